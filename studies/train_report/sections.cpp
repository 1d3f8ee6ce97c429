// sections.cpp — assigns statements of the questions to sections of the report.
#include "studies/train_report/sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "studies/claims/headline.h"
#include "studies/limits/verdicts.h"
#include "studies/modes/modes.h"
#include "studies/run/run_findings.h"

namespace kurbel::train_report {
namespace {

const Rows* rows_of(const Part& part, const std::string& key) {
  for (const Statement& s : part.output.statements)
    if (const Rows* rows = std::get_if<Rows>(&s.what); rows && rows->key == key) return rows;
  return nullptr;
}

std::string word_at(const Rows& rows, const std::string& key, std::size_t row) {
  for (const Column& column : rows.columns)
    if (column.key == key)
      if (const std::string* word = column.values[row].as<std::string>()) return *word;
  return {};
}

// "… (60: the scene as it is has no such torque; 8: …)"
void add_margins(const Part& modes, std::vector<std::string>& lines) {
  const Rows* rows = rows_of(modes, "margins");
  if (!rows) return;
  std::map<std::string, std::size_t> reasons;
  std::size_t all = 0;
  for (std::size_t i = 0; i < rows->count; ++i)
    if (const std::string why = word_at(*rows, "not_assessed", i); !why.empty()) ++reasons[why], ++all;
  if (all == 0) return;
  std::vector<std::string> words;
  for (const auto& [why, count] : reasons) words.push_back(fmt::format("{}: {}", count, why));
  lines.push_back(fmt::format(
      "the response of {} of the {} pairs of a mode and an excitation; their margins are in margins.csv ({})", all,
      rows->count, fmt::join(words, "; ")));
}

const char* const limit_keys[] = {"verdicts", "ratings"};

bool is_open(const Rows& rows, std::size_t i) {
  return word_at(rows, "verdict", i) == name_of(Compliance::not_assessed);
}

// A limit in a load case left open by one question and assessed by another counts as assessed.
bool is_judged(const std::vector<Part>& parts, const Rows& limits, std::size_t i) {
  for (const Part& part : parts)
    for (const char* key : limit_keys) {
      const Rows* rows = rows_of(part, key);
      for (std::size_t k = 0; rows && k < rows->count; ++k) {
        const auto same = [&](const char* column) { return word_at(*rows, column, k) == word_at(limits, column, i); };
        if (!is_open(*rows, k) && same("component") && same("requirement") && same("load_case")) return true;
      }
    }
  return false;
}

// A run's limits without those that it leaves open and another question assesses.
void omit_judged_limits(const std::vector<Part>& parts, Rows& limits) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < limits.count; ++i)
    if (!is_open(limits, i) || !is_judged(parts, limits, i)) shown.push_back(i);
  limits.for_people = std::move(shown), limits.title += " in the simulated run";
}

// Limits that a part leaves open and no part assesses; or those that another part assesses.
std::vector<Verdict> open_limits(const std::vector<Part>& parts, const Part& part, bool judged = false) {
  std::vector<Verdict> list;
  for (const char* key : limit_keys) {
    const Rows* rows = rows_of(part, key);
    for (std::size_t i = 0; rows && i < rows->count; ++i)
      if (is_open(*rows, i) && is_judged(parts, *rows, i) == judged)
        list.push_back(kurbel::not_assessed(word_at(*rows, "component", i), word_at(*rows, "requirement", i), 0, "",
                                            word_at(*rows, "load_case", i).c_str(), word_at(*rows, "note", i)));
  }
  return list;
}

constexpr std::string_view not_assessed_words = "not assessed: ";  // verdicts.h: sentence_of

void erase_words(const std::string& words, std::string& text) {
  if (const std::size_t at = text.find(words); at != std::string::npos) text.erase(at, words.size());
}

