// size_words.h — the sized flywheel in sentences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/limits/verdicts.h"
#include "studies/size/size.h"

namespace kurbel {

std::string conclusion_of(const Sizing& sizing);
std::vector<std::string> motions_in_words(const Sizing& sizing);
// The motion of the actual machine misses the δ for which its flywheel was sized; empty: it does not.
std::optional<Claim> missed_demand(const Sizing& sizing);
std::string comparison_with_scene(const Sizing& sizing);
Sentences basis_words(const Sizing& sizing);
std::string punch_words(const PunchPress& press);

}  // namespace kurbel
