// deforming_pool.cpp — gathers the crank's motion and internal states, solves for the effect on the shaft, scatters.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/loads/load_acts.h"

namespace kurbel {
namespace {

constexpr int chunk = 6;  // so many inputs are differentiated at once
constexpr std::size_t most_own = SliderCrankDynamics::most;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_own, most_own>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_own, 1>;

Eigen::Index ix(std::size_t i) { return static_cast<Eigen::Index>(i); }

constexpr double creep = 1e-2;  // speed within which a slider creeps, of the output's scale [rad/s]

}  // namespace

void DeformingMechanismPool::place(Mechanism mechanism, std::shared_ptr<const SliderCrankDynamics> dynamics,
                                   const ShaftPorts& at) {
  using Kind = GuardOwner::Kind;
  Placed placed{std::move(mechanism), std::move(dynamics), at};
  const std::size_t index = placed_.size();
  placed.watches_travel = placed.mechanism.watches_travel();
  if (placed.watches_travel) owners_.push_back({Kind::travel, index, 0, 0});
  for (std::size_t k = 0; k < placed.mechanism.loads.size(); ++k)
    if (placed.mechanism.loads[k].has_pieces())
      for (const int which : {0, 1}) owners_.push_back({Kind::load, index, k, which});
  for (std::size_t c = 0; c < placed.dynamics->contacts().size(); ++c)
    for (int which = 0; which < JointContact::guards; ++which) owners_.push_back({Kind::contact, index, c, which});
  placed_.push_back(std::move(placed));
}

DeformingMechanismPool::Vector DeformingMechanismPool::coordinates(const Placed& p, const Instant& now) const {
  Vector z{};
  z[SliderCrankDynamics::phi] = now.angle[p.at.angle] + p.at.phase;
  for (std::size_t k = 0; k < p.further(); ++k) z[p.dynamics->free()[1 + k]] = now.own[at_internal(p, k)];
  return z;
}
DeformingMechanismPool::Vector DeformingMechanismPool::rates(const Placed& p, const Instant& now) const {
  Vector w{};
  w[SliderCrankDynamics::phi] = p.at.gain * now.speed[p.at.shaft];
  for (std::size_t k = 0; k < p.further(); ++k) w[p.dynamics->free()[1 + k]] = now.own[at_rate(p, k)];
  return w;
}
DeformingMechanismPool::Motion DeformingMechanismPool::motion(const Placed& p, const Instant& now) const {
  return p.dynamics->motion<double>(coordinates(p, now), rates(p, now));
}

double DeformingMechanismPool::creep_speed(const Placed& p) { return creep * p.mechanism.output_scale(); }

template <class T>
SliderState<T> DeformingMechanismPool::slider(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m,
                                              std::size_t load) const {
  const bool watched = p.watches_travel && p.mechanism.loads[load].depends_on_travel();
  const int travel = watched ? now.mode[p.at.mode] : value_of(m.x_rate) >= 0 ? 1 : -1;
  return {m.z[SliderCrankDynamics::phi], m.x, m.x_rate, travel, now.mode[p.at.mode + 1 + static_cast<int>(load)]};
}

template SliderState<double> DeformingMechanismPool::slider(const Placed& p, const Instant& now, const Motion& m,
                                                            std::size_t load) const;

template <class T>
T DeformingMechanismPool::force_of(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m,
                                   std::size_t load) const {
  if (!now.active[p.at.id] || !acts(p.at, now, load)) return T(0.0);
  const SliderLoad& law = p.mechanism.loads[load];
  SliderState<T> s = slider(p, now, m, load);
  if (s.travel != creeps) return law.value(s);
  const auto towards = [&](int travel) {
    s.travel = travel;
    law.take_first_piece({value_of(s.phi), value_of(s.x), value_of(s.v), travel, s.mode}, s.mode);
    return law.value(s);
  };
  using std::tanh;
  const T part = tanh(m.x_rate * (1 / creep_speed(p)));
  return T(0.5 * (T(1.0) + part) * towards(1) + 0.5 * (T(1.0) - part) * towards(-1));
}

template <class T>
T DeformingMechanismPool::load_force(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m) const {
  T sum(0.0);
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) sum = sum + force_of(p, now, m, k);
  return sum;
}

void DeformingMechanismPool::set_timed_modes(double /*t*/, int* /*mode*/, char* active) const {
  for (const Placed& p : placed_) active[p.at.id] = 1;
}

