// compile.cpp — merges what is rigidly joined: from the machine as drawn to its smallest set of coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "engine/model/build_component.h"
#include "engine/model/cycle_of.h"
#include "engine/model/model.h"
#include "engine/model/no_element.h"
#include "engine/model/relations.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Nodes that hang together rigidly, each with its speed relative to the first of them.
struct Merging {
  std::vector<int> group;
  std::vector<double> gain;  // ω_node / ω_first
  int groups = 0;
};

// Relations that a walk goes through, in their usual motion: to every member, or to those only that turn in it (not to
// a gearbox's housing).
enum class Through { none, turning, all };

// Walks the joints that `is_rigid` admits, and the relations in their usual motion where they are asked for.
template <class IsRigid>
Merging merge(const Network& network, IsRigid is_rigid, Through relations = Through::none) {
  const std::size_t n = network.nodes.size();
  std::vector<std::vector<std::size_t>> joints_at(n);
  for (std::size_t j = 0; j < network.joints.size(); ++j)
    if (is_rigid(network.joints[j])) {
      joints_at[at(network.joints[j].a)].push_back(j);
      joints_at[at(network.joints[j].b)].push_back(j);
    }
  std::vector<std::vector<const Network::Relation*>> relations_at(n);
  const auto is_walked = [&](const Network::Relation& relation, int k) {
    return relations == Through::all || (relations == Through::turning && relation.usual[at(k)] != 0);
  };
  for (const Network::Relation& relation : network.relations)
    for (int k = 0; k < relation.members(); ++k)
      if (is_walked(relation, k)) relations_at[at(relation.node[at(k)])].push_back(&relation);
  Merging merging{std::vector<int>(n, -1), std::vector<double>(n, 1.0), 0};
  for (std::size_t first = 0; first < n; ++first) {
    if (merging.group[first] >= 0) continue;
    Deadline::check();
    std::vector<std::size_t> queue = {first};
    merging.group[first] = merging.groups;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const std::size_t node = queue[next];
      for (const std::size_t j : joints_at[node]) {
        const Network::Joint& joint = network.joints[j];
        const bool from_a = at(joint.a) == node;
        const std::size_t other = at(from_a ? joint.b : joint.a);
        if (merging.group[other] >= 0) continue;
        merging.group[other] = merging.groups;
        merging.gain[other] = from_a ? merging.gain[node] / joint.ratio : merging.gain[node] * joint.ratio;
        queue.push_back(other);
      }
      for (const Network::Relation* relation : relations_at[node]) {
        const auto own = static_cast<std::size_t>(
            std::find(relation->node.begin(), relation->node.end(), static_cast<int>(node)) - relation->node.begin());
        for (int k = 0; k < relation->members(); ++k) {
          const std::size_t other = at(relation->node[at(k)]);
          if (merging.group[other] >= 0 || !is_walked(*relation, k)) continue;
          merging.group[other] = merging.groups;
          const double usual = relation->usual[own];
          merging.gain[other] =
              usual == 0 ? relation->usual[at(k)] : merging.gain[node] * relation->usual[at(k)] / usual;
          queue.push_back(other);
        }
      }
    }
    ++merging.groups;
  }
  return merging;
}

class Compiler {
 public:
  Compiler(Network network, const Scene& scene, const Effects& effects) : messages_(scene.file) {
    model_.network = std::move(network);
    model_.scene = scene;
    model_.effects = effects;
  }

  std::shared_ptr<const Model> compile() {
    check_tree();
    choose_reduction_node();
    find_node_ratios();
    switch_connections();
    settle_relative_damping();
    switch_effects();
    model_.gear_torques = simplify_relations(net(), model_.effects, standing_nodes());
    make_shafts();
    make_elastic_joints();
    model_.relations = relations_over_shafts(model_);
    check_inertias();
    find_scales();
    find_cycle();
    track_angles();
    place_elements();
    list_torque_joints();
    messages_.throw_if_any();
    model_.jacobian = lay_out_jacobian(model_);
    return std::make_shared<const Model>(std::move(model_));
  }

 private:
  Network& net() { return model_.network; }
  Location location_of(const std::string& component) const {
    const Section* section = model_.scene.find(component);
    return section ? section->at : Location{};
  }

  // Of what is wrong with the machine as a whole.
  Location location_of_line() const { return model_.scene.lines.empty() ? Location{} : model_.scene.lines.front().at; }

