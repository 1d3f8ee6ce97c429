// flush_denormals.h — denormal numbers count as zero within its scope.
//
// Ahead of a wave front the motion of a chain decays to denormal numbers, which are a hundred times slower.
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
