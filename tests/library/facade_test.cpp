// facade_test.cpp — <kurbel/kurbel.h> as its users have it: faults with places, settings, motions, sweeps of functions.
// Elements of one's own are tested by the examples, each in a process of its own.
#include <gtest/gtest.h>
#include <kurbel/kurbel.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/sanitized.h"

namespace kurbel::facade_test {
namespace {

const char* const two_masses = R"(
title    = "Step torque on two masses"
line     = ["rotor", "coupling", "fan"]
rotor    = { kind = "inertia", inertia = "0.2 kg*m2" }
motor    = { kind = "torque source", torque = "50 N*m", on = "rotor" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping = "0 N*m*s/rad" }
fan      = { kind = "inertia", inertia = "1.5 kg*m2" }
effects  = { elasticity = true }
run      = { until = "0.3 s" }
)";
// The undamped step: τ = M J₂/(J₁ + J₂) (1 − cos ω t), ω² = k (1/J₁ + 1/J₂).
double torque_at(double t, double stiffness = 4000) {
  return 50 * 1.5 / 1.7 * (1 - std::cos(std::sqrt(stiffness * (1 / 0.2 + 1 / 1.5)) * t));
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Facade, AFaultOfASceneHasItsPlace) {
  std::string text = two_masses;
  text.replace(text.find("1.5 kg"), 3, "-15");
  try {
    Machine::from_text(text, "two.toml");
    FAIL() << "was read";
  } catch (const BadScene& bad) {
    ASSERT_EQ(bad.faults().size(), 1u);
    EXPECT_EQ(bad.faults()[0].file, "two.toml");
    EXPECT_EQ(bad.faults()[0].line, 7);
    EXPECT_EQ(std::string(bad.what()).substr(0, 11), "two.toml:7:");
  }
  // A file that is not there is one fault, without a line.
  try {
    Machine::from_file("nowhere/two.toml");
    FAIL() << "was read";
  } catch (const BadScene& bad) {
    ASSERT_EQ(bad.faults().size(), 1u);
    EXPECT_EQ(bad.faults()[0].line, 0);
    EXPECT_NE(bad.faults()[0].text.find("no such file"), std::string::npos);
  }
  // For a fault in a setting the setting is reported.
  EXPECT_NE(message_of([] {
              Machine::from_text(two_masses).with({{"fan.inertia", "-1 kg*m2"}});
            }).find("fan.inertia"),
            std::string::npos);
}

TEST(Facade, TheLaterSettingOfAPathHolds) {
  const Machine machine = Machine::from_text(two_masses, "two.toml", {{"coupling.stiffness", "1 kN*m/rad"}});
  const Machine stiff = machine.with({{"coupling.stiffness", "9 kN*m/rad"}});
  Motion soft_motion(machine), stiff_motion(stiff);
  soft_motion.go_to(0.05), stiff_motion.go_to(0.05);
  EXPECT_NEAR(soft_motion["torque.coupling"], torque_at(0.05, 1000), 1e-6);
  EXPECT_NEAR(stiff_motion["torque.coupling"], torque_at(0.05, 9000), 1e-6);
}

TEST(Facade, AColumnOutlivesItsRun) {
  TimeSeries torque, time;
  {
    const kurbel::Run run = kurbel::run(Machine::from_text(two_masses), {.no_error = true, .page = false});
    torque = run.trajectory()["torque.coupling"], time = run.trajectory().time();
  }
  ASSERT_GT(torque.size(), 900u);
  for (std::size_t i = 0; i < torque.size(); i += 7) ASSERT_NEAR(torque[i], torque_at(time[i]), 1e-4);
}

// J₁ ω₁ + J₂ ω₂ = M t, by columns that are requested by their names.
TEST(Facade, AColumnIsThatOfItsName) {
  const kurbel::Run run = kurbel::run(Machine::from_text(two_masses), {.no_error = true, .page = false});
  const TimeSeries rotor = run.trajectory()["speed.rotor"], fan = run.trajectory()["speed.fan"],
                   torque = run.trajectory()["torque.coupling"], time = run.trajectory().time();
  for (std::size_t i = 0; i < time.size(); i += 7) {
    ASSERT_NEAR(0.2 * rotor[i] + 1.5 * fan[i], 50 * time[i], 1e-4);
    ASSERT_NEAR(torque[i], torque_at(time[i]), 1e-4);
  }
  EXPECT_NE(rotor[10], fan[10]);
  EXPECT_THROW(run.trajectory()["speed.fans"], std::out_of_range);
}

// A record of the closed form, given 10 ms late and 3 N·m too high.
TEST(Facade, ARecordIsLaidOverRunAndCycle) {
  const std::string file = testing::TempDir() + "facade_record.csv";
  {
    std::ofstream record(file);
    record << "time [s];T1 [N*m]\n";
    for (int i = 0; i <= 200; ++i) record << i * 1e-3 + 0.01 << ";" << torque_at(i * 1e-3) + 3 << "\n";
  }
  const Machine machine = Machine::from_text(two_masses);
  const std::string map = "T1=torque.coupling";
  const kurbel::Run run =
      kurbel::run(machine, {.no_error = true, .measured = file, .map = {map}, .shift = "-10 ms", .offset = {"T1=fit"}});
  EXPECT_NEAR(run.figures()["measured_offset.torque.coupling"].value, 3, 0.02);
  // What is left: the record's four digits and straight lines between the run's rows.
  EXPECT_LT(run.figures()["residual_rms.torque.coupling"].value, 0.05);
  // What the options lack or the file has wrongly is reported before anything runs.
  EXPECT_NE(message_of([&] { kurbel::run(machine, {.measured = file}); }).find("channel: map \"T1="),
            std::string::npos);
  try {
    kurbel::run(machine, {.measured = file, .map = {"T2=torque.coupling"}});
    FAIL() << "was read";
  } catch (const BadScene& bad) {
    ASSERT_EQ(bad.faults().size(), 1u);
    EXPECT_NE(bad.faults()[0].text.find("T1"), std::string::npos) << bad.what();
  }
  EXPECT_THROW(steady(machine, {{"measured", file}, {"map", "T2=torque.coupling"}}), BadScene);
  std::filesystem::remove(file);
}

TEST(Facade, ARunGoesOnFromAState) {
  const Machine machine = Machine::from_text(two_masses);
  Motion motion(machine);
  motion.go_to(0.1);
  const kurbel::Run run = kurbel::run(machine, {.no_error = true, .page = false, .from_state = motion.state().text()});
  const TimeSeries time = run.trajectory().time(), torque = run.trajectory()["torque.coupling"];
  EXPECT_EQ(time[0], 0.1);
  EXPECT_NEAR(time[time.size() - 1], 0.3, 1e-12);
  for (std::size_t i = 0; i < time.size(); i += 7) ASSERT_NEAR(torque[i], torque_at(time[i]), 1e-4);
  EXPECT_THROW(kurbel::run(Machine::from_text(two_masses), {.effects = "none", .from_state = motion.state().text()}),
               std::invalid_argument);
}

// The rigid machine carries half of what rings: M J₂/(J₁ + J₂) against twice that.
TEST(Facade, FiguresOfAStudyHaveTheirModel) {
  const Study study = compare(Machine::from_text(two_masses), {{"no_error", "true"}, {"no_trials", "true"}});
  std::map<std::string, double> peaks;
  for (const FigureValue& figure : study.figures())
    if (figure.name == "peak_torque.coupling") peaks[figure.of] = figure.value;
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(peaks.at("rigid"), 50 * 1.5 / 1.7, 1e-3);
  EXPECT_NEAR(peaks.at("elastic"), 2 * 50 * 1.5 / 1.7, 1e-3);
  // Trials are made unless they are not wanted, as by the command.
  const Machine damped = Machine::from_text(two_masses).with({{"effects.elasticity", "false"}});
  EXPECT_NE(kurbel::run(damped, {.no_error = true, .no_trials = false}).study().text().find("elasticity"),
            std::string::npos);
}

TEST(Facade, TwoMachinesFigureByFigure) {
  const Machine soft = Machine::from_text(two_masses), stiff = soft.with({{"coupling.stiffness", "16 kN*m/rad"}});
  const Study study = diff(soft, stiff, {{"of", "modes"}});
  // f = √(k (1/J₁ + 1/J₂))/2π: twice as high for four times the stiffness.
  std::vector<double> frequencies;
  for (const FigureValue& figure : study.figures())
    if (figure.name == "natural_frequency.1") frequencies.push_back(figure.value);
  EXPECT_NE(study.json().find("coupling.stiffness"), std::string::npos);
  EXPECT_NE(study.text().find("natural_frequency"), std::string::npos) << study.text();
  const auto frequency = [](const Machine& m) { return answer(m, "modes").figures["natural_frequency.1"].value; };
  EXPECT_NEAR(frequency(stiff) / frequency(soft), 2, 1e-9);
  EXPECT_NEAR(frequency(soft), std::sqrt(4000 * (1 / 0.2 + 1 / 1.5)) / (2 * std::acos(-1.0)), 1e-6);
  // The same by its name: a machine and other values of it.
  EXPECT_EQ(study.json(),
            kurbel::study("diff", soft, {{"other_set", "coupling.stiffness=16 kN*m/rad"}, {"of", "modes"}}).json());
  EXPECT_NE(message_of([&] { diff(soft, stiff, {{"off", "run"}}); }).find("diff has no option"), std::string::npos);
  EXPECT_NE(message_of([&] {
              modes(soft, {{"effects", "none"}, {"effects", "elasticity"}});
            }).find("effects is given 2 times; give one"),
            std::string::npos);
}

// Callers have no command line: an option has its name, and only command lines and quotations have dashes.
TEST(Facade, MessagesNameOptionsAsCallersDo) {
  const Machine machine = Machine::from_text(two_masses);
  const auto said = [&](const std::string& name, const Options& options) {
    return message_of([&] { study(name, machine, options); });
  };
  EXPECT_EQ(said("steady", {{"mid_speed", "3 m"}}).substr(0, 16), "mid_speed \"3 m\":");
  EXPECT_EQ(said("size", {}).find("--"), std::string::npos) << said("size", {});
  EXPECT_NE(said("size", {}).find("Give delta, e.g. delta 0.05"), std::string::npos) << said("size", {});
  EXPECT_EQ(said("size", {{"delta", "0.1"}, {"machine", "press"}}), "delta and machine both given; keep one");
  EXPECT_EQ(said("reduce", {{"to", "--to --here"}}).substr(0, 17), "to \"--to --here\":");
  EXPECT_EQ(said("reduce", {{"positions", "0"}}), "positions \"0\": must be 1 … 100000");
  EXPECT_EQ(message_of([] { rows_of({{"a=1..2"}, "grid:0"}); }).substr(0, 16), "design \"grid:0\":");
  EXPECT_EQ(message_of([] { rows_in("nowhere.db"); }),
            "nowhere.db: no such file; kurbel sweep SCENE … --into nowhere.db makes one");
  try {
    machine.with({{"fan.inertia", "1 m"}});
    FAIL() << "was read";
  } catch (const BadScene& bad) {
    ASSERT_EQ(bad.faults().size(), 1u);
    EXPECT_EQ(bad.faults()[0].file, "set \"fan.inertia=1 m\"");
    EXPECT_EQ(std::string(bad.what()).find("--set"), std::string::npos) << bad.what();
  }
}

TEST(Facade, AMachineIsExportedForOtherTools) {
  const test::ScratchFolder folder;
  const Study exported = study("export", Machine::from_text(two_masses, "two.toml"),
                               {{"fmi", "3"}, {"kind", "both"}, {"input", "fan.torque"}, {"output", "speed.fan"}});
  EXPECT_NE(exported.text().find("1 inputs"), std::string::npos) << exported.text();
  exported.write(folder.string());
  std::ifstream component(folder / "two.fmu", std::ios::binary);
  std::string magic(2, ' ');
  component.read(magic.data(), 2);
  EXPECT_EQ(magic, "PK");
  EXPECT_NE(message_of([] {
              study("export", Machine::from_text(two_masses), {{"fmi", "4"}});
            }).find("fmi"),
            std::string::npos);
}

// 100 runs before, so that pools and tables are filled.
TEST(Facade, AThousandLoadsRunsAndFreesLeakNothing) {
  if (test::sanitized) GTEST_SKIP() << "the sanitizer keeps what is freed, and tells leaks itself";
  const auto resident = [] {  // [MB]
    long pages = 0, all = 0;
    std::ifstream("/proc/self/statm") >> all >> pages;
    return static_cast<double>(pages) * 4096e-6;
  };
  const auto cycle = [] {
    const Machine machine =
        Machine::from_text(two_masses, "two.toml", {{"run.until", "20 ms"}, {"run.samples", "100"}});
    const kurbel::Run run = kurbel::run(machine, {.no_error = true, .page = false});
    EXPECT_GE(run.trajectory().rows(), 100u);  // and rows at peaks
    EXPECT_FALSE(run.study().json().empty());
    Motion motion(machine);
    motion.go_to(1e-3);
    motion.restore(motion.state_from(motion.state().text()));
    EXPECT_EQ(motion.values().size(), motion.names().size());
  };
  for (int i = 0; i < 100; ++i) cycle();
  const double before = resident();
  for (int i = 0; i < 1000; ++i) cycle();
  EXPECT_LT(resident() - before, 2);
}

TEST(Facade, AMotionGoesBackAndOnToTheLastBit) {
  const Machine machine = Machine::from_text(two_masses);
  Motion motion(machine);
  motion.go_to(0.1);
  EXPECT_NEAR(motion["torque.coupling"], torque_at(0.1), 1e-6);
  const SavedState kept = motion.state();
  motion.go_to(0.2);
  const SavedState end = motion.state();
  EXPECT_FALSE(kept == end);
  Motion other(machine);
  other.restore(other.state_from(kept.text()));
  EXPECT_EQ(other.time(), 0.1);
  EXPECT_NEAR(other["torque.coupling"], torque_at(0.1), 1e-6);
  other.go_to(0.2);
  EXPECT_TRUE(other.state() == end);
  EXPECT_THROW(other.go_to(0.1), std::invalid_argument);
  // The text of another machine is none of this one.
  EXPECT_THROW(Motion(machine, "none").restore(kept), std::invalid_argument);
}

TEST(Facade, AMotionThatIsInterruptedStandsWhereItStood) {
  const Machine machine = Machine::from_text(two_masses);
  Motion motion(machine), other(machine);
  motion.go_to(0.1);
  const SavedState kept = motion.state();
  // At work for ever, were it not for the third word on its progress, which comes with 64 steps each.
  std::atomic<bool> interrupted{false};
  std::vector<double> reported;
  const Watcher watcher{&interrupted, [&](const std::string&, double fraction) {
                          reported.push_back(fraction);
                          interrupted = reported.size() == 3;
                        }};
  EXPECT_NE(message_of([&] { motion.go_to(1e6, watcher); }).find("interrupted"), std::string::npos);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_TRUE(0 < reported[0] && reported[0] < reported[1] && reported[1] < reported[2] && reported[2] < 1e-3)
      << reported[0];
  EXPECT_TRUE(motion.state() == kept);
  // And goes on as if nothing had been.
  motion.go_to(0.2);
  other.restore(kept);
  other.go_to(0.2);
  EXPECT_TRUE(motion.state() == other.state());
  EXPECT_NEAR(motion["torque.coupling"], torque_at(0.2), 1e-6);
}

TEST(Facade, WhatAStudyDoesNotAskForIsRefusedWithWhatItHas) {
  const Machine machine = Machine::from_text(two_masses);
  EXPECT_NE(message_of([&] {
              steady(machine, {{"mid_sped", "60 rpm"}});
            }).find("did you mean \"mid_speed\""),
            std::string::npos);
  EXPECT_NE(message_of([&] { study("stedy", machine); }).find("did you mean \"steady\""), std::string::npos);
  EXPECT_NE(message_of([&] {
              kurbel::run(machine, {.no_error = true}).figures()["peak_torque.couplin"];
            }).find("did you mean \"peak_torque.coupling\""),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              steady(machine, {{"mid_speed", "60 rpm"}, {"mid_speed", "70 rpm"}});
            }).find("mid_speed is given 2 times"),
            std::string::npos);
  EXPECT_FALSE(modes(machine).conclusion().empty());
}

