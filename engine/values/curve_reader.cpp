// curve_reader.cpp — what it is given over, in which units, point by point.
#include "engine/values/curve_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/tables/table_file.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

constexpr std::size_t most_points = 1'000'000;

class CurveReader {
 public:
  CurveReader(const DocumentValue& table, const Key& key, std::string what, Messages& messages, DataFiles allowed)
      : table_(table), key_(key), what_(std::move(what)), messages_(messages), allowed_(allowed) {}

  bool read(CurveData& curve) {
    if (table_.type != Type::table)
      return messages_.add(
                 table_.at,
                 fmt::format("{} = {}; must be a table such as {{ over = \"{}\", unit = [\"{}\", \"{}\"], {} }}", what_,
                             table_.describe(), key_.choices.front(), unit_over(key_.choices.front()), key_.unit,
                             table_.type == Type::text ? "file = " + table_.describe() : "points = [[0, 0], [1, 1]]")),
             false;
    for (const DocumentEntry& e : table_.entries) {
      static const std::vector<std::string> known = {
          "over",          "unit",   "points",  "file",           "return_points", "return_file", "columns",
          "interpolation", "period", "formula", "return_formula", "range",         "with",        "sheet",
          "decimal",       "gain",   "offset",  "shift",          "beyond"};
      if (std::find(known.begin(), known.end(), e.key) != known.end()) continue;
      if (const auto near = nearest(e.key, known)) meant_.push_back(*near);
      refuse(e.at, fmt::format("unknown key {}{}; allowed: {}", in_quotes(e.key), suggestion(e.key, known),
                               listed(known, "and")));
    }
    const std::size_t before = messages_.all().size();
    if (!read_over(curve) || !read_beyond(curve)) return false;
    if (table_.find("formula") || table_.find("return_formula"))
      return read_curve_formula(table_, key_, what_, messages_, curve) && messages_.all().size() == before;
    for (const char* key : {"range", "with"})
      if (const DocumentEntry* entry = table_.find(key))
        refuse(entry->at, fmt::format("\"{}\" belongs to \"formula\", which is not given", key));
    // Each says itself what is wrong with it; a mistyped key was named above, and what it should hold is missing.
    const bool units = read_units(curve.over), form = read_form(curve), file_form = read_file_form(),
               points = units && file_form && read_points("points", "file", true, curve.x, curve.y),
               back =
                   units && file_form && read_points("return_points", "return_file", false, curve.x_back, curve.y_back);
    return form && points && back && messages_.all().size() == before && correct(curve) && check_period(curve) &&
           check_points(curve);
  }

 private:
  bool refuse(Location at, const std::string& text) {
    messages_.add(at, fmt::format("{}: {}", what_, text));
    return false;
  }

  bool is_meant(const std::string& key) const { return std::find(meant_.begin(), meant_.end(), key) != meant_.end(); }

  bool read_over(CurveData& curve) {
    const DocumentEntry* over = table_.find("over");
    curve.over = key_.choices.front();
    if (!over && key_.choices.size() == 1) return true;
    if (!over)
      return !is_meant("over") &&
             refuse(table_.at,
                    fmt::format("\"over\" is missing: what the first column is; allowed: {}", listed(key_.choices)));
    curve.over = over->value.text;
    if (std::find(key_.choices.begin(), key_.choices.end(), curve.over) != key_.choices.end()) return true;
    return refuse(over->value.at, fmt::format("over = {}{}; allowed: {}", over->value.describe(),
                                              suggestion(curve.over, key_.choices), listed(key_.choices)));
  }

