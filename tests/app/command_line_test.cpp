// command_line_test.cpp — the program as its users meet it: exit codes, messages, files, Ctrl-C.
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace kurbel::command_line_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

using test::Ended;
using test::text_of;

class CommandLine : public test::ProgramTest {
 protected:
  // The program on a terminal of its own; what it shows is all of its output.
  std::string on_terminal(const std::vector<std::string>& arguments, bool no_colour = false) {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      if (chdir(folder_.path.c_str()) != 0) _exit(99);
      setenv("TERM", "xterm", 1);
      no_colour ? setenv("NO_COLOR", "1", 1) : unsetenv("NO_COLOR");
      test::become_program(arguments);
    }
    std::string shown;
    char piece[4096];
    for (ssize_t n; (n = read(terminal, piece, sizeof piece)) > 0;) shown.append(piece, static_cast<std::size_t>(n));
    waitpid(child, nullptr, 0);
    close(terminal);
    return shown;
  }

  std::string scene(const std::string& run, const std::string& inertia = "\"1 kg*m2\"") {
    std::ofstream(folder_ / "scene.toml")
        << "line = [\"motor\", \"coupling\", \"fan\"]\n"
           "[motor]\nkind = \"dc shunt motor\"\nstall_torque = \"60 N*m\"\nno_load_speed = \"40 rad/s\"\ninertia = "
        << inertia
        << "\n[coupling]\nkind = \"coupling\"\nstiffness = \"4 kN*m/rad\"\ndamping = \"2 N*m*s/rad\"\n"
           "[fan]\nkind = \"load\"\nquadratic = \"0.02 N*m*s2/rad2\"\ninertia = \"0.6 kg*m2\"\n"
           // A pulsation: without one the steps would grow without limit.
           "[pulse]\nkind = \"torque source\"\namplitude = \"5 N*m\"\nfrequency = \"5 Hz\"\non = \"fan\"\n"
           "[effects]\nelasticity = true\n[run]\n"
        << run;
    return "scene.toml";
  }
  bool file(const std::string& name) const { return fs::exists(folder_ / name); }
};

TEST_F(CommandLine, ValidRunEndsWithZeroAndWritesItsFiles) {
  const Ended r = kurbel({"run", scene("until = \"1 s\"\n"), "--out", "out"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(r.err.empty()) << r.err;
  EXPECT_TRUE(file("out/summary.json"));
  EXPECT_TRUE(file("out/trajectory.csv"));
}

// A test's record: what is left of the run's own trajectory is nothing; what is wrong with it is reported before a run.
TEST_F(CommandLine, AMeasurementIsLaidOverARunOrRefused) {
  const std::string text = scene("until = \"0.3 s\"\n");
  ASSERT_EQ(kurbel({"run", text, "--no-error", "--no-trials", "--out", "out", "--format", "csv,xlsx"}).code, 0);
  EXPECT_TRUE(file("out/results.xlsx"));
  const std::vector<std::string> with = {"run",        text,         "--no-error",        "--no-trials",
                                         "--no-files", "--measured", "out/trajectory.csv"};
  const auto asked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), with.begin(), with.end());
    return kurbel(more);
  };
  const Ended own = asked({"--map", "torque.coupling=torque.coupling", "--json"});
  EXPECT_EQ(own.code, 0) << own.err;
  EXPECT_EQ(nlohmann::json::parse(own.out)["measured"]["models"][0]["signals"][0]["rms"], 0);
  const std::pair<std::vector<std::string>, std::string> bad[] = {
      {{"--map", "torque.coupling=torque.couplin"}, "did you mean \"torque.coupling\"?"},
      {{"--map", "torque=torque.coupling"}, "out/trajectory.csv:1:1: no column \"torque\""},
      {{"--map", "torque.coupling=torque.coupling", "--shift", "5 s"}, "no time in common"},
      {{}, "say which column is which channel"},
  };
  for (const auto& [more, said] : bad) {
    const Ended refused = asked(more);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(said), std::string::npos) << refused.err;
  }
  EXPECT_NE(kurbel({"run", text, "--format", "ods"}).err.find("allowed: csv, mat, xlsx"), std::string::npos);
}

