// mechanism_pool.cpp — gathers the crank's motion, applies the reduced functions, scatters torque and inertia.
#include <stdexcept>

#include "mechanisms/loads/load_acts.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {
namespace {

// The end of the travel that the output has just left.
const char* name_of_reversal(const Mechanism& m, bool now_growing) {
  if (m.travel.reversals.size() > 2 || !m.reduced->cycle().change_points().empty()) return "output reverses";
  if (m.rocks()) return now_growing ? "least angle" : "greatest angle";
  return now_growing ? "folded dead centre" : "extended dead centre";
}

}  // namespace

void MechanismPool::place(Mechanism mechanism, ShaftPorts at) {
  Placed placed{std::move(mechanism), std::move(at)};
  placed.has_weight = placed.mechanism.has_weight();
  placed.load_account = placed.at.account + (placed.mechanism.is_force() ? 0 : 1);
  placed.output_scale = placed.mechanism.output_scale();
  // The friction of a guide reverses with the slider.
  const JointFriction* friction = placed.mechanism.friction.get();
  placed.watches_travel = friction || placed.mechanism.watches_travel();
  reacts_ = reacts_ || friction;
  if (friction) reacting_shafts_.push_back(placed.at.shaft);
  const std::size_t index = placed_.size();
  if (placed.mechanism.arc() && !placed.mechanism.is_force())
    for (const int end : {-1, 1}) owners_.push_back({index, GuardOwner::limit, end});
  if (placed.watches_travel) owners_.push_back({index, GuardOwner::travel, 0});
  for (std::size_t k = 0; k < placed.mechanism.loads.size(); ++k)
    if (placed.mechanism.loads[k].has_pieces())
      for (const int which : {0, 1}) owners_.push_back({index, static_cast<int>(k), which});
  for (int k = 0; friction && k < friction->sign_count(); ++k) owners_.push_back({index, GuardOwner::turning, k});
  for (int k = 0; friction && k < friction->side_count(); ++k) {
    side_modes_.push_back(side_mode(placed, k));
    side_guards_.push_back(static_cast<int>(owners_.size()));
    owners_.push_back({index, GuardOwner::side, k});
  }
  guards_ = static_cast<int>(owners_.size());
  if (friction) placed.within.assign(friction->applied().size(), -1);
  placed_.push_back(std::move(placed));
  const Mechanism& last = placed_.back().mechanism;
  for (Placed& p : placed_)
    for (std::size_t k = 0; last.is_force() && k < p.within.size(); ++k)
      if (p.mechanism.friction->applied()[k] == last.name) p.within[k] = static_cast<int>(index);
}

SliderState<double> MechanismPool::slider(const Placed& p, const Instant& now, std::size_t load) const {
  const double phi = angle_of(p.at, now), omega = p.at.gain * now.speed[p.at.shaft];
  const auto here = p.mechanism.reduced->at(phi);
  const auto [x, ratio] = here.output_position();
  const int travel = p.watches_travel ? now.mode[p.at.mode] * p.at.direction(now) : direction_of(ratio * omega);
  return {phi, x, ratio * omega, travel, now.mode[p.at.mode + 1 + static_cast<int>(load)]};
}

MechanismPool::Reduced MechanismPool::reduced_at(const Placed& p, double phi) {
  const Mechanism& m = p.mechanism;
  if (m.in_the_loop) {
    const double there = m.reduced->cycle().within(phi);
    const ReducedSample s = m.extraction == Extraction::first ? m.bodies->sample(there) : closed_sample(m.data, there);
    const bool mean = m.mean_inertia;
    return {mean ? m.travel.mean_inertia : s.inertia, mean ? 0 : s.inertia_slope,
            m.reduced->cycle().unwound(phi, s.output_position), s.output_velocity_ratio, s.gravity_torque};
  }
  const auto here = m.reduced->at(phi);
  Reduced at{m.travel.mean_inertia, 0, 0, 0, 0};
  if (!m.mean_inertia) {
    const auto [inertia, slope] = here.inertia();
    at.inertia = inertia, at.inertia_slope = slope;
  }
  if (p.has_weight) at.weight = here.gravity_torque().value;
  if (!m.loads.empty()) {
    const auto [x, ratio] = here.output_position();
    at.position = x, at.ratio = ratio;
  }
  return at;
}

