// published.h — what the tests of published cases share: scenes with another value, trajectories, natural frequencies.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::test {

constexpr double two_pi = 2 * std::numbers::pi;

// A number with all its digits, for scene texts.
std::string digits(double value);

std::string project_text(const std::string& relative);

// The text with one passage replaced; the passage must stand there exactly once.
std::string with(std::string text, const std::string& from, const std::string& to);

// A column of the trajectory.
std::vector<double> series(const Result& result, const std::string& channel);

// |x̂| of the harmonic e^{iωt} over the trajectory, which must span whole periods (its last row repeats the first).
double harmonic_amplitude(const Result& result, const std::string& channel, double omega);

// The state matrix of a compiled model at its start, from the exact Jacobian.
Eigen::MatrixXd state_matrix(const std::string& text);

// Frequencies |Im λ| of the oscillating modes [rad/s], ascending; rigid-body motion and the angle have λ = 0.
std::vector<double> natural_frequencies(const std::string& text);

// A row of the page for each mode; the unit is 2π for Hz, 2π/60 for a number per minute, 1 for rad/s.
void expect_frequencies(const Validation& is, const std::string& text, const std::vector<double>& expected, double unit,
                        double relative);

struct PublishedSeries {
  std::vector<double> x, y;
};

// Two columns of a published series.
PublishedSeries published_series(const std::string& file, int x_column, int y_column);

// Largest difference of a trajectory to a published series; each of its times must be a row of the trajectory.
double largest_difference(const Result& result, const std::string& channel, const PublishedSeries& published);

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
