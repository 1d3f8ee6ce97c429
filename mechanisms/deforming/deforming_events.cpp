// deforming_events.cpp — events of a deforming slider-crank: its output reverses, a load's piece ends, a joint comes into
// contact or separates.
#include <algorithm>
#include <cmath>

#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/loads/load_acts.h"

namespace kurbel {
namespace {

constexpr double creep_ends = 5;  // in units of the speed within which a slider creeps

}  // namespace

void DeformingMechanismPool::guards(const Instant& now, double* g) const {
  using Kind = GuardOwner::Kind;
  Motion m;
  const Placed* known = nullptr;
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    const GuardOwner& owner = owners_[i];
    const Placed& p = placed_[owner.placed];
    if (known != &p) m = motion(p, now), known = &p;
    if (owner.kind == Kind::travel && now.mode[p.at.mode] == creeps) {
      g[i] = creep_ends - std::abs(m.x_rate) / creep_speed(p);
      continue;
    }
    if (owner.kind == Kind::travel) {
      g[i] = now.mode[p.at.mode] * m.x_rate / (p.mechanism.output_scale() * std::max(1.0, std::abs(m.w[0])));
      continue;
    }
    if (owner.kind == Kind::load) {
      const SliderState<double> s = slider(p, now, m, owner.index);
      if (s.travel == creeps)
        g[i] = g[i + 1] = 1;
      else
        p.mechanism.loads[owner.index].guard(s, g + i);
    } else {
      const auto [depth, rate] = p.dynamics->approach(owner.index, m);
      const auto& joint = p.dynamics->clearances()[p.dynamics->contacts()[owner.index].clearance];
      joint.contact.guard(now.mode[p.contact_mode() + static_cast<int>(owner.index)], depth, rate, g + i);
    }
    ++i;  // both were written
  }
}

void DeformingMechanismPool::fire(const Instant& now, int guard, int* mode) const {
  using Kind = GuardOwner::Kind;
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  const Motion m = motion(p, now);
  if (owner.kind == Kind::contact) {
    const auto& joint = p.dynamics->clearances()[p.dynamics->contacts()[owner.index].clearance];
    int& own = mode[p.contact_mode() + static_cast<int>(owner.index)];
    own = joint.contact.next_mode(own, owner.which);
    return;
  }
  if (owner.kind == Kind::load) {
    mode[p.at.mode + 1 + static_cast<int>(owner.index)] =
        p.mechanism.loads[owner.index].next_piece(slider(p, now, m, owner.index), owner.which);
    return;
  }
  // The slider reverses, and each load changes to the branch of the other stroke.
  mode[p.at.mode] = mode[p.at.mode] == creeps ? (m.x_rate >= 0 ? 1 : -1) : -mode[p.at.mode];
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
    if (!p.mechanism.loads[k].depends_on_travel()) continue;
    SliderState<double> s = slider(p, now, m, k);
    s.travel = mode[p.at.mode];
    p.mechanism.loads[k].take_first_piece(s, mode[p.at.mode + 1 + static_cast<int>(k)]);
  }
}

GuardLabel DeformingMechanismPool::label(int guard, const Instant& now) const {
  using Kind = GuardOwner::Kind;
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.kind == Kind::travel) return {p.mechanism.name, {}};
  if (owner.kind == Kind::load) {
    SliderState<double> s{};
    s.mode = now.mode[p.at.mode + 1 + static_cast<int>(owner.index)];
    const SliderLoad& load = p.mechanism.loads[owner.index];
    const bool on = !now.command || (now.active[p.at.id] && acts(p.at, now, owner.index));
    return {load.name, on ? load.piece_name(s) : std::string(), load.piece_kind()};  // off, it changes unlisted
  }
  const SliderCrankDynamics::ContactPlace& place = p.dynamics->contacts()[owner.index];
  static const char* const corners[] = {"extended upper corner", "folded upper corner", "extended lower corner",
                                        "folded lower corner"};
  std::string what = p.dynamics->clearances()[place.clearance].name();
  if (place.corner >= 0) what += std::string(", ") + corners[place.corner];
  switch (now.mode[p.contact_mode() + static_cast<int>(owner.index)]) {
    case JointContact::flight:
      return {p.mechanism.name, what + ": in flight", EventKind::flight};
    case JointContact::touching:
      return {p.mechanism.name, what + ": touches", EventKind::touch};
    case JointContact::parting:
      return {p.mechanism.name, what + ": parts"};
    default:
      return {p.mechanism.name, what + ": contact without events"};
  }
}

void DeformingMechanismPool::first_modes(const Instant& now, int* mode) const {
  for (const Placed& p : placed_) {
    const Motion m = motion(p, now);
    double rate = m.x_rate;
    // At rest by the direction of the crank; at a dead centre by the following motion.
    if (std::abs(rate) < 1e-12 * p.mechanism.output_scale() * std::max(1.0, std::abs(m.w[0])))
      rate = m.w[0] != 0 ? m.x_bias : m.of_x[0];
    if (mode[p.at.mode] != creeps) mode[p.at.mode] = rate >= 0 ? 1 : -1;
    for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
      SliderState<double> s = slider(p, now, m, k);
      if (p.mechanism.loads[k].depends_on_travel()) {
        if (mode[p.at.mode] == creeps) continue;  // branches follow the state
        s.travel = mode[p.at.mode];
      }
      p.mechanism.loads[k].take_first_piece(s, mode[p.at.mode + 1 + static_cast<int>(k)]);
    }
    for (std::size_t c = 0; c < p.dynamics->contacts().size(); ++c) {
      int& own = mode[p.contact_mode() + static_cast<int>(c)];
      if (own == JointContact::without_events) continue;
      const auto [depth, approach] = p.dynamics->approach(c, m);
      own = p.dynamics->clearances()[p.dynamics->contacts()[c].clearance].contact.first_mode(depth, approach);
    }
  }
}

bool DeformingMechanismPool::regularise(int guard, int* mode) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.kind == GuardOwner::Kind::contact)
    mode[p.contact_mode() + static_cast<int>(owner.index)] = JointContact::without_events;
  else if (owner.kind == GuardOwner::Kind::travel)
    mode[p.at.mode] = creeps;
  return owner.kind != GuardOwner::Kind::load;
}

}  // namespace kurbel
