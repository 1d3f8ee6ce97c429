// curve_reader.cpp — what it is given over, in which units, point by point.
#include "engine/values/curve_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/scene/csv.h"
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
          "interpolation", "period", "formula", "return_formula", "range",         "with"};
      if (std::find(known.begin(), known.end(), e.key) != known.end()) continue;
      const auto near = nearest(e.key, known);
      if (near) meant_.push_back(*near);
      refuse(e.at, fmt::format("unknown key {}{}; allowed: {}", in_quotes(e.key),
                               near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(known, "and")));
    }
    const std::size_t before = messages_.all().size();
    if (!read_over(curve)) return false;
    if (table_.find("formula") || table_.find("return_formula"))
      return read_curve_formula(table_, key_, what_, messages_, curve) && messages_.all().size() == before;
    for (const char* key : {"range", "with"})
      if (const DocumentEntry* entry = table_.find(key))
        refuse(entry->at, fmt::format("\"{}\" belongs to \"formula\", which is not given", key));
    // Each says itself what is wrong with it; a mistyped key was named above, and what it should hold is missing.
    const bool units = read_units(curve.over), form = read_form(curve),
               points = read_points("points", "file", true, curve.x, curve.y),
               back = read_points("return_points", "return_file", false, curve.x_back, curve.y_back);
    return units && form && points && back && messages_.all().size() == before && check_period(curve) &&
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
    const auto near = nearest(curve.over, key_.choices);
    return refuse(over->value.at,
                  fmt::format("over = {}{}; allowed: {}", over->value.describe(),
                              near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(key_.choices)));
  }

  bool read_units(const std::string& over) {
    const DocumentEntry* units = table_.find("unit");
    const std::string x_unit = unit_over(over);
    if (!units)
      return !is_meant("unit") &&
             refuse(table_.at,
                    fmt::format("\"unit\" is missing; say the units of both columns, e.g. unit = [\"{}\", \"{}\"]",
                                x_unit, key_.unit));
    const DocumentValue& list = units->value;
    if (list.type != Type::list || list.items.size() != 2)
      return refuse(list.at, fmt::format("unit = {}; must be a list of two units, e.g. [\"{}\", \"{}\"]",
                                         list.describe(), x_unit, key_.unit));
    const bool first = read_unit(list.items[0], x_unit, x_factor_),
               second = read_unit(list.items[1], key_.unit, y_factor_);
    if (first) x_unit_ = list.items[0].text;
    if (second) y_unit_ = list.items[1].text;
    return first && second;
  }
  bool read_unit(const DocumentValue& value, const std::string& wanted, double& factor) {
    UnitError error;
    const auto target = parse_unit(wanted, error);
    if (value.type != Type::text)
      return refuse(value.at,
                    fmt::format("unit = {}; must be a unit in quotes, e.g. \"{}\"", value.describe(), wanted));
    auto unit = parse_unit(value.text, error);
    if (!unit)
      return refuse(place_within(value, error.column), fmt::format("unit = {}: {}", value.describe(), error.text));
    unit = wanted_as(*unit, target->dimension);
    if (unit->dimension != target->dimension)
      return refuse(value.at, fmt::format("unit = {} is the unit of {}; must be one of {}", value.describe(),
                                          name_of(unit->dimension), name_of(target->dimension)));
    if (!std::isfinite(unit->factor) || unit->factor == 0)
      return refuse(value.at, fmt::format("unit = {} is out of range", value.describe()));
    factor = unit->factor;
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
    const double x_si = x * x_factor_, y_si = y * y_factor_;
    std::string wrong;
    if (!(std::abs(x_si) <= greatest_size) || !(std::abs(y_si) <= greatest_size))
      wrong =
          fmt::format("the point [{}, {}] is too large; in SI units both must be within ± {:g}", x, y, greatest_size);
    else if (!all_x.empty() && x_si != all_x.back() && !(x_si - all_x.back() > least_size))
      wrong = fmt::format(
          "x = {} lies so near to the point before it that no slope can be computed between them; set "
          "them farther apart",
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
    int column[2] = {1, 2};
    if (const DocumentEntry* columns = table_.find("columns")) {
      const auto& items = columns->value.items;
      const auto is_column = [](const DocumentValue& v) { return is_whole(v) && v.number >= 1 && v.number <= 1000; };
      if (columns->value.type != Type::list || items.size() != 2 || !is_column(items[0]) || !is_column(items[1]))
        return refuse(columns->value.at,
                      fmt::format("columns = {}; must be two column numbers counted from 1, e.g. [1, 2]",
                                  columns->value.describe()));
      column[0] = static_cast<int>(items[0].number);
      column[1] = static_cast<int>(items[1].number);
    }
    const std::filesystem::path folder = std::filesystem::path(messages_.file()).parent_path();
    const std::filesystem::path path = folder / value.text;
    if (allowed_ == DataFiles::below_the_scene && !lies_below(folder, path))
      return refuse(value.at, fmt::format("file {} lies outside of the scene's folder; put it there or below, or, if "
                                          "you trust the scene, allow it with --allow-files",
                                          value.describe()));
    try {
      const std::size_t before = messages_.all().size();
      const Columns data = read_csv(path.string(), column[0], column[1], messages_);
      if (messages_.all().size() > before) return false;
      if (data.x.size() < 2)
        return refuse(value.at, fmt::format("file {} has {} row{} of numbers; must be two or more", value.describe(),
                                            data.x.size(), data.x.size() == 1 ? "" : "s"));
      for (std::size_t i = 1; i < data.x.size(); ++i)
        if (const std::string wrong = not_ascending(data.x[i], data.x[i - 1], i > 1 ? data.x[i - 2] : -HUGE_VAL);
            !wrong.empty()) {
          messages_.add_in(path.string(), {data.line[i], 1}, wrong);
          return false;
        }
      for (std::size_t i = 0; i < data.x.size(); ++i)
        if (!add_point(data.x[i], data.y[i], path.string(), {data.line[i], 1}, x, y)) return false;
    } catch (const SceneError& error) {
      return refuse(value.at, fmt::format("file {}: {}", value.describe(), error.messages.front().text));
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
    const auto in_user_unit = [&](double x) { return with_unit(x / x_factor_, x_unit_); };
    if (curve.over == "angle") {
      const double turns = 4 * M_PI / curve.period;
      if (std::abs(turns - std::round(turns)) > 1e-9)
        return refuse(at, fmt::format("period = {:g} deg; must divide two turns (720 deg) without remainder",
                                      curve.period * 180 / M_PI));
    }
    for (const auto* x : {&curve.x, &curve.x_back})
      if (!x->empty() && x->back() - x->front() > curve.period * (1 + 1e-9))
        return refuse(at, fmt::format("period = {}; must be at least the span of the points, {}",
                                      in_user_unit(curve.period), in_user_unit(x->back() - x->front())));
    const bool closing_point = std::abs(curve.x.back() - curve.x.front() - curve.period) <= 1e-9 * curve.period;
    if (closing_point && std::abs(curve.y.back() - curve.y.front()) >
                             1e-9 * std::max(std::abs(curve.y.back()), std::abs(curve.y.front())))
      return refuse(at, fmt::format("the last point lies one period after the first, but {} is not {}; make them "
                                    "equal, drop the last point, or let it jump back: a second point at this place",
                                    with_unit(curve.y.back() / y_factor_, y_unit_),
                                    with_unit(curve.y.front() / y_factor_, y_unit_)));
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
  std::vector<std::string> meant_;  // known keys that unknown ones were taken for
  std::string x_unit_, y_unit_;
  double x_factor_ = 1, y_factor_ = 1;
};

}  // namespace

std::string unit_over(const std::string& over) {
  if (over == "time") return "s";
  if (over == "angle" || over == "swing" || over == "twist") return "rad";
  if (over == "speed ratio") return "1";
  if (over == "speed") return "rad/s";
  return "m";  // travel
}

bool read_curve(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, CurveData& curve) {
  return CurveReader(table, key, what, messages, allowed).read(curve);
}

}  // namespace kurbel