// Names that a line of the command begins with: "--mid-speed" is mid_speed.
std::set<std::string> options_of_command(const std::string& command) {
  std::set<std::string> names;
  std::istringstream lines(test::said_by_program("commands " + command).text);
  for (std::string name; std::getline(lines, name);) {
    if (!name.starts_with("--")) continue;
    std::replace(name.begin() + 2, name.end(), '-', '_');
    names.insert(name.substr(2));
  }
  return names;
}

TEST(Facade, AStudyHasTheOptionsOfItsCommand) {
  // Where results go and how they are shown, which a program has by itself (Study::write, json, html, text, Watcher), and a
  // scene's settings and data files.
  const std::set<std::string> of_all = {"all",      "allow_files", "author", "brand", "format", "help", "json",
                                        "no_files", "open",        "out",    "plots", "quiet",  "set",  "verbose"};
  for (const std::string& study : study_names()) {
    std::set<std::string> command = options_of_command(study);
    ASSERT_GT(command.size(), study == "merge" ? 1 : of_all.size() - 3) << study;
    for (const std::string& name : of_all) command.erase(name);
    const std::vector<std::string> there = option_names(study);
    if (study == "diff") command.insert("other");  // by its place
    if (study == "merge") command.insert("files");
    EXPECT_EQ(std::set<std::string>(there.begin(), there.end()), command) << study;
  }
}

