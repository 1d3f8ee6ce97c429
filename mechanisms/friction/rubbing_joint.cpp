// rubbing_joint.cpp — the domain of a joint's friction data; laws of friction made when they are first requested.
#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <stdexcept>

#include "mechanisms/friction/joint_friction.h"

namespace kurbel {
namespace {

void require(bool holds, const RubbingJoint& j, const char* what, double got, const char* domain) {
  if (!holds) throw std::invalid_argument(fmt::format("{}: {} = {:g}; must be {}", j.name, what, got, domain));
}

}  // namespace

void validate(const RubbingJoint& j) {
  const FrictionCoefficient& f = j.friction;
  for (const double value : {f.kinetic, f.resting, f.stribeck_speed, f.viscous})
    require(std::isfinite(value) && value >= 0, j, "a friction value", value, "finite and >= 0");
  require(f.resting >= f.kinetic, j, "static friction coefficient", f.resting,
          fmt::format(">= the kinetic one, {:g}", f.kinetic).c_str());
  for (const auto& [what, value] : {std::pair("radius", j.radius), std::pair("length", j.length),
                                    std::pair("width", j.width), std::pair("rolling_arm", j.rolling_arm)})
    require(std::isfinite(value) && value >= 0, j, what, value, ">= 0 m");
  require(std::isfinite(j.middle), j, "middle", j.middle, "finite");
  require(std::isfinite(j.roller_radius) && (j.rolling_arm == 0 || j.roller_radius > 0), j, "roller_radius",
          j.roller_radius, "> 0 m where there is a rolling_arm");
}

struct JointFrictionSource::Kept {
  std::once_flag once[2];
  std::shared_ptr<const JointFriction> made[2];
};
JointFrictionSource::JointFrictionSource(Make make) : make_(std::move(make)), kept_(std::make_unique<Kept>()) {}
JointFrictionSource::~JointFrictionSource() = default;
std::shared_ptr<const JointFriction> JointFrictionSource::get(bool second) const {
  std::call_once(kept_->once[second], [&] { kept_->made[second] = make_(second); });
  return kept_->made[second];
}

}  // namespace kurbel
