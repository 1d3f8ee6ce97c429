// floquet.cpp — the period interval by interval, the eigenvalues of the product, and the phases of the modes.
#include "engine/periodic/floquet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"
#include "engine/matrices/periodic_schur.h"
#include "engine/numerics/angles.h"
#include "engine/orbit/follow_period.h"
#include "engine/return_map/sensitivities.h"

namespace kurbel {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double looser = 100;           // the tolerance by which errors are measured
constexpr double in_common = 4;          // allows for common errors of both computations with similar steps
constexpr double fades_in_interval = 9;  // ln of the allowed decay of one direction relative to another
constexpr double turns_in_interval = 1;  // [rad] of the slow ones
constexpr std::size_t least_intervals = 12, most_intervals = 2000;
constexpr double gone = 1e-9, gone_by_differences = 1e-6;  // of the largest direction: accuracy of the integration
constexpr double difference_step = 2e-5;                   // of states over their scales
constexpr double jumps = 2;       // [rad] in an interval, from the mode's phase: the number of turns is then ambiguous
constexpr double vanishes = 0.1;  // of a mode's mean amplitude in a motion: below this its phase is not significant

struct BrokenOff : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Transition matrices A_k from section to section; filled up with zeros where sections have fewer directions than others.
struct Period {
  std::vector<MatrixXd> factors;
  std::vector<MatrixXd> directions;  // before each: δy over the scales = directions · coordinates
  Index rank = 0;                    // least
  double wiped_out = 0;              // largest share of a factor that was set to zero
};

// As square as the largest.
MatrixXd filled(const MatrixXd& m, Index rows, Index columns) {
  MatrixXd larger = MatrixXd::Zero(rows, columns);
  larger.topLeftCorner(m.rows(), m.cols()) = m;
  return larger;
}

// Sets entries below the accuracy of the integration to zero.
void wipe_out(MatrixXd& factor, double least, Period& round) {
  if (factor.size() == 0) return;
  const Svd svd = thin_svd(factor);
  Eigen::VectorXd values = svd.values;
  Index rank = values.size();
  for (; rank > 1 && values[rank - 1] <= least * values[0]; values[--rank] = 0)
    round.wiped_out = std::max(round.wiped_out, values[rank - 1] / values[0]);
  if (rank < values.size()) factor = product_transposed(svd.u * values.asDiagonal(), svd.v);
  round.rank = std::min(round.rank, rank);
}

class Machine {
 public:
  Machine(const ReturnMap& map, double tolerance)
      : map_(map), tolerance_(tolerance), equations_(map.shared_model(), false) {
    const ErrorControl control = equations_.error_control(1);
    scale_.resize(static_cast<Index>(equations_.state_count()));
    for (Index i = 0; i < scale_.size(); ++i) {
      const double scale = control.scale[static_cast<std::size_t>(i)];
      scale_[i] = scale > 0 ? scale : 1;
    }
  }
  const Eigen::VectorXd& scale() const { return scale_; }

  struct Way {
    double time = 0;  // of the period [s]
    MatrixXd mean;    // Jacobian
    std::vector<double> events;
  };
  Way follow(const Eigen::VectorXd& z) {
    MeanJacobian mean(equations_);
    const RunOutcome outcome = follow_period(map_, z, equations_, {.tolerance = tolerance_}, {&mean});
    if (!outcome.complete) throw BrokenOff(outcome.diagnosis);
    if (!map_.periodicity().by_time && !outcome.stopped) throw BrokenOff("the machine does not complete a cycle");
    const double from = map_.start_time();
    Way way{outcome.t - from, mean.mean(), {}};
    for (const Event& e : outcome.events) way.events.push_back(e.t - from);
    return way;
  }

