// recurrence.h — events that recur, and where between them least happens; repetitions that are late; how a run that does not
// repeat ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/events/event.h"
#include "engine/model/model.h"
#include "engine/orbit/link_speeds.h"
#include "engine/return_map/return_map.h"

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

// A repetition of a clocked sequence began late, or is late in the state at the end.
bool begins_late_in(const EventLog& events, const State& end, const Sequence& sequence);
// "; its steps take longer than every = 0.5 s"; empty: it keeps to its clock, or has none.
std::string late_in_words(const Sequence& sequence, bool clocked);

// Values increase over the second half of all, in its second half as much as in its first, beyond 2.
bool grows(const std::vector<double>& speeds);

// The machine comes to rest by an event, or approaches the rest; as in the periods of a run.
std::string rest_in_words(const LastMotion& motion, const EventLog& events, const Model& m);

// "it runs away: at 2 s a shaft turns at 31 times its rated speed, …"; `times` the scale of speeds. Where no element states a
// speed: that of the link [rad/s].
std::string runaway_in_words(double t, double times, double link_speed, const Model& m);

}  // namespace kurbel
