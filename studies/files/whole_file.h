// whole_file.h — a file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "studies/files/staging.h"

namespace kurbel {

enum class Existing { replace, keep };

// Why no file can be written at a path, with a next step; empty: it can.
std::string why_no_file_at(const std::filesystem::path& path);

// Written next to the target under a unique name, flushed, and put in place in one step. A link at the path is itself
// replaced; its target is unchanged. False: a file exists and was to be kept. Throws std::invalid_argument if no file
// can be written at the path, std::runtime_error if writing failed.
bool write_whole(const std::filesystem::path& path, std::string_view text, Existing existing = Existing::replace);

// A file in memory, for libraries that can only write to a path; its bytes are then stored elsewhere.
class MemoryFile {
 public:
  MemoryFile();              // throws std::runtime_error if memory is insufficient
  std::string path() const;  // valid as long as this object
  std::string bytes() const;

 private:
  Descriptor file_;
};

}  // namespace kurbel
