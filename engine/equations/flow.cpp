// flow.cpp — right-hand side, Jacobian and outputs of a compiled model, as a flat list of stages.
#include "engine/equations/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/numerics/fp_traps.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// A universal joint's θ = φ_a − φ_b oscillates by degrees whatever its spring carries: no step can hold it more
// exactly than it is rounded.
double twist_scale(const Model& m, const ElasticJoint& elastic, double tolerance) {
  const Network::Joint& joint = m.network.joints[at(elastic.joint)];
  if (!joint.element || !joint.element->is.uses_angle) return elastic.twist_scale;
  constexpr int positions = 16;
  double swing = 0;
  for (int k = 0; k < positions; ++k)
    swing = std::max(swing, std::abs(joint.element->rest_twist(2 * std::numbers::pi * k / positions)));
  return std::max(elastic.twist_scale, 16 * std::numeric_limits<double>::epsilon() * swing / tolerance);
}

// What it transmits follows from the motion of all that is behind it, not from its own twist.
constexpr auto is_rigid = [](const TorqueJoint& joint) { return joint.elastic < 0; };

}  // namespace

Flow::Flow(std::shared_ptr<const Model> model, bool audit)
    : model_(std::move(model)),
      ties_(*model_, modes_),
      reactions_(*model_, modes_),
      joint_torques_(*model_),
      twists_begin_(model_->angle_count()),
      speeds_begin_(twists_begin_ + model_->twist_count()),
      internal_begin_(speeds_begin_ + model_->free_shafts),
      states_(model_->state_count()) {
  const Model& m = *model_;
  const std::size_t shafts = m.shafts.size(), elements = m.network.elements.size();
  if (audit) quadratures_ = m.accounts.size() + 2 * (m.torque_joints.size() + m.motors.size());
  plain_ = !ties_.any() && !reactions_.any();
  for (std::size_t s = 0; s < shafts; ++s) {
    if (m.shafts[s].directional) directional_.push_back(static_cast<int>(s));
    if (m.shafts[s].variable) variable_.push_back(static_cast<int>(s));
    constant_inertia_.push_back(m.shafts[s].inertia);
    inverse_inertia_.push_back(m.shafts[s].inertia > 0 ? 1 / m.shafts[s].inertia : 0);
  }
  for (const auto& pool : m.pools)
    if (pool->follows()) following_.push_back(pool.get());
  inertia_ = constant_inertia_;
  for (auto* per_shaft : {&speed_, &torque_, &free_torque_, &alpha_, &shaft_angle_, &followed_alpha_})
    per_shaft->assign(shafts, 0);
  for (auto* per_joint : {&twist_rate_, &connection_torque_, &turning_torque_, &spring_torque_})
    per_joint->assign(m.elastic.size(), 0);
  for (auto* per_element : {&element_torque_, &element_inertia_}) per_element->assign(elements, 0);
  node_angle_.assign(m.network.nodes.size(), 0);
  work_rate_.assign(m.accounts.size() + 2 * m.torque_joints.size(), 0);
  internal_rate_.assign(m.internal_states.size(), 0);
  command_value_.assign(m.commands.size(), 1);
  Sums& sums = snapshot_.sums;
  sums.torque = torque_.data(), sums.inertia = inertia_.data();
  sums.connection_torque = connection_torque_.data(), sums.turning_torque = turning_torque_.data();
  sums.spring_torque = spring_torque_.data();
  sums.element_torque = element_torque_.data(), sums.element_inertia = element_inertia_.data();
  list_elastic_tree();
  modes_ = unset_modes(m, ties_.contacts().size());
  ties_.make_rows();
}

void Flow::bind(const Modes& modes) {
  changing_modes() = modes;
  ties_.make_rows();
}

