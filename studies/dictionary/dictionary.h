// dictionary.h — what a figure means: one definition in all commands, asked for by its quantity or by its name.
//
//     const Definition* d = definition_of(quantities::delta);   // of a typed quantity
//     const Definition* d = definition_of("delta.press");         // as it is printed
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/elements/quantity.h"

namespace kurbel {

struct Definition {
  std::string_view name = {};     // as the figure's name begins: "delta"; a star stands for any part: "bending_*"
  std::string_view words = {};    // "speed fluctuation δ"
  std::string_view unit = {};     // SI; empty: a plain number
  std::string_view of = {};       // whose it is, behind the point: "shaft"; empty: the machine's, nothing stands behind
  std::string_view theory = {};   // "2.6": page 2, equation 6; "15": a page; empty: none
  std::string_view verbs = {};    // that print it: "run, compare"; empty: none does
  std::string_view is = {};       // what it is
  std::string_view formula = {};  // empty: there is none
  std::string_view is_not = {};   // what it is taken for; empty: nothing

  // "delta.SHAFT"
  std::string form() const;
  // The definition and what stands beside it, in sentences.
  std::string text() const;
  bool is_printed_by(std::string_view verb) const;
};

// All of them: of channels, of runs, of steady cycles, of the other studies.
const std::vector<Definition>& dictionary();

// Null for quantities::other and its peaks, whose words are the element's own.
const Definition* definition_of(const QuantityKind& what);
// Of a figure, a channel or what a study calls its own: "delta.press", "delta", "peak_current.motor"; null: none.
const Definition* definition_of(std::string_view name);
// Of a typed name, whose owner is known.
const Definition* definition_of(const Name& name);

// What a person may mean by it: its name as above, its words: "mean speed", a symbol: "R_12", "δ", or what a page calls it:
// "peak torque, main_coupling".
const Definition* meant_by(std::string_view asked);
// Under which of these names a figure is told that is not told under the one asked for: δ of motion that does not
// repeat, what is of a whole run and of a cycle; empty: under none.
std::string told_instead(std::string_view asked, const std::vector<std::string>& names);

// Names that are like it, nearest first; at most so many.
std::vector<std::string> names_like(std::string_view asked, std::size_t most);

}  // namespace kurbel
