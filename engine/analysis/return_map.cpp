// return_map.cpp — one round from section to section, and Newton on it.
#include "engine/analysis/return_map.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/analysis/sensitivities.h"
#include "engine/numerics/index.h"
#include "engine/numerics/period.h"

namespace kurbel {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int most_periods = 1000;          // of the first law within a common period
constexpr double same_ratio = 1e-9;         // by which a ratio of periods may miss a fraction
constexpr std::size_t most_unknowns = 400;  // the derivative is full
constexpr double overlap = 0.02;            // of a round, by which the first run goes on
constexpr double slowest = 20;              // a round may take this many times what it takes at the guessed speed

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(i); }

struct NamedPeriod {
  double period;
  std::string component;
};

// The smallest multiple of the first period that is a multiple of all.
double common_multiple(const std::vector<NamedPeriod>& periods, const std::string& unit) {
  const double first = periods.front().period;
  const auto meets = [&](int k, const NamedPeriod& p) {
    const double ratio = k * first / p.period;
    return std::round(ratio) >= 1 && std::abs(ratio - std::round(ratio)) <= same_ratio * ratio;
  };
  for (int k = 1; k <= most_periods; ++k)
    if (std::all_of(periods.begin(), periods.end(), [&](const NamedPeriod& p) { return meets(k, p); }))
      return k * first;
  const NamedPeriod* odd = &periods.back();
  for (const NamedPeriod& p : periods) {
    bool ever = false;
    for (int k = 1; k <= most_periods && !ever; ++k) ever = meets(k, p);
    if (!ever) odd = &p;
  }
  throw std::invalid_argument(fmt::format(
      "there is no steady cycle: what repeats after {:.9g} {} (\"{}\") and after {:.9g} {} (\"{}\") never meets within "
      "{} periods. Make the ratio of the two a fraction, or simulate a long time with kurbel run",
      first, unit, periods.front().component, odd->period, unit, odd->component, most_periods));
}

// Where events happen: angles of the link at the ends of steps.
class AngleLog final : public Observer {
 public:
  void begin(double t, std::span<const double> y, Equations& equations) override { see(t, y, equations); }
  void step(StepView& view) override { see(view.t(), view.y(), view.equations()); }
  double angle_at(double t) const {
    const auto after = std::lower_bound(time_.begin(), time_.end(), t - 1e-13 * std::max(1.0, t));
    return after == time_.end() ? angle_.back() : angle_[static_cast<std::size_t>(after - time_.begin())];
  }

 private:
  void see(double t, std::span<const double> y, Equations& e) {
    time_.push_back(t);
    angle_.push_back(e.angle_with_turns(at(e.model().reduction_angle), y));
  }
  std::vector<double> time_, angle_;
};

// Middle of the widest gap between angles on a circle.
double quiet_angle(std::vector<double> angles, double cycle, double without_events) {
  if (angles.empty()) return without_events;
  for (double& a : angles) a = place_within(a, cycle);
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + cycle);
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
    if (angles[i + 1] - angles[i] > angles[widest + 1] - angles[widest] + 1e-9) widest = i;
  return place_within(0.5 * (angles[widest] + angles[widest + 1]), cycle);
}

// ∫ω dt of a prescribed speed from 0 on: Simpson within each of its pieces.
double angle_turned(const PrescribedSpeed& given, double until) {
  double sum = 0;
  for (double t = 0; t < until;) {
    const double end = std::min(until, given.next_edge(t));
    const int piece = given.piece(t), panels = 100 + 2 * static_cast<int>(40 * std::abs(given.frequency) * (end - t));
    const double h = (end - t) / (2 * panels);
    for (int i = 0; i <= 2 * panels; ++i)
      sum += h / 3 * (i == 0 || i == 2 * panels ? 1 : i % 2 ? 4 : 2) * given.value(t + i * h, piece);
    t = end;
  }
  return sum;
}

int prescribed_node(const Model& m) {
  const Network& net = m.network;
  int found = -1;
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    if (net.nodes[n].prescribed < 0) continue;
    if (m.node_ratio[n] == 0 && net.prescribed[at(net.nodes[n].prescribed)].is_nothing()) continue;  // the frame
    if (found >= 0)
      throw std::invalid_argument(
          fmt::format("\"{}\" and \"{}\" both prescribe a speed; a steady cycle is sought for one prescribed speed at "
                      "most: simulate with kurbel run",
                      net.nodes[at(found)].component, net.nodes[n].component));
    found = static_cast<int>(n);
  }
  return found;
}

}  // namespace

