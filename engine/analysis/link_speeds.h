// link_speeds.h — how fast the reduction link turns in a run, forwards and backwards: whether it keeps swinging.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/run/run.h"

namespace kurbel {

// The reduction link's greatest speeds, forwards and backwards, at the ends of steps.
class LinkSpeeds final : public Observer {
 public:
  explicit LinkSpeeds(const Model& m)
      : link_(m.angles[at(m.reduction_angle)]), free_(at(link_.shaft) < m.free_shafts) {}
  void step(StepView& view) override {
    if (!free_) return;
    const double speed = link_.gain * view.y()[view.equations().speed_index(link_.shaft)];
    forwards_ = std::max(forwards_, speed), backwards_ = std::max(backwards_, -speed);
  }
  bool turned_back() const { return forwards_ > 0 && backwards_ > 0; }
  double greatest() const { return std::max(forwards_, backwards_); }

 private:
  const TrackedAngle& link_;
  bool free_;
  double forwards_ = 0, backwards_ = 0;
};

// To and fro as fast as over the wait before, hundreds of swings long: it will neither come round nor come to rest.
class LastSwing {
 public:
  bool as_before(const LinkSpeeds& speeds) {
    constexpr double same = 1e-4;
    const double now = speeds.turned_back() ? speeds.greatest() : 0, before = std::exchange(greatest_, now);
    return now > 0 && std::abs(now - before) <= same * now;
  }

 private:
  double greatest_ = 0;  // [rad/s]; 0: it did not turn back
};

}  // namespace kurbel
