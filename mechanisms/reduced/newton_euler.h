// newton_euler.h — reactions, balancing torque and inertia forces of any mechanism with ideal joints: every link in
// equilibrium under its inertia force −m a and couple −I ε (d'Alembert; theory 9.6). Friction of the joints is added by
// mechanisms/joints/mechanism_statics.h.
//
// Axes of the mechanism: origin on the crank's axis, +x along stroke or ground, +y 90° ahead of it; moments and angles
// counter-clockwise. A reaction is what the body `from` does to the body `on`. For each link i, forces and moments
// about its centre of mass S:
//     Σ R + W + F = m a_S,     Σ (P − S) × R + Σ M = I ε_i
// 3 equations per link; unknowns: two for each joint (R_x, R_y of a pin; normal force N and moment of a slide) and the
// balancing torque on the crank. Solved in long double for five cases: ω² = 1, ε = 1, weights, unit load, other forces
// on links; every reaction is linear in these.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mechanisms/loops/planar.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {

using Force2 = Planar<double>;  // [N]

// A force on a body other than its weight and the load on the output.
struct AppliedForce {
  int body = 0;       // index in the linkage
  Force2 at, force;   // [m], [N]
  double moment = 0;  // [N·m]
};

// Angle and motion of the crank, load on the output (a force along +x at its pin [N], or a torque [N·m]), other forces on
// links.
struct LinkageState {
  double phi = 0, omega = 0, alpha = 0, load = 0;
  std::vector<AppliedForce> applied = {};
};

struct LinkForces {
  const char* name = "";
  double direction = 0;             // of the link; for a slider: of its guide [rad]
  Force2 com;                       // centre of mass [m]
  Force2 acceleration;              // of the centre of mass [m/s²]
  double omega = 0, alpha = 0;      // of the link [rad/s], [rad/s²]
  Force2 inertia_force;             // −m a [N]
  double inertia_couple = 0;        // −I ε, about its centre of mass [N·m]
  double reduced_inertia = 0;       // its part of I_r [kg·m²]
  double reduced_inertia_rate = 0;  // of I_r′ [kg·m²]
  double kinetic_energy = 0;        // ½ (its part of I_r) ω² [J]
};

struct JointForces {
  const char* name = "";
  const char *from = "frame", *on = "frame";  // names of the acting and the loaded body
  bool slides = false;
  Force2 at;          // position [m]
  double along = 0;   // direction of a slide [rad]
  Force2 force;       // of `from` on `on` [N]
  double normal = 0;  // of a slide: positive 90° ahead of its direction [N]
  double moment = 0;  // of a slide on `on`, about `at` [N·m]
  // Friction on `on`: couple of a pin [N·m], force along a slide [N], not included in `force`; its power loss [W], ≥ 0.
  double friction = 0, friction_power = 0;
  // If N acts outside the known length of a slide: contact at both ends, with these forces in front and behind [N].
  bool both_edges = false;
  double edge_front = 0, edge_back = 0;

  // Position of N along a slide from `at` [m]; infinite if N = 0.
  double point() const { return moment == 0 ? 0 : moment / normal; }
};

struct LinkageForces {
  LinkageState state;
  double output = 0, output_velocity = 0;  // [m] or [rad]
  std::vector<LinkForces> links;           // the crank first, the output last
  std::vector<JointForces> joints;         // empty: their reactions are undetermined
  double torque = 0;                       // of the shaft on the crank, positive counter-clockwise [N·m]
  Force2 shaking_force;                    // of all inertia forces, on the frame [N]
  double shaking_moment = 0;  // of all inertia forces and couples about the crank's axis, on the frame [N·m]
  double reduced_inertia = 0, kinetic_energy = 0;             // I_r [kg·m²]; T [J]
  double kinetic_rate = 0, weight_power = 0, load_power = 0;  // dT/dt and powers on the mechanism [W]; load
                                                              // power includes other forces on links
  double residual = 0;           // of the equations of ideal joints, relative to their largest terms
  double friction_residual = 0;  // of the friction laws, relative to the largest friction load

  double friction_loss() const;                        // of all joints [W]
  double friction_loss(std::string_view joint) const;  // of the joints with this name [W]
};

// Of a linkage with redundant closures no joints, as their reactions are undetermined, and the torque by the powers (ω ≠ 0).
// Throws std::runtime_error with the numbers if the equations are singular: in a position in which the crank cannot move
// the mechanism.
LinkageForces forces_in(const PlanarLinkage& linkage, const LinkageState& state);
// Only the links and the sums over them: no reactions, no torque, no powers of loads and weights.
LinkageForces motion_in(const PlanarLinkage& linkage, const LinkageState& state);

// Unit friction load of a joint on its body `on`, with the reaction on `from`: a couple of 1 N·m, or 1 N along a slide.
struct FrictionPlace {
  int joint = 0;
  bool couple = true;
};
// R_x, R_y [N] of each joint in order, for a slide its normal force [N] and moment [N·m]; last the balancing torque [N·m].
// One column each for ω² = 1, ε = 1, weights, unit load, every applied force, every friction load alone (theory 10.2).
std::vector<std::vector<long double>> unit_reactions(const PlanarLinkage& linkage,
                                                     std::span<const FrictionPlace> friction,
                                                     std::span<const std::vector<AppliedForce>> applied = {});

// The linkage at φ; of a mechanism that passes change points: at φ itself, or if it lies nearer to one than a thousandth of what the sine there
// changes by in a radian, the place at that distance on its side. Reactions go with the inverse of the distance.
PlanarLinkage linkage_beside(const MechanismData& data, double& phi);

// Reactions that are unbounded at change points, found from positions at two distances from each.
struct UnboundedReactions {
  std::vector<double> at;      // φ [rad]
  std::vector<bool> of_joint;  // in the order of the linkage's joints
  double beside = 0;           // distance from the change point [rad] …
  double greatest = 0;         // … at which the largest of them has this value [N]
  std::string words;           // with the numbers; empty: none
  bool any() const { return !at.empty(); }
};
UnboundedReactions unbounded_reactions(const MechanismData& data,
                                       const std::function<LinkageState(double phi)>& state_at);

}  // namespace kurbel
