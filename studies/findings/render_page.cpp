// render_page.cpp — findings as a page: sections of cards.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <set>

#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/dictionary/dictionary.h"
#include "studies/findings/output.h"
#include "studies/findings/plots.h"

namespace kurbel {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string definition_id(const std::string& figure) {
  const Definition* known = figure.empty() ? nullptr : definition_of(figure);
  return known ? std::string(known->name) : "";
}

// For the rows shown to people.
std::vector<std::string> definition_ids(const Rows& rows) {
  std::vector<std::string> ids;
  if (rows.means.empty()) return ids;
  for (const std::size_t i : rows.for_people ? *rows.for_people : numbers_below(rows.count))
    ids.push_back(definition_id(rows.means[i]));
  return ids;
}

// Columns without a text in any row.
void omit_empty_columns(Table& table) {
  if (table.rows.empty()) return;
  for (std::size_t k = table.columns.size(); k-- > 0;) {
    if (std::any_of(table.rows.begin(), table.rows.end(), [k](const auto& row) { return !row[k].empty(); })) continue;
    const auto omit = [at = static_cast<std::ptrdiff_t>(k)](auto& cells) { cells.erase(cells.begin() + at); };
    omit(table.columns);
    for (auto& row : table.rows) omit(row);
    for (auto& row : table.tones)
      if (row.size() > k) omit(row);
    if (k < table.text_columns) --table.text_columns;
  }
}

void show(Cards& cards, const Rows& rows) {
  if (!rows.page || !rows.shown_to_people()) return;
  Table table{.title = rows.title,
              .columns = rows.headings(),
              .rows = rows.texts(),
              .folded = rows.folded,
              .text_columns = rows.text_columns,
              .tones = rows.tones,
              .means = definition_ids(rows)};
  omit_empty_columns(table);
  cards.push_back(std::move(table));
}
void show(Cards& cards, const Sentences& words) {
  if (words.page && !words.lines.empty()) cards.push_back(Text{.title = words.title, .body = joined(words.lines)});
}
// An empty plot is omitted.
bool shows_nothing(const Card& card) {
  const Plot* plot = std::get_if<Plot>(&card);
  return plot && !plot->map &&
         std::all_of(plot->series.begin(), plot->series.end(), [](const Series& s) { return s.x.empty(); });
}
// Decimal numbers of a note have four digits at most; whole ones (counts, numbers of standards) are unchanged.
std::string readable_note(const std::string& note) {
  static const std::regex decimal("[0-9]+[.][0-9]+(e[+-]?[0-9]+)?");
  std::string text;
  auto rest = note.begin();
  for (std::sregex_iterator number(note.begin(), note.end(), decimal), none; number != none; ++number) {
    const std::string digits = number->str();
    text.append(rest, (*number)[0].first);
    text += significant_digits(digits) > headline_digits ? headline_number(std::stod(digits)) : digits;
    rest = (*number)[0].second;
  }
  return readable(text.append(rest, note.end()));
}
// Lines of the legend that have the colour of an earlier one are dashed: there are six for a list.
void dash_repeated_colours(Plot& plot) {
  std::map<Role, int> drawn;
  for (Series& s : plot.series) {
    const bool told = !s.name.empty() && s.text_at_start.empty() && s.text_at_end.empty();
    if (plot.bars || !told || !s.line || s.dashed || s.role == Role::reference) continue;
    s.dashed = drawn[s.role]++ % 2 == 1;
  }
}

// Converts numbers in texts of a plot to readable form.
void make_readable(Plot& plot) {
  dash_repeated_colours(plot);
  plot.title = readable(plot.title);
  plot.note = readable_note(plot.note);
  for (Series& series : plot.series) series.name = readable(series.name);
  for (Band& band : plot.bands) band.text = readable(band.text);
}
void make_readable(FormulaCard& formula) {
  for (std::string* text : {&formula.title, &formula.numbers}) *text = readable(*text);
  formula.note = readable_note(formula.note);
}
template <class Other>
void make_readable(Other&) {}

void show(Cards& cards, const Drawn& drawn) {
  for (Card& card : drawn.cards()) {
    if (shows_nothing(card)) continue;
    std::visit([](auto& what) { make_readable(what); }, card);
    cards.push_back(std::move(card));
  }
}
void show(Cards&, const Field&) {}

// Definitions of the figures shown, each once, in the dictionary's order.
std::vector<Meaning> meanings_of(const Report& page) {
  std::set<std::string, std::less<>> shown;
  for (const KeyFigure& figure : page.figures) shown.insert(figure.means);
  for (const ReportSection& section : page.sections)
    for (const Card& card : section.cards)
      if (const Table* table = std::get_if<Table>(&card)) shown.insert(table->means.begin(), table->means.end());
  std::vector<Meaning> meanings;
  for (const Definition& d : dictionary())
    if (shown.contains(d.name))
      meanings.push_back({std::string(d.name), d.form() + " — " + std::string(d.words), d.text()});
  return meanings;
}

}  // namespace