// The ends of a range as one word or as two, before the scene and after it.
TEST_F(CommandLine, ARangeIsReadAsItIsWritten) {
  const std::string text = scene("until = \"1 s\"\n");
  const auto bands = [&](const std::vector<std::string>& words) {
    const Ended r = kurbel(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return r.code == 0 ? nlohmann::json::parse(r.out)["response"] : nlohmann::json();
  };
  const nlohmann::json wanted = bands({"modes", text, "--json", "--no-files", "--range", "20 rpm", "200 rpm"});
  ASSERT_FALSE(wanted.empty());
  EXPECT_EQ(bands({"modes", "--range", "20..200 rpm", text, "--json", "--no-files"}), wanted);
  EXPECT_EQ(bands({"modes", text, "--range", "20 rpm .. 200 rpm", "--json", "--no-files"}), wanted);
  EXPECT_EQ(kurbel({"modes", text, "--range", "20..200"}).code, 2);
}

// What is set beside a scene does what the same in the file does, is shown, and its faults are placed, however late.
TEST_F(CommandLine, SettingsBesideASceneAreReadShownAndPlaced) {
  const std::string text = scene("until = \"1 s\"\n");
  const auto figures = [](const Ended& r) { return nlohmann::json::parse(r.out)["figures"]; };
  const Ended set = kurbel({"run", text, "--json", "--no-files", "--no-error", "--set", "coupling.damping=5 N*m*s/rad",
                            "--set", "fan.inertia=0.9 kg*m2"});
  ASSERT_EQ(set.code, 0) << set.err;
  const nlohmann::json shown = nlohmann::json::parse(set.out);
  EXPECT_EQ(shown["set"], (std::vector<std::string>{"coupling.damping=5 N*m*s/rad", "fan.inertia=0.9 kg*m2"}));
  EXPECT_EQ(shown["title"], "scene.toml with coupling.damping=5 N*m*s/rad, fan.inertia=0.9 kg*m2");
  std::string edited = text_of(folder_ / text);
  edited.replace(edited.find("2 N*m*s/rad\""), 1, "5");
  edited.replace(edited.find("0.6 kg*m2"), 3, "0.9");
  std::ofstream(folder_ / "edited.toml") << edited;
  EXPECT_EQ(figures(set), figures(kurbel({"run", "edited.toml", "--json", "--no-files", "--no-error"})));
  for (const char* command : {"run", "compare", "check", "figures", "steady", "modes", "size", "reduce", "forces",
                              "gears", "effects", "advise", "accuracy"}) {
    const Ended wrong = kurbel({command, text, "--set", "coupling.stiffness=4 kg"});
    EXPECT_EQ(wrong.code, 2) << command;
    EXPECT_NE(
        wrong.err.find("--set \"coupling.stiffness=4 kg\":1:20: coupling \"coupling\": stiffness = \"4 kg\" is a mass"),
        std::string::npos)
        << command << ": " << wrong.err;
  }
  // Found when the machine is built: in the file's own place.
  const Ended late = kurbel(
      {"check", text, "--set", "run.accuracy=1e-5", "--set", "motor.inertia=", "--set", "coupling.inertia_in=0 kg*m2"});
  EXPECT_EQ(late.code, 2);
  EXPECT_TRUE(late.err.starts_with("scene.toml:") || late.err.starts_with("--set \"")) << late.err;
}

TEST_F(CommandLine, ForcesOfASliderCrankAreWrittenAndBadRequestsRefused) {
  const std::string press = std::string(KURBEL_SOURCE_DIR) + "/scenes/crank_press.toml";
  const Ended r = kurbel({"forces", press, "--speed", "60 rpm", "--no-run", "--out", "out"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(r.err.empty()) << r.err;
  EXPECT_NE(r.out.find("reaction of the main bearing"), std::string::npos) << r.out;
  for (const char* name : {"out/summary.json", "out/report.html", "out/forces_prescribed.csv"})
    EXPECT_TRUE(file(name)) << name;
  const struct {
    std::vector<std::string> arguments;
    std::string said;
  } bad[] = {{{"--speed", "60 mm"}, "--speed \"60 mm\": must be a speed with its unit, e.g. \"300 rpm\""},
             {{"--speed", "0 rpm"}, "must be a speed ≠ 0"},
             {{"--positions", "2"}, "--positions \"2\": must be 4 … 3600"},
             {{"--mechanism", "pres"}, "--mechanism pres: no mechanism of that name; allowed: \"press\""}};
  for (const auto& request : bad) {
    std::vector<std::string> arguments = {"forces", press, "--no-run"};
    arguments.insert(arguments.end(), request.arguments.begin(), request.arguments.end());
    const Ended refused = kurbel(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(request.said), std::string::npos) << refused.err;
  }
}

TEST_F(CommandLine, BadSceneEndsWithTwoAndWritesNothing) {
  const Ended r = kurbel({"run", scene("until = \"1 s\"\n", "\"-1 kg*m2\""), "--out", "out"});
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.err, "scene.toml:6:11: dc shunt motor \"motor\": inertia = -1 kg·m²; must be ≥ 0\n");
  EXPECT_TRUE(r.out.empty());
  EXPECT_FALSE(file("out"));
}

TEST_F(CommandLine, MissingSceneEndsWithTwo) {
  const Ended r = kurbel({"check", "absent.toml"});
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.err, "absent.toml: no such file; check the path, or list the folder with ls\n");
}

TEST_F(CommandLine, UnknownCommandIsAnsweredWithTheNearest) {
  const Ended r = kurbel({"comapre", "scene.toml"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("unknown command \"comapre\" — did you mean \"compare\"?"), std::string::npos) << r.err;
}

TEST_F(CommandLine, UnknownOptionIsRefused) {
  const Ended r = kurbel({"run", scene(""), "--acuracy", "1e-3"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("--acuracy"), std::string::npos) << r.err;
}

TEST_F(CommandLine, AListOfEffectsTakesNoSceneBehindIt) {
  const Ended r = kurbel({"run", "--effects", "none", scene(""), "--no-files", "--quiet"});
  EXPECT_EQ(r.code, 0) << r.err;
}

// Two sets of effects are no third one: what says one thing is said once.
TEST_F(CommandLine, WhatSaysOneThingIsGivenOnce) {
  const std::string path = scene("until = \"0.1 s\"\n");
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"run", {"--effects", "elasticity", "--effects", "gravity"}},
      {"run", {"--effects", "none", "--effects", "none"}},
      {"run", {"--accuracy", "1e-4", "--accuracy", "1e-6"}},
      {"steady", {"--effects", "elasticity", "--effects", "gravity"}},
      {"compare", {"--against", "none", "--against", "elasticity"}}};
  for (const auto& [command, options] : cases) {
    std::vector<std::string> arguments = {command, path, "--no-files", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended r = kurbel(arguments);
    EXPECT_EQ(r.code, 2) << command << " " << options[0];
    EXPECT_NE(r.err.find(options[0]), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("received 2"), std::string::npos) << r.err;
  }
}

TEST_F(CommandLine, BadOptionsAreRefusedBeforeAnythingRuns) {
  // The run itself would take hours.
  const std::string path = scene("until = \"1000000 s\"\n");
  const struct {
    std::string option, value, said;
  } cases[] = {
      {"--effects", "elastic", "allowed: \"none\", \"all\", \"elasticity\", \"elasticity:COUPLING"},
      {"--effects", "elasticity:copling",
       "\"copling\" is no component — did you mean \"coupling\"?; allowed: \"coupling\""},
      {"--effects", "elasticity:fan", "\"fan\" is a load, which is always rigid; allowed: \"coupling\""},
      {"--effects", "elasticity:", "\"\" is no component"},
      {"--until", "3", "must be a time > 0 with its unit, e.g. \"3 s\""},
      {"--until", "3 m", "must be a time > 0"},
      {"--until", "-3 s", "must be a time > 0"},
      {"--until", "nan s", "the number must be finite"},
      {"--until", "3 sec", "unknown unit \"sec\""},
      {"--accuracy", "2", "--accuracy"},
      {"--accuracy", "fine", "--accuracy"},
      {"--accuracy", "nan", "--accuracy"},
      {"--accuracy", "0", "--accuracy"},
      {"--method", "euler",
       "allowed: \"auto\", \"work\", \"dopri5\", \"verner6\", \"dop853\", \"fehlberg8\", \"adams\", \"esdirk3\", "
       "\"esdirk\", \"esdirk5\" or \"bdf\""},
      {"--method", "dop835", "did you mean \"dop853\"?"},
      {"--method", "CPodes",
       "method \"CPodes\" belongs to model = \"multibody\"; for model = \"reduced\" allowed: \"auto\""},
  };
  for (const auto& c : cases) {
    const auto begin = Clock::now();
    const Ended r = kurbel({"run", path, c.option, c.value, "--out", "out"});
    EXPECT_EQ(r.code, 2) << c.option << " " << c.value;
    EXPECT_NE(r.err.find(c.said), std::string::npos) << r.err;
    EXPECT_TRUE(r.out.empty());
    EXPECT_FALSE(file("out"));
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
  }
}

// What lies in a results folder is never read; a measured setting is used only where its file is named.
TEST_F(CommandLine, FiguresDoNotDependOnFilesOfEarlierRuns) {
  const std::string path = scene("until = \"0.2 s\"\n");
  const auto results = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", path, "--json", "--no-files"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended r = kurbel(arguments);
    EXPECT_EQ(r.code, 0) << r.err;
    return nlohmann::json::parse(r.out);
  };
  const auto before = results({});
  const Ended study = kurbel({"accuracy", path, "--methods", "dop853", "verner6", "--tolerances", "1e-5", "1e-9",
                              "--no-multibody", "--time", "5 s"});
  ASSERT_EQ(study.code, 0) << study.err;
  const std::string file = "results/scene/accuracy/summary.json";
  EXPECT_NE(study.out.find("kurbel run scene.toml --setting " + file), std::string::npos) << study.out;
  EXPECT_TRUE(fs::exists(folder_ / file));
  const auto after = results({}), reported = results({"--setting", file});
  EXPECT_EQ(before["figures"], after["figures"]);
  EXPECT_EQ(before["notes"], after["notes"]);
  EXPECT_NE(reported["notes"].dump().find("method and tolerance by --setting " + file), std::string::npos)
      << reported["notes"];

  std::ofstream(folder_ / "other.json") << "{ \"title\": 1";
  const struct {
    std::vector<std::string> arguments;
    std::string said;
  } bad[] = {{{"--setting", "none.json"}, "none.json: --setting: no such file; kurbel accuracy SCENE writes one"},
             {{"--setting", "other.json"}, "other.json:1:13: --setting: is no JSON here"},
             {{"--setting", file, "--effects", "none", "--accuracy", "1e-12"}, file + ": --setting: no setting had an"},
             {{"--setting", file, "--method", "dop853"}, "give one of them"}};
  for (const auto& request : bad) {
    std::vector<std::string> arguments = {"run", path, "--no-files"};
    arguments.insert(arguments.end(), request.arguments.begin(), request.arguments.end());
    const Ended r = kurbel(arguments);
    EXPECT_EQ(r.code, 2) << request.said;
    EXPECT_NE(r.err.find(request.said), std::string::npos) << r.err;
  }
}

// A state that one process wrote goes on in others to the same bits, and ends within the errors of a run that never
// stopped.
TEST_F(CommandLine, StatesGoOnInAnotherProcess) {
  for (const char* name : {"crank_press", "worm_hoist", "planetary_brake"}) {
    const std::string scene = KURBEL_SOURCE_DIR "/scenes/" + std::string(name) + ".toml";
    ASSERT_EQ(kurbel({"run", scene, "--until", "0.7 s", "--save-state", "a", "--no-files"}).code, 0) << name;
    std::string ends[2];
    for (const char* end : {"b", "c"}) {
      const Ended r =
          kurbel({"run", scene, "--until", "1.5 s", "--from-state", "a", "--save-state", end, "--json", "--no-files"});
      ASSERT_EQ(r.code, 0) << name << r.err;
      EXPECT_EQ(nlohmann::json::parse(r.out)["goes_on_from"], 0.7);
      ends[*end - 'b'] = r.out;
    }
    EXPECT_EQ(text_of(folder_ / "b"), text_of(folder_ / "c")) << name;
    const Ended whole = kurbel({"run", scene, "--until", "1.5 s", "--json", "--no-files"});
    const auto figures = [](const std::string& json) {
      std::map<std::string, std::pair<double, double>> list;
      const nlohmann::json read = nlohmann::json::parse(json);
      for (const auto& [component, end] : read["final"].items())
        for (const char* what : {"angle", "speed"})
          list[component + "." + what] = {end[what].get<double>(), end[std::string(what) + "_error"].get<double>()};
      return list;
    };
    const auto on = figures(ends[0]), through = figures(whole.out);
    ASSERT_FALSE(on.empty());
    for (const auto& [figure, value] : on)
      EXPECT_NEAR(value.first, through.at(figure).first, 3 * (value.second + through.at(figure).second) + 1e-7)
          << name << " " << figure;
  }
  const std::string hoist = KURBEL_SOURCE_DIR "/scenes/worm_hoist.toml";
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--from-state", "a"}, "is of another machine: its state "},
      {{"--from-state", "none"}, "--from-state none: no such file; kurbel run SCENE --until TIME --save-state none"},
      {{"--save-state", "no/such/folder"}, "--save-state"},
      {{"--save-state", "d", "--method", "work"}, "work"}};
  for (auto [words, said] : wrong) {
    words.insert(words.begin(), {"run", hoist, "--no-files"});
    const Ended r = kurbel(words);
    EXPECT_EQ(r.code, 2) << said;
    EXPECT_NE(r.err.find(said), std::string::npos) << r.err;
  }
  const std::string brake = KURBEL_SOURCE_DIR "/scenes/planetary_brake.toml";
  const Ended early = kurbel({"run", brake, "--until", "0.5 s", "--from-state", "a", "--no-files"});
  EXPECT_EQ(early.code, 2);
  EXPECT_NE(early.err.find("is of 0.7 s, and the run ends at 0.5 s; let it run on with --until"), std::string::npos)
      << early.err;
}

