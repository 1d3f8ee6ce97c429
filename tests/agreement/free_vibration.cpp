// free_vibration.cpp — pushes, what the runs make of them, and the exponents of that.
#include "tests/agreement/free_vibration.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/run/run.h"

namespace kurbel::agreement {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;
constexpr Index largest_problem = 420;  // blocks × states
constexpr int most_sub_intervals = 64;
constexpr std::size_t looked_for = 3;      // frequencies that choose the sub-intervals
constexpr double dies_by = 2.5;            // e-foldings within a sub-interval
constexpr double turns_by = 0.15;          // radians between looks
constexpr int most_looks = 4000;           // within a sub-interval
constexpr double left_by_runs = 2e-11;     // of the scales
constexpr double least_multiplier = 1e-6;  // of a sub-interval: what is less is lost in what runs leave
constexpr double real_enough = 1e-3;       // of a double exponent half the digits are lost
constexpr double much = 0.1;               // of the energy

// States at equal times.
class StateSamples final : public Observer {
 public:
  StateSamples(double from, double step, int number) : from_(from), step_(step), number_(number) {}
  void begin(double, std::span<const double> y, Equations& equations) override {
    if (list_.empty()) take(y, equations);
  }
  void step(StepView& view) override {
    while (static_cast<int>(list_.size()) <= number_) {
      const double t = from_ + step_ * static_cast<double>(list_.size());
      if (t > view.t()) break;
      const std::span<const double> now = view.at(t);
      take(std::vector<double>(now.begin(), now.end()), view.equations());
    }
  }
  const std::vector<VectorXd>& list() const { return list_; }

 private:
  void take(std::span<const double> y, Equations& equations) {
    VectorXd x(static_cast<Index>(equations.state_count()));
    for (Index i = 0; i < x.size(); ++i) x[i] = y[at(i)];
    for (std::size_t a = 0; a < equations.model().angle_count(); ++a)
      x[static_cast<Index>(a)] = equations.angle_with_turns(a, y);
    list_.push_back(std::move(x));
  }
  double from_, step_;
  int number_;
  std::vector<VectorXd> list_;
};

// One sub-interval: pushes as they were at its begin, and what was made of them, look by look; over the scales.
struct Stretch {
  MatrixXd begin;               // states × pushes
  std::vector<MatrixXd> looks;  // the last: at its end
  MatrixXd basis;               // of what can differ at its begin
};

class Pushing {
 public:
  Pushing(const SettledRun& run, const PushSettings& settings)
      : run_(run), settings_(settings), equations_(run.model, false), begin_(processor_time()) {
    equations_.bind(run.at.state.modes);
    const std::vector<double> scale = equations_.error_control(1).scale;
    scale_ = Eigen::Map<const VectorXd>(scale.data(), static_cast<Index>(equations_.state_count()));
    scale_.head(static_cast<Index>(run.model->angle_count())).setOnes();
    weigh();
  }

  FreeVibrations find() {
    try {
      measure();
    } catch (const std::runtime_error& error) {
      found_.why = error.what();
      found_.list.clear();
      found_.measured = false;
    }
    found_.cpu_seconds = processor_time() - begin_;
    return std::move(found_);
  }

 private:
  void measure() {
    if (run_.kind != Motion::repeats) throw std::runtime_error("the machine does not repeat");
    if (run_.model->elastic.empty()) throw std::runtime_error("nothing is elastic");
    choose_sub_intervals();
    Checkpoint from = run_.at;
    for (int k = 0; k < found_.sub_intervals; ++k) {
      both_.emplace_back(), one_.emplace_back();
      from = stretch(from, both_.back(), one_.back());
      if (processor_time() - begin_ > settings_.budget)
        throw std::runtime_error(fmt::format("more than {:g} s of processor time", settings_.budget));
    }
    for (Stretch* s : {both_.data(), one_.data()})
      for (int k = 0; k < found_.sub_intervals; ++k) s[k].basis = basis_of(both_[at(k)].begin);
    found_.list = vibrations_of(both_);
    const std::vector<FreeVibration> other = vibrations_of(one_);
    for (FreeVibration& s : found_.list) add_error(s, other);
    found_.measured = true;
  }

