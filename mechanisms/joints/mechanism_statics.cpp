// mechanism_statics.cpp — the frictionless solution, the friction loads that it leads to, and what these do to all joints.
#include "mechanisms/joints/mechanism_statics.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/find_by.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

// A slide whose reaction leaves its length is in contact at both ends.
void share_edges(const RubbingJoint& data, JointForces& slide) {
  const double about_middle = slide.moment - data.middle * slide.normal;
  slide.both_edges = data.length > 0 && 2 * std::abs(about_middle) > data.length * std::abs(slide.normal);
  if (!slide.both_edges) return;
  slide.edge_front = 0.5 * slide.normal + about_middle / data.length;
  slide.edge_back = 0.5 * slide.normal - about_middle / data.length;
}

// Coefficients at one angle.
class ReactionsThere final : public ReactionTable {
 public:
  ReactionsThere(const ReactionPlaces& places, std::vector<double> values)
      : places_(places), values_(std::move(values)) {}
  const ReactionPlaces& places() const override { return places_; }
  void read(double, double* values) const override { std::copy(values_.begin(), values_.end(), values); }
  void read(double, double*, double*) const override { throw std::logic_error("no slopes at one angle"); }
  One read_one(double, std::size_t) const override { throw std::logic_error("no slopes at one angle"); }
  std::string describe() const override { return "reactions at one angle"; }

 private:
  ReactionPlaces places_;
  std::vector<double> values_;
};

}  // namespace

MechanismStatics::MechanismStatics(const MechanismData& data, MechanismJoints joints, bool friction, bool weightless)
    : data_(data), joints_(std::move(joints)), weightless_(weightless) {
  if (!friction || joints_.joints.empty()) return;
  sampler_.emplace(data_, joints_.joints, joints_.off, std::vector<ActsWithin>());
  if (sampler_->joints.empty()) sampler_.reset();
}

const RubbingJoint* MechanismStatics::joint_data(const char* name) const {
  return find_by(joints_.joints, &RubbingJoint::name, std::string_view(name));
}

PlanarLinkage MechanismStatics::linkage(double& phi) const {
  PlanarLinkage l = placed_off_the_pin(linkage_beside(data_, phi), joints_.off);
  if (weightless_) l.gravity = 0;
  return l;
}

LinkageForces MechanismStatics::solve(const PlanarLinkage& l, const LinkageState& state) const {
  LinkageForces f = forces_in(l, state);
  if (sampler_) add_friction(l, f);
  for (JointForces& joint : f.joints)
    if (const RubbingJoint* data = joint.slides ? joint_data(joint.name) : nullptr) share_edges(*data, joint);
  return f;
}

void MechanismStatics::add_friction(const PlanarLinkage& l, LinkageForces& f) const {
  const ReactionPlaces& places = sampler_->places();
  std::vector<double> values(places.size());
  const ReactionSampler::UnitReactions unit = sampler_->put(f.state.phi, l, values.data());
  // What acts without friction stands in the place of the weights.
  for (std::size_t j = 0; j < sampler_->joints.size(); ++j) {
    const JointForces& joint = f.joints[sampler_->joint_of(j)];
    for (std::size_t i = 0; i < 2; ++i) {
      const auto place = [&](std::size_t column) -> double& {
        return values[places.column(column) + places.reaction(j, i)];
      };
      for (std::size_t column = 0; column < ReactionPlaces::cases; ++column) place(column) = 0;
      place(ReactionPlaces::weight_case) =
          joint.slides ? (i == 0 ? joint.normal : joint.moment) : (i == 0 ? joint.force.x : joint.force.y);
    }
  }
  const JointFriction friction(sampler_->joints, {}, std::make_shared<ReactionsThere>(places, values));
  const JointFriction::Solved solved = friction.solve({.phi = f.state.phi, .omega = f.state.omega});
  const std::size_t first = unit.size() - places.loads;
  const auto added = [&](std::size_t row) {
    long double sum = 0;
    for (std::size_t c = 0; c < places.loads; ++c) sum += unit[first + c][row] * solved.loads[c];
    return static_cast<double>(sum);
  };
  for (std::size_t k = 0; k < f.joints.size(); ++k) {
    JointForces& joint = f.joints[k];
    const double one = added(2 * k), other = added(2 * k + 1);
    if (joint.slides) {
      joint.normal += one, joint.moment += other;
      joint.force = joint.normal * Force2{-std::sin(joint.along), std::cos(joint.along)};
    } else {
      joint.force = joint.force + Force2{one, other};
    }
  }
  f.torque += added(2 * f.joints.size());
  f.friction_residual = solved.residual;
  for (std::size_t j = 0; j < sampler_->joints.size(); ++j) {
    JointForces& joint = f.joints[sampler_->joint_of(j)];
    joint.friction = solved.loads[sampler_->joints[j].load];
    joint.friction_power = -values[places.ratio(sampler_->joints[j].load)] * f.state.omega * joint.friction;
  }
}

std::vector<double> MechanismStatics::turnings() const {
  std::vector<double> angles;
  if (!sampler_) return angles;
  const std::optional<CrankArc>& arc = data_.arc();
  const int cells = 360 * (arc ? 1 : CrankCycle(data_).turns());
  const double step = arc ? 2 * arc->reach() / cells : 2 * std::numbers::pi / 360;
  const double begin = arc ? arc->middle - arc->reach() : 0.3 * step;  // off the angles where they like to lie
  for (std::size_t j = 0; j < sampler_->joints.size(); ++j) {
    const auto rate = [&](double phi) { return sampler_->rate(j, data_.linkage(phi)); };
    double before = rate(begin);
    for (int i = 0; i < cells; ++i) {
      const double a = begin + step * i, after = rate(a + step);
      if (before * after < 0) angles.push_back(find_root(rate, a, before, a + step, after));
      before = after;
    }
  }
  return angles;
}

}  // namespace kurbel
