// crank_cycle.cpp — closure after a turn or two, the output's turns, the change points on the way.
#include "mechanisms/reduced/crank_cycle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr long double turn = 2 * std::numbers::pi_v<long double>;

// Whether all links have returned: their directions and the positions of their joints.
bool same_place(const PlanarLinkage& a, const PlanarLinkage& b) {
  const long double size = std::hypot(a.joints[1].at.x.value(), a.joints[1].at.y.value());
  const auto near = [](const Taylor& u, const Taylor& v, long double scale) {
    return std::fabs(u.value() - v.value()) <= 1e-9L * (scale + std::fabs(u.value()));
  };
  for (int i = 0; i < a.body_count; ++i) {
    const Direction &u = a.bodies[i].direction, &v = b.bodies[i].direction;
    if (!near(u.cos, v.cos, 1) || !near(u.sin, v.sin, 1)) return false;
  }
  for (int k = 0; k < a.joint_count; ++k)
    if (!near(a.joints[k].at.x, b.joints[k].at.x, size) || !near(a.joints[k].at.y, b.joints[k].at.y, size))
      return false;
  return true;
}

int turns_of(const MechanismData& data) {
  constexpr long double somewhere = 0.7L;
  const PlanarLinkage begin = data.linkage(somewhere);
  for (int turns = 1; turns <= 2; ++turns)
    if (same_place(begin, data.linkage(somewhere + turns * turn))) return turns;
  throw std::runtime_error("crank_cycle: the loop is closed neither after one turn of the crank nor after two");
}

double output_at(const MechanismData& data, double phi) { return static_cast<double>(data.linkage(phi).output[0]); }

}  // namespace

CrankCycle::CrankCycle(const MechanismData& data) : arc_(data.arc()), turns_(arc_ ? 1 : turns_of(data)) {
  if (data.rocks() && arc_)
    follow_output(data, arc_->middle - arc_->reach(), arc_->middle + arc_->reach());
  else if (data.rocks())
    follow_output(data, 0, angle());
  if (!arc_) find_change_points(data);
}

double CrankCycle::within(double phi) const {
  return arc_ ? arc_->middle + std::clamp(arc_->near(phi) - arc_->middle, -arc_->reach(), arc_->reach()) : phi;
}

double CrankCycle::along_arc(double phi) const {
  return std::clamp((arc_->near(phi) - arc_->middle) / arc_->reach(), -1.0, 1.0);
}

double CrankCycle::angle_at(double part) const {
  return arc_ ? arc_->middle + arc_->reach() * std::cos(part) : turns_ * part;
}

double CrankCycle::part_of(double phi) const { return arc_ ? std::acos(along_arc(phi)) : phi / turns_; }

double CrankCycle::part_rate(double phi) const {
  if (!arc_) return 1.0 / turns_;
  const double cosine = along_arc(phi), sine = std::sqrt(1 - cosine * cosine);
  return sine > 0 ? -1 / (arc_->reach() * sine) : 0;
}

double CrankCycle::angle() const { return static_cast<double>(turns_ * turn); }

// Steps are bisected until the rotation of the output is limited, so that no turn of it is missed.
void CrankCycle::follow_output(const MechanismData& data, double from, double end) {
  constexpr double most = 0.5, first = 2 * std::numbers::pi / 64, least = 1e-9;
  double psi = output_at(data, from);
  phi_ = {from}, part_ = {psi};
  for (double phi = from; phi < end;) {
    double step = std::min(first, end - phi), moved = 0;
    for (;; step /= 2) {
      moved = std::remainder(output_at(data, phi + step) - psi, 2 * std::numbers::pi);
      if (std::abs(moved) <= most || step < least) break;
    }
    phi = end - phi - step < least ? end : phi + step;
    psi += moved;
    phi_.push_back(phi), part_.push_back(psi);
  }
  const double wound = arc_ ? 0 : std::round((part_.back() - part_.front()) / (2 * std::numbers::pi));
  winding_ = wound / turns_;
  double mean = 0;
  for (std::size_t i = 0; i < part_.size(); ++i)
    mean += (part_[i] -= winding_ * phi_[i]) / static_cast<double>(part_.size());
  const double whole = 2 * std::numbers::pi * std::round(mean / (2 * std::numbers::pi));
  for (double& p : part_) p -= whole;
}

double CrankCycle::periodic_part(double phi, double output) const {
  if (phi_.empty()) return output;
  const double end = phi_.back(), at = arc_ ? within(phi) : phi - end * std::floor(phi / end);
  const auto next = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(phi_.begin(), phi_.end(), at) - phi_.begin()), 1, phi_.size() - 1);
  const double share = (at - phi_[next - 1]) / (phi_[next] - phi_[next - 1]);
  const double near = part_[next - 1] + share * (part_[next] - part_[next - 1]);
  const double part = output - winding_ * phi;
  return part - 2 * std::numbers::pi * std::round((part - near) / (2 * std::numbers::pi));
}

// The sine of the angle between the adjacent links has simple zeros there.
void CrankCycle::find_change_points(const MechanismData& data) {
  constexpr int samples = 96;
  constexpr double shift = 0.37;  // none is a sample
  const auto sine = [&](double phi) { return data.linkage(phi).sine; };
  const double step = 2 * std::numbers::pi / samples;
  for (int i = 0; i < samples * turns_; ++i) {
    const double from = (i + shift) * step, to = from + step;
    const bool positive = sine(from) > 0;
    if ((sine(to) > 0) == positive) continue;
    const auto before = [&](double phi) { return (sine(phi) > 0) == positive; };
    change_points_.push_back(std::fmod(halved({from, to}, 60, before).middle(), angle()));
    if (angle() - change_points_.back() < 1e-9) change_points_.back() = 0;
  }
  std::sort(change_points_.begin(), change_points_.end());
}

}  // namespace kurbel