  void check_tree() {
    if (net().nodes.empty()) throw SceneError({{model_.scene.file, location_of_line(), "the machine has no shaft"}});
    check_sizes();
    const Merging all = merge(
        net(), [](const Network::Joint&) { return true; }, Through::all);
    const Merging joined = merge(net(), [](const Network::Joint&) { return true; });
    const bool loop = net().joints.size() + at(joined.groups) != net().nodes.size();
    if (all.groups > 1 || loop || !relations_are_independent(net(), joined.group))
      throw SceneError(
          {{model_.scene.file, location_of_line(),
            "the shafts do not form a tree: a part is unconnected or a loop is closed; check the lines and branches"}});
  }

  // Compiling takes time in proportion to the shafts, and to the cube of the relations between their speeds.
  void check_sizes() {
    constexpr std::size_t most_shafts = 1'000'000, most_relations = 1000;
    const auto refuse = [&](const std::string& component, const std::string& text) {
      throw SceneError({{model_.scene.file, location_of(component), text}});
    };
    if (net().nodes.size() > most_shafts)
      refuse(net().nodes[most_shafts].component,
             fmt::format("the machine has {} shaft ends; must be at most {}; give fewer segments or components",
                         net().nodes.size(), most_shafts));
    if (net().relations.size() > most_relations)
      refuse(net().relations[most_relations].component,
             fmt::format("the machine has {} gears with losses, planetary gears and gears in housings; must be at most "
                         "{}; give some of the gears without losses",
                         net().relations.size(), most_relations));
  }

  // The reduction link is the crank of the first mechanism, else the first shaft of the line.
  void choose_reduction_node() {
    for (std::size_t e = 0; e < net().elements.size(); ++e)
      if (net().elements[e].element->cycle() > 0) {
        model_.reduction_node = net().elements[e].node;
        model_.cycle = net().elements[e].element->cycle();
        model_.reduction_element = static_cast<int>(e);
        return;
      }
  }

  void find_node_ratios() {
    const Merging all = merge(
        net(), [](const Network::Joint&) { return true; }, Through::all);
    model_.node_ratio = all.gain;
    const double reduction = all.gain[at(model_.reduction_node)];
    for (double& ratio : model_.node_ratio) ratio /= reduction == 0 ? 1 : reduction;
    for (const double ratio : model_.node_ratio) model_.scale_ratio.push_back(ratio == 0 ? 1 : std::abs(ratio));
    // Inertias count by their squares.
    constexpr double farthest = 1e30;
    for (std::size_t n = 0; n < net().nodes.size(); ++n) {
      const double ratio = model_.scale_ratio[n];
      if (ratio <= farthest && ratio >= 1 / farthest) continue;
      const std::string& component = net().nodes[n].component;
      messages_.add(
          location_of(component),
          fmt::format("\"{}\" turns {:.3g} times as fast as \"{}\"; must be within {:g} … {:g}; check the "
                      "ratios between them",
                      component, ratio, net().nodes[at(model_.reduction_node)].component, 1 / farthest, farthest));
      messages_.throw_if_any();
    }
  }

  // A damping ratio refers to the two inertias that the element joins when every elastic element is flexible, whatever
  // effects are on: 1/J_red = 1/J_a + i²/J_b.
  void settle_relative_damping() {
    const Merging finest = merge(
        net(), [](const Network::Joint& joint) { return !joint.element; }, Through::turning);
    std::vector<double> inertia(at(finest.groups), 0.0);
    for (std::size_t n = 0; n < net().nodes.size(); ++n)
      inertia[at(finest.group[n])] +=
          net().nodes[n].prescribed >= 0 ? HUGE_VAL : net().nodes[n].inertia * finest.gain[n] * finest.gain[n];
    for (const Network::ShaftElement& e : net().elements)
      inertia[at(finest.group[at(e.node)])] +=
          e.element->mean_inertia() * finest.gain[at(e.node)] * finest.gain[at(e.node)];
    for (Network::Joint& joint : net().joints) {
      if (!joint.element) continue;
      const auto own = [&](int node) {
        return inertia[at(finest.group[at(node)])] / (finest.gain[at(node)] * finest.gain[at(node)]);
      };
      const double compliance = 1 / own(joint.a) + joint.ratio * joint.ratio / own(joint.b);
      joint.element->settle(compliance > 0 && std::isfinite(compliance) ? 1 / compliance : 0.0);
    }
  }