Periodicity periodicity_of(const Model& m) {
  Periodicity result;
  std::vector<NamedPeriod> angles, times;
  for (const Network::ShaftElement& e : m.network.elements) {
    if (e.element->is.uses_angle && e.element->angle_period > 0)
      angles.push_back({e.element->angle_period / m.scale_ratio[at(e.node)], e.component});
    if (e.element->time_period > 0) times.push_back({e.element->time_period, e.component});
    result.settled_from = std::max(result.settled_from, e.element->settled_from);
  }
  result.angle_matters = !angles.empty();
  result.angle = angles.empty() ? two_pi : common_multiple(angles, "rad");
  if (const int node = prescribed_node(m); node >= 0) {
    const PrescribedSpeed& given = m.network.prescribed[at(m.network.nodes[at(node)].prescribed)];
    const std::string& name = m.network.nodes[at(node)].component;
    const double link_speed = std::abs(given.speed.back() / m.node_ratio[at(node)]);
    if (!(link_speed > 0))
      throw std::invalid_argument(
          fmt::format("\"{}\" prescribes a mean speed of 0: nothing turns, so there is no cycle", name));
    if (given.amplitude != 0) times.push_back({1 / std::abs(given.frequency), name});
    if (result.angle_matters || times.empty()) times.push_back({result.angle / link_speed, name});
    if (!given.time.empty()) result.settled_from = std::max(result.settled_from, given.time.back());
  }
  result.by_time = !times.empty();
  if (result.by_time) result.time = common_multiple(times, "s");
  return result;
}

ReturnMap::ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options)
    : shared_(std::move(model)), options_(std::move(options)), equations_(shared_, false) {
  const Model& m = *shared_;
  if (!m.own_states.empty() || m.has_contacts() || !m.scene.sequence.steps.empty())
    throw std::invalid_argument(fmt::format(
        "a steady cycle is sought for twists and speeds alone; {}. Simulate with kurbel run until it is steady",
        !m.own_states.empty() ? fmt::format("\"{}\" has a state of its own ({})", m.own_states.front().component,
                                            m.own_states.front().state.name)
        : m.has_contacts()    ? "this machine has shafts that are tied at run time"
                              : "an operating sequence does not repeat with the cycle"));
  periodicity_ = periodicity_of(m);
  start_time_ = periodicity_.settled_from;
  const int node = prescribed_node(m);
  fixed_shaft_ = node >= 0 ? m.shaft_of_node[at(node)] : -1;
  angle_unknown_ = periodicity_.by_time && periodicity_.angle_matters && fixed_shaft_ < 0;
  if (angle_unknown_) scale_.push_back(1);
  for (const ElasticJoint& e : m.elastic) scale_.push_back(e.twist_scale);
  for (std::size_t s = 0; s < m.free_shafts; ++s) scale_.push_back(m.shafts[s].speed_scale);
  size_ = scale_.size();
  if (size_ == 0)
    throw std::invalid_argument(
        "time drives this machine: a prescribed speed leaves nothing to find. Switch elasticity on, or "
        "replace the prescribed speed by a motor");
  if (size_ > most_unknowns)
    throw std::invalid_argument(
        fmt::format("a steady cycle is sought for up to {} twists and speeds; this model has {}. Switch elasticity off "
                    "where it matters least (--effects), or simulate with kurbel run",
                    most_unknowns, size_));
  if (options_.cycles < 1) throw std::invalid_argument(fmt::format("{} cycles; must be ≥ 1", options_.cycles));
  for (std::size_t k = 0; k < m.elastic.size(); ++k) angle_by_twist_.push_back(equations_.shaft_angles_by_twist(k));
  const StartSettings& start = m.scene.run.start;
  const int on = start.on.empty() ? m.reduction_node : m.network.ports.at(start.on).in;
  section_ = start.angle / m.node_ratio[at(on)];
  if (fixed_shaft_ >= 0)
    section_ += angle_turned(m.network.prescribed[at(m.network.nodes[at(node)].prescribed)], start_time_) /
                m.node_ratio[at(node)];
  time_limit_ = slowest * periodicity_.angle * options_.cycles / m.speed_scale;
}

