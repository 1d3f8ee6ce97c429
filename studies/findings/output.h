// output.h — renderings of a study's findings: text for the terminal, JSON, a page, tables.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/findings/report.h"

namespace kurbel {

// The renderings of findings, each in its own file: render_terminal.cpp, render_json.cpp, render_page.cpp.
// `all_digits`: nine digits of figures instead of six, and every row of every table.
std::string terminal_text(const Findings& findings, bool all_digits = false);
// Short form: at most Brief::most_lines lines of Brief::width columns; empty if there is none.
std::string brief_text(const Findings& findings);
// A sentence a line, as terminal_text has it.
std::string conclusion_text(const Findings& findings);
// Sentence by sentence on lines of at most Brief::width columns, as brief_text has it.
std::string headline_text(const Findings& findings);
// The contents of summary.json.
Record summary_of(const Findings& findings);
Report page_of(const Findings& findings);

// Findings with all that belongs to them; rendered on request.
struct StudyOutput : Findings {
  std::vector<std::pair<std::string, std::string>> files = {};  // other than tables: name and text
  std::string next = {};  // next step for the user when files are written: {scene}, {summary} stand for their names
  std::shared_ptr<const void> study = {};  // data of page and files, if owned here
  std::string aside = {};                  // said beside the results, no part of them
  std::string words = {};                  // an answer in words: shown as it is, no files; programs get the summary

  std::string text(bool all_digits = false) const { return words.empty() ? terminal_text(*this, all_digits) : words; }
  std::string json() const { return json_text(summary_of(*this)); }
  Report report() const { return page_of(*this); }
};

inline StudyOutput in_words(std::string words) {
  StudyOutput output;
  output.words = std::move(words);
  return output;
}

// For a study with a function findings_of. An lvalue must outlive the output; an rvalue is kept by it.
template <class Study>
requires requires(const std::remove_reference_t<Study>& s) {
  { findings_of(s) } -> std::same_as<Findings>;
}
StudyOutput output_of(Study&& study) {
  if constexpr (std::is_lvalue_reference_v<Study>) {
    return {findings_of(study)};
  } else {
    const auto kept = std::make_shared<const Study>(std::move(study));
    return {findings_of(*kept), {}, {}, kept};
  }
}

}  // namespace kurbel
