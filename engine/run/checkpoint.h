// checkpoint.h — a checkpoint as text, and back to the last bit; what observers remember in it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// As JSON, with the names of all states, so that a reader knows what machine it is of.
std::string text_of(const Checkpoint& checkpoint, const Equations& equations);

// Why a text is no checkpoint of this machine.
struct UnfitCheckpoint : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Throws UnfitCheckpoint where the text is none, or of a machine of other states: what is not alike, in words.
// Parameters may be others: a machine that has warmed up goes on under another load.
Checkpoint checkpoint_from(const std::string& text, const Equations& equations);

// What each of them has seen so far, as numbers, and back. Throws std::invalid_argument for the memory of others; none
// at all: they begin anew.
std::vector<std::vector<double>> memory_of(const std::vector<Observer*>& observers);
void recall(const std::vector<Observer*>& observers, const std::vector<std::vector<double>>& memory);

}  // namespace kurbel
