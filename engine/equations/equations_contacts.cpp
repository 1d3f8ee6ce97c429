// equations_contacts.cpp — what sticks and what slips: torques of stuck contacts, and the set of modes that fits.
//
// Of all contacts whose speed of slip is zero each may stick or slip either way. A set of modes fits when every stuck
// one needs no more torque than it can hold, and every released one is accelerated the way it was let go.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "engine/equations/equations.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr double nothing = 1e-12;          // of a scale: a torque or speed within round-off
constexpr double leaves_rest = 1e-9;       // of the speed scale: a prescribed motion that begins without acceleration
constexpr double creep = 1e-4;             // of the speed scale: where a regularised contact reaches three quarters
constexpr double creep_ends = 20 * creep;  // beyond this a regularised contact moves, by its own law again
constexpr double least_capacity = 1e-6, most_capacity = 1e3;  // of the torque scale, for sharing
constexpr std::size_t few_contacts = 7;                       // so many are enumerated
constexpr int most_changes = 200;

double sum_over(const std::vector<ShaftGain>& row, const double* per_shaft) {
  double sum = 0;
  for (const ShaftGain& g : row) sum += g.gain * per_shaft[g.shaft];
  return sum;
}
void add_over(const std::vector<ShaftGain>& row, double factor, std::vector<double>& torque) {
  for (const ShaftGain& g : row) torque[at(g.shaft)] += g.gain * factor;
}
std::vector<ShaftGain> minus(std::vector<ShaftGain> row) {
  for (ShaftGain& g : row) g.gain = -g.gain;
  return row;
}

// What goes on to the driven side, μ = λ − L, where both lines of a sense of motion meet: there the flanks change.
double meeting(const GearLoss& loss, int direction) {
  const GearLoss::Line &up = loss.line(direction, 1), &down = loss.line(direction, -1);
  if (up.slope == down.slope) return 0;
  const double taken = (down.offset - up.offset) / (up.slope - down.slope);
  return taken - (up.slope * taken + up.offset);
}
// L while μ goes on: unique also where a gear locks itself and either flank takes λ > 0.
double loss_at(const GearLoss::Line& line, double passed) {
  return (line.slope * passed + line.offset) / (1 - line.slope);
}

}  // namespace

void Equations::list_contacts() {
  const Model& m = *model_;
  for (const int s : directional_) {
    const Shaft& shaft = m.shafts[at(s)];
    contacts_.push_back({.kind = Contact::Kind::frame,
                         .index = s,
                         .motion = {{s, 1}},
                         .torque = {{s, -1}},
                         .speed_scale = shaft.speed_scale,
                         .torque_scale = shaft.torque_scale,
                         .name = m.node_label(shaft.reference)});
  }
  coupled_.assign(m.shafts.size(), 0);
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const ElasticJoint& e = m.elastic[i];
    if (!e.slips) continue;
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    const Shaft& a = m.shafts[at(e.shaft_a)];
    const std::vector<ShaftGain> motion = {{e.shaft_a, e.gain_a}, {e.shaft_b, -e.gain_b}};
    contacts_.push_back({.kind = Contact::Kind::connection,
                         .index = static_cast<int>(i),
                         .motion = motion,
                         .torque = minus(motion),
                         .speed_scale = std::abs(e.gain_a) * a.speed_scale,
                         .torque_scale = a.torque_scale / std::abs(e.gain_a),
                         .name = joint.component});
  }
  contact_of_loss_.assign(m.relations.size(), 0);
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const Network::Relation& relation = m.network.relations[at(m.relations[r].relation)];
    if (!relation.lossy) continue;
    lossy_.push_back(static_cast<int>(r));
    contact_of_loss_[r] = contacts_.size();
    const auto node = at(relation.node[0]);
    const double gain = std::abs(m.gain_of_node[node]);
    const Shaft& shaft = m.shafts[at(m.shaft_of_node[node])];
    contacts_.push_back({.kind = Contact::Kind::loss,
                         .index = static_cast<int>(r),
                         .motion = m.relations[r].sliding,
                         .torque = m.relations[r].loss,
                         .speed_scale = gain * shaft.speed_scale,
                         .torque_scale = shaft.torque_scale / gain,
                         .name = relation.component});
  }
  guard_count_ += 2 * contacts_.size() + lossy_.size();
  modes_.regularised.assign(contacts_.size(), 0);
  modes_.carries.assign(contacts_.size(), 0);
  modes_.capacity.assign(contacts_.size(), 0);
  modes_.slip.assign(m.elastic.size(), 1);
  modes_.loss_direction.assign(m.relations.size(), 1);
  modes_.loss_sign.assign(m.relations.size(), 1);
  relation_torque_.assign(m.relations.size(), 0);
  relation_loss_.assign(m.relations.size(), 0);
  contact_torque_.assign(contacts_.size(), 0);
  multiplier_.assign(contacts_.size() + m.relations.size(), 0);
  all_alpha_.assign(m.shafts.size(), 0);
  free_torque_.assign(m.shafts.size(), 0);
  slip_hold_.assign(m.elastic.size(), {});
  still_.assign(m.shafts.size(), 0);
  for (const JacobianLayout::Coupled& group : m.jacobian.coupled)
    for (const int s : group.shafts) coupled_[at(s)] = 1;
  constraints_ = Constraints(m.free_shafts);
  tie_stuck_contacts();
}

