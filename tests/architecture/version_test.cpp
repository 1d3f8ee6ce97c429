// version_test.cpp — the version is that of project() in CMakeLists.txt, and is written nowhere else but on the manual page.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace kurbel::version_test {
namespace {

namespace fs = std::filesystem;

const fs::path sources = KURBEL_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string version_of_project() {
  const std::string lists = text_of(sources / "CMakeLists.txt"), begin = "project(kurbel VERSION ";
  const std::size_t at = lists.find(begin) + begin.size();
  return lists.substr(at, lists.find(' ', at) - at);
}

// What programs and packages are made of.
std::vector<fs::path> files_with_versions() {
  std::vector<fs::path> files = {sources / "pyproject.toml", sources / "setup.py"};
  for (const char* const room : {"app", "engine", "library", "python", "scripts", "studies"})
    for (const auto& entry : fs::recursive_directory_iterator(sources / room))
      if (entry.is_regular_file() && entry.path().parent_path().filename() != "vendor") files.push_back(entry.path());
  return files;
}

}  // namespace

TEST(Version, IsWrittenOnceAndOnTheManualPage) {
  const std::string version = version_of_project();
  ASSERT_EQ(std::count(version.begin(), version.end(), '.'), 2) << version;
  EXPECT_NE(text_of(sources / "docs/kurbel.1").find("\"kurbel " + version + "\""), std::string::npos)
      << "docs/kurbel.1 is not of version " << version;
  const std::vector<fs::path> files = files_with_versions();
  EXPECT_GT(files.size(), 300u);
  for (const fs::path& file : files) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
      EXPECT_TRUE(line.find(version) == std::string::npos || line.starts_with("//"))
          << file << " has a version of its own: " << line;
  }
}

TEST(Version, TheProgramSaysIt) {
  const std::string out = testing::TempDir() + "version.txt";
  const std::string command = fmt::format("{} --version > {}", KURBEL_EXECUTABLE, out);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(text_of(out), "kurbel " + version_of_project() + "\n");
}

}  // namespace kurbel::version_test
