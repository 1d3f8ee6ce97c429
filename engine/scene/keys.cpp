// keys.cpp — keys of every type, how domains and lists of names are written, and how a section's values are found.
#include "engine/scene/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "engine/base/find_by.h"
#include "engine/numerics/angles.h"
#include "engine/scene/units.h"

namespace kurbel {

Curve CurveData::curve(double other_period) const {
  Curve curve = by_formula.empty() ? Curve(x, y, form, other_period > 0 ? other_period : period) : by_formula;
  curve.go_on(beyond, beyond);
  return within > 0 ? curve.by_fewer_pieces(within * curve.max_abs()) : curve;
}

Curve CurveData::back() const {
  if (x_back.empty()) return {};
  Curve curve = by_formula_back.empty() ? Curve(x_back, y_back, form) : by_formula_back;
  curve.go_on(beyond, beyond);
  return within > 0 ? curve.by_fewer_pieces(within * curve.max_abs()) : curve;
}

std::string Domain::describe(const std::string& unit) const {
  constexpr double degree = pi / 180;  // angles are given in degrees
  if (unit == "rad") return Domain{low / degree, high / degree, low_open, high_open}.describe("deg");
  const bool bounded_low = std::isfinite(low), bounded_high = std::isfinite(high);
  if (bounded_low && bounded_high)
    return low_open || high_open ? fmt::format("{} {:.9g} and {} {}", low_open ? ">" : "≥", low, high_open ? "<" : "≤",
                                               with_unit(high, unit, 9))
                                 : fmt::format("{:.9g} … {}", low, with_unit(high, unit, 9));
  if (bounded_low) return fmt::format("{} {}", low_open ? ">" : "≥", with_unit(low, low == 0 ? "" : unit));
  if (bounded_high) return fmt::format("{} {}", high_open ? "<" : "≤", with_unit(high, unit));
  return "finite";
}

Key quantity(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect) {
  return {.name = std::string(name),
          .unit = std::string(unit),
          .domain = domain,
          .doc = KeyDoc(doc),
          .effect = std::string(effect)};
}

Key required(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect) {
  Key key = quantity(name, unit, domain, doc, effect);
  key.required = true;
  return key;
}

static std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

Key defaulted(std::string_view name, std::string_view unit, std::string_view fallback, Domain domain, KeyDocText doc,
              std::string_view effect) {
  Key key = quantity(name, unit, domain, doc, effect);
  key.fallback = key.unit.empty() ? std::string(fallback) : quoted(fallback);
  return key;
}

static Key other_key(KeyType type, std::string_view name, std::string fallback, KeyDocText doc,
                     std::string_view effect) {
  Key key = quantity(name, "", any_number, doc, effect);
  key.type = type;
  key.fallback = std::move(fallback);
  return key;
}

Key flag(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect) {
  return other_key(KeyType::flag, name, std::string(fallback), doc, effect);
}

Key choice(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect) {
  return other_key(KeyType::text, name, quoted(fallback), doc, effect);
}

Key curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc) {
  Key key = quantity(name, unit, any_number, doc);
  key.type = KeyType::curve;
  key.choices = std::move(over);
  return key;
}

Key required_curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc) {
  Key key = curve(name, std::move(over), unit, doc);
  key.required = true;
  return key;
}

Kind on_a_shaft(std::string name, KeyDoc doc, std::vector<Key> keys, Build build) {
  return {.name = std::move(name), .doc = std::move(doc), .keys = std::move(keys), .build = build};
}

Kind between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build) {
  Kind kind = on_a_shaft(std::move(name), std::move(doc), std::move(keys), build);
  kind.placement = Placement::inline_two;
  return kind;
}

Kind elastic_between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build) {
  Kind kind = between_shafts(std::move(name), std::move(doc), std::move(keys), build);
  kind.elastic = true;
  return kind;
}

const Key* Kind::key(std::string_view its_name) const { return find_by(keys, &Key::name, its_name); }

std::string shortened_list(std::vector<std::string> names, std::string_view conjunction) {
  constexpr std::size_t most = 30;
  if (names.size() <= most) return listed(names, conjunction);
  const std::size_t more = names.size() - most;
  names.resize(most);
  return fmt::format("{} … and {} more", listed(names, ","), more);
}

namespace {

// "spring_stiffness", "dc shunt motor"
std::set<std::string> words_in(const std::string& name) {
  std::set<std::string> words;
  for (std::size_t begin = 0, end = 0; begin < name.size(); begin = end + 1) {
    end = std::min(name.find_first_of(" _-", begin), name.size());
    if (end > begin) words.insert(name.substr(begin, end - begin));
  }
  return words;
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  if (const auto near = nearest(word, names)) return fmt::format(" — did you mean \"{}\"?", *near);
  constexpr std::size_t most = 4;
  const std::set<std::string> asked = words_in(word);
  std::vector<std::string> holding;
  for (const std::string& name : names)
    if (std::ranges::includes(words_in(name), asked)) holding.push_back(name);
  if (asked.empty() || holding.empty() || holding.size() > most) return "";
  return fmt::format(" — did you mean {}?", listed(holding));
}

std::string listed(const std::vector<std::string>& names, std::string_view conjunction) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", conjunction) : ", ";
    text += fmt::format("\"{}\"", names[i]);
  }
  return text;
}

const Setting* Section::find(std::string_view key) const { return find_by(settings, &Setting::key, key); }

const Setting& Section::operator[](std::string_view key) const {
  if (const Setting* setting = find(key)) return *setting;
  throw std::logic_error(fmt::format("section \"{}\" has no value for \"{}\"", name, key));
}

}  // namespace kurbel
