// trials.h — what effects that are off would change: one run each, while runs are short.
//
// A scene may hold data of effects that are off in a run: stiffnesses of a machine that is taken as rigid, friction,
// gaps, circuits. Each is tried by one more run with it on, all else alike; elasticity that is off, all of it at once.
// Figures are compared one by one, each by its own size: what the models differ by, and what the runs leave open of
// it, are told apart (figure_changes.h).
// What trials may cost is bounded, so that they stay a remark: nothing is tried after a run of more than half a second
// of processor time; each integration has that much, all trials together have two seconds.
#pragma once

#include <string>
#include <vector>

#include "studies/effects/effect_units.h"
#include "studies/findings/figure_changes.h"
#include "studies/findings/output.h"
#include "studies/run/compare.h"
#include "studies/run/simulate.h"

namespace kurbel {

struct Trial {
  EffectUnit effect = {};                  // elasticity: of all components where it is off
  std::vector<FigureChange> changes = {};  // with the effect against without, the surely greatest first
  std::string failed = {};                 // why the machine does not run with it; empty: it does
  // The first change that is surely this large, of the figure with the effect; null: none is.
  const FigureChange* move(double least) const;
};

struct Trials {
  static constexpr double least_move = 0.01;  // of a figure: what is worth a line
  std::vector<Trial> tried = {};
  std::vector<std::string> left_out = {};  // effects that were not tried, and why: a line each
};

struct TrialLimits {
  double run = 0.5;  // processor time [s] of the run, and of one integration of a trial
  double all = 2;    // of all trials together
};

// Of a run of this scene with these effects. The run itself stays what it is.
Trials try_what_is_off(const Scene& scene, const Effects& effects, const Result& run, SimulateOptions options,
                       const TrialLimits& limits = {});

// A run, or two compared, with trials beside it: of the second of the two. Both must outlive their findings.
struct TriedRun {
  const Result& run;
  const Trials& trials;
};
struct TriedComparison {
  const Comparison& comparison;
  const Trials& trials;
};
Findings findings_of(const TriedRun& tried);
Findings findings_of(const TriedComparison& tried);

}  // namespace kurbel
