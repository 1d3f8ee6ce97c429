// reaction_sampler.cpp — which joints rub, and what a unit of everything does to their reactions.
#include "mechanisms/joints/reaction_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mechanisms/link_forces/link_forces.h"

namespace kurbel {
namespace {

// Velocity of body `on` against `from` by ω: of a pin the angle's, of a slide along it.
long double relative_rate(const PlanarLinkage& l, const PlanarLinkage::Joint& j) {
  const auto body = [&](int b) -> const PlanarLinkage::Body& { return l.bodies[static_cast<std::size_t>(b)]; };
  const auto turning = [&](int b) { return b == PlanarLinkage::frame ? 0 : body(b).direction.rate().value(); };
  if (!j.slides) return turning(j.on) - turning(j.from);
  const auto along = [&](int b) -> long double {
    if (b == PlanarLinkage::frame) return 0;
    const long double x = j.at.x.value() - body(b).com.x.value(), y = j.at.y.value() - body(b).com.y.value();
    const long double vx = body(b).com.x.slope() - turning(b) * y, vy = body(b).com.y.slope() + turning(b) * x;
    return vx * j.along.cos.value() + vy * j.along.sin.value();
  };
  return along(j.on) - along(j.from);
}

}  // namespace

PlanarLinkage placed_off_the_pin(PlanarLinkage l, const OffThePin& off) {
  if (l.rocks || (off.com == 0 && off.load == 0)) return l;
  l.bodies.back().com.x = l.bodies.back().com.x + Taylor(off.com);
  l.load_at.y = l.load_at.y + Taylor(off.load);
  return l;
}

ReactionSampler::ReactionSampler(const MechanismData& data, const std::vector<RubbingJoint>& rubbing,
                                 const OffThePin& off, std::vector<ActsWithin> within)
    : data_(data), off_(off), within_(std::move(within)) {
  const PlanarLinkage l = linkage(data.arc() ? data.arc()->middle : 0.5);
  for (const RubbingJoint& r : rubbing) {
    bool any = false;
    for (int k = 0; k < l.joint_count; ++k) {
      const PlanarLinkage::Joint& j = l.joints[static_cast<std::size_t>(k)];
      if (r.name != j.name) continue;
      any = true;
      validate(r);
      if (r.rubs(j.slides)) add(k, r, j);
    }
    if (!any) throw std::invalid_argument(fmt::format("no joint \"{}\" in the linkage", r.name));
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].slides && joints[j].data.length > 0 && joints[j].data.width > 0)
      joints[j].couple = loads_.size(), loads_.push_back({static_cast<int>(joint_[j]), true});
  places_.joints = joints.size(), places_.loads = loads_.size(), places_.applied = within_.size();
  if (joints.size() > JointFriction::most_joints || loads_.size() > JointFriction::most_loads)
    throw std::invalid_argument(
        fmt::format("{} joints have friction; at most {} may", joints.size(), JointFriction::most_joints));
  if (within_.size() > JointFriction::most_applied)
    throw std::invalid_argument(
        fmt::format("{} springs, forces and couples press on joints with friction; at most {} may", within_.size(),
                    JointFriction::most_applied));
}

void ReactionSampler::add(int number, const RubbingJoint& r, const PlanarLinkage::Joint& j) {
  joints.push_back({.data = r, .slides = j.slides, .load = loads_.size(), .between = j.from_is_between ? -1 : 1});
  loads_.push_back({number, !j.slides});
  joint_.push_back(static_cast<std::size_t>(number));
}

void ReactionSampler::operator()(double phi, double* values) const { put(phi, linkage(phi), values); }

ReactionSampler::UnitReactions ReactionSampler::put(double phi, const PlanarLinkage& l, double* values) const {
  UnitReactions unit = units(phi, l);
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < unit.size(); ++c)
        values[places_.column(c) + places_.reaction(j, i)] = static_cast<double>(unit[c][2 * joint_[j] + i]);
  for (std::size_t k = 0; k < loads_.size(); ++k) values[places_.ratio(k)] = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) values[places_.ratio(joints[j].load)] = rate(j, l);
  return unit;
}

ReactionSampler::UnitReactions ReactionSampler::units(double phi, const PlanarLinkage& l) const {
  std::vector<std::vector<AppliedForce>> applied(within_.size());
  if (within_.empty()) return unit_reactions(l, loads_);
  const LinkPoses poses = within_.front().along.linkage->poses(phi);
  for (std::size_t k = 0; k < within_.size(); ++k) add_actions(within_[k].along, 1, poses, l, applied[k]);
  return unit_reactions(l, loads_, applied);
}

double ReactionSampler::rate(std::size_t joint, const PlanarLinkage& l) const {
  return static_cast<double>(relative_rate(l, l.joints[joint_[joint]]));
}

void ReactionSampler::widen(double phi, Greatest& to) const {
  const PlanarLinkage l = linkage(phi);
  const auto unit = units(phi, l);
  const double length = static_cast<double>(std::hypot(l.joints[1].at.x.value(), l.joints[1].at.y.value()));
  to.force.resize(unit.size()), to.moment.resize(unit.size());
  for (std::size_t c = 0; c < unit.size(); ++c) {
    double &force = to.force[c], &moment = to.moment[c];
    for (std::size_t k = 0; k < l.joints.size(); ++k) {
      double& second = l.joints[k].slides ? moment : force;
      force = std::max(force, std::abs(static_cast<double>(unit[c][2 * k])));
      second = std::max(second, std::abs(static_cast<double>(unit[c][2 * k + 1])));
    }
    if (c >= ReactionPlaces::load_case) {
      const std::size_t k = c - ReactionPlaces::cases;  // of what acts within, then of the friction loads
      const bool couple = c == ReactionPlaces::load_case ? l.rocks
                          : k < within_.size()           ? within_[k].along.travel.rocks()
                                                         : loads_[k - within_.size()].couple;
      force = std::max(force, couple ? 1 / length : 1);
    }
    force = std::max(force, moment / length), moment = std::max(moment, force * length);
  }
}

}  // namespace kurbel
