// difference_findings.cpp — findings on the comparison of two machines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/scene/units.h"
#include "studies/difference/difference.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

// Files of the same name are distinguished by their folders.
std::string name_of(const MachineAnswer& m, const MachineAnswer& other) {
  const std::filesystem::path path(m.file);
  if (path.stem() != std::filesystem::path(other.file).stem()) return path.stem().string();
  return m.file == other.file ? m.file : path.lexically_normal().string();
}
struct Names {
  std::string a, b;
};
Names names_of(const MachineDifference& d) {
  Names names{name_of(d.a, d.b), name_of(d.b, d.a)};
  if (names.a == names.b) names = {"the first", "the second"};
  return names;
}

std::string percent(double relative) {
  if (relative < -1) return "changes sign";
  return std::abs(relative) >= 10 ? fmt::format("× {:.3g}", 1 + relative) : fmt::format("{:+.3g} %", 100 * relative);
}

bool changes_sign(const FigureDifference& f) { return *f.relative() < -1; }

// The differing figures by size; those relevant for a headline have a higher weight. Without those that change sign, of
// which a percentage says nothing, unless all do.
std::vector<const FigureDifference*> by_size(const MachineDifference& d) {
  std::vector<const FigureDifference*> list;
  for (const FigureDifference& f : d.figures)
    if (f.differs() && f.relative()) list.push_back(&f);
  if (!std::all_of(list.begin(), list.end(), [](const auto* f) { return changes_sign(*f); }))
    std::erase_if(list, [](const auto* f) { return changes_sign(*f); });
  const auto rank = [](const FigureDifference& f) { return (f.reporting ? 10 : 1) * f.weight(); };
  std::stable_sort(list.begin(), list.end(), [&](const auto* x, const auto* y) { return rank(*x) > rank(*y); });
  return list;
}

std::string keys_in_words(const MachineDifference& d) {
  if (d.changes.empty()) return "their scenes are the same";
  const SceneChange& first = d.changes.front();
  const std::string shown = fmt::format("{} ({} → {})", first.path, first.a.value_or("—"), first.b.value_or("—"));
  if (d.changes.size() == 1) return "one key differs, " + shown;
  return fmt::format("{} keys differ, {} first", d.changes.size(), shown);
}

std::string conclusion(const MachineDifference& d) {
  const Names names = names_of(d);
  for (const auto& [m, name] : {std::pair{&d.a, names.a}, std::pair{&d.b, names.b}})
    if (!m->done()) return fmt::format("\"{}\" has no sure answer: {}", name, m->diagnosis);
  const auto list = by_size(d);
  const auto count = std::count_if(d.figures.begin(), d.figures.end(), [](const auto& f) { return f.differs(); });
  if (count == 0)
    return fmt::format("The machines do not differ: {} figures agree within their errors; {}", d.figures.size(),
                       keys_in_words(d));
  const auto common = std::count_if(d.figures.begin(), d.figures.end(), [](const auto& f) { return f.a && f.b; });
  const auto of_one = static_cast<std::ptrdiff_t>(d.figures.size()) - common;
  std::string text;
  for (std::size_t i = 0; i < list.size() && i < 3; ++i)
    text += fmt::format("{}{} {} → {} ({})", i ? ", " : "", list[i]->name,
                        short_text(list[i]->a->value, list[i]->unit, d.speed_unit()),
                        short_text(list[i]->b->value, list[i]->unit, d.speed_unit()), percent(*list[i]->relative()));
  return fmt::format("\"{}\" against \"{}\": {}{}{} of {} figures differ by more than their errors{}; {}", names.b,
                     names.a, text, text.empty() ? "" : "; ", count - of_one, common,
                     of_one ? fmt::format(", {} more belong to one machine only", of_one) : "", keys_in_words(d));
}

// In the unit for people.
Estimate read_in(const MachineDifference& d, const FigureDifference& f, const Estimate& figure) {
  return f.unit == "rad/s" ? figure / d.speed_unit().size : figure;
}
std::string cell(const MachineDifference& d, const FigureDifference& f, const std::optional<Estimate>& figure) {
  if (!figure) return "—";
  const FigureCells cells = figure_cells(*figure, f.unit, d.speed_unit());
  return cells.error.empty() ? cells.value : cells.value + " " + cells.error;
}

