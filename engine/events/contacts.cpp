// contacts.cpp — guards of contacts, search for consistent modes, and the stop if there are none.
#include "engine/events/contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double nothing = 1e-12;                // of a scale: a torque or speed within round-off
constexpr double round_off = 1e-9;               // of a torque: not significant
constexpr double leaves_rest = 1e-9;             // of the speed scale: a prescribed motion that begins softly
constexpr double creep_ends = 20 * Ties::creep;  // beyond this a regularised contact moves, by its own law again
constexpr std::size_t few_contacts = 7;          // so many are enumerated
constexpr int most_changes = 200;

}  // namespace

// It may stick or slip, depending on the torques.
bool Contacts::is_open(std::size_t c) const { return sense(c) == 0 && !modes().regularised[c] && !is_given(c); }

// ---------------------------------------------------------------------------------------------------------------------
// Guards

void Contacts::guards(double t, std::span<const double> y, bool evaluated, std::size_t which, double* g) {
  const Instant now = flow_.instant(t, y);
  const Ties& ties = flow_.ties();
  const std::vector<Contact>& contacts = list();
  const bool all = which >= guard_count();
  const std::size_t first = all ? 0 : std::min(which / 2, contacts.size());
  const std::size_t end = all ? contacts.size() : std::min(first + 1, contacts.size());
  const bool flanks = (all || first == end) && !ties.lossy().empty();
  bool stuck = flanks;
  for (std::size_t c = first; c < end && !stuck; ++c) stuck = sense(c) == 0 && !modes().regularised[c];
  if (stuck) {
    if (!evaluated) flow_.evaluate(t, y);
    flow_.ties().find_holds(flow_.now());
  }
  for (std::size_t c = first; c < end; ++c) {
    const Contact& contact = contacts[c];
    double* const own = g + 2 * c;
    own[0] = own[1] = 1;
    const int direction = sense(c);
    if (modes().regularised[c]) {
      own[0] = creep_ends - std::abs(slip_speed(c, now)) / contact.speed_scale;
    } else if (direction != 0) {
      own[0] = direction * slip_speed(c, now) / contact.speed_scale;
    } else if (is_given(c)) {
      own[0] = leaves_rest - std::abs(slip_speed(c, now)) / contact.speed_scale;
    } else {
      const Hold hold = ties.limits(c);
      own[0] = std::min(1e6, (hold.high - ties.torque(c)) / contact.torque_scale);
      own[1] = std::min(1e6, (ties.torque(c) - hold.low) / contact.torque_scale);
    }
  }
  double* sign = g + 2 * contacts.size();
  if (!flanks) return;
  for (const int r : ties.lossy()) *sign++ = modes().loss_direction[at(r)] == 0 ? 1 : ties.flank_margin(at(r));
}

std::size_t Contacts::contact_of(std::size_t guard) const {
  const Ties& ties = flow_.ties();
  if (guard < 2 * list().size()) return guard / 2;
  return ties.contact_of_loss(ties.lossy()[guard - 2 * list().size()]);
}

void Contacts::take(std::size_t guard, double t, std::span<const double> y, Changes& changes) {
  if (guard >= 2 * list().size()) {
    int& sign = modes().loss_sign[at(flow_.ties().lossy()[guard - 2 * list().size()])];
    sign = -sign;
    return;
  }
  const std::size_t c = guard / 2;
  if (modes().regularised[c]) {
    modes().regularised[c] = false;
    changes.released.emplace_back(c, slip_speed(c, flow_.instant(t, y)) > 0 ? 1 : -1);
  } else if (is_given(c)) {
    const double v = slip_speed(c, flow_.instant(t, y));
    sense(c) = sense(c) != 0 ? -sense(c) : v > 0 ? 1 : -1;
  } else if (sense(c) != 0) {
    changes.stopped.push_back(c);
  } else {
    // Breaks away on the side whose guard fired: exactly there the torque still equals the limit.
    changes.released.emplace_back(c, guard % 2 == 0 ? 1 : -1);
  }
}

std::string Contacts::regularise(std::size_t guard) {
  const std::size_t c = guard / 2;
  if (c >= list().size() || list()[c].kind == Contact::Kind::loss || is_given(c)) return {};
  modes().regularised[c] = true;
  modes().capacity[c] = 0;
  sense(c) = 0;
  return fmt::format("{} (creeps with up to {:.2g} of its speed scale)", list()[c].name, Ties::creep);
}

