// uncertainty.h — effect of tolerances on figures, and the reliability of each figure (after ASME V&V 20 and JCGM
// 101): numerical error, uncertainty by the inputs, and known biases, separately.
//
//     u² = Σ (∂y/∂x_i · u_i)²       by gradients: first order, independent parameters (JCGM 100, 5.1.2)
//     y(x), x random                by samples: check of the gradients (JCGM 101)
//     b = y with an effect − y      a bias: signed, individual, never added in quadrature
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
  bool biases = true;  // for run: try the effects that are off
  Watch watch = {};
};

// Contribution of one parameter to one figure.
struct ToleranceShare {
  std::size_t parameter = 0;
  double gradient = 0;  // ∂y/∂x, x in its unit
  // |∂y/∂x| u. Error: from the measured errors of the two runs, (e₊ + e₋)/(x₊ − x₋) · u; empty: not measured.
  Estimate deviation = {};
  double step = 0;        // the difference was taken over ± this many deviations
  Estimate share = {};    // of Σ deviation²
  Estimate without = {};  // remaining u if this parameter had no tolerance
};

// A shift, signed: with the effect − without.
struct Bias : Estimate {
  std::string effect;
};

// With the measured error at the given values.
struct FigureUncertainty : Estimate {
  SweptFigure figure;
  // Standard uncertainty u. Error: the noise floor, √Σ (errors of the deviations)²: a smaller u may be numerical error alone.
  Estimate by_gradients = {};
  // Standard deviation and mean of the samples; 95 % of them lie between low and high, empty for fewer than 40. Errors: two
  // standard errors of n samples, for the ends the 95 % interval of a quantile, and the largest error of a run.
  Estimate by_samples = {}, mean = {};
  std::optional<Estimate> low = {}, high = {};
  std::size_t samples = 0;
  std::vector<ToleranceShare> shares = {};  // the greatest first
  std::vector<Bias> biases = {};

  // Whether gradients are valid over the tolerances: their deviation agrees with that of the samples within a tenth,
  // and the samples' mean is within a fifth of a deviation of the nominal value, apart from the scatter of n samples
  // (4 σ). Not decidable with fewer than 30 samples.
  bool is_linear() const;
  // By gradients if they are valid, else by samples.
  const Estimate& deviation() const { return is_linear() ? by_gradients : by_samples; }
};

struct UncertaintyStudy : SceneStudy {
  std::vector<Tolerated> parameters;
  std::vector<FigureUncertainty> figures;
  std::vector<LimitCount> limits;  // a machine that does not run meets none
  std::size_t drawn = 0, failed = 0;
};

// Throws std::invalid_argument if the scene has no tolerance, or a figure or a limit is invalid.
UncertaintyStudy study_uncertainty(const MachineQuestion& question, const UncertaintyOptions& options);

Findings findings_of(const UncertaintyStudy& study);

}  // namespace kurbel
