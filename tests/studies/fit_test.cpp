// fit_test.cpp — records made of closed forms give back the values that made them, with the errors that theory says;
// what a record cannot determine is named.
#include "studies/fit/fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "engine/scene/messages.h"
#include "tests/support/files.h"

namespace kurbel::fit_test {
namespace {

namespace fs = std::filesystem;
constexpr double pi = std::numbers::pi;

class Fit : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }
  const test::ScratchFolder folder_;
};

// A rotor that drag slows down: ω = ω₀ e^{−bt/J}, ω₀ = 100 rad/s, J = 0.5 kg·m², b = 0.2 N·m·s/rad.
constexpr double omega0 = 100, inertia = 0.5, damping = 0.2;
const char* const coasting =
    "line = [\"rotor\", \"drag\"]\nrotor = { kind = \"flywheel\", inertia = \"0.5 kg*m2\" }\n"
    "drag = { kind = \"bearing drag\", damping = \"0.3 N*m*s/rad\" }\n"
    "[run]\nstart = { speed = \"100 rad/s\" }\nuntil = \"4 s\"\naccuracy = 1e-9\n";
double coasted(double t) { return omega0 * std::exp(-damping * t / inertia); }

FitOptions asked(const std::string& scene, const std::string& record, Over over, std::vector<std::string> maps,
                 std::vector<std::string> free) {
  FitOptions options;
  RecordRequest& r = options.records.emplace_back();
  r.name = "test", r.file = record, r.over = over, r.maps = std::move(maps);
  r.scene.text = scene, r.scene.file = "test.toml";
  options.free = std::move(free);
  return options;
}

std::string coasting_record(double sigma, int points, std::uint64_t seed, double shift = 0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, 1);
  std::string text = "t [s],n [rad/s]\n";
  for (int i = 0; i < points; ++i) {
    const double t = 3.0 * i / (points - 1);
    text += fmt::format("{},{}\n", t, coasted(t + shift) + sigma * noise(random));
  }
  return text;
}

// Exact data: b to 1e-6; and with noise σ the deviation of b is σ/√Σ(∂ω/∂b)², ∂ω/∂b = −t/J ω.
TEST_F(Fit, OfACoastingRotorFindsItsDragWithItsError) {
  FitOptions exact = asked(coasting, file("exact.csv", coasting_record(0, 61, 1)), Over::time, {"n=speed.rotor"},
                           {"drag.damping=0.05..0.6 N*m*s/rad"});
  const FitStudy found = fit_machine(exact);
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.unknowns.at(0).value, damping, 1e-6);
  const double sigma = 0.5;
  const int points = 301;
  const FitStudy noisy = fit_machine(asked(coasting, file("noisy.csv", coasting_record(sigma, points, 7)), Over::time,
                                           {"n=speed.rotor"}, {"drag.damping=0.05..0.6 N*m*s/rad"}));
  double squares = 0;
  for (int i = 0; i < points; ++i) {
    const double t = 3.0 * i / (points - 1);
    squares += std::pow(t / inertia * coasted(t), 2);
  }
  const double deviation = sigma / std::sqrt(squares);
  const FittedUnknown& b = noisy.unknowns.at(0);
  // Of 300 points s is known to 4 %; the correlation length of noise is over 1 by up to some 0.2.
  EXPECT_NEAR(*b.error, deviation, 0.25 * deviation);
  EXPECT_NEAR(b.value, damping, 4 * deviation);
  EXPECT_NEAR(noisy.residuals.at(0).rms, sigma, 0.15 * sigma);
  EXPECT_NEAR((*b.high - *b.low) / *b.error, 2 * 1.968, 0.02);  // Student's, some 250 … 300 degrees
}

