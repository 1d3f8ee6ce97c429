// whole_file.h — a file that appears under its name only when it is whole.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace kurbel {

enum class Existing { replace, keep };

// Why no file can be written at a path, with a next step; empty: it can.
std::string why_no_file_at(const std::filesystem::path& path);

// Written beside under a name that nobody else takes, flushed, and put in place in one step. A link at the path is
// replaced itself; what it names stays as it is. False: something is there and was to be kept. Throws
// std::invalid_argument where no file can be written at the path, std::runtime_error where it could not.
bool write_whole(const std::filesystem::path& path, std::string_view text, Existing existing = Existing::replace);

}  // namespace kurbel
