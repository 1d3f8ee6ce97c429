// difference.cpp — the same study of both scenes, figure by figure.
#include "studies/difference/difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/findings/figure_changes.h"

namespace kurbel {

std::optional<Estimate> FigureDifference::change() const {
  if (!a || !b) return {};
  return *b - *a;
}

std::optional<double> FigureDifference::relative() const {
  if (!a || !b || !(std::abs(a->value) > a->error.value_or(0)) || a->value == 0) return {};
  return b->value / a->value - 1;
}

double FigureDifference::weight() const {
  if (!a || !b) return 0;
  const double most = std::max({std::abs(a->value), std::abs(b->value), scale});
  return most > 0 ? std::abs(change()->value) / most : 0;
}

bool FigureDifference::differs() const {
  const auto by = change();
  return !by || std::abs(by->value) > by->error.value_or(0);
}

MachineDifference difference_between(const MachineQuestion& a, const MachineQuestion& b, const std::string& of) {
  // Answers first: if one throws, for example on interruption, g++ 12 destroys elements of a braced list twice.
  MachineAnswer first = answer_of(a), second = answer_of(b);
  MachineDifference d{.of = of, .a = std::move(first), .b = std::move(second)};
  for (const Figure& f : d.a.figures) {
    FigureDifference row{.name = f.name, .unit = f.unit, .a = f, .scale = f.scale, .telling = is_telling(f)};
    d.figures.push_back(std::move(row));
  }
  for (const Figure& f : d.b.figures) {
    auto row = std::find_if(d.figures.begin(), d.figures.end(), [&](const auto& r) { return r.name == f.name; });
    if (row == d.figures.end())
      row = d.figures.insert(row, {.name = f.name, .unit = f.unit, .scale = f.scale, .telling = is_telling(f)});
    row->b = f;
  }
  d.changes = scene_changes(parse_toml(d.a.text, d.a.file), parse_toml(d.b.text, d.b.file));
  return d;
}

}  // namespace kurbel