double Equations::slip_speed(const Contact& contact, const Instant& now) const {
  return sum_over(contact.motion, now.speed);
}

// Its motion is given on every side: it sticks or slips as it is told.
bool Equations::is_prescribed(const Contact& contact) const {
  return std::all_of(contact.motion.begin(), contact.motion.end(),
                     [&](const ShaftGain& g) { return at(g.shaft) >= model_->free_shafts; });
}

// Of what a torque of the contact accelerates, by whatever else is tied.
double Equations::effective_inertia(const Contact& contact) {
  const auto& inertia = reacting_.empty() ? inertia_ : reaction_effective_inertia_;
  const double mobility = std::abs(constraints_.mobility(inertia, contact.motion, contact.torque));
  return mobility > 0 ? 1 / mobility : 0;
}

// Measure of its share where rows repeat: what it can hold the way it carries.
double Equations::capacity(std::size_t contact) const {
  const Contact& c = contacts_[contact];
  const Hold hold = limits(contact);
  const int carries = modes_.carries[contact];
  const double most = carries > 0 ? hold.high : carries < 0 ? -hold.low : std::min(hold.high, -hold.low);
  return std::clamp(most, least_capacity * c.torque_scale, most_capacity * c.torque_scale);
}

// Of what is stuck, by the holds at the state looked at last.
void Equations::find_capacities() {
  for (std::size_t c = 0; c < contacts_.size(); ++c) modes_.capacity[c] = makes_a_row(c) ? capacity(c) : 0;
}

bool Equations::makes_a_row(std::size_t contact) const {
  return sense(contact) == 0 && !modes_.regularised[contact] && !is_prescribed(contacts_[contact]);
}

// A one-way clutch holds its drag one way, and whatever comes the other. True: one carries otherwise than it was tied.
bool Equations::follow_what_is_carried() {
  if (!tied_ || !constraints_.repeats()) return false;
  bool changed = false;
  for (const std::size_t c : row_contact_) {
    const double carried = contact_torque_[c];
    if (std::abs(carried) <= nothing * contacts_[c].torque_scale) continue;
    modes_.carries[c] = carried > 0 ? 1 : -1;
    changed = changed || capacity(c) != modes_.capacity[c];
  }
  return changed;
}

void Equations::bind(const Modes& modes) {
  modes_ = modes;
  tie_stuck_contacts();
}

// The constraint rows of the present modes, and the shafts that they tie to the frame.
void Equations::tie_stuck_contacts() {
  const Model& m = *model_;
  std::vector<ConstraintRow> rows;
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const ShaftRelation& relation = m.relations[r];
    ConstraintRow row{relation.motion, minus(relation.motion), most_capacity * m.torque_scale};
    if (!relation.loss.empty() && modes_.loss_direction[r] != 0) {
      const GearLoss::Line& line = relation.in_motion.line(modes_.loss_direction[r], modes_.loss_sign[r]);
      for (const ShaftGain& g : relation.loss) row.torque.push_back({g.shaft, line.slope * g.gain});
    }
    rows.push_back(std::move(row));
  }
  row_contact_.clear();
  tied_ = !rows.empty();
  std::fill(still_.begin(), still_.end(), 0);
  smooth_ = std::count(modes_.regularised.begin(), modes_.regularised.end(), 1) > 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!makes_a_row(c)) continue;
    const Contact& contact = contacts_[c];
    rows.push_back(
        {contact.motion, contact.torque, std::max(modes_.capacity[c], least_capacity * contact.torque_scale)});
    row_contact_.push_back(c);
    tied_ = tied_ || contact.kind != Contact::Kind::frame;
  }
  // A row whose other members stand still holds the last one too.
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) {
    const PrescribedSpeed& given = m.network.prescribed[at(m.shafts[s].prescribed)];
    still_[s] = given.is_nothing();
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const ConstraintRow& row : rows) {
      int moving = -1, count = 0;
      for (const ShaftGain& g : row.motion)
        if (!still_[at(g.shaft)] && g.gain != 0) moving = g.shaft, ++count;
      if (count == 1) still_[at(moving)] = changed = true;
    }
  }
  constraints_.set(tied_ ? std::move(rows) : std::vector<ConstraintRow>{});
}

