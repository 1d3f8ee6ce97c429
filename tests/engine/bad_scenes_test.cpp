// bad_scenes_test.cpp — every malformed scene of tests/bad_scenes says exactly what is wrong with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/model/model.h"
#include "engine/scene/document.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::bad_scenes_test {
namespace {

namespace fs = std::filesystem;

const std::string folder = test::source_path("tests/bad_scenes/");

using test::text_of;

std::vector<std::string> bad_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// What a user in that folder would read.
std::string messages_of(const std::string& name) {
  try {
    const Scene scene = read_scene(folder + name + ".toml", all_kinds());
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    std::string text = std::string(error.what()) + "\n";
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  }
  return "no error\n";
}

std::string message_of(const std::string& text) {
  try {
    const Scene scene = test::scene_from(text);
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

class BadScene : public testing::TestWithParam<std::string> {};

// An expectation says {all kinds} where a message lists them.
std::string expected_of(const std::string& name) {
  std::vector<std::string> names;
  for (const Kind& kind : all_kinds()) names.push_back(kind.name);
  std::string text = text_of(folder + name + ".expected");
  const std::string mark = "{all kinds}";
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
    text.replace(at, mark.size(), listed(names, "or"));
  return text;
}

TEST_P(BadScene, SaysWhatIsWrongAndWhere) { EXPECT_EQ(messages_of(GetParam()), expected_of(GetParam())); }

INSTANTIATE_TEST_SUITE_P(All, BadScene, testing::ValuesIn(bad_scenes()), [](const auto& info) { return info.param; });

TEST(BadScenes, EveryExpectationHasItsScene) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".expected") {
      EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".toml"))) << entry.path();
    }
}

TEST(BadScenes, MissingFileIsNamed) {
  EXPECT_EQ(messages_of("absent"), "absent.toml: no such file; check the path, or list the folder with ls\n");
}

TEST(BadScenes, FolderInPlaceOfAFileIsNamed) {
  try {
    read_scene(folder, all_kinds());
    FAIL() << "a folder was read as a scene";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("is a folder"), std::string::npos);
  }
}

TEST(BadScenes, FileAboveSixteenMegabytesIsRefusedBeforeParsing) {
  const fs::path path = fs::temp_directory_path() / "kurbel_large_scene.toml";
  std::ofstream(path) << std::string(max_scene_bytes + 1, '[');
  try {
    read_scene(path.string(), all_kinds());
    FAIL() << "17 MB were read";
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()), path.string() + ": is larger than 16 MB; put long tables into CSV files");
  }
  fs::remove(path);
}

TEST(BadScenes, DeepNestingOfAnyFormSparesTheStack) {
  constexpr int n = 100'000;
  for (const std::string& text :
       {"x = " + repeated("[", n), "x = " + repeated("{a=", n), "x = " + repeated("[", n) + repeated("]", n),
        repeated("[", n), repeated("a.", n) + "a = 1", "[" + repeated("a.", n) + "a]",
        "[[" + repeated("a . ", n) + "a]]", "x = {" + repeated("a.", n) + "a = 1}", repeated("\"a\".", n) + "a = 1",
        "x = " + repeated("{a.a.a.a.a.a.a.a=", 250) + "1" + repeated("}", 250)}) {
    const std::string said = message_of(text);
    EXPECT_NE(said.find("test.toml:"), std::string::npos) << said.substr(0, 200);
    EXPECT_LT(said.size(), 2000u);
  }
}

TEST(BadScenes, ThousandsOfErrorsAreCutToAHundredLines) {
  std::string text = "line = [\"a\"]\n";
  for (int i = 0; i < 20'000; ++i) text += "key" + std::to_string(i) + " = 1\n";
  const std::string said = message_of(text);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 100);
  EXPECT_TRUE(said.ends_with("more messages"));
}

// Quadratic work on 16 MB of text would take minutes.
TEST(BadScenes, LargeScenesAreReadInSeconds) {
  const auto begin = std::chrono::steady_clock::now();
  std::string text = "line = [\"c0\"]\n";
  for (int i = 0; i < 20'000; ++i)
    text += "[c" + std::to_string(i) + "]\nkind = \"flywheel\"\ninertia = \"1 kg*m2\"\n" +
            (i > 0 ? "on = \"c" + std::to_string(i - 1) + "\"\n" : "");
  EXPECT_EQ(test::scene_from(text).components.size(), 20'000u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace kurbel::bad_scenes_test
