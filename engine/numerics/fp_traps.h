// fp_traps.h — during its lifetime a division by zero or an invalid operation in this thread stops the program.
//
// Only with KURBEL_FP_TRAPS (the debug preset), and only around the equations of the machine: the libraries compare NaN
// and divide by zero on purpose. A diverging trial step overflows, which the step control handles: states with extreme
// values are not trapped.
#pragma once

#include <span>

#ifdef KURBEL_FP_TRAPS
#include <algorithm>
#include <cfenv>
#include <cmath>
#endif

namespace kurbel {

class FpTraps {
 public:
#ifdef KURBEL_FP_TRAPS
  explicit FpTraps(std::span<const double> state) : before_(fegetexcept()) {
    constexpr double beyond_reason = 1e12;
    if (!std::all_of(state.begin(), state.end(), [](double v) { return std::abs(v) < beyond_reason; })) return;
    std::feclearexcept(traps);  // earlier exceptions would trap at once
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
#else
  explicit FpTraps(std::span<const double>) {}
#endif
};

}  // namespace kurbel
