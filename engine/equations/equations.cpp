// equations.cpp — right-hand side, Jacobian, angles and outputs of a compiled model, as a flat list of stages.
#include "engine/equations/equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/numerics/fp_traps.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// 4π as two doubles: 10⁶ wraps lose no digit.
constexpr double two_turns = 4 * std::numbers::pi;
constexpr double two_turns_rest = 4 * 1.2246467991473532e-16;

// A universal joint's θ = φ_a − φ_b swings by degrees whatever its spring carries: no step can hold it more exactly
// than it is rounded.
double twist_scale(const Model& m, const ElasticJoint& elastic, double tolerance) {
  const Network::Joint& joint = m.network.joints[at(elastic.joint)];
  if (!joint.element || !joint.element->uses_angle()) return elastic.twist_scale;
  constexpr int positions = 16;
  double swing = 0;
  for (int k = 0; k < positions; ++k)
    swing = std::max(swing, std::abs(joint.element->rest_twist(2 * std::numbers::pi * k / positions)));
  return std::max(elastic.twist_scale, 16 * std::numeric_limits<double>::epsilon() * swing / tolerance);
}

}  // namespace

Equations::Equations(std::shared_ptr<const Model> model, bool audit)
    : model_(std::move(model)), sequence_(*model_), joint_torques_(*model_) {
  const Model& m = *model_;
  states_ = m.state_count();
  if (audit) quadratures_ = m.accounts.size() + 2 * m.torque_joints.size();
  for (const auto& pool : m.pools) {
    guard_begin_.push_back(guard_count_);
    guard_count_ += static_cast<std::size_t>(pool->guard_count());
  }
  for (std::size_t s = 0; s < m.shafts.size(); ++s) {
    if (m.shafts[s].directional) directional_.push_back(static_cast<int>(s));
    if (m.shafts[s].variable) variable_.push_back(static_cast<int>(s));
    constant_inertia_.push_back(m.shafts[s].inertia);
    inverse_inertia_.push_back(m.shafts[s].inertia > 0 ? 1 / m.shafts[s].inertia : 0);
  }
  inertia_ = constant_inertia_;
  const std::size_t shafts = m.shafts.size(), elements = m.network.elements.size(), nodes = m.network.nodes.size();
  modes_.direction.assign(shafts, 1);
  modes_.piece.assign(m.mode_slots, 0);
  modes_.active.assign(elements, 1);
  modes_.prescribed_piece.assign(m.network.prescribed.size(), 0);
  modes_.turns.assign(m.angles.size(), 0);
  speed_.assign(shafts, 0);
  torque_.assign(shafts, 0);
  alpha_.assign(shafts, 0);
  twist_rate_.assign(m.elastic.size(), 0);
  connection_torque_.assign(m.elastic.size(), 0);
  spring_torque_.assign(m.elastic.size(), 0);
  element_torque_.assign(elements, 0);
  for (const auto& pool : model_->pools)
    if (pool->reacts()) reacting_.push_back(pool.get()), reaction_memory_.push_back(pool->make_memory());
  if (!reacting_.empty()) {
    for (auto* per_shaft : {&reaction_alpha_, &reaction_torque_, &reaction_slope_})
      per_shaft->assign(model_->shafts.size(), 0);
    for (auto* per_shaft : {&reaction_effective_torque_, &reaction_effective_inertia_, &reaction_next_})
      per_shaft->assign(model_->shafts.size(), 0);
    reaction_element_.assign(elements, 0);
  }
  for (const auto& pool : model_->pools)
    if (pool->follows()) following_.push_back(pool.get());
  if (!following_.empty()) followed_alpha_.assign(shafts, 0);
  element_inertia_.assign(elements, 0);
  node_angle_.assign(nodes, 0);
  shaft_hold_.assign(shafts, {});
  element_hold_.assign(elements, {});
  work_rate_.assign(m.accounts.size() + 2 * m.torque_joints.size(), 0);
  shaft_angle_.assign(shafts, 0);
  own_rate_.assign(m.own_states.size(), 0);
  Sums& sums = snapshot_.sums;
  sums.torque = torque_.data(), sums.inertia = inertia_.data();
  sums.connection_torque = connection_torque_.data(), sums.spring_torque = spring_torque_.data();
  sums.element_torque = element_torque_.data(), sums.element_inertia = element_inertia_.data();
  list_elastic_tree();
  list_contacts();
  modes_.command.assign(m.commands.size(), {});
  command_value_.assign(m.commands.size(), 1);
  if (sequence_.any()) ++guard_count_;
}

