// link_bodies.cpp — links on a bearing, links between pins, sliders.
#include "mechanisms/linkages/link_bodies.h"

namespace kurbel {

PlanarLinkage::Body pivoted(const char* name, const LinkBody& link, const Path& bearing, const Direction& direction) {
  const long double central = link.inertia - static_cast<long double>(link.mass) * link.com * link.com;
  return {name, link.mass, central > 0 ? central : 0, bearing + along(direction, link.com), direction};
}

PlanarLinkage::Body floating(const char* name, const LinkBody& link, const Path& joint, const Direction& direction) {
  return {name, link.mass, link.inertia, joint + along(direction, link.com), direction};
}

void add_slider(PlanarLinkage& to, const char* name, double mass, const char* pin, const Path& at) {
  const int link = to.body_count - 1;
  to.add(PlanarLinkage::Body{name, mass, 0, at, Direction{Taylor(1), Taylor()}});
  to.join({pin, link, link + 1, at});
  to.join({"guide", PlanarLinkage::frame, link + 1, at, true, Direction{Taylor(1), Taylor()}});
  to.load_at = at;
  to.output[0] = at.x.value(), to.output[1] = at.x.slope(), to.output[2] = at.x.curvature();
}

}  // namespace kurbel
