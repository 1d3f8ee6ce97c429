// mechanism_words.h — what a linkage is made of and how its output and points move: structure, stroke, dead centres, time ratio.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

// Every degree of their cycles.
std::vector<PointPath> point_paths(const Model& model);

// Of the mechanisms that are described link by link, each line with the mechanism's name.
std::vector<std::string> mechanism_words(const Model& model);

}  // namespace kurbel
