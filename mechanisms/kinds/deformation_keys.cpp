// deformation_keys.cpp — tables of keys of gaps and of the flexible rod, and from them to their data.
#include "mechanisms/kinds/deformation_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

std::vector<Key> contact_keys(const char* gap) {
  return {{.name = "gap", .unit = "m", .domain = positive, .doc = gap, .required = true},
          {.name = "stiffness",
           .unit = "N/m",
           .domain = positive,
           .doc = "k of the contact: force over depth at a depth equal to the gap, N = k gap (depth/gap)ⁿ",
           .required = true},
          {.name = "exponent",
           .fallback = "1.5",
           .domain = {.low = 1, .high = 3},
           .doc = "n: 1.5 contact in a point (Hertz), 1 in a line"},
          {.name = "damping",
           .unit = "s/m",
           .domain = not_negative,
           .doc = "λ of Hunt and Crossley: N (1 + λ · approach speed); default: from restitution, else 0"},
          {.name = "restitution",
           .domain = {.low = 0, .high = 1, .low_open = true},
           .doc = "speed after over speed before a normal impact of restitution_speed; gives λ"},
          {.name = "restitution_speed", .unit = "m/s", .domain = positive, .doc = "that restitution belongs to"},
          {.name = "friction", .fallback = "0", .domain = not_negative, .doc = "μ of the contact"},
          {.name = "friction_speed",
           .unit = "m/s",
           .fallback = "\"1 mm/s\"",
           .domain = positive,
           .doc = "v₀ of friction force μ N tanh(v/v₀): it creeps below"}};
}

const std::vector<Kind>& clearance_kinds() {
  const auto pin = [](const char* name, const char* doc) {
    return Kind{.name = name,
                .doc = doc,
                .placement = Placement::nested,
                .keys = joined({contact_keys("radial clearance: bearing radius less pin radius"),
                                {{.name = "radius",
                                  .unit = "m",
                                  .fallback = "\"0 m\"",
                                  .domain = not_negative,
                                  .doc = "of the pin: lever of its friction"}}})};
  };
  static const std::vector<Kind> kinds = {
      pin("crank pin", "between crank and rod"),
      pin("wrist pin", "between rod and slider"),
      {.name = "guide",
       .doc = "slider between two surfaces that it touches with its corners; it may tilt",
       .placement = Placement::nested,
       .keys = joined({contact_keys("from each surface of the slider in the middle"),
                       {{.name = "length",
                         .unit = "m",
                         .domain = positive,
                         .doc = "of the slider along the guide, its pin in the middle",
                         .required = true},
                        {.name = "height",
                         .unit = "m",
                         .domain = positive,
                         .doc = "of the slider between the surfaces",
                         .required = true},
                        {.name = "inertia",
                         .unit = "kg*m2",
                         .domain = positive,
                         .doc = "of the slider about its pin, which is its centre of mass",
                         .required = true}}})}};
  return kinds;
}

const std::vector<Kind>& flexibility_kinds() {
  static const std::vector<Kind> kinds = {
      {.name = "prismatic",
       .doc = "the same section over the whole length; rod_mass is spread evenly",
       .placement = Placement::nested,
       .keys = {{.name = "modulus", .unit = "Pa", .domain = positive, .doc = "of elasticity E", .required = true},
                {.name = "height",
                 .unit = "m",
                 .domain = positive,
                 .doc = "of a rectangular section, in the plane of motion"},
                {.name = "width", .unit = "m", .domain = positive, .doc = "of a rectangular section, across it"},
                {.name = "area", .unit = "m2", .domain = positive, .doc = "of another section"},
                {.name = "second_moment",
                 .unit = "m4",
                 .domain = positive,
                 .doc = "of area of another section, for bending in the plane of motion"},
                {.name = "edge",
                 .unit = "m",
                 .domain = positive,
                 .doc = "outermost fibre from the axis, for the stress; default: height/2, else no stress is told"},
                {.name = "modes",
                 .type = KeyType::integer,
                 .fallback = "2",
                 .domain = {.low = 0, .high = RodFlexibility::most_modes},
                 .doc = "of bending, between the pins"},
                {.name = "stretching", .type = KeyType::flag, .fallback = "true", .doc = "it stretches, too"},
                {.name = "damping_ratio",
                 .fallback = "0",
                 .domain = {.low = 0, .high = 1, .high_open = true},
                 .doc = "of each mode of bending, and of stretching's first"}}}};
  return kinds;
}

