// simulate.h — one scene, one set of effects: run until a tighter run and an independent one confirm the requested
// accuracy.
#pragma once

#include "engine/model/model.h"
#include "studies/findings/result.h"
#include "studies/findings/watch.h"

namespace kurbel {

struct SimulateOptions {
  bool measure_error = true;
  bool traces = false;                // record everything along the steps, for the plots of a report
  std::optional<std::string> method;  // overrides the scene's
  std::optional<double> accuracy, until;
  Watch watch = {};
  std::optional<double> first_tolerance = {};  // the sequence of tolerances begins there; default: accuracy/10
  std::string chosen_because = {};             // reason of this choice, for people
  std::string go_on_from = {};                 // text of a checkpoint (engine/run/checkpoint.h): figures start there
  bool timed = false;                          // its time is compared: a short run is repeated, the least time counts
  bool keep_state = false;                     // the checkpoint of the result is needed: no method over the angle
  std::optional<double> budget = {};           // processor time of one integration [s], if shorter than the scene's
};

// Throws SceneError if no machine can be made; a run that fails is returned incomplete.
Result simulate(const Scene& scene, const Effects& effects, const std::string& label, const SimulateOptions& options);
Result simulate(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options);

// Names and units of all figures that runs of a model can yield.
std::vector<Figure> figure_list(const Model& model);

// Processor times within this factor are not distinguished: that of one run varies this much between repetitions.
inline constexpr double alike_in_time = 1.25;

// Factor by which the confirming run has tighter local tolerances.
inline constexpr double tolerance_step = 30;

}  // namespace kurbel
