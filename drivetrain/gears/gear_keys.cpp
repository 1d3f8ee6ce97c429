// gear_keys.cpp — from the keys of a stage to its pair of wheels.
#include "drivetrain/gears/gear_keys.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kurbel {
namespace {

// Two values, driving wheel first; empty where the key is not given.
std::array<std::optional<double>, 2> two_of(const Section& stage, const char* key, const std::string& what,
                                            Messages& messages) {
  if (!stage.has(key)) return {};
  const std::vector<double>& values = stage[key].numbers;
  if (values.size() == 2) return {values[0], values[1]};
  messages.add(stage.where(key), fmt::format("{}: {} has {} value{}; must be two, driving wheel first", what, key,
                                             values.size(), values.size() == 1 ? "" : "s"));
  return {};
}

// A key of the geometry that was given, or null.
const Setting* any_geometry(const Section& stage) {
  for (const Key& key : gear_geometry_keys())
    if (key.name != "module" && stage.given(key.name)) return stage.find(key.name);
  return nullptr;
}

}  // namespace

const std::vector<Key>& gear_geometry_keys() {
  static const std::vector<Key> keys = {
      {.name = "module",
       .unit = "m",
       .domain = positive,
       .doc = "normal module m_n: the stage is given by its teeth, and the inertias follow from width and density"},
      {.name = "width", .unit = "m", .domain = positive, .doc = "face width b of both wheels"},
      {.name = "helix", .unit = "rad", .fallback = "\"0 deg\"", .doc = "helix angle β, −60 … 60 deg"},
      {.name = "shift",
       .type = KeyType::quantities,
       .domain = {.low = -3, .high = 3},
       .doc = "profile shifts x of both wheels, in modules; default: 0, or by the centre distance, half each"},
      {.name = "centre_distance", .unit = "m", .domain = positive, .doc = "a_w; default: by the shifts"},
      {.name = "internal",
       .type = KeyType::flag,
       .fallback = "false",
       .doc = "the driven wheel is internal; its shift counts as after ISO 21771, > 0 makes its teeth thicker"},
      {.name = "backlash", .unit = "m", .domain = not_negative, .doc = "allowance j_bn along the normal of the teeth"},
      {.name = "pressure_angle", .unit = "rad", .fallback = "\"20 deg\"", .doc = "α_n of the basic rack, 10 … 35 deg"},
      {.name = "addendum", .fallback = "1", .domain = positive, .doc = "h_a* of the basic rack, in modules"},
      {.name = "clearance", .fallback = "0.25", .domain = not_negative, .doc = "c* of the basic rack"},
      {.name = "root_radius", .fallback = "0.38", .domain = not_negative, .doc = "ρ_f* of the basic rack"},
      {.name = "tip_diameter",
       .type = KeyType::quantities,
       .unit = "m",
       .domain = positive,
       .doc = "tip diameters, where they differ from the rack's"},
      {.name = "bore",
       .type = KeyType::quantities,
       .unit = "m",
       .domain = not_negative,
       .doc = "bores of both wheels; of an internal one its outer diameter (\"0 mm\": rim of 3.5 modules)"},
      {.name = "density", .unit = "kg/m3", .fallback = "\"7850 kg/m3\"", .domain = positive, .doc = "of the wheels"},
      {.name = "elastic_modulus",
       .unit = "Pa",
       .fallback = "\"206 GPa\"",
       .domain = positive,
       .doc = "of the wheels, for the mesh stiffness"},
  };
  return keys;
}

std::optional<GearPair> gear_pair_of(const Section& stage, const std::string& what, Messages& messages) {
  if (!stage.has("module")) {
    if (const Setting* given = any_geometry(stage))
      messages.add(given->at, fmt::format("{}: {} needs the module, e.g. module = \"4 mm\"", what, given->key));
    return {};
  }
  const std::vector<double>& teeth = stage["teeth"].numbers;
  const std::size_t before = messages.all().size();
  GearPairData d;
  d.module = stage.number("module");
  d.teeth = {static_cast<int>(teeth[0]), static_cast<int>(teeth[1]) * (stage["internal"].flag ? -1 : 1)};
  d.helix = stage.number("helix");
  d.rack = {stage.number("pressure_angle"), stage.number("addendum"), stage.number("clearance"),
            stage.number("root_radius")};
  d.shift = two_of(stage, "shift", what, messages);
  d.tip_diameter = two_of(stage, "tip_diameter", what, messages);
  const auto bore = two_of(stage, "bore", what, messages);
  d.bore = {bore[0].value_or(0), bore[1].value_or(0)};
  if (stage.has("centre_distance")) d.centre_distance = stage.number("centre_distance");
  d.backlash = stage.number_or("backlash", 0);
  d.width = {stage.number_or("width", 0), stage.number_or("width", 0)};
  d.density = stage.number("density");
  d.young = stage.number("elastic_modulus");
  if (messages.all().size() > before) return {};
  try {
    return solve_gear_pair(d);
  } catch (const std::invalid_argument& error) {
    messages.add(stage.where("module"), fmt::format("{}: {}", what, error.what()));
    return {};
  }
}

}  // namespace kurbel
