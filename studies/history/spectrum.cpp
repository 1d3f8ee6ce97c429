// spectrum.cpp — windowed Fourier transforms of evenly sampled histories.
#include "studies/history/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "studies/response/excitation.h"

namespace kurbel {
namespace {

// A sine near the k-th line of a spectrum, a local maximum.
SpectralLine located(const AmplitudeSpectrum& s, std::size_t k) {
  const double before = s.amplitude[k - 1], here = s.amplitude[k], after = s.amplitude[k + 1];
  const double sense = after >= before ? 1 : -1, ratio = std::max(before, after) / here;
  const double delta = (2 * ratio - 1) / (1 + ratio), x = std::numbers::pi * delta;
  const double gain = std::abs(delta) < 1e-9 ? 1 : std::sin(x) / (x * (1 - delta * delta));
  return {{(static_cast<double>(k) + sense * delta) * s.resolution, 0.0}, {here / gain, 0.0}};
}

// By amplitude; lines within two lines of 0 belong to the mean.
std::vector<SpectralLine> lines_in(const AmplitudeSpectrum& s) {
  std::vector<SpectralLine> lines;
  for (std::size_t k = 2; k + 1 < s.amplitude.size(); ++k)
    if (s.amplitude[k] > s.amplitude[k - 1] && s.amplitude[k] >= s.amplitude[k + 1]) lines.push_back(located(s, k));
  std::sort(lines.begin(), lines.end(),
            [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude.value > b.amplitude.value; });
  return lines;
}

}  // namespace

AmplitudeSpectrum spectrum_of(const std::vector<double>& values, double step) {
  if (values.size() < 16 || !(step > 0))
    throw std::invalid_argument(
        fmt::format("a spectrum needs 16 values or more at a step > 0; got {} at {:g}", values.size(), step));
  std::size_t n = 16;
  while (2 * n <= values.size()) n *= 2;
  const std::vector<double> tail(values.end() - static_cast<std::ptrdiff_t>(n), values.end());
  // The mean weighted by the window, so that it leaks into no line.
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

std::vector<double> powers_of(const std::vector<double>& values) {
  // kn = (k² + n² − (k − n)²)/2: a convolution, of a power of two for any N (Bluestein 1970).
  const std::size_t n = values.size();
  std::size_t length = 1;
  while (length < 2 * n) length *= 2;
  const auto chirp = [n](std::size_t k) {
    return std::polar(1.0, std::numbers::pi * static_cast<double>(k * k % (4 * n)) / static_cast<double>(2 * n));
  };
  std::vector<Complex> a(length), b(length), fa, fb;
  for (std::size_t k = 0; k < n; ++k) {
    a[k] = values[k] * std::conj(chirp(k));
    b[k] = chirp(k);
    if (k > 0) b[length - k] = b[k];
  }
  Eigen::FFT<double> fft;
  fft.fwd(fa, a), fft.fwd(fb, b);
  for (std::size_t k = 0; k < length; ++k) fa[k] *= fb[k];
  fft.inv(a, fa);
  std::vector<double> powers(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double half = std::numbers::pi * static_cast<double>(k) / static_cast<double>(2 * n);
    const double part = (a[k] * std::conj(chirp(k)) * std::polar(1.0, -half)).real() / static_cast<double>(n);
    powers[k] = (k == 0 ? 1 : 2) * part * part;
  }
  return powers;
}

std::vector<SpectralLine> strongest_lines(const std::vector<double>& values, double step, std::size_t count) {
  if (values.size() < 32) return {};
  const AmplitudeSpectrum whole = spectrum_of(values, step);
  std::vector<SpectralLine> lines = lines_in(whole);
  if (lines.size() > count) lines.resize(count);
  const auto half = static_cast<std::ptrdiff_t>(std::lround(0.5 / (whole.resolution * step)));
  for (const std::ptrdiff_t back : {half, half + half / 2, 2 * half})
    widen_errors(lines, spectrum_of({values.end() - back, values.end() - back + half}, step));
  return lines;
}

void widen_errors(std::vector<SpectralLine>& lines, const AmplitudeSpectrum& other) {
  const std::vector<SpectralLine> found = lines_in(other);
  for (SpectralLine& line : lines) {
    const auto distance = [&](const SpectralLine& l) { return std::abs(l.frequency.value - line.frequency.value); };
    const auto nearest =
        std::min_element(found.begin(), found.end(),
                         [&](const SpectralLine& a, const SpectralLine& b) { return distance(a) < distance(b); });
    const bool known = nearest != found.end() && distance(*nearest) <= 2 * other.resolution;
    const double size = line.amplitude.value, apart = known ? std::abs(nearest->amplitude.value - size) : size;
    line.frequency.error = std::max(*line.frequency.error, 2 * (known ? distance(*nearest) : other.resolution));
    line.amplitude.error = std::max(*line.amplitude.error, std::min(2 * apart, size));
  }
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
      // Cubic interpolation through four neighbours (Lagrange); linear where the angle is not monotonic.
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
