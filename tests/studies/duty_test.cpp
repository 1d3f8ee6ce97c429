// duty_test.cpp — what a run requires of its motors, and where its energy goes: closed forms, and works against powers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "engine/base/find_by.h"
#include "studies/duty/work_periods.h"
#include "studies/findings/trace.h"
#include "studies/limits/ratings.h"
#include "studies/modes/modes.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"
#include "studies/steady/steady_words.h"
#include "tests/published/published.h"
#include "tests/support/conclusions.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::duty_test {
namespace {

using test::figure;
constexpr double pi = std::numbers::pi;

// M = M₀ (1 − ω/ω₀) on an inertia alone: ω = ω₀ (1 − e^(−t/T)), M = M₀ e^(−t/T), T = J ω₀/M₀, so that
//     M_rms² = M₀² T/(2 t) (1 − e^(−2t/T)),   P_mean = ½ J ω²/t
TEST(MotorFigures, OfARunUpOnAnInertiaAreThoseOfTheClosedForm) {
  const double M = 60, w = 40, J = 1.5 + 0.5, t = 2;
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", rated_torque = "20 N*m", inertia = "0.5 kg*m2" }
    wheel = { kind = "flywheel", inertia = "1.5 kg*m2" }
    run = { start = "rest", until = "2 s", accuracy = 1e-9 }
  )");
  const double T = J * w / M, end = w * (1 - std::exp(-t / T));
  EXPECT_NEAR(figure(r, "motor_rms_torque.motor"), M * std::sqrt(T / (2 * t) * (1 - std::exp(-2 * t / T))), 1e-7);
  EXPECT_NEAR(figure(r, "motor_mean_power.motor"), 0.5 * J * end * end / t, 1e-6);
  EXPECT_EQ(r.find("motor_slip_heat.motor"), nullptr) << "of induction motors only";
  EXPECT_EQ(r.find("thermal_use.motor"), nullptr) << "no cycle, no use of one";
}

// U, R, k on an inertia alone: i = (U/R) e^(−t/T), T = J R/k². And of a series motor, whose torque is κ i², by the current
// that its circuit has as a state.
TEST(MotorFigures, CurrentOfARunUpIsThatOfTheClosedForm) {
  const std::string text = R"(
    line = ["motor", "wheel"]
    motor = { kind = "dc shunt motor", voltage = "220 V", resistance = "0.5 Ohm", constant = "1.4 N*m/A", inertia = "1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "5 kg*m2" }
    run = { start = "rest", until = "2 s", accuracy = 1e-9, samples = 20001 }
  )";
  const double t = 2, T = 6 * 0.5 / (1.4 * 1.4);
  EXPECT_NEAR(figure(test::run(text), "motor_rms_current.motor"),
              220 / 0.5 * std::sqrt(T / (2 * t) * (1 - std::exp(-2 * t / T))), 1e-5);
  std::string series = test::with(test::with(text, "dc shunt motor", "dc series motor"), "1.4 N*m/A\"",
                                  "60 mN*m/A2\", inductance = \"10 mH\", max_speed = \"900 rad/s\"");
  const Result r = test::run(series);
  const std::vector<double> current = test::series(r, "current.motor"), time = r.trajectory->time();
  double square = 0;  // Simpson's rule
  for (std::size_t i = 0; i + 2 < current.size(); i += 2)
    square += (time[i + 2] - time[i]) / 6 *
              (current[i] * current[i] + 4 * current[i + 1] * current[i + 1] + current[i + 2] * current[i + 2]);
  EXPECT_NEAR(figure(r, "motor_rms_current.motor"), std::sqrt(square / t), 1e-5);
}

// Whatever its curve: an induction motor that runs an inertia up from rest to ω heats its rotor by
//     ω_s J ω − ½ J ω²,   towards ω_s as much as it gives to the inertia.
TEST(MotorFigures, HeatOfSlipOfAStartIsThatOfTheClosedForm) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "induction motor", rated_power = "7.5 kW", rated_speed = "1450 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.5, inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "2.9 kg*m2" }
    run = { start = "rest", until = "10 s", accuracy = 1e-9 }
  )");
  const double J = 3, synchronous = 50 * pi, w = figure(r, "final_speed.motor");
  EXPECT_GT(w, 0.9 * synchronous);
  EXPECT_NEAR(figure(r, "motor_slip_heat.motor"), synchronous * J * w - 0.5 * J * w * w, 1e-4);
  EXPECT_NEAR(figure(r, "motor_mean_power.motor") * 10, 0.5 * J * w * w, 1e-4);
}

