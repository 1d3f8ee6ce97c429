// settings_test.cpp — values given beside a scene: they do what an edit of the file does, and every fault is placed
// where the user can mend it.
#include "engine/reading/settings.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "engine/reading/read_scene.h"
#include "studies/scenes/kinds.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::settings_test {
namespace {

namespace fs = std::filesystem;

const std::string machine = R"(title = "two masses"   # the first line
line = ["motor", "shaft", "wheel"]
effects = { elasticity = ["shaft"] }
[motor]
kind = "dc shunt motor"
stall_torque = "20 N*m"
no_load_speed = "100 rad/s"   # größer als nötig
inertia = "2 kg*m2"
[shaft]
kind = "coupling"
stiffness = "4 kN*m/rad"
damping_ratio = 0.02
[wheel]
kind = "flywheel"
inertia = "1 kg*m2"
[run]
until = "1 s"
start = { speed = "10 rad/s" }
)";

std::string settled(const std::vector<std::string>& settings) {
  return SettledText(machine, "m.toml", settings).text();
}
Scene scene_with(const std::vector<std::string>& settings) {
  return parse_scene(SettledText(machine, "m.toml", settings), all_kinds());
}
std::vector<Message> faults(const std::string& text, const std::vector<std::string>& settings) {
  try {
    parse_scene(SettledText(text, "m.toml", settings), all_kinds());
  } catch (const SceneError& error) {
    return error.messages;
  }
  return {};
}

TEST(Settings, DoWhatAnEditOfTheFileDoes) {
  EXPECT_NE(settled({"shaft.stiffness=1 MN*m/rad"}).find("\nstiffness = \"1 MN*m/rad\"\n"), std::string::npos);
  EXPECT_NE(settled({" shaft.damping_ratio = 0.5 "}).find("\ndamping_ratio = 0.5\n"), std::string::npos);
  EXPECT_NE(settled({"run.start.speed=20 rad/s"}).find("start = { speed = \"20 rad/s\" }"), std::string::npos);
  EXPECT_NE(settled({"effects.elasticity=[]"}).find("elasticity = [] }"), std::string::npos);
  // What is not there comes with the tables that it needs.
  EXPECT_NE(settled({"wheel.inertia_error=3"}).find("[wheel]\ninertia_error = 3\n"), std::string::npos);
  EXPECT_NE(settled({"run.start.angle=90 deg"}).find("{ angle = \"90 deg\", speed"), std::string::npos);
  EXPECT_EQ(scene_with({"run.start.wheel.speed=12 rad/s"}).run.start.components.at("wheel").speed, 12);
  EXPECT_EQ(scene_with({"sequence={ steps = [{ at = \"1 s\", set = \"motor\", to = 0 }] }"}).sequence.steps.size(), 1u);
  EXPECT_FALSE(scene_with({"sequence.repeat=false", "sequence.steps=[{ at = \"1 s\", set = \"motor\", to = 0 }]"})
                   .sequence.repeat);
  EXPECT_EQ(scene_with({"title=\"\\\"quoted\\\"\""}).title, "\"quoted\"");
  EXPECT_EQ(scene_with({"title=a \"b\" \\ c"}).title, "a \"b\" \\ c");
  // Without a value the default holds.
  EXPECT_EQ(settled({"shaft.damping_ratio="}).find("damping_ratio = "), std::string::npos);
  EXPECT_EQ(scene_with({"run.start.speed="}).run.start.speed, 0);
  // Of two for one key the last counts; several go together.
  const Scene both = scene_with({"run.until=3 s", "run.accuracy=1e-4", "run.until=5 s"});
  EXPECT_EQ(both.run.until, 5);
  EXPECT_EQ(both.run.accuracy, 1e-4);
  EXPECT_EQ(both.settings.size(), 3u);
  EXPECT_EQ(both.heading(), "two masses with run.until=3 s, run.accuracy=1e-4, run.until=5 s");
  EXPECT_NE(both.text.find("# set beside the file: \"run.until=5 s\"\n"), std::string::npos);
}

