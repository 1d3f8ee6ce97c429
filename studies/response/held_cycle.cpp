// held_cycle.cpp — from the linear response to the fixed point of the return map with its mean speed held.
#include "studies/response/held_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/gauss.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/held_speeds.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double map_tolerance = 1e-11, enough = 1e-10;     // residual of the map, over the rated values
constexpr double most_derivatives = 25;                     // periods with derivative that a search may take
constexpr double first_part = 0.25, least_part = 1.0 / 32;  // of the way between two speeds
constexpr std::size_t samples = 4096;                       // of a cycle

// Mean speeds of shafts over a cycle, integrated along its steps.
class MeanSpeeds final : public Observer {
 public:
  explicit MeanSpeeds(std::vector<std::size_t> states) : states_(std::move(states)), sum_(states_.size(), 0.0) {}
  void step(StepView& view) override {
    gauss<3>.over(view.t_previous(), view.t() - view.t_previous(), [&](double t, double weight) {
      const std::span<const double> y = view.at(t);
      for (std::size_t i = 0; i < states_.size(); ++i) sum_[i] += weight * y[states_[i]];
    });
  }
  double mean(std::size_t i, double time) const { return sum_[i] / time; }

 private:
  std::vector<std::size_t> states_;
  std::vector<double> sum_;
};

// Motions of the coordinates in which no spring is twisted.
MatrixXd free_motions(BaseMotion& base) {
  SparseRows springs = base.twists();
  springs.prune([&](Index joint, Index, double) { return base.has_spring(static_cast<std::size_t>(joint)); });
  return motions_without_twist(springs);
}

// The motion of the linear drive, as a state of the machine with its link at the section.
class LinearMotion {
 public:
  LinearMotion(const LinearDrive& drive, const Excitations& x, BaseMotion& base)
      : drive_(drive), response_(drive), x_(x), base_(base), m_(base.model()), link_(at(m_.reduction_angle)) {
    q_ = rate_ = VectorXd::Zero(drive.size());
    own_ = VectorXd::Zero(drive.internal_states());
    twist_ = VectorXd::Zero(static_cast<Index>(drive.joints.size()));
  }

  State state() {
    const MeanMotion* orbit = base_.point().orbit.get();
    const double angle = orbit ? orbit->state.y[link_] : 0;
    add_orders(angle);
    const BaseMotion::Position position{angle, 0};
    const std::span<const double> base = base_.at(position);
    std::vector<double> y(base.begin(), base.end());
    Equations& equations = base_.equations();
    const VectorXd along = base_.coordinates().motion * rate_;
    for (std::size_t s = 0; s < m_.free_shafts; ++s)
      y[equations.speed_index(static_cast<int>(s))] += along[static_cast<Index>(s)];
    for (Index k = 0; k < own_.size(); ++k) y[equations.internal_begin() + at(k)] += own_[k];
    VectorXd apart = VectorXd::Zero(twist_.size());
    for (Index j = 0; j < twist_.size(); ++j) {
      if (!base_.has_spring(at(j))) continue;
      const std::size_t i = equations.twist_index(static_cast<int>(j));
      y[i] += twist_[j];
      apart[j] = y[i] - (orbit ? orbit->state.y[i] : 0);
    }
    turn_angles(apart, y, orbit ? &orbit->state.y : nullptr);
    y.resize(m_.state_count());
    return {base_.time(position), std::move(y), equations.modes()};
  }

