// shaft_stress_test.cpp — a shaft's stresses under vibration, and the allowable ones: by hand, against the closed form
// of two masses, and as one cylinder does not fire.
#include "studies/shafts/shaft_stress.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>

#include "studies/findings/output.h"
#include "studies/limits/ratings.h"
#include "studies/modes/modes.h"
#include "studies/shafts/stress_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::shaft_stress_test {
namespace {

constexpr double pi = std::numbers::pi, megapascal = 1e6;
using Rating = ShaftRating;

Rating rating_of(Rating::Role role, double strength, Rating::Detail detail = Rating::Detail::flange,
                 Rating::Steel steel = Rating::Steel::carbon) {
  Rating r;
  r.role = role, r.detail = detail, r.steel = steel;
  r.tensile = strength * megapascal, r.rated_speed = 10;
  return r;
}

// UR M68.5 by hand: (σ_B + 160)/18 · c_K (0.35 + 0.93 d^−0.2)(3 − 2 λ²), and 1.7/√c_K of it.
TEST(UrM68, PermissibleStressesOfFourShaftsByHand) {
  const auto expect = [](const Rating& r, double millimetres, double lambda, double continuous, double transient) {
    EXPECT_NEAR(r.continuous(1e-3 * millimetres, lambda) / megapascal, continuous, 1e-5 * continuous);
    EXPECT_NEAR(r.transient(1e-3 * millimetres, lambda) / megapascal, transient, 1e-5 * transient);
  };
  using Role = Rating::Role;
  expect(rating_of(Role::intermediate, 560), 400, 0.5, 63.05892, 107.20016);
  expect(rating_of(Role::propeller, 600), 480, 0.5, 36.02591, 82.58146);
  expect(rating_of(Role::intermediate, 800, Rating::Detail::flange, Rating::Steel::alloy), 390, 0.3, 95.05484,
         161.59323);
  expect(rating_of(Role::intermediate, 560, Rating::Detail::tapered_keyway), 400, 0.95, 20.88511, 45.83636);
}

// Table of M68.6: 1, 1, 0.6, 0.45, 0.5, 0.3; thrust 0.85, propeller 0.55, stern tube 0.8.
TEST(UrM68, DesignFactorsAreThoseOfTheTable) {
  using Detail = Rating::Detail;
  const std::pair<Detail, double> details[] = {{Detail::flange, 1},           {Detail::shrink_fit, 1},
                                               {Detail::tapered_keyway, 0.6}, {Detail::cylindrical_keyway, 0.45},
                                               {Detail::radial_hole, 0.5},    {Detail::slot, 0.3}};
  for (const auto& [detail, factor] : details)
    EXPECT_EQ(rating_of(Rating::Role::intermediate, 500, detail).design_factor(), factor);
  EXPECT_EQ(rating_of(Rating::Role::thrust, 500).design_factor(), 0.85);
  EXPECT_EQ(rating_of(Rating::Role::propeller, 500).design_factor(), 0.55);
  EXPECT_EQ(rating_of(Rating::Role::stern_tube, 500).design_factor(), 0.8);
  Rating stated = rating_of(Rating::Role::intermediate, 500);
  stated.stated_design = 0.37;
  EXPECT_EQ(stated.design_factor(), 0.37);
}

// Of more than 600 MPa no more counts, of alloy steel forward of the stern tube 800 MPa; the limit has no jump at λ = 0.9.
TEST(UrM68, StrengthCountsUpToItsLimitAndTheCurveIsContinuous) {
  using Role = Rating::Role;
  const auto counts = [](Role role, Rating::Steel steel) {
    return rating_of(role, 1000, Rating::Detail::flange, steel).counted_strength() / megapascal;
  };
  EXPECT_EQ(counts(Role::intermediate, Rating::Steel::carbon), 600);
  EXPECT_EQ(counts(Role::intermediate, Rating::Steel::alloy), 800);
  EXPECT_EQ(counts(Role::thrust, Rating::Steel::alloy), 800);
  EXPECT_EQ(counts(Role::propeller, Rating::Steel::alloy), 600);
  EXPECT_EQ(counts(Role::stern_tube, Rating::Steel::alloy), 600);
  const Rating r = rating_of(Role::intermediate, 560);
  EXPECT_NEAR(r.continuous(0.4, 0.9 - 1e-12), r.continuous(0.4, 0.9), 1e-3);
  EXPECT_EQ(r.continuous(0.4, 1.05), r.continuous(0.4, 0.9));
  EXPECT_EQ(r.continuous(0.4, 1.06), HUGE_VAL);
}

// --- two masses on a shaft, the load oscillates once a turn ---

constexpr double near_inertia = 0.5, far_inertia = 1.5, stiffness = 2400, damping = 0.6;  // ω₀ = 80 rad/s, ζ = 0.01
constexpr double outer = 0.020, inner = 0.008, mean = 40;
const double modulus = pi * (std::pow(outer, 4) - std::pow(inner, 4)) / (16 * outer);

std::string two_masses(double swing, const std::string& keys) {
  std::string points;
  for (int k = 0; k < 72; ++k)
    points += fmt::format("[{}, {:.17g}], ", 5 * k, mean + swing * std::cos(5 * k * pi / 180));
  return fmt::format(R"(
line = ["source", "shaft", "disc"]
source = {{ kind = "torque source", torque = "40 N*m", inertia = "0.5 kg*m2" }}
[shaft]
kind = "shaft"
stiffness = "2400 N*m/rad"
damping = "0.6 N*m*s/rad"
diameter = "20 mm"
bore = "8 mm"
{}
[disc]
kind = "load"
inertia = "1.5 kg*m2"
acts = "always"
table = {{ over = "angle", unit = ["deg", "N*m"], interpolation = "smooth", points = [{}] }}
[effects]
elasticity = true
[run]
start = {{ speed = "100 rad/s", equilibrium = true }}
until = "1 s"
accuracy = 1e-6
)",
                     keys, points);
}