double MechanismPool::load_force(const Placed& p, const Instant& now) const {
  double sum = 0;
  if (!is_loaded(p, now)) return sum;
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k)
    if (acts(p.at, now, k)) sum += p.mechanism.loads[k].value(slider(p, now, k));
  return sum;
}

// With x, x′ as functions of φ.
Dual<2> MechanismPool::load_slopes(const Placed& p, const Instant& now) const {
  using D = Dual<2>;
  const double omega = p.at.gain * now.speed[p.at.shaft], phi = angle_of(p.at, now);
  const auto here = p.mechanism.reduced->at(phi);
  const auto [x, ratio] = here.output_position();
  const D angle = D::input(phi, 0), v = angle.chain(ratio, here.output_velocity().slope) * D::input(omega, 1);
  D force(0.0);
  for (std::size_t k = 0; is_loaded(p, now) && k < p.mechanism.loads.size(); ++k) {
    if (!acts(p.at, now, k)) continue;
    const SliderState<double> s = slider(p, now, k);
    force = force + p.mechanism.loads[k].value(SliderState<D>{angle, angle.chain(x, ratio), v, s.travel, s.mode});
  }
  return force;
}

void MechanismPool::add(const Instant& now, Sums& sums) const {
  for (const Placed& p : placed_) {
    const double omega = p.at.gain * now.speed[p.at.shaft];
    const double phi = angle_of(p.at, now);
    const Reduced here = reduced_at(p, phi);
    const double inertia = here.inertia;
    double torque = -0.5 * here.inertia_slope * omega * omega;
    if (p.has_weight) {
      torque += here.weight;
      if (sums.work_rate) sums.work_rate[p.at.account] += here.weight * omega;
    }
    if (is_loaded(p, now)) {
      const double x = here.position, ratio = here.ratio;
      SliderState<double> s{phi, x, ratio * omega, 0, 0};
      s.travel = p.watches_travel ? now.mode[p.at.mode] * p.at.direction(now) : direction_of(s.v);
      for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
        if (!acts(p.at, now, k)) continue;
        s.mode = now.mode[p.at.mode + 1 + static_cast<int>(k)];
        const double force = p.mechanism.loads[k].value(s);
        torque += force * ratio;
        if (sums.work_rate) sums.work_rate[p.load_account + static_cast<int>(k)] += force * s.v;
      }
    }
    sums.element_torque[p.at.id] = torque;
    sums.element_inertia[p.at.id] = inertia;
    sums.torque[p.at.shaft] += p.at.gain * torque;
    sums.inertia[p.at.shaft] += p.at.gain * p.at.gain * inertia;
  }
}

void MechanismPool::register_jacobian(JacobianPattern& pattern) {
  for (Placed& p : placed_) {
    const int speed = pattern.speed(p.at.shaft);
    p.slot_angle = pattern.entry(speed, pattern.angle(p.at.angle));
    p.slot_rate = pattern.entry(speed, speed);
  }
}

void MechanismPool::add_jacobian(const Instant& now, const double* alpha, double* slots) const {
  using D = Dual<2>;  // by crank angle and crank speed
  for (const Placed& p : placed_) {
    const double omega = p.at.gain * now.speed[p.at.shaft], phi = angle_of(p.at, now);
    const auto here = p.mechanism.reduced->at(phi);
    auto [slope, curvature] = here.inertia_derivative();
    if (p.mechanism.mean_inertia) slope = curvature = 0;
    const D angle = D::input(phi, 0), speed = D::input(omega, 1);
    D torque = -0.5 * angle.chain(slope, curvature) * speed * speed;
    if (p.has_weight) {
      const auto weight = here.gravity_torque();
      torque = torque + angle.chain(weight.value, weight.slope);
    }
    const auto ratio = here.output_velocity();
    torque = torque + load_slopes(p, now) * angle.chain(ratio.value, ratio.slope);
    slots[p.slot_angle] += p.at.gain * (torque.d[0] - slope * p.at.gain * alpha[p.at.shaft]);
    slots[p.slot_rate] += p.at.gain * torque.d[1] * p.at.gain;
    add_friction_jacobian(p, now, alpha, slots);
  }
}