// A claim on limits with those alone not assessed that are left `open` by all parts; empty: it is on a `judged` one.
std::optional<Claim> with_open(const std::vector<Verdict>& open, const std::vector<Verdict>& judged, Claim claim) {
  const std::string left = sentence_of(open, "");
  const std::size_t cut = claim.text.find("; " + std::string(not_assessed_words));
  if (cut != std::string::npos) {
    claim.text.resize(cut);
    if (!left.empty()) claim.text += "; " + left;
    if (!left.empty()) return claim;
    for (const char* words : {" that is assessed", " that are assessed"}) erase_words(words, claim.text);
    return claim;
  }
  if (claim.predicate != Predicate::not_assessed) return claim;
  if (claim.text.starts_with(capitalised(std::string(not_assessed_words)))) {
    if (open.empty()) return {};
    claim.text = capitalised(left), claim.of = open.front().component, claim.load_case = open.front().load_case;
    return claim;
  }
  const bool is_judged = std::any_of(judged.begin(), judged.end(), [&](const Verdict& v) {
    return sentence_of({v}, "") == std::string(not_assessed_words) + claim.text.substr(0, claim.text.rfind(": "));
  });
  return is_judged ? std::nullopt : std::optional(claim);
}

bool is_bad_limit(const Claim& claim) { return claim.predicate == Predicate::limit_exceeded; }

void add_notes(const Part& part, std::vector<std::string>& lines) {
  static const std::string begin = "not assessed";
  for (const Statement& s : part.output.statements)
    if (const Sentences* words = std::get_if<Sentences>(&s.what); words && words->key == "notes")
      for (const std::string& line : words->lines)
        if (line.starts_with(begin)) {
          const std::size_t behind = line.find_first_not_of(" ,:", begin.size());
          lines.push_back(behind == std::string::npos ? line : line.substr(behind));
        }
}

// What an analyst may set to get more follows the statement: "…; --orders gives more".
std::string without_hint(const std::string& line) {
  return line.substr(0, std::min(line.find("; --"), line.find("; samples = ")));
}

// By another question, in the report.
bool is_said(const Findings& report, const std::string& line) {
  return std::any_of(report.statements.begin(), report.statements.end(), [&](const Statement& statement) {
    const Sentences* words = std::get_if<Sentences>(&statement.what);
    return words && std::find(words->lines.begin(), words->lines.end(), line) != words->lines.end();
  });
}

const std::string* text_in(const Record& record, const std::string& key) {
  for (const Field& field : record)
    if (field.key == key) return field.value.as<std::string>();
  return nullptr;
}

}  // namespace

const Value* reported(const Part& part, const std::string& key) {
  for (const Statement& s : part.output.statements)
    if (const Field* field = std::get_if<Field>(&s.what); field && field->key == key) return &field->value;
  return nullptr;
}

std::optional<Place> section_of(const std::string& question, const std::string& chapter, const Statement& statement) {
  const Rows* rows = std::get_if<Rows>(&statement.what);
  if (rows && rows->key == "ratings") return Place::response;
  if (rows && rows->key == "comparison") return Place::input;
  if (rows && question == "run" && !rows->means.empty()) return Place::input;  // all figures
  if (chapter == "Scene") return {};
  if (chapter == "Notes") return Place::assumptions;
  if (question == "modes") {
    if (chapter == modes_chapter::modes) return Place::modes;
    if (chapter == modes_chapter::margins) return Place::margins;
    return chapter == modes_chapter::history ? Place::time : Place::response;
  }
  if (chapter.empty()) return Place::train;
  if (chapter == chapter_of_trials) return Place::assumptions;
  return chapter == chapter_of_cost || chapter == chapter_of_model ? Place::input : Place::time;
}

void take(const std::vector<Part>& parts, const Part& part, const std::vector<bool>& wanted,
          const std::vector<Chapter>& chapters, Findings& report) {
  const StudyOutput& from = part.output;
  for (const Statement& statement : from.statements) {
    if (!statement.chapter) continue;
    const auto section =
        section_of(part.question, from.chapters[static_cast<std::size_t>(*statement.chapter)], statement);
    if (!section || !wanted[static_cast<std::size_t>(*section)]) continue;
    Statement taken = statement;
    taken.chapter = chapters[static_cast<std::size_t>(*section)];
    if (Rows* rows = std::get_if<Rows>(&taken.what)) {
      if (rows->key == "ratings") omit_judged_limits(parts, *rows);
      rows->key.clear(), rows->terminal = rows->folded = false;
      if (section == Place::input) rows->means.clear();  // the dictionary explains them; key figures are explained here
    }
    if (Sentences* words = std::get_if<Sentences>(&taken.what)) {
      words->key.clear(), words->terminal = false;
      for (std::string& line : words->lines) line = without_hint(line);
      std::erase_if(words->lines, [&](const std::string& line) { return is_said(report, line); });
    }
    report.statements.push_back(std::move(taken));
  }
}

