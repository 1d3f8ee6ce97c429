// conclusion.h — the conclusion of a study, made from its claims.
//
//     figures_told "δ is 0.1043819", limit_exceeded "\"clutch\" gets too hot"
//         → "\"clutch\" gets too hot.", "δ is 0.1044."
#pragma once

#include <string>
#include <vector>

#include "studies/claims/claim.h"

namespace kurbel {

// First the machine as it is, then its variants, then figures. Warnings and faults by topic, severity and excess over their
// limit, at most two per topic; the others by topic, in the given order. Adds full stops, rounds numbers as in headlines.
std::vector<std::string> concluded(Claims claims);

// In one line.
std::string in_one_line(const std::vector<std::string>& sentences);

}  // namespace kurbel
