// seeds.cpp — files of the repository, in the order of their names.
#include "tests/fuzz/seeds.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kurbel::fuzz {
namespace {

namespace fs = std::filesystem;

void add_folder(const std::string& folder, const std::string& extension, std::vector<Seed>& seeds) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(KURBEL_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    seeds.push_back({path.stem().string(), text.str()});
  }
}

std::vector<Seed> from(const std::vector<std::string>& folders, const std::string& extension) {
  std::vector<Seed> seeds;
  for (const std::string& folder : folders) add_folder(folder, extension, seeds);
  return seeds;
}

}  // namespace

const std::vector<Seed>& good_scenes() {
  static const std::vector<Seed> seeds = from({"scenes"}, ".toml");
  return seeds;
}
const std::vector<Seed>& all_scenes() {
  static const std::vector<Seed> seeds = from({"scenes", "tests/bad_scenes"}, ".toml");
  return seeds;
}
const std::vector<Seed>& crashes() {
  static const std::vector<Seed> seeds = from({"tests/cases/crashes"}, ".toml");
  return seeds;
}
const std::vector<Seed>& tables() {
  static const std::vector<Seed> seeds = from({"scenes/data", "tests/bad_scenes"}, ".csv");
  return seeds;
}
const std::vector<Seed>& train_sheets() {
  static const std::vector<Seed> seeds = [] {
    std::vector<Seed> sheets = from({"tests/cases"}, ".csv");
    std::erase_if(sheets, [](const Seed& seed) { return !seed.name.starts_with("ts"); });
    return sheets;
  }();
  return seeds;
}

std::string scene_path() { return KURBEL_SOURCE_DIR "/scenes/fuzzed.toml"; }

}  // namespace kurbel::fuzz
