// ties.cpp — rows of stuck contacts, their torques, and the limits of contacts.
#include "engine/equations/ties.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double nothing = 1e-12;    // of the torque scale: no direction
constexpr double no_change = 1e-15;  // of a capacity
constexpr double gives_way = 1e-6;   // of the torque scale: the share of what holds nothing, such as an open clutch
constexpr int most_rounds = 60;      // until the capacities are those of the torques that they share

// Torque on the driven side, μ = λ − L, at the intersection of both lines of a direction: there the flanks change.
double meeting(const GearLoss& loss, int direction) {
  const GearLoss::Line &up = loss.line(direction, 1), &down = loss.line(direction, -1);
  if (up.slope == down.slope) return 0;
  const double taken = (down.offset - up.offset) / (up.slope - down.slope);
  return taken - (up.slope * taken + up.offset);
}
// L by μ: unique also for a self-locking gear, in which both flanks take λ > 0.
double loss_at(const GearLoss::Line& line, double passed) {
  return (line.slope * passed + line.offset) / (1 - line.slope);
}

}  // namespace

Ties::Ties(const Model& model, const Modes& modes)
    : model_(model), modes_(modes), contacts_(contacts_of(model)), constraints_(model.free_shafts) {
  contact_of_loss_.assign(model.relations.size(), 0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (contacts_[c].kind != Contact::Kind::loss) continue;
    lossy_.push_back(contacts_[c].index);
    contact_of_loss_[at(contacts_[c].index)] = c;
  }
  const std::size_t shafts = model.shafts.size();
  coupled_.assign(shafts, 0);
  for (const JacobianLayout::Coupled& group : model.jacobian.coupled)
    for (const int s : group.shafts) coupled_[at(s)] = 1;
  relation_torque_.assign(model.relations.size(), 0);
  relation_loss_.assign(model.relations.size(), 0);
  contact_torque_.assign(contacts_.size(), 0);
  multiplier_.assign(contacts_.size() + model.relations.size(), 0);
  all_alpha_.assign(shafts, 0);
  still_.assign(shafts, 0);
  shaft_hold_.assign(shafts, {});
  element_hold_.assign(model.network.elements.size(), {});
  slip_hold_.assign(model.elastic.size(), {});
}

// ---------------------------------------------------------------------------------------------------------------------
// Rows

bool Ties::makes_a_row(std::size_t contact) const {
  return sense_of(contacts_[contact], modes_) == 0 && !modes_.regularised[contact] &&
         !is_prescribed(contacts_[contact], model_);
}

void Ties::write_relation_rows() {
  for (std::size_t r = 0; r < model_.relations.size(); ++r) {
    const ShaftRelation& relation = model_.relations[r];
    ConstraintRow& row = rows_[r];
    row.motion = relation.motion;
    row.torque = relation.motion;
    for (ShaftGain& g : row.torque) g.gain = -g.gain;
    row.capacity = most_capacity * model_.torque_scale;
    row.unlimited = true;
    if (relation.loss.empty() || modes_.loss_direction[r] == 0) continue;
    const GearLoss::Line& line = relation.in_motion.line(modes_.loss_direction[r], modes_.loss_sign[r]);
    for (const ShaftGain& g : relation.loss) row.torque.push_back({g.shaft, line.slope * g.gain});
  }
}

void Ties::make_rows() {
  const std::size_t relations = model_.relations.size();
  row_contact_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (makes_a_row(c)) row_contact_.push_back(c);
  rows_.resize(relations + row_contact_.size());
  write_relation_rows();
  tied_ = relations > 0;
  smooth_ = std::count(modes_.regularised.begin(), modes_.regularised.end(), 1) > 0;
  for (std::size_t k = 0; k < row_contact_.size(); ++k) {
    const Contact& contact = contacts_[row_contact_[k]];
    ConstraintRow& row = rows_[relations + k];
    row.motion = contact.motion;
    row.torque = contact.torque;
    row.capacity = weight(row_contact_[k], modes_.capacity[row_contact_[k]]);
    tied_ = tied_ || contact.kind != Contact::Kind::frame;
  }
  list_still_shafts(rows_);
  static const std::vector<ConstraintRow> none;
  constraints_.set(tied_ ? rows_ : none);
}

// A row whose other members are at rest also holds the last one.
void Ties::list_still_shafts(const std::vector<ConstraintRow>& rows) {
  std::fill(still_.begin(), still_.end(), 0);
  for (std::size_t s = model_.free_shafts; s < model_.shafts.size(); ++s)
    still_[s] = model_.network.prescribed[at(model_.shafts[s].prescribed)].is_nothing();
  for (bool changed = true; changed;) {
    changed = false;
    for (const ConstraintRow& row : rows) {
      int moving = -1, count = 0;
      for (const ShaftGain& g : row.motion)
        if (!still_[at(g.shaft)] && g.gain != 0) moving = g.shaft, ++count;
      if (count == 1) still_[at(moving)] = changed = true;
    }
  }
}