 private:
  void add(double omega, double phase, const Forcing& forcing) {
    const FrequencyResponse::Motion motion = response_.motion(omega, forcing);
    if (!motion.q.allFinite() || !motion.own.allFinite()) return;
    const Complex turned = std::polar(1.0, phase);
    q_ += (motion.q * turned).real();
    rate_ += (motion.q * turned * Complex(0, omega)).real();
    own_ += (motion.own * turned).real();
    twist_ += ((drive_.twists * motion.q + forcing.twist) * turned).real();
  }
  void add_orders(double angle) {
    const double speed = drive_.at.speed, sense = speed < 0 ? -1 : 1;
    for (std::size_t r = 1; r <= x_.harmonics && !x_.at_speed(speed).empty(); ++r) {
      if (!x_.is_looked_at(r)) continue;
      Forcing forcing = Forcing::none(drive_);
      for (const OrderSource& s : x_.at_speed(speed)) forcing.add(s.kind, s.index, s.at(r, speed));
      add(x_.order(r) * std::abs(speed), x_.order(r) * sense * angle, forcing);
    }
    for (const FrequencySource& s : x_.by_frequency) {
      Forcing forcing = Forcing::none(drive_);
      forcing.add(s.kind, s.index, s.amplitude);
      add(s.omega, 0, forcing);
    }
  }
  // Angles follow from twists: they change from a known state by the difference of the twists; the link's is
  // unchanged.
  void turn_angles(const VectorXd& apart, std::vector<double>& y, const std::vector<double>* known) const {
    const MatrixXd twists = MatrixXd(base_.twists());
    VectorXd turn = shortest_solution(twists, apart);
    const VectorXd whole = base_.rates();
    const auto turned = [&](const TrackedAngle& a, const VectorXd& by) {
      return a.gain * (base_.coordinates().motion * by)[a.shaft];
    };
    const double link = turned(m_.angles[link_], whole);
    if (link != 0) turn -= whole * (turned(m_.angles[link_], turn) / link);
    for (std::size_t i = 0; i < m_.angles.size(); ++i) y[i] = (known ? (*known)[i] : y[i]) + turned(m_.angles[i], turn);
  }

  const LinearDrive& drive_;
  FrequencyResponse response_;
  const Excitations& x_;
  BaseMotion& base_;
  const Model& m_;
  std::size_t link_;
  VectorXd q_, rate_, own_, twist_;
};

class CycleSearch {
 public:
  CycleSearch(const HeldMachine& machine, const LinearDrive& drive, const Excitations& x,
              const HeldCycleOptions& options)
      : machine_(machine), drive_(drive), x_(x), options_(options), base_(drive.model, drive.at), m_(base_.model()) {}

  HeldCycle run() {
    if (!is_free()) return std::move(out_);
    const Deadline deadline(options_.seconds, options_.interrupted);
    try {
      search();
    } catch (const OutOfTime& out) {
      if (out.budget() != options_.seconds) throw;
      out_.found = false;
      out_.why = "the search exceeded its time limit" + on_the_way();
    }
    out_.cost = motion_.cost;
    return std::move(out_);
  }

 private:
  // --- what is held ---

  bool is_free() {
    const Periodicity period = periodicity_of(m_);
    const bool own_period = machine_.orbit && machine_.orbit->map->periodicity().by_time && !period.by_time;
    free_ = free_motions(base_);
    if (free_.cols() == 0)
      out_.why = "a prescribed speed drives the machine, so that its mean speed cannot be held at another";
    else if (own_period)
      out_.why = "its own motion has a period that no law gives, which is known only where it is kept";
    else if (period.by_time && period.angle_matters)
      out_.why = "what depends on time and what depends on an angle have no common period at this speed";
    return out_.why.empty();
  }

  void choose_scales() {
    by_link_ = free_.cols() == 1 && !periodicity_of(m_).by_time;
    const Coordinates& c = base_.coordinates();
    for (Index f = 0; f < free_.cols(); ++f) {
      Index names = 0;
      free_.col(f).cwiseAbs().maxCoeff(&names);
      const auto shaft = at(c.shaft[at(names)]);
      unit_.push_back(m_.shafts[shaft].torque_scale / free_.col(f).cwiseAbs2().dot(base_.inertia()));
      held_.push_back(base_.equations().speed_index(static_cast<int>(shaft)));
      speed_.push_back((c.motion * base_.rates())[static_cast<Index>(shaft)]);
      scale_.push_back(m_.shafts[shaft].speed_scale);
    }
    if (by_link_) speed_ = {drive_.at.speed}, scale_ = {m_.speed_scale};
  }

