// slider_crank_forces_test.cpp — published reactions and torques: textbook engines (sc05), a flexible-rod benchmark's
// rigid limit (mb04), a pendulum by ADAMS (mb05), the slider-crank of SUNDIALS' IDAS (sc04).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/steppers/stepper.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/validation.h"

namespace kurbel::slider_crank_forces_test {
namespace {

using test::Against;
using test::Validation;

constexpr double pi = std::numbers::pi;
double degrees(double value) { return value * pi / 180; }
double rpm(double value) { return value * 2 * pi / 60; }
double circle_area(double diameter) { return pi / 4 * diameter * diameter; }

// --- sc05: Khurmi and Gupta, Theory of Machines, chapter 15; "exact" to 1e-6, printed values to 1 % ---

SliderCrankData engine(double r, double l, double reciprocating_mass) {
  SliderCrankData d;
  d.radius = r;
  d.rod_length = l;
  d.slider_mass = reciprocating_mass;
  return d;
}

TEST(TextbookEngine, HorizontalSteamEngineOfExample15_7) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 7");
  const SliderCrankForces f =
      SliderCrankStatics(engine(0.3, 1.2, 250))
          .solve({.phi = degrees(60), .omega = rpm(250), .slider_force = -0.35e6 * circle_area(0.5)});
  is.close("force on the guide", "N", std::fabs(f.guide), 10964.137, 1e-6);
  is.close("force in the rod", "N", f.slider_pin.magnitude(), 50641.181, 1e-6);
  is.close("torque on the crank", "N·m", -f.torque, 14489.518, 1e-6);
  is.close("torque on the crank, as printed", "N·m", -f.torque, 14491, 0.01);
  is.close("tangential force on the crank pin, as printed", "N", -f.torque / 0.3, 48300,
           0.01);  // tangential force on the crank pin
}

TEST(TextbookEngine, VerticalDoubleActingEngineOfExample15_8) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 8");
  SliderCrankData d = engine(0.225, 1.2, 225);
  d.gravity = 9.81;
  d.stroke_angle = pi / 2;
  const double piston = circle_area(0.3), rod = circle_area(0.05);
  const SliderCrankForces f = SliderCrankStatics(d).solve(
      {.phi = degrees(125), .omega = rpm(200), .slider_force = -(30e3 * piston - 1.5e3 * (piston - rod))});
  is.close("torque on the crank", "N·m", -f.torque, 3017.2019, 1e-6);
  is.close("torque on the crank, as printed", "N·m", -f.torque, 3020, 0.01);
}

TEST(TextbookEngine, PetrolEngineOfExample15_11) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 11");
  SliderCrankData d = engine(0.06, 0.25, 1.1);
  d.gravity = 9.81;
  d.stroke_angle = pi / 2;
  const SliderCrankForces f =
      SliderCrankStatics(d).solve({.phi = degrees(20), .omega = rpm(2000), .slider_force = -700e3 * circle_area(0.1)});
  is.close("force on the piston", "N", std::fabs(f.slider_pin.x), 2249.8476, 1e-6);
  is.close("force in the rod", "N", f.slider_pin.magnitude(), 2257.4657, 1e-6);
  is.close("force on the guide", "N", std::fabs(f.guide), 185.3037, 1e-6);
}

TEST(TextbookEngine, TorqueAndAccelerationOfTheFlywheelOfExample15_12) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 12");
  const SliderCrankData d = engine(0.2, 0.6, 60);
  const double piston = circle_area(0.25), rod = circle_area(0.05), omega = rpm(120);
  const SliderCrankForces f = SliderCrankStatics(d).solve(
      {.phi = degrees(45), .omega = omega, .slider_force = -(550e3 * piston - 70e3 * (piston - rod))});
  is.close("torque on the crank", "N·m", -f.torque, 3925.6669, 1e-6);
  is.close("angular acceleration of the flywheel", "rad/s²", (-f.torque - 20e3 / omega) / 21.6, 108.06100, 1e-6);
}

TEST(TextbookEngine, ExpansionByBoyleOfExample15_14) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 14");
  SliderCrankData d = engine(0.18, 0.6, 160);
  d.gravity = 9.81;
  d.stroke_angle = pi / 2;
  const double phi = degrees(75), moved = 0.78 - SliderCrankGeometry(d).slider(phi).value;
  is.close("travel of the piston", "m", moved, 0.1591561932, 1e-9);
  const double pressure = 9.03e5 * (0.36 / 3) / moved - 0.28e5;
  const SliderCrankForces f =
      SliderCrankStatics(d).solve({.phi = phi, .omega = rpm(300), .slider_force = -pressure * circle_area(0.24) + 500});
  is.close("torque on the crank", "N·m", -f.torque, 5809.8082, 1e-6);
}