TEST_F(CommandLine, MultibodyModelRefusesMethodsOfTheReducedOne) {
  std::ofstream(folder_ / "crank.toml")
      << "line = [\"crank\"]\n[crank]\nkind = \"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\n"
         "crank_inertia = \"0.5 kg*m2\"\nslider_mass = \"3 kg\"\n[run]\nmodel = \"multibody\"\nuntil = \"0.1 "
         "s\"\nstart = { speed = \"30 rad/s\" }\n";
  const Ended r = kurbel({"run", "crank.toml", "--method", "dop853", "--no-files"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("method \"dop853\" belongs to model = \"reduced\"; for model = \"multibody\" allowed: \"auto\", "
                       "\"RungeKuttaMerson\""),
            std::string::npos)
      << r.err;
  EXPECT_EQ(kurbel({"run", "crank.toml", "--method", "RungeKuttaMerson", "--no-files"}).code, 0);
}

TEST_F(CommandLine, FileInPlaceOfTheFolderIsRefusedBeforeAnythingRuns) {
  std::ofstream(folder_ / "taken") << "mine";
  for (const char* out : {"taken", "taken/deeper"}) {
    const Ended r = kurbel({"run", scene("until = \"1000000 s\"\n"), "--out", out});
    EXPECT_EQ(r.code, 2);
    EXPECT_NE(r.err.find("taken is a file; give a folder"), std::string::npos) << r.err;
  }
  EXPECT_EQ(text_of(folder_ / "taken"), "mine");
}

TEST_F(CommandLine, UnwritableFolderIsNamed) {
  const Ended r = kurbel({"run", scene("until = \"0.1 s\"\n"), "--out", "/proc/kurbel"});
  EXPECT_EQ(r.code, 2) << "before anything runs";
  EXPECT_NE(r.err.find("/proc/kurbel: cannot write in /proc"), std::string::npos) << r.err;
  EXPECT_TRUE(r.out.empty());
}

TEST_F(CommandLine, SpentBudgetEndsWithThreeADiagnosisAndPartialResults) {
  const Ended r = kurbel({"run", scene("until = \"1000000 s\"\nbudget = \"0.01 s\"\n"), "--out", "out"});
  EXPECT_EQ(r.code, 3);
  for (const char* part :
       {"stopped at t = ", "the budget of 0.01 s of processor time is spent", "Raise `budget`, loosen `accuracy`"})
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
  EXPECT_NE(r.out.find("INCOMPLETE"), std::string::npos);
  EXPECT_NE(r.out.find("results: out.incomplete/summary.json"), std::string::npos) << r.out;
  EXPECT_FALSE(file("out"));
  const auto summary = nlohmann::json::parse(text_of(folder_ / "out.incomplete/summary.json"));
  EXPECT_FALSE(summary["complete"]);
  EXPECT_FALSE(summary["diagnosis"].get<std::string>().empty());
  EXPECT_TRUE(text_of(folder_ / "out.incomplete/trajectory.csv").starts_with("# incomplete: stopped at t = "));
}

// A series motor without a load: an event, a diagnosis, what was computed up to then.
TEST_F(CommandLine, RunawayEndsWithThreeAnEventAndADiagnosis) {
  std::ofstream(folder_ / "runaway.toml")
      << "line = [\"motor\"]\n[motor]\nkind = \"dc series motor\"\nvoltage = \"220 V\"\nresistance = \"1 Ohm\"\n"
         "constant = \"0.02 N*m/A2\"\nrated_speed = \"500 rpm\"\ninertia = \"1 kg*m2\"\n[run]\nuntil = \"1000 s\"\n";
  const Ended r = kurbel({"run", "runaway.toml"});
  EXPECT_EQ(r.code, 3);
  EXPECT_NE((r.out + r.err).find("ran away: its speed passed max_speed = 2500 rpm"), std::string::npos)
      << r.out << r.err;
  const auto summary = nlohmann::json::parse(text_of(folder_ / "results/runaway/run.incomplete/summary.json"));
  EXPECT_FALSE(summary["complete"]);
  ASSERT_EQ(summary["events"].size(), 1u);
  EXPECT_EQ(summary["events"][0]["what"], "ran away: passed its max_speed");
}

// A clearance that no pin has: the motion loses its values at the first contact. Nothing of that is given as a figure.
TEST_F(CommandLine, FiguresWithoutAValueAreOmittedOfAnIncompleteRun) {
  std::string text = text_of(std::string(KURBEL_SOURCE_DIR) + "/scenes/worn_crank_pin.toml");
  const auto put = [&](const std::string& old, const std::string& value) {
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), value);
  };
  put("gap = \"0.1 mm\"", "gap = \"1e300 mm\"");
  put("friction = 0.05, radius = \"10 mm\"", "friction = 0.05, radius = \"1e150 mm\"");
  std::ofstream(folder_ / "lost.toml") << text;
  for (const char* verb : {"run", "compare"}) {
    const Ended r = kurbel({verb, "lost.toml", "--out", verb});
    if (r.code == 2) {  // refused before it runs
      EXPECT_EQ(r.err.rfind("lost.toml:", 0), 0u) << r.err;
      continue;
    }
    EXPECT_EQ(r.code, 3);
    std::istringstream lines(r.out);
    for (std::string line; std::getline(lines, line);)
      if (line.find("stopped at") == std::string::npos) {
        EXPECT_EQ(line.find(" nan"), std::string::npos) << line;
      }
    const auto summary = nlohmann::json::parse(text_of(folder_ / (std::string(verb) + ".incomplete/summary.json")));
    const auto run = std::string(verb) == "run" ? summary : summary["models"]["full"];
    EXPECT_FALSE(run["complete"]);
    EXPECT_FALSE(run["figures"].empty());
    for (const auto& figure : run["figures"]) EXPECT_TRUE(figure["value"].is_number()) << figure;
  }
}

