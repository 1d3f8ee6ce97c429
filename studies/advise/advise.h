// advise.h — the cheapest set of effects, by evaluations × states, whose figures stay within a tolerance of the fullest
// model: screened, then run.
#pragma once

#include <string>
#include <vector>

#include "studies/advise/advise_screens.h"
#include "studies/advise/deviation.h"
#include "studies/effects/effect_study.h"
#include "studies/findings/output.h"

namespace kurbel {

struct AdviseOptions {
  SimulateOptions simulate;
  double within = 0.01;              // relative deviation allowed of every figure
  std::vector<std::string> figures;  // names or their beginnings; empty: all significant ones
  bool held_out = true;              // check other figures and operating points too
};

// A set of effects that was run against the full model, and the deviations of the required figures.
struct TriedSet : Deviation {
  EffectSet on = {};
  std::string words = {};
  double cpu_seconds = 0;        // measured: depends on what else the computer does
  std::int64_t evaluations = 0;  // of the equations, their Jacobian and its factors
  ModelSize size = {};
  std::string refused = {};  // why it did not run

  // What a run costs, the same in every run: the choice is made by it.
  double work() const { return static_cast<double>(evaluations) * static_cast<double>(size.states); }
};

// The recommended set at an operating point that was not used for the choice.
struct HeldOut : Deviation {
  std::string what = {}, refused = {};  // "loads +20 % (load.torque)"
};

struct Advice : SceneStudy {
  double tolerance = 0;
  std::vector<std::string> figures;
  std::vector<EffectUnit> units;
  Result full;
  std::vector<std::vector<Screen>> screens;  // per unit
  std::vector<TriedSet> tried;               // the full set first
  std::size_t chosen = 0;                    // among tried
  std::vector<std::string> kept_because;     // per unit: why it is kept or dropped
  std::vector<HeldOut> held_out;
  double time_spread = 0;  // of processor times: relative, between two runs of the chosen set
  std::vector<std::string> warnings;
  std::string lean_scene;
};

// Never recommends a set that was not run. Throws std::invalid_argument if there is no choice.
Advice advise(const Scene& scene, const AdviseOptions& options);

// The advice must outlive the findings.
Findings findings_of(const Advice& advice);

}  // namespace kurbel
