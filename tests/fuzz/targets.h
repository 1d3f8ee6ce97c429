// targets.h — what the program answers to an input, and what is wrong with that answer.
//
// Each judge returns the fault in words, or nothing. It does not return where the program crashes or hangs: whoever
// calls it watches for that.
#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/mutator.h"

namespace kurbel::fuzz {

struct Target {
  const char* name;
  const char* asks;
  MutationStyle style;  // of its inputs
  std::string (*judge)(const std::string& input);
  double patience;  // processor time after which an input counts as endless [s]
  std::string (*input)(std::uint64_t number, const MutationStyle& style) = scene_input;
  std::string (*mutated)(const std::string& text, Random& random, const MutationStyle& style) = mutated_scene;
};

std::string judge_reader(const std::string& text);
std::string judge_compile(const std::string& text);  // with rough tables of the mechanisms
std::string judge_run(const std::string& text);      // with a budget
std::string judge_study(const std::string& text);    // one of the other verbs, chosen by the text
std::string judge_every_study(const std::string& text);
std::string judge_csv(const std::string& text);

const std::vector<Target>& targets();
const Target* target_named(const std::string& name);

// The input of a target that belongs to a number.
inline std::string input_of(const Target& target, std::uint64_t number) { return target.input(number, target.style); }

// Processor time that a short run may take for each integration [s].
inline constexpr double run_budget = 0.1;

}  // namespace kurbel::fuzz