  // Of the scene; a file's heading may say them in its place.
  bool read_units(const std::string& over) {
    const DocumentEntry* units = table_.find("unit");
    wanted_ = {unit_over(over), key_.unit};
    if (!units) {
      const bool inline_points = table_.find("points") || table_.find("return_points");
      if (!inline_points && (table_.find("file") || table_.find("return_file"))) return true;
      return !is_meant("unit") &&
             refuse(table_.at,
                    fmt::format("\"unit\" is missing; say the units of both columns, e.g. unit = [\"{}\", \"{}\"]",
                                wanted_[0], wanted_[1]));
    }
    const DocumentValue& list = units->value;
    if (list.type != Type::list || list.items.size() != 2)
      return refuse(list.at, fmt::format("unit = {}; must be a list of two units, e.g. [\"{}\", \"{}\"]",
                                         list.describe(), wanted_[0], wanted_[1]));
    bool good = true;
    for (std::size_t k = 0; k < 2; ++k) good = read_unit(list.items[k], k) && good;
    units_ = &list;
    return good;
  }
  bool read_unit(const DocumentValue& value, std::size_t k) {
    if (value.type != Type::text)
      return refuse(value.at,
                    fmt::format("unit = {}; must be a unit in quotes, e.g. \"{}\"", value.describe(), wanted_[k]));
    UnitError error;
    const auto factor = factor_of(value.text, k, error);
    if (!factor)
      return refuse(place_within(value, error.column), fmt::format("unit = {}{}", value.describe(), error.text));
    factor_[k] = *factor, unit_text_[k] = value.text;
    return true;
  }
  // To SI, of a column's unit; else why it is none.
  std::optional<double> factor_of(const std::string& text, std::size_t k, UnitError& error) const {
    const Dimension wanted = parse_unit(wanted_[k], error)->dimension;
    auto unit = parse_unit(text == "-" ? "" : text, error);
    if (!unit) {
      error.text = ": " + error.text;
      return {};
    }
    unit = wanted_as(*unit, wanted);
    if (unit->dimension != wanted)
      error = {fmt::format(" is the unit of {}; must be one of {}{}", name_of(unit->dimension), name_of(wanted),
                           force_meant(text, unit->dimension, wanted))};
    else if (!std::isfinite(unit->factor) || unit->factor == 0)
      error = {" is out of range"};
    else
      return unit->factor;
    return {};
  }
  // Of a file's column: its heading's unit and the scene's must be the same; one of them is needed.
  bool take_unit(const TableFile& file, int column, std::size_t k) {
    const bool named = column <= static_cast<int>(file.headings().size());
    const TableHeading* heading = named ? &file.headings()[static_cast<std::size_t>(column - 1)] : nullptr;
    const auto refuse_heading = [&](const std::string& text) {
      messages_.add_in(file.path(), heading->at,
                       fmt::format("{}: column {}: {}", what_, in_quotes(heading->text), text));
      return false;
    };
    if (!heading || !heading->unit) {
      if (units_) return true;
      return refuse(table_.at, fmt::format("neither \"unit\" nor the heading of column {} of the file says its unit; "
                                           "give e.g. unit = [\"{}\", \"{}\"]",
                                           column, wanted_[0], wanted_[1]));
    }
    UnitError error;
    const auto factor = factor_of(*heading->unit, k, error);
    if (!factor) return refuse_heading(fmt::format("unit [{}]{}", *heading->unit, error.text));
    if (units_ && std::abs(*factor - factor_[k]) > 1e-12 * std::abs(*factor))
      return refuse(
          units_->items[k].at,
          fmt::format("unit = {}, but the heading {} of the file says {}; drop `unit`, or correct one of them",
                      units_->items[k].describe(), in_quotes(heading->text), in_quotes(*heading->unit)));
    factor_[k] = *factor, unit_text_[k] = *heading->unit;
    return true;
  }

  bool read_form(CurveData& curve) {
    if (const DocumentEntry* form = table_.find("interpolation")) {
      if (form->value.text != "linear" && form->value.text != "smooth")
        return refuse(form->value.at,
                      fmt::format("interpolation = {}; allowed: \"linear\" or \"smooth\"", form->value.describe()));
      curve.form = form->value.text == "smooth" ? Curve::Form::smooth : Curve::Form::linear;
    }
    const DocumentEntry* period = table_.find("period");
    if (!period) return true;
    return read_quantity(period->value, unit_over(curve.over), positive, what_ + ": period", messages_, curve.period);
  }

  bool read_beyond(CurveData& curve) {
    const DocumentEntry* entry = table_.find("beyond");
    if (!entry) return true;
    if (curve.over == "angle")
      return refuse(
          entry->at,
          "\"beyond\" of a table over the angle, which repeats and has no end; drop it, and give the points of a "
          "whole period: a turn, or period = \"720 deg\"");
    static const std::vector<std::string> allowed = {"hold", "line", "refuse"};
    const auto found = std::find(allowed.begin(), allowed.end(), entry->value.text);
    if (found == allowed.end())
      return refuse(entry->value.at, fmt::format("beyond = {}{}; allowed: {}", entry->value.describe(),
                                                 suggestion(entry->value.text, allowed), listed(allowed)));
    curve.beyond = static_cast<Beyond>(found - allowed.begin() + 1);
    return !table_.find("period") || refuse(entry->at, "\"beyond\" and \"period\" both given; keep one");
  }

