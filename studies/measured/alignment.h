// alignment.h — comparison of measured and simulated signals: shift in time, offset, and residuals.
//
//     r_i = m_i − o − s(t_i + Δ)      Δ: shift, the same for all signals; o: offset of each
//
// If unknown, Δ minimises Σ over the signals of mean(r²)/range², and o is the mean of m − s (least squares; Nocedal,
// Wright 2006, ch. 10).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/measured/measurement.h"

namespace kurbel {

// Values over time, linearly interpolated; with a period they are repeated periodically.
class Signal {
 public:
  // Times do not decrease; at a repeated time the signal jumps, and the later value holds from there on.
  Signal(std::vector<double> time, std::vector<double> value, std::optional<double> period = {});
  double begin() const { return time_.front(); }
  double end() const { return time_.back(); }
  const std::optional<double>& period() const { return period_; }
  const std::vector<double>& time() const { return time_; }
  const std::vector<double>& value() const { return value_; }

  bool covers(double t) const { return period_ || (t >= begin() && t <= end()); }
  double within(double t) const;  // the time shifted by periods into begin … end
  double at(double t) const;
  double slope(double t) const;

 private:
  std::size_t piece(double t) const;  // index of the piece that contains t
  std::vector<double> time_, value_;
  std::optional<double> period_;
};

struct Residuals {
  Estimate offset;                                // error: if identified, twice its standard error
  double rms = 0, mean = 0;                       // of the residuals
  double largest = 0, at = 0;                     // residual of largest magnitude, with its sign; its simulated time
  std::optional<double> relative;                 // rms over the measured range; empty if it does not vary
  std::vector<double> time, simulated, measured;  // of the compared points: simulated time; offset subtracted
};

struct Alignment {
  Estimate shift;                  // [s]; error: if identified, twice its standard error
  std::vector<Residuals> signals;  // in the order of the measurement
};

// Signal k of the measurement against `simulated[k]`; all of these have the same ends. Empty: no common time, or a
// shift is to be identified from signals that do not vary.
std::optional<Alignment> align(const Measurement& measurement, const std::vector<Signal>& simulated);

}  // namespace kurbel
