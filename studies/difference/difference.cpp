// difference.cpp — the same study of both scenes, figure by figure.
#include "studies/difference/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/text.h"
#include "engine/values/quantity_reader.h"
#include "studies/findings/figure_changes.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

double number_of(const DocumentValue& v) { return v.type == Type::integer ? static_cast<double>(v.integer) : v.number; }

bool same_quantity(const std::string& a, const std::string& b) {
  UnitError error;
  const auto x = parse_quantity(a, error), y = parse_quantity(b, error);
  return x && y && x->dimension == y->dimension && std::abs(x->value - y->value) <= 1e-14 * std::abs(x->value);
}

// A value in one line, as it may stand in a file.
std::string in_one_line(const DocumentValue& v) {
  constexpr std::size_t most = 120;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (v.type == Type::list) {
    for (const DocumentValue& item : v.items) add(in_one_line(item));
    text = "[" + text + "]";
  } else if (v.type == Type::table) {
    for (const DocumentEntry& entry : v.entries) add(entry.key + " = " + in_one_line(entry.value));
    text = "{ " + text + " }";
  } else {
    return v.describe();
  }
  if (text.size() <= most) return text;
  return std::string(cut_at_character(text, most)) + " …";
}

class Changes {
 public:
  std::vector<SceneChange> take() { return std::move(changes_); }

  void compare(const std::string& path, const DocumentValue& a, const DocumentValue& b) {
    if (a.type == Type::table && b.type == Type::table) return tables(path, a, b);
    if (a.type == Type::list && b.type == Type::list && a.items.size() == b.items.size() && !a.items.empty()) {
      for (std::size_t i = 0; i < a.items.size(); ++i)
        compare(fmt::format("{}[{}]", path, i + 1), a.items[i], b.items[i]);
      return;
    }
    if (!same(a, b)) changes_.push_back({path, in_one_line(a), in_one_line(b), a.at, b.at});
  }

 private:
  static bool same(const DocumentValue& a, const DocumentValue& b) {
    if (is_number(a) && is_number(b)) return number_of(a) == number_of(b);
    if (a.type != b.type) return false;
    if (a.type == Type::text) return a.text == b.text || same_quantity(a.text, b.text);
    return in_one_line(a) == in_one_line(b) && a.items.size() == b.items.size();
  }

  void tables(const std::string& path, const DocumentValue& a, const DocumentValue& b) {
    const auto under = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
    for (const DocumentEntry& entry : a.entries) {
      if (const DocumentEntry* other = b.find(entry.key))
        compare(under(entry.key), entry.value, other->value);
      else
        changes_.push_back({under(entry.key), in_one_line(entry.value), {}, entry.value.at, {}});
    }
    for (const DocumentEntry& entry : b.entries)
      if (!a.find(entry.key)) changes_.push_back({under(entry.key), {}, in_one_line(entry.value), {}, entry.value.at});
  }

  std::vector<SceneChange> changes_;
};

}  // namespace

std::optional<Estimate> FigureDifference::change() const {
  if (!a || !b) return {};
  return *b - *a;
}

std::optional<double> FigureDifference::relative() const {
  if (!a || !b || !(std::abs(a->value) > a->error.value_or(0)) || a->value == 0) return {};
  return b->value / a->value - 1;
}

double FigureDifference::weight() const {
  if (!a || !b) return 0;
  const double most = std::max({std::abs(a->value), std::abs(b->value), scale});
  return most > 0 ? std::abs(change()->value) / most : 0;
}

bool FigureDifference::differs() const {
  constexpr double rounding = 1e-10;  // of the larger value, or of the figure's scale
  const auto by = change();
  return !by || (std::abs(by->value) > by->error.value_or(0) && weight() > rounding);
}

MachineDifference difference_between(const MachineQuestion& a, const MachineQuestion& b, const std::string& of) {
  // Answers first: if one throws, for example on interruption, g++ 12 destroys elements of a braced list twice.
  MachineAnswer first = answer_of(a), second = answer_of(b);
  MachineDifference d{.of = of, .a = std::move(first), .b = std::move(second)};
  for (const Figure& f : d.a.figures) {
    FigureDifference row{.name = f.name, .unit = f.unit, .a = f, .scale = f.scale, .reporting = is_informative(f)};
    d.figures.push_back(std::move(row));
  }
  for (const Figure& f : d.b.figures) {
    auto row = std::find_if(d.figures.begin(), d.figures.end(), [&](const auto& r) { return r.name == f.name; });
    if (row == d.figures.end())
      row = d.figures.insert(row, {.name = f.name, .unit = f.unit, .scale = f.scale, .reporting = is_informative(f)});
    row->b = f;
  }
  d.changes = scene_changes(parse_toml(d.a.text, d.a.file), parse_toml(d.b.text, d.b.file));
  return d;
}

std::vector<SceneChange> scene_changes(const DocumentValue& a, const DocumentValue& b) {
  Changes changes;
  changes.compare("", a, b);
  return changes.take();
}

}  // namespace kurbel
