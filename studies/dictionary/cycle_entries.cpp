// cycle_entries.cpp — what figures of one cycle mean: of the steady one, or of a run's last whole one.
#include "studies/dictionary/entries.h"

namespace kurbel {
namespace {

constexpr std::string_view both_verbs = "run, compare, effects, advise, accuracy, steady, sweep, uncertainty",
                           steady_verbs = "steady, sweep, uncertainty";

std::vector<KindEntry> speeds() {
  using enum QuantityKind;
  return {
      {cycle_max_speed,
       {.words = "greatest speed of a cycle, ω_max",
        .unit = "rad/s",
        .of = "LINK",
        .is = "greatest speed of the reduction link in one steady cycle",
        .formula = "ω_max = ω_mid (1 + ½ δ)",
        .is_not = "that of a whole run, which is max_speed",
        .theory = "2.6",
        .verbs = steady_verbs}},
      {cycle_min_speed,
       {.words = "least speed of a cycle, ω_min",
        .unit = "rad/s",
        .of = "LINK",
        .is = "least speed of the reduction link in one steady cycle",
        .formula = "ω_min = ω_mid (1 − ½ δ)",
        .is_not = "that of a whole run, which is min_speed",
        .theory = "2.6",
        .verbs = steady_verbs}},
      {mid_speed,
       {.words = "mid speed ω_mid",
        .unit = "rad/s",
        .of = "LINK",
        .is = "middle of the greatest and the least speed of one cycle: of the steady one, in a run of the last whole "
              "one before it runs down. δ and the flywheel refer to it; books call it the mean speed",
        .formula = "ω_mid = ½ (ω_max + ω_min)",
        .is_not = "the mean over time, which is mean_speed",
        .theory = "2.6",
        .verbs = "run, compare, effects, advise, accuracy, steady, size, sweep, uncertainty"}},
      {mean_speed,
       {.words = "mean speed over time",
        .unit = "rad/s",
        .of = "LINK",
        .is = "angle that the reduction link turns in one cycle over the time that it takes: what a tachometer shows",
        .formula = "ω_mean = Φ/T = 2π n/T for n turns in the time T",
        .is_not = "(ω_max + ω_min)/2, which is mid_speed; in a press the two may differ by 5 % and more",
        .theory = "2.7",
        .verbs = "run, compare, effects, advise, accuracy, steady, forces, sweep, uncertainty"}},
  };
}

std::vector<KindEntry> fluctuations() {
  using enum QuantityKind;
  return {
      {delta,
       {.words = "speed fluctuation δ",
        .of = "SHAFT",
        .is = "how far the speed swings within one cycle of motion that repeats, over its middle",
        .formula = "δ = (ω_max − ω_min)/ω_mid, ω_mid = ½ (ω_max + ω_min)",
        .is_not = "of a whole run with its start, nor of motion that does not repeat (cycle_fluctuation); an elastic "
                  "machine has another δ at every shaft",
        .theory = "2.6",
        .verbs = both_verbs}},
      {cycle_fluctuation,
       {.words = "fluctuation in the last cycle",
        .of = "LINK",
        .is = "as δ, of the last whole cycle of a run that is not steady",
        .formula = "(ω_max − ω_min)/ω_mid",
        .is_not = "δ: run-up and drift are part of it, and another length of the run gives another value",
        .theory = "2.6",
        .verbs = "run, compare, effects, advise, accuracy, sweep, uncertainty"}},
      {cycle_time,
       {.words = "time of a cycle",
        .unit = "s",
        .of = "LINK",
        .is = "time in which the reduction link turns through one cycle: the least angle after which it is back in "
              "place, 2π of a crank, 4π of a four-stroke engine",
        .formula = "T = Φ/ω_mean",
        .is_not = "the time after which all repeats, where that takes several cycles: period",
        .theory = "2.7",
        .verbs = both_verbs}},
      {period,
       {.words = "period of the motion",
        .unit = "s",
        .is = "time after which all angles, speeds and times of the machine repeat: one cycle or several of them",
        .is_not = "the cycle of the reduction link alone: cycle_time",
        .theory = "11.1",
        .verbs = steady_verbs}},
  };
}

// The like of a whole run, of one steady cycle.
KindEntry peak(QuantityKind what, std::string_view words, std::string_view unit, std::string_view of,
               std::string_view is, std::string_view is_not, std::string_view theory) {
  return {
      what,
      {.words = words, .unit = unit, .of = of, .is = is, .is_not = is_not, .theory = theory, .verbs = steady_verbs}};
}

std::vector<KindEntry> peaks() {
  using enum QuantityKind;
  return {
      peak(cycle_peak_torque, "peak torque of a steady cycle", "N*m", "COUPLING",
           "the torque of greatest magnitude that the element transmits within one steady cycle, with its sign",
           "the peak of a whole run with its start and stop: peak_torque", "1.2"),
      peak(cycle_peak_spring_torque, "peak torque of a spring alone, of a steady cycle", "N*m", "COUPLING",
           "the spring torque of greatest magnitude within one steady cycle",
           "what is transmitted: the damper's part "
           "is left out",
           "5.1"),
      peak(cycle_peak_velocity, "peak velocity of a steady cycle", "m/s", "MECHANISM",
           "velocity of greatest magnitude of what the mechanism moves, within one steady cycle",
           "that of a whole run: peak_velocity", "9"),
      peak(cycle_peak_acceleration, "peak acceleration of a steady cycle", "m/s2", "MECHANISM",
           "acceleration of greatest magnitude of what the mechanism moves, within one steady cycle",
           "that of a whole run: peak_acceleration", "9"),
      peak(cycle_peak_force, "peak force of the loads in a steady cycle", "N", "MECHANISM",
           "force of greatest magnitude that the loads exert on the slider, within one steady cycle",
           "a reaction in a joint: those are told by forces", "10"),
      peak(cycle_peak_load_torque, "peak torque of the loads on what rocks, of a steady cycle", "N*m", "MECHANISM",
           "torque of greatest magnitude that the loads exert on the rocker, within one steady cycle",
           "that of a whole run: peak_load_torque", "10"),
      peak(peak_drive_torque, "peak torque of a drive in a steady cycle", "N*m", "MOTOR",
           "the torque of greatest magnitude that the drive exerts on its shaft within one steady cycle",
           "its starting or breakdown torque", "4"),
  };
}

std::vector<KindEntry> means_of_torque() {
  using enum QuantityKind;
  return {
      {cycle_rms_torque,
       {.words = "RMS torque of a steady cycle",
        .unit = "N*m",
        .of = "COUPLING",
        .is = "root of the mean square over time of the torque transmitted, over one steady cycle",
        .formula = "√( (1/T) ∫ τ² dt )",
        .is_not = "of a whole run, which is rms_torque",
        .theory = "5.1",
        .verbs = steady_verbs}},
      {mean_drive_torque,
       {.words = "mean torque of a drive",
        .unit = "N*m",
        .of = "MOTOR",
        .is = "mean over time of the drive's torque on its shaft, over one steady cycle",
        .formula = "(1/T) ∫ M dt",
        .is_not = "the mean over the angle, by which the work of a cycle is had",
        .theory = "4",
        .verbs = steady_verbs}},
      {rms_drive_torque,
       {.words = "RMS torque of a drive",
        .unit = "N*m",
        .of = "MOTOR",
        .is = "root of the mean square over time of the drive's torque, over one steady cycle: what heats a motor",
        .formula = "√( (1/T) ∫ M² dt )",
        .is_not = "its rated torque; their ratio is the thermal use",
        .theory = "4",
        .verbs = steady_verbs}},
  };
}

KindEntry work_of(QuantityKind what, std::string_view words, std::string_view is, std::string_view is_not,
                  std::string_view verbs) {
  return {what,
          {.words = words,
           .unit = "J",
           .is = is,
           .formula = "A = ∮ M dφ",
           .is_not = is_not,
           .theory = "1.3",
           .verbs = verbs}};
}

std::vector<KindEntry> works() {
  using enum QuantityKind;
  constexpr std::string_view whole = "of a whole run: that is work";
  std::vector<KindEntry> all = {
      work_of(driving_work_per_cycle, "driving work of a cycle",
              "work of all that drives, over one cycle; positive into the machine", whole, both_verbs),
      work_of(useful_work_per_cycle, "useful work of a cycle",
              "work of the loads of the process, over one cycle; negative, because it leaves the machine", whole,
              both_verbs),
      work_of(harmful_work_per_cycle, "harmful work of a cycle",
              "work of friction and damping, over one cycle; negative, because it leaves the machine", whole,
              both_verbs),
      work_of(weight_work_per_cycle, "work of weights over a cycle",
              "work of gravity over one cycle; nothing where what moves comes back to its height", whole, steady_verbs),
      work_of(work_per_cycle, "work of one account over a cycle",
              "work of one component in one account, over one steady cycle; positive into the machine",
              "the sum over a line of the balance", steady_verbs),
  };
  all.back().told.of = "COMPONENT (account)";
  return all;
}

}  // namespace

std::vector<KindEntry> entries_of_cycles() {
  std::vector<KindEntry> all = speeds();
  for (const std::vector<KindEntry>& more : {fluctuations(), peaks(), means_of_torque(), works()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace kurbel