// Mean power times time is the work; the cycle's are those that `steady` finds by itself.
TEST(MotorFigures, PowerTimesTimeIsWorkAndRunAgreesWithSteady) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const Result r = test::run(scene);
  EXPECT_NEAR(figure(r, "motor_mean_power.motor") * r.until, figure(r, "work.driving"),
              1e-9 * figure(r, "work.driving"));
  const double of_cycle = figure(r, "driving_work_per_cycle");
  EXPECT_NEAR(figure(r, "cycle_motor_power.motor") * figure(r, "cycle_time.press"), of_cycle, 1e-9 * of_cycle);
  EXPECT_NEAR(figure(r, "machine_efficiency"), -figure(r, "useful_work_per_cycle") / of_cycle, 1e-12);
  const SteadyStudy s = steady(scene, {scene.effects}, {});
  ASSERT_TRUE(s.cycles.front().found);
  const MotorUse& motor = s.cycles.front().motors.front();
  ASSERT_TRUE(motor.thermal());
  // M_b = ratio · P_n/ω_n
  const Section& plate = *scene.find("motor");
  const double breakdown = plate.number("breakdown_ratio") * plate.number("rated_power") / plate.number("rated_speed");
  EXPECT_NEAR(s.cycles.front().find("breakdown_use.motor")->value, std::abs(motor.peak) / breakdown, 1e-12);
  EXPECT_NEAR(s.cycles.front().find("cycle_motor_power.motor")->value, figure(r, "cycle_motor_power.motor"), 1e-2);
  EXPECT_NEAR(s.cycles.front().find("machine_efficiency")->value, figure(r, "machine_efficiency"), 1e-6);
  EXPECT_NEAR(figure(r, "thermal_use.motor"), *motor.thermal(), 1e-5 * *motor.thermal());
  for (const char* name : {"motor_mean_power.motor", "thermal_use.motor", "cycle_motor_power.motor"})
    EXPECT_TRUE(r.find(name)->error && *r.find(name)->error > 0) << name;
}

// With both ends at work the compressor asks its motor for 55 % and more, with one 29 %: its heat is by the heavier, and so
// is the verdict, though the run ends with the lighter; also where the motor slips out of the band about the last speed.
// Neither the start counts, nor what a switching leaves behind.
TEST(MotorFigures, ThermalUseIsThatOfTheHeaviestCycleThatRepeats) {
  for (const auto& [bore, until, use] : {std::tuple("146 mm", "9 s", 0.5455), std::tuple("240 mm", "9 s", 0.992),
                                         std::tuple("146 mm", "6.9 s", 0.5455), std::tuple("260 mm", "9 s", 1.115)}) {
    SCOPED_TRACE(std::string(bore) + ", " + until);
    std::string text = test::text_of(test::source_path("scenes/unloaded_compressor.toml"));
    text.replace(text.find("146 mm"), 6, bore);
    text.insert(text.find("breakdown_ratio"), "duty = \"S1\"\n");
    Scene scene = test::scene_from(text);
    SteadyOptions options;
    options.at.time = 4.9;
    const SteadyStudy loaded = steady(scene, {scene.effects}, options);
    ASSERT_TRUE(loaded.cycles.back().found) << loaded.cycles.back().why;
    const MotorUse& motor = loaded.cycles.back().motors.front();
    EXPECT_NEAR(*motor.thermal(), use, 1e-3);
    scene.run.until = std::stod(until);
    const Result r = test::run(scene);
    EXPECT_NEAR(figure(r, "thermal_use.motor"), *motor.thermal(), 0.01 * *motor.thermal()) << "it swings on a little";
    const std::vector<Verdict> verdicts = judge_ratings(r);
    const auto* const judged = find_by(verdicts, &Verdict::component, "motor");
    ASSERT_NE(judged, nullptr);
    if (r.find(quantities::run_up_time, "")) {
      EXPECT_NE(judged->requirement.find("heaviest cycle"), std::string::npos);
      EXPECT_NEAR(judged->value, figure(r, "thermal_use.motor") * *motor.rated, 1e-9 * judged->value);
      EXPECT_EQ(judged->state(), use > 1 ? Compliance::exceeded : Compliance::holds);
    }
  }
}

