// decay.cpp — a settled machine followed on: how a small deviation dies away, and what it has at equal angles.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"
#include "tests/agreement/passings.h"
#include "tests/agreement/settled_run.h"

namespace kurbel::agreement {
namespace {

constexpr double part = 1e-4;         // of the speeds, that they are more
constexpr double noise = 2e-10;       // of rated values, that two runs side by side leave
constexpr double seen = 100 * noise;  // deviations below are not examined
constexpr int most_periods = 14;      // followed
constexpr int most_modes = 4;         // distinguished
constexpr std::size_t few = 6;
constexpr double unseen = 0.03;
constexpr double fits_well = 1e-3;   // part of a deviation that a recurrence leaves
constexpr double fits_badly = 0.05;  // then it gives no factor

std::vector<Passing> passings_from(const SettledRun& run, const Checkpoint& from, double periods, Passings::Of of,
                                   double base, bool energies) {
  Equations equations(run.model, false);
  Passings passings(of, base, energies);
  RunOptions options{.tolerance = 1e-11,
                     .method = "auto",
                     .until = from.state.t + periods * run.period,
                     .budget = 20,
                     .interrupted = nullptr,
                     .progress = {}};
  options.to_go_on = true;  // steps over time, not over the angle
  options.checkpoint = &from;
  integrate(equations, options, {&passings});
  return passings.list();
}

// Speeds of all free shafts by a small part more: what is tied stays so.
Checkpoint disturbed(const SettledRun& run) {
  Checkpoint checkpoint = run.at;
  Equations equations(run.model, false);
  for (std::size_t s = 0; s < run.model->free_shafts; ++s)
    checkpoint.state.y[equations.speed_index(static_cast<int>(s))] *= 1 + part;
  return checkpoint;
}

// Deviations at one place after the other, until they are lost in what integration leaves.
std::vector<Eigen::VectorXd> deviations_of(const SettledRun& run) {
  // At equal angles of the link, so that a phase that stays behind is none of it; at equal times where time drives.
  const auto of = run.base == Base::angle ? Passings::Of::angle : Passings::Of::time;
  const double base = run.base == Base::angle ? std::abs(run.angle) : run.period;
  const std::vector<Passing> as_it_is = passings_from(run, run.at, most_periods, of, base, false),
                             aside = passings_from(run, disturbed(run), most_periods + 0.5, of, base, false);
  std::vector<Eigen::VectorXd> list;
  for (std::size_t i = 0; i < std::min(as_it_is.size(), aside.size()); ++i) {
    if (difference(as_it_is[i], aside[i]) < seen) break;
    Eigen::VectorXd d(static_cast<Eigen::Index>(aside[i].state.size()));
    for (std::size_t j = 0; j < aside[i].state.size(); ++j)
      d[static_cast<Eigen::Index>(j)] = aside[i].state[j] - as_it_is[i].state[j];
    list.push_back(std::move(d));
  }
  return list;
}

// d_j+p = a_1 d_j+p−1 + … + a_p d_j holds where p modes are seen; its factors are the roots of x^p = a_1 x^p−1 + … + a_p.
struct Fit {
  double factor = 0, left = 1;  // the largest root's magnitude; part of the deviations that it leaves
};
Fit recurrence(const std::vector<Eigen::VectorXd>& d, std::size_t from, int p) {
  const auto order = static_cast<std::size_t>(p);
  const std::size_t equations = d.size() - from - order;
  const Eigen::Index n = d.front().size();
  Eigen::MatrixXd left(static_cast<Eigen::Index>(equations) * n, p);
  Eigen::VectorXd right(left.rows());
  for (std::size_t j = 0; j < equations; ++j) {
    const double weight = 1 / d[from + j + order].norm();
    for (std::size_t k = 0; k < order; ++k)
      left.block(static_cast<Eigen::Index>(j) * n, static_cast<Eigen::Index>(k), n, 1) =
          weight * d[from + j + order - 1 - k];
    right.segment(static_cast<Eigen::Index>(j) * n, n) = weight * d[from + j + order];
  }
  const Eigen::VectorXd a = left.completeOrthogonalDecomposition().solve(right);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(p, p);
  companion.row(0) = a.transpose();
  if (p > 1) companion.bottomLeftCorner(p - 1, p - 1).setIdentity();
  return {eigenvalues(companion).cwiseAbs().maxCoeff(),
          (left * a - right).norm() / std::sqrt(static_cast<double>(equations))};
}

}  // namespace

Decay decay_of(const SettledRun& run) {
  Decay decay;
  if (run.kind != Motion::repeats || run.base == Base::event || run.base == Base::none) return decay;
  const std::vector<Eigen::VectorXd> d = deviations_of(run);
  decay.periods = static_cast<int>(d.size());
  decay.factor = std::pow(seen / part, 1.0 / static_cast<double>(d.size() + 1));
  Fit best;
  int order = 0;
  const Model& m = *run.model;
  const int unknowns = static_cast<int>(m.elastic.size() + m.free_shafts + m.internal_states.size());  // no more modes
  for (int p = 1; p <= std::min(most_modes, unknowns) && 2 * static_cast<std::size_t>(p) + 2 <= d.size(); ++p) {
    const Fit fit = recurrence(d, 0, p);
    if (order == 0 || fit.left < best.left) best = fit, order = p;
    if (fit.left < fits_well) break;
  }
  if (order == 0 || best.left > fits_badly) return decay;
  decay.measured = true;
  decay.factor = best.factor;
  decay.error = std::abs(best.factor - recurrence(d, 1, order).factor) + best.factor * (best.left + 10 * part) +
                noise / d.back().norm() * best.factor;
  // So few places may not show the slowest mode yet.
  if (d.size() < few) decay.error += unseen;
  return decay;
}

std::vector<Place> places_of(const SettledRun& run, double cycle, int number) {
  const double base = cycle / number;
  std::vector<Place> places;
  if (run.kind != Motion::repeats || std::abs(run.angle) < 1e-9) return places;
  const double periods = 1.2 * std::max(1.0, cycle / std::abs(run.angle));
  for (const Passing& p : passings_from(run, run.at, periods, Passings::Of::angle, base, true)) {
    if (static_cast<int>(places.size()) == number) break;
    const double angle = p.angle - cycle * std::floor(p.angle / cycle + 1e-9);
    places.push_back({std::max(0.0, angle), p.speed, p.kinetic_energy});
  }
  return places;
}

}  // namespace kurbel::agreement
