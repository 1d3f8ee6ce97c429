// outside_data.cpp — the position of each quantity within its table, step by step, and the sentences on extrapolation.
#include "studies/validity/outside_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/numerics/period.h"
#include "engine/numerics/turns.h"
#include "engine/orbit/follow_period.h"
#include "engine/run/recorders.h"
#include "engine/scene/units.h"
#include "mechanisms/link_forces/link_forces.h"

namespace kurbel {
namespace {

using DataRange = Network::DataRange;
constexpr double never = std::numeric_limits<double>::infinity();

bool is_said(Beyond beyond) { return beyond == Beyond::hold || beyond == Beyond::line; }
// Rounding allowance at an end.
double slack(const DataRange& range) { return 1e-9 * (range.high - range.low); }
bool is_left_below(const DataRange& range, double x) { return !is_said(range.below) && x < range.low - slack(range); }
bool is_left_above(const DataRange& range, double x) { return !is_said(range.above) && x > range.high + slack(range); }

bool is_over_speed(const DataRange& range) {
  return range.over == DataRange::Over::speed || range.over == DataRange::Over::size_of_speed;
}
// At this speed of the link, of a table over speed.
double place_in(const DataRange& range, const Model& model, double link_speed) {
  const double speed = model.node_ratio[at(range.node)] * link_speed;
  return range.over == DataRange::Over::size_of_speed ? std::abs(speed) : speed;
}

std::string in_words(const DataRange& range, double x, const SpeedUnit& unit) {
  return is_over_speed(range) ? unit.text(x, 6) : with_unit(x, range.unit, 6);
}

// Angles of a cycle or a range: equidistant, and where the outputs of mechanisms reverse.
std::vector<double> angles_of(const RigidMachine& machine) {
  constexpr int of_a_turn = 720;
  const double cycle = machine.cycle();
  const auto cells = std::max(of_a_turn, static_cast<int>(std::lround(of_a_turn * cycle / turn)));
  const AngleRange range{machine.begin(), machine.begin() + cycle};
  std::vector<double> angles;
  for (int i = 0; i <= cells; ++i) angles.push_back(machine.begin() + cycle * i / cells);
  for (const Network::ShaftElement& e : machine.model().network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    const Mechanism* const mechanism = element ? &element->mechanism() : link_force_of(e);
    const double ratio = machine.model().node_ratio[at(e.node)];
    if (!mechanism || ratio == 0) continue;
    const double own = mechanism->cycle();
    for (const double reversal : mechanism->travel.reversals) {
      if (machine.has_range()) {
        if (const double phi = (reversal - e.phase) / ratio; range.holds(phi)) angles.push_back(phi);
        continue;
      }
      for (int k = 0; k < std::max(1.0, std::round(std::abs(ratio) * cycle / own)); ++k)
        angles.push_back(place_within((reversal + k * own - e.phase) / ratio, cycle));
    }
  }
  return angles;
}

// The step that last set a command; empty: as at the start. In a repeating sequence it may be in the previous cycle.
std::optional<std::size_t> last_step_of(const Model& model, std::size_t command, const Modes& modes) {
  const std::vector<SequenceStep>& steps = model.scene.sequence.steps;
  for (std::size_t back = 1; back <= steps.size(); ++back) {
    if (back > modes.next_step && !model.scene.sequence.repeat) return {};
    const std::size_t step = (modes.next_step + steps.size() - back) % steps.size();
    const std::vector<std::string>& set = steps[step].set;
    if (std::find(set.begin(), set.end(), model.commands[command].component) != set.end()) return step;
  }
  return {};
}

// Position of a command relative to the range of this step's law [s]: before it, within it (also if another law is
// followed), or beyond. A law that has ended holds its last value (operating_sequence.cpp).
double place_beside_law(const Model& model, std::size_t command, std::size_t step, const Modes& modes) {
  const Curve& law = model.scene.sequence.steps[step].law;
  const Command& now = modes.command[command];
  if (now.law == static_cast<int>(step)) return now.piece < 0 ? law.x().front() - 1 : law.x().front();
  const bool ended = now.holds_still() && now.value == law.y().back() && last_step_of(model, command, modes) == step;
  return ended ? law.x().back() + 1 : law.x().front();
}

}  // namespace

DataRangeRecorder::DataRangeRecorder(const Model& model) : model_(model) {
  for (const DataRange& range : model.network.ranges) {
    Watched watched{range, {}, {}, {}, {}};
    for (std::size_t e = 0; e < model.network.elements.size(); ++e)
      if (model.network.elements[e].component == range.component) watched.elements.push_back(e);
    const int command = model.command_of(range.component);
    if (range.part >= 0 && command >= 0) watched.command = at(command) + 1 + at(range.part);
    const auto shaft = at(model.shaft_of_node[at(range.node)]);
    const double gain = model.gain_of_node[at(range.node)];
    switch (range.over) {
      case DataRange::Over::time:
        watched.value = [](const Snapshot& s) { return s.now.t; };
        break;
      case DataRange::Over::speed:
        watched.value = [=](const Snapshot& s) { return gain * s.now.speed[shaft]; };
        break;
      case DataRange::Over::size_of_speed:
        watched.value = [=](const Snapshot& s) { return std::abs(gain * s.now.speed[shaft]); };
        break;
      case DataRange::Over::ratio_of_speeds: {
        const auto other = at(model.shaft_of_node[at(range.other)]);
        if (shaft == other) break;
        watched.value = [=, of_other = model.gain_of_node[at(range.other)]](const Snapshot& s) {
          const double a = gain * s.now.speed[shaft], b = of_other * s.now.speed[other];
          const auto [slower, faster] = std::abs(a) < std::abs(b) ? std::pair(a, b) : std::pair(b, a);
          return faster == 0 ? 1 : slower / faster;
        };
        break;
      }
      case DataRange::Over::channel:
        for (Channel& channel : channels_of(model, {range.component}))
          if (channel.name.text == range.channel)
            watched.value = [offset = range.offset, sign = range.sign,
                             of = std::move(channel.value)](const Snapshot& s) { return offset + sign * of(s); };
    }
    if (watched.value) watch(std::move(watched));  // else merged with others: it does not move
  }
  watch_laws();
}

void DataRangeRecorder::watch(Watched watched) {
  since_.push_back(never), least_.push_back(watched.range.low), greatest_.push_back(watched.range.high);
  watched_.push_back(std::move(watched));
}

// A law over time ends with its step, and the command continues.
void DataRangeRecorder::watch_laws() {
  const std::vector<SequenceStep>& steps = model_.scene.sequence.steps;
  for (std::size_t step = 0; step < steps.size(); ++step)
    for (const std::string& component : steps[step].set) {
      Network ranges;
      ranges.limit(
          {.component = component, .of = "law", .over = DataRange::Over::time, .unit = "s", .at = steps[step].at},
          steps[step].law);
      const int of_component = model_.command_of(component);
      if (of_component < 0) continue;
      const auto command = at(of_component);
      for (DataRange& range : ranges.ranges)
        watch({std::move(range), {}, {}, {}, [&model = model_, command, step](const Modes& modes) {
                 return place_beside_law(model, command, step, modes);
               }});
    }
}

bool DataRangeRecorder::is_in_force(const Watched& watched, const Snapshot& snapshot) const {
  if (watched.command && snapshot.now.command[*watched.command] <= 0.5) return false;
  return watched.elements.empty() || std::any_of(watched.elements.begin(), watched.elements.end(),
                                                 [&](std::size_t e) { return snapshot.now.active[e] != 0; });
}

void DataRangeRecorder::see(double t, const Snapshot& snapshot, const Modes* modes) {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const DataRange& range = watched_[i].range;
    if (watched_[i].of_law && !modes) continue;
    const double x = watched_[i].of_law ? watched_[i].of_law(*modes) : watched_[i].value(snapshot);
    if (!(is_left_below(range, x) || is_left_above(range, x)) || !is_in_force(watched_[i], snapshot)) continue;
    since_[i] = std::min(since_[i], t);
    least_[i] = std::min(least_[i], x), greatest_[i] = std::max(greatest_[i], x);
  }
}

void DataRangeRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  if (!watched_.empty()) see(t, equations.snapshot(t, y), &equations.modes());
}

// Ends of tables are ends of steps: the first step beyond an end begins there.
void DataRangeRecorder::step(StepView& view) {
  if (watched_.empty()) return;
  const double begin = view.t_previous(), end = view.t();
  const Modes* const modes = &view.equations().modes();
  const auto look = [&](double t) { see(begin, view.snapshot(t), modes); };
  look(0.5 * (begin + end)), look(end);
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const DataRange& range = watched_[i].range;
    if (since_[i] == never || !watched_[i].value || range.over == DataRange::Over::time) continue;
    const auto value = [&](double t) { return watched_[i].value(view.snapshot(t)); };
    const double x = value(0.5 * (begin + end));
    if (is_left_below(range, x) || is_left_above(range, x)) for_each_turn_within(begin, end, value, look);
  }
}

std::optional<double> DataRangeRecorder::since() const {
  double first = never;
  for (const double since : since_) first = std::min(first, since);
  return first < never ? std::optional(first) : std::nullopt;
}

std::vector<std::string> DataRangeRecorder::sentences() const {
  std::vector<std::string> list;
  std::vector<Message> refused;
  const SpeedUnit& unit = model_.scene.speed_unit;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const DataRange& range = watched_[i].range;
    const char* const allowed = watched_[i].of_law ? "\"hold\"" : "\"hold\" or \"line\"";
    for (const bool above : {false, true}) {
      const double end = above ? range.high : range.low, reached = above ? greatest_[i] : least_[i];
      if (reached == end || since_[i] == never) continue;
      const std::string where = range.over == DataRange::Over::time
                                    ? fmt::format("{} {}", above ? "ends at" : "begins at", in_words(range, end, unit))
                                    : fmt::format("{} {}, and the motion goes to {}", above ? "ends at" : "begins at",
                                                  in_words(range, end, unit), in_words(range, reached, unit));
      if ((above ? range.above : range.below) == Beyond::refuse) {
        refused.push_back({model_.scene.file, range.at,
                           fmt::format("\"{}\": its table of {} {} {}, and the motion is beyond it from {:.4g} s on: "
                                       "there is nothing to compute "
                                       "with. Give more of it, or say how it goes on: beyond = {}",
                                       range.component, range.of, above ? "ends at" : "begins at",
                                       in_words(range, end, unit), since_[i], allowed)});
        continue;
      }
      std::string sentence = fmt::format(
          "the {} of \"{}\" is taken from outside its table, which {}; {}. Figures that depend on it have no known "
          "error; beyond = {} would make it part of the data",
          range.of, range.component, where,
          (above ? range.line_above : range.line_below) ? "its last slope goes on there" : "its end value holds there",
          allowed);
      // Both branches of a table may end at the same place.
      if (std::find(list.begin(), list.end(), sentence) == list.end()) list.push_back(std::move(sentence));
    }
  }
  if (!refused.empty()) throw SceneError(refused);
  return list;
}