// ½ J (ω_max² − ω_min²) = J δ ω_mid²; `steady` finds the same.
TEST(FlywheelEnergy, IsInertiaTimesFluctuationTimesSpeedSquared) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const Result r = test::run(scene);
  const double J = scene.find("flywheel")->number("inertia"), delta = figure(r, "delta.press"),
               w = figure(r, "mid_speed.press");
  const double energy = figure(r, "flywheel_energy.flywheel");
  EXPECT_NEAR(energy, J * delta * w * w, 1e-9 * energy);
  const SteadyStudy s = steady(scene, {scene.effects}, {});
  const Figure* found = s.cycles.front().find("flywheel_energy.flywheel");
  ASSERT_NE(found, nullptr);
  EXPECT_NEAR(found->value, energy, 1e-5 * energy);
}

// --- ratings of the steady motion ---

// What DIN 740-2 requires of the steady motion is what `modes` requires, value and error; the start is not judged.
TEST(SteadyRatings, OfACouplingAreThoseOfModes) {
  const Scene scene = test::scene_file("docs/tasks/genset.toml");
  const SteadyStudy s = steady(scene, {scene.effects}, {});
  ASSERT_TRUE(s.cycles.front().found) << s.cycles.front().why;
  const std::vector<Verdict> verdicts = steady_ratings(s.cycles.front());
  std::size_t same = 0;
  for (const Verdict& by_modes : find_modes(scene, scene.effects, {}).verdicts) {
    if (by_modes.requirement == requirement::maximum) continue;
    const auto* const found = find_by(verdicts, &Verdict::requirement, by_modes.requirement);
    ASSERT_NE(found, nullptr) << by_modes.requirement;
    EXPECT_NEAR(found->value, by_modes.value, found->known_error() + by_modes.known_error()) << by_modes.requirement;
    EXPECT_LT(found->known_error(), 1e-4 * found->value);
    ++same;
  }
  EXPECT_EQ(same, 3U) << "T_KN, T_KW, P_KW";
  const auto* const most = find_by(verdicts, &Verdict::requirement, requirement::maximum);
  ASSERT_NE(most, nullptr);
  EXPECT_NE(most->note.find("kurbel modes judges the start"), std::string::npos) << most->note;
}

// A shaft of several segments is judged once each, with K_A, and not by its peaks besides; what a start would add (S_z) does
// not weigh on the steady torque, and the start is said to be omitted.
TEST(SteadyRatings, AreNotJudgedTwice) {
  for (const int segments : {1, 3}) {
    SCOPED_TRACE(segments);
    const Scene scene = test::scene_from(fmt::format(
        "line = [\"motor\", \"coupling\", \"shaft\", \"wheel\"]\n"
        "motor = {{ kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"100 rad/s\", inertia = "
        "\"0.5 kg*m2\" }}\n"
        "coupling = {{ kind = \"coupling\", stiffness = \"20 kN*m/rad\", relative_damping = 0.8, maximum_torque = \"90 "
        "N*m\", start_factor = 1.5 }}\n"
        "shaft = {{ kind = \"shaft\", diameter = \"20 mm\", length = \"400 mm\", segments = {}, damping_ratio = 0.01, "
        "allowable_shear_stress = \"40 MPa\", application_factor = 1.5 }}\n"
        "wheel = {{ kind = \"load\", damping = \"0.6 N*m*s/rad\", inertia = \"4 kg*m2\" }}\n[effects]\nelasticity = "
        "true\n[run]\nuntil = \"30 s\"\nstart = {{ speed = \"50 rad/s\" }}\n",
        segments));
    const SteadyStudy s = steady(scene, {scene.effects}, {});
    ASSERT_TRUE(s.cycles.back().found) << s.cycles.back().why;
    const std::vector<Verdict> verdicts = steady_ratings(s.cycles.back());
    std::size_t stresses = 0;
    for (const Verdict& v : verdicts) {
      if (v.requirement.starts_with("shear stress") && v.assessed) {
        ++stresses;
        EXPECT_NE(v.requirement.find("K_A"), std::string::npos) << v.component;
        EXPECT_NEAR(v.value, 1.5 * 30 / (pi * 8e-6 / 16), 2e-3 * v.value) << "30 N·m, 20 mm";
      }
      if (v.requirement == requirement::maximum && v.assessed) {
        EXPECT_NEAR(v.value, 30, 0.1) << "without S_z";
      }
      if (v.requirement == requirement::maximum && !v.assessed) {
        EXPECT_NE(v.note.find("kurbel modes judges the start"), std::string::npos) << v.note;
      }
    }
    EXPECT_EQ(stresses, static_cast<std::size_t>(segments));
  }
}