// Torques that hang on the state alone: what losses have besides their share of λ, and regularised contacts.
void Equations::add_known_contact_torques() {
  const Model& m = *model_;
  for (const int r : lossy_)
    if (modes_.loss_direction[at(r)] != 0) {
      const GearLoss& loss = m.relations[at(r)].in_motion;
      add_over(m.relations[at(r)].loss, loss.line(modes_.loss_direction[at(r)], modes_.loss_sign[at(r)]).offset,
               torque_);
    }
  if (smooth_) find_holds();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (modes_.regularised[c]) {
      contact_torque_[c] = regularised_torque(c, snapshot_.now);
      add_over(contacts_[c].torque, contact_torque_[c], torque_);
    }
}

void Equations::find_accelerations(double t, std::span<const double> torque, std::span<const double> inertia,
                                   double* alpha) {
  const Model& m = *model_;
  if (!tied_) {
    for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = torque[s] / inertia[s];
    for (const std::size_t c : row_contact_) {
      const std::size_t s = at(contacts_[c].index);
      contact_torque_[c] = torque[s];
      alpha[s] = 0;
    }
    return;
  }
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) all_alpha_[s] = prescribed_acceleration(s, t);
  constraints_.solve(inertia, torque, all_alpha_, multiplier_);
  for (std::size_t s = 0; s < m.free_shafts; ++s) alpha[s] = still_[s] ? 0 : all_alpha_[s];
  std::copy(multiplier_.begin(), multiplier_.begin() + static_cast<std::ptrdiff_t>(m.relations.size()),
            relation_torque_.begin());
  for (std::size_t k = 0; k < row_contact_.size(); ++k)
    contact_torque_[row_contact_[k]] = multiplier_[m.relations.size() + k];
}

const std::string& Equations::name_of_row(std::size_t row) const {
  const std::size_t relations = model_->relations.size();
  return row < relations ? model_->network.relations[at(model_->relations[row].relation)].component
                         : contacts_[row_contact_[row - relations]].name;
}

// The gear with whose losses the last accelerations could not be found; −1: none.
int Equations::relation_that_locks() const {
  if (!tied_ || !constraints_.trouble() || constraints_.trouble()->cause != Constraints::Trouble::Cause::locked)
    return -1;
  const std::size_t row = constraints_.trouble()->row, relations = model_->relations.size();
  if (row < relations) return static_cast<int>(row);
  const Contact& contact = contacts_[row_contact_[row - relations]];
  return contact.kind == Contact::Kind::loss ? contact.index : -1;
}

// A run whose ties are not kept must not go on.
void Equations::refuse_broken_ties(double t) const {
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
                      "contradict each "
                      "other; leave one of them free, or prescribe speeds that fit",
                      name, t));
    case Constraints::Trouble::Cause::lost:
      break;
  }
  throw std::runtime_error(fmt::format(
      "the shafts that \"{}\" ties part at {:.6g} s: their accelerations are lost to round-off; bring its inertias and "
      "ratios nearer to each other, or its efficiency nearer to 1",
      name, t));
}

// What contacts and relations transmit, as torques on the shafts, of the connections, and as work lost.
void Equations::publish_contacts(double* work_rate) {
  const Model& m = *model_;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    if (contact.kind == Contact::Kind::connection && (modes_.regularised[c] || sense(c) == 0)) {
      connection_torque_[at(contact.index)] = contact_torque_[c];
      if (!modes_.regularised[c]) {
        add_over(contact.torque, contact_torque_[c], torque_);
      } else {
        const double rate = slip_speed(contact, snapshot_.now);
        snapshot_.sums.twist_rate[contact.index] = rate;
        if (work_rate) work_rate[m.elastic[at(contact.index)].loss_account] -= contact_torque_[c] * rate;
      }
    } else if (contact.kind == Contact::Kind::frame && modes_.regularised[c] && work_rate) {
      // The work of a regularised standstill goes to the first element that holds there.
      for (std::size_t e = 0; e < m.network.elements.size(); ++e)
        if (m.shaft_of_node[at(m.network.elements[e].node)] == contact.index &&
            m.network.elements[e].element->directional()) {
          work_rate[m.network.elements[e].account] -= contact_torque_[c] * slip_speed(contact, snapshot_.now);
          break;
        }
    }
  }
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const ShaftRelation& relation = m.relations[r];
    add_over(relation.motion, -relation_torque_[r], torque_);
    if (relation.loss.empty()) continue;
    if (modes_.loss_direction[r] != 0) {
      const GearLoss::Line& line = relation.in_motion.line(modes_.loss_direction[r], modes_.loss_sign[r]);
      relation_loss_[r] = line.slope * relation_torque_[r] + line.offset;
      add_over(relation.loss, line.slope * relation_torque_[r], torque_);  // the offset is in already
    } else {
      const std::size_t c = contact_of_loss_[r];
      relation_loss_[r] = contact_torque_[c];
      if (!modes_.regularised[c]) add_over(relation.loss, relation_loss_[r], torque_);
    }
    if (work_rate)
      work_rate[relation.loss_account] -= relation_loss_[r] * sum_over(relation.sliding, snapshot_.now.speed);
  }
}

