// mechanism_friction.cpp — joint friction in the pool of mechanisms: M(φ, ω, ε, F) on the crank, found together with ε.
#include <algorithm>
#include <cmath>

#include "engine/equations/jam.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

MechanismPool::Acting MechanismPool::acting(const Placed& p, const Instant& now) const {
  Acting forces{load_force(p, now)};
  for (std::size_t k = 0; k < p.within.size(); ++k)
    if (p.within[k] >= 0) forces.applied[k] = load_force(placed_[static_cast<std::size_t>(p.within[k])], now);
  return forces;
}

JointFriction::State MechanismPool::crank_state(const Placed& p, const Instant& now, double alpha,
                                                const Acting& forces) const {
  return {.phi = angle_of(p.at, now),
          .omega = p.at.gain * now.speed[p.at.shaft],
          .alpha = p.at.gain * alpha,
          .load = forces.load,
          .applied = forces.applied,
          .direction = p.at.direction(now),
          .weightless = p.mechanism.weightless,
          .travel = now.mode[p.at.mode],
          .modes = now.mode + turning_mode(p, 0)};
}

struct MechanismPool::FrictionMemory final : ElementPool::Memory {
  struct Of {  // a mechanism
    JointFriction::Place place;
    std::optional<Acting> acting;
  };
  std::vector<Of> of;
  void begin() override {
    for (Of& memory : of) memory.acting.reset();
  }
};

std::unique_ptr<ElementPool::Memory> MechanismPool::make_memory() const {
  auto memory = std::make_unique<FrictionMemory>();
  memory->of.resize(placed_.size());
  return memory;
}

JointFriction::Torque MechanismPool::friction_torque(const Placed& p, const JointFriction::State& state,
                                                     double response, JointFriction::Place& place) {
  // A trial step so long that its speeds or accelerations are none: like one that jams, it is tried again, shorter.
  if (!std::isfinite(state.omega * state.omega) || !std::isfinite(state.alpha) || !std::isfinite(state.load))
    throw Jam("no finite motion to find the joints' friction by", p.at.shaft);
  try {
    return p.mechanism.friction->torque(state, response, place);
  } catch (const Jam& jam) {
    throw Jam("\"" + p.mechanism.name + "\": " + jam.what(), p.at.shaft);
  }
}

void MechanismPool::add_friction(const Placed& p, const JointFriction::State& state,
                                 const JointFriction::Torque& friction, Reactions& sums) const {
  sums.torque[p.at.shaft] += p.at.gain * friction.torque;
  sums.slope[p.at.shaft] -= p.at.gain * p.at.gain * friction.slope;
  sums.element_torque[p.at.id] += friction.torque;
  if (sums.work_rate)
    sums.work_rate[p.at.account + 1 + static_cast<int>(p.mechanism.loads.size())] += friction.torque * state.omega;
}

void MechanismPool::add_reactions(const Instant& now, const double* alpha, Reactions& sums, Memory* memory) const {
  auto& known = static_cast<FrictionMemory&>(*memory);
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    if (!p.mechanism.friction || now.direction[p.at.shaft] == 0) continue;  // at standstill: friction_hold
    FrictionMemory::Of& of = known.of[k];
    if (!of.acting) of.acting = acting(p, now);
    const JointFriction::State state = crank_state(p, now, alpha[p.at.shaft], *of.acting);
    add_friction(p, state, friction_torque(p, state, 0, of.place), sums);
  }
}

void MechanismPool::add_answered(const Instant& now, double alpha, double response, Reactions& sums,
                                 Memory* memory) const {
  auto& known = static_cast<FrictionMemory&>(*memory);
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    if (!p.mechanism.friction) continue;
    const Acting forces = acting(p, now);
    const JointFriction::State state = crank_state(p, now, alpha, forces);
    add_friction(p, state, friction_torque(p, state, p.at.gain * p.at.gain * response, known.of[k].place), sums);
  }
}