// The elastic joints in an order that leads outwards from the reduction link, and from one shaft of each further tree
// that relations alone tie to it.
void Flow::list_elastic_tree() {
  const Model& m = *model_;
  std::vector<std::vector<int>> joints_at(m.shafts.size());
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    joints_at[at(m.elastic[i].shaft_a)].push_back(static_cast<int>(i));
    joints_at[at(m.elastic[i].shaft_b)].push_back(static_cast<int>(i));
  }
  std::vector<char> seen(m.shafts.size(), 0);
  std::vector<int> queue;
  for (std::size_t i = 0; i < m.angles.size(); ++i) {
    if (seen[at(m.angles[i].shaft)]) continue;
    root_angles_.push_back(i);
    queue.assign(1, m.angles[i].shaft);
    seen[at(queue.front())] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const int j : joints_at[at(queue[next])]) {
        const ElasticJoint& e = m.elastic[at(j)];
        const bool forward = e.shaft_a == queue[next];
        const int other = forward ? e.shaft_b : e.shaft_a;
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        queue.push_back(other);
        elastic_steps_.push_back({j, queue[next], other, forward ? e.gain_a / e.gain_b : e.gain_b / e.gain_a,
                                  forward ? -1 / e.gain_b : 1 / e.gain_a});
      }
  }
}

// φ_b = (gain_a φ_a − θ)/gain_b, and back.
void Flow::set_shaft_angles(const double* twists, std::vector<double>& angles) const {
  for (const ElasticStep& step : elastic_steps_)
    angles[at(step.to)] = step.by_angle * angles[at(step.from)] + step.by_twist * twists[step.elastic];
}

std::vector<double> Flow::shaft_angles_by_twist(std::size_t elastic) const {
  std::vector<double> twists(model_->elastic.size(), 0.0), angles(model_->shafts.size(), 0.0);
  twists[elastic] = 1;
  set_shaft_angles(twists.data(), angles);
  return angles;
}

// Word by word: a copy reads by pairs what was just stored so, and the processor waits for that (a sixth of the whole
// right-hand side of a small machine).
[[gnu::always_inline]] inline void Flow::look_at(double t, std::span<const double> y, Instant& now) {
  const Model& m = *model_;
  const double* speed = y.data() + speed_index(0);
  if (m.free_shafts < speed_.size()) {
    std::copy(speed, speed + m.free_shafts, speed_.begin());
    for (std::size_t s = m.free_shafts; s < speed_.size(); ++s) speed_[s] = prescribed_speed(m, modes_, s, t);
    speed = speed_.data();
  }
  for (std::size_t c = 0; c < modes_.command.size(); ++c)
    command_value_[c] = modes_.command[c].at(t, model_->scene.sequence);
  now.t = t;
  now.angle = y.data();
  now.twist = y.data() + twists_begin();
  now.speed = speed;
  now.mode = modes_.piece.data();
  now.direction = modes_.direction.data();
  now.active = modes_.active.data();
  now.on_since = modes_.on_since.data();
  now.slip = modes_.slip.data();
  now.command = command_value_.data();
  now.own = y.data() + internal_begin();
}

Instant Flow::instant(double t, std::span<const double> y) {
  Instant now;
  look_at(t, y, now);
  return now;
}

void Flow::look(double t, std::span<const double> y) { look_at(t, y, snapshot_.now); }

void Flow::keep(double t, std::span<const double> y) {
  kept_t_ = t;
  kept_y_.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(states_));
  kept_ = true;
}

void Flow::evaluate(double t, std::span<const double> y) {
  if (kept_ && t == kept_t_ && std::equal(kept_y_.begin(), kept_y_.end(), y.begin())) return look(t, y);
  evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
}

// Stages: clear, elements, accelerations, torques in merged joints where somebody asks.
void Flow::evaluate(double t, std::span<const double> y, double* twist_rate, double* alpha, double* work_rate,
                    double* internal_rate) {
  const Model& m = *model_;
  kept_ = false;
  std::fill(torque_.begin(), torque_.end(), 0.0);
  for (const int s : variable_) inertia_[at(s)] = constant_inertia_[at(s)];
  if (work_rate) std::fill(work_rate, work_rate + m.accounts.size(), 0.0);
  look_at(t, y, snapshot_.now);
  snapshot_.sums.twist_rate = twist_rate;
  snapshot_.sums.work_rate = work_rate;
  snapshot_.sums.internal_rate = internal_rate ? internal_rate : internal_rate_.data();
  for (const auto& pool : m.pools) pool->add(snapshot_.now, snapshot_.sums);
  if (plain_) {
    const volatile double* const torque = torque_.data();  // word by word, as in look_at()
    for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = torque[s] * inverse_inertia_[s];
    for (const int s : variable_)
      if (at(s) < m.free_shafts) alpha[s] = torque_[at(s)] / inertia_[at(s)];
    if (!following_.empty()) let_follow(t, alpha, snapshot_.sums.internal_rate);
    return;
  }
  ties_.add_known(snapshot_.now, torque_.data());
  std::copy(torque_.begin(), torque_.end(), free_torque_.begin());
  ties_.accelerate(t, free_torque_, inertia_, alpha);
  if (reactions_.any()) settle_reactions(t, alpha);
  ties_.publish(snapshot_.now, snapshot_.sums);
  if (!following_.empty()) let_follow(t, alpha, snapshot_.sums.internal_rate);
}

