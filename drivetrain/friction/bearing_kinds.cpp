// bearing_kinds.cpp — bearings with friction against the frame.
#include <fmt/format.h>

#include "drivetrain/friction/bearing.h"
#include "drivetrain/friction/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"
#include "engine/model/no_element.h"
#include "engine/scene/effects.h"
#include "engine/scene/units.h"

namespace kurbel {

ShaftForm under(const StickingBearing&, const Effects& effects) {
  return effects.bearing_friction ? nullptr : no_element();
}
ShaftForm under(const CreepingBearing&, const Effects& effects) {
  return effects.bearing_friction ? nullptr : no_element();
}
ShaftForm under(const BristleBearing&, const Effects& effects) {
  return effects.bearing_friction ? nullptr : no_element();
}

std::string CreepingBearing::describe() const {
  return fmt::format("\"{}\" holds nothing, it creeps: under half of its static torque with {}", name,
                     with_unit(creep_speed * std::atanh(0.5), "rad/s", 3));
}

namespace {

constexpr const char* exact = "exact";
constexpr const char* regularised = "regularised";
constexpr const char* bristles = "LuGre";

void build_bearing(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const std::string& model = s.text("model");
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("bearing \"{}\": {}", s.name, text));
  };
  StribeckCurve curve{.kinetic = s.number("torque"),
                      .breakaway = s.number_or("static_torque", s.number("torque")),
                      .stribeck_speed = s.number_or("stribeck_speed", 1),
                      .exponent = s.number("stribeck_exponent"),
                      .viscous = s.number("damping")};
  if (curve.breakaway < curve.kinetic)
    refuse("static_torque",
           fmt::format("static_torque = {:g} N·m; must be ≥ torque = {:g} N·m", curve.breakaway, curve.kinetic));
  // Without a Stribeck speed the exact model falls from M_s to M_c at once; the smooth ones need the way between.
  const bool falls = curve.breakaway > curve.kinetic;
  if (falls && !s.given("stribeck_speed")) {
    if (model != exact)
      refuse("static_torque",
             fmt::format("static_torque > torque needs \"stribeck_speed\" with model = \"{}\"", model));
    curve.stribeck_speed = 0;
  }
  const std::pair<const char*, const char*> keys_of_models[] = {
      {"creep_speed", regularised}, {"bristle_stiffness", bristles}, {"bristle_damping", bristles}};
  for (const auto& [key, owner] : keys_of_models)
    if (s.given(key) && model != owner)
      refuse(key, fmt::format("\"{}\" belongs to model = \"{}\"; here it is \"{}\"", key, owner, model));
  if (model == exact) {
    net.put(node, s.name, StickingBearing{curve});
  } else if (model == regularised) {
    if (!s.given("creep_speed"))
      return refuse("model", "model = \"regularised\" needs \"creep_speed\": it creeps with about that speed");
    net.put(node, s.name, CreepingBearing{curve, s.number("creep_speed"), s.name});
  } else {
    if (!s.given("bristle_stiffness"))
      return refuse("model", "model = \"LuGre\" needs \"bristle_stiffness\", the stiffness of presliding");
    if (curve.kinetic == 0) return refuse("torque", "torque = 0 N·m; must be > 0 with model = \"LuGre\"");
    net.put(node, s.name, BristleBearing{curve, s.number("bristle_stiffness"), s.number_or("bristle_damping", 0)});
  }
}

}  // namespace

std::vector<Kind> bearing_kinds() {
  return {
      {.name = "bearing",
       .doc = "friction against the frame: Coulomb, Stribeck and viscous part; sticks at standstill",
       .keys =
           {{.name = "torque",
             .unit = "N*m",
             .domain = not_negative,
             .doc = "kinetic friction torque M_c",
             .required = true,
             .effect = "bearing_friction"},
            {.name = "static_torque",
             .unit = "N*m",
             .domain = not_negative,
             .doc = "M_s that it holds at standstill; default: M_c"},
            {.name = "stribeck_speed",
             .unit = "rad/s",
             .domain = positive,
             .doc = "ω_s, over which friction falls from M_s to M_c; default: at once"},
            {.name = "stribeck_exponent",
             .fallback = "2",
             .domain = {.low = 0.5, .high = 10},
             .doc = "n in exp(−(ω/ω_s)ⁿ)"},
            {.name = "damping",
             .unit = "N*m*s/rad",
             .fallback = "\"0 N*m*s/rad\"",
             .domain = not_negative,
             .doc = "viscous part b"},
            {.name = "model",
             .type = KeyType::text,
             .fallback = "\"exact\"",
             .doc = "exact: sticks and slips; regularised: smooth, creeps; LuGre: bristles bend before they slip",
             .choices = {exact, regularised, bristles}},
            {.name = "creep_speed",
             .unit = "rad/s",
             .domain = positive,
             .doc = "ω_c of the regularised model, M = −g tanh(ω/ω_c)"},
            {.name = "bristle_stiffness", .unit = "N*m/rad", .domain = positive, .doc = "σ₀ of LuGre"},
            {.name = "bristle_damping", .unit = "N*m*s/rad", .domain = not_negative, .doc = "σ₁ of LuGre; default: 0"},
            own_inertia_key()},
       .build = build_bearing},
  };
}

}  // namespace kurbel
