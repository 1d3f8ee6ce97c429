// planetary_gear_test.cpp — planetary gear and differential with three free shafts: Willis, torques, inertia, losses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "drivetrain/gears/planetary.h"
#include "tests/published/published.h"
#include "tests/support/jacobians.h"
#include "tests/support/validation.h"

namespace kurbel::planetary_gear_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::series;
using test::Validation;

// Torques on all three shafts; speeds at the start of sun and ring.
std::string three_shafts(double sun, double ring, double carrier, const std::string& gear, double sun_speed,
                         double ring_speed) {
  return fmt::format(R"(
line = ["sun", "gear", "carrier"]
sun = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.02 kg*m2" }}
gear = {{ kind = "planetary gear", sun = 30, ring = 80{} }}
carrier = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.5 kg*m2" }}
ring = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.1 kg*m2" }}
run = {{ start = {{ sun = {{ speed = "{:.17g} rad/s" }}, ring = {{ speed = "{:.17g} rad/s" }} }}, until = "0.5 s", accuracy = 1e-9, samples = 11 }}
[[branch]]
from = "gear.ring"
line = ["ring"]
)",
                     sun, gear, carrier, ring, sun_speed, ring_speed);
}
const double i0 = -80.0 / 30;

TEST(PlanetaryGear, SpeedsObeyWillisWhateverTheTorques) {
  for (const double ring_torque : {-7.0, 0.0, 12.0})
    for (const double carrier_torque : {-40.0, 9.0}) {
      const Result r = run(three_shafts(5, ring_torque, carrier_torque, "", 100, -30));
      ASSERT_TRUE(r.complete) << r.diagnosis;
      const auto s = series(r, "speed.gear.in"), g = series(r, "speed.gear.ring"), c = series(r, "speed.gear.out");
      for (std::size_t k = 0; k < s.size(); ++k) EXPECT_NEAR(s[k] - c[k], i0 * (g[k] - c[k]), 1e-10);
      EXPECT_NEAR(s.front(), 100, 1e-12);
      EXPECT_NEAR(g.front(), -30, 1e-12);
      const auto a = series(r, "angle.gear.in"), b = series(r, "angle.gear.ring"), d = series(r, "angle.gear.out");
      EXPECT_NEAR(a.back() - d.back(), i0 * (b.back() - d.back()), 1e-10);
      EXPECT_LT(r.energy.relative, 1e-11);
    }
}

// T_r = −i₀ T_s, T_c = −(1 − i₀) T_s (with losses −i₀ η₀ while rolling power flows from the sun): nothing accelerates.
TEST(PlanetaryGear, TorquesInWillisRatioBalance) {
  for (const double efficiency : {1.0, 0.9})
    for (const double sun_torque : {10.0, -10.0})
      for (const double sun_speed : {80.0, -80.0}) {
        const PlanetaryTrain train{i0, efficiency};
        const double ring_speed = 20, carrier_speed = train.carrier_speed(sun_speed, ring_speed);
        const PlanetaryTrain::Torques t = train.torques(sun_torque, sun_speed, carrier_speed);
        const Result r = run(three_shafts(t.sun, t.ring, t.carrier,
                                          efficiency < 1 ? fmt::format(", efficiency = {}", efficiency) : "", sun_speed,
                                          ring_speed));
        EXPECT_NEAR(figure(r, "final_speed.sun"), sun_speed, 1e-9);
        EXPECT_NEAR(figure(r, "final_speed.ring"), ring_speed, 1e-9);
        EXPECT_NEAR(series(r, "torque.gear.sun").back(), t.sun, 1e-9);
        EXPECT_NEAR(series(r, "torque.gear.ring").back(), -t.ring, 1e-9);
        EXPECT_NEAR(series(r, "torque.gear.carrier").back(), -t.carrier, 1e-9);
        const double lost = 0.5 * (t.sun * sun_speed + t.ring * ring_speed + t.carrier * carrier_speed);
        EXPECT_NEAR(efficiency < 1 ? r.energy.by_account.at("gear") : 0.0, -lost, 1e-8);
        EXPECT_LT(r.energy.relative, 1e-11);
      }
}

