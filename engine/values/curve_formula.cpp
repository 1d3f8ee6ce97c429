// curve_formula.cpp — a characteristic by a formula: its variable, range and constants, its pieces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/values/curve_reader.h"
#include "engine/values/formula_reader.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

// The names of what a curve is given over, the word first.
std::vector<std::string> variable_names(const std::string& over) {
  if (over == "time") return {"time", "t"};
  if (over == "angle") return {"angle", "phi"};
  if (over == "speed") return {"speed", "omega"};
  if (over == "twist") return {"twist", "theta"};
  if (over == "swing") return {"swing", "psi"};
  if (over == "speed ratio") return {"speed_ratio", "nu"};
  return {over, "x"};
}

class FormulaCurveReader {
 public:
  FormulaCurveReader(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages)
      : table_(table), key_(key), what_(what), messages_(messages) {}

  bool read(CurveData& curve) {
    UnitError error;
    over_ = curve.over;
    names_.variable = variable_names(curve.over);
    names_.variable_dimension = parse_unit(unit_over(curve.over), error)->dimension;
    curve.form = Curve::Form::formula;
    const bool formula_alone = refuse_points(), constants = read_constants(), range = read_range(curve);
    if (!table_.find("formula"))
      refuse(table_.find("return_formula")->at, "\"return_formula\" needs a \"formula\", too");
    if (!formula_alone || !constants || !range || !table_.find("formula")) return false;
    if (!read_one("formula", curve.period, curve.by_formula, curve.x, curve.y)) return false;
    return !table_.find("return_formula") ||
           read_one("return_formula", curve.period, curve.by_formula_back, curve.x_back, curve.y_back);
  }

 private:
  bool refuse(Location at, const std::string& text) {
    messages_.add(at, fmt::format("{}: {}", what_, text));
    return false;
  }

  bool refuse_points() {
    bool none = true;
    for (const char* key : {"unit", "points", "file", "return_points", "return_file", "columns", "interpolation",
                            "sheet", "decimal", "gain", "offset", "shift"})
      if (const DocumentEntry* entry = table_.find(key))
        none = refuse(entry->at, fmt::format("\"formula\" and \"{}\" both given; {}", key,
                                             key == std::string_view("unit")
                                                 ? "a formula carries its units in itself; drop the list"
                                                 : "keep one"));
    return none;
  }

  bool read_constants() {
    if (table_.constants) names_.constants = *table_.constants;
    const DocumentEntry* with = table_.find("with");
    if (!with) return true;
    if (with->value.type != Type::table)
      return refuse(with->value.at, fmt::format("with = {}; must be a table of constants, e.g. {{ p0 = \"1 bar\" }}",
                                                with->value.describe()));
    const std::size_t before = messages_.all().size();
    for (const DocumentEntry& entry : with->value.entries) {
      std::string wrong = wrong_constant_name(entry.key);
      if (std::find(names_.variable.begin(), names_.variable.end(), entry.key) != names_.variable.end())
        wrong = "it is the variable";
      if (!wrong.empty()) refuse(entry.at, fmt::format("constant {}: {}", in_quotes(entry.key), wrong));
      names_.constants[entry.key] = read_constant(entry.value, what_ + ": constant " + in_quotes(entry.key), messages_);
    }
    return messages_.all().size() == before;
  }

