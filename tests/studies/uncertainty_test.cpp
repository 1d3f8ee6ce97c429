// uncertainty_test.cpp — tolerances as distributions, and what they make of a two-mass resonance against its closed
// form f = √(k (1/J₁ + 1/J₂))/2π.
#include "studies/uncertainty/uncertainty.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "studies/findings/output.h"
#include "studies/run/simulate.h"
#include "tests/support/scenes.h"

namespace kurbel::uncertainty_test {
namespace {

constexpr double j1 = 0.2, j2 = 1.5, stiffness = 4000, deviation = 200;  // of k: 10 % / 2

double resonance(double k, double j) { return std::sqrt(k * (1 / j1 + 1 / j)) / (2 * std::numbers::pi); }

MachineQuestion resonator(const std::string& of_mass) {
  MachineQuestion q;
  q.text = fmt::format(
      "title = \"Two masses\"\nline = [\"rotor\", \"spring\", \"mass\"]\n"
      "rotor = {{ kind = \"inertia\", inertia = \"0.2 kg*m2\" }}\n"
      "spring = {{ kind = \"coupling\", stiffness = {{ value = \"4 kN*m/rad\", tolerance = \"10 %\", distribution = "
      "\"normal\", k = 2 }}, damping = \"0 N*m*s/rad\" }}\n"
      "mass = {{ kind = \"inertia\", inertia = {} }}\nrun = {{ until = \"0.1 s\" }}\n",
      of_mass);
  q.file = "two.toml";
  q.of = SweepStudy::modes;
  return q;
}

const FigureUncertainty& of_figure(const UncertaintyStudy& s, const std::string& name) {
  for (const FigureUncertainty& f : s.figures)
    if (f.figure.name == name) return f;
  throw std::logic_error(name);
}

// k is normal, f grows with it: the share of f is the share of k.
TEST(Uncertainty, OfATwoMassResonanceIsItsClosedFormDistribution) {
  UncertaintyOptions options;
  options.samples = 4000;
  const double limit = 25, at_limit = std::pow(2 * std::numbers::pi * limit, 2) / (1 / j1 + 1 / j2);
  options.limits = {"natural_frequency.1 <= 25 Hz"};
  const UncertaintyStudy s = study_uncertainty(resonator("\"1.5 kg*m2\""), options);
  const FigureUncertainty& f = of_figure(s, "natural_frequency.1");
  const boost::math::normal k(stiffness, deviation);
  EXPECT_NEAR(f.value, resonance(stiffness, j2), 1e-9);
  // First order: u = f/(2k) · 200; the central difference over ± 0.2 u is off by (0.2 · 0.05)²/8.
  EXPECT_NEAR(f.by_gradients.value, f.value / (2 * stiffness) * deviation, 2e-5 * f.by_gradients.value);
  EXPECT_NEAR(f.shares.at(0).share.value, 1, 1e-12);
  EXPECT_NEAR(f.shares[0].without.value, 0, 1e-12);
  // Mean and deviation of √k by its series: E = √k (1 − c²/8), u = √k c/2 (1 + 7c²/64 …), c = 0.05.
  EXPECT_NEAR(f.mean.value, f.value * (1 - 0.05 * 0.05 / 8), 3.5 * f.by_gradients.value / std::sqrt(4000.0));
  EXPECT_NEAR(f.by_samples.value, f.by_gradients.value, 3.5 * f.by_gradients.value / std::sqrt(8000.0));
  // Quantiles scatter by √(p (1 − p)/n)/density: 4 % of u here.
  EXPECT_NEAR(f.low->value, resonance(boost::math::quantile(k, 0.025), j2), 3.5 * 0.042 * f.by_gradients.value);
  EXPECT_NEAR(f.high->value, resonance(boost::math::quantile(k, 0.975), j2), 3.5 * 0.042 * f.by_gradients.value);
  // Two standard errors: 2 u/√n of the mean, 2 u/√(2n) of the deviation.
  EXPECT_NEAR(f.mean.error.value(), 2 * f.by_gradients.value / std::sqrt(4000.0), 0.05 * f.mean.error.value());
  EXPECT_NEAR(f.by_samples.error.value(), 2 * f.by_gradients.value / std::sqrt(8000.0),
              0.1 * f.by_samples.error.value());
  EXPECT_NEAR(f.low->error.value(), 2 * 0.042 * f.by_gradients.value, 0.3 * f.low->error.value());
  const double chance = boost::math::cdf(k, at_limit);
  ASSERT_EQ(s.limits.size(), 1u);
  EXPECT_LT(s.limits[0].interval.low, chance);
  EXPECT_GT(s.limits[0].interval.high, chance);
  EXPECT_LT(s.limits[0].interval.high - s.limits[0].interval.low, 0.04);
  EXPECT_EQ(s.limits[0].holds + s.limits[0].beyond + s.limits[0].undecided, 4000u);
}

// Beyond either end of 95 % lies one of 40: fewer give no ends.
TEST(Uncertainty, FewSamplesReportNoEndsOfTheirDistribution) {
  for (const std::size_t samples : {39u, 40u}) {
    UncertaintyOptions options;
    options.samples = samples;
    const UncertaintyStudy s = study_uncertainty(resonator("\"1.5 kg*m2\""), options);
    EXPECT_EQ(of_figure(s, "natural_frequency.1").low.has_value(), samples >= 40) << samples;
    EXPECT_EQ(std::any_of(s.notes.begin(), s.notes.end(),
                          [](const std::string& note) { return note.starts_with("39 samples do not give"); }),
              samples < 40);
  }
}

// ∂f/∂k = f/2k, ∂f/∂J₂ = −f/2 · (1/J₂²)/(1/J₁ + 1/J₂).
TEST(Uncertainty, SharesOfTwoTolerancesAreThoseOfTheDerivatives) {
  UncertaintyOptions options;
  options.samples = 1000;
  const UncertaintyStudy s = study_uncertainty(
      resonator("{ value = \"0.3 kg*m2\", tolerance = \"0.06 kg*m2\", distribution = \"triangular\" }"), options);
  const FigureUncertainty& f = of_figure(s, "natural_frequency.1");
  const double by_k = f.value / (2 * stiffness) * deviation;
  const double by_j = f.value / 2 / (0.3 * 0.3) / (1 / j1 + 1 / 0.3) * 0.06 / std::sqrt(6.0);
  ASSERT_EQ(f.shares.size(), 2u);
  const ToleranceShare& of_k = f.shares[0].parameter == 0 ? f.shares[0] : f.shares[1];
  EXPECT_NEAR(of_k.share.value, by_k * by_k / (by_k * by_k + by_j * by_j), 1e-3);
  EXPECT_NEAR(f.by_gradients.value, std::hypot(by_k, by_j), 1e-3 * f.by_gradients.value);
  EXPECT_NEAR(f.by_samples.value, f.by_gradients.value, 0.08 * f.by_gradients.value);
  EXPECT_NEAR(of_k.without.value, by_j, 1e-3 * by_j);
}

// Φ cut off at 0: of a deviation as large as the value 15.87 % lie below, and are reported.
TEST(Uncertainty, ADistributionIsCutOffWhereTheDomainEnds) {
  Tolerance t{.path = "a.b",
              .unit = "kg*m2",
              .value = 1,
              .low = 0,
              .high = 2,
              .distribution = Tolerance::Distribution::normal,
              .k = 1,
              .at = {}};
  const Tolerated cut(t, positive);
  EXPECT_NEAR(cut.cut_off(), 0.158655, 1e-6);
  EXPECT_GT(cut.quantile(0), 0);
  EXPECT_NEAR(cut.quantile(0.5), 1 + boost::math::quantile(boost::math::normal(), 0.158655 + 0.5 * 0.841345), 1e-5);
  EXPECT_NE(cut.in_words().find("16 % cut off"), std::string::npos) << cut.in_words();
  t.distribution = Tolerance::Distribution::triangular, t.high = 4, t.low = 0.5;
  const Tolerated triangular(t, positive);
  EXPECT_NEAR(triangular.quantile(0.5 / 3.5), 1, 1e-12);  // the mode, by the area on its left
  EXPECT_NEAR(triangular.deviation(), std::sqrt((0.25 + 16 + 1 - 2 - 0.5 - 4) / 18), 1e-12);
  t.distribution = Tolerance::Distribution::uniform;
  EXPECT_NEAR(Tolerated(t, positive).quantile(0.25), 0.5 + 3.5 / 4, 1e-12);
}

// A run computes with the value, to the last bit.
TEST(Uncertainty, ARunTakesTheValueOfATolerance) {
  const MachineQuestion q = resonator("{ value = \"1.5 kg*m2\", from = \"1.4 kg*m2\", to = \"1.7 kg*m2\" }");
  std::string plain = q.text;
  const auto put = [&](const std::string& from, const std::string& to, const std::string& by) {
    const std::size_t begin = plain.find(from), end = plain.find(to, begin) + to.size();
    plain.replace(begin, end - begin, by);
  };
  put("{ value = \"4 kN", "k = 2 }", "\"4 kN*m/rad\"");
  put("{ value = \"1.5", "1.7 kg*m2\" }", "\"1.5 kg*m2\"");
  const Scene a = test::scene_from(q.text), b = test::scene_from(plain);
  EXPECT_EQ(a.find("spring")->number("stiffness"), b.find("spring")->number("stiffness"));
  EXPECT_EQ(a.find("mass")->number("inertia"), b.find("mass")->number("inertia"));
}

TEST(Uncertainty, WrongTolerancesAreReportedInTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"{ value = \"1.5 kg*m2\", tolerance = \"3 kg\" }", "is a mass"},
      {"{ value = \"1.5 kg*m2\", tolerance = \"3 %\", distribution = \"normall\" }", "did you mean \"normal\""},
      {"{ value = \"1.5 kg*m2\", tolerance = \"3 %\", from = \"1 kg*m2\" }", "either tolerance, or from and to"},
      {"{ value = \"1.5 kg*m2\", tolerance = \"3 %\", widht = 3 }", "unknown key \"widht\""},
      {"{ value = \"1.5 kg*m2\", tolerance = \"3 %\", k = 2 }", "normal"},
      {"{ value = \"1.5 kg\", tolerance = \"3 %\" }", "inertia"},
      {"{ value = \"1.5 kg*m2\", from = \"2 kg*m2\", to = \"3 kg*m2\" }", "between"}};
  for (const auto& [text, reported] : cases) {
    try {
      test::scene_from(resonator(text).text);
      ADD_FAILURE() << text;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(reported), std::string::npos) << text << "\n" << error.what();
    }
  }
  MachineQuestion none = resonator("\"1.5 kg*m2\"");
  none.settings = {"spring.stiffness=4 kN*m/rad"};
  EXPECT_THROW(study_uncertainty(none, {}), std::invalid_argument);
}

