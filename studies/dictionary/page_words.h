// page_words.h — what stands on pages beside figures and symbols: headings of tables, rows, axes and legends.
//
// Names of one meaning share a row, separated by "; "; a star stands for any part. Units are omitted where two
// quantities do not share a heading. The longest name that fits is taken.
#pragma once

#include "studies/dictionary/entries.h"

namespace kurbel {

// The words of a name that is no figure.
inline constexpr std::string_view word_of_pages = "on pages";

}  // namespace kurbel

namespace kurbel::entries {

struct PageWord {
  std::string_view names, verbs, is;
};

inline constexpr std::string_view of_all = "every command that makes a table or plot";
inline constexpr std::string_view of_trains = "modes, report";
inline constexpr std::string_view of_models = "effects, advise, accuracy";

inline constexpr PageWord of_pages[] = {
    // every page
    {"figure; key figure; quantity", of_all,
     "name of the figure in this row; `kurbel explain NAME` says what it means"},
    {"value; values", of_all,
     "of the figure or key in this row, in the unit beside it; where counted: how many there are"},
    {"unit", of_all, "in which value and numerical error of this row are given"},
    {"numerical error; numerical errors; ±; ± ζ; numerical error [*]; ± [*]", of_all,
     "by how much the value may differ from the exact solution of the same equations, measured by further runs; not "
     "the error of the model"},
    {"rigid; rigid machine; rigid model", of_all, "of the machine with rigid shafts: one degree of freedom"},
    {"elastic; elastic machine; elastic model; elastic: *", of_all,
     "of the machine with the elastic shafts that its scene names; after a colon: only with these"},
    {"simulated; elastic, simulated; rigid, simulated; simulated, *", "run, size, forces",
     "of the motion that a run or a steady cycle gives, not of a prescribed one"},
    {"measured", "run, steady, fit", "of a record from a test, as the file has it"},
    {"time; time [s]", of_all, "simulated time since the start of the run; of a processor it is in ms"},
    {"first at; last at; times; mean interval", "run, compare",
     "of events of one kind in a run: when the first and the last of them was, how many there were, and the mean time "
     "from "
     "one to the next"},
    {"at; at [s]; at [rpm]; at [mm]", of_all,
     "where the value beside it occurs: time, angle, speed, or distance along a guide, by the unit"},
    {"from; to; range from", of_all,
     "ends of a range; of an event the state before and after; of a rainflow count the least and greatest torque of "
     "the class"},
    {"of; in; by; where; what; why", of_all,
     "the component, figure, file or reason to which the rest of the row refers"},
    {"mean; mean [*]; mean, linear", of_all, "mean over the cycle, or over the samples"},
    {"RMS; RMS [*]; root mean square", of_all, "root of the mean square of the quantity in this table"},
    {"peak; peak, linear; peak of *", of_all, "value of greatest magnitude in the cycle or in the run"},
    {"largest; least; most; largest [*]; least [*]; most [*]", of_all, "greatest or least value in the cycle"},
    {"amplitude; amplitude [*]; its amplitude; relative amplitude; sum of amplitudes; Σ of amplitudes; amplitude of *",
     "steady, modes, report",
     "half the range of one harmonic; of a mode relative to its largest; of a torque in the forced response the "
     "largest "
     "deviation from its mean; of a shaft's stress half its range, (τ_max − τ_min)/2; Σ: of all harmonics, as if they "
     "peaked together"},
    {"phase; phase [*]", "steady, modes, fit", "of a harmonic: cos(n φ + phase), φ the angle of the reduction link"},
    {"order; order *; strongest order; all orders; * · *×; * · *× *; * · mesh *", "steady, modes, report, forces, fit",
     "harmonic per turn of the shaft named beside it: order 2 occurs twice per turn; `mesh`: teeth per turn"},
    {"torque; peak of the torque; transmitted torque", of_all, "in the part that is named beside it"},
    {"energy; share of the energy; energy, work since the start", of_all,
     "kinetic energy, energy of springs and work; of a mode the share of its parts"},
    {"inertia; inertia [*]", of_all,
     "moment of inertia of the row's part, about its own axis unless it is said to be reduced"},
    {"share; share [*]", of_all, "of the row in the sum that the title of the table names"},
    {"crank angle; engine angle; * angle; angle of *", of_all, "angle of the shaft named, over one cycle"},
    {"travel; slider speed; output speed", "run, compare", "position and velocity of what the mechanism moves"},
    {"transmission angle; transmission angle of *", "forces, reduce",
     "between coupler (or rod) and the link or line that it drives; 90° transmits best, below some 40° friction may "
     "jam it; the least of the cycle is shown"},
    {"time ratio", "forces, reduce", "of the slower stroke's crank angle to the quicker one's (quick return: > 1)"},
    {"dead centre; dead centres; folded dead centre; extended dead centre", "forces, reduce",
     "crank angles where the output stands and turns back: crank and coupler (or rod) lie in one line, folded over "
     "each other or extended"},
    {"stroke", "forces, reduce", "way or angle of the output from one dead centre to the other"},
    {"linkage of class *; class of a linkage; RRR; RRP; RPR; dyad", "forces, reduce",
     "Assur's class by the groups of links that close it: II of dyads alone, named by their joints, R turning, P "
     "sliding"},
    {"Grashof; Grashof's condition; crank-rocker; crank–rocker; drag link", "forces, reduce",
     "of a four-bar: the shortest link turns fully where shortest and longest together are less than the two others "
     "(theory 9)"},
    {"note", of_all, "on this row alone"},
    {"UR M68; UR M68, *", of_trains,
     "rule of the classification societies on torsional vibration of propulsion shafts: permissible stresses τ_C for "
     "continuous running and τ_T in passing, and barred ranges of speed around a resonance (theory 12.16)"},
    {"resonance passed", of_trains, "load case: a critical speed below the operating speeds, passed at each start"},
    {"kept; WITHIN; not kept; within the margin", of_trains,
     "separation margin: kept if the excitation stays farther from the natural frequency than is required"},
    {"spot check; spot checks; spot check at *", of_trains,
     "the linear response compared with a cycle of the full nonlinear equations whose mean speed is held"},
    {"periodic system; exponents of the periodic system", of_trains,
     "equations linearised about a cycle, whose coefficients change within it: Floquet's exponents (theory 12.3)"},
    {"internal states; states of *; torques that follow speeds", of_trains,
     "damping or energy of a mode in quantities other than angles and speeds of shafts (currents, lagging torques), or "
     "in torques of motors and loads that depend on speed"},
    {"branch of the drive; main line; branch *", "reduce, report",
     "the chain from its first inertia on, and what branches from it, each drawn in a row of its own"},
    {"severity; stability", of_trains,
     "severity: the largest torque where an excitation meets a mode, and its share of the limit; stability: whether "
     "small deviations from the motion decay"},
    {"component; element; part; joint; shaft; link; elastic element; line; point", of_all,
     "name of the scene's part, of a link of its mechanism, of an account of work, or of a point of the path of "
     "contact"},
    {"key; unknown", "uncertainty, diff, fit, sweep",
     "COMPONENT.KEY of the scene; `kurbel keys KIND` says what it means"},
    {"—; …", of_all, "none, not known, or omitted rows"},
    // a run
    {"elastic/rigid; ratio", "compare, report", "value of the elastic model over that of the rigid one"},
    {"off; on; effect; effects; effects on; omitted; none; elasticity; elasticity *; joint friction; backlash; mesh "
     "variation; transients; torque lag; relaxation; bearing friction; gear losses; joint clearance; flexible rod; "
     "gravity; variable inertia; load edges; load edge",
     "run, compare, effects, advise",
     "physical effects of the model (docs/effects.md), and key figures without and with the one in this row"},
    {"kinetic energy; kinetic energy at *; stored in springs; stored in springs at *; energy balance closes to; energy "
     "drift",
     of_files, "parts of the energy balance; what it leaves over is relative to the energy converted (theory 1.3)"},
    {"driving; useful; harmful; weight; friction; * (driving); * (useful); * (harmful); * (weight); open; work of a "
     "cycle",
     of_all,
     "accounts of the work: of drives, of loads, of friction and losses, of weights; open: residual of the balance"},
    {"states; steps; rejected steps; evaluations; evaluations of the equations; right-hand sides; Jacobians; runs; "
     "events; "
     "nonzeros; guards",
     "run, compare, effects, advise, accuracy",
     "counts of a run: its state variables, its steps, how often its equations and their derivatives were evaluated, "
     "its events; nonzeros of the Jacobian and switching functions of the model"},
    {"method; accuracy measured; requested accuracy; tolerance; tolerance * %", "run, compare, accuracy, advise",
     "integrator, and relative error per step or of the figures that was requested"},
    {"adams; bdf; dop853; dopri5; dormand_prince_853; esdirk; esdirk3; esdirk5; fehlberg8; verner6; energy method; "
     "work",
     "run, accuracy", "integrators (engine/steppers); work: the rigid machine by its work equation over the angle"},
    {"sequence; run up; steady motion; steady motion, *; middle of its vibration", "run, report, modes",
     "parts of the motion: operating sequence of the scene: its steps switch clutches, brakes and drives"},
    {"the first; the second; difference; relative; more than the errors", "diff",
     "figures of both machines, their difference, the same over the first, and whether it exceeds both numerical "
     "errors"},
    {"rises; falls", "diff, steady", "sign of the change"},
    {"thermal load; thermal load of *", "run, compare, steady",
     "of a motor: RMS torque over its rated torque, the figure thermal_use; above 100 % it overheats"},
    // steady
    {"multiplier; multipliers; Floquet multiplier; Floquet multipliers; magnitude; halves in cycles; real part; "
     "imaginary part; unit circle",
     "steady",
     "Floquet multipliers μ: factors of small deviations over one cycle, stable inside of |μ| = 1; halves in ln 2/(−ln "
     "|μ|)"},
    {"mean torque over a cycle; drive M_d; loads M_c; stable", "steady",
     "of drive and loads over the speed; they meet at operating speeds, stable where the drive's falls below the "
     "loads'"},
    {"ratio to the link; fastest; time to * of the steady speed; time to * of the present steady speed", "steady, size",
     "of each shaft over the reduction link; a start of the rigid machine"},
    {"slot: *; slot [N]; lever bearing*; block; pin; №", "forces, reduce",
     "joints of a mechanism, and what acts in them: reactions in N, moments in N·m; №: number of the position"},
    {"sliding speed; sliding speed [m/s]; boundary λ < 1; mixed λ < 3", "forces, gears",
     "of one surface against the other; shares of the cycle with boundary and with mixed friction, by the film "
     "parameter λ"},
    {"absolute pressure; rocker speed", "run, compare", "pressure in a cylinder; speed of a rocking output"},
    // size
    {"I_drive − 1.1 I_motor − I_gearbox", "size",
     "the flywheel by the customary formula, which allows a tenth of the motor's inertia for couplings and omits the "
     "other parts (theory 3.1)"},
    {"against exact; flywheel sized by; cycles; punch-press form; motor's slope counted; neglecting "
     "I_em; Mertsalov; Wittenbauer; Wittenbauer (exact); rigid, work equation; sized, *; scene as it is, *",
     "size",
     "methods of sizing (theory 3), their deviation from Wittenbauer's, and the machine with the flywheel that they "
     "give"},
    {"tangent of slope ½ *; touching points; extremes, *; intercepts; ΔT over I_em; A", "size",
     "Wittenbauer's diagram and the works: tangents at greatest and least speed; extremes of the energy where M_d = "
     "M_c; on a sheet of a mechanism A is a pin"},
    {"material; outer diameter D; hub diameter D/5; breadth b; thickness of the rim h *; spokes (elliptical); mass of "
     "*; rim's share of the inertia; energy stored at ω_max; rim speed at ω_max; stress of a free rim ρ v²; stress "
     "with bending between spokes; safety against tensile strength; sum",
     "size",
     "a rim on six spokes with the inertia that is required (theory 3.7), and its stresses at the greatest speed"},
    // reduce
    {"own; reduced; own c; reduced c; speed ratio i; J*; k*-*; ∛(J/J_max); compliance from the first inertia",
     "reduce, report",
     "the drive as a chain: inertias J and stiffnesses k (damping c) on their own shafts, and times i² on the "
     "reduction link"},
    {"* positions; position", "reduce, forces", "positions of the crank for which the table is made"},
    // forces
    {"along; along *; across; across [*]; ahead of it; order * across; order * along; shaking; point of action",
     "forces",
     "components of a force along the stroke, the link or the guide, and across it; at which point of the guide it "
     "acts"},
    {"* pin; pin *; main bearing; rocker bearing; slide *; guide; * bearing: *; * pin: *; pin *: *", "forces, run",
     "reaction in this joint of the mechanism; the links it joins stand after the colon"},
    {"crank; coupler; rod; rocker; slider; ram; press", "forces, run", "link of the mechanism, or its mechanism"},
    {"m a; −I ε; of I_r; of T", "forces",
     "inertia force and couple of a link; its share in I_r and in the kinetic energy"},
    {"prescribed; prescribed: *", "forces",
     "of a motion at constant speed, or of the given one, without its drive's yielding"},
    {"counterweight; m·r; share of reciprocating; as it is; rotating masses; rotating masses and half the "
     "reciprocating ones",
     "forces",
     "mass times radius of a counterweight on the crank, by the masses that it balances; as it is: of the scene"},
    {"moment; moment [*]", "forces", "of a force about the pin or the bearing that the title names"},
    // modes, report
    {"mode; shape", of_trains,
     "mode of vibration by its number, ascending; parts with the largest amplitudes of the mode; `against`: in "
     "opposite phase"},
    {"f [Hz]; f_n; frequency; frequency [Hz]; f damped; |λ|; held at angles; periodic system, ζ; periodic system [Hz], "
     "ζ; first natural frequencies; first natural frequencies [Hz]",
     of_trains,
     "frequencies of a mode: undamped; damped; magnitude of the eigenvalue; range with the mechanism held at its "
     "angles; of the Floquet system of the cycle"},
    {"ζ; damping by", of_trains,
     "damping ratio of the mode by its eigenvalue, and the parts that dissipate its energy"},
    {"energy of the damped mode; twist energy in; kinetic energy in; nature", of_trains,
     "shares of the parts in the mode's energy; nature: mechanical, or of a winding or a controller"},
    {"excitation; meet at; order meets mode at; largest response at; meetings, larger ones severer; severity where "
     "they meet",
     of_trains, "where a harmonic of a torque equals a natural frequency, and the amplitude of the response there"},
    {"margin [%]; margin at it [%]; nearest margin; ± 10 %; within ± 10 % *; 95 % of it by tolerances; kept with "
     "probability; as given",
     of_trains,
     "separation margin: meeting speed (undamped), or speed of the largest response, over the nearest operating speed, "
     "less one; required 10 %; its range by tolerances"},
    {"in the cycle; in the steady motion; linear − cycle; linear − steady motion; in the nonlinear cycle; linear drive",
     of_trains, "the linear response beside the same of the nonlinear cycle, and the difference of both"},
    {"limit; limit there; limits; use; requirement; load case; load; factors; of the standard; share of the limit; "
     "allowed there; allowed at *; allowed by its manufacturer; barred because of; barred; barred [*]",
     "run, modes, report",
     "a component's limit, the load of the load case with its factors, and use = load over limit; barred: range of "
     "speeds where it is exceeded"},
    {"T_KN", of_trains,
     "nominal torque of a coupling by its manufacturer, for the mean torque of steady motion (DIN 740-2)"},
    {"T_Kmax; T_K max", of_trains,
     "maximum torque of a coupling by its manufacturer, for the peaks of starts and shocks (DIN 740-2)"},
    {"T_KW", of_trains, "vibratory torque of a coupling by its manufacturer: lasting amplitude at 10 Hz (DIN 740-2)"},
    {"P_KW; P_W", of_trains, "power that a coupling's damping may take, and that it takes (DIN 740-2)"},
    {"T_N; T_mean; T_S; T_W", of_trains,
     "torques in a coupling: mean; peak above it at a start; largest deviation from the mean in steady motion"},
    {"K_A; S_t; S_f; S_z", "run, modes, report",
     "factors on torques: application; temperature; frequency √(f/10 Hz); number of starts (theory 12.9)"},
    {"critical speed; critical speeds", of_trains,
     "speed at which the frequency of an order equals a natural frequency"},
    {"barred range; barred ranges; barred speed range; barred speed ranges", of_trains,
     "speeds at which the load of a part would exceed its limit, or where it has none its rated torque, if the machine "
     "stayed there"},
    {"separation margin; separation margins", of_trains,
     "distance of the speed where an excitation meets a natural frequency from the nearest operating speed, in "
     "percent"},
    {"τ_C, *; τ_T, *", "report", "stresses allowed for continuous running and for quick passing (IACS UR M68)"},
    {"order of the inertia; around; variation ε; half width; state", "modes",
     "parametric instability: ranges of speed 2 ω_n/order in which the varying inertia makes a mode grow"},
    {"dissipated; case; cases; set; in frequency; in time; machine; scene; verdict; operating speeds; misfires; "
     "cylinder * "
     "misfires; beside it; file; distribution",
     of_trains,
     "power in a coupling's damping; cases of failure and what they change; sources and tolerances of the data"},
    // gears
    {"B; C; wheel 1; wheel 2; without shift, x = 0; of the wheels; of the mesh; symbol", "gears",
     "data of wheel 1, of wheel 2, or of both in mesh; on a sheet of a mechanism B and C are pins"},
    {"g [mm]; place on the path of contact g; v_g/ω₁", "gears",
     "distance from the pitch point along the path of contact, and sliding there"},
    {"transverse tooth thickness s_t; tooth thickness *; on the working circle; at the tip, normal; the same, "
     "transverse; width",
     "gears", "of the teeth, along the reference circle or where it is said; normal: across the tooth"},
    {"teeth; profile shift; generating shift; sum of shifts*; least shift *; least teeth *", "gears",
     "numbers of teeth and shifts in modules: generating: as cut, with the allowance for backlash (theory 6)"},
    {"* diameter; diameter where *; bore, *; greatest tip diameter *; base circle; reference circle, *; tip clearance; "
     "tip shortening; reference centre distance; radius; base pitch; pitch",
     "gears", "dimensions of the wheels (theory 6)"},
    {"pressure angle; pressure angle, *; working pressure angle; base helix angle; overlap ratio; total contact ratio",
     "gears", "angles and contact ratios of the mesh (theory 6)"},
    {"margin against tip fouling", "gears", "angle by which the tips of an internal pair pass each other"},
    {"backlash *; mesh stiffness *; stiffness of a pair *; torsional mesh stiffness *", "gears",
     "backlash along the circle, the normal or as an angle; stiffness of the teeth in contact (theory 6.13)"},
    {"along the reference circle; specific sliding ζ; from the wheel's axis; rack*; its datum line; flank of *; "
     "sliding speed over *",
     "gears",
     "how the rack cuts the flank, drawn position by position; sliding of the flanks along the path of contact"},
    // effects, advise, accuracy
    {"greatest change; greatest change of *; change; change when omitted; change of *; from zero", of_models,
     "of the key figures when this effect alone is switched, relative to the value beside it"},
    {"advice; criteria; check; loads *; speeds *; within; outside; full model; chosen: *; greatest deviation *; "
     "deviation",
     "advise",
     "whether an effect is needed, by which criteria; figures and operating points kept for a check; within the "
     "tolerance"},
    {"time ×; time with *; time [ms]; time of *; spread", "effects, advise, accuracy, compare",
     "processor time of one integration; ×: over that with the effect on; spread: of repetitions"},
    {"model; reference by; agreement of motion; model error; error; error of *; total error; largest error *; front; "
     "Pareto front; numerical error as large as the model's; multibody",
     "accuracy",
     "errors against a reference by two other methods, of the motion and of each figure; total: with that of the "
     "model; front: nothing is both faster and more accurate"},
    // sweep, uncertainty, fit
    {"parameter; variants; row; rows; greatest; mean along the parameter; computed alone", "sweep",
     "a varied key; rows are its variants; over them the range of a figure and its largest numerical error; the "
     "command that computes one alone"},
    {"first order; total; share of the variance", "sweep",
     "Sobol's indices: share of a figure's variance that the parameter causes alone, and with its interactions"},
    {"deviation by gradients; by samples; deviation without it; samples; 95 % from; noise floor; numerical noise; "
     "step; of its value; where it comes from; all tolerances, *; tolerance of *",
     "uncertainty",
     "standard deviation of a figure by the tolerances of the scene: linear, and of samples; without: if the row's "
     "value were exact; noise: part that numerical errors explain; step: of the gradient, in deviations of the value"},
    {"hold; beyond; within their error; without the figure; probability from", "uncertainty, sweep",
     "samples that keep the limit, exceed it, are undecided within their numerical error, or lack the figure; 95 % "
     "interval"},
    {"record; channel; fitted; left; measured − fitted; standard error; correlation; correlation length; of the range; "
     "over the scatter; scatter of the mean",
     "fit",
     "fitted values beside the measured ones, and their residuals: over the measured range and over the standard error "
     "of the mean; correlation length: as many values count as one"},
};

}  // namespace kurbel::entries
