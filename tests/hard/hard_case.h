// hard_case.h — a case that breaks ordinary solvers: the machine, how its answer is known, who may try it; and what
// became of it with one method at one accuracy.
//
//   HardCase{.family = "DeadCentre", .name = "…", .parameter = "…", .scene = "…", .truths = {closed_form("…", {…})}}
//   run_case(hard_case, "dop853", 1e-6).verdict
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studies/findings/result.h"

namespace kurbel::hard {

struct Judgement {
  double error = 0;        // over the figure's scale
  std::string what;        // the figure that is worst
  double uncertainty = 0;  // of the truth itself, over the same scale
  bool reports = true;     // an answer of nothing at all would fail
};

// How the answer is known.
struct Truth {
  std::string words;  // "closed form: ω = M t/I"
  std::function<Judgement(const Result&)> judge;
};

struct Known {
  std::string figure;
  double value = 0;
  double scale = 0;  // 0: the program's own scale of the figure
};
// Judged by ten times itself: where the program's scale is a million times the figure, as that of a blow's torque for
// what follows it, no answer could fail.
inline Known by_its_size(std::string figure, double value) { return {std::move(figure), value, 10 * std::abs(value)}; }

// Figures that a formula gives.
Truth closed_form(std::string words, std::vector<Known> figures);

// Figures of the same scene by two methods at local tolerances of 1e-13; their difference is the uncertainty. Found
// when first requested.
Truth converged(const std::string& scene, std::vector<std::string> figures, const std::string& method = "dop853",
                const std::string& second = "verner6", const std::string& effects = "");

// Anything else that is to be small: a residual over its scale.
Truth residual(std::string words, std::function<double(const Result&)> of);

struct HardCase {
  std::string family;     // "DeadCentre"; one file each
  std::string name;       // states the fact: "AtRestUnderTorqueItStaysThere"; letters and digits
  std::string parameter;  // the hard parameter with its value: "l/r = 1.0001"
  std::string scene;
  std::string effects = "";  // other than the scene's, as on the command line
  std::vector<Truth> truths = {};
  bool energy = true;  // the energy balance is a truth, too
  // Measured: change of the figures (over their scales) over the change of the data that rounding makes (2.2e-16).
  double condition = 0;
  std::string condition_words = "";  // how it was measured
  std::vector<std::string> refusal =
      {};  // words of the diagnosis or refusal that is the right end; empty: an answer is
  std::map<std::string, std::string> excluded = {};  // method: the reason
  // method: the finest accuracy that it is run at, and why not more.
  std::map<std::string, std::pair<double, std::string>> finest = {};
  std::map<std::string, std::shared_ptr<const HardCase>> variants = {};  // method: a shortened case for it
  bool heavy = false;  // the tests run it with what the program chooses alone, the bench with all its budget
  double budget = 10;  // processor time of an integration [s]
};

enum class Verdict {
  passed,      // error ≤ 20 × (requested accuracy + condition × rounding)
  reported,    // the program says that it reached less than requested, and how much, true within 20 × of that; or
               // that the tighter run failed, and how, so that its figures come without errors
  refused,     // ended with the words that belong here
  unfinished,  // stopped at its budget, in words
  excluded,    // the method does not apply; the reason is given
  failed
};
const char* name_of(Verdict verdict);

struct CaseOutcome {
  Verdict verdict = Verdict::failed;
  std::string words;  // the worst figure, the diagnosis or the reason
  double error = 0, asked = 0, allowed = 0;
  double smallest_step = 0;  // [s]
  std::int64_t steps = 0, events = 0;
  double cpu_seconds = 0;  // of all runs of the cell
  int runs = 0;
  double ratio() const { return asked > 0 ? error / asked : 0; }
};

// "auto", every integrator of the reduced model, and "multibody" (which only cases with a variant for it try).
const std::vector<std::string>& all_methods();
const std::vector<double>& all_accuracies();  // 1e-3 … 1e-10

// The error that a passed cell may have over the requested accuracy.
inline constexpr double allowed_ratio = 20;

// One run at the local tolerance that belongs to the accuracy, without the tighter one that measures its error.
Result single_run(const HardCase& hard_case, const std::string& method, double accuracy);

// budget: at most this much processor time an integration [s], whatever the case requires.
CaseOutcome run_case(const HardCase& hard_case, const std::string& method, double accuracy, double budget = 1e9);

}  // namespace kurbel::hard
