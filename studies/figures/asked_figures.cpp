// asked_figures.cpp — reads what the scene asks for, and finds it along the steps of a run.
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
    if (request.window == "cycle") asked.window = Over::steady_cycle;
    if (request.step > 0) asked.window = Over::step;
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

}  // namespace

std::vector<AskedFigure> asked_figures(const Model& model) {
  std::vector<std::string> of_other_effects;
  return read(model, of_other_effects);
}

std::vector<std::string> figures_not_given(const Model& model, const std::vector<Figure>& given) {
  std::vector<std::string> notes;
  for (const AskedFigure& asked : read(model, notes))
    if (!find(given, asked.figure.name))
      notes.push_back(fmt::format(
          "[[figure]]: no {}: the run {}", asked.figure.name,
          asked.step > 0 ? fmt::format("does not come to step {} of the sequence", asked.step) : "has no whole cycle"));
  return notes;
}

AskedRecorder::AskedRecorder(const Model& model, const CycleRecorder* cycles) : cycles_(cycles) {
  for (AskedFigure& asked : asked_figures(model))
    if (cycles || asked.window == Over::steady_cycle) asked_.push_back({std::move(asked)});
}

void AskedRecorder::begin(double t, std::span<const double>, Equations&) {
  for (Asked& asked : asked_)
    if (asked.window == Over::run || !cycles_) asked.open = true, asked.now = {t, t};
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
  if (!cycles_) return ends;
  const std::vector<CycleRecord>& cycles = cycles_->cycles();
  for (; seen_cycles_ < cycles.size(); ++seen_cycles_)
    for (const double end : {cycles[seen_cycles_].begin, cycles[seen_cycles_].end}) ends.push_back(end);
  ends.push_back(cycles_->begin_of_current());
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
  constexpr int parts = 2;
  for (int part = 0; part < parts; ++part) {
    const double from = a + (b - a) * part / parts, to = part + 1 < parts ? a + (b - a) * (part + 1) / parts : b;
    const double middle = 0.5 * (from + to), delta = beside * (to - from);
    const std::array time = {from, from + delta, middle - delta, middle, middle + delta, to - delta, to};
    std::vector<std::array<double, time.size()>> values(asked_.size());
    for (std::size_t k = 0; k < time.size(); ++k) {
      const Snapshot& s = view.snapshot(time[k]);
      for (std::size_t i = 0; i < asked_.size(); ++i) values[i][k] = asked_[i].channel.value(s);
    }
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      Asked& asked = asked_[i];
      if (!asked.open) continue;
      const auto x = [&](double t) { return asked.channel.value(view.snapshot(t)); };
      const auto rate = [&](double t) { return x(std::min(t + delta, to)) - x(std::max(t - delta, from)); };
      const auto& at = values[i];
      std::vector<Sampled> ends = {{from, at[0]}, {middle, at[3]}, {to, at[6]}};
      for_each_turn(rate, {from, at[1] - at[0]}, {middle, at[4] - at[2]}, {to, at[6] - at[5]}, [&](double t) {
        ends.push_back({t, x(t)});
      });
      std::ranges::sort(ends, {}, &Sampled::at);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k) add_piece(view, asked, ends[k], ends[k + 1]);
    }
    gauss<5>.over(from, to - from, [&](double t, double weight) {
      const Snapshot* s = nullptr;
      for (Asked& asked : asked_) {
        const bool square = asked.functional == Functional::rms;
        if (!asked.open || !(square || asked.functional == Functional::mean)) continue;
        if (!s) s = &view.snapshot(t);
        const double value = asked.channel.value(*s);
        asked.now.sum += weight * (square ? value * value : value);
      }
    });
  }
}

double AskedRecorder::merit(const Asked& asked, double value) {
  return asked.functional == Functional::greatest ? value
         : asked.functional == Functional::least  ? -value
                                                  : std::abs(value);
}

// The channel rises or falls from a to b.
void AskedRecorder::add_piece(StepView& view, Asked& asked, const Sampled& a, const Sampled& b) {
  Gauge& now = asked.now;
  now.end = b.at;
  for (const Sampled& end : {a, b}) {
    asked.size = std::max(asked.size, std::abs(end.value));
    if (now.extreme && merit(asked, end.value) <= merit(asked, now.extreme->value)) continue;
    const bool same =
        now.extreme && merit(asked, end.value) - merit(asked, now.extreme->value) <= same_peak * asked.size;
    now.extreme = {same ? now.extreme->at : end.at, end.value};
  }
  if (asked.functional != Functional::above) return;
  const double over_a = a.value - asked.level, over_b = b.value - asked.level;
  if (over_a <= 0 && over_b <= 0) return;
  if (over_a >= 0 && over_b >= 0) {
    now.sum += b.at - a.at;
    return;
  }
  const auto over = [&](double t) { return asked.channel.value(view.snapshot(t)) - asked.level; };
  const double crossing = find_root(over, a.at, over_a, b.at, over_b);
  now.sum += over_b > 0 ? b.at - crossing : crossing - a.at;
}

const AskedRecorder::Gauge* AskedRecorder::gauge_of(const Asked& asked, double cycle_end) const {
  const Gauge* gauge = &asked.now;
  if (asked.window == Over::steady_cycle && cycles_) {
    const auto found = std::ranges::find(asked.whole, cycle_end, &Gauge::end);
    gauge = found == asked.whole.end() ? nullptr : &*found;
  } else if (!asked.whole.empty()) {
    gauge = &asked.whole.back();
  }
  return gauge && gauge->end > gauge->begin ? gauge : nullptr;
}

void AskedRecorder::report(double cycle_end, FigureReporter& report) const {
  for (const Asked& asked : asked_) {
    const Gauge* const gauge = gauge_of(asked, cycle_end);
    if (!gauge || report.find(asked.figure.name)) continue;
    Figure& figure = report.take(asked.figure);
    const double time = gauge->end - gauge->begin, mean = gauge->sum / time;
    figure.at = gauge->end, figure.scale = asked.size;
    if (asked.functional == Functional::mean)
      figure.value = mean;
    else if (asked.functional == Functional::rms)
      figure.value = std::sqrt(std::max(mean, 0.0));
    else if (asked.functional == Functional::above)
      figure.value = gauge->sum, figure.scale = time;
    else
      figure.value = gauge->extreme->value, figure.at = gauge->extreme->at;
  }
}

}  // namespace kurbel
