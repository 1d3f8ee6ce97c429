// studies.cpp — the studies by their names: options read, the machine asked, the findings handed out.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "library/machine_parts.h"
#include "library/option_values.h"
#include "library/own_mechanism.h"
#include "library/study_options.h"
#include "studies/accuracy/accuracy_findings.h"
#include "studies/advise/advise_findings.h"
#include "studies/effects/effect_study_findings.h"
#include "studies/forces/forces_findings.h"
#include "studies/gears/gears.h"
#include "studies/modes/modes_findings.h"
#include "studies/reduce/reduce.h"
#include "studies/report/write_output.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady_findings.h"
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
  if (!a.ready()) return {};
  return output_of(compare(a.scene(), models_to_compare(a.scene(), effects, against), simulation));
}

StudyOutput steady_cycle(Asked& a) {
  SteadyOptions o{.traces = true, .watch = a.watch};
  const auto effects = a.options.effects("effects", a.scene());
  o.at = moment_of(a.options.text("at"), o.mid_speed);
  if (const auto speed = a.options.quantity("mid_speed", "a speed other than 0", "60 rpm")) o.mid_speed = speed;
  o.periods = a.options.whole("periods", 1, 64).value_or(1);
  o.start_search = !a.options.flag("no_start");
  if (!a.ready()) return {};
  if (effects) return output_of(steady(a.scene(), {*effects}, o));
  Effects full = a.scene().effects;
  if (full.describe() == "none") full.all_elastic = true;
  if (!is_elastic(*compile(a.scene(), full))) return output_of(steady(a.scene(), {a.scene().effects}, o));
  return output_of(steady(a.scene(), {without_elasticity(full), full}, o));
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
  if (const auto fastest = a.options.quantity("fastest", "a speed > 0", "300 rpm", positive)) o.fastest = *fastest;
  if (const auto slowest = a.options.quantity("slowest", "a speed ≥ 0", "300 rpm", not_negative)) o.slowest = *slowest;
  if (!a.ready()) return {};
  Effects effects = asked.value_or(a.scene().effects);
  if (!asked && effects.elastic.empty() && !effects.all_elastic) effects.all_elastic = true;
  return output_of(find_modes(a.scene(), effects, o));
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
  if (!a.ready()) return {};
  refuse_forces_of_own(a.scene(), o.mechanism);
  if (chosen_mechanism(a.scene(), o.mechanism).kind->name != "slider-crank")
    return output_of(find_linkage_forces(a.scene(), o));
  return output_of(find_forces(a.scene(), o));
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
  if (!a.ready()) return {};
  return output_of(reduce(a.scene(), o));
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
  for (const std::string& method : o.methods) check_method(method, "reduced");
  o.within = a.options.quantity("within", "a relative error > 0", "0.1 %", positive);
  o.budget = a.options.quantity("budget", "a time > 0", "50 ms", positive);
  o.time = a.options.quantity("time", "a time > 0", "60 s", positive).value_or(o.time);
  if (!a.ready()) return {};
  return output_of(measure_accuracy(a.scene(), o));
}

StudyOutput uncertain(Asked& a) {
  MachineQuestion question;
  question.text = a.machine.text, question.file = a.machine.file, question.settings = a.machine.settings;
  if (const std::string of = a.options.text("of"); !of.empty()) question.of = study_named(of);
  if (a.options.flag("no_error")) question.errors_every = 0;
  question.interrupted = a.watch.interrupted;
  UncertaintyOptions o{.figures = a.options.names("figures"), .limits = a.options.names("limits"), .watch = a.watch};
  if (const auto samples = a.options.whole("samples", 10, 1'000'000)) o.samples = static_cast<std::size_t>(*samples);
  if (const auto seed = a.options.whole("seed", 0, 1 << 30)) o.seed = static_cast<std::uint64_t>(*seed);
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  o.jobs = a.options.whole("jobs", 1, 1024).value_or(cores);
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
