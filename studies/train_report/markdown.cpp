// markdown.cpp — cards of a report as Markdown and as records.
#include "studies/train_report/markdown.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

// A cell: no bar, no line's end.
std::string in_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return out;
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + in_cell(cell) + " |";
  return line + "\n";
}

std::string heading(const std::string& title) { return title.empty() ? "" : fmt::format("### {}\n\n", title); }

std::string figure(const std::string& title, const std::string& note) {
  return fmt::format("*Figure: {}.*{}\n\n", title, note.empty() ? "" : " " + note);
}

std::string markdown(const Table& t) {
  std::string text = heading(t.title) + row_of(t.columns) + "|";
  for (std::size_t k = 0; k < t.columns.size(); ++k) text += k < t.text_columns ? "---|" : "---:|";
  text += "\n";
  for (const std::vector<std::string>& row : t.rows) text += row_of(row);
  return text + "\n";
}
std::string markdown(const Text& t) {
  if (t.verbatim) return heading(t.title) + fmt::format("```\n{}\n```\n\n", t.body);
  std::string text = heading(t.title);
  for (std::size_t begin = 0; begin < t.body.size();) {
    const std::size_t end = std::min(t.body.find('\n', begin), t.body.size());
    if (end > begin) text += t.body.substr(begin, end - begin) + "\n\n";
    begin = end + 1;
  }
  return text;
}
std::string markdown(const FormulaCard& f) {
  return heading(f.title) +
         fmt::format("```\n{}\n{}\n```\n\n{}", f.symbols, f.numbers, f.note.empty() ? "" : f.note + "\n\n");
}
std::string markdown(const Plot& p) {
  const auto axis = [](const Axis& a) { return a.unit.empty() ? a.label : fmt::format("{} [{}]", a.label, a.unit); };
  return figure(fmt::format("{}: {} over {}", p.title, axis(p.y), axis(p.x)), p.note);
}
std::string markdown(const MachineView& m) { return figure(m.title, ""); }
std::string markdown(const GearView& g) { return figure(g.title, g.note); }

Record record(const Table& t) {
  return {{"title", t.title}, {"columns", t.columns}, {"rows", each(t.rows, [](const auto& row) { return row; })}};
}
Record record(const Text& t) { return {{"title", t.title}, {"text", t.body}}; }
Record record(const FormulaCard& f) {
  return {{"title", f.title}, {"text", f.symbols + "\n" + f.numbers + (f.note.empty() ? "" : "\n" + f.note)}};
}
Record record(const Plot& p) { return {{"title", p.title}, {"figure", p.note}}; }
Record record(const MachineView& m) { return {{"title", m.title}, {"figure", ""}}; }
Record record(const GearView& g) { return {{"title", g.title}, {"figure", g.note}}; }

}  // namespace

std::string markdown_of(const Report& report) {
  std::string text = fmt::format("# {}\n\n", report.title);
  if (!report.subtitle.empty()) text += report.subtitle + "\n\n";
  for (const std::string& sentence : report.conclusion) text += fmt::format("> {}\n>\n", sentence);
  text += "\n";
  if (!report.figures.empty()) {
    text += "| figure | value | |\n|---|---:|---|\n";
    for (const KeyFigure& f : report.figures) {
      const TileText tile = tile_text(f, f.digits);
      text += row_of({f.name, fmt::format("{} {}", tile.value, pretty_unit(f.unit)), f.note});
    }
    text += "\n";
  }
  for (const ReportSection& section : report.sections) {
    text += fmt::format("## {}\n\n", section.title);
    for (const Card& card : section.cards) text += std::visit([](const auto& c) { return markdown(c); }, card);
  }
  if (!report.meanings.empty()) text += "## What the figures mean\n\n";
  for (const Meaning& meaning : report.meanings) text += fmt::format("**{}** {}\n\n", meaning.title, meaning.text);
  return text + "---\n\n" + report.footer + "\n";
}

List sections_of(const Report& report) {
  return each(report.sections, [](const ReportSection& section) {
    return Record{{"title", section.title}, {"parts", each(section.cards, [](const Card& card) {
                                               return std::visit([](const auto& c) { return record(c); }, card);
                                             })}};
  });
}

}  // namespace kurbel
