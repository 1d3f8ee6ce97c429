// base_motion.cpp — states along the uniform motion, and the balance of its means.
#include "engine/linear/base_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "engine/model/cycle_of.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// From one speed to another the laws of speed go on to the pieces that hold there: what has not changed its sign keeps
// its piece, such as a coupling whose twist is the same; so does what stands at the end of its piece, as a belt that
// slips and whose states balance where it would grip.
void follow_pieces(Equations& equations, double t, const std::vector<double>& from, const std::vector<double>& to) {
  constexpr int most_pieces = 1000;
  constexpr double beyond = 1e-6;  // of a guard: balances are not found more closely
  const auto whole = [&](std::vector<double> y) { return y.resize(equations.size(), 0.0), y; };
  const std::vector<double> there = whole(from), here = whole(to);
  std::vector<int>& piece = equations.changing_modes().piece;
  for (const auto& pool : equations.model().pools) {
    const auto count = static_cast<std::size_t>(pool->guard_count());
    if (count == 0 || pool->guards_are_of_angle()) continue;
    std::vector<double> before(count), now(count);
    pool->guards(equations.instant(t, there), before.data());
    for (int i = 0; i < most_pieces; ++i) {
      pool->guards(equations.instant(t, here), now.data());
      std::size_t passed = 0;
      while (passed < count && !(before[passed] > 0 && now[passed] < -beyond)) ++passed;
      if (passed == count) break;
      pool->fire(equations.instant(t, here), static_cast<int>(passed), piece.data());
    }
  }
}

constexpr double geared_within = 1e-6;        // of the link's speed: an angle that turns with the link
constexpr double golden = 0.618033988749895;  // spreads times over the angles

// The smallest common period of all torques and speeds over time [s]; 0: there are none, or they never meet.
double common_time(const Model& m) {
  std::vector<double> periods;
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->time_period > 0) periods.push_back(e.element->time_period);
  for (const PrescribedSpeed& p : m.network.prescribed)
    if (p.period() > 0) periods.push_back(p.period());
  for (const PrescribedSpeed& p : m.network.prescribed)
    if (p.amplitude != 0 && p.frequency > 0) periods.push_back(1 / p.frequency);
  return periods.empty() ? 0 : common_period(periods).value;
}

}  // namespace

BaseMotion::BaseMotion(std::shared_ptr<const Model> model, LinearisationPoint point)
    : shared_(std::move(model)), m_(*shared_), equations_(shared_, false), point_(std::move(point)) {
  for (const Network::ShaftElement& e : m_.network.elements)
    if (std::isinf(e.element->cycle) && !point_.angle)
      throw std::invalid_argument(fmt::format(
          "the crank of \"{}\" rocks and never turns fully, so that there is no mean over its angle to linearise "
          "about; hold it at an angle, e.g. --angle \"0 deg\", or follow its motion with kurbel run",
          e.component));
  turn_of_joint_.assign(m_.elastic.size(), -1);
  for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
    const Network::Joint& joint = m_.network.joints[kurbel::at(m_.elastic[j].joint)];
    if (!joint.element->is.turns_unevenly) continue;
    const std::size_t a = kurbel::at(joint.a);
    for (std::size_t i = 0; i < m_.angles.size(); ++i)
      if (m_.angles[i].shaft == m_.shaft_of_node[a] && m_.angles[i].gain == m_.gain_of_node[a])
        turn_of_joint_[j] = static_cast<int>(i);
  }
  choose_positions();
  take_modes();
  find_inertia();
  find_coordinates();
  acceleration_ = Eigen::VectorXd::Zero(coordinates_.size());
  const bool at_its_means = point_.orbit && point_.speed == point_.orbit->speed;
  if (at_its_means) return;
  balance();
}

void BaseMotion::choose_positions() {
  const auto& elements = m_.network.elements;
  turns_ = std::any_of(elements.begin(), elements.end(),
                       [](const Network::ShaftElement& e) { return e.element->is.uses_angle; }) ||
           std::any_of(m_.elastic.begin(), m_.elastic.end(), [&](const ElasticJoint& e) {
             return m_.network.joints[kurbel::at(e.joint)].element->is.uses_angle;
           });
  cycle_ = cycle_of(m_).angle;
  time_period_ = common_time(m_);
  if (!turns_ && time_period_ == 0) {
    positions_ = {{point_.angle.value_or(0), 0}};
    return;
  }
  if (point_.angle) {
    positions_ = {{*point_.angle, 0}};
    return;
  }
  const int n = point_.positions * (turns_ ? static_cast<int>(std::lround(cycle_ / turn)) : 1);
  int stride = turns_ ? static_cast<int>(golden * n) : 1;  // every time once, in another order than the angles
  while (std::gcd(stride, n) != 1) ++stride;
  for (int i = 0; i < n; ++i) {
    const double share = (i + 0.5) / n;  // off whole degrees, where edges of loads lie
    const auto turn = static_cast<int>(static_cast<long>(i) * stride % n);
    positions_.push_back({turns_ ? share * cycle_ : 0, (turn + 0.5) / n * time_period_});
  }
}

