// along_cycle.h — the machine along its steady cycle, as a function of the angle of its reduction link.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/numerics/deadline.h"
#include "engine/rigid/rigid_machine.h"
#include "studies/cycle/orbit_cycle.h"
#include "studies/reduce/targets.h"

namespace kurbel {

// `target`: node of the reduction, whose speed is the first of cycle.others; −1: the link.
class AlongCycle {
 public:
  AlongCycle(const OrbitCycle& cycle, int target)
      : c_(cycle), slope_(cycle.inertia.derivative()), speed_slope_(cycle.speed.derivative()) {
    if (target < 0) return;
    const Piecewise& speed = c_.speed;
    ratio_ =
        Piecewise::sample(
            speed.breaks(), 1,
            [&](double s, std::span<double> out) { out[0] = c_.others.front().value(s) / (c_.sense * speed.value(s)); },
            [](double) { Deadline::check(); }, 1e-9)
            .front();
    ratio_slope_ = ratio_->derivative();
  }
  double way(double phi) const {
    const double s = c_.sense * phi;
    return s - c_.way() * std::floor(s / c_.way());
  }
  RigidMachine::At at(double phi) {
    const double s = way(phi);
    share_.clear();
    for (const Piecewise& one : c_.cycle.share) share_.push_back(one.value(s));
    constexpr double dust = 1e-9;  // sampling error of a constant
    const double inertia = std::max(0.0, c_.inertia.value(s)), slope = c_.sense * slope_.value(s);
    return {inertia, std::abs(slope) < dust * inertia ? 0.0 : slope, 0, share_};
  }
  double mechanism_inertia(double phi) const { return c_.cycle.mechanism.value.value(way(phi)); }
  // Ratio of the chosen shaft to the link, and its derivative by the link's angle.
  RatioAt ratio(double phi) const {
    if (!ratio_) return {1, 0};
    return {ratio_->value(way(phi)), c_.sense * ratio_slope_->value(way(phi))};
  }
  // ω and ε = ω dω/dφ of the link.
  std::pair<double, double> motion(double phi) const {
    const double s = way(phi), speed = c_.speed.value(s);
    return {c_.sense * speed, c_.sense * speed * speed_slope_.value(s)};
  }
  double mean_ratio() const { return ratio_ ? ratio_->mean() : 1; }
  const OrbitCycle& cycle() const { return c_; }

 private:
  const OrbitCycle c_;
  Piecewise slope_, speed_slope_;
  std::optional<Piecewise> ratio_, ratio_slope_;
  std::vector<double> share_;
};

}  // namespace kurbel