// b and J: b/J alone is seen. Moved together by their ratio nothing changes.
TEST_F(Fit, NamesWhatARecordCannotDistinguish) {
  const FitStudy found =
      fit_machine(asked(coasting, file("pair.csv", coasting_record(0.1, 61, 3)), Over::time, {"n=speed.rotor"},
                        {"drag.damping=0.05..0.6 N*m*s/rad", "rotor.inertia=0.2..1 kg*m2"}));
  ASSERT_EQ(found.confounded.size(), 1u);
  EXPECT_NE(found.confounded[0].find("drag.damping"), std::string::npos) << found.confounded[0];
  EXPECT_NE(found.confounded[0].find("rotor.inertia"), std::string::npos) << found.confounded[0];
  EXPECT_FALSE(found.unknowns[0].error || found.unknowns[1].error);
  EXPECT_NEAR(found.unknowns[0].value / found.unknowns[1].value, damping / inertia, 2e-3);
}

// The record begins 0.25 s late: Δ and the start speed go together (ω₀ e^{−bΔ/J}); the shift alone is found.
TEST_F(Fit, FindsAShiftWithoutARunOfTheMachine) {
  const FitStudy found = fit_machine(asked(coasting, file("late.csv", coasting_record(0, 61, 1, 0.25)), Over::time,
                                           {"n=speed.rotor"}, {"shift=0..0.8 s", "drag.damping=0.05..0.6 N*m*s/rad"}));
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_NEAR(found.unknowns[0].value, 0.25, 1e-4);
  EXPECT_NEAR(found.unknowns[1].value, damping, 1e-5);
}

// Times of teeth, 12 − 1: φ = ω₀ J/b (1 − e^{−bt/J}), t by its inverse. A gap is no slow tooth.
TEST_F(Fit, ReadsTeethWithAGap) {
  std::string text = "tooth,t [s]\n";
  for (int tooth = 0; tooth < 240; ++tooth) {
    if (tooth % 12 == 7) continue;
    const double angle = tooth * 2 * pi / 12;
    text += fmt::format("{},{}\n", tooth, -inertia / damping * std::log(1 - angle * damping / (inertia * omega0)));
  }
  FitOptions options =
      asked(coasting, file("teeth.csv", text), Over::time, {"t=speed.rotor"}, {"drag.damping=0.05..0.6 N*m*s/rad"});
  options.records[0].teeth = "12-1";
  const FitStudy found = fit_machine(options);
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_NEAR(found.unknowns[0].value, damping, 1e-5);
}

// f = √(k (1/J₁ + 1/J₂))/2π, ζ = c ω/(2k).
TEST_F(Fit, FindsStiffnessAndDampingByAMode) {
  const double j1 = 0.2, j2 = 1.5, k = 5000, c = 3, omega = std::sqrt(k * (1 / j1 + 1 / j2)),
               ratio = c * omega / (2 * k);
  const std::string text = fmt::format("mode,f [Hz],fd [Hz],zeta [-]\n1,{},{},{}\n", omega / (2 * pi),
                                       omega / (2 * pi) * std::sqrt(1 - ratio * ratio), ratio);
  const std::string scene =
      "line = [\"a\", \"spring\", \"b\"]\na = { kind = \"inertia\", inertia = \"0.2 kg*m2\" }\nspring = { kind = "
      "\"coupling\", stiffness = \"4 kN*m/rad\", damping = \"5 N*m*s/rad\" }\nb = { kind = \"inertia\", inertia = "
      "\"1.5 kg*m2\" }\n[effects]\nelasticity = true\n[run]\nuntil = \"0.1 s\"\n";
  const std::vector<std::string> free = {"spring.stiffness=3..8 kN*m/rad", "spring.damping=1..10 N*m*s/rad"};
  const std::string record = file("modes.csv", text);
  const FitStudy found = fit_machine(
      asked(scene, record, Over::mode, {"f=natural_frequency", "fd=damped_frequency", "zeta=damping_ratio"}, free));
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_NEAR(found.unknowns[0].value, k / 1000, 1e-6 * k / 1000);
  EXPECT_NEAR(found.unknowns[1].value, c, 1e-6 * c);
  EXPECT_TRUE(found.unknowns[0].error);
  // Two values for two unknowns: solved, without errors.
  const FitStudy solved =
      fit_machine(asked(scene, record, Over::mode, {"f=natural_frequency", "zeta=damping_ratio"}, free));
  EXPECT_NEAR(solved.unknowns[0].value, k / 1000, 1e-6 * k / 1000);
  EXPECT_NEAR(solved.unknowns[1].value, c, 1e-6 * c);
  for (const FittedUnknown& u : solved.unknowns) EXPECT_FALSE(u.error) << *u.error;
  EXPECT_NE(solved.unknowns[0].remark.find("not assessed"), std::string::npos);
  EXPECT_TRUE(solved.errors_from.empty()) << solved.errors_from;
}

