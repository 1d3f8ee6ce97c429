// jam.h — jamming: friction laws that no motion satisfies.
#pragma once

#include <stdexcept>
#include <string>

namespace kurbel {

// At this state no acceleration, or no finite reaction, satisfies the friction laws. In a trial step it means that the step
// is too long; if the motion itself reaches such a state, the machine stops there by an impact.
struct Jam : std::runtime_error {
  explicit Jam(const std::string& why, int shaft = -1) : std::runtime_error(why), shaft(shaft) {}
  int shaft;  // shaft of the jamming element; −1: not given
};

}  // namespace kurbel