TEST(Facade, APairOfGearsNeedsNoMachine) {
  const Study pair = gears({{"teeth", "31"}, {"teeth", "30"}, {"module", "3.5 mm"}, {"shift", "0.291"}});
  EXPECT_NE(pair.json().find("\"shift\""), std::string::npos) << pair.json();
  EXPECT_NE(study("effects", Options{}).text().find("elasticity — "), std::string::npos);
  EXPECT_NE(message_of([] { gears({{"teeth", "19,95"}}); }).find("teeth needs module"), std::string::npos);
  EXPECT_NE(message_of([] { study("modes", Options{}); }).find("modes needs a machine"), std::string::npos);
  const Machine machine = Machine::from_text(example_scene("press"));
  EXPECT_NE(message_of([&] {
              gears(machine, {{"bore", "20 mm, 20 mm"}});
            }).find("bore belongs to a pair alone"),
            std::string::npos);
}

TEST(Facade, WordsAreThoseOfTheCommands) {
  EXPECT_NE(explain("delta").find("(ω_max − ω_min)"), std::string::npos);
  EXPECT_NE(message_of([] { explain("detla"); }).find("did you mean"), std::string::npos);
  EXPECT_NE(keys("coupling").find("damping_ratio"), std::string::npos);
  EXPECT_NE(message_of([] { keys("couplin"); }).find("did you mean \"coupling\""), std::string::npos);
  EXPECT_NE(message_of([] { example_scene("pres"); }).find("did you mean \"press\""), std::string::npos);
  for (const std::string& name : explained_figures()) EXPECT_FALSE(explain(name).empty()) << name;
  for (const std::string& kind : kinds()) EXPECT_FALSE(keys(kind).empty()) << kind;
  for (const std::string& name : example_scenes())
    EXPECT_FALSE(Machine::from_text(example_scene(name)).figures().empty()) << name;
  EXPECT_NE(schema().find("2020-12"), std::string::npos);
}

