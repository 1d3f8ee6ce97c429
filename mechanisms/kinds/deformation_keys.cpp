// deformation_keys.cpp — fields of gaps and of the flexible rod.
#include "mechanisms/kinds/deformation_keys.h"

#include <fmt/format.h>

#include <set>

namespace kurbel {
namespace {

// λ of the contact may be given by what is left of an impact's speed.
struct Contact : JointContact {
  std::optional<double> restitution, restitution_speed;  // [1], [m/s]
};

void check_contact(const Reading<Contact>& c) {
  if (c.given(&Contact::damping) && c.restitution)
    c.refuse(&Contact::restitution, "damping and restitution say the same twice; keep one");
  else if (c.restitution.has_value() != c.restitution_speed.has_value())
    c.refuse(c.restitution ? &Contact::restitution : &Contact::restitution_speed,
             "restitution depends on the speed of the impact; give both restitution and restitution_speed");
}

Fields<Contact> contact(const char* gap) {
  return Fields<Contact>()
      .add(required("gap", "m", positive, gap), &Contact::gap)
      .add(required("stiffness", "N/m", positive,
                    "k of the contact: force over depth at a depth equal to the gap, N = k gap (depth/gap)ⁿ"),
           &Contact::stiffness)
      .add(defaulted("exponent", "", "1.5", {.low = 1, .high = 3}, "n: 1.5 contact in a point (Hertz), 1 in a line"),
           &Contact::exponent)
      .add(quantity("damping", "s/m", not_negative,
                    "λ of Hunt and Crossley: N (1 + λ · approach speed); default: from restitution, else 0"),
           &Contact::damping)
      .add(quantity("restitution", "", {.low = 0, .high = 1, .low_open = true},
                    "speed after over speed before a normal impact of restitution_speed; gives λ"),
           &Contact::restitution)
      .add(quantity("restitution_speed", "m/s", positive, "that restitution belongs to"), &Contact::restitution_speed)
      .add(defaulted("friction", "", "0", not_negative, "μ of the contact"), &Contact::friction)
      .add(defaulted("friction_speed", "m/s", "1 mm/s", positive,
                     "v₀ of friction force μ N tanh(v/v₀): it creeps below"),
           &Contact::friction_speed)
      .derive([](Contact& c) {
        if (c.restitution && c.restitution_speed)
          c.damping = JointContact::damping_for(*c.restitution, *c.restitution_speed);
      })
      .check(check_contact);
}

Fields<JointClearance> pin_clearance() {
  return Fields<JointClearance>()
      .add(contact("radial clearance: bearing radius less pin radius"), &JointClearance::contact)
      .add(defaulted("radius", "m", "0 m", not_negative, "of the pin: lever of its friction"),
           &JointClearance::pin_radius);
}

Fields<JointClearance> guide_clearance() {
  return Fields<JointClearance>()
      .add(contact("from each surface of the slider in the middle"), &JointClearance::contact)
      .add(required("length", "m", positive, "of the slider along the guide, its pin in the middle"),
           &JointClearance::half_length, Scaled(0.5))
      .add(required("height", "m", positive, "of the slider between the surfaces"), &JointClearance::half_height,
           Scaled(0.5))
      .add(required("inertia", "kg*m2", positive, "of the slider about its pin, which is its centre of mass"),
           &JointClearance::slider_inertia);
}

const Tables<Reading<JointClearance>>& clearances() {
  using Joint = JointClearance::Joint;
  static const auto made =
      Tables<Reading<JointClearance>>()
          .add("crank pin", "between crank and rod", pin_clearance(), {.joint = Joint::crank_pin, .contact = {}})
          .add("wrist pin", "between rod and slider", pin_clearance(), {.joint = Joint::wrist_pin, .contact = {}})
          .add("guide", "slider between two surfaces that it touches with its corners; it may tilt", guide_clearance(),
               {.joint = Joint::guide, .contact = {}});
  return made;
}

// The section may be a rectangle, or anything else by its area and second moment.
struct RodKeys : RodFlexibility {
  std::optional<double> height, width;                        // [m]
  std::optional<double> another_area, another_second_moment;  // [m²], [m⁴]

