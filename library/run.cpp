// run.cpp — a run and its records for the caller.
#include <kurbel/run.h>

#include <stdexcept>

#include "library/machine_parts.h"
#include "studies/measured/overlay.h"
#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "studies/tables/trajectory_rows.h"
#include "studies/trials/trials_findings.h"

namespace kurbel {

struct RunParts {
  std::shared_ptr<const Result> result;
  Study study;
  FigureValues figures;
  Trajectory trajectory;
};

namespace {

// A run, its trials if requested, and a measured record compared with it.
struct ToldRun {
  WithTrials<Result> tried;
  bool has_trials = false;
  std::optional<Overlay> overlay = {};
};
Findings findings_of(const ToldRun& run) {
  Findings findings = run.has_trials ? findings_of(run.tried) : findings_of(run.tried.study);
  if (run.overlay) show(findings, *run.overlay);
  return findings;
}

// Read before any computation; empty: not requested.
std::optional<Measurement> measurement_of(const RunChoices& choices, const Model& model) {
  const MeasurementRequest request{choices.measured, choices.map, choices.shift, choices.offset};
  if (!request.asked()) return {};
  const RunSettings& run = model.scene.run;
  if (run.model != "reduced")
    throw std::invalid_argument("a test's record belongs to the reduced model; set run.model = \"reduced\"");
  Measurement measurement = read_measurement(request, channels_of_run(model));
  if (choices.from_state.empty()) require_overlap(measurement, 0, choices.until.value_or(run.until));
  return measurement;
}

FigureValues figures_of(const Result& result) {
  std::vector<FigureValue> all;
  for (const Figure& f : result.figures)
    if (is_told(f, result)) all.push_back({f.name, f.value, f.unit, f.error, f.at});
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

SimulateOptions options_of(const RunChoices& choices, const Scene& scene) {
  SimulateOptions options;
  options.measure_error = !choices.no_error;
  options.traces = choices.page;
  if (choices.method) check_method(*choices.method, scene.run.model);
  options.method = choices.method;
  if (choices.accuracy && !(*choices.accuracy >= 1e-12 && *choices.accuracy <= 0.1))
    throw std::invalid_argument("accuracy must be 1e-12 … 0.1");
  options.accuracy = choices.accuracy;
  if (choices.until && !(*choices.until > 0 && *choices.until < 1e30))
    throw std::invalid_argument("until must be a time > 0 [s]");
  options.until = choices.until;
  options.go_on_from = choices.from_state;
  if (!choices.from_state.empty() && scene.run.model != "reduced")
    throw std::invalid_argument("a state belongs to the reduced model; set run.model = \"reduced\"");
  options.watch = watch_of(choices.watcher);
  return options;
}

}  // namespace

Run run(const Machine& machine, const RunChoices& choices) {
  return asked_of(machine.parts(), [&] {
    const Scene& scene = machine.parts().scene;
    const Effects effects = choices.effects ? parse_effects(*choices.effects, scene) : scene.effects;
    const auto model = compile(scene, effects);
    SimulateOptions options = options_of(choices, scene);
    const std::optional<Measurement> measurement = measurement_of(choices, *model);
    if (measurement) options.traces = true;
    const auto told = std::make_shared<ToldRun>();
    Result result = simulate(model, is_elastic(*model) ? "elastic" : "rigid", options);
    told->has_trials = !choices.no_trials;
    if (told->has_trials)
      told->tried = with_trials(std::move(result), options);
    else
      told->tried.study = std::move(result);
    if (measurement) told->overlay = lay_over(*measurement, told->tried.study);
    const std::shared_ptr<const Result> run(told, &told->tried.study);
    return Run(std::make_shared<const RunParts>(
        RunParts{run, study_of({findings_of(*told), {}, {}, told}), figures_of(*run), trajectory_of(*run)}));
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