void Flow::settle_reactions(double t, double* alpha) {
  const auto accelerate = [&](std::span<const double> torque, std::span<const double> inertia, double* next) {
    ties_.accelerate(t, torque, inertia, next);
  };
  try {
    reactions_.settle(snapshot_.now, free_torque_, inertia_, accelerate, alpha, snapshot_.sums);
  } catch (const Jam& jam) {
    jam_ = jam;
    throw;
  }
}

// What is coupled to the shafts by inertia accelerates with them.
void Flow::let_follow(double t, const double* alpha, double* internal_rate) {
  const Model& m = *model_;
  std::copy(alpha, alpha + m.free_shafts, followed_alpha_.begin());
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s)
    followed_alpha_[s] = prescribed_acceleration(m, modes_, s, t);
  for (const ElementPool* pool : following_) pool->follow(snapshot_.now, followed_alpha_.data(), internal_rate);
}

void Flow::flow(double t, std::span<const double> y, std::span<double> ydot) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = *model_;
  double* const alpha = ydot.data() + speed_index(0);
  double* const work_rate = audit() ? ydot.data() + states_ : nullptr;
  const auto lose = [&] { std::fill(ydot.begin(), ydot.end(), std::numeric_limits<double>::quiet_NaN()); };
  // After a stage that jammed.
  if (reactions_.any() && !std::all_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); })) return lose();
  try {
    evaluate(t, y, ydot.data() + twists_begin(), alpha, work_rate, ydot.data() + internal_begin());
  } catch (const Jam&) {  // a step too long: it is tried again, shorter
    return lose();
  }
  if (!plain_) ties_.refuse_broken(t);
  if (reactions_.any()) {
    std::copy(alpha, alpha + m.free_shafts, alpha_.begin());
    keep(t, y);
  }
  for (std::size_t i = 0; i < m.angles.size(); ++i) ydot[i] = m.angles[i].gain * snapshot_.now.speed[m.angles[i].shaft];
  if (audit()) {
    std::copy(alpha, alpha + m.free_shafts, alpha_.begin());
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(m, modes_, s, t);
    if (m.free_shafts < m.shafts.size() || std::any_of(m.torque_joints.begin(), m.torque_joints.end(), is_rigid))
      find_joint_torques();
    write_quadratures(ydot.data() + states_);
  }
}

// At standstill the opposing elements hold what is left of the shaft's torques.
void Flow::find_joint_torques() {
  held_shafts_.clear();
  for (std::size_t c = 0; c < directional_.size(); ++c)  // contacts with the frame come first
    if (modes_.direction[at(directional_[c])] == 0) held_shafts_.push_back({directional_[c], -ties_.torque(c)});
  if (!held_shafts_.empty()) ties_.find_holds(snapshot_.now);
  joint_torques_.find(given_torques(), held_shafts_, ties_.shaft_hold().data(), ties_.element_hold().data());
}

JointTorques::Given Flow::given_torques() const {
  return {.alpha = alpha_.data(),
          .element_torque = element_torque_.data(),
          .element_inertia = element_inertia_.data(),
          .connection_torque = connection_torque_.data(),
          .turning_torque = turning_torque_.data(),
          .relation_torque = ties_.relation_torque().data(),
          .relation_loss = ties_.relation_loss().data()};
}

