// equations_events.cpp — guards, and the modes that change when they fire: load edges, contacts, windows of time.
#include "engine/equations/equations.h"

#include <algorithm>
#include <limits>

#include "engine/numerics/fp_traps.h"

namespace kurbel {

// Pools, contacts, operating sequence, in this order.
void Equations::guards(double t, std::span<const double> y, std::span<double> g) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = *model_;
  const Instant now = instant(t, y);
  for (std::size_t p = 0; p < m.pools.size(); ++p) m.pools[p]->guards(now, g.data() + guard_begin_[p]);
  if (!contacts_.empty()) contact_guards(t, y, g.data() + contact_guards_begin());
  if (sequence_.any()) g[guard_count_ - 1] = sequence_.guard(modes_, y, now.speed);
}

void Equations::fire(double t, std::span<double> y, const std::vector<std::size_t>& fired, std::vector<Event>& log) {
  const Model& m = *model_;
  look_at_losses(t, y);
  const std::size_t contacts_begin = contact_guards_begin();
  std::vector<std::size_t> stopped;
  std::vector<std::pair<std::size_t, int>> released;
  for (const std::size_t guard : fired) {
    if (guard >= contacts_begin) {
      const std::size_t local = guard - contacts_begin, contact = local / 2;
      if (local >= 2 * contacts_.size() + lossy_.size()) {
        take_steps(t, y, &log);
      } else if (local >= 2 * contacts_.size()) {
        int& sign = modes_.loss_sign[static_cast<std::size_t>(lossy_[local - 2 * contacts_.size()])];
        sign = -sign;
      } else if (modes_.regularised[contact]) {
        modes_.regularised[contact] = false;
        released.emplace_back(contact, slip_speed(contacts_[contact], instant(t, y)) > 0 ? 1 : -1);
      } else if (is_prescribed(contacts_[contact])) {
        const double v = slip_speed(contacts_[contact], instant(t, y));
        sense(contact) = sense(contact) != 0 ? -sense(contact) : v > 0 ? 1 : -1;
      } else if (sense(contact) != 0) {
        stopped.push_back(contact);
      } else {
        // Breaks away on the side whose guard fired: just there the push still equals what can be held.
        released.emplace_back(contact, local % 2 == 0 ? 1 : -1);
      }
      continue;
    }
    std::size_t p = m.pools.size() - 1;
    while (guard_begin_[p] > guard) --p;
    const int local = static_cast<int>(guard - guard_begin_[p]);
    const std::string before = m.pools[p]->label(local, instant(t, y)).what;
    m.pools[p]->fire(instant(t, y), local, modes_.piece.data());
    const GuardLabel label = m.pools[p]->label(local, instant(t, y));
    // Edges over the angle are told as such; elsewhere a label names the mode.
    const bool edge = m.pools[p]->guards_are_of_angle();
    if (!label.what.empty() && (edge || label.what != before))
      log.push_back({t, label.component, label.what, edge ? "" : before});
  }
  settle_contacts(t, y, stopped, released, &log);
  for (const auto& pool : m.pools) pool->follow_directions(instant(t, y), modes_.piece.data());
}

double Equations::next_edge(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& pool : model_->pools) next = std::min(next, pool->next_edge(t));
  for (const PrescribedSpeed& given : model_->network.prescribed) next = std::min(next, given.next_edge(t));
  return std::min(next, sequence_.next_edge(modes_));
}

// What gears lose by their present torques is asked for by what comes next; nothing may hang on who asked last.
void Equations::look_at_losses(double t, std::span<const double> y) {
  if (lossy_.empty()) return;
  try {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
  } catch (const Jam&) {  // which is why these modes change
  }
}

void Equations::pass_edge(double t, std::span<double> y, std::vector<Event>& log) {
  look_at_losses(t, y);
  const std::vector<char> before = modes_.active;
  sequence_.end_ramps(modes_, t);
  set_timed_modes(t);
  for (std::size_t e = 0; e < modes_.active.size(); ++e)
    if (modes_.active[e] != before[e])
      log.push_back(
          {t, model_->network.elements[e].component, modes_.active[e] ? "on" : "off", before[e] ? "on" : "off"});
  tell_switched(t, y, before);
  if (modes_.armed_time <= t) take_steps(t, y, &log);
  settle_contacts(t, y, {}, {}, &log);
}

// What was told changes what is on, and a circuit that opens or closes changes its currents at once.
void Equations::take_steps(double t, std::span<double> y, std::vector<Event>* log) {
  const std::vector<char> before = modes_.active;
  sequence_.take(modes_, t, y, log);
  set_timed_modes(t);
  tell_switched(t, y, before);
}

void Equations::tell_switched(double t, std::span<double> y, const std::vector<char>& before) {
  if (modes_.active == before) return;
  for (const auto& pool : model_->pools) pool->switched(instant(t, y), before.data(), y.data() + own_begin());
}

}  // namespace kurbel
