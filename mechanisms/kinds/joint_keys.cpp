// joint_keys.cpp — fields of the joints.
#include "mechanisms/kinds/joint_keys.h"

#include <fmt/format.h>

namespace kurbel {
namespace {

using Friction = FrictionCoefficient;

void check_friction(const Reading<Friction>& f) {
  if (f.resting < f.kinetic)
    f.refuse(&Friction::resting,
             fmt::format("static_friction = {:g}; must be ≥ friction = {:g}, else standing still would be easier to "
                         "leave than to keep",
                         f.resting, f.kinetic));
}

Fields<Friction> friction() {
  return Fields<Friction>()
      .add(defaulted("friction", "", "0", not_negative,
                     "coefficient of kinetic friction; of a rolling bearing its equivalent one (0.001 … 0.005)",
                     "joint_friction"),
           &Friction::kinetic)
      .add(quantity("static_friction", "", not_negative, "≥ friction; default: the same"), &Friction::resting,
           &Friction::kinetic)
      .add(
          defaulted("stribeck_speed", "m/s", "0 m/s", not_negative,
                    "sliding speed v_s within which static friction falls to kinetic: f + (f_s − f) exp(−(v/v_s)²); 0: "
                    "at once"),
          &Friction::stribeck_speed)
      .add(defaulted("viscous_friction", "s/m", "0 s/m", not_negative,
                     "rise of the coefficient with sliding speed (fluid friction)"),
           &Friction::viscous)
      .check(check_friction);
}

const Tables<RevoluteJoint>& journals() {
  static const auto made = Tables<RevoluteJoint>().add(
      "journal",
      "journal or pin in its bearing; friction torque is ρ times the reaction, ρ = r sin(atan f) the radius of the "
      "friction circle",
      Fields<RevoluteJoint>()
          .add(required("radius", "m", positive, "of the journal; of a rolling bearing half its bore"),
               &RevoluteJoint::radius)
          .add(friction(), &RevoluteJoint::friction));
  return made;
}

void check_guide(const Reading<SliderGuide>& guide) {
  if (guide.rolling_arm > 0 && guide.roller_radius == 0)
    guide.refuse(&SliderGuide::rolling_arm, "rolling_arm without roller_radius; give the rollers' radius");
}

Fields<SliderGuide> guide() {
  return Fields<SliderGuide>()
      .add(friction(), &SliderGuide::friction)
      .add(defaulted("length", "m", "0 m", not_negative,
                     "bearing length of the slider; 0: its tilting is not considered"),
           &SliderGuide::length)
      .add(defaulted("middle", "m", "0 m", any_number, "of that length, from the slider pin towards the extended end"),
           &SliderGuide::middle)
      .add(defaulted("width", "m", "0 m", not_negative,
                     "between the two guiding surfaces (bore of a cylinder): lever of their friction"),
           &SliderGuide::width)
      .add(defaulted("rolling_arm", "m", "0 m", not_negative,
                     "lever arm k_r of rolling friction, for a slider on rollers"),
           &SliderGuide::rolling_arm)
      .add(quantity("roller_radius", "m", positive, "of these rollers"), &SliderGuide::roller_radius)
      .add(defaulted("slider_com", "m", "0 m", any_number,
                     "slider's centre of mass from its pin towards the extended end"),
           &SliderGuide::com_x)
      .add(defaulted("force_offset", "m", "0 m", any_number,
                     "of the load's line from the slider pin, positive 90° ahead of the stroke"),
           &SliderGuide::force_offset)
      .check(check_guide);
}

const Tables<SliderGuide>& guides() {
  static const auto made = Tables<SliderGuide>().add(
      "guide", "of the slider: friction f N, from both edges where the reaction leaves the guide's length", guide());
  return made;
}

}  // namespace

Fields<SliderCrankJoints> joint_fields() {
  using Joints = SliderCrankJoints;
  return Fields<Joints>()
      .add({.name = "main_bearing", .doc = "bearing of the crank"}, &Joints::main_bearing, journals())
      .add({.name = "crank_pin", .doc = "pin between crank and rod"}, &Joints::crank_pin, journals())
      .add({.name = "slider_pin", .doc = "pin between rod and slider"}, &Joints::slider_pin, journals())
      .add({.name = "guide", .doc = "guide of the slider"}, &Joints::guide, guides());
}

}  // namespace kurbel
