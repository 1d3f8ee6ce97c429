// joint_friction_law_test.cpp — friction in joints by two unknowns: the torque of the reactions, its derivatives, its
// kinks as events.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/elements/reacting_pool.h"
#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "mechanisms/slider_crank/slider_crank_forces.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"

namespace kurbel::joint_friction_law_test {
namespace {

class Draw {
 public:
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  SliderCrankData mechanism() {
    SliderCrankData d;
    d.radius = between(0.02, 0.2), d.rod_length = d.radius * between(1.3, 6), d.offset = between(-0.2, 0.2) * d.radius;
    d.crank_mass = between(0, 5), d.crank_com = between(-0.5, 1) * d.radius;
    d.crank_inertia = d.crank_mass * d.crank_com * d.crank_com + between(0.01, 1);
    d.rod_mass = between(0, 4), d.rod_com = between(0, 1) * d.rod_length, d.rod_inertia = between(0, 0.1);
    d.slider_mass = between(0.1, 5), d.gravity = 9.81, d.stroke_angle = between(-3, 3);
    return d;
  }
  RevoluteJoint revolute() {
    const double f = between(0, 0.15);
    return {between(0, 0.05), {f, f + between(0, 0.1), between(0.1, 1), between(0, 0.01)}};
  }
  SliderCrankJoints joints(bool long_guide) {
    SliderCrankJoints j{revolute(), revolute(), revolute(), {}};
    j.guide.friction = {0.1, 0.2, 0.3, 0.01};
    if (!long_guide) return j;
    j.guide.length = between(0.05, 0.3), j.guide.middle = between(-0.05, 0.05), j.guide.width = between(0, 0.1);
    j.guide.com_x = between(-0.05, 0.05), j.guide.force_offset = between(-0.02, 0.02);
    return j;
  }
  CrankState state() {
    CrankState s{.phi = between(0, 6.28), .omega = between(0.1, 30), .alpha = between(-100, 100)};
    s.slider_force = between(-1000, 1000);
    if (between(0, 1) < 0.5) s.omega = -s.omega;
    return s;
  }

 private:
  std::mt19937 random_{7};
};

// The sides on which a state is, for the law to be held on them.
CrankState on_its_sides(const SliderCrankStatics& statics, CrankState s) {
  const auto share = statics.edge_shares(s);
  const auto rate = statics.rates(s.phi, 1);
  s.direction = s.omega > 0 ? 1 : -1;
  s.sign = {rate.slider > 0 ? 1 : -1, rate.slider_pin < 0 ? 1 : -1, {share[0] > 0 ? 1 : -1, share[1] > 0 ? 1 : -1}};
  return s;
}

double scale_of(const SliderCrankStatics& statics, const CrankState& s) {
  return std::abs(statics.solve_frictionless(s).torque) + statics.data().radius * std::abs(s.slider_force);
}

TEST(JointFrictionLaw, TorqueIsThatOfAllReactionsTogether) {
  Draw draw;
  for (int k = 0; k < 400; ++k) {
    const SliderCrankStatics statics(draw.mechanism(), draw.joints(k % 2));
    const CrankState s = draw.state();
    const double all = statics.solve(s).torque - statics.solve_frictionless(s).torque;
    EXPECT_NEAR(statics.friction_torque(s).torque, all, 1e-12 * (scale_of(statics, s) + std::abs(all))) << k;
    const CrankState held = on_its_sides(statics, s);
    EXPECT_NEAR(statics.friction_torque(held).torque, all, 1e-12 * (scale_of(statics, s) + std::abs(all))) << k;
  }
}

// Also where β′ or x′ has changed its sign already: with its sides held the law goes on smoothly.
TEST(JointFrictionLaw, DerivativesEqualDifferencesOnBothSidesOfAKink) {
  Draw draw;
  for (int k = 0; k < 300; ++k) {
    const SliderCrankStatics statics(draw.mechanism(), draw.joints(k % 2));
    CrankState s = draw.state();
    if (k % 3 == 0) s.phi = (k % 4) * std::acos(0.0) + 1e-7;  // β′ = 0, and near x′ = 0
    s = on_its_sides(statics, s);
    if (k % 6 == 0) s.phi -= 2e-7;
    const auto at = [&](double CrankState::*of, double step) {
      CrankState there = s;
      there.*of += step;
      return statics.friction_torque(there).torque;
    };
    const auto slope = [&](double CrankState::*of, double h) {  // of fourth order
      return (8 * (at(of, h) - at(of, -h)) - (at(of, 2 * h) - at(of, -2 * h))) / (12 * h);
    };
    const auto by = statics.friction_slopes(s);
    const double scale = scale_of(statics, s);
    const auto close = [&](double exact, double difference, double unit, const char* what) {
      EXPECT_NEAR(exact, difference, 1e-6 * (std::abs(exact) + 1e-2 * scale / unit)) << k << what;
    };
    close(by.by_angle, slope(&CrankState::phi, 1e-4), 1, " angle");
    close(by.by_speed, slope(&CrankState::omega, 1e-4 * std::abs(s.omega)), std::abs(s.omega), " speed");
    close(by.by_force, slope(&CrankState::slider_force, 1e-2), 1000, " force");
    close(statics.friction_torque(s).slope, slope(&CrankState::alpha, 1e-2), 100, " acceleration");
  }
}

// What is remembered within one balance is where to begin, not what to find.
TEST(JointFrictionLaw, MemoryChangesNoAnswer) {
  Draw draw;
  for (int k = 0; k < 100; ++k) {
    const SliderCrankStatics statics(draw.mechanism(), draw.joints(k % 2));
    CrankState s = draw.state();
    SliderCrankStatics::Memory memory;
    for (int i = 0; i < 4; ++i, s.alpha += draw.between(-50, 50)) {
      const double alone = statics.friction_torque(s).torque;
      EXPECT_NEAR(statics.friction_torque(s, memory).torque, alone, 1e-12 * (scale_of(statics, s) + std::abs(alone)));
    }
  }
}

std::string press(const std::string& length) {
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
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.81 m/s2"
main_bearing = {{ radius = "40 mm", friction = 0.05 }}
crank_pin = {{ radius = "30 mm", friction = 0.05 }}
slider_pin = {{ radius = "15 mm", friction = 0.08 }}
guide = {{ friction = 0.1{} }}
[effects]
joint_friction = true
[run]
start = {{ speed = "30 rad/s" }}
until = "0.8 s"
)",
                     length);
}

