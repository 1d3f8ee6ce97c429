// printable.h — texts without terminal control sequences; names and titles may contain any characters.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

// On one line: control characters, marks that change the writing direction and invalid UTF-8 are shown as \n, \x1B,
// \u202E.
std::string printable(std::string_view text);
// The same on several lines: line feeds and tabs are kept.
std::string printable_lines(std::string_view text);
// The same for JSON, where such characters occur only in strings: \u001b.
std::string printable_json(std::string_view json);

}  // namespace kurbel
