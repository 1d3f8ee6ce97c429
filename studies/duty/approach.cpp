// approach.cpp — geometric sequences, and ranges of alternating ones.
#include "studies/duty/approach.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace kurbel {
namespace {

// Changes D₁, D₂ over the two halves of the last 2 · `length` changes.
std::optional<double> geometric_rest(std::span<const double> v, std::size_t length, double noise) {
  const std::size_t n = v.size() - 1;
  const double second = std::abs(v[n] - v[n - length]), first = std::abs(v[n - length] - v[n - 2 * length]);
  if (second <= noise) return second;
  if (second >= first) return {};
  return second * second / (first - second);
}

constexpr std::size_t shortest_step = 4;  // intervals
constexpr double same_limit = 0.1;        // of what lacks
constexpr double apart = 3;               // what limits by other parts differ by, as an uncertainty

// The limit by the last four steps of so many intervals.
SpeedLimit limit_by(std::span<const double> angles, std::size_t step, double noise) {
  const std::size_t n = angles.size() - 1;
  const auto weight = [&](std::size_t k) {
    const double sine = std::sin(std::numbers::pi * (static_cast<double>(k) + 0.5) / (2 * static_cast<double>(step)));
    return sine * sine / static_cast<double>(step);
  };
  const auto mean = [&](std::size_t before) {  // steps before the last
    double sum = 0;
    const std::size_t first = n - (before + 2) * step;
    for (std::size_t k = 0; k < 2 * step; ++k) sum += weight(k) * (angles[first + k + 1] - angles[first + k]);
    return sum;
  };
  const double last = mean(0), first_change = mean(1) - mean(2), change = last - mean(1);
  SpeedLimit found{.limit = last, .speed = last, .unsure = std::abs(change) + noise, .change = change};
  if (std::abs(change) <= noise) return found.kind = SpeedLimit::Kind::known, found;
  if (std::abs(change) >= std::abs(first_change) - noise) {
    if (change * first_change > 0) found.kind = SpeedLimit::Kind::grows;
    return found;
  }
  if (change * first_change <= 0) return found;
  const double q = change / first_change, rest = change * q / (1 - q);
  double lacks = 0;  // of the last mean, where 1 lacks at the end
  for (std::size_t k = 0; k < 2 * step; ++k)
    lacks += weight(k) * std::pow(q, -(2 - (static_cast<double>(k) + 0.5) / static_cast<double>(step)));
  found.kind = SpeedLimit::Kind::known;
  found.limit = last + rest, found.speed = found.limit - rest / lacks;
  found.unsure = noise * (1 + 4 * q / ((1 - q) * (1 - q)));
  return found;
}

bool agree(const SpeedLimit& a, const SpeedLimit& b) {
  return a.kind == SpeedLimit::Kind::known && b.kind == SpeedLimit::Kind::known &&
         std::abs(a.limit - b.limit) <=
             same_limit * std::max(std::abs(a.limit - a.speed), std::abs(b.limit - b.speed)) + a.unsure + b.unsure;
}

// A change that is within the noise only as the part is short: over twice the time it was twice as large. A speed that has
// settled changes far less.
bool goes_on(const SpeedLimit& longer, const SpeedLimit& part, double noise) {
  constexpr double of_half_the_time = 0.25;
  return std::abs(part.change) <= noise && part.change * longer.change > 0 &&
         std::abs(part.change) > of_half_the_time * std::abs(longer.change);
}

}  // namespace

SpeedLimit limit_of_speed(std::span<const double> angles, double noise) {
  std::vector<SpeedLimit> by;  // the longest part first
  for (std::size_t step = angles.empty() ? 0 : (angles.size() - 1) / 4; step >= shortest_step; step /= 2)
    by.push_back(limit_by(angles, step, noise));
  bool all_grow = true;  // the longer ones
  for (std::size_t k = 0; k + 1 < by.size(); ++k) {
    all_grow = all_grow && (k == 0 || by[k - 1].kind == SpeedLimit::Kind::grows);
    if (k > 0 && all_grow && goes_on(by[k - 1], by[k], noise)) break;
    if (agree(by[k], by[k + 1]) && (k + 2 == by.size() || agree(by[k], by[k + 2]))) {
      SpeedLimit& found = by[k];
      for (std::size_t other = k + 1; other < by.size() && other <= k + 2; ++other)
        found.unsure = std::max(found.unsure, apart * std::abs(found.limit - by[other].limit));
      return found;
    }
  }
  SpeedLimit none;
  if (by.empty()) return none;
  none.change = by.back().change;
  const auto grows = [](const SpeedLimit& one) { return one.kind == SpeedLimit::Kind::grows; };
  if (by.size() > 1 && grows(by.back()) && grows(by[by.size() - 2])) none.kind = SpeedLimit::Kind::grows;
  return none;
}

double range_of(std::span<const double> v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

Approach approach_of(std::span<const double> values, double noise) {
  Approach approach;
  if (values.size() >= 2) approach.last_change = values.back() - values[values.size() - 2];
  if (values.size() < 3) return approach;
  const std::span<const double> v = values.last(std::max<std::size_t>(3, values.size() / 2 + 1));
  const std::size_t n = v.size() - 1, half = n / 2;
  bool rises = false, falls = false;
  for (std::size_t k = 1; k <= n; ++k) {
    rises = rises || v[k] - v[k - 1] > noise;
    falls = falls || v[k - 1] - v[k] > noise;
  }
  approach.alternates = rises && falls;
  if (approach.alternates) {
    const double before = range_of(v.first(v.size() - half)), now = range_of(v.last(half + 1));
    const double growth = std::max(1.0, now / std::max(before, noise));
    approach.remaining = std::isfinite(growth) ? now * growth * growth : now;
    return approach;
  }
  approach.remaining = 0;
  for (const std::size_t length : {std::max<std::size_t>(1, half / 4), half}) {
    const std::optional<double> rest = geometric_rest(v, length, noise);
    if (!rest || !approach.remaining) {
      approach.remaining.reset();
    } else {
      approach.remaining = std::max(*approach.remaining, *rest);
    }
  }
  // A single ratio may be that of a faster motion, which dies away in it: none below a tenth is assumed.
  if (const double change = std::abs(v[n] - v[n - 1]); n == 2 && approach.remaining && change > noise)
    approach.remaining = std::max(*approach.remaining, change / 9);
  return approach;
}

}  // namespace kurbel