  // Energies of unit states over their scales; internal states and angles have none of their own.
  void weigh() {
    const Model& m = *run_.model;
    weight_ = VectorXd::Zero(scale_.size());
    for (std::size_t j = 0; j < m.elastic.size(); ++j) {
      const ElasticJoint& e = m.elastic[j];
      if (e.slips || e.springless) continue;
      const auto i = static_cast<Index>(equations_.twist_index(static_cast<int>(j)));
      weight_[i] = 0.5 * m.torque_scale / m.scale_ratio[at(m.network.joints[at(e.joint)].a)] * scale_[i];
    }
    for (std::size_t s = 0; s < m.free_shafts; ++s) {
      const auto i = static_cast<Index>(equations_.speed_index(static_cast<int>(s)));
      weight_[i] = 0.5 * m.shafts[s].mean_inertia * scale_[i] * scale_[i];
    }
  }

  // --- how long they are ---

  // By differences of the right-hand side at the settled state: how fast things go, roughly.
  std::vector<Complex> rates() {
    const State& state = run_.at.state;
    const Index n = scale_.size();
    const std::size_t all = state.y.size();
    std::vector<double> y = state.y, forwards(all), backwards(all);
    MatrixXd a = MatrixXd::Zero(n, n);  // angles are held
    for (auto j = static_cast<Index>(equations_.twists_begin()); j < n; ++j) {
      const double h = 1e-6 * scale_[j], before = y[at(j)];
      y[at(j)] = before + h;
      equations_.flow(state.t, y, forwards);
      y[at(j)] = before - h;
      equations_.flow(state.t, y, backwards);
      y[at(j)] = before;
      for (Index i = 0; i < n; ++i) a(i, j) = (forwards[at(i)] - backwards[at(i)]) / (2 * h) * scale_[j] / scale_[i];
    }
    if (!a.allFinite()) return {};
    const Eigen::VectorXcd values = eigenvalues(a);
    std::vector<Complex> vibrating;
    for (const Complex& value : values)
      if (value.imag() > 1e-3 * std::abs(value)) vibrating.push_back(value);
    std::sort(vibrating.begin(), vibrating.end(), [](Complex u, Complex v) { return std::abs(u) < std::abs(v); });
    return vibrating;
  }
  void choose_sub_intervals() {
    held_ = rates();
    const std::vector<Complex>& vibrating = held_;
    double fastest = run_.base == Base::none ? 1 : 2 * pi / run_.period, fading = 0;
    for (std::size_t i = 0; i < std::min(looked_for, vibrating.size()); ++i) {
      fastest = std::max(fastest, std::abs(vibrating[i]));
      fading = std::max(fading, std::abs(vibrating[i].real()));
    }
    period_ = run_.base == Base::none ? 1.5 / fastest : run_.period;
    const double number = std::ceil(period_ * fading / dies_by);
    const int most = std::clamp(static_cast<int>(largest_problem / scale_.size()), 1, most_sub_intervals);
    found_.sub_intervals = std::clamp(static_cast<int>(std::min(number, 1e6)), 1, most);
    step_ = period_ / found_.sub_intervals;
    looks_ = std::clamp(static_cast<int>(std::ceil(step_ * fastest / turns_by)), 1, most_looks);
    found_.fastest = pi / 2 * looks_ / step_;
    found_.shortest = -0.5 * std::log(least_multiplier) / step_;
    found_.pushes = static_cast<int>(scale_.size());
    if (found_.pushes > settings_.most_pushes)
      throw std::runtime_error(fmt::format("{} states: more than are pushed one by one", found_.pushes));
  }

  // --- runs ---

