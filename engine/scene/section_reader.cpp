// section_reader.cpp — checks types, units and domains of a table's values.
#include "engine/scene/section_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "engine/scene/csv.h"
#include "engine/scene/units.h"

namespace kurbel {

std::string Domain::describe(const std::string& unit) const {
  const bool bounded_low = std::isfinite(low), bounded_high = std::isfinite(high);
  if (bounded_low && bounded_high)
    return low_open || high_open ? fmt::format("{} {} and {} {}", low_open ? ">" : "≥", low, high_open ? "<" : "≤",
                                               with_unit(high, unit, 9))
                                 : fmt::format("{} … {}", low, with_unit(high, unit, 9));
  if (bounded_low) return fmt::format("{} {}", low_open ? ">" : "≥", with_unit(low, low == 0 ? "" : unit));
  if (bounded_high) return fmt::format("{} {}", high_open ? "<" : "≤", with_unit(high, unit));
  return "finite";
}

std::string shortened_list(std::vector<std::string> names, std::string_view conjunction) {
  constexpr std::size_t most = 30;
  if (names.size() <= most) return listed(names, conjunction);
  const std::size_t more = names.size() - most;
  names.resize(most);
  return fmt::format("{} … and {} more", listed(names, ","), more);
}

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const auto near = nearest(word, names);
  return near ? fmt::format(" — did you mean \"{}\"?", *near) : "";
}

std::string listed(const std::vector<std::string>& names, std::string_view conjunction) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", conjunction) : ", ";
    text += fmt::format("\"{}\"", names[i]);
  }
  return text;
}

const Setting* Section::find(std::string_view key) const {
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return s.key == key; });
  return found == settings.end() ? nullptr : &*found;
}

const Setting& Section::operator[](std::string_view key) const {
  if (const Setting* setting = find(key)) return *setting;
  throw std::logic_error(fmt::format("section \"{}\" has no value for \"{}\"", name, key));
}