// ---------------------------------------------------------------------------------------------------------------------
// Tied speeds

// Of stuck contacts, by the holds at the last evaluated state.
void Contacts::find_capacities() {
  const Ties& ties = flow_.ties();
  for (std::size_t c = 0; c < list().size(); ++c) modes().capacity[c] = ties.makes_a_row(c) ? ties.capacity(c, 0) : 0;
}

void Contacts::tie(double t, std::span<const double> y) {
  flow_.look(t, y);
  flow_.ties().find_holds(flow_.now());
  find_capacities();
  flow_.ties().make_rows();
}

// Makes the speeds of stuck contacts exactly equal, with the least change of kinetic energy.
void Contacts::tie_speeds(double t, std::span<double> y) {
  tie(t, y);
  flow_.evaluate(t, y);  // for the inertias
  const Model& m = flow_.model();
  std::vector<double> speed(flow_.now().speed, flow_.now().speed + m.shafts.size());
  flow_.ties().project(flow_.inertia(), speed);
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[flow_.speed_index(static_cast<int>(s))] = flow_.ties().stands(s) ? 0 : speed[s];
}

// ---------------------------------------------------------------------------------------------------------------------
// Consistent modes

// Evaluation with shares by capacity. False: the motion with these modes jams, which is an unlimited misfit.
bool Contacts::evaluate_sharing(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                                Misfit& jammed) {
  try {
    flow_.evaluate(t, y);
  } catch (const Jam& jam) {  // contacts at rest do not jam
    for (const std::size_t c : among)
      if (list()[c].kind == Contact::Kind::frame && list()[c].index == jam.shaft && sense(c) != 0) {
        flow_.forget_jam();
        jammed = {HUGE_VAL, c, 0, HUGE_VAL};
        return false;
      }
    throw;
  }
  return true;
}

void Contacts::consider(Misfit& worst, double size, std::size_t which, int better) const {
  const double total = worst.total + (size > 0 ? size : 0);
  if (size > worst.size) worst = {size, which, better, 0};
  worst.total = total;
}

// The largest misfit of the present modes of these contacts, and the better mode. Evaluates the model.
Contacts::Misfit Contacts::worst_misfit(double t, std::span<const double> y, const std::vector<std::size_t>& among) {
  for (const auto& pool : flow_.model().pools) pool->follow_directions(flow_.instant(t, y), modes().piece.data());
  tie(t, y);
  Misfit worst;
  if (!evaluate_sharing(t, y, among, worst)) return worst;
  const Ties& ties = flow_.ties();
  flow_.ties().find_holds(flow_.now());
  flow_.accelerations();
  if (const int r = ties.relation_that_locks(); r >= 0)  // no torques are compatible with these modes
    consider(worst, HUGE_VAL, list().size() + at(r), -modes().loss_sign[at(r)]);
  for (const std::size_t c : among)
    if (!modes().regularised[c]) consider_contact(worst, c, t);
  for (const int r : ties.lossy())
    if (modes().loss_direction[at(r)] != 0)
      consider(worst, -ties.flank_margin(at(r)) - nothing, list().size() + at(r), -modes().loss_sign[at(r)]);
  return worst;
}

void Contacts::consider_contact(Misfit& worst, std::size_t c, double t) {
  const Ties& ties = flow_.ties();
  const Contact& contact = list()[c];
  const int now = sense(c);
  if (now == 0) {
    const Hold hold = ties.limits(c);
    consider(worst, (ties.torque(c) - hold.high) / contact.torque_scale - nothing, c, 1);
    consider(worst, (hold.low - ties.torque(c)) / contact.torque_scale - nothing, c, -1);
    return;
  }
  // A torque within round-off is not significant.
  const double push = sum_over(contact.motion, flow_.accelerations().data()) *
                      flow_.ties().effective_inertia(contact, flow_.effective_inertia()) / contact.torque_scale;
  consider(worst, -push * now - round_off, c, 0);
  if (!ties.lossy().empty() && std::abs(push) <= round_off && !gives_way(c, now, t)) consider(worst, 1, c, 0);
}

// Accelerations, and the torques of all ties, with a further torque along the slip.
void Contacts::push(std::size_t c, double torque, double t, std::vector<double>& alpha) {
  std::vector<double> pushed = flow_.free_torque();
  add_over(list()[c].motion, torque, pushed.data());
  flow_.ties().accelerate(t, pushed, flow_.inertia(), alpha.data());
}

