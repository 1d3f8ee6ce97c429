// deforming_mechanism.cpp — gathers the crank's motion and the own states, solves for what the shaft feels, scatters.
#include "mechanisms/reduced/deforming_mechanism.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/scene/scene.h"

namespace kurbel {
namespace {

constexpr int chunk = 6;  // so many inputs are differentiated at once
constexpr std::size_t most = SliderCrankDynamics::most;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most, 1>;

Eigen::Index ix(std::size_t i) { return static_cast<Eigen::Index>(i); }

// A slider that finds no rest under loads that turn with its travel creeps: they go over from one sense to the other as
// tanh(v/v₀), v₀ = `creep` times the output's scale, and take up their branches again beyond `creep_ends` v₀.
constexpr int creeps = 2;         // in place of ±1 as the sense of travel
constexpr double creep = 1e-2;    // of the output's scale [rad/s]
constexpr double creep_ends = 5;  // in units of creep

template <class L>
constexpr bool has_pieces = requires(const L& l, SliderState<double> s) {
  l.first_mode(s);
};

// What the crank feels while nothing deforms; negative: the masses cannot be those of bodies.
double inertia_felt(const SliderCrankDynamics& dynamics, double phi) {
  SliderCrankDynamics::Vector z{}, w{};
  z[SliderCrankDynamics::phi] = phi;
  const auto m = dynamics.motion<double>(z, w);
  const auto& free = dynamics.free();
  Eigen::MatrixXd mass(ix(free.size()), ix(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto column = dynamics.inertia_column(m, free[k]);
    for (std::size_t i = 0; i < free.size(); ++i) mass(ix(i), ix(k)) = column[free[i]];
  }
  const Eigen::Index n = mass.rows() - 1;
  Eigen::MatrixXd further = mass.bottomRightCorner(n, n);
  const Eigen::VectorXd scale = further.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0)) return -1;
  further = scale.cwiseInverse().asDiagonal() * further * scale.cwiseInverse().asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factors(further);
  if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-12)) return -1;
  const Eigen::VectorXd coupling = mass.bottomLeftCorner(n, 1).col(0).cwiseQuotient(scale);
  const double felt = mass(0, 0) - coupling.dot(factors.solve(coupling));
  return felt < -1e-9 * mass(0, 0) ? -1 : std::max(felt, 0.0);
}