// Two records, one shared unknown and a start speed of each; each omitted, the other finds the same within its error.
TEST_F(Fit, SharesUnknownsBetweenRecordsAndLeavesEachOut) {
  FitOptions options = asked(coasting, file("a.csv", coasting_record(0.3, 81, 4)), Over::time, {"n=speed.rotor"},
                             {"drag.damping=0.05..0.6 N*m*s/rad", "each: run.start.speed=80..120 rad/s"});
  options.records.push_back(options.records[0]);
  options.records[0].name = "a", options.records[1].name = "b";
  options.records[1].file = file("b.csv", coasting_record(0.3, 81, 9, 0.2));
  const FitStudy found = fit_machine(options);
  ASSERT_EQ(found.unknowns.size(), 3u);
  EXPECT_EQ(found.unknowns[1].unknown.name, "a: run.start.speed");
  EXPECT_NEAR(found.unknowns[0].value, damping, 4 * *found.unknowns[0].error);
  EXPECT_NEAR(found.unknowns[1].value, omega0, 4 * *found.unknowns[1].error);
  EXPECT_NEAR(found.unknowns[2].value, coasted(0.2), 4 * *found.unknowns[2].error);
  ASSERT_EQ(found.omitted.size(), 6u);
  for (const WithoutRecord& l : found.omitted)
    if (l.name == "drag.damping") {
      EXPECT_LT(std::abs(*l.errors), 5);
    }
  EXPECT_FALSE(found.correlations.empty());
}

// A record that no value of the free unknowns explains is given little weight in what another one determines: the second
// record's rotor has another drag than the scene says, and b alone is shared.
TEST_F(Fit, ARecordThatItsMachineDoesNotExplainDrawsLittle) {
  FitOptions options = asked(coasting, file("good.csv", coasting_record(0.02, 81, 4)), Over::time, {"n=speed.rotor"},
                             {"drag.damping=0.05..0.6 N*m*s/rad"});
  std::string bad = "t [s],n [rad/s]\n";
  for (int i = 0; i < 81; ++i) bad += fmt::format("{},{}\n", 0.0375 * i, coasted(0.0375 * i) + 20 * std::sin(0.25 * i));
  options.records.push_back(options.records[0]);
  options.records[0].name = "good", options.records[1].name = "bad";
  options.records[1].file = file("bad.csv", bad);
  options.checks = false;
  EXPECT_NEAR(fit_machine(options).unknowns.at(0).value, damping, 1e-3);
}

// What is left holds a frequency that the machine lacks: its band is the one that is named.
TEST_F(Fit, SaysWhichBandOfFrequenciesIsLeft) {
  std::string text = "t [s],n [rad/s]\n";
  for (int i = 0; i < 400; ++i)
    text += fmt::format("{},{}\n", 0.0075 * i, coasted(0.0075 * i) + 2 * std::sin(2 * pi * 25 * 0.0075 * i));
  const FitStudy found = fit_machine(
      asked(coasting, file("band.csv", text), Over::time, {"n=speed.rotor"}, {"drag.damping=0.05..0.6 N*m*s/rad"}));
  const auto most = std::max_element(found.bands.begin(), found.bands.end(),
                                     [](const BandResidual& a, const BandResidual& b) { return a.left < b.left; });
  ASSERT_NE(most, found.bands.end());
  EXPECT_LE(most->from, 25);
  EXPECT_GE(most->to, 25);
  EXPECT_NEAR(most->left, 2 / std::sqrt(2.0), 0.05);
}

