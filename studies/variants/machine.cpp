// machine.cpp — applies the studies to rows of variants.
#include "studies/variants/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "engine/numerics/deadline.h"
#include "engine/scene/quantity_place.h"
#include "engine/scene/units.h"
#include "studies/modes/modes.h"
#include "studies/scenes/kinds.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "studies/variants/in_threads.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {
namespace {

// In SI by its unit only. If the reader converts it otherwise ("60 1/min" as a speed), the check against reading
// detects it, and the parameter is read again in every row.
double in_si(const SweptParameter& p, double value) {
  UnitError error;
  const auto quantity = parse_quantity(p.text_of(value), error);
  return quantity ? quantity->value : std::nan("");
}

bool same_numbers(const Section& a, const Section& b);
bool same_settings(const Setting& a, const Setting& b) {
  if (a.key != b.key || a.number != b.number || a.flag != b.flag || a.text != b.text || a.numbers != b.numbers ||
      a.curve.x != b.curve.x || a.curve.y != b.curve.y || a.curve.period != b.curve.period ||
      a.sections.size() != b.sections.size())
    return false;
  return std::equal(a.sections.begin(), a.sections.end(), b.sections.begin(), same_numbers);
}
bool same_numbers(const Section& a, const Section& b) {
  return a.name == b.name && a.kind == b.kind &&
         std::equal(a.settings.begin(), a.settings.end(), b.settings.begin(), b.settings.end(), same_settings);
}
bool same_machine(const Scene& a, const Scene& b) {
  return std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(), same_numbers) &&
         a.effects.describe() == b.effects.describe() && a.run.until == b.run.until &&
         a.run.accuracy == b.run.accuracy && a.run.start.speed == b.run.start.speed;
}

}  // namespace

OptionsOf<MachineRequest> machine_options() {
  return OptionsOf<MachineRequest>()
      .add({.name = "of", .doc = "run (default), steady, modes or size"}, &MachineRequest::of)
      .add({.name = "delta", .doc = "demanded δ, of --of size", .example = "0.05", .what = "a plain number"},
           &MachineRequest::delta)
      .add({.name = "no_error", .doc = "skip the runs that measure errors: figures are then taken as exact"},
           &MachineRequest::measure_error, false);
}

MachineQuestion question_of(const Inquiry& inquiry, const MachineRequest& asked) {
  const SweepStudy of = study_named(asked.of);
  if (asked.delta && of != SweepStudy::size) throw std::invalid_argument("--delta: belongs to --of size");
  return {.text = inquiry.text,
          .file = inquiry.file,
          .settings = inquiry.settings,
          .allowed = inquiry.allowed,
          .of = of,
          .errors_every = asked.measure_error ? 1u : 0u,
          .delta = asked.delta,
          .every_order = false,
          .interrupted = inquiry.watch.interrupted};
}

SweepStudy study_named(const std::string& of) {
  if (of == "run") return SweepStudy::run;
  if (of == "steady") return SweepStudy::steady;
  if (of == "modes") return SweepStudy::modes;
  if (of == "size") return SweepStudy::size;
  throw std::invalid_argument(fmt::format("--of {}: must be run, steady, modes or size", in_quotes(of)));
}

VariedScene::VariedScene(const MachineQuestion& question, const std::vector<SweptParameter>& parameters)
    : question_(question), parameters_(parameters), scene_(read_with({})) {
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other)
      if (parameters_[k].path == parameters_[other].path)
        throw std::invalid_argument(fmt::format("{} is varied twice; give one of them", parameters_[k].path));
    check_ends(k);
    all_in_place_ = all_in_place_ && in_place_.back();
  }
}

Scene VariedScene::read_with(const std::vector<std::string>& further) const {
  std::vector<std::string> settings = question_.settings;
  settings.insert(settings.end(), further.begin(), further.end());
  return parse_scene(SettledText(question_.text, question_.file, settings), all_kinds(), question_.allowed);
}

Scene VariedScene::read(const std::vector<double>& values) const {
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < parameters_.size(); ++k) settings.push_back(parameters_[k].setting(values[k]));
  return read_with(settings);
}

// For a list every value, for a range its ends: values between them are within the key's domain, too.
void VariedScene::check_ends(std::size_t k) {
  const SweptParameter& p = parameters_[k];
  std::vector<double> ends = p.is_list() ? p.values : std::vector<double>{p.low, p.high};
  constexpr std::size_t most_checked = 200;
  if (p.is_list() && p.words.empty() && ends.size() > most_checked) {
    const auto [least, most] = std::minmax_element(p.values.begin(), p.values.end());
    ends = {*least, *most};
  }
  for (const double value : ends) {
    const std::string setting = p.setting(value);
    try {
      read_with({setting});
    } catch (SceneError& error) {
      std::vector<Message> messages = error.messages;
      const std::string asked = p.where.empty() ? fmt::format("--vary {}", in_quotes(p.given))
                                                : fmt::format("{}: {}", p.where, in_quotes(p.given));
      for (Message& m : messages) {
        if (m.file != fmt::format("--set {}", in_quotes(setting))) continue;
        m.file = asked;
        if (p.words.empty()) m.at = {}, m.text += fmt::format(" (at {})", p.text_of(value));
      }
      throw SceneError(std::move(messages));
    }
  }
  in_place_.push_back(p.words.empty() && found_in_place(k, ends.front(), ends.back()));
}