// The planets' energy ½ J (ω_p)² of all motions, from shares on the three shafts.
TEST(PlanetaryGear, PlanetsTurningEnergyIsThatOfTheirSharesOnTheShafts) {
  for (const auto& [sun, planet, second, ring] :
       {std::array{30.0, 25.0, 25.0, 80.0}, {12.0, 40.0, 40.0, 92.0}, {50.0, 20.0, 35.0, 105.0}}) {
    const PlanetShares share = shares_of_planet(sun / planet, ring / second);
    const PlanetaryTrain train{-planet / sun * ring / second};
    for (const double ws : {-7.0, 0.0, 11.0})
      for (const double wc : {-3.0, 0.0, 5.0}) {
        const double wr = train.ring_speed(ws, wc), own = wc - (ws - wc) * sun / planet;
        const double sum = share.sun * ws * ws + share.ring * wr * wr + share.carrier * wc * wc;
        EXPECT_NEAR(sum, own * own, 1e-12 * (1 + sum + std::abs(share.carrier) * wc * wc));
      }
  }
}

// tests/cases/pl01_planetary.toml: ring fixed, reduced to the sun 5.783904958677685e-4 kg·m².
TEST(PlanetaryGear, WithItsRingFixedShowsThePublishedInertiaAtTheSun) {
  const std::string text = R"(
line = ["sun", "gear"]
sun = { kind = "torque source", torque = "0.05 N*m" }
gear = { kind = "planetary gear", sun = 30, planet = 25, ring = 80, fixed = "ring", module = "2 mm", planets = 3, sun_inertia = "2e-4 kg*m2", carrier_inertia = "3e-3 kg*m2", ring_inertia = "7 kg*m2", planet_inertia = "5e-5 kg*m2", planet_mass = "0.15 kg" }
run = { until = "1 s", accuracy = 1e-10 }
)";
  const Scene scene = test::scene_from(text);
  const auto model = compile(scene, scene.effects);
  EXPECT_EQ(model->free_shafts, 1u);
  EXPECT_TRUE(model->relations.empty());
  EXPECT_NEAR(model->shafts.front().inertia, 5.783904958677685e-4, 1e-15);
  const Result r = run(scene);
  EXPECT_NEAR(figure(r, "final_speed.sun"), 0.05 / 5.783904958677685e-4, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.gear"), 0.05 / 5.783904958677685e-4 * 3 / 11, 1e-9);
  // With losses it is a relation; with next to none it moves alike.
  const Result lossy = run(test::with(text, "fixed = \"ring\"", "fixed = \"ring\", efficiency = 0.9999999999"));
  EXPECT_NEAR(figure(lossy, "final_speed.sun"), figure(r, "final_speed.sun"), 1e-7);
}

// Khurmi, Theory of Machines, ch. 13 (tests/cases/pl01_planetary.toml): arm 18 → sun 58.5 with a ring of 72 held
// (example 13.6); compound planets 20 and 35 between 50 and a held ring of 105: 110 → 50 (13.10).
TEST(PlanetaryGear, SpeedsArePublishedOnes) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 13 (gear trains): runs of ex. 6 and 10");
  const auto out = [](const std::string& gear, double speed) {
    return figure(run(fmt::format(R"(
line = ["drive", "gear", "load"]
drive = {{ kind = "prescribed speed", speed = "{} rpm" }}
gear = {{ kind = "planetary gear", {} }}
load = {{ kind = "flywheel", inertia = "1 kg*m2" }}
run = {{ until = "0.1 s" }}
)",
                                  speed, gear),
                      false),
                  "final_speed.load") *
           60 / test::two_pi;
  };
  is.near("ex. 6: speed of the sun, ring held", "rpm",
          out("sun = 32, ring = 72, in = \"carrier\", out = \"sun\", fixed = \"ring\"", 18), 58.5, 1e-9);
  is.near("ex. 10: speed of the carrier, compound planets", "rpm",
          out("sun = 50, planet = 20, second_planet = 35, ring = 105, fixed = \"ring\"", 110), 50, 1e-9);
  EXPECT_NEAR(out("sun = 30, ring = 80, in = \"sun\", out = \"ring\", fixed = \"carrier\"", 80), -30, 1e-9);
  EXPECT_NEAR(out("sun = 30, ring = 80, in = \"ring\", out = \"carrier\", fixed = \"sun\"", 110), 80, 1e-9);
}

