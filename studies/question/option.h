// option.h — options of a question, each declared once together with the member that it fills: the command line, the
// library, Python, completion and the documents use this table.
//
//     OptionsOf<SizeRequest>()
//         .add({.name = "delta", .doc = "demanded δ, e.g. 0.05 or 1/20", .example = "0.05", .what = "a plain number"},
//              &SizeRequest::delta)
//         .add({.name = "periods", .doc = "cycles of a period", .domain = {.low = 1, .high = 64}}, &SizeRequest::periods)
//         .add({.name = "no_start", .doc = "skip the start"}, &SizeRequest::start_search, false)
//         .add({.name = "form", .doc = "rim or disc"}, &SizeRequest::form, {{"rim", Form::rim}, {"disc", Form::disc}})
//
// The member's type defines the syntax: bool a flag, double a quantity with its unit, whole numbers, a string a text,
// vectors several values; std::optional if it may be absent.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/orbit/moment.h"
#include "engine/scene/effects.h"
#include "engine/scene/keys.h"

namespace kurbel {

// A quantity in SI from an option; the example shows its unit: quantity_of("--until", "3 s", "a time > 0", "3 s",
// positive). Throws std::invalid_argument with the reason.
double quantity_of(const std::string& option, const std::string& text, const std::string& what,
                   const std::string& example, const Domain& domain);

// Throws std::logic_error unless the example of a quantity's option is one that the option accepts: it defines the unit.
struct OptionText;
void check_example(const OptionText& option);

// After "step 2" of the operating sequence, at "1.5 s", or at a speed, which is stored in `speed` [rad/s]. Throws
// std::invalid_argument for anything else.
Moment moment_of(const std::string& option, const std::string& at, std::optional<double>& speed);

// By name, {"mid_speed", "60 rpm"}; a flag is "true". A repeatable option appears several times.
using GivenOptions = std::vector<std::pair<std::string, std::string>>;

struct OptionText {
  std::string name;            // "mid_speed", on the command line --mid-speed
  std::string doc;             // for help, manual page and documents
  std::string example = {};    // of a quantity: shows its unit, "60 rpm"
  std::string what = {};       // what a quantity must be: "a speed > 0"
  Domain domain = any_number;  // of quantities and whole numbers
  int count = 0;               // number of values for several values; 0: any
  int least = 0;               // fewest of them, if fewer than count are allowed
  bool each_time = false;      // several values: one per occurrence of the option; otherwise also joined by commas
  bool words = false;          // several values: also as successive words on the command line
  bool makes_a_file = false;   // it adds a file to the results
  bool required = false;
  bool by_place = false;  // on the command line by its place, behind the scene, and required there
};

enum class OptionForm { flag, one, several };
struct DeclaredOption {
  OptionText text;
  OptionForm form = OptionForm::one;
};

// The values given for one option, for its reader. Errors throw std::invalid_argument with its name and the allowed
// values. Messages name options as the command line does; the library renders them for its callers.
class OptionValues {
 public:
  OptionValues(const DeclaredOption& option, std::vector<std::string> texts, const Scene& scene)
      : option_(option), texts_(std::move(texts)), scene_(scene) {}
  std::string label() const;        // "--mid-speed"
  const std::string& text() const;  // the single value
  const std::vector<std::string>& texts() const { return texts_; }
  const Scene& scene() const { return scene_; }
  [[noreturn]] void refuse(const std::string& text, const std::string& must) const;

  // After "step 2" of the operating sequence, at "1.5 s", or at a speed, which is stored in `speed` [rad/s].
  Moment moment(std::optional<double>& speed) const;
  void read(double& value) const;
  void read(std::string& value) const { value = text(); }
  void read(std::vector<std::string>& value) const { value = texts_; }
  void read(std::vector<double>& value) const;
  std::pair<double, double> range() const;  // two quantities, the lesser first
  void read(Effects& value) const;          // one text: names joined by commas
  template <class Whole>
  requires std::is_integral_v<Whole>
  void read(Whole& value) const { value = static_cast<Whole>(whole()); }
  template <class T>
  void read(std::optional<T>& value) const {
    read(value.emplace());
  }
  template <class T, std::size_t count>
  void read(std::array<T, count>& value) const {
    for (std::size_t k = 0; k < texts_.size(); ++k) OptionValues(option_, {texts_[k]}, scene_).read(value[k]);
  }

