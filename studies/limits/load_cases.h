// load_cases.h — the load case to which a moment of a run belongs.
#pragma once

#include <optional>
#include <string>

#include "studies/findings/result.h"

namespace kurbel {

// By the run's sequence ("after step 2 of the sequence"), or by its three periods (periods.h): one of load_case
// (verdicts.h). Empty: of no moment, that of the whole run.
std::string load_case_at(const Result& result, std::optional<double> at);

// The largest |torque| among the samples of the trajectory from a time on [N·m]; `peak`: the joint's largest torque.
// Empty: the joint is not recorded.
std::optional<double> largest_sample_from(const Result& result, const Figure& peak, double from);

// That of the largest torque of a joint. A peak within the steady motion that is not reached again, to within 1 %, in
// the second half of the run is of what the start has left: load_case::run. Of runs with fewer than 100 samples of a cycle the
// moment alone decides.
std::string load_case_of_peak(const Result& result, const Figure& peak_torque);

}  // namespace kurbel