// ω(1 + a cos φ + b sin φ), φ = ω₀ J/b (1 − e^{−bt/J}): what an encoder's pitches add each turn, of a record over time.
TEST_F(Fit, FindsThePatternOfAnEncoderOverTime) {
  const double a = 0.002, b = -0.003;
  std::string text = "t [s],n [rad/s]\n";
  for (int i = 0; i < 300; ++i) {
    const double t = 0.01 * i, angle = omega0 * inertia / damping * (1 - std::exp(-damping * t / inertia));
    text += fmt::format("{},{}\n", t, coasted(t) * (1 + a * std::cos(angle) + b * std::sin(angle)));
  }
  const FitStudy found = fit_machine(asked(coasting, file("pattern.csv", text), Over::time, {"n=speed.rotor"},
                                           {"drag.damping=0.05..0.6 N*m*s/rad", "pattern of speed.rotor=1"}));
  ASSERT_EQ(found.unknowns.size(), 3u);
  EXPECT_NEAR(found.unknowns[0].value, damping, 1e-5);
  EXPECT_NEAR(found.unknowns[1].value, a, 1e-5);
  EXPECT_NEAR(found.unknowns[2].value, b, 1e-5);
}

// 1.05 ω + 2; and a table's offset: against a torque of 3 N·m, of which the scene says 2, ω = ω₀ − M t/J.
TEST_F(Fit, FindsGainAndOffsetOfAChannelAndOffsetOfATable) {
  std::string text = "t [s],n [rad/s]\n", straight = text;
  for (int i = 0; i < 61; ++i)
    text += fmt::format("{},{}\n", 0.05 * i, 1.05 * coasted(0.05 * i) + 2),
        straight += fmt::format("{},{}\n", 0.05 * i, omega0 - 3 * 0.05 * i / inertia);
  const FitStudy found = fit_machine(
      asked(coasting, file("gain.csv", text), Over::time, {"n=speed.rotor"},
            {"drag.damping=0.05..0.6 N*m*s/rad", "gain of speed.rotor=0.9..1.2", "offset of speed.rotor=-5..5 rad/s"}));
  EXPECT_NEAR(found.unknowns.at(0).value, damping, 1e-5);
  EXPECT_NEAR(found.unknowns.at(1).value, 1.05, 1e-4);
  EXPECT_NEAR(found.unknowns.at(2).value, 2, 1e-2);
  const FitStudy table = fit_machine(asked(
      "line = [\"rotor\", \"load\"]\nrotor = { kind = \"flywheel\", inertia = \"0.5 kg*m2\" }\nload = { kind = "
      "\"load\", table = { over = \"time\", unit = [\"s\", \"N*m\"], points = [[0, 2], [9, 2]] } }\n[run]\nstart = "
      "{ speed = \"100 rad/s\" }\nuntil = \"4 s\"\naccuracy = 1e-9\n",
      file("straight.csv", straight), Over::time, {"n=speed.rotor"}, {"offset of load.table=-1..3 N*m"}));
  EXPECT_NEAR(table.unknowns.at(0).value, 1, 1e-6);
  EXPECT_NE(table.notes.at(0).find("offset of load.table"), std::string::npos) << table.notes.at(0);
}

