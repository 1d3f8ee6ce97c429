// deformed_mechanism.cpp — torque and reactions at one instant, taken from the element.
#include "studies/forces/deformed_mechanism.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/numerics/index.h"
#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"
#include "studies/forces/crank_motion.h"

namespace kurbel {

DeformedMechanism::DeformedMechanism(std::shared_ptr<const Model> model, const std::string& component)
    : model_(std::move(model)) {
  const Model& m = *model_;
  const Network::ShaftElement& element = mechanism_element(m.network, component);
  element_ = static_cast<std::size_t>(&element - m.network.elements.data());
  dynamics_ = dynamics_of(element);
  for (std::size_t e = 0; e < m.network.elements.size(); ++e)
    if (m.network.elements[e].component.starts_with(component + ".")) within_.push_back(e);
  for (std::size_t k = 0; k < m.pool_channels.size(); ++k)
    if (m.pool_channels[k].name.what == quantities::force && m.pool_channels[k].name.of == component)
      force_channel_ = static_cast<int>(k);
  while (own_ < m.internal_states.size() && m.internal_states[own_].component != component) ++own_;
}

MachineForces DeformedMechanism::at(const Snapshot& s) const {
  const Model& m = *model_;
  const int node = m.network.elements[element_].node, shaft = m.shaft_of_node[kurbel::at(node)];
  const double gain = m.gain_of_node[kurbel::at(node)], alpha = gain * s.alpha[shaft];
  MachineForces out;
  out.torque = s.sums.element_inertia[element_] * alpha - s.sums.element_torque[element_];
  for (const std::size_t e : within_) out.torque -= s.sums.element_torque[e];
  if (dynamics_) find_reactions(s, gain * s.now.speed[shaft], alpha, out);
  return out;
}

void DeformedMechanism::find_reactions(const Snapshot& s, double omega, double alpha, MachineForces& out) const {
  using C = SliderCrankDynamics::Coordinate;
  const Network::ShaftElement& element = model_->network.elements[element_];
  const std::vector<std::size_t>& free = dynamics_->free();
  Vector z{}, w{}, acceleration{};
  z[C::phi] = s.node_angle[element.node] + element.phase, w[C::phi] = omega, acceleration[C::phi] = alpha;
  for (std::size_t k = 1; k < free.size(); ++k) {
    z[free[k]] = s.now.own[own_ + k - 1];
    w[free[k]] = s.now.own[own_ + free.size() + k - 2];
    acceleration[free[k]] = s.sums.internal_rate[own_ + free.size() + k - 2];
  }
  const auto motion = dynamics_->motion<double>(z, w);
  std::array<int, SliderCrankDynamics::most_contacts> mode{};
  std::fill(mode.begin(), mode.end(), static_cast<int>(JointContact::without_events));
  const double load = force_channel_ < 0 ? 0 : model_->pool_channels[kurbel::at(force_channel_)].value(s);
  const Vector left = dynamics_->residual<double>(motion, acceleration, load, mode.data());
  Force2 pin{left[C::e_x], left[C::e_y]}, wrist{left[C::f_x], left[C::f_y]};
  double guide = std::abs(left[C::y]);
  double corners = 0;  // both sides of a guide with play
  for (std::size_t c = 0; c < dynamics_->contacts().size(); ++c) {
    const auto& place = dynamics_->contacts()[c];
    const JointClearance& joint = dynamics_->clearances()[place.clearance];
    const double normal = dynamics_->contact_force(motion, c, mode[c]);
    if (place.corner >= 0) {
      corners += (place.corner < 2 ? 1 : -1) * normal;
      guide = std::abs(corners);
      continue;
    }
    const bool crank = joint.joint == JointClearance::Joint::crank_pin;
    const std::size_t first = crank ? C::e_x : C::f_x;
    const double gap = std::hypot(z[first], z[first + 1]);
    (crank ? pin : wrist) =
        gap > 0 ? (crank ? -normal / gap : normal / gap) * Force2{z[first], z[first + 1]} : Force2{};
  }
  // Equilibrium of the crank: forces of the pin and the frame, its inertia and weight.
  const SliderCrankData& d = dynamics_->data();
  const double c = std::cos(z[C::phi]), n = std::sin(z[C::phi]), moment = d.crank_mass * d.crank_com;
  const Force2 inertia{-moment * (c * omega * omega + n * alpha), moment * (c * alpha - n * omega * omega)};
  const double gravity = mechanism_of(element)->mechanism().weightless ? 0 : d.gravity;
  const Force2 up = d.crank_mass * gravity * Force2{std::sin(d.stroke_angle), std::cos(d.stroke_angle)};
  out.reaction = {(pin + inertia + up).magnitude(), pin.magnitude(), wrist.magnitude(), guide};
}

}  // namespace kurbel
