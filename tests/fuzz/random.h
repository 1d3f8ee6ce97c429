// random.h — numbers that are the same from the same seed with every library and compiler.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace kurbel::fuzz {

// Where inputs begin that nobody has seen: a million numbers for each second of the clock.
inline std::uint64_t number_of_now() {
  using namespace std::chrono;
  return 1'000'000 * static_cast<std::uint64_t>(duration_cast<seconds>(system_clock::now().time_since_epoch()).count());
}

// SplitMix64 (Steele, Lea, Flood 2014): any seed will do, neighbouring ones as well.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // 0 … 1
  bool chance(double p) { return uniform() < p; }
  std::size_t index(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(bits() % n); }
  double factor(double most) { return std::pow(most, 2 * uniform() - 1); }  // 1/most … most, even over the logarithm
  template <class T>
  const T& one_of(const std::vector<T>& list) {
    return list[index(list.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace kurbel::fuzz
