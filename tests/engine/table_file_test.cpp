// table_file_test.cpp — tables in the forms that spreadsheets, measuring programs and people write.
#include "engine/tables/table_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/tables/heading.h"
#include "tests/support/files.h"

namespace kurbel::table_file_test {
namespace {

using Doubles = std::vector<double>;
using Texts = std::vector<std::string>;

struct Read {
  Doubles x, y;
  std::vector<int> line;
  Texts names, units;  // of the heading; "": none
  Texts errors;        // "line:column: text"
};

Read read(const std::string& text, std::vector<int> columns = {1, 2}, const TableForm& form = {}) {
  const test::ScratchFolder folder;
  const auto path = folder / "table";
  std::ofstream(path, std::ios::binary) << text;
  Read result;
  const auto report = [&](const std::vector<Message>& all) {
    for (const Message& m : all) {
      EXPECT_EQ(m.file, path.string());
      result.errors.push_back(fmt::format("{}:{}: {}", m.at.line, m.at.column, m.text));
    }
  };
  try {
    const TableFile file(path.string(), form);
    Messages messages("scene.toml");
    TableNumbers numbers = file.numbers(columns, messages);
    result.x = numbers.columns[0], result.y = numbers.columns[1];
    for (const Location& at : numbers.at) result.line.push_back(at.line);
    for (const TableHeading& h : file.headings())
      result.names.push_back(h.name), result.units.push_back(h.unit.value_or(""));
    report(messages.all());
  } catch (const SceneError& error) {
    report(error.messages);
  }
  return result;
}

void expect_table(const std::string& text, const Doubles& x, const Doubles& y, const TableForm& form = {}) {
  const Read r = read(text, {1, 2}, form);
  EXPECT_EQ(r.x, x) << text;
  EXPECT_EQ(r.y, y) << text;
  EXPECT_EQ(r.errors, Texts()) << text;
}

TEST(TableFile, HeaderCommentsAndBlankLinesArePassedOver) {
  const Read r = read("# measured\n\ntime [s],torque [N*m]\n0,1\n\n  # a pause\n0.5,2\n");
  EXPECT_EQ(r.x, (Doubles{0, 0.5}));
  EXPECT_EQ(r.y, (Doubles{1, 2}));
  EXPECT_EQ(r.line, (std::vector<int>{4, 7}));
  EXPECT_EQ(r.names, (Texts{"time", "torque"}));
  EXPECT_EQ(r.units, (Texts{"s", "N*m"}));
  EXPECT_EQ(r.errors, Texts());
}

TEST(TableFile, CommaSemicolonAndTabSeparate) {
  for (const char* text : {"0,1\n2,3", "0;1\n2;3\n", "0\t1\n2\t3\n", " 0 , 1 \n\"2\",\"3\"\n"})
    expect_table(text, {0, 2}, {1, 3});
}

TEST(TableFile, WindowsLineEndsAndMarksDoNoHarm) {
  expect_table(
      "\xEF\xBB\xBF"
      "0,1\r\n2,+3\r\n",
      {0, 2}, {1, 3});
  expect_table("0;1\r2;3\r", {0, 2}, {1, 3});
}

std::string utf16(const std::string& ascii, bool little, bool marked) {
  std::string bytes;
  const auto put = [&](char high, char low) { bytes += little ? low : high, bytes += little ? high : low; };
  if (marked) put('\xFE', '\xFF');
  for (const char c : ascii) put('\0', c);
  return bytes;
}

TEST(TableFile, Utf16IsRead) {
  for (const bool little : {true, false})
    for (const bool marked : {true, false})
      expect_table(utf16("speed [rpm]\ttorque [Nm]\r\n0\t1,5\r\n2\t3,5\r\n", little, marked), {0, 2}, {1.5, 3.5});
}

TEST(TableFile, Latin1IsRead) {
  const Read r = read("angle [\xB0];M [N\xB7m]\n0;1\n90;2\n");
  EXPECT_EQ(r.units, (Texts{"°", "N·m"}));
  EXPECT_EQ(r.y, (Doubles{1, 2}));
}

TEST(TableFile, ColumnsAreChosenByNumber) {
  EXPECT_EQ(read("t,a,b\n0,9,5\n1,9,6\n", {1, 3}).y, (Doubles{5, 6}));
  EXPECT_EQ(read("0,9,5\n", {3, 1}).x, (Doubles{5}));
}

TEST(TableFile, DecimalCommasAreReadWhereTheyCanBeNothingElse) {
  expect_table("0,5;1,5\n1;2,25\n", {0.5, 1}, {1.5, 2.25});
  expect_table("0,125;1,500\n1,000;2,250\n", {0.125, 1}, {1.5, 2.25});
  expect_table("\"0,5\",\"1,5\"\n\"1,0\",\"2,0\"\n", {0.5, 1}, {1.5, 2});
  expect_table("n;M\n1,5E3;-2,5\n1,6E3;+3,5\n", {1500, 1600}, {-2.5, 3.5});
  expect_table("1,500;2\n2,500;3\n", {1.5, 2.5}, {2, 3}, {.decimal = ','});
}

TEST(TableFile, WhatMayBeThousandsIsRefusedWithItsLine) {
  EXPECT_EQ(read("n;M\n1,500;2\n2,500;3\n").errors,
            (Texts{"2:1: \"1,500;2\": \"1,500\" may be decimals or thousands, as all numbers of the file with a comma; "
                   "say decimal = \",\", or write them without commas"}));
  EXPECT_EQ(read("1.234,5;2\n").errors,
            (Texts{"1:1: \"1.234,5;2\": \"1.234,5\" seems to have its thousands marked; write numbers without marks"}));
  EXPECT_EQ(
      read("0,5;2\n1;2.5\n").errors,
      (Texts{"1:1: \"0,5;2\": \"0,5\" with a comma, and \"2.5\" in line 2 with a point; write all decimals with one "
             "sign"}));
  EXPECT_EQ(read("0,5,1,5\n1,5,2,5\n").errors,
            (Texts{"1:1: \"0,5,1,5\": 4 whole numbers, or 2 with decimal commas; separate cells by semicolons, or say "
                   "decimal = \".\""}));
  EXPECT_EQ(read("n,M\n0,5,1,5\n1,5,2,5\n").errors.size(), 1u);
  EXPECT_EQ(read("0,5,1,5\n1,5,2,5\n", {1, 3}, {.decimal = '.'}).y, (Doubles{1, 2}));
  EXPECT_EQ(read("t,a,b,c\n0,5,1,5\n1,5,2,5\n", {1, 3}).y, (Doubles{1, 2})) << "its heading tells its columns";
}

TEST(TableFile, BannersUnitsAndTrailingEmptyColumnsAreOfNoConsequence) {
  const Read r = read(
      "Pr\xC3\xBC"
      "fstand 3;;;;\nDate;2021;5;;\n;;;;\ntime;n;M;;\ns;1/min;kNm;;\n0;1000;0,5;;\n0,5;1500;0,75;;\n;;;;\n",
      {2, 3});
  EXPECT_EQ(r.x, (Doubles{1000, 1500}));
  EXPECT_EQ(r.y, (Doubles{0.5, 0.75}));
  EXPECT_EQ(r.names, (Texts{"time", "n", "M"}));
  EXPECT_EQ(r.units, (Texts{"s", "1/min", "kNm"}));
  EXPECT_EQ(r.line, (std::vector<int>{6, 7}));
}

TEST(TableFile, AHeadingMayBeARemark) {
  const Read r = read("# made by hand\n# speed [rad/s], torque [kN*m]\n0,0.01\n157.08,0\n");
  EXPECT_EQ(r.units, (Texts{"rad/s", "kN*m"}));
  EXPECT_EQ(read("# one, two\n0,1,2\n1,2,3\n").names, Texts()) << "of two words, for three columns";
}

TEST(TableFile, QuotedCellsMayHoldAnything) {
  const Read r = read("\"speed, of the motor\",\"torque\n[N*m]\"\n\"0\",1\n1,2\n");
  EXPECT_EQ(r.names.front(), "speed, of the motor");
  EXPECT_EQ(r.units.back(), "N*m");
  EXPECT_EQ(r.line, (std::vector<int>{3, 4}));
}

TEST(TableFile, ShorterColumnsEndEarlier) {
  EXPECT_EQ(read("a;b;c;d\n1;2;3;4\n5;6;7;8\n9;10;;\n", {3, 4}).y, (Doubles{4, 8}));
}

TEST(TableFile, FirstRowOfDataIsNoHeader) {
  EXPECT_EQ(read("0,abc\n1,2\n").errors, (Texts{"1:3: \"abc\" is not a finite number"}));
  EXPECT_EQ(read("nan,nan\n1,2\n").errors.size(), 1u);
  EXPECT_EQ(read("1e999,1e999\n1,2\n").errors.size(), 1u);
}

TEST(TableFile, BadCellsAreNamedByLineAndColumn) {
  EXPECT_EQ(read("0,1\n 1 ,x\n2\n3,\n").errors,
            (Texts{"2:5: \"x\" is not a finite number",
                   "3:1: column 2 is wanted, but this line has 1 cell; cells are separated by commas: \"2\"",
                   "4:1: column 2 is wanted, but this line has 1 cell; cells are separated by commas: \"3,\""}));
}

TEST(TableFile, WhatIsNoTableIsRefusedWithWhatItLooksLike) {
  EXPECT_EQ(
      read("time torque\n0 1\n1 2\n").errors,
      (Texts{"2:1: \"0 1\": its numbers seem to be separated by blanks; separate them by comma, semicolon or tab"}));
  EXPECT_EQ(read("a letter\nto you\n").errors,
            (Texts{"1:1: \"a letter\": no line of the file has two numbers; cells are separated by comma, semicolon or "
                   "tab"}));
  EXPECT_EQ(read(std::string("0,1\n\0,2\n", 8)).errors,
            (Texts{"1:1: is no table: byte 5 is zero, as in no text; give .csv or .xlsx"}));
}

TEST(TableFile, ManyBadLinesEndTheReading) {
  std::string text = "0,0\n";
  for (int i = 0; i < 1000; ++i) text += "1,x\n";
  const Read r = read(text);
  EXPECT_EQ(r.errors.size(), 21u);
  EXPECT_EQ(r.errors.back(), "22:1: 20 bad lines so far; the rest is not read");
}

TEST(TableFile, EmptyFileHasNoRows) { EXPECT_TRUE(read("").x.empty()); }

TEST(TableFile, MissingFileThrows) { EXPECT_THROW(TableFile("/nonexistent/table.csv"), SceneError); }

TEST(TableFile, HeadingsSayTheirUnitsInManyWays) {
  const auto said = [](const char* heading) {
    const NameWithUnit both = name_with_unit(heading);
    return both.name + "|" + both.unit.value_or("none");
  };
  EXPECT_EQ(said("speed [rad/s]"), "speed|rad/s");
  EXPECT_EQ(said("torque (N*m)"), "torque|N*m");
  EXPECT_EQ(said("n / min^-1"), "n|min^-1");
  EXPECT_EQ(said("time in ms"), "time|ms");
  EXPECT_EQ(said("slip [-]"), "slip|-");
  EXPECT_EQ(said("torque (measured)"), "torque (measured)|none");
  EXPECT_EQ(said("torque (in-lb)"), "torque|in-lb") << "meant as a unit: it is not passed over";
  EXPECT_EQ(said("T1/T2"), "T1/T2|none");
}

// One table of random numbers, written in every form: all give it back to the last bit.
TEST(TableFile, OneTableInAllFormsIsTheSame) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1e4, 1e4);
  Doubles x, y;
  for (int i = 0; i < 50; ++i) x.push_back(i + 0.5), y.push_back(any(random));
  for (const char separator : {',', ';', '\t'})
    for (const bool comma : {false, true})
      for (const bool quoted : {false, true})
        for (const bool banner : {false, true})
          for (const int units : {0, 1, 2}) {
            if (comma && separator == ',' && !quoted) continue;
            const auto cell = [&](std::string text) {
              if (comma) std::replace(text.begin(), text.end(), '.', ',');
              return quoted ? "\"" + text + "\"" : text;
            };
            std::string text = banner ? fmt::format("Test 5{0}{0}{0}\n", separator) : "";
            if (units == 1) text += fmt::format("a [m]{0}b [N]{0}{0}\n", separator);
            if (units == 2) text += fmt::format("a{0}b{0}{0}\nm{0}N{0}{0}\n", separator);
            for (std::size_t i = 0; i < x.size(); ++i)
              text += fmt::format("{}{}{}{}{}\n", cell(fmt::format("{}", x[i])), separator,
                                  cell(fmt::format("{}", y[i])), separator, separator);
            const Read r = read(text);
            ASSERT_EQ(r.errors, Texts()) << text.substr(0, 100);
            ASSERT_EQ(r.x, x) << text.substr(0, 100);
            ASSERT_EQ(r.y, y) << text.substr(0, 100);
            if (units > 0) {
              ASSERT_EQ(r.units, (Texts{"m", "N"})) << text.substr(0, 100);
            }
          }
}

}  // namespace
}  // namespace kurbel::table_file_test
