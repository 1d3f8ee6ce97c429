// entries.h — shared by the rows of the dictionary: the commands that print a figure.
//
// Columns of a row: name, words, unit, owner, theory, commands, definition, formula, what it is not.
#pragma once

#include "studies/dictionary/dictionary.h"

namespace kurbel::entries {

// trajectory.csv
inline constexpr std::string_view of_files = "run, compare";
inline constexpr std::string_view of_runs = "run, compare, effects, advise, accuracy, sweep, uncertainty";
inline constexpr std::string_view of_both = "run, compare, effects, advise, accuracy, steady, sweep, uncertainty";
inline constexpr std::string_view of_cycles = "steady, sweep, uncertainty";
inline constexpr std::string_view of_sizing = "size, sweep, uncertainty";

}  // namespace kurbel::entries