ModesStudy modes_of(const std::string& text, const ModesOptions& options = {}) {
  const Scene scene = test::scene_from(text);
  return find_modes(scene, scene.effects, options);
}

// Amplitude of the shaft's stress: A J₁/(J₁ + J₂) |k*/(k* − ω² J_red)|/W_p.
double stress_at(double swing, double omega) {
  const std::complex<double> spring(stiffness, omega * damping);
  const double sum = near_inertia + far_inertia;
  return swing * near_inertia / sum * std::abs(spring / (spring - omega * omega * near_inertia * far_inertia / sum)) /
         modulus;
}

const Verdict& verdict_on(const std::vector<Verdict>& verdicts, const std::string& what) {
  for (const Verdict& v : verdicts)
    if (v.requirement.starts_with(what)) return v;
  throw std::runtime_error("no verdict on " + what);
}

// τ_C by hand, of a propeller shaft with σ_B = 600 MPa and d = 20 mm.
double continuous_at(double lambda) {
  return (600 + 160) / 18.0 * 0.55 * (0.35 + 0.93 * std::pow(20, -0.2)) *
         (lambda < 0.9 ? 3 - 2 * lambda * lambda : 1.38) * megapascal;
}

double root(double a, double b, const std::function<double(double)>& f) {
  const bool rises = f(b) > 0;
  for (int i = 0; i < 100; ++i) {
    const double m = 0.5 * (a + b);
    ((f(m) > 0) == rises ? b : a) = m;
  }
  return a;
}

const std::string propeller = "role = \"propeller shaft\"\ntensile_strength = \"600 MPa\"\nrated_speed = \"160 rad/s\"";
const ModesOptions wide{.fastest = 180};

