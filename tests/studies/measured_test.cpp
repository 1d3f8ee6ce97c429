// measured_test.cpp — a record made of the machine's own motion gives back what was done to it: shift, offset, noise.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "engine/scene/messages.h"
#include "studies/findings/trace.h"
#include "studies/measured/overlay.h"
#include "studies/report/render.h"
#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "studies/steady/steady.h"
#include "studies/tables/trajectory_rows.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::test::measured_test {
namespace {

namespace fs = std::filesystem;

class Measured : public testing::Test {
 protected:
  std::string file(const std::string& text) const {
    const std::string path = (folder_ / "test.csv").string();
    std::ofstream(path) << text;
    return path;
  }
  const ScratchFolder folder_;
};

// Two masses under a step of torque M: M (1 − cos Ω t) J₂/(J₁ + J₂) in the shaft, with some damping.
Result ringing(int samples = 1001) {
  const Scene scene = scene_from(fmt::format(
      "line = [\"a\", \"shaft\", \"b\"]\na = {{ kind = \"load\", torque = \"-10 N*m\", acts = \"always\", inertia = "
      "\"1 "
      "kg*m2\" }}\nshaft = {{ kind = \"shaft\", stiffness = \"400 N*m/rad\", damping = \"3 N*m*s/rad\" }}\nb = {{ kind "
      "= "
      "\"flywheel\", inertia = \"3 kg*m2\" }}\n[effects]\nelasticity = true\n[run]\nstart = {{ speed = \"1 rad/s\" "
      "}}\nuntil = \"1 s\"\nsamples = {}\n",
      samples));
  SimulateOptions options;
  options.traces = true, options.measure_error = false;
  return simulate(compile(scene, scene.effects), "elastic", options);
}

const std::vector<KnownChannel> two = {{"torque.shaft", "N*m"}, {"speed.b", "rad/s"}};

std::string said_of(const std::string& path, const MeasurementRequest& request) {
  MeasurementRequest asked = request;
  asked.file = path;
  try {
    read_measurement(asked, two);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

// --- what is left ---

TEST_F(Measured, ARunsOwnTrajectoryLeavesNothing) {
  Result r = ringing();
  const std::string path = file(csv_text(trajectory_data(r)));
  const Measurement m =
      read_measurement({path, {"torque.shaft=torque.shaft", "speed.b=speed.b"}, "", {}}, channels_of_run(*r.model));
  const Overlay o = lay_over(m, r);
  ASSERT_EQ(o.models.size(), 1u);
  for (const Residuals& left : o.models[0].alignment.signals) {
    EXPECT_EQ(left.time.size(), rows_of(*r.trajectory).time.size());
    EXPECT_EQ(left.rms, 0);
    EXPECT_EQ(left.largest, 0);
  }
  EXPECT_EQ(r.find("residual_rms.torque.shaft")->value, 0);
}

// Its own torque in another unit, 37.5 ms late and 2 N·m too high, sampled anew, with noise of 0.05 N·m. By least
// squares of n points the offset is sure to σ/√n, the shift to σ/√(n mean(ṡ²)).
TEST_F(Measured, ShiftOffsetAndNoiseAreFoundAgain) {
  Result r = ringing();
  const TrajectoryRows rows = rows_of(*r.trajectory);
  std::size_t k = 0;
  while (r.trajectory->channels()[k].name.text != "torque.shaft") ++k;
  std::vector<double> torque;
  for (std::size_t i = 0; i < rows.time.size(); ++i)
    torque.push_back(rows.values[i * r.trajectory->channels().size() + k]);
  const Signal exact(rows.time, torque);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.05);
  std::string text = "t [ms];T1 [kN*m]\n";
  int n = 0;
  double slopes = 0;
  for (double t = 0.1; t < 0.9; t += 1.7e-3, ++n) {
    text += fmt::format("{};{}\n", 1e3 * (t + 0.0375), 1e-3 * (exact.at(t) + 2 + noise(random)));
    slopes += std::pow(exact.slope(t), 2);
  }
  const Measurement m = read_measurement({file(text), {"T1=torque.shaft"}, "fit", {"fit"}}, channels_of_run(*r.model));
  const Overlay o = lay_over(m, r);
  const Alignment& a = o.models.at(0).alignment;
  const double shift_sigma = 0.05 / std::sqrt(slopes), offset_sigma = 0.05 / std::sqrt(n);
  EXPECT_NEAR(a.shift.value, -0.0375, 3 * shift_sigma);
  EXPECT_NEAR(*a.shift.error, 2 * shift_sigma, 0.2 * shift_sigma);
  EXPECT_NEAR(a.signals[0].offset.value, 2, 3 * offset_sigma);
  EXPECT_NEAR(*a.signals[0].offset.error, 2 * offset_sigma, 0.2 * offset_sigma);
  EXPECT_NEAR(a.signals[0].rms, 0.05, 0.05 * 4 / std::sqrt(2 * n));
  EXPECT_NEAR(a.signals[0].mean, 0, 1e-12);
  EXPECT_LT(shift_sigma, 1e-4) << "or the test proves nothing";

  // The same, given: what is left is the same.
  const Overlay given = lay_over(
      read_measurement({file(text), {"T1=torque.shaft"}, "-37.5 ms", {"T1=2 N*m"}}, channels_of_run(*r.model)), r);
  EXPECT_NEAR(given.models.at(0).alignment.signals[0].rms, a.signals[0].rms, 1e-3);
  EXPECT_FALSE(given.models[0].alignment.shift.error);
  // And neither: the offset stays, as mean and in the largest residual.
  const Overlay none =
      lay_over(read_measurement({file(text), {"T1=torque.shaft"}, "-37.5 ms", {}}, channels_of_run(*r.model)), r);
  EXPECT_NEAR(none.models.at(0).alignment.signals[0].mean, 2, 3 * offset_sigma);
}

// A sine against itself: every period is as good a shift; the smallest is taken. Closed forms: r = A − 0 offset.
TEST(Alignment, OfWhatRepeatsTheSmallestShiftIsTaken) {
  const double omega = 2 * std::numbers::pi;  // one period a second
  std::vector<double> t, s;
  for (int i = 0; i <= 4000; ++i) t.push_back(i * 1e-3), s.push_back(std::sin(omega * t.back()));
  Measurement m{.file = "", .time = {}, .shift = {0, true}, .signals = {{"a", "a", "", {}}}};
  for (int i = 0; i < 2000; ++i) {
    m.time.push_back(1 + i * 1e-3);
    m.signals[0].values.push_back(std::sin(omega * (m.time.back() + 0.2)));
  }
  const auto a = align(m, {Signal(t, s)});
  ASSERT_TRUE(a);
  EXPECT_NEAR(a->shift.value, 0.2, 1e-6);
  EXPECT_LT(a->signals[0].rms, 1e-5);
  // Over one period, repeated: the same shift, the record as long as it is, all of it compared.
  const std::vector<double> one(t.begin(), t.begin() + 1001), cycle(s.begin(), s.begin() + 1001);
  const auto folded = align(m, {Signal(one, cycle, 1.0)});
  ASSERT_TRUE(folded);
  EXPECT_NEAR(folded->shift.value, 0.2, 1e-6);
  EXPECT_EQ(folded->signals[0].time.size(), 2000u);
  // Without a shift: r = sin(x + φ) − sin x, rms √2 |sin(φ/2)|… of a difference of two sines, 2 sin(φ/2) cos(…).
  m.shift = {};
  const auto unshifted = align(m, {Signal(one, cycle, 1.0)});
  EXPECT_NEAR(unshifted->signals[0].rms, std::sqrt(2) * std::sin(0.1 * omega), 1e-4);
  EXPECT_NEAR(std::abs(unshifted->signals[0].largest), 2 * std::sin(0.1 * omega), 1e-4);
  EXPECT_NEAR(*unshifted->signals[0].relative, std::sqrt(2) * std::sin(0.1 * omega) / 2, 1e-4);
  // What does not vary has no shift.
  m.shift = {0, true};
  EXPECT_FALSE(align(m, {Signal({0, 4}, {1, 1})}));
}

// Three turns of the press's steady cycle, recorded from another moment on: its phase is found, and stated in the page.
TEST_F(Measured, ASteadyCycleTakesTheTimeModuloItsPeriod) {
  const Scene scene = scene_file("scenes/crank_press.toml");
  SteadyOptions options;
  options.traces = true, options.start_search = false;
  SteadyStudy study = steady(scene, {scene.effects}, options);
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles.front();
  // Recorded by a run from the cycle's traces: its torque over time, late by a fifth of a period.
  const Trace* trace = c.traces->find("torque.main_coupling");
  const double period = c.cycle_time, begin = c.traces->last_cycles.back().end - period;
  const Signal exact(trace->x, trace->y);
  std::string text = "time [s],T [N*m]\n";
  for (int i = 0; i < 900; ++i) {
    const double t = 3 * period * i / 900;
    const double phase = t / period - std::floor(t / period);
    text += fmt::format("{},{}\n", t + 0.2 * period, exact.at(begin + phase * period));
  }
  const Measurement m =
      read_measurement({file(text), {"T=torque.main_coupling"}, "fit", {}}, channels_of_cycle(*c.model));
  const Overlay o = lay_over(m, study);
  ASSERT_EQ(o.models.size(), 1u);
  EXPECT_NEAR(o.models[0].alignment.shift.value, -0.2 * period, 1e-5 * period);
  EXPECT_LT(*o.models[0].alignment.signals[0].relative, 1e-5);
  EXPECT_EQ(o.models[0].alignment.signals[0].time.size(), 900u);
  EXPECT_TRUE(study.cycles.front().find("residual_rms.torque.main_coupling"));
  Findings f = findings_of(study);
  show(f, o);
  const StudyOutput output{std::move(f)};
  const auto reported = nlohmann::json::parse(output.json()).at("measured").at("models").at(0);
  EXPECT_NEAR(reported.at("shift").get<double>(), -0.2 * period, 1e-5 * period);
  int measured = 0;
  for (const ReportSection& section : output.report().sections)
    for (const Card& card : section.cards)
      if (const Plot* plot = std::get_if<Plot>(&card))
        for (const Series& series : plot->series) measured += series.name == "measured";
  EXPECT_EQ(measured, 2) << "over the angle among the cycle's plots, and over time";
  for (const NamedTable& named : output.tables) EXPECT_EQ(csv_text(named.table()).find("measured"), std::string::npos);
}

// In the run's own plots, in its figures, in JSON, on the terminal in short and at length.
TEST_F(Measured, ARunReportsItEverywhere) {
  Result r = ringing(101);
  const std::string path = file("time [s],T1 [N*m]\n0,1\n0.1,2\n0.2,3\n0.3,2\n");
  const Overlay o = lay_over(read_measurement({path, {"T1=torque.shaft"}, "", {}}, channels_of_run(*r.model)), r);
  Findings f = findings_of(r);
  show(f, o);
  const StudyOutput output{std::move(f)};
  EXPECT_NE(brief_text(output).find("measured − simulated, torque.shaft: rms "), std::string::npos)
      << brief_text(output);
  EXPECT_NE(output.text().find("T1 → torque.shaft"), std::string::npos);
  const auto j = nlohmann::json::parse(output.json());
  EXPECT_EQ(j.at("measured").at("models").at(0).at("signals").at(0).at("points"), 4);
  int measured = 0;
  for (const ReportSection& section : output.report().sections)
    for (const Card& card : section.cards)
      if (const Plot* plot = std::get_if<Plot>(&card))
        for (const Series& series : plot->series)
          if (series.name == "measured") {
            ++measured;
            EXPECT_TRUE(series.dashed);
            EXPECT_EQ(series.x.size(), 4u);
          }
  EXPECT_EQ(measured, 2) << "in the plot of the torque, and in the measurement's chapter";
  EXPECT_NE(html_of(output.report()).find("Against the measurement"), std::string::npos);
}

// --- what is wrong with it: place, what, what would be right ---

TEST_F(Measured, FaultsAreReportedAtTheirPlaces) {
  const std::string good = "time [s],T1 [N*m],w [rpm]\n0,1,2\n1,2,3\n2,3,4\n3,4,5\n";
  const std::string path = file(good);
  const struct {
    std::string text;
    MeasurementRequest request;
    std::string said;
  } bad[] = {
      {good, {"", {"T2=torque.shaft"}, "", {}}, path + ":1:1: no column \"T2\""},
      {good, {"", {"T2=torque.shaft"}, "", {}}, "columns: \"time\", \"T1\", \"w\"; did you mean \"T1\"?"},
      {good,
       {"", {"T1=torque.shafd"}, "", {}},
       "--map \"T1=torque.shafd\":1:4: no channel \"torque.shafd\" is recorded; "
       "did you mean \"torque.shaft\"?"},
      {good, {"", {"T1=x"}, "", {}}, "there are \"torque.shaft\", \"speed.b\""},
      {good, {"", {"T1"}, "", {}}, "--map \"T1\": must be COLUMN=…"},
      {good,
       {"", {"T1=speed.b"}, "", {}},
       path + ":1:10: unit [N*m] of column \"T1 [N*m]\" is a torque or energy (N·m), "
              "but speed.b is"},
      {good, {"", {"T1=torque.shaft [kN*m]"}, "", {}}, "leave one of them out"},
      {good, {"", {"T1=torque.shaft"}, "2 m", {}}, "--shift \"2 m\":1:1: \"2 m\" is a length (m); must be a time (s)"},
      {good, {"", {"T1=torque.shaft"}, "", {"T3=fit"}}, "no column \"T3\" is mapped; mapped: \"T1\""},
      {good, {"", {"T1=torque.shaft"}, "", {"T1=1 rad"}}, "must be a torque or energy (N·m)"},
      {good, {"", {}, "", {}}, "say which column is which channel"},
      {"time [s],T1\n0,1\n",
       {"", {"T1=torque.shaft"}, "", {}},
       path + ":1:10: column \"T1\" has no unit; write \"T1 "
              "[N*m]\""},
      {"time [s],T1 [Nn]\n0,1\n", {"", {"T1=torque.shaft"}, "", {}}, path + ":1:10: unit [Nn] of column"},
      {"x [s],T1 [N*m]\n0,1\n",
       {"", {"T1=torque.shaft"}, "", {}},
       "no column \"time\" or \"t\"; columns: \"x\", \"T1\""},
      {"time,T1 [N*m]\n0,1\n", {"", {"T1=torque.shaft"}, "", {}}, path + ":1:1: column \"time\" has no unit"},
      {"time [s],T1 [N*m]\n0,1\n1,2\n 1,3\n2,4\n", {"", {"T1=torque.shaft"}, "", {}}, path + ":4:2: time 1 after 1: "},
      {"time [s],T1 [N*m]\n0,1\n1,2\n2,x\n3,4\n", {"", {"T1=torque.shaft"}, "", {}}, path + ":4:3: \"x\" is not a "},
      {"time [s],T1 [N*m]\n0,1\n1,2\n", {"", {"T1=torque.shaft"}, "", {}}, "2 rows; at least 4 are needed"},
  };
  for (const auto& fault : bad) {
    const std::string said = said_of(file(fault.text), fault.request);
    EXPECT_NE(said.find(fault.said), std::string::npos) << said << "\n  wanted: " << fault.said;
  }
  EXPECT_EQ(said_of(file(good), {"", {"T1=torque.shaft", "w=speed.b"}, "1 ms", {"w=2 rpm"}}), "nothing");
  EXPECT_EQ(said_of(file("x;T1\n0;1\n1;2\n2;3\n3;4\n"), {"", {"x=time [ms]", "T1=torque.shaft [kN*m]"}, "", {}}),
            "nothing");
}

TEST_F(Measured, UnitsOfHeadingsAndOptionsAreConvertedToSi) {
  const std::string path = file("x;T1;w [rpm]\n0;1;60\n1;2;60\n2;3;60\n3;4;30\n");
  const Measurement m =
      read_measurement({path, {"x=time [ms]", "T1=torque.shaft [kN*m]", "w=speed.b"}, "1 ms", {"w=3 rpm"}}, two);
  EXPECT_EQ(m.time[3], 3e-3);
  EXPECT_EQ(m.signals[0].values[1], 2000);
  EXPECT_NEAR(m.signals[1].values[0], 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(m.shift.value, 1e-3);
  EXPECT_NEAR(m.signals[1].offset.value, std::numbers::pi / 10, 1e-12);
  EXPECT_NO_THROW(require_overlap(m, 0, 1));
  try {
    require_overlap(m, 5, 6);
    FAIL() << "no time in common";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("no time in common; give --shift \"5 s\""), std::string::npos)
        << error.what();
  }
}

// Rows of which a mapped column has no number are omitted and counted; other columns do not matter.
TEST_F(Measured, RowsWithoutANumberAreLeftOut) {
  const std::string path =
      file("time [s];T1 [N*m];w [rpm]\n0;1,5;2\n1;;3\n2;3,5;NaN\n3;4,5;---\n4;5,5;6\n5;6,5;7\n6;7,5\n");
  const Measurement torque = read_measurement({path, {"T1=torque.shaft"}, "", {}}, two);
  EXPECT_EQ(torque.time, (std::vector<double>{0, 2, 3, 4, 5, 6}));
  EXPECT_EQ(torque.gaps(), "1 of 7 rows of " + path + " are omitted: no number in a column that is mapped");
  MeasurementRequest both = {path, {"T1=torque.shaft", "w=speed.b"}, "", {}};
  both.fewest_rows = 3;
  EXPECT_EQ(read_measurement(both, two).signals[0].values, (std::vector<double>{1.5, 5.5, 6.5}));
  EXPECT_NE(said_of(path, {"", {"T1=torque.shaft", "w=speed.b"}, "", {}}).find("4 more lack a number"),
            std::string::npos);
  EXPECT_EQ(
      read_measurement({file("time [s],T1 [N*m]\n0,1\n1,2\n2,3\n3,4\n"), {"T1=torque.shaft"}, "", {}}, two).gaps(), "");
}

// One unit, written twice in different ways, is no contradiction; one that the heading has and nobody knows gives way.
TEST_F(Measured, TheUnitOfAMapGivesWayToNone) {
  const auto speed_of = [&](const std::string& heading, const std::string& map) {
    return read_measurement({file("time [s];" + heading + "\n0;60\n1;60\n2;60\n3;30\n"), {map}, "", {}}, two)
        .signals.at(0)
        .values.at(0);
  };
  for (const char* heading : {"n [rpm]", "n (U/min)", "n [1/min]", "n [min-1]", "n [Umdr]", "n"})
    for (const char* unit : {"rpm", "U/min", "min-1"})
      EXPECT_NEAR(speed_of(heading, fmt::format("n=speed.b [{}]", unit)), 2 * std::numbers::pi, 1e-12)
          << heading << unit;
  EXPECT_NEAR(speed_of("Drehzahl n (U/min)", "Drehzahl n=speed.b"), 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(speed_of("T1 [N·m]", "T1=torque.shaft [N*m]"), 60);
  EXPECT_NE(said_of(file("time [s];n [rpm]\n0;1\n"), {"", {"n=speed.b [Hz]"}, "", {}}).find("leave one of them out"),
            std::string::npos);
}

// Over the link's angle, three times around, late by 0.3 rad: as over time.
TEST_F(Measured, ASteadyCycleTakesTheAngleOfItsLink) {
  const Scene scene = scene_file("scenes/crank_press.toml");
  SteadyOptions options;
  options.traces = true, options.start_search = false;
  SteadyStudy study = steady(scene, {scene.effects}, options);
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles.front();
  const auto& last = c.traces->last_cycles.back();
  const Trace* found = nullptr;
  for (const Trace& trace : last.traces)
    if (trace.name == "torque.main_coupling") found = &trace;
  ASSERT_TRUE(found);
  std::string text = "angle [deg],T [N*m]\n";
  const Signal exact(found->x, found->y);
  for (int i = 1; i < 900; ++i) {
    const double angle = 3 * c.model->cycle * i / 900, in_cycle = std::fmod(angle, c.model->cycle);
    if (in_cycle < exact.begin() || in_cycle > exact.end()) continue;
    text += fmt::format("{},{}\n", (angle - 0.3) * 180 / std::numbers::pi, exact.at(in_cycle));
  }
  MeasurementRequest request{file(text), {"T=torque.main_coupling"}, "0.3 rad", {}};
  request.over = "angle", request.over_unit = "rad";
  const Overlay o = lay_over(read_measurement(request, channels_of_cycle(*c.model)), study);
  ASSERT_EQ(o.models.size(), 1u) << (o.notes.empty() ? "" : o.notes.front());
  EXPECT_LT(*o.models[0].alignment.signals[0].relative, 1e-3);
}

}  // namespace
}  // namespace kurbel::test::measured_test