// 30 N·m on the motor against a drag of 2.4 N·m·s/rad behind a belt of 1 : 2: 60 N·m, 25 rad/s there, 50 rad/s at the
// motor. F = F₀ + τ/(2 r₁) = 500 + 30/0.2 = 650 N; v = r ω = 0.4 · 25 m/s; M_rms/M_n = 30/20.
TEST(SteadyRatings, AreThoseOfTheMotionThatItKeeps) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "belt", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", rated_torque = "20 N*m", inertia = "0.5 kg*m2" }
    wheel = { kind = "flywheel", inertia = "4 kg*m2", rim_radius = "400 mm", allowable_rim_speed = "9 m/s" }
    drag = { kind = "load", on = "wheel", damping = "2.4 N*m*s/rad" }
    [belt]
    kind = "belt"
    diameter_in = "200 mm"
    diameter_out = "400 mm"
    pretension = "500 N"
    friction_coefficient = 0.3
    wrap_angle = "180 deg"
    allowable_tension = "700 N"
    [run]
    until = "30 s"
    accuracy = 1e-8
    start = { speed = "50 rad/s" }
  )");
  const SteadyStudy s = steady(scene, {scene.effects}, {});
  ASSERT_TRUE(s.cycles.front().found) << s.cycles.front().why;
  const std::vector<Verdict> verdicts = steady_ratings(s.cycles.front());
  ASSERT_EQ(verdicts.size(), 3u);
  for (const Verdict& v : verdicts)
    if (!v.assessed) {
      EXPECT_EQ(v.component + ", " + v.load_case, std::string("belt, ") + load_case::start);
    } else if (v.component == "belt") {
      EXPECT_NEAR(v.value, 650, 1e-4);
      EXPECT_EQ(v.state(), Compliance::holds);
    } else {
      EXPECT_NEAR(v.value, 10, 1e-5);
      EXPECT_EQ(v.state(), Compliance::exceeded);
    }
  const Findings f = findings_of(s);
  test::expect_valid_conclusion(f, "steady ratings");
  EXPECT_TRUE(f.conclusion().starts_with("\"motor\" gets too hot: the RMS torque of its steady motion is 150 %"))
      << f.conclusion();
  EXPECT_NE(f.conclusion().find("1 of 2 ratings EXCEEDED, worst \"wheel\", rim speed"), std::string::npos);
}

// No engagement and no start is in the steady motion: their limits are not assessed, and no sentence says that all hold.
TEST(SteadyRatings, LeaveStartsAndEngagementsToARun) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "clutch", "hub", "belt", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", rated_torque = "20 N*m", inertia = "0.5 kg*m2", duty = "S2", duty_time = "10 min" }
    clutch = { kind = "clutch", torque = "90 N*m", allowable_heat = "2 kJ", allowable_heat_power = "300 W" }
    belt = { kind = "belt", diameter_in = "200 mm", diameter_out = "200 mm", pretension = "500 N", friction_coefficient = 0.5, wrap_angle = "180 deg", slip_reserve = 1.1 }
    hub = { kind = "inertia", inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "4 kg*m2", rim_radius = "400 mm", allowable_rim_speed = "90 m/s" }
    drag = { kind = "load", on = "wheel", damping = "0.6 N*m*s/rad" }
    run = { until = "30 s", start = { speed = "50 rad/s" } }
  )");
  const SteadyStudy s = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(s.cycles.back().found) << s.cycles.back().why;
  std::multiset<std::string> left;
  for (const Verdict& v : steady_ratings(s.cycles.back()))
    if (v.state() == Compliance::not_assessed) left.insert(v.component + ", " + v.load_case);
  const std::string run = load_case::run, start = load_case::start;
  EXPECT_EQ(left, (std::multiset<std::string>{"belt, " + start, "clutch, " + run, "clutch, " + run, "clutch, " + run,
                                              "motor, " + run}));
  const std::string reported = findings_of(s).conclusion();
  EXPECT_NE(reported.find("ratings that are assessed hold"), std::string::npos) << reported;
  EXPECT_NE(reported.find("not assessed: "), std::string::npos) << reported;
}

