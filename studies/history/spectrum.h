// spectrum.h — frequencies and orders of a simulated torque: whole run, and by speed along a run-up.
#pragma once

#include <vector>

#include "engine/base/estimate.h"

namespace kurbel {

// Amplitudes over frequency (or order) of evenly sampled values: Hann window, amplitudes of sines kept. Mean removed.
struct AmplitudeSpectrum {
  std::vector<double> frequency;  // [Hz], or orders where sampled over turns
  std::vector<double> amplitude;  // in the values' unit
  double resolution = 0;          // distance of two lines
};

// values at distance `step` [s, or turns]. Takes the largest power of two of them from the end. Throws
// std::invalid_argument for fewer than 16 values or a step that is not > 0.
AmplitudeSpectrum spectrum_of(const std::vector<double>& values, double step);

// A sine among the values, located between the lines of Hann's window (theory 15.3), which gives two of them the ratio
//     |X_(k+1)|/|X_k| = (1 + δ)/(2 − δ),   |X_k| = A sin(πδ)/(πδ (1 − δ²))
// where it lies δ lines above the k-th, alone. What another sine, a decay or a change of frequency does to it is seen in
// three windows half as long, the first half of the whole, its middle and its last: twice the greatest difference is the
// error, for they may happen to see none of it.
struct SpectralLine {
  Estimate frequency;  // [Hz], or orders
  Estimate amplitude;  // in the values' unit
};

// The strongest ones, the strongest first; none of fewer than 32 values. A line's greatest amplitude alone would lack up
// to 15 % of a sine between two lines.
std::vector<SpectralLine> strongest_lines(const std::vector<double>& values, double step, std::size_t count);

// Errors at least twice the distances to what another spectrum of the same has there: all of the amplitude where that
// has nothing.
void widen_errors(std::vector<SpectralLine>& lines, const AmplitudeSpectrum& other);

// The same quantity, sampled at equal steps of the angle by cubic interpolation, while the angle grows.
std::vector<double> resampled_over_angle(const std::vector<double>& angle, const std::vector<double>& values,
                                         double step);

// Spectra of windows along the run, by the mean speed in each.
struct WaterfallLine {
  double time = 0, speed = 0;  // middle [s], mean [rad/s]
  AmplitudeSpectrum spectrum;
};
std::vector<WaterfallLine> waterfall(const std::vector<double>& time, const std::vector<double>& speed,
                                     const std::vector<double>& values, int lines);

}  // namespace kurbel