// What every contact can hold at the state looked at last, which must still be there.
void Equations::find_holds() {
  std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
  std::fill(element_hold_.begin(), element_hold_.end(), Hold{});
  for (const auto& pool : model_->pools) {
    pool->add_holds(snapshot_.now, shaft_hold_.data(), element_hold_.data());
    pool->add_slip_holds(snapshot_.now, slip_hold_.data());
  }
}

// Range of λ that a stuck contact can carry.
Hold Equations::limits(std::size_t contact) const {
  const Contact& c = contacts_[contact];
  switch (c.kind) {
    case Contact::Kind::frame:
      return {-shaft_hold_[at(c.index)].high, -shaft_hold_[at(c.index)].low};
    case Contact::Kind::connection:
      return slip_hold_[at(c.index)];
    case Contact::Kind::loss:
      break;
  }
  const GearLoss& loss = model_->network.relations[at(model_->relations[at(c.index)].relation)].loss;
  const double passed = relation_torque_[at(c.index)] - contact_torque_[contact];
  return {std::min(loss_at(loss.line(-1, 1), passed), loss_at(loss.line(-1, -1), passed)),
          std::max(loss_at(loss.line(1, 1), passed), loss_at(loss.line(1, -1), passed))};
}

// Positive while the flank that the mode says is the one that carries.
double Equations::flank_margin(std::size_t relation) const {
  const int direction = modes_.loss_direction[relation], sign = modes_.loss_sign[relation];
  const GearLoss& loss = model_->relations[relation].in_motion;
  const GearLoss::Line& line = loss.line(direction, sign);
  const double passed = relation_torque_[relation] - (line.slope * relation_torque_[relation] + line.offset);
  return sign * (passed - meeting(loss, direction)) / contacts_[contact_of_loss_[relation]].torque_scale;
}

// λ = limit · tanh(v/v₀): it creeps.
double Equations::regularised_torque(std::size_t contact, const Instant& now, double* slope) const {
  const Contact& c = contacts_[contact];
  const double v0 = creep * c.speed_scale, v = slip_speed(c, now);
  const Hold hold = limits(contact);
  const double limit = std::min(v >= 0 ? hold.high : -hold.low, 1e3 * c.torque_scale);
  const double part = std::tanh(v / v0);
  if (slope) *slope = limit * (1 - part * part) / v0;
  return limit * part;
}

// ---------------------------------------------------------------------------------------------------------------------
// Which modes fit

// Where the present modes of these contacts fit least, and what would be better there. Evaluates the model.
Equations::Misfit Equations::worst_misfit(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                                          double* total) {
  for (const auto& pool : model_->pools) pool->follow_directions(instant(t, y), modes_.piece.data());
  snapshot_.now = instant(t, y);
  find_holds();
  find_capacities();
  tie_stuck_contacts();
  try {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    find_holds();
    if (follow_what_is_carried()) {
      find_capacities();
      tie_stuck_contacts();
      evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    }
  } catch (const Jam& jam) {  // what stands does not jam; what moves as these modes say does
    for (const std::size_t c : among)
      if (contacts_[c].kind == Contact::Kind::frame && contacts_[c].index == jam.shaft && sense(c) != 0) {
        jam_.reset();
        if (total) *total = HUGE_VAL;
        return {HUGE_VAL, c, 0};
      }
    throw;
  }
  find_holds();
  for (std::size_t s = model_->free_shafts; s < model_->shafts.size(); ++s) alpha_[s] = prescribed_acceleration(s, t);
  constexpr double round_off = 1e-9;
  // Does a torque that pushes on speed up what slips that way? Where a gear that locks itself turns back with its load,
  // the more it is pushed the more it holds: what lets go at its limit does not go that way. What another contact holds
  // answers no push at all, and lets go all the same.
  const auto gives_way = [&](std::size_t c, int way) {
    const std::vector<double> contact_torque = contact_torque_, relation_torque = relation_torque_;
    std::vector<double> torque = free_torque_, pushed = alpha_;
    add_over(contacts_[c].motion, way * contacts_[c].torque_scale, torque);
    find_accelerations(t, torque, inertia_, pushed.data());
    contact_torque_ = contact_torque;
    relation_torque_ = relation_torque;
    double answer = 0, size = 0;
    for (const ShaftGain& g : contacts_[c].motion) {
      answer += way * g.gain * (pushed[at(g.shaft)] - alpha_[at(g.shaft)]);
      size += std::abs(g.gain) * (std::abs(pushed[at(g.shaft)]) + std::abs(alpha_[at(g.shaft)]));
    }
    return answer >= -round_off * size;
  };
  Misfit worst;
  const auto consider = [&](double size, std::size_t which, int better) {
    if (total && size > 0) *total += size;
    if (size > worst.size) worst = {size, which, better};
  };
  if (const int r = relation_that_locks(); r >= 0)  // no torques go with these modes
    consider(HUGE_VAL, contacts_.size() + at(r), -modes_.loss_sign[at(r)]);
  for (const std::size_t c : among) {
    const Contact& contact = contacts_[c];
    if (modes_.regularised[c]) continue;
    const int now = sense(c);
    if (now == 0) {
      const Hold hold = limits(c);
      consider((contact_torque_[c] - hold.high) / contact.torque_scale - nothing, c, 1);
      consider((hold.low - contact_torque_[c]) / contact.torque_scale - nothing, c, -1);
    } else {
      // A push within round-off decides nothing.
      const double push = sum_over(contact.motion, alpha_.data()) * effective_inertia(contact) / contact.torque_scale;
      consider(-push * now - round_off, c, 0);
      if (!lossy_.empty() && std::abs(push) <= round_off && !gives_way(c, now)) consider(1, c, 0);
    }
  }
  for (const int r : lossy_) {
    if (modes_.loss_direction[at(r)] == 0) continue;
    consider(-flank_margin(at(r)) - nothing, contacts_.size() + at(r), -modes_.loss_sign[at(r)]);
  }
  return worst;
}

