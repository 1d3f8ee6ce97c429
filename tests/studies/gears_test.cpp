// gears_test.cpp — kurbel gears: stages of a scene, a pair alone, what a gearbox takes from its teeth, the report's
// data.
#include "studies/gears/gears.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/model/model.h"
#include "studies/report/render.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace kurbel::gears_test {
namespace {

std::string train(const std::string& stage) {
  return fmt::format(R"(
line = ["motor", "gearbox", "fan"]
motor   = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }}
gearbox = {{ kind = "gearbox", stages = [{{ {} }}] }}
fan     = {{ kind = "load", quadratic = "0.1 N*m*s2/rad2", inertia = "2 kg*m2" }}
)",
                     stage);
}

TEST(GearboxFromTeeth, HasTheInertiasOfItsWheelsOnTheirShafts) {
  GearPairData d;
  d.module = 4e-3;
  d.teeth = {19, 95};
  d.width = {0.04, 0.04};
  const GearPair pair = solve_gear_pair(d);
  const Scene scene = test::scene_from(train("teeth = [19, 95], module = \"4 mm\", width = \"40 mm\""));
  const auto model = compile(scene, {});
  double in = 0, out = 0;
  for (const Network::Node& node : model->network.nodes) {
    if (node.component != "gearbox") continue;
    (node.label == "in" ? in : out) += node.inertia;
  }
  EXPECT_NEAR(in, pair.wheel[0].inertia, 1e-12);
  EXPECT_NEAR(out, pair.wheel[1].inertia, 1e-12);
  // A solid steel wheel of 380 mm and 40 mm width: about ½ m r².
  EXPECT_NEAR(out, 0.5 * 7850 * 0.04 * std::numbers::pi * std::pow(0.19, 4), 0.03 * out);
}

TEST(GearboxFromTeeth, GivenInertiasGoFirst) {
  const Scene scene =
      test::scene_from(train("teeth = [19, 95], module = \"4 mm\", inertia = [\"0.5 kg*m2\", \"0.25 kg*m2\"]"));
  const auto model = compile(scene, {});
  for (const Network::Node& node : model->network.nodes)
    if (node.component == "gearbox") {
      EXPECT_EQ(node.inertia, node.label == "in" ? 0.5 : 0.25);
    }
}