std::string joint_word(const JointClearance& joint) {
  std::string word = joint.name();
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------------

DeformingMechanismMaker::DeformingMechanismMaker(Mechanism given) : MechanismMaker(std::move(given)) {
  const Mechanism& m = mechanism();
  const std::string what = m.clearances.empty() ? "a flexible rod"
                           : m.flexibility      ? "joint clearance and a flexible rod"
                                                : "joint clearance";
  if (m.joint_friction)
    throw std::invalid_argument(what +
                                " and joint_friction cannot both be on: reactions with friction are those of ideal "
                                "joints; give the clearance a friction and switch joint_friction off");
  for (const SliderLoad& load : m.loads)
    if (std::holds_alternative<OpposingForce>(load.law))
      throw std::invalid_argument(fmt::format(
          "{} cannot be had with the load \"{}\" of kind \"opposing\", which holds a slider that stands; take kind "
          "\"medium\", or switch the effect off",
          what, load.name));
  dynamics_ = std::make_shared<const SliderCrankDynamics>(std::get<SliderCrankData>(m.data), m.clearances,
                                                          m.flexibility, m.weightless);
  constexpr int n = 64;
  least_inertia_ = HUGE_VAL;
  for (int i = 0; i < n; ++i)
    least_inertia_ = std::min(least_inertia_, inertia_felt(*dynamics_, 2 * std::numbers::pi * i / n));
  if (least_inertia_ < 0)
    throw std::invalid_argument(
        what +
        " needs masses that its motions accelerate: give rod_mass, rod_inertia (of a prismatic rod "
        "rod_mass · rod²/12) and slider_mass");
}

// Scales: gaps, a ten thousandth of the length for bending, and a hundredth of that for stretching; rates by what an
// impact of that depth or a vibration of that amplitude has.
std::vector<OwnState> DeformingMechanismMaker::own_states() const {
  const Mechanism& m = mechanism();
  const auto& data = std::get<SliderCrankData>(m.data);
  struct Name {
    std::string name, unit;
    double scale, rate_scale;
    bool peak;
  };
  std::vector<Name> names;
  const double mass = std::max(data.slider_mass + data.rod_mass, 1e-300);
  for (const JointClearance& c : m.clearances) {
    const double gap = c.contact.gap, rate = gap * std::sqrt(c.contact.stiffness / mass);
    const std::string word = joint_word(c);
    if (c.joint == JointClearance::Joint::guide) {
      const double arm = std::max({c.half_length, c.half_height, gap});
      names.push_back({"guide_shift", "m", gap, rate, false});
      names.push_back({"guide_tilt", "rad", gap / arm, rate / arm, false});
    } else {
      names.push_back({word + "_shift_x", "m", gap, rate, false});
      names.push_back({word + "_shift_y", "m", gap, rate, false});
    }
  }
  const RodModes& rod = dynamics_->rod();
  for (int i = 0; i < rod.bending; ++i) {
    const double scale = 1e-4 * rod.length;
    names.push_back({fmt::format("bending_{}", i + 1), "m", scale, scale * rod.frequency(i + 1), true});
  }
  if (rod.axial) {
    const auto e = static_cast<std::size_t>(rod.end());
    const double scale = 1e-6 * rod.length, omega = std::sqrt(rod.stiffness[e][e] / rod.mass[e][e]);
    names.push_back({"stretching_middle", "m", scale, scale * omega, false});
    names.push_back({"stretching_end", "m", scale, scale * omega, true});
  }
  std::vector<OwnState> states;
  for (const Name& n : names) states.push_back({n.name, n.unit, n.scale, n.peak});
  for (const Name& n : names) states.push_back({n.name + "_rate", n.unit + "/s", n.rate_scale, false});
  return states;
}

std::string DeformingMechanismMaker::describe() const {
  const Mechanism& m = mechanism();
  std::string text = MechanismMaker::describe();
  for (const JointClearance& c : m.clearances)
    text += fmt::format(
        "; {} of {}: gap {:.6g} m, contact after Hunt and Crossley with {:.6g} N/m at the depth of the gap, exponent "
        "{:.3g}, damping {:.4g} s/m{}",
        c.name(), m.name, c.contact.gap, c.contact.stiffness, c.contact.exponent, c.contact.damping,
        c.contact.friction > 0 ? fmt::format(", friction {:.3g}", c.contact.friction) : "");
  const RodModes& rod = dynamics_->rod();
  if (rod.count() > 0) {
    text += fmt::format("; rod of {}: {} bending mode{}", m.name, rod.bending, rod.bending == 1 ? "" : "s");
    if (rod.bending > 0)
      text += fmt::format(", the first at {:.6g} Hz between its pins", rod.frequency(1) / (2 * M_PI));
    if (rod.axial) text += ", and stretching";
  }
  return text;
}

int DeformingMechanismMaker::mode_count() const {
  return 1 + static_cast<int>(mechanism().loads.size() + dynamics_->contacts().size());
}

std::vector<std::pair<std::string, Account>> DeformingMechanismMaker::further_accounts() const {
  auto accounts = MechanismMaker::further_accounts();
  if (!mechanism().clearances.empty()) accounts.emplace_back(mechanism().name + ".contact", Account::harmful);
  if (dynamics_->rod().count() > 0) accounts.emplace_back(mechanism().name + ".rod", Account::harmful);
  return accounts;
}

std::size_t further_coordinates(const Model& model) {
  std::size_t sum = 0;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const auto* maker = dynamic_cast<const DeformingMechanismMaker*>(e.element.get()))
      sum += maker->dynamics().free().size() - 1;
  return sum;
}

void DeformingMechanismMaker::place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel&) const {
  pools.of<DeformingMechanismPool>().place(mechanism(), dynamics_, ports);
}

// ---------------------------------------------------------------------------------------------------------------------

