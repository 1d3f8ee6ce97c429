// schema.h — the JSON Schema of a scene, from the same table of keys that the reader uses.
#pragma once

#include <string>

namespace kurbel {

// Draft 2020-12; editors with TOML support (taplo, Even Better TOML) use it to complete and check scenes.
std::string scene_schema();

}  // namespace kurbel
