// load_cases.h — the load case to which a moment of a run belongs.
#pragma once

#include <optional>
#include <string>

#include "studies/findings/result.h"

namespace kurbel {

// By the run's sequence ("after step 2 of the sequence"), or by its three periods (periods.h): one of load_case
// (verdicts.h). Empty: of no moment, that of the whole run.
std::string load_case_at(const Result& result, std::optional<double> at);

}  // namespace kurbel
