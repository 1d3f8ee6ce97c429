// stress_findings.h — findings on stresses: leading sentence, tables, curves.
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
// misfires 44.1 MPa at 92 rpm, 101 %: it EXCEEDS that", for the highest utilisation; empty: nothing to report.
std::optional<Claim> stress_claim(const ShaftStresses& s);

Rows stress_table(const ShaftStresses& s);   // for every shaft the sum and its orders
Rows misfire_table(const ShaftStresses& s);  // for every shaft and misfiring cylinder
std::vector<Plot> stress_plots(const ShaftStresses& s);
DataTable stress_data(const ShaftStresses& s);  // by shaft and speed: the sum, every order, limits

}  // namespace kurbel