 private:
  double quantity(const std::string& text) const;
  std::int64_t whole() const;

  const DeclaredOption& option_;
  std::vector<std::string> texts_;
  const Scene& scene_;
};

// Finds the values of every option among those given. Throws std::invalid_argument for an undeclared option, with the
// declared ones, and for an option that is repeated without permission.
std::vector<std::optional<OptionValues>> values_of(const std::vector<DeclaredOption>& options,
                                                   const GivenOptions& given, const std::string& question,
                                                   const Scene& scene);

template <class T>
inline constexpr bool has_several = false;
template <class T>
inline constexpr bool has_several<std::vector<T>> = true;
template <class T, std::size_t count>
inline constexpr bool has_several<std::array<T, count>> = true;

// A double, or a list or an option of them: quantities, read by the unit of the example.
template <class T>
inline constexpr bool has_quantities = std::is_same_v<T, double>;
template <class T>
inline constexpr bool has_quantities<std::optional<T>> = has_quantities<T>;
template <class T>
inline constexpr bool has_quantities<std::vector<T>> = has_quantities<T>;
template <class T, std::size_t count>
inline constexpr bool has_quantities<std::array<T, count>> = has_quantities<T>;

template <class Asked>
class OptionsOf {
 public:
  using Reader = std::function<void(Asked&, const OptionValues&)>;

  template <class M, class B>
  OptionsOf& add(OptionText text, M B::*member) {
    if constexpr (has_quantities<M>) check_example(text);
    return add(std::move(text), has_several<M> ? OptionForm::several : OptionForm::one,
               [member](Asked& asked, const OptionValues& given) { given.read(asked.*member); });
  }
  // A flag; if given, the member has the value `given`.
  template <class B>
  OptionsOf& add(OptionText text, bool B::*member, bool given = true) {
    return add(std::move(text), OptionForm::flag, [=](Asked& asked, const OptionValues&) { asked.*member = given; });
  }
  // Words, each with its value.
  template <class M, class B, class V>
  OptionsOf& add(OptionText text, M B::*member, std::vector<std::pair<const char*, V>> words) {
    return add(std::move(text), OptionForm::one, [member, words](Asked& asked, const OptionValues& given) {
      std::string all;
      for (const auto& [word, value] : words) {
        if (given.text() == word) return void(asked.*member = value);
        all += (all.empty() ? "" : " or ") + std::string(word);
      }
      given.refuse(given.text(), all);
    });
  }
  // With its own reader.
  OptionsOf& add(OptionText text, OptionForm form, Reader reader) {
    declared_.push_back({std::move(text), form});
    readers_.push_back(std::move(reader));
    return *this;
  }
  // A group of options shared by several questions: for a base class of `Asked`, or for a member.
  template <class Part>
  OptionsOf& add(const OptionsOf<Part>& group) {
    for (std::size_t k = 0; k < group.declared().size(); ++k)
      add(group.declared()[k].text, group.declared()[k].form, Reader(group.readers()[k]));
    return *this;
  }
  template <class Part, class B>
  OptionsOf& add(const OptionsOf<Part>& group, Part B::*member) {
    for (std::size_t k = 0; k < group.declared().size(); ++k)
      add(group.declared()[k].text, group.declared()[k].form,
          [member, read = group.readers()[k]](Asked& asked, const OptionValues& given) { read(asked.*member, given); });
    return *this;
  }

  const std::vector<DeclaredOption>& declared() const { return declared_; }
  const std::vector<Reader>& readers() const { return readers_; }

  Asked read(const GivenOptions& given, const std::string& question, const Scene& scene) const {
    Asked asked;
    const auto values = values_of(declared_, given, question, scene);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k]) readers_[k](asked, *values[k]);
    return asked;
  }

 private:
  std::vector<DeclaredOption> declared_;
  std::vector<Reader> readers_;
};

}  // namespace kurbel