  // Over intervals that end at these times; the last one ends the period.
  Period round(const Eigen::VectorXd& z, const std::vector<double>& ends) {
    State here;
    here.t = map_.start_time();
    here.y = map_.place(equations_, z);
    here.modes = equations_.modes();
    std::vector<PoincareSection> sections = {map_.section()};
    Period round{{}, {}, static_cast<Index>(map_.size()), 0};
    Index largest = round.rank;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const MatrixXd moved = advance(here, map_.start_time() + ends[k], sections.back().directions());
      if (k + 1 < ends.size()) sections.emplace_back(equations_, here, map_.section().options());
      const PoincareSection& end = k + 1 < ends.size() ? sections.back() : sections.front();
      std::vector<double> rate(equations_.size());
      equations_.bind(here.modes);
      equations_.flow(here.t, here.y, rate);
      Eigen::RowVectorXd slowing;
      round.factors.push_back(end.read_at_end(moved, rate, slowing));
      wipe_out(round.factors.back(), map_.variational() ? gone : gone_by_differences, round);
      largest = std::max(largest, static_cast<Index>(end.size()));
    }
    for (MatrixXd& factor : round.factors) factor = filled(factor, largest, largest);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const PoincareSection& section = sections[k];
      round.directions.push_back(
          filled(scale_.cwiseInverse().asDiagonal() * section.directions(), scale_.size(), largest));
    }
    return round;
  }

 private:
  RunOptions options(double from, double until) const {
    RunOptions run{.tolerance = tolerance_,
                   .method = map_.options().method,
                   .until = until,
                   .budget = map_.options().budget,
                   .interrupted = map_.options().interrupted,
                   .progress = {}};
    run.from = {from, {}};
    return run;
  }

  // The state, and the transformed directions.
  MatrixXd advance(State& state, double until, const MatrixXd& directions) {
    if (!map_.variational()) return advance_by_differences(state, until, directions);
    equations_.bind(state.modes);
    state.y.resize(equations_.size(), 0.0);
    Sensitivities sensitivities(equations_, static_cast<std::size_t>(directions.cols()), 1);
    RunOptions run = options(state.t, until);
    run.from->y = sensitivities.start(state.y, directions);
    run.extension = &sensitivities;
    const RunOutcome outcome = integrate(equations_, run, {});
    if (!outcome.complete) throw BrokenOff(outcome.diagnosis);
    state.t = outcome.t;
    state.y.assign(outcome.state.begin(), outcome.state.begin() + static_cast<std::ptrdiff_t>(equations_.size()));
    state.modes = equations_.modes();
    return sensitivities.matrix(outcome.state).topRows(scale_.size());
  }

  MatrixXd advance_by_differences(State& state, double until, const MatrixXd& directions) {
    MatrixXd moved(scale_.size(), directions.cols());
    for (Index j = 0; j < directions.cols(); ++j) {
      const Eigen::VectorXd step = difference_step * directions.col(j);
      moved.col(j) = (image(state, until, step) - image(state, until, -step)) / (2 * difference_step);
    }
    image(state, until, Eigen::VectorXd::Zero(scale_.size()));
    state.t = until;
    state.y = end_;
    state.modes = equations_.modes();
    return moved;
  }
  // y at a time, angles with their turns.
  Eigen::VectorXd image(const State& state, double until, const Eigen::VectorXd& step) {
    std::vector<double> y = state.y;
    for (Index i = 0; i < step.size(); ++i) y[static_cast<std::size_t>(i)] += step[i];
    bind_beside(equations_, state, y);
    RunOptions run = options(state.t, until);
    run.from->y = y;
    const RunOutcome outcome = integrate(equations_, run, {});
    if (!outcome.complete) throw BrokenOff(outcome.diagnosis);
    end_ = outcome.state;
    Eigen::VectorXd image(scale_.size());
    const auto angles = static_cast<Index>(equations_.model().angle_count());
    for (Index i = 0; i < image.size(); ++i) {
      const auto state_number = static_cast<std::size_t>(i);
      image[i] = i < angles ? equations_.angle_with_turns(state_number, end_) : end_[state_number];
    }
    return image;
  }

  const ReturnMap& map_;
  double tolerance_;
  Equations equations_;
  Eigen::VectorXd scale_;
  std::vector<double> end_;
};

std::size_t intervals_for(double time, const std::vector<MeanMode>& modes) {
  double fastest = -HUGE_VAL, slowest = HUGE_VAL, turns = HUGE_VAL;
  for (const MeanMode& mode : modes) {
    fastest = std::max(fastest, mode.exponent.real());
    slowest = std::min(slowest, mode.exponent.real());
    if (mode.exponent.imag() > 0) turns = std::min(turns, mode.exponent.imag());
  }
  double wanted = static_cast<double>(least_intervals);
  if (!modes.empty()) wanted = std::max(wanted, time * (fastest - slowest) / fades_in_interval);
  if (std::isfinite(turns)) wanted = std::max(wanted, time * turns / turns_in_interval);
  return static_cast<std::size_t>(std::ceil(std::min(wanted, static_cast<double>(most_intervals))));
}

