// extreme_lengths_test.cpp — a mechanism whose lengths lie too far apart is refused at once, at its line; up to there it
// is reduced at once, too.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/events/equations.h"
#include "engine/reading/read_scene.h"
#include "engine/reading/settings.h"
#include "studies/scenes/kinds.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::extreme_lengths_test {
namespace {

namespace fs = std::filesystem;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Length {
  std::string text, file, component, key;
  double crank = 0;
};

// Of a scene for each kind of mechanism.
std::vector<Length> lengths_of_every_mechanism() {
  std::vector<Length> lengths;
  std::set<std::string> kinds;
  for (const auto& entry : fs::directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const Scene scene = parse_scene(text.str(), entry.path().string(), all_kinds());
    for (const Section& s : scene.components) {
      if (s.kind->name != "slider-crank" && s.kind->name != "four-bar" && s.kind->name != "quick-return" &&
          s.kind->name != "knuckle press")
        continue;
      if (!kinds.insert(s.kind->name).second) continue;
      const auto is_length = [](const Key& key) { return key.unit == "m"; };
      const Key& crank = *std::find_if(s.kind->keys.begin(), s.kind->keys.end(), is_length);
      for (const Key& key : s.kind->keys)
        if (is_length(key) && key.name != crank.name)
          lengths.push_back({text.str(), scene.file, s.name, key.name, s.number(crank.name)});
    }
  }
  EXPECT_EQ(kinds.size(), 4u);
  return lengths;
}

TEST(ExtremeLengths, AreRefusedAtTheirPlaceAtOnce) {
  for (const Length& l : lengths_of_every_mechanism())
    for (const double factor : {1.1e9, 1e15, 1e28}) {
      const std::string setting = fmt::format("{}.{}={} m", l.component, l.key, factor * l.crank);
      const double begin = processor_seconds();
      try {
        parse_scene(SettledText(l.text, l.file, {setting}), all_kinds());
        // Read; what builds it says so.
        const Scene scene = parse_scene(SettledText(l.text, l.file, {setting}), all_kinds());
        compile(scene, scene.effects);
        ADD_FAILURE() << setting << " is sound";
      } catch (const SceneError& error) {
        ASSERT_FALSE(error.messages.empty());
        EXPECT_GT(error.messages.front().at.line, 0) << error.what();
      }
      EXPECT_LT(processor_seconds() - begin, 1) << setting;
    }
}

// A rod of any length that is allowed: x = r cos φ + l cos β → r cos φ + l as l grows, and I_r with it.
TEST(ExtremeLengths, LongRodsTendToTheScotchYoke) {
  const std::string text = R"(
line = ["motor", "crank"]
motor = { kind = "dc shunt motor", stall_torque = "40 N*m", no_load_speed = "62 rad/s", inertia = "0 kg*m2" }
crank = { kind = "slider-crank", radius = "50 mm", rod = "1 m", crank_inertia = "0.05 kg*m2", slider_mass = "8 kg" }
run = { until = "1 s" }
)";
  for (const double rod : {1e2, 1e4, 1e6, 4.9e7}) {
    const double begin = processor_seconds();
    const Scene scene = parse_scene(SettledText(text, "yoke.toml", {fmt::format("crank.rod={} m", rod)}), all_kinds());
    const auto model = compile(scene, scene.effects);
    Equations equations(model, false);
    for (const double phi : {0.3, 1.2, 2.9, 4.4}) {
      const std::vector<double> y = equations.state_of(0, phi, {}, std::vector{1.0});
      const double expected = 0.05 + 8 * std::pow(0.05 * std::sin(phi), 2);  // of the Scotch yoke
      EXPECT_NEAR(equations.shaft_balance(0, 0, y).inertia, expected, expected * (0.11 / rod + 1e-16 * rod / 0.05 * 20))
          << rod << " m at " << phi;
    }
    EXPECT_LT(processor_seconds() - begin, 1) << rod;
  }
}

}  // namespace
}  // namespace kurbel::extreme_lengths_test
