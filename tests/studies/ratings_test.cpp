// ratings_test.cpp — heat of engagements, strand forces, rim speeds and shear stresses of runs against closed forms, and
// the verdicts on them.
#include "studies/limits/ratings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/limits/load_cases.h"
#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::ratings_test {
namespace {

using test::figure;
constexpr double pi = std::numbers::pi;

const Verdict& verdict_of(const std::vector<Verdict>& verdicts, const std::string& begin) {
  for (const Verdict& v : verdicts)
    if (v.requirement.starts_with(begin)) return v;
  throw std::logic_error("no verdict " + begin);
}

// A clutch of constant torque M between J₁ at Δω and J₂ at rest that a torque M_L holds back:
//     q = M/J₁ + (M − M_L)/J₂,  t = Δω/q,  W = M Δω²/(2 q);  J₁ → ∞: ½ J₂ Δω² M/(M − M_L);  M_L = 0: ½ J Δω².
TEST(Ratings, HeatOfAnEngagementUnderLoadIsTheClosedForm) {
  for (const double load : {0.0, 12.0}) {
    const double j1 = 1.7, j2 = 0.6, m = 40, dw = 150, q = m / j1 + (m - load) / j2, heat = m * dw * dw / (2 * q);
    const Result r = test::run(fmt::format(R"(
      line = ["a", "clutch", "b"]
      a = {{ kind = "inertia", inertia = "1.7 kg*m2" }}
      b = {{ kind = "inertia", inertia = "0.6 kg*m2" }}
      clutch = {{ kind = "clutch", torque = "40 N*m", allowable_heat = "{:.17g} J", allowable_heat_power = "1 kW" }}
      drag = {{ kind = "torque source", on = "b", torque = "-{} N*m" }}
      run = {{ until = "20 s", accuracy = 1e-9, start = {{ a = {{ speed = "150 rad/s" }}, b = {{ speed = "0 rad/s" }} }} }}
    )",
                                           0.8 * heat, load));
    EXPECT_NEAR(figure(r, "engagement_heat.clutch"), heat, 1e-8 * heat);
    EXPECT_NEAR(figure(r, "slip_time.clutch"), dw / q, 1e-9);
    EXPECT_NEAR(figure(r, "heat_power.clutch"), heat / 20, 1e-8 * heat);
    const auto verdicts = judge_ratings(r);
    ASSERT_EQ(verdicts.size(), 3u);  // under load it holds a torque, too
    EXPECT_EQ(verdicts[2].state(), load > 0 ? Compliance::holds : Compliance::not_assessed);
    EXPECT_EQ(verdicts[0].state(), Compliance::exceeded);
    EXPECT_NE(verdicts[0].note.find("89 %"), std::string::npos) << verdicts[0].note;  // √0.8
    EXPECT_EQ(verdicts[1].state(), Compliance::holds);
    EXPECT_NE(sentence_of(verdicts, "rating")
                  .find(fmt::format("1 of {} ratings EXCEEDED, worst \"clutch\"", load > 0 ? 3 : 2)),
              std::string::npos);
  }
}

// A brake of 20 N·m on 1 kg m² from 100 rad/s: on for 1 s (90 rad), released, on for ½ s from 80 rad/s (37.5 rad).
TEST(Ratings, EveryEngagementCountsByItself) {
  const Result r = test::run(R"(
    line = ["a"]
    a = { kind = "inertia", inertia = "1 kg*m2" }
    brake = { kind = "brake", on = "a", torque = "20 N*m", allowable_heat = "2 kJ", allowable_heat_power = "400 W" }
    sequence = { steps = [{ at = "1 s", set = "brake", to = 0 }, { at = "2 s", set = "brake" }, { at = "2.5 s", set = "brake", to = 0 }] }
    run = { until = "5 s", accuracy = 1e-9, start = { speed = "100 rad/s" } }
  )");
  EXPECT_NEAR(figure(r, "engagement_heat.brake"), 1800, 1e-5);
  EXPECT_NEAR(figure(r, "slip_time.brake"), 1.5, 1e-9);
  EXPECT_NEAR(figure(r, "heat_power.brake"), 2550.0 / 5, 1e-5);
  const auto verdicts = judge_ratings(r);
  EXPECT_EQ(verdict_of(verdicts, "heat of an engagement").state(), Compliance::holds);
  EXPECT_EQ(verdict_of(verdicts, "mean heat power").state(), Compliance::exceeded);
  EXPECT_NE(verdict_of(verdicts, "mean heat power").note.find("78 %"), std::string::npos);  // 400/510
}