  StateSamples run_from(const Checkpoint& from, Checkpoint* end) const {
    Equations equations(run_.model, false);
    StateSamples looks(from.state.t, step_ / looks_, looks_);
    RunOptions options{.tolerance = settings_.tolerance,
                       .method = "auto",
                       .until = from.state.t + step_,
                       .budget = settings_.budget,
                       .interrupted = nullptr,
                       .progress = {}};
    options.to_go_on = true;
    options.checkpoint = &from;
    const RunOutcome outcome = integrate(equations, options, {&looks});
    if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
    if (end) {
      *end = outcome.checkpoint;
      end->integrals.clear(), end->observers.clear();
    }
    StateSamples whole = looks;
    return whole;
  }
  // Speeds that are tied stay so.
  Checkpoint pushed(const Checkpoint& from, Index state, double by) {
    Checkpoint checkpoint = from;
    std::vector<double>& y = checkpoint.state.y;
    y[at(state)] += by * scale_[state];
    equations_.bind(from.state.modes);
    equations_.evaluate(from.state.t, from.state.y);
    if (equations_.ties().any())
      equations_.ties().project(equations_.inertia(),
                                std::span(y).subspan(equations_.speed_index(0), run_.model->shafts.size()));
    return checkpoint;
  }
  Checkpoint stretch(const Checkpoint& from, Stretch& both, Stretch& one) {
    Checkpoint end;
    const std::vector<VectorXd> middle = run_from(from, &end).list();
    const Index n = scale_.size();
    both.begin = one.begin = MatrixXd(n, n);
    both.looks.assign(middle.size() - 1, MatrixXd(n, n));
    one.looks = both.looks;
    for (Index j = 0; j < n; ++j) {
      const std::vector<VectorXd> plus = run_from(pushed(from, j, settings_.push), nullptr).list(),
                                  minus = run_from(pushed(from, j, -settings_.push), nullptr).list();
      const std::size_t number = std::min({middle.size(), plus.size(), minus.size()});
      if (number < middle.size()) throw std::runtime_error("a pushed run ended early");
      for (std::size_t i = 0; i < number; ++i) {
        MatrixXd& two_sided = i == 0 ? both.begin : both.looks[i - 1];
        MatrixXd& one_sided = i == 0 ? one.begin : one.looks[i - 1];
        two_sided.col(j) = (plus[i] - minus[i]).cwiseQuotient(scale_) / (2 * settings_.push);
        one_sided.col(j) = (plus[i] - middle[i]).cwiseQuotient(scale_) / settings_.push;
      }
    }
    return end;
  }

  // --- exponents ---

  static MatrixXd basis_of(const MatrixXd& begin) {
    Eigen::ColPivHouseholderQR<MatrixXd> qr(begin);
    qr.setThreshold(1e-3);
    return MatrixXd(qr.householderQ()).leftCols(qr.rank());
  }
  // What becomes of unit pushes along the basis, at one look.
  static MatrixXd made_of_basis(const Stretch& s, const MatrixXd& look) {
    return look * s.begin.completeOrthogonalDecomposition().solve(s.basis);
  }