// A torque over the angle drives a rotor: J (ω² − c)/2 = M₁ sin φ + M₂/2 sin 2φ; c by the mean speed 2π/∮dφ/ω. Straight
// between points h apart a harmonic k loses ((sin x)/x)², x = kh/2.
constexpr double first = 15, second = 5;  // [N·m]
std::string driven(double shift = 0) {
  std::string points, against;
  const double step = pi / 36;
  const auto kept = [](double x) { return std::pow(std::sin(x) / x, 2); };
  for (int i = 0; i <= 72; ++i) {
    const std::string at = fmt::format("{}[{}, ", i ? ", " : "", 5 * i);
    points += fmt::format("{}{}]", at, 21 + first / kept(step / 2) * std::cos(step * i + shift));
    against += fmt::format("{}{}]", at, 20 - second / kept(step) * std::cos(2 * step * i));
  }
  const std::string table = "over = \"angle\", unit = [\"deg\", \"N*m\"], period = \"360 deg\", points = [";
  return "line = [\"rotor\", \"drive\", \"load\", \"brake\"]\nrotor = { kind = \"flywheel\", inertia = \"0.4 kg*m2\" "
         "}\n"
         "drive = { kind = \"torque source\", table = { " +
         table + points + "] } }\nload = { kind = \"load\", table = { " + table + against +
         "] } }\nbrake = { kind = \"load\", torque = \"1 N*m\", acts = \"always\" }\n[run]\nstart = { speed = \"100 "
         "rad/s\" }\nuntil = \"1 s\"\naccuracy = 1e-8\n";
}
double driven_speed(double mean, double angle) {
  const auto squared = [](double c, double at) {
    return c + 2 / inertia * (first * std::sin(at) + second / 2 * std::sin(2 * at));
  };
  double c = mean * mean;
  for (int round = 0; round < 30; ++round) {
    double slowness = 0;
    for (int i = 0; i < 360; ++i) slowness += 1 / std::sqrt(squared(c, pi / 180 * i)) / 360;
    c *= std::pow(mean * slowness, 2);
  }
  return std::sqrt(squared(c, angle));
}
// `shift`: what the record calls 0 lies so much behind the machine's 0 [rad].
std::string driven_record(double mean, double shift = 0, int cycles = 1, double sigma = 0, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, 1);
  std::string text = "angle [deg]";
  for (int k = 1; k <= cycles; ++k) text += fmt::format(",c{} [rad/s]", k);
  for (int i = 0; i < 72; ++i) {
    const double speed = driven_speed(mean, pi / 36 * i + shift);
    text += fmt::format("\n{}", 5 * i);
    for (int k = 0; k < cycles; ++k) text += fmt::format(",{}", speed + sigma * noise(random));
  }
  return text + "\n";
}
FitOptions of_driven(const std::string& scene, const std::string& record, std::vector<std::string> free) {
  FitOptions options = asked(scene, record, Over::angle, {"c*=speed.rotor"}, std::move(free));
  options.records[0].hold_by = "brake.torque";
  return options;
}

// What is called 0 by table and record lies 0.02 rad behind the dead centre; the load's table does not move with it.
TEST_F(Fit, FindsTheDeadCentreOfTableAndRecord) {
  const FitStudy found =
      fit_machine(of_driven(driven(0.02), file("centre.csv", driven_record(100, 0.02)),
                            {"rotor.inertia=0.2..1 kg*m2", "dead centre of drive.table=-0.1..0.1 rad"}));
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_NEAR(found.unknowns.at(0).value, inertia, 1e-3 * inertia);
  EXPECT_NEAR(found.unknowns.at(1).value, 0.02, 1e-4);
}

// Of a torque with orders 1 and 2 order 2 alone is compared: the sentence says so, the curve's plot too.
TEST_F(Fit, TellsWhichOrdersItsResidualIsOf) {
  FitOptions options = of_driven(driven(), file("orders.csv", driven_record(100)), {"rotor.inertia=0.2..1 kg*m2"});
  options.records[0].orders = {2};
  options.checks = false;
  const FitStudy found = fit_machine(options);
  EXPECT_NE(found.conclusion.find("; in the orders compared (2) the RMS residual is "), std::string::npos)
      << found.conclusion;
  EXPECT_EQ(found.curves.at(0).orders, (std::vector<double>{2}));
}

