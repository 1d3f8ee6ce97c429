// key_values.cpp — quantities by unit and domain, curves, lists, nested tables.
#include "tests/fuzz/key_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel::fuzz {
namespace {

using Type = DocumentValue::Type;

const std::vector<std::string>& units() {
  static const std::vector<std::string> list = {
      "",     "m",       "mm",    "kg",  "t",   "s",   "ms",    "h",           "N",       "kN",        "N*m",
      "kN*m", "rpm",     "rad/s", "rad", "deg", "rev", "Hz",    "1/s",         "N*m/rad", "N*m*s/rad", "kg*m2",
      "W",    "kW",      "Pa",    "bar", "GPa", "m/s", "m/s2",  "N/m",         "N*s/m",   "A",         "V",
      "Ohm",  "H",       "m3",    "l",   "%",   "1",   "kg/m3", "N*m*s2/rad2", "m3/rad",  "m3/s",      "kg*m2^9",
      "m^-9", "furlong", "m/",    "m*",  "²"};
  return list;
}

// Plausible sizes by the SI unit, so that made-up machines run more often than they are refused.
double usual_size(const std::string& unit) {
  if (unit == "N*m/rad") return 1e4;
  if (unit == "N/m") return 1e8;
  if (unit == "N*m") return 100;
  if (unit == "N") return 1000;
  if (unit == "W") return 1e4;
  if (unit == "Pa") return 1e6;
  if (unit == "rad/s") return 100;
  if (unit == "m") return 0.1;
  if (unit == "m3" || unit == "m3/rad" || unit == "m3/s") return 1e-4;
  return 1;
}

double usual_number(const Key& key, Random& random) {
  const Domain& d = key.domain;
  if (std::isfinite(d.low) && std::isfinite(d.high)) return d.low + (d.high - d.low) * random.uniform();
  const double x = usual_size(key.unit) * random.factor(30);
  if (std::isfinite(d.low)) return d.low + x;
  if (std::isfinite(d.high)) return d.high - x;
  return random.chance(0.2) ? -x : x;
}

DocumentValue quantity(const Key& key, Random& random, double wild) {
  const double x = random.chance(wild) ? extreme_number(key.domain, random) : usual_number(key, random);
  const std::string unit = random.chance(0.2 * wild) ? random.one_of(units()) : key.unit;
  if (unit.empty()) return number_value(x);
  return text_value(fmt::format("{:.6g} {}", x, unit));
}

DocumentValue whole_number(const Key& key, Random& random, double wild) {
  const Domain& d = key.domain;
  if (random.chance(wild)) {
    static const std::vector<std::int64_t> list = {0,       1,         -1,        2,          3,         1000,
                                                   1000000, INT64_MAX, INT64_MIN, 2147483647, 2147483648};
    return random.chance(0.2) ? number_value(extreme_number(d, random)) : integer_value(random.one_of(list));
  }
  const double low = std::isfinite(d.low) ? d.low : 0,
               high = std::isfinite(d.high) ? std::min(d.high, low + 200) : low + 100;
  return integer_value(static_cast<std::int64_t>(low + (high - low) * random.uniform()));
}

std::string unit_of_first_column(const std::string& over) {
  if (over == "time") return "s";
  if (over == "angle" || over == "swing" || over == "twist") return "rad";
  if (over == "speed ratio") return "1";
  if (over == "speed") return "rad/s";
  return "m";
}

const std::vector<std::string>& data_files() {
  static const std::vector<std::string> list = {"data/absent.csv", "data", "", "..", "not_ascending.csv", "x\ty.csv"};
  return list;
}

DocumentValue pair_of(double x, double y) { return list_value({number_value(x), number_value(y)}); }

DocumentValue points(const std::string& unit, const Domain& domain, Random& random, double wild) {
  std::vector<DocumentValue> list;
  double x = random.chance(0.3) ? 0 : -random.uniform();
  const std::size_t n = 2 + random.index(5);
  for (std::size_t i = 0; i < n; ++i, x += random.factor(3)) {
    const double y = random.chance(wild) ? extreme_number(domain, random) : usual_size(unit) * random.uniform();
    list.push_back(pair_of(random.chance(0.1 * wild) ? extreme_number(domain, random) : x, y));
  }
  if (random.chance(0.2 * wild)) list.resize(random.index(2));
  if (random.chance(0.2 * wild)) list.push_back(any_value(random));
  return list_value(std::move(list));
}

// A law by formula: pieces that fit together more often than not.
DocumentValue formula_table(const Key& key, const std::string& over, const std::string& first, Random& random,
                            double wild) {
  static const std::vector<std::string> parts = {
      "x",   "time", "angle", "speed", "sin(", "abs(",  "max(0, ", "if(x < ", ")",        ", ",
      " + ", " - ",  "*",     "/",     "^",    "^1.3",  "sqrt(",   "log(",    "-",        "(",
      "2",   "0.5",  "pi",    "c0",    "1 mm", "[N*m]", "1/0",     "1e300",   "tan(phi)", "exp(-t/1 s)"};
  DocumentValue table = table_value();
  put(table, "over", text_value(over));
  std::string text = fmt::format("{} [{}]*(1 + 0.5*sin({}/1 [{}]))", usual_size(key.unit) * random.uniform(),
                                 key.unit.empty() ? "1" : key.unit, over == "speed ratio" ? "nu" : over, first);
  if (random.chance(wild))
    for (std::size_t n = random.index(6); n > 0; --n) text.insert(random.index(text.size() + 1), random.one_of(parts));
  put(table, "formula", text_value(text));
  if (over != "angle" || random.chance(0.1 * wild))
    put(table, "range",
        list_value({text_value(fmt::format("{} {}", random.uniform(), first)),
                    text_value(fmt::format("{} {}", 1 + random.uniform() * random.factor(10), first))}));
  if (random.chance(0.3)) put(table, "with", table_value());
  return table;
}

DocumentValue curve(const Key& key, Random& random, double wild) {
  DocumentValue table = table_value();
  const std::string over = random.chance(0.1 * wild) ? "nothing" : random.one_of(key.choices);
  const std::string first = unit_of_first_column(over);
  if (random.chance(0.2)) return formula_table(key, over, first, random, wild);
  put(table, "over", text_value(over));
  put(table, "unit",
      list_value({text_value(random.chance(0.1 * wild) ? random.one_of(units()) : first),
                  text_value(random.chance(0.1 * wild) ? random.one_of(units()) : key.unit)}));
  if (random.chance(0.1 * wild))
    put(table, "file", text_value(random.one_of(data_files())));
  else
    put(table, random.chance(0.1 * wild) ? "pionts" : "points", points(key.unit, key.domain, random, 0.3 * wild));
  if (random.chance(0.2)) put(table, "return_points", points(key.unit, key.domain, random, 0.3 * wild));
  if (random.chance(0.3)) put(table, "interpolation", text_value(random.chance(0.5) ? "smooth" : "linear"));
  if (random.chance(0.3)) {
    const double period = random.chance(wild) ? extreme_number(positive, random) : 20 * random.uniform();
    put(table, "period",
        over == "angle" ? text_value(random.chance(0.5) ? "1 rev" : "720 deg")
                        : text_value(fmt::format("{} {}", period, first)));
  }
  return table;
}

}  // namespace