// Whether a torque in this direction accelerates the slip. In a self-locking gear that turns back with its load, a larger
// torque increases the hold: a contact that releases at its limit does not slip this way. A contact held by another one
// has no response and releases nevertheless.
bool Contacts::gives_way(std::size_t c, int way, double t) {
  const Contact& contact = list()[c];
  const Ties::Torques known = flow_.ties().torques();
  const std::vector<double>& alpha = flow_.accelerations();
  std::vector<double> pushed = alpha;
  push(c, way * contact.torque_scale, t, pushed);
  flow_.ties().set_torques(known);
  double answer = 0, size = 0;
  for (const ShaftGain& g : contact.motion) {
    const double after = pushed[at(g.shaft)], before = alpha[at(g.shaft)];
    answer += way * g.gain * (after - before);
    size += std::abs(g.gain) * (std::abs(after) + std::abs(before));
  }
  return answer >= -round_off * size;
}

// Contacts with prescribed motion, momentarily at rest, slip in their next direction.
void Contacts::slip_as_given(double t, std::span<const double> y) {
  const Instant now = flow_.instant(t, y);
  for (std::size_t c = 0; c < list().size(); ++c) {
    if (!is_given(c) || std::abs(slip_speed(c, now) / list()[c].speed_scale) > nothing) continue;
    double v = 0;
    for (const ShaftGain& g : list()[c].motion)
      v += g.gain * prescribed_acceleration(flow_.model(), modes(), at(g.shaft), t);
    sense(c) = v > 0 ? 1 : v < 0 ? -1 : 0;
  }
}

void Contacts::settle(double t, std::span<double> y, const Changes& changes, EventLog* log) {
  if (list().empty()) return;
  slip_as_given(t, y);
  std::vector<int> before(list().size());
  std::set<std::size_t> open;
  for (std::size_t c = 0; c < list().size(); ++c) {
    before[c] = sense(c);
    if (is_open(c)) open.insert(c);
  }
  for (const std::size_t c : changes.stopped) open.insert(c), sense(c) = 0;
  std::vector<std::size_t> always(changes.stopped.begin(), changes.stopped.end());
  for (const auto& [c, direction] : changes.released) open.insert(c), always.push_back(c), sense(c) = direction;
  const std::vector<std::size_t> among(open.begin(), open.end());
  if (among.empty() && flow_.ties().lossy().empty()) return tie(t, y);
  if (!changes.stopped.empty()) tie_speeds(t, y);
  int count = 0;
  const bool fits = change_worst(t, y, among, count) || try_all(t, y, among, {});
  if (fits) release_otherwise(t, y, among, changes.released);
  if (!log) return;
  report(t, among, before, always, *log);
  if (always.size() < 2) return;
  log->push_back(modes_event(t, always.size(), fits, count));
}

// The largest misfit is changed until there is none. False: it cycles.
bool Contacts::change_worst(double t, std::span<const double> y, const std::vector<std::size_t>& among, int& changes) {
  std::set<std::vector<int>> seen;
  for (; changes < most_changes; ++changes) {
    const Misfit misfit = worst_misfit(t, y, among);
    if (misfit.size <= 0) return true;
    std::vector<int> tried;
    for (const std::size_t c : among) tried.push_back(sense(c));
    tried.insert(tried.end(), modes().loss_sign.begin(), modes().loss_sign.end());
    if (!seen.insert(tried).second) return false;
    if (misfit.contact < list().size())
      sense(misfit.contact) = misfit.better;
    else
      modes().loss_sign[misfit.contact - list().size()] = misfit.better;
  }
  return false;
}

