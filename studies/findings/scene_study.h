// scene_study.h — what every study of a scene has, whatever its question.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"

namespace kurbel {

struct SceneStudy {
  std::string title, scene_file, scene_text;
  SpeedUnit speed_unit;            // of speeds for people
  std::vector<std::string> notes;  // what its figures omit or depend on
  std::string conclusion;          // empty: made with its findings
  bool complete = true;
  std::string diagnosis;  // of an incomplete one

  void is_of(const Scene& scene) {
    title = scene.heading(), scene_file = scene.file, scene_text = scene.text, speed_unit = scene.speed_unit;
  }
  void break_off(std::string why) { complete = false, diagnosis = std::move(why); }
};

}  // namespace kurbel
