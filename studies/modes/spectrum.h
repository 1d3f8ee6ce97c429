// spectrum.h — frequencies and orders of a simulated torque: whole run, and by speed along a run-up.
#pragma once

#include <string>
#include <vector>

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
