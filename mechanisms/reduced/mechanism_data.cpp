// mechanism_data.cpp — from a mechanism's description to its bodies, its places, its reduced functions.
#include "mechanisms/reduced/mechanism_data.h"

#include <algorithm>
#include <cctype>

namespace kurbel {
namespace {

// Made when they are first requested: a scene that is only checked needs none.
class LateBodies final : public MechanismBodies {
 public:
  explicit LateBodies(std::function<std::unique_ptr<MechanismBodies>()> make) : make_(std::move(make)) {}
  ReducedSample sample(double phi) override { return made().sample(phi); }
  ReducedSample sample_from(double phi, const std::vector<double>& start) override {
    return made().sample_from(phi, start);
  }
  double kinetic_energy(double phi, double omega) override { return made().kinetic_energy(phi, omega); }
  double potential_energy(double phi) override { return made().potential_energy(phi); }
  std::vector<TrackedMotion> tracked() const override {
    return made_ ? made_->tracked() : std::vector<TrackedMotion>{};
  }

 private:
  MechanismBodies& made() {
    if (!made_) made_ = make_();
    return *made_;
  }
  std::function<std::unique_ptr<MechanismBodies>()> make_;
  std::unique_ptr<MechanismBodies> made_;
};

}  // namespace

MechanismData::LinkageAt MechanismData::standing(LinkageAt moving, long double x) {
  return [moving = std::move(moving), x](long double phi) {
    PlanarLinkage l = moving(phi);
    l.stands_still = true;
    l.output[0] = x, l.output[1] = l.output[2] = 0;
    return l;
  };
}

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
    if (held_->own_bodies) return std::make_unique<LateBodies>(held_->own_bodies);
    const BodiesOf of = bodies_of();
    const auto bare = [](const PlanarLinkage::Body& body) { return body.mass == 0 && body.inertia > 0; };
    const std::vector<PlanarLinkage::Body> links = of.linkage(of.place).bodies;
    if (std::any_of(links.begin(), links.end(), bare)) return kurbel::make_bodies(of);  // which may refuse them
    return std::make_unique<LateBodies>([of] { return kurbel::make_bodies(of); });
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
