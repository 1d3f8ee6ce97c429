// tasks_test.cpp — the worked tasks in docs/tasks: every command runs, and says what the page says that it says.
//
// A page's blocks "```console" hold commands behind "$ " and, below each, lines of what it prints: each must occur in
// the output, blanks counting as one; a line of "…" leaves some out.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace kurbel::tasks_test {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(KURBEL_SOURCE_DIR) / "docs/tasks";

struct Command {
  std::string line;
  std::vector<std::string> says;
};

std::string one_blank(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

std::vector<Command> commands_of(const fs::path& page) {
  std::ifstream in(page);
  std::vector<Command> commands;
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside && line.starts_with("$ kurbel ")) {
      commands.push_back({line.substr(9), {}});
    } else if (inside && !commands.empty() && !line.empty() && line != "…") {
      commands.back().says.push_back(one_blank(line));
    }
  }
  return commands;
}

// What a command prints in a folder that has the tasks' scenes.
std::string output_of(const std::string& arguments, const fs::path& where) {
  const test::Said said =
      test::said_by("(cd '" + where.string() + "' && '" KURBEL_EXECUTABLE "' " + arguments + " 2>/dev/null)");
  EXPECT_EQ(said.code, 0) << arguments;
  return said.text;
}

class Task : public ::testing::TestWithParam<std::string> {};

TEST_P(Task, EveryCommandSaysWhatThePageSays) {
  const std::vector<Command> commands = commands_of(folder / (GetParam() + ".md"));
  ASSERT_FALSE(commands.empty());
  const test::ScratchFolder here;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto kind = entry.path().extension(); kind == ".toml" || kind == ".csv")
      fs::copy(entry.path(), here.path, fs::copy_options::overwrite_existing);
  for (const Command& command : commands) {
    const std::string text = output_of(command.line, here), printed = one_blank(text);
    EXPECT_FALSE(command.says.empty()) << command.line;
    for (const std::string& line : command.says)
      EXPECT_NE(printed.find(line), std::string::npos)
          << "kurbel " << command.line << "\ndoes not say: " << line << "\nbut:\n"
          << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Worked, Task,
                         ::testing::Values("press", "compressor", "genset", "flywheel", "tolerances", "fan_report",
                                           "compressor_report", "ship_report", "fit", "hoist_control"),
                         [](const auto& info) { return info.param; });

// Each page is in the list of pages, and each scene in a page.
TEST(Tasks, EveryPageAndSceneIsUsed) {
  const auto text_of = [](const fs::path& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  };
  const std::string list = text_of(folder / "README.md");
  std::string pages;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".md" && entry.path().filename() != "README.md") {
      EXPECT_NE(list.find(entry.path().filename().string()), std::string::npos) << entry.path();
      pages += text_of(entry.path());
    }
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() != ".md") {
      EXPECT_NE(pages.find(entry.path().filename().string()), std::string::npos) << entry.path();
    }
}

}  // namespace
}  // namespace kurbel::tasks_test