std::string title_of(Place section, bool elastic) {
  const std::string title = section_names[static_cast<std::size_t>(section)].title;
  return section == Place::time && !elastic ? title.substr(0, title.find(';')) : title;
}

std::string why_no_verdict(const Claims& claims) {
  const bool judged =
      std::any_of(claims.begin(), claims.end(), [](const Claim& claim) { return claim.topic() == Topic::bears; });
  return judged ? "" : "none is possible: the scene states no limit that this report assesses";
}

bool is_empty(const Findings& report, Chapter chapter) {
  return std::none_of(report.statements.begin(), report.statements.end(), [&](const Statement& statement) {
    const Rows* rows = std::get_if<Rows>(&statement.what);
    const Sentences* words = std::get_if<Sentences>(&statement.what);
    const bool shown = rows    ? rows->page && rows->shown_to_people()
                       : words ? words->page && !words->lines.empty()
                               : !std::holds_alternative<Field>(statement.what);
    return statement.chapter == chapter && shown;
  });
}

std::string why_empty(const std::vector<Part>& parts, Place section) {
  const bool of_modes = section == Place::modes || section == Place::margins || section == Place::response;
  for (const Part& part : parts)
    if (!part.assessed() && (part.question == "modes") == of_modes)
      return fmt::format("{}: {}.", part.why == nothing_elastic ? "Does not apply" : "Not assessed", part.why);
  return "Nothing to report.";
}

Claims claims_of(const std::vector<Part>& parts) {
  std::vector<Claims> of_parts;
  Claims all;
  for (const Part& part : parts) {
    Claims& own = of_parts.emplace_back();
    if (!part.assessed()) continue;
    // Limits that another part has judged alike are reported once.
    const bool alike = std::all_of(part.output.claims.begin(), part.output.claims.end(), [&](const Claim& claim) {
      return claim.predicate != Predicate::limit_held ||
             std::any_of(all.begin(), all.end(), [&](const Claim& reported) {
               return reported.predicate == claim.predicate && reported.of == claim.of &&
                      reported.load_case == claim.load_case;
             });
    });
    const std::vector<Verdict> open = open_limits(parts, part), judged = open_limits(parts, part, true);
    for (const Claim& claim : part.output.claims) {
      if (alike && claim.predicate == Predicate::limit_held) continue;
      add(own, with_open(open, judged, claim));
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  // That all limits hold is said of one part where another exceeds some.
  all.clear();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool others = std::any_of(of_parts.begin(), of_parts.end(), [&](const Claims& claims) {
      return &claims != &of_parts[i] && std::any_of(claims.begin(), claims.end(), is_bad_limit);
    });
    if (others)
      hold_under(parts[i].question == "modes" ? "in the frequency domain" : "in the simulated run", of_parts[i]);
    all.insert(all.end(), of_parts[i].begin(), of_parts[i].end());
  }
  return all;
}

std::vector<std::string> not_assessed(const std::vector<Part>& parts) {
  std::vector<std::string> lines;
  for (const Part& part : parts) {
    if (!part.assessed()) {
      lines.push_back(fmt::format("results of kurbel {}: {}", part.question, part.why));
      continue;
    }
    if (!part.output.complete) lines.push_back(fmt::format("{}: {}", part.question, part.output.diagnosis));
    for (const Verdict& open : open_limits(parts, part))
      lines.push_back(fmt::format("{}, {} ({}): {}", open.component, open.requirement, open.load_case, open.note));
    add_margins(part, lines);
    add_notes(part, lines);
    if (const Value* cases = reported(part, "cases"))
      for (const Value& one : *cases->as<List>())
        if (const std::string* why = text_in(*one.as<Record>(), "not_assessed"))
          lines.push_back(fmt::format("the case {}: {}", *text_in(*one.as<Record>(), "name"), *why));
  }
  std::vector<std::string> once;
  for (std::string& line : lines)
    if (std::find(once.begin(), once.end(), line) == once.end()) once.push_back(std::move(line));
  return once;
}

}  // namespace kurbel::train_report