const ReactingPool& reacting_pool(const Model& model) {
  for (const auto& pool : model.pools)
    if (pool->reacts()) return dynamic_cast<const ReactingPool&>(*pool);
  throw std::runtime_error("nothing reacts");
}

// Wherever a step ends, every side that is held is the one that the reactions have.
struct SidesOfEverySteps : Observer {
  explicit SidesOfEverySteps(Equations& of) : equations(of), guards(of.guard_count()) {}
  void step(StepView& view) override {
    const std::vector<double> y(view.y().begin(), view.y().end());
    equations.guards(view.t(), y, guards);
    for (const double g : guards) least = std::min(least, g);
    const ReactingPool& pool = reacting_pool(equations.model());
    std::vector<int> now;
    for (const int place : pool.side_modes()) now.push_back(equations.modes().piece[static_cast<std::size_t>(place)]);
    changes += !last.empty() && now != last;
    for (const int side : now) EXPECT_EQ(std::abs(side), 1) << "at " << view.t();
    last = now;
  }
  Equations& equations;
  std::vector<double> guards;
  std::vector<int> last;
  double least = 1;
  int changes = 0;
};

TEST(JointFrictionLaw, GuideForceThatChangesSidesIsAnEventOfTheRun) {
  for (const char* length : {"", ", length = \"60 mm\", width = \"80 mm\""}) {
    const Scene scene = test::scene_from(press(length));
    Equations equations(compile(scene, scene.effects), false);
    SidesOfEverySteps sides(equations);
    const RunOptions options{.tolerance = 1e-8,
                             .method = "dop853",
                             .until = scene.run.until,
                             .budget = 60,
                             .interrupted = nullptr,
                             .progress = {},
                             .work_tables = nullptr};
    integrate(equations, options, {&sides});
    EXPECT_GT(sides.changes, 6) << length;
    EXPECT_GT(sides.least, -1e-9) << length;
  }
}

TEST(JointFrictionLaw, JacobianIsExactOnTheSidesThatHold) {
  const Scene scene = test::scene_from(press(", length = \"60 mm\", width = \"80 mm\""));
  Equations equations(compile(scene, scene.effects), false);
  for (const double phi : {0.02, 1.57, 1.58, 3.13, 4.71, 6.1}) {
    const std::vector<double> y = equations.state_of(0, phi, {}, std::vector<double>{20});
    const test::Slopes slopes = test::slopes_of(equations, 0, y, std::vector<double>(y.size(), 1e-4));
    for (std::size_t row = 0; row < y.size(); ++row)
      for (std::size_t column = 0; column < y.size(); ++column) {
        const double slope = slopes.difference_at(row, column);
        EXPECT_NEAR(slopes.exact_at(row, column), slope, 1e-7 * (1 + std::abs(slope))) << phi;
      }
  }
}

}  // namespace
}  // namespace kurbel::joint_friction_law_test