DocumentValue text_value(const std::string& text) {
  DocumentValue value;
  value.type = Type::text;
  value.text = text;
  return value;
}
DocumentValue number_value(double x) {
  DocumentValue value;
  value.type = Type::number;
  value.number = x;
  return value;
}
DocumentValue integer_value(std::int64_t x) {
  DocumentValue value;
  value.type = Type::integer;
  value.integer = x;
  value.number = static_cast<double>(x);
  return value;
}
DocumentValue flag_value(bool on) {
  DocumentValue value;
  value.type = Type::flag;
  value.flag = on;
  return value;
}
DocumentValue list_value(std::vector<DocumentValue> items) {
  DocumentValue value;
  value.type = Type::list;
  value.items = std::move(items);
  return value;
}
DocumentValue table_value(std::vector<DocumentEntry> entries) {
  DocumentValue value;
  value.type = Type::table;
  value.entries = std::move(entries);
  return value;
}

DocumentEntry* find(DocumentValue& table, const std::string& key) {
  for (DocumentEntry& entry : table.entries)
    if (entry.key == key) return &entry;
  return nullptr;
}
void put(DocumentValue& table, const std::string& key, DocumentValue value) {
  if (DocumentEntry* entry = find(table, key))
    entry->value = std::move(value);
  else
    table.entries.push_back({key, {}, std::move(value)});
}