// Ends of intervals of about the same length, each as far from events as a fifth of it to either side allows.
std::vector<double> ends_away_from(const std::vector<double>& events, double time, std::size_t count) {
  std::vector<double> ends;
  const double length = time / static_cast<double>(count);
  const auto distance = [&](double t) {
    double least = HUGE_VAL;
    for (const double e : events) least = std::min(least, std::abs(e - t));
    return least;
  };
  for (std::size_t k = 1; k < count; ++k) {
    double best = length * static_cast<double>(k);
    for (const double aside : {-0.2, -0.1, 0.1, 0.2}) {
      if (distance(best) > 0.04 * length) break;
      const double other = length * (static_cast<double>(k) + aside);
      if (distance(other) > distance(best)) best = other;
    }
    ends.push_back(best);
  }
  ends.push_back(time);
  return ends;
}

double turned(double phase) { return std::remainder(phase, turn); }

// The phase of one motion over the cycle, measured with its mode.
class PhaseReader {
 public:
  PhaseReader(const std::vector<MeanMode>& modes, const ModeFilter& filter, const std::vector<double>& ends)
      : modes_(modes), filter_(filter), ends_(ends) {}

  // w_k before each interval, over the scales, with A_k w_k = ν_k w_{k+1}. Of all modes with a share in it, the one
  // with the nearest exponent is chosen.
  void read(const std::vector<VectorXcd>& w, const std::vector<Complex>& nu, const PeriodicEigenvalue& value,
            FloquetExponent& out) const {
    std::vector<VectorXcd> seen;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(static_cast<Index>(modes_.size()));
    for (const VectorXcd& here : w) {
      seen.push_back(filter_(here));
      const double length = filter_.length(here);
      if (length > 0) share += seen.back().cwiseAbs() / (length * static_cast<double>(w.size()));
    }
    out.phase_advance = out_of_step(value);
    double best = 0;
    for (Index j = 0; j < share.size(); ++j) {
      const Complex mode = modes_[static_cast<std::size_t>(j)].exponent;
      if (!(share[j] > 0) || (is_real(value) && mode.imag() < 0)) continue;
      const Followed followed = follow(j, seen, nu);
      double phase = mode.imag() == 0 ? out_of_step(value) : branch(followed.phase, value);
      const double off = std::abs(Complex(value.log_magnitude, phase) - mode * ends_.back());
      const double score = share[j] / (1 + off * off);
      if (score <= best) continue;
      best = score;
      out.mode = static_cast<int>(j);
      out.share = share[j];
      const double nearest = mode.imag() == 0 ? phase : branch(mode.imag() * ends_.back(), value);
      out.off_nearest = static_cast<int>(std::round((phase - nearest) / turn));
      out.branch_by_mean = out.off_nearest != 0 && !followed.sure;
      if (out.branch_by_mean) phase = nearest, out.off_nearest = 0;
      out.phase_advance = phase;
    }
  }

 private:
  // A motion in phase with the period has equal shares of a mode and of its conjugate.
  static bool is_real(const PeriodicEigenvalue& value) {
    const double off = std::min(std::abs(value.phase), std::numbers::pi - std::abs(value.phase));
    return off <= std::max(1e-9, 10 * value.error);
  }
  // For aperiodic modes: 0 or π if the multiplier is real.
  static double out_of_step(const PeriodicEigenvalue& value) {
    return is_real(value) ? std::abs(value.phase) : value.phase;
  }
  // The phase of the multiplier that is nearest to a phase.
  static double branch(double phase, const PeriodicEigenvalue& value) {
    return value.phase + turn * std::round((phase - value.phase) / turn);
  }
  struct Followed {
    double phase = 0;  // [rad] in a period
    bool sure = true;
  };
  // Phase advance measured with a mode, in each interval as near as possible to the phase advance of the mode.
  Followed follow(Index mode, const std::vector<VectorXcd>& seen, const std::vector<Complex>& nu) const {
    const double omega = modes_[static_cast<std::size_t>(mode)].exponent.imag();
    Followed followed;
    double before = 0, least = HUGE_VAL, mean = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const double by_mode = omega * (ends_[k] - before);
      const Complex ratio = nu[k] * seen[(k + 1) % seen.size()][mode] * std::conj(seen[k][mode]);
      const double beside = turned(std::arg(ratio) - by_mode), amplitude = std::abs(seen[k][mode]);
      followed.phase += by_mode + beside;
      followed.sure = followed.sure && std::abs(beside) < jumps;
      least = std::min(least, amplitude);
      mean += amplitude / static_cast<double>(seen.size());
      before = ends_[k];
    }
    followed.sure = followed.sure && least > vanishes * mean;
    return followed;
  }

  const std::vector<MeanMode>& modes_;
  const ModeFilter& filter_;
  const std::vector<double>& ends_;
};