// The steady motion's; else everything turns as geared, clutches locked, and internal states as at the start.
void BaseMotion::take_modes() {
  const double speed = point_.speed;
  if (point_.orbit) {
    begin_ = point_.orbit->state.y;
    equations_.bind(point_.orbit->state.modes);
    begin_time_ = point_.orbit->state.t;
    const double scale = point_.orbit->speed != 0 ? speed / point_.orbit->speed : 1;
    for (std::size_t i = m_.angle_count(); i < m_.state_count(); ++i) begin_[i] = point_.orbit->mean[i];
    const std::vector<double> there = begin_;
    for (std::size_t s = 0; s < m_.free_shafts; ++s) begin_[equations_.speed_index(static_cast<int>(s))] *= scale;
    if (scale != 1) follow_pieces(equations_, begin_time_, there, begin_);
  } else {
    begin_ = equations_.modes_from_scratch(0, positions_.front().angle, speed);
    for (std::size_t i = 0; i < m_.angles.size(); ++i)
      begin_[i] = m_.node_ratio[kurbel::at(m_.angles[i].node)] * positions_.front().angle;
  }
  begin_.resize(equations_.size(), 0.0);
  begin_angle_ = begin_[kurbel::at(m_.reduction_angle)];
}

void BaseMotion::find_inertia() {
  shaft_inertia_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m_.shafts.size()));
  for (std::size_t s = 0; s < m_.shafts.size(); ++s)
    shaft_inertia_[static_cast<Eigen::Index>(s)] = m_.shafts[s].mean_inertia;
  if (point_.angle) {
    at(positions_.front());
    equations_.evaluate(begin_time_, y_);
    const std::span<const double> inertia = equations_.effective_inertia();
    for (std::size_t s = 0; s < m_.free_shafts; ++s) shaft_inertia_[static_cast<Eigen::Index>(s)] = inertia[s];
  }
}

void BaseMotion::find_coordinates() {
  coordinates_ = coordinates_of(m_, equations_.ties(), shaft_inertia_);
  if (m_.free_shafts == 0)
    throw std::invalid_argument(
        "every speed is prescribed, so nothing can vibrate; switch the elasticity of a coupling or shaft on");
  if (coordinates_.size() == 0)
    throw std::invalid_argument(
        "every shaft is held by friction at rest, so nothing can vibrate; give a speed, e.g. --speed \"10 rpm\"");
  std::vector<double> speed(m_.shafts.size(), 0.0);
  for (std::size_t s = 0; s < m_.free_shafts; ++s) speed[s] = begin_[equations_.speed_index(static_cast<int>(s))];
  rates_ = coordinates_.rates(speed, shaft_inertia_);
  const Eigen::VectorXd omega = coordinates_.motion * rates_;
  for (std::size_t s = 0; s < m_.free_shafts; ++s)
    begin_[equations_.speed_index(static_cast<int>(s))] = omega[static_cast<Eigen::Index>(s)];
  inertia_ = Eigen::VectorXd::Zero(coordinates_.size());
  for (Eigen::Index k = 0; k < coordinates_.size(); ++k)
    for (SparseMatrix::InnerIterator it(coordinates_.motion, k); it; ++it)
      inertia_[k] += shaft_inertia_[it.row()] * it.value() * it.value();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < m_.elastic.size(); ++j) {
    const ElasticJoint& e = m_.elastic[j];
    entries.emplace_back(static_cast<int>(j), e.shaft_a, e.gain_a);
    entries.emplace_back(static_cast<int>(j), e.shaft_b, -e.gain_b);
  }
  SparseMatrix ends(static_cast<Eigen::Index>(m_.elastic.size()), static_cast<Eigen::Index>(m_.shafts.size()));
  ends.setFromTriplets(entries.begin(), entries.end());
  twists_ = (ends * coordinates_.motion).pruned(1.0, 1e-14);
}

