// run_findings.h — findings of one run, and of two models compared.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/run/compare.h"

namespace kurbel {

// Files: trajectory.csv; for a comparison one per model. The result must outlive the findings.
// `rigid`: the same machine without elasticity, drawn behind it.
Findings findings_of(const Result& result, const Result* rigid = nullptr);
Findings findings_of(const Comparison& comparison);
// Key figures at the top of the page.
std::vector<KeyFigure> key_figures_of(const Result& result);
std::vector<KeyFigure> key_figures_of(const Comparison& comparison);
// Chapters after the figures, for studies that tried the rigid machine or effects that are off; not shown if empty.
inline constexpr const char *chapter_of_rigid = "The rigid machine", *chapter_of_trials = "Effects that are off",
                            *chapter_of_cost = "Energy, cost, events",
                            *chapter_of_model = "What was on, what was merged, and why";

// --- words (run_words.cpp) ---

// No account has done work, and stored energy has not changed: the energy balance proves nothing.
bool nothing_turned_over(const EnergyBalance& energy);
// The link turns in both senses within the period: δ and a run-up mean nothing for it.
bool reverses_within_cycle(const Result& result);
// False for figures without a value in a run that broke off, and for what means nothing for a link that reverses.
bool is_reported(const Figure& figure, const Result& result);
// False for a run that broke off before its works were computed.
bool has_works(const Result& result);
// Result of the energy balance: "energy balance closed to 1e-9 of the energy converted"; without work and change of
// energy a sentence that nothing is proved.
std::string reported(const EnergyBalance& energy);

// "peak_torque.main_coupling" → "peak torque, main_coupling"
std::string in_words(const Figure& figure);
std::string sure(const Figure& figure);         // value, error, unit in SI
SpeedUnit speed_unit_of(const Result& result);  // of its scene
// Not known where its error exceeds it: of several equal extremes, each run may find another one.
bool has_known_time(const Figure& figure);
std::string at_time(const Figure& figure);  // "at 1.23 s"; empty: at none
// For a peak of the vibration in which a run begins: the machine turns at once, in no steady motion, and the peak within
// its first cycle is not reached again. The largest magnitude in the second half of the run, from the rows; empty: the
// peak is another.
std::optional<double> largest_after_start(const Result& result, const Figure& peak);
// ", in the vibration with which the run begins; in its second half at most 490 N·m"; empty: it is another peak.
std::string words_of_start(const Result& result, const Figure& peak);
const Figure* largest_peak(const Result& result);  // of torque in any coupling
const Figure* first_of(const Result& result, const QuantityKind& what);

// "crank angle", or "angle of motor" if the reduction link is no mechanism.
std::string angle_of_link(const Result& result);
// What figures of a cycle belong to: "cycle", or "period of 3 turns" if the motion repeats after several.
std::string cycle_of_figures(const Result& result);
// What a mechanism moves: "slider", "rocker"; of a linkage whose output is a point: "output".
std::string moved_part(const Model& model, const std::string& mechanism);

// For cranks that cannot rotate fully.
std::vector<std::string> notes_on_arcs(const Model& model);
// The requested figures, in a sentence without a full stop.
std::string figures_in_words(const Result& result);
// Sentences before its figures, and after them.
std::vector<std::string> model_words(const Result& result);
std::vector<std::string> balance_words(const Result& result);

// --- the animated machine, and plots of one run or of two models superposed (machine_view.cpp, run_plots.cpp) ---

// The last one in front.
using Results = std::vector<const Result*>;

inline constexpr std::size_t most_torque_plots = 8;

// Whether there are traces of a machine that moved.
bool drawable(const Results& results);
// Couplings by the size of their peak torque, the largest first; of a shaft that is divided the place with the largest.
std::vector<std::string> couplings(const Result& result);

MachineView machine_view(const Results& results);
std::vector<Plot> motion_plots(const Results& results);
// Torque, power and current of drives; slip speed of slipping contacts, and the heat generated.
std::vector<Plot> drive_plots(const Results& results);

// --- shared by findings of one run and of two compared (result_findings.cpp) ---

// For programs; without title, scene and completion.
Record result_record(const Result& result);
// Equidistant rows, and between them one at each extreme that is a figure.
DataTable trajectory_data(const Result& result);
// A note if a peak exceeds all equidistant rows by more than 5 %; `steps` of the run give a sufficient number of rows.
std::string coarse_rows_note(const TrajectoryRecorder& trajectory, std::int64_t steps);

// The animated machine and its plots: the page's first chapters.
void show_motion(Findings& findings, const Results& results);
// One row per period of a steady motion, with the same borders as everywhere; they close: ΔE is the sum of the works.
void show_works_of_periods(Findings& findings, Chapter in, const Result& result);
void show_delta_formulas(Findings& findings, Chapter in, const Results& results);
// Audit, statistics, events, explanation, scene: the page's last chapters.
void show_background(Findings& findings, const Results& results);

// Causes of a run's short steps; empty if the equations cannot be evaluated at its end.
std::vector<LimitedSteps> limits_of(const RunOutcome& outcome, Equations& equations);

}  // namespace kurbel