TEST(ShaftStress, AmplitudeOverTheSpeedIsThatOfTwoMasses) {
  const ModesStudy m = modes_of(two_masses(8, propeller), wide);
  const LimitedJoint& shaft = m.limited.at(0);
  for (const SpeedResponse& s : m.sweep) {
    // Below that, orders 3, 5, 7 of what is left of the cosine between its points come to resonance.
    if (s.speed > 40) {
      EXPECT_NEAR(summed_stress(shaft, s.joints[0]), stress_at(8, s.speed), 2e-5 * stress_at(8, s.speed)) << s.speed;
    }
    EXPECT_NEAR(order_stress(shaft, s.orders[0][1]), stress_at(8, s.speed), 2e-5 * stress_at(8, s.speed)) << s.speed;
  }
  const auto peaks = stress_peaks(m.stresses.joints, m.stresses.normal);
  ASSERT_EQ(peaks.size(), 2u);  // the sum, and the only order
  EXPECT_EQ(peaks[1].order, 1);
  EXPECT_NEAR(peaks[0].stress, stress_at(8, 80), 1e-3 * stress_at(8, 80));
  EXPECT_NEAR(peaks[0].speed, 80, 0.2);
  EXPECT_NEAR(peaks[0].allowed, continuous_at(peaks[0].speed / 160), 1e-9 * peaks[0].allowed);
}

// A resonance that hardly exceeds τ_C is barred by the rule around it, 16 n_c/(18 − λ_c) to (18 − λ_c) n_c/16; one that
// exceeds it farther away as far as it does.
TEST(ShaftStress, BarredByTheRuleAroundTheResonanceOrAsFarAsItExceeds) {
  const ModesStudy slight = modes_of(two_masses(8, propeller), wide);
  ASSERT_EQ(slight.barred.size(), 1u);
  const double critical = slight.barred[0].worst, lambda = critical / 160;
  EXPECT_NEAR(critical, 80, 0.2);
  EXPECT_EQ(slight.barred[0].reason, "UR M68");
  EXPECT_NEAR(slight.barred[0].from, 16 * critical / (18 - lambda), 1e-9 * critical);
  EXPECT_NEAR(slight.barred[0].to, (18 - lambda) * critical / 16, 1e-9 * critical);
  const ModesStudy strong = modes_of(two_masses(90, propeller), wide);
  ASSERT_EQ(strong.barred.size(), 1u);
  const auto excess = [](double w) { return stress_at(90, w) - continuous_at(w / 160); };
  EXPECT_NEAR(strong.barred[0].from, root(40, 80, excess), 1e-3);
  EXPECT_NEAR(strong.barred[0].to, root(80, 140, excess), 1e-3);
  EXPECT_LT(strong.barred[0].from, 16 * critical / (18 - lambda));
  EXPECT_TRUE(modes_of(two_masses(5, propeller), wide).barred.empty());
}