// The link's angle at the begin of a round: given, unknown, or by the twists from the shaft whose motion is given.
double ReturnMap::link_angle_of(const Eigen::VectorXd& z) const {
  if (angle_unknown_) return z[0];
  double angle = section_;
  if (fixed_shaft_ < 0) return angle;
  const double ratio = shared_->node_ratio[at(shared_->shafts[at(fixed_shaft_)].reference)];
  for (std::size_t k = 0; k < angle_by_twist_.size(); ++k)
    angle -= angle_by_twist_[k][at(fixed_shaft_)] * z[row(k)] * scale_[k] / ratio;
  return angle;
}

std::vector<double> ReturnMap::place(Equations& equations, const Eigen::VectorXd& z) const {
  std::vector<double> twists, speeds;
  std::size_t i = angle_unknown_ ? 1 : 0;
  for (std::size_t k = 0; k < shared_->elastic.size(); ++k, ++i) twists.push_back(z[row(i)] * scale_[i]);
  for (std::size_t s = 0; s < shared_->free_shafts; ++s, ++i) speeds.push_back(z[row(i)] * scale_[i]);
  return equations.state_of(start_time_, link_angle_of(z), twists, speeds);
}

Eigen::VectorXd ReturnMap::unknowns_of(std::span<const double> y, double link_angle) const {
  Eigen::VectorXd z(row(size_));
  std::size_t i = 0;
  if (angle_unknown_) z[row(i++)] = link_angle;
  for (std::size_t k = 0; k < shared_->elastic.size(); ++k, ++i)
    z[row(i)] = y[equations_.twist_index(static_cast<int>(k))] / scale_[i];
  for (std::size_t s = 0; s < shared_->free_shafts; ++s, ++i)
    z[row(i)] = y[equations_.speed_index(static_cast<int>(s))] / scale_[i];
  return z;
}

// ∂y₀/∂z: twists and speeds are states themselves; the angles of other shafts turn with the twists.
Eigen::MatrixXd ReturnMap::first_directions() const {
  const Model& m = *shared_;
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(row(equations_.size()), row(size_));
  std::size_t j = 0;
  if (angle_unknown_) {
    for (std::size_t i = 0; i < m.angles.size(); ++i) first(row(i), 0) = m.node_ratio[at(m.angles[i].node)];
    ++j;
  }
  for (std::size_t k = 0; k < m.elastic.size(); ++k, ++j) {
    double link = 0;
    if (fixed_shaft_ >= 0)
      link = -angle_by_twist_[k][at(fixed_shaft_)] / m.node_ratio[at(m.shafts[at(fixed_shaft_)].reference)];
    for (std::size_t i = 0; i < m.angles.size(); ++i)
      first(row(i), row(j)) =
          (m.angles[i].gain * angle_by_twist_[k][at(m.angles[i].shaft)] + m.node_ratio[at(m.angles[i].node)] * link) *
          scale_[j];
    first(row(equations_.twist_index(static_cast<int>(k))), row(j)) = scale_[j];
  }
  for (std::size_t s = 0; s < m.free_shafts; ++s, ++j)
    first(row(equations_.speed_index(static_cast<int>(s))), row(j)) = scale_[j];
  return first;
}

// On a section of the link's angle the round's end moves: dT = −δφ/φ̇.
void ReturnMap::read_derivative(const Eigen::MatrixXd& directions, std::span<const double> rate, Image& image) const {
  const Model& m = *shared_;
  const Eigen::Index link = row(at(m.reduction_angle));
  Eigen::MatrixXd end = directions;
  image.slowing = Eigen::RowVectorXd::Zero(row(size_));
  if (!periodicity_.by_time) {
    image.slowing = -directions.row(link) / rate[at(m.reduction_angle)];
    for (Eigen::Index i = 0; i < end.rows(); ++i) end.row(i) += rate[static_cast<std::size_t>(i)] * image.slowing;
  }
  image.derivative.resize(row(size_), row(size_));
  std::size_t i = 0;
  if (angle_unknown_) image.derivative.row(row(i++)) = end.row(link);
  for (std::size_t k = 0; k < m.elastic.size(); ++k, ++i)
    image.derivative.row(row(i)) = end.row(row(equations_.twist_index(static_cast<int>(k)))) / scale_[i];
  for (std::size_t s = 0; s < m.free_shafts; ++s, ++i)
    image.derivative.row(row(i)) = end.row(row(equations_.speed_index(static_cast<int>(s)))) / scale_[i];
}

