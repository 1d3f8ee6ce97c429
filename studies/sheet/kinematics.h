// kinematics.h — motion of a mechanism at a position of its crank: output, pins, centres of mass, links.
//
// By its loop equations in closed form (mechanisms/loops/planar_linkage.h): with a function f of the crank's angle,
//     ḟ = f′ ω,      f̈ = f″ ω² + f′ ε
// f′ and f″ are called analogues of velocity and acceleration in textbooks.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/sheet/positions.h"

namespace kurbel {

struct MechanismOnSheet {
  Mechanism mechanism;
  double ratio = 1;  // its crank's speed over the link's

  double crank_angle(double phi) const { return ratio * phi + mechanism.phase; }
  // Positions of the joints in drawing order [m].
  std::vector<PlanePoint> joints(double crank_angle) const;
  std::string letter(std::size_t joint) const;  // "O", "A", "B" …
};

// The mechanisms of a machine, that of the reduction link first. Throws std::invalid_argument if there is none, or if
// a crank cannot rotate fully.
std::vector<MechanismOnSheet> mechanisms_of(const Model& model);

// Throws std::invalid_argument for a crank that only rocks.
void check_rotates(const Mechanism& mechanism);

// φ of the link at the dead centre of the mechanism's output nearest to φ = 0; 0 if there is none.
double dead_centre(const MechanismOnSheet& mechanism);

// Position, velocity and acceleration of a point, in the mechanism's axes [m], [m/s], [m/s²].
struct JointMotion {
  std::string name;  // "B", "S₂"
  PlanePoint place, velocity, acceleration;
};
struct LinkMotion {
  std::string name;                        // "rod"
  double angle = 0, omega = 0, alpha = 0;  // [rad], [rad/s], [rad/s²]
};
struct MechanismMotionAt {
  double crank = 0, omega = 0, alpha = 0;    // of its crank
  double output = 0, first = 0, second = 0;  // x, x′, x″ [m] or [rad]
  double velocity = 0, acceleration = 0;     // of the output
  std::vector<LinkMotion> links;             // all links, the crank first
  std::vector<JointMotion> pins, centres;    // moving pins; centres of mass of floating links
};
// At an angle of the link, which rotates with ω and ε.
MechanismMotionAt motion_at(const MechanismOnSheet& mechanism, double phi, double omega, double alpha);

}  // namespace kurbel
