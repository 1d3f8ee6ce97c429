// start.cpp — a start: unloaded motion, twists in equilibrium with the loads, and consistent modes.
#include "engine/events/start.h"

#include "engine/events/reaction_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/elements/coupled_springs.h"
#include "engine/events/unloaded_motion.h"

namespace kurbel {
namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }
std::size_t shaft_of(const ShaftGain& g) { return index(g.shaft); }

constexpr double at_rest = 1e-14;   // of the speed scale
constexpr double balanced = 1e-14;  // change of a state in a pass, of its value
constexpr int most_passes = 30;

// Angles and twists of a scene's start; given angles of components are combined with the usual ones of the others.
KnownMotion known_at_start(const Model& m, const StartSettings& start, int on) {
  KnownMotion known{.shaft = m.shaft_of_node[index(on)], .angle = start.angle / m.gain_of_node[index(on)]};
  known.twists.resize(m.elastic.size());
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const auto c = start.components.find(m.network.joints[index(m.elastic[i].joint)].component);
    if (c == start.components.end() || !c->second.twist) continue;
    known.twists[i] = *c->second.twist * m.network.share_of_twist(m.network.joints[index(m.elastic[i].joint)]);
  }
  const double reduction_angle = start.angle / m.node_ratio[index(on)];
  for (const auto& [component, c] : start.components) {
    if (!c.angle) continue;
    if (known.angles.empty())
      for (const Shaft& shaft : m.shafts)
        known.angles.push_back(m.node_ratio[index(shaft.reference)] * reduction_angle);
    const int node = m.network.ports.at(component).in;
    known.angles[index(m.shaft_of_node[index(node)])] = *c.angle / m.gain_of_node[index(node)];
  }
  return known;
}

}  // namespace

// Errors are located at the start in the scene.
std::vector<double> Start::at(double t, const StartSettings& settings) try {
  const Model& m = model_;
  std::vector<double> y(flow_.size(), 0.0);
  const int on = settings.on.empty() ? m.reduction_node : m.network.ports.at(settings.on).in;
  const KnownMotion known = known_at_start(m, settings, on);
  UnloadedMotion unloaded = unloaded_motion(m, known);
  if (!known.angles.empty()) flow_.set_shaft_angles(unloaded.twist.data(), unloaded.angle);  // twists may be given
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * unloaded.angle[index(m.angles[i].shaft)];
  for (std::size_t i = 0; i < unloaded.twist.size(); ++i) y[flow_.twists_begin() + i] = unloaded.twist[i];
  const double speed_on = m.node_ratio[index(on)];
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[flow_.speed_index(static_cast<int>(s))] = settings.speed * unloaded.speed[s] / speed_on;
  std::vector<char> given(m.shafts.size(), 0);
  for (const auto& [component, c] : settings.components) {
    if (!c.speed) continue;
    const int node = m.network.ports.at(component).in;
    const int s = m.shaft_of_node[index(node)];
    if (index(s) < m.free_shafts) y[flow_.speed_index(s)] = *c.speed / m.gain_of_node[index(node)];
    given[index(s)] = 1;
  }
  members_follow(y, given, t);
  settle_modes(t, y, settings.equilibrium);
  return y;
} catch (const SceneError&) {
  throw;
} catch (const std::runtime_error& impossible) {
  const Scene& scene = model_.scene;
  if (scene.lines.empty()) throw;  // made by hand
  throw SceneError({{scene.file, settings.at.line > 0 ? settings.at : scene.lines.front().at,
                     fmt::format("[run]: start: {}", impossible.what())}});
}

std::vector<double> Start::with(double t, double link_angle, std::span<const double> twists,
                                std::span<const double> speeds) {
  const Model& m = model_;
  std::vector<double> y(flow_.size(), 0.0), angles(m.shafts.size(), 0.0);
  const TrackedAngle& link = m.angles[index(m.reduction_angle)];
  angles[index(link.shaft)] = link_angle / link.gain;
  flow_.set_shaft_angles(twists.data(), angles);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * angles[index(m.angles[i].shaft)];
  std::copy(twists.begin(), twists.end(), y.begin() + static_cast<std::ptrdiff_t>(flow_.twists_begin()));
  std::copy(speeds.begin(), speeds.end(), y.begin() + static_cast<std::ptrdiff_t>(flow_.speed_index(0)));
  settle_modes(t, y, false);
  return y;
}

