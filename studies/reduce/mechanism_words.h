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

// Class and groups, least transmission angles, travel.
std::vector<std::string> mechanism_words(const Mechanism& mechanism);

// The same of every mechanism, behind their names: of equal mechanisms once.
std::vector<std::string> mechanism_notes(const Model& model);

}  // namespace kurbel
