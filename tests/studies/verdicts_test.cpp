// verdicts_test.cpp — what a study says of a machine is what the machine does: settled, efficiency, peaks, shares.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "studies/effects/effect_study.h"
#include "studies/forces/forces.h"
#include "studies/forces/forces_findings.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/scenes.h"
#include "tests/support/steady_simulation.h"
#include "tests/support/thorough.h"

namespace kurbel::verdicts_test {
namespace {

constexpr double pi = std::numbers::pi;

// --- settled ---

// A press on a constant torque that is more than its load takes, with so heavy a wheel that δ stands still.
std::string runaway_press(double torque, double wheel) {
  return fmt::format(R"(
line  = ["motor", "wheel", "press"]
motor = {{ kind = "torque source", torque = "{} N*m" }}
wheel = {{ kind = "flywheel", inertia = "{} kg*m2" }}
press = {{ kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "8 kg", load = {{ kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm", rise = "2 mm" }} }}
)",
                     torque, wheel);
}

// 540 J a turn are taken, 2π M given: the rest stays in ½ I ω², so that ω rises by ΔE/(I ω²) of itself a cycle.
TEST(Settled, RunawayIsNotSettledHoweverStillItsFluctuationStands) {
  for (const double torque : {100.0, 70.0}) {
    const double inertia = 2e6, speed = 8;
    const test::SteadySimulation run =
        test::simulate_steady(test::scene_from(runaway_press(torque, inertia)), Effects{}, speed, 2 * pi, 0, {}, 40);
    ASSERT_TRUE(run.complete) << run.diagnosis;
    const double gain = (2 * pi * torque - 540) / (inertia * speed * speed);  // δ changes by 7e-7 of itself a cycle
    EXPECT_LT(std::abs(gain), 1e-5);
    EXPECT_FALSE(run.settled);
    EXPECT_TRUE(std::isinf(run.speed_to_come));
    EXPECT_NEAR(run.speed_change, gain, 0.02 * std::abs(gain));
  }
}

TEST(Settled, WhatIsStillToComeIsTheRestOfAGeometricCourse) {
  std::mt19937 random(14);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int k = 0; k < 200; ++k) {
    const double q = between(0.05, 0.98), amplitude = std::copysign(std::pow(10, between(-3, 1)), between(-1, 1));
    const auto length = static_cast<std::size_t>(between(5, 60));
    std::vector<double> course, line, growing, swinging;
    for (std::size_t i = 0; i <= length; ++i) {
      const auto n = static_cast<double>(i);
      course.push_back(7 + amplitude * std::pow(q, n));
      line.push_back(7 + amplitude * n);
      growing.push_back(7 + amplitude * std::pow(1 / q, n));
      swinging.push_back(7 + amplitude * std::pow(-q, n));
    }
    const double rest = std::abs(amplitude) * std::pow(q, static_cast<double>(length)), noise = 1e-9;
    if (rest > 1e-6) {
      EXPECT_NEAR(still_to_come(course, noise), rest, 1e-4 * rest);
      EXPECT_GE(still_to_come(swinging, noise), 0.5 * rest);
    }
    EXPECT_TRUE(std::isinf(still_to_come(line, noise)) || std::abs(amplitude) * static_cast<double>(length) < 1e-8);
    EXPECT_TRUE(std::isinf(still_to_come(growing, noise)));
  }
  EXPECT_EQ(still_to_come({1, 1, 1, 1}, 1e-9), 0);
}

// --- forces ---

std::string crank(const std::string& load, const std::string& friction, double speed) {
  return fmt::format(R"(
line = ["wheel", "crank"]
[wheel]
kind = "flywheel"
inertia = "0.4 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.15 kg*m2"
crank_mass = "3 kg"
crank_com = "30 mm"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.81 m/s2"
stroke_angle = "90 deg"
{}
{}
[run]
start = {{ speed = "{} rad/s" }}
until = "1 s"
accuracy = 1e-7
)",
                     load, friction, speed);
}
const char* const bearings = "main_bearing = { radius = \"40 mm\", friction = 0.05 }\nguide = { friction = 0.1 }";

// Of ups and downs of weights and inertia nothing is left over a turn but rounding: no efficiency, and it says why.
TEST(Efficiency, IsNotMadeOfRounding) {
  for (const double speed : {1.0, 30.0, -30.0}) {
    for (const char* friction : {"", bearings}) {
      const Forces f = find_forces(test::scene_from(crank("", friction, speed)), {});
      ASSERT_TRUE(f.prescribed);
      for (const ForceCycle* c : {&*f.prescribed, f.simulated ? &*f.simulated : &*f.prescribed}) {
        EXPECT_FALSE(c->efficiency) << c->label << " " << speed << ": " << c->efficiency.value_or(Estimate{}).value;
        EXPECT_FALSE(c->no_efficiency.empty());
        EXPECT_EQ(c->useful.value, 0);
        if (*friction) {
          EXPECT_GT(c->harmful.value, 0);
        }
      }
      const StudyOutput output = output_of(f);
      const auto json = nlohmann::json::parse(output.json());
      EXPECT_TRUE(json["prescribed"]["efficiency"].is_null());
      EXPECT_NE(json["prescribed"]["no_efficiency"].get<std::string>().find("no "), std::string::npos);
      if (*friction) {
        EXPECT_NE(output.conclusion().find("no efficiency of the cycle: no useful work"), std::string::npos)
            << output.conclusion();
      }
    }
  }
}

// A coasting crank pays its load out of its own motion: never more comes out than was spent.
TEST(Efficiency, LiesBetweenNothingAndOneForAnyLoadSpeedAndFriction) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const int machines = test::thorough() ? 18 : 9;
  int made = 0;
  for (int k = 0; k < machines; ++k) {
    const double force = std::pow(10, between(-9, 2.5));
    const std::string load = k % 3 == 2
                                 ? fmt::format("load = {{ kind = \"medium\", viscous = \"{} N*s/m\" }}", 0.1 * force)
                                 : fmt::format("load = {{ kind = \"opposing\", force = \"{} N\" }}", force);
    const std::string friction = k % 2 ? bearings : "";
    const Forces f = find_forces(test::scene_from(crank(load, friction, between(0, 1) < 0.5 ? -25 : 25)), {});
    for (const ForceCycle* c : {&*f.prescribed, f.simulated ? &*f.simulated : &*f.prescribed}) {
      EXPECT_NE(c->efficiency.has_value(), !c->no_efficiency.empty());
      if (!c->efficiency) continue;
      ++made;
      EXPECT_GE(c->efficiency->value, 0);
      EXPECT_LE(c->efficiency->value, 1);
      // By the balance of energy: what is spent is what comes out and what is lost.
      EXPECT_NEAR(c->efficiency->value, (c->useful / (c->useful + c->harmful)).value, 2e-3)
          << c->label << " " << load << friction;
    }
    for (const PositionForces& p : f.prescribed->positions)
      if (p.power.efficiency()) {
        EXPECT_LE(*p.power.efficiency(), 1);
      }
  }
  EXPECT_GT(2 * made, machines);
}

const char* const pump_with_edges =
    "load = { kind = \"press\", nominal_force = \"400 N\", nominal_travel = \"60 mm\", working_end = \"folded\" }";

// The same peak for any number of rows, as an independent scan finds it; and the same in table, text, JSON and picture.
TEST(ForcePeaks, AreOfTheContinuousMotionWhateverRowsAreAskedFor) {
  const Scene scene = test::scene_from(crank(pump_with_edges, bearings, 30));
  std::optional<Forces> first;
  for (const int positions : {12, 4, 7, 97, 360, 1000, 3600}) {
    ForcesOptions options;
    options.positions = positions;
    options.simulate = positions < 100;
    Forces f = find_forces(scene, options);
    EXPECT_EQ(f.prescribed->rows.size(), static_cast<std::size_t>(positions) + 1);
    if (!first) first = f;
    const auto same = [&](const ForceCycle& a, const ForceCycle& b) {
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(a.reaction(k).value, b.reaction(k).value) << positions << " joint " << k;
        EXPECT_EQ(a.reaction(k).phi, b.reaction(k).phi) << positions;
      }
      EXPECT_EQ(a.torque.value, b.torque.value) << positions;
      EXPECT_EQ(a.shaking_moment.value, b.shaking_moment.value) << positions;
      EXPECT_EQ(a.useful.value, b.useful.value) << positions;
      ASSERT_EQ(a.efficiency.has_value(), b.efficiency.has_value()) << positions;
      if (a.efficiency) {
        EXPECT_EQ(a.efficiency->value, b.efficiency->value) << positions;
      }
      for (const PositionForces& row : a.rows)
        EXPECT_LE(row.forces.joints[0].force.magnitude(), a.reaction(0).value * (1 + 1e-9)) << positions;
    };
    same(*f.prescribed, *first->prescribed);
    if (options.simulate) {
      ASSERT_TRUE(f.simulated && first->simulated);
      same(*f.simulated, *first->simulated);
    }
    // The bearing of the crank as it is, is the same bearing.
    EXPECT_EQ(f.balancing->counterweights[0].peak_bearing.value, f.prescribed->reaction(0).value);
    EXPECT_EQ(f.balancing->counterweights[0].peak_force.value, f.prescribed->shaking_force.value);
  }
  const Forces& f = *first;
  const auto json = nlohmann::json::parse(output_of(f).json());
  double drawn = 0;
  for (const PositionForces& p : f.simulated->curve) drawn = std::max(drawn, p.forces.joints[0].force.magnitude());
  EXPECT_NEAR(drawn, f.simulated->reaction(0).value, 1e-12 * drawn);
  EXPECT_EQ(json["simulated"]["peaks"][0]["value"].get<double>(), f.simulated->reaction(0).value);
  EXPECT_EQ(f.simulated->at_torque_peak.forces.state.phi, f.simulated->torque.phi);
  EXPECT_NEAR(f.simulated->at_torque_peak.forces.torque, f.simulated->torque.value,
              1e-9 * std::abs(f.simulated->torque.value));
}

// Independent of the study: statics on a dense grid, with the press' force by hand on either side of its edges.
TEST(ForcePeaks, AreThoseOfADenseScan) {
  ForcesOptions options;
  options.speed = 30;
  options.simulate = false;
  const Forces f =
      find_forces(test::scene_from(crank("load = { kind = \"opposing\", force = \"900 N\" }", bearings, 30)), options);
  const SliderCrankStatics statics(f.balancing->data, slider_crank_joints(f.joints));
  const SliderCrankGeometry g(f.balancing->data);
  double bearing = 0, torque = 0;
  constexpr int n = 20000;
  const auto look = [&](double phi) {
    const double slope = g.slider(phi).slope;
    const SliderCrankForces s = statics.solve({phi, 30, 0, slope > 0 ? -900.0 : 900.0});
    bearing = std::max(bearing, s.main_bearing.magnitude());
    torque = std::max(torque, std::abs(s.torque));
  };
  for (int i = 0; i < n; ++i) look(2 * pi * (i + 0.5) / n);
  for (const double edge : {0.0, pi}) look(edge - 1e-9), look(edge + 1e-9);
  EXPECT_GE(f.prescribed->reaction(0).value, bearing * (1 - 1e-9));
  EXPECT_LE(f.prescribed->reaction(0).value, bearing * (1 + 1e-6));
  EXPECT_GE(std::abs(f.prescribed->torque.value), torque * (1 - 1e-9));
  EXPECT_LE(std::abs(f.prescribed->torque.value), torque * (1 + 1e-6));
}

// --- effects ---

Figure figure(const QuantityKind& what, const std::string& of, double value, const std::string& unit, double error,
              double scale) {
  Figure made = Figure::of_name(Name::make(what, of), value, unit, scale);
  made.error = error;
  return made;
}

Result with_figures(std::vector<Figure> figures) {
  Result r;
  r.tolerance = 1e-8;
  r.figures = std::move(figures);
  return r;
}

// δ of 0.004 that becomes 0.005 is a quarter off, not 2 % of 0.05. A work is judged by the energy turned over: a loss of
// 2 J of 10 kJ is none that an effect is ranked by.
TEST(Effects, ChangeIsOfTheFigureItselfHoweverSmallBesideTheRatedOne) {
  const std::vector<Figure> full = {figure(quantities::delta, "crank", 0.004, "", 1e-7, 1),
                                    figure(quantities::peak_torque, "pump", 3, "N*m", 1e-5, 4000),
                                    figure(quantities::work, "harmful", -2, "J", 1e-6, 1e4)};
  std::vector<Figure> other = full;
  other[0].value = 0.005, other[1].value = -2.4, other[2].value = -2.02;
  const std::vector<FigureChange> changes = changes_between(with_figures(full), with_figures(other));
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].figure, "delta.crank");
  EXPECT_NEAR(changes[0].relative, 0.25, 1e-12);
  EXPECT_NEAR(changes[1].relative, 0.2, 1e-12);  // of equal peaks either sign may be the larger
  EXPECT_NEAR(changes[2].relative, 0.02 / 1e4, 1e-12);
}

