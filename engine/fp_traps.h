// fp_traps.h — while one of these lives, a division by zero or an invalid operation of this thread stops the program.
//
// Only with KURBEL_FP_TRAPS (the debug preset), and around the machine's own equations alone: the libraries compare NaN
// and divide by zero on purpose.
#pragma once

#ifdef KURBEL_FP_TRAPS
#include <cfenv>
#endif

namespace kurbel {

class FpTraps {
 public:
#ifdef KURBEL_FP_TRAPS
  FpTraps() : before_(fegetexcept()) {
    std::feclearexcept(traps);  // what was raised before would stop us at once
    feenableexcept(traps);
  }
  ~FpTraps() {
    fedisableexcept(traps);
    std::feclearexcept(traps);
    feenableexcept(before_);
  }
  FpTraps(const FpTraps&) = delete;
  FpTraps& operator=(const FpTraps&) = delete;

 private:
  static constexpr int traps = FE_DIVBYZERO | FE_INVALID;
  int before_;
#endif
};

}  // namespace kurbel