TEST_F(CommandLine, ColoursWarnOnATerminalOnly) {
  const std::vector<std::string> spent = {"run", scene("until = \"1000000 s\"\nbudget = \"0.01 s\"\n"), "--out", "out"};
  EXPECT_NE(on_terminal(spent).find("\033[31mINCOMPLETE\033[0m"), std::string::npos);
  EXPECT_EQ(on_terminal(spent, true).find("\033["), std::string::npos);
  EXPECT_EQ(kurbel(spent).out.find("\033["), std::string::npos);
  // Five seconds of this chain come no nearer than 2e-12: said in yellow.
  const std::string chain = std::string(KURBEL_SOURCE_DIR) + "/scenes/six_inertia_chain.toml";
  const std::string shown = on_terminal({"run", chain, "--accuracy", "1e-12", "--no-files"});
  EXPECT_NE(shown.find("\033[33mNOT confirmed\033[0m"), std::string::npos) << shown;
}

// Figures without the requested accuracy: stated in the conclusion, in JSON, in the page, and by the exit code.
TEST_F(CommandLine, AnAccuracyThatWasNotConfirmedIsReportedEverywhereAndEndsWithThree) {
  const std::string chain = std::string(KURBEL_SOURCE_DIR) + "/scenes/six_inertia_chain.toml";
  const Ended quiet = kurbel({"run", chain, "--accuracy", "1e-12", "--quiet", "--out", "out"});
  EXPECT_EQ(quiet.code, 3);
  EXPECT_NE(quiet.out.find("NOT confirmed: accuracy 1.0e-12 requested"), std::string::npos) << quiet.out;
  EXPECT_NE(quiet.err.find("not confirmed"), std::string::npos) << quiet.err;
  EXPECT_NE(text_of(folder_ / "out/summary.json").find("\"confirmed\": false"), std::string::npos);
  EXPECT_NE(text_of(folder_ / "out/report.html").find("NOT confirmed"), std::string::npos);
  const Ended unasked = kurbel({"run", chain, "--no-error", "--no-files", "--json"});
  EXPECT_EQ(unasked.code, 0);
  EXPECT_NE(unasked.out.find("\"confirmed\": null"), std::string::npos);
}

