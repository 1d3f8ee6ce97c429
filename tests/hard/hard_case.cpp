// hard_case.cpp — runs a hard case as a user would, and judges what comes out.
#include "tests/hard/hard_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "engine/run/recorders.h"
#include "engine/scene/messages.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"

namespace kurbel::hard {
namespace {

constexpr double reference_accuracy = 1e-12, rounding = 2.2e-16;
// Figures that the program gives without errors because the tighter run failed may be off by this many times what a
// passed cell may.
constexpr double without_errors = 50;

Scene scene_of(const std::string& text) { return parse_scene(text, "hard_case.toml", all_kinds()); }

Effects effects_of(const Scene& scene, const std::string& effects) {
  return effects.empty() ? scene.effects : parse_effects(effects, scene);
}

const Figure& figure_of(const Result& result, const std::string& name) {
  const Figure* figure = result.find(name);
  if (!figure) throw std::logic_error("no figure " + name);
  return *figure;
}

double scale_of(const Figure& figure, double given) {
  const double scale = given > 0 ? given : figure.scale;
  if (!(scale > 0)) throw std::logic_error("no scale for figure " + figure.name);
  return scale;
}

// Would the figure's absence fail? (A figure that is to be 0 shows it by what it is otherwise.)
bool reports(double value, double scale, double accuracy) {
  return value == 0 || std::abs(value) > allowed_ratio * accuracy * scale;
}

// Not a number counts as worst.
void take_worse(Judgement& worst, const Judgement& next) {
  if (std::isnan(worst.error)) return;
  if (!(next.error <= worst.error)) worst = next;
}

std::string note_with(const Result& result, const std::string& words) {
  for (const std::string& note : result.notes)
    if (note.find(words) != std::string::npos) return note;
  return {};
}

// Two runs of one scene by two methods; the equations are the same.
class Reference {
 public:
  Reference(std::string scene, std::string effects, std::string first, std::string second)
      : scene_(std::move(scene)), effects_(std::move(effects)), first_(std::move(first)), second_(std::move(second)) {}

  Judgement judge(const Result& result, const std::vector<std::string>& figures) {
    const std::lock_guard lock(mutex_);
    if (!known_) {
      best_ = run(first_);
      other_ = run(second_);
      known_ = true;
    }
    Judgement worst;
    bool some_report = false;
    for (const std::string& name : figures) {
      const Figure& truth = figure_of(best_, name);
      const double scale = scale_of(truth, 0);
      some_report = some_report || reports(truth.value, scale, result.accuracy);
      take_worse(worst, {std::abs(figure_of(result, name).value - truth.value) / scale, name,
                         std::abs(figure_of(other_, name).value - truth.value) / scale});
    }
    worst.reports = some_report;
    return worst;
  }

