// output.h — results as tables for people, JSON and CSV for programs.
#pragma once

#include <string>

#include "studies/compare.h"

namespace kurbel {

std::string table_of(const Result& result);
std::string table_of(const Comparison& comparison);
std::string json_of(const Result& result);
std::string json_of(const Comparison& comparison);

// Writes summary.json, report.html and trajectory.csv (of a comparison one per model) into the folder, each under a
// temporary name first. An incomplete run's files are marked as such. Throws std::runtime_error if the folder cannot be
// written. With plots the report's plots are written for gnuplot too, into plots/.
void write_results(const Result& result, const std::string& folder, bool plots = false);
void write_results(const Comparison& comparison, const std::string& folder, bool plots = false);

}  // namespace kurbel
