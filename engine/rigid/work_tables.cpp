// work_tables.cpp — which machines can run over their angle, and the edges and diagrams that serve many runs of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/rigid/work_equation.h"

namespace kurbel {

std::string WorkTables::refusal(const std::shared_ptr<const Model>& model) {
  if (!model->elastic.empty())
    return fmt::format(
        "the machine is elastic ({} coordinates; effects: {}), and the work equation is that of one angle; switch the "
        "elasticity off or choose another method",
        model->free_shafts + model->twist_count(), model->effects.describe());
  if (!model->relations.empty())
    return fmt::format("\"{}\" ties shafts only while the machine runs; choose another method",
                       model->network.relations.front().component);
  if (model->free_shafts != 1)
    return "a prescribed speed leaves no coordinate free; replace it by a motor or choose another method";
  if (!model->internal_states.empty())
    return fmt::format(
        "the {} of \"{}\" is a state besides angle and speed; switch that effect off or choose another method",
        model->internal_states.front().state.name, model->internal_states.front().component);
  if (!model->scene.sequence.steps.empty())
    return "the operating sequence switches at times or events, which are not known over the angle; choose another "
           "method";
  for (const Network::ShaftElement& e : model->network.elements)
    if (std::isinf(e.element->cycle))
      return fmt::format("the crank of \"{}\" rocks and never turns fully; choose another method", e.component);
  const RigidMachine machine(model);
  for (const Network::ShaftElement& e : model->network.elements)
    if (e.element->uses_time || e.window.start > Window{}.start || e.window.stop < Window{}.stop)
      return fmt::format(
          "the torque of \"{}\" depends on time, and over the angle the times of edges are not known; choose another "
          "method",
          e.component);
  for (const auto& pool : model->pools)
    if (pool->reacts())
      return "joint friction depends on the acceleration, and its kinks lie at angles that are not known beforehand; "
             "choose another method";
  if (!machine.edges_are_of_angle())
    return "a torque given as a table over speed changes its piece at speeds, not at angles; choose another method";
  if (!machine.periodic())
    return "the elements' angles do not come back together within 24 turns, so that load edges have no fixed place; "
           "choose another method";
  return {};
}

WorkTables::WorkTables(std::shared_ptr<const Model> model)
    : machine_([&] {
        if (const std::string why = refusal(model); !why.empty()) throw std::invalid_argument(why);
        return RigidMachine(model);
      }()),
      of_angle_alone_(!machine_.uses_speed()) {}

const std::vector<double>& WorkTables::edges(int direction) {
  std::optional<std::vector<double>>& made = edges_[side(direction)];
  if (!made) {
    made = machine_.edges(direction);
    if (direction < 0) {
      for (double& e : *made) e = e > 0 ? machine_.cycle() - e : 0;
      std::sort(made->begin(), made->end());
    }
  }
  return *made;
}

const WorkOverAngle& WorkTables::diagram(int direction) {
  std::unique_ptr<WorkOverAngle>& made = diagram_[side(direction)];
  if (!made) {
    if (!of_angle_alone_) throw std::logic_error("the work diagram needs torques of the angle alone");
    made = std::make_unique<WorkOverAngle>(machine_, machine_.edges(direction), direction);
  }
  return *made;
}

}  // namespace kurbel
