// gear_pair_test.cpp — laws of gearing on random pairs: conjugate action, path of contact, undercut, drawn wheels.
#include "drivetrain/gears/gear_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "drivetrain/gears/bevel_worm.h"
#include "drivetrain/gears/planetary.h"

namespace kurbel::gear_pair_test {
namespace {

// The point of the line of action at g.
OutlinePoint line_point(const GearPair& p, double g) {
  return {0.5 * p.wheel[0].working_diameter + g * std::sin(p.working_angle), g * std::cos(p.working_angle)};
}

constexpr double mm = 1e-3, degree = std::numbers::pi / 180, pi = std::numbers::pi;

// Pairs as they occur: spur and helical, external and (every third) internal, shifted, with and without backlash.
std::vector<GearPair> random_pairs(int count, bool external_only = false) {
  std::mt19937 random(20061);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<GearPair> pairs;
  for (int k = 0; static_cast<int>(pairs.size()) < count; ++k) {
    const bool internal = !external_only && k % 3 == 2;
    GearPairData d;
    d.module = between(0.5, 12) * mm;
    d.teeth[0] = static_cast<int>(between(17, 45));
    d.teeth[1] = internal ? -static_cast<int>(d.teeth[0] + between(25, 90)) : static_cast<int>(between(17, 140));
    d.helix = k % 2 ? between(-30, 30) * degree : 0;
    d.shift[0] = between(0, 0.5);
    d.shift[1] = internal ? between(-0.5, 0) : between(-0.1, 0.5);
    d.backlash = k % 5 ? between(0, 0.1) * d.module : 0;
    d.width = {10 * d.module, 10 * d.module};
    pairs.push_back(solve_gear_pair(d));
  }
  return pairs;
}

double distance(OutlinePoint a, OutlinePoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(Involute, InverseReturnsTheAngle) {
  for (double angle = 1e-4; angle < 1.5; angle *= 1.07)
    EXPECT_NEAR(involute_angle(involute(angle)), angle, 1e-11) << angle;
  EXPECT_EQ(involute_angle(0), 0);
  EXPECT_THROW(involute_angle(-1e-9), std::invalid_argument);
}

TEST(GearWheel, SeventeenTeethAtTwentyDegrees) {
  EXPECT_NEAR(least_teeth({}), 2 / std::pow(std::sin(20 * degree), 2), 1e-12);
  EXPECT_NEAR(least_teeth({}), 17.0973, 1e-4);
  // A helix lowers it.
  EXPECT_LT(least_teeth({}, 30 * degree), 12);
}

TEST(GearWheel, InvoluteBeginsAtTheRootOfTheStraightRackFlank) {
  // ISO 21771: d_Ff² = (d sin α_t − 2 (h_Ff* − x) m/sin α_t)² + d_b².
  for (const GearPair& p : random_pairs(100))
    for (const MeshedWheel& w : p.wheel) {
      if (w.internal() || w.undercut) continue;
      const double s = std::sin(w.transverse_angle);
      const double leg = w.reference_diameter * s - 2 * w.module * (w.rack.straight_depth() - w.generating_shift) / s;
      EXPECT_NEAR(w.form_diameter, std::hypot(leg, w.base_diameter), 1e-11 * w.form_diameter);
    }
}

TEST(GearWheel, UndercutBeginsExactlyAtTheLeastShift) {
  for (const int teeth : {7, 10, 12, 14, 16}) {
    GearWheel w;
    w.teeth = teeth;
    w.module = 2 * mm;
    const auto cut = [&](double shift) {
      w.shift = w.generating_shift = shift;
      w.tip_diameter = w.module * (teeth + 2 * (1 + shift));
      return finish(w);
    };
    w = cut(0);
    const double least = w.least_shift_generated();
    EXPECT_NEAR(least, 1 - teeth * std::pow(std::sin(20 * degree), 2) / 2,
                5e-5);  // ρ_f* = 0.38 leaves 0.99998 m of straight flank
    const GearWheel below = cut(least - 1e-3), above = cut(least + 1e-3);
    EXPECT_TRUE(below.undercut);
    EXPECT_FALSE(above.undercut);
    EXPECT_NEAR(above.form_diameter, above.base_diameter, 1e-5 * above.base_diameter);
    EXPECT_GT(below.form_diameter, below.base_diameter);
    EXPECT_TRUE(cut(0).undercut);
    EXPECT_GT(cut(0).form_diameter, above.form_diameter);
  }
}

TEST(GearWheel, OutlineIsContinuousAndStaysBetweenRootAndTip) {
  std::vector<GearWheel> wheels;
  for (const GearPair& p : random_pairs(60)) wheels.insert(wheels.end(), p.wheel.begin(), p.wheel.end());
  for (const int teeth : {8, 11, 14}) {  // undercut
    GearPairData d;
    d.module = 3 * mm;
    d.teeth = {teeth, 40};
    wheels.push_back(solve_gear_pair(d).wheel[0]);
  }
  for (const GearWheel& w : wheels) {
    const std::vector<FlankPoint> half = half_tooth(w, 200);
    const double low = 0.5 * std::min(std::abs(w.root_diameter), std::abs(w.tip_diameter));
    const double high = 0.5 * std::max(std::abs(w.root_diameter), std::abs(w.tip_diameter));
    EXPECT_NEAR(half.front().angle, pi / std::abs(w.teeth), 1e-12);
    EXPECT_NEAR(half.back().angle, 0, 1e-12);
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
      EXPECT_GE(half[i].radius, low * (1 - 1e-12));
      EXPECT_LE(half[i].radius, high * (1 + 1e-12));
      const double step =
          std::hypot(half[i + 1].radius - half[i].radius, half[i].radius * (half[i + 1].angle - half[i].angle));
      EXPECT_LT(step, 0.05 * w.module) << "z = " << w.teeth << " at point " << i;
    }
  }
}

TEST(GearWheel, ThicknessOnTheReferenceCircleGrowsWithTheShift) {
  for (const GearPair& p : random_pairs(60))
    for (const MeshedWheel& w : p.wheel)
      EXPECT_NEAR(w.thickness(w.reference_diameter),
                  w.transverse_module * (pi / 2 + 2 * w.generating_shift * std::tan(w.rack.pressure_angle)),
                  1e-12 * w.module);
}

TEST(GearWheel, FlanksMeetAtThePointedDiameter) {
  for (const GearPair& p : random_pairs(60, true))
    for (const MeshedWheel& w : p.wheel) {
      EXPECT_NEAR(w.thickness(w.pointed_diameter()), 0, 1e-10 * w.module);
      EXPECT_GT(w.pointed_diameter(), w.base_diameter);
    }
}

TEST(GearWheel, InertiaOfItsOutlineLiesBetweenRootAndTipDisc) {
  for (const GearPair& p : random_pairs(60)) {
    const auto disc = [&](double d, double b) { return pi / 32 * 7850 * b * std::pow(std::abs(d), 4); };
    for (const MeshedWheel& w : p.wheel) {
      const double outer = w.internal() ? disc(w.bore, w.width) : 0, sign = w.internal() ? -1 : 1;
      const double solid = sign * (w.inertia - outer);
      EXPECT_GT(solid, std::min(disc(w.root_diameter, w.width), disc(w.tip_diameter, w.width)));
      EXPECT_LT(solid, std::max(disc(w.root_diameter, w.width), disc(w.tip_diameter, w.width)));
    }
  }
  // A fine module is a disc: error of order m/d.
  GearPairData d;
  d.module = 0.1 * mm;
  d.teeth = {1000, 1000};
  d.width = {10 * mm, 10 * mm};
  EXPECT_NEAR(solve_gear_pair(d).wheel[0].inertia / (pi / 32 * 7850 * 0.01 * 1e-4), 1, 4e-3);
}

TEST(GearPair, CentreDistanceAndShiftLeadBackToEachOther) {
  for (const GearPair& p : random_pairs(200)) {
    GearPairData d = p.data;
    d.centre_distance = std::abs(p.centre_distance);
    d.shift[1].reset();
    const GearPair back = solve_gear_pair(d);
    EXPECT_NEAR(back.wheel[1].shift, p.wheel[1].shift, 1e-9);
    EXPECT_NEAR(back.working_angle, p.working_angle, 1e-10);
    EXPECT_NEAR(p.centre_distance, 0.5 * (p.wheel[0].working_diameter + p.wheel[1].working_diameter),
                1e-12 * std::abs(p.centre_distance));
    EXPECT_NEAR(p.backlash_normal, p.data.backlash, 1e-9 * p.data.module);
  }
}

TEST(GearPair, ContactRatioIsThePathFromTipToTipOverTheBasePitch) {
  for (const GearPair& p : random_pairs(200)) {
    if (p.wheel[0].undercut || p.wheel[1].undercut) continue;
    // Where the line of action crosses both tip circles, found on the line itself.
    const auto crossing = [&](double centre, double radius, double low, double high) {
      const auto off = [&](double g) { return distance(line_point(p, g), {centre, 0}) - radius; };
      for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        ((off(middle) > 0) == (off(high) > 0) ? high : low) = middle;
      }
      return 0.5 * (low + high);
    };
    const double far = 3 * p.wheel[0].tip_diameter;
    const double end = crossing(0, 0.5 * p.wheel[0].tip_diameter, 0, far);
    const double start = p.internal()
                             ? crossing(p.centre_distance, 0.5 * std::abs(p.wheel[1].tip_diameter), p.limit_end, 0)
                             : crossing(p.centre_distance, 0.5 * p.wheel[1].tip_diameter, -far, 0);
    EXPECT_NEAR(end, p.end, 1e-9 * p.data.module);
    EXPECT_NEAR(start, p.start, 1e-9 * p.data.module);
    EXPECT_NEAR(p.contact_ratio, (end - start) / p.base_pitch, 1e-9);
  }
}

TEST(GearPair, FlanksTouchOnTheLineOfActionAllTheWay) {
  // Both flanks by their thickness at the radius of the point, turned to where the mesh has them.
  for (const GearPair& p : random_pairs(200)) {
    const MeshedWheel &one = p.wheel[0], &two = p.wheel[1];
    for (int i = 0; i <= 10; ++i) {
      const double g = p.start + (p.end - p.start) * i / 10, wanted = g - contact_at(p, 0);
      const MeshPlace place = mesh_place(p, wanted / (0.5 * one.base_diameter));
      ASSERT_NEAR(contact_at(p, place.angle_1), g, 1e-12 * one.base_diameter);
      const OutlinePoint contact = line_point(p, g);
      const auto r = p.radius(g);
      const double half_1 = one.thickness(2 * r[0]) / (2 * r[0]);
      const double half_2 = two.thickness(two.internal() ? -2 * r[1] : 2 * r[1]) / (2 * r[1]);
      const double a1 = place.angle_1 + half_1;
      const double a2 = place.angle_2 + (two.internal() ? -half_2 : half_2);
      EXPECT_LT(distance({r[0] * std::cos(a1), r[0] * std::sin(a1)}, contact), 1e-9 * p.data.module);
      EXPECT_LT(distance({p.centre_distance + r[1] * std::cos(a2), r[1] * std::sin(a2)}, contact), 1e-9 * p.data.module)
          << "z2 = " << two.teeth;
    }
  }
}

TEST(GearPair, SlidingIsTheDifferenceOfTheFlanksSpeedsAlongTheTangent) {
  for (const GearPair& p : random_pairs(100)) {
    const double omega_1 = 10, omega_2 = -omega_1 / p.ratio;
    for (const double g : {p.start, 0.3 * p.start, 0.7 * p.end, p.end}) {
      const OutlinePoint at = line_point(p, g);
      // v = ω × r of both wheels, along (−cos α_w, sin α_w): the tangent of the flanks, towards the tip of wheel 1.
      const double tx = std::cos(p.working_angle), ty = -std::sin(p.working_angle);
      const double v1 = -omega_1 * at.y * tx + omega_1 * at.x * ty;
      const double v2 = -omega_2 * at.y * tx + omega_2 * (at.x - p.centre_distance) * ty;
      EXPECT_NEAR(std::abs(v1 - v2), std::abs(p.sliding_speed(g, omega_1)), 1e-10);
      const auto zeta = p.specific_sliding(g);
      EXPECT_NEAR(zeta[0], (v1 - v2) / v1, 1e-7 * (1 + std::abs(zeta[0])));
      EXPECT_NEAR(zeta[1], (v2 - v1) / v2, 1e-7 * (1 + std::abs(zeta[1])));
      // Along the line of action both move alike: the law of gearing.
      const double nx = std::sin(p.working_angle), ny = std::cos(p.working_angle);
      EXPECT_NEAR(-omega_1 * at.y * nx + omega_1 * at.x * ny,
                  -omega_2 * at.y * nx + omega_2 * (at.x - p.centre_distance) * ny, 1e-12);
    }
  }
}

// A wheel's material: its half tooth, whose pieces are found by their angle.
class Material {
 public:
  Material(const GearWheel& wheel, std::vector<FlankPoint> half)
      : half_(std::move(half)), pitch_(2 * pi / std::abs(wheel.teeth)), internal_(wheel.internal()), at_(bins) {
    for (std::size_t i = 0; i + 1 < half_.size(); ++i) {
      const double low = std::min(half_[i].angle, half_[i + 1].angle);
      const double high = std::max(half_[i].angle, half_[i + 1].angle);
      if (high == low) continue;
      for (std::size_t k = bin_of(low); k <= bin_of(high); ++k) at_[k].push_back({low, high, i});
    }
  }