  // Connections in the form that the effects leave them.
  void switch_connections() {
    for (Network::Joint& joint : net().joints)
      if (joint.element)
        if (auto changed = joint.element->with(model_.effects)) joint.element = std::move(changed);
  }

  void switch_effects() {
    const std::set<std::string> elastic(model_.effects.elastic.begin(), model_.effects.elastic.end());
    for (Network::Joint& joint : net().joints) {
      if (joint.element && (joint.element->slips() || joint.element->springless())) {
        joint.elastic = !model_.effects.locked;
        if (!joint.elastic)
          model_.merged.push_back(
              fmt::format("\"{}\" counts as locked; the shafts on either side are one", joint.component));
        continue;
      }
      joint.elastic = joint.element && (model_.effects.all_elastic || elastic.count(joint.component) > 0);
      if (joint.element && !joint.elastic &&
          (model_.merged.empty() || model_.merged.back().find("\"" + joint.component + "\"") == std::string::npos))
        model_.merged.push_back(fmt::format(
            "\"{}\" is rigid because its elasticity is off; the shafts on either side are one", joint.component));
    }
    if (model_.effects.locked) release_brakes();
    bool any = false;
    for (Network::ShaftElement& e : net().elements) try {
        if (auto changed = e.element->with(model_.effects)) {
          any = any || e.element->cycle() > 0;
          e.element = std::move(changed);
        }
      } catch (const std::invalid_argument& cannot) {  // effects that it cannot have together
        messages_.add(location_of(e.component), fmt::format("\"{}\": {}", e.component, cannot.what()));
      }
    for (std::size_t e = net().elements.size(); e-- > 0;)
      if (net().elements[e].element == no_element()) {
        net().elements.erase(net().elements.begin() + static_cast<std::ptrdiff_t>(e));
        if (static_cast<int>(e) < model_.reduction_element) --model_.reduction_element;
      }
    if (model_.effects.joint_friction && !any)
      messages_.add(location_of_line(),
                    "joint_friction is on, but no joint of a slider-crank has friction; give its main_bearing, "
                    "crank_pin, slider_pin or guide a coefficient, or switch the effect off");
  }

  // Nodes that are rigidly tied to a shaft whose speed is prescribed as nothing: to the frame.
  std::vector<char> standing_nodes() {
    const Merging merging = merge(net(), [](const Network::Joint& joint) { return !joint.elastic; });
    std::vector<char> stands(at(merging.groups), 0), of_node;
    for (std::size_t n = 0; n < net().nodes.size(); ++n)
      if (net().nodes[n].prescribed >= 0 && net().prescribed[at(net().nodes[n].prescribed)].is_nothing())
        stands[at(merging.group[n])] = 1;
    for (std::size_t n = 0; n < net().nodes.size(); ++n) of_node.push_back(stands[at(merging.group[n])]);
    return of_node;
  }

  // With clutches locked the machine runs: what the operating sequence brakes with is released, and the sequence is
  // over.
  void release_brakes() {
    std::set<std::string> told;
    for (const SequenceStep& step : model_.scene.sequence.steps) told.insert(step.set.begin(), step.set.end());
    model_.scene.sequence.steps.clear();
    std::erase_if(net().elements, [&](const Network::ShaftElement& e) {
      const bool brake = told.count(e.component) && e.element->directional() && e.element->commanded();
      if (brake) model_.merged.push_back(fmt::format("\"{}\" counts as released", e.component));
      return brake;
    });
  }