TEST(Effects, FiguresThatAreZeroButForRoundingAreNotCompared) {
  const auto torque = [](double value) {
    return with_figures({figure(quantities::peak_torque, "pump", value, "N*m", 1e-9, 4000)});
  };
  EXPECT_TRUE(changes_between(torque(1e-7), torque(-3e-6)).empty());
  const std::vector<FigureChange> appeared = changes_between(torque(1e-7), torque(5));
  ASSERT_EQ(appeared.size(), 1u);
  EXPECT_TRUE(appeared[0].from_nothing);
  EXPECT_GT(appeared[0].relative, 1e3);
}

// A figure below its own error may be ten times its size in the other run: that is no change, and it does not come
// first.
TEST(Effects, ATinyFigureWithinItsErrorDoesNotDominate) {
  const auto full = with_figures({figure(quantities::peak_torque, "idler", 1e-5, "N*m", 1e-6, 4000),
                                  figure(quantities::peak_torque, "pump", 3, "N*m", 1e-5, 4000)});
  const auto other = with_figures({figure(quantities::peak_torque, "idler", 1e-4, "N*m", 5e-4, 4000),
                                   figure(quantities::peak_torque, "pump", 3.3, "N*m", 1e-5, 4000)});
  const std::vector<FigureChange> changes = changes_between(full, other);
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.front().figure, "peak_torque.pump");
  EXPECT_NEAR(changes.front().relative, 0.1, 1e-12);
  for (const FigureChange& change : changes) EXPECT_EQ(change.reported(), change.figure == "peak_torque.pump");
}

