// twin_gears.h — the gears that machines stand behind, in the order in which scenes need them, and all scenes.
#pragma once

#include "tests/twins/drive_scenes.h"
#include "tests/twins/mechanism_scenes.h"
#include "tests/twins/motor_scenes.h"

namespace kurbel::test {

// ω_in/ω_out = 2.5, −2.5, 0.3, 25.
inline const std::vector<IdealGear>& twin_gears() {
  static const std::vector<IdealGear> gears = {{.teeth = {{20, 50}}},
                                               {.teeth = {{20, 50}}, .reversing = true},
                                               {.teeth = {{60, 18}}},
                                               {.teeth = {{17, 85}, {18, 90}}}};
  return gears;
}

inline const std::vector<TwinScene>& twin_scenes() {
  static const std::vector<TwinScene> scenes = [] {
    std::vector<TwinScene> all = drive_scenes();
    for (const auto& more : {motor_scenes(), angle_scenes(), mechanism_scenes()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return scenes;
}

inline std::vector<IdealGear> gears_of(const TwinScene& scene) {
  std::vector<IdealGear> gears;
  for (std::size_t k = 0; k < scene.gears; ++k)
    if (scene.reversible || !twin_gears()[k].reversing) gears.push_back(twin_gears()[k]);
  return gears;
}

// The scene's name as gtest takes it: CouplingsByAllFormsOfDamping
inline std::string name_of_twin(const ::testing::TestParamInfo<std::size_t>& info) {
  std::string name;
  bool begins = true;
  for (const char c : twin_scenes()[info.param].name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = !std::isalnum(static_cast<unsigned char>(c));
  }
  return name;
}

// A test of every scene.
class EveryScene : public ::testing::TestWithParam<std::size_t> {
 public:
  const TwinScene& scene() const { return twin_scenes()[GetParam()]; }
};

}  // namespace kurbel::test
