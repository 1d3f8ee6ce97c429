// curve_reader.h — a characteristic of a scene file: its points in place or in a file, with their units, or a formula.
#pragma once

#include <string>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads a curve in SI; false with messages where it is none. Points in files are read where they are `allowed`.
bool read_curve(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, CurveData& curve);

// The same of a table with `formula`, whose `over` has been read (curve_formula.cpp).
bool read_curve_formula(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                        CurveData& curve);

// What is wrong with the period of a curve over the angle, in words; empty: nothing, or it is given over something else.
std::string wrong_period(const CurveData& curve);

// Unit of the first column of a curve, by what it is given over.
std::string unit_over(const std::string& over);

}  // namespace kurbel
