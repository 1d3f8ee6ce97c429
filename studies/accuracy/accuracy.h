// accuracy.h — the cost of accuracy: error against processor time, over integrators, tolerances and levels of modelling.
//
// Levels of modelling form a series: the bare rigid machine, then one effect more per level, up to all that the scene
// has parameters for. Every level has a reference by two independent methods at the tightest tolerance; their
// difference is the smallest error that is ever stated. Then each method runs through all tolerances.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "studies/findings/output.h"
#include "studies/findings/watch.h"

namespace kurbel {

struct AccuracyOptions {
  std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  std::vector<std::string> methods = {};  // of the reduced model; empty: all that apply
  bool multibody = true;
  std::vector<std::string> figures = {};  // followed before all others; questions refer to the first
  std::optional<double> within = {};  // "how cheap is an error of at most this?" relative, against the fullest model
  std::optional<double> budget = {};  // "how accurate is a result for this processor time?" [s]
  double time = 60;                   // processor time for the whole study, about [s]
  int most_repetitions = 9;
  Watch watch = {};
};

// A figure whose error is followed; all errors of figures are relative to the reference's value.
struct FollowedFigure {
  std::string name, unit;
};

// One level of modelling with its converged result.
struct ModelLevel {
  // "energy method", "rigid", "with joint friction", "elastic: main_coupling", "elastic", "multibody"
  std::string name = {};
  std::string called = {};   // in sentences: "rigid model", "model with gear losses", "model elastic in shaft alone"
  std::string effects = {};  // of the model
  std::size_t coordinates = 0;
  std::string first = {}, second = {};  // methods of the reference
  double tolerance = 0;                 // of both
  double agreement = 0;                 // of the two trajectories, over scales: smaller errors cannot be resolved
  std::vector<double> value = {},
                      floor = {};  // per followed figure; NaN: the level does not yield it. floor: relative agreement
  std::vector<double> model_error = {};  // per followed figure: reference against that of the fullest level
  // Of the cheapest setting within `close_enough` of the level's own key figure; NaN: none measured.
  double seconds = std::numeric_limits<double>::quiet_NaN();
};
inline constexpr double close_enough = 1e-3;

// One level in the series of models: the effects of the levels before, and one more.
struct ModelRung {
  std::string name, called;       // "elastic", "elastic model", as the level's
  Effects effects;                // all that are on
  bool Effects::*adds = nullptr;  // null: the bare machine, or elasticity
  bool of_scene = true;           // on in the scene; its own effects come first: its model is a level, too
};

// Rigid, then the effects that the scene has on, then those that it only has parameters for: first those of a rigid machine,
// then elasticity, then those that need elasticity. Mechanisms evaluated body by body: only if the scene has that on.
std::vector<ModelRung> model_rungs(const Scene& scene);

// One method at one tolerance on one level.
struct MeasuredSetting {
  std::size_t level = 0;
  std::string method;
  double tolerance = 0;                 // 0: the method has none
  double trajectory_error = 0;          // largest of angles [rad], speeds and twists over their own largest value
  std::vector<double> numerical_error;  // per followed figure, against the level's reference; at least its floor
  std::vector<double> total_error;      // against the fullest model
  double seconds = 0, fastest = 0, slowest = 0;  // processor time: median and spread
  int repetitions = 0;
  std::int64_t steps = 0, rejected = 0, flow_calls = 0, jacobian_calls = 0, events = 0;
  double energy_drift = 0;      // residual of the energy balance over the energy converted
  bool on_level_front = false;  // no setting of the level has a smaller trajectory error in less time
  bool on_front = false;        // no setting at all has a smaller total error in the key figure in less time
};

struct Omission {
  std::string what, why;
};

struct AccuracyStudy : SceneStudy {
  std::vector<FollowedFigure> figures;
  std::size_t key = 0;             // of the figures
  std::vector<ModelLevel> levels;  // the series up to `fullest`, the reference of the others; then own solvers
  std::size_t fullest = 0;
  std::size_t own = 0;  // level with the scene's own effects
  std::vector<MeasuredSetting> settings;
  std::vector<Omission> omissions;
  std::vector<std::string> findings;  // sentences from the data; the first is the conclusion
  std::vector<std::string> answers;   // to --within and --budget
  double seconds = 0;                 // of the whole study

  std::string name_of(const MeasuredSetting& s) const;  // "elastic, esdirk at 1e-05"
};

// Throws SceneError if no machine can be made from the scene, std::invalid_argument for a figure that it does not yield.
AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options);

// Evaluates the settings: fronts, findings, answers. Part of measure_accuracy().
void judge_accuracy(AccuracyStudy& study, const AccuracyOptions& options);

// Indices of the settings that no other beats in both error (by more than a tenth) and time, cheapest first.
std::vector<std::size_t> pareto_front(const std::vector<double>& error, const std::vector<double>& seconds);

// Files: settings.csv. The study must outlive the findings.
Findings findings_of(const AccuracyStudy& study);

}  // namespace kurbel