// The elastic joints in an order that leads outwards from the reduction link, and from one shaft of each further tree
// that relations alone tie to it.
void Equations::list_elastic_tree() {
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
        const bool forward = m.elastic[at(j)].shaft_a == queue[next];
        const int other = forward ? m.elastic[at(j)].shaft_b : m.elastic[at(j)].shaft_a;
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        queue.push_back(other);
        elastic_steps_.push_back({j, forward});
      }
  }
}

double Equations::prescribed_speed(std::size_t shaft, double t) const {
  const int p = model_->shafts[shaft].prescribed;
  return model_->network.prescribed[at(p)].value(t, modes_.prescribed_piece[at(p)]);
}

double Equations::prescribed_acceleration(std::size_t shaft, double t) const {
  const int p = model_->shafts[shaft].prescribed;
  return model_->network.prescribed[at(p)].slope(t, modes_.prescribed_piece[at(p)]);
}

// Everything that changes at known times.
void Equations::set_timed_modes(double t) {
  for (const auto& pool : model_->pools) pool->set_timed_modes(t, modes_.piece.data(), modes_.active.data());
  for (std::size_t c = 0; c < modes_.command.size(); ++c) {
    for (const int e : model_->commands[c].switched)
      if (modes_.command[c].at(t) <= 0.5) modes_.active[at(e)] = 0;
    if (modes_.command[c].value == 0 && modes_.command[c].rate == 0)
      for (const int e : model_->commands[c].opened) modes_.active[at(e)] = 0;
  }
  for (std::size_t p = 0; p < modes_.prescribed_piece.size(); ++p)
    modes_.prescribed_piece[p] = model_->network.prescribed[p].piece(t);
}

Instant Equations::instant(double t, std::span<const double> y) {
  Instant now;
  look_at(t, y, now);
  return now;
}

// Word by word: a copy reads by pairs what was just stored so, and the processor waits for that (a sixth of the whole
// right-hand side of a small machine).
void Equations::look_at(double t, std::span<const double> y, Instant& now) {
  const Model& m = *model_;
  const double* speed = y.data() + speed_index(0);
  if (m.free_shafts < m.shafts.size()) {
    std::copy(speed, speed + m.free_shafts, speed_.begin());
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) speed_[s] = prescribed_speed(s, t);
    speed = speed_.data();
  }
  for (std::size_t c = 0; c < modes_.command.size(); ++c) command_value_[c] = modes_.command[c].at(t);
  now.t = t;
  now.angle = y.data();
  now.twist = y.data() + twists_begin();
  now.speed = speed;
  now.mode = modes_.piece.data();
  now.direction = modes_.direction.data();
  now.active = modes_.active.data();
  now.slip = modes_.slip.data();
  now.command = command_value_.data();
  now.own = y.data() + own_begin();
}

// Stages: clear, elements, accelerations, torques in merged joints where somebody asks.
void Equations::evaluate(double t, std::span<const double> y, double* twist_rate, double* alpha, double* work_rate,
                         double* own_rate) {
  const Model& m = *model_;
  std::fill(torque_.begin(), torque_.end(), 0.0);
  for (const int s : variable_) inertia_[at(s)] = constant_inertia_[at(s)];
  if (work_rate) std::fill(work_rate, work_rate + m.accounts.size(), 0.0);
  look_at(t, y, snapshot_.now);
  snapshot_.sums.twist_rate = twist_rate;
  snapshot_.sums.work_rate = work_rate;
  snapshot_.sums.own_rate = own_rate ? own_rate : own_rate_.data();
  for (const auto& pool : m.pools) pool->add(snapshot_.now, snapshot_.sums);
  if (contacts_.empty() && m.relations.empty() && reacting_.empty()) {
    for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = torque_[s] * inverse_inertia_[s];
    for (const int s : variable_)
      if (at(s) < m.free_shafts) alpha[s] = torque_[at(s)] / inertia_[at(s)];
    if (!following_.empty()) let_follow(t, alpha, snapshot_.sums.own_rate);
    return;
  }
  add_known_contact_torques();
  std::copy(torque_.begin(), torque_.end(), free_torque_.begin());
  find_accelerations(t, free_torque_, inertia_, alpha);
  if (!reacting_.empty()) {
    try {
      settle_reactions(t, alpha, work_rate);
    } catch (const Jam& jam) {
      jam_ = jam;
      throw;
    }
  }
  publish_contacts(work_rate);
  if (!following_.empty()) let_follow(t, alpha, snapshot_.sums.own_rate);
}

