// event_words.h — what happens in a run in words: the one place where events are given English.
//
// Elements name their own modes (GuardLabel); the rest is said here. Programs read `kind` and `value`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/equations/contact.h"
#include "engine/events/event.h"

namespace kurbel {

// An element's law changes its piece. Edges over the angle name themselves; elsewhere the label names the mode.
Event law_event(double t, const GuardLabel& before, const GuardLabel& now, bool edge_over_angle);
// Senses: −1 backwards, 0 stuck, 1 forwards.
Event contact_event(double t, const Contact& contact, int before, int now);
// Several elements hold one shaft, each by its part of the capacity [1].
using Shares = std::vector<std::pair<std::string, double>>;
Event shares_event(double t, const Contact& contact, const Shares& shares);
Event jam_event(double t, const Contact& contact);
// A command goes from one value to another, at once or over a time [s].
Event command_event(double t, const std::string& component, double before, double to, double over);
// A round of the operating sequence took longer than the time after which the next one begins [s].
Event late_round_event(double t, double took, double every);
Event window_event(double t, const std::string& component, bool on);
// So many contacts changed at one instant; a set of modes that fits was found after so many changes, or none.
Event modes_event(double t, std::size_t contacts, bool fits, int changes);
// So many events within so short a time [s] that what owns them gets a law without events.
Event restless_event(double t, const std::string& owners, std::size_t events, double within);

// A contact that holds: what acts, and what may act before it lets go [N·m]; a capacity above `unbounded` is endless.
struct Holding {
  double acts = 0, backwards = 0, forwards = 0;
  double unbounded = 0;
};
std::string words_of(const Contact& contact, const std::string& holders, const Holding& holding);

}  // namespace kurbel
