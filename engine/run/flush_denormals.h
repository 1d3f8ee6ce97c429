// flush_denormals.h — within its scope numbers too small to be normal count as zero.
//
// Ahead of a wave front a chain's motion decays into denormal numbers, which cost a hundred times the usual.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace kurbel {

class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }  // flush to zero, denormals are zero
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
#endif
};

}  // namespace kurbel
