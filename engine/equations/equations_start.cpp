// equations_start.cpp — the state that a scene starts from: angles, twists in balance with the loads, modes.
#include "engine/equations/equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/equations/unloaded_motion.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr double at_rest = 1e-14;  // of the speed scale

// What a scene's start says of angles and twists; given angles of components stand beside the others' usual ones.
KnownMotion known_at_start(const Model& m, const StartSettings& start, int on) {
  KnownMotion known{.shaft = m.shaft_of_node[at(on)], .angle = start.angle / m.gain_of_node[at(on)]};
  known.twists.resize(m.elastic.size());
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const auto c = start.components.find(m.network.joints[at(m.elastic[i].joint)].component);
    if (c != start.components.end()) known.twists[i] = c->second.twist;
  }
  const double reduction_angle = start.angle / m.node_ratio[at(on)];
  for (const auto& [component, c] : start.components) {
    if (!c.angle) continue;
    if (known.angles.empty())
      for (const Shaft& shaft : m.shafts) known.angles.push_back(m.node_ratio[at(shaft.reference)] * reduction_angle);
    const int node = m.network.ports.at(component).in;
    known.angles[at(m.shaft_of_node[at(node)])] = *c.angle / m.gain_of_node[at(node)];
  }
  return known;
}

}  // namespace

// Angles of all shafts from the twists, outwards from the reduction link: φ_b = (gain_a φ_a − θ)/gain_b.
void Equations::set_shaft_angles(const double* twists, std::vector<double>& angles) const {
  for (const ElasticStep& step : elastic_steps_) {
    const ElasticJoint& e = model_->elastic[at(step.elastic)];
    if (step.forward) {
      angles[at(e.shaft_b)] = (e.gain_a * angles[at(e.shaft_a)] - twists[step.elastic]) / e.gain_b;
    } else {
      angles[at(e.shaft_a)] = (e.gain_b * angles[at(e.shaft_b)] + twists[step.elastic]) / e.gain_a;
    }
  }
}

// What it finds impossible is said where the scene tells of the start.
std::vector<double> Equations::start(double t, const StartSettings& settings) try {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0);
  const int on = settings.on.empty() ? m.reduction_node : m.network.ports.at(settings.on).in;
  const KnownMotion known = known_at_start(m, settings, on);
  UnloadedMotion unloaded = unloaded_motion(m, known);
  if (!known.angles.empty()) set_shaft_angles(unloaded.twist.data(), unloaded.angle);  // twists may be given, too
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * unloaded.angle[at(m.angles[i].shaft)];
  for (std::size_t i = 0; i < unloaded.twist.size(); ++i) y[twists_begin() + i] = unloaded.twist[i];
  const double speed_on = m.node_ratio[at(on)];
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[speed_index(static_cast<int>(s))] = settings.speed * unloaded.speed[s] / speed_on;
  std::vector<char> given(m.shafts.size(), 0);
  for (const auto& [component, c] : settings.components) {
    if (!c.speed) continue;
    const int node = m.network.ports.at(component).in;
    const int s = m.shaft_of_node[at(node)];
    if (at(s) < m.free_shafts) y[speed_index(s)] = *c.speed / m.gain_of_node[at(node)];
    given[at(s)] = 1;
  }
  members_follow(y, given, t);
  settle_modes(t, y, settings.equilibrium);
  return y;
} catch (const SceneError&) {
  throw;
} catch (const std::runtime_error& impossible) {
  const Scene& scene = model_->scene;
  if (scene.lines.empty()) throw;  // made by hand
  throw SceneError({{scene.file, settings.at.line > 0 ? settings.at : scene.lines.front().at,
                     fmt::format("[run]: start: {}", impossible.what())}});
}

std::vector<double> Equations::state_of(double t, double link_angle, std::span<const double> twists,
                                        std::span<const double> speeds) {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0), angles(m.shafts.size(), 0.0);
  const TrackedAngle& link = m.angles[at(m.reduction_angle)];
  angles[at(link.shaft)] = link_angle / link.gain;
  set_shaft_angles(twists.data(), angles);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * angles[at(m.angles[i].shaft)];
  std::copy(twists.begin(), twists.end(), y.begin() + static_cast<std::ptrdiff_t>(twists_begin()));
  std::copy(speeds.begin(), speeds.end(), y.begin() + static_cast<std::ptrdiff_t>(speed_index(0)));
  settle_modes(t, y, false);
  return y;
}

