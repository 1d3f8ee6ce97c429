// inertia_kinds.cpp — rigid bodies: inertia and flywheel.
#include "drivetrain/loads/kinds.h"

#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_inertia(const Section& s, Network& net, Messages&) { single_shaft(s, net); }

}  // namespace

std::vector<Kind> inertia_kinds() {
  return {
      {.name = "inertia",
       .doc = "rigid body on the shaft",
       .keys = {inertia_key("", "moment of inertia")},
       .build = build_inertia},
      {.name = "flywheel",
       .doc = "the same, by its usual name",
       .keys = {inertia_key("", "moment of inertia")},
       .build = build_inertia},
  };
}

}  // namespace kurbel
