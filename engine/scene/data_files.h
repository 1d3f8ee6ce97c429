// data_files.h — which data files a scene may have read.
#pragma once

#include <string>
#include <vector>

namespace kurbel {

struct Kind;
struct Scene;

// A scene from a stranger only those in its own folder and below (SECURITY.md).
enum class DataFiles { below_the_scene, anywhere };

// As in scene.h, where it is the first that is allowed.
Scene read_scene(const std::string& path, const std::vector<Kind>& kinds, DataFiles allowed);
Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds, DataFiles allowed);

}  // namespace kurbel