  // The machine with the torques of an acceleration F a.
  std::shared_ptr<const Model> model_with(const VectorXd& a) const {
    VectorXd scaled = a;
    for (Index f = 0; f < a.size(); ++f) scaled[f] *= unit_[at(f)];
    const VectorXd shafts = base_.coordinates().motion * (free_ * scaled);
    Network network = machine_.network;
    for (std::size_t s = 0; s < m_.free_shafts; ++s) {
      const auto i = static_cast<Index>(s);
      const int node = m_.shafts[s].reference;
      if (base_.coordinates().motion.row(i).norm() == 0) continue;
      network.put(node, network.nodes[at(node)].component,
                  HoldingTorque{-base_.shaft_inertia()[i] * shafts[i] / m_.gain_of_node[at(node)]});
    }
    return compile_network(std::move(network), machine_.scene, machine_.effects);
  }
  OrbitOptions orbit_options() const {
    OrbitOptions options = kurbel::orbit_options(machine_.scene.run, options_.interrupted);
    options.tolerance = map_tolerance;
    options.budget = 10 * options_.seconds;  // the deadline comes first
    return options;
  }
  // The same modes, for the model with the holding torques among its elements.
  static State on(const Model& model, State state) {
    state.modes.active.resize(model.network.elements.size(), 1);
    state.modes.on_since.resize(model.network.elements.size(), 0);
    return state;
  }

  // --- the search ---

  void search() {
    choose_scales();
    const VectorXd a = first_acceleration();
    const auto model = model_with(a);
    map_ = std::make_unique<ReturnMap>(model, map_options(orbit_options()));
    const State begin = LinearMotion(drive_, x_, base_).state();
    const ReturnMap::Image guess = map_->approach_from(on(*model, begin));
    motion_.cost += map_->cost();
    out_.why = guess.why;
    if (guess.end == ReturnMap::End::returned) {
      VectorXd x(guess.z.size() + a.size());
      x << guess.z, a;
      if (solve_at(1, x)) return settle();
    }
    if (motion_.last.end != ReturnMap::End::interrupted && machine_.orbit) along_the_speeds();
  }

  VectorXd first_acceleration() const {
    VectorXd a = least_squares(free_, base_.acceleration());
    for (Index f = 0; f < a.size(); ++f) a[f] /= unit_[at(f)];
    return a;
  }

  // In steps of speed, from the machine's steady motion.
  void along_the_speeds() {
    const Orbit& orbit = *machine_.orbit;
    const double from = drive_.at.orbit->speed / drive_.at.speed;  // of the speeds to be held
    const auto model = model_with(VectorXd::Zero(free_.cols()));
    map_ = std::make_unique<ReturnMap>(model, map_options(orbit_options()));
    const PoincareSection& section = orbit.map->section();
    map_->go_through(on(*model, section.state()), section.options().sticks_throughout, drive_.at.orbit->speed);
    if (section.size() != map_->size()) return;
    VectorXd x = VectorXd::Zero(orbit.point.z.size() + free_.cols());
    x.head(orbit.point.z.size()) = orbit.point.z;
    double way = 0;
    for (double part = first_part; way < 1;) {
      VectorXd next = x;
      const double to = std::min(1.0, way + part);
      if (solve_at(from + to * (1 - from), next)) {
        x = next, way = to, part = std::min(2 * part, 0.5);
        continue;
      }
      part *= 0.5;
      if (part < least_part || motion_.last.end == ReturnMap::End::interrupted) return;
    }
    settle();
  }

  // At this fraction of the speeds to be held.
  bool solve_at(double share, VectorXd& x) {
    const double motions = static_cast<double>(free_.cols());
    std::optional<MeanSpeeds> mean;
    HeldSpeeds held{.machine = [this](const VectorXd& a) { return model_with(a); },
                    .record = [&](const Model&) { return &mean.emplace(held_); },
                    .miss = [&](const ReturnMap::Image& round) { return miss_of(round, *mean, share); }};
    if (by_link_)
      held.slope = [this](const ReturnMap::Image& round) -> MatrixXd {
        return -link_speed(round) / (round.time * scale_[0]) * round.slowing;
      };
    held.by_differences = !by_link_;
    held.enough = enough;
    held.magnitude = std::max(held.magnitude, map_->section().magnitude());
    held.most_cost = most_derivatives * (map_->derivative_cost() + motions);
    find_held_orbit(held, *map_, x, orbit_options(), motion_);
    x = motion_.newton.x;
    if (motion_.orbit.repeats()) return true;
    const bool reports_all =
        motion_.last.end != ReturnMap::End::returned && motion_.last.end != ReturnMap::End::interrupted;
    out_.why = motion_.orbit.words + (reports_all ? "" : on_the_way());
    return false;
  }
  std::string on_the_way() const { return motion_.broken.empty() ? "" : "; of what was tried, " + motion_.broken; }