// Plots over the angle show the cycle that figures are of: driven up to 1 s, though it turns on to 3 s; what nothing ever
// drove shows its last one.
TEST(Traces, OverTheAngleAreOfTheLastCycleThatIsDriven) {
  SimulateOptions options;
  options.traces = true, options.measure_error = false;
  const auto end_of_last = [&](const std::string& stop) {
    const Scene scene = test::scene_from(R"(
      line = ["motor", "press"]
      motor = { kind = "torque source", torque = ")" +
                                         stop + R"( }
      press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "5 kg*m2", slider_mass = "1 kg" }
      run = { start = { speed = "50 rad/s" }, until = "3 s" }
    )");
    const Result r = simulate(scene, scene.effects, "test", options);
    return r.traces->last_cycles.back().end;
  };
  EXPECT_LE(end_of_last("10 N*m\", stop = \"1 s\""), 1);
  EXPECT_GT(end_of_last("10 N*m\", stop = \"1 s\""), 0.8);
  EXPECT_GT(end_of_last("10 N*m\""), 2.8);
}

// --- works by period ---

// Every period closes, ΔE = ΣW; together they are the whole run; steady cycles keep their energy.
TEST(WorksByPeriod, CloseAndAddUpToTheRun) {
  const Result r = test::run(test::scene_file("scenes/crank_press.toml"));
  double all = 0, energy = 0;
  const double turned_over = figure(r, "work.driving");
  for (const char* period : {"run_up", "steady_motion"}) {
    const auto of = [&](const char* kind) { return figure(r, std::string("work_of_") + period + "." + kind); };
    EXPECT_NEAR(of("energy"), of("driving") + of("useful") + of("harmful") + of("weight"), 1e-6 * turned_over)
        << period;
    all += of("driving");
    energy += of("energy");
  }
  EXPECT_NEAR(all, turned_over, 1e-9 * turned_over);
  EXPECT_NEAR(energy, r.energy.kinetic_end - r.energy.kinetic_start + r.energy.stored_end - r.energy.stored_start,
              1e-6 * turned_over);
}

// Works of periods by hand: run-up ends and the drive goes off within a cycle; energy there is that at the cycle's begin and
// what was done since. A border whose time is known to 10 ms shifts works by that times the power, though works are known
// within a step of 4 ms beside it alone.
TEST(WorksByPeriod, AreThoseBetweenTheBordersThatAreReported) {
  const auto model = compile(test::scene_file("scenes/driven_slider_crank.toml"), {});
  std::vector<CycleRecord> cycles;
  std::vector<double> before(model->accounts.size(), 0.0);
  const std::size_t drive =
      static_cast<std::size_t>(std::find_if(model->accounts.begin(), model->accounts.end(),
                                            [](const WorkAccount& a) { return a.kind == Account::driving; }) -
                               model->accounts.begin());
  ASSERT_LT(drive, model->accounts.size());
  for (int k = 0; k < 4; ++k) {
    std::vector<double> own(model->accounts.size(), 0.0);
    own[drive] = 10 + k;
    cycles.push_back({.begin = 1.0 * k,
                      .end = 1.0 * (k + 1),
                      .work = own,
                      .work_before = before,
                      .energy_before = 5.0 * k,
                      .energy_after = 5.0 * (k + 1)});
    before[drive] += own[drive];
  }
  before[drive] += 3;
  Periods p;
  p.steady = true, p.run_up_end = 0.5, p.run_down_begin = 3.5, p.run_up_resolution = 0.01;
  const std::vector<WorkPeriod> found = work_periods(
      *model, p, cycles, {.begin = 0, .end = 6, .energy_begin = 0, .energy_end = 1, .work = before}, [](double t) {
        const bool unknown = t < 1 && std::abs(t - 0.5) > 0.004;
        const std::array<double, 4> work = {t < 1 ? 6.0 + 20 * (t - 0.5) : 10 + 11 + 12 + 7.0, 0, 0, 0};
        return unknown ? std::nullopt : std::optional(work);
      });
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].work[0], 6);
  EXPECT_EQ(found[0].energy, 6);
  EXPECT_EQ(found[0].end, 0.5);
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_NEAR(found[k].work_resolution[0], 0.2, 1e-9);
    EXPECT_NEAR(found[k].energy_resolution, 0.2, 1e-9);
  }
  EXPECT_EQ(found[2].energy_resolution, 0);
  EXPECT_EQ(found[1].work[0], 40 - 6);
  EXPECT_EQ(found[1].energy, 15 + 7 - 6);
  EXPECT_EQ(found[1].end, 3.5);
  EXPECT_EQ(found[2].work[0], 6 + 3);
  EXPECT_EQ(found[2].energy, 1 - 22);
  EXPECT_EQ(found[2].residual(), -21 - 9);
}