// At the acceleration that was found, which answers in turn: ReactionBalance::slope.
void MechanismPool::add_friction_jacobian(const Placed& p, const Instant& now, const double* alpha,
                                          double* slots) const {
  if (!p.mechanism.friction || now.direction[p.at.shaft] == 0) return;
  const Acting forces = acting(p, now);
  const auto by = p.mechanism.friction->slopes(crank_state(p, now, alpha[p.at.shaft], forces));
  Dual<2> load = by.by_load * load_slopes(p, now);
  for (std::size_t k = 0; k < p.within.size(); ++k)
    if (p.within[k] >= 0)
      load = load + by.by_applied[k] * load_slopes(placed_[static_cast<std::size_t>(p.within[k])], now);
  slots[p.slot_angle] += p.at.gain * (by.by_angle + load.d[0]);
  slots[p.slot_rate] += p.at.gain * p.at.gain * (by.by_speed + load.d[1]);
}

// Static friction holds the crank between what it takes to move it either way, seen from the torque without friction. What
// loads can hold against the output presses on the joints as well: each end of it widens what friction holds.
Hold MechanismPool::friction_hold(const Placed& p, const Instant& now) const {
  const double phi = angle_of(p.at, now);
  Acting forces = acting(p, now);
  const double force = forces.load;
  const auto here = p.mechanism.reduced->at(phi);
  const double ratio = here.output_position().slope, free = here.gravity_torque().value + force * ratio;
  double low = HUGE_VAL, high = -HUGE_VAL;
  // `further` on one of the forces that act; the load's own hold counts here, by its ratio.
  const auto widen = [&](double& on, double along, const Hold& held) {
    const double free_of_it = on;
    for (const double further : {0.0, held.low, held.high}) {
      on = free_of_it + further;
      const auto needed = [&](int direction) {
        return p.mechanism.friction->resting(phi, forces.load, direction, p.mechanism.weightless, forces.applied) -
               further * along;
      };
      low = std::min(low, needed(-1)), high = std::max(high, needed(1));
    }
    on = free_of_it;
  };
  widen(forces.load, ratio, load_hold(p, now));
  for (std::size_t k = 0; k < p.within.size(); ++k) {
    if (p.within[k] < 0) continue;
    const Hold held = load_hold(placed_[static_cast<std::size_t>(p.within[k])], now);
    if (held.low != 0 || held.high != 0) widen(forces.applied[k], 0, held);
  }
  const double most = 1e6 * (1 + std::abs(free) + std::abs(force) * p.output_scale);  // locks itself
  return {-std::min(high, most), std::min(-low, most)};
}

// Of the joints' velocities, where one is zero that of the motion to come; the sides of the slides as they come.
void MechanismPool::take_first_signs(const Placed& p, const Instant& now, int* mode) const {
  for (int k = 0; k < p.mechanism.friction->sign_count(); ++k) {
    auto [ratio, slope] = p.mechanism.friction->turning(k, angle_of(p.at, now));
    if (std::abs(ratio) < 1e-12) ratio = slope * (p.at.direction(now) >= 0 ? 1 : -1);
    mode[turning_mode(p, k)] = ratio >= 0 ? 1 : -1;
  }
  for (int k = 0; k < p.mechanism.friction->side_count(); ++k)
    if (mode[side_mode(p, k)] != without_events) mode[side_mode(p, k)] = 0;
}

// At standstill nothing slides.
void MechanismPool::find_sides(const Instant& now, const double* alpha, double* side, Memory* memory) const {
  auto& known = static_cast<FrictionMemory&>(*memory);
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    if (!p.mechanism.friction) continue;
    const int count = p.mechanism.friction->side_count();
    std::fill_n(side, count, 1.0);
    if (now.direction[p.at.shaft] != 0)
      p.mechanism.friction->sides(crank_state(p, now, alpha[p.at.shaft], acting(p, now)), side, known.of[k].place);
    side += count;
  }
}

}  // namespace kurbel