// 30 N·m on J₁ = 0.5 drive J₂ = 4 through i = 2: τ = 30 · 1/1.5 = 20 N·m on r₁ = 0.1 m, tight strand F₀ + 100 N. At the
// limit the strands are as e^{μα}.
TEST(Ratings, BeltByEulerAndEytelwein) {
  const auto text = [](double reserve, double tension) {
    return fmt::format(R"(
      line = ["a", "belt", "b"]
      a = {{ kind = "inertia", inertia = "0.5 kg*m2" }}
      b = {{ kind = "inertia", inertia = "4 kg*m2" }}
      drive = {{ kind = "torque source", on = "a", torque = "30 N*m" }}
      [belt]
      kind = "belt"
      diameter_in = "200 mm"
      diameter_out = "400 mm"
      pretension = "500 N"
      friction_coefficient = 0.3
      wrap_angle = "180 deg"
      slip_reserve = {}
      allowable_tension = "{} N"
      [run]
      until = "2 s"
      accuracy = 1e-9
    )",
                       reserve, tension);
  };
  const Result r = test::run(text(2, 599));
  EXPECT_NEAR(figure(r, "strand_force.belt"), 600, 1e-6);
  const auto verdicts = judge_ratings(r);
  const Verdict &slip = verdict_of(verdicts, "reserve"), &strand = verdict_of(verdicts, "strand");
  EXPECT_EQ(slip.state(), Compliance::holds);
  EXPECT_NEAR(slip.value, 40, 1e-7);
  const double pull = slip.limit / 0.2;  // half of T₁ − T₂
  EXPECT_NEAR((500 + pull) / (500 - pull), std::exp(0.3 * pi), 1e-12);
  EXPECT_EQ(strand.state(), Compliance::exceeded);
  EXPECT_NE(strand.note.find("diameter_in = 202.1 mm"), std::string::npos) << strand.note;  // 200 · 100/99, rounded up
  const auto more = judge_ratings(test::run(text(3, 700)));
  EXPECT_EQ(verdict_of(more, "strand").state(), Compliance::holds);
  EXPECT_EQ(verdict_of(more, "reserve").state(), Compliance::exceeded);
  EXPECT_NEAR(verdict_of(more, "reserve").remedy->value, 500 * 60 / slip.limit, 0.1);
  EXPECT_NE(verdict_of(more, "reserve").note.find("pretension = "), std::string::npos);
}

// 5 N·m on 1 kg m² from 100 rad/s for 2 s: 110 rad/s at r = 0.6 m, v = 66 m/s, σ = ρ v².
TEST(Ratings, RimSpeedAndHoopStress) {
  const Result r = test::run(R"(
    line = ["wheel"]
    drive = { kind = "torque source", on = "wheel", torque = "5 N*m" }
    [wheel]
    kind = "flywheel"
    inertia = "1 kg*m2"
    rim_radius = "600 mm"
    allowable_rim_speed = "70 m/s"
    rim_density = "7200 kg/m3"
    allowable_rim_stress = "30 MPa"
    [run]
    until = "2 s"
    accuracy = 1e-9
    start = { speed = "100 rad/s" }
  )");
  EXPECT_NEAR(figure(r, "rim_speed.wheel"), 66, 1e-9);
  const auto verdicts = judge_ratings(r);
  EXPECT_EQ(verdict_of(verdicts, "rim speed").state(), Compliance::holds);
  const Verdict& stress = verdict_of(verdicts, "hoop stress");
  EXPECT_NEAR(stress.value, 7200.0 * 66 * 66, 1);
  EXPECT_EQ(stress.state(), Compliance::exceeded);
  EXPECT_NEAR(stress.remedy->value, 0.6 * std::sqrt(30e6 / (7200.0 * 66 * 66)), 1e-4);
}

// τ = 16 T/(π d³) of the torque that the run finds, rigid and elastic.
TEST(Ratings, ShearStressOfAShaft) {
  for (const char* elasticity : {"false", "true"}) {
    const Result r = test::run(fmt::format(R"(
      line = ["a", "shaft", "b"]
      a = {{ kind = "inertia", inertia = "0.5 kg*m2" }}
      b = {{ kind = "inertia", inertia = "1.5 kg*m2" }}
      drive = {{ kind = "torque source", on = "a", torque = "400 N*m" }}
      effects = {{ elasticity = {} }}
      [shaft]
      kind = "shaft"
      length = "300 mm"
      diameter = "30 mm"
      allowable_shear_stress = "50 MPa"
      [run]
      until = "0.2 s"
      accuracy = 1e-8
    )",
                                           elasticity));
    const double torque = figure(r, "peak_torque.shaft"), swings = *elasticity == 't' ? 2 : 1;
    EXPECT_NEAR(std::abs(torque), swings * 300, 0.02 * 300);  // 400 · 1.5/2; applied at once it peaks at twice that
    const auto verdicts = judge_ratings(r);
    ASSERT_EQ(verdicts.size(), 1u);
    EXPECT_NEAR(verdicts[0].value, 16 * std::abs(torque) / (pi * std::pow(0.03, 3)), 1e-9 * verdicts[0].value);
    EXPECT_EQ(verdicts[0].state(), Compliance::exceeded);
  }
}

