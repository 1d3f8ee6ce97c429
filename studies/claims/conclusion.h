// conclusion.h — the conclusion of a study, made from its claims.
//
//     figures_told "δ is 0.1043819", limit_exceeded "\"clutch\" gets too hot"
//         → "\"clutch\" gets too hot.", "δ is 0.1044."
#pragma once

#include <string>
#include <vector>

#include "studies/claims/claim.h"

namespace kurbel {

// Of the machine as it is bad news first; behind it what is said of its variants, then figures. Bad news by question, then
// by severity, then by how far it is beyond its limit, at most two of a question; then the others by question, each as it
// was given. With full stops, and rounded as headlines are.
std::vector<std::string> concluded(Claims claims);

// In one line.
std::string in_one_line(const std::vector<std::string>& sentences);

}  // namespace kurbel
