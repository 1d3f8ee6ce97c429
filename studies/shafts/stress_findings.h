// stress_findings.h — findings on stresses: leading sentence, tables, curves.
#pragma once

#include <vector>

#include "studies/claims/claim.h"
#include "studies/data/data_table.h"
#include "studies/findings/plots.h"
#include "studies/findings/rows.h"
#include "studies/shafts/shaft_stress.h"

namespace kurbel {

// Begins the load case of a claim on a misfiring cylinder.
inline const std::string misfire_of = "misfire of ";

// On the highest utilisation, then on every other shaft whose limit is exceeded: "vibratory stress in "crank_end": 104 MPa at
// 59.94 rpm, 231 % of the limit for continuous running"; empty: nothing to report.
Claims stress_claims(const ShaftStresses& s);

Rows stress_table(const ShaftStresses& s);   // for every shaft the sum and its orders
Rows misfire_table(const ShaftStresses& s);  // for every shaft and misfiring cylinder
std::vector<Plot> stress_plots(const ShaftStresses& s);
DataTable stress_data(const ShaftStresses& s);  // by shaft and speed: the sum, every order, limits

}  // namespace kurbel
