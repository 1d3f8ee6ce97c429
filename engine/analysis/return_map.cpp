// return_map.cpp — one round from section to section, and its derivative.
#include "engine/analysis/return_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/analysis/sensitivities.h"
#include "engine/numerics/index.h"
#include "engine/numerics/period.h"

namespace kurbel {
namespace {

constexpr std::size_t most_unknowns = 400;  // the derivative is full
constexpr double overlap = 0.02;            // of a round, by which the first run goes on
constexpr double slowest = 20;              // a round may take this many times what it takes at the guessed speed

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(i); }

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

}  // namespace

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

}  // namespace kurbel