// Speeds of what is stuck made equal to the last bit, with the least change of kinetic energy.
void Equations::tie_speeds(double t, std::span<double> y) {
  const Model& m = *model_;
  snapshot_.now = instant(t, y);
  find_holds();
  find_capacities();
  tie_stuck_contacts();
  evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);  // for the inertias
  std::vector<double> speed(snapshot_.now.speed, snapshot_.now.speed + m.shafts.size());
  if (tied_) constraints_.project(inertia_, speed);
  for (std::size_t s = 0; s < m.free_shafts; ++s) y[speed_index(static_cast<int>(s))] = still_[s] ? 0 : speed[s];
}

void Equations::settle_contacts(double t, std::span<double> y, const std::vector<std::size_t>& stopped,
                                const std::vector<std::pair<std::size_t, int>>& forced, std::vector<Event>* log) {
  if (contacts_.empty()) return;
  // What is moved as prescribed and just stands still slips the way it is about to go.
  const Instant now = instant(t, y);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    if (!is_prescribed(contact)) continue;
    double v = slip_speed(contact, now) / contact.speed_scale;
    if (std::abs(v) > nothing) continue;
    v = 0;
    for (const ShaftGain& g : contact.motion) v += g.gain * prescribed_acceleration(at(g.shaft), t);
    sense(c) = v > 0 ? 1 : v < 0 ? -1 : 0;
  }
  std::vector<int> before(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) before[c] = sense(c);
  std::set<std::size_t> open;
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (sense(c) == 0 && !modes_.regularised[c] && !is_prescribed(contacts_[c])) open.insert(c);
  for (const std::size_t c : stopped) open.insert(c), sense(c) = 0;
  std::vector<std::size_t> always(stopped.begin(), stopped.end());
  for (const auto& [c, direction] : forced) open.insert(c), always.push_back(c), sense(c) = direction;
  const std::vector<std::size_t> among(open.begin(), open.end());
  if (among.empty() && lossy_.empty()) {
    snapshot_.now = instant(t, y);
    find_holds();
    find_capacities();
    return tie_stuck_contacts();
  }
  if (!stopped.empty()) tie_speeds(t, y);
  std::set<std::vector<int>> seen;
  int changes = 0;
  bool fits = false;
  for (; changes < most_changes; ++changes) {
    const Misfit misfit = worst_misfit(t, y, among);
    if (misfit.size <= 0) {
      fits = true;
      break;
    }
    std::vector<int> modes;
    for (const std::size_t c : among) modes.push_back(sense(c));
    modes.insert(modes.end(), modes_.loss_sign.begin(), modes_.loss_sign.end());
    if (!seen.insert(modes).second) break;  // it goes in circles
    if (misfit.contact < contacts_.size())
      sense(misfit.contact) = misfit.better;
    else
      modes_.loss_sign[misfit.contact - contacts_.size()] = misfit.better;
  }
  if (!fits) fits = try_all_modes(t, y, among, {});
  if (fits) release_otherwise(t, y, among, forced);
  if (!log) return;
  log_contacts(t, among, before, always, *log);
  if (always.size() < 2) return;
  log->push_back({t, "modes",
                  fmt::format("{} contacts at once; {} after {} change{}", always.size(),
                              fits ? "a set that fits was found" : "no set fits, the nearest was taken", changes,
                              changes == 1 ? "" : "s")});
}

