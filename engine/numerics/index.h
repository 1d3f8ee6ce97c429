// index.h — the model numbers nodes, shafts and states by int, where −1 is "none"; containers count by std::size_t.
#pragma once

#include <concepts>
#include <cstddef>

namespace kurbel {

// Index for an element of a container: shafts[at(node.shaft)]. The number must not be negative.
template <std::signed_integral Number>
constexpr std::size_t at(Number number) {
  return static_cast<std::size_t>(number);
}

}  // namespace kurbel
