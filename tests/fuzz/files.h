// files.h — files other than scenes and plain tables: workbooks, MAT files, mass–elastic sheets, JSON that the program wrote.
#pragma once

#include <cstdint>
#include <string>

#include "tests/fuzz/mutator.h"

namespace kurbel::fuzz {

// An archive with the parts of a workbook: their XML is changed, then sometimes the archive.
std::string workbook_input(std::uint64_t seed, const MutationStyle& = {});
// A MAT file of version 5, its elements plain or compressed.
std::string mat_input(std::uint64_t seed, const MutationStyle& = {});
std::string train_sheet_input(std::uint64_t seed, const MutationStyle& = {});
// A checkpoint, or the summary of a study of accuracy, both of one small machine.
std::string json_input(std::uint64_t seed, const MutationStyle& = {});

std::string mutated_file(const std::string& bytes, Random& random, const MutationStyle& = {});

// Read as text within the limits of sizes, or refused in words.
std::string judge_sheet(const std::string& bytes);
// A scene that can be read, or a refusal with a place.
std::string judge_train_sheet(const std::string& text);
// A checkpoint is refused, or a run goes on from it and ends, with finite values if it is complete. A setting is found or
// refused.
std::string judge_json(const std::string& text);

}  // namespace kurbel::fuzz