 private:
  Result run(const std::string& method) const {
    const Scene scene = scene_of(scene_);
    SimulateOptions options;
    options.method = method;
    options.accuracy = reference_accuracy;
    options.measure_error = false;
    Result result = simulate(scene, effects_of(scene, effects_), "reference", options);
    if (!result.complete || !note_with(result, "the contact chatters").empty())
      throw std::logic_error("the reference did not come to its end in order: " + result.diagnosis);
    return result;
  }
  std::string scene_, effects_, first_, second_;
  std::mutex mutex_;
  bool known_ = false;
  Result best_, other_;
};

bool holds_all(const std::string& text, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

std::string all_words(const Result& result) {
  std::string text = result.diagnosis;
  for (const std::string& note : result.notes) text += "\n" + note;
  for (const Event& event : result.events) text += "\n" + event.component + " " + event.what;
  return text;
}

Judgement judge(const HardCase& hard_case, const Result& result) {
  Judgement worst;
  for (const Figure& figure : result.figures)
    if (!std::isfinite(figure.value)) return {HUGE_VAL, figure.name + " is not finite", 0};
  bool some_report = false;
  for (const Truth& truth : hard_case.truths) {
    const Judgement next = truth.judge(result);
    some_report = some_report || next.reports;
    take_worse(worst, next);
  }
  if (!some_report) return {HUGE_VAL, "no figure that could fail at this accuracy", 0};
  if (hard_case.energy) take_worse(worst, {result.energy.relative, "energy balance", 0});
  return worst;
}

bool spent_its_budget(const Result& result) {
  return all_words(result).find("of processor time is spent") != std::string::npos;
}

void judge_answer(const HardCase& hard_case, const Result& result, CaseOutcome& out) {
  if (!result.complete || (!result.errors_measured && spent_its_budget(result))) {
    out.verdict = spent_its_budget(result) ? Verdict::unfinished : Verdict::failed;
    out.words = result.complete ? note_with(result, "the confirming run failed") : result.diagnosis;
    return;
  }
  if (!note_with(result, "the contact chatters").empty()) {
    out.words = note_with(result, "the contact chatters");
    return;
  }
  const Judgement found = judge(hard_case, result);
  out.error = found.error;
  const double reported = allowed_ratio * result.measured_accuracy;
  const std::string unconfirmed = note_with(result, "the confirming run failed");
  if (found.uncertainty > out.allowed) {
    out.words = fmt::format("the truth of {} itself is known to {:.1e} only", found.what, found.uncertainty);
  } else if (found.error <= out.allowed) {
    out.verdict = Verdict::passed;
    out.words = found.what;
  } else if (!unconfirmed.empty() && found.error <= without_errors * out.allowed) {
    out.verdict = Verdict::reported;
    out.words = found.what + ": " + unconfirmed;
  } else if (result.errors_measured && !result.accuracy_confirmed && found.error <= reported) {
    out.verdict = Verdict::reported;
    out.words = fmt::format("{}: the program says that it reached {:.1e}", found.what, result.measured_accuracy);
  } else {
    out.words =
        fmt::format("{} is wrong by {:.2e} of its scale ({})", found.what, found.error,
                    result.accuracy_confirmed ? "unnoticed" : fmt::format("{:.1e} stated", result.measured_accuracy));
  }
}

void judge_refusal(const HardCase& hard_case, const std::string& words, CaseOutcome& out) {
  if (holds_all(words, hard_case.refusal)) {
    out.verdict = Verdict::refused;
    out.words = words;
  } else {
    out.words = "ended otherwise than it should: " + (words.empty() ? "without a word" : words);
  }
}

Result simulate_case(const HardCase& hard_case, const std::string& method, double accuracy, bool measure_error,
                     double budget) {
  Scene scene = scene_of(hard_case.scene);
  SimulateOptions options;
  options.accuracy = accuracy;
  options.measure_error = measure_error;
  options.budget = std::min(hard_case.budget, budget);
  if (method == "multibody") {
    scene.run.model = "multibody";
  } else {
    options.method = method;
  }
  return simulate(scene, effects_of(scene, hard_case.effects), "hard case", options);
}

}  // namespace

Truth closed_form(std::string words, std::vector<Known> figures) {
  return {"closed form: " + std::move(words), [figures = std::move(figures)](const Result& result) {
            Judgement worst;
            bool some_report = false;
            for (const Known& known : figures) {
              const Figure& figure = figure_of(result, known.figure);
              const double scale = scale_of(figure, known.scale);
              some_report = some_report || reports(known.value, scale, result.accuracy);
              take_worse(worst, {std::abs(figure.value - known.value) / scale, known.figure, 0});
            }
            worst.reports = some_report;
            return worst;
          }};
}

Truth converged(const std::string& scene, std::vector<std::string> figures, const std::string& method,
                const std::string& second, const std::string& effects) {
  const auto reference = std::make_shared<Reference>(scene, effects, method, second);
  return {
      fmt::format("reference: {} and {} at local tolerances of {:.0e}", method, second, 0.1 * reference_accuracy),
      [reference, figures = std::move(figures)](const Result& result) { return reference->judge(result, figures); }};
}

Truth residual(std::string words, std::function<double(const Result&)> of) {
  return {words, [words, of = std::move(of)](const Result& result) { return Judgement{of(result), words, 0}; }};
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::reported:
      return "told";
    case Verdict::refused:
      return "refused";
    case Verdict::unfinished:
      return "unfinished";
    case Verdict::excluded:
      return "excluded";
    case Verdict::failed:
      return "failed";
  }
  return "unknown";
}

const std::vector<std::string>& all_methods() {
  static const std::vector<std::string> methods = {"auto",  "work",    "dopri5", "verner6", "dop853", "fehlberg8",
                                                   "adams", "esdirk3", "esdirk", "esdirk5", "bdf",    "multibody"};
  return methods;
}

const std::vector<double>& all_accuracies() {
  static const std::vector<double> accuracies = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
  return accuracies;
}

Result single_run(const HardCase& hard_case, const std::string& method, double accuracy) {
  return simulate_case(hard_case, method, accuracy, false, hard_case.budget);
}

CaseOutcome run_case(const HardCase& whole, const std::string& method, double accuracy, double budget) {
  const auto variant = whole.variants.find(method);
  const HardCase& hard_case = variant == whole.variants.end() ? whole : *variant->second;
  CaseOutcome out;
  out.asked = accuracy;
  out.allowed = allowed_ratio * (accuracy + hard_case.condition * rounding);
  const auto exclude = [&](const std::string& reason) {
    out.verdict = Verdict::excluded;
    out.words = reason;
    return out;
  };
  if (const auto reason = hard_case.excluded.find(method); reason != hard_case.excluded.end())
    return exclude(reason->second);
  if (const auto limit = hard_case.finest.find(method);
      limit != hard_case.finest.end() && accuracy < 0.99 * limit->second.first)
    return exclude(limit->second.second);
  if (method == "multibody" && variant == whole.variants.end())
    return exclude("Simbody's closed loop runs rigid machines of one slider-crank, a thousand times slower");
  try {
    const Result result = simulate_case(hard_case, method, accuracy, true, budget);
    out.steps = result.statistics.stepper.steps;
    out.smallest_step = result.statistics.smallest_step;
    out.events = result.statistics.events;
    out.cpu_seconds = result.cpu_total;
    out.runs = result.runs;
    if (hard_case.refusal.empty()) {
      judge_answer(hard_case, result, out);
    } else {
      judge_refusal(hard_case, all_words(result), out);
    }
  } catch (const SceneError& error) {
    if (hard_case.refusal.empty()) {
      out.words = error.what();
    } else {
      judge_refusal(hard_case, error.what(), out);
    }
  } catch (const std::invalid_argument& error) {
    if (method == "work" || method == "fehlberg8") return exclude(error.what());  // they say where they do not apply
    out.words = error.what();
  }
  return out;
}

}  // namespace kurbel::hard
