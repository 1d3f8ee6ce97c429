// study_entries.h — meaning of the figures that belong to one study.
#pragma once

#include "studies/dictionary/entries.h"

namespace kurbel::entries {

inline constexpr Definition of_one_study[] = {
    // steady
    {"largest_multiplier", "largest Floquet multiplier", "", "", "11.4", "steady",
     "magnitude of the greatest eigenvalue of the return map's derivative: the factor by which a disturbance shrinks "
     "in one "
     "period, for every part of it at most",
     "max |μ|; stable below 1; halves in ln 2/(−ln |μ|) periods", "a damping ratio"},
    {"residual_rms", "root mean square of measured − simulated", "", "CHANNEL", "", "run, steady",
     "of the residuals of a test's record against the simulation, after shift and offset, over the points of both; "
     "in the channel's unit",
     "√(Σ r²/n), r_i = m_i − o − s(t_i + Δ)", "the simulation's numerical error"},
    {"residual_largest", "largest measured − simulated", "", "CHANNEL", "", "run, steady",
     "the residual of largest magnitude, with its sign; in the channel's unit", "max |m − o − s|",
     "the difference of the peaks"},
    {"residual_relative", "residual over the measured range", "", "CHANNEL", "", "run, steady",
     "root mean square of the residual over what the record goes from its least to its greatest value",
     "√(Σ r²/n)/(m_max − m_min)"},
    {"measured_shift", "shift of a test's record", "s", "", "", "run, steady",
     "what is added to measured times; where it was found by least squares, its error is twice the standard error that "
     "independent noise of the residuals' size gives",
     "t_simulated = t_measured + Δ"},
    {"measured_offset", "offset of a measured column", "", "CHANNEL", "", "run, steady",
     "what the column reads too high, taken off before it is compared; where it was found, the mean of measured − "
     "simulated, its error twice the standard error; in the channel's unit"},
    {"thermal_use", "thermal use of a motor", "", "MOTOR", "4", of_both,
     "RMS torque of the steady cycle, or of a run's last whole cycle of a motion that repeats, over the rated torque; "
     "where commands change the motion, of the heaviest cycle that repeats; beyond 1 the motor gets too hot in "
     "continuous use",
     "M_rms/M_n", "an efficiency"},
    {"breakdown_use", "use of a motor's breakdown torque", "", "MOTOR", "4", "steady",
     "largest torque of the steady cycle over the breakdown torque at the motor's voltage; towards 1 it stalls",
     "|M|_max/M_b", "the thermal use, which is of the RMS torque"},
    {"operating_speed", "operating speed", "rad/s", "LINK", "4.15", "steady, size, reduce, sweep, uncertainty",
     "constant speed at which the drive's mean torque over a cycle equals the loads', and the drive's falls below "
     "beyond it",
     "M_d(ω) = M_c(ω), dM_d/dω < dM_c/dω", "the mid or mean speed of the motion, whose speed is not constant"},
    {"margin", "margin of the drive", "", "", "4.15", "steady",
     "greatest mean torque that the drive can give over what it needs at the operating speed", "",
     "the breakdown ratio of its catalogue"},
    {"start_time", "start time", "s", "", "11", "steady", "from rest to 95 % of the steady speed, of the rigid machine",
     "", "the run-up time, which ends where the speed stays within the steady cycle's range"},
    {"added_torque", "torque that a demanded speed needs", "N*m", "MOTOR", "11", "steady",
     "constant torque beside the scene's drive with which the steady cycle has the demanded mid speed"},
    // size
    {"flywheel", "inertia of the flywheel", "kg*m2", "", "3.2", of_sizing,
     "inertia on the flywheel's own shaft that keeps δ at what is demanded, at constant driving torque, less all that "
     "turns there at a constant ratio anyway",
     "I_fly = I₀/i² − Σ others", "I₀, which is the whole constant inertia on the reduction link"},
    {"flywheel_with_slope", "inertia of the flywheel with the drive's slope", "kg*m2", "", "11.5", of_sizing,
     "the same with the torques as they depend on the speed", "δ(I₀) = δ"},
    {"flywheel_that_meets", "inertia of the flywheel whose steady motion has the demanded δ", "kg*m2", "", "3.6",
     of_sizing,
     "inertia on the flywheel's own shaft with which the machine's steady cycle, with the scene's effects, has the δ "
     "that is demanded; sought where the flywheel of the work equation misses it",
     "δ(I₀) = δ"},
    {"delta_reached", "δ reached", "", "", "2.6", of_sizing,
     "δ of the machine with the sized flywheel: of its work equation, or of its steady motion, rigid or elastic, at "
     "the crank "
     "or at the motor",
     "δ = (ω_max − ω_min)/ω_mid", "the δ demanded"},
    {"fluctuation_of_energy", "greatest fluctuation of energy", "J", "", "3.4", of_sizing,
     "greatest less least excess of the driving work over the loads' within a cycle", "ΔA_max = max ΔT − min ΔT",
     "the work of a cycle"},
    {"flywheel_mass", "mass of the flywheel", "kg", "", "3.7", of_sizing, "of rim, spokes and hub, or of the disc"},
    // reduce
    {"constant_inertia", "constant inertia of the drive", "kg*m2", "", "2.1", "reduce",
     "what turns at a constant ratio, reduced to the link by kinetic energy", "Σ J i²",
     "the whole reduced inertia: without the mechanism's, which changes over the angle"},
    {"mean_driving_torque", "mean driving torque", "N*m", "", "2.2", "reduce",
     "mean over the angle of a cycle of all driving torques, reduced to the link by power at constant speed",
     "(1/Φ) ∮ M_d dφ", "a mean over time"},
    {"mean_resisting_torque", "mean resisting torque", "N*m", "", "2.2", "reduce",
     "mean over the angle of a cycle of all that brakes, reduced to the link by power at constant speed; positive when "
     "it brakes",
     "(1/Φ) ∮ M_c dφ", "a mean over time"},
    // modes
    {"natural_frequency", "natural frequency of a mode", "Hz", "", "12.2", "modes, sweep, uncertainty",
     "undamped natural frequency of the drive, linearised at the operating point: of inertias and springs, ascending, "
     "motor windings, controllers and other internal states of elements as they are",
     "K v = ω_n² M v",
     "the damped frequency ω_n √(1 − ζ²), nor a frequency that a winding or a controller brings about"},
    {"damped_frequency", "damped frequency of a mode", "Hz", "MODE", "12.3", "sweep, uncertainty",
     "frequency at which a mode dies out or grows, by its eigenvalue at the operating point, with all damping, slopes "
     "of "
     "motors and loads and internal states of elements; given for modes that oscillate",
     "ω_d = Im λ", "the natural frequency, which is undamped"},
    {"internal_frequency", "frequency of a mode of internal states", "Hz", "MODE", "12.3", "modes, sweep, uncertainty",
     "magnitude of the eigenvalue of a mode that grows out of no natural frequency: a motor's winding against inertia, "
     "a "
     "controller; its number follows those of the natural frequencies",
     "|λ|", "a natural frequency of the drive, which springs and inertias alone have"},
    {"damping_ratio", "damping ratio of a mode", "", "MODE", "12.3", "modes, sweep, uncertainty",
     "share of critical damping with which a mode dies out, by its eigenvalue at the operating point: what is left "
     "after a cycle is exp(−2πζ/√(1 − ζ²)); given for modes that oscillate",
     "ζ = −Re λ/|λ|", "the damping ratio that a coupling is given, which is of that coupling alone"},
    {"largest_amplitude", "largest amplitude at that speed", "N*m", "", "12.7", "modes",
     "the greatest of all joints' torque peaks above its mean in the steady forced motion of the linearised drive", "",
     "a peak torque: the mean is not in it, nor is anything not linear"},
    {"spot_amplitude", "amplitude at a speed of the range, by the nonlinear cycle", "N*m", "", "12.13", "modes",
     "the greatest departure of a joint's torque from its mean in the nonlinear cycle of the machine whose mean speed "
     "is held there, at the spot check with the highest use of the limits; among requested speeds only, where the "
     "linear response is off by most",
     "", "the steady motion: torques proportional to inertia hold the speed"},
    {"nominal_torque_verdict", "mean torque against T_KN", "N*m", "", "12.9", "modes",
     "K_A S_t times the mean of a joint's torque over a cycle of the steady motion", "K_A S_t |T_mean| ≤ T_KN",
     "a peak, nor the torque of a start"},
    {"maximum_torque_verdict", "largest torque from rest against T_Kmax", "N*m", "", "12.9", "modes",
     "the largest torque of a joint in a simulated start from rest to the steady motion, what starts add times S_z, "
     "all times S_t; without such a start a bound, the largest steady amplitude below the operating speed",
     "S_t (T_N + S_z T_S) ≤ T_Kmax", "the standard's estimate by shock and resonance factors"},
    {"vibratory_torque_verdict", "alternating torque against T_KW", "N*m", "", "12.11", "modes",
     "the largest departure of a joint's torque from its mean over a cycle of the steady motion, times "
     "S_t and the frequency factor of its harmonics",
     "S_t S_f T_W ≤ T_KW", "half the range from least to greatest torque; the amplitude of one order"},
    // forces
    {"reaction", "largest reaction in a joint", "N", "", "9.6", "forces",
     "greatest magnitude of the joint's force over the cycle, masses in motion included", "",
     "the force of the loads on the slider: peak_force"},
    {"reaction_moment", "largest moment in a slide", "N*m", "", "9.6", "forces",
     "greatest moment over the cycle that a slide's two bodies exert on each other, about the pin at which it is given",
     "", "a friction torque"},
    {"balancing_torque", "largest balancing torque", "N*m", "", "9.6", "forces",
     "torque on the crank that keeps the motion as prescribed", "", "what a motor gives, whose speed yields"},
    {"shaking_force", "largest shaking force", "N", "", "9", "forces",
     "greatest force on the frame by the inertia of what moves"},
    {"shaking_moment", "largest shaking moment", "N*m", "", "9", "forces",
     "greatest moment on the frame about the main bearing by the inertia of what moves"},
    {"film_parameter", "film parameter λ", "", "", "8.16", "forces",
     "smallest film of a pin's journal over the cycle, by its load and sliding speed at each position, over the root "
     "of the "
     "squared roughnesses of both surfaces: boundary friction below 1, mixed up to 3, fluid above",
     "λ = h_min/√(R_q1² + R_q2²)", "a bearing calculation: squeezing of the film is not in it"},
    // gears
    {"centre_distance", "centre distance", "mm", "", "6", "gears", "between the wheels' axes, as they run"},
    {"contact_ratio", "contact ratio ε_α", "", "", "6", "gears",
     "length of the path of contact over the base pitch: pairs in mesh on average", "ε_α = g_α/p_b",
     "the overlap of helical teeth, which is given beside it"},
    {"specific_sliding", "greatest specific sliding", "", "", "6", "gears",
     "sliding over rolling speed of a flank, at the worse foot"},
    {"backlash_angle", "backlash at wheel 1", "mrad", "", "6", "gears",
     "angle that wheel 1 may turn with wheel 2 held"},
    {"mesh_stiffness", "mesh stiffness about wheel 1", "N*m/rad", "", "6", "gears",
     "mean stiffness of the mesh as a torsional spring on wheel 1's shaft; its error is the method's own, 8 %"},
    // which model, which method
    {"coordinates", "coordinates", "", "", "14", "run",
     "independent coordinates of the compiled machine: shafts that are free and twists", "",
     "states: velocities and internal states are counted separately"},
    {"processor_time", "processor time of a run", "s", "", "", "compare, advise",
     "of one integration, without those that measure the errors"},
    {"change_with", "change with an effect that is off", "", "", "14.1", of_files,
     "change of a key figure when that effect alone is switched on in a run that has it off", "(on − off)/|off|",
     "the change when the effect is taken out of the fullest machine"},
    {"change_without", "change without an effect", "", "", "14.1", "effects",
     "greatest change of a telling figure when that effect alone is switched off", "|without − full|/|full|"},
    {"deviation", "deviation of the recommended model", "", "", "14.1", "advise",
     "greatest change of a telling figure against the fullest model, measured by running both"},
    {"sets_run", "sets of effects run", "", "", "14", "advise",
     "how many sets of effects were run before one was recommended"},
    {"settings_measured", "settings measured", "", "", "15", "accuracy",
     "how many combinations of model, method and tolerance were run"},
    // data of the scene: not printed by any command, but figures are confused with them
    {"rated_speed", "rated speed", "rad/s", "MOTOR", "4", "",
     "the catalogue's speed at rated power, a key of the scene", "",
     "the speed at which it runs in the machine: operating_speed, mid_speed"},
    {"synchronous_speed", "synchronous speed", "rad/s", "MOTOR", "4", "",
     "speed of an induction motor's field, 2π f over its pole pairs; without slip, so without torque", "",
     "the rated speed"},
    {"start_speed", "start speed", "rad/s", "", "1", "",
     "speed of the reduction link at the start of a run: `speed` in the scene's start", "",
     "a speed that the motion has later"},
};

}  // namespace kurbel::entries
