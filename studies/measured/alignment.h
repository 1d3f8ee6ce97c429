// alignment.h — a measured signal laid over a simulated one: shift in time, offset, and what is left between them.
//
//     r_i = m_i − o − s(t_i + Δ)      Δ: shift, the same for all signals; o: offset of each
//
// Where they are to be found, Δ minimises Σ over the signals of mean(r²)/range², and o is the mean of m − s
// (least squares; Nocedal, Wright 2006, ch. 10).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "studies/measured/measurement.h"

namespace kurbel {

// Values over time, straight between its points; of a cycle they come again after each period.
class Signal {
 public:
  // Times do not fall; where one stands twice the signal jumps, and the later value holds from there on.
  Signal(std::vector<double> time, std::vector<double> value, std::optional<double> period = {});
  double begin() const { return time_.front(); }
  double end() const { return time_.back(); }
  const std::optional<double>& period() const { return period_; }
  const std::vector<double>& time() const { return time_; }
  const std::vector<double>& value() const { return value_; }

  bool covers(double t) const { return period_ || (t >= begin() && t <= end()); }
  double within(double t) const;  // the same moment between begin and end
  double at(double t) const;
  double slope(double t) const;

 private:
  std::size_t piece(double t) const;  // whose end lies behind t
  std::vector<double> time_, value_;
  std::optional<double> period_;
};

struct Residuals {
  double offset = 0;
  std::optional<double> offset_error;  // of one that was found: twice its standard error
  double rms = 0, mean = 0;            // of the residuals
  double largest = 0, at = 0;          // the residual of largest magnitude, with its sign; at this simulated time
  std::optional<double> relative;      // rms over the measured range; none of what does not vary
  std::vector<double> time, simulated, measured;  // of the compared points: simulated time; the offset taken off
};

struct Alignment {
  double shift = 0;                   // [s]
  std::optional<double> shift_error;  // of one that was found: twice its standard error [s]
  std::vector<Residuals> signals;     // as the measurement has them
};

// Signal k of the measurement against `simulated[k]`; all of them have the same ends. Nothing: no moment in common, or a
// shift is to be found of signals that do not vary.
std::optional<Alignment> align(const Measurement& measurement, const std::vector<Signal>& simulated);

}  // namespace kurbel
