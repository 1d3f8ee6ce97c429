// table_files_test.cpp — a trajectory as CSV, MAT and XLSX: the same rows and, to the last bit, the same numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "studies/steady/steady.h"
#include "studies/tables/mat_file.h"
#include "studies/tables/table_files.h"
#include "studies/tables/trajectory_rows.h"
#include "tests/support/files.h"
#include "tests/support/matio.h"
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

// Column by column; words are no numbers.
std::vector<std::vector<double>> columns_of(const DataTable& table) {
  std::vector<std::vector<double>> columns(table.columns.size());
  table.each_row([&](DataRow row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const double* const number = std::get_if<double>(&row[k]);
      columns[k].push_back(number ? as_written(*number, table.columns[k].format) : std::nan(""));
    }
  });
  return columns;
}

// A MAT file read by libmatio.
class Mat {
 public:
  explicit Mat(const std::string& bytes) {
    const fs::path path = fs::temp_directory_path() / ("kurbel_mat_" + std::to_string(getpid()) + ".mat");
    std::ofstream(path, std::ios::binary) << bytes;
    file_.reset(of_matio<decltype(Mat_Open)>("Mat_Open")(path.c_str(), MAT_ACC_RDONLY));
    fs::remove(path);
    EXPECT_TRUE(file_);
    EXPECT_EQ(of_matio<decltype(Mat_GetVersion)>("Mat_GetVersion")(file_.get()), MAT_FT_MAT5);
  }
  const matvar_t& operator[](const std::string& name) {
    std::shared_ptr<matvar_t>& variable = variables_[name];
    if (!variable)
      variable.reset(of_matio<decltype(Mat_VarRead)>("Mat_VarRead")(file_.get(), name.c_str()),
                     of_matio<decltype(Mat_VarFree)>("Mat_VarFree"));
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
    void operator()(mat_t* file) const { of_matio<decltype(Mat_Close)>("Mat_Close")(file); }
  };
  std::unique_ptr<mat_t, Closed> file_;
  std::map<std::string, std::shared_ptr<matvar_t>> variables_;
};

TEST(TableFiles, ATableHoldsTheRunsNumbersToTheLastBit) {
  const TrajectoryRows rows = rows_of(*ringing().trajectory);
  const DataTable table = trajectory_data(ringing());
  const std::vector<std::vector<double>> numbers = columns_of(table);
  const std::size_t columns = ringing().trajectory->channels().size();
  ASSERT_GT(numbers[0].size(), 5u) << "rows at peaks, too";
  ASSERT_EQ(numbers[0].size(), rows.time.size());
  ASSERT_EQ(table.columns.size(), columns + 1);
  EXPECT_EQ(table.columns[0].unit, "s");
  for (std::size_t i = 0; i < numbers[0].size(); ++i) {
    EXPECT_EQ(numbers[0][i], rows.time[i]);
    for (std::size_t k = 0; k < columns; ++k)
      EXPECT_EQ(numbers[k + 1][i], rows.values[i * columns + k]) << table.columns[k + 1].name;
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
  const auto reported = [&](std::size_t name, std::size_t what) {
    return static_cast<const std::int32_t*>(info.data)[4 * name + what];
  };
  EXPECT_EQ(names[0], "time");
  EXPECT_EQ(reported(0, 0), 0);
  EXPECT_EQ(reported(0, 1), 1);
  const DataTable table = trajectory_data(ringing());
  const std::vector<std::vector<double>> numbers = columns_of(table);
  std::size_t quantities = 0, constants = 0;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto row = static_cast<std::size_t>(reported(i, 1)) - 1;
    ASSERT_GT(row, 0u) << "the first row is the time";
    EXPECT_EQ(reported(i, 2), 0) << "linear between";
    if (reported(i, 0) == 1) {
      ++constants;
      EXPECT_EQ(reported(i, 3), 0) << "constant beyond the ends";
      const Figure* figure = ringing().find(names[i]);
      ASSERT_TRUE(figure) << names[i];
      for (const std::size_t end : {0u, 1u}) EXPECT_EQ(mat.number("data_1", row, end), figure->value) << names[i];
    } else {
      ++quantities;
      EXPECT_EQ(reported(i, 3), -1) << "unknown beyond the ends";
      ASSERT_EQ(names[i], table.columns[row].name);
      for (std::size_t at = 0; at < numbers[0].size(); ++at)
        EXPECT_EQ(mat.number("data_2", row, at), numbers[row][at]) << names[i] << at;
    }
    if (names[i] == "torque.shaft") {
      EXPECT_EQ(words[i], "torque [N.m]");
    }
  }
  EXPECT_EQ(quantities, table.columns.size() - 1);
  EXPECT_EQ(constants, ringing().figures.size());
  EXPECT_EQ(mat["data_2"].dims[1], numbers[0].size());
  for (std::size_t at = 0; at < numbers[0].size(); ++at) EXPECT_EQ(mat.number("data_2", 0, at), numbers[0][at]);
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

// A sheet to be printed is no table and has one form, whatever tables are requested.
TEST(TableFiles, WhatIsNoTableStaysAsItIs) {
  StudyOutput output = output_of(ringing());
  const std::string page = "<!doctype html>\n<p>a, b</p>\n<p>c, d, e, f</p>\n";
  output.files.emplace_back("sheet.html", page);
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
  const DataTable table = output.tables.back().table();
  ASSERT_EQ(output.tables.back().name, "steady.elastic");
  const std::vector<std::vector<double>> numbers = columns_of(table);
  EXPECT_EQ(mat.texts("name").at(0), "angle");
  EXPECT_EQ(mat["data_2"].dims[0], table.columns.size());
  for (std::size_t k = 0; k < table.columns.size(); ++k) EXPECT_EQ(mat.number("data_2", k, 360), numbers[k][360]);

  struct Row {
    int n;
    std::string who;
    double x;
  };
  const std::vector<Row> rows = {{1, "", 0.5}, {2, "rotor", HUGE_VAL}, {3, "shaft", 1 / 3.0}};
  DataTable mixed =
      data_of(rows).in_file("n", {}, &Row::n).in_file("who", "s", &Row::who).in_file("x", "", &Row::x, 3).data();
  mixed.remark = "a remark";
  EXPECT_EQ(csv_text(mixed), "# a remark\nn,who [s],x []\n1,,0.5\n2,rotor,\n3,shaft,0.333\n");
  Mat read(mat_file(mixed, {}).value());
  EXPECT_EQ(read.texts("name"), (std::vector<std::string>{"n", "x"})) << "numbers alone";
  EXPECT_EQ(read.number("data_2", 1, 2), 0.333) << "as in the other files";
}

TEST(TableFiles, HoldNoNegativeZero) {
  DataTable table;
  table.columns = {{.name = "a"}, {.name = "b", .format = {3}}, {.name = "c", .format = {3, true}}};
  table.each_row = [](const std::function<void(DataRow)>& take) {
    for (const double x : {-0.0, -0.0004, -0.0006}) take(std::vector<DataCell>{-0.0, -0.0, x});
  };
  EXPECT_EQ(csv_text(table), "a,b,c\n0,0,0.000\n0,0,0.000\n0,0,-0.001\n");
}

}  // namespace
}  // namespace kurbel::test::table_files_test