std::function<double(double, std::span<const double>)> ReturnMap::round_end(Equations& equations,
                                                                            std::span<const double> y,
                                                                            double rounds) const {
  const std::size_t link = at(shared_->reduction_angle);
  if (periodicity_.by_time) return {};
  const double target = equations.angle_with_turns(link, y) + sense_ * periodicity_.angle * options_.cycles * rounds;
  return [&equations, link, target, sense = sense_](double, std::span<const double> state) {
    return std::min(1.0, sense * (target - equations.angle_with_turns(link, state)));
  };
}

// What became of a round.
ReturnMap::Image ReturnMap::judge(const RunOutcome& outcome, double link_begin, Equations& equations) const {
  const Model& m = *shared_;
  const std::size_t link = at(m.reduction_angle);
  Image image;
  image.time = outcome.t - start_time_;
  if (outcome.state.empty()) {
    image.why = outcome.diagnosis;
    return image;
  }
  const std::span<const double> y(outcome.state.data(), equations.size());
  image.link_angle = equations.angle_with_turns(link, y);
  image.z = unknowns_of(y, image.link_angle - windings_);
  const std::string name = m.node_label(m.reduction_node);
  const double phi = place_within(image.link_angle, periodicity_.angle);
  const double speed = m.angles[link].gain * equations.snapshot(outcome.t, y).now.speed[m.angles[link].shaft] * sense_;
  if (!outcome.diagnosis.empty()) {
    image.end = options_.interrupted && options_.interrupted->load() ? End::interrupted : End::failed;
    image.why = outcome.diagnosis;
  } else if (outcome.stopped || periodicity_.by_time) {
    image.end = End::returned;
  } else if (std::abs(speed) < 1e-6 * m.speed_scale) {
    image.end = End::stands;
    image.why = fmt::format("\"{}\" comes to rest at {:.2f}° of its cycle and does not come round", name,
                            phi * 180 / std::numbers::pi);
  } else if (sense_ * (image.link_angle - link_begin) < 0 || speed < 0) {
    image.end = End::turns_back;
    image.why = fmt::format("\"{}\" is stopped within the cycle and driven backwards", name);
  } else {
    image.end = End::too_slow;
    image.why = fmt::format("\"{}\" does not come round within {:.4g} s; it stands at {:.2f}° of its cycle", name,
                            image.time, phi * 180 / std::numbers::pi);
  }
  return image;
}

ReturnMap::Image ReturnMap::image(const Eigen::VectorXd& z, bool with_derivative,
                                  const std::vector<Observer*>& observers) {
  const std::vector<double> y = place(equations_, z);
  const std::size_t link = at(shared_->reduction_angle);
  const double begin = equations_.angle_with_turns(link, y);
  Sensitivities sensitivities(equations_, size_);
  const double until = start_time_ + (periodicity_.by_time ? periodicity_.time * options_.cycles : time_limit_);
  RunOptions run{.tolerance = options_.tolerance,
                 .method = options_.method,
                 .until = until,
                 .budget = options_.budget,
                 .interrupted = options_.interrupted,
                 .progress = {}};
  run.stop = round_end(equations_, y);
  run.from = {start_time_, with_derivative ? sensitivities.start(y, first_directions()) : y};
  if (with_derivative) run.extension = &sensitivities;
  const RunOutcome outcome = integrate(equations_, run, observers);
  cost_ += options_.cycles * (with_derivative ? static_cast<double>(size_) + 1 : 1.0);
  Image image = judge(outcome, begin, equations_);
  if (!with_derivative || image.end != End::returned) return image;
  std::vector<double> rate(equations_.size());
  equations_.flow(outcome.t, std::span(outcome.state).first(equations_.size()), rate);
  read_derivative(sensitivities.matrix(outcome.state), rate, image);
  image.grazed = sensitivities.grazed();
  return image;
}

