// run_report.h — the reports of `run` and `compare`.
#pragma once

#include "studies/compare.h"
#include "studies/report/report.h"

namespace kurbel {

Report report_of(const Result& result);
Report report_of(const Comparison& comparison);

// Cards that other studies may want too.
MachineView machine_view(const std::vector<const Result*>& results);  // the last in front
std::vector<Plot> motion_plots(const std::vector<const Result*>& results);
Table figures_table(const Result& result, bool folded);

}  // namespace kurbel
