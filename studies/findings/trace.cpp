// trace.cpp — samples within each step; a full trace is thinned to half.
#include "studies/findings/trace.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "studies/findings/thin.h"

namespace kurbel {
namespace {

constexpr int samples_per_step = 6;
constexpr double same_end = 1e-3;  // of a turn: runs of other tolerances end it elsewhere
constexpr std::size_t full = 16000, thinned = 8000, rows_of_block = 128;

void push(Trace& trace, double x, double y) {
  trace.x.push_back(x);
  trace.y.push_back(y + 0.0);  // no −0
  if (trace.x.size() >= full) thin_by_extremes(trace.x, trace.y, thinned);
}

void append(Trace& trace, const std::vector<double>& x, const double* y) {
  if (trace.x.size() + x.size() >= full) {
    for (std::size_t i = 0; i < x.size(); ++i) push(trace, x[i], y[i]);
  } else {
    trace.x.insert(trace.x.end(), x.begin(), x.end());
    for (std::size_t i = 0; i < x.size(); ++i) trace.y.push_back(y[i] + 0.0);
  }
}

}  // namespace

// Between the points before `next` and at it.
double Trace::before(std::size_t next, double place) const {
  if (next == 0 || next == x.size() || !(x[next] > x[next - 1])) return y[std::min(next, y.size() - 1)];
  return y[next - 1] + (y[next] - y[next - 1]) * (place - x[next - 1]) / (x[next] - x[next - 1]);
}

double Trace::at(double place) const {
  return before(static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), place) - x.begin()), place);
}

std::vector<double> Trace::at(const std::vector<double>& places) const {
  std::vector<double> values;
  values.reserve(places.size());
  const bool ascends = std::is_sorted(x.begin(), x.end());
  std::size_t next = 0;  // the first one that is not before the place: mostly near the last one
  for (const double place : places) {
    while (ascends && next < x.size() && x[next] < place) ++next;
    if (!ascends || (next > 0 && !(x[next - 1] < place)))
      next = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), place) - x.begin());
    values.push_back(before(next, place));
  }
  return values;
}

TraceRecorder::TraceRecorder(const Model& model) : model_(&model), sources_(model) {
  for (Channel& channel : channels_of(
           model, model.network.components.size() > 60 ? std::vector<std::string>{} : model.network.components)) {
    if (channel.name.what == quantities::spring_torque || channel.name.what == quantities::angle) continue;
    channels_.push_back(std::move(channel));
  }
  const int link = model.reduction_node;
  channels_.push_back({Name::make(quantities::angle), "rad", [link](const Snapshot& s) { return s.node_angle[link]; }});
  if (model.network.components.size() <= 60)
    for (const std::string& component : model.network.components) {
      const Network::Ports& ports = model.network.ports.at(component);
      for (const int node : {ports.in, ports.out}) {
        const double ratio = model.node_ratio[static_cast<std::size_t>(node)];
        if (ratio == 0 || node == link || (node == ports.out && ports.in == ports.out && node != ports.in)) continue;
        bool known = false;
        for (const Channel& c : channels_) known = known || c.name.text == Traces::node_key(node);
        if (!known)
          channels_.push_back({Name{quantities::other, "", Traces::node_key(node)}, "rad",
                               [=](const Snapshot& s) { return s.node_angle[node] / ratio - s.node_angle[link]; }});
      }
    }
  for (const Channel& channel : channels_) {
    const QuantityKind& what = channel.name.what;
    if (what == quantities::torque || what == quantities::force || what == quantities::load_torque ||
        what == quantities::speed || what == quantities::slip || what == quantities::position)
      over_angle_.push_back(traces_->over_time.size());
    traces_->over_time.push_back({channel.name.text, channel.unit, {}, {}, what, channel.name.of});
  }
  for (const char* name :
       {"kinetic_energy", "stored_energy", "work.driving", "work.useful", "work.harmful", "work.weight"})
    traces_->over_time.push_back({name, "J", {}, {}});
  now_.resize(traces_->over_time.size());
  for (const WorkAccount& account : model.accounts) {
    const auto kind = std::find(all_accounts.begin(), all_accounts.end(), account.kind);
    works_.push_back(now_.size() - static_cast<std::size_t>(all_accounts.end() - kind));
  }
  block_.resize(now_.size() * rows_of_block);
  for (Trace& trace : traces_->over_time) trace.x.reserve(full), trace.y.reserve(full);
}

const Trace* Traces::find(const std::string& name) const {
  for (const Trace& trace : over_time)
    if (trace.name == name) return &trace;
  return nullptr;
}

void TraceRecorder::look(double t, std::span<const double> y, Equations& equations) {
  const Snapshot& s = equations.snapshot(t, y);
  for (std::size_t k = 0; k < channels_.size(); ++k) now_[k] = channels_[k].value(s);
  angle_ = s.node_angle[model_->reduction_node];
  std::size_t k = channels_.size();
  now_[k++] = equations.kinetic_energy(t, y);
  now_[k++] = equations.stored_energy(t, y);
  std::fill(now_.begin() + static_cast<std::ptrdiff_t>(k), now_.end(), 0.0);
  for (std::size_t a = 0; a < works_.size() && equations.audit(); ++a) now_[works_[a]] += y[equations.work_index(a)];
}

void TraceRecorder::put(double t, Equations& equations) {
  std::size_t place = times_.size();
  for (const double value : now_) block_[place] = value, place += rows_of_block;
  times_.push_back(t);
  angles_.push_back(angle_);
  if (model_->cycle > 0) follow_cycle(t, sources_.drive(equations.modes().active));
  if (times_.size() == rows_of_block) hand_over();
}

