// render_terminal.cpp — findings as text: columns by display width, statements in the order given.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "engine/scene/text.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/output.h"

namespace kurbel {
namespace {

std::string padded(const std::string& text, std::size_t columns) {
  return text + std::string(columns > characters(text) ? columns - characters(text) : 0, ' ');
}
std::string right(const std::string& text, std::size_t columns) {
  return std::string(columns > characters(text) ? columns - characters(text) : 0, ' ') + text;
}

constexpr std::size_t every_row = SIZE_MAX / 2;

// Rows of each table if not all are requested: the longest tables are cut until all together have at most 48 rows, but none
// to fewer than eight.
std::size_t rows_each(const Findings& f) {
  constexpr std::size_t most = 48, least = 8;
  const auto rows = [&f](std::size_t each) {
    std::size_t sum = 0;
    for (const Statement& s : f.statements)
      if (const Rows* table = std::get_if<Rows>(&s.what); table && table->terminal)
        sum += std::min(table->for_people ? table->for_people->size() : table->count, each);
    return sum;
  };
  std::size_t each = most;
  while (each > least && rows(each) > most) --each;
  return each;
}

std::string opening_of(const Findings& f) {
  std::string text;
  if (f.opening != Findings::Opening::conclusion) text += f.title + "\n";
  if (f.opening != Findings::Opening::title) text += conclusion_text(f) + "\n";
  return text;
}

void say(std::string& text, const std::string& heading, bool apart) {
  if (apart) text += "\n";
  if (!heading.empty()) text += heading + "\n";
}

void say(std::string& text, const Sentences& words, std::size_t) {
  if (!words.terminal || words.lines.empty()) return;
  say(text, words.heading, words.apart);
  for (const std::string& line : words.lines) text += words.indent + line + "\n";
}

void say(std::string&, const Field&, std::size_t) {}
void say(std::string&, const Drawn&, std::size_t) {}

// At most `columns` columns; the rest, of what goes on in any case, is in the report.
std::string shortened(const std::string& text, std::size_t columns, bool goes_on = false) {
  static const std::string stated_elsewhere = " … (report)";
  if (characters(text) + (goes_on ? characters(stated_elsewhere) : 0) <= columns)
    return text + (goes_on ? stated_elsewhere : "");
  std::size_t n = 0, bytes = 0;
  for (std::size_t i = 0; i < text.size() && n + characters(stated_elsewhere) <= columns; ++i)
    if (begins_character(text[i])) bytes = i, ++n;
  const std::size_t blank = text.find_last_of(' ', bytes);
  return text.substr(0, blank == std::string::npos || blank < bytes / 2 ? bytes : blank) + stated_elsewhere;
}

// Wrapped between words; lines after the first are indented.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns, const std::string& indent) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && characters(line) + 1 + characters(word) > columns) {
      lines.push_back(line);
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
    begin = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

// Rows aligned in columns, a line each.
std::vector<std::string> aligned_lines(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], characters(row[k]));
  }
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string& text = lines.emplace_back(" ");
    for (std::size_t k = 0; k < row.size(); ++k)
      text += " " + (k < text_columns || k + 1 == row.size() ? padded(row[k], k + 1 == row.size() ? 0 : widths[k])
                                                             : right(row[k], widths[k]));
    while (text.ends_with(' ')) text.pop_back();
  }
  return lines;
}

// With its headings. Of a long table the first rows, and how many there are besides.
std::vector<std::string> lines_of(const Rows& rows, std::size_t most) {
  std::vector<std::vector<std::string>> cells = rows.texts(most == every_row);
  const std::size_t more = cells.size() > most + 1 ? cells.size() - most : 0;
  cells.resize(cells.size() - more);
  cells.insert(cells.begin(), rows.headings());
  std::vector<std::string> lines = aligned_lines(cells, rows.text_columns_on_terminal);
  if (more > 0) lines.push_back(fmt::format("  {} more rows (report, or --all)", more));
  return lines;
}

std::string in_lines(const std::vector<std::string>& lines) {
  return lines.empty() ? "" : fmt::format("{}\n", fmt::join(lines, "\n"));
}