void MechanismPool::guards(const Instant& now, double* g) const {
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    const GuardOwner& owner = owners_[i];
    const Placed& p = placed_[owner.placed];
    if (owner.load == GuardOwner::turning) {
      g[i] = now.mode[turning_mode(p, owner.which)] *
             p.mechanism.friction->turning(owner.which, angle_of(p.at, now)).value;
      continue;
    }
    if (owner.load == GuardOwner::side) {
      g[i] = 1;  // find_sides()
      continue;
    }
    if (owner.load == GuardOwner::limit) {
      const CrankArc& arc = *p.mechanism.arc();
      g[i] = arc.reach() - owner.which * (arc.near(angle_of(p.at, now)) - arc.middle);
      continue;
    }
    if (owner.load == GuardOwner::travel) {
      const double ratio = p.mechanism.reduced->at(angle_of(p.at, now)).output_position().slope;
      g[i] = now.mode[p.at.mode] * ratio / p.output_scale;
      continue;
    }
    const auto load = static_cast<std::size_t>(owner.load);
    p.mechanism.loads[load].guard(slider(p, now, load), g + i);
    ++i;  // both ends of the piece were written
  }
}

void MechanismPool::fire(const Instant& now, int guard, int* mode) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.load >= 0) {
    const auto load = static_cast<std::size_t>(owner.load);
    mode[p.at.mode + 1 + owner.load] = p.mechanism.loads[load].next_piece(slider(p, now, load), owner.which);
    return;
  }
  if (owner.load == GuardOwner::limit) throw std::runtime_error(limit_reached(p.mechanism, owner.which));
  if (owner.load == GuardOwner::turning) {
    mode[turning_mode(p, owner.which)] = -mode[turning_mode(p, owner.which)];
    return;
  }
  if (owner.load == GuardOwner::side) {
    int& side = mode[side_mode(p, owner.which)];
    if (side != without_events) side = -side;
    return;
  }
  // Dead centre: the slider reverses, and each load changes to the branch of the other stroke.
  mode[p.at.mode] = -mode[p.at.mode];
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
    if (!p.mechanism.loads[k].depends_on_travel()) continue;
    SliderState<double> s = slider(p, now, k);
    s.travel = mode[p.at.mode] * p.at.direction(now);
    p.mechanism.loads[k].take_first_piece(s, mode[p.at.mode + 1 + static_cast<int>(k)]);
  }
}

GuardLabel MechanismPool::label(int guard, const Instant& now) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.load == GuardOwner::turning || owner.load == GuardOwner::side) return {p.mechanism.name, {}};
  if (owner.load == GuardOwner::limit) return {p.mechanism.name, "end of the crank's arc"};
  if (owner.load == GuardOwner::travel)
    return {p.mechanism.name, name_of_reversal(p.mechanism, now.mode[p.at.mode] * p.at.direction(now) > 0)};
  const SliderLoad& load = p.mechanism.loads[static_cast<std::size_t>(owner.load)];
  SliderState<double> s{};
  s.mode = now.mode[p.at.mode + 1 + owner.load];
  const bool on = !now.command || (now.active[p.at.id] && acts(p.at, now, static_cast<std::size_t>(owner.load)));
  return {load.name, on ? load.piece_name(s) : std::string(), load.piece_kind()};  // off, it changes unlisted
}

void MechanismPool::set_timed_modes(double /*t*/, int* /*mode*/, char* active) const {
  for (const Placed& p : placed_) active[p.at.id] = 1;
}

void MechanismPool::first_modes(const Instant& now, int* mode) const {
  for (const Placed& p : placed_) {
    require_on_arc(p.mechanism, angle_of(p.at, now));
    mode[p.at.mode] = p.mechanism.growth(angle_of(p.at, now), p.at.direction(now));
    for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k)
      p.mechanism.loads[k].take_first_piece(slider(p, now, k), mode[p.at.mode + 1 + static_cast<int>(k)]);
    if (p.mechanism.friction) take_first_signs(p, now, mode);
  }
}

// Edges that alternate follow the state: the law is the same, so that nothing is reported.
bool MechanismPool::regularise(int guard, int* mode) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  if (owner.load == GuardOwner::side) mode[side_mode(placed_[owner.placed], owner.which)] = without_events;
  return false;
}