// A motor by Kloss held at its rated speed gives M_N; half the voltage a quarter of that. 1 s of each in 4 s:
// RMS √((1 + 1/16)/4) M_N. The duty's own is M_N √part.
TEST(Ratings, DutyOfAMotorByASquareProfile) {
  const auto text = [](const char* duty) {
    return fmt::format(R"(
      line = ["motor", "held"]
      held = {{ kind = "prescribed speed", speed = "1440 rpm" }}
      sequence = {{ steps = [{{ at = "1 s", set = "motor", to = 0.5 }}, {{ at = "2 s", set = "motor", to = 0 }}] }}
      [motor]
      kind = "induction motor"
      rated_power = "15 kW"
      rated_speed = "1440 rpm"
      synchronous_speed = "1500 rpm"
      breakdown_ratio = 2.8
      inertia = "0.1 kg*m2"
      {}
      [run]
      until = "4 s"
      accuracy = 1e-9
      start = {{ speed = "1440 rpm" }}
    )",
                       duty);
  };
  const double rated = 15e3 / (1440 * pi / 30);
  const double rms = rated * std::sqrt((1 + 1.0 / 16) / 4);
  const auto judged = [&](const char* duty, double part) {
    const Result r = test::run(text(duty));
    EXPECT_NEAR(figure(r, "motor_rms_torque.motor"), rms, 1e-9 * rated);
    const auto verdicts = judge_ratings(r);
    EXPECT_EQ(verdicts.size(), 1u);
    EXPECT_NEAR(verdicts.at(0).limit, rated * std::sqrt(part), 1e-9 * rated);
    return verdicts.at(0);
  };
  EXPECT_EQ(judged("duty = \"S1\"", 1).state(), Compliance::holds);
  EXPECT_EQ(judged("duty = \"S3\"\nduty_share = 0.4", 0.4).state(), Compliance::holds);
  EXPECT_EQ(judged("duty = \"S2\"\nduty_time = \"3 s\"", 0.75).state(), Compliance::holds);
  const Verdict exceeded = judged("duty = \"S3\"\nduty_share = 0.25", 0.25);
  EXPECT_EQ(exceeded.state(), Compliance::exceeded);
  EXPECT_NE(exceeded.note.find("it holds from a rated torque of"), std::string::npos) << exceeded.note;
}

// A shunt motor at its full field heats its armature by M², too: U, R, k held at a speed give M = k (c U − k ω)/R. Full
// voltage for 1 s, braking on its resistance for 1 s.
TEST(Ratings, DutyOfAShuntMotorByASquareProfile) {
  const auto verdict = [](const char* duty) {
    const Result r = test::run(fmt::format(R"(
      line = ["motor", "held"]
      held = {{ kind = "prescribed speed", speed = "100 rad/s" }}
      sequence = {{ steps = [{{ at = "1 s", set = "motor", to = 0 }}] }}
      [motor]
      kind = "dc shunt motor"
      voltage = "220 V"
      resistance = "0.5 Ohm"
      constant = "2 N*m/A"
      braking_resistance = "1.5 Ohm"
      rated_torque = "60 N*m"
      inertia = "0.1 kg*m2"
      {}
      [run]
      until = "2 s"
      accuracy = 1e-9
      start = {{ speed = "100 rad/s" }}
    )",
                                           duty));
    return judge_ratings(r).at(0);
  };
  const double drives = 2 * (220 - 200) / 0.5, brakes = 2 * 200 / 2.0;
  const Verdict s1 = verdict("duty = \"S1\"");
  EXPECT_NEAR(s1.value, std::sqrt((drives * drives + brakes * brakes) / 2), 1e-7);
  EXPECT_EQ(s1.limit, 60);
  EXPECT_EQ(s1.state(), Compliance::exceeded);
  EXPECT_NEAR(verdict("duty = \"S2\"\nduty_time = \"1 s\"").limit, 60 * std::sqrt(0.5), 1e-12);
}

