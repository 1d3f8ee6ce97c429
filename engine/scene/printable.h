// printable.h — texts that no terminal obeys: names and titles may hold anything.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

// On one line: control characters, marks that turn the direction of writing and what is no UTF-8 are shown as \n, \x1B,
// \u202E.
std::string printable(std::string_view text);
// The same on several lines: line feeds and tabs stay.
std::string printable_lines(std::string_view text);
// The same for JSON, where such characters stand in texts only: \u001b.
std::string printable_json(std::string_view json);

}  // namespace kurbel