bool BaseMotion::pass_pieces(const std::vector<double>& before) {
  const std::vector<int> pieces = equations_.modes().piece;
  follow_pieces(equations_, begin_time_, before, begin_);
  return equations_.modes().piece != pieces;
}

bool BaseMotion::has_spring(std::size_t joint) const {
  return m_.network.joints[kurbel::at(m_.elastic[joint].joint)].element->is.has_spring();
}

bool BaseMotion::joints_change() const {
  return std::any_of(m_.elastic.begin(), m_.elastic.end(), [&](const ElasticJoint& e) {
    return m_.network.joints[kurbel::at(e.joint)].element->is.uses_angle;
  });
}

// Of a tracked angle over the link's: as geared, or as its shaft really turns; 0 where it slips along, then it stays as
// it is.
double BaseMotion::angle_rate(std::size_t tracked) const {
  const TrackedAngle& angle = m_.angles[tracked];
  const double geared = m_.node_ratio[kurbel::at(angle.node)];
  if (!point_.orbit || point_.orbit->speed == 0 || kurbel::at(angle.shaft) >= m_.free_shafts) return geared;
  const double mean = angle.gain * point_.orbit->mean[equations_.speed_index(angle.shaft)] / point_.orbit->speed;
  return std::abs(mean - geared) <= geared_within * std::max(1.0, std::abs(geared)) ? geared : 0;
}

std::span<const double> BaseMotion::at(const Position& position) {
  Deadline::check();  // of a cycle of many turns there are hundreds of thousands
  y_ = begin_;
  const double way = position.angle - begin_angle_;
  for (std::size_t i = 0; i < m_.angles.size(); ++i) y_[i] += angle_rate(i) * way;
  equations_.wrap(y_);
  for (std::size_t j = 0; j < m_.elastic.size(); ++j)
    if (turn_of_joint_[j] >= 0)
      y_[equations_.twist_index(static_cast<int>(j))] +=
          m_.network.joints[kurbel::at(m_.elastic[j].joint)].element->rest_twist(y_[kurbel::at(turn_of_joint_[j])]);
  Modes& modes = equations_.changing_modes();
  if (time_period_ > 0) {
    const double t = time(position);
    std::vector<char> active = modes.active;  // what is on stays on
    for (const auto& pool : m_.pools) pool->set_timed_modes(t, modes.piece.data(), active.data());
    for (std::size_t p = 0; p < modes.prescribed_piece.size(); ++p)
      modes.prescribed_piece[p] = m_.network.prescribed[p].piece(t);
  }
  if (!point_.orbit) {
    equations_.modes_at(time(position), y_);
    return y_;
  }
  // Load edges by the angle; other laws keep the pieces that they have in the steady motion.
  for (const auto& pool : m_.pools)
    if (pool->guards_are_of_angle()) pool->first_modes(equations_.instant(time(position), y_), modes.piece.data());
  return y_;
}

BaseMotion::Residual BaseMotion::residual(const Position& position) {
  at(position);
  ydot_.resize(y_.size());
  equations_.flow(time(position), y_, ydot_);
  const std::span<const double> inertia = equations_.effective_inertia();
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(shaft_inertia_.size());
  for (std::size_t s = 0; s < m_.free_shafts; ++s)
    torque[static_cast<Eigen::Index>(s)] = inertia[s] * ydot_[equations_.speed_index(static_cast<int>(s))];
  const Eigen::Map<const Eigen::VectorXd> own(ydot_.data() + equations_.internal_begin(),
                                              static_cast<Eigen::Index>(m_.internal_states.size()));
  return {coordinates_.motion.transpose() * torque - inertia_.cwiseProduct(acceleration_), own, {}, {}};
}

BaseMotion::Residual BaseMotion::residual_with_joints(const Position& position) {
  Residual r = residual(position);
  const Snapshot& s = equations_.snapshot(time(position), y_);
  const auto joints = static_cast<Eigen::Index>(m_.elastic.size());
  r.joint_torque = Eigen::Map<const Eigen::VectorXd>(s.sums.connection_torque, joints);
  r.twist_rate = Eigen::Map<const Eigen::VectorXd>(s.sums.twist_rate, joints);
  return r;
}

double BaseMotion::rest_twist(std::size_t joint, const Position& position) {
  if (turn_of_joint_[joint] < 0) return 0;
  return m_.network.joints[kurbel::at(m_.elastic[joint].joint)].element->rest_twist(
      at(position)[kurbel::at(turn_of_joint_[joint])]);
}

}  // namespace kurbel