TEST_F(CommandLine, ProgressIsShownForLongWorkOnATerminalAndWipedOut) {
  const std::vector<std::string> slow = {"run", scene("until = \"1000000 s\"\nbudget = \"2 s\"\n"), "--out", "out"};
  const std::string shown = on_terminal(slow);
  EXPECT_NE(shown.find("\r\033[Kelastic (tolerance "), std::string::npos) << shown.substr(0, 400);
  EXPECT_EQ(kurbel(slow).err.find("elastic (tolerance"), std::string::npos);
}

TEST_F(CommandLine, InterruptEndsALongRunWithinASecondAndMarksItsFiles) {
  const pid_t child = start({"run", scene("until = \"10000000 s\"\n"), "--out", "out"});
  test::wait_for_handler(child);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  const auto begin = Clock::now();
  kill(child, SIGINT);
  const Ended r = wait(child);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(1));
  EXPECT_EQ(r.code, 130);
  EXPECT_NE(r.err.find("interrupted"), std::string::npos) << r.err;
  const fs::path place = folder_ / "out.incomplete";
  EXPECT_FALSE(nlohmann::json::parse(text_of(place / "summary.json"))["complete"]);
  EXPECT_TRUE(text_of(place / "trajectory.csv").starts_with("# incomplete: "));
  EXPECT_NE(text_of(place / "set.sha256").find("; INCOMPLETE\n"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(place))
    EXPECT_TRUE(entry.path().extension() == ".json" || entry.path().extension() == ".csv" ||
                entry.path().extension() == ".html" || entry.path().filename() == "set.sha256")
        << entry.path();
  EXPECT_FALSE(file("out"));
}