namespace {

using Type = DocumentValue::Type;

// A number and its unit for people: "-3 kN*m/rad" → "-3 kN·m/rad".
std::string pretty_quantity(const DocumentValue& value) {
  if (value.type != Type::text) return value.describe();
  const std::size_t unit = std::min(value.text.find(' '), value.text.size());
  return value.text.substr(0, unit) + pretty_unit(value.text.substr(unit));
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// What may stand in place of a value that was refused: "4 kN*m/rad", 0.05.
std::string write_instead(const std::string& unit) { return "write e.g. " + examples_of(unit); }

bool is_number(const DocumentValue& v) { return v.type == Type::integer || v.type == Type::number; }
bool is_whole(const DocumentValue& v) { return is_number(v) && v.number == std::floor(v.number); }  // 1e3 is

// Sizes in SI units that can be computed with: products and quotients of ten such values are numbers still (1e±300).
constexpr double least_size = 1e-30, greatest_size = 1e30;
// An angle's last digit is 1e-7 rad here.
constexpr double greatest_angle = 1e9;
constexpr std::size_t most_points = 1'000'000, most_items = 100'000;

// Unit of the first column of a curve, by what it is given over.
std::string unit_over(const std::string& over) {
  if (over == "time") return "s";
  if (over == "angle" || over == "swing" || over == "twist") return "rad";
  if (over == "speed ratio") return "1";
  if (over == "speed") return "rad/s";
  return "m";  // travel
}

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
          "over", "unit", "points", "file", "return_points", "return_file", "columns", "interpolation", "period"};
      if (std::find(known.begin(), known.end(), e.key) != known.end()) continue;
      const auto near = nearest(e.key, known);
      if (near) meant_.push_back(*near);
      refuse(e.at, fmt::format("unknown key {}{}; allowed: {}", in_quotes(e.key),
                               near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(known, "and")));
    }
    const std::size_t before = messages_.all().size();
    if (!read_over(curve)) return false;
    // Each says itself what is wrong with it; a mistyped key was named above, and what it should hold is missing.
    const bool units = read_units(curve.over), form = read_form(curve),
               points = read_points("points", "file", true, curve.x, curve.y),
               back = read_points("return_points", "return_file", false, curve.x_back, curve.y_back);
    return units && form && points && back && messages_.all().size() == before && check_period(curve);
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
    const auto unit = parse_unit(value.text, error);
    if (!unit)
      return refuse(
          {value.at.line, value.at.column + 1 + static_cast<int>(characters(value.text.substr(0, error.column)))},
          fmt::format("unit = {}: {}", value.describe(), error.text));
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
    return required ? refuse(table_.at, "no data; give points = [[x, y], …] or file = \"data.csv\"") : true;
  }
  bool read_inline(const DocumentValue& list, const char* name, std::vector<double>& x, std::vector<double>& y) {
    if (list.type != Type::list)
      return refuse(list.at, fmt::format("{} = {}; must be a list of pairs [[x, y], …]", name, list.describe()));
    if (list.items.size() < 2)
      return refuse(list.at, fmt::format("{} has {} point{}; must be two or more", name, list.items.size(),
                                         list.items.size() == 1 ? "" : "s"));
    double last = -HUGE_VAL;
    int number = 0;
    for (const DocumentValue& pair : list.items) {
      ++number;
      if (pair.type != Type::list || pair.items.size() != 2 || !is_number(pair.items[0]) || !is_number(pair.items[1]))
        return refuse(pair.at, fmt::format("{}[{}] is no pair of plain numbers [x, y]; their units stand in `unit`",
                                           name, number));
      if (!std::isfinite(pair.items[0].number) || !std::isfinite(pair.items[1].number))
        return refuse(pair.at,
                      fmt::format("the point [{}, {}] is not finite", pair.items[0].number, pair.items[1].number));
      if (!(pair.items[0].number > last)) return refuse(pair.items[0].at, not_ascending(pair.items[0].number, last));
      last = pair.items[0].number;
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
    else if (!all_x.empty() && !(x_si - all_x.back() > least_size))
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
  static std::string not_ascending(double x, double last) {
    return x == last ? fmt::format("x = {} stands twice; must ascend (write a jump as two points close together)", x)
                     : fmt::format("x = {} follows {}; the first column must ascend", x, last);
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
        if (!(data.x[i] > data.x[i - 1])) {
          messages_.add_in(path.string(), {data.line[i], 1}, not_ascending(data.x[i], data.x[i - 1]));
          return false;
        }
      for (std::size_t i = 0; i < data.x.size(); ++i)
        if (!add_point(data.x[i], data.y[i], path.string(), {data.line[i], 1}, x, y)) return false;
    } catch (const SceneError& error) {
      return refuse(value.at, fmt::format("file {}: {}", value.describe(), error.messages.front().text));
    }
    return true;
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
                                    "equal, or drop the last point",
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

// How a missing value would be written.
std::string example_of(const Key& key) {
  const std::string examples = examples_of(key.unit);
  switch (key.type) {
    case KeyType::quantity:
      return examples.substr(0, examples.find(", "));
    case KeyType::integers:
      return "[19, 95]";
    case KeyType::curve:
      return fmt::format("{{ over = \"{}\", unit = [\"{}\", \"{}\"], points = [[0, 0], [1, 1]] }}", key.choices.front(),
                         unit_over(key.choices.front()), key.unit);
    case KeyType::sections: {
      std::string text = key.nested->size() == 1 ? "" : fmt::format("kind = \"{}\"", key.nested->front().name);
      for (const Key& nested : key.nested->front().keys)
        if (nested.required)
          text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", nested.name, example_of(nested));
      return fmt::format("[{{ {} }}]", text);
    }
    default:
      return "…";
  }
}

bool read_list(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
               Setting& setting) {
  if (value.type != Type::list) {
    messages.add(value.at, fmt::format("{} = {}; must be a list in brackets{}", what, value.describe(),
                                       key.type == KeyType::integers ? ", e.g. [19, 95]" : ""));
    return false;
  }
  if (value.items.size() > most_items) {
    messages.add(value.at, fmt::format("{} has {} values; must be at most {}", what, value.items.size(), most_items));
    return false;
  }
  for (const DocumentValue& item : value.items) {
    double number = 0;
    if (key.type == KeyType::integers) {
      if (!is_whole(item) || !key.domain.contains(item.number)) {
        messages.add(item.at, fmt::format("{} = {}; must be a whole number, {}", what, item.describe(),
                                          key.domain.describe("")));
        return false;
      }
      number = item.number;
    } else if (!read_quantity(item, key.unit, key.domain, what, messages, number)) {
      return false;
    }
    setting.numbers.push_back(number);
  }
  return true;
}

bool read_nested(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
                 DataFiles allowed, Setting& setting) {
  std::vector<const DocumentValue*> tables;
  if (value.type == Type::table) tables.push_back(&value);
  for (const DocumentValue& item : value.items) tables.push_back(&item);
  bool good = !tables.empty() || value.type == Type::list;
  for (const DocumentValue* table : tables) good = good && table->type == Type::table;
  if (!good) {
    messages.add(value.at, fmt::format("{} = {}; must be a table or a list of tables, e.g. {}", what, value.describe(),
                                       example_of(key)));
    return false;
  }
  bool kinds_known = true;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const DocumentValue& table = *tables[i];
    const std::string name = value.type == Type::table ? what : fmt::format("{}[{}]", what, i + 1);
    const bool one_kind = key.nested->size() == 1;
    const Kind* kind = one_kind ? &key.nested->front() : read_kind(table, *key.nested, name, table.at, messages);
    if (kind) {
      setting.sections.push_back(read_section(table, *kind, key.name, name, messages,
                                              one_kind ? std::vector<std::string>{} : std::vector<std::string>{"kind"},
                                              allowed));
    } else {
      kinds_known = false;
    }
  }
  return kinds_known;
}

bool read_setting(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
                  DataFiles allowed, Setting& setting) {
  const auto refuse = [&](const std::string& allowed) {
    messages.add(value.at, fmt::format("{} = {}; must be {}", what, value.describe(), allowed));
    return false;
  };
  switch (key.type) {
    case KeyType::quantity:
      return read_quantity(value, key.unit, key.domain, what, messages, setting.number);
    case KeyType::integer:
      if (!is_whole(value) || !key.domain.contains(value.number))
        return refuse(fmt::format("a whole number, {}", key.domain.describe("")));
      setting.number = value.number;
      return true;
    case KeyType::flag:
      if (value.type != Type::flag) return refuse("true or false");
      setting.flag = value.flag;
      return true;
    case KeyType::text:
      if (value.type != Type::text) return refuse(key.choices.empty() ? "a text in quotes" : listed(key.choices));
      setting.text = value.text;
      if (key.choices.empty() || std::find(key.choices.begin(), key.choices.end(), value.text) != key.choices.end())
        return true;
      {
        const auto near = nearest(value.text, key.choices);
        return refuse(listed(key.choices) + (near ? fmt::format(" — did you mean \"{}\"?", *near) : ""));
      }
    case KeyType::curve:
      return CurveReader(value, key, what, messages, allowed).read(setting.curve);
    case KeyType::quantities:
    case KeyType::integers:
      return read_list(value, key, what, messages, setting);
    case KeyType::sections:
      return read_nested(value, key, what, messages, allowed, setting);
  }
  return false;
}

// "4 kN*m" for a stiffness: says what it is, what it must be, and where only the angle is missing or too many.
std::string wrong_dimension(const DocumentValue& value, const Quantity& got, const Unit& wanted,
                            const std::string& unit) {
  if (got.dimension == Dimension{}) return fmt::format("{} has no unit; {}", value.describe(), write_instead(unit));
  Dimension without_angle = got.dimension, wanted_without = wanted.dimension;
  without_angle.exponent[3] = wanted_without.exponent[3] = 0;
  return fmt::format(
      "{} is {}; must be {}, e.g. {}{}", value.describe(), name_of(got.dimension), name_of(wanted.dimension),
      examples_of(unit),
      without_angle == wanted_without && !unit.empty() ? " (the angle counts as a dimension: rad, deg, rev)" : "");
}

// A fallback is written as in a file; it is read by the same code.
Setting fallback_setting(const Key& key, Location at, Messages& messages) {
  const DocumentValue document = parse_toml("x = " + key.fallback, "fallback of " + key.name);
  Setting setting;
  setting.key = key.name;
  setting.at = at;
  read_setting(document.entries.front().value, key, key.name, messages, DataFiles::below_the_scene, setting);
  return setting;
}

}  // namespace