// Every set for few contacts: the one that fits, else the nearest. Many are left as they are; the fixed ones keep their
// sense.
bool Equations::try_all_modes(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                              const std::vector<std::size_t>& fixed) {
  std::vector<std::size_t> open;
  for (const std::size_t c : among)
    if (!std::count(fixed.begin(), fixed.end(), c)) open.push_back(c);
  if (open.size() > few_contacts || lossy_.size() > few_contacts) return false;
  int sets = 1;
  for (std::size_t k = 0; k < open.size(); ++k) sets *= 3;
  for (std::size_t k = 0; k < lossy_.size(); ++k) sets *= 2;
  const auto choose = [&](int set) {
    for (const std::size_t c : open) {
      const int which = set % 3;
      sense(c) = which == 0 ? 0 : which == 1 ? 1 : -1;
      set /= 3;
    }
    for (const int r : lossy_) {
      modes_.loss_sign[at(r)] = set % 2 == 0 ? 1 : -1;
      set /= 2;
    }
  };
  double least = HUGE_VAL;
  int best = 0;
  for (int set = 0; set < sets && least > 0; ++set) {
    choose(set);
    double total = 0;
    worst_misfit(t, y, among, &total);
    if (total < least) least = total, best = set;
  }
  choose(best);
  worst_misfit(t, y, among);
  return least <= 0;
}

// At a breakaway the hold is exceeded by round-off only, so that sticking on seems to fit: it does not, where some set
// lets go (of a gear that locks itself: on its other flank). True: such a set was found and taken.
bool Equations::release_otherwise(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                                  const std::vector<std::pair<std::size_t, int>>& forced) {
  std::vector<std::size_t> fixed;
  for (const auto& [c, direction] : forced)
    if (sense(c) == 0) fixed.push_back(c);
  if (fixed.empty()) return false;
  std::vector<int> senses;
  for (const std::size_t c : among) senses.push_back(sense(c));
  const std::vector<int> signs = modes_.loss_sign;
  for (const auto& [c, direction] : forced) sense(c) = direction;
  if (try_all_modes(t, y, among, fixed)) return true;
  for (std::size_t k = 0; k < among.size(); ++k) sense(among[k]) = senses[k];
  modes_.loss_sign = signs;
  worst_misfit(t, y, among);
  return false;
}

// "brake 62 %, bearing 38 %" where several elements hold one shaft.
std::string Equations::sharing(const Contact& contact) {
  if (contact.kind != Contact::Kind::frame) return {};
  const Model& m = *model_;
  std::map<std::string, double> capacity;
  double sum = 0;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    if (m.shaft_of_node[at(m.network.elements[e].node)] != contact.index) continue;
    const double own = std::abs(m.gain_of_node[at(m.network.elements[e].node)]) *
                       (element_hold_[e].high - element_hold_[e].low);  // on the merged shaft
    if (own <= 0) continue;
    capacity[m.network.elements[e].component] += own;
    sum += own;
  }
  if (capacity.size() < 2) return {};
  std::string text;
  for (const auto& [component, own] : capacity)
    text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", component, 100 * own / sum);
  return text;
}