std::vector<double> Equations::shaft_angles_by_twist(std::size_t elastic) const {
  std::vector<double> twists(model_->elastic.size(), 0.0), angles(model_->shafts.size(), 0.0);
  twists[elastic] = 1;
  set_shaft_angles(twists.data(), angles);
  return angles;
}

// All modes anew for a state; turns are counted from here.
void Equations::settle_modes(double t, std::span<double> y, bool equilibrium) {
  const Model& m = *model_;
  std::fill(modes_.turns.begin(), modes_.turns.end(), 0.0);
  std::fill(modes_.piece.begin(), modes_.piece.end(),
            0);  // a law that lost its events in an earlier run has them again
  // Where several sets of modes fit, the search for one must not begin at what an earlier run ended with.
  std::fill(modes_.loss_sign.begin(), modes_.loss_sign.end(), 1);
  std::fill(relation_torque_.begin(), relation_torque_.end(), 0);
  std::fill(relation_loss_.begin(), relation_loss_.end(), 0);
  std::fill(contact_torque_.begin(), contact_torque_.end(), 0);
  wrap(y);
  if (sequence_.begin(modes_, t, y)) take_steps(t, y, nullptr);
  set_timed_modes(t);
  std::vector<std::size_t> still;
  const Instant now = instant(t, y);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double v = slip_speed(contacts_[c], now);
    sense(c) = std::abs(v) <= at_rest * contacts_[c].speed_scale ? 0 : v > 0 ? 1 : -1;
    modes_.regularised[c] = false;
    modes_.carries[c] = 0;
    if (sense(c) == 0 && !is_prescribed(contacts_[c])) still.push_back(c);
  }
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), modes_.piece.data());
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  if (equilibrium) balance_twists(y, t);
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  if (equilibrium && !following_.empty()) {
    evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
    for (const ElementPool* pool : following_)
      pool->balance(snapshot_.now, followed_alpha_.data(), y.data() + own_begin());
  }
  settle_contacts(t, y, still, {}, nullptr);
  refuse_impossible_slip(t, y);
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), modes_.piece.data());
}

// A contact that can only ever hold in the sense in which it slips: the sides would have to hit each other.
void Equations::refuse_impossible_slip(double t, std::span<const double> y) {
  if (contacts_.empty()) return;
  snapshot_.now = instant(t, y);
  find_holds();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (contacts_[c].kind == Contact::Kind::connection && sense(c) != 0 &&
        std::isinf(sense(c) > 0 ? limits(c).high : limits(c).low))
      throw std::runtime_error(
          fmt::format("\"{}\" cannot slip in the sense in which the machine starts ({:.6g} rad/s): its driving side "
                      "would have to be "
                      "no faster than its driven side. Start both sides at one speed",
                      contacts_[c].name, slip_speed(contacts_[c], snapshot_.now)));
}

// Speeds that relations demand of members whose speeds are not given. Where a relation leaves a choice, its first
// members keep the speeds of the usual motion.
void Equations::members_follow(std::span<double> y, std::vector<char> given, double t) {
  const Model& m = *model_;
  for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s) given[s] = 1;
  std::vector<const ShaftRelation*> open;
  for (const ShaftRelation& relation : m.relations) open.push_back(&relation);
  const auto unknown = [&](const ShaftRelation& relation) {
    return std::count_if(relation.motion.begin(), relation.motion.end(),
                         [&](const ShaftGain& g) { return !given[at(g.shaft)]; });
  };
  while (!open.empty()) {
    const auto next = std::min_element(open.begin(), open.end(),
                                       [&](const auto* a, const auto* b) { return unknown(*a) < unknown(*b); });
    const ShaftRelation& relation = **next;
    open.erase(next);
    double sum = 0;
    const ShaftGain* last = nullptr;
    for (const ShaftGain& g : relation.motion) {
      const bool is_free = at(g.shaft) < m.free_shafts;
      sum += g.gain * (is_free ? y[speed_index(g.shaft)] : prescribed_speed(at(g.shaft), t));
      if (!given[at(g.shaft)]) last = &g;
      given[at(g.shaft)] = 1;
    }
    if (last) {
      y[speed_index(last->shaft)] -= sum / last->gain;
    } else if (std::abs(sum) > 1e-9 * m.speed_scale) {
      throw std::runtime_error(fmt::format("the start speeds contradict \"{}\", which ties them; leave one of them out",
                                           m.network.relations[at(relation.relation)].component));
    }
  }
}

