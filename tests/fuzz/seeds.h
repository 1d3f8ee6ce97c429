// seeds.h — the texts that mutation begins at: all example scenes, the built-in ones, and those with faults.
#pragma once

#include <string>
#include <vector>

namespace kurbel::fuzz {

struct Seed {
  std::string name, text;
};

const std::vector<Seed>& good_scenes();   // of scenes/ and tests/hard-like chains
const std::vector<Seed>& all_scenes();    // and tests/bad_scenes/
const std::vector<Seed>& crashes();       // of tests/cases/crashes: what was found
const std::vector<Seed>& tables();        // CSV
const std::vector<Seed>& train_sheets();  // mass–elastic sheets, CSV

// Where data files of a scene are looked for: beside those of scenes/.
std::string scene_path();

}  // namespace kurbel::fuzz
