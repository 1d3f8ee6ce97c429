// section_reader.cpp — checks types, units and domains of a table's values.
#include "engine/section_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "engine/csv.h"
#include "engine/units.h"

namespace kurbel {

std::string Domain::describe(const std::string& unit) const {
  const bool bounded_low = std::isfinite(low), bounded_high = std::isfinite(high);
  if (bounded_low && bounded_high)
    return fmt::format("{} {} … {} {}", low_open ? "within (open)" : "within", low, with_unit(high, unit),
                       high_open ? "(excluded)" : "");
  if (bounded_low) return fmt::format("{} {}", low_open ? ">" : "≥", with_unit(low, low == 0 ? "" : unit));
  if (bounded_high) return fmt::format("{} {}", high_open ? "<" : "≤", with_unit(high, unit));
  return "finite";
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

bool is_number(const DocumentValue& v) { return v.type == Type::integer || v.type == Type::number; }

// Unit of the first column of a curve, by what it is given over.
std::string unit_over(const std::string& over) {
  if (over == "time") return "s";
  if (over == "angle") return "rad";
  if (over == "speed") return "rad/s";
  return "m";  // travel
}

class CurveReader {
 public:
  CurveReader(const DocumentValue& table, const Key& key, std::string what, Messages& messages)
      : table_(table), key_(key), what_(std::move(what)), messages_(messages) {}

  bool read(CurveData& curve) {
    if (table_.type != Type::table)
      return refuse(table_.at, fmt::format("got {}; give a table such as {{ over = \"{}\", unit = [\"{}\", \"{}\"], "
                                           "points = [[0, 0], [1, 1]] }}",
                                           table_.describe(), key_.choices.front(), unit_over(key_.choices.front()), key_.unit));
    for (const DocumentEntry& e : table_.entries) {
      static const std::vector<std::string> known = {"over", "unit", "points", "file", "return_points", "return_file", "columns", "interpolation", "period"};
      if (std::find(known.begin(), known.end(), e.key) != known.end()) continue;
      const auto near = nearest(e.key, known);
      refuse(e.at, fmt::format("unknown key \"{}\"{}; allowed: {}", e.key, near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(known, "and")));
    }
    if (!read_over(curve) || !read_units() || !read_form(curve)) return false;
    if (!read_points("points", "file", true, curve.x, curve.y)) return false;
    if (!read_points("return_points", "return_file", false, curve.x_back, curve.y_back)) return false;
    return check_curve(curve);
  }

 private:
  bool refuse(Location at, const std::string& text) {
    messages_.add(at, fmt::format("{}: {}", what_, text));
    return false;
  }

  bool read_over(CurveData& curve) {
    const DocumentEntry* over = table_.find("over");
    curve.over = key_.choices.front();
    if (!over && key_.choices.size() == 1) return true;
    if (!over) return refuse(table_.at, fmt::format("\"over\" is missing; allowed: {}", listed(key_.choices)));
    curve.over = over->value.text;
    if (std::find(key_.choices.begin(), key_.choices.end(), curve.over) != key_.choices.end()) return true;
    return refuse(over->value.at, fmt::format("over = {}; allowed: {}", over->value.describe(), listed(key_.choices)));
  }

  bool read_units() {
    const DocumentEntry* units = table_.find("unit");
    const DocumentEntry* over = table_.find("over");
    const std::string x_unit = unit_over(over ? over->value.text : key_.choices.front());
    if (!units) return refuse(table_.at, fmt::format("\"unit\" is missing; say the units of both columns, e.g. unit = [\"{}\", \"{}\"]", x_unit, key_.unit));
    const DocumentValue& list = units->value;
    if (list.type != Type::list || list.items.size() != 2)
      return refuse(list.at, fmt::format("unit = {}; must be a list of two units, e.g. [\"{}\", \"{}\"]", list.describe(), x_unit, key_.unit));
    return read_unit(list.items[0], x_unit, x_factor_) && read_unit(list.items[1], key_.unit, y_factor_);
  }
  bool read_unit(const DocumentValue& value, const std::string& wanted, double& factor) {
    UnitError error;
    const auto unit = parse_unit(value.text, error);
    const auto target = parse_unit(wanted, error);
    if (value.type != Type::text || !unit) return refuse(value.at, fmt::format("unit {}: {}", value.describe(), error.text));
    if (unit->dimension != target->dimension)
      return refuse(value.at, fmt::format("unit \"{}\" has the wrong dimension; allowed: units of {}", value.text, wanted));
    factor = unit->factor;
    return true;
  }

  bool read_form(CurveData& curve) {
    if (const DocumentEntry* form = table_.find("interpolation")) {
      if (form->value.text != "linear" && form->value.text != "smooth")
        return refuse(form->value.at, fmt::format("interpolation = {}; allowed: \"linear\" or \"smooth\"", form->value.describe()));
      curve.form = form->value.text == "smooth" ? Curve::Form::smooth : Curve::Form::linear;
    }
    const DocumentEntry* period = table_.find("period");
    if (!period) return true;
    return read_quantity(period->value, unit_over(curve.over), positive, what_ + ": period", messages_, curve.period);
  }

  bool read_points(const char* inline_key, const char* file_key, bool required, std::vector<double>& x, std::vector<double>& y) {
    const DocumentEntry* points = table_.find(inline_key);
    const DocumentEntry* file = table_.find(file_key);
    if (points && file) return refuse(file->at, fmt::format("\"{}\" and \"{}\" both given; keep one", inline_key, file_key));
    if (points) return read_inline(points->value, x, y);
    if (file) return read_file(file->value, x, y);
    return required ? refuse(table_.at, "no data; give points = [[x, y], …] or file = \"data.csv\"") : true;
  }
  bool read_inline(const DocumentValue& list, std::vector<double>& x, std::vector<double>& y) {
    if (list.type != Type::list) return refuse(list.at, fmt::format("points = {}; must be a list of pairs [[x, y], …]", list.describe()));
    for (const DocumentValue& pair : list.items) {
      if (pair.type != Type::list || pair.items.size() != 2 || !is_number(pair.items[0]) || !is_number(pair.items[1]))
        return refuse(pair.at, fmt::format("{} is not a pair of numbers [x, y]; units stand in `unit`", pair.describe()));
      if (!std::isfinite(pair.items[0].number) || !std::isfinite(pair.items[1].number))
        return refuse(pair.at, "a point is not finite");
      x.push_back(pair.items[0].number * x_factor_);
      y.push_back(pair.items[1].number * y_factor_);
    }
    return true;
  }
  bool read_file(const DocumentValue& value, std::vector<double>& x, std::vector<double>& y) {
    if (value.type != Type::text) return refuse(value.at, fmt::format("file = {}; must be the path of a CSV file in quotes", value.describe()));
    int column[2] = {1, 2};
    if (const DocumentEntry* columns = table_.find("columns")) {
      const auto& items = columns->value.items;
      if (items.size() != 2 || items[0].integer < 1 || items[1].integer < 1 || items[0].integer > 1000 || items[1].integer > 1000)
        return refuse(columns->value.at, "columns must be two column numbers counted from 1, e.g. [1, 2]");
      column[0] = static_cast<int>(items[0].integer);
      column[1] = static_cast<int>(items[1].integer);
    }
    const std::filesystem::path path = std::filesystem::path(messages_.file()).parent_path() / value.text;
    try {
      const std::size_t before = messages_.all().size();
      const Columns data = read_csv(path.string(), column[0], column[1], messages_);
      if (messages_.all().size() > before) return false;
      for (const double v : data.x) x.push_back(v * x_factor_);
      for (const double v : data.y) y.push_back(v * y_factor_);
    } catch (const SceneError& error) {
      return refuse(value.at, fmt::format("file \"{}\": {}", value.text, error.messages.front().text));
    }
    return true;
  }

  // The points make a curve: two or more, ascending.
  bool check_curve(const CurveData& curve) {
    try {
      if (curve.over == "angle" && curve.period > 0) {
        const double turns = 4 * M_PI / curve.period;
        if (std::abs(turns - std::round(turns)) > 1e-9)
          return refuse(table_.at, fmt::format("period = {:g} deg; must divide two turns (720 deg) without remainder", curve.period * 180 / M_PI));
      }
      Curve(curve.x, curve.y, curve.form, curve.period);
      if (!curve.x_back.empty()) Curve(curve.x_back, curve.y_back, curve.form, curve.period);
      return true;
    } catch (const std::invalid_argument& error) {
      return refuse(table_.at, error.what());
    }
  }

  const DocumentValue& table_;
  const Key& key_;
  std::string what_;
  Messages& messages_;
  double x_factor_ = 1, y_factor_ = 1;
};

bool read_list(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages, Setting& setting) {
  if (value.type != Type::list) {
    messages.add(value.at, fmt::format("{} = {}; must be a list in brackets", what, value.describe()));
    return false;
  }
  for (const DocumentValue& item : value.items) {
    double number = 0;
    if (key.type == KeyType::integers) {
      if (item.type != Type::integer || !key.domain.contains(item.number)) {
        messages.add(item.at, fmt::format("{}: {}; must be whole numbers {}", what, item.describe(), key.domain.describe("")));
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

bool read_nested(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages, Setting& setting) {
  std::vector<const DocumentValue*> tables;
  if (value.type == Type::table) tables.push_back(&value);
  for (const DocumentValue& item : value.items) tables.push_back(&item);
  bool good = !tables.empty() || value.type == Type::list;
  for (const DocumentValue* table : tables) good = good && table->type == Type::table;
  if (!good) {
    messages.add(value.at, fmt::format("{} = {}; must be a table {{ … }} or a list of tables", what, value.describe()));
    return false;
  }
  for (const DocumentValue* table : tables) {
    const std::string name = tables.size() == 1 ? what : fmt::format("{} {}", what, setting.sections.size() + 1);
    const Kind* kind = key.nested->size() == 1 ? &key.nested->front() : read_kind(*table, *key.nested, name, table->at, messages);
    if (kind) setting.sections.push_back(read_section(*table, *kind, key.name, name, messages));
  }
  return true;
}

bool read_setting(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages, Setting& setting) {
  const auto refuse = [&](const std::string& allowed) {
    messages.add(value.at, fmt::format("{} = {}; must be {}", what, value.describe(), allowed));
    return false;
  };
  switch (key.type) {
    case KeyType::quantity: return read_quantity(value, key.unit, key.domain, what, messages, setting.number);
    case KeyType::integer:
      if (value.type != Type::integer || !key.domain.contains(value.number))
        return refuse(fmt::format("a whole number {}", key.domain.describe("")));
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
    case KeyType::curve: return CurveReader(value, key, what, messages).read(setting.curve);
    case KeyType::quantities:
    case KeyType::integers: return read_list(value, key, what, messages, setting);
    case KeyType::sections: return read_nested(value, key, what, messages, setting);
  }
  return false;
}

// A fallback is written as in a file; it is read by the same code.
Setting fallback_setting(const Key& key, Location at, Messages& messages) {
  const DocumentValue document = parse_toml("x = " + key.fallback, "fallback of " + key.name);
  Setting setting{.key = key.name, .at = at};
  read_setting(document.entries.front().value, key, key.name, messages, setting);
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
    if (!unit.empty())
      return refuse(value.at, fmt::format("{} has no unit; write it with one, e.g. {}", value.describe(), examples_of(unit)));
    result = value.number;
  } else if (value.type == Type::text) {
    UnitError error;
    const auto quantity = parse_quantity(value.text, error);
    const auto wanted = parse_unit(unit, error);
    if (!quantity)
      return refuse({value.at.line, value.at.column + 1 + static_cast<int>(error.column)},
                    fmt::format("\"{}\": {}; write e.g. {}", value.text, error.text, examples_of(unit)));
    if (quantity->dimension != wanted->dimension)
      return refuse(value.at, fmt::format("\"{}\" is no quantity in {}; write e.g. {}", value.text,
                                          unit.empty() ? "plain numbers" : pretty_unit(unit), examples_of(unit)));
    result = quantity->value;
  } else {
    return refuse(value.at, fmt::format("{}; must be a quantity, e.g. {}", value.describe(), examples_of(unit)));
  }
  if (!domain.contains(result)) return refuse(value.at, fmt::format("{}; must be {}", value.type == Type::text ? value.text : fmt::format("{}", value.number), domain.describe(unit)));
  return true;
}

const Kind* read_kind(const DocumentValue& table, const std::vector<Kind>& kinds, const std::string& what, Location at,
                      Messages& messages) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  const DocumentEntry* entry = table.find("kind");
  if (!entry) {
    messages.add(at, fmt::format("{} has no \"kind\"; allowed: {}", what, listed(names)));
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
                     Messages& messages, const std::vector<std::string>& passed_over) {
  Section section{.name = name, .kind = &kind, .at = table.at};
  const std::size_t errors_before = messages.all().size();
  std::vector<std::string> known;
  for (const Key& key : kind.keys) known.push_back(key.name);
  for (const DocumentEntry& entry : table.entries) {
    if (entry.key == "kind" || std::find(passed_over.begin(), passed_over.end(), entry.key) != passed_over.end()) continue;
    const auto key = std::find_if(kind.keys.begin(), kind.keys.end(), [&](const Key& k) { return k.name == entry.key; });
    if (key == kind.keys.end()) {
      const auto near = nearest(entry.key, known);
      messages.add(entry.at, fmt::format("{}: unknown key \"{}\"{}; allowed: {}", what, entry.key,
                                         near ? fmt::format(" — did you mean \"{}\"?", *near) : "", listed(known, "and")));
      continue;
    }
    Setting setting{.key = key->name, .at = entry.value.at, .given = true};
    if (read_setting(entry.value, *key, what + ": " + key->name, messages, setting)) {
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
    } else if (key.required) {
      messages.add(section.at, fmt::format("{}: \"{}\" is missing ({}); write e.g. {} = {}", what, key.name, key.doc,
                                           key.name, key.type == KeyType::quantity ? examples_of(key.unit) : "…"));
    }
  }
  section.sound = messages.all().size() == errors_before;
  return section;
}

}  // namespace kurbel
