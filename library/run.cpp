// run.cpp — a run and its records for the caller.
#include <kurbel/run.h>

#include <fmt/format.h>

#include "library/machine_parts.h"
#include "studies/question/question.h"
#include "studies/run/run_findings.h"
#include "studies/tables/trajectory_rows.h"
#include "studies/trials/run_question.h"

namespace kurbel {

struct RunParts {
  std::shared_ptr<const Result> result;
  Study study;
  FigureValues figures;
  Trajectory trajectory;
};

namespace {

FigureValues figures_of(const Result& result) {
  std::vector<FigureValue> all;
  for (const Figure& f : result.figures)
    if (is_reported(f, result)) all.push_back({f, f.name, f.unit, f.at});
  return FigureValues(std::move(all));
}

Trajectory trajectory_of(const Result& result) {
  if (!result.trajectory) return {};
  std::vector<std::string> names, units;
  for (const Channel& channel : result.trajectory->channels()) {
    names.push_back(channel.name.text);
    units.push_back(channel.unit);
  }
  const auto rows = std::make_shared<const TrajectoryRows>(rows_of(*result.trajectory));
  return {rows, &rows->time, &rows->values, std::move(names), std::move(units)};
}

GivenOptions options_of(const RunChoices& choices) {
  GivenOptions given{{"measured", choices.measured}, {"shift", choices.shift}};
  if (choices.effects) given.emplace_back("effects", *choices.effects);
  if (choices.method) given.emplace_back("method", *choices.method);
  if (choices.accuracy) given.emplace_back("accuracy", fmt::format("{}", *choices.accuracy));
  if (choices.until) given.emplace_back("until", fmt::format("{} s", *choices.until));
  if (choices.no_error) given.emplace_back("no_error", "true");
  if (choices.no_trials) given.emplace_back("no_trials", "true");
  for (const std::string& one : choices.map) given.emplace_back("map", one);
  for (const std::string& one : choices.offset) given.emplace_back("offset", one);
  return given;
}

}  // namespace

Run run(const Machine& machine, const RunChoices& choices) {
  return asked_of(machine.parts(), [&] {
    Inquiry inquiry = inquiry_of(machine.parts(), choices.watcher);
    inquiry.page = choices.page;
    SingleRunRequest asked = single_run_options().read(options_of(choices), "run", inquiry.scene);
    asked.state = choices.from_state;
    const auto reported = single_run(inquiry, asked);
    const std::shared_ptr<const Result> result(reported, &reported->tried.study);
    return Run(std::make_shared<const RunParts>(
        RunParts{result, study_of(output_of(reported)), figures_of(*result), trajectory_of(*result)}));
  });
}

bool Run::complete() const { return parts_->result->complete; }
std::string Run::diagnosis() const { return parts_->result->diagnosis; }
const FigureValues& Run::figures() const { return parts_->figures; }
const Trajectory& Run::trajectory() const { return parts_->trajectory; }
double Run::measured_accuracy() const { return parts_->result->measured_accuracy; }
double Run::processor_seconds() const { return parts_->result->cpu_total; }
const Study& Run::study() const { return parts_->study; }

std::vector<RunEvent> Run::events() const {
  std::vector<RunEvent> all;
  for (const Event& e : parts_->result->events) all.push_back({e.t, e.component, e.what});
  return all;
}

}  // namespace kurbel