// A crank that reverses within its stroke changes its loads to the branch of the other direction: while they do not
// resist, their pieces are not guarded, and a separate branch has other pieces.
void MechanismPool::follow_directions(const Instant& now, int* mode) const {
  for (const Placed& p : placed_) {
    if (!p.watches_travel) continue;
    for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k)
      if (p.mechanism.loads[k].follows_travel())
        p.mechanism.loads[k].follow_travel(slider(p, now, k), mode[p.at.mode + 1 + static_cast<int>(k)]);
  }
}

// Static forces of the loads on the output, in addition to their forces there.
Hold MechanismPool::load_hold(const Placed& p, const Instant& now) const {
  Hold sum;
  if (!is_loaded(p, now)) return sum;
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
    if (!acts(p.at, now, k)) continue;
    const Hold force = p.mechanism.loads[k].hold(slider(p, now, k));
    sum.low += force.low;
    sum.high += force.high;
  }
  return sum;
}

void MechanismPool::add_holds(const Instant& now, Hold* shaft, Hold* element) const {
  for (const Placed& p : placed_) {
    Hold hold;
    if (p.mechanism.friction) {
      // The hold of a moving crank is not needed, and reactions with friction are expensive.
      if (now.direction[p.at.shaft] != 0 && now.speed[p.at.shaft] != 0) continue;
      hold = friction_hold(p, now);
    } else {
      const double ratio = p.mechanism.reduced->at(angle_of(p.at, now)).output_position().slope;
      const Hold force = load_hold(p, now);
      hold = ratio >= 0 ? Hold{force.low * ratio, force.high * ratio} : Hold{force.high * ratio, force.low * ratio};
    }
    element[p.at.id].low += hold.low;
    element[p.at.id].high += hold.high;
    p.at.add_hold(hold, shaft);
  }
}

double MechanismPool::kinetic_energy_of_bodies(const Instant& now) const {
  double sum = 0;
  for (const Placed& p : placed_) {
    const double omega = p.at.gain * now.speed[p.at.shaft];
    sum += p.mechanism.mean_inertia
               ? 0.5 * p.mechanism.travel.mean_inertia * omega * omega
               : p.mechanism.bodies->kinetic_energy(p.mechanism.reduced->cycle().within(angle_of(p.at, now)), omega);
  }
  return sum;
}

void MechanismPool::add_channels(std::vector<Channel>& channels) const {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const auto here = [this, i](const Snapshot& s) {
      return placed_[i].mechanism.reduced->at(angle_of(placed_[i].at, s.now));
    };
    const auto omega = [this, i](const Snapshot& s) { return placed_[i].at.gain * s.now.speed[placed_[i].at.shaft]; };
    const auto alpha = [this, i](const Snapshot& s) { return placed_[i].at.gain * s.alpha[placed_[i].at.shaft]; };
    const Mechanism& m = placed_[i].mechanism;
    const bool rocks = m.rocks();
    const auto put = [&](const auto& quantity, const char* sliding, const char* rocking, auto value) {
      channels.push_back({Name::make(quantity, m.name), rocks ? rocking : sliding, std::move(value)});
    };
    if (const auto* t = m.data.as<LinkageTravelData>(); !t || t->travel.of != LinkageTravel::Of::path)
      put(quantities::position, "m", "rad", [this, i, here](const Snapshot& s) {
        const Placed& p = placed_[i];
        const double turns = s.node_angle[p.at.node] - s.now.angle[p.at.angle];  // [rad]
        return here(s).output_position().value + p.mechanism.travel.winding * turns;
      });
    put(quantities::velocity, "m/s", "rad/s",
        [=](const Snapshot& s) { return here(s).output_position().slope * omega(s); });
    put(quantities::acceleration, "m/s2", "rad/s2", [=](const Snapshot& s) {
      const auto [ratio, second] = here(s).output_velocity();
      return second * omega(s) * omega(s) + ratio * alpha(s);
    });
    if (!m.loads.empty())
      put(rocks ? quantities::load_torque : quantities::force, "N", "N*m",
          [this, i](const Snapshot& s) { return load_force(placed_[i], s.now); });
  }
}

}  // namespace kurbel
