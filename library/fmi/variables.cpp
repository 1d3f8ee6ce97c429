// variables.cpp — names, units and meanings of all variables; what derivatives depend on.
#include "library/fmi/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace kurbel {
namespace {

std::string unit_of_state(const Flow& flow, std::size_t state) {
  const Model& m = flow.model();
  if (state < flow.speed_index(0)) return "rad";  // angles, twists
  return state < flow.own_begin() ? "rad/s" : m.own_states[state - flow.own_begin()].state.unit;
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
    const bool torque = in.what == ExportedInput::What::torque;
    variables.push_back({input, k, in.name, torque ? "N*m" : "",
                         torque ? fmt::format("torque on {}, positive in its positive sense", in.of)
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

ExportedDependencies dependencies_of(const ExportedMachine& machine, Flow& flow) {
  const Model& m = flow.model();
  const std::size_t states = flow.state_count();
  const SparsityPattern& pattern = flow.jacobian_pattern();
  std::vector<char> zero(states * states, 1);
  for (std::size_t column = 0; column < states; ++column)
    for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      if (const auto row = static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)]); row < states)
        zero[row * states + column] = 0;
  ExportedDependencies all{std::vector<std::vector<std::size_t>>(states),
                           std::vector<std::vector<std::size_t>>(states)};
  for (std::size_t row = 0; row < states; ++row) {
    for (std::size_t column = 0; column < states; ++column) {
      const bool diagonal_of_angle = row == column && row < flow.twists_begin();  // stored, and 0: its rate is a speed
      if (!zero[row * states + column] && !diagonal_of_angle) all.states[row].push_back(column);
    }
    const bool kinematic = row < flow.twists_begin();
    for (std::size_t k = 0; k < machine.inputs.size(); ++k) {
      // Where the input acts: shafts of the component's elements and joints, and its own states.
      bool depends = false;
      const auto touches = [&](int shaft) {
        const auto s = static_cast<std::size_t>(shaft);
        if (s < m.free_shafts && row >= flow.speed_index(0))
          depends = depends || !zero[row * states + flow.speed_index(shaft)];
      };
      const std::string target = machine.inputs[k].target();
      for (const Network::ShaftElement& e : m.network.elements)
        if (e.component == target) touches(m.shaft_of_node[static_cast<std::size_t>(e.node)]);
      for (const ElasticJoint& joint : m.elastic)
        if (m.network.joints[static_cast<std::size_t>(joint.joint)].component == target)
          touches(joint.shaft_a), touches(joint.shaft_b);
      if (row >= flow.own_begin()) depends = depends || m.own_states[row - flow.own_begin()].component == target;
      if (depends && !kinematic) all.inputs[row].push_back(k);
    }
  }
  return all;
}

}  // namespace kurbel
