// recurrence.cpp — see recurrence.h.
#include "engine/orbit/recurrence.h"

#include <algorithm>
#include <cmath>

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

}  // namespace kurbel