// The measured error is the floor: a looser run's tolerance hides no figure that was measured well.
TEST(Effects, AFigureAThousandTimesSmallerIsJudgedByItsOwnSize) {
  auto full = with_figures({figure(quantities::peak_torque, "main", 4000, "N*m", 1e-4, 4000),
                            figure(quantities::peak_torque, "pump", 4, "N*m", 1e-4, 4000)});
  auto other = with_figures({figure(quantities::peak_torque, "main", 4040, "N*m", 1e-4, 4000),
                             figure(quantities::peak_torque, "pump", 6, "N*m", 1e-4, 4000)});
  full.tolerance = other.tolerance = 1e-2;
  const std::vector<FigureChange> changes = changes_between(full, other);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].figure, "peak_torque.pump");
  EXPECT_NEAR(changes[0].relative, 0.5, 1e-12);
  EXPECT_NEAR(changes[1].relative, 0.01, 1e-12);
}

// Errors add to none of the change: they stand beside it, of both runs, over the same size.
TEST(Effects, ErrorAndDeviationAreApart) {
  for (const double error : {0.0, 1e-3, 0.2}) {
    const std::vector<FigureChange> changes =
        changes_between(with_figures({figure(quantities::delta, "crank", 2, "", error, 1)}),
                        with_figures({figure(quantities::delta, "crank", 2.1, "", 2 * error, 1)}));
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_NEAR(changes[0].relative, 0.05, 1e-12);
    EXPECT_NEAR(changes[0].error, 3 * error / 2, 1e-12);
  }
}

// Scaling a figure and its counterpart changes no verdict, down to the floor.
TEST(Effects, VerdictsDoNotDependOnTheScaleOfAFigure) {
  for (double size = 1e-5; size < 1e3; size *= 10) {
    const auto one = with_figures({figure(quantities::delta, "crank", size, "", 0, 1)});
    const auto other = with_figures({figure(quantities::delta, "crank", size * 1.26, "", 0, 1)});
    const std::vector<FigureChange> changes = changes_between(one, other);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_NEAR(changes.front().relative, 0.26, 1e-9) << size;
  }
}

}  // namespace
}  // namespace kurbel::verdicts_test
