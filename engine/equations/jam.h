// jam.h — friction whose law no motion satisfies.
#pragma once

#include <stdexcept>
#include <string>

namespace kurbel {

// At this state no acceleration, or no finite reaction, satisfies the laws of friction. In a trial step it says that
// the step was too long; where the motion itself comes to such a state, the machine stops there by an impact.
struct Jam : std::runtime_error {
  explicit Jam(const std::string& why, int shaft = -1) : std::runtime_error(why), shaft(shaft) {}
  int shaft;  // that what jams turns with; −1: not said
};

}  // namespace kurbel
