// mat_text_test.cpp — MAT files as tables: those of libmatio, plain and compressed; those of the program; damaged ones.
#include "engine/tables/mat_text.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/tables/table_file.h"
#include "studies/tables/mat_file.h"
#include "tests/support/files.h"
#include "tests/support/matio.h"

namespace kurbel::mat_text_test {
namespace {

namespace fs = std::filesystem;
using test::of_matio;

class MatText : public testing::Test {
 protected:
  // By libmatio: 1 × 4 doubles t, 4 × 1 floats n, 4 × 2 bytes m, two single values, a text; `complex` one more, complex.
  void write(mat_ft version, matio_compression packed, bool complex = false) const {
    fs::remove(path_);
    mat_t* const file = of_matio<decltype(Mat_CreateVer)>("Mat_CreateVer")(path_.c_str(), nullptr, version);
    ASSERT_TRUE(file);
    const auto add = [&](const char* name, matio_classes kind, matio_types type, std::array<std::size_t, 2> extent,
                         const void* values, int options = 0) {
      matvar_t* const v = of_matio<decltype(Mat_VarCreate)>("Mat_VarCreate")(name, kind, type, 2, extent.data(),
                                                                             const_cast<void*>(values), options);
      EXPECT_EQ(of_matio<decltype(Mat_VarWrite)>("Mat_VarWrite")(file, v, packed), 0);
      of_matio<decltype(Mat_VarFree)>("Mat_VarFree")(v);
    };
    const double t[] = {0, 0.1, 0.2, 1.0 / 3}, imaginary[] = {1, 2, 3, 4};
    const float n[] = {100, 99.5F, 99, -1e-7F};
    const std::int8_t m[] = {1, 2, 3, 4, -5, -6, -7, -8};
    const std::int32_t single = 7;
    add("rate", MAT_C_INT32, MAT_T_INT32, {1, 1}, &single);
    add("t", MAT_C_DOUBLE, MAT_T_DOUBLE, {1, 4}, t);
    add("remark", MAT_C_CHAR, MAT_T_UINT8, {1, 4}, "test");
    add("n", MAT_C_SINGLE, MAT_T_SINGLE, {4, 1}, n);
    add("m", MAT_C_INT8, MAT_T_INT8, {4, 2}, m);
    const mat_complex_split_t split{const_cast<double*>(t), const_cast<double*>(imaginary)};
    if (complex) add("z", MAT_C_DOUBLE, MAT_T_DOUBLE, {4, 1}, &split, MAT_F_COMPLEX);
    of_matio<decltype(Mat_Close)>("Mat_Close")(file);
  }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  std::string refusal(const std::string& variable = "") const {
    try {
      const TableFile file(path_, {.sheet = variable});
    } catch (const SceneError& error) {
      return error.messages.front().text;
    }
    return "";
  }
  const test::ScratchFolder folder_;
  const std::string path_ = folder_ / "values.mat";
};

TEST_F(MatText, VectorsAndColumnsOfMatricesAreColumns) {
  for (const matio_compression packed : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    write(MAT_FT_MAT5, packed);
    const TableFile file(path_);
    EXPECT_EQ(file.names(), (std::vector<std::string>{"t", "n", "m_1", "m_2"}));
    Messages messages("test");
    const TableNumbers numbers = file.numbers({1, 2, 4}, messages);
    EXPECT_TRUE(messages.empty());
    EXPECT_EQ(numbers.columns[0], (std::vector<double>{0, 0.1, 0.2, 1.0 / 3})) << "to the last bit";
    EXPECT_EQ(numbers.columns[1], (std::vector<double>{100, 99.5, 99, -1e-7F}));
    EXPECT_EQ(numbers.columns[2], (std::vector<double>{-5, -6, -7, -8}));
    EXPECT_EQ(TableFile(path_, {.sheet = "m"}).names(), (std::vector<std::string>{"m_1", "m_2"}));
  }
}

// All words in the other order of bytes: a vector x of two 32-bit numbers and a y of two 16-bit ones.
TEST_F(MatText, FilesOfMachinesWithTheOtherOrderOfBytes) {
  std::string bytes(124, ' ');
  const auto words = [&](std::initializer_list<std::uint32_t> list) {
    for (const std::uint32_t w : list)
      for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(w >> shift & 0xFF);
  };
  words({0x01004D49});
  for (const std::uint32_t letter : {0x78U, 0x79U}) {
    words({14, 56, 6, 8, 6, 0, 5, 8, 1, 2, 1U << 16 | 1, letter << 24});
    if (letter == 0x78) words({5, 8, 70000, 0xFFFFFFFF});
    if (letter == 0x79) words({4U << 16 | 3, 0x0102FFFE}), words({0, 0});
  }
  write(bytes);
  Messages messages("test");
  const TableNumbers numbers = TableFile(path_).numbers({1, 2}, messages);
  EXPECT_EQ(numbers.columns, (std::vector<std::vector<double>>{{70000, -1}, {258, -2}}));
}

// Modelica's results, each variable a column of letters: a time, x in row 2, and −x as its alias with a sign.
TEST_F(MatText, AliasesOfModelicaHaveTheirSign) {
  fs::remove(path_);
  mat_t* const file = of_matio<decltype(Mat_CreateVer)>("Mat_CreateVer")(path_.c_str(), nullptr, MAT_FT_MAT5);
  ASSERT_TRUE(file);
  const auto add = [&](const char* name, matio_classes kind, matio_types type, std::array<std::size_t, 2> extent,
                       const void* values) {
    matvar_t* const v = of_matio<decltype(Mat_VarCreate)>("Mat_VarCreate")(name, kind, type, 2, extent.data(),
                                                                           const_cast<void*>(values), 0);
    EXPECT_EQ(of_matio<decltype(Mat_VarWrite)>("Mat_VarWrite")(file, v, MAT_COMPRESSION_NONE), 0);
    of_matio<decltype(Mat_VarFree)>("Mat_VarFree")(v);
  };
  std::string about;  // four rows of letters, column by column
  for (std::size_t k = 0; k < 11; ++k)
    for (const char* row : {"Atrajectory", "1.1        ", "           ", "binTrans   "}) about += row[k];
  const std::int32_t info[] = {0, 1, 0, -1, 2, 2, 0, -1, 2, -2, 0, -1};
  const double data[] = {0, 10, 1, 11, 2, 12};
  add("Aclass", MAT_C_CHAR, MAT_T_UINT8, {4, 11}, about.data());
  add("name", MAT_C_CHAR, MAT_T_UINT8, {4, 3}, "timex   back");
  add("description", MAT_C_CHAR, MAT_T_UINT8, {4, 3}, "[s] [m] [m] ");
  add("dataInfo", MAT_C_INT32, MAT_T_INT32, {4, 3}, info);
  add("data_2", MAT_C_DOUBLE, MAT_T_DOUBLE, {2, 3}, data);
  of_matio<decltype(Mat_Close)>("Mat_Close")(file);
  const TableFile table(path_);
  EXPECT_EQ(table.names(), (std::vector<std::string>{"time", "x", "back"}));
  Messages messages("test");
  EXPECT_EQ(table.numbers({1, 2, 3}, messages).columns,
            (std::vector<std::vector<double>>{{0, 1, 2}, {10, 11, 12}, {-10, -11, -12}}));
}

// Names and units of what the program writes, and the same numbers.
TEST_F(MatText, WhatTheProgramWritesIsReadBack) {
  DataTable table;
  table.columns = {{.name = "time", .unit = "s", .format = {}},
                   {.name = "torque.s8", .unit = "N*m", .format = {}},
                   {.name = "ratio", .unit = "", .format = {}}};
  table.each_row = [](const std::function<void(DataRow)>& take) {
    for (int i = 0; i < 5; ++i) take(std::vector<DataCell>{0.1 * i, 1.0 / (i + 1), -3.0 * i});
  };
  write(*mat_file(table, {{"mass", "kg", "", 5}}));
  const TableFile file(path_);
  EXPECT_EQ(file.names(), (std::vector<std::string>{"time", "torque.s8", "ratio"}));
  EXPECT_EQ(*file.headings()[1].unit, "N*m");
  Messages messages("test");
  const TableNumbers numbers = file.numbers({1, 2, 3}, messages);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(numbers.columns[0][i], 0.1 * static_cast<double>(i));
    EXPECT_EQ(numbers.columns[1][i], 1.0 / (static_cast<double>(i) + 1));
  }
}

TEST_F(MatText, WhatIsNotReadSaysWhatToDo) {
  write(MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, true);
  EXPECT_EQ(refusal(), "its variable \"z\" is complex; save real and imaginary parts as variables of their own");
  write(MAT_FT_MAT73, MAT_COMPRESSION_NONE);
  EXPECT_EQ(refusal(), "is a MAT file of version 7.3 (HDF5), which is not read; save it anew: save('file.mat', '-v7')");
  // Of version 4: type, rows, columns, no imaginary part, length of the name.
  write(std::string("\0\0\0\0\1\0\0\0\1\0\0\0\0\0\0\0\2\0\0\0t\0", 22) + std::string(200, '\0'));
  EXPECT_EQ(refusal(),
            "is no MAT file of version 5, or a truncated one; save it anew: save('file.mat', '-v7'), or as .csv");
  write(MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  EXPECT_EQ(refusal("q"),
            "has no variable of numbers \"q\"; it has \"rate\", \"t\", \"remark\", \"n\" and \"m\"; save the columns "
            "of the table as "
            "vectors of numbers");
  const std::string whole = test::text_of(path_);
  write(whole.substr(0, 128));
  EXPECT_EQ(
      refusal(),
      "has no vector or matrix of numbers; it has no variable; save the columns of the table as vectors of numbers");
  write(whole.substr(0, whole.size() - 20));
  EXPECT_EQ(refusal(), "is damaged or truncated behind its variable \"n\"; save it anew");
}

// 128 MB of zeros in some 130 kB; and a text that is longer than its numbers.
TEST_F(MatText, WhatUnpacksBeyondBoundsIsRefused) {
  std::string zeros(128'000'000, '\0'), packed(200'000, '\0');
  uLongf size = packed.size();
  ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()),
                      zeros.size(), 9),
            Z_OK);
  std::string tag = {15, 0, 0, 0, 0, 0, 0, 0};
  for (int k = 0; k < 4; ++k) tag[static_cast<std::size_t>(4 + k)] = static_cast<char>(size >> 8 * k & 0xFF);
  write(std::string(124, ' ') + std::string("\0\1IM", 4) + tag + packed.substr(0, size));
  EXPECT_EQ(refusal(), "unpacks to more than 64 MB; save the variables that are needed");
  write(MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  EXPECT_THROW(mat_as_text(test::text_of(path_), "", path_, 40), SceneError);
}

// Cut off anywhere, and with any byte changed: a table or a refusal.
TEST_F(MatText, DamagedFilesAreTablesOrRefused) {
  std::mt19937 random(5);
  for (const matio_compression packed : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    write(MAT_FT_MAT5, packed);
    const std::string whole = test::text_of(path_);
    std::size_t refused = 0;
    const auto read = [&](const std::string& bytes) {
      try {
        mat_as_text(bytes, "", path_, 1'000'000);
      } catch (const SceneError&) {
        ++refused;
      }
    };
    for (std::size_t size = 0; size < whole.size(); ++size) read(whole.substr(0, size));
    EXPECT_GT(refused, whole.size() - 16) << "but where a whole variable is missing";
    for (int round = 0; round < 20'000; ++round) {
      std::string bytes = whole;
      for (int k = 0; k <= round % 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      read(bytes);
    }
    EXPECT_GT(refused, whole.size());
  }
}

}  // namespace
}  // namespace kurbel::mat_text_test
