// gear_errors_test.cpp — stated errors of gears' figures cover the difference to the same geometry in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "studies/gears/bevel_worm.h"
#include "studies/gears/gears.h"
#include "tests/support/scenes.h"

namespace kurbel::gear_errors_test {
namespace {

using Real = long double;
using Json = nlohmann::json;

Real inv(Real angle) { return std::tan(angle) - angle; }

// By Newton's method from above, to rounding of long double.
Real angle_of_involute(Real value) {
  Real a = std::min(std::cbrt(3 * value), static_cast<Real>(1.4));
  for (int k = 0; k < 200; ++k) {
    const Real step = (inv(a) - value) / (std::tan(a) * std::tan(a));
    a -= step;
    if (std::abs(step) < 1e-19L) break;
  }
  return a;
}

// External pairs without undercut, with shifts given and nothing else that is not (theory 6.1 … 6.11).
std::map<std::string, Real> pair_in_long_double(const GearPairData& d) {
  const Real pi = std::acos(-1.0L), an = d.rack.pressure_angle, m = d.module, beta = d.helix;
  const Real z1 = d.teeth[0], z2 = d.teeth[1], u = z2 / z1, x1 = *d.shift[0], x2 = *d.shift[1];
  const Real mt = m / std::cos(beta), at = std::atan(std::tan(an) / std::cos(beta));
  const Real a = mt * (z1 + z2) / 2, aw = angle_of_involute(inv(at) + 2 * std::tan(an) * (x1 + x2) / (z1 + z2));
  const Real distance = a * std::cos(at) / std::cos(aw);
  const Real k = std::min(0.0L, (distance - a) / m - (x1 + x2));
  const Real da1 = mt * z1 + 2 * m * (d.rack.addendum + x1 + k), da2 = mt * z2 + 2 * m * (d.rack.addendum + x2 + k);
  const Real db1 = mt * z1 * std::cos(at), db2 = mt * z2 * std::cos(at);
  const Real t1 = -db1 / 2 * std::tan(aw), t2 = db2 / 2 * std::tan(aw);
  const Real end = std::sqrt(da1 * da1 - db1 * db1) / 2 + t1, start = t2 - std::sqrt(da2 * da2 - db2 * db2) / 2;
  const Real pitch = pi * mt * std::cos(at);
  const auto thickness = [&](Real diameter, Real z, Real x, Real db) {
    const Real generating = x - d.backlash / (4 * m * std::sin(an));
    return diameter * ((pi + 4 * generating * std::tan(an)) / (2 * z) + inv(at) - inv(std::acos(db / diameter)));
  };
  const Real dw1 = db1 / std::cos(aw), dw2 = db2 / std::cos(aw), base_helix = std::asin(std::sin(beta) * std::cos(an));
  const Real arc = pi * dw1 / z1 - thickness(dw1, z1, x1, db1) - thickness(dw2, z2, x2, db2);
  return {{"working_angle", aw},
          {"reference_centre_distance", a},
          {"centre_distance", distance},
          {"tip_shortening", k},
          {"base_pitch", pitch},
          {"contact_ratio", (end - start) / pitch},
          {"backlash_normal", arc * std::cos(aw) * std::cos(base_helix)},
          {"wheel.reference_diameter", mt * z1},
          {"wheel.base_diameter", db1},
          {"wheel.working_diameter", dw1},
          {"wheel.tip_diameter", da1},
          {"A.g", start},
          {"E.g", end},
          {"E.zeta", 1 - u * (end - t1) / (t2 - end)},
          {"A.zeta", 1 - (t2 - start) / (u * (start - t1))}};
}

struct Reported {
  Real value, error;
};
Reported reported(const Json& of, const std::string& key) {
  return {of.at(key).get<double>(), of.at(key + "_error").get<double>()};
}

Reported reported_of(const Json& pair, const std::string& name) {
  if (name.starts_with("wheel.")) return reported(pair["wheels"][0], name.substr(6));
  if (name.starts_with("A.") || name.starts_with("E.")) {
    const Json& at = pair["path"][name[0] == 'A' ? 0 : 4];
    if (name.ends_with(".g")) return reported(at, "g");
    const int wheel = name[0] == 'A' ? 0 : 1;
    return {at["specific_sliding"][wheel].get<double>(), at["specific_sliding_error"][wheel].get<double>()};
  }
  return reported(pair, name);
}

TEST(GearErrors, cover_the_difference_to_long_double_and_are_those_of_rounding) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int pairs = 0;
  std::map<std::string, Real> worst;
  for (int trial = 0; trial < 400; ++trial) {
    GearPairData d;
    d.module = between(0.0005, 0.02);
    d.teeth = {static_cast<int>(between(20, 60)), static_cast<int>(between(20, 300))};
    d.helix = trial % 2 ? between(-0.5, 0.5) : 0;
    d.rack.pressure_angle = between(0.3, 0.45);
    d.shift = {between(0.1, 0.8), between(-0.3, 0.8)};
    d.backlash = trial % 3 ? d.module * between(0.001, 0.05) : 0;
    Gears gears;
    try {
      gears = single_pair(d);
    } catch (const std::invalid_argument&) {
      continue;
    }
    const GearPair& p = gears.stages.front().pair;
    if (p.wheel[0].undercut || p.wheel[1].undercut || p.start < p.limit_start || p.end > p.limit_end) continue;
    ++pairs;
    const Json json = Json::parse(output_of(gears).json())["pairs"][0];
    for (const auto& [name, exact] : pair_in_long_double(d)) {
      const Reported t = reported_of(json, name);
      EXPECT_LE(std::abs(t.value - exact), t.error) << name << ", trial " << trial;
      const Real scale = name == "tip_shortening" || name == "backlash_normal" ? p.centre_distance / p.data.module
                         : name.ends_with(".g")                                ? p.centre_distance
                                                                               : std::abs(exact);
      if (!name.ends_with("zeta")) {
        EXPECT_LT(t.error, 1e-12L * scale) << name << ", trial " << trial;
      }
      if (t.error > 0) worst[name] = std::max(worst[name], std::abs(t.value - exact) / t.error);
    }
  }
  EXPECT_GT(pairs, 100);
  // Not so large that they could not fail: of some figure more than a hundredth is used.
  EXPECT_GT(std::max_element(worst.begin(), worst.end(), [](auto& a, auto& b) { return a.second < b.second; })->second,
            0.01L);
}

TEST(GearErrors, of_a_moment_of_inertia_cover_an_outline_of_twenty_times_as_many_points) {
  for (const double bore : {0.0, 0.02}) {
    GearPairData d;
    d.module = 0.004;
    d.teeth = {19, 95};
    d.shift = {0.3, 0.0};
    d.width = {0.04, 0.04};
    d.bore = {bore, bore};
    const Gears gears = single_pair(d);
    const GearStage& s = gears.stages.front();
    for (const std::size_t i : {0UL, 1UL}) {
      const MeshedWheel& w = s.pair.wheel[i];
      const double fine = wheel_inertia(w, w.width, d.density, w.bore, 480), error = inertia_error(s, i);
      EXPECT_LE(std::abs(w.inertia - fine), error);
      EXPECT_LT(error, 1e-3 * w.inertia);
      EXPECT_GT(std::abs(w.inertia - fine), 0.1 * error);
    }
  }
}

// The pair of the page's example, all of it: nothing is stated without an error but what is counted or given.
TEST(GearErrors, stand_beside_every_figure) {
  const Gears gears = find_gears(test::scene_file("scenes/gear_pair.toml"), {.pair = "", .speed = 100.0});
  const StudyOutput output = output_of(gears);
  const Json parsed = Json::parse(output.json());
  for (const Json& pair : parsed["pairs"])
    for (const Json& of : {pair, pair["wheels"][0], pair["wheels"][1], pair["mesh_stiffness"]})
      for (const auto& [key, value] : of.items()) {
        if (!value.is_number_float() || key.ends_with("_error") || key == "module" || key == "helix") continue;
        ASSERT_TRUE(of.contains(key + "_error")) << key;
        EXPECT_TRUE(of[key + "_error"].is_number()) << key;
      }
  for (const KeyFigure& figure : findings_of(gears).figures) EXPECT_TRUE(figure.error.has_value()) << figure.name;
  EXPECT_NE(output.text().find("numerical error"), std::string::npos);
}

TEST(GearErrors, of_a_stiffness_out_of_the_methods_range_are_not_known) {
  GearPairData d;
  d.module = 0.004;
  d.teeth = {30, 60};
  d.width = {0.04, 0.04};
  const Gears in_range = single_pair(d);
  EXPECT_TRUE(in_range.stages[0].stiffness.within);
  EXPECT_NEAR(stiffness_error(in_range.stages[0].stiffness, 100), 8, 1e-12);
  d.shift = {-0.2, 0.5};  // x₁ < x₂
  const Gears beyond = single_pair(d);
  EXPECT_TRUE(Json::parse(output_of(beyond).json())["pairs"][0]["mesh_stiffness"]["mean_error"].is_null());
  for (const KeyFigure& figure : findings_of(beyond).figures)
    if (figure.means == "mesh_stiffness") {
      EXPECT_FALSE(figure.error.has_value());
    }
}

TEST(GearErrors, of_bevel_and_worm_pairs_cover_the_difference_to_long_double) {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int trial = 0; trial < 200; ++trial) {
    const BevelPair b{.teeth = {static_cast<int>(between(10, 40)), static_cast<int>(between(10, 90))},
                      .module = between(0.001, 0.01),
                      .shaft_angle = between(0.3, 1.6)};
    const Json bevel = Json::parse(json_text(summary_of(findings_of(b))));
    const Real sum = b.shaft_angle, u = static_cast<Real>(b.teeth[1]) / b.teeth[0];
    const Real one = std::atan2(std::sin(sum), u + std::cos(sum)), two = sum - one;
    const Real cone = static_cast<Real>(b.module) * b.teeth[0] / (2 * std::sin(one));
    EXPECT_LE(std::abs(bevel["cone_angle"][0].get<double>() - one), bevel["cone_angle_error"][0].get<double>());
    EXPECT_LE(std::abs(bevel["cone_angle"][1].get<double>() - two), bevel["cone_angle_error"][1].get<double>());
    EXPECT_LE(std::abs(reported(bevel, "cone_distance").value - cone), reported(bevel, "cone_distance").error);
    EXPECT_LT(reported(bevel, "cone_distance").error, 1e-13L * cone);
    EXPECT_LE(std::abs(bevel["virtual_teeth"][1].get<double>() - b.teeth[1] / std::cos(two)),
              bevel["virtual_teeth_error"][1].get<double>());

    const WormPair w{.starts = 1 + trial % 4,
                     .teeth = 40,
                     .module = between(0.002, 0.01),
                     .worm_diameter = between(0.03, 0.1),
                     .friction = between(0, 0.2)};
    const Json worm = Json::parse(json_text(summary_of(findings_of(w))));
    const Real lead = std::atan(static_cast<Real>(w.starts) * w.module / w.worm_diameter);
    const Real friction = std::atan(w.friction / std::cos(static_cast<Real>(w.pressure_angle)));
    const Real back = std::tan(lead - friction) / std::tan(lead);
    EXPECT_LE(std::abs(reported(worm, "lead_angle").value - lead), reported(worm, "lead_angle").error);
    EXPECT_LE(std::abs(reported(worm, "efficiency").value - std::tan(lead) / std::tan(lead + friction)),
              reported(worm, "efficiency").error);
    EXPECT_LE(std::abs(reported(worm, "efficiency_back").value - back), reported(worm, "efficiency_back").error);
    EXPECT_LT(reported(worm, "efficiency_back").error, 1e-12L);
  }
}

}  // namespace
}  // namespace kurbel::gear_errors_test
