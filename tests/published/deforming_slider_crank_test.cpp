// deforming_slider_crank_test.cpp — published slider-cranks with a flexible rod (mb04) and with clearance (cl01).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/reduced/mechanism.h"
#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::test::deforming_slider_crank_test {
namespace {

// B. Simeon's slider crank (Test Set for IVP Solvers): crank at 150 rad/s, slender rod with two modes of bending and
// quadratic stretching, no damping.
const char* const simeon = R"(
line = ["drive", "coupling", "crank"]
drive = { kind = "prescribed speed", speed = "150 rad/s" }
coupling = { kind = "coupling", stiffness = "1 MN*m/rad" }
effects = { elasticity = false }
[crank]
kind = "slider-crank"
radius = "150 mm"
rod = "300 mm"
crank_inertia = "0.002727 kg*m2"
rod_mass = "0.151104 kg"
rod_inertia = "0.0011340859 kg*m2"
slider_mass = "0.075552 kg"
rod_flexibility = { modulus = "200 GPa", height = "8 mm", width = "8 mm", modes = 2 }
[run]
until = "0.1 s"
)";

// The masses of stretching as in the published program, whose matrix lacks the 1/15 of the quadratic element.
std::shared_ptr<const Model> with_stretching_masses(const Scene& scene, double factor) {
  Network net = build_network(scene);
  for (Network::ShaftElement& e : net.elements)
    if (const MechanismElement* element = mechanism_of(e)) {
      Mechanism changed = element->mechanism();
      const auto parts = std::make_shared<Deformation>(deformation_of(changed));
      parts->flexibility->stretching_mass_factor = factor;
      changed.deforming = parts;
      e.element = std::make_shared<MechanismElement>(std::move(changed));
    }
  return compile_network(std::move(net), scene, scene.effects);
}

// Channels at the end of the published run.
std::map<std::string, double> at_the_end(std::shared_ptr<const Model> model, double tolerance) {
  Equations equations(model, false);
  RunOptions options{.tolerance = tolerance, .method = "dop853", .until = 0.1, .progress = {}};
  RunStart start{0, equations.start(0)};
  const std::vector<double> published = {
      0, 0, 0.103339863e-4, 0.169327969e-4, 0.444896105, 0.463434311e-2, -0.178591076e-5, -0.268938672e-5};
  std::copy(published.begin(), published.end(), start.y.end() - static_cast<std::ptrdiff_t>(published.size()));
  options.from = start;
  const RunOutcome outcome = integrate(equations, options, {});
  EXPECT_TRUE(outcome.complete) << outcome.diagnosis;
  const Snapshot& s = equations.snapshot(outcome.t, outcome.state);
  std::map<std::string, double> found;
  for (const Channel& channel : channels_of(*model, {})) found[channel.name.text] = channel.value(s);
  return found;
}

void expect_close(double found, double expected, double relative) {
  EXPECT_NEAR(found, expected, relative * std::fabs(expected));
}

TEST(FlexibleRod, MotionAndReactionsOfSimeonsSliderCrank) {
  const Validation is(Against::published,
                      "Simeon: slider crank with a flexible rod, Test Set for IVP Solvers, at 0.1 s");
  const Scene scene = scene_from(simeon);
  auto end = at_the_end(with_stretching_masses(scene, 15), 1e-12);
  const double x = end["position.crank"], u = end["stretching_end.crank"];
  is.close("position of the slider", "m", x, 0.1697373326718410, 1e-8);
  // r sin φ + (l + u) sin β = 0
  is.close("angle of the rod", "rad", std::asin(-0.15 * std::sin(15.0) / (0.3 + u)), -0.3311734987910881, 1e-8);
  is.close("first bending mode", "m", end["bending_1.crank"], 1.893192460247178e-4, 1e-6);
  is.close("second bending mode", "m", end["bending_2.crank"], 2.375751865617931e-5, 1e-6);
  is.close("stretching of the middle", "m", end["stretching_middle.crank"], -5.323907988763734e-6, 1e-5);
  is.close("stretching of the end", "m", u, -8.363283141616840e-6, 1e-5);
  is.close("velocity of the slider", "m/s", end["velocity.crank"], -8.753116989887888, 1e-6);
  // Multipliers: force of the guide, force on the slider along it, torque on the crank; all with the other sign.
  is.close("force of the guide", "N", end["guide_reaction.crank"], 62.32893262533717, 2e-5);
  is.close("force on the slider", "N", 0.075552 * end["acceleration.crank"], 163.7910131687472, 2e-5);
  is.close("torque on the crank", "N·m", end["torque.coupling"], -25.29853213732781, 2e-5);
}