Rows figure_table(const MachineDifference& d) {
  using F = const FigureDifference&;
  const Names names = names_of(d);
  return table_of("figures", "Figure by figure", d.figures)
      .column("name", "figure", &FigureDifference::name)
      .only_for_programs("a", &FigureDifference::a)
      .only_for_programs("b", &FigureDifference::b)
      .only_for_programs("difference", &FigureDifference::change)
      .only_for_programs("relative", &FigureDifference::relative)
      .only_for_people(names.a, [&d](F f) { return cell(d, f, f.a); })
      .only_for_people(names.b, [&d](F f) { return cell(d, f, f.b); })
      .column("unit", "unit", &FigureDifference::unit,
              [&d](const std::string& unit) { return unit == "rad/s" ? d.speed_unit().name : pretty_unit(unit); })
      .only_for_people("difference",
                       [&d](F f) {
                         if (!f.change()) return std::string(f.a ? "only the first has it" : "only the second has it");
                         return figure_text(read_in(d, f, *f.change()), 4).value;
                       })
      .only_for_people("relative", [](F f) { return !f.relative() ? "—"
                                                    : f.differs() ? percent(*f.relative())
                                                                  : "0"; })
      .only_for_programs("differs", &FigureDifference::differs)
      .only_for_people("more than the errors", [](F f) { return !f.change()   ? "—"
                                                                : f.differs() ? "yes"
                                                                              : "no"; });
}

Rows change_table(const MachineDifference& d) {
  using C = const SceneChange&;
  const Names names = names_of(d);
  const auto side = [](const std::optional<std::string>& text) { return text.value_or("—"); };
  return table_of("changes", "What differs between the scenes", d.changes)
      .headed("scenes")
      .text_in(3)
      .column("path", "key", &SceneChange::path)
      .column("a", names.a, &SceneChange::a, side)
      .column("b", names.b, &SceneChange::b, side)
      .only_for_programs("line_a", [](C c) { return c.at_a.line; })
      .only_for_programs("line_b", [](C c) { return c.at_b.line; });
}

std::optional<Plot> picture(const MachineDifference& d) {
  constexpr std::size_t most = 14;
  auto list = by_size(d);
  if (list.empty() || changes_sign(*list.front())) return {};
  const auto height = [](const FigureDifference& f) { return std::abs(*f.relative()); };
  std::stable_sort(list.begin(), list.end(), [&](const auto* x, const auto* y) { return height(*x) > height(*y); });
  const Names names = names_of(d);
  Plot plot{.title = fmt::format("What changes from {} to {}", names.a, names.b),
            .x = {.label = "figure"},
            .y = {"change of its value", "%"},
            .bars = true,
            .wide = true};
  Series up{.name = "rises", .role = Role::elastic}, down{.name = "falls", .role = Role::orange};
  for (std::size_t i = 0; i < list.size() && i < most; ++i) {
    plot.x.names.push_back(list[i]->name);
    Series& series = *list[i]->relative() > 0 ? up : down;
    series.add(static_cast<double>(i + 1), 100 * *list[i]->relative());
  }
  for (Series* series : {&up, &down})
    if (!series->x.empty()) plot.series.push_back(std::move(*series));
  if (list.size() > most) plot.note = fmt::format("The {} greatest of {} changes.", most, list.size());
  const auto turned = std::count_if(d.figures.begin(), d.figures.end(), [](const FigureDifference& f) {
    return f.differs() && f.relative() && changes_sign(f);
  });
  if (turned > 0)
    plot.note += fmt::format("{}{} more change sign: see the table.", plot.note.empty() ? "" : " ", turned);
  return plot;
}

}  // namespace

Findings findings_of(const MachineDifference& d) {
  Findings f{.title = d.a.title == d.b.title ? d.a.title : d.a.title + " / " + d.b.title,
             .subtitle = fmt::format("Two machines side by side, figures of kurbel {}", d.of),
             .scene_file = d.a.file,
             .speed_unit = d.speed_unit().name,
             .complete = d.complete(),
             .diagnosis = d.a.done() ? d.b.diagnosis : d.a.diagnosis};
  f.conclude(d.complete(), conclusion(d));
  for (const FigureDifference* figure : by_size(d))
    if (f.figures.size() < 5) {
      f.figures.push_back({read_in(d, *figure, *figure->b), figure->name,
                           figure->unit == "rad/s" ? d.speed_unit().name : figure->unit,
                           fmt::format("{} from {}", percent(*figure->relative()),
                                       short_text(figure->a->value, figure->unit, d.speed_unit())),
                           0, figure->name});
    }
  const Chapter figures = f.chapter("Figures"), scenes = f.chapter("Scenes");
  f.draw(figures, [&d] { return picture(d); });
  f.say(scenes, change_table(d));
  f.say(figures, figure_table(d));
  f.record("of", d.of);
  f.record("other_scene", d.b.file);
  f.show_scene(d.a.file, d.a.text);
  if (!d.changes.empty() || d.b.file != d.a.file)
    f.show(f.chapter("The other scene"), Text{.title = d.b.file, .body = d.b.text, .verbatim = true, .folded = true});
  return f;
}

}  // namespace kurbel