TEST(Settings, ThatLeadNowhereSayWhereAndWhatIsThere) {
  const auto fault = [](const std::string& setting) {
    try {
      settled({setting});
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(fault("shaft.stiffness"),
            "--set \"shaft.stiffness\":1:16: no value; write COMPONENT.KEY=VALUE, e.g. main_coupling.stiffness=1 "
            "MN*m/rad");
  EXPECT_EQ(fault("shaf.stiffness=1 N*m/rad"),
            "--set \"shaf.stiffness=1 N*m/rad\":1:1: the scene has no \"shaf\" — did you mean \"shaft\"?; it has: "
            "\"title\", \"line\", \"effects\", \"motor\", \"shaft\", \"wheel\" and \"run\"");
  EXPECT_EQ(fault("shaft=3"),
            "--set \"shaft=3\":1:1: \"shaft\" is a table; set one of its keys: \"kind\", \"stiffness\" and "
            "\"damping_ratio\"");
  EXPECT_EQ(fault("shaft.stiffness.value=3"),
            "--set \"shaft.stiffness.value=3\":1:17: \"stiffness\" is no table but \"4 kN*m/rad\"");
  EXPECT_EQ(fault("line[4]=wheel"), "--set \"line[4]=wheel\":1:1: \"line\" has 3 items");
  EXPECT_EQ(fault("shaft.backlash="), "--set \"shaft.backlash=\":1:7: there is no \"backlash\" to take away");
  for (const char* wrong : {"=1", ".a=1", "shaft.=1", "shaft..k=1", "line[0]=a", "line[x]=a", "line[]=a", "", "[1]=2"})
    EXPECT_TRUE(fault(wrong).starts_with("--set ")) << wrong << ": " << fault(wrong);
  EXPECT_TRUE(fault("run.start.speed=1 rad/s").find("none") == 0);
  EXPECT_THROW(settled({"run.start={ speed = \"1 rad/s\" }", "run.start.speed=2 rad/s"}), SceneError);
}

// Units, domains and names are checked as in a file; the place is the one within the setting.
TEST(Settings, FaultsAreReportedAtTheirPlaceInTheSetting) {
  const auto expect = [](const std::string& setting, int column, const std::string& words) {
    const std::vector<Message> found = faults(machine, {setting});
    ASSERT_EQ(found.size(), 1u) << setting;
    EXPECT_EQ(found[0].file, "--set \"" + setting + "\"");
    EXPECT_EQ(found[0].at, (Location{1, column})) << setting << ": " << found[0].text;
    EXPECT_NE(found[0].text.find(words), std::string::npos) << found[0].text;
  };
  expect("shaft.stiffness=1 kg", 17, "is a mass");
  expect("shaft.stiffness = -1 N*m/rad", 19, "must be");
  expect("shaft.stifness=1 N*m/rad", 7, "did you mean \"stiffness\"?");
  expect("effects.elasticity=[\"shaft\", \"shaf\"]", 30, "did you mean \"shaft\"?");
  expect("run.start.wheel.sped=1 rad/s", 17, "sped");
  expect("run.method=\"dopry5\"", 12, "dopry5");
}

// Whatever is given: the scene is read, or refused with a place.
// A table that is at fault as a value with a tolerance is read as nothing else.
TEST(Settings, AWrongKeyOfAValueWithAToleranceIsOneFault) {
  std::stringstream stream;
  stream << std::ifstream(test::source_path("scenes/straight_line.toml")).rdbuf();
  std::string text = stream.str();
  const std::string length = "OA = \"280 mm\"", mass = "{ points = \"O A\", mass = \"1 kg\"";
  text.replace(text.find(length), length.size(), "OA = { value = \"280 mm\", tolerance = \"0.1 mm\" }");
  text.replace(text.find(mass), mass.size(), "{ points = \"O A\", mass = { value = \"1 kg\", tolerance = \"5 %\" }");
  for (const char* path : {"saw.lengths.OA.length=281 mm", "saw.links.arm_a.mass.val=2 kg"}) {
    const std::vector<Message> list = faults(text, {path});
    ASSERT_EQ(list.size(), 1u) << path;
    EXPECT_NE(list[0].text.find("the value itself is \"value\""), std::string::npos) << list[0].text;
    EXPECT_EQ(list[0].file, std::string("--set \"") + path + "\"");
  }
  EXPECT_TRUE(faults(text, {"saw.lengths.OA.value=280.05 mm"}).empty());
}

TEST(Settings, OfAnyCharactersAreReadOrRefusedWithAPlace) {
  const std::vector<std::string> pieces = {"shaft", "motor", "run",  "start",     "line", "title", ".",   "=",
                                           "[1]",   "[",     "]",    " ",         "\"",   "'",     "{",   "}",
                                           ",",     "#",     "\n",   "\t",        "1",    "1e9",   "rpm", "-",
                                           "\\",    "ω",     "\xff", "stiffness", "speed"};
  std::mt19937 dice(7);
  int read = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string setting = k % 3 == 0 ? "run.start.speed=" : k % 3 == 1 ? "shaft." : "";
    for (auto n = dice() % 9; n > 0; --n) setting += pieces[dice() % pieces.size()];
    try {
      scene_with({setting});
      ++read;
    } catch (const SceneError& error) {
      ASSERT_FALSE(error.messages.empty());
      for (const Message& m : error.messages) EXPECT_GT(m.at.line, 0) << in_quotes(setting) << ": " << m.text;
    }
  }
  EXPECT_GT(read, 5);
}

// SECURITY.md: what a setting brings is a part of the scene, and so are the data files that it names.
TEST(Settings, ReadNoDataFilesThatTheSceneMayNotRead) {
  const std::string text = machine + "[pulse]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"1 N*m\"\n";
  EXPECT_TRUE(faults(text, {}).empty());
  const std::string setting = "pulse.table={ over = \"angle\", unit = [\"rad\", \"N*m\"], file = \"/etc/hostname\" }";
  const std::vector<Message> found = faults(text, {setting});
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(found[0].file.starts_with("--set \"pulse.table=")) << found[0].file;
  EXPECT_NE(found[0].text.find("allow-files"), std::string::npos) << found[0].text;
}

// What a setting brings shifts lines and columns; other faults stand where the file has them.
TEST(Settings, LeaveThePlacesOfOtherFaults) {
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(test::source_path("tests/bad_scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    std::stringstream stream;
    stream << std::ifstream(entry.path()).rdbuf();
    const std::vector<Message> plain = faults(stream.str(), {});
    std::vector<Message> with;
    try {
      SettledText(stream.str(), "m.toml", {"run.budget=17 s"});
      with = faults(stream.str(), {"run.budget=17 s"});
    } catch (const SceneError& error) {  // no TOML at all
      with = error.messages;
    }
    SCOPED_TRACE(entry.path().filename().string());
    if (plain.size() != with.size()) continue;  // [run] itself was at fault
    ++compared;
    for (std::size_t k = 0; k < plain.size(); ++k) {
      EXPECT_EQ(plain[k].text, with[k].text);
      EXPECT_EQ(plain[k].at, with[k].at);
      EXPECT_EQ(plain[k].file, with[k].file);
    }
  }
  EXPECT_GT(compared, 100);
}

// Every text of every example scene, set to itself, is the same scene; set to what no key takes, it is at fault there.
void walk(const DocumentValue& value, const std::string& path,
          std::vector<std::pair<std::string, std::string>>& texts) {
  if (value.type == DocumentValue::Type::text) texts.emplace_back(path, value.text);
  for (const DocumentEntry& entry : value.entries)
    walk(entry.value, path.empty() ? entry.key : path + "." + entry.key, texts);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    walk(value.items[i], path + "[" + std::to_string(i + 1) + "]", texts);
}

TEST(Settings, ReachEveryTextOfEveryScene) {
  int reached = 0, at_fault = 0;
  for (const auto& entry : fs::directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().filename().string());
    std::stringstream stream;
    stream << std::ifstream(entry.path()).rdbuf();
    const std::string text = stream.str(), file = entry.path().string();
    std::vector<std::pair<std::string, std::string>> texts;
    walk(parse_toml(text, file), "", texts);
    for (const auto& [path, value] : texts) {
      if (path.find("][") != std::string::npos) continue;  // lists within lists are given as a whole
      const std::string same = path + "=\"" + value + "\"";
      const std::string back = SettledText(text, file, {same}).text();
      EXPECT_EQ(back.substr(0, text.size()), text) << same;
      ++reached;
      if (value.find(' ') == std::string::npos || !std::isdigit(static_cast<unsigned char>(value[0]))) continue;
      const std::string wrong = path + "=1 furlong";
      try {
        parse_scene(SettledText(text, file, {wrong}), all_kinds());
        ADD_FAILURE() << wrong << " was read";
      } catch (const SceneError& error) {
        bool placed = false;
        for (const Message& m : error.messages)
          placed = placed || (m.file == "--set \"" + wrong + "\"" && m.at.column >= static_cast<int>(path.size()) + 2);
        EXPECT_TRUE(placed) << wrong << ": " << error.what();
        ++at_fault;
      }
    }
  }
  EXPECT_GT(reached, 1000);
  EXPECT_GT(at_fault, 600);
}

}  // namespace
}  // namespace kurbel::settings_test