std::vector<double> Start::rigid(double t, double link_angle, double link_speed) {
  const Model& m = model_;
  std::vector<double> y(flow_.size(), 0.0);
  const auto speed = [&](std::size_t s) { return link_speed * m.node_ratio[index(m.shafts[s].reference)]; };
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * link_angle;
  for (std::size_t s = 0; s < m.free_shafts; ++s) y[flow_.speed_index(static_cast<int>(s))] = speed(s);
  Modes& modes = flow_.changing_modes();
  std::fill(modes.turns.begin(), modes.turns.end(), 0.0);
  wrap(modes, y);
  switching_.set_timed_modes(t);
  for (const Contact& contact : flow_.ties().contacts()) {
    double sliding = 0;
    for (const ShaftGain& g : contact.motion) sliding += g.gain * speed(shaft_of(g));
    int& sense = sense_of(contact, modes);
    if (contact.kind == Contact::Kind::frame) sense = sliding > 0 ? 1 : sliding < 0 ? -1 : 0;
    if (contact.kind == Contact::Kind::connection) sense = 0;  // clutches locked
    if (contact.kind == Contact::Kind::loss) sense = sliding >= 0 ? 1 : -1;
  }
  first_pieces(t, y);
  first_states(t, y);
  contacts_.tie(t, y);
  return y;
}

void Start::first_pieces(double t, std::span<const double> y) {
  for (const auto& pool : model_.pools) pool->first_modes(flow_.instant(t, y), flow_.changing_modes().piece.data());
}

void Start::first_states(double t, std::span<double> y) {
  for (const auto& pool : model_.pools) pool->first_states(flow_.instant(t, y), y.data() + flow_.internal_begin());
}

// If several sets of modes are consistent, the search must not start from the end of an earlier run; a law that lost its
// events has them again. Turns are counted from here.
void Start::forget_earlier_modes() {
  Modes& modes = flow_.changing_modes();
  std::fill(modes.turns.begin(), modes.turns.end(), 0.0);
  std::fill(modes.piece.begin(), modes.piece.end(), 0);
  std::fill(modes.loss_sign.begin(), modes.loss_sign.end(), 1);
  flow_.ties().forget_torques();
}

// Directions by the speeds; returns the contacts at rest that may move.
std::vector<std::size_t> Start::senses_of_slip(double t, std::span<const double> y) {
  Modes& modes = flow_.changing_modes();
  const std::vector<Contact>& contacts = flow_.ties().contacts();
  std::vector<std::size_t> still;
  const Instant now = flow_.instant(t, y);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double v = sum_over(contacts[c].motion, now.speed);
    int& sense = sense_of(contacts[c], modes);
    sense = std::abs(v) <= at_rest * contacts[c].speed_scale ? 0 : v > 0 ? 1 : -1;
    modes.regularised[c] = false;
    if (sense == 0 && !is_prescribed(contacts[c], model_)) still.push_back(c);
  }
  return still;
}

void Start::settle_modes(double t, std::span<double> y, bool equilibrium) {
  forget_earlier_modes();
  wrap(flow_.changing_modes(), y);
  switching_.begin(t, y);
  const Contacts::Changes changes{.stopped = senses_of_slip(t, y), .released = {}};
  first_pieces(t, y);
  first_states(t, y);
  if (equilibrium) balance_twists(y, t);
  first_states(t, y);
  // Deforming parts and the accelerations that load them depend on each other.
  const auto balance_followers = [&] {
    if (!equilibrium || !flow_.has_followers()) return;
    const auto states = y.subspan(flow_.internal_begin(), flow_.state_count() - flow_.internal_begin());
    std::vector<double> before;
    for (int pass = 0; pass < most_passes; ++pass) {
      before.assign(states.begin(), states.end());
      flow_.evaluate(t, y);
      flow_.balance_followers(states.data());
      const bool stays = std::equal(states.begin(), states.end(), before.begin(), [](double now, double earlier) {
        return std::abs(now - earlier) <= balanced * std::abs(now);
      });
      if (stays) return;
    }
  };
  balance_followers();
  contacts_.settle(t, y, changes, nullptr);
  balance_followers();  // by the accelerations of what is held now
  refuse_impossible_slip(t, y);
  first_pieces(t, y);
  OpenSides(flow_).settle(t, y);
}