bool read_quantity(const DocumentValue& value, const std::string& unit, const Domain& domain, const std::string& what,
                   Messages& messages, double& result) {
  const auto refuse = [&](Location at, const std::string& text) {
    messages.add(at, fmt::format("{} = {}", what, text));
    return false;
  };
  if (is_number(value)) {
    if (!std::isfinite(value.number)) return refuse(value.at, fmt::format("{}; must be finite", value.describe()));
    if (!unit.empty())
      return refuse(value.at,
                    fmt::format("{} has no unit; write it with one, e.g. {}", value.describe(), examples_of(unit)));
    result = value.number;
  } else if (value.type == Type::text) {
    UnitError error;
    const auto wanted = parse_unit(unit, error);
    const auto quantity = parse_quantity(value.text, error);
    if (!quantity) {
      const bool suggests = error.text.ends_with('?');
      return refuse(
          {value.at.line, value.at.column + 1 + static_cast<int>(characters(value.text.substr(0, error.column)))},
          fmt::format("{}: {}{}", value.describe(), error.text, suggests ? "" : "; " + write_instead(unit)));
    }
    if (quantity->dimension != wanted->dimension)
      return refuse(value.at, wrong_dimension(value, *quantity, *wanted, unit));
    result = quantity->value;
  } else {
    return refuse(value.at,
                  fmt::format("{}; must be {}, e.g. {}", value.describe(),
                              unit.empty() ? "a number" : "a number with its unit in quotes", examples_of(unit)));
  }
  if (!domain.contains(result))
    return refuse(value.at, fmt::format("{}; must be {}", pretty_quantity(value), domain.describe(unit)));
  UnitError none;
  if (const std::string allowed = size_allowed(result, parse_unit(unit, none)->dimension, domain); !allowed.empty())
    return refuse(value.at,
                  fmt::format("{}; must be {}; check its unit and power of ten", pretty_quantity(value), allowed));
  return true;
}

