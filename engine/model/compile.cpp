// compile.cpp — merges what is rigidly joined: from the machine as drawn to its smallest set of coordinates.
#include "engine/model/compile_steps.h"
#include "engine/model/cycle_of.h"
#include "engine/model/relations.h"

namespace kurbel {

Location Compilation::place_of(const std::string& component) const {
  const Section* section = model.scene.find(component);
  return section ? section->at : Location{};
}

Location Compilation::place_of_line() const {
  return model.scene.lines.empty() ? Location{} : model.scene.lines.front().at;
}

namespace {

// All mechanisms are back in place, each at its own ratio; where none of a few turns does it, the link's own cycle. An
// engine, a load over an angle or a joint at an angle make a cycle without any mechanism: their common period, as the
// steady study has it.
void find_cycle(Model& m) {
  const CyclePeriod cycle = cycle_of(m);
  if (m.cycle == 0)
    m.cycle = cycle.of_laws;
  else if (cycle.periodic)
    m.cycle = cycle.angle;
}

}  // namespace

std::shared_ptr<const Model> compile_network(Network network, const Scene& scene, const Effects& effects) {
  Compilation c(scene.file);
  Model& m = c.model;
  m.network = std::move(network);
  m.scene = scene;
  m.effects = effects;
  // The network as drawn, with a reduction link.
  check_shafts(c);
  choose_reduction_link(c);
  find_node_ratios(c);
  // Under its effects.
  switch_connections(c);
  settle_relative_damping(c);
  switch_effects(c);
  m.gear_torques = simplify_relations(m.network, m.effects, standing_nodes(m.network));
  // The coordinates.
  make_shafts(c);
  make_elastic_joints(c);
  m.relations = relations_over_shafts(m);
  check_inertias(c);
  find_scales(c);
  find_cycle(m);
  track_angles(c);
  // What acts on them.
  place_elements(c);
  list_torque_joints(c);
  list_motors(m);
  c.messages.throw_if_any();
  m.jacobian = lay_out_jacobian(m);
  return std::make_shared<const Model>(std::move(m));
}

std::shared_ptr<const Model> compile(const Scene& scene, const Effects& effects) {
  return compile_network(build_network(scene), scene, effects);
}

}  // namespace kurbel