// Work of prescribed motions (their reaction is known only now) and the squares of the torques.
void Flow::write_quadratures(double* rate) {
  const Model& m = *model_;
  std::size_t account = m.accounts.size();
  for (std::size_t n = m.network.nodes.size(); m.free_shafts < m.shafts.size() && n-- > 0;) {
    if (m.network.nodes[n].prescribed < 0) continue;
    --account;
    const std::size_t s = at(m.shaft_of_node[n]);
    rate[account] = joint_torques_.balance()[n] * m.gain_of_node[n] * snapshot_.now.speed[s];
  }
  for (std::size_t i = 0; i < m.torque_joints.size(); ++i) {
    const TorqueJoint& joint = m.torque_joints[i];
    const double tau = is_rigid(joint) ? joint.torque(joint_torques_.torque().data())
                                       : joint.reported(connection_torque_.data(), joint.elastic);
    const double spring = is_rigid(joint) ? tau : joint.reported(spring_torque_.data(), joint.elastic);
    rate[m.accounts.size() + 2 * i] = tau * tau;
    rate[m.accounts.size() + 2 * i + 1] = spring * spring;
  }
  double* of_motor = rate + m.accounts.size() + 2 * m.torque_joints.size();
  for (const MotorTorque& motor : m.motors) {
    double torque = motor.prescribed ? joint_torques_.balance()[at(motor.node)] : 0;
    for (const std::size_t e : motor.elements) torque += element_torque_[e];
    *of_motor++ = torque;
    *of_motor++ = torque * torque;
  }
}

Flow::ShaftBalance Flow::shaft_balance(std::size_t shaft, double t, std::span<const double> y, double* work_rate) {
  evaluate(t, y, twist_rate_.data(), alpha_.data(), work_rate);
  return {torque_[shaft], inertia_[shaft]};
}

const std::vector<double>& Flow::accelerations() {
  const Model& m = *model_;
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s)
    alpha_[s] = prescribed_acceleration(m, modes_, s, snapshot_.now.t);
  return alpha_;
}

void Flow::balance_followers(double* own) const {
  for (const ElementPool* pool : following_) pool->balance(snapshot_.now, followed_alpha_.data(), own);
}

const SparsityPattern& Flow::jacobian_pattern() {
  if (pattern_.size == size()) return pattern_;
  pattern_ = model_->jacobian.pattern;
  pattern_.size = size();
  for (std::size_t q = 0; q < quadratures_; ++q) {
    pattern_.row.push_back(static_cast<std::int64_t>(states_ + q));
    pattern_.column_start.push_back(static_cast<std::int64_t>(pattern_.row.size()));
  }
  return pattern_;
}

// Quadratures feed nothing back; their rows are left empty, so that they cost the factorisation nothing.
void Flow::jacobian(double t, std::span<const double> y, std::span<double> values) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = *model_;
  const JacobianLayout& layout = m.jacobian;
  slot_.assign(layout.slot_position.size(), 0.0);
  try {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(m, modes_, s, t);
    for (const auto& pool : m.pools) pool->add_jacobian(snapshot_.now, alpha_.data(), slot_.data());
  } catch (const Jam& jam) {
    jam_ = jam;  // of the derivatives, too
    return std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
  }
  std::fill(values.begin(), values.end(), 0.0);
  const std::size_t stored = layout.pattern.row.size();
  for (std::size_t k = 0; k < slot_.size(); ++k)
    if (layout.slot_position[k] < stored) values[layout.slot_position[k]] += slot_[k];
  if (ties_.any()) ties_.mix_rows(snapshot_.now, effective_inertia(), values);
  for (std::size_t i = 0; i < stored; ++i) {
    const int s = layout.row_shaft[i];
    if (s >= 0 && !ties_.is_coupled(at(s)))
      values[i] *= m.shafts[at(s)].directional && modes_.direction[at(s)] == 0
                       ? 0.0
                       : 1 / (inertia_[at(s)] + (reactions_.any() ? reactions_.slope(at(s)) : 0.0));
  }
  for (const JacobianLayout::Follower& follower : layout.followers)
    for (const auto& [from, to] : follower.entries) values[to] += slot_[follower.slot] * values[from];
  for (const auto& [position, value] : layout.constant) values[position] += value;
}