  void make_shafts() {
    const Merging merging = merge(net(), [](const Network::Joint& joint) { return !joint.elastic; });
    std::vector<Shaft> groups(at(merging.groups));
    for (std::size_t n = 0; n < net().nodes.size(); ++n)
      groups[at(merging.group[n])].nodes.push_back(static_cast<int>(n));
    for (Shaft& shaft : groups) {
      shaft.reference = shaft.nodes.front();
      for (const int n : shaft.nodes) {
        if (net().nodes[at(n)].prescribed < 0) continue;
        if (shaft.prescribed >= 0)
          messages_.add(location_of(net().nodes[at(n)].component),
                        fmt::format("\"{}\" prescribes the speed of a shaft whose speed \"{}\" prescribes already; "
                                    "keep one, or put an elastic coupling between them",
                                    net().nodes[at(n)].component, net().nodes[at(shaft.reference)].component));
        shaft.prescribed = net().nodes[at(n)].prescribed;
        shaft.reference = n;
      }
    }
    for (const Network::ShaftElement& e : net().elements) {
      Shaft& shaft = groups[at(merging.group[at(e.node)])];
      if (e.element->cycle() > 0 && !shaft.variable) {
        shaft.variable = true;
        if (shaft.prescribed < 0) shaft.reference = e.node;
      }
      shaft.directional = shaft.directional || e.element->directional();
    }
    for (Shaft& shaft : groups) {
      if (shaft.prescribed < 0 && std::count(shaft.nodes.begin(), shaft.nodes.end(), model_.reduction_node))
        shaft.reference = model_.reduction_node;
      const double reference = merging.gain[at(shaft.reference)];
      for (const int n : shaft.nodes) {
        const double gain = merging.gain[at(n)] / reference;
        shaft.inertia += net().nodes[at(n)].inertia * gain * gain;
      }
    }
    // Free shafts first, so that their speeds stand side by side in the state.
    std::vector<std::size_t> order(groups.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return groups[i].prescribed < 0; });
    model_.shaft_of_node.assign(net().nodes.size(), 0);
    model_.gain_of_node.assign(net().nodes.size(), 1);
    for (const std::size_t i : order) {
      if (groups[i].prescribed < 0) ++model_.free_shafts;
      for (const int n : groups[i].nodes) {
        model_.shaft_of_node[at(n)] = static_cast<int>(model_.shafts.size());
        model_.gain_of_node[at(n)] = merging.gain[at(n)] / merging.gain[at(groups[i].reference)];
      }
      model_.shafts.push_back(std::move(groups[i]));
    }
    for (Shaft& shaft : model_.shafts) shaft.mean_inertia = shaft.inertia;
    for (const Network::ShaftElement& e : net().elements) {
      const double gain = model_.gain_of_node[at(e.node)];
      model_.shafts[at(model_.shaft_of_node[at(e.node)])].mean_inertia += e.element->mean_inertia() * gain * gain;
    }
  }

  void make_elastic_joints() {
    for (std::size_t j = 0; j < net().joints.size(); ++j) {
      const Network::Joint& joint = net().joints[j];
      if (!joint.elastic) continue;
      model_.elastic.push_back({static_cast<int>(j), model_.shaft_of_node[at(joint.a)],
                                model_.shaft_of_node[at(joint.b)], model_.gain_of_node[at(joint.a)],
                                joint.ratio * model_.gain_of_node[at(joint.b)], 1e-4, joint.element->slips(),
                                joint.element->springless()});
    }
  }

  void check_inertias() {
    const std::vector<int> undefined = shafts_without_motion(model_);
    for (std::size_t s = 0; s < model_.free_shafts; ++s) {
      const Shaft& shaft = model_.shafts[s];
      if (shaft.variable && shaft.mean_inertia > 0) check_dead_centres(shaft);
    }
    for (const int s : undefined) {
      const Shaft& shaft = model_.shafts[at(s)];
      std::set<std::string> names;
      for (const int n : shaft.nodes) names.insert(model_.node_label(n));
      messages_.add(location_of(net().nodes[at(shaft.nodes.front())].component),
                    fmt::format("the shaft at {} has no inertia (0 kg·m²), {}so its motion is undefined; give a "
                                "component there an inertia (a coupling: inertia_in, inertia_out){}",
                                listed({names.begin(), names.end()}, "and"), ties_of_massless(s),
                                model_.elastic.empty() ? "" : ", or switch the elasticity beside it off"));
    }
    messages_.throw_if_any();
  }

  // Why what ties a shaft without inertia to others does not give it its motion: they have none either, or it may slip.
  std::string ties_of_massless(int shaft) const {
    std::string text;
    for (const ShaftRelation& relation : model_.relations)
      if (std::any_of(relation.motion.begin(), relation.motion.end(),
                      [&](const ShaftGain& g) { return g.shaft == shaft && g.gain != 0; }))
        text += fmt::format("\"{}\" ties it to a shaft without inertia, ",
                            model_.network.relations[at(relation.relation)].component);
    for (const ElasticJoint& e : model_.elastic)
      if (e.slips && (e.shaft_a == shaft || e.shaft_b == shaft))
        text += fmt::format("\"{}\" may slip, ", model_.network.joints[at(e.joint)].component);
    return text;
  }

  // A mechanism whose crank is massless may have no inertia to offer it at a dead centre, where its acceleration is
  // infinite.
  void check_dead_centres(const Shaft& shaft) {
    const Network::ShaftElement* mechanism = nullptr;
    double least = shaft.inertia;
    for (const Network::ShaftElement& e : net().elements) {
      if (!std::count(shaft.nodes.begin(), shaft.nodes.end(), e.node) || e.element->cycle() == 0) continue;
      if (mechanism) return;  // several mechanisms stand at different angles
      mechanism = &e;
      const double gain = model_.gain_of_node[at(e.node)];
      least += e.element->least_inertia() * gain * gain;
    }
    if (mechanism && least < 1e-9 * shaft.mean_inertia)
      messages_.add(location_of(mechanism->component),
                    fmt::format("\"{}\" has no inertia {}, so the crank's motion is undefined; give it a crank_inertia",
                                mechanism->component,
                                mechanism->element->own_states().empty()
                                    ? "at a dead centre (its output stands still there)"
                                    : "while its rod flies free of the crank or stands at a dead centre"));
  }

  // All mechanisms are back in place, each at its own ratio; where none of a few turns does it, the link's own cycle.
  void find_cycle() {
    if (model_.cycle == 0) return;
    if (const auto [angle, periodic] = cycle_of(model_); periodic) model_.cycle = angle;
  }

  // What the stiffest elastic joint bears at a small twist, on the link [N·m].
  double torque_of_a_small_twist() const {
    constexpr double small = 1e-3;  // [rad]
    double torque = 0;
    for (const ElasticJoint& e : model_.elastic) {
      const Network::Joint& joint = model_.network.joints[at(e.joint)];
      torque = std::max(torque, joint.element->stiffness() * small * model_.scale_ratio[at(joint.a)]);
    }
    return torque;
  }
  // Rated speed and torque, carried to the reduction link and from there to every shaft.
  void find_scales() {
    double speed = 0, torque = 0, resisting = 0, inertia = 0;
    for (std::size_t n = 0; n < net().nodes.size(); ++n)
      inertia += net().nodes[n].inertia * model_.node_ratio[n] * model_.node_ratio[n];
    for (const Network::ShaftElement& e : net().elements) {
      const double ratio = model_.scale_ratio[at(e.node)];
      const Rated rated = e.element->rated();
      speed = std::max(speed, std::abs(rated.speed) / ratio);
      double& sum = e.element->account() == Account::driving ? torque : resisting;
      sum = std::max(sum, std::abs(rated.torque) * ratio);
      inertia += e.element->mean_inertia() * ratio * ratio;
    }
    for (std::size_t n = 0; n < net().nodes.size(); ++n) {
      if (net().nodes[n].prescribed < 0) continue;
      const PrescribedSpeed& given = net().prescribed[at(net().nodes[n].prescribed)];
      for (const double s : given.speed) speed = std::max(speed, std::abs(s / model_.scale_ratio[n]));
      speed = std::max(speed, std::abs(given.amplitude / model_.scale_ratio[n]));
    }
    const StartSettings& start = model_.scene.run.start;
    const auto speed_of = [&](const std::string& component, double value) {
      const int node = component.empty() ? model_.reduction_node : net().ports.at(component).in;
      speed = std::max(speed, std::abs(value / model_.scale_ratio[at(node)]));
    };
    if (start.speed != 0) speed_of(start.on, start.speed);
    for (const auto& [component, given] : start.components)
      if (given.speed) speed_of(component, *given.speed);
    if (torque == 0) torque = resisting;  // nothing drives: the loads set the scale
    if (speed == 0 && torque > 0) speed = std::sqrt(2 * torque * 2 * std::numbers::pi / inertia);  // after one turn
    if (speed == 0) speed = 1;
    if (torque == 0) torque = 0.5 * inertia * speed * speed;  // kinetic energy per radian
    if (torque == 0) torque = torque_of_a_small_twist();      // all motions are given
    torque = std::max(torque, 1e-12);
    check_scales(speed, torque);
    model_.speed_scale = speed;
    model_.torque_scale = torque;
    for (Shaft& shaft : model_.shafts) {
      const double ratio = model_.scale_ratio[at(shaft.reference)];
      shaft.speed_scale = speed * ratio;
      shaft.torque_scale = torque / ratio;
    }
    for (ElasticJoint& e : model_.elastic) {
      const Network::Joint& joint = net().joints[at(e.joint)];
      const double stiffness = joint.element->stiffness();
      if (e.slips || e.springless) e.twist_scale = 1;
      if (stiffness > 0) e.twist_scale = torque / model_.scale_ratio[at(joint.a)] / stiffness;
    }
  }

  // Squares of them must be numbers, too.
  void check_scales(double speed, double torque) {
    constexpr double beyond_reason = 1e100;
    if (speed < beyond_reason && torque < beyond_reason) return;
    std::string largest = net().components.front();
    double most = -1;
    for (const Network::ShaftElement& e : net().elements) {
      const Rated rated = e.element->rated();
      const double size = std::max(std::abs(rated.torque), std::abs(rated.speed));
      if (size > most) most = size, largest = e.component;
    }
    messages_.add(location_of(largest),
                  fmt::format("the machine's torques reach {:.3g} N·m and its speeds {:.3g} rad/s; both must be below "
                              "{:g}; check the values and units of \"{}\"",
                              torque, speed, beyond_reason, largest));
    messages_.throw_if_any();
  }

  int tracked(int node) {
    const int shaft = model_.shaft_of_node[at(node)];
    const double gain = model_.gain_of_node[at(node)];
    for (std::size_t i = 0; i < model_.angles.size(); ++i)
      if (model_.angles[i].shaft == shaft && model_.angles[i].gain == gain) return static_cast<int>(i);
    model_.angles.push_back({node, shaft, gain});
    return static_cast<int>(model_.angles.size()) - 1;
  }
  void track_angles() {
    model_.reduction_angle = tracked(model_.reduction_node);
    for (const int node : loose_trees(model_)) tracked(node);
    for (const SequenceStep& step : model_.scene.sequence.steps)
      model_.trigger_angle.push_back(step.when == SequenceStep::When::angle ? tracked(net().ports.at(step.of).in) : -1);
  }

  // A component that the sequence sets: its place among the commands, or −1.
  int command_of(const std::string& component) {
    const auto is = [&](const CommandTarget& target) { return target.component == component; };
    const auto known = std::find_if(model_.commands.begin(), model_.commands.end(), is);
    return known == model_.commands.end() ? -1 : static_cast<int>(known - model_.commands.begin());
  }
  void list_commands() {
    for (const SequenceStep& step : model_.scene.sequence.steps)
      for (const std::string& component : step.set)
        if (command_of(component) < 0) model_.commands.push_back({component, {}, {}});
  }
  int own_places(const std::string& component, const std::vector<OwnState>& states) {
    const int first = static_cast<int>(model_.own_states.size());
    for (const OwnState& state : states) model_.own_states.push_back({component, state});
    return first;
  }

  int account(const std::string& name, Account kind) {
    model_.accounts.push_back({name, kind});
    return static_cast<int>(model_.accounts.size()) - 1;
  }

  void place_elements() {
    list_commands();
    PoolSet pools;
    std::string last;
    int loss = -1;
    for (std::size_t i = 0; i < model_.elastic.size(); ++i) {
      Deadline::check();
      ElasticJoint& e = model_.elastic[i];
      const Network::Joint& joint = net().joints[at(e.joint)];
      if (joint.component != last || loss < 0) loss = account(joint.component, Account::harmful);
      last = joint.component;
      e.loss_account = loss;
      ConnectionExtras extras{.own = own_places(joint.component, joint.element->own_states()),
                              .component = joint.component};
      if (joint.element->has_modes()) extras.mode = static_cast<int>(model_.mode_slots++);
      if (joint.element->commanded()) extras.command = command_of(joint.component);
      if (joint.element->uses_angle()) extras.angle = tracked(joint.a);
      joint.element->place(pools, {static_cast<int>(i), e.shaft_a, e.shaft_b, e.gain_a, e.gain_b, loss}, extras);
    }
    for (ShaftRelation& relation : model_.relations)
      if (net().relations[at(relation.relation)].lossy)
        relation.loss_account = account(net().relations[at(relation.relation)].component, Account::harmful);
    for (std::size_t i = 0; i < net().elements.size(); ++i) {
      Deadline::check();
      Network::ShaftElement& e = net().elements[i];
      ShaftPorts ports{.id = static_cast<int>(i),
                       .shaft = model_.shaft_of_node[at(e.node)],
                       .gain = model_.gain_of_node[at(e.node)]};
      if (e.element->uses_angle()) {
        ports.angle = tracked(e.node);
        ports.phase = e.phase;
      }
      ports.mode = static_cast<int>(model_.mode_slots);
      model_.mode_slots += at(e.element->mode_count());
      ports.own = own_places(e.component, e.element->own_states());
      ports.command = command_of(e.component);
      if (ports.command >= 0 && !e.element->commanded())
        model_.commands[at(ports.command)].switched.push_back(static_cast<int>(i));
      if (ports.command >= 0 && e.element->opens_at_zero())
        model_.commands[at(ports.command)].opened.push_back(static_cast<int>(i));
      ports.account = e.account = account(e.component, e.element->account());
      for (const auto& [name, kind] : e.element->further_accounts()) account(name, kind);
      e.element->place(pools, ports, {e.window, e.component});
    }
    for (const Network::Node& node : net().nodes)
      if (node.prescribed >= 0) account(node.component, Account::driving);
    check_sequence();
    model_.pools = pools.release();
    for (const auto& pool : model_.pools) pool->add_channels(model_.pool_channels);
  }

  // What a component does not understand it must not be told.
  void check_sequence() {
    for (const SequenceStep& step : model_.scene.sequence.steps)
      for (const std::string& component : step.set) {
        bool any = false, reversible = true;
        for (const Network::ShaftElement& e : net().elements)
          if (e.component == component) any = true, reversible = reversible && e.element->reversible();
        for (const Network::Joint& joint : net().joints)
          if (joint.component == component && joint.element && joint.element->commanded())
            any = true, reversible = false;
        if (!any)
          messages_.add(step.at, fmt::format("[sequence]: \"{}\" has nothing that can be set; name a motor, a load, a "
                                             "clutch or a brake",
                                             component));
        else if (step.to < 0 && !reversible)
          messages_.add(step.at, fmt::format("[sequence]: \"{}\" cannot be reversed, to = {:g}; must be ≥ 0 (only "
                                             "electric motors without a starter can)",
                                             component, step.to));
      }
  }

  void list_torque_joints() {
    std::map<std::string, int> segments, seen;
    for (const Network::Joint& joint : net().joints)
      if (joint.element) ++segments[joint.component];
    int elastic = 0;
    for (std::size_t j = 0; j < net().joints.size(); ++j) {
      const Network::Joint& joint = net().joints[j];
      if (!joint.element) continue;
      const int index = joint.elastic ? elastic++ : -1;
      const int total = segments[joint.component], k = ++seen[joint.component];
      if (total > 20 && k != 1 && k != total) continue;  // both ends of a long chain
      const std::string name = !joint.label.empty() ? joint.component + "." + joint.label
                               : total == 1         ? joint.component
                                                    : fmt::format("{}.{}", joint.component, k);
      model_.torque_joints.push_back(
          {name, static_cast<int>(j), index, model_.torque_scale / model_.scale_ratio[at(joint.a)]});
    }
  }

  Model model_;
  Messages messages_;
};

}  // namespace