// What is coupled to the shafts by inertia accelerates with them.
void Equations::let_follow(double t, const double* alpha, double* own_rate) {
  const Model& m = *model_;
  std::copy(alpha, alpha + m.free_shafts, followed_alpha_.begin());
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) followed_alpha_[s] = prescribed_acceleration(s, t);
  for (const ElementPool* pool : following_) pool->follow(snapshot_.now, followed_alpha_.data(), own_rate);
}

// I α = M + M_r(α) by Newton's method: M_r′ counts as inertia.
void Equations::settle_reactions(double t, double* alpha, double* work_rate) {
  const Model& m = *model_;
  std::copy(alpha, alpha + m.free_shafts, reaction_alpha_.begin());
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) reaction_alpha_[s] = prescribed_acceleration(s, t);
  const auto react = [&](double* work) {
    std::fill(reaction_torque_.begin(), reaction_torque_.end(), 0.0);
    std::fill(reaction_slope_.begin(), reaction_slope_.end(), 0.0);
    std::fill(reaction_element_.begin(), reaction_element_.end(), 0.0);
    Reactions sums{reaction_torque_.data(), reaction_slope_.data(), reaction_element_.data(), work};
    for (std::size_t p = 0; p < reacting_.size(); ++p)
      reacting_[p]->add_reactions(snapshot_.now, reaction_alpha_.data(), sums, reaction_memory_[p].get());
  };
  for (const auto& memory : reaction_memory_)
    if (memory) memory->begin();
  std::vector<double>& torque = reaction_effective_torque_;
  std::vector<double>& inertia = reaction_effective_inertia_;
  constexpr int most_steps = 50;
  double last_change = HUGE_VAL;
  for (int i = 0; i < most_steps; ++i) {
    react(nullptr);
    for (std::size_t s = 0; s < m.shafts.size(); ++s) {
      torque[s] = free_torque_[s] + reaction_torque_[s] + reaction_slope_[s] * reaction_alpha_[s];
      inertia[s] = inertia_[s] + reaction_slope_[s];
    }
    find_accelerations(t, torque, inertia, reaction_next_.data());
    double change = 0;
    for (std::size_t s = 0; s < m.free_shafts; ++s) {
      const double step = reaction_next_[s] - reaction_alpha_[s];
      reaction_alpha_[s] = reaction_next_[s];
      if (inertia_[s] == 0) continue;  // follows others
      change = std::max(
          change, std::abs(step) / (std::abs(reaction_alpha_[s]) + 1e-3 * m.shafts[s].torque_scale / inertia_[s]));
    }
    const bool lost =
        !std::all_of(reaction_next_.begin(), reaction_next_.end(), [](double a) { return std::isfinite(a); });
    const bool round_off = change < 1e-12 && change >= 0.5 * last_change;
    last_change = lost ? HUGE_VAL : change;
    if (lost) break;
    if (!(change > 1e-14) || round_off) break;
  }
  constexpr double settled = 1e-8;  // Newton's method that goes to and fro over a kink has found nothing
  if (!(last_change < settled))
    throw Jam("no acceleration satisfies the friction in the joints", [&] {
      for (std::size_t s = 0; s < m.shafts.size(); ++s)
        if (reaction_slope_[s] != 0) return static_cast<int>(s);
      return -1;
    }());
  react(work_rate);
  for (std::size_t s = 0; s < m.shafts.size(); ++s) torque_[s] += reaction_torque_[s];
  for (std::size_t e = 0; e < element_torque_.size(); ++e) element_torque_[e] += reaction_element_[e];
  std::copy(reaction_alpha_.begin(), reaction_alpha_.begin() + static_cast<std::ptrdiff_t>(m.free_shafts), alpha);
}

void Equations::flow(double t, std::span<const double> y, std::span<double> ydot) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = *model_;
  double* const alpha = ydot.data() + speed_index(0);
  double* const work_rate = audit() ? ydot.data() + states_ : nullptr;
  const auto lose = [&] { std::fill(ydot.begin(), ydot.end(), std::numeric_limits<double>::quiet_NaN()); };
  // After a stage that jammed.
  if (!reacting_.empty() && !std::all_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); })) return lose();
  try {
    evaluate(t, y, ydot.data() + twists_begin(), alpha, work_rate, ydot.data() + own_begin());
  } catch (const Jam&) {  // a step too long: it is tried again, shorter
    return lose();
  }
  refuse_broken_ties(t);
  for (std::size_t i = 0; i < m.angles.size(); ++i) ydot[i] = m.angles[i].gain * snapshot_.now.speed[m.angles[i].shaft];
  if (audit()) {
    std::copy(alpha, alpha + m.free_shafts, alpha_.begin());
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(s, t);
    find_joint_torques(alpha_.data());
    write_quadratures(ydot.data() + states_);
  }
}

