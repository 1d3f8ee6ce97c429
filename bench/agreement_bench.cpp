// agreement_bench.cpp — does every study speak of the same machine? Each verb against the settled run of every scene.
//
// What cells are, and when they agree: tests/agreement/agreement.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "bench/benches.h"
#include "bench/workers.h"
#include "studies/scenes/kinds.h"
#include "tests/agreement/agreement.h"

namespace kurbel::bench {
namespace {

using namespace agreement;

constexpr int seconds_a_scene = 120;  // processor time
constexpr double wanted_agree = 0.9, wanted_reported = 0.1;

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

// What one half of the matrix compares, and on which machines.
struct Half {
  const char* title;
  const char* file;
  std::vector<const char*> folders;
  std::size_t begin, end;  // topics
  Row (*compare)(const Scene& scene);
};
const Half halves[] = {{"run against steady, reduce and size",
                        "agreement.md",
                        {KURBEL_SOURCE_DIR "/scenes", KURBEL_SOURCE_DIR "/tests/agreement"},
                        0,
                        first_of_modes,
                        [](const Scene& scene) { return compare_verbs(scene, {}); }},
                       {"run against modes, forces and advise",
                        "agreement_of_vibrations.md",
                        {KURBEL_SOURCE_DIR "/scenes", KURBEL_SOURCE_DIR "/tests/agreement",
                         KURBEL_SOURCE_DIR "/tests/agreement/vibrations"},
                        first_of_modes,
                        topic_count,
                        [](const Scene& scene) { return compare_second_half(scene); }}};

std::vector<std::string> scenes_named(const Half& half, const std::string& only) {
  std::vector<std::string> names;
  for (const char* folder : half.folders)
    for (std::string& file : scene_files(folder))
      if (std::filesystem::path(file).stem().string().find(only) != std::string::npos) names.push_back(std::move(file));
  return names;
}

// What breaks the process says nothing: no worse answer.
Row broken(const Half& half, const std::string& scene, const std::string& words) {
  Row row{.scene = scene, .kind = Motion::none, .orbit = words, .figures = {}, .cpu_seconds = 0};
  row.figures.push_back({static_cast<agreement::Topic>(half.begin), words, 0, 0, 0, Verdict::silent, words});
  return row;
}

std::vector<Row> measured(const Half& half, const std::vector<std::string>& files, int jobs) {
  std::vector<Row> rows(files.size());
  run_tasks(
      files.size(), jobs, seconds_a_scene,
      [&](std::size_t k) {
        Row row = half.compare(read_scene(files[k], all_kinds()));
        row.scene = std::filesystem::path(files[k]).stem().string();
        return lines_of(row);
      },
      [&](const TaskEnd& end) {
        const std::string name = std::filesystem::path(files[end.task]).stem().string();
        rows[end.task] = end.whole ? read_row(end.text) : broken(half, name, end.words);
        std::fprintf(stderr, "%s: %.2f s\n", name.c_str(), rows[end.task].cpu_seconds);
      },
      [] { return true; });
  return rows;
}

// By how much a silent cell misses, over the larger of the two.
std::string mark_of(const Compared* cell) {
  if (!cell) return "";
  if (cell->verdict == Verdict::agrees) return "✓";
  if (cell->verdict != Verdict::silent) return name_of(cell->verdict);
  const double size = std::max(std::abs(cell->run), std::abs(cell->study));
  return size > 0 ? fmt::format("✗ {:.2g} %", 100 * std::abs(cell->run - cell->study) / size) : "✗";
}
Tone tone_of(const Compared* cell) {
  if (!cell) return Tone::none;
  switch (cell->verdict) {
    case Verdict::agrees:
      return Tone::good;
    case Verdict::reported:
      return Tone::fair;
    case Verdict::refused:
      return Tone::aside;
    case Verdict::silent:
      break;
  }
  return Tone::bad;
}

Table matrix_of(const Half& half, const std::vector<Row>& rows) {
  Table table{.title = half.title, .columns = {"scene"}, .rows = {}};
  for (std::size_t t = half.begin; t < half.end; ++t)
    table.columns.emplace_back(name_of(static_cast<agreement::Topic>(t)));
  table.columns.emplace_back("the run");
  for (const Row& row : rows) {
    std::vector<std::string> cells = {row.scene};
    std::vector<Tone> tones = {Tone::none};
    for (std::size_t t = half.begin; t < half.end; ++t) {
      const Compared* cell = row.cell(static_cast<agreement::Topic>(t));
      cells.push_back(mark_of(cell));
      tones.push_back(tone_of(cell));
    }
    cells.push_back(row.orbit);
    tones.push_back(Tone::none);
    table.rows.push_back(std::move(cells));
    table.tones.push_back(std::move(tones));
  }
  return table;
}

Table silent_of(const std::vector<Row>& rows) {
  Table table{
      .title = "silent disagreements", .columns = {"scene", "topic", "figure", "run", "study", "allowed"}, .rows = {}};
  table.text_columns = 3;
  for (const Row& row : rows)
    for (std::size_t t = 0; t < topic_count; ++t)
      if (const Compared* c = row.cell(static_cast<agreement::Topic>(t)); c && c->verdict == Verdict::silent)
        table.rows.push_back({row.scene, name_of(c->topic), c->figure, fmt::format("{:.9g}", c->run),
                              fmt::format("{:.9g}", c->study), fmt::format("{:.1e}", c->allowed)});
  return table;
}

// One topic stands for each verb.
constexpr struct {
  const char* verb;
  agreement::Topic topic;
} verbs[] = {{"steady", agreement::Topic::mean_speed},   {"reduce", agreement::Topic::mean_torques},
             {"size", agreement::Topic::sized_delta},    {"modes", agreement::Topic::forced_peaks},
             {"forces", agreement::Topic::crank_torque}, {"forces", agreement::Topic::reactions},
             {"advise", agreement::Topic::advice}};

// The same reason of several components counts as one: names and numbers are omitted from the comparison.
std::string reason_of(const std::string& words) {
  std::string plain;
  bool quoted = false;
  for (const char c : words) {
    if (c == '"') quoted = !quoted;
    if (!quoted && plain.size() < 110) plain += c;
  }
  return plain;
}
Table refusals_of(const Half& half, const std::vector<Row>& rows) {
  Table table{.title = "refusals", .columns = {"verb", "reason", "scenes", "how many"}, .rows = {}};
  table.text_columns = 3;
  for (const auto& verb : verbs) {
    if (const auto t = static_cast<std::size_t>(verb.topic); t < half.begin || t >= half.end) continue;
    std::map<std::string, std::vector<std::string>> by_reason;
    std::size_t asked = 0, refused = 0;
    for (const Row& row : rows) {
      const Compared* cell = row.cell(verb.topic);
      if (!cell) continue;
      ++asked;
      if (cell->verdict != Verdict::refused) continue;
      ++refused;
      by_reason[reason_of(cell->words)].push_back(row.scene);
    }
    table.rows.push_back({verb.verb, "all", "", fmt::format("{} of {}", refused, asked)});
    for (const auto& [reason, scenes] : by_reason)
      table.rows.push_back(
          {verb.verb, reason, fmt::format("{}", fmt::join(scenes, ", ")), std::to_string(scenes.size())});
  }
  return table;
}

std::string markdown(const Table& table) {
  std::string text = fmt::format("## {}\n\n", table.title);
  const auto line = [&](const std::vector<std::string>& cells) {
    text += fmt::format("| {} |\n", fmt::join(cells, " | "));
  };
  line(table.columns);
  line(std::vector<std::string>(table.columns.size(), "---"));
  for (std::vector<std::string> row : table.rows) {
    for (std::string& cell : row) std::replace(cell.begin(), cell.end(), '|', '/');
    line(row);
  }
  return text + "\n";
}

// Per topic: how many agree, are stated, refused, silent.
Table counts_of(const Half& half, const std::vector<Row>& rows) {
  Table table{.title = "cells of each topic", .columns = {"topic", "agree", "stated", "refused", "silent"}, .rows = {}};
  for (std::size_t t = half.begin; t < half.end; ++t) {
    std::array<int, 4> of{};
    for (const Row& row : rows)
      if (const Compared* cell = row.cell(static_cast<agreement::Topic>(t)))
        ++of[static_cast<std::size_t>(cell->verdict)];
    table.rows.push_back({name_of(static_cast<agreement::Topic>(t)), std::to_string(of[0]), std::to_string(of[1]),
                          std::to_string(of[2]), std::to_string(of[3])});
  }
  return table;
}

}  // namespace

void agreement_of_verbs(BenchBook& book, int which, const std::string& only, int jobs, const std::string& folder) {
  const Half& half = halves[which];
  const std::vector<std::string> files = scenes_named(half, only);
  if (files.empty()) throw std::invalid_argument(fmt::format("--only {}: no scene's name holds that", only));
  const std::vector<Row> rows = measured(half, files, jobs);
  const Totals totals = totals_of(rows);
  const std::string words = fmt::format(
      "Of {} cells of {} scenes {} agree, {} are stated, {} refused, {} silent; {} scenes are not settled.",
      totals.cells, rows.size(), percent(totals.share(Verdict::agrees)), percent(totals.share(Verdict::reported)),
      percent(totals.share(Verdict::refused)), percent(totals.share(Verdict::silent)), totals.unsettled);
  const std::vector<Table> tables = {matrix_of(half, rows), counts_of(half, rows), silent_of(rows),
                                     refusals_of(half, rows)};
  std::filesystem::create_directories(folder);
  std::ofstream out(fmt::format("{}/{}", folder, half.file));
  out << words << "\n\n";
  for (const Table& table : tables) {
    out << markdown(table);
    book.tables.push_back(table);
  }
  const double agree = totals.share(Verdict::agrees), reported = totals.share(Verdict::reported);
  const std::size_t silent = totals.of[static_cast<std::size_t>(Verdict::silent)];
  book.target("cells that agree", "≥ 90 %", percent(agree), agree >= wanted_agree);
  book.target("cells that are stated", "≤ 10 %", percent(reported), reported <= wanted_reported);
  book.target("silent disagreements", "0", std::to_string(silent), silent == 0);
  book.conclusions.push_back(words);
}

}  // namespace kurbel::bench
