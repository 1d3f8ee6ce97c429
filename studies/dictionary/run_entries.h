// run_entries.h — meaning of channels, figures of a whole run and figures of one cycle.
#pragma once

#include "studies/dictionary/entries.h"

namespace kurbel::entries {

inline constexpr Definition of_channels_and_runs[] = {
    // shafts and what connects them
    {"angle", "angle of a shaft", "rad", "SHAFT", "1.1", of_files,
     "angle that the shaft has turned in its own direction of drive", "",
     "reduced to another shaft, or taken back to one turn"},
    {"speed", "speed of a shaft", "rad/s", "SHAFT", "1.1", of_files,
     "angular velocity of the shaft in its own direction of drive, at a moment", "", "a mean of anything"},
    {"twist", "twist of an elastic element", "rad", "COUPLING", "1.2", of_files,
     "how far its driving shaft is ahead of its driven one", "θ = φ_a − i φ_b"},
    {"slip", "slip of a contact", "rad/s", "COUPLING", "8", of_files,
     "speed of its driving shaft less that of its driven one", "ω_a − i ω_b",
     "an induction motor's slip, which is a part of the synchronous speed"},
    {"torque", "torque", "N*m", "COMPONENT", "1.2", of_files,
     "of a coupling what it transmits, positive when it drives its driven shaft; of a motor or load what it exerts on "
     "its shaft, positive when it drives forwards, at standstill with what it holds; of a prescribed speed what keeps "
     "its shaft at it",
     "", "reduced to another shaft"},
    {"spring_torque", "torque of a spring alone", "N*m", "COUPLING", "5.1", of_files,
     "the part of what an elastic element transmits that its twist gives", "τ = k θ",
     "what it transmits: without its damper's torque"},
    // mechanisms
    {"position", "position of what a mechanism moves", "m", "MECHANISM", "9", of_files,
     "of its slider along its line, of a screw's nut, a wedge's or a pinion's slide its travel; of what rocks its "
     "angle [rad]"},
    {"velocity", "velocity of what a mechanism moves", "m/s", "MECHANISM", "9", of_files,
     "of its slider along its line; of what rocks in rad/s"},
    {"acceleration", "acceleration of what a mechanism moves", "m/s2", "MECHANISM", "9", of_files,
     "of its slider along its line; of what rocks in rad/s²"},
    {"force", "force of the loads", "N", "MECHANISM", "10", of_files,
     "sum of the loads on its slider, positive towards its greatest x", "",
     "a reaction in a joint, or an inertia force"},
    {"load_torque", "torque of the loads on what rocks", "N*m", "MECHANISM", "10", of_files,
     "sum of the loads on its rocker", "", "reduced to the crank"},
    // peaks of a whole run
    {"peak_torque", "peak torque of a whole run", "N*m", "COUPLING", "1.2", of_runs,
     "the torque of greatest magnitude that the element transmits from the start of the run to its end, with its sign "
     "and its time",
     "τ(t*), |τ(t*)| = max |τ(t)|",
     "the peak of a steady cycle, which is cycle_peak_torque: a start or a stop counts here"},
    {"peak_spring_torque", "peak torque of a spring alone, of a whole run", "N*m", "COUPLING", "5.1", of_runs,
     "the spring torque of greatest magnitude during the run; of a rigid element its whole torque", "max |k θ(t)|",
     "what is transmitted: without its damper's torque"},
    {"peak_velocity", "peak velocity of a whole run", "m/s", "MECHANISM", "9", of_runs,
     "velocity of greatest magnitude of what the mechanism moves"},
    {"peak_acceleration", "peak acceleration of a whole run", "m/s2", "MECHANISM", "9", of_runs,
     "acceleration of greatest magnitude of what the mechanism moves"},
    {"peak_force", "peak force of the loads in a whole run", "N", "MECHANISM", "10", of_runs,
     "force of greatest magnitude that the loads exert on the slider", "", "a reaction in a joint: forces gives those"},
    {"peak_load_torque", "peak torque of the loads on what rocks, of a whole run", "N*m", "MECHANISM", "10", of_runs,
     "torque of greatest magnitude that the loads exert on the rocker"},
    // speeds of the reduction link, RMS torques, ends
    {"max_speed", "greatest speed of a whole run", "rad/s", "LINK", "2", of_runs,
     "greatest speed of the reduction link from the start of the run to its end", "max ω(t)",
     "the ω_max of δ, which is of one cycle: cycle_max_speed"},
    {"min_speed", "least speed of a whole run", "rad/s", "LINK", "2", of_runs,
     "least speed of the reduction link from the start of the run to its end: 0 after a start from rest", "min ω(t)",
     "the ω_min of δ, which is of one cycle: cycle_min_speed"},
    {"rms_torque", "RMS torque of a whole run", "N*m", "COUPLING", "5.1", of_runs,
     "root of the mean square over time of the torque transmitted, from the start of the run to its end",
     "√( (1/t) ∫ τ² dt )", "of a steady cycle, which is cycle_rms_torque"},
    {"rms_spring_torque", "RMS torque of a spring alone, of a whole run", "N*m", "COUPLING", "5.1", of_runs,
     "root of the mean square over time of the spring torque", "√( (1/t) ∫ (k θ)² dt )"},
    {"amplification", "amplification of a torque", "", "COUPLING", "14.2", "compare",
     "peak torque of the second model over that of the first, each at its own time; mostly elastic over rigid",
     "K = |τ_elastic| / |τ_rigid|", "a factor on the mean torque, or an application factor K_A"},
    {"final_angle", "angle at the end of the run", "rad", "COMPONENT", "1.1", of_runs,
     "angle of its driven shaft when the run ends"},
    {"final_speed", "speed at the end of the run", "rad/s", "COMPONENT", "1.1", of_runs,
     "speed of its driven shaft when the run ends", "", "a steady speed, unless the motion is steady by then"},
    {"steady_speed", "steady speed", "rad/s", "LINK", "11.6", of_runs,
     "mid speed of the last whole cycle before the drive goes off, where the motion is steady; without a cycle the "
     "speed at that time",
     "", "the operating speed, where mean torques taken at constant speed balance"},
    // times, angles and works
    {"run_up_time", "run-up time", "s", "", "11.6", of_runs,
     "from the start until the reduction link's speed enters for good the range of the last cycle, widened by a "
     "twentieth of it, but by 0.1 … 1 % of the steady speed; by 1 % if later cycles leave that range. Without a cycle "
     "steady speed ± 1 %. Of steady motion only, and not of a link that reverses within its cycle",
     "", "the time to 95 % of the steady speed, which is start_time"},
    {"run_down_time", "run-down time", "s", "", "2", of_runs,
     "from the moment at which the last driving source goes off for good to standstill: at rest, or below 0.1 % of the "
     "last mid speed for good",
     "", "the stopping time, which counts from a signal"},
    {"stopping_time", "stopping time", "s", "LINK", "8", of_runs,
     "from the signal of the operating sequence that makes the reduction link stop to its rest: the first step that "
     "takes a motor or a clutch away, reverses a motor or sets a brake, after the last that drove. Only where that "
     "happens",
     "", "the run-down time, which counts from the drive's end"},
    {"stopping_angle", "stopping angle", "rad", "LINK", "8", of_runs,
     "what the reduction link still turns in its stopping time"},
    {"time_above_*", "time above a level", "s", "LEVEL.OWNER", "", of_runs,
     "time during which the channel lies above the level of a [[figure]] of the scene, which the name has as it is "
     "given there: time_above_torque.40kN*m.main_coupling. step_time_above_torque.2.40kN*m.main_coupling is that in "
     "step 2 of the operating sequence, cycle_time_above_torque.40kN*m.main_coupling that in one steady cycle",
     "", "a share of the time; a number of crossings"},
    {"impacts", "impacts", "", "MECHANISM", "13", of_runs,
     "how often a joint with clearance is hit after flight during the run", "",
     "how often its contact bounces within a hit that never parts"},
    {"slip_heat", "heat of slipping", "J", "COUPLING", "1.3", of_runs,
     "what the slipping contact has turned into heat during the run; positive", "∫ |τ (ω_a − i ω_b)| dt",
     "a work with its sign: in the balance of energy it is harmful work, negative"},
    {"work", "work of a line of the energy balance, of a whole run", "J", "ACCOUNT", "1.3", of_runs,
     "sum of the works of all torques and forces of that account (driving, useful, harmful, weight), positive into the "
     "machine: useful and harmful work are negative as a rule",
     "A = ∫ M ω dt", "of one cycle: that is driving_work_per_cycle and its like"},
};

// Of the steady cycle, or of the last whole cycle of a run.
inline constexpr Definition of_a_cycle[] = {
    // speeds and times
    {"cycle_max_speed", "greatest speed of a cycle, ω_max", "rad/s", "LINK", "2.6", of_cycles,
     "greatest speed of the reduction link in one steady cycle", "ω_max = ω_mid (1 + ½ δ)",
     "that of a whole run, which is max_speed"},
    {"cycle_min_speed", "least speed of a cycle, ω_min", "rad/s", "LINK", "2.6", of_cycles,
     "least speed of the reduction link in one steady cycle", "ω_min = ω_mid (1 − ½ δ)",
     "that of a whole run, which is min_speed"},
    {"mid_speed", "mid speed ω_mid", "rad/s", "LINK", "2.6",
     "run, compare, effects, advise, accuracy, steady, size, sweep, uncertainty",
     "middle of the greatest and the least speed of one cycle: of the steady one, in a run of the last whole one "
     "before it runs down. δ and the flywheel refer to it; books call it the mean speed",
     "ω_mid = ½ (ω_max + ω_min)", "the mean over time, which is mean_speed"},
    {"mean_speed", "mean speed over time", "rad/s", "LINK", "2.7",
     "run, compare, effects, advise, accuracy, steady, forces, sweep, uncertainty",
     "angle that the reduction link turns in one cycle over the time that it takes: what a tachometer shows",
     "ω_mean = Φ/T = 2π n/T for n turns in the time T",
     "(ω_max + ω_min)/2, which is mid_speed; in a press the two may differ by 5 % and more"},
    {"delta", "speed fluctuation δ", "", "SHAFT", "2.6", of_both,
     "range of the speed within one cycle of motion that repeats, over its middle",
     "δ = (ω_max − ω_min)/ω_mid, ω_mid = ½ (ω_max + ω_min)",
     "of a whole run with its start, nor of motion that does not repeat (cycle_fluctuation), nor of a shaft that "
     "reverses within the cycle; an elastic machine has another δ at every shaft"},
    {"cycle_fluctuation", "fluctuation in the last cycle", "", "LINK", "2.6", of_runs,
     "as δ, of the last whole cycle of a run that is not steady, or drifts by a tenth of this or more in a cycle; none "
     "if most of it is drift",
     "(ω_max − ω_min)/ω_mid", "δ: run-up and drift are part of it, and another length of the run gives another value"},
    {"cycle_time", "time of a cycle", "s", "LINK", "2.7", of_both,
     "time in which the reduction link turns through one cycle: the least angle after which it is back in place, 2π of "
     "a crank, 4π of a four-stroke engine",
     "T = Φ/ω_mean", "the time after which all repeats, where that takes several cycles: period"},
    {"period", "period of the motion", "s", "", "11.1", of_both,
     "time after which all angles, speeds and times of the machine repeat: one cycle or several of them; in a run "
     "where "
     "that takes several cycles, or is the period of laws over time. Figures of a cycle are then of the whole period",
     "", "the cycle of the reduction link alone: cycle_time"},
    {"vibration_frequency", "frequency of a vibration about a place", "Hz", "", "11.1", "steady, sweep, uncertainty",
     "of a machine whose reduction link does not turn on average but vibrates: how often its motion repeats", "f = 1/T",
     "a natural frequency, which is natural_frequency.N; the two agree where nothing excites and damping is small"},
    {"vibration_amplitude", "amplitude of a vibration about a place", "rad", "SHAFT", "11.1",
     "steady, sweep, uncertainty",
     "half the way between the extreme angles of the shaft, of a machine whose reduction link does not turn on "
     "average",
     "½ (φ_max − φ_min)", "the amplitude of one order of the motion; for motion that is not a sine they differ"},
    // the same quantities for one steady cycle
    {"cycle_peak_torque", "peak torque of a steady cycle", "N*m", "COUPLING", "1.2", of_cycles,
     "the torque of greatest magnitude that the element transmits within one steady cycle, with its sign", "",
     "the peak of a whole run with its start and stop: peak_torque"},
    {"cycle_peak_spring_torque", "peak torque of a spring alone, of a steady cycle", "N*m", "COUPLING", "5.1",
     of_cycles, "the spring torque of greatest magnitude within one steady cycle", "",
     "what is transmitted: without the damper's part"},
    {"cycle_peak_velocity", "peak velocity of a steady cycle", "m/s", "MECHANISM", "9", of_cycles,
     "velocity of greatest magnitude of what the mechanism moves, within one steady cycle", "",
     "that of a whole run: peak_velocity"},
    {"cycle_peak_acceleration", "peak acceleration of a steady cycle", "m/s2", "MECHANISM", "9", of_cycles,
     "acceleration of greatest magnitude of what the mechanism moves, within one steady cycle", "",
     "that of a whole run: peak_acceleration"},
    {"cycle_peak_force", "peak force of the loads in a steady cycle", "N", "MECHANISM", "10", of_cycles,
     "force of greatest magnitude that the loads exert on the slider, within one steady cycle", "",
     "a reaction in a joint: forces gives those"},
    {"cycle_peak_load_torque", "peak torque of the loads on what rocks, of a steady cycle", "N*m", "MECHANISM", "10",
     of_cycles, "torque of greatest magnitude that the loads exert on the rocker, within one steady cycle", "",
     "that of a whole run: peak_load_torque"},
    {"peak_drive_torque", "peak torque of a drive in a steady cycle", "N*m", "MOTOR", "4", of_cycles,
     "the torque of greatest magnitude that the drive exerts on its shaft within one steady cycle", "",
     "its starting or breakdown torque"},
    // torques over time, works
    {"cycle_rms_torque", "RMS torque of a steady cycle", "N*m", "COUPLING", "5.1", of_cycles,
     "root of the mean square over time of the torque transmitted, over one steady cycle", "√( (1/T) ∫ τ² dt )",
     "of a whole run, which is rms_torque"},
    {"mean_drive_torque", "mean torque of a drive", "N*m", "MOTOR", "4", of_cycles,
     "mean over time of the drive's torque on its shaft, over one steady cycle", "(1/T) ∫ M dt",
     "the mean over the angle, by which the work of a cycle is had"},
    {"rms_drive_torque", "RMS torque of a drive", "N*m", "MOTOR", "4", of_cycles,
     "root of the mean square over time of the drive's torque, over one steady cycle: what heats a motor",
     "√( (1/T) ∫ M² dt )", "its rated torque; their ratio is the thermal use"},
    {"driving_work_per_cycle", "driving work of a cycle", "J", "", "1.3", of_both,
     "work of all that drives, over one cycle; positive into the machine", "A = ∮ M dφ",
     "of a whole run: that is work"},
    {"useful_work_per_cycle", "useful work of a cycle", "J", "", "1.3", of_both,
     "work of the loads of the process, over one cycle; negative, because it leaves the machine", "A = ∮ M dφ",
     "of a whole run: that is work"},
    {"harmful_work_per_cycle", "harmful work of a cycle", "J", "", "1.3", of_both,
     "work of friction and damping, over one cycle; negative, because it leaves the machine", "A = ∮ M dφ",
     "of a whole run: that is work"},
    {"weight_work_per_cycle", "work of weights over a cycle", "J", "", "1.3", of_cycles,
     "work of gravity over one cycle; nothing where what moves comes back to its height", "A = ∮ M dφ",
     "of a whole run: that is work"},
    {"work_per_cycle", "work of one account over a cycle", "J", "COMPONENT (account)", "1.3", of_cycles,
     "work of one component in one account, over one steady cycle; positive into the machine", "A = ∮ M dφ",
     "the sum over a line of the balance"},
    // oscillating quantities, over the link's angle
    {"speed_order", "amplitude of an order of a speed", "rad/s", "ORDER.SHAFT", "11.10", of_cycles,
     "amplitude of the part of a shaft's speed that oscillates ORDER times in a turn of the reduction link, in steady "
     "motion, over the link's angle; a cycle of two turns has halves. Of a vibration about a place: ORDER times in its "
     "period, over time. Given are those of at least 1 % of the largest",
     "x(φ) = x̄ + Σ a_r cos(r φ − ψ_r)",
     "half of what the speed goes from its least to its greatest value, which all orders make together"},
    {"speed_order_phase", "phase of an order of a speed", "deg", "ORDER.SHAFT", "11.10", of_cycles,
     "ψ_r of that part: it is greatest where ORDER times the angle of the reduction link is ψ_r; of amplitudes beyond "
     "their error",
     "x(φ) = x̄ + Σ a_r cos(r φ − ψ_r), −180° < ψ_r ≤ 180°",
     "an angle of the link, which is ψ_r over the order; a lead over some other order"},
    {"angle_order", "amplitude of an order of a vibration", "rad", "ORDER.SHAFT", "11.10", of_cycles,
     "amplitude of the part of a shaft's angle that oscillates ORDER times in the period of a vibration about a place, "
     "in "
     "steady motion, over time. Given are those of at least 1 % of the largest",
     "φ(t) = φ̄ + Σ a_r cos(2π r t/T − ψ_r)",
     "half the way between the extreme angles, which all orders make together: vibration_amplitude"},
    {"angle_order_phase", "phase of an order of a vibration", "deg", "ORDER.SHAFT", "11.10", of_cycles,
     "ψ_r of that part: it is greatest where ORDER times 360° t/T is ψ_r; of amplitudes beyond their error",
     "φ(t) = φ̄ + Σ a_r cos(2π r t/T − ψ_r), −180° < ψ_r ≤ 180°", "an angle of the shaft"},
    {"torque_order", "amplitude of an order of a torque", "N*m", "ORDER.COMPONENT", "11.10", of_cycles,
     "amplitude of the part of a torque that oscillates ORDER times in a turn of the reduction link, in steady motion, "
     "over the link's angle; a cycle of two turns has halves. Of a vibration about a place: ORDER times in its period, "
     "over time. Given are those of at least 1 % of the largest",
     "x(φ) = x̄ + Σ a_r cos(r φ − ψ_r)",
     "of the linear forced response at a constant speed, which modes gives; the alternating torque of all orders"},
    {"torque_order_phase", "phase of an order of a torque", "deg", "ORDER.COMPONENT", "11.10", of_cycles,
     "ψ_r of that part: it is greatest where ORDER times the angle of the reduction link is ψ_r; of amplitudes beyond "
     "their error",
     "x(φ) = x̄ + Σ a_r cos(r φ − ψ_r), −180° < ψ_r ≤ 180°",
     "an angle of the link, which is ψ_r over the order; a lead over some other order"},
};

}  // namespace kurbel::entries
