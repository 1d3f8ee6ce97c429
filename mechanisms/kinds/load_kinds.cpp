// load_kinds.cpp — keys of loads on a mechanism's output.
#include "mechanisms/kinds/load_kinds.h"

#include <string>

namespace kurbel {
namespace {

using namespace load_keys;

// --- keys that several loads have ---

Key working_end_key() {
  return choice("working_end", "extended", "end of the stroke that the distance is counted from");
}
Words<bool> stroke_ends() { return {{"extended", true}, {"folded", false}}; }

Key swing_end_key() { return choice("working_end", "greatest", "end of the swing that the distance is counted from"); }
Words<bool> swing_ends() { return {{"greatest", true}, {"least", false}}; }

Key work_key() { return choice("work", "useful", "line of the energy balance"); }
Words<Account> accounts() {
  return {{"useful", Account::useful}, {"harmful", Account::harmful}, {"driving", Account::driving}};
}

Key rounding_key(const char* name, const char* unit) {
  return quantity(name, unit, positive,
                  "width that edges are rounded over, of the same area, when the effect load_edges is off",
                  "load_edges");
}

// --- on outputs that slide ---

Fields<PressLoad> press() {
  return Fields<PressLoad>()
      .add(required("nominal_force", "N", not_negative, "force F_n against the motion"), &PressLoad::force)
      .add(required("nominal_travel", "m", positive, "distance before the working end where the force begins"),
           &PressLoad::travel)
      .add(defaulted("rise", "m", "0 mm", not_negative, "travel within which the force rises; 0: an edge"),
           &PressLoad::rise)
      .add(defaulted("breakthrough", "m", "0 mm", not_negative,
                     "distance before the end where the work breaks through; 0: force lasts to the end"),
           &PressLoad::breakthrough)
      .add(defaulted("drop", "m", "0 mm", not_negative, "travel within which the force falls after break-through"),
           &PressLoad::drop)
      .add(rounding_key("rounding", "m"), &PressLoad::rounding)
      .add(working_end_key(), &PressLoad::from_greatest, stroke_ends())
      .add(work_key(), &PressLoad::account, accounts());
}

// Magnitudes of loads of one number or two: a force on what slides, a torque on what rocks.
Fields<Constant> constant(const char* name, const char* unit, const char* doc) {
  return Fields<Constant>()
      .add(required(name, unit, any_number, doc), &Constant::force)
      .add(work_key(), &Constant::account, accounts());
}
Fields<Opposing> opposing(const char* name, const char* unit) {
  return Fields<Opposing>()
      .add(required(name, unit, not_negative, "magnitude"), &Opposing::force)
      .add(work_key(), &Opposing::account, accounts());
}
Fields<Medium> medium(const std::string& viscous_unit, const std::string& quadratic_unit) {
  return Fields<Medium>()
      .add(defaulted("viscous", viscous_unit, "0 " + viscous_unit, not_negative, "c"), &Medium::viscous)
      .add(defaulted("quadratic", quadratic_unit, "0 " + quadratic_unit, not_negative, "q"), &Medium::quadratic)
      .add(work_key(), &Medium::account, accounts());
}

template <class K>
Fields<K> with_misfire(Fields<K> fields, const char* unit) {
  return fields
      .add(flag("misfire", "false", "of a diagram over the crank angle: the cylinder does not fire"), &K::misfire)
      .add(curve("motored", {"angle"}, unit,
                 "the diagram of a cylinder that does not fire; default: its compression, mirrored about 0 deg, the "
                 "top dead centre"),
           &K::motored);
}

Fields<Table> table() {
  return with_misfire(Fields<Table>()
                          .add(required_curve("force", {"travel", "angle"}, "N",
                                              "positive pushes the slider away from the working end; over the distance "
                                              "to that end (return_points: branch of the other stroke) or over the "
                                              "crank angle (span up to 360 deg, or 720 deg for four strokes)"),
                               &Table::force)
                          .add(rounding_key("rounding", "m"), &Table::rounding)
                          .add(rounding_key("rounding_angle", "rad"), &Table::rounding_angle)
                          .add(working_end_key(), &Table::from_greatest, stroke_ends())
                          .add(work_key(), &Table::account, accounts()),
                      "N");
}

Fields<Compressor> compressor() {
  return Fields<Compressor>()
      .add(required("bore", "m", positive, "diameter of the piston"), &Compressor::bore)
      .add(required("suction_pressure", "Pa", positive, "p₁, absolute"), &Compressor::suction)
      .add(required("delivery_pressure", "Pa", positive, "p₂, absolute"), &Compressor::delivery)
      .add(quantity("outside_pressure", "Pa", not_negative,
                    "on the other face of the piston, absolute; default: suction_pressure"),
           &Compressor::outside, &Compressor::suction)
      .add(required("clearance", "", positive, "clearance volume over swept volume, e.g. 0.05"), &Compressor::clearance)
      .add(defaulted("compression_exponent", "", "1.3", positive,
                     "polytropic exponent n: 1 isothermal, 1.4 adiabatic for air"),
           &Compressor::compression_exponent)
      .add(quantity("expansion_exponent", "", positive,
                    "polytropic exponent of the re-expansion; default: compression_exponent"),
           &Compressor::expansion_exponent, &Compressor::compression_exponent)
      .add(working_end_key(), &Compressor::from_greatest, stroke_ends())
      .add(work_key(), &Compressor::account, accounts());
}

Words<Account> driving_accounts() {
  return {{"driving", Account::driving}, {"useful", Account::useful}, {"harmful", Account::harmful}};
}
Key driving_work_key() { return choice("work", "driving", "line of the energy balance"); }

Fields<Cylinder> cylinder() {
  return with_misfire(
      Fields<Cylinder>()
          .add(required("bore", "m", positive, "diameter of the piston"), &Cylinder::bore)
          .add(defaulted("rod_diameter", "m", "0 m", not_negative,
                         "of the piston rod, on the side away from the working end"),
               &Cylinder::rod)
          .add(required_curve(
                   "pressure", {"travel", "angle"}, "Pa",
                   "absolute, in the chamber at the working end, which pushes the slider away from it; over the "
                   "distance to that end (return_points: while the slider moves away) or over the crank angle"),
               &Cylinder::pressure)
          .add(curve("pressure_behind", {"travel", "angle"}, "Pa",
                     "the same in the other chamber, over the same distance or angle; without: outside_pressure"),
               &Cylinder::behind)
          .add(defaulted("outside_pressure", "Pa", "101325 Pa", not_negative,
                         "absolute, on the rod and on the piston's other face where there is no second chamber"),
               &Cylinder::outside)
          .add(working_end_key(), &Cylinder::from_greatest, stroke_ends())
          .add(driving_work_key(), &Cylinder::account, driving_accounts()),
      "Pa");
}

Fields<LinearMotor> linear_motor() {
  return Fields<LinearMotor>()
      .add(required("stall_force", "N", positive, "F₀ at standstill"), &LinearMotor::force)
      .add(required("no_load_velocity", "m/s", positive, "v₀ in F = F₀ (σ − v/v₀)"), &LinearMotor::velocity)
      .add(choice("pushes", "with motion", "σ: with the motion, nothing at standstill; or always towards one end"),
           &LinearMotor::sense, {{"with motion", 0}, {"extended", 1}, {"folded", -1}})
      .add(driving_work_key(), &LinearMotor::account, driving_accounts());
}

// --- on outputs that rock ---

Fields<Table> rocker_table() {
  return Fields<Table>()
      .add(required_curve(
               "torque", {"swing", "angle"}, "N*m",
               "positive pushes the output away from the working end; over the angle to that end (return_points: "
               "branch of the other stroke) or over the crank angle (span up to 360 deg, or 720 deg)"),
           &Table::force)
      .add(rounding_key("rounding", "rad"), &Table::rounding)
      .add(swing_end_key(), &Table::from_greatest, swing_ends())
      .add(work_key(), &Table::account, accounts());
}

}  // namespace

const Tables<LoadReading>& slider_loads() {
  static const auto made =
      Tables<LoadReading>()
          .add("press", "nominal force before the working end, on the working stroke only, then break-through", press())
          .add("constant", "force along the stroke, whatever the motion",
               constant("force", "N", "positive towards the extended end"))
          .add("opposing", "constant force against the motion; holds at standstill", opposing("force", "N"))
          .add("medium", "resistance of the medium, F = c v + q v |v|", medium("N*s/m", "N*s2/m2"))
          .add("table", "force by table over travel or crank angle (indicator diagram)", table())
          .add("compressor",
               "gas force of a compressor: compression, delivery, re-expansion of the clearance volume, suction; the "
               "valves open at located events",
               compressor())
          .add("cylinder",
               "a cylinder that drives the slider: pressures in one chamber or both, by table or formula over travel "
               "or crank angle",
               cylinder())
          .add("linear motor", "a linear motor that drives the slider, by its force-speed line", linear_motor());
  return made;
}

const Tables<LoadReading>& rocker_loads() {
  static const auto made =
      Tables<LoadReading>()
          .add("constant", "torque on the rocking output, whatever the motion",
               constant("torque", "N*m", "positive towards the greatest angle"))
          .add("opposing", "constant torque against the output's motion; holds at standstill",
               opposing("torque", "N*m"))
          .add("medium", "resistance of the medium to the output's rotation, M = c ω + q ω |ω|",
               medium("N*m*s/rad", "N*m*s2/rad2"))
          .add("table", "torque on the rocking output by table over its swing or the crank angle", rocker_table());
  return made;
}

}  // namespace kurbel