void Ties::project(std::span<const double> inertia, std::span<double> speed) {
  if (tied_) constraints_.project(inertia, speed);
}

double Ties::effective_inertia(const Contact& contact, std::span<const double> inertia) {
  const double mobility = std::abs(constraints_.mobility(inertia, contact.motion, contact.torque));
  return mobility > 0 ? 1 / mobility : 0;
}

// ---------------------------------------------------------------------------------------------------------------------
// Stages of an evaluation

void Ties::add_known(const Instant& now, double* torque) {
  now_ = &now;
  for (const int r : lossy_) {
    const int direction = modes_.loss_direction[at(r)];
    if (direction == 0) continue;
    const ShaftRelation& relation = model_.relations[at(r)];
    add_over(relation.loss, relation.in_motion.line(direction, modes_.loss_sign[at(r)]).offset, torque);
  }
  if (!smooth_) return;
  find_holds(now);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!modes_.regularised[c]) continue;
    contact_torque_[c] = regularised_torque(c, now);
    add_over(contacts_[c].torque, contact_torque_[c], torque);
  }
}

void Ties::accelerate(double t, std::span<const double> torque, std::span<const double> inertia, double* alpha) {
  const Model& m = model_;
  if (!tied_) {
    for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = torque[s] / inertia[s];
    for (const std::size_t c : row_contact_) {
      const std::size_t s = at(contacts_[c].index);
      contact_torque_[c] = torque[s];
      alpha[s] = 0;
    }
    return;
  }
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s)
    all_alpha_[s] = prescribed_acceleration(m, modes_, s, t);
  solve(torque, inertia);
  for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = still_[s] ? 0 : all_alpha_[s];
}

// The hold of a gear by its losses grows with the torque that it passes on, the hold of a brake changes with its command:
// where several contacts hold together, their shares follow their present holds. They begin from those of the modes, so
// that they depend on the state alone.
void Ties::solve(std::span<const double> torque, std::span<const double> inertia) {
  const std::size_t relations = model_.relations.size();
  capacity_.clear();
  if (row_contact_.size() > 1)
    for (const ConstraintRow& row : rows_) capacity_.push_back(row.capacity);
  bool changed = true;
  for (int round = 0; changed && round < most_rounds; ++round) {
    if (!capacity_.empty()) constraints_.share_by(capacity_);
    constraints_.solve(inertia, torque, all_alpha_, multiplier_);
    std::copy_n(multiplier_.begin(), relations, relation_torque_.begin());
    for (std::size_t k = 0; k < row_contact_.size(); ++k) contact_torque_[row_contact_[k]] = multiplier_[relations + k];
    if (!shares()) return;
    if (round == 0) find_holds(*now_);
    changed = false;
    for (std::size_t k = 0; k < row_contact_.size(); ++k) {
      const std::size_t c = row_contact_[k];
      const double part = contact_torque_[c] / contacts_[c].torque_scale;
      const double own = weight(c, capacity(c, (part > nothing) - (part < -nothing)));
      double& before = capacity_[relations + k];
      changed = changed || std::abs(own - before) > no_change * own;
      before = round < most_rounds / 4 ? own : 0.5 * (own + before);
    }
  }
}

// Torques count by the power that they take where the shafts turn: as if all were on one shaft.
double Ties::weight(std::size_t contact, double capacity) const {
  const Contact& c = contacts_[contact];
  const double least = capacity > 0 || c.kind == Contact::Kind::loss ? least_capacity : gives_way;
  return std::max(capacity, least * c.torque_scale) * model_.speed_scale / c.speed_scale;
}

void Ties::publish(const Instant& now, Sums& sums) {
  for (std::size_t c = 0; c < contacts_.size(); ++c) publish_contact(c, now, sums);
  for (std::size_t r = 0; r < model_.relations.size(); ++r) publish_relation(r, now, sums);
}

