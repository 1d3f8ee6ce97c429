// findings.h — results of a study, each stated once; terminal, JSON, page and table files are renderings of it (output.h).
//
//   Findings f{.title = "Size of the flywheel", .conclusion = "420 kg·m² keep δ below 0.05."};
//   const Chapter results = f.chapter("Results");   // chapters appear on the page in the order of declaration,
//   f.say(results, table_of(…).column(…));          // statements within them, and on the terminal, in the order of calls
//   f.draw(results, [&] { return plot_of(study); });
//   f.record("operating_point", Record{{"speed", 31.4}});
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/claims/headline.h"
#include "studies/data/data_table.h"
#include "studies/findings/report.h"
#include "studies/findings/rows.h"
#include "studies/findings/scene_study.h"

namespace kurbel {

// Version of summary.json: increased by one whenever programs that read it must change.
inline constexpr int summary_version = 3;

// Formulas with numbers inserted, in sequence.
class Formulas {
 public:
  // The formula "δ = (ω_max − ω_min)/ω_m"; the same with numbers inserted, and the result.
  template <class... Values>
  Formulas& add(std::string title, std::string symbols, fmt::format_string<Values...> numbers, Values&&... values) {
    cards_.push_back({.title = std::move(title),
                      .symbols = std::move(symbols),
                      .numbers = fmt::format(numbers, std::forward<Values>(values)...)});
    return *this;
  }
  // A note below the last one.
  Formulas& note(std::string words) { return cards_.back().note = std::move(words), *this; }

  const std::vector<FormulaCard>& cards() const { return cards_; }

 private:
  std::vector<FormulaCard> cards_;
};

// Sentences, one per line.
struct Sentences {
  std::vector<std::string> lines;
  std::string title = {};    // of the card on the page
  std::string heading = {};  // on the terminal
  std::string indent = {};   // on the terminal, before each line: "  note: "
  std::string key = {};      // of the list in JSON; empty: none
  bool terminal = true, page = true;
  bool apart = false;  // on the terminal, preceded by a blank line
};

enum class Chapter : std::size_t {};

using Cards = std::vector<Card>;

// Made only when a page is made, as plots are costly; or content for the page only.
struct Drawn {
  std::function<Cards()> cards;
};

struct Statement {
  std::optional<Chapter> chapter;  // on the page; none: not there
  std::variant<Rows, Sentences, Field, Drawn> what;
};

// One terminal screen: conclusion, subject, key figures, a few sentences, as many notes as fit.
struct Brief {
  std::string about;                    // one line
  Rows figures;                         // at most most_figures rows
  std::vector<std::string> words = {};  // one per line
  std::vector<std::string> notes = {};  // shortened if long
  std::string more = {};                // what the full output adds

  static constexpr std::size_t most_figures = 12, most_of_conclusion = 6, width = 110;
  static constexpr std::size_t most_lines = 23;  // two more lines name the files
};

// A key figure in the unit of its definition.
KeyFigure key_figure(std::string name, const Estimate& value, std::string means, std::string note = {}, int digits = 0);

struct Findings {
  // How the terminal's text begins.
  enum class Opening { conclusion, title_and_conclusion, title };

  std::string title, subtitle = {};
  std::string page_title = {};  // empty: the title
  std::string scene_file = {};  // for programs; empty: not given
  std::string speed_unit = {};  // unit of speeds for people, reported to programs; empty: no speeds
  Claims claims = {};           // the conclusion is made from them
  bool complete = true;
  std::string diagnosis = {};    // of a run that failed
  std::string unconfirmed = {};  // why the requested accuracy is not confirmed and what to try; empty: it is, or it was not requested
  Opening opening = Opening::conclusion;
  bool reports_diagnosis = true;  // to programs, if incomplete
  bool reports_complete = true;   // to programs; false for studies that are always complete
  std::string footer = {};        // versions
  std::vector<KeyFigure> figures = {};
  std::vector<std::string> chapters = {};
  std::vector<Statement> statements = {};
  std::vector<NamedTable> tables = {};
  std::optional<Brief> brief = {};  // short form for the terminal, unless all is requested; none: always the full form

  // Of a study, as far as they are the same for all.
  static Findings of(const SceneStudy& study, std::string subtitle) {
    return {.title = study.title,
            .subtitle = std::move(subtitle),
            .scene_file = study.scene_file,
            .complete = study.complete,
            .diagnosis = study.diagnosis};
  }

  // The same in terminal, page and JSON, on one line.
  std::string conclusion() const { return in_one_line(concluded(claims)); }
  void claim(std::optional<Claim> made) { add(claims, std::move(made)); }
  void claim(Predicate what, std::string sentence) { claim(claimed(what, std::move(sentence))); }
  void claim(Claims made) {
    claims.insert(claims.end(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
  }
  // The result of a study, in a sentence.
  void conclude(bool whole, std::string sentence) {
    claim(whole ? Predicate::figures_told : Predicate::incomplete, std::move(sentence));
  }

  void key(std::string name, const Estimate& value, std::string means, std::string note = {}, int digits = 0) {
    figures.push_back(key_figure(std::move(name), value, std::move(means), std::move(note), digits));
  }

  // A chapter without cards is not shown.
  Chapter chapter(std::string with_title) {
    chapters.push_back(std::move(with_title));
    return static_cast<Chapter>(chapters.size() - 1);
  }
  // The chapter with this title, added if there is none yet.
  Chapter chapter_named(const std::string& title) {
    const auto found = std::find(chapters.begin(), chapters.end(), title);
    return found == chapters.end() ? chapter(title) : static_cast<Chapter>(found - chapters.begin());
  }
  void say(Chapter in, Rows rows) { statements.push_back({in, std::move(rows)}); }
  void say(Chapter in, Sentences words) {
    for (std::string& line : words.lines) line = readable(line);
    statements.push_back({in, std::move(words)});
  }
  // On the page only.
  void show(Chapter in, Card card) {
    statements.push_back({in, Drawn{[cards = Cards{std::move(card)}] { return cards; }}});
  }
  void show(Chapter in, const Formulas& formulas) {
    for (const FormulaCard& formula : formulas.cards()) show(in, Card(formula));
  }
  // The same, evaluated when the page is made: a Plot, std::optional<Plot>, or list of plots.
  template <class Made>
  void draw(Chapter in, Made made) {
    statements.push_back({in, Drawn{[made = std::move(made)] { return cards_of(made()); }}});
  }
  // For programs only.
  void record(std::string key, Value value) {
    statements.push_back({std::nullopt, Field{std::move(key), std::move(value)}});
  }
  // Notes in terminal, JSON and page; for an incomplete study with what is missing.
  void note(Chapter in, const std::vector<std::string>& notes, const std::string& indent = "  ");
  // The scene's text, folded.
  void show_scene(const std::string& file, const std::string& text);

 private:
  static Cards cards_of(Cards cards) { return cards; }
  static Cards cards_of(Plot plot) { return {std::move(plot)}; }
  static Cards cards_of(std::optional<Plot> plot) { return plot ? cards_of(std::move(*plot)) : Cards{}; }
  static Cards cards_of(std::vector<Plot> plots) {
    return {std::make_move_iterator(plots.begin()), std::make_move_iterator(plots.end())};
  }
};

}  // namespace kurbel
