// rows.cpp — cells, totals, and rows as lines of text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "tests/agreement/agreement.h"

namespace kurbel::agreement {

const char* name_of(Verdict verdict) {
  static constexpr const char* names[] = {"agrees", "told", "refused", "silent"};
  return names[static_cast<std::size_t>(verdict)];
}
const char* name_of(Topic topic) {
  static constexpr const char* names[topic_count] = {
      "mean speed",   "mid speed",    "δ",           "period",        "peaks",
      "RMS",          "works",        "multipliers", "energy",        "mean torques",
      "δ as sized",   "frequencies",  "damping",     "forced orders", "forced peaks",
      "linear peaks", "crank torque", "reactions",   "advice"};
  return names[static_cast<std::size_t>(topic)];
}

// Of equal verdicts the one furthest beyond what is allowed.
const Compared* Row::cell(Topic topic) const {
  const Compared* worst = nullptr;
  const auto excess = [](const Compared& c) {
    return c.allowed > 0 ? std::abs(c.run - c.study) / c.allowed : std::abs(c.run - c.study);
  };
  for (const Compared& c : figures) {
    if (c.topic != topic) continue;
    if (!worst || c.verdict > worst->verdict || (c.verdict == worst->verdict && excess(c) > excess(*worst))) worst = &c;
  }
  return worst;
}

Row compare_second_half(const Scene& scene, const SettleSettings& settings) {
  Row row = compare_modes(scene, settings);
  for (const Row& more : {compare_forces(scene, settings), compare_advice(scene, 0.05, settings)}) {
    row.figures.insert(row.figures.end(), more.figures.begin(), more.figures.end());
    row.cpu_seconds += more.cpu_seconds;
  }
  return row;
}

Totals totals_of(const std::vector<Row>& rows) {
  Totals totals;
  for (const Row& row : rows) {
    if (row.kind == Motion::none) ++totals.unsettled;
    for (std::size_t t = 0; t < topic_count; ++t)
      if (const Compared* cell = row.cell(static_cast<Topic>(t))) {
        ++totals.cells;
        ++totals.of[static_cast<std::size_t>(cell->verdict)];
      }
  }
  return totals;
}

double Totals::share(Verdict verdict) const {
  return cells == 0 ? 0 : static_cast<double>(of[static_cast<std::size_t>(verdict)]) / static_cast<double>(cells);
}

namespace {

// Tabs part the columns, ends of lines the figures: none may stand within a text.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), '\t', ' ');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}
std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns(1);
  for (const char c : line)
    if (c == '\t')
      columns.emplace_back();
    else
      columns.back() += c;
  return columns;
}

}  // namespace

std::string lines_of(const Row& row) {
  std::string text =
      fmt::format("{}\t{}\t{}\t{}\n", plain(row.scene), static_cast<int>(row.kind), plain(row.orbit), row.cpu_seconds);
  for (const Compared& c : row.figures)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\n", static_cast<int>(c.topic), plain(c.figure), c.run, c.study,
                        c.allowed, static_cast<int>(c.verdict), plain(c.words));
  return text;
}

Row read_row(const std::string& lines) {
  std::istringstream in(lines);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error("a row of the agreement has no head");
  const std::vector<std::string> head = columns_of(line);
  if (head.size() != 4) throw std::runtime_error("the head of a row of the agreement has other columns");
  Row row{.scene = head[0],
          .kind = static_cast<Motion>(std::stoi(head[1])),
          .orbit = head[2],
          .figures = {},
          .cpu_seconds = std::stod(head[3])};
  while (std::getline(in, line)) {
    const std::vector<std::string> c = columns_of(line);
    if (c.size() != 7) throw std::runtime_error("a figure of the agreement has other columns");
    row.figures.push_back({static_cast<Topic>(std::stoi(c[0])), c[1], std::stod(c[2]), std::stod(c[3]), std::stod(c[4]),
                           static_cast<Verdict>(std::stoi(c[5])), c[6]});
  }
  return row;
}

}  // namespace kurbel::agreement
