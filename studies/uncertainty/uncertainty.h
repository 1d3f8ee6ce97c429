// uncertainty.h — what tolerances make of the figures, and how sure each of them is (after ASME V&V 20 and JCGM 101):
// numerical error, uncertainty by the inputs, and known biases, apart.
//
//     u² = Σ (∂y/∂x_i · u_i)²       by gradients: first order, independent parameters (JCGM 100, 5.1.2)
//     y(x), x drawn                 by samples: what the gradients are checked by (JCGM 101)
//     b = y with an effect − y      a bias: signed, one each, never added in quadrature
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/sweep/influence.h"
#include "studies/sweep/limit.h"
#include "studies/uncertainty/tolerated.h"
#include "studies/variants/machine.h"

namespace kurbel {

struct UncertaintyOptions {
  std::vector<std::string> figures = {}, limits = {};
  std::size_t samples = 500;
  std::uint64_t seed = 1;
  int jobs = 1;
  bool biases = true;  // of run: try the effects that are off
  Watch watch = {};
};

// Of one figure by one parameter.
struct ToleranceShare {
  std::size_t parameter = 0;
  double gradient = 0;   // ∂y/∂x, x in its unit
  double deviation = 0;  // |∂y/∂x| u
  // Of the deviation: what the measured errors of the two runs leave open, (e₊ + e₋)/(x₊ − x₋) · u; none were measured.
  std::optional<double> noise = {};
  double step = 0;     // the difference was taken over ± so many deviations
  double share = 0;    // of Σ deviation²
  double without = 0;  // u that would remain if this parameter had no tolerance
};

struct Bias {
  std::string effect;
  double shift = 0;  // signed: with the effect − without
  std::optional<double> error = {};
};

struct FigureUncertainty {
  SweptFigure figure;
  double value = 0;                           // at the values as given
  std::optional<double> numerical = {};       // measured error there
  double by_gradients = 0;                    // standard uncertainty u
  std::optional<double> noise_floor = {};     // of u, √Σ noise²: what is below may be numerical errors alone
  double by_samples = 0, mean = 0;            // deviation, mean of the samples
  std::optional<double> low = {}, high = {};  // between them lie 95 % of the samples; of fewer than 40 nobody can say
  std::size_t samples = 0;
  std::vector<ToleranceShare> shares = {};  // the greatest first
  std::vector<Bias> biases = {};

  // Do gradients hold over the tolerances? Their deviation is that of the samples within a tenth, and the samples' mean
  // lies within a fifth of a deviation of the value as given, what chance does to n samples (4 σ) apart. Fewer than 30
  // samples do not tell.
  bool is_linear() const;
  // By gradients where they hold, else by samples.
  double deviation() const { return is_linear() ? by_gradients : by_samples; }
};

struct UncertaintyStudy {
  std::string title, scene_file, scene_text;
  std::vector<Tolerated> parameters;
  std::vector<FigureUncertainty> figures;
  std::vector<LimitCount> limits;  // a machine that does not run holds none
  std::vector<std::string> notes;
  std::size_t drawn = 0, failed = 0;
  SpeedUnit speed_unit;  // that people are told speeds in
  std::string conclusion;
  bool complete = true;
  std::string diagnosis;
};

// Throws std::invalid_argument where the scene gives no tolerance, a figure or a limit is none.
UncertaintyStudy study_uncertainty(const MachineQuestion& question, const UncertaintyOptions& options);

Findings findings_of(const UncertaintyStudy& study);

}  // namespace kurbel