std::vector<double> Equations::modes_from_scratch(double t, double reduction_angle, double reduction_speed) {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * reduction_angle;
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[speed_index(static_cast<int>(s))] = reduction_speed * m.node_ratio[at(m.shafts[s].reference)];
  std::fill(modes_.turns.begin(), modes_.turns.end(), 0.0);
  wrap(y);
  set_timed_modes(t);
  const auto speed = [&](int s) { return reduction_speed * m.node_ratio[at(m.shafts[at(s)].reference)]; };
  for (const int s : directional_) modes_.direction[at(s)] = speed(s) > 0 ? 1 : speed(s) < 0 ? -1 : 0;
  for (std::size_t i = 0; i < m.elastic.size(); ++i) modes_.slip[i] = m.elastic[i].slips ? 0 : 1;  // clutches locked
  for (const int r : lossy_) {
    double sliding = 0;
    for (const ShaftGain& g : m.relations[at(r)].sliding) sliding += g.gain * speed(g.shaft);
    modes_.loss_direction[at(r)] = sliding >= 0 ? 1 : -1;
  }
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), modes_.piece.data());
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  snapshot_.now = instant(t, y);
  find_holds();
  find_capacities();
  tie_stuck_contacts();
  return y;
}

void Equations::modes_at(double t, std::span<const double> y) {
  for (const auto& pool : model_->pools) pool->first_modes(instant(t, y), modes_.piece.data());
}

// Twists that carry the torques which the rigid machine would have in this position: no artificial ring at the start.
// The machine as a whole may accelerate; all shafts then do so together.
void Equations::balance_twists(std::span<double> y, double t) {
  const Model& m = *model_;
  if (m.elastic.empty()) return;
  const Network& net = m.network;
  std::vector<double> rest(m.elastic.size(), 0.0);
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    if (m.network.joints[at(m.elastic[i].joint)].element->uses_angle()) rest[i] = y[twists_begin() + i];
    y[twists_begin() + i] = 0;
  }
  evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
  // Without twists the elements' torques alone remain; sum them over the whole machine.
  double torque = 0, inertia = 0;
  bool free = true;
  std::vector<double> need(net.nodes.size(), 0.0);
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    inertia += net.nodes[n].inertia * m.node_ratio[n] * m.node_ratio[n];
    free = free && (net.nodes[n].prescribed < 0 || m.node_ratio[n] == 0);  // the frame holds nothing that moves
  }
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const double ratio = m.node_ratio[at(net.elements[e].node)];
    torque += element_torque_[e] * ratio;
    inertia += element_inertia_[e] * ratio * ratio;
  }
  // At standstill the opposing elements may hold the machine.
  double hold_low = 0, hold_high = 0;
  std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
  std::fill(element_hold_.begin(), element_hold_.end(), Hold{});
  for (const auto& pool : m.pools) pool->add_holds(snapshot_.now, shaft_hold_.data(), element_hold_.data());
  const bool still = std::all_of(y.begin() + static_cast<std::ptrdiff_t>(speed_index(0)),
                                 y.begin() + static_cast<std::ptrdiff_t>(states_), [](double w) { return w == 0; });
  if (still)
    for (std::size_t e = 0; e < net.elements.size(); ++e) {
      const double ratio = m.node_ratio[at(net.elements[e].node)];
      hold_low += ratio * (ratio > 0 ? element_hold_[e].low : element_hold_[e].high);
      hold_high += ratio * (ratio > 0 ? element_hold_[e].high : element_hold_[e].low);
    }
  const double held = std::clamp(-torque, hold_low, hold_high);
  const double capacity = held > 0 ? hold_high : hold_low;
  const double acceleration = free ? (torque + held) / inertia : 0;  // of the reduction link
  for (std::size_t n = 0; n < net.nodes.size(); ++n) need[n] = net.nodes[n].inertia * m.node_ratio[n] * acceleration;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const std::size_t n = at(net.elements[e].node);
    need[n] += element_inertia_[e] * m.node_ratio[n] * acceleration - element_torque_[e];
    const bool upwards = (held > 0) == (m.node_ratio[n] > 0);  // on the element's own shaft
    if (still && capacity != 0) need[n] -= held / capacity * (upwards ? element_hold_[e].high : element_hold_[e].low);
  }
  const std::vector<double> joint_torque = balanced_joints(std::move(need));
  std::vector<double> twists(m.elastic.size());
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const int j = m.elastic[i].joint;
    twists[i] = net.joints[at(j)].element->twist_at(joint_torque[at(j)]);
    y[twists_begin() + i] = twists[i] + rest[i];
  }
  // Shafts away from the reduction link stand turned by the twists.
  std::vector<double> angles(m.shafts.size(), 0.0);
  set_shaft_angles(twists.data(), angles);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] += m.angles[i].gain * angles[at(m.angles[i].shaft)];
  wrap(y);
}

