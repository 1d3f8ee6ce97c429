// train_sheet_test.cpp — a mass–elastic sheet becomes a scene, or is refused with file and line.
#include "studies/scenes/train_sheet.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::train_sheet_test {
namespace {

namespace fs = std::filesystem;

class TrainSheet : public testing::Test {
 protected:
  std::string scene(const std::string& sheet) const {
    std::ofstream(file_) << sheet;
    return scene_of_sheet(file_.string());
  }
  // "LINE: what", of the first fault.
  std::string refusal(const std::string& sheet) const {
    try {
      return "taken: " + scene(sheet);
    } catch (const SceneError& error) {
      const Message& m = error.messages.front();
      EXPECT_EQ(m.file, file_.string());
      return std::to_string(m.at.line) + ": " + m.text;
    }
  }
  void expect_refused(const std::string& sheet, int line, const std::string& words) const {
    const std::string said = refusal(sheet);
    EXPECT_TRUE(said.starts_with(std::to_string(line) + ": ")) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }

  const test::ScratchFolder folder_;
  const fs::path file_ = folder_ / "sheet.csv";
};

TEST_F(TrainSheet, KeepsItsDigitsAndUnits) {
  const std::string text =
      scene("station,inertia [kg*m2],stiffness [MN*m/rad],diameter [mm]\nmotor 1,12.40,0.150,90\npump,0.90,,\n");
  EXPECT_NE(text.find("inertia = \"12.40 kg*m2\""), std::string::npos) << text;
  EXPECT_NE(text.find("stiffness = \"0.150 MN*m/rad\"\n# diameter = \"90 mm\""), std::string::npos) << text;
  const Scene scene = test::scene_from(text);
  compile(scene, scene.effects);  // a diameter beside a stiffness is for stresses alone, which nothing limits yet
  EXPECT_EQ(scene.lines.front().names, (std::vector<std::string>{"motor_1", "motor_1_pump", "pump"}));
}

TEST_F(TrainSheet, SpeedsBecomeRatiosAndTheOperatingSpeed) {
  const Scene made = test::scene_from(
      scene("station;inertia [kg*m2];stiffness [N*m/rad];speed [rpm]\nmotor;10,5;2e5;1500\nwheel;1,25;gear;1500\n"
            "pinion;0,125;1e5;4500\npump;0,75;;4500\n"));
  EXPECT_NEAR(made.operation.speeds.front(), 1500 * M_PI / 30, 1e-9);
  EXPECT_EQ(made.operation.on, "motor");
  const auto model = compile(made, made.effects);
  EXPECT_NEAR(model->node_ratio[static_cast<std::size_t>(model->network.ports.at("pump").in)], 3, 1e-12);
}

// The same cells in a workbook are the same scene.
TEST_F(TrainSheet, AWorkbookIsReadAsItsTable) {
  const std::string sheet =
      "station,inertia [kg*m2],stiffness [N*m/rad],speed "
      "ratio\nmotor,12.4,rigid,1\ngear,0.8,gear,1\npinion,0.06,2100000,"
      "3.52\npump,0.9,,3.52\n";
  std::string rows, expected = scene(sheet);
  std::istringstream lines(sheet);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows += "<row r=\"" + std::to_string(++number) + "\">";
    char column = 'A';
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (cell.empty()) continue;
      const std::string at = std::string(1, column) + std::to_string(number);
      const bool figure = cell.find_first_not_of("0123456789.") == std::string::npos;
      rows += figure ? "<c r=\"" + at + "\"><v>" + cell + "</v></c>"
                     : "<c r=\"" + at + "\" t=\"inlineStr\"><is><t>" + cell + "</t></is></c>";
    }
    rows += "</row>";
  }
  const std::map<std::string, std::string> parts = {
      {"xl/workbook.xml", "<workbook xmlns:r=\"r\"><sheets><sheet name=\"Train\" r:id=\"rId1\"/></sheets></workbook>"},
      {"xl/_rels/workbook.xml.rels",
       "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/></Relationships>"},
      {"xl/worksheets/sheet1.xml",
       "<?xml version=\"1.0\"?><worksheet><sheetData>" + rows + "</sheetData></worksheet>"}};
  fs::path book = file_;
  book.replace_extension(".xlsx");
  fs::remove(book);
  zip_t* archive = zip_open(book.c_str(), ZIP_CREATE, nullptr);
  for (const auto& [name, text] : parts)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), 0);
  ASSERT_EQ(zip_close(archive), 0);
  std::string read = scene_of_sheet(book.string());
  fs::remove(book);
  for (std::string* text : {&read, &expected}) text->erase(0, text->find("line = "));
  EXPECT_EQ(read, expected);
}

// J′ = J (n/n₁)², GD² = 4 J.
TEST_F(TrainSheet, ReferredValuesAndGD2AreConverted) {
  const std::string referred = scene(
      "station,referred inertia [kg*m2],referred stiffness [N*m/rad],speed "
      "ratio\nmotor,10,gear,1\npinion,9,4e5,2\npump,"
      "8,,2\n");
  EXPECT_NE(referred.find("inertia = \"2.25 kg*m2\""), std::string::npos) << referred;
  EXPECT_NE(referred.find("stiffness = \"100000 N*m/rad\""), std::string::npos) << referred;
  EXPECT_NE(scene("station,GD2 [kg*m2],stiffness [N*m/rad]\na,8,1e5\nb,4,\n").find("inertia = \"2 kg*m2\""),
            std::string::npos);
}

TEST_F(TrainSheet, WhatIsAmbiguousIsRefusedWithItsLine) {
  const std::string head = "station,inertia [kg*m2],stiffness [N*m/rad],speed ratio\n";
  expect_refused(head + "motor,10,1e5,1\npump,1,,3\n", 2, "turn at different speeds");
  expect_refused(head + "motor,10,1e5,1\npump,1,2e5,1\n", 3, "leads nowhere");
  expect_refused(head + "motor,10,,1\npump,1,,1\n", 2, "no stiffness between");
  expect_refused(head + "motor,10,1e5,1\npump,1,,\n", 3, "no speed ratio");
  expect_refused(head + "motor,10,1e5,1\nmotor,1,,1\n", 3, "twice");
  expect_refused(head + "motor,10,1e5,1\nrotor,,1e5,1\npump,1,,1\n", 3, "no inertia");
  expect_refused(head + "motor,ten,1e5,1\npump,1,,1\n", 2, "must be a number");
  expect_refused("station,inertia,stiffness [N*m/rad]\na,1,1e5\nb,1,\n", 1, "has no unit");
  expect_refused("station,inertia [kg],stiffness [N*m/rad]\na,1,1e5\nb,1,\n", 1, "its unit must be of");
  expect_refused("station,inertia [kg*m2],stiffness [N*m/rad],mass [kg]\na,1,1e5,3\nb,1,,3\n", 1, "what is it?");
  expect_refused("station,inertia [kg*m2]\na,1\nb,1\n", 1, "stiffness");
  const std::string list = "station,to,inertia [kg*m2],stiffness [N*m/rad]\na,b,1,1e5\nb,c,1,1e5\n";
  expect_refused(list + "c,a,1,1e5\n", 4, "closes a loop");
  expect_refused(list + "c,,1,\nd,,1,\n", 5, "nothing joins");
  expect_refused(list + "c,e,1,1e5\n", 4, "no station \"e\"");
}

}  // namespace
}  // namespace kurbel::train_sheet_test
