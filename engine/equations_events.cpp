// equations_events.cpp — guards, and the modes that change when they fire: load edges, standstill, breakaway, windows
// of time.
#include "engine/equations.h"

#include <algorithm>
#include <limits>

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

void Equations::guards(double t, std::span<const double> y, std::span<double> g) {
  const Model& m = *model_;
  const Instant now = instant(t, y);
  for (std::size_t p = 0; p < m.pools.size(); ++p) m.pools[p]->guards(now, g.data() + guard_begin_[p]);
  if (directional_.empty()) return;
  const bool still =
      std::any_of(directional_.begin(), directional_.end(), [&](int s) { return direction_[at(s)] == 0; });
  if (still) {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
    for (const auto& pool : m.pools) pool->add_holds(snapshot_.now, shaft_hold_.data(), element_hold_.data());
  }
  double* direction_guard = g.data() + guard_count_ - 2 * directional_.size();
  for (const int s : directional_) {
    const Shaft& shaft = m.shafts[at(s)];
    if (direction_[at(s)] != 0) {
      *direction_guard++ = direction_[at(s)] * now.speed[s] / shaft.speed_scale;
      *direction_guard++ = 1;
    } else if (at(s) >= m.free_shafts) {
      *direction_guard++ = 1;
      *direction_guard++ = 1;
    } else {
      *direction_guard++ = (torque_[at(s)] + shaft_hold_[at(s)].high) / shaft.torque_scale;
      *direction_guard++ = -(torque_[at(s)] + shaft_hold_[at(s)].low) / shaft.torque_scale;
    }
  }
}

void Equations::fire(double t, std::span<double> y, const std::vector<std::size_t>& fired, std::vector<Event>& log) {
  const Model& m = *model_;
  std::vector<std::size_t> stopped;
  const std::size_t directions_begin = guard_count_ - 2 * directional_.size();
  for (const std::size_t guard : fired) {
    if (guard >= directions_begin) {
      const auto s = at(directional_[(guard - directions_begin) / 2]);
      if (s >= m.free_shafts) {
        direction_[s] = -direction_[s];
      } else if (direction_[s] != 0) {
        y[speed_index(static_cast<int>(s))] = 0;
        stopped.push_back(s);
      } else {
        // Breaks away on the side whose guard fired: just there the push still equals what can be held.
        direction_[s] = (guard - directions_begin) % 2 == 0 ? -1 : 1;
        log.push_back(
            {t, m.node_label(m.shafts[s].reference), direction_[s] > 0 ? "moves forwards" : "moves backwards"});
      }
      continue;
    }
    std::size_t p = m.pools.size() - 1;
    while (guard_begin_[p] > guard) --p;
    const int local = static_cast<int>(guard - guard_begin_[p]);
    m.pools[p]->fire(instant(t, y), local, mode_.data());
    const GuardLabel label = m.pools[p]->label(local, mode_.data());
    if (!label.what.empty()) log.push_back({t, label.component, label.what});
  }
  settle_directions(t, y, stopped, &log);
  if (stopped.empty() && !directional_.empty() && fired.back() >= directions_begin)
    for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
}

// A shaft at standstill stays there while its opposing elements can hold it; else it moves the way it is pushed.
void Equations::settle_directions(double t, std::span<double> y, const std::vector<std::size_t>& shafts,
                                  std::vector<Event>* log) {
  const Model& m = *model_;
  for (const std::size_t s : shafts) {
    if (s >= m.free_shafts) continue;
    direction_[s] = 0;
    for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
    for (const auto& pool : m.pools) pool->add_holds(snapshot_.now, shaft_hold_.data(), element_hold_.data());
    // A push within round-off decides nothing: the guards will tell which way it grows.
    const double push = torque_[s], nothing = 1e-12 * m.shafts[s].torque_scale;
    if (push + shaft_hold_[s].low > nothing) {
      direction_[s] = 1;
    } else if (push + shaft_hold_[s].high < -nothing) {
      direction_[s] = -1;
    }
    for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
    if (!log) continue;
    const std::string name = m.node_label(m.shafts[s].reference);
    if (direction_[s] == 0) {
      log->push_back({t, name, "comes to rest and is held"});
    } else {
      log->push_back({t, name, direction_[s] > 0 ? "moves forwards" : "moves backwards"});
    }
  }
}

double Equations::next_edge(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& pool : model_->pools) next = std::min(next, pool->next_edge(t));
  for (const PrescribedSpeed& given : model_->network.prescribed) next = std::min(next, given.next_edge(t));
  return next;
}

void Equations::pass_edge(double t, std::span<double> y, std::vector<Event>& log) {
  const std::vector<char> before = active_;
  set_timed_modes(t);
  for (std::size_t e = 0; e < active_.size(); ++e)
    if (active_[e] != before[e]) log.push_back({t, model_->network.elements[e].component, active_[e] ? "on" : "off"});
  std::vector<std::size_t> still;
  for (const int s : directional_)
    if (direction_[at(s)] == 0) still.push_back(at(s));
  if (!still.empty()) settle_directions(t, y, still, nullptr);
}

}  // namespace kurbel
