// link_forces_test.cpp — springs, dampers, forces and couples within linkages: their travels by both extractions, closed
// forms of energy and torque, reactions, keys and what is said of wrong ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "mechanisms/link_forces/link_forces.h"
#include "studies/forces/linkage_cycle.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/support/scenes.h"

namespace kurbel::link_forces_test {
namespace {

using std::numbers::pi;
using test::SketchOf;
using Of = LinkageTravel::Of;

// Points of Stephenson's chain: O A B C D E G are 0 … 6; links crank, coupler, rocker, rod, lever are 0 … 4.
std::vector<LinkageTravel> travels() {
  const int frame = LinkageSketch::frame;
  return {{Of::distance, {frame, 0}, {4, 5}, 0},
          {Of::distance, {1, 2}, {3, 5}, 0},
          {Of::way, {}, {1, 4}, 0.7},
          {Of::path, {}, {1, 4}, 0},
          {Of::path, {}, {4, 5}, 0},
          {Of::rotation, {frame, -1}, {2, -1}, 0},
          {Of::rotation, {1, -1}, {3, -1}, 0},
          {Of::rotation, {0, -1}, {1, -1}, 0}};
}

void expect_both_extractions(const std::shared_ptr<const Linkage>& linkage, const std::vector<LinkageTravel>& travels) {
  for (const LinkageTravel& travel : travels) {
    ASSERT_EQ(fault_of(*linkage, travel), "");
    const MechanismData data(LinkageTravelData{linkage, travel});
    const auto bodies = data.make_bodies();
    for (int i = 0; i < 40; ++i) {
      const double phi = 0.1 + 0.16 * i, h = 1e-5;
      const ReducedSample a = bodies->sample(phi), b = closed_sample(data, phi);
      const double off = a.output_position - b.output_position;
      EXPECT_NEAR(travel.rocks() ? std::remainder(off, 2 * pi) : off, 0, 1e-14);
      EXPECT_NEAR(a.output_velocity_ratio, b.output_velocity_ratio, 1e-13);
      EXPECT_NEAR(a.output_acceleration_ratio, b.output_acceleration_ratio, 1e-12);
      EXPECT_EQ(b.inertia, 0);
      // Each is the derivative of the one before.
      const ReducedSample next = closed_sample(data, phi + h), last = closed_sample(data, phi - h);
      const double rate = (next.output_velocity_ratio - last.output_velocity_ratio) / (2 * h);
      EXPECT_NEAR(rate, b.output_acceleration_ratio, 1e-6);
      if (travel.of == Of::path) continue;
      const double moved = next.output_position - last.output_position;
      EXPECT_NEAR((travel.rocks() ? std::remainder(moved, 2 * pi) : moved) / (2 * h), b.output_velocity_ratio, 1e-8);
    }
  }
}

TEST(LinkForces, TravelsOfBothExtractionsAgree) {
  expect_both_extractions(test::stephenson().data().linkage, travels());
  // A ram that may ride on its rod, unless something acts beside its pin; links crank, rod, ram are 0, 1, 2, its points 2, 3.
  const int frame = LinkageSketch::frame;
  expect_both_extractions(test::ram_with_a_point_beside_its_pin().moves("ram", 'D', 0).data().linkage,
                          {{Of::distance, {frame, 0}, {2, 3}, 0},
                           {Of::distance, {frame, 0}, {2, 2}, 0},
                           {Of::path, {}, {2, 3}, 0},
                           {Of::rotation, {1, -1}, {2, -1}, 0},
                           {Of::rotation, {frame, -1}, {2, -1}, 0}});
}

// A path's rate is the point's speed, with a sign where it turns about a bearing.
TEST(LinkForces, APathsRateIsThePointsSpeed) {
  const auto linkage = test::stephenson().data().linkage;
  for (int i = 0; i < 20; ++i) {
    const LinkPoses poses = linkage->poses(0.31L * i);
    for (const LinkageTravel& travel : {travels()[3], travels()[4]}) {
      const Path at = poses[travel.to.body](linkage->spot_of(travel.to.point));
      const double speed = double(std::hypot(at.x.slope(), at.y.slope()));
      EXPECT_NEAR(std::abs(double(travel_series(*linkage, poses, travel).slope())), speed, 1e-15);
    }
    const double lever = double(poses[4].turn.rate().value());
    EXPECT_GE(lever * double(travel_series(*linkage, poses, travels()[4]).slope()), 0);
  }
}

// Power of what acts on the links is F s′ω, and the crank needs so much less.
TEST(LinkForces, ReactionsTakeForcesWhereTheyAct) {
  const LinkageData data = test::stephenson().data();
  for (const LinkageTravel& travel : travels()) {
    for (int i = 0; i < 10; ++i) {
      const double phi = 0.2 + 0.6 * i;
      const PlanarLinkage l = linkage_of(data, phi);
      LinkageState state{phi, 9, -20, 0}, with = state;
      add_actions({data.linkage, travel}, 700, data.linkage->poses(phi), l, with.applied);
      const LinkageForces a = forces_in(l, state), b = forces_in(l, with);
      const double ratio = double(travel_series(*data.linkage, data.linkage->poses(phi), travel).slope());
      EXPECT_NEAR(b.torque - a.torque, -700 * ratio, 1e-11);
      EXPECT_NEAR(b.load_power, 700 * ratio * 9, 1e-11);
      EXPECT_LT(b.residual, 1e-14);
      // The frame takes what acts from outside.
      Force2 sum;
      for (std::size_t k = 0; k < a.joints.size(); ++k)
        if (std::string(a.joints[k].from) == "frame")
          sum = sum + Force2{b.joints[k].force.x - a.joints[k].force.x, b.joints[k].force.y - a.joints[k].force.y};
      for (const AppliedForce& applied : with.applied) sum = sum + applied.force;
      EXPECT_NEAR(sum.x, 0, 1e-10);
      EXPECT_NEAR(sum.y, 0, 1e-10);
    }
  }
}

// --- in scenes ---

// A massless yoke x = r cos φ, a spring from its point Y to a point F on its line, an inertia J on the crank.
std::string yoke(const std::string& within, const std::string& run) {
  return R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [60, 0], Y = [300, 0], F = [500, 0] }
frame  = "O F"
slides = { block = { on = "yoke", along = "90 deg" }, yoke = "0 deg" }
[m.links]
crank  = { points = "O A", mass = "1 kg", com = [0, 0], inertia = "0.02 kg*m2" }
block  = "A"
yoke   = "Y"
)" + within +
         "\n[run]\n" + run;
}

