// templates.h — scenes to start from, built into the program: the files in scenes/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct SceneTemplate {
  std::string name;       // "press"
  std::string doc;        // the machine
  std::string_view text;  // of the file in scenes/
};

const std::vector<SceneTemplate>& scene_templates();

}  // namespace kurbel
