// scales.cpp — orders of magnitude of speeds, torques and twists: the rated ones, referred to every shaft.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/model/compile_steps.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// Rated values of the machine's elements, referred to the reduction link.
struct Size {
  double speed = 0;             // the largest that is rated, prescribed or given at the start [rad/s]
  double torque = 0;            // the largest that drives [N·m]
  double resisting = 0;         // the largest of the others [N·m]
  double inertia = 0;           // of all [kg·m²]
  double mechanisms = 0;        // their mean inertia [kg·m²]
  double varying = 0;           // what they have of it beyond their least [kg·m²]
  void reaches(double given) {  // a speed
    speed = std::max(speed, std::abs(given));
  }
};

Size rated_size(const Model& m) {
  Size size;
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n)
    size.inertia += m.network.nodes[n].inertia * m.node_ratio[n] * m.node_ratio[n];
  for (const Network::ShaftElement& e : m.network.elements) {
    const double ratio = m.scale_ratio[at(e.node)];
    const Rated rated = e.element->rated;
    size.speed = std::max(size.speed, std::abs(rated.speed) / ratio);
    double& sum = e.element->account == Account::driving ? size.torque : size.resisting;
    sum = std::max(sum, std::abs(rated.torque) * ratio);
    size.inertia += e.element->mean_inertia * ratio * ratio;
    size.mechanisms += e.element->mean_inertia * ratio * ratio;
    size.varying += (e.element->mean_inertia - e.element->least_inertia) * ratio * ratio;
  }
  return size;
}

void add_given_speeds(const Model& m, Size& size) {
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n) {
    if (m.network.nodes[n].prescribed < 0) continue;
    const PrescribedSpeed& given = m.network.prescribed[at(m.network.nodes[n].prescribed)];
    size.reaches(given.greatest() / m.scale_ratio[n]);
    size.reaches(given.amplitude / m.scale_ratio[n]);
  }
  const StartSettings& start = m.scene.run.start;
  const auto speed_of = [&](const std::string& component, double value) {
    const int node = component.empty() ? m.reduction_node : m.network.ports.at(component).in;
    size.reaches(value / m.scale_ratio[at(node)]);
  };
  if (start.speed != 0) speed_of(start.on, start.speed);
  for (const auto& [component, given] : start.components)
    if (given.speed) speed_of(component, *given.speed);
}

// Torque of the stiffest elastic joint at a small twist, referred to the link [N·m].
double torque_of_a_small_twist(const Model& m) {
  constexpr double small = 1e-3;  // [rad]
  double torque = 0;
  for (const ElasticJoint& e : m.elastic) {
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    torque = std::max(torque, joint.element->stiffness * small * m.scale_ratio[at(joint.a)]);
  }
  return torque;
}

// Squares of them must be numbers, too.
void check_scales(Compilation& c, double speed, double torque) {
  constexpr double beyond_reason = 1e100;
  if (speed < beyond_reason && torque < beyond_reason) return;
  std::string largest = c.net().components.front();
  double most = -1;
  for (const Network::ShaftElement& e : c.net().elements) {
    const Rated rated = e.element->rated;
    const double size = std::max(std::abs(rated.torque), std::abs(rated.speed));
    if (size > most) most = size, largest = e.component;
  }
  c.refuse(largest, fmt::format("the machine's torques reach {:.3g} N·m and its speeds {:.3g} rad/s; both must be "
                                "below {:g}; check the values and units of \"{}\"",
                                torque, speed, beyond_reason, largest));
  c.messages.throw_if_any();
}

}  // namespace

// Rated speed and torque, referred to the reduction link and from there to every shaft.
void find_scales(Compilation& c) {
  Model& m = c.model;
  Size size = rated_size(m);
  add_given_speeds(m, size);
  double speed = size.speed, torque = size.torque;
  if (torque == 0) torque = size.resisting;  // nothing drives: the loads set the scale
  if (speed == 0 && torque > 0) speed = std::sqrt(2 * torque * 2 * std::numbers::pi / size.inertia);  // after one turn
  if (speed == 0) speed = 1;
  // Where nothing drives by a torque and a speed is prescribed: at least (I mean − I least) ω², the torque of the inertia
  // that varies, and 1e-6 of I mean ω². Smaller loads are rounding beside these.
  constexpr double least = 1e-6;  // of the inertia's
  const double varying = std::max(size.varying, least * size.mechanisms);
  const auto moves = [](const PrescribedSpeed& given) { return !given.is_nothing(); };
  if (size.torque == 0 && std::any_of(m.network.prescribed.begin(), m.network.prescribed.end(), moves) &&
      (torque > 0 || size.varying == varying))
    torque = std::max(torque, varying * speed * speed);
  if (torque == 0) torque = 0.5 * size.inertia * speed * speed;  // kinetic energy per radian
  if (torque == 0) torque = torque_of_a_small_twist(m);          // all motions are given
  torque = std::max(torque, 1e-12);
  check_scales(c, speed, torque);
  m.speed_scale = speed;
  m.torque_scale = torque;
  for (Shaft& shaft : m.shafts) {
    const double ratio = m.scale_ratio[at(shaft.reference)];
    shaft.speed_scale = speed * ratio;
    shaft.torque_scale = torque / ratio;
  }
  for (ElasticJoint& e : m.elastic) {
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    const double stiffness = joint.element->stiffness;
    if (e.slips || e.springless) e.twist_scale = 1;
    if (stiffness > 0) e.twist_scale = torque / m.scale_ratio[at(joint.a)] / stiffness;
  }
}

}  // namespace kurbel
