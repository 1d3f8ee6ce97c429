// mechanism_data.cpp — from a mechanism's description to its bodies, its places, its reduced functions.
#include "mechanisms/reduced/mechanism_data.h"

#include <cctype>

namespace kurbel {

std::vector<PlanePoint> MechanismData::places(double phi) const {
  if (held_->places) return held_->places(phi);
  const PlanarLinkage l = linkage(phi);
  std::vector<PlanePoint> places;
  for (const int k : held_->drawing.places) {
    const Path& at = l.joints[static_cast<std::size_t>(k)].at;
    places.push_back({static_cast<double>(at.x.value()), static_cast<double>(at.y.value())});
  }
  return places;
}

BodiesOf MechanismData::bodies_of() const {
  constexpr double off_change_points = 0.7;  // and off the dead centres
  std::string kind = held_->drawing.name;
  kind[0] = static_cast<char>(std::tolower(kind[0]));
  if (held_->faults) throw_if_any(kind, held_->faults());
  return {.kind = kind,
          .linkage = [held = held_, data = data_](long double phi) { return held->linkage(phi); },
          .place = held_->drawn_at.value_or(arc() ? arc()->middle : off_change_points),
          .turns = held_->turns};
}

std::unique_ptr<MechanismBodies> MechanismData::make_bodies() const {
  if constexpr (!has_bodies) {
    bodies_of();  // its faults are found all the same
    return nullptr;
  } else {
    return held_->own_bodies ? held_->own_bodies() : kurbel::make_bodies(bodies_of());
  }
}

ReducedSample closed_sample(const MechanismData& data, double phi) { return rounded(data.closed_form(phi)); }

ReducedSample rounded(const ClosedForm& f) {
  const auto to_double = [](long double value) { return static_cast<double>(value); };
  return {to_double(f.inertia),
          to_double(f.inertia_slope),
          to_double(f.inertia_curvature),
          to_double(f.output_position),
          to_double(f.output_velocity_ratio),
          to_double(f.output_acceleration_ratio),
          to_double(f.gravity_torque),
          to_double(f.gravity_torque_slope),
          to_double(f.gravity_torque_scale),
          1};
}

}  // namespace kurbel
