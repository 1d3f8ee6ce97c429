// variables.cpp — names, units and meanings of all variables; what derivatives depend on.
#include "library/fmi/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "library/fmi/ports.h"

namespace kurbel {
namespace {

std::string unit_of_state(const Flow& flow, std::size_t state) {
  const Model& m = flow.model();
  if (state < flow.speed_index(0)) return "rad";  // angles, twists
  return state < flow.internal_begin() ? "rad/s" : m.internal_states[state - flow.internal_begin()].state.unit;
}
std::string unit_of_rate(const std::string& unit) {
  if (unit == "rad/s") return "rad/s2";
  if (unit == "m/s") return "m/s2";
  return unit.empty() || unit == "1" ? "1/s" : unit + "/s";
}

template <class T, class Name>
const T& named(const std::vector<T>& all, const std::string& wanted, const char* what, const Name& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return name(one) == wanted; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const T& one : all) names.push_back(name(one));
  throw std::invalid_argument(fmt::format("the machine has no {} {}{}; there are {}", what, in_quotes(wanted),
                                          suggestion(wanted, names),
                                          names.empty() ? "none" : shortened_list(names, "and")));
}

}  // namespace

ExportedView::ExportedView(const ExportedMachine& machine, const Equations& flow) {
  using enum ExportedVariable::Role;
  const Model& m = flow.model();
  const std::vector<Channel> channels = channels_of(m, m.network.components);
  for (const std::string& name : machine.outputs)
    outputs.push_back(named(channels, name, "output", [](const Channel& c) { return c.name.text; }));
  if (!machine.peaks.empty()) {
    const std::vector<ExtremeOf> extremes = extremes_of(m);
    for (const std::string& name : machine.peaks)
      peaks.push_back(named(extremes, name, "peak", [](const ExtremeOf& e) { return e.name.text; }));
  }
  variables.push_back({time, 0, "time", "s", "time"});
  for (std::size_t k = 0; k < machine.inputs.size(); ++k) {
    const ExportedInput& in = machine.inputs[k];
    const bool torque = in.what == ExportedInput::What::torque, speed = in.what == ExportedInput::What::speed;
    variables.push_back({input, k, in.name,
                         torque  ? "N*m"
                         : speed ? "rad/s"
                                 : "",
                         torque  ? fmt::format("torque on {}, positive in its positive sense", in.of)
                         : speed ? fmt::format("speed of {}, reached at the end of a communication step", in.of)
                                 : fmt::format("command of {}, in the place of an operating sequence", in.of)});
  }
  for (std::size_t k = 0; k < machine.parameters.size(); ++k)
    variables.push_back(
        {parameter, k, machine.parameters[k].path, machine.parameters[k].unit, machine.parameters[k].doc});
  for (std::size_t k = 0; k < outputs.size(); ++k)
    variables.push_back({output, k, machine.outputs[k], outputs[k].unit, ""});
  for (std::size_t k = 0; k < peaks.size(); ++k)
    variables.push_back({peak, k, machine.peaks[k], peaks[k].unit, "extreme within the last communication step"});
  std::map<std::string, int> times;  // several parts of a shaft have one name
  std::vector<std::string> states;
  for (std::size_t k = 0; k < flow.state_count(); ++k) {
    const std::string name = flow.state_name(k);
    const int before = times[name]++;
    states.push_back(before == 0 ? name : fmt::format("{} ({})", name, before + 1));
    variables.push_back({state, k, "state: " + states[k], unit_of_state(flow, k), ""});
  }
  for (std::size_t k = 0; k < flow.state_count(); ++k)
    variables.push_back({derivative, k, "derivative: " + states[k], unit_of_rate(unit_of_state(flow, k)), ""});
  for (std::size_t k = 0; k < flow.guard_count(); ++k)
    variables.push_back({indicator, k, fmt::format("indicator {}: {}", k + 1, flow.guard_owner(k)), "",
                         "falls through zero where a law changes"});
}

