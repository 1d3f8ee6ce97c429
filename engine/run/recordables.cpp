// recordables.cpp — what can be recorded of a model: channels for its trajectory, quantities whose peaks count.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/elements/coupled_springs.h"
#include "engine/numerics/index.h"
#include "engine/numerics/lobatto_element.h"
#include "engine/run/recorders.h"

namespace kurbel {
namespace {

bool is_wanted(const std::vector<std::string>& wanted, const std::string& component) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), component) != wanted.end();
}
// "crank" of "crank.pin"
std::string component_of(const std::string& part) { return part.substr(0, part.find('.')); }

// Both ends of a long machine stand for the rest.
std::vector<std::string> default_components(const Model& model) {
  const std::vector<std::string>& all = model.network.components;
  if (all.size() <= 60) return {};
  return {all.front(), all.back()};
}

// A trajectory is held in memory: 2 GB at most.
void refuse_too_many(const Scene& scene, std::size_t channels) {
  const double needed = 1e-9 * sizeof(double) * scene.run.samples * static_cast<double>(channels);
  if (needed <= 2) return;
  throw SceneError({{scene.file, scene.run.method_at,
                     fmt::format("[run]: samples = {} of {} quantities take {:.2g} GB; must be at most 2 GB: fewer "
                                 "samples, or the components that matter in output",
                                 scene.run.samples, channels, needed)}});
}

// --- channels, and their peaks over a run ---

Channel torque_of(const TorqueJoint& joint) {
  return {Name::make(quantities::torque, joint.component), "N*m",
          [joint](const Snapshot& s) { return joint.torque(s.joint_torque); }};
}
Channel spring_torque_of(const TorqueJoint& joint) {
  return {Name::make(quantities::spring_torque, joint.component), "N*m",
          [joint](const Snapshot& s) { return joint.reported(s.sums.spring_torque, joint.elastic); }};
}
Channel torque_of(const GearTorque& torque) {
  return {Name::make(quantities::torque, torque.name), "N*m",
          [torque](const Snapshot& s) { return torque.value(s.joint_torque, s.relation_torque, s.relation_loss); }};
}
Channel internal_state(const Model& model, std::size_t k) {
  const auto& [component, state] = model.internal_states[k];
  return {Name::own(state.name, component), state.unit, [k](const Snapshot& s) { return s.now.own[k]; }};
}

ExtremeOf peak_of(Channel channel, double scale = 0) {
  return {.name = channel.name.peak(),
          .unit = std::move(channel.unit),
          .scale = scale,
          .value = std::move(channel.value),
          .rate = {}};
}

class ChannelList {
 public:
  ChannelList(const Model& model, const std::vector<std::string>& components)
      : model_(model), wanted_(components.empty() ? default_components(model) : components) {}

  std::vector<Channel> make() {
    for (const std::string& component : model_.network.components)
      if (is_wanted(wanted_, component)) {
        add_motions(component);
        add_elements(component);
        add_drive(component);
      }
    for (const TorqueJoint& joint : model_.torque_joints)
      if (is_wanted(wanted_, component_of(joint.component))) add_joint(joint);
    for (const GearTorque& torque : model_.gear_torques)
      if (is_wanted(wanted_, component_of(torque.name))) channels_.push_back(torque_of(torque));
    for (std::size_t k = 0; k < model_.internal_states.size(); ++k)
      if (is_wanted(wanted_, model_.internal_states[k].component)) channels_.push_back(internal_state(model_, k));
    for (const Channel& channel : model_.pool_channels)
      if (is_wanted(wanted_, channel.name.of) || is_wanted(wanted_, component_of(channel.name.of)))
        channels_.push_back(channel);
    return std::move(channels_);
  }

 private:
  void add(Name name, std::string unit, std::function<double(const Snapshot&)> value) {
    channels_.push_back({std::move(name), std::move(unit), std::move(value)});
  }

  void add_motion(const std::string& name, int node) {
    const int shaft = model_.shaft_of_node[at(node)];
    const double gain = model_.gain_of_node[at(node)];
    add(Name::make(quantities::angle, name), "rad", [node](const Snapshot& s) { return s.node_angle[node]; });
    add(Name::make(quantities::speed, name), "rad/s",
        [shaft, gain](const Snapshot& s) { return gain * s.now.speed[shaft]; });
  }
  void add_motions(const std::string& component) {
    const Network::Ports& ports = model_.network.ports.at(component);
    if (ports.in == ports.out) return add_motion(component, ports.in);
    add_motion(component + ".in", ports.in);
    add_motion(component + ".out", ports.out);
    for (const auto& [name, node] : ports.others)
      if (node != ports.in && node != ports.out) add_motion(component + "." + name, node);
  }

