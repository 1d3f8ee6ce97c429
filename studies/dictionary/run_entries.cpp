// run_entries.cpp — what channels and figures of a whole run mean.
#include "studies/dictionary/entries.h"

namespace kurbel {
namespace {

constexpr std::string_view of_runs = "run, compare, effects, advise, accuracy, sweep, uncertainty";
constexpr std::string_view of_files = "run, compare";  // trajectory.csv

std::vector<KindEntry> channels_of_shafts() {
  using enum QuantityKind;
  return {
      {angle,
       {.words = "angle of a shaft",
        .unit = "rad",
        .of = "SHAFT",
        .is = "angle that the shaft has turned in its own direction of drive",
        .is_not = "reduced to another shaft, or taken back to one turn",
        .theory = "1.1",
        .verbs = of_files}},
      {speed,
       {.words = "speed of a shaft",
        .unit = "rad/s",
        .of = "SHAFT",
        .is = "angular velocity of the shaft in its own direction of drive, at a moment",
        .is_not = "a mean of anything",
        .theory = "1.1",
        .verbs = of_files}},
      {twist,
       {.words = "twist of an elastic element",
        .unit = "rad",
        .of = "COUPLING",
        .is = "how far its driving shaft is ahead of its driven one",
        .formula = "θ = φ_a − i φ_b",
        .theory = "1.2",
        .verbs = of_files}},
      {slip,
       {.words = "slip of a contact",
        .unit = "rad/s",
        .of = "COUPLING",
        .is = "speed of its driving shaft less that of its driven one",
        .formula = "ω_a − i ω_b",
        .is_not = "an induction motor's slip, which is a part of the synchronous speed",
        .theory = "8",
        .verbs = of_files}},
      {torque,
       {.words = "torque",
        .unit = "N*m",
        .of = "COMPONENT",
        .is = "of a coupling what it transmits, positive when it drives its driven shaft; of a motor or load what it "
              "exerts on its shaft, positive when it drives forwards; of a prescribed speed what keeps its shaft at it",
        .is_not = "reduced to another shaft",
        .theory = "1.2",
        .verbs = of_files}},
      {spring_torque,
       {.words = "torque of a spring alone",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "the part of what an elastic element transmits that its twist gives",
        .formula = "τ = k θ",
        .is_not = "what it transmits: its damper's torque is left out",
        .theory = "5.1",
        .verbs = of_files}},
  };
}

std::vector<KindEntry> channels_of_mechanisms() {
  using enum QuantityKind;
  return {
      {position,
       {.words = "position of what a mechanism moves",
        .unit = "m",
        .of = "MECHANISM",
        .is = "of its slider along its line, of a screw's nut, a wedge's or a pinion's slide its travel; of what rocks "
              "its "
              "angle [rad]",
        .theory = "9",
        .verbs = of_files}},
      {velocity,
       {.words = "velocity of what a mechanism moves",
        .unit = "m/s",
        .of = "MECHANISM",
        .is = "of its slider along its line; of what rocks in rad/s",
        .theory = "9",
        .verbs = of_files}},
      {acceleration,
       {.words = "acceleration of what a mechanism moves",
        .unit = "m/s2",
        .of = "MECHANISM",
        .is = "of its slider along its line; of what rocks in rad/s²",
        .theory = "9",
        .verbs = of_files}},
      {force,
       {.words = "force of the loads",
        .unit = "N",
        .of = "MECHANISM",
        .is = "sum of the loads on its slider, positive towards its greatest x",
        .is_not = "a reaction in a joint, or an inertia force",
        .theory = "10",
        .verbs = of_files}},
      {load_torque,
       {.words = "torque of the loads on what rocks",
        .unit = "N*m",
        .of = "MECHANISM",
        .is = "sum of the loads on its rocker",
        .is_not = "reduced to the crank",
        .theory = "10",
        .verbs = of_files}},
  };
}

std::vector<KindEntry> peaks_of_torque() {
  using enum QuantityKind;
  return {
      {peak_torque,
       {.words = "peak torque of a whole run",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "the torque of greatest magnitude that the element transmits from the start of the run to its end, with "
              "its sign and its time",
        .formula = "τ(t*), |τ(t*)| = max |τ(t)|",
        .is_not = "the peak of a steady cycle, which is cycle_peak_torque: a start or a stop counts here",
        .theory = "1.2",
        .verbs = of_runs}},
      {peak_spring_torque,
       {.words = "peak torque of a spring alone, of a whole run",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "the spring torque of greatest magnitude during the run; of a rigid element its whole torque",
        .formula = "max |k θ(t)|",
        .is_not = "what is transmitted: its damper's torque is left out",
        .theory = "5.1",
        .verbs = of_runs}},
  };
}

std::vector<KindEntry> peaks_of_motion() {
  using enum QuantityKind;
  return {
      {peak_velocity,
       {.words = "peak velocity of a whole run",
        .unit = "m/s",
        .of = "MECHANISM",
        .is = "velocity of greatest magnitude of what the mechanism moves",
        .theory = "9",
        .verbs = of_runs}},
      {peak_acceleration,
       {.words = "peak acceleration of a whole run",
        .unit = "m/s2",
        .of = "MECHANISM",
        .is = "acceleration of greatest magnitude of what the mechanism moves",
        .theory = "9",
        .verbs = of_runs}},
      {peak_force,
       {.words = "peak force of the loads in a whole run",
        .unit = "N",
        .of = "MECHANISM",
        .is = "force of greatest magnitude that the loads exert on the slider",
        .is_not = "a reaction in a joint: those are told by forces",
        .theory = "10",
        .verbs = of_runs}},
      {peak_load_torque,
       {.words = "peak torque of the loads on what rocks, of a whole run",
        .unit = "N*m",
        .of = "MECHANISM",
        .is = "torque of greatest magnitude that the loads exert on the rocker",
        .theory = "10",
        .verbs = of_runs}},
  };
}

std::vector<KindEntry> speeds_of_motion() {
  using enum QuantityKind;
  return {
      {max_speed,
       {.words = "greatest speed of a whole run",
        .unit = "rad/s",
        .of = "LINK",
        .is = "greatest speed of the reduction link from the start of the run to its end",
        .formula = "max ω(t)",
        .is_not = "the ω_max of δ, which is of one cycle: cycle_max_speed",
        .theory = "2",
        .verbs = of_runs}},
      {min_speed,
       {.words = "least speed of a whole run",
        .unit = "rad/s",
        .of = "LINK",
        .is = "least speed of the reduction link from the start of the run to its end: 0 after a start from rest",
        .formula = "min ω(t)",
        .is_not = "the ω_min of δ, which is of one cycle: cycle_min_speed",
        .theory = "2",
        .verbs = of_runs}},
  };
}

std::vector<KindEntry> rms_torques() {
  using enum QuantityKind;
  return {
      {rms_torque,
       {.words = "RMS torque of a whole run",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "root of the mean square over time of the torque transmitted, from the start of the run to its end",
        .formula = "√( (1/t) ∫ τ² dt )",
        .is_not = "of a steady cycle, which is cycle_rms_torque",
        .theory = "5.1",
        .verbs = of_runs}},
      {rms_spring_torque,
       {.words = "RMS torque of a spring alone, of a whole run",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "root of the mean square over time of the spring torque",
        .formula = "√( (1/t) ∫ (k θ)² dt )",
        .theory = "5.1",
        .verbs = of_runs}},
      {amplification,
       {.words = "amplification of a torque",
        .of = "COUPLING",
        .is = "peak torque of the second model over that of the first, each at its own time; mostly elastic over rigid",
        .formula = "K = |τ_elastic| / |τ_rigid|",
        .is_not = "a factor on the mean torque, or an application factor K_A",
        .theory = "14.2",
        .verbs = "compare"}},
  };
}

std::vector<KindEntry> ends() {
  using enum QuantityKind;
  return {
      {final_angle,
       {.words = "angle at the end of the run",
        .unit = "rad",
        .of = "COMPONENT",
        .is = "angle of its driven shaft when the run ends",
        .theory = "1.1",
        .verbs = of_runs}},
      {final_speed,
       {.words = "speed at the end of the run",
        .unit = "rad/s",
        .of = "COMPONENT",
        .is = "speed of its driven shaft when the run ends",
        .is_not = "a steady speed, unless the motion is steady by then",
        .theory = "1.1",
        .verbs = of_runs}},
      {steady_speed,
       {.words = "steady speed",
        .unit = "rad/s",
        .of = "LINK",
        .is = "mid speed of the last whole cycle before the drive goes off, where the motion is steady; without a "
              "cycle the speed at that time",
        .is_not = "the operating speed, where mean torques taken at constant speed balance",
        .theory = "11.6",
        .verbs = of_runs}},
  };
}

std::vector<KindEntry> times() {
  using enum QuantityKind;
  return {
      {run_up_time,
       {.words = "run-up time",
        .unit = "s",
        .is = "from the start until the reduction link's speed enters for good the range of the last cycle widened by "
              "1 % of the steady speed; without a cycle steady speed ± 1 %. Of steady motion only",
        .is_not = "the time to 95 % of the steady speed, which is start_time",
        .theory = "11.6",
        .verbs = of_runs}},
      {run_down_time,
       {.words = "run-down time",
        .unit = "s",
        .is = "from the moment at which the last driving source goes off for good to standstill: at rest, or below "
              "0.1 % of the last mid speed for good",
        .is_not = "the stopping time, which counts from a signal",
        .theory = "2",
        .verbs = of_runs}},
      {stopping_time,
       {.words = "stopping time",
        .unit = "s",
        .of = "LINK",
        .is =
            "from the signal of the operating sequence that makes the reduction link stop to its rest: the first step "
            "that takes a motor or a clutch away, reverses a motor or sets a brake, after the last that drove. Only "
            "where that happens",
        .is_not = "the run-down time, which counts from the drive's end",
        .theory = "8",
        .verbs = of_runs}},
      {stopping_angle,
       {.words = "stopping angle",
        .unit = "rad",
        .of = "LINK",
        .is = "what the reduction link still turns in its stopping time",
        .theory = "8",
        .verbs = of_runs}},
  };
}

std::vector<KindEntry> losses() {
  using enum QuantityKind;
  return {
      {impacts,
       {.words = "impacts",
        .of = "MECHANISM",
        .is = "how often a joint with clearance is hit after flight during the run",
        .is_not = "how often its contact bounces within a hit that never parts",
        .theory = "13",
        .verbs = of_runs}},
      {slip_heat,
       {.words = "heat of slipping",
        .unit = "J",
        .of = "COUPLING",
        .is = "what the slipping contact has turned into heat during the run; positive",
        .formula = "∫ |τ (ω_a − i ω_b)| dt",
        .is_not = "a work with its sign: in the balance of energy it is harmful work, negative",
        .theory = "1.3",
        .verbs = of_runs}},
      {work,
       {.words = "work of a line of the energy balance, of a whole run",
        .unit = "J",
        .of = "ACCOUNT",
        .is = "sum of the works of all torques and forces of that account (driving, useful, harmful, weight), positive "
              "into the machine: useful and "
              "harmful work are negative as a rule",
        .formula = "A = ∫ M ω dt",
        .is_not = "of one cycle: that is driving_work_per_cycle and its like",
        .theory = "1.3",
        .verbs = of_runs}},
  };
}

}  // namespace

std::vector<KindEntry> entries_of_kinds() {
  std::vector<KindEntry> all;
  for (const std::vector<KindEntry>& more :
       {channels_of_shafts(), channels_of_mechanisms(), peaks_of_torque(), peaks_of_motion(), speeds_of_motion(),
        rms_torques(), ends(), times(), losses()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace kurbel
