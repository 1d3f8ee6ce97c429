// render_terminal.cpp — findings as text: columns by display width, statements in the order in which they are said.
#include <algorithm>

#include "studies/findings/output.h"
#include "studies/findings/text_table.h"

namespace kurbel {
namespace {

// Display width: UTF-8 continuation bytes take no column.
std::size_t width(const std::string& text) {
  std::size_t n = 0;
  for (const char c : text) n += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return n;
}
std::string padded(const std::string& text, std::size_t columns) {
  return text + std::string(columns > width(text) ? columns - width(text) : 0, ' ');
}
std::string right(const std::string& text, std::size_t columns) {
  return std::string(columns > width(text) ? columns - width(text) : 0, ' ') + text;
}

std::string opening_of(const Findings& f) {
  std::string text;
  if (f.opening != Findings::Opening::conclusion) text += f.title + "\n";
  if (f.opening != Findings::Opening::title) text += f.conclusion + "\n";
  return text;
}

void say(std::string& text, const std::string& heading, bool apart) {
  if (apart) text += "\n";
  if (!heading.empty()) text += heading + "\n";
}

void say(std::string& text, const Rows& rows) {
  if (!rows.terminal || !rows.shown_to_people()) return;
  say(text, rows.heading, rows.apart);
  std::vector<std::vector<std::string>> lines = rows.texts();
  lines.insert(lines.begin(), rows.headings());
  text += aligned(lines, rows.text_columns_on_terminal);
}

void say(std::string& text, const Sentences& words) {
  if (!words.terminal || words.lines.empty()) return;
  say(text, words.heading, words.apart);
  for (const std::string& line : words.lines) text += words.indent + line + "\n";
}

void say(std::string&, const Field&) {}
void say(std::string&, const Drawn&) {}

}  // namespace

std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string text;
  for (const auto& row : rows) {
    text += " ";
    for (std::size_t k = 0; k < row.size(); ++k)
      text += " " + (k < text_columns || k + 1 == row.size() ? padded(row[k], k + 1 == row.size() ? 0 : widths[k])
                                                             : right(row[k], widths[k]));
    while (text.ends_with(' ')) text.pop_back();
    text += "\n";
  }
  return text;
}

std::string terminal_text(const Findings& findings) {
  std::string text = opening_of(findings);
  for (const Statement& s : findings.statements) std::visit([&](const auto& what) { say(text, what); }, s.what);
  return text;
}

}  // namespace kurbel