  std::vector<FreeVibration> vibrations_of(const std::vector<Stretch>& stretches) const {
    const std::size_t number = stretches.size();
    std::vector<Index> first(number + 1, 0);
    for (std::size_t k = 0; k < number; ++k) first[k + 1] = first[k] + stretches[k].basis.cols();
    MatrixXd cyclic = MatrixXd::Zero(first[number], first[number]);
    for (std::size_t k = 0; k < number; ++k) {
      const Stretch& next = stretches[(k + 1) % number];
      const MatrixXd image = made_of_basis(stretches[k], stretches[k].looks.back());
      cyclic.block(first[(k + 1) % number], first[k], next.basis.cols(), image.cols()) = next.basis.transpose() * image;
    }
    const Eigenpairs pairs = eigenpairs(cyclic);
    std::vector<FreeVibration> list;
    const double sector = pi / static_cast<double>(number);
    for (Index e = 0; e < first[number]; ++e) {
      // Of N values that differ by roots of one, and their conjugates, the one next to the positive axis.
      const Complex mu = pairs.values[e];
      if (std::abs(mu) < least_multiplier || std::arg(mu) < 0 || std::arg(mu) > sector * (1 + 1e-9)) continue;
      std::vector<Eigen::VectorXcd> pieces;
      for (std::size_t k = 0; k < number; ++k)
        pieces.push_back(pairs.vectors.col(e).segment(first[k], stretches[k].basis.cols()));
      const FreeVibration vibration = followed(stretches, pieces, mu);
      const bool seen = std::any_of(list.begin(), list.end(), [&](const FreeVibration& s) {
        return std::abs(s.omega - vibration.omega) + std::abs(s.decay - vibration.decay) < 1e-9 * s.natural();
      });
      if (vibration.omega > 0 && !seen) list.push_back(vibration);
    }
    // What is locked comes in two, and takes the place of a vibration; else what never changes its sign from period to
    // period is a slow change of speed that the forced vibration follows.
    const std::vector<FreeVibration> all = list;
    const auto free = std::count_if(all.begin(), all.end(), [](const FreeVibration& s) { return !s.locked; });
    std::erase_if(list, [&](const FreeVibration& s) {
      return s.locked && !s.turned &&
             (free >= static_cast<std::ptrdiff_t>(held_.size()) ||
              std::none_of(all.begin(), all.end(), [&](const FreeVibration& o) {
                return o.locked && o.decay != s.decay && std::abs(o.omega - s.omega) < 1.02 * pi / period_;
              }));
    });
    if (!run_.model->internal_states.empty()) leave_others(list);
    std::sort(list.begin(), list.end(),
              [](const FreeVibration& a, const FreeVibration& b) { return a.omega < b.omega; });
    return list;
  }
  // Currents, deflections of rods: what has its energy in these may turn with the shafts at a frequency that is not its
  // own. A vibration of shafts is one that the machine has, or nearly, while its angles are held, and is the nearest.
  void leave_others(std::vector<FreeVibration>& list) const {
    const auto apart = [](const FreeVibration& s, const Complex& rate) {
      return std::hypot(s.omega - rate.imag(), s.decay + rate.real());
    };
    const std::vector<FreeVibration> all = list;
    for (FreeVibration& s : list) {
      const auto rate = std::min_element(held_.begin(), held_.end(),
                                         [&](const Complex& a, const Complex& b) { return apart(s, a) < apart(s, b); });
      if (rate == held_.end() || apart(s, *rate) > 0.35 * s.natural()) s.share = 0;
      for (const FreeVibration& o : all)
        if (rate != held_.end() && apart(o, *rate) < apart(s, *rate) && apart(s, *rate) > 0.1 * s.natural())
          s.share = 0;
    }
  }

  // Along the period: how the twist that vibrates most turns.
  FreeVibration followed(const std::vector<Stretch>& stretches, const std::vector<Eigen::VectorXcd>& pieces,
                         Complex mu) const {
    std::vector<Eigen::VectorXcd> path;
    const double log_mu = std::log(std::abs(mu));
    for (std::size_t k = 0; k < stretches.size(); ++k) {
      const Stretch& s = stretches[k];
      const MatrixXd back = s.begin.completeOrthogonalDecomposition().solve(s.basis);
      const Eigen::VectorXcd weights = back.cast<Complex>() * pieces[k];
      if (k == 0) path.push_back(s.begin.cast<Complex>() * weights);
      // Each piece is the one before over μ: without that, the swing would jump.
      const Complex phase = std::polar(1.0, std::arg(mu) * static_cast<double>(k));
      for (std::size_t i = 0; i < s.looks.size(); ++i) {
        const double part = static_cast<double>(i + 1) / static_cast<double>(s.looks.size());
        path.push_back(phase * std::exp(-log_mu * part) * (s.looks[i].cast<Complex>() * weights));
      }
    }
    return vibration_of(path, log_mu, std::arg(mu));
  }

