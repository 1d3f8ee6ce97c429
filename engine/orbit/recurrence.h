// recurrence.h — events that recur: the times of one kind, and where between those of a period least happens.
#pragma once

#include <optional>
#include <vector>

#include "engine/events/event.h"
#include "engine/model/model.h"

namespace kurbel {

// The last events of a run, and how many there were.
struct RecentEvents {
  EventLog last = {};
  std::size_t seen = 0;
  void add(const EventLog& events);
};

// Times [s], latest first, of all events of the last one's kind; of a sequence that repeats, those of the last command of each
// cycle.
std::vector<double> times_of_last_kind(const std::vector<Event>& events, const Model& m);

// Whether a time is whole periods of the laws over time, to a part in 10⁶. The motion of a sequence that repeats by
// itself repeats after such a time alone; other motions are examined at each period of the laws, and here at others.
bool is_whole(double time, double period);

// Middle [s] of the widest gap between the events of the period that ends at `last`; none: no event is in it.
std::optional<double> middle_of_widest_gap(const std::vector<Event>& events, double last, double period);

}  // namespace kurbel