// At 100 rad/s by the full equations; passing the resonance, and from λ = 0.8 on, by the linear response.
TEST(ShaftStress, VerdictsOfUrM68ByHand) {
  const ModesStudy m = modes_of(two_masses(8, propeller), wide);
  const Verdict& now = verdict_on(m.verdicts, "UR M68, continuous");
  EXPECT_NEAR(now.value, stress_at(8, 100), 1e-4 * now.value);
  EXPECT_NEAR(now.limit, continuous_at(100.0 / 160), 1e-6 * now.limit);
  EXPECT_EQ(now.state(), Compliance::holds);
  const Verdict& passing = verdict_on(m.verdicts, "UR M68, passing");
  EXPECT_NEAR(passing.value, stress_at(8, 80), 1e-3 * passing.value);
  EXPECT_NEAR(passing.limit, 1.7 * continuous_at(0.5) / std::sqrt(0.55), 2e-3 * passing.limit);
  EXPECT_EQ(passing.state(), Compliance::holds);
  EXPECT_EQ(stress_claims(m.stresses).front().predicate, Predicate::limit_held)
      << "what is barred and may be passed is no excess";
  const auto uses = stress_table(m.stresses).texts();
  EXPECT_TRUE(std::any_of(uses.begin(), uses.end(), [](const auto& row) { return row.back().ends_with("%, barred"); }));
  const Verdict& upper = verdict_on(m.verdicts, "UR M68, all of");
  EXPECT_LT(upper.value, stress_at(8, 0.8 * 160));
  EXPECT_GT(upper.value, 0.95 * stress_at(8, 0.8 * 160));
  EXPECT_EQ(upper.state(), Compliance::holds);
  const ModesStudy strong = modes_of(two_masses(20, propeller), wide);
  EXPECT_EQ(verdict_on(strong.verdicts, "UR M68, passing").state(), Compliance::exceeded);
  ShaftStresses two = strong.stresses;  // the same shaft twice: one exceeded limit does not hide another
  two.joints.push_back(two.joints.front());
  two.joints.back().name = "further_shaft", two.joints.back().limits.polar_modulus *= 1.05;
  for (SpeedResponse& r : two.normal.sweep) r.joints.push_back(r.joints.front()), r.orders.push_back(r.orders.front());
  ASSERT_EQ(stress_claims(two).size(), 2u);
  EXPECT_EQ(stress_claims(two)[0].of, "shaft");
  EXPECT_EQ(stress_claims(two)[1].of, "further_shaft");
  EXPECT_NEAR(stress_claims(two)[1].share(), stress_claims(two)[0].share() / 1.05, 1e-9);
  const Claim strongest = stress_claims(strong.stresses).front();
  EXPECT_NE(strongest.text.find("% of the limit for continuous running"), std::string::npos);
  EXPECT_EQ(strongest.predicate, Predicate::limit_exceeded);
  EXPECT_NEAR(strongest.share(), stress_at(20, 80) / continuous_at(0.5), 0.01);
}

// A resonance within 0.8 < λ ≤ 1.05 may not be barred: with 85 rad/s rated, λ_c = 0.94.
TEST(ShaftStress, ResonanceNearTheRatedSpeedIsNotAllowed) {
  const ModesStudy m = modes_of(
      two_masses(8, "role = \"propeller shaft\"\ntensile_strength = \"600 MPa\"\nrated_speed = \"85 rad/s\""), wide);
  const Verdict& upper = verdict_on(m.verdicts, "UR M68, all of");
  EXPECT_NEAR(upper.value, stress_at(8, 80), 1e-3 * upper.value);
  EXPECT_NEAR(upper.limit, continuous_at(0.94), 1e-9 * upper.limit);
  EXPECT_EQ(upper.state(), Compliance::exceeded);
}

// S (K_f τ_a + τ_W τ_m/(0.67 σ_B)) against τ_W, S |τ| against 0.577 σ_S, the amplitude against the manufacturer's.
TEST(ShaftStress, GoodmanYieldAndTheManufacturersLimitOfTheSteadyMotion) {
  const ModesStudy m = modes_of(
      two_masses(8,
                 "tensile_strength = \"600 MPa\"\nyield_strength = \"350 MPa\"\nendurance_limit = \"150 MPa\"\n"
                 "notch_factor = 1.6\nsafety = 1.5\nallowable_vibratory_stress = \"2 MPa\""),
      wide);
  const double amplitude = stress_at(8, 100), middle = mean / modulus;
  const Verdict& fatigue = verdict_on(m.verdicts, "fatigue");
  EXPECT_NEAR(fatigue.value, 1.5 * (1.6 * amplitude + 150 * middle / (0.67 * 600)), 1e-4 * fatigue.value);
  EXPECT_EQ(fatigue.limit, 150e6);
  const Verdict& maker = verdict_on(m.verdicts, "vibratory stress");
  EXPECT_NEAR(maker.value, amplitude, 1e-4 * amplitude);
  EXPECT_EQ(maker.state(), amplitude > 2e6 ? Compliance::exceeded : Compliance::holds);
  EXPECT_NEAR(verdict_on(m.verdicts, "yield").limit, 0.577 * 350e6, 1);
  ASSERT_FALSE(m.barred.empty());
  EXPECT_TRUE(m.barred[0].reason == "allowable_vibratory_stress" || m.barred[0].reason == "endurance_limit");
}