// Without a free length the spring is free as it is drawn, at φ = 0: it is stretched by r (1 − cos φ).
TEST(LinkForces, ASpringIsFreeAsItIsDrawn) {
  const Result r =
      test::run(test::scene_from(yoke("[m.springs]\nreturn = { between = \"Y F\", stiffness = \"900 N/m\" }",
                                      "start = { speed = \"200 rpm\" }\nuntil = \"1.1 s\"\naccuracy = 1e-10")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  const double phi = test::figure(r, "final_angle.m"), omega = test::figure(r, "final_speed.m"), start = 200 * pi / 30;
  const double stored = 0.5 * 900 * std::pow(0.06 * (1 - std::cos(phi)), 2);
  EXPECT_NEAR(0.01 * omega * omega + stored, 0.01 * start * start, 1e-7);
  EXPECT_NEAR(r.energy.by_account.at("m.return"), -stored, 1e-7);
}

// J ω²/2 + k r² cos²φ/2 stays: the spring's free length is that of the yoke amid its way.
TEST(LinkForces, ASpringOnAYokeKeepsItsEnergy) {
  const Result r = test::run(test::scene_from(
      yoke("[m.springs]\nreturn = { between = \"Y F\", stiffness = \"900 N/m\", free_length = \"260 mm\" }",
           "start = { speed = \"130 rpm\" }\nuntil = \"3 s\"\naccuracy = 1e-12")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-11);
  const double phi = test::figure(r, "final_angle.m"), omega = test::figure(r, "final_speed.m"), start = 130 * pi / 30;
  const auto stored = [](double angle) { return 0.5 * 900 * std::pow(0.06 * std::cos(angle), 2); };
  EXPECT_NEAR(0.01 * omega * omega + stored(phi), 0.01 * start * start + stored(0), 1e-9);
  EXPECT_NEAR(r.energy.by_account.at("m.return"), stored(0) - stored(phi), 1e-9);
  EXPECT_NEAR(r.energy.by_line.at("weight"), stored(0) - stored(phi), 1e-9);
}

// The same as a pendulum of twice the angle: θ = 2φ, θ″ = −(k r²/J) sin θ about 90°; period by the elliptic integral.
TEST(LinkForces, ASpringOverATogglesPeriodIsThePendulums) {
  // At rest at φ = 60°, it moves to 120° and back: amplitude of θ 60°, about the place where the spring is slack.
  const double rate = std::sqrt(900 * 0.06 * 0.06 / 0.02), amplitude = pi / 3;
  double a = 1, g = std::cos(amplitude / 2);
  for (int i = 0; i < 8; ++i) {
    const double mean = (a + g) / 2;
    g = std::sqrt(a * g), a = mean;
  }
  const double period = 2 * pi / (rate * a);
  const Result r = test::run(test::scene_from(
      yoke("[m.springs]\nreturn = { between = \"Y F\", stiffness = \"900 N/m\", free_length = \"260 mm\" }",
           "start = { speed = \"0 rpm\", angle = \"60 deg\" }\nuntil = \"" + fmt::format("{:.15g}", 1.25 * period) +
               " s\"\naccuracy = 1e-11")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(test::figure(r, "final_angle.m"), pi / 2, 2e-6);
}

// J ω′ = −c r² sin²φ ω: ln ω falls by c r² (φ/2 − sin 2φ/4)/J over the angle, without any ω² terms ω falls linearly so.
TEST(LinkForces, ADamperTakesSpeedOverTheAngle) {
  const Result r =
      test::run(test::scene_from(yoke("[m.springs]\ndamper = { between = \"Y F\", damping = \"20 N*s/m\" }",
                                      "start = { speed = \"300 rpm\" }\nuntil = \"1 s\"\naccuracy = 1e-11")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  const double phi = test::figure(r, "final_angle.m"), omega = test::figure(r, "final_speed.m"), start = 10 * pi;
  EXPECT_NEAR(omega, start - 20 * 0.0036 / 0.02 * (phi / 2 - std::sin(2 * phi) / 4), 1e-8);
  EXPECT_NEAR(r.energy.by_account.at("m.damper"), 0.01 * (omega * omega - start * start), 1e-8);
  EXPECT_EQ(r.energy.by_line.at("weight"), 0);
}

// Quadratic resistance along the pin's path, a circle of radius r: J ω′ = −q r³ ω², 1/ω = 1/ω₀ + q r³ t/J.
TEST(LinkForces, AMediumResistsAlongAPath) {
  const Result r = test::run(test::scene_from(
      yoke("[m.forces]\ndrag = { on = \"A\", load = { kind = \"medium\", quadratic = \"30 N*s2/m2\" } }",
           "start = { speed = \"300 rpm\" }\nuntil = \"4 s\"\naccuracy = 1e-11")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  const double start = 10 * pi;
  EXPECT_NEAR(test::figure(r, "final_speed.m"), 1 / (1 / start + 30 * std::pow(0.06, 3) * 4 / 0.02), 1e-9);
}

// A torsion spring and a constant couple between frame and crank.
TEST(LinkForces, CouplesActBetweenLinks) {
  const Result r = test::run(test::scene_from(yoke(
      "[m.couples]\ndrive = { between = \"frame crank\", torque = { kind = \"constant\", torque = \"3 N*m\", work = "
      "\"driving\" } }\nback = { between = \"block yoke\", damping = \"5 N*m*s/rad\" }",
      "start = { speed = \"60 rpm\" }\nuntil = \"0.5 s\"\naccuracy = 1e-11")));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(test::figure(r, "final_speed.m"), 2 * pi + 3 / 0.02 * 0.5, 1e-8);
}

// A pin's path is measured along the link that guides it, so that the point may reverse.
TEST(LinkForces, APinsPathIsThatOfTheLinkThatGuidesIt) {
  const auto model = compile(test::scene_from(R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0] }
frame  = "O C"
links  = { crank = { points = "O A", inertia = "0.5 kg*m2" }, coupler = "A B", rocker = "C B" }
forces = { drag = { on = "B", load = { kind = "medium", viscous = "30 N*s/m" } } }
)"),
                             Effects{});
  const Mechanism& drag = *link_forces_of(model->network, "m").at(0);
  EXPECT_EQ(drag.data.as<LinkageTravelData>()->travel.to.body, 2);
  // B goes to and fro at |C B| ψ′, and a turn's mean of that is none.
  EXPECT_NEAR(drag.reduced->mean(ReducedMechanism::output_velocity_ratio), 0, 1e-13);
  EXPECT_NEAR(drag.load(1, 2), -30 * drag.reduced->output_position(1).slope * 2, 1e-12);
}

// A press force on a point counts the way along its direction as the same load on the output does.
TEST(LinkForces, ALoadOnAPointIsTheLoadOnTheOutput) {
  const std::string load =
      "{ kind = \"press\", nominal_force = \"400 N\", nominal_travel = \"30 mm\", rise = \"5 mm\" }";
  const std::string run = "start = { speed = \"300 rpm\" }\nuntil = \"1 s\"\naccuracy = 1e-10";
  const Result a =
      test::run(test::scene_from(yoke("", run).replace(yoke("", run).find("[m.links]"), 0, "load = " + load + "\n")));
  const Result b = test::run(
      test::scene_from(yoke("[m.forces]\ntool = { on = \"Y\", along = \"0 deg\", load = " + load + " }", run)));
  EXPECT_TRUE(a.complete && b.complete) << b.diagnosis;
  EXPECT_NEAR(test::figure(b, "final_speed.m"), test::figure(a, "final_speed.m"), 1e-8);
  EXPECT_NEAR(b.energy.by_account.at("m.tool"), a.energy.by_account.at("m.load"), 1e-8);
  EXPECT_LT(b.energy.by_account.at("m.tool"), -1);
}

// Andrews' squeezing mechanism, seven links driven by a constant torque against a spring: data and solution at 30 ms of the
// Test Set for IVP Solvers (Mazzia, Magherini; there as a differential-algebraic system of index 3).
TEST(LinkForces, AndrewsSqueezerIsThatOfTheTestSet) {
  using Place = std::complex<double>;
  const double beta = -0.0617138900142764496, gamma = 0.455279819163070380, phi = 0.222668390165885885,
               delta = 0.487364979543842550, omega = -0.222668390165885885, epsilon = 1.23054744454982119;
  const auto along = [](double length, double angle) { return std::polar(length, angle); };
  const auto across = [](double length, double angle) { return std::polar(length, angle) * Place(0, -1); };
  const Place a{-0.06934, -0.00227}, b{-0.03635, 0.03273}, p = along(0.007, beta), e = p - along(0.028, beta),
                                                           d = b + along(0.02, gamma) + across(0.018, gamma),
                                                           g = a + along(0.04, delta), h = a + across(0.04, epsilon);
  const Place e5 = g + across(0.02, phi + delta), e7 = h + along(0.02, omega + epsilon), e3 = b + across(0.035, gamma);
  for (const Place& same : {e3, e5, e7}) ASSERT_LT(std::abs(same - e), 1e-16);
  const auto at = [](Place x) { return fmt::format("[{:.17g}, {:.17g}]", x.real(), x.imag()); };
  std::string links;
  const auto link = [&](const char* name, const char* points, double mass, Place com, double inertia) {
    links += fmt::format("{} = {{ points = \"{}\", mass = \"{} kg\", com = {}, inertia = \"{} kg*m2\" }}\n", name,
                         points, mass, at(com), inertia);
  };
  link("k1", "O P", 0.04325, along(0.00092, beta), 2.194e-6);
  link("k2", "P E", 0.00365, p - along(0.0115, beta), 4.41e-7);
  link("k3", "B E D", 0.02373, b + along(0.01874, gamma) + across(0.01043, gamma), 5.255e-6);
  link("k4", "G E", 0.00706, g + across(0.02 - 0.01421, phi + delta), 5.667e-7);
  link("k5", "A G", 0.0705, a + along(0.02308, delta) + across(0.00916, delta), 1.169e-5);
  link("k6", "H E", 0.00706, h + along(0.02 - 0.01421, omega + epsilon), 5.667e-7);
  link("k7", "A H", 0.05498, a + along(0.01228, epsilon) + across(0.00449, epsilon), 1.912e-5);
  const Scene scene = test::scene_from(fmt::format(
      R"(
line = ["m"]
[m]
kind    = "linkage"
unit    = "m"
points  = {{ O = [0, 0], P = {}, E = {}, B = {}, D = {}, G = {}, A = {}, H = {}, C = [0.014, 0.072] }}
frame   = "O A B C"
springs = {{ c = {{ between = "C D", stiffness = "4530 N/m", free_length = "77.85 mm" }} }}
couples = {{ mom = {{ between = "frame k1", torque = {{ kind = "constant", torque = "0.033 N*m", work = "driving" }} }} }}
[m.links]
{}[run]
start    = {{ speed = "0 rpm", angle = "{:.18g} rad" }}
until    = "30 ms"
accuracy = 1e-12
)",
      at(p), at(e), at(b), at(d), at(g), at(a), at(h), links, beta));
  const Result r = test::run(scene);
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-10);
  const double angle = test::figure(r, "final_angle.m"), speed = test::figure(r, "final_speed.m");
  EXPECT_NEAR(angle, 15.81077119629904, 1e-8);
  EXPECT_NEAR(speed, 1139.920302151208, 1e-6);
  const auto model = compile(scene, Effects{});
  const Linkage& linkage = *find_mechanism(model->network, "m")->data.as<LinkageData>()->linkage;
  const LinkPoses poses = linkage.poses(angle);
  struct Published {
    int link;
    double start, angle, speed;
  };
  for (const Published& x : {Published{2, gamma, 0.04082224013073101, 11.03291221937134},
                             {4, delta, 0.5244099658805304, 0.5735699284790808},
                             {6, epsilon, 1.048080741042263, 0.3231791658026955}}) {
    const Taylor turned = travel_series(linkage, poses, {Of::rotation, {LinkageSketch::frame, -1}, {x.link, -1}, 0});
    EXPECT_NEAR(x.start + double(turned.value()), x.angle, 1e-9) << x.link;
    EXPECT_NEAR(double(turned.slope()) * speed, x.speed, 2e-6) << x.link;
  }
}

const char* const sieve = R"(
line = ["motor", "sieve"]
[motor]
kind    = "motor"
torque  = { over = "speed", unit = ["rpm", "N*m"], points = [[0, 300], [200, -20]] }
inertia = "0.4 kg*m2"
[sieve]
kind    = "linkage"
unit    = "mm"
points  = { O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0], D = [150, 220], E = [340, 260], G = [420, 80], H = [600, 260] }
frame   = "O C G H"
gravity = "9.81 m/s2"
torque  = { kind = "medium", viscous = "14 N*m*s/rad" }
[sieve.links]
crank   = { points = "O A", mass = "2 kg", inertia = "0.004 kg*m2" }
coupler = { points = "A B D", mass = "3 kg", inertia = "0.03 kg*m2" }
rocker  = { points = "C B", mass = "1.6 kg", inertia = "0.006 kg*m2" }
rod     = { points = "D E", mass = "1.8 kg", inertia = "0.008 kg*m2" }
sieve   = { points = "G E", mass = "14 kg", com = [430, 90], inertia = "0.9 kg*m2" }
[sieve.springs]
over    = { between = "E H", stiffness = "8 N/mm", free_length = "200 mm", damping = "60 N*s/m" }
[sieve.forces]
push    = { on = "D", along = "30 deg", load = { kind = "constant", force = "50 N" } }
air     = { on = "E", load = { kind = "medium", viscous = "5 N*s/m", quadratic = "3 N*s2/m2" } }
[sieve.couples]
brake   = { between = "coupler rod", damping = "0.4 N*m*s/rad", stiffness = "12 N*m/rad" }
[run]
start    = { speed = "150 rpm" }
until    = "1.5 s"
accuracy = 1e-10
)";

TEST(LinkForces, TheMachinesBalanceOverACycle) {
  const Scene scene = test::scene_from(sieve);
  const Forces study = find_forces(scene, {});
  EXPECT_LT(study.prescribed->power_residual, 1e-11);
  EXPECT_LT(study.prescribed->equation_residual, 1e-14);
  ASSERT_TRUE(study.simulated);
  ASSERT_TRUE(study.simulated->machine_residual);
  EXPECT_LT(*study.simulated->machine_residual, 1e-7);
  EXPECT_LT(study.simulated->power_residual, 1e-9);
  const Result r = test::run(scene);
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-9);
  EXPECT_LT(r.energy.by_account.at("sieve.over.damping"), 0);
  EXPECT_LT(r.energy.by_account.at("sieve.air"), 0);
}

// With springs, forces, couples and rubbing joints at once: what the joints lose is what the run misses, and the cycle's
// efficiency is one number by reactions and by the run's works.
TEST(LinkForces, RubbingJointsTakeTheirReactionsFromSpringsAndForces) {
  std::string rough = sieve;
  rough.replace(
      rough.find("[run]"), 5,
      "[sieve.joints]\nA = { radius = \"20 mm\", friction = 0.1 }\nE = { radius = \"15 mm\", friction = 0.12 }\n"
      "G = { radius = \"25 mm\", friction = 0.08 }\n[effects]\njoint_friction = true\n[run]");
  const Scene scene = test::scene_from(rough);
  const Forces study = find_forces(scene, {});
  ASSERT_TRUE(study.friction && study.simulated && study.simulated->machine_residual && study.simulated->efficiency);
  for (const auto& cycle : {study.prescribed, study.simulated}) {
    EXPECT_LT(cycle->power_residual, 1e-12);
    EXPECT_LT(cycle->equation_residual, 1e-14);
    EXPECT_LT(cycle->friction_residual, 1e-12);
  }
  EXPECT_LT(*study.simulated->machine_residual, 1e-7);
  const Result r = test::run(scene);
  EXPECT_LT(r.energy.relative, 1e-9);
  const Figure* efficiency = r.find("machine_efficiency");
  ASSERT_TRUE(efficiency);
  EXPECT_NEAR(efficiency->value, study.simulated->efficiency->value, 1e-8);
  EXPECT_LT(efficiency->value, 0.8);  // 0.765; without friction 0.87
}

// --- keys ---

std::string fault_in(const std::string& within) {
  try {
    compile(test::scene_from(yoke(within, "until = \"1 s\"")), Effects{});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

TEST(LinkForcesKeys, FaultsSayWhatAndWhere) {
  const auto expect = [](const std::string& within, const std::string& words) {
    const std::string fault = fault_in(within);
    EXPECT_NE(fault.find(words), std::string::npos) << fault;
    EXPECT_NE(fault.find("test.toml:"), std::string::npos) << fault;
  };
  expect("[m.springs]\ns = { between = \"Y Q\", stiffness = \"1 N/m\" }", "unknown point \"Q\"");
  expect("[m.springs]\ns = { between = \"Y\", stiffness = \"1 N/m\" }", "must name two points");
  expect("[m.springs]\ns = { between = \"crank F yoke Y\", stiffness = \"1 N/m\" }", "F is not on \"crank\"");
  expect("[m.springs]\ns = { between = \"O F\", stiffness = \"1 N/m\" }", "O and F keep their distance on the frame");
  expect("[m.springs]\ns = { between = \"O A\", stiffness = \"1 N/m\" }", "keep their distance on the crank");
  expect("[m.springs]\ns = { between = \"Y F\" }", "is no spring and no damper");
  expect("[m.springs]\nload = { between = \"Y F\", stiffness = \"1 N/m\" }", "give it another name");
  expect(
      "[m.springs]\ns = { between = \"Y F\", damping = \"1 N*s/m\" }\n[m.couples]\ns = { between = \"frame crank\", "
      "damping "
      "= \"1 N*m*s/rad\" }",
      "is given twice");
  expect("[m.forces]\nf = { between = \"Y F\", on = \"Y\", load = { kind = \"constant\", force = \"1 N\" } }",
         "either between");
  expect("[m.forces]\nf = { on = \"Y\", load = { kind = \"constant\", force = \"1 N\" } }", "without along");
  expect("[m.forces]\nf = { on = \"F\", along = \"0 deg\", load = { kind = \"constant\", force = \"1 N\" } }",
         "stands still");
  expect("[m.forces]\nf = { on = \"crank Y\", along = \"0 deg\", load = { kind = \"constant\", force = \"1 N\" } }",
         "not on \"crank\"; links through it are \"yoke\"");
  expect("[m.couples]\nc = { between = \"frame cranc\", damping = \"1 N*m*s/rad\" }", "unknown link \"cranc\"");
  expect("[m.couples]\nc = { between = \"frame crank\", stiffness = \"1 N*m/rad\" }", "wound up without end");
  expect("[m.couples]\nc = { between = \"frame crank\" }", "has no torque");
}

// Points that come together have no line between them.
TEST(LinkForcesKeys, PointsThatComeTogetherAreRefused) {
  std::string text = yoke("[m.springs]\ns = { between = \"Y F\", stiffness = \"1 N/m\" }", "until = \"1 s\"");
  text.replace(text.find("F = [500, 0]"), 12, "F = [240, 0]");
  try {
    compile(test::scene_from(text), Effects{});
    ADD_FAILURE() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("come together"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace kurbel::link_forces_test
