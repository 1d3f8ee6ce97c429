// linkage_friction_test.cpp — friction in the joints of any linkage: closed forms, a four-bar by hand, runs, refusals.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "engine/equations/jam.h"
#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/reduced/mechanism.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"

namespace kurbel::linkage_friction_test {
namespace {

const double pi = std::acos(-1.0);

std::shared_ptr<const JointFriction> law_of(const MechanismData& data, const std::vector<RubbingJoint>& joints) {
  return tabulate_joint_friction(data, joints, {}, {}, Extraction::first);
}

RubbingJoint pin(const std::string& name, double radius, double f) {
  return {.name = name, .friction = {f, f, 0, 0}, .radius = radius};
}

// Crank O A along +x, rod A B, ram on the line y = 0.
test::SketchOf crank_and_ram() {
  test::SketchOf of;
  of.point('O', 0, 0).point('A', 0.1, 0).point('B', 0.4, 0).frame("O");
  of.link("crank", "OA").link("rod", "AB").link("ram", "B").slide("ram", 0);
  of.moves("ram", 'B', 0);
  return of;
}

// A force on the ram, nothing has mass: at φ = 90° every pin carries F/cos β, tan β = r/√(l² − r²).
TEST(LinkageFriction, PinHasItsFrictionCircle) {
  const double r = 0.1, l = 0.3, force = 1000, cos_beta = std::sqrt(1 - r * r / (l * l)), f = 0.3;
  const double rho = 0.05 * f / std::sqrt(1 + f * f);
  const JointFriction::State state{.phi = pi / 2, .omega = 2, .load = force};
  const MechanismData data = crank_and_ram().data();
  EXPECT_NEAR(law_of(data, {pin("pin O", 0.05, f)})->torque(state).torque, -rho * force / cos_beta, 1e-9);
  // The ram's pin: the rod stands at a greatest β there, so that it does not turn, and its friction takes no power.
  const auto ram = law_of(data, {pin("pin B", 0.05, f)});
  EXPECT_NEAR(ram->torque(state).torque, 0, 1e-9);
  // The crank's pin turns against the rod: its couple q on the rod, whose ram pushes with F, leaves R_x = F and
  // R_y = F tan β + q/(l cos β) at both ends.
  const auto crank_pin = law_of(data, {pin("pin A", 0.05, f)})->solve(state);
  const double q = crank_pin.loads.at(0), across = force * std::sqrt(1 / (cos_beta * cos_beta) - 1);
  EXPECT_GT(q, 0);  // the rod turns back against the crank
  EXPECT_NEAR(std::abs(crank_pin.reactions.at(0)), force, 1e-9);
  EXPECT_NEAR(std::abs(std::abs(crank_pin.reactions.at(1)) - across), q / (l * cos_beta), 1e-9);
  EXPECT_NEAR(q, rho * std::hypot(crank_pin.reactions.at(0), crank_pin.reactions.at(1)), 1e-9);
  EXPECT_NEAR(crank_pin.torque, -q, 1e-9);
}

// A crank's pin A in a slotted lever about C, nothing has mass: N acts where it balances the friction on the face that it
// presses on, ½ f w from A. Of a block within the slot that is towards the motion of the block, of a lever's bar within the
// block away from it, whichever of the two comes first.
TEST(LinkageFriction, FacesLieWhereTheSlidingLinkIsBetweenThem) {
  constexpr double r = 0.1, ground = 0.25, f = 0.2, w = 0.06;
  for (const double phi : {0.4, 1.3, 2.5, 3.6, 4.4, 5.8}) {
    SCOPED_TRACE(phi);
    const double x = r * std::cos(phi) - ground, y = r * std::sin(phi), reach = std::hypot(x, y);
    const double outwards = ground * std::sin(phi) > 0 ? 1 : -1;  // sign of d reach/dφ = r d sin φ/reach
    for (const bool block_slides : {true, false}) {
      test::SketchOf of;
      of.point('O', 0, 0).point('A', r * std::cos(phi), y).point('C', ground, 0);
      of.point('D', ground + 2 * x, 2 * y).frame("OC");
      of.link("crank", "OA").link("block", "A").link("lever", "CD").rocks("lever");
      if (block_slides)
        of.slide("block", std::atan2(y, x), "lever");
      else
        of.slide("lever", std::atan2(y, x), "block");
      const auto law = law_of(
          of.data(),
          {{.name = block_slides ? "slide block" : "slide lever", .friction = {f, f, 0, 0}, .length = 10, .width = w}});
      const auto solved = law->solve({.phi = phi, .omega = 2, .load = 50});
      const double from_point = solved.reactions.at(1) / solved.reactions.at(0);
      const double from_pin = block_slides ? from_point : from_point - reach;
      EXPECT_NEAR(from_pin, (block_slides ? 1 : -1) * outwards * f * w / 2, 1e-12);
    }
  }
}

// A rod that pushes the ram out under β on a guide of friction f: F = P (1 − f tan β); it locks at f tan β = 1.
TEST(LinkageFriction, SlideJamsWhereTheFrictionAngleMeetsTheRod) {
  test::SketchOf of = crank_and_ram();
  of.s.points[2].x = 0.21;  // rod of 110 mm
  const MechanismData data = of.data();
  const double phi = -80 * pi / 180, beta = std::asin(0.1 / 0.11 * std::sin(-phi));
  const JointFriction::State state{.phi = phi, .omega = 1e-3, .load = -100};
  const auto guide = [&](double part) {
    const double f = part / std::tan(beta);
    return law_of(data, {{.name = "slide ram", .friction = {f, f, 0, 0}}});
  };
  const auto solved = guide(0.999)->solve(state);
  EXPECT_NEAR(solved.loads.at(0), -(100 / 0.001 - 100), 1e-4 * 1e5);  // P cos β = F/(1 − f tan β), less F
  EXPECT_THROW(guide(1.001)->torque(state), Jam);
  EXPECT_EQ(guide(1.001)->resting(phi, -100, 1, true), HUGE_VAL);  // locks itself
  EXPECT_LT(guide(1.001)->resting(phi, -100, -1, true), 0);        // not backwards
}

// Rollers of radius r_r with the rolling arm k_r are a friction coefficient k_r/r_r more.
TEST(LinkageFriction, RollersAddTheirArmOverTheirRadius) {
  const MechanismData data = crank_and_ram().data();
  const auto guide = [&](double f, double arm) {
    RubbingJoint joint{.name = "slide ram", .friction = {f, f, 0, 0}};
    joint.rolling_arm = arm, joint.roller_radius = 0.02;
    return law_of(data, {joint});
  };
  const auto rolls = guide(0.03, 1e-3), alone = guide(0, 1e-3), slides = guide(0.08, 0);
  for (const double phi : {0.5, 1.7, 4.0}) {
    const JointFriction::State state{.phi = phi, .omega = 2, .load = -300};
    const double torque = slides->torque(state).torque;
    EXPECT_LT(torque, -0.01);
    EXPECT_NEAR(rolls->torque(state).torque, torque, 1e-9) << phi;
    EXPECT_NEAR(alone->torque(state).torque, guide(0.05, 0)->torque(state).torque, 1e-9) << phi;
  }
}

// --- a four-bar by hand ---

struct Vector {
  double x, y;
};
double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }

using Row = std::array<double, 10>;

std::array<double, 9> eliminate(std::array<Row, 9> a) {
  for (std::size_t k = 0; k < 9; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < 9; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    for (std::size_t i = 0; i < 9; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 10; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  std::array<double, 9> x{};
  for (std::size_t k = 0; k < 9; ++k) x[k] = a[k][9] / a[k][k];
  return x;
}

// Positions, velocities and accelerations by the loop, 9 equations of equilibrium, friction couples by fixed point.
struct FourBarByHand {
  FourBarData d;
  std::array<double, 4> circle;  // ρ of O, A, B, D

  double torque(double phi, double omega, double alpha, double load, bool rubs) const {
    const Vector o{0, 0}, a{d.crank * std::cos(phi), d.crank * std::sin(phi)}, p{d.ground, 0};
    const double reach = std::hypot(p.x - a.x, p.y - a.y), along = std::atan2(p.y - a.y, p.x - a.x);
    const double open =
        std::acos((d.coupler * d.coupler + reach * reach - d.rocker * d.rocker) / (2 * d.coupler * reach));
    const double theta = along + open;  // the coupler pin left of the line from crank pin to rocker bearing
    const Vector b{a.x + d.coupler * std::cos(theta), a.y + d.coupler * std::sin(theta)};
    const double psi = std::atan2(b.y - p.y, b.x - p.x);
    // l i e^{iθ} θ̇ − c i e^{iψ} ψ̇ = −a i e^{iφ} ω, and once more.
    const Vector u{-d.coupler * std::sin(theta), d.coupler * std::cos(theta)};
    const Vector v{d.rocker * std::sin(psi), -d.rocker * std::cos(psi)};
    const auto solve = [&](Vector right) {
      return Vector{cross(right, v) / cross(u, v), cross(u, right) / cross(u, v)};
    };
    const Vector rate = solve({a.y * omega, -a.x * omega});
    const double w = rate.x, s = rate.y;
    const Vector acceleration = solve(
        {a.y * alpha + a.x * omega * omega + d.coupler * std::cos(theta) * w * w - d.rocker * std::cos(psi) * s * s,
         -a.x * alpha + a.y * omega * omega + d.coupler * std::sin(theta) * w * w - d.rocker * std::sin(psi) * s * s});
    struct Link {
      double mass, inertia, com, angle, rate, acceleration;
      Vector from, from_acceleration;
    };
    const auto central = [](const LinkBody& l) { return l.inertia - l.mass * l.com * l.com; };
    const Link links[3] = {
        {d.crank_body.mass, central(d.crank_body), d.crank_body.com, phi, omega, alpha, o, {0, 0}},
        {d.coupler_body.mass,
         d.coupler_body.inertia,
         d.coupler_body.com,
         theta,
         w,
         acceleration.x,
         a,
         {-a.x * omega * omega - a.y * alpha, -a.y * omega * omega + a.x * alpha}},
        {d.rocker_body.mass, central(d.rocker_body), d.rocker_body.com, psi, s, acceleration.y, p, {0, 0}}};
    // Unknowns: frame on crank at O, crank on coupler at A, coupler on rocker at B, frame on rocker at D, torque.
    const Vector place[4] = {o, a, b, p};
    const int on[4] = {0, 1, 2, 2}, from[4] = {-1, 0, 1, -1};
    const double relative[4] = {omega, w - omega, s - w, s};
    std::array<double, 4> couple{};
    std::array<double, 9> x{};
    for (int round = 0; round < 200; ++round) {
      std::array<Row, 9> m{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Link& l = links[i];
        const double c = std::cos(l.angle), n = std::sin(l.angle);
        const Vector com{l.from.x + l.com * c, l.from.y + l.com * n};
        const double r2 = l.rate * l.rate;
        m[3 * i][9] = l.mass * (l.from_acceleration.x - l.com * (c * r2 + n * l.acceleration));
        m[3 * i + 1][9] = l.mass * (l.from_acceleration.y + l.com * (c * l.acceleration - n * r2) + d.gravity);
        m[3 * i + 2][9] = l.inertia * l.acceleration - (i == 2 ? load : 0);
        for (std::size_t j = 0; j < 4; ++j)
          for (const auto& [body, sense] : {std::pair(on[j], 1.0), std::pair(from[j], -1.0)}) {
            if (body != static_cast<int>(i)) continue;
            const Vector arm = place[j] - com;
            m[3 * i][2 * j] += sense, m[3 * i + 1][2 * j + 1] += sense;
            m[3 * i + 2][2 * j] -= sense * arm.y, m[3 * i + 2][2 * j + 1] += sense * arm.x;
            m[3 * i + 2][9] -= sense * couple[j];
          }
      }
      m[2][8] = 1;
      x = eliminate(m);
      for (std::size_t j = 0; rubs && j < 4; ++j)
        couple[j] = -(relative[j] > 0 ? 1 : -1) * circle[j] * std::hypot(x[2 * j], x[2 * j + 1]);
    }
    return x[8];
  }
};

TEST(LinkageFriction, FourBarIsThatOfItsEquilibriumByHand) {
  FourBarData d;
  d.crank = 0.08, d.coupler = 0.25, d.rocker = 0.17, d.ground = 0.28, d.gravity = 9.81;
  d.crank_body = {2, 0.03, 0.02}, d.coupler_body = {1.5, 0.1, 0.012}, d.rocker_body = {2.5, 0.06, 0.05};
  const char* const names[4] = {"main bearing", "crank pin", "coupler pin", "rocker bearing"};
  const double radius[4] = {0.03, 0.025, 0.02, 0.028}, f[4] = {0.08, 0.1, 0.15, 0.12};
  FourBarByHand hand{d, {}};
  std::vector<RubbingJoint> joints;
  for (std::size_t j = 0; j < 4; ++j) {
    joints.push_back(pin(names[j], radius[j], f[j]));
    hand.circle[j] = radius[j] * f[j] / std::sqrt(1 + f[j] * f[j]);
  }
  const auto law = law_of(d, joints);
  std::mt19937 random(3);
  const auto draw = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  for (int k = 0; k < 60; ++k) {
    const double phi = draw(0, 6.28), omega = (k % 2 ? 1 : -1) * draw(1, 30), alpha = draw(-80, 80);
    const double load = draw(-200, 200);
    const double without = hand.torque(phi, omega, alpha, load, false);
    const double friction = without - hand.torque(phi, omega, alpha, load, true);
    const auto found = law->torque({.phi = phi, .omega = omega, .alpha = alpha, .load = load});
    EXPECT_NEAR(found.torque, friction, 1e-10 * (std::abs(without) + std::abs(load))) << phi;
    EXPECT_LT(found.torque * omega, 0);
  }
}

// Friction takes power in every joint, whatever linkage: M ω is the sum of what each loses.
TEST(LinkageFriction, LosesPowerInEveryJointOfAnyLinkage) {
  const MechanismData data = test::stephenson().data();
  std::vector<RubbingJoint> joints;
  for (const char* name : {"pin O", "pin A", "pin B", "pin C", "pin D", "pin E", "pin G"})
    joints.push_back(pin(name, 0.015, 0.1));
  const auto law = law_of(data, joints);
  ASSERT_EQ(law->joints().size(), 7U);
  for (int k = 0; k < 90; ++k) {
    const JointFriction::State s{
        .phi = 0.07 * k, .omega = k % 2 ? 12.0 : -12.0, .alpha = 5.0 * (k % 7 - 3), .load = 40};
    const auto solved = law->solve(s);
    EXPECT_LT(solved.residual, 1e-12);
    EXPECT_LT(solved.torque * s.omega, 0);
    for (std::size_t j = 0; j < 7; ++j) {
      const double size = std::hypot(solved.reactions[2 * j], solved.reactions[2 * j + 1]);
      EXPECT_NEAR(std::abs(solved.loads[j]), 0.015 * 0.1 / std::sqrt(1.01) * size, 1e-11 * size);
    }
  }
}

// --- scenes ---

const char* const wheel = "line = [\"wheel\", \"crank\"]\n[wheel]\nkind = \"flywheel\"\ninertia = \"0.4 kg*m2\"\n";

std::string slider_crank(const std::string& joints, const std::string& run) {
  return std::string(wheel) +
         "[crank]\nkind = \"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\ncrank_inertia = \"0.15 kg*m2\"\n"
         "rod_mass = \"2 kg\"\nrod_com = \"175 mm\"\nrod_inertia = \"0.02 kg*m2\"\nslider_mass = \"3 kg\"\n"
         "gravity = \"9.81 m/s2\"\n" +
         joints + run;
}
std::string same_by_sketch(const std::string& joints, const std::string& run) {
  return std::string(wheel) +
         "[crank]\nkind = \"linkage\"\nunit = \"mm\"\npoints = { O = [0, 0], A = [100, 0], B = [450, 0] }\n"
         "frame = \"O\"\nslides = { ram = \"0 deg\" }\ngravity = \"9.81 m/s2\"\n"
         "links = { crank = { points = \"O A\", inertia = \"0.15 kg*m2\" }, rod = { points = \"A B\", mass = \"2 kg\", "
         "inertia = \"0.02 kg*m2\" }, ram = { points = \"B\", mass = \"3 kg\" } }\n" +
         joints + run;
}
const char* const run_down =
    "[effects]\njoint_friction = true\n[run]\nstart = { speed = \"30 rad/s\" }\nuntil = \"1 s\"\naccuracy = 1e-7\n";

TEST(LinkageFriction, SketchOfASliderCrankRunsAsTheNamedKind) {
  const Result named = test::run(
      slider_crank(
          "main_bearing = { radius = \"40 mm\", friction = 0.05 }\ncrank_pin = { radius = \"30 mm\", friction = "
          "0.05 }\nslider_pin = { radius = \"15 mm\", friction = 0.08 }\nguide = { friction = 0.1, length = "
          "\"60 mm\", width = \"80 mm\" }\n",
          run_down),
      false);
  const Result sketch =
      test::run(same_by_sketch(
                    "joints = { O = { radius = \"40 mm\", friction = 0.05 }, A = { radius = \"30 mm\", friction = 0.05 "
                    "}, B = { radius = \"15 mm\", friction = 0.08 }, ram = { friction = 0.1, length = \"60 mm\", width "
                    "= \"80 mm\" } }\n",
                    run_down),
                false);
  const double speed = test::figure(named, "final_speed.wheel");
  EXPECT_LT(speed, 28);
  EXPECT_NEAR(test::figure(sketch, "final_speed.wheel"), speed, 1e-6 * speed);
  const double lost = -named.energy.by_account.at("crank.joints");
  EXPECT_NEAR(-sketch.energy.by_account.at("crank.joints"), lost, 1e-6 * lost);
  EXPECT_NEAR(named.energy.kinetic_start - named.energy.kinetic_end + named.energy.by_line.at("weight"), lost,
              1e-5 * lost);
}

// What acts within presses on the joints as a load on the output does: on the ram's pin, but on the ram.
TEST(LinkageFriction, AForceOnThePinOfTheOutputIsALoadOnIt) {
  const std::string joints =
      "joints = { O = { radius = \"40 mm\", friction = 0.05 }, B = { radius = \"15 mm\", friction = 0.08 }, ram = { "
      "friction = 0.1, length = \"60 mm\", width = \"80 mm\" } }\n";
  const std::string law = "{ kind = \"medium\", viscous = \"90 N*s/m\" }";
  const auto within = [&](const std::string& on) {
    return test::run(same_by_sketch(joints, "[crank.forces]\npush = { on = \"" + on +
                                                "\", along = \"0 deg\", load = " + law + " }\n" + run_down),
                     false);
  };
  const Result load = test::run(same_by_sketch(joints + "load = " + law + "\n", run_down), false);
  const double speed = test::figure(load, "final_speed.wheel"), lost = load.energy.by_account.at("crank.joints");
  const Result ram = within("ram B"), rod = within("rod B");
  EXPECT_NEAR(test::figure(ram, "final_speed.wheel"), speed, 1e-6 * speed);
  EXPECT_NEAR(ram.energy.by_account.at("crank.joints"), lost, 1e-6 * -lost);
  EXPECT_NEAR(ram.energy.by_account.at("crank.push"), load.energy.by_account.at("crank.load"), 1e-6 * speed * speed);
  // On the rod it does not go through the ram's pin.
  EXPECT_LT(lost, 1.001 * rod.energy.by_account.at("crank.joints"));
}

// A massless yoke x = r cos φ, whose spring F(φ) presses on crank, block and yoke; friction f in the yoke's slot makes it
// F √(1 + f²) in the pins O and A, of friction circles ρ: M = −(ρ_O + ρ_A) F √(1 + f²) − f F r |cos φ|.
TEST(LinkageFriction, ASpringOnAYokePressesOnItsJoints) {
  const double f = 0.12, rho = (0.02 + 0.012) * 0.09 / std::sqrt(1 + 0.09 * 0.09), r = 0.06;
  const Scene scene = test::scene_from(R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [60, 0], Y = [300, 0], F = [500, 0] }
frame  = "O F"
slides = { block = { on = "yoke", along = "90 deg" }, yoke = "0 deg" }
joints = { O = { radius = "20 mm", friction = 0.09 }, A = { radius = "12 mm", friction = 0.09 }, block = { friction = 0.12 } }
[m.links]
crank  = { points = "O A", mass = "1 kg", com = [0, 0], inertia = "0.5 kg*m2" }
block  = "A"
yoke   = "Y"
[m.springs]
return = { between = "Y F", stiffness = "900 N/m", free_length = "180 mm" }
[effects]
joint_friction = true
[run]
start    = { speed = "120 rpm" }
until    = "0.8 s"
accuracy = 1e-9
)");
  const auto force = [&](double phi) { return 900 * (0.02 + r * (1 - std::cos(phi))); };  // always pulled
  const auto friction = [&](double phi) {
    return -force(phi) * (rho * std::sqrt(1 + f * f) + f * r * std::abs(std::cos(phi)));
  };
  const auto model = compile(scene, scene.effects);
  const Mechanism* m = find_mechanism(model->network, "m");
  ASSERT_TRUE(m && m->friction);
  ASSERT_EQ(m->friction->applied(), std::vector<std::string>{"m.return"});
  for (int i = 0; i < 12; ++i) {
    const double phi = 0.2 + 0.5 * i, applied = -force(phi);
    const auto found = m->friction->torque({.phi = phi, .omega = 6, .applied = &applied});
    EXPECT_NEAR(found.torque, friction(phi), 1e-11) << phi;
  }
  Equations equations(model, false);
  for (const double phi : {0.4, 1.1, 2.3, 4.0, 5.5})
    test::expect_exact(test::slopes_of(equations, 0, equations.modes_from_scratch(0, phi, 9)), equations, 1e-6);
  const Result run = test::run(scene);
  EXPECT_TRUE(run.complete) << run.diagnosis;
  EXPECT_LT(run.energy.relative, 1e-7);
  const double end = test::figure(run, "final_angle.m"), speed = test::figure(run, "final_speed.m");
  ASSERT_GT(speed, 1);
  double lost = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) lost += friction(end * (i + 0.5) / steps) * end / steps;
  EXPECT_NEAR(run.energy.by_account.at("m.joints"), lost, 1e-6 * -lost);
  EXPECT_NEAR(0.25 * speed * speed, 0.25 * 16 * pi * pi + lost + 450 * (0.0004 - std::pow(force(end) / 900, 2)),
              1e-6 * -lost);
}

TEST(LinkageFriction, OffLeavesNoTrace) {
  const std::string run = "[run]\nstart = { speed = \"30 rad/s\" }\nuntil = \"0.5 s\"\n";
  const Result off =
      test::run(same_by_sketch("joints = { O = { radius = \"40 mm\", friction = 0.05 } }\n", run), false);
  const Result without = test::run(same_by_sketch("", run), false);
  EXPECT_EQ(test::figure(off, "final_speed.wheel"), test::figure(without, "final_speed.wheel"));
  EXPECT_EQ(off.statistics.stepper.flow_calls, without.statistics.stepper.flow_calls);
}

TEST(LinkageFriction, SaysWhichJointsThereAreAndWhatBelongsToThem) {
  const auto refused = [](const std::string& joints) {
    try {
      const Scene scene = test::scene_from(same_by_sketch(joints, run_down));
      compile(scene, scene.effects);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refused("joints = { X = { radius = \"40 mm\", friction = 0.05 } }\n").find("joints are"),
            std::string::npos);
  EXPECT_NE(refused("joints = { O = { friction = 0.05 } }\n").find("no radius"), std::string::npos);
  EXPECT_NE(refused("joints = { O = { radius = \"4 mm\", friction = 0.05, length = \"1 m\" } }\n").find("slide"),
            std::string::npos);
  EXPECT_NE(refused("joints = { ram = { radius = \"4 mm\", friction = 0.05 } }\n").find("pin"), std::string::npos);
  EXPECT_NE(refused("joints = { ram = { friction = 0.1, static_friction = 0.05 } }\n").find("static_friction"),
            std::string::npos);
  EXPECT_EQ(refused("joints = { ram = { friction = 0.1 } }\n"), "");
}

}  // namespace
}  // namespace kurbel::linkage_friction_test
