// sanitized.h — whether this build is instrumented by the address sanitizer.
#pragma once

namespace kurbel::test {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
// Instrumented code takes some four times the processor time.
inline constexpr double slower = sanitized ? 4 : 1;

}  // namespace kurbel::test
