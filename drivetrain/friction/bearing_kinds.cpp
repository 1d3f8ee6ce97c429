// bearing_kinds.cpp — bearings with friction against the frame.
#include <fmt/format.h>

#include "drivetrain/friction/bearing.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/elements/no_element.h"
#include "engine/model/network.h"
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

enum class Model { exact, regularised, bristles };
const Words<Model>& models() {
  static const Words<Model> words = {
      {"exact", Model::exact}, {"regularised", Model::regularised}, {"LuGre", Model::bristles}};
  return words;
}
const char* name_of(Model model) { return models()[static_cast<std::size_t>(model)].first; }

struct BearingKeys {
  double torque = 0;                     // M_c [N·m]
  std::optional<double> static_torque;   // M_s [N·m]
  std::optional<double> stribeck_speed;  // ω_s [rad/s]
  double exponent = 2, damping = 0;      // n, b [N·m·s/rad]
  Model model = Model::exact;
  std::optional<double> creep_speed, bristle_stiffness, bristle_damping;  // ω_c, σ₀, σ₁
  double inertia = 0;                                                     // [kg·m²]
};

Fields<BearingKeys> bearing_fields() {
  using Keys = BearingKeys;
  return Fields<Keys>()
      .add(required("torque", "N*m", not_negative, "kinetic friction torque M_c", "bearing_friction"), &Keys::torque)
      .add(quantity("static_torque", "N*m", not_negative, "M_s that it holds at standstill; default: M_c"),
           &Keys::static_torque)
      .add(quantity("stribeck_speed", "rad/s", positive,
                    "ω_s, over which friction falls from M_s to M_c; default: at once"),
           &Keys::stribeck_speed)
      .add(defaulted("stribeck_exponent", "", "2", {.low = 0.5, .high = 10}, "n in exp(−(ω/ω_s)ⁿ)"), &Keys::exponent)
      .add(defaulted("damping", "N*m*s/rad", "0 N*m*s/rad", not_negative, "viscous part b"), &Keys::damping)
      .add(choice("model", "exact",
                  "exact: sticks and slips; regularised: smooth, creeps; LuGre: bristles bend before they slip"),
           &Keys::model, models())
      .add(quantity("creep_speed", "rad/s", positive, "ω_c of the regularised model, M = −g tanh(ω/ω_c)"),
           &Keys::creep_speed)
      .add(quantity("bristle_stiffness", "N*m/rad", positive, "σ₀ of LuGre"), &Keys::bristle_stiffness)
      .add(quantity("bristle_damping", "N*m*s/rad", not_negative, "σ₁ of LuGre; default: 0"), &Keys::bristle_damping)
      .add(own_inertia_key(), &Keys::inertia);
}

// Without a Stribeck speed the exact model falls from M_s to M_c at once; the smooth ones need the way between.
StribeckCurve curve_of(const Reading<BearingKeys>& b) {
  StribeckCurve curve{.kinetic = b.torque,
                      .breakaway = b.static_torque.value_or(b.torque),
                      .stribeck_speed = b.stribeck_speed.value_or(1),
                      .exponent = b.exponent,
                      .viscous = b.damping};
  if (curve.breakaway < curve.kinetic)
    b.refuse(&BearingKeys::static_torque,
             fmt::format("static_torque = {:g} N·m; must be ≥ torque = {:g} N·m", curve.breakaway, curve.kinetic));
  if (curve.breakaway > curve.kinetic && !b.stribeck_speed) {
    if (b.model != Model::exact)
      b.refuse(&BearingKeys::static_torque,
               fmt::format("static_torque > torque needs \"stribeck_speed\" with model = \"{}\"", name_of(b.model)));
    curve.stribeck_speed = 0;
  }
  return curve;
}

void build_bearing(const Section& s, const Reading<BearingKeys>& b, Network& net) {
  using Keys = BearingKeys;
  const int node = single_shaft(s, b.inertia, net);
  const StribeckCurve curve = curve_of(b);
  const std::pair<std::optional<double> Keys::*, Model> owners[] = {{&Keys::creep_speed, Model::regularised},
                                                                    {&Keys::bristle_stiffness, Model::bristles},
                                                                    {&Keys::bristle_damping, Model::bristles}};
  for (const auto& [member, owner] : owners)
    if (b.*member && b.model != owner)
      b.refuse(member, fmt::format("\"{}\" belongs to model = \"{}\"; here it is \"{}\"", b.key(member), name_of(owner),
                                   name_of(b.model)));
  if (b.model == Model::exact) {
    net.put(node, s.name, StickingBearing{curve});
  } else if (b.model == Model::regularised) {
    if (b.creep_speed)
      net.put(node, s.name, CreepingBearing{curve, *b.creep_speed, s.name});
    else
      b.refuse(&Keys::model, "model = \"regularised\" needs \"creep_speed\": it creeps with about that speed");
  } else if (!b.bristle_stiffness) {
    b.refuse(&Keys::model, "model = \"LuGre\" needs \"bristle_stiffness\", the stiffness of presliding");
  } else if (curve.kinetic == 0) {
    b.refuse(&Keys::torque, "torque = 0 N·m; must be > 0 with model = \"LuGre\"");
  } else {
    net.put(node, s.name, BristleBearing{curve, *b.bristle_stiffness, b.bristle_damping.value_or(0)});
  }
}

}  // namespace

std::vector<Kind> bearing_kinds() {
  return {
      kind_of<bearing_fields, build_bearing>(
          on_a_shaft, "bearing",
          "friction against the frame: Coulomb, Stribeck and viscous part; sticks at standstill"),
  };
}

}  // namespace kurbel
