// keys.h — what may stand in a scene: every kind of component is one table of keys, used by the reader and by the docs.
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

// The range a number must lie in.
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

// What people read about a key or a kind. The run-time of exported components shows it to nobody, and holds none of it.
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
  std::string unit = {};      // SI unit of the value (of a curve: of its second column)
  std::string fallback = {};  // as it would stand in the file; empty: none
  Domain domain = any_number;
  KeyDoc doc = {};
  bool required = false;
  std::vector<std::string> choices = {};      // of a text; of a curve: what it may be given over
  const std::vector<Kind>* nested = nullptr;  // of sections, of named ones
  std::string effect = {};                    // giving it gives the scene parameters for these effects, by spaces

  bool gives(const std::string& asked) const {
    return (" " + effect + " ").find(" " + asked + " ") != std::string::npos;
  }
};

// Keys of numbers; an empty unit for a bare number, `effect` as in Key.
Key quantity(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect = "");
Key required(std::string_view name, std::string_view unit, Domain domain, KeyDocText doc, std::string_view effect = "");
// Where it is not given, as if `fallback` stood in the file: "0 deg"; quotes are put around it where it has a unit.
Key defaulted(std::string_view name, std::string_view unit, std::string_view fallback, Domain domain, KeyDocText doc,
              std::string_view effect = "");

// Keys of what is no number: true or false, a word, a characteristic over one of `over`.
Key flag(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect = "");
Key choice(std::string_view name, std::string_view fallback, KeyDocText doc, std::string_view effect = "");
Key curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc);
Key required_curve(std::string_view name, std::vector<std::string> over, std::string_view unit, KeyDocText doc);

// How a kind of component stands in a machine.
enum class Placement {
  inline_one,  // one shaft passes through it: motor, flywheel, slider-crank; in a line, or `on` a component
  inline_two,  // it has a shaft on either side: coupling, gearbox; only in a line
  nested       // stands inside another component's table
};

struct Kind {
  std::string name;
  KeyDoc doc = {};
  Placement placement = Placement::inline_one;
  std::vector<Key> keys;
  // Adds the component to the network, and says what is wrong with its parameters together. Null for nested kinds.
  void (*build)(const Section&, Network&, Messages&) = nullptr;
  // The component's elasticity can be switched off, which merges the shafts on either side.
  bool elastic = false;
  // Shafts besides "in" and "out" that a branch may begin at: "ring".
  std::vector<std::string> further_shafts = {};
};

// Kinds of components, by what every one of them says.
using Build = void (*)(const Section&, Network&, Messages&);
Kind on_a_shaft(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);
Kind between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);
Kind elastic_between_shafts(std::string name, KeyDoc doc, std::vector<Key> keys, Build build);

// A characteristic as read, in SI; made into a Curve by the component that owns it. Of a formula the points are those
// between its pieces.
struct CurveData {
  std::string over;  // "time", "angle", "speed", "travel"
  std::vector<double> x, y;
  std::vector<double> x_back, y_back;  // branch of the return stroke, where one was given
  Curve::Form form = Curve::Form::linear;
  double period = 0;
  Beyond beyond = Beyond::unsaid;               // of both ends
  Curve by_formula = {}, by_formula_back = {};  // empty: by points
  // Part of the greatest value that fewer pieces than points may be off; 0: as given. Set by studies (dense_tables.h).
  double within = 0;

  // Throws std::invalid_argument in words; with another period than its own where one is given.
  Curve curve(double other_period = 0) const;
  Curve back() const;  // of the return stroke
};

// One value of a section.
struct Setting {
  std::string key;
  Location at;         // of the value in the file; of the section where the fallback is used
  bool given = false;  // stands in the file
  double number = 0;   // SI
  bool flag = false;
  std::string text = {};
  std::vector<double> numbers = {};
  CurveData curve = {};
  std::vector<Section> sections;
};

// One table of the scene: a component, or a table nested in one. Holds every key of its kind that was given or has a
// fallback.
struct Section {
  std::string name;
  const Kind* kind = nullptr;
  Location at;
  std::vector<Setting> settings = {};
  bool sound = true;  // read without an error

  const Setting* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool given(std::string_view key) const { return has(key) && find(key)->given; }
  const Setting& operator[](std::string_view key) const;  // throws std::logic_error if the key is absent
  double number(std::string_view key) const { return (*this)[key].number; }
  double number_or(std::string_view key, double fallback) const { return has(key) ? number(key) : fallback; }
  const std::string& text(std::string_view key) const { return (*this)[key].text; }
  Location where(std::string_view key) const { return has(key) ? find(key)->at : at; }
};

// A few names of many.
std::string shortened_list(std::vector<std::string> names, std::string_view conjunction = "or");
// " — did you mean "x"?", or nothing.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

// "a", "b" or "c"
std::string listed(const std::vector<std::string>& names, std::string_view conjunction = "or");

}  // namespace kurbel
