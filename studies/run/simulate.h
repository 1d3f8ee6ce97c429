// simulate.h — one scene, one set of effects: run until a tighter run and one from elsewhere confirm the accuracy asked
// for.
#pragma once

#include "engine/model/model.h"
#include "studies/findings/result.h"
#include "studies/findings/watch.h"

namespace kurbel {

struct SimulateOptions {
  bool measure_error = true;
  bool traces = false;                // follow everything along the steps, for a report's plots
  std::optional<std::string> method;  // overrides the scene's
  std::optional<double> accuracy, until;
  Watch watch = {};
  std::optional<double> first_tolerance = {};  // the ladder begins there; default: accuracy/10
  std::string chosen_because = {};             // for people: who says so
  std::string go_on_from = {};        // text of a checkpoint (engine/run/checkpoint.h): figures are of what follows it
  bool timed = false;                 // its time is compared: a short run is made several times, the least counts
  bool keep_state = false;            // the result's checkpoint is wanted: no method over the angle
  std::optional<double> budget = {};  // processor time of one integration [s], if shorter than the scene's
};

// Throws SceneError where the scene makes no machine; a run that fails on its way is returned incomplete.
Result simulate(const Scene& scene, const Effects& effects, const std::string& label, const SimulateOptions& options);
Result simulate(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options);

// Names and units of all figures that runs of a model can yield.
std::vector<Figure> figure_list(const Model& model);

// Processor times nearer to each other than this factor are not told apart: that of one run differs so much between runs.
inline constexpr double alike_in_time = 1.25;

// Local tolerances are this much tighter in the run that confirms.
inline constexpr double tolerance_step = 30;

}  // namespace kurbel
