// asked_figures.cpp — reads what the scene requests, and finds it along the steps of a run.
#include "studies/figures/asked_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/gauss.h"
#include "engine/model/model.h"
#include "engine/values/quantity_reader.h"
#include "studies/dictionary/dictionary.h"

namespace kurbel {
namespace {

using Over = QuantityKind::Window;

constexpr double beside = 1e-3;     // of a piece: rates by differences
constexpr double same_peak = 1e-9;  // peaks that differ by less are one: the time of the first one counts

Functional functional_named(const std::string& name) {
  constexpr std::pair<std::string_view, Functional> names[] = {
      {"peak", Functional::peak}, {"max", Functional::greatest}, {"min", Functional::least},
      {"mean", Functional::mean}, {"rms", Functional::rms},      {"time above", Functional::above}};
  return std::ranges::find(names, name, &std::pair<std::string_view, Functional>::first)->second;
}

Over window_named(const std::string& name) {
  constexpr std::pair<std::string_view, Over> names[] = {{"run", Over::run},
                                                         {"cycle", Over::steady_cycle},
                                                         {"run-up", Over::run_up},
                                                         {"steady motion", Over::steady_motion},
                                                         {"run-down", Over::run_down}};
  return std::ranges::find(names, name, &std::pair<std::string_view, Over>::first)->second;
}
bool is_period(Over window) {
  return window == Over::run_up || window == Over::steady_motion || window == Over::run_down;
}

// "step_time_above_torque.2.40kN*m.main_coupling": the level as the scene gives it.
Name name_of(const AskedFigure& asked, std::string level) {
  const Name& channel = asked.channel.name;
  const QuantityKind what{channel.what.channel, asked.functional, asked.window};
  std::string text = prefix_of(what) + channel.text.substr(0, channel.text.size() - channel.of.size() - 1);
  if (asked.step > 0) text += fmt::format(".{}", asked.step);
  std::erase(level, ' ');
  if (asked.functional == Functional::above) text += "." + level;
  return {what, channel.of, text + "." + channel.of};
}

// The channel of this name; null: the model has none.
std::optional<Channel> channel_named(const Model& model, const std::string& name) {
  std::vector<std::string> owners;
  for (const std::string& component : model.network.components)
    if ((name + ".").find("." + component + ".") != std::string::npos) owners.push_back(component);
  if (owners.empty()) return {};
  for (Channel& channel : channels_of(model, owners))
    if (channel.name == name) return std::move(channel);
  return {};
}

// Under other effects the machine may have it: the twist of what is rigid; but no speed of what has two shafts.
bool may_exist(const Model& model, const std::string& channel) {
  const auto owns = [&](const std::string& component) { return channel.ends_with("." + component); };
  const Definition* known = definition_of(channel);
  return known && known->verbs.find("run") != std::string_view::npos &&
         std::ranges::any_of(model.network.components, owns) && !channel_named(model, channel + ".in");
}

std::vector<AskedFigure> read(const Model& model, std::vector<std::string>& of_other_effects) {
  std::vector<AskedFigure> list;
  Messages messages(model.scene.file);
  for (const FigureRequest& request : model.scene.figures) {
    const std::optional<Channel> channel = channel_named(model, request.channel);
    if (!channel && may_exist(model, request.channel)) {
      of_other_effects.push_back(
          fmt::format("[[figure]]: under these effects the machine has no channel \"{}\"", request.channel));
      continue;
    }
    if (!channel) {
      std::vector<std::string> names;
      for (const Channel& known : channels_of(model, {})) names.push_back(known.name.text);
      messages.add(request.at,
                   fmt::format("[[figure]]: channel = {}; the machine has none of this name{}; allowed: {}",
                               in_quotes(request.channel), suggestion(request.channel, names), shortened_list(names)));
      continue;
    }
    AskedFigure asked{.channel = *channel, .functional = functional_named(request.functional), .step = request.step};
    asked.window = request.step > 0 ? Over::step : window_named(request.window);
    const bool time = asked.functional == Functional::above;
    DocumentValue level;
    level.type = DocumentValue::Type::text, level.text = request.level, level.at = request.at;
    if (time) read_quantity(level, channel->unit, any_number, "[[figure]]: level", messages, asked.level);
    asked.figure = Figure::of_name(name_of(asked, request.level), 0, time ? "s" : channel->unit);
    if (std::ranges::find(list, asked.figure.name, [](const AskedFigure& a) { return a.figure.name; }) != list.end())
      messages.add(request.at, fmt::format("[[figure]]: \"{}\" is requested twice", asked.figure.name));
    list.push_back(std::move(asked));
  }
  messages.throw_if_any();
  return list;
}

// Times in a stretch at which its channel is examined: its ends, its middle, and beside them for the rates.
struct Looks {
  Looks(double from, double to)
      : delta(beside * (to - from)),
        at{from, from + delta, middle(from, to) - delta, middle(from, to), middle(from, to) + delta, to - delta, to} {}
  static double middle(double from, double to) { return 0.5 * (from + to); }
  double delta;
  std::array<double, 7> at;
};

// The polynomial through a channel's values at the ends of a stretch and at the Gauss points between them, by Lagrange.
double interpolated(double from, double to, const std::array<double, 7>& x, double t) {
  constexpr auto& inner = gauss<5>.x;
  constexpr std::array<double, 7> nodes = {-1, inner[0], inner[1], inner[2], inner[3], inner[4], 1};
  const double s = (2 * t - from - to) / (to - from);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double factor = x[i];
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k != i) factor *= (s - nodes[k]) / (nodes[i] - nodes[k]);
    sum += factor;
  }
  return sum;
}

}  // namespace

