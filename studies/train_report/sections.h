// sections.h — sections of a train's report, and the assignment of the questions' statements to them.
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
    {"input", "8 Appendix: all figures, numerics, input"},
}};

// Without an elastic part there is no elastic machine to set against the rigid one.
std::string title_of(Place section, bool elastic);

// The answer to a question, or why there is none.
struct Part {
  std::string question;  // "modes"
  StudyOutput output = {};
  std::string why = {};  // reason; empty: assessed
  bool assessed() const { return why.empty(); }
};

// The section for a statement of a part's chapter; empty: it is not used.
std::optional<Place> section_of(const std::string& question, const std::string& chapter, const Statement& statement);

// Copies the statements of the `wanted` sections into chapters of the report; `chapters` by Place.
void take(const std::vector<Part>& parts, const Part& part, const std::vector<bool>& wanted,
          const std::vector<Chapter>& chapters, Findings& report);

// Claims of all parts; a part's open limits are not mentioned if other parts assess all of them.
Claims claims_of(const std::vector<Part>& parts);

// One line each: what the parts could not assess, and what the scene does not specify.
std::vector<std::string> not_assessed(const std::vector<Part>& parts);

// Empty: the conclusion states one on limits or margins.
std::string why_no_verdict(const Claims& claims);

// For a section without a statement.
inline constexpr const char* nothing_elastic = "the machine has no elastic part";
bool is_empty(const Findings& report, Chapter chapter);
std::string why_empty(const std::vector<Part>& parts, Place section);

// The value of a part for programs under a key; null: none.
const Value* reported(const Part& part, const std::string& key);

}  // namespace kurbel::train_report