// All sets for few contacts: the consistent one, else the nearest. Many contacts are unchanged; the fixed ones keep their
// direction.
bool Contacts::try_all(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                       const std::vector<std::size_t>& fixed) {
  const std::vector<int>& lossy = flow_.ties().lossy();
  std::vector<std::size_t> open;
  for (const std::size_t c : among)
    if (!std::count(fixed.begin(), fixed.end(), c)) open.push_back(c);
  if (open.size() > few_contacts || lossy.size() > few_contacts) return false;
  int sets = 1;
  for (std::size_t k = 0; k < open.size(); ++k) sets *= 3;
  for (std::size_t k = 0; k < lossy.size(); ++k) sets *= 2;
  const auto choose = [&](int set) {
    for (const std::size_t c : open) {
      const int which = set % 3;
      sense(c) = which == 0 ? 0 : which == 1 ? 1 : -1;
      set /= 3;
    }
    for (const int r : lossy) {
      modes().loss_sign[at(r)] = set % 2 == 0 ? 1 : -1;
      set /= 2;
    }
  };
  double least = HUGE_VAL;
  int best = 0;
  for (int set = 0; set < sets && least > 0; ++set) {
    choose(set);
    const double total = worst_misfit(t, y, among).total;
    if (total < least) least = total, best = set;
  }
  choose(best);
  worst_misfit(t, y, among);
  return least <= 0;
}

// At a breakaway the limit is exceeded only by round-off, so that sticking seems consistent. It is not if some set releases
// (for a self-locking gear: on its other flank). True: such a set was found and taken.
bool Contacts::release_otherwise(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                                 const std::vector<std::pair<std::size_t, int>>& released) {
  std::vector<std::size_t> fixed;
  for (const auto& [c, direction] : released)
    if (sense(c) == 0) fixed.push_back(c);
  if (fixed.empty()) return false;
  std::vector<int> senses;
  for (const std::size_t c : among) senses.push_back(sense(c));
  const std::vector<int> signs = modes().loss_sign;
  for (const auto& [c, direction] : released) sense(c) = direction;
  if (try_all(t, y, among, fixed)) return true;
  for (std::size_t k = 0; k < among.size(); ++k) sense(among[k]) = senses[k];
  modes().loss_sign = signs;
  worst_misfit(t, y, among);
  return false;
}

// ---------------------------------------------------------------------------------------------------------------------
// Jams

// Work account of the friction of this contact; −1: none.
int Contacts::account_of_friction(const Contact& contact) const {
  const Model& m = flow_.model();
  if (contact.kind == Contact::Kind::connection) return m.elastic[at(contact.index)].loss_account;
  if (contact.kind == Contact::Kind::loss) return m.relations[at(contact.index)].loss_account;
  int account = -1;
  for (const Network::ShaftElement& e : m.network.elements) {
    if (m.shaft_of_node[at(e.node)] != contact.index || !e.element->is.directional) continue;
    for (std::size_t k = 0; k < m.accounts.size(); ++k)
      if (m.accounts[k].name == e.component + ".joints") return static_cast<int>(k);
    if (account < 0) account = e.account;
  }
  return account;
}

std::vector<std::size_t> Contacts::jammed_contacts(std::span<const std::size_t> guards) const {
  std::vector<std::size_t> jammed;
  const auto add = [&](std::size_t c) {
    if (sense(c) != 0 && !modes().regularised[c] && !is_given(c)) jammed.push_back(c);
  };
  for (const std::size_t guard : guards)
    if (guard < guard_count()) add(contact_of(guard));
  if (guards.empty() && flow_.jam())
    for (std::size_t c = 0; c < list().size(); ++c)
      if (list()[c].kind == Contact::Kind::frame && list()[c].index == flow_.jam()->shaft) add(c);
  return jammed;
}

bool Contacts::stop_jam(double t, std::span<double> y, std::span<const std::size_t> guards, EventLog& log) {
  const Model& m = flow_.model();
  const Changes changes{.stopped = jammed_contacts(guards), .released = {}};
  if (changes.stopped.empty()) return false;
  const auto speed_of = [&](std::size_t s) { return y[flow_.speed_index(static_cast<int>(s))]; };
  std::vector<double> speed(m.free_shafts);
  for (std::size_t s = 0; s < m.free_shafts; ++s) speed[s] = speed_of(s);
  for (const std::size_t c : changes.stopped) sense(c) = 0;
  tie_speeds(t, y);
  double lost = 0;
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    lost += 0.5 * flow_.inertia()[s] * (speed[s] * speed[s] - std::pow(speed_of(s), 2));
  const int account = account_of_friction(list()[changes.stopped.front()]);
  if (flow_.audit() && account >= 0) y[flow_.work_index(at(account))] -= lost;
  for (const std::size_t c : changes.stopped) log.push_back(jam_event(t, list()[c]));
  settle(t, y, changes, &log);
  for (const auto& pool : m.pools) pool->follow_directions(flow_.instant(t, y), modes().piece.data());
  return true;
}

}  // namespace kurbel
