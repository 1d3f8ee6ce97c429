// rows.h — a table stated once: rows of values described by columns; terminal, JSON, page and files are renderings of it.
//
//   table_of("critical_speeds", "Strongest critical speeds", study.critical)
//       .column("speed", "speed [1/min]", &CriticalSpeed::speed, {.factor = 30 / pi})
//       .column("mode", "mode", &CriticalSpeed::mode)
//       .only_for_programs("harmonic", &CriticalSpeed::harmonic)
//
//   data_of(angles)                          // a table for a file only
//       .in_file("phi", "rad", std::identity())
//       .in_file("M_d", "N*m", torque, 9)    // nine digits in CSV
//
// A column has a key for programs, a heading for people, or both; programs get the value in SI, people a formatted text.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/claims/headline.h"
#include "studies/data/data_table.h"
#include "studies/data/value.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/report.h"

namespace kurbel {

// --- formatting for people ---

// How a number is formatted.
struct ReadAs {
  double factor = 1;  // from SI
  int digits = 6;
  const char* otherwise = "—";  // for values that are not finite or not present
};

inline std::string read_as(double v, const ReadAs& r = {}) {
  const double x = r.factor * v;
  return std::isfinite(x) ? rounded_number(x == 0 ? 0.0 : x, r.digits) : std::string(r.otherwise);
}
inline std::string read_as(const std::string& text, const ReadAs& = {}) { return text; }
template <std::integral T>
std::string read_as(T v, const ReadAs& = {}) {
  return fmt::format("{}", v);
}
template <class T>
std::string read_as(const std::optional<T>& v, const ReadAs& r = {}) {
  return v ? read_as(*v, r) : std::string(r.otherwise);
}
template <class T, std::invocable<const T&> InWords>
std::string read_as(const T& v, const InWords& in_words) {
  return std::invoke(in_words, v);
}

// --- tables ---

struct Column {
  std::string key, heading;                  // empty: not for programs; not for people
  bool for_people = true;                    // even under an empty heading
  std::vector<Value> values = {};            // one per row, if there is a key or a file column
  std::vector<std::string> texts = {};       // one per row, if it is for people
  std::vector<std::string> long_texts = {};  // the same with all digits; empty: as `texts`
  std::optional<DataColumn> in_file = {};    // none: in no file
};

struct Rows {
  std::string key;           // of the list in JSON; empty: none
  std::string title;         // on the page
  std::string heading = {};  // on the terminal, above; empty: none
  std::vector<Column> columns = {};
  std::size_t count = 0;
  std::size_t for_programs = SIZE_MAX;                         // at most this many
  std::optional<std::vector<std::size_t>> for_people = {};     // indices of the shown rows; none: all
  bool whole_in_long_form = false;                             // --all shows rows beside `for_people`, too
  std::size_t text_columns = 1, text_columns_on_terminal = 1;  // leading text columns; the rest: numbers, on the right
  bool terminal = true, page = true, even_if_empty = false;
  bool folded = false;                        // on the page
  bool apart = true;                          // on the terminal, preceded by a blank line
  std::vector<std::vector<Tone>> tones = {};  // report.h
  std::vector<std::string> means = {};        // per row, the name of its figure in the dictionary; none, or one each

  List list() const;                                                           // for programs
  DataTable data() const;                                                      // columns for files
  std::vector<std::string> headings() const;                                   // for people
  std::vector<std::vector<std::string>> texts(bool all_digits = false) const;  // without the headings
  bool shown_to_people() const { return (count > 0 && (!for_people || !for_people->empty())) || even_if_empty; }
};

template <class T>
class RowsOf : public Rows {
 public:
  RowsOf(std::string of_key, std::string of_title, std::span<const T> rows, std::shared_ptr<const std::vector<T>> owned)
      : rows_(rows), owned_(std::move(owned)) {
    key = std::move(of_key), title = std::move(of_title), count = rows.size();
  }

  // `get` is a member or a function of a row; `read` a ReadAs, or a function that formats the result of `get`.
  template <class Get, class Read = ReadAs>
  RowsOf& column(std::string its_key, std::string its_heading, Get get, Read read = {}) {
    Column& made = columns.emplace_back(Column{std::move(its_key), std::move(its_heading)});
    for (const T& row : rows_) {
      const auto& value = std::invoke(get, row);
      if (!made.key.empty()) made.values.emplace_back(value);
      made.texts.push_back(read_as(value, read));
    }
    return *this;
  }
  template <class Get, class Read = ReadAs>
  RowsOf& only_for_people(std::string its_heading, Get get, Read read = {}) {
    Column& made = columns.emplace_back(Column{"", std::move(its_heading)});
    for (const T& row : rows_) made.texts.push_back(read_as(std::invoke(get, row), read));
    return *this;
  }
  template <class Get>
  RowsOf& only_for_programs(std::string its_key, Get get) {
    Column& made = columns.emplace_back(Column{.key = std::move(its_key), .heading = "", .for_people = false});
    for (const T& row : rows_) made.values.emplace_back(std::invoke(get, row));
    return *this;
  }

