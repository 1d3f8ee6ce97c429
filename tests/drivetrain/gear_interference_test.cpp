// gear_interference_test.cpp — undercut and interference are two verdicts, judged by the line of action and the roots
// as the rack cuts them.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <stdexcept>

#include "drivetrain/gears/gear_pair.h"

namespace kurbel::gear_interference_test {
namespace {

constexpr double mm = 1e-3, degree = std::numbers::pi / 180, pi = std::numbers::pi;

// Is this point of the wheel (angle from a tooth's middle) inside the rack's tooth in any of its places?
bool cut_away(const GearWheel& w, double r, double angle) {
  const double m = w.module, alpha = w.rack.pressure_angle, rho = w.rack.root_radius * m;
  const double depth = w.rack.dedendum() * m - rho, pitch_radius = 0.5 * w.reference_diameter;
  const double half = m * pi / 4 - depth * std::tan(alpha) - rho / std::cos(alpha);
  for (int k = -3000; k <= 3000; ++k) {
    const double travel = 1.5 * pi * m * k / 3000;
    const double turned = angle - pi / w.teeth + travel / pitch_radius;
    const double width = std::abs(r * std::sin(turned) - travel) * std::cos(w.helix);
    const double below = pitch_radius + w.generating_shift * m - r * std::cos(turned);
    const bool straight = below < w.rack.straight_depth() * m && width < m * pi / 4 - below * std::tan(alpha);
    const bool tip = below < w.rack.dedendum() * m && width < half;
    const bool rounding = std::hypot(width - half, below - depth) < rho;
    if (straight || tip || rounding) return true;
  }
  return false;
}

// Radius at which the involute ends, from the rack alone: of an undercut flank, nothing of it is cut above; else where
// the end of the rack's straight flank made it, r² = r_b² + (r sin α − h/sin α)² with h its depth below the pitch line.
double end_of_involute(const GearWheel& w) {
  if (!w.undercut) {
    const double cosine = w.base_diameter / w.reference_diameter, sine = std::sqrt(1 - cosine * cosine);
    const double depth = (w.rack.straight_depth() - w.generating_shift) * w.module;
    return std::hypot(0.5 * w.base_diameter, 0.5 * w.reference_diameter * sine - depth / sine);
  }
  const double base = 0.5 * w.base_diameter, hair = 1e-5 * w.module;
  const auto lost = [&](double r) { return cut_away(w, r, 0.5 * w.thickness(2 * r) / r - hair / r); };
  double low = base * (1 + 1e-9), high = 0.5 * std::min(w.tip_diameter, w.pointed_diameter());
  if (!lost(low)) return low;
  for (int i = 0; i < 30; ++i) (lost(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return high;
}

// Where the tip circle of wheel 2 cuts the line of action: how far past the foot of the normal from O₁ (negative: it
// stays before it), and how far from O₁.
struct TipPoint {
  double past_foot, radius;
};
std::optional<TipPoint> tip_on_line(const GearPair& p) {
  const double tip = 0.5 * std::abs(p.wheel[1].tip_diameter), pitch = 0.5 * p.wheel[0].working_diameter;
  const double c = std::cos(p.working_angle), s = std::sin(p.working_angle);
  const auto outside = [&](double g) { return std::hypot(pitch + g * s - p.centre_distance, g * c) > tip; };
  // From the foot of the normal from O₂, where the line is nearest to it, outwards: there the circle is cut once.
  double inner = (p.centre_distance - pitch) * s, outer = (p.internal() ? 1 : -1) * (20 * p.data.module + 2 * pitch);
  if (outside(inner) || !outside(outer)) return {};
  for (int i = 0; i < 100; ++i) (outside(0.5 * (inner + outer)) ? outer : inner) = 0.5 * (inner + outer);
  return TipPoint{-pitch * s - inner, std::hypot(pitch + inner * s, inner * c)};
}

GearPairData random_data(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  GearPairData d;
  d.module = between(1, 10) * mm;
  d.teeth[0] = static_cast<int>(between(7, 26));
  d.teeth[1] =
      between(0, 1) < 0.2 ? -static_cast<int>(d.teeth[0] + between(25, 80)) : static_cast<int>(between(20, 150));
  d.helix = between(0, 1) < 0.4 ? between(-30, 30) * degree : 0;
  d.shift = {between(-0.4, 0.7), between(-0.3, 0.6) - (d.teeth[1] < 0 ? 0.3 : 0)};
  d.rack.addendum = between(0.7, 1.2);
  return d;
}

bool says(const GearPair& p, const std::string& words) {
  for (const GearVerdict& v : verdicts(p))
    if (v.text.find(words) != std::string::npos) return true;
  return false;
}

TEST(GearInterference, IsReportedWhereTheTipLeavesTheInvoluteUndercutOrNot) {
  std::mt19937 random(217714);
  int judged = 0, both = 0, undercut_alone = 0, interfering_alone = 0;
  for (int k = 0; k < 400 && judged < 120; ++k) {
    GearPair p;
    try {
      p = solve_gear_pair(random_data(random));
    } catch (const std::invalid_argument&) {
      continue;
    }
    const MeshedWheel& pinion = p.wheel[0];
    const std::optional<TipPoint> tip = tip_on_line(p);
    if (!tip) continue;
    const double end = end_of_involute(pinion);
    const double margin = tip->radius - end;  // on the flank, if > 0
    const double near = 1e-3 * p.data.module;
    if (std::abs(margin) < near || std::abs(tip->past_foot) < near) continue;
    const bool expected = tip->past_foot > 0 || margin < 0;
    EXPECT_EQ(interference(p, 0).found(), expected)
        << "z = " << p.data.teeth[0] << ", " << p.data.teeth[1] << ", x = " << pinion.shift << ": tip at "
        << tip->radius << ", involute from " << end << ", past the base circle " << tip->past_foot << "; reached "
        << pinion.reached_diameter / 2 << ", form circle " << pinion.form_diameter / 2 << ", tips from " << p.tip_start
        << " to " << p.tip_end << ", limits " << p.limit_start << ", " << p.limit_end;
    EXPECT_EQ(says(p, "Interference: the tip of wheel 2"), expected);
    EXPECT_EQ(says(p, "Wheel 1 (z = " + std::to_string(p.data.teeth[0]) + ") is undercut"), pinion.undercut);
    ++judged;
    both += expected && pinion.undercut;
    undercut_alone += !expected && pinion.undercut;
    interfering_alone += expected && !pinion.undercut;
  }
  EXPECT_GE(judged, 100);
  EXPECT_GE(both, 10);
  EXPECT_GE(undercut_alone, 3);
  EXPECT_GE(interfering_alone, 3);
}

// A hob clears what a wheel of the same rack needs; longer tips than its own dedendum it does not.
TEST(GearInterference, UndercutRootHasRoomForTheTipsThatItsRackClears) {
  for (const int teeth : {8, 10, 13}) {
    GearPairData d;
    d.module = 2 * mm;
    d.teeth = {teeth, 50};
    GearPair p = solve_gear_pair(d);
    ASSERT_TRUE(p.wheel[0].undercut);
    EXPECT_TRUE(interference(p, 0).found());
    EXPECT_GT(root_room(p, 0), 0) << teeth;
    d.tip_diameter[1] = p.wheel[1].tip_diameter + 2 * 0.2 * d.module;  // within the clearance
    d.rack.clearance = 0.25;
    p = solve_gear_pair(d);
    EXPECT_TRUE(says(p, "Interference")) << teeth;
    EXPECT_TRUE(says(p, "undercut")) << teeth;
  }
}

// The tip that the verdict names ends the interference, and one a hair longer does not.
TEST(GearInterference, TipDiameterThatIsAdvisedEndsItExactly) {
  for (const int mate : {40, 90, -70}) {
    GearPairData d;
    d.module = 3 * mm;
    d.teeth = {10, mate};
    const GearPair p = solve_gear_pair(d);
    if (!interference(p, 0).found()) continue;
    const double form = 0.5 * p.wheel[0].form_diameter, base = 0.5 * p.wheel[0].base_diameter;
    const double sign = mate < 0 ? 1 : -1;
    const double leg =
        std::abs(p.centre_distance) * std::sin(p.working_angle) + sign * std::sqrt(form * form - base * base);
    const double limit = 2 * std::hypot(0.5 * p.wheel[1].base_diameter, leg);
    d.tip_diameter[1] = limit + sign * 1e-3 * mm;
    EXPECT_FALSE(interference(solve_gear_pair(d), 0).found()) << mate;
    d.tip_diameter[1] = limit - sign * 1e-2 * mm;
    EXPECT_TRUE(interference(solve_gear_pair(d), 0).found()) << mate;
  }
}

}  // namespace
}  // namespace kurbel::gear_interference_test