std::string size_allowed(double value, const Dimension& dimension, const Domain& domain) {
  const double size = std::abs(value);
  const bool angle = dimension == Dimension{{0, 0, 0, 1, 0}};
  if (angle && size > greatest_angle) return fmt::format("within ± {:g} rad", greatest_angle);
  if (size > greatest_size) return fmt::format("within ± {:g} in SI units", greatest_size);
  const bool is_place = angle && domain.contains(0);  // on a turn, which nothing is divided by
  if (size > 0 && size < least_size && !is_place)
    return domain.contains(0) ? fmt::format("0 or of a size of {:g} or more in SI units", least_size)
                              : fmt::format("of a size of {:g} or more in SI units", least_size);
  return {};
}

const Kind* read_kind(const DocumentValue& table, const std::vector<Kind>& kinds, const std::string& what, Location at,
                      Messages& messages) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  const DocumentEntry* entry = table.find("kind");
  if (!entry) {
    messages.add(at, fmt::format("{}: \"kind\" is missing; allowed: {}", what, listed(names)));
    return nullptr;
  }
  for (const Kind& kind : kinds)
    if (entry->value.type == Type::text && kind.name == entry->value.text) return &kind;
  const auto near = nearest(entry->value.text, names);
  messages.add(entry->value.at, fmt::format("{}: kind = {}{}; allowed: {}", what, entry->value.describe(),
                                            near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(names)));
  return nullptr;
}

Section read_section(const DocumentValue& table, const Kind& kind, const std::string& name, const std::string& what,
                     Messages& messages, const std::vector<std::string>& passed_over, DataFiles allowed) {
  Section section{.name = name, .kind = &kind, .at = table.at};
  const std::size_t errors_before = messages.all().size();
  std::vector<std::string> known, meant;  // meant: by a key mistyped
  for (const Key& key : kind.keys) known.push_back(key.name);
  known.insert(known.end(), passed_over.begin(), passed_over.end());
  for (const DocumentEntry& entry : table.entries) {
    if (std::find(passed_over.begin(), passed_over.end(), entry.key) != passed_over.end()) continue;
    const auto key =
        std::find_if(kind.keys.begin(), kind.keys.end(), [&](const Key& k) { return k.name == entry.key; });
    if (key == kind.keys.end()) {
      const auto near = nearest(entry.key, known);
      if (near) meant.push_back(*near);
      messages.add(entry.at,
                   fmt::format("{}: unknown key {}{}; allowed: {}", what, in_quotes(entry.key),
                               near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(known, "and")));
      continue;
    }
    Setting setting;
    setting.key = key->name;
    setting.at = entry.value.at;
    setting.given = true;
    if (read_setting(entry.value, *key, what + ": " + key->name, messages, allowed, setting)) {
      section.settings.push_back(std::move(setting));
    } else {
      // Something was said about this value already: put the least harmful one in its place.
      setting.number = std::isfinite(key->domain.low) ? key->domain.low + 1 : 0;
      setting.text = key->choices.empty() ? "" : key->choices.front();
      section.settings.push_back(std::move(setting));
    }
  }
  for (const Key& key : kind.keys) {
    if (section.has(key.name)) continue;
    if (!key.fallback.empty()) {
      section.settings.push_back(fallback_setting(key, section.at, messages));
    } else if (key.required && std::find(meant.begin(), meant.end(), key.name) == meant.end()) {
      messages.add(section.at, fmt::format("{}: \"{}\" is missing ({}); write e.g. {} = {}", what, key.name, key.doc,
                                           key.name, example_of(key)));
    }
  }
  section.sound = messages.all().size() == errors_before;
  return section;
}

}  // namespace kurbel