ErrorControl Flow::error_control(double tolerance) const {
  const Model& m = *model_;
  ErrorControl control{tolerance, {}};
  for (const TrackedAngle& angle : m.angles) control.scale.push_back(std::max(1.0, m.scale_ratio[at(angle.node)]));
  for (const ElasticJoint& joint : m.elastic) control.scale.push_back(twist_scale(m, joint, tolerance));
  for (std::size_t s = 0; s < m.free_shafts; ++s) control.scale.push_back(m.shafts[s].speed_scale);
  for (const PlacedInternalState& own : m.internal_states) control.scale.push_back(own.state.scale);
  control.scale.resize(size(), 0.0);
  if (!audit() || m.free_shafts == m.shafts.size()) return control;
  // Beside a prescribed motion the states may be smoother than the torques: only the quadratures keep the steps short.
  for (std::size_t k = 0; k < m.accounts.size(); ++k) control.scale[work_index(k)] = m.torque_scale;  // per radian
  for (std::size_t i = 0; i < m.torque_joints.size(); ++i)
    for (const bool spring : {false, true})
      control.scale[square_index(i, spring)] = std::pow(m.torque_joints[i].torque_scale, 2) / m.speed_scale;
  for (std::size_t i = 0; i < m.motors.size(); ++i)
    for (const bool squared : {false, true})
      control.scale[motor_index(i, squared)] = std::pow(m.motors[i].rated_torque, squared ? 2 : 1) / m.speed_scale;
  return control;
}

std::string Flow::state_name(std::size_t state) const {
  const Model& m = *model_;
  if (state < m.angle_count()) return fmt::format("angle of {}", m.node_label(m.angles[state].node));
  if (state < speed_index(0))
    return fmt::format("twist of {}", m.network.joints[at(m.elastic[state - twists_begin()].joint)].component);
  if (state < internal_begin())
    return fmt::format("speed of {}", m.node_label(m.shafts[state - speed_index(0)].reference));
  if (state < states_)
    return fmt::format("{} of {}", m.internal_states[state - internal_begin()].state.name,
                       m.internal_states[state - internal_begin()].component);
  if (state < states_ + m.accounts.size()) return fmt::format("work of {}", m.accounts[state - states_].name);
  return "a squared torque";
}

// ---------------------------------------------------------------------------------------------------------------------
// Outputs

const Snapshot& Flow::snapshot(double t, std::span<const double> y) {
  const Model& m = *model_;
  evaluate(t, y, twist_rate_.data(), alpha_.data(), work_rate_.data());
  keep(t, y);
  ties_.refuse_broken(t);
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(m, modes_, s, t);
  find_joint_torques();
  for (const std::size_t root : root_angles_)
    shaft_angle_[at(m.angles[root].shaft)] = angle_with_turns(root, y) / m.angles[root].gain;
  set_shaft_angles(snapshot_.now.twist, shaft_angle_);
  for (std::size_t n = 0; n < node_angle_.size(); ++n)
    node_angle_[n] = m.gain_of_node[n] * shaft_angle_[at(m.shaft_of_node[n])];
  snapshot_.alpha = alpha_.data();
  snapshot_.joint_torque = joint_torques_.torque().data();
  snapshot_.reaction = joint_torques_.balance().data();
  snapshot_.relation_torque = ties_.relation_torque().data();
  snapshot_.relation_loss = ties_.relation_loss().data();
  snapshot_.hold_torque = joint_torques_.hold_torque().data();
  snapshot_.node_angle = node_angle_.data();
  snapshot_.quadrature = audit() ? y.data() + states_ : nullptr;
  return snapshot_;
}

double Flow::kinetic_energy(double t, std::span<const double> y) {
  evaluate(t, y);
  double sum = 0;
  for (std::size_t s = 0; s < model_->shafts.size(); ++s)
    sum += 0.5 * inertia_[s] * snapshot_.now.speed[s] * snapshot_.now.speed[s];
  for (const ElementPool* pool : following_) sum += pool->further_kinetic_energy(snapshot_.now);
  return sum;
}

double Flow::kinetic_energy_of_bodies(double t, std::span<const double> y) {
  const Instant now = instant(t, y);
  double sum = 0;
  for (std::size_t s = 0; s < model_->shafts.size(); ++s)
    sum += 0.5 * constant_inertia_[s] * now.speed[s] * now.speed[s];
  for (const auto& pool : model_->pools) sum += pool->kinetic_energy_of_bodies(now);
  return sum;
}

double Flow::stored_energy(double t, std::span<const double> y) {
  const Instant now = instant(t, y);
  double sum = 0;
  for (const auto& pool : model_->pools) sum += pool->energy(now);
  return sum;
}

}  // namespace kurbel
