// mechanism_words.h — structure of a mechanism and motion of its output and points: stroke, dead centres, time ratio, dwell.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

// For every degree of their cycles.
std::vector<PointPath> point_paths(const Model& model);

// Class and groups; empty where its joints are unknown or its links pass change points.
std::string structure_words(const Mechanism& mechanism);

// Of every mechanism: class and groups, least transmission angles, travel; each line with the mechanism's name.
std::vector<std::string> mechanism_words(const Model& model);

}  // namespace kurbel