double extreme_number(const Domain& domain, Random& random) {
  static const std::vector<double> list = {0,        -0.0,   1,     -1,     1e-12,
                                           1e-9,     1e-6,   1e6,   1e9,    1e12,
                                           1e19,     1e30,   1e-30, 1e50,   1e-50,
                                           1e100,    1e-100, 1e154, 1e155,  1e-160,
                                           5e-324,   1e-308, 1e308, -1e308, 1.7976931348623157e308,
                                           HUGE_VAL, NAN};
  if (std::isfinite(domain.low) && random.chance(0.2)) return domain.low;
  if (std::isfinite(domain.high) && random.chance(0.2)) return domain.high;
  if (random.chance(0.4)) return std::pow(10.0, -20 + 40 * random.uniform());
  const double x = random.one_of(list);
  return random.chance(0.2) ? -x : x;
}

DocumentValue any_value(Random& random) {
  switch (random.index(9)) {
    case 0:
      return flag_value(random.chance(0.5));
    case 1:
      return integer_value(static_cast<std::int64_t>(random.index(100)));
    case 2:
      return number_value(extreme_number(any_number, random));
    case 3:
      return text_value(fmt::format("{} {}", extreme_number(any_number, random), random.one_of(units())));
    case 4:
      return text_value(random.chance(0.5) ? "" : "\x1b[2J\u00e4\u2603");
    case 5:
      return list_value({});
    case 6:
      return list_value({integer_value(1), text_value("x")});
    case 7:
      return table_value({{"a", {}, integer_value(1)}});
    default: {
      DocumentValue date;
      date.type = Type::other;
      return date;
    }
  }
}

DocumentValue value_for(const Key& key, Random& random, double wild) {
  if (random.chance(0.05 * wild)) return any_value(random);
  switch (key.type) {
    case KeyType::quantity:
      return quantity(key, random, wild);
    case KeyType::integer:
      return whole_number(key, random, wild);
    case KeyType::flag:
      return flag_value(random.chance(0.5));
    case KeyType::text:
      return text_value(key.choices.empty() || random.chance(0.1 * wild) ? "grey" : random.one_of(key.choices));
    case KeyType::curve:
      return curve(key, random, wild);
    case KeyType::quantities:
    case KeyType::integers: {
      std::vector<DocumentValue> items;
      const std::size_t n = random.chance(0.1 * wild) ? random.index(40) : 1 + random.index(4);
      for (std::size_t i = 0; i < n; ++i)
        items.push_back(key.type == KeyType::integers ? whole_number(key, random, wild) : quantity(key, random, wild));
      return list_value(std::move(items));
    }
    case KeyType::sections: {
      std::vector<DocumentValue> items;
      const std::size_t n = random.chance(0.1 * wild) ? random.index(6) : 1 + random.index(2);
      for (std::size_t i = 0; i < n; ++i)
        items.push_back(table_for(random.one_of(*key.nested), random, wild, key.nested->size() > 1));
      if (items.size() == 1 && random.chance(0.7)) return items.front();
      return list_value(std::move(items));
    }
    case KeyType::named: {
      DocumentValue table = table_value();
      for (const char* name : {"A", "B", "C", "D"}) {
        const Kind& kind = key.nested->front();
        if (random.chance(0.3)) continue;
        put(table, name,
            random.chance(0.5) ? table_for(kind, random, wild, false) : value_for(kind.keys.front(), random, wild));
      }
      return table;
    }
  }
  return {};
}

DocumentValue table_for(const Kind& kind, Random& random, double wild, bool with_kind) {
  DocumentValue table = table_value();
  if (with_kind) put(table, "kind", text_value(kind.name));
  for (const Key& key : kind.keys)
    if (random.chance(key.required ? 1 - 0.05 * wild : 0.15)) put(table, key.name, value_for(key, random, wild));
  return table;
}

}  // namespace kurbel::fuzz