std::vector<AskedFigure> asked_figures(const Model& model) {
  std::vector<std::string> of_other_effects;
  return read(model, of_other_effects);
}

std::vector<std::string> figures_not_given(const Model& model, const std::vector<Figure>& given) {
  std::vector<std::string> notes;
  for (const AskedFigure& asked : read(model, notes))
    if (!find(given, asked.figure.name))
      notes.push_back(fmt::format("[[figure]]: no {}: the run {}", asked.figure.name,
                                  asked.step > 0 ? fmt::format("does not come to step {} of the sequence", asked.step)
                                  : asked.window == Over::run_up        ? "has no run-up to a steady motion"
                                  : asked.window == Over::steady_motion ? "does not become steady"
                                  : asked.window == Over::run_down      ? "has no run-down from a steady motion"
                                                                        : "has no whole cycle"));
  return notes;
}

AskedRecorder::AskedRecorder(const Model& model, const CycleRecorder* cycles, const CycleRecorder* by_time)
    : cycles_{cycles, by_time} {
  for (AskedFigure& asked : asked_figures(model))
    if (cycles || asked.window == Over::steady_cycle) {
      const Meter meter{asked.functional, asked.level};
      asked_.push_back({std::move(asked), meter});
    }
}

void AskedRecorder::begin(double t, std::span<const double>, Equations&) {
  for (Asked& asked : asked_)
    if (asked.window == Over::run || is_period(asked.window) || !cycles_.front()) asked.open = true, asked.now = {t, t};
}

void AskedRecorder::step(StepView& view) {
  double from = view.t_previous();
  follow_sequence(view.equations(), from);
  for (const double end : ends_of_cycles(view)) {
    take(view, from, end);
    begin_cycle(end);
    from = end;
  }
  take(view, from, view.t());
}

// A step of the sequence was carried out: the window of the one before it ends.
void AskedRecorder::follow_sequence(const Equations& equations, double t) {
  const Modes& modes = equations.modes();
  if (modes.next_step == next_step_ && modes.last_step_time == step_began_) return;
  const bool none_yet = step_began_ == -HUGE_VAL && modes.next_step == 0 && modes.cycle_began > t;
  const std::size_t taken = none_yet              ? 0
                            : modes.next_step > 0 ? modes.next_step
                                                  : equations.model().scene.sequence.steps.size();
  next_step_ = modes.next_step, step_began_ = modes.last_step_time;
  for (Asked& asked : asked_) {
    if (asked.window != Over::step) continue;
    if (asked.open) asked.whole = {asked.now};
    asked.open = static_cast<std::size_t>(asked.step) == taken;
    asked.now = {t, t};
  }
}

