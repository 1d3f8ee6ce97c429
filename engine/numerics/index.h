// index.h — the model numbers nodes, shafts and states by int, where −1 says "none"; containers count by std::size_t.
#pragma once

#include <concepts>
#include <cstddef>

namespace kurbel {

// The element of a container that a number names: shafts[at(node.shaft)]. Numbers are never negative where they are
// used.
template <std::signed_integral Number>
constexpr std::size_t at(Number number) {
  return static_cast<std::size_t>(number);
}

}  // namespace kurbel