  // `get` gives an Estimate: KEY and KEY_error for programs, "6082.2 ± 0.6" for people.
  template <class Get>
  RowsOf& estimate(std::string its_key, std::string its_heading, Get get) {
    return column(std::move(its_key), std::move(its_heading), std::move(get),
                  [](const Estimate& e) { return with_error(e, ""); });
  }

  // For people: `get` returns FigureText or FigureCells for a row and a number of digits; one column of values, one
  // of errors.
  template <class Get>
  RowsOf& value_and_error(std::string its_heading, const Get& get, std::string of_error = "numerical error") {
    const auto value = [&](const T& row, int digits) { return std::invoke(get, row, digits).value; };
    only_for_people(std::move(its_heading), [&](const T& row) { return value(row, digits_in_tables); });
    for (const T& row : rows_) columns.back().long_texts.push_back(value(row, digits_in_long_forms));
    return only_for_people(std::move(of_error), [&](const T& row) {
      const std::string error = std::invoke(get, row, digits_in_tables).error;
      return error.empty() ? std::string("—") : error;
    });
  }

  // Writes the last column into a file as well, under its key. `digits`: significant ones of numbers.
  RowsOf& also_in_file(std::optional<std::string> unit = {}, int digits = 12) {
    columns.back().in_file = {columns.back().key, std::move(unit), {digits}};
    return *this;
  }
  // Only in a file. `get` returns a number, or std::optional of one (not finite: not known), or words.
  template <class Get>
  RowsOf& in_file(std::string name, std::optional<std::string> unit, Get get, int digits = 12) {
    only_for_programs(std::move(name), std::move(get)).also_in_file(std::move(unit), digits);
    columns.back().key.clear();
    return *this;
  }

  // For rows that are figures: `get` returns a row's name in the dictionary.
  template <class Get>
  RowsOf& explained_by(Get get) {
    for (const T& row : rows_) means.push_back(std::invoke(get, row));
    return *this;
  }

  // Where and how it is shown.
  RowsOf& headed(std::string on_terminal) { return heading = std::move(on_terminal), *this; }
  RowsOf& text_in(std::size_t leading) { return text_columns = text_columns_on_terminal = leading, *this; }
  RowsOf& text_in(std::size_t on_page, std::size_t on_terminal) {
    return text_columns = on_page, text_columns_on_terminal = on_terminal, *this;
  }
  RowsOf& fold(bool so = true) { return folded = so, *this; }
  RowsOf& close() { return apart = false, *this; }
  RowsOf& always() { return even_if_empty = true, *this; }
  RowsOf& not_on_terminal() { return terminal = false, *this; }
  RowsOf& not_on_page() { return page = false, *this; }
  RowsOf& people_see(std::vector<std::size_t> which) { return for_people = std::move(which), *this; }
  RowsOf& people_see_first(std::size_t most) {
    for_people.emplace();
    for (std::size_t i = 0; i < std::min(most, count); ++i) for_people->push_back(i);
    return *this;
  }
  RowsOf& people_see_it_if(bool so) { return so ? *this : people_see({}); }
  RowsOf& programs_see_first(std::size_t most) { return for_programs = most, *this; }

 private:
  std::span<const T> rows_;
  std::shared_ptr<const std::vector<T>> owned_;
};

// For rows that live while columns are added; temporary rows are kept.
template <class T>
RowsOf<T> table_of(std::string key, std::string title, const std::vector<T>& rows) {
  return {std::move(key), std::move(title), std::span<const T>(rows), nullptr};
}
template <class T>
RowsOf<T> table_of(std::string key, std::string title, std::vector<T>&& rows) {
  auto kept = std::make_shared<const std::vector<T>>(std::move(rows));
  const std::span<const T> view(*kept);
  return {std::move(key), std::move(title), view, std::move(kept)};
}
// For rows that are only in a file.
template <class T>
RowsOf<T> data_of(const std::vector<T>& rows) {
  return table_of("", "", rows);
}
template <class T>
RowsOf<T> data_of(std::vector<T>&& rows) {
  return table_of("", "", std::move(rows));
}
// 0, 1, … count − 1: rows of numbered items.
std::vector<std::size_t> numbers_below(std::size_t count);

// Rows of text under headings, for people only.
using Lines = std::vector<std::vector<std::string>>;
Rows words_table(const std::string& title, const std::vector<std::string>& headings, const Lines& lines);

}  // namespace kurbel
