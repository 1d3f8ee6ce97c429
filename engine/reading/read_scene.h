// read_scene.h — from a scene's file, or its text, to a scene that can be built.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/settings.h"
#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads a scene; `kinds` lists the components that a line may hold. Throws SceneError with all errors of the file.
Scene read_scene(const std::string& path, const std::vector<Kind>& kinds,
                 DataFiles allowed = DataFiles::below_the_scene);
Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene);

// As parse_scene of the text that the document was made from, without its [[case]]; an empty text if there is none.
Scene scene_from(DocumentValue document, const std::string& text, const std::string& file,
                 const std::vector<Kind>& kinds, DataFiles allowed = DataFiles::below_the_scene);

// With settings put into its text (settings.h). Errors are placed in the file as it stands and in the settings; those
// of what is built from the scene later must be placed by settled.placed(). `with_cases`: those of [[case]] are
// checked, too.
Scene parse_scene(const SettledText& settled, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene, bool with_cases = true);

// A named variant of a scene: a failed valve, a damper out of order, one cylinder without compression. What it sets is put
// into the scene's text; that is tried when the scene is read.
//
//     [[case]]
//     name = "damper out of order"
//     set  = ["damper.damping=0 N*m*s/rad"]     # as --set takes them
struct Case {
  std::string name;
  std::vector<std::string> settings;
  std::vector<Location> setting_at = {};
};

// Of a scene's text that was read without fault, in its order.
std::vector<Case> cases_of(const std::string& text, const std::string& file);

// The scene of one; `settings` were given beside the file, those of the case come behind them. Throws SceneError.
Scene scene_of(const Case& one, const std::string& text, const std::string& file,
               const std::vector<std::string>& settings, const std::vector<Kind>& kinds, DataFiles allowed);

}  // namespace kurbel
