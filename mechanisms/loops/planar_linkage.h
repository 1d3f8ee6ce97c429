// planar_linkage.h — a mechanism at one crank angle as bodies and joints with their series in φ: the common source of its
// Simbody model, its reduced functions and its reactions.
#pragma once

#include <vector>

#include "mechanisms/loops/taylor.h"

namespace kurbel {

// A mechanism at φ as bodies and joints; all lengths and angles are series in φ. Axes of the mechanism, origin on the
// crank's axis.
struct PlanarLinkage {
  static constexpr int frame = -1, most_bodies = 16;
  struct Body {
    const char* name;     // "crank"
    double mass;          // [kg]
    long double inertia;  // central [kg·m²]
    Path com;             // [m]
    Direction direction;  // of the link; for a slider: of its guide
  };
  // A reaction acts from body `from` on body `on`: the two force components of a pin, or the normal force of a slide and its
  // moment about `at`.
  struct Joint {
    const char* name;  // "crank pin"
    int from, on;      // indices of bodies, or frame
    Path at;
    bool slides = false;
    Direction along = {};          // direction of the slide
    bool from_is_between = false;  // of a slide: `from` lies between the faces of `on`, not the other way round
  };
  PlanarLinkage() { bodies.reserve(5), joints.reserve(7); }
  std::vector<Body> bodies;  // the crank first, the loaded body last
  std::vector<Joint> joints;
  int body_count = 0, joint_count = 0;
  bool rocks = false;                 // the load is a torque on the last body; else a force along +x at …
  Path load_at;                       // … this point of it
  double gravity = 0, elevation = 0;  // [m/s²]; of +x above the horizontal [rad]
  long double output[3] = {0, 0, 0};  // position and its derivatives by φ: [m] or [rad]
  bool stands_still = false;          // the output never moves: its motion is set to zero instead of rounding errors
  // With change points: zero there and of constant sign between them; reactions are proportional to the inverse.
  bool changes = false, turns_over = true;  // turns_over: the determinant of the closures changes its sign with it
  long double sine = 1;

  void add(const Body& body) { bodies.push_back(body), ++body_count; }
  void join(const Joint& joint) { joints.push_back(joint), ++joint_count; }
};

// Its reduced functions by sums over the links (theory 2.1, 2.2); members as in ReducedSample:
//     I_r = Σ m v_S′² + J ϑ′²,   M_g = −g Σ m h_S′,   each with its derivatives by φ from the links' Taylor series.
struct ClosedForm {
  long double inertia = 0, inertia_slope = 0, inertia_curvature = 0;
  long double output_position = 0, output_velocity_ratio = 0, output_acceleration_ratio = 0;
  long double gravity_torque = 0, gravity_torque_slope = 0, gravity_torque_scale = 0;
  long double potential_energy = 0;  // [J], zero at the height of the crank's axis
};
ClosedForm closed_form_of(const PlanarLinkage& linkage);

// A function of φ with its first derivative by φ.
template <class T>
struct ValueAndSlope {
  T value, slope;
};

}  // namespace kurbel
