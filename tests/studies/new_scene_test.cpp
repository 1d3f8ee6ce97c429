// new_scene_test.cpp — scenes to start from run and balance; what helps to write them is complete.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "studies/scenes/templates.h"
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace kurbel::new_scene_test {
namespace {

namespace fs = std::filesystem;

using test::text_of;

using test::Said;

class NewScene : public testing::Test {
 protected:
  Said kurbel(const std::string& arguments) const {
    return shell(std::string("'") + KURBEL_EXECUTABLE + "' " + arguments);
  }
  Said shell(const std::string& command) const { return test::said_by("cd '" + folder_.string() + "' && " + command); }

  const test::ScratchFolder folder_;
};

TEST_F(NewScene, IsWrittenOnceAndSaysWhatToDoNext) {
  const Said first = kurbel("new press");
  EXPECT_EQ(first.code, 0);
  EXPECT_NE(first.text.find("kurbel compare press.toml"), std::string::npos) << first.text;
  const std::string text = text_of(folder_ / "press.toml");
  EXPECT_TRUE(text.starts_with("#:schema ./scene.schema.json\n# Crank press"));
  EXPECT_TRUE(fs::exists(folder_ / "scene.schema.json"));
  const Said second = kurbel("new press");
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.text.find("press.toml exists already"), std::string::npos) << second.text;
  EXPECT_EQ(text_of(folder_ / "press.toml"), text);
}

TEST_F(NewScene, MistypedKindIsGuessed) {
  const Said said = kurbel("new compresor");
  EXPECT_EQ(said.code, 2);
  EXPECT_NE(said.text.find("did you mean \"compressor\"?"), std::string::npos) << said.text;
  EXPECT_NE(kurbel("keys coupeling").text.find("did you mean \"coupling\"?"), std::string::npos);
  EXPECT_EQ(kurbel("new press missing/press.toml").code, 2);
}

TEST_F(NewScene, EveryOneIsValid) {
  for (const SceneTemplate& scene : scene_templates()) {
    EXPECT_EQ(kurbel("new " + scene.name).code, 0);
    const Said said = kurbel("check " + scene.name + ".toml");
    EXPECT_EQ(said.code, 0) << said.text;
  }
}

// Each scene reaches its accuracy, and its energy balance closes to ten times that.
class ExampleScene : public testing::TestWithParam<const char*> {};
TEST_P(ExampleScene, ReachesItsAccuracyAndBalances) {
  const Scene scene = test::scene_file("scenes/" + std::string(GetParam()) + ".toml");
  const Result result = test::run(scene);
  EXPECT_TRUE(result.complete) << result.diagnosis;
  EXPECT_TRUE(result.accuracy_confirmed) << result.measured_accuracy;
  EXPECT_LE(result.energy.relative, 10 * scene.run.accuracy);
}
INSTANTIATE_TEST_SUITE_P(Scenes, ExampleScene,
                         testing::Values("piston_pump", "single_cylinder_engine", "four_cylinder_engine",
                                         "compressor"));

// W = ∮ p dV of the diagrams' closed forms.
TEST(ExampleWork, OfTheCompressorIsThePolytropicOne) {
  const Result result = test::run(test::scene_file("scenes/compressor.toml"));
  const double n = 1.3, clearance = 0.05, ratio = 8, volume = M_PI / 4 * 0.16 * 0.16 * 0.11;
  const double drawn = volume * (1 + clearance - clearance * std::pow(ratio, 1 / n));
  const double work = n / (n - 1) * 1e5 * drawn * (std::pow(ratio, (n - 1) / n) - 1);
  EXPECT_NEAR(-test::figure(result, "useful_work_per_cycle"), work, 1e-7 * work);
}
TEST(ExampleWork, OfThePumpIsPressureTimesVolume) {
  const Result result = test::run(test::scene_file("scenes/piston_pump.toml"));
  // 98 bar between delivery and suction over 70 mm, less half of the ramps of 3 mm and 2.5 mm.
  EXPECT_NEAR(-test::figure(result, "useful_work_per_cycle"), 3 * (12441 - 126) * (0.070 - 0.5 * (0.003 + 0.0025)),
              0.1);
}

TEST_F(NewScene, QuietPrintsOneLineAndVerboseLogsToTheErrorStream) {
  kurbel("new chain");
  const Said quiet = kurbel("run chain.toml --quiet --no-files --until '0.2 s'");
  EXPECT_EQ(std::count(quiet.text.begin(), quiet.text.end(), '\n'), 1) << quiet.text;
  const Said log = kurbel("run chain.toml --verbose --no-files --until '0.2 s' 2> log > /dev/null; cat log");
  for (const char* word : {"read chain.toml", "coordinates", "tolerance", "events", "agree within"})
    EXPECT_NE(log.text.find(word), std::string::npos) << log.text;
  EXPECT_EQ(kurbel("run chain.toml --no-files --until '0.2 s'").text.find('\033'), std::string::npos)
      << "colours belong on a terminal";
}

// A terminal of its own by util-linux' script.
TEST_F(NewScene, ConclusionIsBoldOnATerminalUnlessColoursAreUnwanted) {
  if (shell("command -v script").code != 0) GTEST_SKIP() << "no script(1) here to make a terminal";
  kurbel("new chain");
  const std::string command = " script -qec \"'" + std::string(KURBEL_EXECUTABLE) +
                              "' compare chain.toml --no-files --until '0.2 s'\" /dev/null";
  const Said bold = shell("TERM=xterm" + command), plain = shell("TERM=xterm NO_COLOR=1" + command);
  EXPECT_NE(bold.text.find("\033[1mElastic model: "), std::string::npos) << bold.text;
  EXPECT_EQ(plain.text.find("\033[1m"), std::string::npos) << plain.text;
}

// What stands between the marks of a file.
std::string made_part(const std::string& file) {
  const std::string text = text_of(test::source_path(file));
  const std::size_t begin = text.find('\n', text.find("made by the program: begin")) + 1;
  const std::size_t end = text.find("made by the program: end");
  return text.substr(begin, text.rfind('\n', end) + 1 - begin);
}

// What all commands on a scene take is described by hand. `effects` takes nothing else.
TEST_F(NewScene, OptionsOfAllCommandsAreInManPageAndTable) {
  const std::string manual = std::regex_replace(text_of(test::source_path("docs/kurbel.1")), std::regex(R"(\\-)"), "-");
  const std::string table = text_of(test::source_path("docs/commands.md"));
  std::istringstream shared(kurbel("commands effects").text);
  int count = 0;
  for (std::string option; std::getline(shared, option); ++count) {
    EXPECT_TRUE(std::regex_search(manual, std::regex("\n\\.BI? " + option + "( |\n)"))) << "kurbel.1 lacks " << option;
    if (option == "--help") continue;
    EXPECT_TRUE(std::regex_search(table, std::regex("\n\\|[^|]*`" + option + "[ `]")))
        << "commands.md lacks " << option;
  }
  EXPECT_GE(count, 14);
}

// A command says itself in one place: manual page, docs/commands.md and completion follow. README names each.
TEST_F(NewScene, ManPageTableAndCompletionAreWhatTheCommandsSayOfThemselves) {
  EXPECT_EQ(made_part("docs/kurbel.1"), kurbel("commands --manual").text) << "renew it: scripts/renew-docs";
  EXPECT_EQ(made_part("docs/commands.md"), kurbel("commands --markdown").text) << "renew it: scripts/renew-docs";
  EXPECT_EQ(made_part("python/kurbel/__init__.pyi"), kurbel("commands --stubs").text) << "renew it: scripts/renew-docs";
  const std::string readme = text_of(test::source_path("README.md")), help = kurbel("--help").text;
  std::istringstream names(kurbel("commands").text);
  int count = 0;
  for (std::string name; std::getline(names, name); ++count) {
    EXPECT_NE(help.find("\n  " + name + " "), std::string::npos) << "kurbel --help lacks " << name;
    EXPECT_NE(readme.find("kurbel " + name), std::string::npos) << "README.md lacks " << name;
    const std::string of_command = kurbel(name + " --help").text, listed = kurbel("commands " + name).text;
    std::set<std::string> in_help, in_list;
    const std::regex option("(--[a-z-]+)");
    const std::string options = of_command.substr(of_command.find("Options:"));
    // Those at the begin of a line; others stand in explanations.
    const std::regex first("\n  (?:-[a-z],)?(--[a-z-]+)");
    for (std::sregex_iterator o(options.begin(), options.end(), first), end; o != end; ++o) in_help.insert((*o)[1]);
    for (std::sregex_iterator o(listed.begin(), listed.end(), option), end; o != end; ++o) in_list.insert((*o)[1]);
    EXPECT_EQ(in_help, in_list) << name;
    const std::string completed =
        shell("bash -c 'source \"" + test::source_path("scripts/kurbel.bash-completion") + "\"; COMP_WORDS=(\"" +
              std::string(KURBEL_EXECUTABLE) + "\" " + name + " --); COMP_CWORD=2; _kurbel; echo ${COMPREPLY[*]}'")
            .text;
    for (const std::string& word : in_list) EXPECT_NE(completed.find(word), std::string::npos) << name << " " << word;
  }
  EXPECT_GE(count, 17);
  std::set<std::string> offered;
  std::istringstream templates(kurbel("new --list").text);
  for (std::string name; std::getline(templates, name);) offered.insert(name);
  for (const SceneTemplate& scene : scene_templates()) EXPECT_TRUE(offered.count(scene.name)) << scene.name;
}

// bash completes the components of a scene after --effects.
TEST_F(NewScene, CompletionKnowsTheCouplingsOfAScene) {
  kurbel("new press");
  const Said said = shell(
      "bash -c 'source \"" + test::source_path("scripts/kurbel.bash-completion") +
      "\"; COMP_WORDS=(kurbel run press.toml --effects elasticity:m); COMP_CWORD=4; _kurbel; echo ${COMPREPLY[*]}'");
  EXPECT_NE(said.text.find("elasticity:motor_coupling"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("elasticity:main_coupling"), std::string::npos) << said.text;
}

}  // namespace
}  // namespace kurbel::new_scene_test
