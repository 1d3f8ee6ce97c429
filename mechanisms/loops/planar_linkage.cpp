// planar_linkage.cpp — sums over the links of a mechanism at one angle.
#include "mechanisms/loops/planar_linkage.h"

#include <cmath>

namespace kurbel {

namespace {

Taylor scaled(long double by, Taylor t) {
  for (long double& c : t.c) c *= by;
  return t;
}

}  // namespace

ClosedForm closed_form_of(const PlanarLinkage& linkage) {
  const long double gravity = linkage.gravity, up_x = std::sin(static_cast<long double>(linkage.elevation)),
                    up_y = std::cos(static_cast<long double>(linkage.elevation));
  Taylor inertia, moment;  // moment: of mass over height
  long double scale = 0;
  for (const PlanarLinkage::Body& body : linkage.bodies) {
    if (body.mass > 0) {
      const Taylor vx = body.com.x.derivative(), vy = body.com.y.derivative();
      inertia = inertia + scaled(body.mass, vx * vx + vy * vy);
      moment = moment + scaled(body.mass, scaled(up_x, body.com.x) + scaled(up_y, body.com.y));
      scale += gravity * body.mass * std::hypot(vx.value(), vy.value());
    }
    if (body.inertia > 0) {
      const Taylor rate = body.direction.rate();
      inertia = inertia + scaled(body.inertia, rate * rate);
    }
  }
  return {inertia.value(),
          inertia.slope(),
          inertia.curvature(),
          linkage.output[0],
          linkage.output[1],
          linkage.output[2],
          -gravity * moment.slope(),
          -gravity * moment.curvature(),
          scale,
          gravity * moment.value()};
}

}  // namespace kurbel