TEST(TextbookEngine, InertiaAndWeightOfTheRodOfExample15_20) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 20");
  SliderCrankData d = engine(0.3, 1.5, 300);
  d.rod_mass = 250;
  d.rod_com = 0.5;
  d.rod_inertia = 250 * 0.65 * 0.65;
  const CrankState state{.phi = degrees(30), .omega = rpm(125)};
  const double inertia = SliderCrankStatics(d).solve(state).torque;
  d.gravity = 9.81;
  const double total = SliderCrankStatics(d).solve(state).torque;
  is.close("torque by inertia", "N·m", inertia, 3415.7233875, 1e-6);
  is.close("torque by weight", "N·m", total - inertia, 424.7854606, 1e-6);
  is.close("torque on the crank", "N·m", total, 3840.5088, 1e-6);
}

TEST(TextbookEngine, RodInertiaOfBevansExample12_5) {  // slugs, feet, lbf
  const Validation is(Against::published, "Bevan: Theory of Machines, ch. 12, ex. 5");
  constexpr double g = 32.2;  // as the book takes it
  SliderCrankData d = engine(1, 5, 580 / g);
  d.rod_mass = 500 / g;
  d.rod_com = 19.0 / 12;
  d.rod_inertia = d.rod_mass * (25.0 / 12) * (25.0 / 12);
  const double torque = SliderCrankStatics(d).solve({.phi = degrees(40), .omega = rpm(120)}).torque;
  is.close("torque on the crank", "lbf·ft", torque, 2209.1026, 1e-6);
  is.close("torque on the crank, as printed", "lbf·ft", torque, 2200.7, 0.01);
}

TEST(TextbookEngine, MotionOfExample15_5) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 15 (inertia forces in reciprocating parts), ex. 5");
  SliderCrankData d = engine(0.15, 0.6, 1);
  d.rod_mass = 1;
  d.rod_com = 0.15;
  const double phi = degrees(60), omega = rpm(450);
  const SliderCrankGeometry g(d);
  const auto slider = g.slider(phi), rod = g.rod(phi);
  is.close("velocity of the slider", "m/s", -slider.slope * omega, 6.905359943, 1e-9);
  is.close("acceleration of the slider", "m/s²", -slider.curvature * omega * omega, 124.9493439, 1e-9);
  is.close("angular velocity of the rod", "rad/s", -rod.slope * omega, 6.033595821, 1e-9);
  is.close("angular acceleration of the rod", "rad/s²", rod.curvature * omega * omega, 484.3947068, 1e-9);
  const double vx = -0.15 * std::sin(phi) - 0.15 * std::sin(rod.value) * rod.slope;
  const double vy = 0.15 * std::cos(phi) + 0.15 * std::cos(rod.value) * rod.slope;
  is.close("velocity of the middle of the rod", "m/s", std::hypot(vx, vy) * omega, 6.851084906, 1e-9);
  const SliderCrankForces f = SliderCrankStatics(d).solve({.phi = phi, .omega = omega});
  is.close("acceleration of the middle of the rod", "m/s²", f.rod_inertia.magnitude(), 266.8179720,
           1e-9);  // m = 1 kg: its acceleration
}

// --- mb04: rigid limit of the slider-crank with a flexible rod (Simeon, IVP test set) ---

TEST(FlexibleRodBenchmark, RigidRodPushesTheSliderAtTheStart) {
  const Validation is(Against::published, "Simeon: slider crank, Test Set for IVP Solvers, rigid limit at the start");
  SliderCrankData d = engine(0.15, 0.30, 0.075552);
  d.crank_mass = 0.36;
  d.crank_com = 0.075;
  d.crank_inertia = 0.002727;
  d.rod_mass = 0.151104;
  d.rod_com = 0.15;
  d.rod_inertia = 0.0045339259 - d.rod_mass * 0.15 * 0.15;
  const SliderCrankForces f = SliderCrankStatics(d).solve({.phi = 0, .omega = 150});
  is.close("acceleration of the slider", "m/s²", -f.slider_inertia.x / d.slider_mass, -5062.5, 1e-12);
  is.close("force in the rod at the slider", "N", -f.slider_pin.x, 382.4820, 1e-9);
  // Crank pin and bearing carry the links beyond them: Σ m a by hand at φ = 0.
  const double rod_acceleration = -(0.15 * 150 * 150 + 0.15 * 75 * 75);
  EXPECT_NEAR(f.crank_pin.x, -382.4820 + d.rod_mass * rod_acceleration, 1e-6);
  EXPECT_NEAR(f.main_bearing.x, -382.4820 + d.rod_mass * rod_acceleration - 0.36 * 0.075 * 150 * 150, 1e-6);
}

// --- mb05: physical pendulum, reactions by ADAMS ---