// Bad news first, cut where there is no room for all of it; then whole sentences, and always the last, which answers the
// question. Those that do not fit are counted.
std::vector<std::string> headline_of(const Findings& findings) {
  std::vector<std::vector<std::string>> sentences;
  std::size_t all = 0;
  for (const std::string& sentence : concluded(findings.claims))
    all += sentences.emplace_back(wrapped(sentence, Brief::width, "  ")).size();
  std::vector<std::string> lines;
  const auto take = [&](std::vector<std::string>& sentence, std::size_t room) {
    if (sentence.size() > room) {
      sentence.resize(std::max<std::size_t>(room, 1));
      sentence.back() = shortened(sentence.back(), Brief::width, true);
    }
    lines.insert(lines.end(), sentence.begin(), sentence.end());
  };
  constexpr std::size_t most = Brief::most_of_conclusion;
  if (all <= most) {
    for (std::vector<std::string>& sentence : sentences) take(sentence, most);
    return lines;
  }
  Claims bad_news;
  std::copy_if(findings.claims.begin(), findings.claims.end(), std::back_inserter(bad_news),
               [](const Claim& c) { return c.is_bad() && c.variant.empty(); });
  const std::size_t bad = concluded(bad_news).size(), last = sentences.size() - 1,
                    answer = std::min<std::size_t>(sentences[last].size(), 2);
  std::size_t reported = 0;
  for (; reported < last; ++reported) {
    const bool is_bad = reported < bad;
    const std::size_t kept = lines.size() + answer + (is_bad && last == bad ? 0 : 1),
                      room = most - std::min(kept, most);
    const std::size_t others = is_bad ? std::min(bad - reported - 1, room) : 0;  // of which each has a line
    const std::size_t own = is_bad && room > 0 ? std::max<std::size_t>(room - others, 1) : room;
    if (sentences[reported].size() > own && (!is_bad || own == 0)) break;
    take(sentences[reported], own);
  }
  const std::size_t room = most - lines.size();
  const bool has_answer = reported == last || room > answer;
  if (const std::size_t more = last - reported + (has_answer ? 0 : 1); more > 0)
    lines.push_back(fmt::format("{} more sentence{} (report)", more, more == 1 ? "" : "s"));
  if (has_answer) take(sentences[last], most - lines.size());
  return lines;
}

void say(std::string& text, const Rows& rows, std::size_t most) {
  if (!rows.terminal || !rows.shown_to_people()) return;
  say(text, rows.heading, rows.apart);
  text += in_lines(lines_of(rows, most));
}

}  // namespace

std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns) {
  return in_lines(aligned_lines(rows, text_columns));
}

std::string terminal_text(const Findings& findings, bool all_digits) {
  std::string text = opening_of(findings);
  const std::size_t most = all_digits ? every_row : rows_each(findings);
  for (const Statement& s : findings.statements) std::visit([&](const auto& what) { say(text, what, most); }, s.what);
  return text;
}

std::string conclusion_text(const Findings& findings) {
  return fmt::format("{}", fmt::join(concluded(findings.claims), "\n"));
}

std::string headline_text(const Findings& findings) {
  return fmt::format("{}", fmt::join(headline_of(findings), "\n"));
}

std::string brief_text(const Findings& f) {
  if (!f.brief) return {};
  const Brief& b = *f.brief;
  std::vector<std::string> lines = {shortened(b.about, Brief::width)};
  for (std::string& line : headline_of(f)) lines.push_back(std::move(line));
  if (b.figures.count > 0)
    for (const std::string& line : lines_of(b.figures, Brief::most_figures))
      lines.push_back(shortened(line, Brief::width));
  for (const std::string& line : b.words) lines.push_back(shortened("  " + readable(line), Brief::width));
  const std::size_t own = lines.size() + (b.more.empty() ? 0 : 1),
                    room = Brief::most_lines - std::min(own, Brief::most_lines);
  for (std::size_t i = 0; i < b.notes.size() && i < room; ++i)
    lines.push_back(i + 1 == room && i + 1 < b.notes.size()
                        ? fmt::format("  {} more notes (report)", b.notes.size() - i)
                        : shortened("  note: " + readable(b.notes[i]), Brief::width));
  if (!b.more.empty()) lines.push_back(shortened("  " + b.more, Brief::width));
  return in_lines(lines);
}

}  // namespace kurbel