void Ties::publish_contact(std::size_t c, const Instant& now, Sums& sums) const {
  const Model& m = model_;
  const Contact& contact = contacts_[c];
  const bool creeps = modes_.regularised[c];
  if (contact.kind == Contact::Kind::connection && (creeps || sense_of(contact, modes_) == 0)) {
    sums.connection_torque[contact.index] = contact_torque_[c];
    if (!creeps) return add_over(contact.torque, contact_torque_[c], sums.torque);
    const double rate = sum_over(contact.motion, now.speed);
    sums.twist_rate[contact.index] = rate;
    if (sums.work_rate) sums.work_rate[m.elastic[at(contact.index)].loss_account] -= contact_torque_[c] * rate;
  } else if (contact.kind == Contact::Kind::frame && creeps && sums.work_rate) {
    // The work of a regularised standstill goes to the first element that holds there.
    for (const Network::ShaftElement& e : m.network.elements) {
      if (m.shaft_of_node[at(e.node)] != contact.index || !e.element->is.directional) continue;
      sums.work_rate[e.account] -= contact_torque_[c] * sum_over(contact.motion, now.speed);
      break;
    }
  }
}

void Ties::publish_relation(std::size_t r, const Instant& now, Sums& sums) {
  const ShaftRelation& relation = model_.relations[r];
  add_over(relation.motion, -relation_torque_[r], sums.torque);
  if (relation.loss.empty()) return;
  if (modes_.loss_direction[r] != 0) {
    const GearLoss::Line& line = relation.in_motion.line(modes_.loss_direction[r], modes_.loss_sign[r]);
    relation_loss_[r] = line.slope * relation_torque_[r] + line.offset;
    add_over(relation.loss, line.slope * relation_torque_[r], sums.torque);  // the offset is in already
  } else {
    const std::size_t c = contact_of_loss_[r];
    relation_loss_[r] = contact_torque_[c];
    if (!modes_.regularised[c]) add_over(relation.loss, relation_loss_[r], sums.torque);
  }
  if (sums.work_rate)
    sums.work_rate[relation.loss_account] -= relation_loss_[r] * sum_over(relation.sliding, now.speed);
}

void Ties::mix_rows(const Instant& now, std::span<const double> inertia, std::span<double> values) {
  add_regularised_slopes(now, values);
  for (const JacobianLayout::Coupled& group : model_.jacobian.coupled) {
    const std::vector<double> w = constraints_.mobility(inertia, group.shafts);
    const std::size_t n = group.shafts.size();
    std::vector<double> row(n);
    for (std::size_t column = 0; column < group.columns.size(); ++column) {
      const std::size_t* position = group.position.data() + column * group.shafts.size();
      for (std::size_t i = 0; i < n; ++i) row[i] = values[position[i]];
      for (std::size_t i = 0; i < n; ++i)
        values[position[i]] =
            still_[at(group.shafts[i])] ? 0 : std::inner_product(row.begin(), row.end(), w.data() + i * n, 0.0);
    }
    // Shafts held by themselves, without a tie to others.
    if (tied_) continue;
    for (std::size_t i = 0; i < group.shafts.size(); ++i)
      if (still_[at(group.shafts[i])])
        for (std::size_t column = 0; column < group.columns.size(); ++column)
          values[group.position[column * group.shafts.size() + i]] = 0;
  }
}

void Ties::add_regularised_slopes(const Instant& now, std::span<double> values) const {
  const Model& m = model_;
  const SparsityPattern& pattern = m.jacobian.pattern;
  const std::size_t first_speed = m.angle_count() + m.twist_count();
  const auto entry = [&](int to, int from) -> double* {
    const std::size_t row = first_speed + at(to), column = first_speed + at(from);
    const auto begin = static_cast<std::size_t>(pattern.column_start[column]);
    const auto end = static_cast<std::size_t>(pattern.column_start[column + 1]);
    for (std::size_t k = begin; k < end; ++k)
      if (static_cast<std::size_t>(pattern.row[k]) == row) return &values[k];
    return nullptr;
  };
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!modes_.regularised[c]) continue;
    double slope = 0;
    regularised_torque(c, now, &slope);
    for (const ShaftGain& to : contacts_[c].torque)
      for (const ShaftGain& from : contacts_[c].motion) {
        if (at(to.shaft) >= m.free_shafts || at(from.shaft) >= m.free_shafts) continue;
        if (double* place = entry(to.shaft, from.shaft)) *place += to.gain * slope * from.gain;
      }
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Holds

void Ties::find_holds(const Instant& now) {
  std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
  std::fill(element_hold_.begin(), element_hold_.end(), Hold{});
  for (const auto& pool : model_.pools) {
    pool->add_holds(now, shaft_hold_.data(), element_hold_.data());
    pool->add_slip_holds(now, slip_hold_.data());
  }
}