// What was complete stays to the last bit, however a later run ends; what a killed one left is gone after the next.
TEST_F(CommandLine, CompleteResultsOutliveRunsThatFailAreInterruptedOrKilled) {
  ASSERT_EQ(kurbel({"run", scene("until = \"0.2 s\"\n"), "--out", "out"}).code, 0);
  const auto all = [&] {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      files[entry.path().filename()] = text_of(entry.path());
    return files;
  };
  const auto before = all();
  EXPECT_EQ(before.size(), 4u);
  EXPECT_EQ(kurbel({"run", scene("until = \"1000000 s\"\nbudget = \"0.01 s\"\n"), "--out", "out"}).code, 3);
  EXPECT_EQ(all(), before);
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    const pid_t child = start({"run", scene("until = \"10000000 s\"\n"), "--out", "out"});
    test::wait_for_handler(child);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(child, signal);
    EXPECT_EQ(wait(child).code, signal == SIGKILL ? -1 : 130);
    EXPECT_EQ(all(), before);
  }
  EXPECT_EQ(kurbel({"run", scene("until = \"0.3 s\"\n"), "--out", "out"}).code, 0);
  EXPECT_NE(all(), before);
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_FALSE(entry.path().filename().string()[0] == '.');
}

TEST_F(CommandLine, NoCommandWritesOverTheResultsOfAnother) {
  const std::string name = scene("until = \"0.2 s\"\naccuracy = 1e-3\n");
  for (const char* verb : {"run", "compare", "modes", "steady", "effects"}) {
    const Ended r = kurbel({verb, name});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find(std::string("results: results/scene/") + verb + "/summary.json"), std::string::npos) << r.out;
  }
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(folder_ / "results/scene")) {
    folders.insert(entry.path().filename());
    EXPECT_NE(text_of(entry.path() / "set.sha256").find("# kurbel " + entry.path().filename().string() + " scene.toml"),
              std::string::npos);
  }
  EXPECT_EQ(folders, (std::set<std::string>{"run", "compare", "modes", "steady", "effects"}));
}

