// thorough.h — whether tests run in their long form, set by scripts/test --thorough through KURBEL_THOROUGH=1.
#pragma once

#include <cstdlib>

namespace kurbel::test {

inline bool thorough() {
  static const bool is = std::getenv("KURBEL_THOROUGH") != nullptr;
  return is;
}

}  // namespace kurbel::test