// The bias of an effect that is off is what kurbel run with it on says, signed.
TEST(Uncertainty, BiasesAreSignedShiftsOfEffectsThatAreOff) {
  MachineQuestion q;
  q.text = test::scene_file("scenes/crank_press.toml").text;
  q.file = "press.toml";
  q.settings = {"run.until=0.5 s", "flywheel.inertia={ value = \"420 kg*m2\", tolerance = \"5 %\" }",
                "effects.elasticity=false"};
  UncertaintyOptions options;
  options.samples = 20;
  options.figures = {"peak_torque.main_coupling"};
  const UncertaintyStudy s = study_uncertainty(q, options);
  const FigureUncertainty& f = of_figure(s, "peak_torque.main_coupling");
  EXPECT_GT(f.by_gradients.value, 0);
  ASSERT_TRUE(f.error);
  ASSERT_FALSE(f.biases.empty());
  const Scene elastic =
      parse_scene(SettledText(q.text, q.file, {"run.until=0.5 s", "effects.elasticity=true"}), all_kinds());
  const Result on = simulate(elastic, elastic.effects, "", {});
  bool found = false;
  for (const Bias& b : f.biases)
    if (std::abs(f.value + b.value - on.find("peak_torque.main_coupling")->value) < 1e-5 * f.value) found = true;
  EXPECT_TRUE(found);
}

