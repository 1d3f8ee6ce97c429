// figure_changes.h — how far the figures of two runs are apart, and which of them are worth comparing.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// How far a figure is from that of the full model, over the full model's value of it: 0.01 is one per cent of the
// figure itself, be it a δ of 0.002 or a torque far below the rated one. Speeds and works are judged by the machine's own
// (rated speed, energy turned over) where those are greater. Only a figure that the full model does not tell from zero is
// judged by its floor instead. A figure that is zero in both models is left out.
//
// The change is what the models differ by; the error is what the two runs leave open of it, and no part of it.
struct FigureChange {
  std::string figure, unit;
  double full = 0, without = 0, relative = 0;
  bool from_nothing = false;  // the full model's value is not told from zero
  double error = 0;           // of `relative`: the errors of both figures over the same size

  bool told() const { return relative > error; }                           // from no change at all
  double sure() const { return relative > error ? relative - error : 0; }  // at least as much
};

// Of a figure: the measured one; where none was measured, max(1e-9, tolerance) of its rated quantity, which is what
// steps and rounding resolve.
double error_of(const Figure& figure, const Result& run);
// What a figure of a run does not tell from nothing: its error, and rounding (1e-9) of its rated quantity.
double floor_of(const Figure& figure, const Result& run);
// δ and a fluctuation that is none differ by what a run found of its motion, not by how they are measured.
bool measure_the_same(const Figure& a, const Figure& b);
// How far two of them are apart: peaks by magnitude, for of two equal ones of opposite sign either may be the larger.
double apart(const Figure& a, const Figure& b);
// What in a run measures the same as a figure of another one; null: nothing.
const Figure* like_in(const Result& run, const Figure& figure);
// By any of these.
inline bool is_asked_for(std::string_view name, const std::vector<std::string>& asked) {
  return std::any_of(asked.begin(), asked.end(), [&](const std::string& by) { return is_asked_for(name, by); });
}
// Figures worth comparing: peaks, speeds, fluctuation, periods, works; not those of single angles or of rounding.
bool is_telling(const Figure& figure);
// Changes of the telling figures of `other` against `full`, the surely greatest first; only `wanted`, unless empty (names or their beginnings).
std::vector<FigureChange> changes_between(const Result& full, const Result& other,
                                          const std::vector<std::string>& wanted = {});

}  // namespace kurbel
