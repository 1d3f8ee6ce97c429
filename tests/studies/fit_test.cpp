// fit_test.cpp — records made of closed forms give back the values that made them, with the errors that theory says;
// what a record cannot tell is named.
#include "studies/fit/fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "engine/scene/messages.h"

namespace kurbel::fit_test {
namespace {

namespace fs = std::filesystem;
constexpr double pi = std::numbers::pi;

class Fit : public testing::Test {
 protected:
  Fit() : folder_(fs::temp_directory_path() / ("kurbel_fit_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Fit() override { fs::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }
  fs::path folder_;
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
  std::normal_distribution<double> noise(0, sigma);
  std::string text = "t [s],n [rad/s]\n";
  for (int i = 0; i < points; ++i) {
    const double t = 3.0 * i / (points - 1);
    text += fmt::format("{},{}\n", t, coasted(t + shift) + (sigma > 0 ? noise(random) : 0));
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
TEST_F(Fit, NamesWhatARecordCannotTellApart) {
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
TEST_F(Fit, FindsAStiffnessByAMode) {
  const double j1 = 0.2, j2 = 1.5, k = 5000, c = 3, omega = std::sqrt(k * (1 / j1 + 1 / j2));
  const std::string text = fmt::format("mode,f [Hz],zeta [-]\n1,{},{}\n", omega / (2 * pi), c * omega / (2 * k));
  const FitStudy found = fit_machine(asked(
      "line = [\"a\", \"spring\", \"b\"]\na = { kind = \"inertia\", inertia = \"0.2 kg*m2\" }\nspring = { kind = "
      "\"coupling\", stiffness = \"4 kN*m/rad\", damping = \"3 N*m*s/rad\" }\nb = { kind = \"inertia\", inertia = "
      "\"1.5 kg*m2\" }\n[effects]\nelasticity = true\n[run]\nuntil = \"0.1 s\"\n",
      file("modes.csv", text), Over::mode, {"f=natural_frequency", "zeta=damping_ratio"},
      {"spring.stiffness=3..8 kN*m/rad"}));
  ASSERT_TRUE(found.complete) << found.diagnosis;
  EXPECT_NEAR(found.unknowns[0].value, k / 1000, 1e-6 * k / 1000);
}

// Two records, one shared unknown and a start speed of each; each left out, the other finds the same within its error.
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
  ASSERT_EQ(found.left_out.size(), 6u);
  for (const WithoutRecord& l : found.left_out)
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
  EXPECT_NE(said(asked(coasting, record, Over::time, {"n=speed.rotor"},
                       {free, "rotor.inertia=0.2..1 kg*m2", "run.start.speed=90..110 rad/s", "shift=0..0.1 s",
                        "gain of speed.rotor=0.9..1.1"}))
                .find("5 unknowns for 5 values"),
            std::string::npos);
  EXPECT_NE(
      said(asked(coasting, record, Over::time, {"n=speed.rotor"}, {"drag.dampin=0.05..0.6 N*m*s/rad"})).find("dampin"),
      std::string::npos);
}

// min (x − 2)² + (y − 1/4)² in the unit square: x presses against 1.
TEST(BoundedFit, HoldsWhatPressesAgainstABound) {
  const BoundedProblem problem{
      .residuals = [](const Eigen::VectorXd& u) -> std::optional<Eigen::VectorXd> {
        return Eigen::Vector2d(u[0] - 2, u[1] - 0.25);
      },
      .derivative = [](const Eigen::VectorXd&, const Eigen::VectorXd&) -> std::optional<Eigen::MatrixXd> {
        return Eigen::MatrixXd::Identity(2, 2);
      }};
  const BoundedFit fit = fit_within_bounds(problem, Eigen::Vector2d(0.1, 0.9));
  EXPECT_NEAR(fit.u[0], 1, 1e-12);
  EXPECT_NEAR(fit.u[1], 0.25, 1e-6);
  EXPECT_EQ(fit.on_bound, (std::vector<int>{1, 0}));
}

// Two columns in the ratio 3: the direction (1, −1) of columns of equal length is not seen; the third is known.
TEST(BoundedFit, NamesTheDirectionThatColumnsShare) {
  Eigen::MatrixXd j(4, 3);
  j << 1, 3, 0, 2, 6, 1, 0, 0, 1, 1, 3, -1;
  const Determination d = determined_by(j, {0, 0, 0}, 1e-4);
  ASSERT_EQ(d.undetermined.size(), 1u);
  ASSERT_EQ(d.undetermined[0].unknowns.size(), 2u);
  EXPECT_NEAR(d.undetermined[0].parts[0] / d.undetermined[0].parts[1], -1, 1e-9);
  EXPECT_EQ(d.known, (std::vector<bool>{false, false, true}));
  // Cov of the third: 1/(|c|² − (c·a)²/|a|²), a = (1, 2, 0, 1), c = (0, 1, 1, −1).
  EXPECT_NEAR(d.covariance(2, 2), 1 / (3.0 - 1.0 / 6), 1e-9);
}

}  // namespace
}  // namespace kurbel::fit_test
