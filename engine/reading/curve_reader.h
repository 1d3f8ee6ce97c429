// curve_reader.h — a characteristic of a scene file: its points in place or in a CSV file, with their units.
#pragma once

#include <string>

#include "engine/reading/data_files.h"
#include "engine/scene/document.h"
#include "engine/scene/keys.h"

namespace kurbel {

// Reads a curve in SI; false with messages where it is none. Points in files are read where they are `allowed`.
bool read_curve(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, CurveData& curve);

// Unit of the first column of a curve, by what it is given over.
std::string unit_over(const std::string& over);

}  // namespace kurbel
