// size_command_test.cpp — kurbel reduce and kurbel size on the command line: exit codes, files, words.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace kurbel::size_command_test {
namespace {

namespace fs = std::filesystem;

using test::Said;
constexpr auto kurbel = test::said_by_program;

const std::string press = std::string(KURBEL_SOURCE_DIR) + "/scenes/crank_press.toml";

TEST(SizeCommand, AnotherBasisIsRefusedWithThoseThatAre) {
  for (const std::string command : {"size", "reduce"}) {
    const Said said = kurbel(command + " " + press + " --basis regime");
    EXPECT_EQ(said.code, 2);
    EXPECT_NE(said.text.find("--basis \"regime\": must be classical or steady"), std::string::npos) << said.text;
  }
}

TEST(SizeCommand, WritesAReportWithEveryFormulaAndEndsWithZero) {
  const test::ScratchFolder folder;
  const Said said = kurbel("size " + press + " --delta 0.08 --diagram '240 mm' --out '" + folder.string() + "'");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_NE(said.text.find("μ_φ"), std::string::npos);
  std::ifstream in(folder / "summary.json");
  const auto json = nlohmann::json::parse(in);
  EXPECT_NEAR(json["methods"][0]["delta"].get<double>(), 0.08, 1e-11);
  EXPECT_EQ(json["reached"].size(), 5u);  // two flywheels in two models, and the one that meets it
  std::ifstream page(folder / "report.html");
  const std::string html((std::istreambuf_iterator<char>(page)), {});
  for (const char* formula : {"Wittenbauer (theory 3.2)", "Mertsalov", "Neglecting I_em", "(theory 3.1)",
                              "Punch-press form", "Rim speed", "Energy stored", "Greatest fluctuation of energy"})
    EXPECT_NE(html.find(formula), std::string::npos) << formula;
  EXPECT_TRUE(fs::exists(folder / "diagrams.csv"));
}

TEST(SizeCommand, BadInputEndsWithTwoInWords) {
  const auto refused = [](const std::string& arguments, const std::string& words) {
    const Said said = kurbel("size " + press + " --no-files " + arguments);
    EXPECT_EQ(said.code, 2) << arguments;
    EXPECT_NE(said.text.find(words), std::string::npos) << said.text;
  };
  refused("--delta 0", "must be > 0 and < 2");
  refused("--delta=-0.1", "must be > 0 and < 2");
  refused("--delta 2", "must be > 0 and < 2");
  refused("--delta 1/0", "nothing can be divided by 0");
  refused("--delta '5 mm'", "must be a plain number, e.g. \"0.05\"");
  refused("--delta 0.1 --mid-speed '1 1/s'", "must be a speed > 0 with its unit");
  refused("", "--delta 0.05");
  refused("--machine pres", "did you mean \"press\"");
  refused("--delta 0.1 --machine press", "keep one");
  refused("--delta 0.1 --material wood", "known: \"grey cast iron\"");
  refused("--delta 0.1 --form ring", "rim or disc");
  refused("--delta 0.1 --diameter 3", "length");
  refused("--delta 0.1 --diameter '300 mm'", "larger --diameter");
  refused("--delta 0.1 --mid-speed '-5 rpm'", "speed > 0");
}

TEST(SizeCommand, FractionsAndTurnsPerMinuteAreTakenAsReportsPrintThem) {
  const auto sized = [](const std::string& arguments) {
    const Said said = kurbel("size " + press + " --no-run --json --no-files " + arguments);
    EXPECT_EQ(said.code, 0) << said.text;
    const auto json = nlohmann::json::parse(said.text);
    return json["flywheel"]["inertia"].get<double>();
  };
  const double inertia = sized("--delta 0.05 --mid-speed '60 rpm'");
  EXPECT_DOUBLE_EQ(sized("--delta 1/20 --mid-speed '60 1/min'"), inertia);
  EXPECT_DOUBLE_EQ(sized("--delta '5 %' --mid-speed '1 Hz'"), inertia);
}

TEST(SizeCommand, CustomaryDeltaAndDiscWithoutSimulation) {
  const Said said = kurbel("size " + press + " --machine press --form disc --material steel --no-run --no-files");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_NE(said.text.find("0.1 … 0.15"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("solid disc"), std::string::npos);
  EXPECT_EQ(said.text.find("simulated"), std::string::npos);
}

TEST(ReduceCommand, TablesAtAnyNumberOfPositionsAndRefusals) {
  const test::ScratchFolder folder;
  const Said said = kurbel("reduce " + press + " --positions 24 --to press.slider --out '" + folder.string() + "'");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_NE(said.text.find("dead centre"), std::string::npos);
  std::ifstream in(folder / "positions.csv");
  std::string line;
  int lines = 0;
  while (std::getline(in, line)) ++lines;
  EXPECT_EQ(lines, 1 + 22);  // both dead centres omitted
  EXPECT_EQ(kurbel("reduce " + press + " --no-files --positions 0").code, 2);
  const Said unknown = kurbel("reduce " + press + " --no-files --to gearbx.in");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.text.find("did you mean \"gearbox.in\""), std::string::npos) << unknown.text;
}

}  // namespace
}  // namespace kurbel::size_command_test
