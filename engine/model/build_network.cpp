// build_network.cpp — from a scene's components to the machine as drawn; the one place where a kind's builder is
// called.
#include "engine/model/model.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/model/continuous_shafts.h"
#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

// The node that a branch begins or ends at: "gearbox", "gearbox.in", "differential.left".
int port_named(const Network& network, const std::string& said) {
  const std::size_t dot = said.find('.');
  const Network::Ports& ports = network.ports.at(said.substr(0, dot));
  if (dot != std::string::npos)
    if (const auto other = ports.others.find(said.substr(dot + 1)); other != ports.others.end()) return other->second;
  return dot != std::string::npos && said.substr(dot + 1) == "in" ? ports.in : ports.out;
}

}  // namespace

void build_component(const Section& section, Network& network, Messages& messages) {
  Deadline::check();
  const auto refuse = [&](const std::exception& why) {
    messages.add(section.at, fmt::format("{} \"{}\": its values do not fit together: {}; check them, and their units",
                                         section.kind->name, section.name, why.what()));
  };
  const std::size_t ranges = network.ranges.size();
  network.kinds[section.name] = section.kind->name;
  try {
    section.kind->build(section, network, messages);
  } catch (const std::invalid_argument& error) {
    refuse(error);
  } catch (const std::runtime_error& error) {
    refuse(error);
  }
  for (std::size_t k = ranges; k < network.ranges.size(); ++k) {
    Network::DataRange& range = network.ranges[k];
    range.at = section.where(section.has(range.of) ? range.of : "table");
  }
}

Network build_network(const Scene& scene) {
  Network network;
  network.data.add("", scene.speed_unit);  // of the machine: for messages of its elements
  Messages messages(scene.file);
  for (const Section& section : scene.components) {
    network.components.push_back(section.name);
    build_component(section, network, messages);
  }
  messages.throw_if_any();
  for (const Line& line : scene.lines) {
    int end = line.from.empty() ? -1 : port_named(network, line.from);
    for (const std::string& name : line.names) {
      const Network::Ports& ports = network.ports.at(name);
      if (end >= 0) network.join(end, ports.in, 1, "");
      end = ports.out;
    }
    if (!line.to.empty()) network.join(end, port_named(network, line.to), 1, "");
  }
  cut_continuous_shafts(network, scene.finer_shafts);
  return network;
}

}  // namespace kurbel