  // Of a path without its decay, e^{iωt} p(t): in which of its frequencies the machine's parts have most energy.
  FreeVibration vibration_of(const std::vector<Eigen::VectorXcd>& path, double log_mu, double arg_mu) const {
    FreeVibration vibration;
    vibration.decay = -log_mu / step_;
    const auto twists = static_cast<Index>(equations_.twists_begin());
    const auto joints = static_cast<Index>(run_.model->elastic.size());
    const double lowest = arg_mu / step_;
    const MatrixXd energy = energies(path, lowest);
    Index joint = 0;
    const Index k = sideband_of(energy.colwise().sum(), lowest);
    vibration.omega = frequency(lowest, k, energy.cols());
    vibration.share = energy.col(k).segment(twists, joints).sum() / std::max(energy.col(k).sum(), 1e-300);
    energy.col(k).segment(twists, joints).maxCoeff(&joint);
    vibration.joint = run_.model->network.joints[at(run_.model->elastic[at(joint)].joint)].component;
    const double phase = std::abs(lowest) * period_;  // over a period
    vibration.locked = phase < real_enough || std::abs(phase - pi) < real_enough;
    vibration.turned = vibration.locked && phase > 1;
    // The motion itself, later or earlier, neither grows nor dies away; nor does what is bound to stay as it is.
    if (vibration.locked && (vibration.share < 0.25 || std::abs(vibration.decay) * period_ < 1e-4)) vibration.omega = 0;
    return vibration;
  }
  double frequency(double lowest, Index k, Index number) const {
    return std::abs(lowest + 2 * pi * static_cast<double>(k <= number / 2 ? k : k - number) / period_);
  }
  // That with most energy. Currents and deflections of rods have energies that are not counted: beside them, of all with
  // much energy the one nearest to a frequency that the machine has while its angles are held.
  Index sideband_of(const Eigen::RowVectorXd& energy, double lowest) const {
    Index best = 0;
    const double most = energy.maxCoeff(&best);
    if (run_.model->internal_states.empty()) return best;
    double nearest = HUGE_VAL;
    for (Index k = 0; k < energy.size(); ++k)
      for (const Complex& rate : held_) {
        const double apart = std::abs(rate.imag() - frequency(lowest, k, energy.size()));
        if (energy[k] > much * most && apart < nearest) nearest = apart, best = k;
      }
    return best;
  }
  // States × frequencies ω₀ + 2πk/T in the order of the FFT: ½ I ω², ½ k θ² of the amplitudes.
  MatrixXd energies(const std::vector<Eigen::VectorXcd>& path, double lowest) const {
    const std::size_t number = path.size() - 1;
    MatrixXd energy = MatrixXd::Zero(scale_.size(), static_cast<Index>(number));
    Eigen::FFT<double> transform;
    std::vector<Complex> values(number), spectrum;
    for (Index i = 0; i < scale_.size(); ++i) {
      if (weight_[i] <= 0) continue;
      for (std::size_t t = 0; t < number; ++t)
        values[t] =
            path[t][i] * std::polar(1.0, -lowest * period_ * static_cast<double>(t) / static_cast<double>(number));
      transform.fwd(spectrum, values);
      for (std::size_t k = 0; k < number; ++k) energy(i, static_cast<Index>(k)) = weight_[i] * std::norm(spectrum[k]);
    }
    return energy;
  }

  void add_error(FreeVibration& vibration, const std::vector<FreeVibration>& others) const {
    const auto apart = [&](const FreeVibration& o) {
      return std::hypot(o.omega - vibration.omega, o.decay - vibration.decay);
    };
    const auto nearest =
        std::min_element(others.begin(), others.end(),
                         [&](const FreeVibration& a, const FreeVibration& b) { return apart(a) < apart(b); });
    const double runs = left_by_runs / settings_.push * std::exp(vibration.decay * step_) / step_;
    const double of_sides = nearest == others.end() ? vibration.natural() : apart(*nearest);
    vibration.omega_error = vibration.decay_error = runs + of_sides;
  }

  const SettledRun& run_;
  PushSettings settings_;
  Equations equations_;
  double begin_;
  VectorXd scale_, weight_;
  std::vector<Complex> held_;  // rates of the machine as it is at one moment
  double period_ = 0, step_ = 0;
  int looks_ = 1;
  std::vector<Stretch> both_, one_;  // pushes to both sides, to one
  FreeVibrations found_;
};

}  // namespace

double FreeVibration::natural() const { return std::hypot(omega, decay); }
double FreeVibration::ratio() const { return natural() > 0 ? decay / natural() : 1; }

FreeVibrations free_vibrations_of(const SettledRun& run, const PushSettings& settings) {
  return Pushing(run, settings).find();
}

}  // namespace kurbel::agreement
