// effect_study.h — what each effect changes and costs: the full model, and the model without one effect at a time.
#pragma once

#include <string>
#include <vector>

#include "studies/effect_units.h"
#include "studies/simulate.h"

namespace kurbel {

// How far a figure is from that of the full model, over the full model's value of it: 0.01 is one per cent of the
// figure itself, be it a δ of 0.002 or a torque far below the rated one. Only a figure that the full model does not
// tell from zero is judged by its floor instead: its measured error and max(1e-9, tolerance) of its rated quantity. A
// figure that is zero in both models is left out.
struct FigureChange {
  std::string figure, unit;
  double full = 0, without = 0, relative = 0;
  bool from_nothing = false;  // the full model's value is not told from zero
};

struct LeftOut {
  EffectUnit effect = {};
  Result result = {};
  std::vector<FigureChange> changes = {};  // of the figures that both have, the greatest first
  ModelSize saved = {};                    // states, nonzeros, guards that the effect adds
  long events_added = 0;
  double time_ratio = 0;     // processor time of the full model over that without
  std::string refused = {};  // why the machine cannot run without it
};

struct EffectStudy {
  std::string title, scene_file, scene_text;
  std::vector<EffectUnit> units;
  Result full;
  ModelSize size;
  std::vector<LeftOut> left_out;  // ranked by their greatest change
  std::string conclusion;
};

// What a figure of a run does not tell from nothing: its measured error, and what steps and rounding resolve of the
// rated quantity.
double floor_of(const Figure& figure, const Result& run);
// Figures worth comparing: peaks, speeds, fluctuation, periods, works; not those of single angles or of rounding.
bool is_telling(const Figure& figure);
// Changes of the telling figures of `other` against `full`; only `wanted`, unless empty (names or their beginnings).
std::vector<FigureChange> changes_between(const Result& full, const Result& other,
                                          const std::vector<std::string>& wanted = {});

// Throws std::invalid_argument where the scene has no effect to leave out.
EffectStudy study_effects(const Scene& scene, const SimulateOptions& options);

}  // namespace kurbel
