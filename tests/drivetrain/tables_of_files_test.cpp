// tables_of_files_test.cpp — characteristics from files: their units, columns, corrections, and what they count from.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "engine/reading/tolerances.h"
#include "engine/scene/messages.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::test::tables_of_files_test {
namespace {

namespace fs = std::filesystem;
constexpr double rpm = std::numbers::pi / 30;

class TablesOfFiles : public testing::Test {
 protected:
  // A motor by that table, against 10 s of a flywheel.
  std::string scene(const std::string& table) const {
    return fmt::format(R"(line = ["motor", "wheel"]
motor = {{ kind = "motor", inertia = "0.4 kg*m2", torque = {{ over = "speed", {} }} }}
wheel = {{ kind = "flywheel", inertia = "1 kg*m2" }}
run = {{ until = "10 s" }}
)",
                       table);
  }
  Scene read(const std::string& table) const {
    return parse_scene(scene(table), (folder_ / "scene.toml").string(), all_kinds());
  }
  void write(const std::string& text, const std::string& name = "data.csv") const {
    std::ofstream(folder_ / name) << text;
  }
  const CurveData& curve(const Scene& of) const { return (*of.find("motor"))["torque"].curve; }
  std::string refusal(const std::string& table) const {
    try {
      read(table);
    } catch (const SceneError& error) {
      const Message& m = error.messages.front();
      return fmt::format("{}:{}:{}: {}", fs::path(m.file).filename().string(), m.at.line, m.at.column, m.text);
    }
    return "";
  }
  const test::ScratchFolder folder_;
};

TEST_F(TablesOfFiles, UnitsOfTheHeadingAreUsed) {
  write("speed [rad/s],torque [kN*m]\n0,0.01\n157.08,0\n");
  const Scene s = read("file = \"data.csv\"");
  EXPECT_EQ(curve(s).x, (std::vector<double>{0, 157.08}));
  EXPECT_EQ(curve(s).y, (std::vector<double>{10, 0}));
  EXPECT_EQ(curve(read("file = \"data.csv\", unit = [\"rad/s\", \"kNm\"]")).y, curve(s).y) << "the same, said twice";
}

TEST_F(TablesOfFiles, OtherUnitsInTheSceneAreRefusedNamingBoth) {
  try {
    scene_file("tests/cases/reports/heading_units.toml");
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_FALSE(error.messages.empty());
    EXPECT_NE(
        error.messages[0].text.find("unit = \"rpm\", but the heading \"speed [rad/s]\" of the file says \"rad/s\""),
        std::string::npos)
        << error.what();
  }
  write("speed [rpm];torque [in-lb]\n0;1\n1;0\n");
  EXPECT_EQ(refusal("file = \"data.csv\", unit = [\"rpm\", \"N*m\"]").substr(0, 31),
            "data.csv:1:13: motor \"motor\": t");
  write("speed;torque\n0;1\n1;0\n");
  EXPECT_NE(refusal("file = \"data.csv\"").find("neither \"unit\" nor the heading of column 1"), std::string::npos);
  write("speed [rpm];torque [lb*ft]\n0;1\n1;0\n");
  EXPECT_NE(refusal("file = \"data.csv\"").find("\"lb\" is a mass — did you mean \"lbf\"?"), std::string::npos);
}

TEST_F(TablesOfFiles, ColumnsAreChosenByName) {
  write("time;Torque (Nm);speed / min^-1\n0;100;0\n1;80;1000\n2;0;1500\n");
  const Scene s = read("file = \"data.csv\", columns = [\"speed\", \"torque\"]");
  EXPECT_NEAR(curve(s).x.back(), 1500 * rpm, 1e-12 * 1500);
  EXPECT_EQ(curve(s).y, (std::vector<double>{100, 80, 0}));
  EXPECT_EQ(curve(read("file = \"data.csv\", columns = [3, \"torque\"]")).y, curve(s).y);
  EXPECT_NE(refusal("file = \"data.csv\", columns = [\"spede\", \"torque\"]")
                .find("the file has no column \"spede\" — did you mean \"speed\"?; there are"),
            std::string::npos);
}

