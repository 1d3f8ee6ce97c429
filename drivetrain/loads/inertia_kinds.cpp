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
const Fields<BodyKeys>& body_fields() {
  static const auto made = Fields<BodyKeys>()
                               .add(inertia_key("", "moment of inertia"), &BodyKeys::inertia)
                               .add(rim_rating_fields(), &BodyKeys::rim);
  return made;
}

BodyKeys put_body(const Section& s, Network& net, Messages& messages) {
  const auto body = body_fields().read(s, messages);
  single_shaft(s, body.inertia, net);
  if (body.rim.radius) net.data.add(s.name, body.rim);
  return body;
}

void build_inertia(const Section& s, Network& net, Messages& messages) { put_body(s, net, messages); }
void build_flywheel(const Section& s, Network& net, Messages& messages) {
  net.data.add(s.name, Flywheel{put_body(s, net, messages).inertia});
}

}  // namespace

std::vector<Kind> inertia_kinds() {
  return {
      on_a_shaft("inertia", "rigid body on the shaft", body_fields().keys(), build_inertia),
      on_a_shaft("flywheel", "the same, by its usual name", body_fields().keys(), build_flywheel),
  };
}

}  // namespace kurbel