TEST(Facade, ASweepOfAFunctionKeepsItsRowsAndSaysWhatFailed) {
  const std::string file = testing::TempDir() + "facade_sweep.db";
  std::filesystem::remove(file);
  const Variation variation{.vary = {"x=1..5", "y=10,20"}, .design = "grid:5x2"};
  std::atomic<int> calls{0};
  const auto product = [&](const std::vector<double>& at) {
    ++calls;
    if (at[0] == 3) throw std::runtime_error("three is not computed");
    return std::vector<double>{at[0] * at[1]};
  };
  const SweepRows rows = sweep(variation, "product", {{"product", ""}}, product, {.into = file, .jobs = 2});
  ASSERT_EQ(rows.lines.size(), 10u);
  EXPECT_TRUE(rows.complete);
  for (const SweepLine& line : rows.lines) {
    if (line.parameters[0] == 3) {
      EXPECT_EQ(line.state, "failed");
      EXPECT_EQ(line.diagnosis, "three is not computed");
      EXPECT_FALSE(line.figures[0].has_value());
    } else {
      EXPECT_EQ(line.figures[0], line.parameters[0] * line.parameters[1]);
    }
  }
  EXPECT_EQ(sweep(variation, "product", {{"product", ""}}, product, {.into = file}).computed, 0u);
  EXPECT_EQ(calls, 10);
  // However many there are, they can be had one by one.
  EXPECT_TRUE(sweep(variation, "product", {{"product", ""}}, product, {.into = file, .lines = false}).lines.empty());
  std::size_t visited = 0;
  const SweepRows reported = rows_in(file, [&](const SweepLine& line) {
    EXPECT_EQ(line.row, visited++);
    EXPECT_EQ(line.figures[0], rows.lines[line.row].figures[0]);
  });
  EXPECT_EQ(visited, 10u);
  EXPECT_TRUE(reported.complete && reported.lines.empty());
  EXPECT_EQ(reported.vary, variation.vary);
  EXPECT_EQ(rows_in(file).lines.size(), 10u);
  const Study report = sweep_report(file, {"product <= 25"});
  EXPECT_NE(report.text().find("three is not computed"), std::string::npos) << report.text();
  EXPECT_THROW(sweep_report(file, {"sum <= 25"}), std::invalid_argument);
  EXPECT_THROW(rows_in(testing::TempDir() + "nowhere.db"), std::invalid_argument);
  // Shards that others computed make one file.
  std::vector<std::string> shards;
  for (const char* shard : {"1/2", "2/2"}) {
    shards.push_back(file + "." + shard[0]);
    std::filesystem::remove(shards.back());
    sweep(variation, "product", {{"product", ""}}, product, {.into = shards.back(), .jobs = 1, .shard = shard});
  }
  const std::string whole = file + ".all";
  std::filesystem::remove(whole);
  EXPECT_EQ(merge(shards, whole), 10u);
  EXPECT_EQ(rows_in(whole).lines[7].figures, rows.lines[7].figures);
  for (const std::string& made : {shards[0], shards[1], whole}) std::filesystem::remove(made);
  // A file holds the rows of one question.
  EXPECT_THROW(sweep(variation, "sum", {{"product", ""}}, product, {.into = file}), std::invalid_argument);
  std::filesystem::remove(file);
}

}  // namespace kurbel::facade_test