ReturnMap::Image ReturnMap::approach(double link_speed) {
  const Model& m = *shared_;
  const std::size_t link = at(m.reduction_angle);
  sense_ = link_speed < 0 ? -1 : 1;
  const double slowness = std::max(std::abs(link_speed), 0.02 * m.speed_scale);
  time_limit_ = slowest * periodicity_.angle * options_.cycles / slowness;
  StartSettings settings{};
  settings.equilibrium = true;
  settings.angle = section_;
  settings.speed = link_speed;
  std::vector<double> y = equations_.start(start_time_, settings);
  const double begin = equations_.angle_with_turns(link, y);
  AngleLog log;
  RunOptions run{.tolerance = std::max(options_.tolerance, 1e-9),
                 .method = options_.method,
                 .until = start_time_ + (periodicity_.by_time ? periodicity_.time * options_.cycles : time_limit_),
                 .budget = options_.budget,
                 .interrupted = options_.interrupted,
                 .progress = {}};
  run.from = {start_time_, y};
  run.stop = round_end(equations_, y, 1 + overlap);  // an event where it begins is seen at the end
  const RunOutcome first = integrate(equations_, run, {&log});
  cost_ += options_.cycles;
  windings_ = 0;
  if (periodicity_.by_time) {
    Image image = judge(first, begin, equations_);
    if (angle_unknown_) {
      windings_ = periodicity_.angle * std::round((image.link_angle - begin) / periodicity_.angle);
      image.z[0] -= windings_;
    }
    return image;
  }
  Image image = judge(first, begin, equations_);
  if (image.end != End::returned) return image;
  std::vector<double> angles;
  for (const Event& e : first.events) angles.push_back(log.angle_at(e.t));
  section_ = quiet_angle(angles, periodicity_.angle, section_);
  // On to the section.
  const double here = image.link_angle;
  double way = std::fmod(sense_ * (section_ - here), periodicity_.angle);
  if (way < 1e-6) way += periodicity_.angle;
  run.from = {first.t, first.state};
  run.until = first.t + time_limit_;
  run.stop = round_end(equations_, first.state, way / (periodicity_.angle * options_.cycles));
  const RunOutcome second = integrate(equations_, run, {});
  cost_ += way / periodicity_.angle;
  return judge(second, here, equations_);
}

void ReturnMap::follow(const ReturnMap& other) {
  section_ = other.section_;
  sense_ = other.sense_;
  time_limit_ = other.time_limit_;
  windings_ = other.windings_;
}

std::string ReturnMap::unknown_name(std::size_t i) const {
  if (angle_unknown_) {
    if (i == 0) return "angle of " + shared_->node_label(shared_->reduction_node);
    --i;
  }
  return equations_.state_name(equations_.model().angle_count() + i);
}

// ---------------------------------------------------------------------------------------------------------------------

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(derivative, false).eigenvalues();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](auto a, auto b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 ? difference > 0 : a.imag() > b.imag();
  });
  return sorted;
}

namespace {

constexpr int most_rounds = 60, most_derivatives = 12;
constexpr int most_run_on = 8;
constexpr double residual_floor = 30;  // times the residual asked for may be left where round-off stops the descent

class Newton {
 public:
  Newton(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough)
      : system_(system), x_(guess), enough_(enough) {}

  NewtonOutcome run() {
    if (evaluate(x_, true)) iterate();
    return std::move(out_);
  }

 private:
  enum class Progress { made, floor, ended };

  bool evaluate(const Eigen::VectorXd& x, bool with_derivative) {
    ++out_.rounds;
    if (with_derivative) ++out_.derivatives;
    Eigen::MatrixXd derivative;
    valid_ = system_.evaluate(x, residual_, with_derivative ? &derivative : nullptr);
    if (!valid_) return false;
    norm_ = residual_.cwiseAbs().maxCoeff();
    if (with_derivative) {
      at_ = x;
      solver_.compute(derivative);
    }
    return true;
  }

  void iterate() {
    while (norm_ > enough_ && out_.rounds < most_rounds && out_.derivatives < most_derivatives) {
      const Progress progress = advance(limited(-solver_.solve(residual_)));
      if (progress == Progress::ended) return;
      if (progress == Progress::floor) break;
    }
    out_.residual = norm_;
    if (norm_ <= residual_floor * enough_) return finish();
    out_.why = fmt::format("Newton's iteration does not settle (residual {:.1e} of the rated values after {} rounds)",
                           norm_, out_.rounds);
  }

  // Far steps lead to other machines: nothing changes by more than half of the largest there is.
  Eigen::VectorXd limited(Eigen::VectorXd step) const {
    const double longest = 0.5 * std::max(0.2, x_.cwiseAbs().maxCoeff()), length = step.cwiseAbs().maxCoeff();
    if (!(length < HUGE_VAL)) return residual_;
    if (length > longest) step *= longest / length;
    return step;
  }

