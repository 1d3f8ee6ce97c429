// keys.h — contents of a scene: every kind of component is a table of keys, used by the reader and by the docs.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "engine/numerics/curve.h"
#include "engine/scene/messages.h"

namespace kurbel {

struct Section;
struct Kind;
class Network;

// The allowed range of a number.
struct Domain {
  double low = -HUGE_VAL, high = HUGE_VAL;
  bool low_open = false, high_open = false;

  bool contains(double v) const {
    return std::isfinite(v) && (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
  }
  std::string describe(const std::string& unit) const;  // "> 0 N·m/rad", "0 … 1"
};
inline constexpr Domain any_number{};
inline constexpr Domain positive{.low = 0, .low_open = true};
inline constexpr Domain not_negative{.low = 0};

enum class KeyType {
  quantity,    // "4 kN*m/rad"; with an empty unit a bare number or "5 %"
  quantities,  // a list of quantities
  integers,    // a list of whole numbers
  integer,
  flag,
  text,      // free text, or one of `choices`
  curve,     // a table: over, unit, points or file
  sections,  // one table or a list of tables, each of one of the `nested` kinds
  named,  // a table of names that the user chooses, each with a table of the `nested` kind or the value of its first key
};

// Documentation of a key or a kind. The run-time of exported components does not contain it.
#ifdef KURBEL_FMI_RUNTIME
struct KeyDoc {
  KeyDoc() = default;
  template <class Text>
  constexpr KeyDoc(const Text&) {}
  constexpr operator std::string_view() const { return {}; }
};
using KeyDocText = KeyDoc;
#else
using KeyDoc = std::string;
using KeyDocText = std::string_view;
#endif

struct Key {
  std::string name;
  KeyType type = KeyType::quantity;
  std::string unit = {};      // SI unit of the value (for a curve: of its second column)
  std::string fallback = {};  // default, as written in a file; empty: none
  Domain domain = any_number;
  KeyDoc doc = {};
  bool required = false;
  std::vector<std::string> choices = {};      // for a text; for a curve: the allowed abscissas
  const std::vector<Kind>* nested = nullptr;  // for sections and named tables
  std::string effect = {};                    // effects for which this key is a parameter, separated by spaces

  bool gives(const std::string& asked) const {
    return (" " + effect + " ").find(" " + asked + " ") != std::string::npos;
  }
};

// Keys of numbers; an empty unit for a bare number, `effect` as in Key.
Key quantity(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect = "");
Key required(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect = "");
// If not given, `fallback` is used as if it were in the file: "0 deg"; quotes are added if it has a unit.
Key defaulted(std::string_view name, std::string_view unit, std::string_view fallback, Domain domain, KeyDocText doc,
              std::string_view effect = "");

// Keys of other types: true or false, a word, a characteristic over one of `over`.
Key flag(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect = "");
Key choice(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect = "");
Key curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc);
Key required_curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc);

// Position of a kind of component in a machine.
enum class Placement {
  inline_one,  // one continuous shaft: motor, flywheel, slider-crank; in a line, or `on` a component
  inline_two,  // a shaft on each side: coupling, gearbox; only in a line
  nested       // in the table of another component
};

struct Kind {
  std::string name;
  KeyDoc doc = {};
  Placement placement = Placement::inline_one;
  std::vector<Key> keys;
  // Adds the component to the network; reports faults of its parameters together. Null for nested kinds.
  void (*build)(const Section&, Network&, Messages&) = nullptr;
  // The component's elasticity can be switched off, which merges the shafts on either side.
  bool elastic = false;
  // Shafts in addition to "in" and "out" at which a branch may begin: "ring".
  std::vector<std::string> further_shafts = {};

  const Key* key(std::string_view its_name) const;  // null: none
};

// Kinds of components by their common properties.
using Build = void (*)(const Section&, Network&, Messages&);
Kind on_a_shaft(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);
Kind between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);
Kind elastic_between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);

// A characteristic as read, in SI; its component makes a Curve of it. For a formula the points are the knots between its
// pieces.
struct CurveData {
  std::string over;  // "time", "angle", "speed", "travel"
  std::vector<double> x, y;
  std::vector<double> x_back, y_back;  // branch of the return stroke, if given
  Curve::Form form = Curve::Form::linear;
  double period = 0;
  Beyond beyond = Beyond::unspecified;          // of both ends
  Curve by_formula = {}, by_formula_back = {};  // empty: by points
  // Allowed error of an approximation by fewer pieces over the maximum; 0: as given. Set by studies (dense_tables.h).
  double within = 0;

  // Throws std::invalid_argument with a message. other_period: replaces its period, if > 0.
  Curve curve(double other_period = 0) const;
  Curve back() const;  // of the return stroke
};

// One value of a section.
struct Setting {
  std::string key;
  Location at;         // of the value in the file; of the section if the default is used
  bool given = false;  // is in the file
  double number = 0;   // SI
  bool flag = false;
  std::string text = {};
  std::vector<double> numbers = {};
  CurveData curve = {};
  std::vector<Section> sections;
};

// One table of the scene: a component, or a table nested in one. Contains every key of its kind that is given or has a
// default.
struct Section {
  std::string name;
  const Kind* kind = nullptr;
  Location at;
  std::vector<Setting> settings = {};
  bool valid = true;  // read without an error

  const Setting* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool given(std::string_view key) const { return has(key) && find(key)->given; }
  const Setting& operator[](std::string_view key) const;  // throws std::logic_error if the key is absent
  double number(std::string_view key) const { return (*this)[key].number; }
  double number_or(std::string_view key, double fallback) const { return has(key) ? number(key) : fallback; }
  const std::string& text(std::string_view key) const { return (*this)[key].text; }
  Location where(std::string_view key) const { return has(key) ? find(key)->at : at; }
};

// A shortened list of names.
std::string shortened_list(std::vector<std::string> names, std::string_view conjunction = "or");
// " — did you mean "x"?", or empty: the nearest name, else those that hold all words of this one.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

// "a", "b" or "c"
std::string listed(const std::vector<std::string>& names, std::string_view conjunction = "or");

}  // namespace kurbel
