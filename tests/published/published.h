// published.h — what the tests of published cases share: scenes with another value, trajectories, natural frequencies.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/linear/eigen_modes.h"
#include "engine/scene/csv.h"
#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::test {

constexpr double two_pi = 2 * std::numbers::pi;

// A number with all its digits, for scene texts.
inline std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline std::string project_text(const std::string& relative) {
  std::ifstream file(source_path(relative));
  if (!file) throw std::runtime_error("cannot read " + relative);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The text with one passage replaced; the passage must stand there exactly once.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::runtime_error("not exactly once in the scene: " + from);
  return text.replace(at, from.size(), to);
}

// A column of the trajectory.
inline std::vector<double> series(const Result& result, const std::string& channel) {
  const TrajectoryRecorder& t = *result.trajectory;
  for (std::size_t k = 0; k < t.channels().size(); ++k) {
    if (t.channels()[k].name != channel) continue;
    std::vector<double> values;
    for (std::size_t row = 0; row < t.time().size(); ++row) values.push_back(t.value(row, k));
    return values;
  }
  throw std::runtime_error("no channel " + channel);
}

// |x̂| of the harmonic e^{iωt} over the trajectory, which must span whole periods (its last row repeats the first).
inline double harmonic_amplitude(const Result& result, const std::string& channel, double omega) {
  const std::vector<double> x = series(result, channel);
  std::complex<double> sum = 0;
  for (std::size_t row = 0; row + 1 < x.size(); ++row)
    sum += x[row] * std::polar(1.0, -omega * result.trajectory->time()[row]);
  return std::abs(sum) * 2 / static_cast<double>(x.size() - 1);
}

// The state matrix of a compiled model at its start, from the exact Jacobian.
inline Eigen::MatrixXd state_matrix(const std::string& text) {
  const Scene scene = scene_from(text);
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = equations.start(0);
  const SparsityPattern& pattern = equations.jacobian_pattern();
  std::vector<double> values(pattern.row.size());
  equations.jacobian(0, y, values);
  const auto n = static_cast<Eigen::Index>(pattern.size);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t column = 0; column < pattern.size; ++column)
    for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      a(pattern.row[static_cast<std::size_t>(k)], static_cast<Eigen::Index>(column)) =
          values[static_cast<std::size_t>(k)];
  return a;
}

// Frequencies |Im λ| of the oscillating modes [rad/s], ascending; rigid-body motion and the angle have λ = 0.
inline std::vector<double> natural_frequencies(const std::string& text) {
  const Eigen::VectorXcd eigenvalues = state_matrix(text).eigenvalues();
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  std::vector<double> frequencies;
  for (const std::complex<double>& lambda : eigenvalues)
    if (lambda.imag() > 1e-6 * largest) frequencies.push_back(lambda.imag());
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

// A row of the page for each mode; the unit is 2π for Hz, 2π/60 for a number per minute, 1 for rad/s.
inline void expect_frequencies(const Validation& is, const std::string& text, const std::vector<double>& expected,
                               double unit, double relative) {
  const std::string name = unit == two_pi ? "Hz" : unit == 1 ? "rad/s" : "1/min";
  const std::vector<double> found = natural_frequencies(text);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    is.close("natural frequency " + std::to_string(i + 1), name, found[i] / unit, expected[i], relative);
  // The same from M and K, where rigid motion comes first.
  const Scene scene = scene_from(text);
  const UndampedModes modes = undamped_modes(linearise(compile(scene, scene.effects), {}));
  ASSERT_EQ(modes.rigid, 1);
  ASSERT_EQ(static_cast<std::size_t>(modes.omega.size()), expected.size() + 1);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(modes.omega[static_cast<Eigen::Index>(i) + 1] / unit, expected[i], relative * expected[i])
        << "undamped mode " << i + 1;
}

// Two columns of a published series.
inline Columns published_series(const std::string& file, int x_column, int y_column) {
  Messages messages(file);
  const Columns columns = read_csv(source_path("tests/cases/" + file), x_column, y_column, messages);
  messages.throw_if_any();
  return columns;
}

// Largest difference of a trajectory to a published series; each of its times must be a row of the trajectory.
inline double largest_difference(const Result& result, const std::string& channel, const Columns& published) {
  const std::vector<double> x = series(result, channel);
  const std::vector<double>& time = result.trajectory->time();
  double largest = 0;
  for (std::size_t k = 0; k < published.x.size(); ++k) {
    const auto row = static_cast<std::size_t>(std::lround(published.x[k] / (time[1] - time[0])));
    if (row >= time.size() || std::abs(time[row] - published.x[k]) > 1e-9)
      throw std::runtime_error("no row at t = " + digits(published.x[k]));
    largest = std::max(largest, std::abs(x[row] - published.y[k]));
  }
  return largest;
}

// In-line slider-crank by hand, for checks: the rod turns by β with r sin φ = l sin β.
struct InlineSliderCrank {
  double r, l, crank_inertia, rod_mass, rod_com, rod_inertia, slider_mass;

  double position(double phi) const {
    return r * std::cos(phi) + std::sqrt(l * l - r * r * std::sin(phi) * std::sin(phi));
  }
  // Reduced inertia (theory 2.1) from the velocities at ω = 1.
  double inertia(double phi) const {
    const double s = std::sin(phi), c = std::cos(phi);
    const double sin_b = r / l * s, cos_b = std::sqrt(1 - sin_b * sin_b);
    const double beta_rate = r * c / (l * cos_b);          // of the rod, against the crank
    const double slider = -r * s - l * sin_b * beta_rate;  // dx/dφ
    // Centre of mass of the rod: pin + rod_com (cos β, −sin β).
    const double vx = -r * s - rod_com * sin_b * beta_rate, vy = r * c - rod_com * cos_b * beta_rate;
    return crank_inertia + rod_mass * (vx * vx + vy * vy) + rod_inertia * beta_rate * beta_rate +
           slider_mass * slider * slider;
  }
};

}  // namespace kurbel::test
