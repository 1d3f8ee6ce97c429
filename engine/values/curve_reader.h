// curve_reader.h — reads a characteristic of a scene: points in the scene or in a file, with units, or a formula.
#pragma once

#include <string>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads a curve in SI; false with messages if it is invalid. Points in files are read if `allowed`.
bool read_curve(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, CurveData& curve);

// The same for a table with `formula`, whose `over` has been read (curve_formula.cpp).
bool read_curve_formula(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                        CurveData& curve);

// Fault of the period of a curve over the angle; empty: none, or it is not over the angle.
std::string wrong_period(const CurveData& curve);

// Unit of the first column of a curve by its abscissa.
std::string unit_over(const std::string& over);

}  // namespace kurbel
