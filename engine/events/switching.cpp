// switching.cpp — edges over time and steps of the operating sequence, as they change what is on.
#include "engine/events/switching.h"

#include <algorithm>
#include <limits>

#include "engine/events/event_words.h"

namespace kurbel {

void Switching::begin(double t, std::span<double> y) {
  const std::vector<Network::ShaftElement>& elements = flow_.model().network.elements;
  for (std::size_t e = 0; e < elements.size(); ++e) flow_.changing_modes().on_since[e] = elements[e].window.first_on();
  if (sequence_.begin(flow_.changing_modes(), t, y)) take_steps(t, y, nullptr);
  set_timed_modes(t);
}

void Switching::set_timed_modes(double t) {
  const Model& m = flow_.model();
  Modes& modes = flow_.changing_modes();
  for (const auto& pool : m.pools) pool->set_timed_modes(t, modes.piece.data(), modes.active.data());
  for (std::size_t c = 0; c < modes.command.size(); ++c) {
    const auto switch_off = [&](const std::vector<int>& elements) {
      for (const int e : elements) modes.active[static_cast<std::size_t>(e)] = 0;
    };
    if (modes.command[c].at(t, m.scene.sequence) <= 0.5) switch_off(m.commands[c].switched);
    if (modes.command[c].value == 0 && modes.command[c].holds_still()) switch_off(m.commands[c].opened);
  }
  for (std::size_t p = 0; p < modes.prescribed_piece.size(); ++p)
    modes.prescribed_piece[p] = m.network.prescribed[p].piece(t);
}

void Switching::take_steps(double t, std::span<double> y, EventLog* log) {
  const std::vector<char> before = flow_.modes().active;
  sequence_.take(flow_.changing_modes(), t, y, log);
  set_timed_modes(t);
  report_switched(t, y, before);
}

void Switching::report_switched(double t, std::span<double> y, const std::vector<char>& before) {
  Modes& modes = flow_.changing_modes();
  if (modes.active == before) return;
  for (std::size_t e = 0; e < before.size(); ++e)
    if (modes.active[e] && !before[e]) modes.on_since[e] = t;
  for (const auto& pool : flow_.model().pools) {
    pool->switched(flow_.instant(t, y), before.data(), y.data() + flow_.internal_begin());
    pool->start_anew(flow_.instant(t, y), before.data(), modes.piece.data());
  }
}

void Switching::pass_edge(double t, std::span<double> y, EventLog& log) {
  Modes& modes = flow_.changing_modes();
  const std::vector<char> before = modes.active;
  sequence_.end_ramps(modes, t);
  set_timed_modes(t);
  for (std::size_t e = 0; e < modes.active.size(); ++e)
    if (modes.active[e] != before[e])
      log.push_back(window_event(t, flow_.model().network.elements[e].component, modes.active[e] != 0));
  report_switched(t, y, before);
  if (modes.armed_time <= t) take_steps(t, y, &log);
}

double Switching::next_edge(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& pool : flow_.model().pools) next = std::min(next, pool->next_edge(t));
  for (const PrescribedSpeed& given : flow_.model().network.prescribed)
    if (given.command < 0) next = std::min(next, given.next_edge(t));
  return std::min(next, sequence_.next_edge(flow_.modes()));
}

}  // namespace kurbel
