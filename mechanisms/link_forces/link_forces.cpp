// link_forces.cpp — what acts along travels within a linkage, and where.
#include "mechanisms/link_forces/link_forces.h"

namespace kurbel {

const Mechanism* link_force_of(const Network::ShaftElement& element) {
  const auto* const found = dynamic_cast<const MechanismElement*>(element.element.get());
  return found && found->mechanism().is_force() ? &found->mechanism() : nullptr;
}

std::vector<const Mechanism*> link_forces_of(const Network& network, const std::string& component) {
  std::vector<const Mechanism*> list;
  for (const Network::ShaftElement& e : network.elements)
    if (const Mechanism* force = link_force_of(e); force && e.component.starts_with(component + "."))
      list.push_back(force);
  return list;
}

void add_actions(const LinkageTravelData& along, double value, const LinkPoses& poses, const PlanarLinkage& linkage,
                 std::vector<AppliedForce>& to) {
  const auto part = [value](long double unit) { return static_cast<double>(value * unit); };
  for (const TravelAction& action : travel_actions(*along.linkage, poses, along.travel))
    to.push_back({body_of(linkage, *along.linkage, action.body),
                  {static_cast<double>(action.at.x), static_cast<double>(action.at.y)},
                  {part(action.force.x), part(action.force.y)},
                  part(action.moment)});
}

}  // namespace kurbel