std::string fault_of(const std::string& stage) {
  try {
    const Scene scene = test::scene_from(train(stage));
    compile(scene, {});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(GearboxFromTeeth, SaysWhatIsMissingOrWrong) {
  EXPECT_NE(fault_of("teeth = [19, 95], width = \"40 mm\"").find("width needs the module"), std::string::npos);
  EXPECT_NE(fault_of("teeth = [19, 95], module = \"4 mm\"").find("needs the width"), std::string::npos);
  EXPECT_NE(fault_of("teeth = [19, 95], module = \"4 mm\", width = \"40 mm\", shift = [0.1]").find("must be two"),
            std::string::npos);
  EXPECT_NE(fault_of("teeth = [40, 30], module = \"4 mm\", width = \"40 mm\", internal = true").find("more than"),
            std::string::npos);
  EXPECT_NE(fault_of("teeth = [19, 95], module = \"4 mm\", width = \"40 mm\", centre_distance = \"100 mm\"")
                .find("base circles touch"),
            std::string::npos);
}

TEST(GearsStudy, FindsTheStagesGivenByModuleAndCarriesTheSpeedOn) {
  const Scene scene = test::scene_from(train(
      "teeth = [19, 95], module = \"4 mm\", width = \"40 mm\" }, { teeth = [20, 60] }, { teeth = [18, 90], module = "
      "\"6 mm\", width = \"60 mm\""));
  const Gears g = find_gears(scene, {.pair = "", .speed = 150.0});
  ASSERT_EQ(g.stages.size(), 2u);
  EXPECT_EQ(g.stages[0].name, "gearbox.stage1");
  EXPECT_EQ(g.stages[1].name, "gearbox.stage3");
  EXPECT_NEAR(*g.stages[1].speed, 150.0 / 5 / 3, 1e-12);
  EXPECT_NEAR(g.stages[0].pair.mesh_frequency(*g.stages[0].speed), 150 * 19 / (2 * std::numbers::pi), 1e-9);
  EXPECT_EQ(g.notes.size(), 1u);
  EXPECT_EQ(find_gears(scene, {.pair = "gearbox.stage3", .speed = {}}).stages.size(), 1u);
  EXPECT_THROW(find_gears(scene, {.pair = "gearbox.stage2", .speed = {}}), std::invalid_argument);
}

TEST(GearsStudy, ReportDrawsWholeWheelsAndSaysTheNumbers) {
  GearPairData d;
  d.module = 4e-3;
  d.teeth = {19, 95};
  d.width = {0.04, 0.04};
  const Gears g = single_pair(d, 150.0);
  const StudyOutput output = output_of(g);
  const auto json = nlohmann::json::parse(output.json());
  EXPECT_NEAR(json["pairs"][0]["centre_distance"].get<double>(), 0.228, 1e-12);
  EXPECT_NE(output.text().find(output.conclusion()), std::string::npos);
  const Report report = output.report();
  const GearView* view = nullptr;
  for (const ReportSection& section : report.sections)
    for (const Card& card : section.cards)
      if (const GearView* found = std::get_if<GearView>(&card)) view = found;
  ASSERT_NE(view, nullptr);
  for (const GearView::Wheel& wheel : view->wheels) {
    // One pitch closes on the next.
    const double turn = 2 * std::numbers::pi / wheel.teeth, x = wheel.x.front(), y = wheel.y.front();
    const double next_x = std::cos(turn) * x - std::sin(turn) * y, next_y = std::sin(turn) * x + std::cos(turn) * y;
    EXPECT_LT(std::hypot(next_x - wheel.x.back(), next_y - wheel.y.back()), d.module);
  }
  // The contacts drawn lie on the path, one to two at a time.
  const double first =
      view->first_contact + std::ceil((view->start - view->first_contact) / view->base_pitch) * view->base_pitch;
  EXPECT_LE(first, view->end);
  EXPECT_GT(first + 2 * view->base_pitch, view->end);
  EXPECT_NE(html_of(report).find("\"kind\":\"gears\""), std::string::npos);
}

using test::Said;
constexpr auto kurbel = test::said_by_program;

// Where a pair has several findings of one severity, the conclusion shows one and says where the others are.
TEST(GearsCommand, OneOfSeveralWarningsNamesThePlaceOfTheOthers) {
  const std::string text = kurbel("gears --teeth 9 60 --module '4 mm' --no-files").text;
  EXPECT_NE(text.find("customary (first of 3 warnings in its verdicts)"), std::string::npos) << text;
  std::size_t warnings = 0;
  for (std::size_t at = text.find("\nverdicts\n"); at != std::string::npos; at = text.find("\n  warning: ", at + 1))
    ++warnings;
  EXPECT_EQ(warnings, 4u) << text;  // the heading and three
}

TEST(GearsCommand, PairAloneOnTheCommandLine) {
  const Said said = kurbel(
      "gears --no-files --json --teeth 31 30 --module '3.5 mm' --helix '21 deg' "
      "--centre-distance '116.5 mm' --shift 0.291 --backlash '0.03 mm'");
  ASSERT_EQ(said.code, 0) << said.text;
  const auto pair = nlohmann::json::parse(said.text)["pairs"][0];
  EXPECT_NEAR(pair["shift_sum"].get<double>(), 0.651877131252, 1e-9);
  EXPECT_NEAR(pair["backlash_normal"].get<double>(), 0.03e-3, 1e-10);
  EXPECT_EQ(kurbel("gears --no-files --quiet --teeth 18 -72 --module '4 mm'").code, 0);
}

TEST(GearsCommand, BevelAndWormPairs) {
  const Said bevel = kurbel("gears --no-files --json --teeth 20 40 --module '3 mm' --shaft-angle '90 deg'");
  ASSERT_EQ(bevel.code, 0) << bevel.text;
  EXPECT_NEAR(nlohmann::json::parse(bevel.text)["cone_angle"][0].get<double>(), std::atan(0.5), 1e-12);
  const Said worm = kurbel("gears --no-files --teeth 1 40 --module '4 mm' --worm-diameter '50 mm' --friction 0.09");
  ASSERT_EQ(worm.code, 0) << worm.text;
  EXPECT_NE(worm.text.find("self-locking"), std::string::npos) << worm.text;
}

TEST(GearsCommand, SceneOfTheExample) {
  const std::string scene = std::string(KURBEL_SOURCE_DIR) + "/scenes/gear_pair.toml";
  const Said said = kurbel("gears --no-files " + scene + " --speed '1450 rpm'");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_NE(said.text.find("valid geometry"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("gear-mesh frequency"), std::string::npos);
}

TEST(GearsCommand, BadInputEndsWithTwoInWords) {
  const auto refused = [](const std::string& arguments, const std::string& words) {
    const Said said = kurbel("gears --no-files " + arguments);
    EXPECT_EQ(said.code, 2) << arguments;
    EXPECT_NE(said.text.find(words), std::string::npos) << said.text;
  };
  const std::string press = std::string(KURBEL_SOURCE_DIR) + "/scenes/crank_press.toml";
  refused("", "give a scene");
  refused(press, "no gearbox stage has its module given");
  refused(press + " --module '4 mm'", "belongs to a pair alone");
  refused("--teeth 19 95", "needs --module");
  refused("--teeth 19 95 --module 4", "--module");
  refused("--teeth 19 95 --module '4 kg'", "a length > 0");
  refused("--teeth 4 95 --module '4 mm'", "5 teeth");
}

}  // namespace
}  // namespace kurbel::gears_test
