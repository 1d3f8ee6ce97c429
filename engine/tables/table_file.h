// table_file.h — a file of a table: its form, its headings, its columns as numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/messages.h"
#include "engine/tables/table_text.h"

namespace kurbel {

// What its user says of it.
struct TableForm {
  std::string sheet = {};  // of an .xlsx file; empty: the first
  char decimal = 0;        // '.' or ','; 0: as the file shows
  bool words = false;      // its cells may be words: the first line is the heading, whatever stands below it
};

struct TableHeading {
  std::string text, name;           // "speed [rad/s]", "speed"
  std::optional<std::string> unit;  // of the heading, or of a line of units below it
  int column = 0;                   // from 1
  Location at;
};

struct TableNumbers {
  std::vector<std::vector<double>> columns;  // as they were asked for
  std::vector<Location> at;                  // of each row: its cell in the first of them
};

struct TableCell {
  std::string text;  // without quotes; of a number, its decimals by a point
  Location at;
};

class TableFile {
 public:
  // Throws SceneError with the line where the form is not clear, and with what that line looks like.
  explicit TableFile(const std::string& path, const TableForm& form = {});

  TableFile(const TableFile&) = delete;  // its cells are within its own text
  TableFile& operator=(const TableFile&) = delete;

  const std::string& path() const { return path_; }
  // One a column; none where no line of words stands above the numbers.
  const std::vector<TableHeading>& headings() const { return headings_; }
  // The column of that name, with or without its unit; capitals do not count. Null: none. Throws SceneError where two have it.
  const TableHeading* find(std::string_view name) const;
  std::vector<std::string> names() const;

  // Columns by their numbers from 1. Rows where all of them are empty are passed over; bad cells go into `messages`.
  TableNumbers numbers(const std::vector<int>& columns, Messages& messages) const;
  // All rows below the headings, one cell for each heading. Throws SceneError at a row with more, and unless cells may be
  // empty, at one with fewer or empty ones.
  std::vector<std::vector<TableCell>> cells(bool may_be_empty = false) const;

 private:
  struct Line {
    std::string_view text;
    int number = 0;  // in the file, from 1
  };
  using Cells = std::vector<std::string_view>;

  [[noreturn]] void refuse(const Line& line, const std::string& why) const;
  void find_lines();
  std::size_t find_separator();
  void find_separator_of_heading();
  void find_data();
  bool is_of_units(std::size_t line) const;
  void take_headings(std::size_t line);
  void find_headings_among_remarks();
  void find_decimal_sign(char said);
  void refuse_commas_for_both() const;
  void split(std::string_view line, char separator, Cells& cells) const;
  Cells cells_of(const Line& line) const;
  std::optional<double> number_in(std::string_view cell) const;
  Location place(const Line& line, std::string_view cell, int column) const;
  std::string place_in_words(const Line& line, int column) const;

  std::string path_;
  TableText text_;
  std::vector<Line> lines_, remarks_;  // those with cells; those that begin with #
  char separator_ = ',', decimal_ = '.';
  std::vector<std::size_t> of_numbers_;  // columns that hold numbers in most lines, from 0
  std::size_t data_ = 0;                 // the first line of numbers
  std::vector<TableHeading> headings_;
};

}  // namespace kurbel
