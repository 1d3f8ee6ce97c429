// files.h — files as texts; a folder for a test's own.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace kurbel::test {

// All bytes of a file; empty if there is none.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// An empty folder, which goes away at the end with all that is in it.
struct ScratchFolder {
  const std::filesystem::path path = made();
  ScratchFolder() = default;
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() { std::filesystem::remove_all(path); }
  operator const std::filesystem::path&() const { return path; }
  std::string string() const { return path.string(); }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path / name; }

 private:
  static std::filesystem::path made() {
    std::string pattern = std::filesystem::canonical(std::filesystem::temp_directory_path()) / "kurbel_XXXXXX";
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder: " + pattern);
    return pattern;
  }
};

}  // namespace kurbel::test
