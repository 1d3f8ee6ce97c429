// checkpoint.h — a checkpoint as text, and back to the last bit; the memory of observers in it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// As JSON, with the names of all states to identify the machine.
std::string text_of(const Checkpoint& checkpoint, const Equations& equations);

// A text that is not a checkpoint of this machine, with the reason.
struct UnfitCheckpoint : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Throws UnfitCheckpoint if the text is no checkpoint, or of a machine with other states, with the difference.
// Parameters may differ: a warmed-up machine may continue under another load.
Checkpoint checkpoint_from(const std::string& text, const Equations& equations);

// The memory of each observer as numbers, and back. Throws std::invalid_argument for the memory of other observers; empty:
// they start without memory.
std::vector<std::vector<double>> memory_of(const std::vector<Observer*>& observers);
void recall(const std::vector<Observer*>& observers, const std::vector<std::vector<double>>& memory);

}  // namespace kurbel
