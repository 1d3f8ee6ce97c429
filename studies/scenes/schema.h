// schema.h — the JSON Schema of a scene, from the same table of keys that the reader uses.
#pragma once

#include <string>

namespace kurbel {

// Draft 2020-12; editors that know TOML (taplo, Even Better TOML) complete and check a scene by it.
std::string scene_schema();

}  // namespace kurbel
