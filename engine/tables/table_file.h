// table_file.h — a table in a file: its form, its headings, its columns as numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/messages.h"
#include "engine/tables/table_text.h"

namespace kurbel {

// Form given by the user.
struct TableForm {
  std::string sheet = {};  // of an .xlsx file; empty: the first
  char decimal = 0;        // '.' or ','; 0: detected from the file
  bool words = false;      // its cells may be words: the first line is the heading, whatever follows
};

struct TableHeading {
  std::string text, name;           // "speed [rad/s]", "speed"
  std::optional<std::string> unit;  // of the heading, or of a line of units below it
  int column = 0;                   // from 1
  Location at;
};

struct TableNumbers {
  std::vector<std::vector<double>> columns;  // in the requested order
  std::vector<Location> at;                  // of each row: its cell in the first of them
};

struct TableCell {
  std::string text;  // without quotes; numbers with a decimal point
  Location at;
};

class TableFile {
 public:
  // Throws SceneError with the line if its form is ambiguous, and with a description of the line.
  explicit TableFile(const std::string& path, const TableForm& form = {});

  TableFile(const TableFile&) = delete;  // its cells refer to its own text
  TableFile& operator=(const TableFile&) = delete;

  const std::string& path() const { return path_; }
  // One per column; empty if there is no line of words above the numbers.
  const std::vector<TableHeading>& headings() const { return headings_; }
  // The column with this name, with or without its unit, case-insensitive. Null: none. Throws SceneError if there are two.
  const TableHeading* find(std::string_view name) const;
  std::vector<std::string> names() const;

  // Columns by their numbers from 1. Rows in which all of them are empty are skipped; faulty cells go into `messages`.
  // With `incomplete` rows that lack one of the numbers ("", "NaN", "---", "n/a") are omitted, too, and counted there.
  TableNumbers numbers(const std::vector<int>& columns, Messages& messages, std::size_t* incomplete = nullptr) const;
  // All rows below the headings, one cell for each heading. Throws SceneError for a row with more cells and, unless cells
  // may be empty, with fewer or empty cells.
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
  std::string separated() const;  // "; cells are separated by commas"

  std::string path_;
  TableText text_;
  std::vector<Line> lines_, remarks_;  // lines with cells; lines that begin with #
  char separator_ = ',', decimal_ = '.';
  std::vector<std::size_t> of_numbers_;  // columns with numbers in most lines, from 0
  std::size_t data_ = 0;                 // the first line of numbers
  std::vector<TableHeading> headings_;
};

}  // namespace kurbel
