// inertia_kinds.cpp — rigid bodies: inertia and flywheel.
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/rating_keys.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct BodyKeys {
  double inertia = 0;  // [kg·m²]
  RimRating rim;
};
Fields<BodyKeys> body_fields() {
  return Fields<BodyKeys>()
      .add(inertia_key("", "moment of inertia"), &BodyKeys::inertia)
      .add(rim_rating_fields(), &BodyKeys::rim);
}

void build_inertia(const Section& s, const Reading<BodyKeys>& body, Network& net) {
  single_shaft(s, body.inertia, net);
  if (body.rim.radius) net.data.add(s.name, body.rim);
}
void build_flywheel(const Section& s, const Reading<BodyKeys>& body, Network& net) {
  build_inertia(s, body, net);
  net.data.add(s.name, Flywheel{body.inertia});
}

}  // namespace

std::vector<Kind> inertia_kinds() {
  return {
      kind_of<body_fields, build_inertia>(on_a_shaft, "inertia", "rigid body on the shaft"),
      kind_of<body_fields, build_flywheel>(on_a_shaft, "flywheel", "the same, by its usual name"),
  };
}

}  // namespace kurbel