// A torque put on at once oscillates between none and twice its mean: τ_a = τ_m = 300 N·m/W_p in `run`.
TEST(Ratings, WidestCycleOfAShaftAfterAShock) {
  const Result r = test::run(R"(
    line = ["a", "shaft", "b"]
    a = { kind = "inertia", inertia = "0.5 kg*m2" }
    b = { kind = "inertia", inertia = "1.5 kg*m2" }
    drive = { kind = "torque source", on = "a", torque = "400 N*m" }
    effects = { elasticity = true }
    [shaft]
    kind = "shaft"
    length = "300 mm"
    diameter = "30 mm"
    inertia = "0 kg*m2"
    tensile_strength = "700 MPa"
    yield_strength = "420 MPa"
    endurance_limit = "170 MPa"
    notch_factor = 1.4
    safety = 1.2
    [run]
    until = "0.2 s"
    accuracy = 1e-8
  )");
  const double stress = 300 * 16 / (pi * std::pow(0.03, 3));
  EXPECT_NEAR(test::figure(r, "greatest_torque.shaft"), 600, 1e-4);
  EXPECT_NEAR(test::figure(r, "least_torque.shaft"), 0, 1e-4);
  const auto verdicts = judge_ratings(r);
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_NEAR(verdict_on(verdicts, "fatigue").value, 1.2 * (1.4 * stress + 170 * stress / (0.67 * 700)), 1e2);
  EXPECT_NEAR(verdict_on(verdicts, "yield").value, 1.2 * 2 * stress, 1e2);
}

// --- one cylinder does not fire ---

std::string engine(const std::string& misfire) {
  return fmt::format(R"(
line = ["engine", "shaft", "propeller"]
[engine]
kind = "engine"
strokes = "two"
firing_order = [1, 3, 2]
inertia = "30 kg*m2"
torque = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [20, 900], [60, 500], [120, 60], [240, -40], [320, -350], [360, 0]] }}
{}
[shaft]
kind = "shaft"
stiffness = "60 kN*m/rad"
damping_ratio = 0.02
diameter = "60 mm"
role = "intermediate shaft"
tensile_strength = "560 MPa"
rated_speed = "400 rpm"
[propeller]
kind = "load"
quadratic = "0.2 N*m*s2/rad2"
inertia = "20 kg*m2"
[effects]
elasticity = true
[run]
start = {{ speed = "380 rpm" }}
until = "1 s"
)",
                     misfire);
}

// Of three cylinders that fire evenly orders 1 and 2 cancel; where one is missing they come back, alike for every one.
TEST(Misfire, OrdersThatCancelledComeBackAsOneCylinderDoesNotFire) {
  const ModesOptions at{.speed = 38, .slowest = 8, .fastest = 48, .orders = 12};
  const ModesStudy all = modes_of(engine(""), at), without = modes_of(engine("misfire = [2]"), at);
  EXPECT_TRUE(without.stresses.misfires.empty());  // it is that case itself
  ASSERT_EQ(all.stresses.misfires.size(), 3u);
  const LimitedJoint& shaft = all.limited.at(0);
  const Firing& second = all.stresses.misfires[1];
  EXPECT_EQ(second.misfires, "cylinder 2 of engine");
  ASSERT_EQ(second.sweep.size(), without.sweep.size());
  for (std::size_t i = 0; i < second.sweep.size(); ++i) {
    const double expected = summed_stress(shaft, without.sweep[i].joints[0]);
    EXPECT_NEAR(summed_stress(shaft, second.sweep[i].joints[0]), expected, 1e-9 * expected);
  }
  const auto largest = [&](const Firing& firing, double order) {
    for (const StressPeak& p : stress_peaks(all.stresses.joints, firing))
      if (p.order == order) return p.stress;
    return 0.0;
  };
  for (const double order : {1.0, 2.0}) {
    EXPECT_EQ(largest(all.stresses.normal, order), 0);
    EXPECT_GT(largest(second, order), 0);  // at least 1 % of the sum
    // Samples of a cycle, a power of two, do not fall on thirds of a turn.
    for (const Firing& other : all.stresses.misfires)
      EXPECT_NEAR(largest(other, order), largest(second, order), 1e-4 * largest(second, order));
  }
  EXPECT_NE(stress_claims(all.stresses).front().text.find("misfiring"), std::string::npos);
}

