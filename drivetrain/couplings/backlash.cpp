// backlash.cpp — the law of contact in words, and its form without a gap.
#include "drivetrain/couplings/backlash.h"

#include <fmt/format.h>

#include <numbers>

#include "engine/elements/any_connection.h"
#include "engine/scene/effects.h"

namespace kurbel {

std::string Backlash::describe() const {
  const double degrees = gap * 180 / std::numbers::pi;
  switch (law) {
    case ContactLaw::no_pulling:
      return fmt::format(
          "gap {:.4g}° between the flanks; law of contact: spring and damper, the damper never above the spring and "
          "never pulling",
          degrees);
    case ContactLaw::hunt_crossley:
      return fmt::format(
          "gap {:.4g}° between the flanks; law of contact: Hunt–Crossley, exponent {:.4g}, damping {:.4g} s/rad",
          degrees, exponent, damping);
    case ContactLaw::clipped:
      break;
  }
  return fmt::format("gap {:.4g}° between the flanks; law of contact: spring and damper, clipped at zero torque",
                     degrees);
}

Backlash BacklashData::settled(double inertia) const {
  Backlash element = contact;
  if (element.law != ContactLaw::hunt_crossley)
    element.damping = CouplingData{contact.stiffness, given}.settled(inertia).damping;
  element.twist_scale = std::max(0.5 * element.gap, 1e-5);
  return element;
}

ConnectionForm under(const BacklashData& given, const Effects& effects) {
  return effects.backlash ? nullptr : connection_form(given.without_gap());
}

CouplingData BacklashData::without_gap() const {
  return {contact.stiffness_at_rest(), contact.law == ContactLaw::hunt_crossley ? Damping{} : given};
}

}  // namespace kurbel