TEST_F(TablesOfFiles, GainOffsetAndShiftCorrectATable) {
  const Scene s = read(
      R"(unit = ["rpm", "N*m"], points = [[0, 100], [1500, 10]], gain = 1.1, offset = "-2 N*m", shift = "30 rpm")");
  EXPECT_NEAR(curve(s).x[0], 30 * rpm, 1e-12);
  EXPECT_NEAR(curve(s).y[0], 108, 1e-12);
  EXPECT_NEAR(curve(s).y[1], 9, 1e-12);
  // With tolerances: their values count, and `uncertainty` finds them.
  const std::string table =
      R"(unit = ["rpm", "N*m"], points = [[0, 100], [1500, 10]], gain = { value = 1.1, tolerance = "5 %" }, offset = { value = "-2 N*m", tolerance = "1 N*m" }, shift = { value = "30 rpm", tolerance = "10 rpm" })";
  const Scene with = read(table);
  EXPECT_EQ(curve(with).y, curve(s).y);
  EXPECT_EQ(curve(with).x, curve(s).x);
  const auto tolerances = tolerances_of(scene(table), "scene.toml");
  ASSERT_EQ(tolerances.size(), 3u);
  EXPECT_EQ(tolerances[0].path, "motor.torque.gain");
  EXPECT_NE(refusal("formula = \"1 [N*m]\", range = [\"0 rpm\", \"1 rpm\"], gain = 2").find("keep one"),
            std::string::npos);
}

// Report: 757.4 rpm, as the cylinder that should not fire did; with 0° = firing 567.1 rpm.
TEST(DiagramsZero, APressureThatCountsFromGasExchangeIsNoticed) {
  const std::string text = [] {
    std::ifstream file(source_path("tests/cases/reports/misfire_convention.toml"));
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  std::string said;
  try {
    compile(scene_from(text), Effects{});
  } catch (const SceneError& error) {
    said = error.messages.front().text;
  }
  EXPECT_NE(said.find("stands at 372 deg"), std::string::npos) << said;
  EXPECT_NE(said.find("zero = \"gas exchange\""), std::string::npos) << said;
  const auto with = [&](const std::string& zero) {
    std::string changed = text;
    changed.replace(changed.find("misfire ="), 9, fmt::format("zero = \"{}\", misfire =", zero));
    Scene scene = scene_from(changed);
    scene.run.until = 30;
    return figure(run(scene, false), "mean_speed.engine") / rpm;
  };
  EXPECT_NEAR(with("gas exchange"), 567.1, 0.1);
  EXPECT_NEAR(with("firing"), 757.4, 0.1) << "as said";
}

// The same diagram from firing, moved, reversed, and as torque.
TEST(DiagramsZero, PeakAndWorkShowWhereADiagramBegins) {
  const auto refusal = [](const std::string& diagram, const std::string& more = "") {
    try {
      compile(scene_from(fmt::format(R"(
line = ["engine", "brake"]
engine = {{ kind = "engine", firing_order = [1], inertia = "1 kg*m2", {} {} }}
brake = {{ kind = "load", damping = "0.8 N*m*s/rad" }}
)",
                                     more, diagram)),
              Effects{});
    } catch (const SceneError& error) {
      return error.messages.front().text;
    }
    return std::string();
  };
  const auto pressure = [](const std::string& points) {
    return fmt::format(
        R"(bore = "85 mm", radius = "44 mm", rod = "141 mm", pressure = {{ over = "angle", unit = ["deg", "bar"], {} }})",
        points);
  };
  const std::string fired =
      "points = [[0, 20], [12, 45], [60, 10], [180, 2], [200, 1], [540, 1], [690, 12], [720, 20]]";
  EXPECT_EQ(refusal(pressure(fired)), "");
  EXPECT_NE(refusal(pressure(fired + ", shift = \"360 deg\"")).find("zero = \"gas exchange\""), std::string::npos);
  EXPECT_EQ(refusal(pressure(fired + ", shift = \"360 deg\""), "zero = \"gas exchange\","), "");
  EXPECT_NE(refusal(pressure(fired + ", shift = \"150 deg\"")).find("near no top dead centre"), std::string::npos);
  // Its angle counts backwards: x → −x.
  const std::string turned =
      "points = [[0, 20], [30, 12], [180, 1], [520, 1], [540, 2], [660, 10], [708, 45], [720, 20]]";
  EXPECT_NE(refusal(pressure(turned)).find("backwards"), std::string::npos);
  const std::string torque =
      R"(torque = { over = "angle", unit = ["deg", "N*m"], points = [[360, 0], [390, 90], [540, 0], [700, -40], [720, 0], [1080, 0]] })";
  EXPECT_NE(refusal(torque).find("zero = \"gas exchange\""), std::string::npos);
  EXPECT_EQ(refusal(torque, "zero = \"gas exchange\","), "");
  EXPECT_NE(refusal(torque, "strokes = \"two\", zero = \"gas exchange\",").find("deg"), std::string::npos);
}

}  // namespace
}  // namespace kurbel::test::tables_of_files_test
