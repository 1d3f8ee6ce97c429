// variant_text.h — numbers with units in the text of a scene, moved at random where they stand.
#pragma once

#include <functional>
#include <random>
#include <string>

#include "engine/scene/document.h"

namespace kurbel::coverage {

// Same numbers from the same seed with every library: distributions of the standard are not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) { engine_.discard(16); }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // 0 … 1
  double between(double a, double b) { return a + (b - a) * uniform(); }
  double factor(double least, double most);  // evenly over the logarithm
  bool chance(double p) { return uniform() < p; }
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

 private:
  std::mt19937_64 engine_;
};

// The text without its tables [effects] and [run], its quantities moved. Dimensions that belong together (lengths of
// one linkage, speeds of one machine) move together, with little of their own, so that most machines can still turn.
std::string moved_text(const std::string& text, const std::string& file, Dice& dice);

}  // namespace kurbel::coverage