TEST(Pendulum, ReactionOfItsHinge) {
  const Validation is(Against::published, "ADAMS: physical pendulum (case mb05), reaction of its hinge");
  const double m = 1, h = 2, g = 9.80665, inertia = 0.1 + m * h * h;
  SliderCrankData d;
  d.radius = 1;
  d.rod_length = 3;  // without mass: a pendulum alone
  d.crank_mass = m;
  d.crank_com = h;
  d.crank_inertia = inertia;
  d.gravity = g;
  const SliderCrankStatics pendulum(d);
  CrankState level{.phi = 0};
  level.alpha = pendulum.acceleration(level, 0);
  EXPECT_NEAR(level.alpha, -m * g * h / inertia, 1e-11);
  is.close("reaction at rest, level", "N", pendulum.solve(level).main_bearing.y, 0.23918658536585277, 1e-10);
  CrankState bottom{.phi = -pi / 2, .omega = std::sqrt(2 * m * g * h / inertia)};
  bottom.alpha = pendulum.acceleration(bottom, 0);
  EXPECT_NEAR(bottom.alpha, 0, 1e-12);
  is.close("reaction at the lowest point", "N", pendulum.solve(bottom).main_bearing.y, 28.94157682926829, 1e-10);
}

// --- sc04: idasSlCrank, a spring and damper between the middles of crank and rod, and a force on the slider ---

class IdasSliderCrank final : public OdeSystem {
 public:
  IdasSliderCrank() : statics_(bodies()) {}
  std::size_t size() const override { return 3; }  // q, q̇, ∫T dt
  void flow(double, std::span<const double> y, std::span<double> rate) override {
    const double q = y[0], w = y[1];
    rate[0] = w;
    rate[1] = statics_.acceleration({.phi = q, .omega = w}, applied(q, w));
    rate[2] = 0.5 * SliderCrankGeometry(bodies()).inertia(q).value * w * w;
  }
  const SparsityPattern& jacobian_pattern() override { return pattern_; }
  void jacobian(double, std::span<const double>, std::span<double>) override { FAIL() << "explicit methods only"; }

 private:
  static SliderCrankData bodies() {
    SliderCrankData d;
    d.radius = 0.5;
    d.rod_length = 1;
    d.crank_inertia = 1;
    d.rod_com = 0;
    d.rod_inertia = 2;
    d.slider_mass = 1;
    return d;
  }
  // The spring's and damper's force, and F on slider and rod, on the crank by their powers at q̇ = 1 (theory 2.2).
  double applied(double q, double w) const {
    const double a = 0.5, k = 1, c = 1, l0 = 1, force = 1;
    const SliderCrankGeometry g(bodies());
    const auto rod = g.rod(q), slider = g.slider(q);
    // Middle of the crank, middle of the rod: ½ a (cos q, sin q) and a (cos q, sin q) + ½ (cos p, sin p).
    const double dx = 0.5 * a * std::cos(q) + 0.5 * std::cos(rod.value),
                 dy = 0.5 * a * std::sin(q) + 0.5 * std::sin(rod.value);
    const double dx1 = -0.5 * a * std::sin(q) - 0.5 * std::sin(rod.value) * rod.slope,
                 dy1 = 0.5 * a * std::cos(q) + 0.5 * std::cos(rod.value) * rod.slope;
    const double length = std::hypot(dx, dy), stretch_ratio = (dx * dx1 + dy * dy1) / length;
    const double pull = k * (length - l0) + c * stretch_ratio * w;
    return -pull * stretch_ratio + force * slider.slope - force * std::sin(rod.value) * rod.slope;
  }
  SliderCrankStatics statics_;
  SparsityPattern pattern_;
};

TEST(IdasSliderCrankProblem, MovesAsPrintedBySundials) {
  const Validation is(Against::published, "SUNDIALS, IDAS example idasSlCrank");
  IdasSliderCrank system;
  const auto stepper = make_stepper(Method::dormand_prince_853, system, {1e-12, {1, 1, 1}});
  const double start[] = {pi / 2, 0, 0};
  stepper->start(0, start);
  const SliderCrankData d = [] {
    SliderCrankData data;
    data.radius = 0.5;
    data.rod_length = 1;
    return data;
  }();
  const SliderCrankGeometry geometry(d);
  struct Row {
    double t, q, x, p, tolerance;
  };
  const Row printed[] = {
      {0.4, 1.5299, 0.88672, -0.52312, 1e-4}, {2, 0.57904, 1.3803, -0.27714, 1e-4},
      {4, -1.2064, 1.0623, 0.48609, 1e-4},    {6, -1.1080, 1.1176, 0.46386, 1e-4},
      {8, 0.64423, 1.3536, -0.30500, 1e-4},   {10, 1.2756758486508692, 1.0235785589794881, -0.49881304918260316, 1e-8}};
  for (const Row& row : printed) {
    while (stepper->t() < row.t) stepper->step(row.t);
    const double q = stepper->y()[0];
    is.near(fmt::format("t = {} s: angle of the crank", row.t), "rad", q, row.q, row.tolerance);
    is.near(fmt::format("t = {} s: position of the slider", row.t), "m", geometry.slider(q).value, row.x,
            row.tolerance);
    is.near(fmt::format("t = {} s: angle of the rod", row.t), "rad", geometry.rod(q).value, row.p, row.tolerance);
  }
  is.near("∫ kinetic energy over 10 s", "J·s", stepper->y()[2], 3.336606799, 1e-8);  // ∫ kinetic energy
}

}  // namespace
}  // namespace kurbel::slider_crank_forces_test