// At standstill the opposing elements hold what is left of the shaft's torques.
void Equations::find_joint_torques(const double* alpha) {
  held_shafts_.clear();
  for (std::size_t c = 0; c < directional_.size(); ++c)
    if (modes_.direction[at(directional_[c])] == 0) held_shafts_.push_back({directional_[c], -contact_torque_[c]});
  if (!held_shafts_.empty()) find_holds();
  joint_torques_.find({.alpha = alpha,
                       .element_torque = element_torque_.data(),
                       .element_inertia = element_inertia_.data(),
                       .connection_torque = connection_torque_.data(),
                       .relation_torque = relation_torque_.data(),
                       .relation_loss = relation_loss_.data()},
                      held_shafts_, shaft_hold_.data(), element_hold_.data());
}

// Work of prescribed motions (their reaction is known only now) and the squares of the torques.
void Equations::write_quadratures(double* rate) {
  const Model& m = *model_;
  std::size_t account = m.accounts.size();
  for (std::size_t n = m.network.nodes.size(); n-- > 0;) {
    if (m.network.nodes[n].prescribed < 0) continue;
    --account;
    const std::size_t s = at(m.shaft_of_node[n]);
    rate[account] = joint_torques_.balance()[n] * m.gain_of_node[n] * snapshot_.now.speed[s];
  }
  for (std::size_t i = 0; i < m.torque_joints.size(); ++i) {
    const TorqueJoint& joint = m.torque_joints[i];
    const double tau = joint_torques_.torque()[at(joint.joint)];
    const double spring = joint.elastic >= 0 ? spring_torque_[at(joint.elastic)] : tau;
    rate[m.accounts.size() + 2 * i] = tau * tau;
    rate[m.accounts.size() + 2 * i + 1] = spring * spring;
  }
}

Equations::ShaftBalance Equations::shaft_balance(std::size_t shaft, double t, std::span<const double> y,
                                                 double* work_rate) {
  evaluate(t, y, twist_rate_.data(), alpha_.data(), work_rate);
  return {torque_[shaft], inertia_[shaft]};
}

const SparsityPattern& Equations::jacobian_pattern() {
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
void Equations::jacobian(double t, std::span<const double> y, std::span<double> values) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = *model_;
  const JacobianLayout& layout = m.jacobian;
  slot_.assign(layout.slot_position.size(), 0.0);
  try {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(s, t);
    for (const auto& pool : m.pools) pool->add_jacobian(snapshot_.now, alpha_.data(), slot_.data());
  } catch (const Jam& jam) {
    jam_ = jam;  // of the derivatives, too
    return std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
  }
  std::fill(values.begin(), values.end(), 0.0);
  const std::size_t stored = layout.pattern.row.size();
  for (std::size_t k = 0; k < slot_.size(); ++k)
    if (layout.slot_position[k] < stored) values[layout.slot_position[k]] += slot_[k];
  if (!contacts_.empty() || !m.relations.empty()) mix_coupled_rows(values);
  for (std::size_t i = 0; i < stored; ++i) {
    const int s = layout.row_shaft[i];
    if (s >= 0 && !coupled_[at(s)])
      values[i] *= m.shafts[at(s)].directional && modes_.direction[at(s)] == 0
                       ? 0.0
                       : 1 / (inertia_[at(s)] + (reacting_.empty() ? 0.0 : reaction_slope_[at(s)]));
  }
  for (const JacobianLayout::Follower& follower : layout.followers)
    for (const auto& [from, to] : follower.entries) values[to] += slot_[follower.slot] * values[from];
  for (const auto& [position, value] : layout.constant) values[position] += value;
}

ErrorControl Equations::error_control(double tolerance) const {
  const Model& m = *model_;
  ErrorControl control{tolerance, {}};
  for (const TrackedAngle& angle : m.angles) control.scale.push_back(std::max(1.0, m.scale_ratio[at(angle.node)]));
  for (const ElasticJoint& joint : m.elastic) control.scale.push_back(twist_scale(m, joint, tolerance));
  for (std::size_t s = 0; s < m.free_shafts; ++s) control.scale.push_back(m.shafts[s].speed_scale);
  for (const OwnStatePlace& own : m.own_states) control.scale.push_back(own.state.scale);
  control.scale.resize(size(), 0.0);
  if (!audit() || m.free_shafts == m.shafts.size()) return control;
  // Beside a prescribed motion the states may be smoother than the torques: only the quadratures keep the steps short.
  for (std::size_t k = 0; k < m.accounts.size(); ++k) control.scale[work_index(k)] = m.torque_scale;  // per radian
  for (std::size_t i = 0; i < m.torque_joints.size(); ++i)
    for (const bool spring : {false, true})
      control.scale[square_index(i, spring)] = std::pow(m.torque_joints[i].torque_scale, 2) / m.speed_scale;
  return control;
}

