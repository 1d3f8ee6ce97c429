// mechanism_words.h — what a linkage is made of and how its output moves, in words: structure, stroke, dead centres, time ratio.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// Of the mechanisms that are described link by link, each line with the mechanism's name.
std::vector<std::string> mechanism_words(const Model& model);

}  // namespace kurbel