  // What of a file's form the scene says.
  bool read_file_form() {
    const bool any_file = table_.find("file") || table_.find("return_file");
    for (const char* key : {"sheet", "decimal", "columns"})
      if (const DocumentEntry* entry = table_.find(key); entry && !any_file && !is_meant("file"))
        return refuse(entry->at, fmt::format("\"{}\" belongs to \"file\", which is not given", key));
    if (const DocumentEntry* sheet = table_.find("sheet")) {
      if (sheet->value.type != Type::text || sheet->value.text.empty())
        return refuse(sheet->value.at,
                      fmt::format("sheet = {}; must be the name of a sheet in quotes", sheet->value.describe()));
      form_.sheet = sheet->value.text;
    }
    if (const DocumentEntry* decimal = table_.find("decimal")) {
      if (decimal->value.text != "," && decimal->value.text != ".")
        return refuse(decimal->value.at,
                      fmt::format("decimal = {}; allowed: \",\" or \".\"", decimal->value.describe()));
      form_.decimal = decimal->value.text[0];
    }
    return true;
  }

  // Instruments' corrections: gain · y + offset over x + shift.
  bool correct(CurveData& curve) {
    double gain = 1, offset = 0, shift = 0;
    const auto read = [&](const char* name, const std::string& unit, double& value) {
      const DocumentEntry* entry = table_.find(name);
      return !entry ||
             read_quantity(entry->value, unit == "1" ? "" : unit, any_number, what_ + ": " + name, messages_, value);
    };
    if (!read("gain", "", gain) || !read("offset", wanted_[1], offset) || !read("shift", wanted_[0], shift))
      return false;
    for (auto* x : {&curve.x, &curve.x_back})
      for (double& place : *x) place += shift;
    for (auto* y : {&curve.y, &curve.y_back})
      for (double& value : *y) value = gain * value + offset;
    return true;
  }