// A short form of what scripts/uncertainty-trials does with 500 trials.
TEST(Uncertainty, IntervalsHoldAsOftenAsTheySay) {
  const std::string script = fmt::format("'{}/scripts/uncertainty-trials' --trials 40 --samples 60 --program '{}'",
                                         KURBEL_SOURCE_DIR, KURBEL_EXECUTABLE);
  EXPECT_EQ(std::system((script + " > /dev/null").c_str()), 0) << script;
}

// A tolerance of a millionth moves no more than the errors of the runs: (e₊ + e₋)/2u · u = (e₊ + e₋)/2 is left open.
TEST(Uncertainty, NoiseFloorsFollowFromTheErrorsOfTheRuns) {
  MachineQuestion q;
  q.text = test::scene_file("scenes/crank_press.toml").text;
  q.file = "press.toml";
  q.settings = {"run.until=0.3 s", "flywheel.inertia={ value = \"420 kg*m2\", tolerance = \"0.0001 %\" }",
                "main_coupling.stiffness={ value = \"900 kN*m/rad\", tolerance = \"0.0001 %\" }"};
  UncertaintyOptions options;
  options.samples = 20, options.biases = false, options.figures = {"peak_torque.main_coupling"};
  const UncertaintyStudy s = study_uncertainty(q, options);
  const FigureUncertainty& f = of_figure(s, "peak_torque.main_coupling");
  ASSERT_EQ(f.shares.size(), 2u);
  ASSERT_TRUE(f.by_gradients.error && f.shares[0].deviation.error && f.shares[1].deviation.error);
  EXPECT_DOUBLE_EQ(*f.by_gradients.error, std::hypot(*f.shares[0].deviation.error, *f.shares[1].deviation.error));
  bool any_below = false;
  for (const ToleranceShare& share : f.shares) {
    EXPECT_EQ(share.step, 1);  // the errors are more than 2 % of so small a difference
    any_below = any_below || share.deviation.value <= *share.deviation.error;
    const Tolerated& of = s.parameters[share.parameter];
    double errors = 0;
    for (const double sign : {-1.0, 1.0}) {
      MachineQuestion beside = q;
      beside.settings = {"run.until=0.3 s", fmt::format("{}={:.17g} {}", of.given().path,
                                                        of.given().value + sign * of.deviation(), of.given().unit)};
      for (const Figure& figure : answer_of(beside).figures)
        if (figure.name == f.figure.name) errors += figure.error.value();
    }
    EXPECT_NEAR(*share.deviation.error, errors / 2, 1e-6 * errors) << of.given().path;
  }
  EXPECT_EQ(any_below, !s.notes.empty() && s.notes.back().find("below the noise floor") != std::string::npos);
}

