#include "engine/reading/mirrored.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/period.h"

namespace kurbel {
namespace {

constexpr double half_turn = std::numbers::pi;

// Places in [0, period] where a piece of the curve may begin or end, and the ends of half turns.
std::vector<double> places_of(const Curve& curve, double period) {
  std::vector<double> places = {0, half_turn, period - half_turn, period};
  for (const double x : curve.x()) places.push_back(place_within(x, period));
  std::sort(places.begin(), places.end());
  const auto together = [&](double a, double b) { return b - a < 1e-12 * period; };
  places.erase(std::unique(places.begin(), places.end(), together), places.end());
  return places;
}

// At one end of the stretch from a to b, seen from within.
double from_within(const Curve& curve, double at, double a, double b) {
  const double middle = 0.5 * (a + b);
  return curve.value_in(curve.piece(middle), at + (curve.within(middle) - middle));
}

}  // namespace

CurveData first_half_turn_mirrored(const CurveData& data, double period, bool odd) {
  if (!data.by_formula.empty())
    throw std::invalid_argument("a formula is not mirrored; give the diagram without combustion as well");
  const Curve curve = data.curve(period);
  CurveData made;
  made.over = data.over, made.form = data.form, made.period = period;
  const double same = 1e-12 * curve.max_abs(), sign = odd ? -1 : 1;
  const auto put = [&](double x, double y) {
    if (!made.x.empty() && made.x.back() == x && std::abs(made.y.back() - y) <= same) return;
    made.x.push_back(x), made.y.push_back(y);
  };
  const std::vector<double> places = places_of(curve, period);
  for (std::size_t i = places.size() - 1; i > 0 && places[i - 1] >= period - half_turn; --i) {
    const double a = places[i - 1], b = places[i];
    put(period - b, sign * from_within(curve, b, a, b));
    put(period - a, sign * from_within(curve, a, a, b));
  }
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double a = places[i], b = places[i + 1];
    if (a < half_turn) continue;
    put(a, from_within(curve, a, a, b));
    put(b, from_within(curve, b, a, b));
  }
  put(period, made.y.front());  // where an odd table does not pass zero it jumps there, too
  return made;
}

std::string words_of_mirrored(const std::string& whose, const std::string& key) {
  return fmt::format(
      "{}: a cylinder that does not fire has the fired diagram's compression, mirrored about top dead centre, in place "
      "of its expansion; neither its losses of heat and gas nor its valves are in that; give \"{}\" where they count",
      whose, key);
}

}  // namespace kurbel