JointClearance read_clearance(const Section& s, const std::string& what, Messages& messages) {
  JointClearance c;
  c.joint = s.kind->name == "crank pin"   ? JointClearance::Joint::crank_pin
            : s.kind->name == "wrist pin" ? JointClearance::Joint::wrist_pin
                                          : JointClearance::Joint::guide;
  c.contact = {.gap = s.number("gap"),
               .stiffness = s.number("stiffness"),
               .exponent = s.number("exponent"),
               .damping = s.number_or("damping", 0),
               .friction = s.number("friction"),
               .friction_speed = s.number("friction_speed")};
  if (s.has("damping") && s.has("restitution"))
    messages.add(s.where("restitution"), what + ": damping and restitution say the same twice; keep one");
  else if (s.has("restitution") != s.has("restitution_speed"))
    messages.add(
        s.where(s.has("restitution") ? "restitution" : "restitution_speed"),
        what + ": restitution depends on the speed of the impact; give both restitution and restitution_speed");
  else if (s.has("restitution"))
    c.contact.damping = JointContact::damping_for(s.number("restitution"), s.number("restitution_speed"));
  if (c.joint == JointClearance::Joint::guide) {
    c.half_length = s.number("length") / 2;
    c.half_height = s.number("height") / 2;
    c.slider_inertia = s.number("inertia");
  } else {
    c.pin_radius = s.number("radius");
  }
  return c;
}

std::optional<RodFlexibility> read_flexibility(const Section& s, const std::string& what, Messages& messages) {
  RodFlexibility rod{.modulus = s.number("modulus"),
                     .modes = static_cast<int>(s.number("modes")),
                     .axial = s["stretching"].flag,
                     .damping_ratio = s.number("damping_ratio")};
  const bool rectangle = s.has("height") && s.has("width"), other = s.has("area") && s.has("second_moment");
  if (rectangle == other || s.has("height") != s.has("width") || s.has("area") != s.has("second_moment")) {
    messages.add(s.at, what + ": its section is not clear; give height and width, or area and second_moment");
    return {};
  }
  if (rod.count() == 0) {
    messages.add(s.where("modes"),
                 what + ": modes = 0 without stretching leaves a rigid rod; raise modes, or leave it out");
    return {};
  }
  rod.area = rectangle ? s.number("height") * s.number("width") : s.number("area");
  const double height = s.number_or("height", 0);
  rod.second_moment = rectangle ? s.number("width") * height * height * height / 12 : s.number("second_moment");
  rod.edge = s.number_or("edge", height / 2);
  return rod;
}

}  // namespace

std::vector<Key> slider_crank_deformation_keys() {
  return {{.name = "clearance",
           .type = KeyType::sections,
           .doc = "gap in a joint, or a list of them",
           .nested = &clearance_kinds(),
           .effect = "joint_clearance"},
          {.name = "rod_flexibility",
           .type = KeyType::sections,
           .doc = "the rod bends and stretches",
           .nested = &flexibility_kinds(),
           .effect = "flexible_rod"}};
}

Deformation read_deformation(const Section& s, const SliderCrankData& data, Messages& messages) {
  Deformation deformation;
  const std::string who = fmt::format("slider-crank \"{}\": ", s.name);
  if (s.has("clearance")) {
    std::set<JointClearance::Joint> seen;
    for (const Section& table : s["clearance"].sections) {
      if (!table.sound) continue;
      deformation.clearances.push_back(read_clearance(table, who + "clearance", messages));
      const JointClearance& c = deformation.clearances.back();
      if (!seen.insert(c.joint).second)
        messages.add(table.at, fmt::format("{}clearance: the {} has two of them; keep one", who, c.name()));
    }
  }
  if (!s.has("rod_flexibility") || s["rod_flexibility"].sections.empty()) return deformation;
  const std::vector<Section>& tables = s["rod_flexibility"].sections;
  if (tables.size() != 1)
    messages.add(s.where("rod_flexibility"),
                 fmt::format("{}rod_flexibility = a list of {} tables; must be one table", who, tables.size()));
  else if (data.rod_mass <= 0)
    messages.add(s.where("rod_flexibility"),
                 who +
                     "rod_flexibility: the rod has no mass; give rod_mass, and rod_inertia (of a prismatic rod "
                     "rod_mass · rod²/12)");
  else if (tables.front().sound)
    deformation.flexibility = read_flexibility(tables.front(), who + "rod_flexibility", messages);
  return deformation;
}

}  // namespace kurbel
