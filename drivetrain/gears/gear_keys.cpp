// gear_keys.cpp — from the fields of a stage to its pair of wheels.
#include "drivetrain/gears/gear_keys.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kurbel {
namespace {

void check_geometry(const Reading<GearGeometryKeys>& g) {
  using Keys = GearGeometryKeys;
  if (g.is_given()) {
    has_two(g, &Keys::shifts);
    has_two(g, &Keys::tip_diameters);
    has_two(g, &Keys::bores);
    return;
  }
  for (const Key& key : gear_geometry_fields().keys())
    if (g.section().given(key.name)) {
      g.refuse(key.name, fmt::format("{} needs the module, e.g. module = \"4 mm\"", key.name));
      return;
    }
}

Fields<BasicRack> rack_fields() {
  return Fields<BasicRack>()
      .add(defaulted("pressure_angle", "rad", "20 deg", any_number, "α_n of the basic rack, 10 … 35 deg"),
           &BasicRack::pressure_angle)
      .add(defaulted("addendum", "", "1", positive, "h_a* of the basic rack, in modules"), &BasicRack::addendum)
      .add(defaulted("clearance", "", "0.25", not_negative, "c* of the basic rack"), &BasicRack::clearance)
      .add(defaulted("root_radius", "", "0.38", not_negative, "ρ_f* of the basic rack"), &BasicRack::root_radius);
}

std::array<std::optional<double>, 2> two_of(const std::optional<std::vector<double>>& list) {
  if (!list) return {};
  return {list->at(0), list->at(1)};
}

}  // namespace

std::string two_wanted(const std::string& key, std::size_t count) {
  return fmt::format("{} has {} value{}; must be two, driving wheel first", key, count, count == 1 ? "" : "s");
}

Key teeth_key() {
  return required("teeth", "", {.low = 1, .high = 100000}, "teeth of the driving and of the driven wheel");
}

Fields<GearGeometryKeys> gear_geometry_fields(const std::string& gap_effect) {
  using Keys = GearGeometryKeys;
  return Fields<Keys>()
      .add(quantity("module", "m", positive,
                    "normal module m_n: the stage is given by its teeth, and the inertias follow from width and "
                    "density"),
           &Keys::module)
      .add(quantity("width", "m", positive, "face width b of both wheels"), &Keys::width_of_both)
      .add(defaulted("helix", "rad", "0 deg", any_number, "helix angle β, −60 … 60 deg"), &Keys::helix)
      .add(quantity("shift", "", {.low = -3, .high = 3},
                    "profile shifts x of both wheels, in modules; default: 0, or by the centre distance, half each"),
           &Keys::shifts)
      .add(quantity("centre_distance", "m", positive, "a_w; default: by the shifts"), &Keys::centre_distance)
      .add(flag("internal", "false",
                "the driven wheel is internal; its shift counts as after ISO 21771, > 0 makes its teeth thicker"),
           &Keys::is_internal)
      .add(quantity("backlash", "m", not_negative, "allowance j_bn along the normal of the teeth", gap_effect),
           &Keys::allowance)
      .add(rack_fields(), &Keys::rack)
      .add(quantity("tip_diameter", "m", positive, "tip diameters, where they differ from the rack's"),
           &Keys::tip_diameters)
      .add(quantity("bore", "m", not_negative,
                    "bores of both wheels; of an internal one its outer diameter (\"0 mm\": rim of 3.5 modules)"),
           &Keys::bores)
      .add(defaulted("density", "kg/m3", "7850 kg/m3", positive, "of the wheels"), &Keys::density)
      .add(defaulted("elastic_modulus", "Pa", "206 GPa", positive, "of the wheels, for the mesh stiffness"),
           &Keys::young)
      .check(check_geometry);
}

std::optional<GearPair> gear_pair_of(const GearGeometryKeys& geometry, const std::vector<int>& teeth,
                                     const std::function<void(const std::string&)>& refuse) {
  const auto valid = [](const auto& list) { return !list || list->size() == 2; };
  if (!geometry.is_given() || !valid(geometry.shifts) || !valid(geometry.tip_diameters) || !valid(geometry.bores))
    return {};
  GearPairData d = geometry;
  d.teeth = {teeth.at(0), teeth.at(1) * (geometry.is_internal ? -1 : 1)};
  d.backlash = geometry.allowance.value_or(0);
  d.shift = two_of(geometry.shifts);
  d.tip_diameter = two_of(geometry.tip_diameters);
  if (geometry.bores) d.bore = {geometry.bores->at(0), geometry.bores->at(1)};
  d.width = {geometry.width_of_both, geometry.width_of_both};
  try {
    return solve_gear_pair(d);
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
    return {};
  }
}

}  // namespace kurbel
