// event_words.h — texts of the events of a run.
//
// Elements name their own modes (GuardLabel); all other texts are here. Programs read `kind` and `value`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/equations/contact.h"
#include "engine/events/event.h"

namespace kurbel {

// The law of an element changes to another piece. Edges over the angle have their own names; else the label names the mode.
Event law_event(double t, const GuardLabel& before, const GuardLabel& now, bool edge_over_angle);
// Directions: −1 backwards, 0 stuck, 1 forwards.
Event contact_event(double t, const Contact& contact, int before, int now);
// Several elements hold a shaft, each with its share of the capacity [1].
using Shares = std::vector<std::pair<std::string, double>>;
Event shares_event(double t, const Contact& contact, const Shares& shares);
Event jam_event(double t, const Contact& contact);
// A command changes from one value to another, at once or over a time [s].
Event command_event(double t, const std::string& component, double before, double to, double over);
// A cycle of the operating sequence took longer than its period [s].
Event late_cycle_event(double t, double took, double every);
Event window_event(double t, const std::string& component, bool on);
// Number of contacts that changed at one instant; a consistent set of modes was found after so many changes, or none.
Event modes_event(double t, std::size_t contacts, bool fits, int changes);
// Chattering: so many events within a short time [s] that their owners get a law without events.
Event restless_event(double t, const std::string& owners, std::size_t events, double within);

// A holding contact: the acting torque, the limits at which it breaks away, and what is missing to them, with all that
// hold together with it [N·m]; above `unbounded`: no limit.
struct Holding {
  double acts = 0, backwards = 0, forwards = 0, missing_backwards = 0, missing_forwards = 0;
  double unbounded = 0;
};
std::string words_of(const Contact& contact, const std::string& holders, const Holding& holding);

}  // namespace kurbel