std::uint32_t ExportedView::reference(ExportedVariable::Role role, std::size_t place) const {
  const auto is = [&](const ExportedVariable& v) { return v.role == role && v.place == place; };
  return static_cast<std::uint32_t>(std::find_if(variables.begin(), variables.end(), is) - variables.begin());
}

namespace {

// Rows of the states' derivatives that something reaches at once.
class Reach {
 public:
  explicit Reach(Flow& flow)
      : flow_(flow), m_(flow.model()), states_(flow.state_count()), stored_(states_ * states_, 0) {
    const SparsityPattern& pattern = flow.jacobian_pattern();
    for (std::size_t column = 0; column < states_; ++column)
      for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
        if (const std::size_t row = row_of(k); row < states_) stored_[row * states_ + column] = 1;
  }
  bool stored(std::size_t row, std::size_t column) const { return stored_[row * states_ + column] != 0; }

  // A torque on the shaft: its acceleration, those that constraints mix it with, internal states that follow them.
  void torque_on(int shaft, std::vector<char>& rows) const {
    if (at(shaft) >= m_.free_shafts) return;
    const std::size_t own = flow_.speed_index(shaft);
    rows[own] = 1;
    for (const JacobianLayout::Coupled& all : m_.jacobian.coupled)
      if (std::count(all.shafts.begin(), all.shafts.end(), shaft))
        for (const int other : all.shafts) rows[flow_.speed_index(other)] = 1;
    for (std::size_t row = flow_.speed_index(0); row < states_; ++row)
      if (stored(row, own)) rows[row] = 1;
  }
  // What a component does to its shafts, and to states of its own.
  void component(const std::string& name, std::vector<char>& rows) const {
    for (const Network::ShaftElement& e : m_.network.elements)
      if (e.component == name) torque_on(m_.shaft_of_node[at(e.node)], rows);
    for (const ElasticJoint& joint : m_.elastic)
      if (m_.network.joints[at(joint.joint)].component == name)
        torque_on(joint.shaft_a, rows), torque_on(joint.shaft_b, rows);
    for (std::size_t k = 0; k < m_.internal_states.size(); ++k)
      if (m_.internal_states[k].component == name) rows[flow_.internal_begin() + k] = 1;
  }
  // The speed and acceleration of a shaft that are given.
  void given_speed(int shaft, std::vector<char>& rows) const {
    for (std::size_t k = 0; k < m_.angles.size(); ++k)
      if (m_.angles[k].shaft == shaft) rows[k] = 1;
    for (std::size_t k = 0; k < m_.elastic.size(); ++k)
      if (m_.elastic[k].shaft_a == shaft || m_.elastic[k].shaft_b == shaft) {
        rows[flow_.twists_begin() + k] = 1;
        component(m_.network.joints[at(m_.elastic[k].joint)].component, rows);
      }
    for (const Network::ShaftElement& e : m_.network.elements)
      if (m_.shaft_of_node[at(e.node)] == shaft) component(e.component, rows);
    for (const ShaftRelation& relation : m_.relations)
      if (std::any_of(relation.motion.begin(), relation.motion.end(), [&](const auto& g) { return g.shaft == shaft; }))
        for (const ShaftGain& g : relation.motion) torque_on(g.shaft, rows);
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  std::size_t row_of(std::int64_t k) const {
    return static_cast<std::size_t>(flow_.jacobian_pattern().row[static_cast<std::size_t>(k)]);
  }
  Flow& flow_;
  const Model& m_;
  std::size_t states_;
  std::vector<char> stored_;
};

void add(std::vector<std::size_t>& all, std::size_t one) {
  const auto place = std::lower_bound(all.begin(), all.end(), one);
  if (place == all.end() || *place != one) all.insert(place, one);
}

// Speeds of a shaft, twists: on these states alone. What else there is may depend on anything.
ExportedDependency on_states(const Flow& flow, const Channel& channel, const ExportedMachine& machine) {
  const Model& m = flow.model();
  ExportedDependency found;
  const auto shaft = [&](int s) {
    if (static_cast<std::size_t>(s) < m.free_shafts) return add(found.states, flow.speed_index(s));
    const std::string& follows =
        m.network.prescribed[static_cast<std::size_t>(m.shafts[static_cast<std::size_t>(s)].prescribed)].follows;
    found.time = found.time || follows.empty();
    for (std::size_t k = 0; k < machine.inputs.size(); ++k)
      if (machine.inputs[k].target() == follows) add(found.inputs, k);
  };
  if (channel.name.what == quantities::speed) {
    shaft(m.shaft_of_node[static_cast<std::size_t>(node_of(m.network, channel.name.of))]);
    return found;
  }
  const auto is = [&](const TorqueJoint& joint) { return joint.component == channel.name.of; };
  const auto joint = std::find_if(m.torque_joints.begin(), m.torque_joints.end(), is);
  if (joint == m.torque_joints.end() || joint->elastic < 0) return {.known = false};
  if (channel.name.what == quantities::twist) {
    for (int k = joint->first; k <= joint->last; ++k)
      add(found.states, flow.twists_begin() + static_cast<std::size_t>(k));
    return found;
  }
  const ElasticJoint& elastic = m.elastic[static_cast<std::size_t>(joint->elastic)];
  const AnyConnection& element = *m.network.joints[static_cast<std::size_t>(elastic.joint)].element;
  const bool spring = (channel.name.what == quantities::torque || channel.name.what == quantities::spring_torque) &&
                      element.is.has_spring() && element.is.states == 0 && !element.is.uses_angle &&
                      !element.is.commanded && !element.row && joint->reported.weight.empty();
  if (channel.name.what != quantities::slip && !spring) return {.known = false};
  if (spring) add(found.states, flow.twists_begin() + static_cast<std::size_t>(joint->elastic));
  shaft(elastic.shaft_a), shaft(elastic.shaft_b);
  return found;
}

}  // namespace

ExportedDependencies dependencies_of(const ExportedMachine& machine, const ExportedView& view, Flow& flow) {
  const Model& m = flow.model();
  const std::size_t states = flow.state_count();
  const Reach reach(flow);
  std::vector<std::vector<char>> by_input;
  std::vector<char> by_time(states, 0);
  const auto given_speeds = [&](const std::string& follows, std::vector<char>& rows) {
    for (std::size_t s = m.free_shafts; s < m.shafts.size(); ++s)
      if (m.network.prescribed[static_cast<std::size_t>(m.shafts[s].prescribed)].follows == follows)
        reach.given_speed(static_cast<int>(s), rows);
  };
  for (const ExportedInput& input : machine.inputs) {
    by_input.emplace_back(states, 0);
    reach.component(input.target(), by_input.back());
    if (input.what == ExportedInput::What::speed) given_speeds(input.target(), by_input.back());
  }
  given_speeds("", by_time);
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->uses_time) reach.component(e.component, by_time);
  for (const SequenceStep& step : m.scene.sequence.steps)  // ramps, laws
    for (const std::string& set : step.set)
      if (step.over > 0 || !step.law.empty()) reach.component(set.substr(0, set.find('.')), by_time);
  ExportedDependencies all;
  for (std::size_t row = 0; row < states; ++row) {
    ExportedDependency one{.time = by_time[row] != 0};
    for (std::size_t column = 0; column < states; ++column) {
      const bool diagonal_of_angle = row == column && row < flow.twists_begin();  // stored, and 0: its rate is a speed
      if (reach.stored(row, column) && !diagonal_of_angle) one.states.push_back(column);
    }
    for (std::size_t k = 0; k < by_input.size(); ++k)
      if (by_input[k][row]) one.inputs.push_back(k);
    all.derivatives.push_back(std::move(one));
  }
  for (const Channel& channel : view.outputs) all.outputs.push_back(on_states(flow, channel, machine));
  return all;
}

}  // namespace kurbel