void DeformingMechanismPool::place(Mechanism mechanism, std::shared_ptr<const SliderCrankDynamics> dynamics,
                                   const ShaftPorts& at) {
  using Kind = GuardOwner::Kind;
  Placed placed{std::move(mechanism), std::move(dynamics), at};
  const std::size_t index = placed_.size();
  for (const SliderLoad& load : placed.mechanism.loads)
    placed.watches_travel = placed.watches_travel || load.depends_on_travel();
  if (placed.watches_travel) owners_.push_back({Kind::travel, index, 0, 0});
  for (std::size_t k = 0; k < placed.mechanism.loads.size(); ++k)
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>)
            for (const int which : {0, 1}) owners_.push_back({Kind::load, index, k, which});
        },
        placed.mechanism.loads[k].law);
  for (std::size_t c = 0; c < placed.dynamics->contacts().size(); ++c)
    for (int which = 0; which < JointContact::guards; ++which) owners_.push_back({Kind::contact, index, c, which});
  placed_.push_back(std::move(placed));
}

DeformingMechanismPool::Vector DeformingMechanismPool::coordinates(const Placed& p, const Instant& now) const {
  Vector z{};
  z[SliderCrankDynamics::phi] = now.angle[p.at.angle] + p.at.phase;
  for (std::size_t k = 0; k < p.further(); ++k) z[p.dynamics->free()[1 + k]] = now.own[at_own(p, k)];
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

template <class T>
T DeformingMechanismPool::force_of(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m,
                                   std::size_t load) const {
  SliderState<T> s = slider(p, now, m, load);
  return std::visit(
      [&](const auto& law) {
        if (s.travel != creeps) return T(law.value(s));
        const auto towards = [&](int travel) {
          s.travel = travel;
          if constexpr (has_pieces<std::decay_t<decltype(law)>>) {
            const SliderState<double> here{value_of(s.phi), value_of(s.x), value_of(s.v), travel, s.mode};
            s.mode = law.first_mode(here);
          }
          return T(law.value(s));
        };
        using std::tanh;
        const T part = tanh(m.x_rate * (1 / creep_speed(p)));
        return T(0.5 * (T(1.0) + part) * towards(1) + 0.5 * (T(1.0) - part) * towards(-1));
      },
      p.mechanism.loads[load].law);
}

template <class T>
T DeformingMechanismPool::load_force(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m) const {
  T sum(0.0);
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) sum = sum + force_of(p, now, m, k);
  return sum;
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
  // What moves with the crank only adds to its own inertia; rounding in trial steps that diverge takes away.
  const double inertia = std::max(mass(0, 0) - coupling.dot(by_alpha), p.dynamics->data().crank_inertia);
  Solved solved{inertia, -h[free[0]] - coupling.dot(alone), {}, {}};
  for (std::size_t k = 0; k < p.further(); ++k) solved.free[k] = alone(ix(k)), solved.by_alpha[k] = by_alpha(ix(k));
  return solved;
}

void DeformingMechanismPool::add_work(const Placed& p, const Instant& now, const Motion& m, double* work_rate) const {
  work_rate[p.at.account] += p.dynamics->weight_power(m);
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k)
    work_rate[p.at.account + 1 + static_cast<int>(k)] += m.x_rate * force_of(p, now, m, k);
  if (!p.mechanism.clearances.empty())
    work_rate[p.contact_account()] -= p.dynamics->contact_loss_power(m, now.mode + p.contact_mode());
  if (p.dynamics->rod().count() > 0) work_rate[p.rod_account()] -= p.dynamics->damping_power(m);
}

// The rates of the own states hold what follow() needs until it makes them what they are: it comes in the same
// evaluation.
void DeformingMechanismPool::add(const Instant& now, Sums& sums) const {
  for (const Placed& p : placed_) {
    const Motion m = motion(p, now);
    const Solved solved = solve(p, now, m);
    for (std::size_t k = 0; k < p.further(); ++k) {
      sums.own_rate[at_own(p, k)] = solved.by_alpha[k];
      sums.own_rate[at_rate(p, k)] = solved.free[k];
    }
    sums.element_torque[p.at.id] = solved.torque;
    sums.element_inertia[p.at.id] = solved.inertia;
    sums.torque[p.at.shaft] += p.at.gain * solved.torque;
    sums.inertia[p.at.shaft] += p.at.gain * p.at.gain * solved.inertia;
    if (sums.work_rate) add_work(p, now, m, sums.work_rate);
  }
}

