// preparation.cpp — definitions of a document used in many places: constants, formulas of them, tables used by name.
#include <fmt/format.h>

#include <algorithm>

#include "engine/reading/scene_reading.h"
#include "engine/reading/tolerances.h"
#include "engine/values/formula_reader.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

constexpr std::size_t most_used = 100'000;  // values that tables used by name bring in

class Preparation {
 public:
  explicit Preparation(SceneReading& r) : r_(r) {}

  void prepare() {
    if (const DocumentEntry* constants = r_.document.find("constants")) read_constants(*constants);
    if (const DocumentEntry* tables = r_.document.find("table"); tables && is_table_of_tables(tables->value)) {
      for (const DocumentEntry& table : tables->value.entries) check_table(table);
      tables_ = tables->value;
    }
    shared_ = std::make_shared<const std::map<std::string, Quantity>>(names_.constants);
    for (DocumentEntry& entry : r_.document.entries) {
      const bool words = entry.key == "title" || entry.key == "description" || entry.key == "constants";
      if (!words) prepare(entry.value, entry.key == "table" && is_table_of_tables(entry.value));
    }
  }

 private:
  void read_constants(const DocumentEntry& table) {
    if (table.value.type != Type::table)
      return r_.refuse(table.at, "constants must be a table: [constants], with p0 = \"1 bar\" and the like");
    for (const DocumentEntry& entry : table.value.entries) {
      if (const std::string wrong = wrong_constant_name(entry.key); !wrong.empty()) {
        r_.refuse(entry.at, fmt::format("constant {}: {}", in_quotes(entry.key), wrong));
        continue;
      }
      DocumentValue value = entry.value;
      if (value.type == Type::text && value.text.starts_with('=')) compute(value);
      names_.constants[entry.key] = read_constant(value, "constant " + in_quotes(entry.key), r_.messages);
    }
  }

  // "= 2*p0"
  void compute(DocumentValue& value) {
    UnitError error;
    const auto read = read_formula(std::string_view(value.text).substr(1), names_, error);
    const auto whole = read ? whole_dimension(read->dimension) : std::nullopt;
    if (read && !whole)
      return r_.refuse(value.at, fmt::format("formula {} is of {}; must be of whole powers", value.describe(),
                                             name_of(read->dimension)));
    Quantity quantity;
    if (read) {
      quantity.value = read->formula[static_cast<int>(read->formula.size()) - 1].number;
      quantity.dimension = *whole;
    } else {
      r_.refuse(place_within(value, error.column + 1), fmt::format("formula {}: {}", value.describe(), error.text));
    }
    value.computed = std::make_shared<const Computed>(Computed{quantity, !read, read && read->zero});
  }

  static std::optional<Dimension> whole_dimension(const BrokenDimension& dimension) {
    Dimension whole;
    for (std::size_t i = 0; i < dimension.size(); ++i) whole.exponent[i] = static_cast<int>(std::lround(dimension[i]));
    if (!same_dimension(broken(whole), dimension)) return {};
    return whole;
  }

  void check_table(const DocumentEntry& table) {
    if (table.value.find("use"))
      r_.refuse(table.value.find("use")->at,
                fmt::format("[table.{}] uses another table; write what it holds", table.key));
  }

  // Depth is bounded by the document's.
  void prepare(DocumentValue& value, bool is_tables) {
    if (value.type == Type::text && value.text.starts_with('=')) return compute(value);
    if (has_tolerance(value)) return take_value(value);
    if (value.type == Type::table && !is_tables) {
      use(value);
      if (value.find("formula") || value.find("return_formula")) value.constants = shared_;
    }
    for (DocumentEntry& entry : value.entries)
      // The formula of a curve has a variable, known to the reader of the curve.
      if (entry.key != "formula" && entry.key != "return_formula") prepare(entry.value, false);
    for (DocumentValue& item : value.items) prepare(item, false);
  }

  // A run uses the value of a toleranced quantity.
  void take_value(DocumentValue& table) {
    const std::size_t faults = r_.messages.all().size();
    for (DocumentEntry& entry : table.entries) prepare(entry.value, false);
    read_tolerance(table, "value with a tolerance", r_.messages);
    if (r_.messages.all().size() > faults) {
      table.computed = std::make_shared<const Computed>(Computed{.quantity = {}, .faulty = true});
      return;
    }
    DocumentValue value = table.find("value")->value;
    table = std::move(value);
  }

  // `use = "table.gas"`: its keys, where the using table does not give them itself.
  void use(DocumentValue& table) {
    const auto use = std::find_if(table.entries.begin(), table.entries.end(),
                                  [](const DocumentEntry& entry) { return entry.key == "use"; });
    if (use == table.entries.end()) return;
    const DocumentValue named = use->value;
    const bool is_name = named.type == Type::text && named.text.starts_with("table.");
    const DocumentEntry* found = is_name ? tables_.find(named.text.substr(6)) : nullptr;
    if (!found || found->value.type != Type::table) {
      std::vector<std::string> names;
      for (const DocumentEntry& entry : tables_.entries) names.push_back("table." + entry.key);
      r_.refuse(named.at, fmt::format("use = {}{}; must name a table of this scene: {}", named.describe(),
                                      is_name ? suggestion(named.text, names) : "",
                                      names.empty() ? "write it as [table.gas]" : shortened_list(names)));
      table.entries.erase(use);
      table.computed = std::make_shared<const Computed>(Computed{.quantity = {}, .faulty = true});
      return;
    }
    used_ += count(found->value);
    if (used_ > most_used)
      return r_.refuse(named.at, fmt::format("tables used by name bring in more than {} values", most_used));
    table.entries.erase(use);
    for (const DocumentEntry& entry : found->value.entries)
      if (!table.find(entry.key)) table.entries.push_back(entry);
  }
  static std::size_t count(const DocumentValue& value) {
    std::size_t sum = 1;
    for (const DocumentEntry& entry : value.entries) sum += count(entry.value);
    for (const DocumentValue& item : value.items) sum += count(item);
    return sum;
  }

  SceneReading& r_;
  FormulaNames names_;
  DocumentValue tables_;
  std::shared_ptr<const std::map<std::string, Quantity>> shared_;
  std::size_t used_ = 0;
};

}  // namespace

bool is_table_of_tables(const DocumentValue& value) { return value.type == Type::table && !value.find("kind"); }

void prepare_document(SceneReading& r) { Preparation(r).prepare(); }

}  // namespace kurbel
