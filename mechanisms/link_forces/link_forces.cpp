// link_forces.cpp — what acts along travels within a linkage, and where.
#include "mechanisms/link_forces/link_forces.h"

namespace kurbel {

std::vector<const Mechanism*> link_forces_of(const Network& network, const std::string& component) {
  std::vector<const Mechanism*> list;
  for (const Network::ShaftElement& e : network.elements)
    if (const auto* const element = dynamic_cast<const MechanismElement*>(e.element.get());
        element && element->mechanism().is_force() && e.component.starts_with(component + "."))
      list.push_back(&element->mechanism());
  return list;
}

void add_actions(const Mechanism& force, double value, long double phi, const PlanarLinkage& linkage,
                 std::vector<AppliedForce>& to) {
  const LinkageTravelData& data = *force.data.as<LinkageTravelData>();
  const Linkage& l = *data.linkage;
  const auto part = [value](long double unit) { return static_cast<double>(value * unit); };
  for (const TravelAction& action : travel_actions(l, l.poses(phi), data.travel)) {
    to.push_back({body_of(linkage, l, action.body),
                  {static_cast<double>(action.at.x), static_cast<double>(action.at.y)},
                  {part(action.force.x), part(action.force.y)},
                  part(action.moment)});
  }
}

}  // namespace kurbel