// What is not rated is not judged; the sentence is of terminal and page alike, and people get a table. Without a clutch or
// brake nobody counts heat.
TEST(Ratings, NothingRatedNothingJudged) {
  const auto text = [](const char* rating) {
    return fmt::format(R"(
      line = ["a"]
      a = {{ kind = "inertia", inertia = "1 kg*m2" }}
      brake = {{ kind = "brake", on = "a", torque = "20 N*m"{} }}
      run = {{ until = "10 s", accuracy = 1e-9, start = {{ speed = "100 rad/s" }} }}
    )",
                       rating);
  };
  const Result bare = test::run(text("")), rated = test::run(text(R"(, allowable_heat = "6 kJ")"));
  EXPECT_TRUE(judge_ratings(bare).empty());
  EXPECT_NEAR(figure(bare, "engagement_heat.brake"), 5000, 1e-5);
  EXPECT_EQ(heat_recorder_of(*test::run(test::scene_file("scenes/six_inertia_chain.toml"), false).model), nullptr);
  EXPECT_EQ(findings_of(bare).conclusion().find("rating"), std::string::npos);
  EXPECT_NEAR(figure(rated, "engagement_heat.brake"), 5000, 1e-5);  // ½ J ω²
  EXPECT_NE(findings_of(rated).conclusion().find("Its rating holds"), std::string::npos);
}

// Beside the figures of two models, too, and in their conclusion: of the second.
TEST(Ratings, OfAComparisonAreThoseOfItsSecondModel) {
  const Scene scene = test::scene_file("scenes/belt_mill.toml");
  SimulateOptions quick;
  quick.measure_error = false;
  const Comparison c = compare(scene, models_to_compare(scene), quick);
  EXPECT_TRUE(findings_of(c).conclusion().find("1 of 3 ratings EXCEEDED, worst \"belts\"") != std::string::npos)
      << findings_of(c).conclusion();
  // A belt that slips limits its torque: no pretension follows from it, and how long it slips is said.
  const std::vector<Verdict> verdicts = judge_ratings(c.b);
  EXPECT_FALSE(verdict_of(verdicts, "reserve").remedy);
  EXPECT_NE(findings_of(c).conclusion().find(" s in all, and grips again"), std::string::npos);
}

// Continuous duty is judged by the steady cycle, which a start with more than the rated torque does not change.
TEST(Ratings, ContinuousDutyIsThatOfTheSteadyCycle) {
  const Result r = test::run(test::scene_file("docs/tasks/two_cylinder_compressor.toml"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double rated = 15e3 / (970 * 2 * std::numbers::pi / 60);
  ASSERT_GT(test::figure(r, "motor_rms_torque.motor"), rated);
  std::vector<Verdict> verdicts = judge_ratings(r);
  EXPECT_EQ(std::erase_if(verdicts, [](const Verdict& v) { return !v.assessed; }), 2u);  // T_KN, T_KW of the coupling
  ASSERT_EQ(verdicts.size(), 2u);
  for (const Verdict& v : verdicts) {
    EXPECT_EQ(v.state(), Compliance::holds);
    if (v.component == "motor") {
      EXPECT_EQ(v.requirement, "RMS torque of the steady cycle: √(∫ M² dt/T) ≤ M_N");
      EXPECT_NEAR(v.value, rated * test::figure(r, "thermal_use.motor"), 1e-9 * rated);
    } else {
      EXPECT_EQ(v.requirement, requirement::maximum);
      EXPECT_GE(v.value, std::abs(test::figure(r, "peak_torque." + v.component)));
    }
  }
}

// A run that begins within the range of its steady speed, but with a vibration that decays over seven turns: 628 N·m is no
// torque of its steady motion, which has 608.5 N·m; in a run from its twentieth turn on it would be.
TEST(Ratings, WhatTheStartHasLeftIsNotOfTheSteadyMotion) {
  const Result r = test::run(test::scene_file("tests/cases/reports/universal_joint_free_body.toml"));
  ASSERT_TRUE(r.periods.steady && !r.periods.run_up_end);
  const Verdict verdict = verdict_of(judge_ratings(r), requirement::maximum);
  EXPECT_NEAR(verdict.value, 628.0225, 1e-3);
  EXPECT_EQ(load_case_at(r, verdict.at), load_case::steady);
  EXPECT_EQ(verdict.load_case, load_case::run);
  Scene longer = test::scene_file("tests/cases/reports/universal_joint_free_body.toml");
  longer.run.until = 20;  // 14 samples of a cycle
  EXPECT_EQ(verdict_of(judge_ratings(test::run(longer)), requirement::maximum).load_case, load_case::steady);
}

}  // namespace
}  // namespace kurbel::ratings_test
