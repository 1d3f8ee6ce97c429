// sweep.cpp — rows of machines and of functions of the caller, by the same sweep.
#include <kurbel/scene.h>
#include <kurbel/sweep.h>

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "library/machine_parts.h"
#include "studies/sweep/sweep_question.h"
#include "studies/variants/in_threads.h"
#include "studies/variants/machine.h"

namespace kurbel {
namespace {

Design design_of(const Variation& variation) {
  return answered([&] {
    std::vector<SweptParameter> parameters;
    for (const std::string& text : variation.vary) parameters.push_back(parse_parameter(text));
    if (parameters.empty())
      throw std::invalid_argument("nothing is varied; give e.g. \"main_coupling.stiffness=500..1500 kN*m/rad\"");
    return Design(variation.design, std::move(parameters), variation.seed);
  });
}

SweepLine line_of(SweepRow&& row, std::size_t columns) {
  SweepLine line{row.row, name_of(row.state), std::move(row.diagnosis), std::move(row.parameters), {}, {}};
  line.figures.resize(columns), line.errors.resize(columns);
  for (const RowFigure& figure : row.figures)
    line.figures[figure.figure] = figure.value, line.errors[figure.figure] = figure.error;
  return line;
}

SweepRows rows_of(const SweepStore& store, const std::function<void(SweepLine&&)>& take) {
  SweepRows all;
  for (const SweptParameter& parameter : store.identity().parameters) all.vary.push_back(parameter.given);
  for (const SweptFigure& figure : store.identity().figures) all.columns.push_back({figure.name, figure.unit});
  std::size_t there = 0;
  if (take) store.each([&](SweepRow&& row) { take(line_of(std::move(row), all.columns.size())), ++there; });
  all.complete = (take ? there : store.count()) == store.identity().rows;
  return all;
}
SweepRows held_rows_of(const SweepStore& store) {
  std::vector<SweepLine> lines;
  SweepRows all = rows_of(store, [&](SweepLine&& line) { lines.push_back(std::move(line)); });
  all.lines = std::move(lines);
  return all;
}

const std::string& file_of(const SweepChoices& choices) {
  if (choices.into.empty()) throw std::invalid_argument("a sweep needs a file that it fills: into");
  return choices.into;
}

SweepRows rows_after(const SweepEnd& end, const SweepStore& store, const SweepChoices& choices) {
  SweepRows rows = choices.lines ? held_rows_of(store) : rows_of(store, {});
  rows.computed = end.computed;
  rows.complete = end.complete();
  return rows;
}

}  // namespace

std::vector<std::vector<double>> rows_of(const Variation& variation) {
  const Design design = design_of(variation);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < design.rows(); ++i) rows.push_back(design.row(i));
  return rows;
}

std::vector<Settings> settings_of(const Variation& variation) {
  const Design design = design_of(variation);
  std::vector<Settings> all;
  for (std::size_t i = 0; i < design.rows(); ++i) {
    const std::vector<double> values = design.row(i);
    Settings settings;
    for (std::size_t k = 0; k < values.size(); ++k)
      settings.emplace_back(design.parameters()[k].path, design.parameters()[k].text_of(values[k]));
    all.push_back(std::move(settings));
  }
  return all;
}

SweepRows sweep(const Variation& variation, const std::string& question, const std::vector<SweepColumn>& columns,
                const RowFunction& function, const SweepChoices& choices) {
  const Design design = design_of(variation);
  std::vector<SweptFigure> figures;
  for (const SweepColumn& column : columns) figures.push_back({column.name, column.unit});
  const SweepIdentity identity =
      identity_of(design, figures, choices.shard, {{"of", question}, {"seed", std::to_string(variation.seed)}});
  const Evaluator evaluator = [&](SweepRow& row) {
    try {
      const std::vector<double> values = function(row.parameters);
      if (values.size() != columns.size())
        throw std::runtime_error(fmt::format("{} values for {} columns", values.size(), columns.size()));
      for (std::size_t k = 0; k < values.size(); ++k) row.figures.push_back({{values[k]}, k});
    } catch (const std::exception& why) {
      row.figures.clear();
      row.state = RowState::failed;
      row.diagnosis = why.what();
    }
    return !(choices.watcher.interrupted && choices.watcher.interrupted->load());
  };
  return answered([&] {
    SweepJob job{.design = &design,
                 .jobs = threads_of(choices.jobs),
                 .evaluator = [&] { return evaluator; },
                 .watch = watch_of(choices.watcher)};
    read_shard(choices.shard, job);
    SweepStore store(file_of(choices), identity);
    return rows_after(run_sweep(job, store), store, choices);
  });
}

SweepRows rows_in(const std::string& file, const std::function<void(const SweepLine&)>& visit) {
  return answered([&] {
    const SweepStore store{std::filesystem::path(file)};
    return visit ? rows_of(store, [&](SweepLine&& line) { visit(line); }) : held_rows_of(store);
  });
}

Study sweep_report(const std::string& file, const std::vector<std::string>& limits) {
  return answered([&] {
    return study_of(output_of(std::make_shared<const StoredSweep>(std::make_unique<SweepStore>(file), limits)));
  });
}

std::size_t merge(const std::vector<std::string>& files, const std::string& into) {
  return answered([&] { return merge_sweeps(files, into); });
}

SweepAnswer answer(const Machine& machine, const std::string& of, bool no_error, const Watcher& watcher) {
  return asked_of(machine.parts(), [&] {
    const MachineAnswer found =
        answer_of(question_of(inquiry_of(machine.parts(), watcher), {.of = of, .measure_error = !no_error}));
    std::vector<FigureValue> figures;
    for (const Figure& f : found.figures) figures.push_back({f, f.name, f.unit, f.at});
    return SweepAnswer{name_of(found.state), found.diagnosis, FigureValues(std::move(figures))};
  });
}

SweepRows sweep(const Machine& machine, const Variation& variation, const std::vector<std::string>& figures,
                const SweepChoices& choices, const std::string& of) {
  return asked_of(machine.parts(), [&] {
    const auto [store, end] = fill_sweep(inquiry_of(machine.parts(), choices.watcher), {.machine = {.of = of},
                                                                                        .vary = variation.vary,
                                                                                        .figures = figures,
                                                                                        .design = variation.design,
                                                                                        .into = file_of(choices),
                                                                                        .shard = choices.shard,
                                                                                        .jobs = choices.jobs,
                                                                                        .seed = variation.seed});
    return rows_after(end, *store, choices);
  });
}

}  // namespace kurbel
