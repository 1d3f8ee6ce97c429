// event_match.cpp — partners by kind, then by order or nearness.
#include "studies/run/event_match.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "studies/run/measured_errors.h"

namespace kurbel {
namespace {

using Likeness = std::tuple<std::string, std::string, std::string>;
using Places = std::vector<std::size_t>;  // of the events of one kind, in time

std::map<Likeness, Places> by_kind(const std::vector<Event>& events) {
  std::map<Likeness, Places> kinds;
  for (std::size_t k = 0; k < events.size(); ++k)
    kinds[{events[k].component, events[k].what, events[k].from}].push_back(k);
  return kinds;
}

std::size_t nearest(const std::vector<Event>& events, const Places& places, double t) {
  const auto after = std::partition_point(places.begin(), places.end(), [&](std::size_t k) { return events[k].t < t; });
  if (after == places.end()) return places.back();
  if (after == places.begin() || events[*after].t - t < t - events[*std::prev(after)].t) return *after;
  return *std::prev(after);
}

}  // namespace

EventMatch match_events(const std::vector<Event>& coarse, const std::vector<Event>& fine) {
  EventMatch match;
  match.error.resize(fine.size());
  const std::map<Likeness, Places> in_coarse = by_kind(coarse), in_fine = by_kind(fine);
  std::size_t matched = 0;
  const auto pair = [&](std::size_t c, std::size_t f) {
    match.error[f] = std::abs(fine[f].t - coarse[c].t);
    ++matched;
  };
  for (const auto& [kind, places] : in_fine) {
    const auto other = in_coarse.find(kind);
    if (other == in_coarse.end()) continue;
    if (other->second.size() == places.size()) {
      for (std::size_t k = 0; k < places.size(); ++k) pair(other->second[k], places[k]);
      continue;
    }
    for (const std::size_t f : places) {
      const std::size_t c = nearest(coarse, other->second, fine[f].t);
      if (nearest(fine, places, coarse[c].t) == f) pair(c, f);
    }
  }
  match.only_in_fine = fine.size() - matched;
  match.only_in_coarse = coarse.size() - matched;
  return match;
}

void add_event_errors(const std::vector<Event>& events, const std::vector<Event>& witness, double weight, double hidden,
                      std::vector<std::optional<double>>& errors) {
  const bool first = errors.empty();
  if (first) errors.resize(events.size());
  const EventMatch match = match_events(witness, events);
  for (std::size_t k = 0; k < events.size(); ++k) {
    std::optional<double>& error = errors[k];
    if (!match.error[k] || (!first && !error)) {
      error.reset();
    } else {
      const double apart = weight * *match.error[k], least = rounding_of_a_run * events[k].t;
      error = std::max({error.value_or(0), apart > least ? apart + hidden : apart, least});
    }
  }
}

}  // namespace kurbel
