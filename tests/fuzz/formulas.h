// formulas.h — formulas of x at random: by the grammar, then sometimes broken; and what is wrong with the answer to one.
#pragma once

#include <cstdint>
#include <string>

#include "tests/fuzz/mutator.h"

namespace kurbel::fuzz {

std::string formula_input(std::uint64_t seed, const MutationStyle& = {});
std::string mutated_formula(const std::string& text, Random& random, const MutationStyle& = {});

// It is read and computed, or refused with a column of its text or a place in its range. What is computed is the same by
// its nodes and by its pieces' programs, and its slope in dual numbers is that of differences.
std::string judge_formula(const std::string& text);

}  // namespace kurbel::fuzz
