// spreadsheet_test.cpp — sheets of .xlsx files, also such as nobody should open.
#include "engine/tables/spreadsheet.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zip.h>

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <map>

#include "engine/tables/table_file.h"
#include "tests/support/files.h"

namespace kurbel::spreadsheet_test {
namespace {

namespace fs = std::filesystem;

class Spreadsheet : public testing::Test {
 protected:
  using Parts = std::map<std::string, std::string>;
  void write(const Parts& parts) const {
    fs::remove(path_);
    zip_t* archive = zip_open(path_.c_str(), ZIP_CREATE, nullptr);
    for (const auto& [name, text] : parts)
      zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), 0);
    ASSERT_EQ(zip_close(archive), 0);
  }
  // Two sheets; the second holds what is given.
  static Parts book(const std::string& rows) {
    const auto sheet = [](const std::string& in) {
      return "<?xml version=\"1.0\"?><worksheet><sheetData>" + in + "</sheetData></worksheet>";
    };
    return {{"xl/workbook.xml",
             "<workbook xmlns:r=\"r\"><sheets><sheet name=\"Notes\" r:id=\"rId1\"/><sheet "
             "name=\"Curve\" r:id=\"rId2\"/></sheets></workbook>"},
            {"xl/_rels/workbook.xml.rels",
             "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/><Relationship Id=\"rId2\" "
             "Target=\"/xl/worksheets/sheet2.xml\"/></Relationships>"},
            {"xl/sharedStrings.xml",
             "<sst><si><t>speed [rpm]</t></si><si><r><t>torque </t></r><r><t>[N*m]</t></r></si></sst>"},
            {"xl/worksheets/sheet1.xml", sheet("<row r=\"1\"><c r=\"A1\"><v>1</v></c><c r=\"B1\"><v>2</v></c></row>")},
            {"xl/worksheets/sheet2.xml", sheet(rows)}};
  }
  std::string refusal(const std::string& sheet = "Curve") const {
    try {
      const TableFile file(path_, {.sheet = sheet});
      Messages messages("scene.toml");
      file.numbers({1, 2}, messages);
      messages.throw_if_any();
    } catch (const SceneError& error) {
      return fmt::format("{}:{}: {}", error.messages.front().at.line, error.messages.front().at.column,
                         error.messages.front().text);
    }
    return "";
  }
  const test::ScratchFolder folder_;
  const std::string path_ = folder_ / "book.xlsx";
};

constexpr const char* rows =
    R"(<row r="2"><c r="B2" t="s"><v>0</v></c><c r="D2" t="s"><v>1</v></c></row>)"
    R"(<row r="4"><c r="B4"><v>0</v></c><c r="D4"><f>B4+1</f><v>0.10000000000000001</v></c></row>)"
    R"(<row r="5"><c r="B5"><v>1500</v></c><c r="D5"><v>1.5E-2</v></c></row>)";

TEST_F(Spreadsheet, ASheetIsReadByItsName) {
  write(book(rows));
  const TableFile file(path_, {.sheet = "Curve"});
  ASSERT_EQ(file.headings().size(), 4u);
  EXPECT_EQ(file.headings()[1].name, "speed");
  EXPECT_EQ(*file.headings()[3].unit, "N*m");
  Messages messages("scene.toml");
  const TableNumbers numbers = file.numbers({2, 4}, messages);
  EXPECT_TRUE(messages.empty());
  EXPECT_EQ(numbers.columns[0], (std::vector<double>{0, 1500}));
  EXPECT_EQ(numbers.columns[1], (std::vector<double>{0.1, 0.015}));
  EXPECT_EQ(numbers.at[1].line, 5);
  const TableFile first(path_);
  EXPECT_EQ(first.numbers({1, 2}, messages).columns[1], (std::vector<double>{2})) << "the first sheet unless asked";
}

TEST_F(Spreadsheet, NamesItsSheets) {
  write(book(""));
  EXPECT_EQ(sheet_names(path_), (std::vector<std::string>{"Notes", "Curve"}));
  EXPECT_TRUE(sheet_names("record.csv").empty());
}

TEST_F(Spreadsheet, BadCellsHaveTheNamesOfTheSheet) {
  write(book(std::string(rows) + R"(<row r="6"><c r="B6"><v>1600</v></c><c r="D6" t="e"><v>#DIV/0!</v></c></row>)"));
  const TableFile file(path_, {.sheet = "Curve"});
  Messages messages("scene.toml");
  file.numbers({2, 4}, messages);
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_EQ(messages.all()[0].text, "cell D6: \"#DIV/0!\" is not a finite number");
  EXPECT_EQ(messages.all()[0].at, (Location{6, 4}));
  EXPECT_EQ(cell_name(7, 28), "AB7");
  EXPECT_EQ(cell_name(1, 16384), "XFD1");
}

TEST_F(Spreadsheet, WhatIsMissingOrBrokenIsReported) {
  write(book(rows));
  EXPECT_EQ(refusal("Kurve"),
            "0:0: has no sheet \"Kurve\" — did you mean \"Curve\"?; there are \"Notes\" and \"Curve\"");
  write({{"content.xml", "<office/>"}});
  EXPECT_EQ(refusal(), "0:0: is an archive without \"xl/workbook.xml\": no .xlsx file; save it as .xlsx or .csv");
  std::ofstream(path_, std::ios::binary) << "PK\x03\x04 and no more";
  EXPECT_EQ(refusal(), "0:0: is a damaged archive, no .xlsx file; save it anew");
  write(book("<row r=\"3\"/><row r=\"2\"/>"));
  EXPECT_EQ(refusal(), "0:0: row 2 follows row 3; save the file anew");
  write(book("<row r=\"1\"><c r=\"A1\" t=\"s\"><v>7</v></c></row>"));
  EXPECT_EQ(refusal(), "0:0: cell A1 names a text that the file does not hold; save it anew");
}

// 65 MB of nothing in some 60 kB; 16 384 columns by a cell in the last of each row; entities that unfold are no entities.
TEST_F(Spreadsheet, WhatUnpacksBeyondBoundsIsRefused) {
  write(book(std::string(65'000'000, ' ')));
  EXPECT_LT(fs::file_size(path_), 1'000'000u);
  EXPECT_EQ(refusal(),
            "0:0: its part \"xl/worksheets/sheet2.xml\" unpacks to more than 64 MB; save the sheet that is needed");
  std::string wide;
  for (int i = 1; i <= 5000; ++i) wide += fmt::format("<row r=\"{0}\"><c r=\"XFD{0}\"><v>1</v></c></row>", i);
  write(book(wide));
  EXPECT_EQ(refusal(), "0:0: holds more than 64 MB of cells; save the part that is needed");
  Parts laughs = book(R"(<row r="1"><c r="A1" t="inlineStr"><is><t>&b;</t></is></c></row>)");
  laughs["xl/worksheets/sheet2.xml"].insert(
      21, R"(<!DOCTYPE x [<!ENTITY a "ha ha ha ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>)");
  write(laughs);
  EXPECT_NE(refusal(), "");
}

TEST_F(Spreadsheet, ASheetOfATextIsRefused) {
  std::ofstream(path_) << "0,1\n1,2\n";
  EXPECT_EQ(refusal(), "0:0: is no .xlsx file, and has no sheet \"Curve\"; drop the key");
}

}  // namespace
}  // namespace kurbel::spreadsheet_test
