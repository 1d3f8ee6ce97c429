// table_files_test.cpp — a trajectory as CSV, MAT and XLSX: the same rows and, to the last bit, the same numbers.
#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>

#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "studies/steady/steady.h"
#include "studies/tables/data_table.h"
#include "studies/tables/mat_file.h"
#include "studies/tables/table_files.h"
#include "studies/tables/trajectory_rows.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel::test::table_files_test {
namespace {

namespace fs = std::filesystem;

// Two masses on a spring under a step of torque; five rows, and those at peaks.
const Result& ringing() {
  static const Result result = [] {
    const Scene scene = scene_from(
        "line = [\"a\", \"shaft\", \"b\"]\na = { kind = \"load\", torque = \"-10 N*m\", acts = \"always\", inertia = "
        "\"1 kg*m2\" }\nshaft = { kind = \"shaft\", stiffness = \"400 N*m/rad\" }\nb = { kind = \"flywheel\", inertia "
        "= \"3 kg*m2\" }\n[effects]\nelasticity = true\n[run]\nstart = { speed = \"1 rad/s\" }\nuntil = \"0.5 "
        "s\"\nsamples = 5\n");
    return simulate(compile(scene, scene.effects), "elastic", {});
  }();
  return result;
}

std::map<std::string, std::string> files_of(const StudyOutput& output, const std::string& formats) {
  std::map<std::string, std::string> files;
  make_table_files(output, table_formats(formats),
                   [&](const std::string& name, const std::string& bytes) { files[name] = bytes; });
  return files;
}

// A MAT file read by libmatio.
class Mat {
 public:
  explicit Mat(const std::string& bytes) {
    const fs::path path = fs::temp_directory_path() / ("kurbel_mat_" + std::to_string(getpid()) + ".mat");
    std::ofstream(path, std::ios::binary) << bytes;
    file_.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    fs::remove(path);
    EXPECT_TRUE(file_);
    EXPECT_EQ(Mat_GetVersion(file_.get()), MAT_FT_MAT5);
  }
  const matvar_t& operator[](const std::string& name) {
    std::shared_ptr<matvar_t>& variable = variables_[name];
    if (!variable) variable.reset(Mat_VarRead(file_.get(), name.c_str()), Mat_VarFree);
    return *variable;
  }
  // A column a text, without the blanks behind; letters beyond ASCII are question marks.
  std::vector<std::string> texts(const std::string& name) {
    const matvar_t& v = (*this)[name];
    EXPECT_EQ(v.class_type, MAT_C_CHAR);
    std::vector<std::string> texts(v.dims[1]);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      for (std::size_t k = 0; k < v.dims[0]; ++k) {
        const auto letter = static_cast<const std::uint16_t*>(v.data)[i * v.dims[0] + k];
        texts[i] += letter < 128 ? static_cast<char>(letter) : '?';
      }
      texts[i].erase(texts[i].find_last_not_of(' ') + 1);
    }
    return texts;
  }
  double number(const std::string& matrix, std::size_t row, std::size_t column) {
    const matvar_t& v = (*this)[matrix];
    EXPECT_EQ(v.class_type, MAT_C_DOUBLE);
    EXPECT_LT(row, v.dims[0]);
    EXPECT_LT(column, v.dims[1]);
    return static_cast<const double*>(v.data)[column * v.dims[0] + row];
  }

 private:
  struct Closed {
    void operator()(mat_t* file) const { Mat_Close(file); }
  };
  std::unique_ptr<mat_t, Closed> file_;
  std::map<std::string, std::shared_ptr<matvar_t>> variables_;
};

TEST(TableFiles, TheCsvGivesTheRunsNumbersToTheLastBit) {
  const TrajectoryRows rows = rows_of(*ringing().trajectory);
  const DataTable table = data_table("trajectory.csv", trajectory_csv(ringing()));
  const std::size_t columns = ringing().trajectory->channels().size();
  ASSERT_GT(table.rows(), 5u) << "rows at peaks, too";
  ASSERT_EQ(table.rows(), rows.time.size());
  ASSERT_EQ(table.columns.size(), columns + 1);
  EXPECT_EQ(table.columns[0].unit, "s");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_EQ(table.columns[0].numbers[i], rows.time[i]);
    for (std::size_t k = 0; k < columns; ++k)
      EXPECT_EQ(table.columns[k + 1].numbers[i], rows.values[i * columns + k]) << table.columns[k + 1].name;
  }
}

