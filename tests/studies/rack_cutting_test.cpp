// rack_cutting_test.cpp — the rack's positions envelop the involute; below 17 teeth without shift they cut into it.
#include "studies/gears/rack_cutting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kurbel::rack_cutting_test {
namespace {

GearWheel wheel(int teeth, double shift, double helix = 0) {
  GearWheel w;
  w.teeth = teeth, w.module = 0.004, w.helix = helix, w.shift = w.generating_shift = shift;
  w.tip_diameter = 0.004 * (teeth / std::cos(helix) + 2 + 2 * shift);
  return finish(w);
}

// Half the angle that all positions of the rack leave of the tooth at a radius.
double left_at(const GearWheel& w, double radius) {
  constexpr int positions = 1200;
  const double turn = 1.4 * 2 * std::numbers::pi / w.teeth;
  double least = std::numbers::pi / w.teeth;
  for (int k = -positions; k <= positions; ++k) {
    const std::vector<OutlinePoint> rack = rack_at(w, turn * k / positions, 0, 60);
    for (std::size_t i = 0; i + 1 < rack.size(); ++i) {
      const OutlinePoint a = rack[i], way = {rack[i + 1].x - a.x, rack[i + 1].y - a.y};
      const double square = way.x * way.x + way.y * way.y, half = a.x * way.x + a.y * way.y;
      const double under = half * half - square * (a.x * a.x + a.y * a.y - radius * radius);
      if (under < 0) continue;
      for (const double root : {-std::sqrt(under), std::sqrt(under)}) {
        const double share = (root - half) / square;
        if (share < 0 || share > 1) continue;
        least = std::min(least, std::abs(std::atan2(a.y + share * way.y, a.x + share * way.x)));
      }
    }
  }
  return least;
}

TEST(RackCutting, PositionsEnvelopTheInvolute) {
  for (const GearWheel& w : {wheel(20, 0), wheel(12, 0.5), wheel(30, -0.3), wheel(24, 0.2, 0.35)})
    for (const double share : {0.02, 0.3, 0.6, 0.9}) {
      const double d = w.form_diameter + share * (w.tip_diameter - w.form_diameter);
      EXPECT_NEAR(left_at(w, d / 2), w.thickness(d) / d, 1e-5) << w.teeth << " " << share;
    }
}

// 2/sin² 20° = 17.1; a shift of (17.1 − z)/17.1 saves the flank.
TEST(RackCutting, FewerThanSeventeenTeethAreUndercutWithoutShift) {
  for (const int teeth : {9, 12, 15, 18, 25}) {
    const double saving =
        (2 / std::pow(std::sin(std::numbers::pi / 9), 2) - teeth) * std::pow(std::sin(std::numbers::pi / 9), 2) / 2;
    for (const double shift : {0.0, saving + 0.01}) {
      const GearWheel w = wheel(teeth, shift);
      const bool cut_into = teeth < 17 && shift == 0;
      const double d = cut_into ? w.base_diameter + 0.3 * (w.form_diameter - w.base_diameter) : 1.001 * w.form_diameter;
      const double lost = w.thickness(d) / d - left_at(w, d / 2);
      EXPECT_EQ(lost > 1e-4, cut_into) << teeth << " " << shift;
      EXPECT_GT(lost, -1e-5) << teeth << " " << shift;
      const Plot plot = cutting_plot(w, 1);
      const auto drawn = [&](const std::string& name) {
        return std::count_if(plot.series.begin(), plot.series.end(), [&](const Series& s) { return s.name == name; });
      };
      EXPECT_EQ(drawn("involute down to the base circle"), cut_into ? 1 : 0) << teeth;
      EXPECT_EQ(drawn("without shift, x = 0"), shift == 0 ? 0 : 1) << teeth;
      EXPECT_EQ(plot.title.find("): undercut") != std::string::npos, cut_into) << plot.title;
    }
  }
}

// What is drawn of the rack lies outside of the drawn tooth, and the nearest position touches it.
TEST(RackCutting, TheDrawnRackStaysOutsideOfTheTooth) {
  const GearWheel w = wheel(14, 0.3);
  const Plot plot = cutting_plot(w, 2);
  EXPECT_TRUE(plot.equal_axes);
  const Series& rack = plot.series.front();
  double nearest = 1;
  for (std::size_t i = 0; i < rack.x.size(); ++i) {
    const double radius = 1e-3 * std::hypot(rack.x[i], rack.y[i]), angle = std::abs(std::atan2(rack.x[i], rack.y[i]));
    if (radius < w.form_diameter / 2 || radius > w.tip_diameter / 2 || angle > std::numbers::pi / w.teeth) continue;
    const double beside = angle - w.thickness(2 * radius) / (2 * radius);
    EXPECT_GT(beside, -1e-9);
    nearest = std::min(nearest, beside);
  }
  EXPECT_LT(nearest, 0.1);
}

}  // namespace
}  // namespace kurbel::rack_cutting_test