  VectorXd miss_of(const ReturnMap::Image& round, const MeanSpeeds& mean, double share) const {
    VectorXd miss(free_.cols());
    for (Index f = 0; f < miss.size(); ++f) {
      const double speed = by_link_ ? link_speed(round) : mean.mean(at(f), round.time);
      miss[f] = (speed - share * speed_[at(f)]) / scale_[at(f)];
    }
    return miss;
  }
  // Mean speed, for a period that is one of the link's angle.
  double link_speed(const ReturnMap::Image& round) const {
    return std::copysign(map_->periodicity().angle / round.time, drive_.at.speed);
  }

  // --- what was found ---

  void settle() {
    try {
      out_.samples = sample_cycle(motion_.orbit, samples);
    } catch (const std::invalid_argument& refused) {
      out_.why = refused.what();
      return;
    }
    out_.found = true;
    out_.why.clear();
    VectorXd scaled = motion_.by;
    for (Index f = 0; f < scaled.size(); ++f) scaled[f] *= unit_[at(f)];
    const TrackedAngle& link = m_.angles[at(m_.reduction_angle)];
    out_.acceleration = link.gain * (base_.coordinates().motion * (free_ * scaled))[link.shaft];
    judge_stability(motion_.orbit.point.z.size(), scaled.size());
  }

  // Multipliers of the period at constant torques, without those of the held speeds: the ones by which torques change
  // mean speeds most, |left · P_a| |s_z · right|. The behaviour of a speed that is not held is irrelevant here.
  void judge_stability(Index n, Index k) {
    if (n == 0) return;
    const MatrixXd& derivative = motion_.derivative;
    out_.uncertain = motion_.last.grazed || !derivative.topLeftCorner(n, n).allFinite();
    if (out_.uncertain) return;
    const auto [values, right] = eigenpairs(derivative.topLeftCorner(n, n) + MatrixXd::Identity(n, n));
    const Eigen::MatrixXcd left = ComplexLu(right).inverse();
    out_.uncertain = !left.allFinite();
    if (out_.uncertain) return;
    const VectorXd share = (left * derivative.topRightCorner(n, k))
                               .rowwise()
                               .norm()
                               .cwiseProduct((derivative.bottomLeftCorner(k, n) * right).colwise().norm().transpose());
    std::vector<Index> order(at(n));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return share[a] > share[b]; });
    for (Index i = std::min(k, n); i < n; ++i) out_.multipliers.push_back(values[order[at(i)]]);
    std::stable_sort(out_.multipliers.begin(), out_.multipliers.end(),
                     [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
  }

  const HeldMachine& machine_;
  const LinearDrive& drive_;
  const Excitations& x_;
  const HeldCycleOptions& options_;
  BaseMotion base_;
  const Model& m_;
  MatrixXd free_;
  // Per motion: unit of a [rad/s²]; speed to be held, its scale [rad/s]; the shaft that has it, as a state.
  std::vector<double> unit_, speed_, scale_;
  std::vector<std::size_t> held_;
  bool by_link_ = false;  // all turns as one, and a cycle is a turn of the link: its time gives the mean speed
  std::unique_ptr<ReturnMap> map_;
  HeldMotion motion_;  // of the last search
  HeldCycle out_;
};

}  // namespace

HeldCycle find_held_cycle(const HeldMachine& machine, const LinearDrive& drive, const Excitations& excitations,
                          const HeldCycleOptions& options) {
  return CycleSearch(machine, drive, excitations, options).run();
}

}  // namespace kurbel