// Rejects a contact that can only hold in the direction in which it slips: its sides would collide.
void Start::refuse_impossible_slip(double t, std::span<const double> y) {
  const std::vector<Contact>& contacts = flow_.ties().contacts();
  if (contacts.empty()) return;
  flow_.look(t, y);
  flow_.ties().find_holds(flow_.now());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].kind != Contact::Kind::connection) continue;
    const int sense = sense_of(contacts[c], flow_.modes());
    const Hold hold = flow_.ties().limits(c);
    if (sense == 0 || !std::isinf(sense > 0 ? hold.high : hold.low)) continue;
    throw std::runtime_error(fmt::format(
        "\"{}\" cannot slip in the sense in which the machine starts ({:.6g} rad/s): its driving side would "
        "have to be no faster than its driven side. Start both sides at one speed",
        contacts[c].name, sum_over(contacts[c].motion, flow_.now().speed)));
  }
}

// Speeds by the relations for members without given speeds. If a relation leaves a choice, its first members keep the
// speeds of the usual motion.
void Start::members_follow(std::span<double> y, std::vector<char> given, double t) {
  const Model& m = model_;
  const auto speed_at = [&](int shaft) -> double& { return y[flow_.speed_index(shaft)]; };
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) given[s] = 1;
  std::vector<const ShaftRelation*> open;
  for (const ShaftRelation& relation : m.relations) open.push_back(&relation);
  const auto unknown = [&](const ShaftRelation& relation) {
    return std::count_if(relation.motion.begin(), relation.motion.end(),
                         [&](const ShaftGain& g) { return !given[shaft_of(g)]; });
  };
  while (!open.empty()) {
    const auto next = std::min_element(open.begin(), open.end(),
                                       [&](const auto* a, const auto* b) { return unknown(*a) < unknown(*b); });
    const ShaftRelation& relation = **next;
    open.erase(next);
    double sum = 0;
    const ShaftGain* last = nullptr;
    for (const ShaftGain& g : relation.motion) {
      const bool is_free = shaft_of(g) < m.free_shafts;
      sum += g.gain * (is_free ? speed_at(g.shaft) : prescribed_speed(m, flow_.modes(), shaft_of(g), t));
      if (!given[shaft_of(g)]) last = &g;
      given[shaft_of(g)] = 1;
    }
    if (last) {
      speed_at(last->shaft) -= sum / last->gain;
    } else if (std::abs(sum) > 1e-9 * m.speed_scale) {
      throw std::runtime_error(fmt::format("the start speeds contradict \"{}\", which ties them; leave one of them out",
                                           m.network.relations[index(relation.relation)].component));
    }
  }
}

// φ_a of a joint whose law depends on it; 0 for others.
double Start::turn_of(int joint, std::span<const double> y) const {
  const Network::Joint& of = model_.network.joints[index(joint)];
  if (!of.element->is.uses_angle) return 0;
  const int shaft = model_.shaft_of_node[index(of.a)];
  const double gain = model_.gain_of_node[index(of.a)];
  const auto tracked = std::find_if(model_.angles.begin(), model_.angles.end(), [&](const TrackedAngle& angle) {
    return angle.shaft == shaft && angle.gain == gain;
  });
  return y[static_cast<std::size_t>(tracked - model_.angles.begin())];
}

