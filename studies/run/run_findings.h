// run_findings.h — what is said of one run, and of two models compared.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/run/compare.h"

namespace kurbel {

// Files: trajectory.csv, of a comparison one per model. The result must outlive the findings.
// `rigid`: the same machine without elasticity, drawn behind it.
Findings findings_of(const Result& result, const Result* rigid = nullptr);
Findings findings_of(const Comparison& comparison);
// What the page begins with.
std::vector<KeyFigure> key_figures_of(const Result& result);
std::vector<KeyFigure> key_figures_of(const Comparison& comparison);
// Chapters behind the figures, for whoever has tried the rigid machine or the effects that are off; empty, they are not
// shown.
inline constexpr const char *chapter_of_rigid = "The rigid machine", *chapter_of_trials = "Effects that are off",
                            *chapter_of_cost = "Energy, cost, events",
                            *chapter_of_model = "What was on, what was merged, and why";

// --- words (run_words.cpp) ---

// No account has done work, and what is stored is what it was: a balance of energy proves nothing.
bool nothing_turned_over(const EnergyBalance& energy);
// Left out is what has no value in a run that broke off, because its motion had lost it.
bool is_told(const Figure& figure, const Result& result);
// A run that broke off before its works were drawn up has none to show.
bool has_works(const Result& result);
// What the energy balance proves: "energy balance closed to 1e-9 of the energy turned over"; of a run in which no work
// is done and no energy changes its form nothing, which is said instead.
std::string told(const EnergyBalance& energy);

// "peak_torque.main_coupling" → "peak torque, main_coupling"
std::string in_words(const Figure& figure);
std::string sure(const Figure& figure);            // value, error, unit in SI
SpeedUnit speed_unit_of(const Result& result);     // of its scene
std::string at_time(const Figure& figure);         // "at 1.23 s"; empty: at none
const Figure* largest_peak(const Result& result);  // of torque in any coupling
const Figure* first_of(const Result& result, const QuantityKind& what);

// Of cranks that cannot turn.
std::vector<std::string> notes_on_arcs(const Model& model);
// The figures asked for, in a sentence without a full stop.
std::string figures_in_words(const Result& result);
// Before its figures, and behind them.
std::vector<std::string> model_words(const Result& result);
std::vector<std::string> balance_words(const Result& result);

// --- the moving machine, and plots of one run, or of two models over each other (machine_view.cpp, run_plots.cpp) ---

// The last in front.
using Results = std::vector<const Result*>;

inline constexpr std::size_t most_torque_plots = 8;

// There are traces, of a machine that moved.
bool drawable(const Results& results);
// Couplings by the size of their peak torque, the largest first.
std::vector<std::string> couplings(const Result& result);

MachineView machine_view(const Results& results);
std::vector<Plot> motion_plots(const Results& results);
// Torque, power and current of what drives; of what slips by how much, and the heat that this makes.
std::vector<Plot> drive_plots(const Results& results);

// --- what findings of one run and of two compared share (result_findings.cpp) ---

// For programs; without title, scene and completion.
Record result_record(const Result& result);
// Equidistant rows, and between them one at each extreme that is a figure.
DataTable trajectory_data(const Result& result);
// Where a peak goes by more than 5 % beyond all equidistant rows; `steps` of the run tell how many rows would follow it.
std::string coarse_rows_note(const TrajectoryRecorder& trajectory, std::int64_t steps);

// The machine that moves and its plots: the page's first chapters.
void show_motion(Findings& findings, const Results& results);
// A row a period of steady machines, between the borders that are told everywhere; they close: ΔE is the sum of the works.
void show_works_of_periods(Findings& findings, Chapter in, const Result& result);
void show_delta_formulas(Findings& findings, Chapter in, const Results& results);
// Audit, statistics, events, explanation, scene: the page's last chapters.
void show_background(Findings& findings, const Results& results);

}  // namespace kurbel
