// jams_test.cpp — machines that cannot go on: held at rest, thrown back, rocking, or jammed in motion; each ends in
// order, with its energy balanced and as many events as its oscillations make.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "engine/run/run.h"
#include "studies/run/run_findings.h"
#include "tests/published/published.h"
#include "tests/support/conclusions.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::jams_test {
namespace {

using test::find;
using test::said;

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}
std::string scene_text(const std::string& name) { return test::text_of(test::source_path("scenes/" + name)); }
bool has_note(const Result& r, const std::string& words) {
  return std::any_of(r.notes.begin(), r.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

// A press that cannot break its sheet is thrown back by its couplings, out of the working zone. Its main coupling
// vibrates at 14 Hz, its gearbox at 65 Hz; a cycle makes six events at most (rest, away, two edges there and back).
constexpr double events_a_second = 6 * 70, events_at_all = 50;

std::string orderly(const Result& r, double until) {
  if (!r.complete) return r.diagnosis;
  if (has_note(r, "chatters")) return "a law without events";
  if (!(r.energy.relative < 10 * r.accuracy)) return fmt::format("energy closes to {:.1e} only", r.energy.relative);
  if (static_cast<double>(r.events.size()) > events_a_second * until + events_at_all)
    return fmt::format("{} events", r.events.size());
  return {};
}

std::string blocked_press(double force, const std::string& motor, const std::string& elasticity, bool friction,
                          double angle, double until) {
  std::string text = scene_text("crank_press.toml");
  text = with(text, "nominal_force = \"630 kN\"", fmt::format("nominal_force = \"{:.17g} kN\"", force));
  text = with(text, "elasticity = [\"motor_coupling\", \"main_coupling\"]",
              fmt::format("elasticity = [{}]\njoint_friction = {}", elasticity, friction));
  text = with(text, "angle = \"90 deg\"", fmt::format("angle = \"{:.17g} deg\"", angle));
  text = with(text, "until    = \"10 s\"", fmt::format("until = \"{:.17g} s\"", until));
  text = with(text, "accuracy = 1e-6", "accuracy = 1e-5");
  if (motor.starts_with("kind")) {
    const std::size_t from = text.find("[motor] ");
    return text.replace(from, text.find("[motor_coupling]") - from,
                        "[motor]\n" + motor + "\ninertia = \"0.092 kg*m2\"\n\n");
  }
  return with(text, "breakdown_ratio   = 3.0", "breakdown_ratio   = 3.0\n" + motor + "\n#");
}

const std::vector<std::string>& motors() {
  static const std::vector<std::string> all = {
      "",  // Kloss
      "starting_ratio = 2.2\npull_up_ratio = 1.8\npull_up_speed = \"300 rpm\"",
      "frequency = \"50 Hz\"\nresistance_ratio = 1",
      "kind = \"dc shunt motor\"\nstall_torque = \"294 N*m\"\nno_load_speed = \"1500 rpm\"",
      "kind = \"dc series motor\"\nvoltage = \"400 V\"\nresistance = \"1 Ohm\"\nconstant = \"0.002 "
      "N*m/A2\"\nrated_speed "
      "= \"1500 rpm\"",
      "kind = \"pneumatic motor\"\nmax_power = \"15 kW\"\nfree_speed = \"1500 rpm\"",
  };
  return all;
}

TEST(Jams, APressThrownBackOutOfItsWorkingZoneRocksWithoutAStormOfEvents) {
  for (const bool friction : {false, true}) {
    const Result r =
        test::run(blocked_press(4000, "", "\"motor_coupling\", \"main_coupling\"", friction, 90, 2.5), false);
    EXPECT_EQ(orderly(r, 2.5), "") << friction;
  }
}

TEST(Jams, RandomStallsEndInOrder) {
  std::mt19937 random(20);
  const auto part = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const std::vector<std::string> elastic = {"", "\"main_coupling\"", "\"motor_coupling\", \"main_coupling\""};
  for (std::size_t k = 0; k < 24; ++k) {
    const double force = 2500 * std::pow(6300.0 / 2500, part()), angle = 360 * part(), until = 3;
    const std::string& motor = motors()[k % motors().size()];
    const std::string& joints = elastic[(k / motors().size()) % elastic.size()];
    const bool friction = part() < 0.5;
    const Result r = test::run(blocked_press(force, motor, joints, friction, angle, until), false);
    EXPECT_EQ(orderly(r, until), "") << fmt::format("{:.17g} kN, {:.17g} deg, elastic [{}], friction {}\n{}", force,
                                                    angle, joints, friction, motor);
  }
}

// A trial step that goes far beyond the load's edge says nothing of the machine.
TEST(Jams, JointsDoNotJamWhereATrialStepIsTooLong) {
  const Result r = test::run(blocked_press(2500, motors()[1], "", true, 90, 3), false);
  EXPECT_EQ(orderly(r, 3), "");
}

TEST(Jams, APumpStartedBackwardsReverses) {
  std::string text = scene_text("piston_pump.toml");
  text = with(text, "speed = \"301 rpm\"", "speed = \"-301 rpm\"");
  text = with(text, "equilibrium = true", "equilibrium = false");
  text = with(text, "until    = \"4 s\"", "until = \"1.5 s\"");
  const Result r = test::run(text, false);
  EXPECT_EQ(orderly(r, 1.5), "");
  EXPECT_GT(test::figure(r, "final_speed.crankshaft"), 30);
}

// With clearance the blow stops the slider within the gap, until the crank has come after it. The sheet takes
// F (2.5 + 0.25 + 0.1) mm a blow. What cannot break it is thrown back.
TEST(Jams, ASliderWithClearanceRestsOnTheSheetUntilTheCrankComesAfterIt) {
  for (const double force : {200.0, 4000.0}) {
    std::string text =
        with(blocked_press(force, "", "\"main_coupling\"", false, 90, 2.5), "accuracy = 1e-5", "accuracy = 1e-4");
    text = with(text, "load = { kind = \"press\"",
                "clearance = { kind = \"crank pin\", gap = \"0.2 mm\", stiffness = \"500 kN/mm\", exponent = 1.5, "
                "restitution = 0.5, restitution_speed = \"0.2 m/s\", friction = 0.05, radius = \"140 mm\" }\n"
                "load = { kind = \"press\"");
    const Result r = test::run(text, false);
    EXPECT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LT(r.energy.relative, 1e-5);
    EXPECT_TRUE(has_note(r, "press: the contact chatters")) << force;
    if (force < 1000) {
      EXPECT_NEAR(test::figure(r, "work.useful"), -2 * 200e3 * 2.85e-3, 0.5);
    } else {
      EXPECT_LT(test::figure(r, "min_speed.press"), -0.1);
    }
  }
}

// A second load, which depends on the place alone, keeps its pieces while the slider creeps on the sheet: what it does
// is the difference of its potential, whatever came between. Travel counts from the lower dead centre, 470 mm out.
TEST(Jams, WhileASliderCreepsALoadOfThePlaceAloneKeepsItsPotential) {
  std::string text =
      with(blocked_press(200, "", "\"main_coupling\"", false, 90, 2.5), "accuracy = 1e-5", "accuracy = 1e-4");
  const std::size_t from = text.find("load = { kind = \"press\""), end = text.find('\n', from);
  const std::string press = text.substr(from + 7, text.find('}', from) - from - 6);
  text.replace(from, end - from,
               "clearance = { kind = \"crank pin\", gap = \"0.2 mm\", stiffness = \"500 kN/mm\", exponent = 1.5, "
               "restitution = 0.5, restitution_speed = \"0.2 m/s\", friction = 0.05, radius = \"140 mm\" }\n"
               "load = [ " +
                   press +
                   ", { kind = \"table\", force = { over = \"travel\", unit = [\"mm\", \"kN\"], "
                   "points = [[0, 2], [40, 3], [80, 9], [99, 11], [100, 30]] } } ]");
  const Result r = test::run(text, false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(has_note(r, "press: the contact chatters"));
  const auto potential = [](double mm) { return 3 * (mm - 40) + 0.075 * (mm - 40) * (mm - 40); };  // [J], 40 … 80 mm
  const std::vector<double> position = test::series(r, "position.press");
  const double first = 1e3 * (0.47 - position.front()), last = 1e3 * (0.47 - position.back());
  ASSERT_GT(std::min(first, last), 40);
  ASSERT_LT(std::max(first, last), 80);
  EXPECT_NEAR(test::figure(r, "work.useful"), -2 * 200e3 * 2.85e-3 + potential(last) - potential(first), 0.5);
}

// Backwards until 0.2 s: 40 − λ = 0.01 ε, 0.4 λ + 2.4 = 0.036 ε (on the input), λ = 35.4 N·m, ε = 460 rad/s². Then the
// load drives, and wants λ = 0.6 μ of help, which slows the input down faster than it slows the load: a jam.
TEST(Jams, AGearThatLocksItselfStopsAtOnceWhenItsMotorIsSwitchedOff) {
  const Result r = test::run(R"(
line = ["motor", "gear", "drum"]
motor = { kind = "torque source", torque = "-40 N*m", stop = "0.2 s", inertia = "0.01 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 100] }], efficiency_forwards = 0.4, efficiency_backwards = -0.6 }
drum = { kind = "load", torque = "12 N*m", acts = "always", inertia = "0.9 kg*m2" }
run = { start = "rest", until = "1 s", accuracy = 1e-6 }
)",
                             true);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(r.accuracy_confirmed);
  EXPECT_NEAR(test::figure(r, "peak_torque.gear.in"), -35.4, 1e-9);
  EXPECT_NEAR(test::figure(r, "final_angle.motor"), -460 * 0.2 * 0.2 / 2, 1e-9);
  EXPECT_EQ(test::figure(r, "final_speed.drum"), 0.0);
  EXPECT_TRUE(has_note(r, "is held at the end by gear"));
  EXPECT_LT(r.energy.relative, 1e-12);
}

// Whichever side drives, however strongly the gear locks itself, whatever is heavy: it ends in order, and again the
// same.
TEST(Jams, RandomSelfLockingGearsEndInOrder) {
  std::mt19937 random(7);
  const auto within = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int jams = 0;
  for (int k = 0; k < 60; ++k) {
    const bool always = within(0, 1) < 0.5;
    const double load = always ? within(-40, 40) : within(1, 40);
    const double speeds[] = {0, 10, -10, 100}, teeth[] = {7, 20, 40, 100};
    const std::string text = fmt::format(
        R"(
line = ["first", "gear", "second"]
first = {{ kind = "torque source", torque = "{:.6g} N*m", stop = "{:.6g} s", inertia = "{:.6g} kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [20, {}], inertia = ["0.001 kg*m2", "0.002 kg*m2"] }}], efficiency_forwards = {:.6g}, efficiency_backwards = {:.6g}, bearing_torque = "{} N*m" }}
second = {{ kind = "load", torque = "{:.6g} N*m", acts = "{}", inertia = "{:.6g} kg*m2" }}
run = {{ start = {{ speed = "{} rad/s" }}, until = "1 s", accuracy = 1e-6 }}
)",
        within(-40, 40), within(0.05, 0.5), std::pow(10, within(-3, 0)), teeth[k % 4], within(0.2, 0.9),
        -std::pow(10, within(-2, 0.3)), k % 3 == 0 ? 0.2 : 0, load, always ? "always" : "against motion",
        std::pow(10, within(-3, 1)), speeds[(k / 4) % 4]);
    const Scene scene = test::scene_from(text);
    Equations equations(compile(scene, scene.effects), true);
    RunOptions options;
    options.tolerance = 1e-8;
    options.until = scene.run.until;
    const auto end = [&] { return integrate(equations, options, {}); };
    const RunOutcome first = end(), again = end();
    EXPECT_TRUE(first.complete) << first.diagnosis << text;
    EXPECT_LT(first.events.size(), 40u) << text;
    EXPECT_EQ(first.state, again.state) << text;
    for (const Event& e : first.events) jams += e.what.starts_with("jams");
  }
  EXPECT_GT(jams, 5);
}

// From |η₂| I₂′ > I₁ on, a worm that turns back with its load has no motion on that flank: it lets go on the other, and
// where that ends it jams.
TEST(Jams, AWormWhoseMotorStopsComesToRestAndHoldsItsLoad) {
  for (const double friction : {0.14, 0.15, 0.16, 0.18, 0.2}) {
    std::string text = scene_text("worm_hoist.toml");
    text = with(text, "friction_coefficient = 0.09", fmt::format("friction_coefficient = {}", friction));
    const Result r = test::run(text, false);
    EXPECT_EQ(orderly(r, 4), "") << friction;
    EXPECT_EQ(test::figure(r, "final_speed.drum"), 0) << friction;
  }
}

// What stands at the end says who holds it, what acts, and what is missing.
TEST(Jams, ARestSaysWhatHoldsItAndWhatIsMissing) {
  const Result r = test::run(
      "line = [\"source\", \"wheel\"]\nsource = { kind = \"torque source\", torque = \"9 N*m\" }\nwheel = { kind = "
      "\"flywheel\", inertia = \"2 kg*m2\" }\nbearing = { kind = \"bearing\", on = \"wheel\", torque = \"12 N*m\", "
      "static_torque = \"15 N*m\" }\nrun = { until = \"1 s\" }\n",
      false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(has_note(r,
                       "held at the end by bearing: the acting torque is 9 N·m; forwards: up to 15 N·m are held, 6 N·m "
                       "more would move it; "
                       "backwards: up to -15 N·m are held, 24 N·m more would move it"))
      << (r.notes.empty() ? "no notes" : r.notes.front());
}

// A rough guide (f = 0.8) and a steep rod (l/r = 1.1): once f |tan β| passes 1 no reactions exist, from
// |sin φ| r/l = sin atan(1/f) on, φ = 239.2° (inertia forces shift it by little). The crank stops there at once, its
// energy lost in the joints; the load then pushes it back, the other way.
TEST(Jams, JointsThatJamInMotionStopTheCrankAtOnce) {
  for (const char* method : {"auto", "dopri5", "dop853", "esdirk", "bdf", "adams"}) {
    Scene scene = test::scene_from(R"(
line = ["wheel", "crank"]
wheel = { kind = "flywheel", inertia = "0.4 kg*m2" }
crank = { kind = "slider-crank", radius = "100 mm", rod = "110 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 kg", guide = { friction = 0.8 }, load = { kind = "constant", force = "-100 N" } }
effects = { joint_friction = true }
run = { start = { angle = "185 deg", speed = "20 rad/s" }, until = "0.3 s", accuracy = 1e-4 }
)");
    scene.run.method = method;
    const Result r = test::run(scene, false);
    EXPECT_EQ(orderly(r, 1), "") << method;
    const double limit = M_PI + std::asin(std::sin(std::atan(1 / 0.8)) * 1.1);
    const auto jam =
        std::find_if(r.events.begin(), r.events.end(), [](const Event& e) { return e.what.starts_with("jams: "); });
    ASSERT_NE(jam, r.events.end()) << method;
    EXPECT_NEAR(jam->angle, limit, 0.03) << method;
    EXPECT_LE(test::figure(r, "final_angle.crank"), jam->angle) << method;
    EXPECT_LT(r.energy.by_account.at("crank.joints"), -80) << method;
    const Claim* claim = find(r.claims, Predicate::jams, "crank");
    ASSERT_TRUE(claim) << method;
    EXPECT_EQ(claim->evidence.value, jam->angle) << method;
  }
}

// As a named mechanism and as a linkage, of a ram on a rough guide: f |tan β| passes 1 where |sin φ| r/l = sin atan(1/f).
std::string rough_guide(bool sketched, double rod, double friction, const std::string& drive,
                        const std::string& start) {
  const std::string mechanism =
      sketched ? fmt::format(
                     "kind = \"linkage\"\npoints = {{ O = [0, 0], A = [0, 0.1], B = [{:.17g}, 0] }}\nunit = "
                     "\"m\"\nframe = \"O\"\nslides = {{ ram = \"0 deg\" }}\nlinks = {{ crank = {{ points = "
                     "\"O A\", inertia = \"0.1 kg*m2\" }}, rod = \"A B\", ram = {{ points = \"B\", mass = \"1 "
                     "kg\" }} }}\njoints = {{ ram = {{ friction = {} }} }}",
                     std::sqrt(rod * rod - 0.01), friction)
               : fmt::format(
                     "kind = \"slider-crank\"\nradius = \"0.1 m\"\nrod = \"{:.17g} m\"\ncrank_inertia = \"0.1 "
                     "kg*m2\"\nslider_mass = \"1 kg\"\nguide = {{ friction = {} }}",
                     rod, friction);
  return fmt::format(
      "line = [\"drive\", \"m\"]\n[drive]\n{}\n[m]\n{}\nload = {{ kind = \"constant\", force = \"-500 N\" "
      "}}\n[effects]\njoint_friction = true\n[run]\nstart = {{ {}angle = \"185 deg\", on = \"m\" }}\nuntil "
      "= \"2 s\"\naccuracy = 1e-4\n",
      drive, mechanism, start);
}
struct Rough {
  double rod, friction;
  double limit() const { return 180 + std::asin(std::sin(std::atan(1 / friction)) * rod / 0.1) * 180 / M_PI; }
};
const Rough rough_guides[] = {{0.11, 0.8}, {0.15, 1.5}, {0.15, 2.5}, {0.3, 4}};

// Nothing can stop a prescribed motion: the run ends there, in words, with what was computed.
TEST(Jams, JointsThatJamUnderAPrescribedSpeedEndTheRunInWords) {
  for (const bool sketched : {false, true})
    for (const Rough& rough : rough_guides)
      for (const char* method : {"auto", "dopri5", "dop853", "esdirk", "bdf", "adams"}) {
        Scene scene = test::scene_from(
            rough_guide(sketched, rough.rod, rough.friction, "kind = \"prescribed speed\"\nspeed = \"60 rpm\"", ""));
        scene.run.method = method;
        const Result r = test::run(scene, false);
        SCOPED_TRACE(fmt::format("{} {} {}: {}", sketched, rough.rod, method, r.diagnosis));
        EXPECT_FALSE(r.complete);
        const std::string words = "\"m\": its joints jam at phi = ";
        const std::size_t at = r.diagnosis.find(words);
        ASSERT_NE(at, std::string::npos);
        EXPECT_NEAR(std::stod(r.diagnosis.substr(at + words.size())), rough.limit(), 0.1);
        EXPECT_EQ(r.diagnosis.find("nan"), std::string::npos);
        EXPECT_EQ(r.diagnosis.find("try method"), std::string::npos);
        EXPECT_NEAR(test::figure(r, "final_angle.m") * 180 / M_PI, rough.limit(), 0.1);
      }
}

// A torque source and a flywheel are stopped in an instant, which is no stall.
TEST(Jams, OfJointsUnderAMotorAreClaimedAsSuch) {
  for (const bool sketched : {false, true})
    for (const Rough& rough : rough_guides) {
      const Result r = test::run(rough_guide(sketched, rough.rod, rough.friction,
                                             "kind = \"torque source\"\ntorque = \"60 N*m\"\ninertia = \"20 kg*m2\"",
                                             "speed = \"300 rpm\", "));
      SCOPED_TRACE(fmt::format("{} {}: {}", sketched, rough.rod, said(r)));
      const Claim* claim = find(r.claims, Predicate::jams, "m");
      ASSERT_TRUE(claim);
      EXPECT_NEAR(*claim->evidence.value * 180 / M_PI, rough.limit(), 3);  // the ram's inertia shifts it
      EXPECT_FALSE(find(r.claims, Predicate::stalls));
      EXPECT_NE(claim->text.find("Painlevé"), std::string::npos);
    }
}

}  // namespace
}  // namespace kurbel::jams_test
