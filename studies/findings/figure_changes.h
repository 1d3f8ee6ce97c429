// figure_changes.h — differences between the figures of two runs, and which figures are worth comparing.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Relative change of a figure against the full model: 0.01 is one per cent of the full model's value, be it a δ of
// 0.002 or a torque far below the rated one. Speeds and works are related to the machine's scale (rated speed, energy
// converted) if that is greater. A figure that the full model cannot distinguish from zero is related to its floor. A
// figure that is zero in both models is omitted.
//
// The change is the difference between the models; the error is the uncertainty of the two runs and not part of it.
struct FigureChange {
  std::string figure, unit;
  double full = 0, without = 0, relative = 0;
  bool from_nothing = false;  // the full model's value is indistinguishable from zero
  double error = 0;           // of `relative`: the errors of both figures over the same size

  bool reported() const { return relative > error; }                       // the change is significant
  double sure() const { return relative > error ? relative - error : 0; }  // at least as much
};

// The measured error of a figure; if not measured, max(1e-9, tolerance) of its rated quantity, the resolution of
// steps and rounding.
double error_of(const Figure& figure, const Result& run);
// Magnitude below which a figure is indistinguishable from zero: its error, and rounding (1e-9) of its rated quantity.
double floor_of(const Figure& figure, const Result& run);
// True for the same quantity: δ and cycle_fluctuation differ only by whether the run found the motion to be steady.
bool measure_the_same(const Figure& a, const Figure& b);
// Their difference: peaks by magnitude, since of two equal ones of opposite sign either may be the larger.
double apart(const Figure& a, const Figure& b);
// The figure of a run that measures the same as one of another run; null: none.
const Figure* like_in(const Result& run, const Figure& figure);
// Whether any of these names selects the figure.
inline bool is_asked_for(std::string_view name, const std::vector<std::string>& asked) {
  return std::any_of(asked.begin(), asked.end(), [&](const std::string& by) { return is_asked_for(name, by); });
}
// Figures worth comparing: peaks, speeds, fluctuation, periods, works; not those of single angles or of rounding.
bool is_informative(const Figure& figure);
// Significant figures of `other` against `full`, largest certain change first; `wanted`: names or their beginnings; empty: all.
std::vector<FigureChange> changes_between(const Result& full, const Result& other,
                                          const std::vector<std::string>& wanted = {});

}  // namespace kurbel