void drop_errors(std::vector<Figure>& figures, double since) {
  for (Figure& figure : figures)
    if (!figure.exact && !(figure.at && *figure.at < since)) figure.error.reset(), figure.at_error.reset();
}

void drop_errors(Result& result, double since) {
  drop_errors(result.figures, since);
  for (auto& [name, state] : result.final_state) {
    state.angle.error.reset(), state.speed.error.reset();
    if (state.angle_out) state.angle_out->error.reset(), state.speed_out->error.reset();
  }
  for (std::size_t i = 0; i < std::min(result.event_errors.size(), result.events.size()); ++i)
    if (result.events[i].t > since) result.event_errors[i].reset();
  for (Claim& claim : result.claims)
    if (!(claim.evidence.at && *claim.evidence.at < since)) claim.evidence.error.reset();
}

// Runs that share the rounding of the start agree, and show nothing. An extreme that came before may be passed later.
void drop_errors_after_unstable_start(Result& result) {
  double since = result.until;
  for (const Claim& c : result.claims)
    if (c.predicate == Predicate::start_unstable) since = std::min(since, *c.evidence.at);
  if (since == result.until) return;
  drop_errors(result, -HUGE_VAL);
  if (!std::exchange(result.errors_measured, false)) return;
  result.accuracy_confirmed = false;
  result.notes.push_back(fmt::format(
      "from {:.3g} s on the motion depends on the rounding of its unstable start: no figure has a known error", since));
}

void report_outside_data(const DataRangeRecorder& ranges, Result& result) {
  for (std::string& sentence : ranges.sentences())
    add(result.claims, claimed(Predicate::outside_data, std::move(sentence)));
  if (const std::optional<double> since = ranges.since()) drop_errors(result, *since);
}

std::vector<std::string> outside_data(const ReturnMap& map, const SteadyPoint& point) {
  DataRangeRecorder recorder(map.model());
  Equations equations(map.shared_model(), false);
  if (!recorder.empty()) follow_period(map, point, equations, {.tolerance = map.options().tolerance}, {&recorder});
  return recorder.sentences();
}

std::vector<std::string> outside_data(RigidMachine& machine, double speed) {
  DataRangeRecorder recorder(machine.model());
  if (!recorder.empty())
    for (const double phi : angles_of(machine)) recorder.see(0, machine.snapshot(phi, speed));
  return recorder.sentences();
}

const DataRange* table_left_at(const Model& model, double link_speed) {
  for (const DataRange& range : model.network.ranges) {
    if (!is_over_speed(range)) continue;
    const double x = place_in(range, model, link_speed);
    if (is_left_below(range, x) || is_left_above(range, x)) return &range;
  }
  return nullptr;
}

std::string beyond_in_words(const Model& model, const DataRange& table, double link_speed) {
  const double x = place_in(table, model, link_speed), end = x < table.low ? table.low : table.high;
  return fmt::format("this speed lies outside the table of {} of \"{}\", which {} {}; its slope there is not known",
                     table.of, table.component, x < table.low ? "begins at" : "ends at",
                     in_words(table, end, model.scene.speed_unit));
}

}  // namespace kurbel
