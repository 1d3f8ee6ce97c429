// limits_findings.h — what is said of limits: verdicts, barred ranges, and the sentence that stands first.
#pragma once

#include "engine/scene/speed_unit.h"
#include "studies/findings/rows.h"
#include "studies/limits/barred_ranges.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// What bars a range: "vibratory torque", "1 × mean torque".
std::string reason_in_words(const BarredRange& range);

Rows verdict_table(const std::vector<Verdict>& verdicts);
Rows barred_table(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                  const SpeedUnit& unit);

// "2 barred ranges, worst 310 … 355 rpm (main_coupling)"; none: no range to keep away from is told.
std::optional<Claim> barred_claim(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                                  const SpeedUnit& unit);

// Where the loads and peaks come from, and what no range of speed is free of.
std::vector<std::string> limits_notes(const std::vector<Verdict>& verdicts, const std::vector<BarredRange>& ranges,
                                      const std::vector<LimitedJoint>& joints, const SteadyLoads& loads,
                                      const RunUp& run_up);

}  // namespace kurbel
