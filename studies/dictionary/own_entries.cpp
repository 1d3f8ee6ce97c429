// own_entries.cpp — what the states and outputs mean that elements bring along under words of their own.
//
// The peak of one over a run is called "peak_" and its name, over a steady cycle "cycle_peak_" and its name.
#include "studies/dictionary/entries.h"

namespace kurbel {
namespace {

constexpr std::string_view told_by = "run, compare";

Definition motor(std::string_view name, std::string_view words, std::string_view is, std::string_view is_not,
                 std::string_view theory) {
  return {.name = name,
          .words = words,
          .unit = "A",
          .of = "MOTOR",
          .is = is,
          .is_not = is_not,
          .theory = theory,
          .verbs = told_by};
}
Definition mechanism(std::string_view name, std::string_view words, std::string_view unit, std::string_view is,
                     std::string_view is_not = {}) {
  return {.name = name,
          .words = words,
          .unit = unit,
          .of = "MECHANISM",
          .is = is,
          .is_not = is_not,
          .theory = "13",
          .verbs = told_by};
}
Definition coupling(std::string_view name, std::string_view words, std::string_view unit, std::string_view of,
                    std::string_view is, std::string_view theory) {
  return {.name = name, .words = words, .unit = unit, .of = of, .is = is, .theory = theory, .verbs = told_by};
}

Definition of_run(std::string_view name, std::string_view words, std::string_view unit, std::string_view of,
                  std::string_view is, std::string_view is_not, std::string_view formula = {}) {
  return {.name = name,
          .words = words,
          .unit = unit,
          .of = of,
          .is = is,
          .formula = formula,
          .is_not = is_not,
          .theory = "1.3",
          .verbs = "run, compare, effects, advise, accuracy, sweep, uncertainty"};
}

Definition of_both(std::string_view name, std::string_view words, std::string_view unit, std::string_view of,
                   std::string_view is, std::string_view is_not, std::string_view formula) {
  Definition d = of_run(name, words, unit, of, is, is_not, formula);
  d.verbs = "run, compare, effects, advise, accuracy, steady, sweep, uncertainty";
  return d;
}

Definition of_period(std::string_view name, std::string_view words, std::string_view is) {
  return of_run(name, words, "J", "driving, useful, harmful, weight or energy", is,
                "of one cycle: that is driving_work_per_cycle and its like", "A_d + A_u + A_h + A_w = ΔE");
}

}  // namespace

// In the order in which a star is tried: what is more definite comes first.
std::vector<Definition> entries_of_own() {
  return {
      motor("current", "armature current", "current in the armature of a direct-current motor", "the rated current",
            "4"),
      motor("stator_current_*", "stator current of an induction motor, in space vectors",
            "component d or q of the stator current's space vector, in the frame that turns with the supply",
            "the current of a phase that an instrument shows: that is the vector's length over √2", "4"),
      motor("rotor_current_*", "rotor current of an induction motor, in space vectors",
            "component d or q of the rotor current's space vector, reduced to the stator",
            "a current that could be "
            "measured in the rotor",
            "4"),
      coupling(
          "engagement_heat", "heat of the hottest engagement", "J", "CLUTCH",
          "heat that a clutch or brake takes from where it begins to slip to where it ends that; the most of the run",
          "1.3"),
      coupling("slip_time", "time of slipping", "s", "CLUTCH", "time of the run in which a clutch or brake makes heat",
               "1.3"),
      coupling("heat_power", "mean heat power", "W", "CLUTCH", "heat of a clutch or brake in the run over the time run",
               "1.3"),
      coupling("slack_force", "least force in the slack strand", "N", "BELT",
               "pretension less half of the largest torque over the driving pulley's radius, fixed centres", "5"),
      coupling("strand_force", "largest force in the tight strand", "N", "BELT",
               "pretension and half of the largest torque over the driving pulley's radius, fixed centres", "5"),
      of_run(
          "motor_peak_torque", "peak torque of a motor", "N*m", "MOTOR",
          "the torque of greatest magnitude that it brings to its shaft in the run, its rotor's inertia not counted; "
          "of a prescribed shaft the one that keeps it at its speed, its own inertia counted",
          "its breakdown torque, which is what it could bring", "M"),
      of_run("motor_peak_power", "peak power of a prescribed shaft's drive", "W", "MOTOR",
             "the power of greatest magnitude that keeps the shaft at its speed, negative where the machine drives it",
             "the mean power, which says what the supply gives", "M ω"),
      of_run(
          "motor_peak_current", "peak current of a motor", "A", "MOTOR",
          "greatest magnitude of the armature's current in the run, of a direct-current motor; of the two-axis model "
          "the greatest length of the stator current's space vector, which is the momentary value that a line can "
          "see",
          "an effective current: of alternating current that is the length over √2", "|M|/k, √(|M|/κ), |i_s|"),
      coupling("power", "power of a prescribed shaft's drive", "W", "MOTOR",
               "torque that keeps the shaft at its speed, times that speed", "1.3"),
      of_run(
          "motor_rms_torque", "RMS torque of a motor over a run", "N*m", "MOTOR",
          "root of the mean square of its torque over the time run; a lower bound of heating: no-load losses and the "
          "currents of a start come on top",
          "its rated torque", "√( (1/t) ∫ M² dt )"),
      of_run(
          "motor_rms_current", "RMS current of a motor over a run", "A", "MOTOR",
          "root of the mean square of the armature's current over the time run, of a direct-current motor, or of a "
          "line's effective current, of the two-axis model; times the winding's resistance and squared the power that "
          "heats it; not told of a weakened field, nor of a series motor that a sequence reverses",
          "the current that its supply gives where a rheostat or a converter stands between",
          "√( (1/t) ∫ i² dt ), i² = ½ |i_s|²"),
      of_run("motor_mean_power", "mean power of a motor over a run", "W", "MOTOR",
             "work that the motor gives to its shaft in the run over the time run",
             "the power that it takes from its supply"),
      of_run(
          "motor_slip_heat", "heat of slip of an induction motor", "J", "MOTOR",
          "what the air gap's field gives less what the shaft takes, over the run: heat of the rotor's winding, that "
          "of the start included",
          "all of its losses: those of the stator, of iron and of friction come on top; of motors that the operating "
          "sequence switches it is told by the two-axis model alone",
          "ω_s ∫ M dt − ∫ M ω dt, of the two-axis model 3/2 R_r ∫ |i_r|² dt"),
      of_both("cycle_motor_power", "mean power of a motor over a cycle", "W", "MOTOR",
              "work that the motor gives to its shaft in the last whole cycle of a motion that repeats, over its time",
              "its rated power", "(1/T) ∫ M ω dt"),
      of_both(
          "machine_efficiency", "efficiency of the machine", "", "",
          "useful work over driving work in the last whole cycle of a motion that repeats; what stored energy still "
          "changes and what weights do is counted with the driving work",
          "the efficiency of one gear or mechanism", "η = −A_useful/(A_driving + A_weight − ΔE)"),
      of_run("current_use", "use of a motor's rated current", "", "MOTOR",
             "RMS current of a line over the cycle that the thermal use is of, over that at the rated slip: of the "
             "two-axis model",
             "the thermal use, which is by its torque; iron and friction are in neither",
             "√( (1/T) ∫ ½ |i_s|² dt )/I_n"),
      of_run("motor_stator_heat", "heat of a motor's stator winding", "J", "MOTOR",
             "what the stator's resistance turns into heat over the run: of the two-axis model", "heat of iron",
             "3/2 R_s ∫ |i_s|² dt"),
      of_run("start_heat", "heat of a motor's start", "J", "MOTOR",
             "heat of slip of the run less what steady motion, by its last cycle, makes of it from the run-up's end on",
             "the heat of the whole run, which is motor_slip_heat", "Q − P_s (t_off − t_up)"),
      of_run(
          "speed_drop", "drop of a flywheel's speed", "", "FLYWHEEL",
          "greatest fall of its speed from any moment of the run to a later one, while something drives, over what it "
          "fell from",
          "δ, which is over the mid speed of a cycle that repeats", "(ω(t₁) − ω(t₂))/ω(t₁)"),
      of_run("energy_given", "energy that a flywheel gives", "J", "FLYWHEEL",
             "kinetic energy that it loses in the greatest fall of its speed: of a press in a stroke",
             "that of one steady cycle, which is flywheel_energy", "½ J (ω(t₁)² − ω(t₂)²)"),
      of_run("held_torque", "largest torque that a clutch holds", "N*m", "CLUTCH",
             "the torque of greatest magnitude that it transmits while it is closed for good and does not slip",
             "its peak torque, which slipping counts in"),
      of_run("torque_reserve", "torque reserve of a clutch", "", "CLUTCH",
             "what it could hold over the largest torque that it does hold, where that is more than a millionth of it; "
             "1: it "
             "reaches that, and slips",
             "a reserve of its heat, for which it has ratings", "M_s/max |τ|"),
      of_run(
          "loop_power", "mean power of a mechanism's load", "W", "MECHANISM",
          "work of its loop over the time of the cycle: of a compressor its indicated power, negative where it leaves "
          "the machine",
          "the power of the motor", "(1/T) ∮ F dx"),
      of_run("volumetric_efficiency", "volumetric efficiency", "", "MECHANISM",
             "share of the stroke that draws in gas, of a compressor by its clearance and pressures",
             "losses of valves and leaks, which the scene does not model", "λ = 1 − c ((p₂/p₁)^(1/m) − 1)"),
      of_run("loop_work", "work of a mechanism's load over a cycle", "J", "MECHANISM",
             "work of the load on the mechanism's output in the last whole cycle: the area of the loop that force over "
             "travel makes, negative where it leaves the machine",
             "work of friction in its joints", "∮ F dx, of gas ∮ (p − p_out) dV"),
      of_both("flywheel_energy", "energy that a flywheel gives in a cycle", "J", "FLYWHEEL",
              "kinetic energy of the flywheel at its largest speed less that at its least one, in the last whole cycle "
              "of a "
              "motion that repeats; `run` tells it of those that turn rigidly with the link, `steady` of all",
              "its whole kinetic energy", "½ J (ω_max² − ω_min²) = J δ ω_mid²"),
      of_period("work_of_run_up", "works of the run-up",
                "from the start to the begin of the first whole cycle of steady motion"),
      of_period("work_of_steady_motion", "works of the steady motion",
                "from the begin of its first whole cycle to the end of its last one"),
      of_period("work_of_run_down", "works of the run-down",
                "from the end of the last whole cycle that is driven to the end of the run"),
      coupling(
          "greatest_torque", "greatest torque of a shaft", "N*m", "SHAFT",
          "with its sign, of the time run or of the steady cycle; told where a cycle of the shaft's stress is rated",
          "12.14"),
      coupling(
          "least_torque", "least torque of a shaft", "N*m", "SHAFT",
          "with its sign, of the time run or of the steady cycle; told where a cycle of the shaft's stress is rated",
          "12.14"),
      coupling("rim_speed", "largest speed of the rim", "m/s", "FLYWHEEL",
               "rim_radius times the shaft's angular velocity, where that is largest", "1.3"),
      coupling("integral", "integral part of a governor", "N*m", "GOVERNOR",
               "torque that the governor has summed up from past errors of the speed", "4"),
      coupling("slipped_angle", "angle slipped by a belt", "rad", "BELT",
               "how far the belt has slipped on its pulleys, about the driving shaft", "5"),
      coupling("bristle", "deflection of bristles", "rad", "BEARING",
               "mean deflection of the contact in the LuGre model of friction", "8"),
      coupling("creep*", "creep of rubber", "rad", "COUPLING",
               "twist of a dashpot in one of its spring-and-dashpot branches", "5"),
      coupling("travelled", "way of a slide since the start", "m", "SCREW, WEDGE or SLIDE",
               "how far a slide whose force hangs on its travel has moved", "7"),
      mechanism("bending_*_rate", "rate of bending of the rod", "m/s", "how fast that mode's amplitude changes"),
      mechanism("bending_*", "bending of the rod in a mode", "m", "amplitude of the rod's bending mode of that number",
                "the deflection at a place, which is the sum over the modes: rod_deflection"),
      mechanism("stretching_*_rate", "rate of stretching of the rod", "m/s", "how fast the rod stretches there"),
      mechanism("stretching_*", "stretching of the rod", "m",
                "displacement of the rod's middle or end along the rod against the rigid rod"),
      mechanism("rod_deflection", "deflection of the rod's middle", "m", "sum of the bending modes at mid-length"),
      mechanism("rod_bending_stress", "greatest bending stress in the rod", "Pa",
                "modulus times edge distance times the greatest curvature along the rod",
                "a stress with tension or notches in it"),
      mechanism("guide_reaction", "reaction of the guide", "N", "force of the guide on the slider across its line"),
      mechanism("guide_shift*", "shift of the slider in its guide", "m", "across the guide, or its rate [m/s]"),
      mechanism("guide_tilt*", "tilt of the slider in its guide", "rad", "against the guide, or its rate [rad/s]"),
      mechanism("*_shift_*", "shift of a journal in its bearing", "m",
                "of the journal's centre against its bearing's, along x or y, or its rate [m/s]"),
      mechanism("*_force", "contact force of a joint with clearance", "N",
                "greatest contact force in that joint at a moment; 0 in flight", "the reaction of an ideal joint"),
      mechanism("*_penetration", "penetration of a contact", "m", "how deep the surfaces of that joint overlap",
                "wear"),
  };
}

}  // namespace kurbel
