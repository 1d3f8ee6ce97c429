// sections.h — the sections of a train's report, and which statement of which question stands in which.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "studies/findings/output.h"

namespace kurbel::train_report {

enum class Place : std::size_t { scope, train, modes, margins, response, time, assumptions, input };
struct SectionName {
  const char *word, *title;  // for --sections; of the document
};
inline constexpr std::array<SectionName, 8> section_names = {{
    {"scope", "1 Scope, verdict, and what was not assessed"},
    {"train", "2 The train: drawing, mass–elastic data, sources and tolerances"},
    {"modes", "3 Undamped torsional modes, damping"},
    {"margins", "4 Campbell diagram and separation margins"},
    {"response", "5 Forced response, ratings with their load cases"},
    {"time", "6 Starts, stops and the sequence in time; rigid against elastic"},
    {"assumptions", "7 Assumptions, and effects that are off"},
    {"input", "8 Appendix: input"},
}};

// What a question answered, or why it could not.
struct Part {
  std::string question;  // "modes"
  StudyOutput output = {};
  std::string why = {};  // not assessed; empty: it was
  bool assessed() const { return why.empty(); }
};

// Which chapter of a part each statement goes to; none: it is not taken.
std::optional<Place> section_of(const std::string& question, const std::string& chapter, const Statement& statement);

// Takes what the part says of its sections that are `wanted` into chapters of the report; `chapters` by Place.
void take(const Part& part, const std::vector<bool>& wanted, const std::vector<Chapter>& chapters, Findings& report);

// Of all parts; where every limit that one leaves open is judged by another, none is said to be open.
Claims claims_of(const std::vector<Part>& parts);

// A line each: what the parts could not assess, and what the scene says nothing of.
std::vector<std::string> not_assessed(const std::vector<Part>& parts);

// What a part says to programs under a key; null: nothing.
const Value* told(const Part& part, const std::string& key);

}  // namespace kurbel::train_report