  // Torque of its motors, loads and the like, those over the angle apart.
  void add_elements(const std::string& component) {
    std::vector<std::size_t> own;
    for (std::size_t e = 0; e < model_.network.elements.size(); ++e)
      if (model_.network.elements[e].component == component && model_.network.elements[e].element->cycle == 0)
        own.push_back(e);
    if (own.empty()) return;
    add(Name::make(quantities::torque, component), "N*m", [own](const Snapshot& s) {
      double sum = 0;
      for (const std::size_t e : own) sum += s.sums.element_torque[e] + s.hold_torque[e];
      return sum;
    });
  }

  // What turns a shaft at a given speed: its torque and power.
  void add_drive(const std::string& component) {
    for (const MotorTorque& drive : model_.motors) {
      if (!drive.prescribed || drive.component != component) continue;
      add(Name::make(quantities::torque, component), "N*m", [drive](const Snapshot& s) { return drive.torque(s); });
      channels_.push_back(power_of(model_, drive));
    }
  }

  void add_joint(const TorqueJoint& joint) {
    const int e = joint.elastic;
    channels_.push_back(torque_of(joint));
    if (e < 0) return;
    const ElasticJoint& elastic = model_.elastic[at(e)];
    if (elastic.slips || elastic.springless) {
      const int a = elastic.shaft_a, b = elastic.shaft_b;
      const double ga = elastic.gain_a, gb = elastic.gain_b;
      add(Name::make(quantities::slip, joint.component), "rad/s",
          [=](const Snapshot& s) { return ga * s.now.speed[a] - gb * s.now.speed[b]; });
      return;
    }
    channels_.push_back(spring_torque_of(joint));
    const int first = joint.first, last = joint.last;
    add(Name::make(quantities::twist, joint.component), "rad", [first, last](const Snapshot& s) {
      double twist = 0;
      for (int k = first; k <= last; ++k) twist += s.now.twist[k];
      return twist;
    });
  }

  const Model& model_;
  std::vector<std::string> wanted_;
  std::vector<Channel> channels_;
};

// A part of a row: its torque, and that in the middle of all, follows the twists and their rates of all parts.
void report_rates_of_row(const Model& model, const TorqueJoint& joint, const AnyConnection& part,
                         ExtremeOf& transmitted, ExtremeOf& spring) {
  const SpringRow* row = part.row.get();
  const int k = part.row_part, first = joint.first;
  const auto by_twists = [row, k, reported = joint.reported](const double* twist) {
    std::array<double, highest_lobatto_degree> torque{};
    for (int l = 0; l < row->size; ++l) torque[at(l)] = row->spring_torque(l, twist);
    return reported(torque.data(), k);
  };
  spring.slope = spring.rate = [by_twists, first](const Snapshot& s) { return by_twists(s.sums.twist_rate + first); };
  const auto* const elastic = model.elastic.data() + first;
  transmitted.slope = transmitted.rate = [by_twists, row, first, elastic](const Snapshot& s) {
    std::array<double, highest_lobatto_degree> acceleration{};
    for (int l = 0; l < row->size; ++l) {
      const ElasticJoint& e = elastic[l];
      acceleration[at(l)] = e.gain_a * s.alpha[e.shaft_a] - e.gain_b * s.alpha[e.shaft_b];
    }
    return by_twists(s.sums.twist_rate + first) + row->retardation * by_twists(acceleration.data());
  };
}