// The corresponding multiplier of the looser computation is the nearest one that is unused.
std::vector<double> differences(const PeriodicSchur& exact, const PeriodicSchur& loose) {
  std::vector<PeriodicEigenvalue> left = loose.eigenvalues();
  std::vector<double> off;
  for (const PeriodicEigenvalue& value : exact.eigenvalues()) {
    const auto distance = [&](const PeriodicEigenvalue& other) {
      const double size = value.log_magnitude - other.log_magnitude;
      return std::isnan(size) ? 0 : std::hypot(size, turned(value.phase - other.phase));
    };
    const auto nearest = std::min_element(left.begin(), left.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    off.push_back(distance(*nearest));
    left.erase(nearest);
  }
  return off;
}

void find(const ReturnMap& map, const Eigen::VectorXd& z, const FloquetOptions& options, FloquetSpectrum& out) {
  Machine machine(map, map.options().tolerance);
  const Machine::Way way = machine.follow(z);
  out.time = way.time;
  const std::vector<MeanMode> of_mean = modes_of(way.mean, machine.scale());
  out.modes = options.modes.empty() ? of_mean : options.modes;
  if (map.size() == 0) return;
  out.intervals = options.intervals > 0 ? options.intervals : intervals_for(way.time, of_mean);
  std::vector<double> ends = ends_away_from(way.events, way.time, out.intervals);
  Period round = machine.round(z, ends);
  // Motions that decay faster than the mean survive in shorter intervals; sticking ones vanish in any interval.
  for (int shorter = 0; options.intervals == 0 && shorter < 2 && round.wiped_out > 0; ++shorter) {
    out.intervals *= 2;
    ends = ends_away_from(way.events, way.time, out.intervals);
    round = machine.round(z, ends);
  }
  const PeriodicSchur schur(round.factors);
  std::vector<double> off(schur.size(), 0.0);
  if (options.measure_error)
    off = differences(schur, PeriodicSchur(Machine(map, looser * map.options().tolerance).round(z, ends).factors));
  const ModeFilter filter(out.modes, machine.scale(), map.model().angle_count());
  const PhaseReader phases(out.modes, filter, ends);
  for (std::size_t j = 0; j < map.size(); ++j) {
    FloquetExponent e;
    const PeriodicEigenvalue& value = schur.eigenvalues()[j];
    const std::vector<VectorXcd> v = schur.vectors(j);
    std::vector<VectorXcd> w;
    std::vector<Complex> nu;
    for (std::size_t k = 0; k < v.size(); ++k) {
      w.push_back(round.directions[k] * v[k]);
      nu.push_back(v[(k + 1) % v.size()].dot(round.factors[k] * v[k]));
    }
    Index largest = 0;
    w.front().cwiseAbs().maxCoeff(&largest);
    e.shape = machine.scale().asDiagonal() * w.front() / w.front()[largest];
    if (static_cast<Index>(j) >= round.rank || value.log_magnitude == -HUGE_VAL) {
      e.exponent = -HUGE_VAL;
    } else {
      phases.read(w, nu, value, e);
      e.exponent = Complex(value.log_magnitude, e.phase_advance) / way.time;
      e.error = (in_common * off[j] + value.error + value.sensitivity * round.wiped_out) / way.time;
    }
    out.exponents.push_back(std::move(e));
  }
}

}  // namespace

FloquetSpectrum floquet_exponents(const ReturnMap& map, const Eigen::VectorXd& z, const FloquetOptions& options) {
  FloquetSpectrum out;
  try {
    find(map, z, options, out);
  } catch (const std::runtime_error& error) {  // a failed period, jamming joints, an iteration without convergence
    out.why = error.what();
    out.exponents.clear();
  }
  return out;
}

}  // namespace kurbel
