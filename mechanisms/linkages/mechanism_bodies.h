// mechanism_bodies.h — a mechanism of one degree of freedom as a multibody system: the reference for all reduced functions
// of its crank angle φ.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/loops/planar.h"

namespace kurbel {

// Mass properties of a link. The centre of mass lies on the link's axis.
struct LinkBody {
  double mass = 0;     // [kg], ≥ 0
  double com = 0;      // centre of mass from the link's first joint along the link [m]
  double inertia = 0;  // links on a fixed bearing: about the bearing, ≥ mass com²; others: central [kg·m²], ≥ 0
};

// Reduced functions at one configuration; primes are derivatives by φ, all from Simbody's bodies and constraints. The
// output is the loaded link: it slides (position in m) or rocks (angle in rad).
struct ReducedSample {
  double inertia, inertia_slope, inertia_curvature;  // I_r [kg·m²] (theory 2.1), I_r′, I_r″
  double output_position;                            // x [m] or ψ [rad]
  double output_velocity_ratio;                      // x′ = v/ω [m/rad], ψ′ [1]
  double output_acceleration_ratio;                  // x″ [m/rad²], ψ″ [1/rad]
  double gravity_torque, gravity_torque_slope;  // of all weights on the crank [N·m], positive when it drives; by φ
  double gravity_torque_scale;  // Σ weight · |velocity ratio| [N·m]: the scale of its rounding errors
  double closure_determinant;   // of the loop closures, with the sign that is > 0 on the right branch
};

// A point in the mechanism's axes.
struct PlanePoint {
  double x, y;  // [m]
};

// Drawing of a mechanism by places on its links, and the type of its output.
struct LinkageDrawing {
  struct Link {
    // "crank", "link", "slot": a line; "slider", "point" on a joint; "block" on a joint, along the next
    std::string shape;
    std::vector<int> joints;  // its places
  };
  std::string name;
  double direction = 0;                 // of +x above the horizontal [rad]
  std::vector<int> places = {};         // its joints in the PlanarLinkage; empty: given by places_of
  std::vector<Link> links;              // in the order of drawing
  std::vector<int> fixed;               // places that are bearings in the frame
  int output = 0;                       // place of the load
  bool rocks = false;                   // the output is an angle
  std::vector<std::string> names = {};  // of the places; empty: O, A, B …
};

// A tracked point of a body, and the body's rotation as the sum of its pins' angles, with derivatives by φ.
struct TrackedMotion {
  Planar<double> position, velocity_ratio, acceleration_ratio;                        // [m], [m/rad], [m/rad²]
  double rotation = 0, rotation_velocity_ratio = 0, rotation_acceleration_ratio = 0;  // [rad], [1], [1/rad]
};

// Simbody's model of a mechanism, evaluated at single configurations. Takes some 20 µs per sample; not thread-safe.
// All members throw std::runtime_error with the numbers if a loop does not close or closes on the wrong branch.
class MechanismBodies {
 public:
  virtual ~MechanismBodies() = default;

  virtual ReducedSample sample(double phi) = 0;
  // The same with given initial values of Newton's method: the coordinates after the crank's, in the order of the joints.
  virtual ReducedSample sample_from(double phi, const std::vector<double>& start) = 0;

  // Summed by Simbody over its moving bodies, without I_r.
  virtual double kinetic_energy(double phi, double omega) = 0;  // [J]
  // Of all weights; zero at the height of the crank's axis.
  virtual double potential_energy(double phi) = 0;  // [J]

  // What BodiesOf::tracked names, in its order, at the last sample.
  virtual std::vector<TrackedMotion> tracked() const { return {}; }
};

}  // namespace kurbel