DeformingMechanismPool::Solved DeformingMechanismPool::solve(const Placed& p, const Instant& now,
                                                             const Motion& m) const {
  const auto& free = p.dynamics->free();
  const Eigen::Index n = ix(p.further());
  Matrix mass(n + 1, n + 1);
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Vector column = p.dynamics->inertia_column(m, free[k]);
    for (std::size_t i = 0; i < free.size(); ++i) mass(ix(i), ix(k)) = column[free[i]];
  }
  const Vector h = p.dynamics->residual<double>(m, Vector{}, load_force(p, now, m), now.mode + p.contact_mode());
  Column force(n);
  for (std::size_t k = 0; k < p.further(); ++k) force(ix(k)) = -h[free[1 + k]];
  const Matrix further = mass.bottomRightCorner(n, n);
  const Eigen::LLT<Matrix> factors(further);
  const Column coupling = mass.bottomLeftCorner(n, 1), by_alpha = factors.solve(coupling), alone = factors.solve(force);
  // Parts moving with the crank only add to its inertia; rounding in diverging trial steps may reduce it.
  const double inertia = std::max(mass(0, 0) - coupling.dot(by_alpha), p.dynamics->data().crank_inertia);
  Solved solved{inertia, -h[free[0]] - coupling.dot(alone), {}, {}};
  for (std::size_t k = 0; k < p.further(); ++k) solved.free[k] = alone(ix(k)), solved.by_alpha[k] = by_alpha(ix(k));
  return solved;
}

void DeformingMechanismPool::add_work(const Placed& p, const Instant& now, const Motion& m, double* work_rate) const {
  work_rate[p.at.account] += p.dynamics->weight_power(m);
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k)
    work_rate[p.at.account + 1 + static_cast<int>(k)] += m.x_rate * force_of(p, now, m, k);
  if (!p.dynamics->clearances().empty())
    work_rate[p.contact_account()] -= p.dynamics->contact_loss_power(m, now.mode + p.contact_mode());
  if (p.dynamics->rod().count() > 0) work_rate[p.rod_account()] -= p.dynamics->damping_power(m);
}

// Until follow(), in the same evaluation, the rates of the internal states store its input.
void DeformingMechanismPool::add(const Instant& now, Sums& sums) const {
  for (const Placed& p : placed_) {
    const Motion m = motion(p, now);
    const Solved solved = solve(p, now, m);
    for (std::size_t k = 0; k < p.further(); ++k) {
      sums.internal_rate[at_internal(p, k)] = solved.by_alpha[k];
      sums.internal_rate[at_rate(p, k)] = solved.free[k];
    }
    sums.element_torque[p.at.id] = solved.torque;
    sums.element_inertia[p.at.id] = solved.inertia;
    sums.torque[p.at.shaft] += p.at.gain * solved.torque;
    sums.inertia[p.at.shaft] += p.at.gain * p.at.gain * solved.inertia;
    if (sums.work_rate) add_work(p, now, m, sums.work_rate);
  }
}

void DeformingMechanismPool::follow(const Instant& now, const double* alpha, double* internal_rate) const {
  for (const Placed& p : placed_)
    for (std::size_t k = 0; k < p.further(); ++k) {
      internal_rate[at_rate(p, k)] -= internal_rate[at_internal(p, k)] * p.at.gain * alpha[p.at.shaft];
      internal_rate[at_internal(p, k)] = now.own[at_rate(p, k)];
    }
}

