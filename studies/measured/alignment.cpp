// alignment.cpp — a search over all shifts, then refinement of each good one as far as the points allow.
#include "studies/measured/alignment.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace kurbel {

Signal::Signal(std::vector<double> time, std::vector<double> value, std::optional<double> period)
    : time_(std::move(time)), value_(std::move(value)), period_(period) {}

double Signal::within(double t) const {
  if (!period_) return t;
  return begin() + (t - begin()) - *period_ * std::floor((t - begin()) / *period_);
}

std::size_t Signal::piece(double t) const {
  const auto after = std::upper_bound(time_.begin(), time_.end(), t);
  return std::clamp<std::size_t>(static_cast<std::size_t>(after - time_.begin()), 1, time_.size() - 1);
}

double Signal::at(double t) const {
  t = within(t);
  const std::size_t i = piece(t);
  const double width = time_[i] - time_[i - 1];
  return width > 0 ? value_[i - 1] + (value_[i] - value_[i - 1]) * ((t - time_[i - 1]) / width) : value_[i];
}

double Signal::slope(double t) const {
  const std::size_t i = piece(within(t));
  const double width = time_[i] - time_[i - 1];
  return width > 0 ? (value_[i] - value_[i - 1]) / width : 0;
}

namespace {

constexpr std::size_t fewest_points = 2;
constexpr double confidence = 2;  // standard errors

double range_of(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return *greatest - *least;
}

class Fit {
 public:
  Fit(const Measurement& measurement, const std::vector<Signal>& simulated)
      : measurement_(measurement), simulated_(simulated) {
    for (const MeasuredSignal& s : measurement.signals) {
      const double range = range_of(s.values);
      weight_.push_back(range > 0 ? 1 / (range * range) : 0);
    }
  }

  // Σ over the signals of the mean square residual, over the square of the range. Every stride-th point.
  double cost(double shift, std::size_t stride = 1) const {
    double cost = 0;
    std::size_t points = 0;
    for (std::size_t k = 0; k < simulated_.size(); ++k) {
      const MeasuredSignal& measured = measurement_.signals[k];
      double n = 0, sum = 0, squares = 0;
      for (std::size_t i = 0; i < measurement_.time.size(); i += stride) {
        const double t = measurement_.time[i] + shift;
        if (!simulated_[k].covers(t)) continue;
        const double r = measured.values[i] - measured.offset.value - simulated_[k].at(t);
        n += 1, sum += r, squares += r * r;
      }
      if (n < fewest_points) return HUGE_VAL;
      points += static_cast<std::size_t>(n);
      const double mean = sum / n;
      cost += weight_[k] * (squares / n - (measured.offset.fit ? mean * mean : 0));
    }
    return points > 0 ? std::max(cost, 0.0) : HUGE_VAL;
  }

  // For a cycle within half a period to either side; otherwise at least half of the shorter record is compared.
  std::optional<double> best_shift() const {
    const Signal& signal = simulated_.front();
    const double first = measurement_.time.front(), last = measurement_.time.back();
    const double common = 0.5 * std::min(signal.end() - signal.begin(), last - first);
    const double low = signal.period() ? -0.5 * *signal.period() : signal.begin() - last + common;
    const double high = signal.period() ? 0.5 * *signal.period() : signal.end() - first - common;
    return best_between(low, high);
  }

  Residuals residuals(std::size_t k, double shift) const {
    const MeasuredSignal& measured = measurement_.signals[k];
    Residuals r;
    double sum = 0;
    for (std::size_t i = 0; i < measurement_.time.size(); ++i) {
      const double t = measurement_.time[i] + shift;
      if (!simulated_[k].covers(t)) continue;
      r.time.push_back(simulated_[k].within(t));
      r.simulated.push_back(simulated_[k].at(t));
      r.measured.push_back(measured.values[i]);
      sum += r.measured.back() - r.simulated.back();
    }
    const auto n = static_cast<double>(r.time.size());
    r.offset.value = measured.offset.fit ? sum / n : measured.offset.value;
    r.mean = sum / n - r.offset.value;
    double squares = 0;
    for (std::size_t i = 0; i < r.time.size(); ++i) {
      r.measured[i] -= r.offset.value;
      const double left = r.measured[i] - r.simulated[i];
      squares += left * left;
      if (i == 0 || std::abs(left) > std::abs(r.largest)) r.largest = left, r.at = r.time[i];
    }
    r.rms = std::sqrt(squares / n);
    if (const double range = range_of(r.measured); range > 0) r.relative = r.rms / range;
    if (measured.offset.fit) r.offset.error = confidence * r.rms / std::sqrt(n);
    return r;
  }

