// findings.h — what a study found, each thing said once; terminal, JSON, page and files of tables are renderings of it (output.h).
//
//   Findings f{.title = "Size of the flywheel", .conclusion = "420 kg·m² keep δ below 0.05."};
//   const Chapter results = f.chapter("Results");   // chapters stand on the page as they are declared,
//   f.say(results, table_of(…).column(…));          // statements within them, and on the terminal, as they are said
//   f.draw(results, [&] { return plot_of(study); });
//   f.tell("operating_point", Record{{"speed", 31.4}});
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/claims/conclusion.h"
#include "studies/data/data_table.h"
#include "studies/findings/formulas.h"
#include "studies/findings/report.h"
#include "studies/findings/rows.h"

namespace kurbel {

// Of summary.json: one higher whenever a program that reads it has to change.
inline constexpr int summary_version = 2;

// Sentences, a line each.
struct Sentences {
  std::vector<std::string> lines;
  std::string title = {};    // of the card on the page
  std::string heading = {};  // on the terminal, above
  std::string indent = {};   // on the terminal, before each: "  note: "
  std::string key = {};      // of the list in JSON; empty: none
  bool terminal = true, page = true;
  bool apart = false;  // on the terminal, by a blank line before it
};

enum class Chapter : std::size_t {};

using Cards = std::vector<Card>;

// Made only when a page is: plots cost. Or what is for the page alone.
struct Drawn {
  std::function<Cards()> cards;
};

struct Statement {
  std::optional<Chapter> chapter;  // of the page; none: not on it
  std::variant<Rows, Sentences, Field, Drawn> what;
};

// A screen of a terminal: the conclusion, what it is about, key figures, a few words, as many notes as fit.
struct Brief {
  std::string about;                    // one line
  Rows figures;                         // at most most_figures rows
  std::vector<std::string> words = {};  // a line each
  std::vector<std::string> notes = {};  // shortened where they are long
  std::string more = {};                // what all of it has besides

  static constexpr std::size_t most_figures = 12, most_of_conclusion = 6, width = 110;
  static constexpr std::size_t most_lines = 23;  // two more tell where the files are
};

// In the unit of its definition.
KeyFigure key_figure(std::string name, const Estimate& value, std::string means, std::string note = {}, int digits = 0);

struct Findings {
  // What the terminal's text begins with.
  enum class Opening { conclusion, title_and_conclusion, title };

  std::string title, subtitle = {};
  std::string page_title = {};  // empty: the title
  std::string scene_file = {};  // for programs; empty: not told
  std::string speed_unit = {};  // that people are told speeds in, for programs; empty: there are none
  Claims claims = {};           // what the conclusion is made of
  bool complete = true;
  std::string diagnosis = {};    // of a run that failed on its way
  std::string unconfirmed = {};  // why the accuracy asked for is not sure; empty: it is, or none was to be confirmed
  Opening opening = Opening::conclusion;
  bool tells_diagnosis = true;  // to programs, of what is incomplete
  bool tells_complete = true;   // to programs; not by those that are always complete
  std::string footer = {};      // versions
  std::vector<KeyFigure> figures = {};
  std::vector<std::string> chapters = {};
  std::vector<Statement> statements = {};
  std::vector<NamedTable> tables = {};
  std::optional<Brief> brief = {};  // what a terminal is told unless all is asked for; none: all

  // The same in terminal, page and JSON, in one line.
  std::string conclusion() const { return in_one_line(concluded(claims)); }
  void claim(std::optional<Claim> made) { add(claims, std::move(made)); }
  void claim(Predicate what, std::string sentence) { claim(claimed(what, std::move(sentence))); }
  void claim(Claims made) {
    claims.insert(claims.end(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
  }
  // What a study comes to, in a sentence.
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
  // The one with this title, begun where there is none yet.
  Chapter chapter_named(const std::string& title) {
    const auto found = std::find(chapters.begin(), chapters.end(), title);
    return found == chapters.end() ? chapter(title) : static_cast<Chapter>(found - chapters.begin());
  }
  void say(Chapter in, Rows rows) { statements.push_back({in, std::move(rows)}); }
  void say(Chapter in, Sentences words) {
    for (std::string& line : words.lines) line = readable(line);
    statements.push_back({in, std::move(words)});
  }
  // On the page alone.
  void show(Chapter in, Card card) {
    statements.push_back({in, Drawn{[cards = Cards{std::move(card)}] { return cards; }}});
  }
  void show(Chapter in, const Formulas& formulas) {
    for (const FormulaCard& formula : formulas.cards()) show(in, Card(formula));
  }
  // The same, made when the page is: a Plot, std::optional<Plot>, or list of plots.
  template <class Made>
  void draw(Chapter in, Made made) {
    statements.push_back({in, Drawn{[made = std::move(made)] { return cards_of(made()); }}});
  }
  // Programs alone.
  void tell(std::string key, Value value) {
    statements.push_back({std::nullopt, Field{std::move(key), std::move(value)}});
  }
  // Notes in terminal, JSON and page, where what is missing of an incomplete study stands with them.
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