std::string Equations::state_name(std::size_t state) const {
  const Model& m = *model_;
  if (state < m.angle_count()) return fmt::format("angle of {}", m.node_label(m.angles[state].node));
  if (state < speed_index(0))
    return fmt::format("twist of {}", m.network.joints[at(m.elastic[state - twists_begin()].joint)].component);
  if (state < own_begin()) return fmt::format("speed of {}", m.node_label(m.shafts[state - speed_index(0)].reference));
  if (state < states_)
    return fmt::format("{} of {}", m.own_states[state - own_begin()].state.name,
                       m.own_states[state - own_begin()].component);
  if (state < states_ + m.accounts.size()) return fmt::format("work of {}", m.accounts[state - states_].name);
  return "a squared torque";
}

// ---------------------------------------------------------------------------------------------------------------------
// Angles

bool Equations::needs_wrap(std::span<const double> y) const {
  for (std::size_t i = 0; i < modes_.turns.size(); ++i)
    if (std::abs(y[i]) > 4 * two_turns) return true;
  return false;
}

bool Equations::wrap(std::span<double> y) {
  bool changed = false;
  for (std::size_t i = 0; i < modes_.turns.size(); ++i) {
    // What is left of 4π itself, which is a little more than its double, would be less than nothing: it stays whole.
    double k = std::floor(y[i] / two_turns) - modes_.first_two_turns;
    const auto rest = [&] { return std::fma(-k, two_turns, y[i]) - k * two_turns_rest; };
    if (k > 0 && rest() < modes_.first_two_turns * two_turns) --k;
    if (k == 0) continue;
    y[i] = rest();
    modes_.turns[i] += k;
    changed = true;
  }
  return changed;
}

double angle_with_turns(const Modes& modes, std::size_t tracked, std::span<const double> y) {
  return static_cast<double>(static_cast<long double>(modes.turns[tracked]) * 4 * std::numbers::pi_v<long double> +
                             y[tracked]);
}

double Equations::angle_with_turns(std::size_t tracked, std::span<const double> y) const {
  return kurbel::angle_with_turns(modes_, tracked, y);
}

// ---------------------------------------------------------------------------------------------------------------------
// Outputs

const Snapshot& Equations::snapshot(double t, std::span<const double> y) {
  const Model& m = *model_;
  evaluate(t, y, twist_rate_.data(), alpha_.data(), work_rate_.data());
  refuse_broken_ties(t);
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) alpha_[s] = prescribed_acceleration(s, t);
  find_joint_torques(alpha_.data());
  for (const std::size_t root : root_angles_)
    shaft_angle_[at(m.angles[root].shaft)] = angle_with_turns(root, y) / m.angles[root].gain;
  set_shaft_angles(snapshot_.now.twist, shaft_angle_);
  for (std::size_t n = 0; n < node_angle_.size(); ++n)
    node_angle_[n] = m.gain_of_node[n] * shaft_angle_[at(m.shaft_of_node[n])];
  snapshot_.alpha = alpha_.data();
  snapshot_.joint_torque = joint_torques_.torque().data();
  snapshot_.relation_torque = relation_torque_.data();
  snapshot_.relation_loss = relation_loss_.data();
  snapshot_.node_angle = node_angle_.data();
  snapshot_.quadrature = audit() ? y.data() + states_ : nullptr;
  return snapshot_;
}

double Equations::kinetic_energy(double t, std::span<const double> y) {
  evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
  double sum = 0;
  for (std::size_t s = 0; s < model_->shafts.size(); ++s)
    sum += 0.5 * inertia_[s] * snapshot_.now.speed[s] * snapshot_.now.speed[s];
  for (const ElementPool* pool : following_) sum += pool->further_kinetic_energy(snapshot_.now);
  return sum;
}

double Equations::kinetic_energy_of_bodies(double t, std::span<const double> y) {
  const Instant now = instant(t, y);
  double sum = 0;
  for (std::size_t s = 0; s < model_->shafts.size(); ++s)
    sum += 0.5 * constant_inertia_[s] * now.speed[s] * now.speed[s];
  for (const auto& pool : model_->pools) sum += pool->kinetic_energy_of_bodies(now);
  return sum;
}

double Equations::stored_energy(double t, std::span<const double> y) {
  const Instant now = instant(t, y);
  double sum = 0;
  for (const auto& pool : model_->pools) sum += pool->energy(now);
  return sum;
}

}  // namespace kurbel
