// measured_errors.h — errors of a run's figures, measured by other runs of the same machine.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "studies/findings/result.h"

namespace kurbel {

// Of a result's size: results are sums of rounded numbers.
inline constexpr double rounding_of_a_run = 8 * std::numeric_limits<double>::epsilon();

// Figures of another run. Their differences are weighted: 1 for a run coarser than the one assessed, so that the
// difference is the coarser one's error; 2 for one of equal accuracy, as the difference then contains two similar
// errors, either of which may be the larger; 0.4 for a run coarser than the latter by tolerance_step, whose error is at
// least five times that of the finer one: twice what that one may hide.
struct Witness {
  const std::vector<Figure>* figures = nullptr;
  double weight = 1;
};

// Of figures with a scale: the largest error over its scale, and what the differences of any figure may hide by chance.
struct MeasuredErrors {
  double largest = 0, hidden = 0;
};

// Sets the error of every figure that a witness contains, too:
//     error = max over witnesses weight |value − witness| + share · m · scale + uncertainty of location and sampling
// with m the median over all figures of the largest difference over its scale: the difference of one figure may
// vanish by chance, those of all figures do not. Peaks are compared by magnitude, since of two equal ones of opposite
// sign either may be the larger. For figures exact by construction only differences count. A figure's time has the same
// error, with the latest of all times as its scale; a time that all runs share to rounding has no other part, and one of
// several equal extremes may be any time.
MeasuredErrors measure_errors(std::vector<Figure>& figures, const std::vector<Witness>& witnesses);

// Adds the discretisation error of shafts, the differences to a machine with finer shafts, to the known errors of
// integration. Returns the largest over its scale.
double add_differences(std::vector<Figure>& figures, const std::vector<Figure>& finer);

// Null: the machine was changed after reading, so that the scene does not describe it.
std::shared_ptr<const Model> with_finer_shafts(const Model& model);

// Adds the changes with finer shafts to the errors of a run's figures and states. Returns the largest change over its scale.
double add_shaft_errors(std::vector<Figure>& figures, std::vector<Figure>& states, const std::vector<Figure>& finer,
                        const std::vector<Figure>& finer_states);

// Notes on this error; `why` there is no such run, else empty.
std::vector<std::string> shaft_error_notes(double change, double accuracy, const std::string& why);

}  // namespace kurbel
