// joint_keys.cpp — tables of keys of the joints, and from them to the joints' data.
#include "mechanisms/kinds/joint_keys.h"

#include <fmt/format.h>

#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

std::vector<Key> friction_keys() {
  return {{.name = "friction",
           .fallback = "0",
           .domain = not_negative,
           .doc = "coefficient of kinetic friction; of a rolling bearing its equivalent one (0.001 … 0.005)",
           .effect = "joint_friction"},
          {.name = "static_friction", .domain = not_negative, .doc = "≥ friction; default: the same"},
          {.name = "stribeck_speed",
           .unit = "m/s",
           .fallback = "\"0 m/s\"",
           .domain = not_negative,
           .doc = "sliding speed v_s within which static friction falls to kinetic: f + (f_s − f) exp(−(v/v_s)²); 0: "
                  "at once"},
          {.name = "viscous_friction",
           .unit = "s/m",
           .fallback = "\"0 s/m\"",
           .domain = not_negative,
           .doc = "rise of the coefficient with sliding speed (fluid friction)"}};
}

const std::vector<Kind>& revolute_kinds() {
  static const std::vector<Kind> kinds = {
      {.name = "journal",
       .doc = "journal or pin in its bearing; friction torque is ρ times the reaction, ρ = r sin(atan f) the radius of "
              "the friction circle",
       .placement = Placement::nested,
       .keys = joined({{{.name = "radius",
                         .unit = "m",
                         .domain = positive,
                         .doc = "of the journal; of a rolling bearing half its bore",
                         .required = true}},
                       friction_keys()})}};
  return kinds;
}

const std::vector<Kind>& guide_kinds() {
  static const std::vector<Kind> kinds = {
      {.name = "guide",
       .doc = "of the slider: friction f N, from both edges where the reaction leaves the guide's length",
       .placement = Placement::nested,
       .keys = joined({friction_keys(),
                       {{.name = "length",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .domain = not_negative,
                         .doc = "bearing length of the slider; 0: its tilting is not considered"},
                        {.name = "middle",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .doc = "of that length, from the slider pin towards the extended end"},
                        {.name = "width",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .domain = not_negative,
                         .doc = "between the two guiding surfaces (bore of a cylinder): lever of their friction"},
                        {.name = "rolling_arm",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .domain = not_negative,
                         .doc = "lever arm k_r of rolling friction, for a slider on rollers"},
                        {.name = "roller_radius", .unit = "m", .domain = positive, .doc = "of these rollers"},
                        {.name = "slider_com",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .doc = "slider's centre of mass from its pin towards the extended end"},
                        {.name = "force_offset",
                         .unit = "m",
                         .fallback = "\"0 m\"",
                         .doc = "of the load's line from the slider pin, positive 90° ahead of the stroke"}}})}};
  return kinds;
}

// Null where the joint is not in the scene.
const Section* table_of(const Section& section, const char* joint) {
  if (!section.has(joint) || section[joint].sections.empty()) return nullptr;
  return &section[joint].sections.front();
}

FrictionCoefficient read_friction(const Section& s) {
  const double kinetic = s.number("friction");
  return {kinetic, s.number_or("static_friction", kinetic), s.number("stribeck_speed"), s.number("viscous_friction")};
}

RevoluteJoint read_revolute(const Section* s) {
  return s ? RevoluteJoint{s->number("radius"), read_friction(*s)} : RevoluteJoint{};
}

SliderGuide read_guide(const Section* s) {
  if (!s) return {};
  return {.friction = read_friction(*s),
          .length = s->number("length"),
          .middle = s->number("middle"),
          .width = s->number("width"),
          .rolling_arm = s->number("rolling_arm"),
          .roller_radius = s->number_or("roller_radius", 0),
          .com_x = s->number("slider_com"),
          .force_offset = s->number("force_offset")};
}

}  // namespace

std::vector<Key> slider_crank_joint_keys() {
  const auto revolute = [](const char* name, const char* doc) {
    return Key{.name = name, .type = KeyType::sections, .doc = doc, .nested = &revolute_kinds()};
  };
  return {revolute("main_bearing", "bearing of the crank"),
          revolute("crank_pin", "pin between crank and rod"),
          revolute("slider_pin", "pin between rod and slider"),
          {.name = "guide", .type = KeyType::sections, .doc = "guide of the slider", .nested = &guide_kinds()}};
}

SliderCrankJoints slider_crank_joints(const Section& s) {
  return {read_revolute(table_of(s, "main_bearing")), read_revolute(table_of(s, "crank_pin")),
          read_revolute(table_of(s, "slider_pin")), read_guide(table_of(s, "guide"))};
}

SliderCrankData slider_crank_data(const Section& s) {
  SliderCrankData d;
  d.radius = s.number("radius");
  d.rod_length = s.number("rod");
  d.offset = s.number("offset");
  d.crank_mass = s.number("crank_mass");
  d.crank_com = s.number("crank_com");
  d.crank_inertia = s.number("crank_inertia");
  d.rod_mass = s.number("rod_mass");
  d.rod_com = s.number_or("rod_com", d.rod_length / 2);
  d.rod_inertia = s.number("rod_inertia");
  d.slider_mass = s.number("slider_mass");
  d.gravity = s.number("gravity");
  d.stroke_angle = s.number("stroke_angle");
  return d;
}

bool check_joints(const Section& s, Messages& messages) {
  const std::size_t before = messages.all().size();
  bool sound = true;
  for (const char* joint : {"main_bearing", "crank_pin", "slider_pin", "guide"}) {
    if (!s.has(joint)) continue;
    const std::string what = fmt::format("slider-crank \"{}\": {}", s.name, joint);
    const std::vector<Section>& tables = s[joint].sections;
    if (tables.size() != 1)
      messages.add(s.where(joint), fmt::format("{} = a list of {} tables; must be one table", what, tables.size()));
    sound = sound && tables.size() == 1 && tables.front().sound;
    if (tables.size() != 1 || !tables.front().sound) continue;
    const Section& table = tables.front();
    if (table.has("static_friction") && table.number("static_friction") < table.number("friction"))
      messages.add(table.where("static_friction"),
                   fmt::format("{}: static_friction = {:g}; must be ≥ friction = {:g}, else standing still would be "
                               "easier to leave than to keep",
                               what, table.number("static_friction"), table.number("friction")));
    if (std::string(joint) == "guide" && table.number("rolling_arm") > 0 && !table.has("roller_radius"))
      messages.add(table.where("rolling_arm"),
                   fmt::format("{}: rolling_arm without roller_radius; give the rollers' radius", what));
  }
  return sound && messages.all().size() == before;
}

}  // namespace kurbel