// Torques of the joints that give every node what it needs: summed from the leaves of the whole tree to a root that can
// take the rest (a prescribed motion, if there is one). A gear that runs counts as one without losses.
std::vector<double> Equations::balanced_joints(std::vector<double> need) const {
  const Model& m = *model_;
  const Network& net = m.network;
  struct Link {
    int a, b;
    double ratio;
  };
  std::vector<Link> links;
  for (const Network::Joint& joint : net.joints) links.push_back({joint.a, joint.b, joint.ratio});
  for (const Network::Relation& relation : net.relations) {
    if (relation.members() == 3 && relation.usual[2] != 0)
      throw std::runtime_error(
          fmt::format("the three shafts of \"{}\" are free, so it is not known which torques balance each other; start "
                      "without equilibrium",
                      relation.component));
    links.push_back({relation.node[0], relation.node[1], -relation.gain[1]});
  }
  std::vector<std::vector<int>> links_at(net.nodes.size());
  for (std::size_t j = 0; j < links.size(); ++j) {
    links_at[at(links[j].a)].push_back(static_cast<int>(j));
    links_at[at(links[j].b)].push_back(static_cast<int>(j));
  }
  struct Step {  // leaves last
    int link, child, parent;
    bool child_is_b;
  };
  std::vector<double> torque(links.size(), 0.0);
  std::vector<char> seen(net.nodes.size(), 0);
  const auto sum_to = [&](int root) {
    std::vector<Step> steps;
    std::vector<int> queue = {root};
    seen[at(root)] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const int j : links_at[at(queue[next])]) {
        const int other = links[at(j)].a == queue[next] ? links[at(j)].b : links[at(j)].a;
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        steps.push_back({j, other, queue[next], other == links[at(j)].b});
        queue.push_back(other);
      }
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const double ratio = links[at(step->link)].ratio, wanted = need[at(step->child)];
      torque[at(step->link)] = step->child_is_b ? wanted / ratio : -wanted;
      need[at(step->parent)] += step->child_is_b ? wanted / ratio : ratio * wanted;
    }
  };
  int root = m.reduction_node;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && m.node_ratio[n] != 0) root = static_cast<int>(n);
  sum_to(root);
  // Housings bear the reactions of their gears, towards the frame.
  for (std::size_t r = 0; r < net.relations.size(); ++r)
    if (net.relations[r].members() == 3)
      need[at(net.relations[r].node[2])] += net.relations[r].gain[2] * torque[net.joints.size() + r];
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && !seen[n]) sum_to(static_cast<int>(n));
  torque.resize(net.joints.size());
  return torque;
}

}  // namespace kurbel