  bool read_points(const char* inline_key, const char* file_key, bool required, std::vector<double>& x,
                   std::vector<double>& y) {
    const DocumentEntry* points = table_.find(inline_key);
    const DocumentEntry* file = table_.find(file_key);
    if (points && file)
      return refuse(file->at, fmt::format("\"{}\" and \"{}\" both given; keep one", inline_key, file_key));
    if (points) return read_inline(points->value, inline_key, x, y);
    if (file) return read_file(file->value, x, y);
    if (is_meant(inline_key) || is_meant(file_key)) return false;
    return required ? refuse(table_.at, "no data; give points = [[x, y], …], file = \"data.csv\" or formula = \"…\"")
                    : true;
  }
  bool read_inline(const DocumentValue& list, const char* name, std::vector<double>& x, std::vector<double>& y) {
    if (list.type != Type::list)
      return refuse(list.at, fmt::format("{} = {}; must be a list of pairs [[x, y], …]", name, list.describe()));
    if (list.items.size() < 2)
      return refuse(list.at, fmt::format("{} has {} point{}; must be two or more", name, list.items.size(),
                                         list.items.size() == 1 ? "" : "s"));
    double last = -HUGE_VAL, before_last = -HUGE_VAL;
    int number = 0;
    for (const DocumentValue& pair : list.items) {
      ++number;
      if (pair.type != Type::list || pair.items.size() != 2 || !is_number(pair.items[0]) || !is_number(pair.items[1]))
        return refuse(pair.at, fmt::format("{}[{}] is no pair of plain numbers [x, y]; their units stand in `unit`",
                                           name, number));
      if (!std::isfinite(pair.items[0].number) || !std::isfinite(pair.items[1].number))
        return refuse(pair.at,
                      fmt::format("the point [{}, {}] is not finite", pair.items[0].number, pair.items[1].number));
      const double here = pair.items[0].number;
      if (const std::string wrong = not_ascending(here, last, before_last); !wrong.empty())
        return refuse(pair.items[0].at, wrong);
      before_last = last;
      last = here;
      if (!add_point(pair.items[0].number, pair.items[1].number, messages_.file(), pair.at, x, y)) return false;
    }
    return true;
  }
  // In SI, where both are of a size to be computed with, and the first column still ascends.
  bool add_point(double x, double y, const std::string& file, Location at, std::vector<double>& all_x,
                 std::vector<double>& all_y) {
    const double x_si = x * factor_[0], y_si = y * factor_[1];
    std::string wrong;
    if (!(std::abs(x_si) <= greatest_size) || !(std::abs(y_si) <= greatest_size))
      wrong =
          fmt::format("the point [{}, {}] is too large; in SI units both must be within ± {:g}", x, y, greatest_size);
    else if (!all_x.empty() && x_si != all_x.back() && !(x_si - all_x.back() > least_size))
      wrong = fmt::format(
          "x = {} lies so near to the point before it that no slope can be computed between them; set them farther "
          "apart",
          x);
    else if (all_x.size() >= most_points)
      wrong = fmt::format("more than {} points; thin them out", most_points);
    if (!wrong.empty()) {
      messages_.add_in(file, at, fmt::format("{}: {}", what_, wrong));
      return false;
    }
    all_x.push_back(x_si);
    all_y.push_back(y_si);
    return true;
  }
  // Two points at one place are a jump; empty: they ascend.
  static std::string not_ascending(double x, double last, double before_last) {
    if (x < last) return fmt::format("x = {} follows {}; the first column must ascend", x, last);
    if (x == last && x == before_last)
      return fmt::format("x = {} stands three times; two points at one x are a jump, from the first to the second", x);
    return {};
  }
  bool read_file(const DocumentValue& value, std::vector<double>& x, std::vector<double>& y) {
    if (value.type != Type::text)
      return refuse(value.at, fmt::format("file = {}; must be the path of a CSV file in quotes", value.describe()));
    const std::filesystem::path folder = std::filesystem::path(messages_.file()).parent_path();
    const std::filesystem::path path = folder / value.text;
    if (allowed_ == DataFiles::below_the_scene && !lies_below(folder, path))
      return refuse(value.at, fmt::format("file {} lies outside of the scene's folder; put it there or below, or, if "
                                          "you trust the scene, allow it with --allow-files",
                                          value.describe()));
    try {
      const TableFile file(path.string(), form_);
      std::vector<int> columns = {1, 2};
      if (!read_columns(file, columns)) return false;
      for (std::size_t k = 0; k < 2; ++k)
        if (!take_unit(file, columns[k], k)) return false;
      const std::size_t before = messages_.all().size();
      const TableNumbers data = file.numbers(columns, messages_);
      if (messages_.all().size() > before) return false;
      return take_rows(data, value, path.string(), x, y);
    } catch (const SceneError& error) {
      const Message& first = error.messages.front();
      if (first.at.line == 0) return refuse(value.at, fmt::format("file {}: {}", value.describe(), first.text));
      messages_.add_in(first.file, first.at, fmt::format("{}: {}", what_, first.text));
      return false;
    }
  }
  bool take_rows(const TableNumbers& data, const DocumentValue& file, const std::string& path, std::vector<double>& x,
                 std::vector<double>& y) {
    const std::vector<double>&all_x = data.columns[0], &all_y = data.columns[1];
    if (all_x.size() < 2)
      return refuse(file.at, fmt::format("file {} has {} row{} of numbers; must be two or more", file.describe(),
                                         all_x.size(), all_x.size() == 1 ? "" : "s"));
    for (std::size_t i = 1; i < all_x.size(); ++i)
      if (const std::string wrong = not_ascending(all_x[i], all_x[i - 1], i > 1 ? all_x[i - 2] : -HUGE_VAL);
          !wrong.empty()) {
        messages_.add_in(path, {data.at[i].line, 1}, wrong);
        return false;
      }
    for (std::size_t i = 0; i < all_x.size(); ++i)
      if (!add_point(all_x[i], all_y[i], path, {data.at[i].line, 1}, x, y)) return false;
    return true;
  }
  // By their numbers from 1, or by their names in the heading.
  bool read_columns(const TableFile& file, std::vector<int>& columns) {
    const DocumentEntry* given = table_.find("columns");
    if (!given) return true;
    const auto& items = given->value.items;
    const auto is_number_of_one = [](const DocumentValue& v) {
      return is_whole(v) && v.number >= 1 && v.number <= 16384;
    };
    const auto is_column = [&](const DocumentValue& v) {
      return is_number_of_one(v) || (v.type == Type::text && !v.computed);
    };
    if (given->value.type != Type::list || items.size() != 2 || !is_column(items[0]) || !is_column(items[1]))
      return refuse(given->value.at, fmt::format("columns = {}; must be two columns, by numbers from 1 or by names, "
                                                 "e.g. [1, 2] or [\"speed\", \"torque\"]",
                                                 given->value.describe()));
    for (std::size_t k = 0; k < 2; ++k) {
      if (is_number_of_one(items[k])) {
        columns[k] = static_cast<int>(items[k].number);
        continue;
      }
      const TableHeading* heading = file.find(items[k].text);
      if (!heading)
        return refuse(items[k].at,
                      file.headings().empty()
                          ? fmt::format("column {}: the file has no heading; give its number", items[k].describe())
                          : fmt::format("the file has no column {}{}; there are {}", items[k].describe(),
                                        suggestion(items[k].text, file.names()), shortened_list(file.names(), "and")));
      columns[k] = heading->column;
    }
    return true;
  }

