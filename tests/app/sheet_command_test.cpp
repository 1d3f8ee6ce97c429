// sheet_command_test.cpp — kurbel reduce --sheet and kurbel forces --sheet on the command line: the file, exit codes, words.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace kurbel::sheet_command_test {
namespace {

namespace fs = std::filesystem;

using test::Said;
constexpr auto kurbel = test::said_by_program;

const std::string scenes = std::string(KURBEL_SOURCE_DIR) + "/scenes/";

TEST(SheetCommand, TheSheetIsAFileOfTheResultSet) {
  const test::ScratchFolder scratch;
  const fs::path folder = scratch / "sheet";
  for (const std::string command : {"reduce", "forces --no-run"}) {
    const Said said =
        kurbel(command + " " + scenes + "crank_press.toml --sheet --author 'N. N. <x>' --out " + folder.string());
    EXPECT_EQ(said.code, 0) << said.text;
    EXPECT_NE(said.text.find("sheet: " + (folder / "sheet.html").string()), std::string::npos) << said.text;
    std::ifstream page(folder / "sheet.html"), manifest(folder / "set.sha256");
    const std::string html((std::istreambuf_iterator<char>(page)), {}),
        set((std::istreambuf_iterator<char>(manifest)), {});
    EXPECT_NE(html.find("N. N. &lt;x&gt;"), std::string::npos);
    EXPECT_NE(set.find("sheet.html"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "report.html"));
    fs::remove_all(folder);
  }
}

TEST(SheetCommand, WhatCannotBeDrawnEndsWithTwoInWordsAndWritesNothing) {
  const test::ScratchFolder scratch;
  const fs::path folder = scratch / "none";
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Said said =
        kurbel(arguments + (arguments.find("--no-files") == std::string::npos ? " --out " + folder.string() : ""));
    EXPECT_EQ(said.code, 2) << arguments;
    EXPECT_NE(said.text.find(words), std::string::npos) << said.text;
    EXPECT_FALSE(fs::exists(folder)) << arguments;
  };
  const std::string press = scenes + "crank_press.toml";
  refused("reduce " + scenes + "belt_conveyor.toml --sheet", "has none on its lines that moves");
  refused("reduce " + press + " --sheet --to press.slider", "omit one of the two");
  refused("reduce " + press + " --sheet --paper A5", "must be A4 or A3");
  refused("reduce " + press + " --paper A3", "add --sheet");
  refused("reduce " + press + " --delta 0.05", "add --sheet, or ask kurbel size");
  refused("reduce " + press + " --sheet --delta 3", "must be > 0 and < 2");
  refused("reduce " + press + " --sheet --no-files", "omit one of the two");
  refused("forces " + press + " --sheet --positions 40", "a sheet has 4 … 36 of a turn");
}

}  // namespace
}  // namespace kurbel::sheet_command_test
