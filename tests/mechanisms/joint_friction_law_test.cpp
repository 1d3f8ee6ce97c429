// joint_friction_law_test.cpp — friction in joints over tabulated reactions: the torque of all reactions together, its
// derivatives, its kinks as events.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/elements/reacting_pool.h"
#include "engine/equations/jam.h"
#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "mechanisms/kinds/joint_keys.h"
#include "tests/mechanisms/slider_crank_statics.h"
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

JointFriction::State same_state(const CrankState& s) {
  return {.phi = s.phi, .omega = s.omega, .alpha = s.alpha, .load = s.slider_force, .direction = s.direction};
}

// A slider-crank by the closed form, and by the tables of its reactions.
struct Both {
  Both(const SliderCrankData& d, const SliderCrankJoints& j)
      : statics(d, j), law(friction_of(d, joints_of(j))->get(false)) {}
  double scale(const CrankState& s) const {
    return std::abs(statics.solve_frictionless(s).torque) + statics.data().radius * std::abs(s.slider_force);
  }
  SliderCrankStatics statics;
  std::shared_ptr<const JointFriction> law;
};

// The sides on which a state is, for the law to be held on them: the sign of β′ or others that turn, then the edges.
std::vector<int> sides_of(const Both& of, JointFriction::State& s) {
  std::vector<int> modes;
  for (int k = 0; k < of.law->sign_count(); ++k) modes.push_back(of.law->turning(k, s.phi).value > 0 ? 1 : -1);
  std::vector<double> side(static_cast<std::size_t>(of.law->side_count()));
  JointFriction::Place place;
  of.law->sides(s, side.data(), place);
  for (const double value : side) modes.push_back(value > 0 ? 1 : -1);
  s.direction = s.omega > 0 ? 1 : -1;
  s.travel = of.statics.rates(s.phi, 1).slider > 0 ? 1 : -1;
  return modes;
}

TEST(JointFrictionLaw, TorqueIsThatOfAllReactionsTogether) {
  Draw draw;
  for (int k = 0; k < 60; ++k) {
    const Both both(draw.mechanism(), draw.joints(k % 2));
    for (int i = 0; i < 8; ++i) {
      const CrankState s = draw.state();
      const double all = both.statics.solve(s).torque - both.statics.solve_frictionless(s).torque;
      const double enough = 1e-10 * (both.scale(s) + std::abs(all));
      JointFriction::State state = same_state(s);
      EXPECT_NEAR(both.law->torque(state).torque, -all, enough) << k;
      const std::vector<int> modes = sides_of(both, state);
      state.modes = modes.data();
      EXPECT_NEAR(both.law->torque(state).torque, -all, enough) << k;
    }
  }
}

// ε and the torque by it at once, as the scalar equation in ε has them.
TEST(JointFrictionLaw, AnswersWithTheAccelerationOfTheImplicitEquation) {
  Draw draw;
  for (int k = 0; k < 40; ++k) {
    const Both both(draw.mechanism(), draw.joints(k % 2));
    for (int i = 0; i < 6; ++i) {
      const CrankState s = draw.state();
      const double torque = draw.between(-50, 50), shaft = draw.between(0.01, 1);
      CrankState still = s;
      still.alpha = 0;
      CrankState unit = still;
      unit.alpha = 1;
      const double at_rest = both.statics.solve_frictionless(still).torque;
      const double inertia = both.statics.solve_frictionless(unit).torque - at_rest + shaft;
      JointFriction::State state = same_state(s);
      state.alpha = (torque - at_rest) / inertia;
      const JointFriction::Torque found = both.law->torque(state, 1 / inertia);
      const double expected = both.statics.acceleration(s, torque, shaft);
      EXPECT_NEAR(found.alpha, expected, 1e-8 * (std::abs(expected) + s.omega * s.omega)) << k;
      state.alpha = found.alpha;
      const JointFriction::Torque there = both.law->torque(state);
      EXPECT_NEAR(there.torque, found.torque, 1e-9 * (both.scale(s) + std::abs(found.torque)));
      EXPECT_NEAR(there.slope, found.slope, 1e-6 * (inertia + std::abs(found.slope)));
    }
  }
}

// Also where β′ or x′ has changed its sign already: with its sides held the law goes on smoothly.
TEST(JointFrictionLaw, DerivativesEqualDifferencesOnBothSidesOfAKink) {
  Draw draw;
  for (int k = 0; k < 60; ++k) {
    const Both both(draw.mechanism(), draw.joints(k % 2));
    for (int i = 0; i < 5; ++i) {
      CrankState crank = draw.state();
      if (i == 0) crank.phi = (k % 4) * std::acos(0.0) + 1e-7;  // β′ = 0, and near x′ = 0
      JointFriction::State s = same_state(crank);
      const std::vector<int> modes = sides_of(both, s);
      s.modes = modes.data();
      if (i == 0 && k % 2) s.phi -= 2e-7;
      const auto at = [&](double JointFriction::State::*of, double step) {
        JointFriction::State there = s;
        there.*of += step;
        return both.law->torque(there).torque;
      };
      const auto slope = [&](double JointFriction::State::*of, double h) {  // of fourth order
        return (8 * (at(of, h) - at(of, -h)) - (at(of, 2 * h) - at(of, -2 * h))) / (12 * h);
      };
      const auto by = both.law->slopes(s);
      const double scale = both.scale(crank);
      const auto close = [&](double exact, double difference, double unit, const char* what) {
        EXPECT_NEAR(exact, difference, 1e-6 * (std::abs(exact) + 1e-2 * scale / unit)) << k << what;
      };
      using State = JointFriction::State;
      close(by.by_angle, slope(&State::phi, 1e-4), 1, " angle");
      close(by.by_speed, slope(&State::omega, 1e-4 * std::abs(s.omega)), std::abs(s.omega), " speed");
      close(by.by_load, slope(&State::load, 1e-2), 1000, " force");
      close(both.law->torque(s).slope, slope(&State::alpha, 1e-2), 100, " acceleration");
    }
  }
}

// The second extraction has other pieces: it differs, and by no more than tables may.
TEST(JointFrictionLaw, SecondExtractionAgreesAndIsAnother) {
  Draw draw;
  const SliderCrankData d = draw.mechanism();
  const SliderCrankJoints j = draw.joints(true);
  const auto source = friction_of(d, joints_of(j));
  EXPECT_EQ(source->get(false), source->get(false));
  double greatest = 0, apart = 0;
  for (int k = 0; k < 200; ++k) {
    const JointFriction::State s = same_state(draw.state());
    const double first = source->get(false)->torque(s).torque, second = source->get(true)->torque(s).torque;
    greatest = std::max(greatest, std::abs(first)), apart = std::max(apart, std::abs(first - second));
  }
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, 1e-10 * greatest);
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