// Within this step, ascending; the cycle that begins with it has begun.
std::vector<double> AskedRecorder::ends_of_cycles(const StepView& view) {
  std::vector<double> ends;
  for (std::size_t i = 0; i < cycles_.size() && cycles_[i]; ++i) {
    const std::vector<CycleRecord>& cycles = cycles_[i]->cycles();
    for (std::size_t& seen = seen_cycles_[i]; seen < cycles.size(); ++seen)
      for (const double end : {cycles[seen].begin, cycles[seen].end}) ends.push_back(end);
    ends.push_back(cycles_[i]->begin_of_current());
  }
  std::erase_if(ends, [&](double end) { return end < view.t_previous() || end > view.t(); });
  std::ranges::sort(ends);
  ends.erase(std::ranges::unique(ends).begin(), ends.end());
  return ends;
}

void AskedRecorder::begin_cycle(double t) {
  for (Asked& asked : asked_) {
    if (asked.window != Over::steady_cycle || (asked.open && asked.now.begin == t)) continue;
    if (asked.open) asked.whole.push_back(asked.now);
    asked.open = true, asked.now = {t, t};
  }
}

// From a to b within a step.
void AskedRecorder::take(StepView& view, double a, double b) {
  if (!(b > a)) return;
  const double middle = a + (b - a) / 2;
  take_half(view, a, middle);
  take_half(view, middle, b);
}

void AskedRecorder::take_half(StepView& view, double from, double to) {
  const Looks looks(from, to);
  std::vector<std::array<double, 7>> values(asked_.size());
  for (std::size_t k = 0; k < looks.at.size(); ++k) {
    const Snapshot& s = view.snapshot(looks.at[k]);
    for (std::size_t i = 0; i < asked_.size(); ++i) values[i][k] = asked_[i].channel.value(s);
  }
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    Asked& asked = asked_[i];
    if (!asked.open) continue;
    if (is_period(asked.window)) asked.now = {from, to}, asked.stretches.push_back({});
    asked.meter.add(
        asked.now, from, to, [&](double t) { return asked.channel.value(view.snapshot(t)); }, values[i]);
  }
  std::size_t node = 0;
  gauss<5>.over(from, to - from, [&](double t, double weight) {
    ++node;
    const Snapshot* s = nullptr;
    for (Asked& asked : asked_) {
      if (!asked.open || !(asked.meter.needs_integral() || is_period(asked.window))) continue;
      if (!s) s = &view.snapshot(t);
      const double value = asked.channel.value(*s);
      asked.meter.add_integral(asked.now, weight, value);
      if (is_period(asked.window)) asked.stretches.back().x[node] = value;
    }
  });
  for (std::size_t i = 0; i < asked_.size(); ++i)
    if (Asked& asked = asked_[i]; asked.open && is_period(asked.window)) {
      Stretch& stretch = asked.stretches.back();
      static_cast<Gauge&>(stretch) = asked.now;
      stretch.x.front() = values[i].front(), stretch.x.back() = values[i].back();
    }
}

double AskedRecorder::Meter::merit(double value) const {
  return functional == Functional::greatest ? value : functional == Functional::least ? -value : std::abs(value);
}

void AskedRecorder::Meter::add_integral(Gauge& gauge, double weight, double value) const {
  if (needs_integral()) gauge.sum += weight * (functional == Functional::rms ? value * value : value);
}

void AskedRecorder::Meter::add_extreme(Gauge& gauge, const Sampled& found) {
  size = std::max(size, std::abs(found.value));
  if (gauge.extreme && merit(found.value) <= merit(gauge.extreme->value)) return;
  const bool same = gauge.extreme && merit(found.value) - merit(gauge.extreme->value) <= same_peak * size;
  gauge.extreme = {same ? gauge.extreme->at : found.at, found.value};
}

template <class X>
void AskedRecorder::Meter::add(Gauge& gauge, double from, double to, const X& x, const std::array<double, 7>& at) {
  const Looks looks(from, to);
  const double middle = looks.at[3], delta = looks.delta;
  const auto rate = [&](double t) { return x(std::min(t + delta, to)) - x(std::max(t - delta, from)); };
  std::vector<Sampled> ends = {{from, at[0]}, {middle, at[3]}, {to, at[6]}};
  for_each_turn(rate, {from, at[1] - at[0]}, {middle, at[4] - at[2]}, {to, at[6] - at[5]}, [&](double t) {
    ends.push_back({t, x(t)});
  });
  std::ranges::sort(ends, {}, &Sampled::at);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) add_monotone(gauge, x, ends[k], ends[k + 1]);
}