  // How deep a point lies inside, > 0 inside: at its angle, from the radius of the flank there, outwards or inwards.
  double depth(double x, double y) const {
    const double radius = std::hypot(x, y), angle = std::abs(std::remainder(std::atan2(y, x), pitch_));
    double deepest = -1;
    for (const Piece& piece : at_[bin_of(angle)]) {
      if (angle < piece.low || angle > piece.high) continue;
      const FlankPoint &a = half_[piece.first], &b = half_[piece.first + 1];
      const double flank = a.radius + (b.radius - a.radius) * (angle - a.angle) / (b.angle - a.angle);
      const double depth = internal_ ? radius - flank : flank - radius;
      deepest = deepest == -1 ? depth : std::min(deepest, depth);
    }
    return deepest;
  }

 private:
  static constexpr std::size_t bins = 512;
  struct Piece {
    double low, high;
    std::size_t first;
  };
  // Over half a pitch; what lies beyond it is in the first or the last.
  std::size_t bin_of(double angle) const {
    return static_cast<std::size_t>(std::clamp(angle / (0.5 * pitch_), 0.0, 1.0) * (bins - 1));
  }

  std::vector<FlankPoint> half_;
  double pitch_;
  bool internal_;
  std::vector<std::vector<Piece>> at_;
};

TEST(GearWheel, RackRollsOnTheWheelTouchingItAndCuttingNothing) {
  std::vector<GearWheel> wheels;
  for (const GearPair& p : random_pairs(12, true)) wheels.push_back(p.wheel[0]);
  for (const int teeth : {8, 11, 15}) {  // undercut
    GearPairData d;
    d.module = 3 * mm;
    d.teeth = {teeth, 40};
    wheels.push_back(solve_gear_pair(d).wheel[0]);
  }
  for (const GearWheel& w : wheels) {
    const Material material(w, half_tooth(w, 2000));
    const double m = w.module, alpha = w.rack.pressure_angle, rho = w.rack.root_radius * m;
    const double centre_depth = w.rack.dedendum() * m - rho, pitch_radius = 0.5 * w.reference_diameter;
    const double centre_half = m * pi / 4 - centre_depth * std::tan(alpha) - rho / std::cos(alpha);
    double fillet = -1, flank = -1;  // deepest point of the rounding and of the straight flank
    for (int k = -150; k <= 150; ++k) {
      const double travel = 1.2 * pi * m * k / 150;
      const auto depth = [&](double half_width, double below) {
        const double x = half_width / std::cos(w.helix) + travel, y = pitch_radius - below + w.generating_shift * m;
        const double angle = std::atan2(x, y) - travel / pitch_radius + pi / w.teeth, r = std::hypot(x, y);
        return material.depth(r * std::cos(angle), r * std::sin(angle));
      };
      for (int i = 0; i <= 40; ++i) {
        const double psi = alpha + (pi / 2 - alpha) * i / 40;
        fillet = std::max(fillet, depth(centre_half + rho * std::cos(psi), centre_depth + rho * std::sin(psi)));
        const double below =
            -w.rack.addendum * m * 0.9 + (0.9 * w.rack.addendum * m + w.rack.straight_depth() * m) * i / 40;
        flank = std::max(flank, depth(m * pi / 4 - below * std::tan(alpha), below));
      }
    }
    // Depths are measured radially, where a steep flank counts several times.
    EXPECT_LT(fillet, 1e-4 * m) << w.teeth;
    EXPECT_GT(fillet, -1e-3 * m) << w.teeth;
    EXPECT_LT(flank, 1e-4 * m) << w.teeth;
    EXPECT_GT(flank, -1e-3 * m) << w.teeth;
  }
}

TEST(GearPair, DrawnWheelsDoNotOverlapAtAnyAngle) {
  int drawn = 0;
  std::vector<GearPair> pairs = random_pairs(40);
  for (const int teeth : {8, 10, 13}) {  // undercut
    GearPairData d;
    d.module = 2 * mm;
    d.teeth = {teeth, 50};
    pairs.push_back(solve_gear_pair(d));
    ASSERT_TRUE(pairs.back().wheel[0].undercut);
  }
  for (const GearPair& p : pairs) {
    bool valid = true;
    for (const GearVerdict& v : verdicts(p)) valid = valid && v.finding != Finding::fault;
    if (!valid) continue;
    ++drawn;
    const Material material(p.wheel[1], half_tooth(p.wheel[1], 400));
    const std::vector<OutlinePoint> outline = wheel_outline(p.wheel[0], 12);
    double deepest = -1;
    for (int step = 0; step < 12; ++step) {
      const MeshPlace place = mesh_place(p, 2 * pi / p.data.teeth[0] * step / 12);
      const double c1 = std::cos(place.angle_1), s1 = std::sin(place.angle_1);
      const double c2 = std::cos(place.angle_2), s2 = std::sin(place.angle_2);
      for (const OutlinePoint& q : outline) {
        const double x = c1 * q.x - s1 * q.y - p.centre_distance, y = s1 * q.x + c1 * q.y;
        const double r = std::hypot(x, y);
        if (p.internal() ? r < 0.5 * std::abs(p.wheel[1].tip_diameter) : r > 0.5 * p.wheel[1].tip_diameter) continue;
        deepest = std::max(deepest, material.depth(c2 * x + s2 * y, -s2 * x + c2 * y));
      }
    }
    EXPECT_LT(deepest, 2e-4 * p.data.module) << p.data.teeth[0] << " " << p.data.teeth[1];
    EXPECT_GT(deepest, -1) << "the wheels do not even meet";
  }
  EXPECT_GE(drawn, 33);
}

TEST(GearPair, MeshStiffnessOfStandardSteelSpurGearsIsAboutTwentyNewtonPerMicrometre) {
  // By hand: 1/c′_th = 0.04723 + 0.15551/20 + 0.25791/40 = 0.06145325 mm·µm/N; c′ = 0.8 · 0.975 c′_th, h_f* = 1.25.
  GearPairData d;
  d.module = 5 * mm;
  d.teeth = {20, 40};
  d.width = {50 * mm, 48 * mm};
  const GearPair p = solve_gear_pair(d);
  const MeshStiffness s = mesh_stiffness(p);
  EXPECT_NEAR(s.single, 0.8 * 0.975 / 0.06145325 * 1e9, 1e-6 * s.single);
  EXPECT_NEAR(s.mean, s.single * (0.75 * p.contact_ratio + 0.25), 1e-9 * s.mean);
  EXPECT_NEAR(s.torsional, s.mean * 0.048 * std::pow(0.05 * std::cos(20 * degree), 2), 1e-6 * s.torsional);
  EXPECT_TRUE(s.within);
}

TEST(GearPair, BacklashAnglesOfBothWheelsAreInTheRatio) {
  for (const GearPair& p : random_pairs(60))
    EXPECT_NEAR(p.backlash_angle(0), std::abs(p.ratio) * p.backlash_angle(1), 1e-15);
  GearPairData d;  // a wider centre distance: j_n = 2 Δa sin α at first order
  d.module = 4 * mm;
  d.teeth = {19, 95};
  d.shift = {0.0, 0.0};
  d.centre_distance = 228 * mm + 1e-6;
  EXPECT_NEAR(solve_gear_pair(d).backlash_normal, 2e-6 * std::sin(20 * degree), 1e-10);
}

bool says(const GearPair& p, Finding finding, const std::string& words) {
  for (const GearVerdict& v : verdicts(p))
    if (v.finding == finding && v.text.find(words) != std::string::npos) return true;
  return false;
}

TEST(GearVerdicts, NameWhatIsWrong) {
  GearPairData d;
  d.module = 2 * mm;
  d.teeth = {10, 41};
  EXPECT_TRUE(says(solve_gear_pair(d), Finding::warning, "undercut"));
  d.teeth = {12, 41};
  d.shift = {1.1, 0};
  EXPECT_TRUE(says(solve_gear_pair(d), Finding::fault, "pointed"));
  d.shift = {0.4, 0.0};
  d.centre_distance = 52 * mm;  // less than the shifts need
  EXPECT_TRUE(says(solve_gear_pair(d), Finding::fault, "negative backlash"));
  d = {};
  d.module = 2 * mm;
  d.teeth = {30, -36};
  EXPECT_TRUE(says(solve_gear_pair(d), Finding::fault, "Tip fouling"));
  d.teeth = {20, 61};
  d.backlash = 0.1 * mm;
  const GearPair good = solve_gear_pair(d);
  EXPECT_TRUE(says(good, Finding::good, "No undercut"));
  EXPECT_EQ(verdicts(good).size(), 1u);
}

TEST(GearVerdicts, TipFoulingOfInternalPairsAgreesWithTheDrawing) {
  // Differences of teeth from 4 up: the drawn tips overlap exactly where the formula says so. Sharp roots, so that it
  // is the tips alone that can meet.
  int fouling = 0, free = 0;
  for (int difference = 4; difference <= 14; ++difference) {
    GearPairData d;
    d.module = 2 * mm;
    d.teeth = {50, -50 - difference};
    d.rack.root_radius = 0;
    const GearPair p = solve_gear_pair(d);
    const Material material(p.wheel[1], half_tooth(p.wheel[1], 300));
    const std::vector<OutlinePoint> outline = wheel_outline(p.wheel[0], 40);
    double deepest = -1;
    for (int step = 0; step < 40; ++step) {
      const MeshPlace place = mesh_place(p, 2 * pi / 50 * step / 40);
      for (const OutlinePoint& q : outline) {
        const double c1 = std::cos(place.angle_1), s1 = std::sin(place.angle_1);
        const double x = c1 * q.x - s1 * q.y - p.centre_distance, y = s1 * q.x + c1 * q.y;
        if (std::hypot(x, y) < 0.5 * std::abs(p.wheel[1].tip_diameter)) continue;
        const double c2 = std::cos(place.angle_2), s2 = std::sin(place.angle_2);
        deepest = std::max(deepest, material.depth(c2 * x + s2 * y, -s2 * x + c2 * y));
      }
    }
    const double margin = tip_fouling_margin(p);
    const bool fouls = margin<0, overlaps = deepest> 1e-3 * d.module;
    if (std::abs(margin) > 2e-3) {
      EXPECT_EQ(fouls, overlaps) << difference << ": " << margin;
      ++(fouls ? fouling : free);
    }
  }
  EXPECT_GE(fouling, 2);
  EXPECT_GE(free, 2);
}

std::string refusal(const GearPairData& d) {
  try {
    solve_gear_pair(d);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(GearPair, BadInputIsRefusedInWords) {
  GearPairData good;
  good.module = 4 * mm;
  good.teeth = {19, 95};
  EXPECT_EQ(refusal(good), "");
  GearPairData d = good;
  d.module = 0;
  EXPECT_NE(refusal(d).find("module"), std::string::npos);
  d = good;
  d.teeth = {4, 95};
  EXPECT_NE(refusal(d).find("5 teeth"), std::string::npos);
  d.teeth = {30, -25};
  EXPECT_NE(refusal(d).find("more than"), std::string::npos);
  d = good;
  d.centre_distance = 200 * mm;
  EXPECT_NE(refusal(d).find("base circles touch"), std::string::npos);
  d.centre_distance = 240 * mm;
  d.shift = {0, 0};
  EXPECT_NE(refusal(d).find("do not reach"), std::string::npos);
  d = good;
  d.shift = {-2.0, -2.9};
  EXPECT_NE(refusal(d), "");
  d.shift = {std::nan(""), 0};
  EXPECT_NE(refusal(d).find("shift = nan"), std::string::npos);
  d = good;
  d.rack.root_radius = 0.6;
  EXPECT_NE(refusal(d).find("root_radius"), std::string::npos);
  d = good;
  d.helix = 75 * degree;
  EXPECT_NE(refusal(d).find("helix"), std::string::npos);
}

TEST(BevelPair, RightAnglePitchConesAndVirtualTeeth) {
  const BevelPair b{.teeth = {20, 40}, .module = 3 * mm};
  EXPECT_NEAR(b.cone_angle(0), std::atan(0.5), 1e-15);
  EXPECT_NEAR(b.cone_angle(0) + b.cone_angle(1), pi / 2, 1e-15);
  EXPECT_NEAR(b.cone_distance(), 0.5 * 3 * mm * std::sqrt(20 * 20 + 40 * 40), 1e-15);
  EXPECT_NEAR(b.virtual_teeth(0), 20 * std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(b.virtual_teeth(1), 40 * std::sqrt(5), 1e-12);
  // Any shaft angle: the cones roll, d₁/sin δ₁ = d₂/sin δ₂.
  const BevelPair oblique{.teeth = {17, 43}, .module = 3 * mm, .shaft_angle = 65 * degree};
  EXPECT_NEAR(oblique.reference_diameter(0) / std::sin(oblique.cone_angle(0)),
              oblique.reference_diameter(1) / std::sin(oblique.cone_angle(1)), 1e-15);
}

TEST(WormPair, LocksItselfWhereTheLeadAngleIsBelowTheFrictionAngle) {
  WormPair w{.starts = 1, .teeth = 40, .module = 4 * mm, .worm_diameter = 40 * mm, .friction = 0.05};
  EXPECT_NEAR(std::tan(w.lead_angle()), 0.1, 1e-15);
  EXPECT_NEAR(w.friction_angle(), std::atan(0.05 / std::cos(20 * degree)), 1e-15);
  EXPECT_NEAR(w.efficiency(), 0.1 / std::tan(w.lead_angle() + w.friction_angle()), 1e-14);
  EXPECT_FALSE(w.self_locking());
  EXPECT_GT(w.efficiency_back(), 0);
  w.friction = 0.1 * std::cos(20 * degree);  // exactly the limit: driven by the worm just below one half
  EXPECT_NEAR(w.efficiency_back(), 0, 1e-14);
  EXPECT_NEAR(w.efficiency(), 0.5 * (1 - 0.1 * 0.1), 1e-14);
  w.friction = 0.11;
  EXPECT_TRUE(w.self_locking());
  EXPECT_LT(w.efficiency_back(), 0);
}

TEST(PlanetaryTrain, TorquesBalanceAndLossesTakePower) {
  for (const double efficiency : {1.0, 0.97, 0.6})
    for (const double sun : {-3.0, 0.5, 7.0})
      for (const double carrier : {-2.0, 0.1, 4.0})
        for (const double torque : {-10.0, 10.0}) {
          PlanetaryTrain train{-81.0 / 30};
          train.basic_efficiency = efficiency;
          const double ring = train.ring_speed(sun, carrier);
          EXPECT_NEAR(train.carrier_speed(sun, ring), carrier, 1e-13);
          EXPECT_NEAR(train.sun_speed(ring, carrier), sun, 1e-12);
          const auto t = train.torques(torque, sun, carrier);
          EXPECT_NEAR(t.sun + t.ring + t.carrier, 0, 1e-12);
          const double loss = t.sun * sun + t.ring * ring + t.carrier * carrier;
          const double rolling = std::abs(t.sun * (sun - carrier));
          EXPECT_NEAR(loss,
                      torque * (sun - carrier) >= 0 ? (1 - efficiency) * rolling : (1 / efficiency - 1) * -rolling * -1,
                      1e-10 * (1 + rolling));
        }
}

}  // namespace
}  // namespace kurbel::gear_pair_test