TEST(Misfire, EveryCylinderOfTheShipsEngineIsTakenInTurn) {
  const Scene scene = test::scene_file("scenes/ship_propulsion.toml");
  ModesOptions options{.slowest = 3, .fastest = 12};
  const ModesStudy m = find_modes(scene, scene.effects, options);
  EXPECT_EQ(m.stresses.misfires.size(), 6u);
  options.misfires = false;
  EXPECT_TRUE(find_modes(scene, scene.effects, options).stresses.misfires.empty());
}

// The limits are kept with every cylinder firing, and exceeded as one misfires: the sentence names its condition.
TEST(Misfire, ThatExceedsALimitIsNoPartOfTheLimitsThatHold) {
  const Scene scene = test::scene_from(engine(""));
  ModesStudy m = find_modes(scene, scene.effects, {.slowest = 8, .fastest = 48, .orders = 12});
  // This engine is loaded most with all cylinders: the other way round it is the case to be named.
  m.stresses.misfires.resize(1);
  std::swap(m.stresses.normal.sweep, m.stresses.misfires.front().sweep);
  std::swap(m.stresses.normal.fundamental, m.stresses.misfires.front().fundamental);
  double all = 0, one = 0;  // [Pa]
  for (const StressPeak& p : stress_peaks(m.stresses.joints, m.stresses.normal)) all = std::max(all, p.stress);
  for (const Firing& firing : m.stresses.misfires)
    for (const StressPeak& p : stress_peaks(m.stresses.joints, firing)) one = std::max(one, p.stress);
  ASSERT_GT(one, 1.1 * all);
  const double between = 0.5 * (all + one);
  for (LimitedJoint& joint : m.stresses.joints) joint.limits.shaft = {}, joint.limits.shaft.vibratory = between;
  m.verdicts = {Verdict{{all, 0}, "shaft", requirement::vibratory_stress, between, "Pa", ""}};
  const std::string text = findings_of(m).conclusion();
  EXPECT_NE(text.find("With every cylinder firing its limit holds"), std::string::npos) << text;
  m.stresses.misfires.clear();
  const std::string alone = findings_of(m).conclusion();
  EXPECT_NE(alone.find("Its limit holds"), std::string::npos) << alone;
}

// --all: every row of every table, those of each misfiring cylinder among them.
TEST(Misfire, IsOnTheTerminal) {
  const Scene scene = test::scene_from(engine(""));
  const Findings f = findings_of(find_modes(scene, scene.effects, {.slowest = 8, .fastest = 48, .orders = 12}));
  const std::string brief = terminal_text(f, false), whole = terminal_text(f, true);
  const auto rows = [](const std::string& text) {
    int count = 0;
    for (std::size_t at = 0; (at = text.find("cylinder ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(rows(brief) - rows(f.conclusion()), 2) << brief;  // the heading, and the worst
  EXPECT_EQ(rows(whole) - rows(f.conclusion()), 4) << whole;
}

}  // namespace
}  // namespace kurbel::shaft_stress_test
