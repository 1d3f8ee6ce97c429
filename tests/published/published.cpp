// published.cpp — trajectories, state matrices and natural frequencies as tests need them.
#include "tests/published/published.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "engine/events/equations.h"
#include "engine/linear/eigen_modes.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/tables/table_file.h"
#include "tests/support/eigen_solutions.h"

namespace kurbel::test {

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string project_text(const std::string& relative) {
  std::ifstream file(source_path(relative));
  if (!file) throw std::runtime_error("cannot read " + relative);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::runtime_error("not exactly once in the scene: " + from);
  return text.replace(at, from.size(), to);
}

std::vector<double> series(const Result& result, const std::string& channel) {
  const TrajectoryRecorder& t = *result.trajectory;
  for (std::size_t k = 0; k < t.channels().size(); ++k) {
    if (t.channels()[k].name != channel) continue;
    std::vector<double> values;
    for (std::size_t row = 0; row < t.time().size(); ++row) values.push_back(t.value(row, k));
    return values;
  }
  throw std::runtime_error("no channel " + channel);
}

double harmonic_amplitude(const Result& result, const std::string& channel, double omega) {
  const std::vector<double> x = series(result, channel);
  std::complex<double> sum = 0;
  for (std::size_t row = 0; row + 1 < x.size(); ++row)
    sum += x[row] * std::polar(1.0, -omega * result.trajectory->time()[row]);
  return std::abs(sum) * 2 / static_cast<double>(x.size() - 1);
}

Eigen::MatrixXd state_matrix(const std::string& text) {
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

std::vector<double> natural_frequencies(const std::string& text) {
  const Eigen::VectorXcd eigenvalues = eigen_solution(state_matrix(text)).values;
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  std::vector<double> frequencies;
  for (const std::complex<double>& lambda : eigenvalues)
    if (lambda.imag() > 1e-6 * largest) frequencies.push_back(lambda.imag());
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

void expect_frequencies(const Validation& is, const std::string& text, const std::vector<double>& expected, double unit,
                        double relative) {
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

PublishedSeries published_series(const std::string& file, int x_column, int y_column) {
  Messages messages(file);
  TableNumbers numbers = TableFile(source_path("tests/cases/" + file)).numbers({x_column, y_column}, messages);
  messages.throw_if_any();
  return {std::move(numbers.columns[0]), std::move(numbers.columns[1])};
}

double largest_difference(const Result& result, const std::string& channel, const PublishedSeries& published) {
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

}  // namespace kurbel::test