// What a joint transmits and what its spring does of that; no spring: the torque alone. The model outlives the run.
void add_peaks(const Model& model, const TorqueJoint& joint, std::vector<ExtremeOf>& wanted) {
  const int j = joint.joint, e = joint.elastic;
  ExtremeOf transmitted = peak_of(torque_of(joint), joint.torque_scale);
  if (e >= 0 && (model.elastic[at(e)].slips || model.elastic[at(e)].springless)) {
    wanted.push_back(std::move(transmitted));
    return;
  }
  if (!model.network.joints[at(j)].element) return wanted.push_back(std::move(transmitted));  // no spring at all
  ExtremeOf spring = transmitted;
  spring.name = Name::make(quantities::peak_spring_torque, joint.component);
  if (e >= 0) {
    const ElasticJoint elastic = model.elastic[at(e)];
    const AnyConnection* element = model.network.joints[at(j)].element.get();
    const bool known = element->knows_torque_rate;
    if (known)
      transmitted.rate = [element, elastic, e](const Snapshot& s) {
        const double acceleration =
            elastic.gain_a * s.alpha[elastic.shaft_a] - elastic.gain_b * s.alpha[elastic.shaft_b];
        return element->torque_rate(s.now.twist[e], s.sums.twist_rate[e], acceleration);
      };
    spring.value = spring_torque_of(joint).value;
    // Where a spring goes slack or changes its mode its slope at the ends of a step says nothing.
    if (known && element->stiffness > 0 && element->is.guards == 0) {
      transmitted.slope = transmitted.rate;
      spring.slope = [element, e](const Snapshot& s) {
        return element->torque_rate(s.now.twist[e], s.sums.twist_rate[e], 0);
      };
    }
    // The spring torque rises and falls with the twist: its rate vanishes with θ̇.
    if (known) spring.rate = [e](const Snapshot& s) { return s.sums.twist_rate[e]; };
    if (element->row) report_rates_of_row(model, joint, *element, transmitted, spring);
  }
  wanted.push_back(std::move(transmitted));
  wanted.push_back(std::move(spring));
}

void add_link_speeds(const Model& model, std::vector<ExtremeOf>& wanted) {
  const int node = model.reduction_node, shaft = model.shaft_of_node[at(node)];
  const double gain = model.gain_of_node[at(node)];
  const std::string link = model.network.nodes[at(node)].component;
  ExtremeOf speed{.name = Name::make(quantities::max_speed, link),
                  .unit = "rad/s",
                  .scale = model.speed_scale,
                  .functional = Functional::greatest,
                  .value = [=](const Snapshot& s) { return gain * s.now.speed[shaft]; },
                  .rate = [=](const Snapshot& s) { return gain * s.alpha[shaft]; }};
  speed.slope = speed.rate;
  wanted.push_back(speed);
  speed.name = Name::make(quantities::min_speed, link);
  speed.functional = Functional::least;
  wanted.push_back(std::move(speed));
}

// The rate of a velocity; empty: it is no channel of the model.
std::function<double(const Snapshot&)> acceleration_beside(const Model& model, const std::string& of) {
  for (const Channel& channel : model.pool_channels)
    if (channel.name.what == quantities::acceleration && channel.name.of == of) return channel.value;
  return {};
}

}  // namespace

std::vector<Channel> channels_of(const Model& model, const std::vector<std::string>& components) {
  std::vector<Channel> channels = ChannelList(model, components).make();
  refuse_too_many(model.scene, channels.size());
  return channels;
}

Channel power_of(const Model& model, const MotorTorque& drive) {
  const int shaft = model.shaft_of_node[at(drive.node)];
  const double gain = model.gain_of_node[at(drive.node)];
  return {Name::own("power", drive.component), "W",
          [=](const Snapshot& s) { return drive.torque(s) * gain * s.now.speed[shaft]; }};
}

std::vector<ExtremeOf> extremes_of(const Model& model) {
  std::vector<ExtremeOf> wanted;
  for (const TorqueJoint& joint : model.torque_joints) add_peaks(model, joint, wanted);
  for (const GearTorque& torque : model.gear_torques)
    wanted.push_back(peak_of(torque_of(torque), model.torque_scale / model.scale_ratio[at(torque.node)]));
  add_link_speeds(model, wanted);
  for (std::size_t k = 0; k < model.internal_states.size(); ++k)
    if (const InternalState& state = model.internal_states[k].state; state.peak) {
      wanted.push_back(peak_of(internal_state(model, k), state.scale));
      wanted.back().rate = wanted.back().slope = [k](const Snapshot& s) { return s.sums.internal_rate[k]; };
    }
  for (const Channel& channel : model.pool_channels) {
    if (channel.name.what == quantities::position) continue;
    wanted.push_back(peak_of(channel));
    if (channel.name.what == quantities::velocity)
      wanted.back().rate = wanted.back().slope = acceleration_beside(model, channel.name.of);
  }
  return wanted;
}

}  // namespace kurbel
