// csv_test.cpp — tables of measured data in the forms that programs write.
#include "engine/scene/csv.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace kurbel {
namespace {

struct Read {
  Columns columns;
  std::vector<std::string> errors;  // "line:column: text"
};

Read read(const std::string& text, int x = 1, int y = 2) {
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::temp_directory_path() / ("kurbel_csv_" + name + ".csv");
  std::ofstream(path, std::ios::binary) << text;
  Messages messages("scene.toml");
  Read result{read_csv(path.string(), x, y, messages), {}};
  for (const Message& m : messages.all()) {
    EXPECT_EQ(m.file, path.string());
    result.errors.push_back(std::to_string(m.at.line) + ":" + std::to_string(m.at.column) + ": " + m.text);
  }
  std::filesystem::remove(path);
  return result;
}

using Doubles = std::vector<double>;
using Texts = std::vector<std::string>;

TEST(Csv, HeaderCommentsAndBlankLinesArePassedOver) {
  const Read r = read("# measured\n\ntime [s],torque [N*m]\n0,1\n\n  # a pause\n0.5,2\n");
  EXPECT_EQ(r.columns.x, (Doubles{0, 0.5}));
  EXPECT_EQ(r.columns.y, (Doubles{1, 2}));
  EXPECT_EQ(r.columns.line, (std::vector<int>{4, 7}));
  EXPECT_TRUE(r.errors.empty());
}

TEST(Csv, CommaSemicolonAndTabSeparate) {
  for (const char* text : {"0,1\n2,3", "0;1\n2;3\n", "0\t1\n2\t3\n", " 0 , 1 \n\"2\",\"3\"\n"}) {
    const Read r = read(text);
    EXPECT_EQ(r.columns.x, (Doubles{0, 2})) << text;
    EXPECT_EQ(r.columns.y, (Doubles{1, 3})) << text;
  }
}

TEST(Csv, WindowsLineEndsAndByteOrderMarkDoNoHarm) {
  const Read r = read(
      "\xEF\xBB\xBF"
      "0,1\r\n2,+3\r\n");
  EXPECT_EQ(r.columns.y, (Doubles{1, 3}));
  EXPECT_TRUE(r.errors.empty());
}

TEST(Csv, ColumnsAreChosenByNumber) {
  const Read r = read("t,a,b\n0,9,5\n1,9,6\n", 1, 3);
  EXPECT_EQ(r.columns.y, (Doubles{5, 6}));
  EXPECT_EQ(read("0,9,5\n", 3, 1).columns.x, (Doubles{5}));
}

TEST(Csv, DecimalCommaIsRefusedAndNeverMisread) {
  EXPECT_EQ(read("0,5;1,5\n").errors,
            (Texts{"1:1: \"0,5\" is not a finite number; decimals are written with a point"}));
}

TEST(Csv, FirstRowOfDataIsNoHeader) {
  EXPECT_EQ(read("0,abc\n1,2\n").errors, (Texts{"1:3: \"abc\" is not a finite number"}));
  EXPECT_EQ(read("nan,nan\n1,2\n").errors.size(), 1u);
  EXPECT_EQ(read("1e999,1e999\n1,2\n").errors.size(), 1u);
}

TEST(Csv, OnlyOneHeaderLineIsAllowed) {
  EXPECT_EQ(read("t,M\ns,Nm\n0,1\n").errors, (Texts{"2:1: \"s\" is not a finite number"}));
}

TEST(Csv, BadCellsAreNamedByLineAndColumn) {
  EXPECT_EQ(read("0,1\n 1 ,x\n2\n3,\n").errors,
            (Texts{"2:5: \"x\" is not a finite number",
                   "3:1: column 2 is wanted, but this line has 1 cell; cells are separated by comma, semicolon or tab",
                   "4:1: \"\" is not a finite number"}));
}

TEST(Csv, ManyBadLinesEndTheReading) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "1,x\n";
  const Read r = read(text);
  EXPECT_EQ(r.errors.size(), 21u);
  EXPECT_EQ(r.errors.back(), "21:1: 20 bad lines so far; the rest is not read");
}

TEST(Csv, EmptyFileHasNoRows) { EXPECT_TRUE(read("").columns.x.empty()); }

TEST(Csv, MissingFileThrows) {
  Messages messages("scene.toml");
  EXPECT_THROW(read_csv("/nonexistent/table.csv", 1, 2, messages), SceneError);
}

}  // namespace
}  // namespace kurbel
