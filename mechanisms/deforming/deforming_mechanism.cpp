// deforming_mechanism.cpp — valid combinations of deformations, internal states with scales, and the description.
#include "mechanisms/deforming/deforming_mechanism.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/scene/scene.h"

namespace kurbel {
namespace {

Eigen::Index entry(std::size_t i) { return static_cast<Eigen::Index>(i); }

// Effective inertia on the crank without deformation; negative: the masses are not possible for bodies.
double inertia_felt(const SliderCrankDynamics& dynamics, double phi) {
  SliderCrankDynamics::Vector z{}, w{};
  z[SliderCrankDynamics::phi] = phi;
  const auto m = dynamics.motion<double>(z, w);
  const auto& free = dynamics.free();
  Eigen::MatrixXd mass(entry(free.size()), entry(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto column = dynamics.inertia_column(m, free[k]);
    for (std::size_t i = 0; i < free.size(); ++i) mass(entry(i), entry(k)) = column[free[i]];
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

// Scales: gaps, a ten thousandth of the length for bending, and a hundredth of that for stretching; rates by what an
// impact of that depth or a vibration of that amplitude has.
std::vector<InternalState> internal_states_of(const Mechanism& m, const RodModes& rod) {
  const SliderCrankData& data = *m.data.as<SliderCrankData>();
  struct Name {
    std::string name, unit;
    double scale, rate_scale;
    bool peak;
  };
  std::vector<Name> names;
  const double mass = std::max(data.slider_mass + data.rod_mass, 1e-300);
  for (const JointClearance& c : deformation_of(m).clearances) {
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
  std::vector<InternalState> states;
  for (const Name& n : names) states.push_back({n.name, n.unit, n.scale, n.peak});
  for (const Name& n : names) states.push_back({n.name + "_rate", n.unit + "/s", n.rate_scale, false});
  return states;
}

}  // namespace

std::string joint_word(const JointClearance& joint) {
  std::string word = joint.name();
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::shared_ptr<const DeformingParts> Deformation::under(const Effects& effects) const {
  auto left = std::make_shared<Deformation>();
  if (effects.joint_clearance) left->clearances = clearances;
  if (effects.flexible_rod) left->flexibility = flexibility;
  return left->clearances.empty() && !left->flexibility ? nullptr : left;
}

ShaftForm Deformation::form(Mechanism mechanism) const {
  return std::make_shared<DeformingMechanismElement>(std::move(mechanism));
}

const Deformation& deformation_of(const Mechanism& mechanism) {
  static const Deformation none;
  return mechanism.deforming ? static_cast<const Deformation&>(*mechanism.deforming) : none;
}

const SliderCrankDynamics* dynamics_of(const Network::ShaftElement& element) {
  const auto* const deforming = dynamic_cast<const DeformingMechanismElement*>(mechanism_of(element));
  return deforming ? &deforming->dynamics() : nullptr;
}

DeformingMechanismElement::DeformingMechanismElement(Mechanism given) : MechanismElement(std::move(given)) {
  const Mechanism& m = mechanism();
  const Deformation& parts = deformation_of(m);
  const std::string what = parts.clearances.empty() ? "a flexible rod"
                           : parts.flexibility      ? "joint clearance and a flexible rod"
                                                    : "joint clearance";
  if (m.friction)
    throw std::invalid_argument(what +
                                " and joint_friction cannot both be on: reactions with friction are those of ideal "
                                "joints; give the clearance a friction and switch joint_friction off");
  for (const SliderLoad& load : m.loads)
    if (std::holds_alternative<OpposingForce>(load.law))
      throw std::invalid_argument(
          fmt::format("{} cannot be had with the load \"{}\" of kind \"opposing\", which holds a slider that stands; "
                      "take kind \"medium\", or switch the effect off",
                      what, load.name));
  dynamics_ = std::make_shared<const SliderCrankDynamics>(*m.data.as<SliderCrankData>(), parts.clearances,
                                                          parts.flexibility, m.weightless);
  constexpr int n = 64;
  least_inertia = HUGE_VAL;
  for (int i = 0; i < n; ++i)
    least_inertia = std::min(least_inertia, inertia_felt(*dynamics_, 2 * std::numbers::pi * i / n));
  if (least_inertia < 0)
    throw std::invalid_argument(what +
                                " needs masses that its motions accelerate: give rod_mass, rod_inertia (of a prismatic "
                                "rod rod_mass · rod²/12) and slider_mass");
  is.directional = false;
  uses_speed = true;
  internal_states = internal_states_of(m, dynamics_->rod());
  modes += static_cast<int>(dynamics_->contacts().size());
  if (!parts.clearances.empty()) further_accounts.emplace_back(m.name + ".contact", Account::harmful);
  if (dynamics_->rod().count() > 0) further_accounts.emplace_back(m.name + ".rod", Account::harmful);
}

std::string DeformingMechanismElement::describe() const {
  const Mechanism& m = mechanism();
  std::string text = MechanismElement::describe();
  for (const JointClearance& c : dynamics_->clearances())
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

std::size_t further_coordinates(const Model& model) {
  std::size_t sum = 0;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const SliderCrankDynamics* dynamics = dynamics_of(e)) sum += dynamics->free().size() - 1;
  return sum;
}

void DeformingMechanismElement::place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel&) const {
  pools.of<DeformingMechanismPool>().place(mechanism(), dynamics_, ports);
}

}  // namespace kurbel
