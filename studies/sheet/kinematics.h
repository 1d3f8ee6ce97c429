// kinematics.h — how a mechanism of the machine moves at a position of its crank: output, pins, centres of mass, links.
//
// By its loop equations in closed form (mechanisms/loops/planar_linkage.h): with a function f of the crank's angle,
//     ḟ = f′ ω,      f̈ = f″ ω² + f′ ε
// f′ and f″ are what books call analogues of velocity and acceleration.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/sheet/positions.h"

namespace kurbel {

struct MechanismOnSheet {
  Mechanism mechanism;
  double ratio = 1;  // of its crank's speed to the link's

  double crank_angle(double phi) const { return ratio * phi + mechanism.phase; }
  // Of the joints in the drawing's order [m].
  std::vector<PlanePoint> joints(double crank_angle) const;
  std::string letter(std::size_t joint) const;  // "O", "A", "B" …
};

// Of a machine, that of the reduction link first. Throws std::invalid_argument where there is none, and where a crank
// cannot go through a whole turn.
std::vector<MechanismOnSheet> mechanisms_of(const Model& model);

// Throws std::invalid_argument for a crank that rocks.
void check_goes_round(const Mechanism& mechanism);

// φ of the link at a dead centre of the mechanism's output: of all of them the nearest to φ = 0; 0 where there is none.
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
  std::vector<LinkMotion> links;             // all, the crank first
  std::vector<JointMotion> pins, centres;    // those that move; of links that float
};
// At an angle of the link that turns with ω and ε.
MechanismMotionAt motion_at(const MechanismOnSheet& mechanism, double phi, double omega, double alpha);

}  // namespace kurbel
