// scene_commands.h — commands that help to write a scene: new, keys, schema.
#pragma once

#include <string>

namespace kurbel::app {

// Writes a scene to start from and, for editors, the schema beside it; refuses to overwrite. Throws
// std::invalid_argument for an unknown kind or a file that cannot be written.
int new_scene(const std::string& kind, const std::string& file);

// All keys as Markdown, or those of one kind as text for a terminal. Throws std::invalid_argument for an unknown kind.
int print_keys(const std::string& kind);

}  // namespace kurbel::app