  // One step, halved while it does not pay; with a kept derivative only the whole step is tried. Steps are judged by
  // the correction that would follow with the same derivative, not by the residual, which knows no common scale of soft
  // and stiff directions (natural monotonicity: Deuflhard, Newton Methods for Nonlinear Problems, 2011).
  Progress advance(const Eigen::VectorXd& step) {
    const Eigen::VectorXd from = x_, residual_from = residual_;
    const double norm_from = norm_, length = step.cwiseAbs().maxCoeff();
    const bool fresh = at_ == x_;
    for (double part = 1; part > 0.02; part *= 0.5) {
      const Eigen::VectorXd trial = from + part * step;
      if (evaluate(trial, false)) {
        const double contraction = solver_.solve(residual_).cwiseAbs().maxCoeff() / length;
        if (contraction < 1 - 0.25 * part) {
          x_ = trial;
          if (norm_ <= enough_ || keep_derivative(contraction)) return Progress::made;
          return evaluate(x_, true) ? Progress::made : Progress::ended;
        }
      }
      if (system_.stopped && system_.stopped()) return Progress::ended;
      if (out_.rounds >= most_rounds) break;
      if (!fresh || norm_from <= residual_floor * enough_) break;
    }
    x_ = from;
    residual_ = residual_from;
    norm_ = norm_from;
    if (norm_ <= residual_floor * enough_) return Progress::floor;  // round-off: nothing shrinks any more
    if (fresh) {                                                    // Newton finds no way down: let the machine run on
      if (!system_.run_on || ++run_on_ > most_run_on) return Progress::floor;
      x_ = from + residual_from;
    }
    return evaluate(x_, true) ? Progress::made : Progress::ended;
  }

  // Kept while the rounds that are left with it cost less than a new one.
  bool keep_derivative(double contraction) const {
    if (contraction >= 0.9) return false;
    return std::log(std::max(norm_ / enough_, 1.0)) / -std::log(contraction) <= system_.derivative_cost + 1;
  }

  // The derivative at the solution itself, for the multipliers.
  void finish() {
    if (at_ != x_) {
      x_ += limited(-solver_.solve(residual_));
      if (!evaluate(x_, true)) return;
    }
    out_.found = true;
    out_.x = x_;
    out_.residual = norm_;
  }

  const NewtonSystem& system_;
  Eigen::VectorXd x_, at_, residual_;
  Eigen::PartialPivLU<Eigen::MatrixXd> solver_;
  NewtonOutcome out_;
  double enough_, norm_ = 0;
  int run_on_ = 0;
  bool valid_ = false;
};

}  // namespace

NewtonOutcome solve(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough) {
  return Newton(system, guess, enough).run();
}

SteadyPoint find_steady(ReturnMap& map, const Eigen::VectorXd& guess, double enough) {
  SteadyPoint out;
  ReturnMap::Image image;
  const double cost_before = map.cost();
  NewtonSystem system;
  system.evaluate = [&](const Eigen::VectorXd& z, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
    ReturnMap::Image here = map.image(z, derivative != nullptr);
    const bool returned = here.end == ReturnMap::End::returned;
    if (returned) {
      residual = here.z - z;
      if (derivative) *derivative = here.derivative - Eigen::MatrixXd::Identity(z.size(), z.size());
    }
    image = std::move(here);
    return returned;
  };
  system.stopped = [&] { return image.end == ReturnMap::End::interrupted; };
  system.derivative_cost = static_cast<double>(map.size()) + 1;
  system.run_on = true;
  const NewtonOutcome newton = solve(system, guess, enough);
  out.rounds = newton.rounds;
  out.derivatives = newton.derivatives;
  out.residual = newton.residual;
  out.cost = map.cost() - cost_before;
  out.end = image.end;
  if (newton.found) {
    out.take(newton.x, image);
  } else if (image.end != ReturnMap::End::returned) {
    out.why = image.why;
  } else {
    out.end = ReturnMap::End::failed;
    out.why =
        newton.why +
        ": there may be no steady cycle of this period near the guess. Try another start speed, --periods 2, or a "
        "long kurbel run";
  }
  return out;
}

void SteadyPoint::take(const Eigen::VectorXd& at, const ReturnMap::Image& image) {
  found = true;
  z = at;
  derivative = image.derivative;
  multipliers = multipliers_of(derivative);
  time = image.time;
  grazed = image.grazed;
}

}  // namespace kurbel
