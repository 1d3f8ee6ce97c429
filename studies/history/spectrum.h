// spectrum.h — frequencies and orders of a simulated torque: over the whole run, and over speed along a run-up.
#pragma once

#include <vector>

#include "engine/base/estimate.h"

namespace kurbel {

// Amplitudes over frequency (or order) of equidistant values: Hann window, scaled to amplitudes of sines. Mean removed.
struct AmplitudeSpectrum {
  std::vector<double> frequency;  // [Hz], or orders if sampled over turns
  std::vector<double> amplitude;  // in the values' unit
  double resolution = 0;          // distance between lines
};

// Values at distance `step` [s, or turns]; the last power of two of them is used. Throws std::invalid_argument for
// fewer than 16 values or a step that is not > 0.
AmplitudeSpectrum spectrum_of(const std::vector<double>& values, double step);

// Of values at equal distances, any number N of them: the mean squares p_k of cosines of k half waves over all of them,
//     p_0 = mean²,  p_k = 2 (Σ x_n cos(πk(n + ½)/N)/N)²,  Σ p_k = Σ x_n²/N      (DCT-II; Strang 1999)
// p_k is of the frequency k/(2N step). The values count as mirrored at their ends: there is no step between the last and
// the first, as a start from rest has, and no window that would weigh some of them down.
std::vector<double> powers_of(const std::vector<double>& values);

// A sine among the values, located between the lines of a Hann window (theory 15.3) by the ratio of two of them,
//     |X_(k+1)|/|X_k| = (1 + δ)/(2 − δ),   |X_k| = A sin(πδ)/(πδ (1 − δ²))
// if it lies δ lines above the k-th, alone. The influence of other sines, decay or change of frequency is estimated
// from three windows half as long (first half, middle, last half): the error is twice the greatest difference, since
// each of them may miss it by chance.
struct SpectralLine {
  Estimate frequency;  // [Hz], or orders
  Estimate amplitude;  // in the values' unit
};

// The strongest lines in descending order; none for fewer than 32 values. The greatest amplitude of a line alone may
// be up to 15 % too small for a sine between two lines.
std::vector<SpectralLine> strongest_lines(const std::vector<double>& values, double step, std::size_t count);

// Increases errors to at least twice the differences to another spectrum of the same quantity: to the whole amplitude
// if it has no such line.
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
