// tolerances.cpp — tables that give a value with a tolerance.
#include "engine/reading/tolerances.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <optional>

#include "engine/scene/keys.h"
#include "engine/scene/units.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

const std::vector<std::string>& keys_of_tolerance() {
  static const std::vector<std::string> keys = {"value", "tolerance", "from", "to", "distribution", "k"};
  return keys;
}

// A quantity of a table in the unit of its value, or a percentage of it.
class ToleranceReader {
 public:
  ToleranceReader(const DocumentValue& table, const std::string& path, Messages& messages)
      : table_(table), path_(path), messages_(messages) {}

  Tolerance read() {
    Tolerance t{.path = path_, .unit = {}, .at = table_.at};
    for (const DocumentEntry& entry : table_.entries)
      if (std::find(keys_of_tolerance().begin(), keys_of_tolerance().end(), entry.key) == keys_of_tolerance().end())
        refuse(entry.at,
               fmt::format("unknown key {}{}; allowed: {}; the value itself is \"value\"", in_quotes(entry.key),
                           suggestion(entry.key, keys_of_tolerance()), listed(keys_of_tolerance())));
    read_value(t);
    read_distribution(t);
    read_ends(t);
    return t;
  }

 private:
  void refuse(Location at, const std::string& why) { messages_.add(at, fmt::format("{}: {}", path_, why)); }

  std::optional<Quantity> quantity(const DocumentValue& v, const std::string& name) {
    if (v.computed) return v.computed->quantity;
    if (v.type == Type::integer || v.type == Type::number) return Quantity{.value = v.number, .dimension = {}};
    UnitError error;
    const auto read = v.type == Type::text ? parse_quantity(v.text, error) : std::nullopt;
    if (!read)
      refuse(v.at, fmt::format("{} = {}: must be a quantity, e.g. \"10 kN*m/rad\"{}", name, v.describe(),
                               error.text.empty() ? "" : "; " + error.text));
    return read;
  }

  void read_value(Tolerance& t) {
    const DocumentValue& v = table_.find("value")->value;
    const auto read = quantity(v, "value");
    if (!read) return;
    dimension_ = read->dimension;
    if (v.type == Type::text && !v.computed) {
      t.unit = v.text.substr(std::min(read->unit_at, v.text.size()));
      t.unit.erase(0, std::min(t.unit.find_first_not_of(' '), t.unit.size()));
    }
    UnitError error;
    const auto unit = parse_unit(t.unit, error);
    factor_ = unit ? unit->factor : 1;
    t.value = read->value / factor_;
  }

  void read_distribution(Tolerance& t) {
    using enum Tolerance::Distribution;
    if (const DocumentEntry* entry = table_.find("distribution")) {
      const std::string& name = entry->value.text;
      const std::vector<std::string> names = {"normal", "uniform", "triangular"};
      if (std::find(names.begin(), names.end(), name) == names.end())
        refuse(entry->value.at, fmt::format("distribution = {}{}; must be {}", entry->value.describe(),
                                            suggestion(name, names), listed(names)));
      t.distribution = name == "normal" ? normal : name == "triangular" ? triangular : uniform;
    }
    if (const DocumentEntry* entry = table_.find("k")) {
      t.k = entry->value.number;
      if (!is_number(entry->value) || !(t.k > 0 && t.k <= 10) || t.distribution != normal)
        refuse(entry->value.at,
               "k is a number > 0 (up to 10) of distribution = \"normal\": its deviation is tolerance/k");
    }
  }

