// loops.cpp — triangles, one after the other; the roots that have simple zeros keep their signs through them.
#include "mechanisms/loops/loops.h"

namespace kurbel {
namespace {

// 1 + cos α = 2 cos²(α/2) and 1 − cos α = 2 sin²(α/2), which cos α itself would lose near π and 0.
struct CosineSums {
  explicit CosineSums(long double angle) : half(Direction::of_variable(angle, 0.5L)) {
    plus = Taylor(2) * half.cos * half.cos;
    minus = Taylor(2) * half.sin * half.sin;
  }
  Direction half;
  Taylor plus, minus;
};

// The triangle A, D, B in the axes of A → D: its side s, the foot of its height seen from A, the height.
struct Triangle {
  Taylor side, foot, height;
  Direction line;
};

// A comes to D, with a = d, b = c: s = 2 a sin(φ/2), and A → D stands across the half angle. Of a rhombus the height
// has a zero, too.
Triangle through_the_bearing(const FourBarLoop& l, const CosineSums& cosine) {
  const Taylor s = Taylor(2 * l.a) * cosine.half.sin;
  const Taylor height = l.in_line_at_half_turn() ? Taylor(l.a) * cosine.half.cos
                                                 : sqrt((Taylor(2 * l.b) + s) * (Taylor(2 * l.b) - s)) / Taylor(2);
  return {s, s / Taylor(2), height, {cosine.half.sin, -cosine.half.cos}};
}

// Twice its area is ½ √((b+c+s)(b+c−s)(s+b−c)(s−b+c)) (Heron), whose differences vanish at a change point: with s² =
// (a+d)² − 2 a d (1 + cos φ) = (a−d)² + 2 a d (1 − cos φ) they come from the lengths alone, b+c−s = b+c−a−d +
// 2 a d (1 + cos φ)/(a+d+s) and so on.
Triangle by_heron(const FourBarLoop& l, const CosineSums& cosine, const Direction& crank) {
  const long double sum = l.a + l.d, difference = std::fabs(l.a - l.d), gap = std::fabs(l.b - l.c);
  const Taylor product(2 * l.a * l.d);
  const Taylor s = sqrt(Taylor(difference * difference) + product * cosine.minus);
  const Taylor below = product / (Taylor(sum) + s), above = product / (s + Taylor(difference));
  Taylor square = (Taylor(l.b + l.c) + s) * (s + Taylor(gap)), root(1);
  if (l.in_line_at_half_turn())
    square = square * Taylor(2) * below, root = root * cosine.half.cos;
  else
    square = square * (Taylor(l.b + l.c - sum) + cosine.plus * below);  // b + c − s
  if (l.in_line_at_zero())
    square = square * Taylor(2) * above, root = root * cosine.half.sin;
  else
    square = square * (Taylor(difference - gap) + cosine.minus * above);  // s − |b − c|
  const Path ad = Path{Taylor(l.d), Taylor()} - along(crank, Taylor(l.a));
  return {s,
          (s * s + Taylor((l.b - l.c) * (l.b + l.c))) / (Taylor(2) * s),
          root * sqrt(square) / (Taylor(2) * s),
          {ad.x / s, ad.y / s}};
}

}  // namespace

std::optional<CrankArc> FourBarLoop::arc() const {
  const long double sum = b + c, gap = std::fabs(b - c), near = std::fabs(a - d), far = a + d;
  const bool outside = sum < far && !in_line_at_half_turn(), inside = gap > near && !in_line_at_zero();
  if ((!outside && !inside) || sum <= near || gap >= far) return {};
  const auto angle = [&](long double ad) {
    return static_cast<double>(std::acos((a * a + d * d - ad * ad) / (2 * a * d)));
  };
  const double pi = std::acos(-1.0), outer = outside ? angle(sum) : pi, inner = inside ? angle(gap) : 0;
  if (!inside) return CrankArc{0, outer};
  if (!outside) return CrankArc{pi, pi - inner};
  return CrankArc{(inner + outer) / 2, (outer - inner) / 2};
}

std::optional<CrankArc> SliderLoop::arc() const {
  const long double low = (e - l) / r, high = (e + l) / r;  // of sin φ
  const bool below = low > -1, above = high < 1;
  if (changes() || (!below && !above) || low >= 1 || high <= -1) return {};
  const double right = std::acos(0.0);
  const double from = below ? static_cast<double>(std::asin(low)) : -2 * right - static_cast<double>(std::asin(high));
  const double to = above ? static_cast<double>(std::asin(high)) : 2 * right - from;
  return CrankArc{(from + to) / 2, (to - from) / 2};
}

Meeting meet(const FourBarLoop& l, long double phi, bool left) {
  const CosineSums cosine(phi);
  const Triangle t =
      l.meets_bearing() ? through_the_bearing(l, cosine) : by_heron(l, cosine, Direction::of_variable(phi));
  const Taylor height = left ? t.height : -t.height;
  const Path aside = {-(height * t.line.sin), height * t.line.cos};
  const Path ab = along(t.line, t.foot) + aside, db = aside - along(t.line, t.side - t.foot);
  return {{ab.x / Taylor(l.b), ab.y / Taylor(l.b)},
          {db.x / Taylor(l.c), db.y / Taylor(l.c)},
          t.side.value() * height.value() / (l.b * l.c)};
}

// l² cos²β = (l − r − e + r (1 + sin φ)) (l − r + e + r (1 − sin φ)), with 1 ± sin φ = 1 ∓ cos(φ + π/2). At l = r + |e|
// one factor, without offset both, are squares.
Direction rod_to_line(const SliderLoop& s, const Direction& crank, long double phi, bool back) {
  const Taylor rise = Taylor(s.e) - Taylor(s.r) * crank.sin;
  const CosineSums cosine(phi + std::acos(-1.0L) / 2);
  if (!s.changes()) {
    const Taylor below = Taylor(s.l - s.r - s.e) + Taylor(s.r) * cosine.minus;
    const Taylor above = Taylor(s.l - s.r + s.e) + Taylor(s.r) * cosine.plus, lever = sqrt(below * above);
    return {(back ? -lever : lever) / Taylor(s.l), rise / Taylor(s.l)};
  }
  const Taylor r(s.r), twice(2 * std::fabs(s.e));
  Taylor reach;
  if (s.e == 0)
    reach = r * crank.cos;
  else if (s.e > 0)
    reach = Taylor(std::sqrt(2 * s.r)) * cosine.half.sin * sqrt(twice + r * cosine.plus);
  else
    reach = Taylor(std::sqrt(2 * s.r)) * cosine.half.cos * sqrt(twice + r * cosine.minus);
  const Taylor length(s.r + std::fabs(s.e));
  return {(back ? -reach : reach) / length, rise / length};
}

Slot slot_to_pin(const SlotLoop& s, long double phi) {
  const CosineSums cosine(phi);
  if (s.changes()) return {{-cosine.half.sin, cosine.half.cos}, Taylor(2 * s.r) * cosine.half.sin};
  const Direction crank = Direction::of_variable(phi);
  const Taylor reach = sqrt(Taylor((s.r - s.d) * (s.r - s.d)) + Taylor(2 * s.r * s.d) * cosine.minus);
  return {{(Taylor(s.r) * crank.cos - Taylor(s.d)) / reach, Taylor(s.r) * crank.sin / reach}, reach};
}

Direction to_line(const Path& joint, long double height, long double length, bool backward) {
  const Taylor rise = Taylor(height) - joint.y;
  const Taylor cosine = sqrt((Taylor(length) - rise) * (Taylor(length) + rise)) / Taylor(length);
  return {backward ? -cosine : cosine, rise / Taylor(length)};
}

}  // namespace kurbel