std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = i;
  return numbers;
}

std::vector<std::string> Rows::headings() const {
  std::vector<std::string> all;
  for (const Column& c : columns)
    if (c.for_people) all.push_back(c.heading);
  return all;
}

std::vector<std::vector<std::string>> Rows::texts(bool all_digits) const {
  std::vector<std::vector<std::string>> all;
  for (const std::size_t i : for_people && !(all_digits && whole_in_long_form) ? *for_people : numbers_below(count)) {
    std::vector<std::string>& row = all.emplace_back();
    for (const Column& c : columns)
      if (c.for_people) row.push_back(readable(all_digits && !c.long_texts.empty() ? c.long_texts[i] : c.texts[i]));
  }
  return all;
}

Rows words_table(const std::string& title, const std::vector<std::string>& headings, const Lines& lines) {
  auto table = table_of("", title, lines).always();
  for (std::size_t k = 0; k < headings.size(); ++k)
    table.only_for_people(headings[k], [k](const std::vector<std::string>& line) { return line[k]; });
  return table;
}

void Findings::note(Chapter in, const std::vector<std::string>& notes, const std::string& indent) {
  say(in, Sentences{.lines = notes, .indent = indent + "note: ", .key = "notes", .page = complete});
  if (complete) return;
  statements.push_back({std::nullopt, Sentences{.lines = {diagnosis}, .indent = indent + "INCOMPLETE: "}});
  std::vector<std::string> lines = notes;
  lines.push_back("incomplete: " + diagnosis);
  say(in, Sentences{.lines = lines, .terminal = false});
}

KeyFigure key_figure(std::string name, const Estimate& value, std::string means, std::string note, int digits) {
  const std::string unit(definition_of(std::string_view(means))->unit);
  return {value, std::move(name), unit, std::move(note), digits, std::move(means)};
}

void Findings::show_scene(const std::string& file, const std::string& text) {
  show(chapter("Scene"), Text{.title = file, .body = text, .verbatim = true, .folded = true});
}

// "629.3 kN", "85.5 MPa", "570 kN·m/rad"; speeds are in the scene's unit already.
void in_readable_unit(KeyFigure& figure) {
  const ReadableUnit unit = unit_on_tile(figure.value, figure.unit);
  static_cast<Estimate&>(figure) = unit.factor * figure;
  figure.unit = unit.unit;
}

Report page_of(const Findings& f) {
  Report page{.title = f.page_title.empty() ? f.title : f.page_title,
              .subtitle = f.subtitle,
              .conclusion = concluded(f.claims),
              .complete = f.complete,
              .figures = f.figures,
              .sections = {},
              .footer = f.footer};
  std::vector<Cards> cards(f.chapters.size());
  for (const Statement& s : f.statements)
    if (s.chapter)
      std::visit([&](const auto& what) { show(cards[static_cast<std::size_t>(*s.chapter)], what); }, s.what);
  for (std::size_t i = 0; i < cards.size(); ++i)
    if (!cards[i].empty()) page.add(f.chapters[i]).cards = std::move(cards[i]);
  for (KeyFigure& figure : page.figures) {
    figure.means = definition_id(figure.means);
    figure.note = headline(figure.note);
    in_readable_unit(figure);
  }
  page.meanings = meanings_of(page);
  return page;
}

}  // namespace kurbel