  void read_ends(Tolerance& t) {
    const DocumentEntry *width = table_.find("tolerance"), *from = table_.find("from"), *to = table_.find("to");
    if (width ? from || to : !(from && to)) return refuse(table_.at, "give either tolerance, or from and to");
    if (!width && t.distribution == Tolerance::Distribution::normal)
      return refuse(table_.at,
                    "a normal distribution has no ends; give tolerance and k, or distribution = \"uniform\"");
    if (width) {
      const double half = std::abs(wide(width->value, t.value));
      t.low = t.value - half, t.high = t.value + half;
    } else {
      t.low = end(from->value, "from"), t.high = end(to->value, "to");
    }
    if (messages_.empty() && !(t.low < t.high && t.low <= t.value && t.value <= t.high))
      refuse(table_.at, "the value must lie between two ends that differ");
  }
  // Absolute, or a share of the value; of a plain number "10 %" is a share, too.
  double wide(const DocumentValue& v, double value) {
    const auto read = quantity(v, "tolerance");
    if (!read) return 0;
    if (v.type == Type::text && v.text.find('%') != std::string::npos) return read->value * value;
    return in_unit(*read, v, "tolerance");
  }
  double end(const DocumentValue& v, const std::string& name) {
    const auto read = quantity(v, name);
    return read ? in_unit(*read, v, name) : 0;
  }
  double in_unit(const Quantity& q, const DocumentValue& v, const std::string& name) {
    if (q.dimension != dimension_)
      refuse(v.at, fmt::format("{} = {}: is {}, and the value is {}", name, v.describe(), name_of(q.dimension),
                               name_of(dimension_)));
    return q.value / factor_;
  }

  const DocumentValue& table_;
  std::string path_;
  Messages& messages_;
  Dimension dimension_;
  double factor_ = 1;
};

void collect(const DocumentValue& value, const std::string& path, std::vector<Tolerance>& list, Messages& messages) {
  if (has_tolerance(value)) {
    list.push_back(read_tolerance(value, path, messages));
    return;
  }
  for (const DocumentEntry& entry : value.entries)
    collect(entry.value, path.empty() ? entry.key : path + "." + entry.key, list, messages);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    collect(value.items[i], fmt::format("{}[{}]", path, i + 1), list, messages);
}

// In double throughout: boost's constants in long double are set at every start of the program, and not under valgrind.
using Normal =
    boost::math::normal_distribution<double,
                                     boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

}  // namespace

double deviation(const Tolerance& t) {
  using enum Tolerance::Distribution;
  const double a = t.low, b = t.high, c = t.value;
  if (t.distribution == normal) return (b - a) / 2 / t.k;
  if (t.distribution == uniform) return (b - a) / std::sqrt(12.0);
  return std::sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18);
}

double share_below(const Tolerance& t, double x) {
  using enum Tolerance::Distribution;
  const double a = t.low, b = t.high, c = t.value;
  if (t.distribution == normal) {
    if (std::isinf(x)) return x > 0 ? 1 : 0;
    return boost::math::cdf(Normal(c, deviation(t)), x);
  }
  if (x <= a) return 0;
  if (x >= b) return 1;
  if (t.distribution == uniform) return (x - a) / (b - a);
  return x < c ? (x - a) * (x - a) / ((b - a) * (c - a)) : 1 - (b - x) * (b - x) / ((b - a) * (b - c));
}

double quantile(const Tolerance& t, double share) {
  using enum Tolerance::Distribution;
  const double a = t.low, b = t.high, c = t.value;
  if (t.distribution == normal) {
    constexpr double least = 1e-300, most = 1 - 1e-16;
    return boost::math::quantile(Normal(c, deviation(t)), std::clamp(share, least, most));
  }
  if (t.distribution == uniform) return a + share * (b - a);
  const double at_mode = (c - a) / (b - a);
  return share < at_mode ? a + std::sqrt(share * (b - a) * (c - a)) : b - std::sqrt((1 - share) * (b - a) * (b - c));
}

bool has_tolerance(const DocumentValue& table) {
  return table.type == Type::table && table.find("value") &&
         (table.find("tolerance") || table.find("from") || table.find("to") || table.find("distribution"));
}

Tolerance read_tolerance(const DocumentValue& table, const std::string& path, Messages& messages) {
  return ToleranceReader(table, path, messages).read();
}

std::vector<Tolerance> tolerances_of(const std::string& text, const std::string& file) {
  std::vector<Tolerance> list;
  Messages messages(file);
  collect(parse_toml(text, file), "", list, messages);
  messages.throw_if_any();
  return list;
}

}  // namespace kurbel