// The published start is that of smooth motion: the rod stretched as its own inertia and the slider's pull it. In
// equilibrium q̈ = 0, which smooth motion is only nearly: 1e-4 of the amplitudes.
TEST(FlexibleRod, EquilibriumAtTheStartIsSimeonsSmoothMotion) {
  const Validation is(Against::published,
                      "Simeon: slider crank with a flexible rod, Test Set for IVP Solvers, smooth motion at the start");
  Scene scene = scene_from(simeon);
  scene.run.start.equilibrium = true;
  Equations equations(with_stretching_masses(scene, 15), false);
  const std::vector<double> y = equations.start(0);
  const double* own = y.data() + y.size() - 8;
  EXPECT_NEAR(own[0], 0, 1e-12);
  is.close("stretching of the middle at the start", "m", own[2], 0.103339863e-4, 2e-4);
  is.close("stretching of the end at the start", "m", own[3], 0.169327969e-4, 2e-4);
}

// With the masses that belong to the shape functions the motion is the same within what stretching does.
TEST(FlexibleRod, ConsistentMassesOfStretchingChangeSimeonsMotionLittle) {
  const Scene scene = scene_from(simeon);
  auto end = at_the_end(compile(scene, scene.effects), 1e-11);
  expect_close(end["position.crank"], 0.1697373326718410, 1e-6);
  expect_close(end["bending_1.crank"], 1.893192460247178e-4, 1e-4);
  expect_close(end["stretching_end.crank"], -8.363283141616840e-6, 1e-2);
  expect_close(end["guide_reaction.crank"], 62.32893262533717, 3e-3);
}

// P. Flores, R. Leine, C. Glocker (2010): slider between two guides, 1 mm of clearance on either side, free flight from
// the middle to the first touch of a corner.
const char* const flores = R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "153 mm"
rod = "306 mm"
crank_mass = "0.038 kg"
crank_com = "76.5 mm"
crank_inertia = "2.963855e-4 kg*m2"
rod_mass = "0.038 kg"
rod_inertia = "5.9e-4 kg*m2"
slider_mass = "0.076 kg"
gravity = "9.81 m/s2"
clearance = { kind = "guide", gap = "1 mm", stiffness = "1 MN/m", restitution = 0.4, restitution_speed = "0.8 m/s", length = "100 mm", height = "50 mm", inertia = "2.7e-6 kg*m2" }
[run]
start = { speed = "150 rad/s" }
until = "2.8 ms"
accuracy = 1e-9
)";

TEST(JointClearance, FirstContactOfFloresSliderCrank) {
  const Validation is(Against::published,
                      "Flores, Leine, Glocker (2010): slider-crank with clearance, free flight to the first contact");
  const Scene scene = scene_from(flores);
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  // J about the axis: 7.4e-5 + 0.038 · 0.0765².
  const RunOptions options{.tolerance = 1e-12, .method = "dop853", .until = 2.8e-3, .progress = {}};
  const RunOutcome outcome = integrate(equations, options, {});
  ASSERT_FALSE(outcome.events.empty());
  const Event& touch = outcome.events.front();
  EXPECT_NE(touch.what.find("touches"), std::string::npos);
  is.close("time of the first contact", "s", touch.t, 0.002692502752, 1e-6);
  // The state there.
  Equations flight(model, false);
  const RunOutcome there =
      integrate(flight, {.tolerance = 1e-12, .method = "dop853", .until = touch.t, .progress = {}}, {});
  const Snapshot& s = flight.snapshot(there.t, there.state);
  const double phi = s.node_angle[model->reduction_node], omega = s.now.speed[0];
  is.close("angle of the crank there", "rad", phi, 0.35530446, 1e-7);
  is.close("speed of the crank there", "rad/s", omega, 109.55768154, 1e-7);
  const double y = s.now.own[0], y_rate = s.now.own[2];
  is.close("place of the slider across the guide", "m", y, 1e-3, 1e-9);
  is.close("angle of the rod there", "rad", std::asin((y - 0.153 * std::sin(phi)) / 0.306), -0.17150954, 1e-7);
  is.close("approach speed", "m/s", y_rate, 0.84161232, 1e-6);  // gap speed: the slider does not tilt
  EXPECT_NEAR(s.now.own[1], 0, 1e-15);
  Equations earlier(model, false);
  const RunOutcome before =
      integrate(earlier, {.tolerance = 1e-12, .method = "dop853", .until = 2.1e-3, .progress = {}}, {});
  is.close("place of the slider across the guide at 2.1 ms, over 1 mm", "",
           earlier.snapshot(before.t, before.state).now.own[0] / 1e-3, 0.5572862855, 1e-7);
}

}  // namespace
}  // namespace kurbel::test::deforming_slider_crank_test