std::string Model::node_label(int node) const {
  const Network::Node& n = network.nodes[static_cast<std::size_t>(node)];
  return n.label.empty() ? n.component : n.component + "." + n.label;
}

double GearTorque::value(const double* joint_torque, const double* relation_torque, const double* relation_loss) const {
  double sum = 0;
  for (const Term& term : terms) {
    if (term.joint >= 0)
      sum += term.taken * joint_torque[term.joint];
    else
      sum += term.taken * relation_torque[term.relation] + term.lost * relation_loss[term.relation];
  }
  return sum;
}

bool Model::has_contacts() const {
  return !relations.empty() ||
         std::any_of(elastic.begin(), elastic.end(), [](const ElasticJoint& e) { return e.slips; });
}

std::string Model::explain() const {
  const std::size_t twists = elastic.size();
  std::string text = fmt::format("effects on: {}\n", effects.describe());
  text += fmt::format("coordinates: {} = {} shaft speed{}{}; angles kept: {} (turns apart from the remainder)\n",
                      free_shafts + twists, free_shafts, free_shafts == 1 ? "" : "s",
                      twists ? fmt::format(" + {} twist{}", twists, twists == 1 ? "" : "s") : "", angles.size());
  text += fmt::format("reduction link: {}\n", node_label(reduction_node));
  const std::size_t shown = 40;
  for (std::size_t s = 0; s < shafts.size() && s < shown; ++s) {
    const Shaft& shaft = shafts[s];
    std::string names;
    for (std::size_t i = 0; i < shaft.nodes.size() && i < 24; ++i) {
      const double gain = gain_of_node[static_cast<std::size_t>(shaft.nodes[i])];
      names += (i ? ", " : "") + node_label(shaft.nodes[i]) + (gain == 1 ? "" : fmt::format(" (×{:.6g})", gain));
    }
    text +=
        fmt::format("  shaft {}: {}{}; on {}: {}\n", s + 1, with_unit(shaft.mean_inertia, "kg*m2"),
                    shaft.variable ? " (mean; varies with the crank angle)" : "", node_label(shaft.reference), names);
    if (shaft.prescribed >= 0) text += "    its speed is prescribed\n";
  }
  if (shafts.size() > shown) text += fmt::format("  … and {} more shafts\n", shafts.size() - shown);
  for (std::size_t i = 0; i < elastic.size() && i < shown; ++i) {
    const Network::Joint& joint = network.joints[static_cast<std::size_t>(elastic[i].joint)];
    if (elastic[i].slips) {
      text += fmt::format("  slip of {}: carries {} before it slips\n", joint.component,
                          with_unit(joint.element->capacity(), "N*m"));
    } else if (elastic[i].springless) {
      text += fmt::format("  slip of {}\n", joint.component);
    } else {
      text += fmt::format("  twist of {}: k = {}, c = {}\n", joint.component,
                          with_unit(joint.element->stiffness(), "N*m/rad"),
                          with_unit(joint.element->damping(), "N*m*s/rad"));
    }
    if (const std::string words = joint.element->describe(); !words.empty()) text += "    " + words + "\n";
  }
  for (const Network::Relation& relation : network.relations) {
    text += fmt::format("  \"{}\" ties {} speeds at run time{}\n", relation.component, relation.members(),
                        relation.lossy ? ", with losses" : "");
    if (relation.lossy && !relation.words.empty()) text += "    " + relation.words + "\n";
  }
  for (const OwnStatePlace& own : own_states)
    text += fmt::format("  state of its own: {} of {}\n", own.state.name, own.component);
  for (const Network::ShaftElement& e : network.elements)
    if (const std::string words = e.element->describe(); !words.empty()) text += "  " + words + "\n";
  for (const std::string& line : merged) text += "  merged: " + line + "\n";
  for (const Network::Joint& joint : network.joints)
    if (!joint.element && joint.ratio != 1)
      text +=
          fmt::format("  merged: gear of \"{}\", ratio {:.6g}; inertias behind it count by the square of the ratio\n",
                      joint.component, joint.ratio);
  return text;
}