  // What else points may have against them: all of them at one place.
  bool check_points(const CurveData& curve) {
    try {
      static_cast<void>(curve.curve());
      static_cast<void>(curve.back());
      return true;
    } catch (const std::invalid_argument& error) {
      return refuse(table_.at, error.what());
    }
  }

  // The points fit into the period, and the curve closes.
  bool check_period(const CurveData& curve) {
    if (!(curve.period > 0)) return true;
    const Location at = table_.find("period")->value.at;
    const auto in_user_unit = [&](double x) { return with_unit(x / factor_[0], unit_text_[0]); };
    if (const std::string wrong = wrong_period(curve); !wrong.empty()) return refuse(at, wrong);
    for (const auto* x : {&curve.x, &curve.x_back})
      if (!x->empty() && x->back() - x->front() > curve.period * (1 + 1e-9))
        return refuse(at, fmt::format("period = {}; must be at least the span of the points, {}",
                                      in_user_unit(curve.period), in_user_unit(x->back() - x->front())));
    const bool closing_point = std::abs(curve.x.back() - curve.x.front() - curve.period) <= 1e-9 * curve.period;
    if (closing_point && std::abs(curve.y.back() - curve.y.front()) >
                             1e-9 * std::max(std::abs(curve.y.back()), std::abs(curve.y.front())))
      return refuse(at, fmt::format("the last point lies one period after the first, but {} is not {}; make them "
                                    "equal, drop the last point, or let it jump back: a second point at this place",
                                    with_unit(curve.y.back() / factor_[1], unit_text_[1]),
                                    with_unit(curve.y.front() / factor_[1], unit_text_[1])));
    try {
      Curve(curve.x, curve.y, curve.form, curve.period);
      if (!curve.x_back.empty()) Curve(curve.x_back, curve.y_back, curve.form, curve.period);
      return true;
    } catch (const std::invalid_argument& error) {
      return refuse(at, error.what());
    }
  }

  const DocumentValue& table_;
  const Key& key_;
  std::string what_;
  Messages& messages_;
  DataFiles allowed_;
  std::vector<std::string> meant_;                 // known keys that unknown ones were taken for
  std::array<std::string, 2> wanted_, unit_text_;  // of the columns: in SI, as given
  std::array<double, 2> factor_{1, 1};             // of these, to SI
  const DocumentValue* units_ = nullptr;           // the scene's
  TableForm form_;                                 // of its files
};

}  // namespace

std::string unit_over(const std::string& over) {
  if (over == "time") return "s";
  if (over == "angle" || over == "swing" || over == "twist") return "rad";
  if (over == "speed ratio") return "1";
  if (over == "speed") return "rad/s";
  return "m";  // travel
}

std::string wrong_period(const CurveData& curve) {
  const double turns = 4 * std::numbers::pi / curve.period;
  if (curve.over != "angle" || std::abs(turns - std::round(turns)) <= 1e-9) return {};
  return fmt::format("period = {:g} deg; must divide two turns (720 deg) without remainder",
                     curve.period * 180 / std::numbers::pi);
}

bool read_curve(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, CurveData& curve) {
  return CurveReader(table, key, what, messages, allowed).read(curve);
}

}  // namespace kurbel