void TraceRecorder::put_jumps(double t) {
  hand_over();
  for (std::size_t i = 0; i < now_.size(); ++i) {
    Trace& trace = traces_->over_time[i];
    if (trace.y.empty() || !(std::abs(trace.y.back() - now_[i]) <= 1e-9 * std::abs(now_[i]))) push(trace, t, now_[i]);
  }
}

void TraceRecorder::hand_over() {
  for (std::size_t i = 0; i < now_.size(); ++i) append(traces_->over_time[i], times_, &block_[i * rows_of_block]);
  for (double& angle : angles_) angle -= turn_ * model_->cycle;
  for (std::size_t k = 0; k < open_.traces.size(); ++k)
    append(open_.traces[k], angles_, &block_[over_angle_[k] * rows_of_block]);
  times_.clear(), angles_.clear();
}

std::shared_ptr<const Traces> TraceRecorder::traces(int cycles, double until) {
  hand_over();
  std::deque<CycleTraces>& last = traces_->last_cycles;
  const auto is_later = [until](const CycleTraces& c) { return c.end - same_end * (c.end - c.begin) > until; };
  while (!last.empty() && !is_later(last.front()) && is_later(last.back())) last.pop_back();
  const std::ptrdiff_t n = cycles, count = std::ssize(last);
  const auto apart = [](const CycleTraces& a, const CycleTraces& b) { return a.end != b.begin; };
  // The turns of a period follow each other: where the last do not, those before them.
  std::ptrdiff_t begin = count - n;
  while (begin >= 0 &&
         std::adjacent_find(last.begin() + begin, last.begin() + begin + n, apart) != last.begin() + begin + n)
    begin -= n;
  const bool joins = n > 1 && begin >= 0;
  if (joins) last.erase(last.begin() + begin + n, last.end());
  last.erase(last.begin(), last.end() - (joins ? n : std::min<std::ptrdiff_t>(2, count)));
  for (; joins && last.size() > 1; last.erase(last.begin() + 1)) {
    const double turned = model_->cycle * last[0].cycles;
    last[0].end = last[1].end, ++last[0].cycles;
    for (std::size_t k = 0; k < last[0].traces.size(); ++k) {
      Trace &all = last[0].traces[k], &next = last[1].traces[k];
      for (double& x : next.x) x += turned;
      all.x.insert(all.x.end(), next.x.begin(), next.x.end());
      all.y.insert(all.y.end(), next.y.begin(), next.y.end());
    }
  }
  return traces_;
}

// A turn of the run-down is not among the cycles for figures.
void TraceRecorder::keep_open_cycle() {
  if (any_driven_ && !open_driven_) return;
  if (open_driven_ && !any_driven_) traces_->last_cycles.clear();
  any_driven_ = any_driven_ || open_driven_;
  traces_->last_cycles.push_back(std::move(open_));
  if (traces_->last_cycles.size() > at(most_cycles_of_a_period)) traces_->last_cycles.pop_front();
}

void TraceRecorder::begin_cycle(double t, bool driven) {
  open_ = {t, t, {}};
  open_driven_ = driven;
  for (const std::size_t i : over_angle_) {
    const Trace& like = traces_->over_time[i];
    open_.traces.push_back({like.name, like.unit, {}, {}, like.what, like.of});
  }
}

// The latest row is in the block already; the next turn begins with it, too.
void TraceRecorder::follow_cycle(double t, bool driven) {
  const double turn = std::floor(angle_ / model_->cycle + 1e-12);
  if (open_.traces.empty()) {
    turn_ = turn;
    open_whole_ = std::abs(angle_ - turn * model_->cycle) < 1e-6;
    begin_cycle(t, driven);
  } else if (turn != turn_) {
    open_driven_ = open_driven_ && driven;
    open_.end = t;
    hand_over();
    if (open_whole_ && turn > turn_) keep_open_cycle();
    open_whole_ = turn > turn_;
    turn_ = turn;
    begin_cycle(t, driven);
    for (std::size_t k = 0; k < over_angle_.size(); ++k)
      push(open_.traces[k], angle_ - turn_ * model_->cycle, now_[over_angle_[k]]);
  }
  open_driven_ = open_driven_ && driven;
  open_.end = t;
}

void TraceRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  look(t, y, equations);
  put(t, equations);
}

// Where the link passes from one turn to the next, so that cycles begin and end there and not at the next sample.
std::optional<double> TraceRecorder::border_between(double from, double angle_from, double to, double angle_to,
                                                    StepView& view) const {
  const double first = angle_from / model_->cycle, last = angle_to / model_->cycle;
  const double border = std::max(std::floor(first), std::floor(last));
  if (std::floor(first) == std::floor(last) || first == border || last == border) return {};
  const auto beyond = [&](double t) {
    return view.snapshot(t).node_angle[model_->reduction_node] / model_->cycle - border;
  };
  return find_root(beyond, from, first - border, to, last - border);
}

void TraceRecorder::step(StepView& view) {
  const double t0 = view.t_previous(), t1 = view.t();
  Equations& equations = view.equations();
  if (view.begins_anew()) {
    look(t0, view.y_previous(), equations);
    put_jumps(t0);
  }
  double before = t0;
  for (int i = 1; i <= samples_per_step; ++i) {
    const double t = i == samples_per_step ? t1 : t0 + (t1 - t0) * i / samples_per_step, angle_before = angle_;
    look(t, view.at(t), equations);
    if (model_->cycle > 0)
      if (const std::optional<double> border = border_between(before, angle_before, t, angle_, view)) {
        look(*border, view.at(*border), equations);
        put(*border, equations);
        look(t, view.at(t), equations);
      }
    put(t, equations);
    before = t;
  }
}

}  // namespace kurbel