Network build_network(const Scene& scene) {
  Network network;
  Messages messages(scene.file);
  for (const Section& section : scene.components) {
    network.components.push_back(section.name);
    build_component(section, network, messages);
  }
  messages.throw_if_any();
  const auto port_named = [&](const std::string& from) {
    const std::size_t dot = from.find('.');
    const Network::Ports& ports = network.ports.at(from.substr(0, dot));
    if (dot != std::string::npos)
      if (const auto other = ports.others.find(from.substr(dot + 1)); other != ports.others.end()) return other->second;
    return dot != std::string::npos && from.substr(dot + 1) == "in" ? ports.in : ports.out;
  };
  for (const Line& line : scene.lines) {
    int end = line.from.empty() ? -1 : port_named(line.from);
    for (const std::string& name : line.names) {
      const Network::Ports& ports = network.ports.at(name);
      if (end >= 0) network.join(end, ports.in, 1, "");
      end = ports.out;
    }
  }
  return network;
}

std::shared_ptr<const Model> compile_network(Network network, const Scene& scene, const Effects& effects) {
  return Compiler(std::move(network), scene, effects).compile();
}

std::shared_ptr<const Model> compile(const Scene& scene, const Effects& effects) {
  return compile_network(build_network(scene), scene, effects);
}

}  // namespace kurbel