// Twists for the torques of the rigid machine in this position: no artificial vibration at the start. The machine as a
// whole may accelerate, with all shafts together. If a law depends on the angle of its shaft, this angle depends on the
// twists: Newton's method, joint by joint, along the tree of elastic joints.
void Start::balance_twists(std::span<double> y, double t) {
  const Model& m = model_;
  if (m.elastic.empty()) return;
  const std::size_t first = flow_.twists_begin(), joints = m.elastic.size();
  const std::vector<double> unloaded(y.begin(), y.end());
  std::vector<double> twist(unloaded.begin() + static_cast<std::ptrdiff_t>(first),
                            unloaded.begin() + static_cast<std::ptrdiff_t>(first + joints));
  std::vector<double> locked_in(joints), by_own_twist(joints, 0.0), share(m.network.joints.size(), 1.0);
  const auto element = [&](std::size_t i) -> const AnyConnection& {
    return *m.network.joints[index(m.elastic[i].joint)].element;
  };
  bool by_angle = false;
  for (std::size_t i = 0; i < joints; ++i) {
    const double turn = turn_of(m.elastic[i].joint, y);
    locked_in[i] = twist[i] - element(i).rest_twist(turn);
    share[index(m.elastic[i].joint)] = element(i).share_of_a(0, turn);
    if (!element(i).is.uses_angle) continue;
    by_angle = true;
    by_own_twist[i] = m.elastic[i].gain_a * flow_.shaft_angles_by_twist(i)[index(m.elastic[i].shaft_a)];
  }
  flow_.look(t, y);
  const Together at_first = moving_together(y);
  constexpr int most_passes = 50;
  constexpr double found = 1e-15, near_enough = 1e-10;  // [rad]
  double largest = 0, before = HUGE_VAL, stored = 0;
  for (int pass = 0; pass < most_passes; ++pass, before = largest) {
    std::fill_n(y.begin() + static_cast<std::ptrdiff_t>(first), joints, 0.0);
    flow_.evaluate(t, y);
    const std::vector<double> torque = balanced_joints(m, needs_when_balanced(y, t, stored), locked_in, share);
    std::vector<double> turned(joints), angles(m.shafts.size(), 0.0);
    largest = 0;
    for (std::size_t i = 0; i < joints; ++i) {
      const int j = m.elastic[i].joint;
      const double turn = turn_of(j, y);
      const AnyConnection& e = element(i);
      const double loaded = e.row ? e.row->twist_at(e.row_part, &torque[index(j) - index(e.row_part)])
                                  : e.twist_at(torque[index(j)], turn);
      const double target = loaded + e.rest_twist(turn);
      const double step = (target - twist[i]) / (1 + (element(i).rest_ratio(turn) - 1) * by_own_twist[i]);
      twist[i] = element(i).is.uses_angle ? twist[i] + step : target;
      largest = std::max(largest, std::abs(step));
      turned[i] = twist[i] - unloaded[first + i];
    }
    // Shafts away from the reduction link are rotated by the twists.
    flow_.set_shaft_angles(turned.data(), angles);
    for (std::size_t i = 0; i < m.angles.size(); ++i)
      y[i] = unloaded[i] + m.angles[i].gain * angles[index(m.angles[i].shaft)];
    std::copy(twist.begin(), twist.end(), y.begin() + static_cast<std::ptrdiff_t>(first));
    turn_together(unloaded, at_first, y);
    if (!by_angle || largest <= found || (largest <= near_enough && largest >= 0.5 * before)) break;
    stored = 0;
    const Together now = moving_together(y);
    for (std::size_t i = 0; i < joints; ++i) {
      const std::size_t j = index(m.elastic[i].joint);
      const double turn = turn_of(m.elastic[i].joint, y);
      share[j] = element(i).share_of_a(torque[j], turn);
      stored += now.ratio[index(m.network.joints[j].a)] * torque[j] * (share[j] - element(i).rest_ratio(turn));
    }
  }
  if (by_angle && !(largest <= near_enough))
    throw std::runtime_error("no twists were found that carry the loads in this position; start without equilibrium");
  wrap(flow_.changing_modes(), y);
}

// Speed ratios of all nodes to the reduction link in this position.
Start::Together Start::moving_together(std::span<const double> y) const {
  const Model& m = model_;
  Together together{m.node_ratio, std::vector<double>(m.network.nodes.size(), 0.0)};
  if (std::none_of(m.elastic.begin(), m.elastic.end(),
                   [&](const ElasticJoint& e) { return m.network.joints[index(e.joint)].element->is.turns_unevenly; }))
    return together;
  KnownMotion known{.shaft = m.shaft_of_node[index(m.reduction_node)]};
  known.angles.resize(m.shafts.size());
  for (std::size_t i = 0; i < m.angles.size(); ++i)
    known.angles[index(m.angles[i].shaft)] = flow_.angle_with_turns(i, y) / m.angles[i].gain;
  known.angle = known.angles[index(known.shaft)];
  const UnloadedMotion motion = unloaded_motion(m, known);
  const double speed = m.gain_of_node[index(m.reduction_node)] * flow_.now().speed[known.shaft];
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n) {
    const std::size_t s = index(m.shaft_of_node[n]);
    together.ratio[n] = m.gain_of_node[n] * motion.speed[s];
    together.kept[n] = m.gain_of_node[n] * motion.bend[s] * speed * speed;
  }
  return together;
}

