// studies.cpp — the studies by their names: options read, the machine asked, the findings handed out.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "library/machine_parts.h"
#include "library/option_values.h"
#include "library/own_mechanism.h"
#include "library/study_options.h"
#include "studies/accuracy/accuracy.h"
#include "studies/advise/advise.h"
#include "studies/difference/difference.h"
#include "studies/effects/effect_study.h"
#include "studies/forces/forces_findings.h"
#include "studies/gears/gears.h"
#include "studies/handout/forces_sheet.h"
#include "studies/handout/reduce_sheet.h"
#include "studies/measured/overlay.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/report/write_output.h"
#include "studies/run/run_findings.h"
#include "studies/sheet/paper.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "studies/tables/summary_tables.h"
#include "studies/trials/trials_findings.h"
#include "studies/uncertainty/uncertainty.h"

namespace kurbel {
namespace {

struct Asked {
  const MachineParts& machine;
  AskedOptions& options;
  Watch watch;
  bool only_names = false;  // of the options

  const Scene& scene() const { return machine.scene; }
  // Behind the last option: what nobody asked for is refused before anything is computed.
  bool ready() const {
    if (!only_names) options.refuse_others();
    return !only_names;
  }
  SimulateOptions simulation() const {
    SimulateOptions simulation;
    simulation.traces = true;
    simulation.watch = watch;
    return simulation;
  }
};

SimulateOptions options_of_runs(Asked& a) {
  SimulateOptions simulation = a.simulation();
  simulation.accuracy = a.options.quantity("accuracy", "1e-12 … 0.1", "1e-6", {.low = 1e-12, .high = 0.1});
  simulation.until = a.options.quantity("until", "a time > 0", "3 s", positive);
  const std::string method = a.options.text("method");
  if (!method.empty()) check_method(method, a.scene().run.model), simulation.method = method;
  simulation.measure_error = !a.options.flag("no_error");
  return simulation;
}

StudyOutput compared(Asked& a) {
  const auto effects = a.options.effects("effects", a.scene()), against = a.options.effects("against", a.scene());
  const SimulateOptions simulation = options_of_runs(a);
  const bool trials = !a.options.flag("no_trials");
  if (!a.ready()) return {};
  Comparison comparison = compare(a.scene(), models_to_compare(a.scene(), effects, against), simulation);
  if (!trials) return output_of(std::move(comparison));
  return output_of(with_trials(std::move(comparison), simulation));
}

StudyOutput steady_cycle(Asked& a) {
  SteadyOptions o{.traces = true, .watch = a.watch};
  const auto effects = a.options.effects("effects", a.scene());
  o.at = moment_of(a.options.text("at"), o.mid_speed);
  if (const auto speed = a.options.quantity("mid_speed", "a speed other than 0", "60 rpm")) o.mid_speed = speed;
  o.periods = a.options.whole("periods", 1, 64).value_or(1);
  o.start_search = !a.options.flag("no_start");
  const MeasurementRequest measured{.file = a.options.text("measured"),
                                    .maps = a.options.texts("map"),
                                    .shift = a.options.text("shift"),
                                    .offsets = a.options.texts("offset")};
  if (!a.ready()) return {};
  return cycles_under(measured, a.scene(), effects ? std::vector{*effects} : effects_side_by_side(a.scene()), o);
}

StudyOutput natural_modes(Asked& a) {
  ModesOptions o{.watch = a.watch};
  const auto asked = a.options.effects("effects", a.scene());
  o.count = a.options.whole("count", 1, 1000).value_or(o.count);
  o.spot_checks = a.options.whole("spot_checks", 0, 100).value_or(2);
  o.torque = a.options.text("torque");
  o.misfires = !a.options.flag("no_misfires");
  o.at = moment_of(a.options.text("at"), o.speed);
  if (const auto speed = a.options.quantity("speed", "a speed", "300 rpm")) o.speed = speed;
  o.angle = a.options.quantity("angle", "an angle", "90 deg");
  const std::vector<double> range = a.options.quantities("range", "two speeds ≥ 0", "300 rpm", not_negative);
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    throw std::invalid_argument("range: must be two speeds, the slower first, e.g. 0 rpm and 3000 rpm");
  if (!range.empty()) o.slowest = range[0], o.fastest = range[1];
  o.spots = a.options.quantities("spot", "a speed > 0", "250 rpm", positive);
  o.orders = a.options.quantity("orders", "a plain number > 0", "12", positive).value_or(o.orders);
  o.barred_factor = a.options.quantity("barred", "a plain number > 0", "1", positive).value_or(o.barred_factor);
  if (!a.ready()) return {};
  return output_of(find_modes(a.scene(), asked.value_or(effects_of_modes(a.scene())), o));
}

// A sheet of the positions to be printed, if it is asked for.
std::optional<Paper> paper_asked(Asked& a) {
  const bool wanted = a.options.flag("sheet");
  const std::string paper = a.options.text("paper");
  if (!wanted && !paper.empty()) throw std::invalid_argument("paper: is that of the sheet; ask for sheet, too");
  if (!wanted) return {};
  return paper_named(paper.empty() ? "A4" : paper);
}

StudyOutput forces_in_joints(Asked& a) {
  ForcesOptions o;
  o.rigid_behind = true;
  o.watch = a.watch;
  o.positions = a.options.whole("positions", 4, 3600).value_or(o.positions);
  o.mechanism = a.options.text("mechanism");
  o.speed = a.options.quantity("speed", "a speed", "300 rpm");
  o.effects = a.options.effects("effects", a.scene());
  o.simulate = !a.options.flag("no_run");
  const std::optional<Paper> paper = paper_asked(a);
  if (!a.ready()) return {};
  refuse_forces_of_own(a.scene(), o.mechanism);
  return paper ? output_of(sheet_of(a.scene(), o, *paper, "")) : output_of_forces(a.scene(), o);
}

StudyOutput sized(Asked& a) {
  SizeOptions o;
  o.delta = a.options.quantity("delta", "a plain number", "0.05");
  o.at = moment_of(a.options.text("at"), o.mid_speed);
  if (const auto speed = a.options.quantity("mid_speed", "a speed > 0", "60 rpm", positive)) o.mid_speed = speed;
  o.machine = a.options.text("machine");
  o.flywheel = a.options.text("flywheel");
  if (const std::string material = a.options.text("material"); !material.empty()) o.material = material;
  o.diameter = a.options.quantity("diameter", "a length > 0", "1.2 m", positive).value_or(0);
  o.rim_speed = a.options.quantity("rim_speed", "a speed > 0", "30 m/s", positive).value_or(0);
  o.sheet = a.options.quantity("sheet", "a length > 0", "240 mm", positive);
  o.simulate = !a.options.flag("no_simulation");
  const std::string form = a.options.text("form"), basis = a.options.text("basis");
  if (!form.empty() && form != "rim" && form != "disc")
    throw std::invalid_argument(fmt::format("form = {}: must be rim or disc", in_quotes(form)));
  if (!basis.empty() && basis != "classical" && basis != "regime")
    throw std::invalid_argument(fmt::format("basis = {}: must be classical or regime", in_quotes(basis)));
  if (form == "disc") o.form = FlywheelForm::disc;
  if (!basis.empty()) o.basis = basis == "classical" ? SizeBasis::classical : SizeBasis::regime;
  o.simulation = a.simulation();
  if (!a.ready()) return {};
  return output_of(size_flywheel(a.scene(), o));
}

StudyOutput reduced(Asked& a) {
  ReduceOptions o;
  o.at = moment_of(a.options.text("at"), o.speed);
  if (const auto speed = a.options.quantity("speed", "a speed > 0", "60 rpm", positive)) o.speed = speed;
  o.to = a.options.text("to");
  o.positions = a.options.whole("positions", 1, 3600).value_or(o.positions);
  o.orders = a.options.whole("orders", 1, 1000).value_or(o.orders);
  const std::string basis = a.options.text("basis");
  if (!basis.empty() && basis != "classical" && basis != "regime")
    throw std::invalid_argument(fmt::format("basis = {}: must be classical or regime", in_quotes(basis)));
  if (!basis.empty()) o.basis = basis == "classical" ? ReduceBasis::classical : ReduceBasis::regime;
  const std::optional<Paper> paper = paper_asked(a);
  ReduceSheetRequest request;
  request.delta = a.options.quantity("delta", "a plain number", "0.05");
  request.flywheel = a.options.text("flywheel");
  if (!paper && (request.delta || !request.flywheel.empty()))
    throw std::invalid_argument("delta and flywheel are of the sheet's flywheel; ask for sheet, too, or for size");
  if (!a.ready()) return {};
  if (!paper) return output_of(reduce(a.scene(), o));
  request.paper = *paper;
  return output_of(sheet_of(a.scene(), o, request));
}

StudyOutput gear_pairs(Asked& a) {
  GearsOptions o{.pair = a.options.text("pair")};
  o.speed = a.options.quantity("speed", "a speed > 0", "1450 rpm", positive);
  if (!a.ready()) return {};
  return output_of(find_gears(a.scene(), o));
}

StudyOutput effects_by_one(Asked& a) {
  if (!a.ready()) return {};
  return output_of(study_effects(a.scene(), a.simulation()));
}

StudyOutput advised(Asked& a) {
  AdviseOptions o;
  o.simulate = a.simulation();
  o.within = a.options.quantity("within", "a part > 0 and below 1", "1 %", {.low = 1e-9, .high = 1}).value_or(o.within);
  o.figures = a.options.names("figures");
  o.held_out = !a.options.flag("no_held_out");
  if (!a.ready()) return {};
  return output_of(advise(a.scene(), o));
}

StudyOutput accuracy_bought(Asked& a) {
  AccuracyOptions o{.watch = a.watch};
  o.figure = a.options.text("figure");
  o.multibody = !a.options.flag("no_multibody");
  o.methods = a.options.names("methods");
  for (const std::string& method : o.methods) {
    check_method(method, "reduced");
    if (method == "auto")
      throw std::invalid_argument("methods = \"auto\": changes its method on its way; name the methods to compare");
  }
  if (auto tolerances = a.options.numbers("tolerances", 1e-12, 0.01); !tolerances.empty()) {
    std::sort(tolerances.rbegin(), tolerances.rend());
    o.tolerances = std::move(tolerances);
  }
  o.within = a.options.quantity("within", "a relative error > 0", "0.1 %", positive);
  o.budget = a.options.quantity("budget", "a time > 0", "50 ms", positive);
  o.time = a.options.quantity("time", "a time > 0", "60 s", positive).value_or(o.time);
  if (!a.ready()) return {};
  return output_of(measure_accuracy(a.scene(), o));
}

StudyOutput uncertain(Asked& a) {
  const std::string of = a.options.text("of");
  MachineQuestion question = question_of(a.machine, of.empty() ? "run" : of, {a.watch.interrupted});
  if (a.options.flag("no_error")) question.errors_every = 0;
  UncertaintyOptions o{.figures = a.options.names("figures"), .limits = a.options.texts("limit"), .watch = a.watch};
  o.biases = !a.options.flag("no_trials");
  if (const auto samples = a.options.whole("samples", 10, 1'000'000)) o.samples = static_cast<std::size_t>(*samples);
  if (const auto seed = a.options.whole("seed", 0, 1 << 30)) o.seed = static_cast<std::uint64_t>(*seed);
  o.jobs = threads_of(a.options.whole("jobs", 1, 1024).value_or(0));
  if (!a.ready()) return {};
  return output_of(study_uncertainty(question, o));
}

struct NamedStudy {
  const char* name;
  StudyOutput (*ask)(Asked&);
};
constexpr NamedStudy named_studies[] = {
    {"compare", compared}, {"steady", steady_cycle},      {"modes", natural_modes},  {"forces", forces_in_joints},
    {"size", sized},       {"reduce", reduced},           {"gears", gear_pairs},     {"effects", effects_by_one},
    {"advise", advised},   {"accuracy", accuracy_bought}, {"uncertainty", uncertain}};

const NamedStudy& named_study(const std::string& name) {
  for (const NamedStudy& study : named_studies)
    if (study.name == name) return study;
  throw std::invalid_argument(fmt::format("no study {}; there are {}{}", in_quotes(name), listed(study_names(), "and"),
                                          suggestion(name, study_names())));
}

}  // namespace

std::vector<std::string> study_names() {
  std::vector<std::string> names;
  for (const NamedStudy& study : named_studies) names.push_back(study.name);
  return names;
}

std::vector<std::string> option_names(const std::string& study) {
  const auto none = std::make_unique<const MachineParts>();
  const Options nothing;
  AskedOptions options(study, nothing);
  Asked asked{*none, options, {}, true};
  named_study(study).ask(asked);
  return options.known();
}

Study study(const std::string& name, const Machine& machine, const Options& given, const Watcher& watcher) {
  const NamedStudy& named = named_study(name);
  AskedOptions options(name, given);
  Asked asked{machine.parts(), options, watch_of(watcher)};
  return asked_of(machine.parts(), [&] { return study_of(named.ask(asked)); });
}

Study diff(const Machine& a, const Machine& b, const Options& given, const Watcher& watcher) {
  AskedOptions options("diff", given);
  std::string of = options.text("of");
  if (of.empty()) of = "run";
  MachineQuestion first = question_of(a.parts(), of, watcher), second = question_of(b.parts(), of, watcher);
  if (options.flag("no_error")) first.errors_every = second.errors_every = 0;
  first.delta = second.delta = options.quantity("delta", "a plain number", "0.05");
  if (first.delta && first.of != SweepStudy::size) throw std::invalid_argument("delta: belongs to of = \"size\"");
  options.refuse_others();
  try {
    return study_of(output_of(difference_between(first, second, of)));
  } catch (const SceneError& error) {
    throw bad_scene(error);  // of either scene: placed in its file
  }
}

std::vector<FigureValue> Study::figures() const {
  std::vector<FigureValue> all;
  for (FigureRow& row : summary_tables(parts_->output.json).figures)
    all.push_back({std::move(row.name), row.value, std::move(row.unit), row.error, row.at, std::move(row.of)});
  return all;
}

std::string Study::conclusion() const { return parts_->output.conclusion; }
std::string Study::text() const { return parts_->output.table; }
std::string Study::json() const { return parts_->output.json; }
std::string Study::html() const { return html_of(parts_->output.report()); }
bool Study::complete() const { return parts_->output.complete; }
std::string Study::diagnosis() const { return parts_->output.diagnosis; }
std::string Study::unconfirmed() const { return parts_->output.unconfirmed; }

std::vector<std::pair<std::string, std::string>> Study::tables() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const CsvFile& file : parts_->output.csv) all.emplace_back(file.name, file.text());
  return all;
}

void Study::write(const std::string& folder, const std::string& formats) const {
  write_output(parts_->output, folder, {.formats = table_formats(formats)});
}

}  // namespace kurbel
