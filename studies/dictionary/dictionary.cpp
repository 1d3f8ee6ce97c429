// dictionary.cpp — assembles the entries and looks up names and words.
#include "studies/dictionary/dictionary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <unordered_map>

#include "engine/scene/text.h"
#include "engine/scene/units.h"
#include "studies/dictionary/own_entries.h"
#include "studies/dictionary/page_words.h"
#include "studies/dictionary/run_entries.h"
#include "studies/dictionary/study_entries.h"
#include "studies/dictionary/symbols.h"

namespace kurbel {
namespace {

// "bending_1" matches "bending_*"; in names the star ends at a point, after which the owner follows.
bool fits(std::string_view pattern, std::string_view name, char star_ends_at = '.') {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  if (!name.starts_with(pattern.substr(0, star))) return false;
  const std::string_view behind = pattern.substr(star + 1);
  for (std::size_t at = star; at <= name.size(); ++at) {
    if (fits(behind, name.substr(at), star_ends_at)) return true;
    if (at < name.size() && name[at] == star_ends_at) break;
  }
  return false;
}

// Converts a request to the form of names: "Mean speed" → "mean_speed".
std::string as_name(std::string_view text) {
  std::string name;
  for (const char c : text) name += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

bool has_star(const Definition& d) { return d.name.find('*') != std::string_view::npos; }

const Definition* find(std::string_view name) {
  static const std::unordered_map<std::string_view, const Definition*> in_full = [] {
    std::unordered_map<std::string_view, const Definition*> known;
    for (const Definition& d : dictionary())
      if (!has_star(d)) known.emplace(d.name, &d);
    return known;
  }();
  if (const auto known = in_full.find(name); known != in_full.end()) return known->second;
  for (const Definition& d : dictionary())
    if (has_star(d) && fits(d.name, name)) return &d;
  return nullptr;
}

// What a name says of a channel before it, functional ∘ window: "cycle_peak_", "step_mean_".
struct Composed {
  const Definition* channel = nullptr;
  std::string says = {};  // "its greatest magnitude in one steady cycle, with its sign"
};
Composed composed(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> windows[] = {{"cycle_", "one steady cycle"},
                                                                       {"step_", "one step of the operating sequence"},
                                                                       {"run_up_", "the run-up"},
                                                                       {"steady_motion_", "the steady motion of a run"},
                                                                       {"run_down_", "the run-down"},
                                                                       {"run_", "a whole run"},
                                                                       {"", "a whole run"}};
  constexpr std::pair<std::string_view, std::string_view> functionals[] = {
      {"peak_", "its greatest magnitude in {}, with its sign"},
      {"max_", "its greatest value in {}"},
      {"min_", "its least value in {}"},
      {"mean_", "its mean over time in {}"},
      {"rms_", "the root of its mean square over time in {}"},
      {"", "the same in {}"}};
  for (const auto& [window, where] : windows)
    for (const auto& [functional, says] : functionals) {
      const std::string prefix = fmt::format("{}{}", window, functional);
      if (prefix.empty() || !name.starts_with(prefix)) continue;
      if (const Definition* channel = find(name.substr(prefix.size())))
        return {channel, fmt::format(fmt::runtime(says), where)};
    }
  return {};
}

// The same, including functionals of channels that have no words of their own.
const Definition* find_composed(std::string_view name) {
  const Definition* const found = find(name);
  return found ? found : composed(name).channel;
}

// "I₀", "I_0"; "ω²" and "I_r(φ)" of a formula are ω and I_r.
std::string as_symbol(std::string_view text) {
  std::string symbol;
  for (std::size_t i = 0; i < text.size() && text[i] != '('; ++i) {
    constexpr std::string_view below = "₀", squared = "²";  // the digits' last bytes ascend
    if (text.substr(i).starts_with(squared)) {
      ++i;
    } else if (text.substr(i).starts_with(below.substr(0, 2)) && i + 2 < text.size() &&
               static_cast<unsigned char>(text[i + 2]) < 0x8A) {
      symbol += fmt::format("_{}", static_cast<unsigned char>(text[i + 2]) - 0x80);
      i += 2;
    } else {
      symbol += text[i];
    }
  }
  return symbol;
}

// One without a star goes first. Any small letter may be a point of a plan.
const Definition* find_symbol(std::string_view asked) {
  const std::string symbol = as_symbol(asked);
  for (const bool starred : {false, true})
    for (const Definition& d : entries::of_symbols)
      if (has_star(d) == starred && fits(d.name, symbol)) return &d;
  if (symbol.size() == 1 && std::islower(static_cast<unsigned char>(symbol[0]))) return find_symbol("*′");
  const std::size_t index = symbol.find_first_of("0123456789");  // on paper it is lowered: "R12"
  const bool has_index = index > 0 && index < symbol.size() && symbol.find('_') == std::string::npos &&
                         symbol.find_first_not_of("0123456789", index) == std::string::npos;
  return has_index && characters(symbol.substr(0, index)) == 1
             ? find_symbol(symbol.substr(0, index) + "_" + symbol.substr(index))
             : nullptr;
}

// What a page calls a figure.
const Definition* find_label(std::string_view asked) {
  for (const entries::Label& l : entries::labels)
    if (asked.starts_with(l.begin) && asked.ends_with(l.end) &&
        (!l.number || asked.find_first_of("0123456789") == l.begin.size()))
      return find(l.name);
  return asked.starts_with("largest ") && asked.find(" on ") != std::string_view::npos ? find("reaction") : nullptr;
}

// What stands on pages beside figures and symbols: of all names that fit the longest.
const Definition* find_page_word(std::string_view asked, bool starred) {
  struct Named {
    std::string_view name;
    Definition meaning;
  };
  static const std::vector<Named> words = [] {
    std::vector<Named> list;
    for (const entries::PageWord& w : entries::of_pages)
      for (std::size_t at = 0; at < w.names.size();) {
        const std::size_t end = std::min(w.names.find("; ", at), w.names.size());
        const std::string_view name = w.names.substr(at, end - at);
        list.push_back({name, {.name = name, .words = word_of_pages, .verbs = w.verbs, .is = w.is}});
        at = end + 2;
      }
    return list;
  }();
  const Named* found = nullptr;
  for (const Named& w : words)
    if (has_star(w.meaning) == starred && (!found || w.name.size() > found->name.size()) && fits(w.name, asked, '\0'))
      found = &w;
  return found ? &found->meaning : nullptr;
}

}  // namespace

const std::vector<Definition>& dictionary() {
  static const std::vector<Definition> all = [] {
    std::vector<Definition> list;
    for (const std::span<const Definition> rows :
         {std::span<const Definition>(entries::of_channels_and_runs), std::span<const Definition>(entries::of_a_cycle),
          std::span<const Definition>(entries::of_one_study), std::span<const Definition>(entries::of_elements)})
      list.insert(list.end(), rows.begin(), rows.end());
    return list;
  }();
  return all;
}

std::string Definition::form() const { return of.empty() ? std::string(name) : fmt::format("{}.{}", name, of); }

std::string Definition::text() const {
  std::string text(is);
  if (!formula.empty()) text += fmt::format("; {}", formula);
  text += '.';
  if (!is_not.empty()) text += fmt::format(" Not: {}.", is_not);
  if (!theory.empty()) text += fmt::format(" (theory {})", theory);
  return text;
}

bool Definition::is_printed_by(std::string_view verb) const {
  for (std::size_t at = 0; at < verbs.size();) {
    const std::size_t end = std::min(verbs.find(", ", at), verbs.size());
    if (verbs.substr(at, end - at) == verb) return true;
    at = end + 2;
  }
  return false;
}

const Definition* definition_of(const QuantityKind& what) {
  const std::string name = word(what);
  return name.empty() ? nullptr : find(name);
}

const Definition* definition_of(std::string_view name) {
  if (const Definition* whole = find_composed(name)) return whole;
  return find_composed(name.substr(0, name.find('.')));
}

const Definition* definition_of(const Name& name) {
  if (const Definition* known = definition_of(name.what)) return known;
  std::string_view own = name.text;
  if (!name.of.empty() && own.size() > name.of.size()) own.remove_suffix(name.of.size() + 1);
  return definition_of(own);
}

std::string said_of_channel(std::string_view name) {
  const std::string_view what = name.substr(0, name.find('.'));
  return find(name) || find(what) ? std::string{} : composed(what).says;
}

const Definition* meant_by(std::string_view asked) {
  if (const Definition* named = definition_of(asked)) return named;
  if (const Definition* word = find_page_word(asked, false)) return word;
  if (const Definition* symbol = find_symbol(asked)) return symbol;
  if (const Definition* label = find_label(asked)) return label;
  const std::string name = as_name(asked);
  if (const Definition* named = definition_of(name)) return named;
  for (const Definition& d : dictionary())
    if (as_name(d.words) == name) return &d;
  if (const Definition* word = find_page_word(asked, true)) return word;
  // "speed fluctuation", "δ": the begin of the words, or the symbol at their end.
  const bool symbol = !name.empty() && static_cast<unsigned char>(name[0]) >= 0x80;
  for (const Definition& d : dictionary()) {
    const std::string words = as_name(d.words);
    if (!name.empty() && (words.starts_with(name + "_") || (symbol && words.ends_with("_" + name)))) return &d;
  }
  // "peak torque, main_coupling", "thermal use of motor", "steps [1]": its begin; "press.load (useful)", "shaft: k = 2": the
  // end; "driving torque M_d": the symbol.
  for (const std::string_view owned : {" [", " (", ": ", " = ", ", ", " of "})
    if (const std::size_t end = asked.find(owned); end != std::string_view::npos) {
      if (const Definition* begin = meant_by(asked.substr(0, end))) return begin;
      if (owned != " (" && owned != ": ") continue;
      const std::string_view rest = asked.substr(end + 2);
      if (const Definition* of_end = meant_by(rest.substr(0, rest.size() - (owned == " (")))) return of_end;
    }
  if (constexpr std::string_view greatest = "greatest "; asked.starts_with(greatest))
    return meant_by(asked.substr(greatest.size()));
  const std::size_t last = asked.rfind(' ');
  return last == std::string_view::npos ? nullptr : find_symbol(asked.substr(last + 1));
}

std::string stated_instead(std::string_view asked, const std::vector<std::string>& names) {
  const std::string_view what = asked.substr(0, asked.find('.'));
  const std::string owner(asked.substr(what.size()));
  std::vector<std::string> others = {"cycle_" + std::string(what)};
  if (what.starts_with("cycle_")) others.emplace_back(what.substr(std::string_view("cycle_").size()));
  const std::string delta = word(quantities::delta), fluctuation = word(quantities::cycle_fluctuation);
  if (what == delta) others.push_back(fluctuation);
  if (what == fluctuation) others.push_back(delta);
  for (const std::string& other : others)
    for (const std::string& name : names)
      if (name == other + owner || (owner.empty() && name.starts_with(other + "."))) return name;
  return {};
}

std::vector<std::string> names_like(std::string_view asked, std::size_t most) {
  const std::string name = as_name(asked.substr(0, asked.find('.')));
  std::vector<std::string> names, like;
  for (const Definition& d : dictionary())
    if (!has_star(d)) names.emplace_back(d.name);
  const auto take = [&](const std::string& one) {
    if (like.size() < most && std::find(like.begin(), like.end(), one) == like.end()) like.push_back(one);
  };
  if (const auto near = nearest(name, names)) take(*near);
  for (const std::string& one : names)
    if (name.size() > 2 && (one.find(name) != std::string::npos || name.find(one) != std::string::npos)) take(one);
  // A word within the name: "torque", "speed".
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find('_', at), name.size());
    const std::string part = name.substr(at, end - at);
    for (const std::string& one : names)
      if (part.size() > 3 && one.find(part) != std::string::npos) take(one);
    at = end + 1;
  }
  return like;
}

}  // namespace kurbel