// The nearest of 170 ± 360 deg lies beyond the bound, where a fit from 0 ends; another start comes to −190 deg.
TEST_F(Fit, OfSeveralStartsTheBestIsKept) {
  FitOptions options = of_driven(driven(), file("starts.csv", driven_record(100, 170 * pi / 180)),
                                 {"shift=-300..60 deg", "rotor.inertia=0.3..0.7 kg*m2"});
  options.checks = false;
  EXPECT_EQ(fit_machine(options).unknowns.at(0).remark, "on its upper bound");
  options.starts = 4;
  const FitStudy found = fit_machine(options);
  EXPECT_NEAR(found.unknowns.at(0).value, -190, 0.01);
  EXPECT_NEAR(found.unknowns.at(1).value, inertia, 1e-3 * inertia);
  EXPECT_NE(found.notes.at(0).find("of 4 starts came to the best fit"), std::string::npos) << found.notes.at(0);
}

// Fitted at 100 rad/s to sixteen cycles, predicted at 60: δ of the closed form within its interval, the curve by far
// better than the fitted one taken for it; and what is written has the values, for the page and for the next fit.
TEST_F(Fit, PredictsARecordWithItsIntervalAndWritesTheScene) {
  FitOptions options = of_driven(driven(), file("cycles.csv", driven_record(100, 0, 16, 0.02)),
                                 {"rotor.inertia=0.2..1 kg*m2", "offset of speed.rotor=-1..1 rad/s"});
  options.predictions = {{.given = "slower",
                          .scene = options.records[0].scene,
                          .mean_speed = 60,
                          .against = file("slower.csv", driven_record(60))}};
  const FitStudy found = fit_machine(options);
  ASSERT_TRUE(found.complete) << found.diagnosis;
  const FittedUnknown& j = found.unknowns.at(0);
  // 72 points, σ/√16 each: σ_J = J σ/(4 √Σ(ω − ω̄)²), as ω − ω̄ ~ 1/J.
  double squares = 0;
  for (int i = 0; i < 72; ++i) squares += std::pow(driven_speed(100, pi / 36 * i) - 100, 2);
  EXPECT_NEAR(*j.error, inertia * 0.02 / 4 / std::sqrt(squares), 0.5 * *j.error);
  EXPECT_NEAR(j.value, inertia, 4 * *j.error);
  EXPECT_EQ(found.residuals.at(0).count, 72u);
  const Prediction& slower = found.predictions.at(0);
  double most = 0, least = 1e9;
  for (int i = 0; i < 72; ++i)
    most = std::max(most, driven_speed(60, pi / 36 * i)), least = std::min(least, driven_speed(60, pi / 36 * i));
  EXPECT_NEAR(slower.delta->value, 2 * (most - least) / (most + least), *slower.delta->error);
  EXPECT_LT(*slower.delta->error, 0.05 * slower.delta->value);
  EXPECT_LT(*slower.rms, *slower.rms_of_fitted_record / 3);
  EXPECT_GT(*slower.inside, 0.9);

  FitOptions again = options;
  again.records[0].scene.text = found.written;
  const FitProblem next(again.records, again.free, 1, {});
  EXPECT_NEAR(next.unknowns()[0].at(next.given()[0]), j.value, 1e-9);
  std::string titles;
  const Report page = page_of(findings_of(found));
  for (const ReportSection& section : page.sections)
    for (const Card& card : section.cards)
      if (const Plot* const plot = std::get_if<Plot>(&card)) titles += plot->title + "\n";
  for (const char* shown : {"measured and fitted", "Residual of", "correlation", "predicted"})
    EXPECT_NE(titles.find(shown), std::string::npos) << titles;
}