// As in an automatic gearbox: the ring runs free, then a brake takes hold of it, and sun and carrier turn by 1 − i₀.
TEST(PlanetaryGear, ABrakeOnTheRingSetsTheRatio) {
  const Result r = run(R"(
line = ["motor", "gear", "load"]
motor = { kind = "torque source", torque = "20 N*m", inertia = "0.1 kg*m2" }
gear = { kind = "planetary gear", sun = 30, ring = 80 }
load = { kind = "load", damping = "2 N*m*s/rad", inertia = "3 kg*m2" }
brake = { kind = "brake", torque = "400 N*m", inertia = "0.05 kg*m2" }
run = { until = "4 s", accuracy = 1e-8 }
[[branch]]
from = "gear.ring"
line = ["brake"]
[sequence]
steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "1 s", set = "brake", to = 1, over = "0.2 s" }]
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), (1 - i0) * figure(r, "final_speed.load"), 1e-9);
  EXPECT_EQ(series(r, "speed.gear.ring").back(), 0.0);
  EXPECT_LT(std::abs(series(r, "torque.gear.ring").back() + i0 * -20), 20);  // near T_r = −i₀ T_s
  bool held = false;
  for (const Event& e : r.events) held = held || (e.t > 1 && e.what == "comes to rest and is held");
  EXPECT_TRUE(held);
  EXPECT_LT(r.energy.by_account.at("brake"), 0);
  EXPECT_LT(r.energy.relative, 1e-8);
  EXPECT_TRUE(r.accuracy_confirmed);
}

TEST(PlanetaryGear, JacobianEqualsDifferencesFreeHeldAndWithLosses) {
  for (const char* gear : {"", ", efficiency = 0.9"})
    for (const double ring_speed : {30.0, 0.0})
      for (const char* brake : {"0.5", "500"})
        test::expect_exact_jacobian_near_start(fmt::format(R"(
line = ["motor", "gear", "coupling", "pump"]
motor = {{ kind = "load", damping = "0.3 N*m*s/rad", quadratic = "0.02 N*m*s2/rad2", inertia = "0.02 kg*m2" }}
drive = {{ kind = "torque source", torque = "50 N*m", on = "motor" }}
gear = {{ kind = "planetary gear", sun = 30, ring = 80, carrier_inertia = "0.1 kg*m2"{} }}
coupling = {{ kind = "coupling", stiffness = "500 N*m/rad", damping = "2 N*m*s/rad" }}
pump = {{ kind = "load", damping = "1 N*m*s/rad", inertia = "0.1 kg*m2" }}
ring = {{ kind = "brake", torque = "{} N*m", slope = "0.1 N*m*s/rad", inertia = "0.05 kg*m2" }}
effects = {{ elasticity = true, gear_losses = {} }}
run = {{ start = {{ motor = {{ speed = "100 rad/s" }}, ring = {{ speed = "{} rad/s" }}, coupling = {{ twist = "0.02 rad" }} }}, until = "1 s" }}
[[branch]]
from = "gear.ring"
line = ["ring"]
)",
                                                           gear, brake, *gear ? "true" : "false", ring_speed),
                                               {}, 1e-6);
}

// ω₁ + ω₂ = 2 ω_cage; without losses both outputs get half of the cage's torque.
TEST(Differential, SharesTorqueEquallyAtAnySpeeds) {
  const Result r = run(R"(
line = ["drive", "axle", "left"]
drive = { kind = "torque source", torque = "100 N*m", inertia = "0.1 kg*m2" }
axle = { kind = "differential", ratio = 4 }
left = { kind = "torque source", torque = "-150 N*m", inertia = "5 kg*m2" }
right = { kind = "torque source", torque = "-250 N*m", inertia = "5 kg*m2" }
run = { start = { speed = "40 rad/s" }, until = "0.5 s", accuracy = 1e-9, samples = 11 }
[[branch]]
from = "axle.second"
line = ["right"]
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto left = series(r, "speed.left"), right = series(r, "speed.right"), drive = series(r, "speed.drive");
  for (std::size_t k = 0; k < left.size(); ++k) EXPECT_NEAR(left[k] + right[k], 2 * drive[k] / 4, 1e-11);
  EXPECT_NEAR(left.front(), 10, 1e-12);
  EXPECT_NEAR(series(r, "torque.axle.out").back(), series(r, "torque.axle.second").back(), 1e-10);
  // Sum motion: (2 · 5 + 16 · 0.1) ω̇_c = 4 · 100 − 400; difference: 5 ω̇ = ±50.
  EXPECT_NEAR(figure(r, "final_speed.left"), 10 + 0.5 * 50 / 5, 1e-10);
  EXPECT_NEAR(figure(r, "final_speed.right"), 10 - 0.5 * 50 / 5, 1e-10);
}

}  // namespace
}  // namespace kurbel::planetary_gear_test
