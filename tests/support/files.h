// files.h — files as texts.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace kurbel::test {

// All bytes of a file; empty if there is none.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace kurbel::test
