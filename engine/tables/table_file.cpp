// table_file.cpp — what separates cells, where the numbers begin, which sign their decimals have.
#include "engine/tables/table_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/scene/text.h"
#include "engine/tables/heading.h"
#include "engine/tables/spreadsheet.h"

namespace kurbel {
namespace {

constexpr std::size_t lines_looked_at = 1000;  // of which the form is found
constexpr int most_bad_lines = 20;
constexpr std::string_view no_number[] = {"nan", "n/a", "na", "#n/a", "null", "none"};

// A number, or one gone wrong: "0,5", "1e999", "nan", "2-3"; not "time [s]" or "".
bool is_number_like(std::string_view cell) {
  if (cell.empty()) return false;
  double value = 0;
  const std::string_view without_sign = cell.starts_with('+') ? cell.substr(1) : cell;
  const auto [end, status] = std::from_chars(without_sign.data(), without_sign.data() + without_sign.size(), value);
  if (status != std::errc::invalid_argument && end == without_sign.data() + without_sign.size()) return true;
  return cell.find_first_of("0123456789") != std::string_view::npos &&
         cell.find_first_not_of("0123456789+-.,eE ") == std::string_view::npos;
}

// "", "NaN", "---", "n/a": no value was recorded.
bool is_missing(std::string_view cell) {
  if (cell.find_first_not_of("-*") == std::string_view::npos) return true;
  return std::any_of(std::begin(no_number), std::end(no_number),
                     [&](std::string_view word) { return equal_but_for_case(cell, word); });
}

bool is_word(std::string_view cell) { return !cell.empty() && !is_number_like(cell); }

bool has_words_alone(const std::vector<std::string_view>& cells) {
  return cells.size() > 1 && std::none_of(cells.begin(), cells.end(), is_number_like) &&
         std::any_of(cells.begin(), cells.end(), is_word);
}

bool has_two_numbers(const std::vector<std::string_view>& cells) {
  return std::count_if(cells.begin(), cells.end(), is_number_like) > 1;
}

bool is_whole(std::string_view cell) {
  return !cell.empty() &&
         cell.find_first_not_of("0123456789", cell[0] == '-' || cell[0] == '+') == std::string_view::npos;
}

// "1,234" and "12,345,678" may have their thousands marked; "0,125", "1,5" and "1234,567" cannot.
bool may_mark_thousands(std::string_view cell) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  std::size_t group = cell.find(',');
  if (group == 0 || group > 3 || cell[0] == '0') return false;
  for (cell.remove_prefix(group); !cell.empty(); cell.remove_prefix(4)) {
    if (cell[0] != ',' || cell.size() < 4) return false;
    if (cell.substr(1, 3).find_first_not_of("0123456789") != std::string_view::npos) return false;
  }
  return true;
}

std::string in_words(char separator) { return separator == '\t' ? "tabs" : separator == ';' ? "semicolons" : "commas"; }

}  // namespace

TableFile::TableFile(const std::string& path, const TableForm& form)
    : path_(path), text_(read_table_text(path, form.sheet)) {
  find_lines();
  if (lines_.empty()) return;
  if (form.words) {
    find_separator_of_heading();
    data_ = lines_.size() > 1 && is_of_units(1) ? 2 : 1;
    take_headings(data_ - 1);
    find_decimal_sign(form.decimal);
    return;
  }
  if (const std::size_t seen = find_separator(); seen == 0) {
    const auto plain = std::find_if(lines_.begin(), lines_.end(), [](const Line& line) {
      return is_number_like(trimmed(line.text).substr(0, trimmed(line.text).find_first_of(" ,;\t")));
    });
    const Line& line = plain == lines_.end() ? lines_.front() : *plain;
    const bool by_blanks = trimmed(line.text).find_first_of(",;\t") == std::string_view::npos &&
                           trimmed(line.text).find(' ') != std::string_view::npos && plain != lines_.end();
    refuse(line, by_blanks ? "its numbers seem to be separated by blanks; separate them by comma, semicolon or tab"
                           : "no line of the file has two numbers; cells are separated by comma, semicolon or tab");
  }
  find_data();
  if (form.decimal != '.') refuse_commas_for_both();
  find_decimal_sign(form.decimal);
}