// --- work within the loop ---

// ∮ p dV of a compressor with clearance, compression and re-expansion alike:
//     W = n/(n−1) p₁ V_s η_v ((p₂/p₁)^((n−1)/n) − 1),   η_v = 1 + ε − ε (p₂/p₁)^(1/n)
TEST(LoopWork, OfACompressorIsTheIndicatedWork) {
  const Result r = test::run(test::scene_file("scenes/compressor.toml"));
  const double n = 1.3, ratio = 8, swept = pi / 4 * 0.16 * 0.16 * 0.11;
  const double volumetric = 1 + 0.05 - 0.05 * std::pow(ratio, 1 / n);
  const double work = n / (n - 1) * 1e5 * swept * volumetric * (std::pow(ratio, (n - 1) / n) - 1);
  EXPECT_NEAR(figure(r, "loop_work.compressor"), -work, 1e-6 * work);
  EXPECT_EQ(figure(r, "loop_work.compressor"), figure(r, "useful_work_per_cycle"));
}

// A model that was stopped before its first whole cycle has no curve over the angle; the other one keeps its own.
TEST(Plots, AreDrawnWhereOneModelOfTwoHasNoWholeCycle) {
  SimulateOptions options;
  options.traces = true;
  options.measure_error = false;
  Scene scene = test::scene_file("scenes/worn_crank_pin.toml");
  const Result whole = simulate(scene, scene.effects, "whole", options);
  scene.run.until = 0.01 * whole.traces->last_cycles.back().end;
  const Result cut = simulate(scene, scene.effects, "cut", options);
  ASSERT_TRUE(cut.traces->last_cycles.empty());
  for (const auto& results : {std::vector{&whole, &cut}, std::vector{&cut, &whole}}) {
    std::size_t over_angle = 0;
    for (const Plot& plot : motion_plots(results)) {
      if (!plot.note.starts_with("Last whole cycle (whole: ")) continue;
      ++over_angle;
      EXPECT_EQ(plot.series.size(), 1u) << plot.title;
      EXPECT_EQ(plot.series.front().name, "whole") << plot.title;
    }
    EXPECT_GT(over_angle, 1u);
    EXPECT_FALSE(machine_view(results).title.empty());
  }
}

// The loop of the page is closed, and its area, by trapezoids, is that work; the tachogram's marks are the periods.
TEST(LoopWork, IsTheAreaOfTheIndicatorDiagram) {
  SimulateOptions options;
  options.traces = true;
  options.measure_error = false;
  for (const char* name : {"compressor", "crank_press"}) {
    const Scene scene = test::scene_file(std::string("scenes/") + name + ".toml");
    const Result r = simulate(scene, scene.effects, "test", options);
    int loops = 0, tachograms = 0;
    for (const Plot& plot : motion_plots({&r})) {
      tachograms += plot.title.starts_with("Tachogram: ");
      if (plot.note.find("Indicator diagram") == std::string::npos) continue;
      ++loops;
      const std::vector<double>&x = plot.series.front().x, &y = plot.series.front().y;
      // mm · kN, or mm · bar on a bore of 160 mm
      const double unit = plot.y.unit == "bar" ? 1e-3 * 1e5 * pi / 4 * 0.16 * 0.16 : 1;
      EXPECT_EQ(plot.y.unit, std::string(name) == "compressor" ? "bar" : "kN");
      double area = 0;
      for (std::size_t i = 1; i < x.size(); ++i) area += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]) * unit;
      EXPECT_NEAR(x.front(), x.back(), 1e-3) << name;
      const double work = figure(r, "useful_work_per_cycle");
      EXPECT_NEAR(std::abs(area), std::abs(work), 0.02 * std::abs(work)) << name;
      if (plot.y.unit == "bar") {
        EXPECT_NE(plot.note.find("= 0.8025."), std::string::npos) << plot.note;
        EXPECT_NEAR(*std::max_element(y.begin(), y.end()), 8, 1e-6);
        EXPECT_NEAR(*std::min_element(y.begin(), y.end()), 1, 1e-6);
      }
    }
    EXPECT_EQ(loops, 1) << name;
    EXPECT_EQ(tachograms, 1) << name;
  }
}

}  // namespace
}  // namespace kurbel::duty_test