TEST_F(CommandLine, SteadyFindsTheCycleAndSaysWhereThereIsNone) {
  const std::string scenes = std::string(KURBEL_SOURCE_DIR) + "/scenes/";
  const Ended press = kurbel({"steady", scenes + "crank_press.toml", "--json"});
  EXPECT_EQ(press.code, 0) << press.err;
  EXPECT_EQ(nlohmann::json::parse(press.out)["cycles"].size(), 2u);
  EXPECT_TRUE(fs::exists(folder_ / "results/crank_press/steady/report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "results/crank_press/steady/operating_points.csv"));
  const Ended family = kurbel({"steady", scenes + "free_slider_crank.toml"});
  EXPECT_EQ(family.code, 2);
  EXPECT_NE(family.err.find("--mid-speed"), std::string::npos) << family.err;
  const Ended member = kurbel({"steady", scenes + "free_slider_crank.toml", "--mean-speed", "100 rpm", "--no-files"});
  EXPECT_EQ(member.code, 0) << member.err;
  const Ended mistyped = kurbel({"steady", scenes + "crank_press.toml", "--mean-speed", "3 m"});
  EXPECT_EQ(mistyped.code, 2);
  std::ofstream(folder_ / "stall.toml")
      << "line = [\"motor\", \"load\"]\n"
         "motor = { kind = \"dc shunt motor\", stall_torque = \"10 N*m\", no_load_speed "
         "= \"40 rad/s\", inertia = \"0.5 kg*m2\" }\n"
         "load = { kind = \"load\", torque = \"15 N*m\" }\n";
  const Ended stall = kurbel({"steady", "stall.toml"});
  EXPECT_EQ(stall.code, 3);
  EXPECT_NE(stall.err.find("stall"), std::string::npos) << stall.err;
}

}  // namespace
}  // namespace kurbel::command_line_test
