// spectrum.cpp — windowed Fourier transforms of evenly sampled histories.
#include "studies/modes/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "studies/modes/excitation.h"

namespace kurbel {

AmplitudeSpectrum spectrum_of(const std::vector<double>& values, double step) {
  if (values.size() < 16 || !(step > 0))
    throw std::invalid_argument(
        fmt::format("a spectrum needs 16 values or more at a step > 0; got {} at {:g}", values.size(), step));
  std::size_t n = 16;
  while (2 * n <= values.size()) n *= 2;
  const std::vector<double> tail(values.end() - static_cast<std::ptrdiff_t>(n), values.end());
  // The mean as the window sees it, so that it leaks into no line.
  std::vector<double> window(n), windowed(n);
  double weight = 0, mean = 0;
  for (std::size_t k = 0; k < n; ++k) {
    window[k] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
    weight += window[k];
    mean += window[k] * tail[k];
  }
  mean /= weight;
  for (std::size_t k = 0; k < n; ++k) windowed[k] = 2 * window[k] * (tail[k] - mean);  // Hann halves a sine
  const std::vector<Complex> lines = harmonics_of(windowed);
  AmplitudeSpectrum spectrum;
  spectrum.resolution = 1 / (static_cast<double>(n) * step);
  for (std::size_t r = 0; r < lines.size(); ++r) {
    spectrum.frequency.push_back(static_cast<double>(r) * spectrum.resolution);
    spectrum.amplitude.push_back(std::abs(lines[r]));
  }
  return spectrum;
}

std::vector<double> resampled_over_angle(const std::vector<double>& angle, const std::vector<double>& values,
                                         double step) {
  std::vector<double> result;
  if (angle.size() < 4 || !(step > 0)) return result;
  double next = angle[1];
  for (std::size_t i = 1; i + 2 < angle.size(); ++i) {
    const double a = angle[i], b = angle[i + 1];
    if (b <= a) continue;
    for (; next <= b; next += step) {
      if (next < a) continue;
      // Cubic through four neighbours (Lagrange); where the angle does not grow throughout, straight.
      const double x[4] = {angle[i - 1], a, b, angle[i + 2]};
      double sum = 0;
      if (x[0] < a && b < x[3]) {
        for (int j = 0; j < 4; ++j) {
          double product = values[i - 1 + static_cast<std::size_t>(j)];
          for (int k = 0; k < 4; ++k)
            if (k != j) product *= (next - x[k]) / (x[j] - x[k]);
          sum += product;
        }
      } else {
        sum = values[i] + (values[i + 1] - values[i]) * (next - a) / (b - a);
      }
      result.push_back(sum);
    }
  }
  return result;
}

std::vector<WaterfallLine> waterfall(const std::vector<double>& time, const std::vector<double>& speed,
                                     const std::vector<double>& values, int lines) {
  std::vector<WaterfallLine> result;
  if (time.size() < 64 || lines < 1) return result;
  // Windows overlap by half.
  const std::size_t width = std::max<std::size_t>(32, 2 * time.size() / (static_cast<std::size_t>(lines) + 1));
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t begin = 0; begin + width <= time.size(); begin += width / 2) {
    const auto part = [&](const std::vector<double>& x) {
      return std::vector<double>(x.begin() + static_cast<std::ptrdiff_t>(begin),
                                 x.begin() + static_cast<std::ptrdiff_t>(begin + width));
    };
    const std::vector<double> w = part(speed);
    WaterfallLine line;
    line.time = 0.5 * (time[begin] + time[begin + width - 1]);
    line.speed = std::accumulate(w.begin(), w.end(), 0.0) / static_cast<double>(width);
    line.spectrum = spectrum_of(part(values), step);
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace kurbel