// Two discs on a spring, from rest under a torque: ω_a = (M t + J_b M/(J_a Ω) sin Ωt)/(J_a + J_b), Ω² = k (1/J_a + 1/J_b).
// Elasticity is off; of what is off it is what takes the rest away.
TEST_F(Fit, TriesTheEffectThatIsOff) {
  const double ja = 0.2, jb = 1.5, k = 2000, torque = 8, omega = std::sqrt(k * (1 / ja + 1 / jb));
  std::string text = "t [s],n [rad/s]\n";
  for (int i = 1; i < 200; ++i) {
    const double t = 0.002 * i;
    text += fmt::format("{},{}\n", t, torque * (t + jb / (ja * omega) * std::sin(omega * t)) / (ja + jb));
  }
  const FitStudy found =
      fit_machine(asked("line = [\"drive\", \"a\", \"spring\", \"b\"]\ndrive = { kind = \"torque source\", torque = "
                        "\"5 N*m\" }\na = { kind "
                        "= \"inertia\", inertia = \"0.2 kg*m2\" }\nspring = { kind = \"coupling\", stiffness = \"2 "
                        "kN*m/rad\" }\nb = { kind "
                        "= \"inertia\", inertia = \"1.5 kg*m2\" }\n[effects]\nelasticity = false\n[run]\nuntil = \"0.5 "
                        "s\"\naccuracy = 1e-7\n",
                        file("off.csv", text), Over::time, {"n=speed.a"}, {"drive.torque=1..20 N*m"}));
  ASSERT_FALSE(found.effects.empty());
  EXPECT_NE(found.effects[0].words.find("elasticity"), std::string::npos);
  EXPECT_GT(found.effects[0].reduction, 0.999) << found.effects[0].failed;
}

// A record over the angle of a machine without a cycle, a channel that does not vary, a bad map, more unknowns than data.
TEST_F(Fit, RefusesWhatSaysNothing) {
  const auto said = [&](const FitOptions& options) -> std::string {
    try {
      fit_machine(options);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::string record = file("r.csv", coasting_record(0, 5, 1));
  const std::string free = "drag.damping=0.05..0.6 N*m*s/rad";
  EXPECT_NE(said(asked(coasting, record, Over::time, {"n=speed.rotr"}, {free})).find("did you mean \"speed.rotor\""),
            std::string::npos);
  EXPECT_NE(said(asked(coasting, file("c.csv", "t [s],n [rad/s]\n0,1\n1,1\n2,1\n3,1\n"), Over::time, {"n=speed.rotor"},
                       {free}))
                .find("does not vary"),
            std::string::npos);
  EXPECT_NE(said(asked(coasting, file("p.csv", "angle [deg],n [rad/s]\n0,1\n10,2\n20,1\n30,3\n"), Over::angle,
                       {"n=speed.rotor"}, {free}))
                .find("no cycle that repeats"),
            std::string::npos);
  const auto of_angle = [&](const std::string& name, const std::string& text) {
    return said(of_driven(driven(), file(name, text), {"rotor.inertia=0.2..1 kg*m2"}));
  };
  const std::string whole = driven_record(100), half = whole.substr(0, whole.find("\n180,"));
  EXPECT_NE(of_angle("half.csv", half + "\n").find("must cover a whole period"), std::string::npos);
  EXPECT_NE(of_angle("more.csv", whole + "360,100\n365,100\n").find("more than the machine's cycle"),
            std::string::npos);
  FitOptions mixed = of_driven(driven(), file("whole.csv", whole), {"shift=-1..1 deg"});
  mixed.records.push_back(asked(coasting, record, Over::time, {"n=speed.rotor"}, {}).records[0]);
  mixed.records[1].name = "down";
  EXPECT_NE(said(mixed).find("unlike axes"), std::string::npos);
  EXPECT_NE(said(asked(coasting, record, Over::time, {"n=speed.rotor"},
                       {free, "rotor.inertia=0.2..1 kg*m2", "run.start.speed=90..110 rad/s", "shift=0..0.1 s",
                        "gain of speed.rotor=0.9..1.1", "offset of speed.rotor=-1..1 rad/s"}))
                .find("--free: 6 unknowns for 5 values"),
            std::string::npos);
  EXPECT_NE(
      said(asked(coasting, record, Over::time, {"n=speed.rotor"}, {"drag.dampin=0.05..0.6 N*m*s/rad"})).find("dampin"),
      std::string::npos);
}

}  // namespace
}  // namespace kurbel::fit_test