void Equations::log_contacts(double t, const std::vector<std::size_t>& among, const std::vector<int>& before,
                             const std::vector<std::size_t>& always, std::vector<Event>& log) {
  for (const std::size_t c : among) {
    const Contact& contact = contacts_[c];
    const int now = sense(c);
    if (now == before[c] && !std::count(always.begin(), always.end(), c)) continue;
    const bool frame = contact.kind != Contact::Kind::connection;
    const auto name = [&](int direction) -> std::string {
      if (direction == 0) return frame ? "at rest" : "locked";
      if (frame) return direction > 0 ? "moving forwards" : "moving backwards";
      return direction > 0 ? "slipping forwards" : "slipping backwards";
    };
    std::string what = frame      ? now == 0  ? "comes to rest and is held"
                                    : now > 0 ? "moves forwards"
                                              : "moves backwards"
                       : now == 0 ? "locks"
                       : now > 0  ? "slips forwards"
                                  : "slips backwards";
    if (contact.kind == Contact::Kind::loss) what = now == 0 ? "is held by its losses" : what;
    log.push_back({t, contact.name, what, name(before[c])});
    if (now != 0) continue;
    if (const std::string shares = sharing(contact); !shares.empty())
      log.push_back({t, contact.name, "is held in proportion to capacity: " + shares});
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Jams

// Of what is lost where this contact rubs; −1: nobody's.
int Equations::account_of_friction(const Contact& contact) const {
  const Model& m = *model_;
  if (contact.kind == Contact::Kind::connection) return m.elastic[at(contact.index)].loss_account;
  if (contact.kind == Contact::Kind::loss) return m.relations[at(contact.index)].loss_account;
  int account = -1;
  for (const Network::ShaftElement& e : m.network.elements) {
    if (m.shaft_of_node[at(e.node)] != contact.index || !e.element->directional()) continue;
    for (std::size_t k = 0; k < m.accounts.size(); ++k)
      if (m.accounts[k].name == e.component + ".joints") return static_cast<int>(k);
    if (account < 0) account = e.account;
  }
  return account;
}

bool Equations::stop_jam(double t, std::span<double> y, const std::vector<std::size_t>& guards,
                         std::vector<Event>& log) {
  const Model& m = *model_;
  std::vector<std::size_t> stopped;
  const auto stop = [&](std::size_t c) {
    if (sense(c) != 0 && !modes_.regularised[c] && !is_prescribed(contacts_[c])) stopped.push_back(c);
  };
  for (const std::size_t guard : guards) {
    if (guard < contact_guards_begin()) continue;
    const std::size_t local = guard - contact_guards_begin();
    if (local < 2 * contacts_.size())
      stop(local / 2);
    else if (local - 2 * contacts_.size() < lossy_.size())
      stop(contact_of_loss_[at(lossy_[local - 2 * contacts_.size()])]);
  }
  if (guards.empty() && jam_)
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (contacts_[c].kind == Contact::Kind::frame && contacts_[c].index == jam_->shaft) stop(c);
  if (stopped.empty()) return false;
  std::vector<double> speed(m.free_shafts);
  for (std::size_t s = 0; s < m.free_shafts; ++s) speed[s] = y[speed_index(static_cast<int>(s))];
  for (const std::size_t c : stopped) sense(c) = 0;
  tie_speeds(t, y);
  double lost = 0;
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    lost += 0.5 * inertia_[s] * (speed[s] * speed[s] - std::pow(y[speed_index(static_cast<int>(s))], 2));
  const int account = account_of_friction(contacts_[stopped.front()]);
  if (audit() && account >= 0) y[work_index(at(account))] -= lost;
  for (const std::size_t c : stopped)
    log.push_back({t, contacts_[c].name, "jams: no acceleration satisfies its friction; it stops at once"});
  settle_contacts(t, y, stopped, {}, &log);
  for (const auto& pool : m.pools) pool->follow_directions(instant(t, y), modes_.piece.data());
  return true;
}

// "press.load, bearing": what can hold there.
std::string Equations::holders(const Contact& contact) const {
  if (contact.kind != Contact::Kind::frame) return contact.name;
  const Model& m = *model_;
  std::set<std::string> names;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e)
    if (m.shaft_of_node[at(m.network.elements[e].node)] == contact.index &&
        element_hold_[e].high - element_hold_[e].low > 0)
      names.insert(m.network.elements[e].component);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? contact.name : text;
}

std::vector<std::string> Equations::held(double t, std::span<const double> y) {
  std::vector<std::string> list;
  if (std::none_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
        return c.kind != Contact::Kind::connection && sense(static_cast<std::size_t>(&c - contacts_.data())) == 0;
      }))
    return list;
  try {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
  } catch (const Jam&) {  // at its very end: nothing can be said
    return list;
  }
  find_holds();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    if (sense(c) != 0 || modes_.regularised[c] || is_prescribed(contact) || contact.kind == Contact::Kind::connection)
      continue;
    const Hold hold = limits(c);
    const double acts = contact_torque_[c];
    const auto side = [&](double limit, const char* way) {
      return std::abs(limit) > most_capacity * contact.torque_scale
                 ? fmt::format("{}: it locks itself", way)
                 : fmt::format("{}: {:.4g} N·m are held, {:.4g} N·m are missing", way, limit, std::abs(limit - acts));
    };
    list.push_back(fmt::format("\"{}\" is held at the end by {}: {:.4g} N·m act; {}; {}", contact.name,
                               holders(contact), acts, side(hold.high, "forwards"), side(hold.low, "backwards")));
  }
  return list;
}

// ---------------------------------------------------------------------------------------------------------------------
// Guards and derivatives

void Equations::contact_guards(double t, std::span<const double> y, double* g) {
  const Instant now = instant(t, y);
  bool stuck = !lossy_.empty();
  for (std::size_t c = 0; c < contacts_.size() && !stuck; ++c) stuck = sense(c) == 0 && !modes_.regularised[c];
  if (stuck) {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    find_holds();
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    double* const own = g + 2 * c;
    own[0] = own[1] = 1;
    const int direction = sense(c);
    if (modes_.regularised[c]) {
      own[0] = creep_ends - std::abs(slip_speed(contact, now)) / contact.speed_scale;
    } else if (direction != 0) {
      own[0] = direction * slip_speed(contact, now) / contact.speed_scale;
    } else if (is_prescribed(contact)) {
      own[0] = leaves_rest - std::abs(slip_speed(contact, now)) / contact.speed_scale;
    } else {
      const Hold hold = limits(c);
      own[0] = std::min(1e6, (hold.high - contact_torque_[c]) / contact.torque_scale);
      own[1] = std::min(1e6, (contact_torque_[c] - hold.low) / contact.torque_scale);
    }
  }
  double* sign = g + 2 * contacts_.size();
  for (const int r : lossy_) *sign++ = modes_.loss_direction[at(r)] == 0 ? 1 : flank_margin(at(r));
}

