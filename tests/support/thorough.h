// thorough.h — whether tests take their long form, as scripts/test --thorough asks for by KURBEL_THOROUGH=1.
#pragma once

#include <cstdlib>

namespace kurbel::test {

inline bool thorough() {
  static const bool is = std::getenv("KURBEL_THOROUGH") != nullptr;
  return is;
}

}  // namespace kurbel::test