void TableFile::refuse(const Line& line, const std::string& why) const {
  throw SceneError({{path_, {line.number, 1}, fmt::format("{}: {}", in_quotes(trimmed(line.text)), why)}});
}

// Quoted cells may hold ends of lines.
void TableFile::find_lines() {
  constexpr int most_lines_in_quotes = 8;
  const std::string_view text = text_.text;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(text.find('\n', begin), text.size());
    int lines = 1;
    const auto open = [&] {
      const std::string_view line = text.substr(begin, end - begin);
      const std::size_t quote = line.find('"');
      return quote != std::string_view::npos &&
             (quote == 0 || std::string_view(",;\t ").find(line[quote - 1]) != std::string_view::npos) &&
             std::count(line.begin(), line.end(), '"') % 2 == 1;
    };
    const std::size_t end_of_line = end;
    while (open() && end < text.size() && lines <= most_lines_in_quotes)
      end = std::min(text.find('\n', end + 1), text.size()), ++lines;
    if (open()) end = end_of_line, lines = 1;
    const Line line{text.substr(begin, end - begin), number + 1};
    number += lines;
    begin = end + 1;
    if (trimmed(line.text).starts_with('#'))
      remarks_.push_back(line);
    else if (line.text.find_first_not_of(" \t\r,;\"") != std::string_view::npos)
      lines_.push_back(line);
  }
}