// The channel rises or falls from a to b.
template <class X>
void AskedRecorder::Meter::add_monotone(Gauge& gauge, const X& x, const Sampled& a, const Sampled& b) {
  gauge.end = b.at;
  for (const Sampled& end : {a, b}) add_extreme(gauge, end);
  if (functional != Functional::above) return;
  const double over_a = a.value - level, over_b = b.value - level;
  if (over_a <= 0 && over_b <= 0) return;
  if (over_a >= 0 && over_b >= 0) {
    gauge.sum += b.at - a.at;
    return;
  }
  const double crossing = find_root([&](double t) { return x(t) - level; }, a.at, over_a, b.at, over_b);
  gauge.sum += over_b > 0 ? b.at - crossing : crossing - a.at;
}

double AskedRecorder::Meter::value(const Gauge& gauge) const {
  const double mean = gauge.sum / (gauge.end - gauge.begin);
  return functional == Functional::mean    ? mean
         : functional == Functional::rms   ? std::sqrt(std::max(mean, 0.0))
         : functional == Functional::above ? gauge.sum
                                           : gauge.extreme->value;
}

// Between two times that need not be ends of stretches: in a part of one its channel is interpolated.
AskedRecorder::Gauge AskedRecorder::between(const Asked& asked, double begin, double end) {
  Meter meter = asked.meter;
  Gauge all{begin, begin};
  for (const Stretch& stretch : asked.stretches) {
    const double from = std::max(begin, stretch.begin), to = std::min(end, stretch.end);
    if (!(to > from)) continue;
    Gauge part = stretch;
    if (from > stretch.begin || to < stretch.end) {
      const auto x = [&](double t) { return interpolated(stretch.begin, stretch.end, stretch.x, t); };
      std::array<double, 7> at;
      std::ranges::transform(Looks(from, to).at, at.begin(), x);
      part = {from, to};
      meter.add(part, from, to, x, at);
      gauss<5>.over(from, to - from, [&](double t, double weight) { meter.add_integral(part, weight, x(t)); });
    }
    all.end = to, all.sum += part.sum;
    meter.add_extreme(all, *part.extreme);
  }
  return all;
}

std::optional<AskedRecorder::Gauge> AskedRecorder::gauge_of(const Asked& asked, const CycleRecord* cycle) const {
  std::optional<Gauge> gauge;
  if (asked.window != Over::steady_cycle || !cycles_.front()) {
    gauge = asked.whole.empty() ? asked.now : asked.whole.back();
  } else if (cycle) {
    Meter meter = asked.meter;
    for (const Gauge& part : asked.whole) {
      if (part.begin < cycle->begin || part.end > cycle->end) continue;
      if (!gauge) gauge.emplace(part.begin, part.end);
      gauge->end = part.end, gauge->sum += part.sum;
      meter.add_extreme(*gauge, *part.extreme);
    }
  }
  return gauge && gauge->end > gauge->begin ? gauge : std::nullopt;
}

void AskedRecorder::give(const Asked& asked, const Gauge& gauge, double resolution, FigureReporter& report) {
  Figure& figure = report.take(asked.figure);
  const Meter& meter = asked.meter;
  const bool extreme = !meter.needs_integral() && meter.functional != Functional::above;
  figure.value = meter.value(gauge), figure.resolution = resolution;
  figure.at = extreme ? gauge.extreme->at : gauge.end;
  figure.scale = meter.functional == Functional::above ? gauge.end - gauge.begin : meter.size;
}

void AskedRecorder::report(const CycleRecord* cycle, std::span<const PeriodOfRun> periods,
                           FigureReporter& report) const {
  for (const Asked& asked : asked_) {
    if (report.find(asked.figure.name)) continue;
    if (!is_period(asked.window)) {
      if (const std::optional<Gauge> gauge = gauge_of(asked, cycle)) give(asked, *gauge, 0, report);
      continue;
    }
    const auto period = std::ranges::find(periods, asked.window, &PeriodOfRun::window);
    if (period == periods.end()) continue;
    const auto gauge = [&](double shift) {
      return between(asked, period->begin + shift * period->begin_open, period->end + shift * period->end_open);
    };
    const Gauge found = gauge(0);
    if (!(found.end > found.begin)) continue;
    double resolution = 0;
    for (const double shift : {-1.0, 1.0})
      if (const Gauge other = gauge(shift); other.end > other.begin)
        resolution = std::max(resolution, std::abs(asked.meter.value(other) - asked.meter.value(found)));
    give(asked, found, resolution, report);
  }
}

}  // namespace kurbel