// Amplitudes of the rod that its stiffness carries, by iteration: K q = what acts on them at rest in the frame.
void DeformingMechanismPool::balance(const Instant& now, const double* alpha, double* own) const {
  for (const Placed& p : placed_) {
    const RodModes& rod = p.dynamics->rod();
    const auto n = static_cast<std::size_t>(rod.count());
    if (n == 0) continue;
    Matrix stiffness(ix(n), ix(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) stiffness(ix(i), ix(k)) = rod.stiffness[i][k];
    const Eigen::LLT<Matrix> factors(stiffness);
    Vector z = coordinates(p, now), w = rates(p, now), acceleration{};
    acceleration[SliderCrankDynamics::phi] = p.at.gain * alpha[p.at.shaft];
    const std::size_t first = SliderCrankDynamics::first_amplitude;
    for (std::size_t k = 0; k < n; ++k) z[first + k] = w[first + k] = 0;
    for (int pass = 0; pass < 100; ++pass) {
      const Motion m = p.dynamics->motion<double>(z, w);
      const Vector h =
          p.dynamics->residual<double>(m, acceleration, load_force(p, now, m), now.mode + p.contact_mode());
      Column force(ix(n));
      for (std::size_t k = 0; k < n; ++k) force(ix(k)) = h[first + k];
      const Column change = factors.solve(force);
      for (std::size_t k = 0; k < n; ++k) z[first + k] -= change(ix(k));
      if (change.cwiseAbs().maxCoeff() < 1e-15 * rod.length) break;
    }
    for (std::size_t k = 0; k < n; ++k) own[at_internal(p, p.further() - n + k)] = z[first + k];
  }
}

void DeformingMechanismPool::first_states(const Instant&, double* own) const {
  for (const Placed& p : placed_) std::fill_n(own + p.at.own, 2 * p.further(), 0.0);
}

double DeformingMechanismPool::further_kinetic_energy(const Instant& now) const {
  double sum = 0;
  for (const Placed& p : placed_) {
    const Motion m = motion(p, now);
    const double omega = m.w[SliderCrankDynamics::phi];
    sum += p.dynamics->kinetic_energy(m) - 0.5 * solve(p, now, m).inertia * omega * omega;
  }
  return sum;
}

double DeformingMechanismPool::kinetic_energy_of_bodies(const Instant& now) const {
  double sum = 0;
  for (const Placed& p : placed_) sum += p.dynamics->kinetic_energy_of_points(motion(p, now));
  return sum;
}

double DeformingMechanismPool::energy(const Instant& now) const {
  double sum = 0;
  for (const Placed& p : placed_) {
    const Motion m = motion(p, now);
    sum += p.dynamics->elastic_energy(m) + p.dynamics->contact_energy(m, now.mode + p.contact_mode());
  }
  return sum;
}

// --- Jacobian; inputs: φ, ω, then the further coordinates, then their rates ---

void DeformingMechanismPool::register_jacobian(JacobianPattern& pattern) {
  for (Placed& p : placed_) {
    const int speed = pattern.speed(p.at.shaft);
    std::vector<int> column = {pattern.angle(p.at.angle), speed};
    for (std::size_t k = 0; k < p.further(); ++k) column.push_back(pattern.own(at_internal(p, k)));
    for (std::size_t k = 0; k < p.further(); ++k) column.push_back(pattern.own(at_rate(p, k)));
    for (const int c : column) p.shaft_slot.push_back(pattern.entry(speed, c));
    for (std::size_t k = 0; k < p.further(); ++k) {
      const int row = pattern.own(at_rate(p, k));
      for (const int c : column) p.internal_slot.push_back(pattern.entry(row, c));
      p.rate_slot.push_back(pattern.entry(pattern.own(at_internal(p, k)), row));
      p.follower_slot.push_back(pattern.follower(row, p.at.shaft));
    }
  }
}

// Of the equations at fixed accelerations: M₂₂ ∂q̈ = −∂R₂ − m₂₁ ∂α, and the shaft's row is −∂R₁ + m₁₂ m₂₂⁻¹ ∂R₂.
void DeformingMechanismPool::add_jacobian(const Instant& now, const double* alpha, double* slots) const {
  using D = Dual<chunk>;
  for (const Placed& p : placed_) {
    const auto& free = p.dynamics->free();
    const std::size_t n = p.further(), inputs = p.inputs();
    const Vector z = coordinates(p, now), w = rates(p, now);
    const Motion m = p.dynamics->motion<double>(z, w);
    const Solved solved = solve(p, now, m);
    const double crank_alpha = p.at.gain * alpha[p.at.shaft];
    Vector acceleration{};
    acceleration[free[0]] = crank_alpha;
    for (std::size_t k = 0; k < n; ++k) acceleration[free[1 + k]] = solved.free[k] - solved.by_alpha[k] * crank_alpha;
    Matrix further(ix(n), ix(n));
    for (std::size_t k = 0; k < n; ++k) {
      const Vector column = p.dynamics->inertia_column(m, free[1 + k]);
      for (std::size_t i = 0; i < n; ++i) further(ix(i), ix(k)) = column[free[1 + i]];
    }
    const Eigen::LLT<Matrix> factors(further);
    for (std::size_t first = 0; first < inputs; first += chunk) {
      std::array<D, most_own> dual_z, dual_w;
      for (std::size_t k = 0; k < most_own; ++k) dual_z[k] = D(z[k]), dual_w[k] = D(w[k]);
      const std::size_t count = std::min<std::size_t>(chunk, inputs - first);
      for (std::size_t c = 0; c < count; ++c) {
        const std::size_t input = first + c;
        D& seeded = input == 0      ? dual_z[free[0]]
                    : input == 1    ? dual_w[free[0]]
                    : input < 2 + n ? dual_z[free[input - 1]]
                                    : dual_w[free[input - 1 - n]];
        seeded.d[c] = 1;
      }
      const SliderCrankMotion<D> dual = p.dynamics->motion<D>(dual_z, dual_w);
      const auto residual =
          p.dynamics->residual<D>(dual, acceleration, load_force(p, now, dual), now.mode + p.contact_mode());
      for (std::size_t c = 0; c < count; ++c) {
        const std::size_t input = first + c;
        const double gain = input == 1 ? p.at.gain : 1;  // the shaft's speed over the crank's
        Column change(ix(n));
        double on_shaft = -residual[free[0]].d[c];
        for (std::size_t k = 0; k < n; ++k) {
          change(ix(k)) = -residual[free[1 + k]].d[c];
          on_shaft -= solved.by_alpha[k] * change(ix(k));
        }
        slots[p.shaft_slot[input]] += p.at.gain * gain * on_shaft;
        const Column rate = factors.solve(change);
        for (std::size_t k = 0; k < n; ++k) slots[p.internal_slot[k * inputs + input]] += gain * rate(ix(k));
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      slots[p.rate_slot[k]] += 1;
      slots[p.follower_slot[k]] -= solved.by_alpha[k] * p.at.gain;
    }
  }
}

// --- outputs ---

DeformingMechanismPool::Vector DeformingMechanismPool::acceleration(const Placed& p, const Snapshot& s) const {
  Vector a{};
  a[SliderCrankDynamics::phi] = p.at.gain * s.alpha[p.at.shaft];
  for (std::size_t k = 0; k < p.further(); ++k) a[p.dynamics->free()[1 + k]] = s.sums.internal_rate[at_rate(p, k)];
  return a;
}

// Forces that keep the other coordinates at zero: reactions of the ideal joints.
DeformingMechanismPool::Vector DeformingMechanismPool::reactions(const Placed& p, const Snapshot& s) const {
  const Motion m = motion(p, s.now);
  return p.dynamics->residual<double>(m, acceleration(p, s), load_force(p, s.now, m), s.now.mode + p.contact_mode());
}

void DeformingMechanismPool::add_channels(std::vector<Channel>& channels) const {
  using C = SliderCrankDynamics::Coordinate;
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const Placed& placed = placed_[i];
    const std::string& name = placed.mechanism.name;
    using Value = std::function<double(const Snapshot&)>;
    const auto add = [&](const QuantityKind& quantity, const char* unit, Value value) {
      channels.push_back({Name::make(quantity, name), unit, std::move(value)});
    };
    const auto add_own = [&](const std::string& words, const char* unit, Value value) {
      channels.push_back({Name::own(words, name), unit, std::move(value)});
    };
    const auto here = [this, i](const Snapshot& s) { return motion(placed_[i], s.now); };
    add(quantities::position, "m", [here](const Snapshot& s) { return here(s).x; });
    add(quantities::velocity, "m/s", [here](const Snapshot& s) { return here(s).x_rate; });
    add(quantities::acceleration, "m/s2", [this, i, here](const Snapshot& s) {
      return placed_[i].dynamics->acceleration_x(here(s), acceleration(placed_[i], s));
    });
    if (!placed.mechanism.loads.empty())
      add(quantities::force, "N",
          [this, i, here](const Snapshot& s) { return load_force(placed_[i], s.now, here(s)); });
    const auto& free = placed.dynamics->free();
    if (std::find(free.begin(), free.end(), std::size_t{C::y}) == free.end())
      add_own("guide_reaction", "N", [this, i](const Snapshot& s) { return reactions(placed_[i], s)[C::y]; });
    for (std::size_t k = 0; k < placed.dynamics->clearances().size(); ++k) {
      const auto greatest = [this, i, k](const Snapshot& s, bool force) {
        const Placed& p = placed_[i];
        const Motion m = motion(p, s.now);
        double found = 0;
        for (std::size_t c = 0; c < p.dynamics->contacts().size(); ++c) {
          if (p.dynamics->contacts()[c].clearance != k) continue;
          const int mode = s.now.mode[p.contact_mode() + static_cast<int>(c)];
          found = std::max(found, force ? p.dynamics->contact_force(m, c, mode) : p.dynamics->approach(c, m).depth);
        }
        return found;
      };
      const std::string word = joint_word(placed.dynamics->clearances()[k]);
      add_own(word + "_force", "N", [greatest](const Snapshot& s) { return greatest(s, true); });
      add_own(word + "_penetration", "m", [greatest](const Snapshot& s) { return greatest(s, false); });
    }
    if (placed.dynamics->rod().bending == 0) continue;
    add_own("rod_deflection", "m",
            [this, i, here](const Snapshot& s) { return placed_[i].dynamics->deflection(here(s), 0.5); });
    const RodFlexibility& rod = *deformation_of(placed.mechanism).flexibility;
    if (rod.edge > 0)
      add_own("rod_bending_stress", "Pa", [this, i, here, rod](const Snapshot& s) {
        return rod.modulus * rod.edge * placed_[i].dynamics->greatest_bending(here(s));
      });
  }
}

}  // namespace kurbel
