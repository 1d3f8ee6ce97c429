// read_scene.h — from a scene's file, or its text, to a scene that can be built.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/settings.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads a scene; `kinds` lists the components that a line may hold. Throws SceneError with all errors of the file.
Scene read_scene(const std::string& path, const std::vector<Kind>& kinds,
                 DataFiles allowed = DataFiles::below_the_scene);
Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene);

// With settings put into its text (settings.h). Errors are placed in the file as it stands and in the settings; those
// of what is built from the scene later must be placed by settled.placed().
Scene parse_scene(const SettledText& settled, const std::vector<Kind>& kinds,
                  DataFiles allowed = DataFiles::below_the_scene);

}  // namespace kurbel
