// read_scene.h — reads a scene from a file or a text.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/settings.h"
#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads a scene; `kinds`: the allowed components of a line. Throws SceneError with all errors of the file.
Scene read_scene(const std::string& path, const std::vector<Kind>& kinds,
                 DataFiles allowed = DataFiles::below_the_scene);
Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene);

// As parse_scene for the text of the document, without its [[case]]; `text` is empty if there is none.
Scene scene_from(DocumentValue document, const std::string& text, const std::string& file,
                 const std::vector<Kind>& kinds, DataFiles allowed = DataFiles::below_the_scene);

// With settings inserted into its text (settings.h). Errors are located in the original file and in the settings; errors
// of later steps must be located by settled.placed(). `with_cases`: [[case]] tables are checked as well.
Scene parse_scene(const SettledText& settled, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene, bool with_cases = true);

// A named variant of a scene: a failed valve, a damper out of order, one cylinder without compression. Its settings are
// inserted into the scene's text, which is checked when the scene is read.
//
//     [[case]]
//     name = "damper out of order"
//     set  = ["damper.damping=0 N*m*s/rad"]     # as for --set
struct Case {
  std::string name;
  std::vector<std::string> settings;
  std::vector<Location> setting_at = {};
};

// The cases of a scene's text without faults, in order.
std::vector<Case> cases_of(const std::string& text, const std::string& file);

// The scene of a case; `settings`: given in addition to the file; those of the case follow them. Throws SceneError.
Scene scene_of(const Case& one, const std::string& text, const std::string& file,
               const std::vector<std::string>& settings, const std::vector<Kind>& kinds, DataFiles allowed);

}  // namespace kurbel