void TableFile::split(std::string_view line, char separator, Cells& cells) const {
  cells.clear();
  const auto closing = [&](std::size_t from) {
    std::size_t at = line.find('"', from);
    while (at != std::string_view::npos && at + 1 < line.size() && line[at + 1] == '"') at = line.find('"', at + 2);
    return at;
  };
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = std::min(line.find(separator, begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    const std::size_t quote = line.find_first_not_of(' ', begin);
    if (quote != std::string_view::npos && line[quote] == '"') {
      const std::size_t last = closing(quote + 1);
      const std::size_t next = last == std::string_view::npos ? last : line.find_first_not_of(" \r", last + 1);
      if (last != std::string_view::npos && (next == std::string_view::npos || line[next] == separator)) {
        cell = line.substr(quote + 1, last - quote - 1);
        end = std::min(next, line.size());
      }
    }
    cells.push_back(trimmed(cell));
    begin = end + 1;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

TableFile::Cells TableFile::cells_of(const Line& line) const {
  Cells cells;
  split(line.text, separator_, cells);
  return cells;
}

// The one by which most lines give two numbers or more; how many lines that is.
std::size_t TableFile::find_separator() {
  const std::size_t count = std::min(lines_.size(), lines_looked_at);
  std::size_t most = 0;
  Cells cells;
  for (const char separator : text_.is_sheet ? std::string_view("\t") : std::string_view(";\t,")) {
    std::vector<std::size_t> numbers;  // lines that have one there, by column
    std::size_t good = 0;
    for (std::size_t i = 0; i < count; ++i) {
      split(lines_[i].text, separator, cells);
      if (!has_two_numbers(cells)) continue;
      ++good;
      numbers.resize(std::max(numbers.size(), cells.size()));
      for (std::size_t k = 0; k < cells.size(); ++k) numbers[k] += is_number_like(cells[k]);
    }
    if (good <= most) continue;
    most = good;
    separator_ = separator;
    of_numbers_.clear();
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (2 * numbers[k] >= good) of_numbers_.push_back(k);
  }
  return most;
}

// The first line with numbers, or nothing, in all columns of numbers; lines before it that have some of them and words
// in place of others are data gone wrong, unless a heading follows.
void TableFile::find_data() {
  const auto among = [&](const Cells& cells, auto&& is) {
    return std::count_if(of_numbers_.begin(), of_numbers_.end(),
                         [&](std::size_t k) { return k < cells.size() && is(cells[k]); });
  };
  const auto is_data = [&](const Line& line) {
    const Cells cells = cells_of(line);
    return among(cells, is_word) == 0 && among(cells, is_number_like) > 0;
  };
  const auto first = std::find_if(lines_.begin(), lines_.end(), is_data);
  const auto any = [&](const Line& line) { return has_two_numbers(cells_of(line)); };
  data_ = static_cast<std::size_t>((first != lines_.end() ? first : std::find_if(lines_.begin(), lines_.end(), any)) -
                                   lines_.begin());
  while (data_ > 0 && among(cells_of(lines_[data_ - 1]), is_number_like) > 0) --data_;
  if (data_ > 0 && has_words_alone(cells_of(lines_[data_ - 1])))
    take_headings(data_ - 1);
  else
    find_headings_among_remarks();
}

// The one that gives the first line most cells. Columns of numbers are those that hold them in most lines below it.
void TableFile::find_separator_of_heading() {
  std::size_t most = 0;
  Cells cells;
  for (const char separator : text_.is_sheet ? std::string_view("\t") : std::string_view(";\t,")) {
    split(lines_.front().text, separator, cells);
    if (cells.size() > most) separator_ = separator;
    most = std::max(most, cells.size());
  }
  std::vector<std::size_t> numbers(most);
  for (std::size_t i = 1; i < lines_.size(); ++i) {
    split(lines_[i].text, separator_, cells);
    for (std::size_t k = 0; k < std::min(most, cells.size()); ++k) numbers[k] += is_number_like(cells[k]);
  }
  for (std::size_t k = 0; k < most; ++k)
    if (2 * numbers[k] >= lines_.size() - 1 && numbers[k] > 0) of_numbers_.push_back(k);
}

// A line of units below one of names.
bool TableFile::is_of_units(std::size_t line) const {
  const Cells last = cells_of(lines_[line]);
  const auto filled = [](const Cells& cells) {
    return std::count_if(cells.begin(), cells.end(), [](std::string_view c) { return !c.empty(); });
  };
  const auto units =
      std::count_if(last.begin(), last.end(), [](std::string_view c) { return unit_in_cell(c).has_value(); });
  return line > 0 && has_words_alone(cells_of(lines_[line - 1])) && 2 * units > filled(last) &&
         filled(cells_of(lines_[line - 1])) >= filled(last);
}

// From this line; where it is one of units, from the line above it.
void TableFile::take_headings(std::size_t line) {
  const Cells last = cells_of(lines_[line]);
  const bool below_names = is_of_units(line);
  const Line& of_names = lines_[below_names ? line - 1 : line];
  const Cells names = cells_of(of_names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int column = static_cast<int>(k) + 1;
    NameWithUnit both = name_with_unit(names[k]);
    if (below_names && k < last.size() && !last[k].empty())
      both = {std::string(names[k]), unit_in_cell(last[k]).value_or(std::string(last[k]))};
    headings_.push_back({std::string(names[k]), both.name, both.unit, column, place(of_names, names[k], column)});
  }
}

// "# time [s], torque [N*m]": of as many words as the data have columns.
void TableFile::find_headings_among_remarks() {
  const auto behind =
      std::find_if(remarks_.rbegin(), remarks_.rend(), [&](const Line& r) { return r.number < lines_[data_].number; });
  if (behind == remarks_.rend()) return;
  Line line = *behind;
  line.text.remove_prefix(line.text.find('#') + 1);
  const Cells cells = cells_of(line);
  if (!has_words_alone(cells) || cells.size() != cells_of(lines_[data_]).size()) return;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const int column = static_cast<int>(k) + 1;
    const NameWithUnit both = name_with_unit(cells[k]);
    headings_.push_back({std::string(cells[k]), both.name, both.unit, column, place(*behind, cells[k], column)});
  }
}

// "0,5,1,5" may be four whole numbers or two with decimals.
void TableFile::refuse_commas_for_both() const {
  if (separator_ != ',') return;
  const std::size_t end = std::min(lines_.size(), data_ + lines_looked_at);
  for (std::size_t i = data_; i < end; ++i) {
    const Cells cells = cells_of(lines_[i]);
    const bool in_pairs =
        cells.size() % 2 == 0 && (headings_.empty() ? cells.size() >= 4 : cells.size() == 2 * headings_.size());
    if (!in_pairs || !std::all_of(cells.begin(), cells.end(), is_whole)) return;
  }
  refuse(
      lines_[data_],
      fmt::format("{} whole numbers, or {} with decimal commas; separate cells by semicolons, or say decimal = \".\"",
                  cells_of(lines_[data_]).size(), cells_of(lines_[data_]).size() / 2));
}

// By all cells with a comma or a point: one that can be decimals alone settles it.
void TableFile::find_decimal_sign(char said) {
  const bool may_be_comma = separator_ != ',' || text_.text.find('"') != std::string::npos;
  if (said || !may_be_comma) {
    decimal_ = said ? said : '.';
    return;
  }
  const Line *comma = nullptr, *point = nullptr, *settled = nullptr;
  std::string_view comma_cell, point_cell;
  Cells cells;
  for (std::size_t i = data_; i < lines_.size(); ++i) {
    split(lines_[i].text, separator_, cells);
    for (const std::size_t k : of_numbers_) {
      if (k >= cells.size() || !is_number_like(cells[k])) continue;
      const std::string_view cell = cells[k];
      const auto commas = std::count(cell.begin(), cell.end(), ',');
      const bool points = cell.find('.') != std::string_view::npos;
      if (commas > 0 && (points || commas > 1))
        refuse(lines_[i],
               fmt::format("{} seems to have its thousands marked; write numbers without marks", in_quotes(cell)));
      if (points && !point) point = &lines_[i], point_cell = cell;
      if (commas > 0 && !comma) comma = &lines_[i], comma_cell = cell;
      if (commas > 0 && !may_mark_thousands(cell)) settled = &lines_[i];
    }
  }
  if (comma && point)
    refuse(*comma, fmt::format("{} with a comma, and {} in line {} with a point; write all decimals with one sign",
                               in_quotes(comma_cell), in_quotes(point_cell), point->number));
  if (comma && !settled)
    refuse(*comma, fmt::format("{} may be decimals or thousands, as all numbers of the file with a comma; say decimal "
                               "= \",\", or write them without commas",
                               in_quotes(comma_cell)));
  decimal_ = comma ? ',' : '.';
}

const TableHeading* TableFile::find(std::string_view wanted) const {
  const std::string name = name_with_unit(wanted).name;
  const TableHeading* found = nullptr;
  for (const TableHeading& heading : headings_) {
    if (heading.text == wanted) return &heading;
    if (!equal_but_for_case(heading.name, name)) continue;
    if (found)
      throw SceneError({{path_, heading.at,
                         fmt::format("two columns are named {}: {} and {}; say the number of one", in_quotes(name),
                                     found->column, heading.column)}});
    found = &heading;
  }
  return found;
}

std::vector<std::string> TableFile::names() const {
  std::vector<std::string> names;
  for (const TableHeading& heading : headings_) names.push_back(heading.name);
  return names;
}

std::optional<double> TableFile::number_in(std::string_view cell) const {
  std::string in_points;
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  if (decimal_ == ',' && cell.find(',') != std::string_view::npos) {
    if (cell.find('.') != std::string_view::npos) return std::nullopt;
    in_points = cell;
    in_points[in_points.find(',')] = '.';
    cell = in_points;
  }
  double value = 0;
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Lines within a quoted cell count.
Location TableFile::place(const Line& line, std::string_view cell, int column) const {
  if (text_.is_sheet) return {line.number, column};
  if (!cell.data()) return {line.number, 1};
  const std::string_view before = line.text.substr(0, static_cast<std::size_t>(cell.data() - line.text.data()));
  const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 = 0
  return {line.number + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          static_cast<int>(before.size() - begin) + 1};
}

std::string TableFile::place_in_words(const Line& line, int column) const {
  return text_.is_sheet ? fmt::format("cell {}: ", cell_name(line.number, column)) : "";
}

std::string TableFile::separated() const {
  return text_.is_sheet ? "" : "; cells are separated by " + in_words(separator_);
}

TableNumbers TableFile::numbers(const std::vector<int>& columns, Messages& messages, std::size_t* incomplete) const {
  TableNumbers numbers{std::vector<std::vector<double>>(columns.size()), {}};
  std::vector<double> row(columns.size());
  Cells cells;
  const int last_column = *std::max_element(columns.begin(), columns.end());
  int bad = 0;
  for (std::size_t i = data_; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    if (bad == most_bad_lines) {
      messages.add_in(path_, {line.number, 1}, fmt::format("{} bad lines so far; the rest is not read", bad));
      break;
    }
    split(line.text, separator_, cells);
    const auto cell_at = [&](int column) {
      const auto k = static_cast<std::size_t>(column - 1);
      return k < cells.size() ? cells[k] : std::string_view();
    };
    if (std::all_of(columns.begin(), columns.end(), [&](int c) { return cell_at(c).empty(); }) && i > data_) continue;
    if (incomplete && std::any_of(columns.begin(), columns.end(), [&](int c) { return is_missing(cell_at(c)); })) {
      ++*incomplete;
      continue;
    }
    if (last_column > static_cast<int>(cells.size())) {
      messages.add_in(path_, {line.number, 1},
                      fmt::format("column {} is wanted, but this line has {} cell{}{}: {}", last_column, cells.size(),
                                  cells.size() == 1 ? "" : "s", separated(), in_quotes(trimmed(line.text))));
      ++bad;
      if (i == data_) break;  // so will all the others
      continue;
    }
    bool good = true;
    for (std::size_t k = 0; k < columns.size() && good; ++k) {
      const std::string_view cell = cell_at(columns[k]);
      const std::optional<double> value = number_in(cell);
      good = value.has_value();
      row[k] = value.value_or(0);
      if (good) continue;
      messages.add_in(path_, place(line, cell, columns[k]),
                      fmt::format("{}{} is not a finite number{}", place_in_words(line, columns[k]), in_quotes(cell),
                                  cell.find(decimal_ == ',' ? '.' : ',') == std::string_view::npos ? ""
                                  : decimal_ == ',' ? "; decimals are written with a comma here"
                                                    : "; decimals are written with a point"));
      ++bad;
    }
    if (!good) continue;
    for (std::size_t k = 0; k < columns.size(); ++k) numbers.columns[k].push_back(row[k]);
    numbers.at.push_back(place(line, cell_at(columns.front()), columns.front()));
  }
  return numbers;
}

std::vector<std::vector<TableCell>> TableFile::cells(bool may_be_empty) const {
  std::vector<std::vector<TableCell>> rows;
  for (std::size_t i = data_; i < lines_.size(); ++i) {
    Cells cells = cells_of(lines_[i]);
    if (may_be_empty && cells.size() < headings_.size())
      cells.resize(headings_.size(), lines_[i].text.substr(lines_[i].text.size()));
    if (cells.size() != headings_.size())
      refuse(lines_[i], fmt::format("{} cells under {} headings{}", cells.size(), headings_.size(), separated()));
    std::vector<TableCell>& row = rows.emplace_back();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Location at = place(lines_[i], cells[k], static_cast<int>(k) + 1);
      if (cells[k].empty() && !may_be_empty)
        throw SceneError({{path_, at, fmt::format("a cell under {} is empty", in_quotes(headings_[k].text))}});
      std::string text(cells[k]);
      if (decimal_ == ',' && is_number_like(text)) std::replace(text.begin(), text.end(), ',', '.');
      row.push_back({std::move(text), at});
    }
  }
  return rows;
}

}  // namespace kurbel
