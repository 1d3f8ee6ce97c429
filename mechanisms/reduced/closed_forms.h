// closed_forms.h — all mechanisms by their loop equations in closed form, in long double: the source of the second
// extraction. Nothing here knows Simbody, Newton's method or a difference that cancels near a change point.
//
// Positions by triangles; their sides' sums and differences are formed before anything is subtracted from them.
// Derivatives by Taylor series, I_r and M_g by theory 2.1 and 2.2 over all links.
#pragma once

#include <vector>

#include "mechanisms/bodies/linkage_bodies.h"
#include "mechanisms/linkages/four_bar.h"
#include "mechanisms/linkages/knuckle_press.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/linkages/quick_return.h"
#include "mechanisms/linkages/slider_crank_simbody.h"
#include "mechanisms/linkages/slotted_lever.h"
#include "mechanisms/loops/taylor.h"

namespace kurbel {

// A mechanism at φ as bodies and the joints between them, every length and angle a series in φ. Axes of the mechanism,
// origin on the crank's axis.
struct PlanarLinkage {
  static constexpr int frame = -1, most_bodies = 16;
  struct Body {
    const char* name;     // "crank"
    double mass;          // [kg]
    long double inertia;  // central [kg·m²]
    Path com;             // [m]
    Direction direction;  // of the link; a slider's that of its guide
  };
  // A reaction is what body `from` does to body `on`: a pin's two forces, or a slide's normal force and moment about
  // `at`.
  struct Joint {
    const char* name;  // "crank pin"
    int from, on;      // indices of bodies, or frame
    Path at;
    bool slides = false;
    Direction along = {};  // of the slide
  };
  PlanarLinkage() { bodies.reserve(5), joints.reserve(7); }
  std::vector<Body> bodies;  // the crank first, the one that the load acts on last
  std::vector<Joint> joints;
  int body_count = 0, joint_count = 0;
  bool rocks = false;                 // the load is a torque on the last body; else a force along +x on …
  Path load_at;                       // … this point of it
  double gravity = 0, elevation = 0;  // [m/s²]; of +x above the horizontal [rad]
  long double output[3] = {0, 0, 0};  // position and its derivatives by φ: [m] or [rad]
  // Of a linkage that passes change points: what is 0 there and of one sign between them; reactions go with its inverse.
  long double sine = 1;

  void add(const Body& body) { bodies.push_back(body), ++body_count; }
  void join(const Joint& joint) { joints.push_back(joint), ++joint_count; }
};

// For data without faults.
PlanarLinkage linkage_of(const SliderCrankData& data, long double phi);
PlanarLinkage linkage_of(const FourBarData& data, long double phi);
PlanarLinkage linkage_of(const QuickReturnData& data, long double phi);
PlanarLinkage linkage_of(const KnucklePressData& data, long double phi);
PlanarLinkage linkage_of(const SlottedLeverData& data, long double phi);
PlanarLinkage linkage_of(const LinkageData& data, long double phi);

// As a ReducedSample, which says what is what.
struct ClosedForm {
  long double inertia = 0, inertia_slope = 0, inertia_curvature = 0;
  long double output_position = 0, output_velocity_ratio = 0, output_acceleration_ratio = 0;
  long double gravity_torque = 0, gravity_torque_slope = 0, gravity_torque_scale = 0;
  long double potential_energy = 0;  // [J], zero at the height of the crank's axis
};

// For data without faults.
ClosedForm closed_form(const SliderCrankData& data, long double phi);
ClosedForm closed_form(const FourBarData& data, long double phi);
ClosedForm closed_form(const QuickReturnData& data, long double phi);
ClosedForm closed_form(const KnucklePressData& data, long double phi);
ClosedForm closed_form(const SlottedLeverData& data, long double phi);
ClosedForm closed_form(const LinkageData& data, long double phi);

}  // namespace kurbel
