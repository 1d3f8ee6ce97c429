// steady_words.h — what is said of steady cycles, operating points and starts in sentences.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/rows.h"
#include "studies/steady/steady.h"

namespace kurbel {

std::vector<std::string> words_of(const SteadyCycle& cycle);
std::vector<std::string> words_of_diagram(const SteadyStudy& study);
Record operating_point(const OperatingDiagram& diagram, const OperatingPoint& point);  // the same for programs
std::vector<std::string> words_of_start(const SteadyStudy& study);

}  // namespace kurbel
