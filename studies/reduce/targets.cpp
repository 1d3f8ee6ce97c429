// targets.cpp — names of shafts and sliders, and the motion of a slider with the link.
#include "studies/reduce/targets.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "engine/numerics/index.h"
#include "engine/orbit/stated_speed.h"
#include "engine/return_map/periodicity.h"
#include "engine/scene/keys.h"

namespace kurbel {
namespace {

std::vector<std::string> sliders_of(const Model& model) {
  std::vector<std::string> names;
  for (const Channel& channel : model.pool_channels)
    if (channel.name.what == quantities::velocity)
      names.push_back(channel.name.of + (channel.unit == "rad/s" ? ".rocker" : ".slider"));
  return names;
}

std::vector<std::string> shafts_of(const Model& model) {
  std::vector<std::string> names;
  for (const std::string& component : model.network.components) {
    const Network::Ports& ports = model.network.ports.at(component);
    if (ports.in == ports.out) {
      names.push_back(component);
    } else {
      names.push_back(component + ".in");
      names.push_back(component + ".out");
    }
  }
  return names;
}

// A prescribed speed would set the link's: the ratio is that of the free machine, whatever its inertia.
std::shared_ptr<const Model> without_prescribed_speed(std::shared_ptr<const Model> model) {
  const int node = prescribed_node(*model);
  if (node < 0) return model;
  Network network = model->network;
  network.nodes[at(node)].prescribed = -1;
  network.nodes[at(node)].inertia += 1;
  return compile_network(std::move(network), model->scene, model->effects);
}

}  // namespace

SliderRatio::SliderRatio(std::shared_ptr<const Model> model, const std::string& mechanism)
    : model_(without_prescribed_speed(std::move(model))), equations_(model_, false) {
  for (const Channel& channel : model_->pool_channels) {
    if (channel.name.of != mechanism) continue;
    if (channel.name.what == quantities::velocity) {
      velocity_ = channel.value;
      rocks_ = channel.unit == "rad/s";
    }
    if (channel.name.what == quantities::acceleration) acceleration_ = channel.value;
  }
}

RatioAt SliderRatio::operator()(double phi) {
  const std::vector<double> y = equations_.modes_from_scratch(0, phi, 1.0);
  const Snapshot& s = equations_.snapshot(0, y);
  const auto node = at(model_->reduction_node);
  const double alpha = s.alpha[model_->shaft_of_node[node]] * model_->gain_of_node[node];
  const double first = velocity_(s);
  return {first, acceleration_(s) - first * alpha};
}

void refuse_target(const Model& model, const std::string& to) {
  std::vector<std::string> names = shafts_of(model);
  for (const std::string& slider : sliders_of(model)) names.push_back(slider);
  throw std::invalid_argument(
      fmt::format("--to {}: no such shaft{}; allowed: {}", in_quotes(to), suggestion(to, names), listed(names)));
}

int node_named(const Model& model, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string end = dot == std::string::npos ? "" : name.substr(dot + 1);
  const bool port = end == "in" || end == "out";
  const auto found = model.network.ports.find(port ? name.substr(0, dot) : name);
  if (found == model.network.ports.end()) refuse_target(model, name);
  const Network::Ports& ports = found->second;
  if (!port && ports.in != ports.out)
    throw std::invalid_argument(fmt::format("--to {}: it has two shafts; write {} or {}", in_quotes(name),
                                            in_quotes(name + ".in"), in_quotes(name + ".out")));
  return end == "in" ? ports.in : ports.out;
}

double choose_speed(RigidMachine& machine, const ReduceOptions& options, MachineReduction& r) {
  const Model& m = machine.model();
  if (options.speed) {
    r.speed = *options.speed;
    r.speed_source = "given";
    return 0;
  }
  if (machine.uses_speed() && machine.periodic()) {
    try {
      const OperatingSpeed found = operating_speed(machine);
      r.speed = found.speed;
      r.speed_source = "the operating speed, at which the mean torques of drive and load balance";
      return found.drive_slope;
    } catch (const std::invalid_argument& error) {
      r.notes.push_back(fmt::format("no operating speed: {}", error.what()));
    }
  }
  r.speed = m.speed_scale;
  r.speed_source = !machine.uses_speed()   ? "no torque depends on it"
                   : states_rated_speed(m) ? "rated speed"
                   : states_speed(m)       ? "the greatest speed of the scene"
                                           : "after one turn from rest under the greatest torque";
  return 0;
}

}  // namespace kurbel
