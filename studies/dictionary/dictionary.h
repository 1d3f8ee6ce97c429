// dictionary.h — the meaning of a figure: one definition for all commands, found by its quantity or by its name.
//
//     const Definition* d = definition_of(quantities::delta);   // by typed quantity
//     const Definition* d = definition_of("delta.press");         // by printed name
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/elements/quantity.h"

namespace kurbel {

struct Definition {
  std::string_view name = {};     // how the figure's name begins: "delta"; a star stands for any part: "bending_*"
  std::string_view words = {};    // "speed fluctuation δ"
  std::string_view unit = {};     // SI; empty: a plain number
  std::string_view of = {};       // owner, after the point: "shaft"; empty: the machine, nothing follows
  std::string_view theory = {};   // "2.6": page 2, equation 6; "15": a page; empty: none
  std::string_view verbs = {};    // commands that print it: "run, compare"; empty: none
  std::string_view is = {};       // what it is
  std::string_view formula = {};  // empty: there is none
  std::string_view is_not = {};   // what it may be confused with; empty: nothing

  // "delta.SHAFT"
  std::string form() const;
  // The complete entry, in sentences.
  std::string text() const;
  bool is_printed_by(std::string_view verb) const;
};

// All of them: of channels, of runs, of steady cycles, of the other studies.
const std::vector<Definition>& dictionary();

// Null for quantities::other and its peaks, which are described by the element.
const Definition* definition_of(const QuantityKind& what);
// Of a figure, a channel or a study's own name: "delta.press", "delta", "peak_current.motor"; null: none.
const Definition* definition_of(std::string_view name);
// Of a typed name with known owner.
const Definition* definition_of(const Name& name);

// Of a figure that is a functional of a channel over a window, without words of its own, what its name says of the channel:
// "its greatest magnitude in one steady cycle, with its sign"; empty for others.
std::string said_of_channel(std::string_view name);

// What a person may mean by it: its name as above, its words: "mean speed", a symbol: "R_12", "δ", or what a page calls it:
// "peak torque, main_coupling".
const Definition* meant_by(std::string_view asked);
// The one of `names` that replaces a figure not given under `asked`: δ of motion that does not repeat; figures of a
// whole run and of a cycle; empty: none.
std::string stated_instead(std::string_view asked, const std::vector<std::string>& names);

// Similar names, nearest first, at most `most`.
std::vector<std::string> names_like(std::string_view asked, std::size_t most);

}  // namespace kurbel
