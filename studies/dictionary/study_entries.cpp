// study_entries.cpp — what the figures mean that only one study has.
#include "studies/dictionary/entries.h"

namespace kurbel {
namespace {

std::vector<Definition> of_steady() {
  constexpr std::string_view verb = "steady";
  return {
      {.name = "largest_multiplier",
       .words = "largest Floquet multiplier",
       .is = "magnitude of the greatest eigenvalue of the return map's derivative: what is left of a disturbance after "
             "one period, for every part of it at most",
       .formula = "max |μ|; stable below 1; halves in ln 2/(−ln |μ|) periods",
       .is_not = "a damping ratio",
       .theory = "11.4",
       .verbs = verb},
      {.name = "residual_rms",
       .words = "root mean square of measured − simulated",
       .of = "CHANNEL",
       .is =
           "what is left between a test's record and the simulation, after shift and offset, over the points that both "
           "have; in the channel's unit",
       .formula = "√(Σ r²/n), r_i = m_i − o − s(t_i + Δ)",
       .is_not = "the simulation's numerical error",
       .verbs = "run, steady"},
      {.name = "residual_largest",
       .words = "largest measured − simulated",
       .of = "CHANNEL",
       .is = "the residual of largest magnitude, with its sign; in the channel's unit",
       .formula = "max |m − o − s|",
       .is_not = "the difference of the peaks",
       .verbs = "run, steady"},
      {.name = "residual_relative",
       .words = "residual over the measured range",
       .of = "CHANNEL",
       .is = "root mean square of the residual over what the record goes from its least to its greatest value",
       .formula = "√(Σ r²/n)/(m_max − m_min)",
       .verbs = "run, steady"},
      {.name = "measured_shift",
       .words = "shift of a test's record",
       .unit = "s",
       .is = "what is added to measured times; where it was found by least squares, its error is twice the standard "
             "error "
             "that independent noise of the residuals' size gives",
       .formula = "t_simulated = t_measured + Δ",
       .verbs = "run, steady"},
      {.name = "measured_offset",
       .words = "offset of a measured column",
       .of = "CHANNEL",
       .is = "what the column reads too high, taken off before it is compared; where it was found, the mean of "
             "measured − "
             "simulated, its error twice the standard error; in the channel's unit",
       .verbs = "run, steady"},
      {.name = "thermal_use",
       .words = "thermal use of a motor",
       .of = "MOTOR",
       .is = "RMS torque of the steady cycle, or of a run's last whole cycle of a motion that repeats, over the rated "
             "torque; where commands change the motion, of the heaviest cycle that comes again; beyond 1 the "
             "motor gets too hot in continuous use",
       .formula = "M_rms/M_n",
       .is_not = "an efficiency",
       .theory = "4",
       .verbs = "run, compare, effects, advise, accuracy, steady, sweep, uncertainty"},
      {.name = "breakdown_use",
       .words = "use of a motor's breakdown torque",
       .of = "MOTOR",
       .is = "largest torque of the steady cycle over the breakdown torque at the motor's voltage; towards 1 it stalls",
       .formula = "|M|_max/M_b",
       .is_not = "the thermal use, which is of the RMS torque",
       .theory = "4",
       .verbs = verb},
      {.name = "operating_speed",
       .words = "operating speed",
       .unit = "rad/s",
       .of = "LINK",
       .is = "constant speed at which the drive's mean torque over a cycle equals the loads', and the drive's falls "
             "below beyond it",
       .formula = "M_d(ω) = M_c(ω), dM_d/dω < dM_c/dω",
       .is_not = "the mid or mean speed of the motion, whose speed is not constant",
       .theory = "4.15",
       .verbs = "steady, size, reduce, sweep, uncertainty"},
      {.name = "margin",
       .words = "margin of the drive",
       .is = "greatest mean torque that the drive can give over what it needs at the operating speed",
       .is_not = "the breakdown ratio of its catalogue",
       .theory = "4.15",
       .verbs = verb},
      {.name = "start_time",
       .words = "start time",
       .unit = "s",
       .is = "from rest to 95 % of the steady speed, of the rigid machine",
       .is_not = "the run-up time, which ends where the speed stays within the steady cycle's range",
       .theory = "11",
       .verbs = verb},
      {.name = "added_torque",
       .words = "torque that a demanded speed needs",
       .unit = "N*m",
       .of = "MOTOR",
       .is = "constant torque beside the scene's drive with which the steady cycle has the demanded mid speed",
       .theory = "11",
       .verbs = verb},
  };
}

std::vector<Definition> of_size() {
  constexpr std::string_view verb = "size, sweep, uncertainty";
  return {
      {.name = "flywheel",
       .words = "inertia of the flywheel",
       .unit = "kg*m2",
       .is = "inertia on the flywheel's own shaft that keeps δ at what is demanded, at constant driving torque, less "
             "all that turns there at a constant ratio anyway",
       .formula = "I_fly = I₀/i² − Σ others",
       .is_not = "I₀, which is the whole constant inertia on the reduction link",
       .theory = "3.2",
       .verbs = verb},
      {.name = "flywheel_with_slope",
       .words = "inertia of the flywheel with the drive's slope",
       .unit = "kg*m2",
       .is = "the same with the torques as they depend on the speed",
       .formula = "δ(I₀) = δ",
       .theory = "11.5",
       .verbs = verb},
      {.name = "flywheel_that_meets",
       .words = "inertia of the flywheel whose regime has the demanded δ",
       .unit = "kg*m2",
       .is = "inertia on the flywheel's own shaft with which the machine's steady cycle, with the scene's effects, has "
             "the δ that is demanded; sought where the flywheel of the work equation misses it",
       .formula = "δ(I₀) = δ",
       .theory = "3.6",
       .verbs = verb},
      {.name = "delta_reached",
       .words = "δ reached",
       .is =
           "δ of the machine with the sized flywheel: of its work equation, or of its regime, rigid or elastic, at the "
           "crank or at the motor",
       .formula = "δ = (ω_max − ω_min)/ω_mid",
       .is_not = "the δ demanded",
       .theory = "2.6",
       .verbs = verb},
      {.name = "fluctuation_of_energy",
       .words = "greatest fluctuation of energy",
       .unit = "J",
       .is = "greatest less least excess of the driving work over the loads' within a cycle",
       .formula = "ΔA_max = max ΔT − min ΔT",
       .is_not = "the work of a cycle",
       .theory = "3.4",
       .verbs = verb},
      {.name = "flywheel_mass",
       .words = "mass of the flywheel",
       .unit = "kg",
       .is = "of rim, spokes and hub, or of the disc",
       .theory = "3.7",
       .verbs = verb},
  };
}

std::vector<Definition> of_reduce() {
  constexpr std::string_view verb = "reduce";
  return {
      {.name = "constant_inertia",
       .words = "constant inertia of the drive",
       .unit = "kg*m2",
       .is = "what turns at a constant ratio, reduced to the link by kinetic energy",
       .formula = "Σ J i²",
       .is_not = "the whole reduced inertia: the mechanism's, which changes over the angle, is left out",
       .theory = "2.1",
       .verbs = verb},
      {.name = "mean_driving_torque",
       .words = "mean driving torque",
       .unit = "N*m",
       .is = "mean over the angle of a cycle of all driving torques, reduced to the link by power at constant speed",
       .formula = "(1/Φ) ∮ M_d dφ",
       .is_not = "a mean over time",
       .theory = "2.2",
       .verbs = verb},
      {.name = "mean_resisting_torque",
       .words = "mean resisting torque",
       .unit = "N*m",
       .is = "mean over the angle of a cycle of all that brakes, reduced to the link by power at constant speed; "
             "positive when it brakes",
       .formula = "(1/Φ) ∮ M_c dφ",
       .is_not = "a mean over time",
       .theory = "2.2",
       .verbs = verb},
  };
}

std::vector<Definition> of_modes() {
  constexpr std::string_view verb = "modes";
  return {
      {.name = "natural_frequency",
       .words = "natural frequency of a mode",
       .unit = "Hz",
       .is = "undamped natural frequency of the drive, linearised at the operating point",
       .formula = "K v = ω_n² M v",
       .is_not = "the damped frequency ω_n √(1 − ζ²)",
       .theory = "12.2",
       .verbs = "modes, sweep, uncertainty"},
      {.name = "damping_ratio",
       .words = "damping ratio of a mode",
       .of = "MODE",
       .is = "share of critical damping with which a mode dies out, by its eigenvalue at the operating point: what is "
             "left after a cycle is exp(−2πζ/√(1 − ζ²)); told of modes that swing",
       .formula = "ζ = −Re λ/|λ|",
       .is_not = "the damping ratio that a coupling is given, which is of that coupling alone",
       .theory = "12.3",
       .verbs = "modes, sweep, uncertainty"},
      {.name = "largest_swing",
       .words = "largest swing at that speed",
       .unit = "N*m",
       .is = "the greatest of all joints' torque peaks above its mean in the steady forced motion of the linearised "
             "drive",
       .is_not = "a peak torque: the mean is not in it, nor is anything not linear",
       .theory = "12.7",
       .verbs = verb},
      {.name = "spot_swing",
       .words = "swing at a speed of the range, by the nonlinear cycle",
       .unit = "N*m",
       .is =
           "the greatest departure of a joint's torque from its mean in the nonlinear cycle of the machine whose mean "
           "speed is held there, at the spot check where the linear response is off by most",
       .is_not = "the motion that the machine keeps: torques proportional to inertia hold the speed",
       .theory = "12.13",
       .verbs = verb},
      {.name = "nominal_torque_verdict",
       .words = "mean torque against T_KN",
       .unit = "N*m",
       .is = "K_A S_t times the mean of a joint's torque over a round of the motion that the machine keeps",
       .formula = "K_A S_t |T_mean| ≤ T_KN",
       .is_not = "a peak, nor the torque of a start",
       .theory = "12.9",
       .verbs = verb},
      {.name = "maximum_torque_verdict",
       .words = "largest torque from rest against T_Kmax",
       .unit = "N*m",
       .is = "the largest torque of a joint on a simulated way from rest to the motion that the machine keeps, what "
             "starts add times S_z, all times S_t; without such a way a bound, the largest steady swing below the "
             "operating speed",
       .formula = "S_t (T_N + S_z T_S) ≤ T_Kmax",
       .is_not = "the standard's estimate by shock and resonance factors",
       .theory = "12.9",
       .verbs = verb},
      {.name = "vibratory_torque_verdict",
       .words = "alternating torque against T_KW",
       .unit = "N*m",
       .is = "the largest departure of a joint's torque from its mean over a round of the motion that the machine "
             "keeps, times S_t and the frequency factor of what swings in it",
       .formula = "S_t S_f T_W ≤ T_KW",
       .is_not = "half the range from least to greatest torque; the amplitude of one order",
       .theory = "12.11",
       .verbs = verb},
  };
}

std::vector<Definition> of_forces() {
  constexpr std::string_view verb = "forces";
  return {
      {.name = "reaction",
       .words = "largest reaction in a joint",
       .unit = "N",
       .is = "greatest magnitude of the joint's force over the cycle, masses in motion included",
       .is_not = "the force of the loads on the slider: peak_force",
       .theory = "9.6",
       .verbs = verb},
      {.name = "reaction_moment",
       .words = "largest moment in a slide",
       .unit = "N*m",
       .is =
           "greatest moment over the cycle that a slide's two bodies exert on each other, about the pin it is told at",
       .is_not = "a friction torque",
       .theory = "9.6",
       .verbs = verb},
      {.name = "balancing_torque",
       .words = "largest balancing torque",
       .unit = "N*m",
       .is = "torque on the crank that keeps the motion as prescribed",
       .is_not = "what a motor gives, whose speed yields",
       .theory = "9.6",
       .verbs = verb},
      {.name = "shaking_force",
       .words = "largest shaking force",
       .unit = "N",
       .is = "greatest force on the frame by the inertia of what moves",
       .theory = "9",
       .verbs = verb},
      {.name = "shaking_moment",
       .words = "largest shaking moment",
       .unit = "N*m",
       .is = "greatest moment on the frame about the main bearing by the inertia of what moves",
       .theory = "9",
       .verbs = verb},
  };
}

std::vector<Definition> of_gears() {
  constexpr std::string_view verb = "gears";
  return {
      {.name = "centre_distance",
       .words = "centre distance",
       .unit = "mm",
       .is = "between the wheels' axes, as they run",
       .theory = "6",
       .verbs = verb},
      {.name = "contact_ratio",
       .words = "contact ratio ε_α",
       .is = "length of the path of contact over the base pitch: pairs in mesh in the mean",
       .formula = "ε_α = g_α/p_b",
       .is_not = "the overlap of helical teeth, which is told beside it",
       .theory = "6",
       .verbs = verb},
      {.name = "specific_sliding",
       .words = "greatest specific sliding",
       .is = "sliding over rolling speed of a flank, at the worse foot",
       .theory = "6",
       .verbs = verb},
      {.name = "backlash_angle",
       .words = "backlash at wheel 1",
       .unit = "mrad",
       .is = "angle that wheel 1 may turn with wheel 2 held",
       .theory = "6",
       .verbs = verb},
      {.name = "mesh_stiffness",
       .words = "mesh stiffness about wheel 1",
       .unit = "N*m/rad",
       .is = "mean stiffness of the mesh as a torsional spring on wheel 1's shaft; its error is the method's own, 8 %",
       .theory = "6",
       .verbs = verb},
  };
}

std::vector<Definition> of_judgement() {
  return {
      {.name = "coordinates",
       .words = "coordinates",
       .is = "independent coordinates of the compiled machine: shafts that are free and twists",
       .is_not = "states: velocities and own states are counted apart",
       .theory = "14",
       .verbs = "run"},
      {.name = "processor_time",
       .words = "processor time of a run",
       .unit = "s",
       .is = "of one integration, without those that measure the errors",
       .verbs = "compare, advise"},
      {.name = "change_with",
       .words = "change with an effect that is off",
       .is = "change of a key figure when that effect alone is switched on in a run that has it off",
       .formula = "(on − off)/|off|",
       .is_not = "the change when the effect is taken out of the fullest machine",
       .theory = "14.1",
       .verbs = "run, compare"},
      {.name = "change_without",
       .words = "change without an effect",
       .is = "greatest change of a telling figure when that effect alone is switched off",
       .formula = "|without − full|/|full|",
       .theory = "14.1",
       .verbs = "effects"},
      {.name = "deviation",
       .words = "deviation of the recommended model",
       .is = "greatest change of a telling figure against the fullest model, measured by running both",
       .theory = "14.1",
       .verbs = "advise"},
      {.name = "sets_run",
       .words = "sets of effects run",
       .is = "how many sets of effects were run before one was recommended",
       .theory = "14",
       .verbs = "advise"},
      {.name = "settings_measured",
       .words = "settings measured",
       .is = "how many combinations of model, method and tolerance were run",
       .theory = "15",
       .verbs = "accuracy"},
  };
}

// What a scene gives; nobody prints them, but figures are taken for them.
std::vector<Definition> of_scenes() {
  return {
      {.name = "rated_speed",
       .words = "rated speed",
       .unit = "rad/s",
       .of = "MOTOR",
       .is = "the catalogue's speed at rated power, a key of the scene",
       .is_not = "the speed at which it runs in the machine: operating_speed, mid_speed",
       .theory = "4",
       .verbs = ""},
      {.name = "synchronous_speed",
       .words = "synchronous speed",
       .unit = "rad/s",
       .of = "MOTOR",
       .is = "speed of an induction motor's field, 2π f over its pole pairs; without slip, so without torque",
       .is_not = "the rated speed",
       .theory = "4",
       .verbs = ""},
      {.name = "start_speed",
       .words = "start speed",
       .unit = "rad/s",
       .is = "speed of the reduction link at the start of a run: `speed` in the scene's start",
       .is_not = "a speed that the motion has later",
       .theory = "1",
       .verbs = ""},
  };
}

}  // namespace

std::vector<Definition> entries_of_studies() {
  std::vector<Definition> all;
  for (const std::vector<Definition>& more :
       {of_steady(), of_size(), of_reduce(), of_modes(), of_forces(), of_gears(), of_judgement(), of_scenes()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace kurbel