// The way that Modelica's tools go: a name's place in dataInfo, its matrix and row there, the sign of the row.
TEST(TableFiles, AMatFileHoldsTheTrajectoryInModelicasLayout) {
  Mat mat(files_of(output_of(ringing()), "mat").at("trajectory.mat"));
  EXPECT_EQ(mat["Aclass"].dims[0], 4u);
  EXPECT_EQ(static_cast<const std::uint16_t*>(mat["Aclass"].data)[0], u'A');
  const std::vector<std::string> names = mat.texts("name"), words = mat.texts("description");
  const matvar_t& info = mat["dataInfo"];
  ASSERT_EQ(info.class_type, MAT_C_INT32);
  ASSERT_EQ(info.dims[0], 4u);
  ASSERT_EQ(info.dims[1], names.size());
  ASSERT_EQ(words.size(), names.size());
  const auto told = [&](std::size_t name, std::size_t what) {
    return static_cast<const std::int32_t*>(info.data)[4 * name + what];
  };
  EXPECT_EQ(names[0], "time");
  EXPECT_EQ(told(0, 0), 0);
  EXPECT_EQ(told(0, 1), 1);
  const DataTable table = data_table("trajectory.csv", trajectory_csv(ringing()));
  std::size_t quantities = 0, constants = 0;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto row = static_cast<std::size_t>(told(i, 1)) - 1;
    ASSERT_GT(row, 0u) << "the first row is the time";
    EXPECT_EQ(told(i, 2), 0) << "linear between";
    if (told(i, 0) == 1) {
      ++constants;
      EXPECT_EQ(told(i, 3), 0) << "constant beyond the ends";
      const Figure* figure = ringing().find(names[i]);
      ASSERT_TRUE(figure) << names[i];
      for (const std::size_t end : {0u, 1u}) EXPECT_EQ(mat.number("data_1", row, end), figure->value) << names[i];
    } else {
      ++quantities;
      EXPECT_EQ(told(i, 3), -1) << "unknown beyond the ends";
      ASSERT_EQ(names[i], table.columns[row].name);
      for (std::size_t at = 0; at < table.rows(); ++at)
        EXPECT_EQ(mat.number("data_2", row, at), table.columns[row].numbers[at]) << names[i] << at;
    }
    if (names[i] == "torque.shaft") {
      EXPECT_EQ(words[i], "torque [N.m]");
    }
  }
  EXPECT_EQ(quantities, table.columns.size() - 1);
  EXPECT_EQ(constants, ringing().figures.size());
  EXPECT_EQ(mat["data_2"].dims[1], table.rows());
  for (std::size_t at = 0; at < table.rows(); ++at)
    EXPECT_EQ(mat.number("data_2", 0, at), table.columns[0].numbers[at]);
  EXPECT_EQ(mat.number("data_1", 0, 1), 0.5) << "the time of the end";
}

// Each format by itself, all of them together, and what is none.
TEST(TableFiles, OnlyWhatIsAskedForIsMade) {
  const StudyOutput output = output_of(ringing());
  const auto names = [&](const std::string& formats) {
    std::string names;
    for (const auto& [name, bytes] : files_of(output, formats)) {
      names += name + " ";
      EXPECT_FALSE(bytes.empty());
    }
    return names;
  };
  EXPECT_EQ(names("csv"), "trajectory.csv ");
  EXPECT_EQ(names("mat"), "trajectory.mat ");
  EXPECT_EQ(names("xlsx"), "results.xlsx ");
  EXPECT_EQ(names("xlsx,csv,mat"), "results.xlsx trajectory.csv trajectory.mat ");
  for (const char* bad : {"", "xls", "csv,", "csv;mat", "MAT"}) EXPECT_THROW(table_formats(bad), std::invalid_argument);
}

// A sheet to be printed is no table and has one form, whatever tables are asked for.
TEST(TableFiles, WhatIsNoTableStaysAsItIs) {
  StudyOutput output = output_of(ringing());
  const std::string page = "<!doctype html>\n<p>a, b</p>\n<p>c, d, e, f</p>\n";
  output.csv.push_back({"sheet.html", [&] { return page; }});
  for (const char* formats : {"csv", "mat", "xlsx", "csv,mat,xlsx"}) {
    const auto files = files_of(output, formats);
    ASSERT_TRUE(files.contains("sheet.html")) << formats;
    EXPECT_EQ(files.at("sheet.html"), page) << formats;
    EXPECT_FALSE(files.contains("sheet.mat"));
  }
}

// Tables over an angle, of several models; words among the numbers.
TEST(TableFiles, EveryStudysTablesAreMade) {
  const Scene scene = scene_file("scenes/crank_press.toml");
  SteadyOptions options;
  options.traces = true, options.start_search = false;
  const SteadyStudy study = steady(scene, {scene.effects}, options);
  const StudyOutput output = output_of(study);
  const auto files = files_of(output, "csv,mat");
  ASSERT_TRUE(files.contains("steady.elastic.mat"));
  Mat mat(files.at("steady.elastic.mat"));
  const DataTable table = data_table("steady.elastic.csv", files.at("steady.elastic.csv"));
  EXPECT_EQ(mat.texts("name").at(0), "angle");
  EXPECT_EQ(mat["data_2"].dims[0], table.columns.size());
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    EXPECT_EQ(mat.number("data_2", k, 360), table.columns[k].numbers[360]);

  const DataTable mixed = data_table("mixed.csv", "# a remark\nn,who [s],x [m]\n1,,0.5\n2,rotor,\n");
  EXPECT_EQ(mixed.remark, "a remark");
  ASSERT_EQ(mixed.columns.size(), 3u);
  EXPECT_TRUE(mixed.columns[1].is_words());
  EXPECT_EQ(mixed.columns[1].words[1], "rotor");
  EXPECT_EQ(mixed.numbers().size(), 2u);
  EXPECT_TRUE(std::isnan(mixed.columns[2].numbers[1]));
  EXPECT_EQ(Mat(mat_file(mixed, {})).texts("name"), (std::vector<std::string>{"n", "x"}));
}

}  // namespace
}  // namespace kurbel::test::table_files_test
