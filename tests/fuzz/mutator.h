// mutator.h — changes a scene where it hurts: by the table of keys while it is TOML, by bytes and lines where it is
// not.
#pragma once

#include <string>

#include "tests/fuzz/random.h"

namespace kurbel::fuzz {

struct MutationStyle {
  double wild = 0.3;          // how likely a new value is extreme, of another unit or type
  double text_level = 0.15;   // how likely bytes, words and lines are changed rather than values
  int most = 6;               // changes at once
  bool bad_ones_too = false;  // begins at scenes with faults, too
};

// Bytes, words or lines inserted, erased, repeated, exchanged or cut off, once.
void change_bytes(std::string& text, Random& random);
std::string mutated_scene(const std::string& text, Random& random, const MutationStyle& style = {});
std::string mutated_table(const std::string& text, Random& random, const MutationStyle& = {});

// The input that belongs to a number: a seed, changed.
std::string scene_input(std::uint64_t seed, const MutationStyle& style);
std::string table_input(std::uint64_t seed, const MutationStyle& = {});

}  // namespace kurbel::fuzz
