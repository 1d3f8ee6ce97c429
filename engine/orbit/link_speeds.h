// link_speeds.h — observers of the shafts' speeds in a run: whether the link keeps vibrating, reverses, has stopped.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/run/run.h"

namespace kurbel {

// The reduction link's maximum speeds, forwards and backwards, at the ends of steps.
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

// Vibration as fast as in the previous interval of hundreds of periods: it will neither complete a turn nor stop.
class LastOscillation {
 public:
  bool as_before(const LinkSpeeds& speeds) {
    constexpr double same = 1e-4;
    const double now = speeds.turned_back() ? speeds.greatest() : 0, before = std::exchange(greatest_, now);
    return now > 0 && std::abs(now - before) <= same * now;
  }

 private:
  double greatest_ = 0;  // [rad/s]; 0: it did not reverse
};

// Last times at which the link was faster than parts of its rated speed, located on the dense output; if its speed is
// prescribed, the fastest of the free shafts.
class LastMotion final : public Observer {
 public:
  static constexpr std::array<double, 3> parts{1e-2, 1e-3, 1e-9};
  explicit LastMotion(const Model& m) : m_(m), link_(at(m.angles[at(m.reduction_angle)].shaft)) {}
  void step(StepView& view) override {
    constexpr int looks = 8;  // per step
    double before = view.t_previous(), speed_before = part_of_rated(view, before);
    for (int k = 1; k <= looks; ++k) {
      const double t = k < looks ? view.t_previous() + (view.t() - view.t_previous()) * k / looks : view.t();
      const double speed = part_of_rated(view, t);
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (speed > parts[i])
          last_[i] = t;
        else if (speed_before > parts[i])
          last_[i] = find_root([&](double x) { return part_of_rated(view, x) - parts[i]; }, before,
                               speed_before - parts[i], t, speed - parts[i]);
      before = t, speed_before = speed;
    }
  }
  // For each of the parts [s]; 0: never.
  const std::array<double, parts.size()>& times() const { return last_; }

 private:
  double part_of_rated(StepView& view, double t) const {
    const bool free = link_ < m_.free_shafts;
    double speed = 0;
    for (std::size_t s = free ? link_ : 0; s < (free ? link_ + 1 : m_.free_shafts); ++s)
      speed = std::max(
          speed, std::abs(view.at(t, view.equations().speed_index(static_cast<int>(s)))) / m_.shafts[s].speed_scale);
    return speed;
  }

  const Model& m_;
  std::size_t link_;
  std::array<double, parts.size()> last_{};
};

// Times at which the link reverses from forwards to backwards, located on the dense output.
class TurningTimes final : public Observer {
 public:
  explicit TurningTimes(const Model& m) : shaft_(m.angles[at(m.reduction_angle)].shaft) {}
  void step(StepView& view) override {
    if (at(shaft_) >= view.equations().model().free_shafts) return;
    const std::size_t speed = view.equations().speed_index(shaft_);
    const auto at_time = [&](double t) { return view.at(t, speed); };
    const double before = at_time(view.t_previous()), now = at_time(view.t());
    if (before > 0 && now <= 0) times_.push_back(find_root(at_time, view.t_previous(), before, view.t(), now));
  }
  const std::vector<double>& times() const { return times_; }

 private:
  int shaft_;
  std::vector<double> times_;  // [s]
};

}  // namespace kurbel