  // From where to where it holds; of an angle, one period.
  bool read_range(CurveData& curve) {
    const std::string unit = unit_over(over_);
    const DocumentEntry *range = table_.find("range"), *period = table_.find("period");
    if (range && period) return refuse(range->at, "\"range\" and \"period\" both given; keep one");
    if (period && !read_quantity(period->value, unit, positive, what_ + ": period", messages_, curve.period))
      return false;
    if (over_ == "angle") {
      if (range) return refuse(range->at, "a formula over the angle holds for a whole \"period\"; default: 360 deg");
      if (!period) curve.period = 2 * std::numbers::pi;
      if (const std::string wrong = wrong_period(curve); !wrong.empty()) return refuse(period->value.at, wrong);
    }
    from_ = 0, to_ = curve.period;
    if (curve.period > 0) return true;
    if (!range)
      return refuse(table_.at,
                    fmt::format("\"range\" is missing: from where to where the formula holds; beyond it the "
                                "values at its ends do. Write e.g. range = [{0}, {1}]",
                                unit == "1" ? "0" : "\"0 " + unit + "\"", unit == "1" ? "1" : "\"1 " + unit + "\""));
    const DocumentValue& ends = range->value;
    if (ends.type != Type::list || ends.items.size() != 2)
      return refuse(ends.at, fmt::format("range = {}; must be a list of two, from and to", ends.describe()));
    const std::string plain_unit = unit == "1" ? "" : unit;
    if (!read_quantity(ends.items[0], plain_unit, any_number, what_ + ": range", messages_, from_) ||
        !read_quantity(ends.items[1], plain_unit, any_number, what_ + ": range", messages_, to_))
      return false;
    if (!(to_ - from_ > 1e-9 * std::max(std::abs(from_), std::abs(to_))) || !(to_ - from_ > least_size))
      return refuse(ends.items[1].at, fmt::format("range = [{}, {}]; the end must lie behind the begin",
                                                  ends.items[0].describe(), ends.items[1].describe()));
    return true;
  }

  bool read_one(const char* name, double period, Curve& curve, std::vector<double>& x, std::vector<double>& y) {
    const DocumentValue& text = table_.find(name)->value;
    const auto refuse_at = [&](std::size_t column, const std::string& why) {
      messages_.add(place_within(text, column), fmt::format("{}: {} = {}: {}", what_, name, text.describe(), why));
      return false;
    };
    if (text.type != Type::text)
      return refuse(text.at, fmt::format("{} = {}; must be a formula in quotes, e.g. \"M0*(1 - {}/(…))\"", name,
                                         text.describe(), names_.variable.front()));
    const std::size_t begin = text.text.starts_with('=') ? 1 : 0;
    UnitError error;
    const auto read = read_formula(std::string_view(text.text).substr(begin), names_, error);
    if (!read) return refuse_at(error.column + begin, error.text);
    const auto wanted = parse_unit(key_.unit, error);
    BrokenDimension without = read->dimension, wanted_without = broken(wanted->dimension);
    const bool fits = read->zero || same_dimension(without, wanted_without);
    without[3] = wanted_without[3] = 0;
    if (!fits)
      return refuse_at(0,
                       fmt::format("it gives {}; must give {}{}", name_of(read->dimension), name_of(wanted->dimension),
                                   same_dimension(without, wanted_without)
                                       ? " (the angle counts as a dimension: multiply or divide by 1 rad)"
                                       : ""));
    const auto in_words = [&](double value) {
      return fmt::format("{} = {}", names_.variable.front(), with_unit(value, unit_over(over_)));
    };
    if (const auto fault = read->formula.knots(from_, to_, x))
      return refuse_at(
          fault->column + begin,
          fmt::format("{} at {}, within its {}", fault->text, in_words(fault->x),
                      period > 0 ? "period" : "range; narrow it, or cut off what lies beyond by max, min or if"));
    std::vector<FormulaProgram> programs;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) programs.push_back(read->formula.program(x[i], x[i + 1]));
    try {
      curve = Curve(x, std::move(programs), period);
    } catch (const std::invalid_argument& wrong) {
      return refuse_at(0, wrong.what());
    }
    y = curve.y();
    return true;
  }

  const DocumentValue& table_;
  const Key& key_;
  const std::string& what_;
  Messages& messages_;
  std::string over_;
  FormulaNames names_;
  double from_ = 0, to_ = 0;
};

}  // namespace

bool read_curve_formula(const DocumentValue& table, const Key& key, const std::string& what, Messages& messages,
                        CurveData& curve) {
  return FormulaCurveReader(table, key, what, messages).read(curve);
}

}  // namespace kurbel
