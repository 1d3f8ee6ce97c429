// run_report.h — the reports of `run` and `compare`.
#pragma once

#include "studies/findings/report.h"
#include "studies/run/compare.h"

namespace kurbel {

Report report_of(const Result& result);
Report report_of(const Comparison& comparison);

// No account has done work, and what is stored is what it was: a balance of energy proves nothing.
bool nothing_turned_over(const EnergyBalance& energy);
// Left out is what has no value in a run that broke off, because its motion had lost it.
bool is_told(const Figure& figure, const Result& result);
// A run that broke off before its works were drawn up has none to show.
bool has_works(const Result& result);

// Cards that other studies may want too.
MachineView machine_view(const std::vector<const Result*>& results);  // the last in front
std::vector<Plot> motion_plots(const std::vector<const Result*>& results);
Table figures_table(const Result& result, bool folded);

}  // namespace kurbel