// Rows of tied shafts: ∂α = W ∂(M − I α), W = mobility. Comes before the division by the inertia, which these rows
// skip.
void Equations::mix_coupled_rows(std::span<double> values) {
  const Model& m = *model_;
  const JacobianLayout& layout = m.jacobian;
  const auto entry = [&](int row, int column) -> double* {
    const auto begin = at(static_cast<int>(layout.pattern.column_start[at(column)]));
    const auto end = at(static_cast<int>(layout.pattern.column_start[at(column) + 1]));
    for (std::size_t k = begin; k < end; ++k)
      if (layout.pattern.row[k] == row) return &values[k];
    return nullptr;
  };
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!modes_.regularised[c]) continue;
    double slope = 0;
    regularised_torque(c, snapshot_.now, &slope);
    for (const ShaftGain& to : contacts_[c].torque)
      for (const ShaftGain& from : contacts_[c].motion) {
        if (at(to.shaft) >= m.free_shafts || at(from.shaft) >= m.free_shafts) continue;
        if (double* place = entry(static_cast<int>(speed_index(to.shaft)), static_cast<int>(speed_index(from.shaft))))
          *place += to.gain * slope * from.gain;
      }
  }
  const std::vector<double>* inertia = &inertia_;
  if (!reacting_.empty()) inertia = &reaction_effective_inertia_;
  for (const JacobianLayout::Coupled& group : layout.coupled) {
    const Eigen::MatrixXd w = constraints_.mobility(*inertia, group.shafts);
    const auto n = static_cast<Eigen::Index>(group.shafts.size());
    Eigen::VectorXd row(n);
    for (std::size_t column = 0; column < group.columns.size(); ++column) {
      const std::size_t* position = group.position.data() + column * group.shafts.size();
      for (Eigen::Index i = 0; i < n; ++i) row[i] = values[position[i]];
      const Eigen::VectorXd mixed = w * row;
      for (Eigen::Index i = 0; i < n; ++i)
        values[position[i]] = still_[at(group.shafts[static_cast<std::size_t>(i)])] ? 0 : mixed[i];
    }
    // Shafts held by themselves, without a tie to others.
    if (tied_) continue;
    for (std::size_t i = 0; i < group.shafts.size(); ++i)
      if (still_[at(group.shafts[i])])
        for (std::size_t column = 0; column < group.columns.size(); ++column)
          values[group.position[column * group.shafts.size() + i]] = 0;
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Events that find no rest

std::string Equations::guard_owner(std::size_t guard) const {
  const std::size_t first = contact_guards_begin();
  if (guard >= first) {
    const std::size_t local = guard - first;
    if (local < 2 * contacts_.size()) return contacts_[local / 2].name;
    return local - 2 * contacts_.size() < lossy_.size()
               ? contacts_[contact_of_loss_[at(lossy_[local - 2 * contacts_.size()])]].name
               : "sequence";
  }
  std::size_t p = model_->pools.size() - 1;
  while (guard_begin_[p] > guard) --p;
  Instant modes;
  modes.mode = modes_.piece.data();
  modes.direction = modes_.direction.data();
  return model_->pools[p]->label(static_cast<int>(guard - guard_begin_[p]), modes).component;
}

std::string Equations::regularise(const std::vector<std::size_t>& guards) {
  std::set<std::string> changed;
  const std::size_t first = contact_guards_begin();
  for (const std::size_t guard : guards) {
    if (guard >= first) {
      const std::size_t local = guard - first;
      if (local >= 2 * contacts_.size()) continue;
      const Contact& contact = contacts_[local / 2];
      if (contact.kind == Contact::Kind::loss || is_prescribed(contact)) continue;
      modes_.regularised[local / 2] = true;
      modes_.capacity[local / 2] = 0;
      sense(local / 2) = 0;
      changed.insert(fmt::format("{} (creeps with up to {:.2g} of its speed scale)", contact.name, creep));
    } else {
      std::size_t p = model_->pools.size() - 1;
      while (guard_begin_[p] > guard) --p;
      if (model_->pools[p]->regularise(static_cast<int>(guard - guard_begin_[p]), modes_.piece.data()))
        changed.insert(guard_owner(guard));
    }
  }
  tie_stuck_contacts();
  std::string text;
  for (const std::string& name : changed) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace kurbel
