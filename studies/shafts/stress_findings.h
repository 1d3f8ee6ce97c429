// stress_findings.h — what is said of stresses: the sentence that stands first, tables, curves.
#pragma once

#include <optional>
#include <vector>

#include "studies/claims/claim.h"
#include "studies/data/data_table.h"
#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/shafts/shaft_stress.h"

namespace kurbel {

// "vibratory stress of shafts: the worst propeller_shaft, 38.2 MPa at 92 rpm, 87 % of the limit there; as cylinder3
// misfires 44.1 MPa at 92 rpm, 101 %: it EXCEEDS that", judged by what is used most; none: there is nothing to say.
std::optional<Claim> stress_claim(const ShaftStresses& s);

Rows stress_table(const ShaftStresses& s);   // of every shaft the sum, and its orders
Rows misfire_table(const ShaftStresses& s);  // of every shaft and cylinder that misfires
std::vector<Plot> stress_plots(const ShaftStresses& s);
DataTable stress_data(const ShaftStresses& s);  // shaft by shaft, speed by speed: the sum, every order, limits

}  // namespace kurbel