Hold Ties::limits(std::size_t contact) const {
  const Contact& c = contacts_[contact];
  Hold hold;
  switch (c.kind) {
    case Contact::Kind::frame:
      hold = {-shaft_hold_[at(c.index)].high, -shaft_hold_[at(c.index)].low};
      break;
    case Contact::Kind::connection:
      hold = slip_hold_[at(c.index)];
      break;
    case Contact::Kind::loss:
      const GearLoss& loss = model_.network.relations[at(model_.relations[at(c.index)].relation)].loss;
      const double passed = relation_torque_[at(c.index)] - contact_torque_[contact];
      hold = {std::min(loss_at(loss.line(-1, 1), passed), loss_at(loss.line(-1, -1), passed)),
              std::max(loss_at(loss.line(1, 1), passed), loss_at(loss.line(1, -1), passed))};
  }
  // A gear's losses that hold nothing yet keep their place among those that hold together.
  const bool among_others = c.kind == Contact::Kind::loss && shares() && makes_a_row(contact);
  const double least = among_others ? least_capacity * c.torque_scale : 0;
  return {std::min(hold.low, -least), std::max(hold.high, least)};
}

double Ties::flank_margin(std::size_t relation) const {
  const int direction = modes_.loss_direction[relation], sign = modes_.loss_sign[relation];
  const GearLoss& loss = model_.relations[relation].in_motion;
  const GearLoss::Line& line = loss.line(direction, sign);
  const double passed = relation_torque_[relation] - (line.slope * relation_torque_[relation] + line.offset);
  return sign * (passed - meeting(loss, direction)) / contacts_[contact_of_loss_[relation]].torque_scale;
}

double Ties::capacity(std::size_t contact, int way) const {
  const Hold hold = limits(contact);
  const double most = way > 0 ? hold.high : way < 0 ? -hold.low : std::max(hold.high, -hold.low);
  return std::min(most, most_capacity * contacts_[contact].torque_scale);
}

double Ties::regularised_torque(std::size_t contact, const Instant& now, double* slope) const {
  const Contact& c = contacts_[contact];
  const double v0 = creep * c.speed_scale, v = sum_over(c.motion, now.speed);
  const Hold hold = limits(contact);
  const double limit = std::min(v >= 0 ? hold.high : -hold.low, most_capacity * c.torque_scale);
  const double part = std::tanh(v / v0);
  if (slope) *slope = limit * (1 - part * part) / v0;
  return limit * part;
}

// ---------------------------------------------------------------------------------------------------------------------
// Transmitted torques

void Ties::set_torques(const Torques& known) {
  contact_torque_ = known.contact, relation_torque_ = known.relation, relation_loss_ = known.loss;
}

void Ties::forget_torques() {
  std::fill(relation_torque_.begin(), relation_torque_.end(), 0);
  std::fill(relation_loss_.begin(), relation_loss_.end(), 0);
  std::fill(contact_torque_.begin(), contact_torque_.end(), 0);
}

const std::string& Ties::name_of_row(std::size_t row) const {
  const std::size_t relations = model_.relations.size();
  return row < relations ? model_.network.relations[at(model_.relations[row].relation)].component
                         : contacts_[row_contact_[row - relations]].name;
}

int Ties::relation_that_locks() const {
  if (!tied_ || !constraints_.trouble() || constraints_.trouble()->cause != Constraints::Trouble::Cause::locked)
    return -1;
  const std::size_t row = constraints_.trouble()->row, relations = model_.relations.size();
  if (row < relations) return static_cast<int>(row);
  const Contact& contact = contacts_[row_contact_[row - relations]];
  return contact.kind == Contact::Kind::loss ? contact.index : -1;
}

void Ties::refuse_broken(double t) const {
  if (!tied_ || !constraints_.trouble()) return;
  const Constraints::Trouble& trouble = *constraints_.trouble();
  const std::string& name = name_of_row(trouble.row);
  switch (trouble.cause) {
    case Constraints::Trouble::Cause::locked:
      throw std::runtime_error(fmt::format(
          "\"{}\" locks itself at {:.6g} s: with its losses no torques go with the motion that it allows, whatever the "
          "acceleration; try less friction (a better efficiency), more inertia on its driving side, or gear_losses off",
          name, t));
    case Constraints::Trouble::Cause::contradicted:
      throw std::runtime_error(
          fmt::format("\"{}\" cannot be kept at {:.6g} s: the speeds that are prescribed for the shafts that it ties "
                      "contradict each other; leave one of them free, or prescribe speeds that fit",
                      name, t));
    case Constraints::Trouble::Cause::lost:
      break;
  }
  throw std::runtime_error(fmt::format(
      "the shafts that \"{}\" ties part at {:.6g} s: their accelerations are lost to round-off; bring its inertias and "
      "ratios nearer to each other, or its efficiency nearer to 1",
      name, t));
}

}  // namespace kurbel
