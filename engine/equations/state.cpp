// state.cpp — angles of a state: whole turns stand apart from the remainder.
#include "engine/equations/state.h"

#include <cmath>
#include <numbers>

#include "engine/scene/scene.h"

namespace kurbel {

double Command::at(double t, const Sequence& sequence) const {
  if (law < 0) return value + rate * (t - from);
  return sequence.steps[static_cast<std::size_t>(law)].law.value_in(piece, t - from);
}
namespace {

// 4π as two doubles: 10⁶ wraps lose no digit.
constexpr double two_turns = 4 * std::numbers::pi;
constexpr double two_turns_rest = 4 * 1.2246467991473532e-16;

}  // namespace

bool needs_wrap(const Modes& modes, std::span<const double> y) {
  for (std::size_t i = 0; i < modes.turns.size(); ++i)
    if (std::abs(y[i]) > 4 * two_turns) return true;
  return false;
}

bool wrap(Modes& modes, std::span<double> y) {
  bool changed = false;
  for (std::size_t i = 0; i < modes.turns.size(); ++i) {
    // What is left of 4π itself, which is a little more than its double, would be less than nothing: it stays whole.
    double k = std::floor(y[i] / two_turns) - modes.first_two_turns;
    const auto rest = [&] { return std::fma(-k, two_turns, y[i]) - k * two_turns_rest; };
    if (k > 0 && rest() < modes.first_two_turns * two_turns) --k;
    if (k == 0) continue;
    y[i] = rest();
    modes.turns[i] += k;
    changed = true;
  }
  return changed;
}

double angle_with_turns(const Modes& modes, std::size_t tracked, std::span<const double> y) {
  return static_cast<double>(static_cast<long double>(modes.turns[tracked]) * 4 * std::numbers::pi_v<long double> +
                             y[tracked]);
}

}  // namespace kurbel