// Shafts that moved with the reduction link in the previous position do so in the present one.
void Start::turn_together(std::span<const double> before, const Together& then, std::span<double> y) const {
  const Model& m = model_;
  const double link =
      m.gain_of_node[index(m.reduction_node)] * flow_.now().speed[index(m.shaft_of_node[index(m.reduction_node)])];
  const Together now = moving_together(y);
  for (std::size_t s = 0; s < m.free_shafts; ++s) {
    const std::size_t i = flow_.speed_index(static_cast<int>(s)), n = index(m.shafts[s].reference);
    if (now.ratio[n] != then.ratio[n] && std::abs(before[i] - then.ratio[n] * link) <= 1e-12 * std::abs(before[i]))
      y[i] = now.ratio[n] * link;
  }
}

// Torque that every node needs from its joints [N·m] when all shafts accelerate together, at the last evaluated state, which
// must have no twists: only torques of elements act. `stored`: torque of angle-dependent springs on the reduction link by
// their stored energy.
std::vector<double> Start::needs_when_balanced(std::span<const double> y, double t, double stored) {
  const Model& m = model_;
  const Network& net = m.network;
  const std::vector<double>&element_torque = flow_.element_torque(), &element_inertia = flow_.element_inertia();
  const Together together = moving_together(y);
  const std::vector<double>& ratio = together.ratio;
  double torque = -stored, inertia = 0;
  std::optional<double> given;  // acceleration of the reduction link, where a motion is prescribed
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    inertia += net.nodes[n].inertia * ratio[n] * ratio[n];
    torque -= net.nodes[n].inertia * together.kept[n] * ratio[n];
    if (net.nodes[n].prescribed < 0 || ratio[n] == 0) continue;  // the frame does not drive
    const std::size_t s = index(m.shaft_of_node[n]);
    const double own = m.gain_of_node[n] * prescribed_acceleration(m, flow_.modes(), s, t);
    given = (own - together.kept[n]) / ratio[n];
  }
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const std::size_t n = index(net.elements[e].node);
    torque += (element_torque[e] - element_inertia[e] * together.kept[n]) * ratio[n];
    inertia += element_inertia[e] * ratio[n] * ratio[n];
  }
  // At standstill the opposing elements may hold the machine.
  double hold_low = 0, hold_high = 0;
  flow_.ties().find_holds(flow_.now());
  const std::vector<Hold>& hold = flow_.ties().element_hold();
  const bool still =
      std::all_of(y.begin() + static_cast<std::ptrdiff_t>(flow_.speed_index(0)),
                  y.begin() + static_cast<std::ptrdiff_t>(flow_.state_count()), [](double w) { return w == 0; });
  for (std::size_t e = 0; still && e < net.elements.size(); ++e) {
    const double r = ratio[index(net.elements[e].node)];
    hold_low += r * (r > 0 ? hold[e].low : hold[e].high);
    hold_high += r * (r > 0 ? hold[e].high : hold[e].low);
  }
  const double held = std::clamp(-torque, hold_low, hold_high);
  const double capacity = held > 0 ? hold_high : hold_low;
  const double acceleration = given ? *given : (torque + held) / inertia;  // of the reduction link
  std::vector<double> need(net.nodes.size());
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    need[n] = net.nodes[n].inertia * ratio[n] * acceleration + net.nodes[n].inertia * together.kept[n];
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const std::size_t n = index(net.elements[e].node);
    need[n] += element_inertia[e] * ratio[n] * acceleration - element_torque[e] + element_inertia[e] * together.kept[n];
    const bool upwards = (held > 0) == (ratio[n] > 0);  // on the element's own shaft
    if (still && capacity != 0) need[n] -= held / capacity * (upwards ? hold[e].high : hold[e].low);
  }
  return need;
}

}  // namespace kurbel
