// recurrence.cpp — see recurrence.h.
#include "engine/orbit/recurrence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/orbit/stated_speed.h"
#include "engine/return_map/periodicity.h"
#include "engine/run/speed_history.h"

namespace kurbel {
namespace {

std::size_t commands_in_a_cycle(const Model& m) {
  std::size_t count = 0;
  for (const SequenceStep& step : m.scene.sequence.steps) count += step.set.size();
  return std::max<std::size_t>(1, count);
}

}  // namespace

void RecentEvents::add(const EventLog& events) {
  constexpr std::ptrdiff_t most =
      20000;  // several periods of a sequence with some hundred each: joints, rattling gears
  last.insert(last.end(), events.begin(), events.end());
  seen += events.size();
  if (std::ssize(last) > most) last.erase(last.begin(), last.end() - most);
}

std::vector<double> times_of_last_kind(const std::vector<Event>& events, const Model& m) {
  std::vector<double> times;
  const std::size_t cycle = commands_in_a_cycle(m);
  std::size_t commands = 0;
  for (auto e = events.rbegin(); e != events.rend(); ++e)
    if (m.scene.sequence.repeat ? e->kind == EventKind::command && commands++ % cycle == 0
                                : e->component == events.back().component && e->what == events.back().what)
      times.push_back(e->t);
  return times;
}

bool is_whole(double time, double period) { return std::abs(std::remainder(time, period)) < 1e-6 * period; }

std::optional<double> middle_of_widest_gap(const std::vector<Event>& events, double last, double period) {
  std::vector<double> times;
  for (const Event& e : events)
    if (e.t > last - (1 - 1e-6) * period && e.t <= last) times.push_back(e.t);
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  times.push_back(times.front() + period);
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (times[i + 1] - times[i] > times[widest + 1] - times[widest]) widest = i;
  return 0.5 * (times[widest] + times[widest + 1]);
}

bool begins_late_in(const EventLog& events, const State& end, const Sequence& sequence) {
  const double clock = least_repetition(sequence) * (1 + 1e-9);
  if (clock == 0) return false;
  return end.t - end.modes.cycle_began > clock || std::any_of(events.begin(), events.end(), [&](const Event& e) {
           return e.kind == EventKind::note && e.component == "sequence" && e.value > clock;
         });
}

std::string late_in_words(const Sequence& sequence, bool clocked) {
  if (sequence.every == 0 || (clocked && least_repetition(sequence) == sequence.every)) return {};
  return fmt::format("; its steps take longer than every = {:.6g} s", sequence.every);
}

bool grows(const std::vector<double>& speeds) {
  const std::size_t n = speeds.size();
  if (n < 40) return false;
  const double late = speeds[n - 1] - speeds[n - 1 - n / 4], before = speeds[n - 1 - n / 4] - speeds[n - 1 - n / 2];
  return late > 0 && before > 0 && speeds.back() > 2 && late > 0.5 * before;
}

std::string rest_in_words(const LastMotion& motion, const EventLog& events, const Model& m) {
  const auto [hundredth, thousandth, moving] = motion.times();
  const std::string link = m.node_label(m.reduction_node);
  const std::string slow =
      states_rated_speed(m) ? "0.1 % of its rated speed" : m.scene.speed_unit.text(1e-3 * m.speed_scale, 3);
  if (moving == 0) return "the machine stands from its start on";
  if (thousandth == 0) return fmt::format("the machine stays at rest: \"{}\" never reaches {}", link, slow);
  if (const Event* rest = rest_of(events, {hundredth, thousandth, moving}, m))
    return fmt::format("the machine comes to rest at {:.4g} s and stays there", rest->t);
  return fmt::format("the machine slows down to rest: \"{}\" is below {} from {:.4g} s on", link, slow, thousandth);
}

std::string runaway_in_words(double t, double times, double link_speed, const Model& m) {
  const std::string fast = states_rated_speed(m) ? fmt::format("a shaft turns at {:.3g} times its rated speed", times)
                                                 : fmt::format("\"{}\" turns at {}", m.node_label(m.reduction_node),
                                                               m.scene.speed_unit.text(link_speed, 4));
  return fmt::format("it runs away: at {:.4g} s {}, and nothing ends the acceleration", t, fast);
}

}  // namespace kurbel