  // Twice the standard error of Δ: its shift by noise of the residuals' size, independent from point to point. Empty
  // if the simulation does not vary: all shifts are equal.
  std::optional<double> shift_error(double shift, const std::vector<Residuals>& left) const {
    double noise = 0, curvature = 0;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const auto n = static_cast<double>(left[k].time.size());
      double slopes = 0;
      for (const double t : measurement_.time)
        if (simulated_[k].covers(t + shift)) slopes += std::pow(simulated_[k].slope(t + shift), 2);
      curvature += weight_[k] * slopes / n;
      noise += std::pow(weight_[k] * left[k].rms / n, 2) * slopes;
    }
    if (!(curvature > 0)) return {};
    return confidence * std::sqrt(noise) / curvature;
  }

 private:
  std::optional<double> best_between(double low, double high) const {
    constexpr std::size_t most_points = 400, best = 8;
    const std::size_t points = measurement_.time.size(), stride = std::max<std::size_t>(1, points / most_points);
    const double interval = (measurement_.time.back() - measurement_.time.front()) / static_cast<double>(points - 1);
    const auto steps = static_cast<std::size_t>(std::clamp((high - low) / interval, 512.0, 32768.0));
    const double step = (high - low) / static_cast<double>(steps);
    std::vector<double> costs;
    for (std::size_t i = 0; i <= steps; ++i) costs.push_back(cost(low + step * static_cast<double>(i), stride));
    const auto [least, greatest] = std::minmax_element(costs.begin(), costs.end());
    if (!(*greatest > *least) || !std::isfinite(*least)) return {};
    std::vector<std::size_t> valleys;
    for (std::size_t i = 0; i <= steps; ++i)
      if ((i == 0 || costs[i] <= costs[i - 1]) && (i == steps || costs[i] <= costs[i + 1])) valleys.push_back(i);
    std::stable_sort(valleys.begin(), valleys.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
    valleys.resize(std::min(valleys.size(), best));
    std::vector<std::pair<double, double>> found;  // cost, shift
    for (const std::size_t i : valleys) found.push_back(refined(low + step * static_cast<double>(i), step));
    return nearest_of_the_best(found);
  }

  // Minimum between the neighbours of a valley.
  std::pair<double, double> refined(double about, double step) const {
    constexpr int bits = 30, parts = 16;
    double best = about, least = cost(about);
    for (int i = -parts; i <= parts; ++i)
      if (const double s = about + step * i / parts, here = cost(s); here < least) best = s, least = here;
    const auto [shift, value] = boost::math::tools::brent_find_minima([&](double s) { return cost(s); },
                                                                      best - step / parts, best + step / parts, bits);
    return value < least ? std::pair(value, shift) : std::pair(least, best);
  }

  // For a periodic signal many shifts are equal: the smallest.
  static double nearest_of_the_best(const std::vector<std::pair<double, double>>& found) {
    const double least = std::min_element(found.begin(), found.end())->first;
    double nearest = HUGE_VAL;
    for (const auto& [value, shift] : found)
      if (value <= 1.0001 * least + 1e-10 && std::abs(shift) < std::abs(nearest)) nearest = shift;
    return nearest;
  }

  const Measurement& measurement_;
  const std::vector<Signal>& simulated_;
  std::vector<double> weight_;
};

}  // namespace

std::optional<Alignment> align(const Measurement& measurement, const std::vector<Signal>& simulated) {
  const Fit fit(measurement, simulated);
  Alignment found{.shift = {measurement.shift.value}, .signals = {}};
  if (measurement.shift.fit) {
    const std::optional<double> best = fit.best_shift();
    if (!best) return {};
    found.shift.value = *best;
  }
  for (std::size_t k = 0; k < simulated.size(); ++k) {
    found.signals.push_back(fit.residuals(k, found.shift.value));
    if (found.signals.back().time.size() < fewest_points) return {};
  }
  if (!measurement.shift.fit) return found;
  found.shift.error = fit.shift_error(found.shift.value, found.signals);
  return found.shift.error ? std::optional(found) : std::nullopt;
}

}  // namespace kurbel