bool VariedScene::found_in_place(std::size_t k, double low, double high) {
  for (const double value : {low, high}) {
    Scene patched = scene_;
    Setting* const setting = quantity_at(patched.components, parameters_[k].path);
    if (!setting) return false;
    setting->number = in_si(parameters_[k], value);
    if (!same_machine(patched, read_with({parameters_[k].setting(value)}))) return false;
  }
  return true;
}

const Scene& VariedScene::at(const std::vector<double>& values) {
  if (!all_in_place_) {
    scene_ = read(values);
    return scene_;
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    Setting* const setting = quantity_at(scene_.components, parameters_[k].path);
    setting->number = in_si(parameters_[k], values[k]);
  }
  return scene_;
}

namespace {

MachineAnswer answer_of_run(const MachineQuestion& q, const Scene& scene, bool measure) {
  SimulateOptions options;
  options.measure_error = measure;
  options.watch.interrupted = q.interrupted;
  Scene unseen = scene;
  unseen.run.samples = 0;  // the motion of a variant is not needed
  Result result = simulate(unseen, unseen.effects, "", options);
  if (!result.complete) return {RowState::failed, result.diagnosis, {}};
  return {result.unconfirmed() ? RowState::unconfirmed : RowState::done,
          result.unconfirmed() ? result.accuracy_in_words() : "", std::move(result.figures)};
}

MachineAnswer answer_of_steady(const MachineQuestion& q, const Scene& scene, bool measure) {
  SteadyOptions options;
  options.start_search = false;
  options.every_order = q.every_order;
  options.watch.interrupted = q.interrupted;
  const SteadyStudy study = steady(scene, {scene.effects}, options);
  if (study.cycles.empty()) return {RowState::failed, study.diagnosis, {}};
  const SteadyCycle& cycle = study.cycles.front();
  if (!cycle.found) return {RowState::failed, cycle.why.empty() ? study.diagnosis : cycle.why, {}};
  MachineAnswer answer{RowState::done, "", cycle.figures};
  if (!measure)
    for (Figure& f : answer.figures) f.error.reset();
  return answer;
}

MachineAnswer answer_of_modes(const MachineQuestion& q, const Scene& scene) {
  ModesOptions options;
  options.modes_alone = true;
  options.watch.interrupted = q.interrupted;
  const ModesStudy study = find_modes(scene, effects_of_modes(scene), options);
  if (!study.complete) return {RowState::failed, study.diagnosis, {}};
  MachineAnswer answer;
  if (study.start_unknown) answer.state = RowState::unconfirmed, answer.diagnosis = study.orbit;
  answer.figures = figures_of(study);
  return answer;
}

MachineAnswer answer_of_size(const MachineQuestion& q, const Scene& scene) {
  SizeOptions options;
  options.delta = q.delta;
  options.simulate = false;
  options.simulation.watch.interrupted = q.interrupted;
  const Sizing sizing = size_flywheel(scene, options);
  if (!sizing.complete) return {RowState::failed, sizing.diagnosis, {}};
  MachineAnswer answer;
  for (const KeyFigure& f : findings_of(sizing).figures)
    if (!f.means.empty() && f.means != "delta_reached") answer.figures.push_back({f, f.means, f.unit});
  return answer;
}

MachineAnswer answer_of(const MachineQuestion& q, VariedScene& varied, const std::vector<double>& values,
                        bool measure) {
  MachineAnswer answer;
  const auto compute = [&] {
    const Scene& scene = varied.at(values);
    answer = q.of == SweepStudy::run      ? answer_of_run(q, scene, measure)
             : q.of == SweepStudy::steady ? answer_of_steady(q, scene, measure)
             : q.of == SweepStudy::modes  ? answer_of_modes(q, scene)
                                          : answer_of_size(q, scene);
  };
  if (const auto failure = failure_of(compute, q.interrupted)) answer = {RowState::failed, failure->reason, {}};
  return answer;
}

bool is_stopped(const MachineQuestion& q) { return q.interrupted && q.interrupted->load(); }

// As it is.
MachineAnswer answer_or_stop(const MachineQuestion& q, VariedScene& scene, bool measure) {
  MachineAnswer answer = answer_of(q, scene, {}, measure);
  if (is_stopped(q)) throw OutOfTime(0);
  return answer;
}

}  // namespace

