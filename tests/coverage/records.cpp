// records.cpp — one line a run, one line a figure.
#include "tests/coverage/records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <istream>
#include <stdexcept>

namespace kurbel::coverage {
namespace {

constexpr std::size_t run_columns = 14, figure_columns = 15;

std::string plain(std::string words) {
  for (char& c : words)
    if (c == ',' || c == '\n' || c == '\r') c = ';';
  return words;
}

// Denormals and infinities, too, which std::stod refuses.
double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

Verdict verdict_named(const std::string& name) {
  for (const Verdict v : {Verdict::covered, Verdict::missed, Verdict::uncertain, Verdict::unstated, Verdict::unknown})
    if (name == name_of(v)) return v;
  throw std::runtime_error("no verdict is called \"" + name + "\"");
}

// "3 × reason | 1 × other" and back.
std::string refusals(const std::map<std::string, int>& refused) {
  std::string text;
  for (const auto& [reason, count] : refused)
    text += fmt::format("{}{} × {}", text.empty() ? "" : " | ", count, plain(reason));
  return text;
}
std::map<std::string, int> refusals_of(const std::string& text) {
  std::map<std::string, int> refused;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(" | ", begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t cross = part.find(" × ");
    if (cross != std::string::npos) refused[part.substr(cross + 4)] += std::stoi(part);
    begin = end + 3;
  }
  return refused;
}

MeasuredVariant run_of(const std::vector<std::string>& c) {
  return {.scene = c[1],
          .method = c[3],
          .seed = std::stoull(c[2]),
          .accuracy = number(c[4]),
          .whole = c[5] == "1",
          .words = c[12],
          .confirmed = c[6] == "1",
          .runs = std::stoi(c[7]),
          .tolerance = number(c[8]),
          .flow_calls = std::stoll(c[9]),
          .flow_calls_of_two = std::stoll(c[10]),
          .cpu_seconds = number(c[11]),
          .figures = {},
          .refused = refusals_of(c[13])};
}

JudgedFigure::Kind kind_of(const std::string& name) {
  if (name.starts_with("impacts.")) return JudgedFigure::Kind::count;
  return name.starts_with("at.") || name.starts_with("event.") ? JudgedFigure::Kind::time : JudgedFigure::Kind::value;
}

JudgedFigure figure_of(const std::vector<std::string>& c) {
  return {.name = c[5],
          .unit = c[6],
          .value = number(c[7]),
          .scale = number(c[8]),
          .stated = number(c[9]),
          .truth = number(c[10]),
          .uncertainty = number(c[11]),
          .verdict = verdict_named(c[12]),
          .stated_by_two = number(c[13]),
          .by_two = verdict_named(c[14]),
          .kind = kind_of(c[5])};
}

}  // namespace

std::string column_lines() {
  return "# "
         "run,scene,seed,method,accuracy,whole,confirmed,runs,tolerance,flow_calls,flow_calls_of_two,cpu_seconds,words,"
         "refused\n"
         "# figure,scene,seed,method,accuracy,name,unit,value,scale,stated,truth,uncertainty,verdict,stated_by_two,"
         "verdict_by_two\n";
}

std::string lines_of(const MeasuredVariant& v) {
  const std::string which = fmt::format("{},{},{},{:.0e}", v.scene, v.seed, v.method, v.accuracy);
  std::string text =
      fmt::format("run,{},{:d},{:d},{},{:.3e},{},{},{:.4g},{},{}\n", which, v.whole, v.confirmed, v.runs, v.tolerance,
                  v.flow_calls, v.flow_calls_of_two, v.cpu_seconds, plain(v.words), refusals(v.refused));
  for (const JudgedFigure& f : v.figures)
    text += fmt::format("figure,{},{},{},{:.17g},{:.6g},{:.4g},{:.17g},{:.4g},{},{:.4g},{}\n", which, plain(f.name),
                        f.unit, f.value, f.scale, f.stated, f.truth, f.uncertainty, name_of(f.verdict), f.stated_by_two,
                        name_of(f.by_two));
  return text;
}

std::vector<MeasuredVariant> read_lines(std::istream& in) {
  std::vector<MeasuredVariant> variants;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells[0] == "run" && cells.size() == run_columns) {
      variants.push_back(run_of(cells));
    } else if (cells[0] == "figure" && cells.size() == figure_columns && !variants.empty()) {
      variants.back().figures.push_back(figure_of(cells));
    } else {
      throw std::runtime_error(fmt::format("line {}: neither a run nor a figure", number));
    }
  }
  return variants;
}

}  // namespace kurbel::coverage
