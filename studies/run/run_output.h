// run_output.h — results of run and compare as tables for people, JSON and CSV for programs.
#pragma once

#include <string>

#include "studies/findings/output.h"
#include "studies/run/compare.h"

namespace kurbel {

std::string table_of(const Result& result);
std::string table_of(const Comparison& comparison);
std::string json_of(const Result& result);
std::string json_of(const Comparison& comparison);

// What the energy balance proves: "energy balance closed to 1e-9 of the energy turned over"; of a run in which no work
// is done and no energy changes its form nothing, which is said instead.
std::string told(const EnergyBalance& energy);

// Files: trajectory.csv, of a comparison one per model. The result must outlive the output.
StudyOutput output_of(const Result& result);
StudyOutput output_of(const Comparison& comparison);

}  // namespace kurbel