void DeformingMechanismPool::follow(const Instant& now, const double* alpha, double* own_rate) const {
  for (const Placed& p : placed_)
    for (std::size_t k = 0; k < p.further(); ++k) {
      own_rate[at_rate(p, k)] -= own_rate[at_own(p, k)] * p.at.gain * alpha[p.at.shaft];
      own_rate[at_own(p, k)] = now.own[at_rate(p, k)];
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
    for (std::size_t k = 0; k < n; ++k) own[at_own(p, p.further() - n + k)] = z[first + k];
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

// ---------------------------------------------------------------------------------------------------------------------
// Jacobian. Inputs: φ, ω, then the further coordinates, then their rates.

void DeformingMechanismPool::register_jacobian(JacobianPattern& pattern) {
  for (Placed& p : placed_) {
    const int speed = pattern.speed(p.at.shaft);
    std::vector<int> column = {pattern.angle(p.at.angle), speed};
    for (std::size_t k = 0; k < p.further(); ++k) column.push_back(pattern.own(at_own(p, k)));
    for (std::size_t k = 0; k < p.further(); ++k) column.push_back(pattern.own(at_rate(p, k)));
    for (const int c : column) p.shaft_slot.push_back(pattern.entry(speed, c));
    for (std::size_t k = 0; k < p.further(); ++k) {
      const int row = pattern.own(at_rate(p, k));
      for (const int c : column) p.own_slot.push_back(pattern.entry(row, c));
      p.rate_slot.push_back(pattern.entry(pattern.own(at_own(p, k)), row));
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
      std::array<D, most> dual_z, dual_w;
      for (std::size_t k = 0; k < most; ++k) dual_z[k] = D(z[k]), dual_w[k] = D(w[k]);
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
        for (std::size_t k = 0; k < n; ++k) slots[p.own_slot[k * inputs + input]] += gain * rate(ix(k));
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      slots[p.rate_slot[k]] += 1;
      slots[p.follower_slot[k]] -= solved.by_alpha[k] * p.at.gain;
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Events

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
        std::visit(
            [&](const auto& law) {
              if constexpr (has_pieces<std::decay_t<decltype(law)>>) law.guard(s, g + i);
            },
            p.mechanism.loads[owner.index].law);
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
    const SliderState<double> s = slider(p, now, m, owner.index);
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>)
            mode[p.at.mode + 1 + static_cast<int>(owner.index)] = law.next_mode(s, owner.which);
        },
        p.mechanism.loads[owner.index].law);
    return;
  }
  // The slider turns round, and each load takes up the branch of the other stroke.
  mode[p.at.mode] = mode[p.at.mode] == creeps ? (m.x_rate >= 0 ? 1 : -1) : -mode[p.at.mode];
  for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
    if (!p.mechanism.loads[k].depends_on_travel()) continue;
    SliderState<double> s = slider(p, now, m, k);
    s.travel = mode[p.at.mode];
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>)
            mode[p.at.mode + 1 + static_cast<int>(k)] = law.first_mode(s);
        },
        p.mechanism.loads[k].law);
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
    std::string what;
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>) what = law.mode_name(s);
        },
        load.law);
    return {load.name, what};
  }
  const SliderCrankDynamics::ContactPlace& place = p.dynamics->contacts()[owner.index];
  static const char* const corners[] = {"extended upper corner", "folded upper corner", "extended lower corner",
                                        "folded lower corner"};
  std::string what = p.dynamics->clearances()[place.clearance].name();
  if (place.corner >= 0) what += std::string(", ") + corners[place.corner];
  switch (now.mode[p.contact_mode() + static_cast<int>(owner.index)]) {
    case JointContact::flight:
      return {p.mechanism.name, what + ": in flight"};
    case JointContact::touching:
      return {p.mechanism.name, what + ": touches"};
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
    // At rest the crank's direction tells; on a dead centre the motion to come.
    if (std::abs(rate) < 1e-12 * p.mechanism.output_scale() * std::max(1.0, std::abs(m.w[0])))
      rate = m.w[0] != 0 ? m.x_bias : m.of_x[0];
    if (mode[p.at.mode] != creeps) mode[p.at.mode] = rate >= 0 ? 1 : -1;
    for (std::size_t k = 0; k < p.mechanism.loads.size(); ++k) {
      SliderState<double> s = slider(p, now, m, k);
      if (p.mechanism.loads[k].depends_on_travel()) {
        if (mode[p.at.mode] == creeps) continue;  // takes its branches as they come
        s.travel = mode[p.at.mode];
      }
      std::visit(
          [&](const auto& law) {
            if constexpr (has_pieces<std::decay_t<decltype(law)>>)
              mode[p.at.mode + 1 + static_cast<int>(k)] = law.first_mode(s);
          },
          p.mechanism.loads[k].law);
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

// ---------------------------------------------------------------------------------------------------------------------
// Outputs

DeformingMechanismPool::Vector DeformingMechanismPool::acceleration(const Placed& p, const Snapshot& s) const {
  Vector a{};
  a[SliderCrankDynamics::phi] = p.at.gain * s.alpha[p.at.shaft];
  for (std::size_t k = 0; k < p.further(); ++k) a[p.dynamics->free()[1 + k]] = s.sums.own_rate[at_rate(p, k)];
  return a;
}

// What the coordinates that are not free need to stay zero: reactions of the ideal joints.
DeformingMechanismPool::Vector DeformingMechanismPool::reactions(const Placed& p, const Snapshot& s) const {
  const Motion m = motion(p, s.now);
  return p.dynamics->residual<double>(m, acceleration(p, s), load_force(p, s.now, m), s.now.mode + p.contact_mode());
}

void DeformingMechanismPool::add_channels(std::vector<Channel>& channels) const {
  using C = SliderCrankDynamics::Coordinate;
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const Placed& placed = placed_[i];
    const std::string& name = placed.mechanism.name;
    const auto add = [&](const std::string& quantity, const char* unit, std::function<double(const Snapshot&)> value) {
      channels.push_back({quantity + "." + name, unit, std::move(value)});
    };
    const auto here = [this, i](const Snapshot& s) { return motion(placed_[i], s.now); };
    add("position", "m", [here](const Snapshot& s) { return here(s).x; });
    add("velocity", "m/s", [here](const Snapshot& s) { return here(s).x_rate; });
    add("acceleration", "m/s2", [this, i, here](const Snapshot& s) {
      return placed_[i].dynamics->acceleration_x(here(s), acceleration(placed_[i], s));
    });
    if (!placed.mechanism.loads.empty())
      add("force", "N", [this, i, here](const Snapshot& s) { return load_force(placed_[i], s.now, here(s)); });
    const auto& free = placed.dynamics->free();
    if (std::find(free.begin(), free.end(), std::size_t{C::y}) == free.end())
      add("guide_reaction", "N", [this, i](const Snapshot& s) { return reactions(placed_[i], s)[C::y]; });
    for (std::size_t k = 0; k < placed.mechanism.clearances.size(); ++k) {
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
      const std::string word = joint_word(placed.mechanism.clearances[k]);
      add(word + "_force", "N", [greatest](const Snapshot& s) { return greatest(s, true); });
      add(word + "_penetration", "m", [greatest](const Snapshot& s) { return greatest(s, false); });
    }
    if (placed.dynamics->rod().bending == 0) continue;
    add("rod_deflection", "m",
        [this, i, here](const Snapshot& s) { return placed_[i].dynamics->deflection(here(s), 0.5); });
    const RodFlexibility& rod = *placed.mechanism.flexibility;
    if (rod.edge > 0)
      add("rod_bending_stress", "Pa", [this, i, here, rod](const Snapshot& s) {
        return rod.modulus * rod.edge * placed_[i].dynamics->greatest_bending(here(s));
      });
  }
}

}  // namespace kurbel
