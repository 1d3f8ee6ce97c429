// limits_findings.h — findings on limits: verdicts, barred ranges, and the leading sentence.
#pragma once

#include "engine/scene/speed_unit.h"
#include "studies/findings/rows.h"
#include "studies/limits/barred_ranges.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// Reason of a barred range: "vibratory torque", "1 × mean torque".
std::string reason_in_words(const BarredRange& range);

Rows verdict_table(const std::vector<Verdict>& verdicts);
Rows barred_table(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                  const SpeedUnit& unit);

// "2 barred ranges, worst 310 … 355 rpm (main_coupling)"; empty if no range must be avoided.
std::optional<Claim> barred_claim(const std::vector<BarredRange>& ranges, const std::vector<LimitedJoint>& joints,
                                  const SpeedUnit& unit);

// Sources of the loads and peaks, and limits exceeded in the whole speed range.
std::vector<std::string> limits_notes(const std::vector<Verdict>& verdicts, const std::vector<BarredRange>& ranges,
                                      const std::vector<LimitedJoint>& joints, const SteadyLoads& loads,
                                      const RunUp& run_up);

}  // namespace kurbel