const Key* quantity_key(const Scene& scene, const std::string& path) {
  return quantity_place(scene.components, path).key;
}

std::vector<SweptFigure> figures_of(const MachineQuestion& question) {
  VariedScene scene(question, {});
  std::vector<SweptFigure> known;
  const auto add = [&](const std::string& name, const std::string& unit) {
    if (std::none_of(known.begin(), known.end(), [&](const SweptFigure& f) { return f.name == name; }))
      known.push_back({name, unit});
  };
  const MachineAnswer answer = answer_or_stop(question, scene, false);
  for (const Figure& f : answer.figures) add(f.name, f.unit);
  if (question.of == SweepStudy::run) {
    const Scene& as_it_is = scene.at({});
    for (const Figure& f : figure_list(*compile(as_it_is, as_it_is.effects))) add(f.name, f.unit);
  }
  if (known.empty())
    throw std::runtime_error(fmt::format("the scene as it is yields no figures ({}); mend it first", answer.diagnosis));
  return known;
}

// Amplitude or phase of one order: there are hundreds, so they are not selected by default.
static bool is_order(const SweptFigure& figure) {
  using namespace quantities;
  for (QuantityKind kind :
       {speed_order, torque_order, QuantityKind{angle.channel, Functional::order, QuantityKind::Window::cycle}})
    for (const Functional functional : {Functional::order, Functional::order_phase}) {
      kind.functional = functional;
      if (is_asked_for(figure.name, word(kind))) return true;
    }
  return false;
}

std::vector<SweptFigure> chosen(const std::vector<SweptFigure>& known, const std::vector<std::string>& asked) {
  std::vector<SweptFigure> list;
  if (asked.empty()) {
    std::copy_if(known.begin(), known.end(), std::back_inserter(list),
                 [](const SweptFigure& f) { return !is_order(f); });
    return list;
  }
  for (const std::string& name : asked) {
    const std::size_t before = list.size();
    for (const SweptFigure& f : known)
      if (is_asked_for(f.name, name))
        if (std::none_of(list.begin(), list.end(), [&](const SweptFigure& g) { return g.name == f.name; }))
          list.push_back(f);
    if (list.size() > before) continue;
    std::vector<std::string> names;
    for (const SweptFigure& f : known) names.push_back(f.name);
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;  // given twice
    throw std::invalid_argument(fmt::format("--figures {}: no such figure{}; there are: {}", in_quotes(name),
                                            suggestion(name, names), shortened_list(names, "and")));
  }
  return list;
}

MachineAnswer answer_of(const MachineQuestion& question) {
  VariedScene varied(question, {});
  MachineAnswer answer = answer_or_stop(question, varied, question.errors_every > 0);
  const Scene& scene = varied.at({});
  answer.file = question.file, answer.title = scene.title, answer.text = scene.text;
  answer.speed_unit = scene.speed_unit;
  return answer;
}

Evaluator machine_evaluator(MachineQuestion question, const VariedScene& scene,
                            const std::vector<SweptFigure>& figures) {
  std::unordered_map<std::string, std::size_t> numbers;
  for (std::size_t k = 0; k < figures.size(); ++k) numbers[figures[k].name] = k;
  question.every_order = true;  // one that matters in the machine as it is may be small in a row
  return [question, numbers, varied = scene](SweepRow& row) mutable {
    const bool measure = question.errors_every > 0 && row.row % question.errors_every == 0;
    MachineAnswer answer = answer_of(question, varied, row.parameters, measure);
    if (is_stopped(question)) return false;
    row.state = answer.state;
    row.diagnosis = std::move(answer.diagnosis);
    for (const Figure& f : answer.figures)
      if (const auto found = numbers.find(f.name); found != numbers.end()) row.figures.push_back({f, found->second});
    std::sort(row.figures.begin(), row.figures.end(),
              [](const RowFigure& a, const RowFigure& b) { return a.figure < b.figure; });
    return true;
  };
}

std::vector<SweepRow> rows_of(const MachineQuestion& question, const VariedScene& scene,
                              const std::vector<SweptFigure>& figures, const std::vector<std::vector<double>>& values,
                              int jobs) {
  std::vector<SweepRow> rows(values.size());
  const bool whole = in_threads(values.size(), jobs, [&]() -> Worker {
    return [&, evaluate = machine_evaluator(question, scene, figures)](std::size_t i) {
      rows[i].row = i, rows[i].parameters = values[i];
      return evaluate(rows[i]);
    };
  });
  if (!whole) throw OutOfTime(0);
  return rows;
}

}  // namespace kurbel