// ω = M t/J over J = 0.2 … 1.8 of its value: E[1/x] = ln 9/1.6, E[1/x²] = (5 − 5/9)/1.6, against gradients' 0.8/√3.
TEST(Uncertainty, WhatGradientsDoNotFollowIsReportedByItsSamples) {
  MachineQuestion q;
  q.text =
      "line = [\"wheel\"]\nwheel = { kind = \"inertia\", inertia = { value = \"1 kg*m2\", from = \"0.2 kg*m2\", to = "
      "\"1.8 kg*m2\" } }\npush = { kind = \"torque source\", torque = \"5 N*m\", on = \"wheel\" }\n"
      "run = { until = \"2 s\" }\n";
  q.file = "wheel.toml";
  UncertaintyOptions options;
  options.samples = 4000;
  options.biases = false;
  options.figures = {"final_speed.wheel"};
  const UncertaintyStudy s = study_uncertainty(q, options);
  const FigureUncertainty& f = of_figure(s, "final_speed.wheel");
  const double mean = std::log(9.0) / 1.6, u = std::sqrt((5 - 5 / 9.0) / 1.6 - mean * mean);
  EXPECT_NEAR(f.value, 10, 1e-9);
  EXPECT_NEAR(f.by_gradients.value, 8 / std::sqrt(3.0), 0.05);  // of a central difference over ± 0.2 deviations
  EXPECT_NEAR(f.by_samples.value, 10 * u, 4 * 10 * u / std::sqrt(4000.0));  // long tails scatter by more than 1/√(2n)
  EXPECT_FALSE(f.is_linear());
  EXPECT_EQ(&f.deviation(), &f.by_samples);
  EXPECT_NE(
      s.conclusion.find(fmt::format("a standard deviation of {:.2g} rpm", 30 / std::numbers::pi * f.by_samples.value)),
      std::string::npos)
      << s.conclusion;
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("does not follow its gradients"), std::string::npos) << s.notes[0];
  EXPECT_EQ(terminal_text(findings_of(s)).find("rad/s"), std::string::npos)
      << "speeds in the scene's unit, in all tables";
  // By 1 % it is linear.
  q.text.replace(q.text.find("0.2 kg"), 3, "0.99"), q.text.replace(q.text.find("1.8 kg"), 3, "1.01");
  const UncertaintyStudy narrow = study_uncertainty(q, options);
  EXPECT_TRUE(of_figure(narrow, "final_speed.wheel").is_linear());
  EXPECT_TRUE(narrow.notes.empty());
}

}  // namespace
}  // namespace kurbel::uncertainty_test
