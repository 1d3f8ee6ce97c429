// measured_errors.h — what other runs of the same machine say of the errors of a run's figures.
#pragma once

#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Figures of another run. Their differences count `weight` times: 1 for a run that is coarser than the one it speaks
// of, so that the difference is the coarser one's error; 2 for one as exact, for then the difference is that of two
// like errors, either of which may be the larger.
struct Witness {
  const std::vector<Figure>* figures = nullptr;
  double weight = 1;
};

// Sets the error of every figure that a witness has, too:
//     error = max over witnesses weight |value − witness| + share · m · scale + what rounding and sampling leave open
// with m the median over all figures of the largest difference in their scales: one figure's difference may happen to
// vanish, those of all figures together do not. Peaks are compared by magnitude, for of two equal ones of opposite sign
// either may be the larger. What is exact by construction has its differences alone. Returns the largest error over its
// scale, of figures that are judged.
double measure_errors(std::vector<Figure>& figures, const std::vector<Witness>& witnesses);

// What a machine that is cut finer does otherwise is an error, too, beside that of integration: adds the differences to
// the errors that are known. Returns the largest over its scale.
double add_differences(std::vector<Figure>& figures, const std::vector<Figure>& finer);

}  // namespace kurbel