  bool rectangle() const { return height && width; }
};

void check_rod(const Reading<RodKeys>& rod) {
  const bool other = rod.another_area && rod.another_second_moment;
  if (rod.rectangle() == other || rod.height.has_value() != rod.width.has_value() ||
      rod.another_area.has_value() != rod.another_second_moment.has_value())
    rod.refuse("its section is not clear; give height and width, or area and second_moment");
  else if (rod.count() == 0)
    rod.refuse(&RodKeys::modes, "modes = 0 without stretching leaves a rigid rod; raise modes, or leave it out");
}

Fields<RodKeys> prismatic_rod() {
  return Fields<RodKeys>()
      .add(required("modulus", "Pa", positive, "of elasticity E"), &RodKeys::modulus)
      .add(quantity("height", "m", positive, "of a rectangular section, in the plane of motion"), &RodKeys::height)
      .add(quantity("width", "m", positive, "of a rectangular section, across it"), &RodKeys::width)
      .add(quantity("area", "m2", positive, "of another section"), &RodKeys::another_area)
      .add(quantity("second_moment", "m4", positive, "of area of another section, for bending in the plane of motion"),
           &RodKeys::another_second_moment)
      .add(quantity("edge", "m", positive,
                    "outermost fibre from the axis, for the stress; default: height/2, else no stress is given"),
           &RodKeys::edge, [](const RodKeys& rod) { return rod.height.value_or(0) / 2; })
      .add(defaulted("modes", "", "2", {.low = 0, .high = RodFlexibility::most_modes}, "of bending, between the pins"),
           &RodKeys::modes)
      .add(flag("stretching", "true", "it stretches, too"), &RodKeys::axial)
      .add(defaulted("damping_ratio", "", "0", {.low = 0, .high = 1, .high_open = true},
                     "of each mode of bending, and of stretching's first"),
           &RodKeys::damping_ratio)
      .derive([](RodKeys& rod) {
        const double height = rod.height.value_or(0);
        rod.area = rod.rectangle() ? height * *rod.width : rod.another_area.value_or(0);
        rod.second_moment =
            rod.rectangle() ? *rod.width * height * height * height / 12 : rod.another_second_moment.value_or(0);
      })
      .check(check_rod);
}

const Tables<RodFlexibility>& flexible_rods() {
  static const auto made = Tables<RodFlexibility>().add(
      "prismatic", "the same section over the whole length; rod_mass is spread evenly", prismatic_rod());
  return made;
}

void check_deformation(const Reading<DeformationKeys>& d) {
  std::set<JointClearance::Joint> seen;
  for (const Reading<JointClearance>& c : d.clearances)
    if (!seen.insert(c.joint).second) c.refuse(fmt::format("the {} has two of them; keep one", c.name()));
}

}  // namespace

Fields<DeformationKeys> deformation_fields() {
  return Fields<DeformationKeys>()
      .add({.name = "clearance", .doc = "gap in a joint, or a list of them", .effect = "joint_clearance"},
           &DeformationKeys::clearances, clearances())
      .add({.name = "rod_flexibility", .doc = "the rod bends and stretches", .effect = "flexible_rod"},
           &DeformationKeys::flexibility, flexible_rods())
      .check(check_deformation);
}

std::shared_ptr<const DeformingParts> deforming_parts(const DeformationKeys& keys, const SliderCrankData& data,
                                                      const Section& section, Messages& messages) {
  if (keys.flexibility && data.rod_mass <= 0)
    messages.add(section.where("rod_flexibility"),
                 fmt::format("slider-crank \"{}\": rod_flexibility: the rod has no mass; give rod_mass, and "
                             "rod_inertia (of a prismatic rod rod_mass · rod²/12)",
                             section.name));
  if (keys.clearances.empty() && !keys.flexibility) return nullptr;
  auto parts = std::make_shared<Deformation>();
  parts->clearances.assign(keys.clearances.begin(), keys.clearances.end());
  parts->flexibility = keys.flexibility;
  return parts;
}

}  // namespace kurbel
