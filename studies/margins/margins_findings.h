// margins_findings.h — findings on separation margins: a table, a sentence.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/speed_unit.h"
#include "studies/claims/claim.h"
#include "studies/findings/findings.h"
#include "studies/margins/margins.h"

namespace kurbel {

// People see all rows with too small a margin and the nearest others; programs and the file all rows.
Rows margin_table(const Margins& margins, const SpeedUnit& unit);
Record operating_range(const Margins& margins);

// Empty if the scene does not give its operating speed.
std::optional<Claim> margin_claim(const Margins& margins, const SpeedUnit& unit);

}  // namespace kurbel
