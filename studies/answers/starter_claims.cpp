// starter_claims.cpp — starters that wait for a speed or a current which the steady motion never reaches.
#include "studies/answers/starter_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/motors/motors.h"
#include "engine/model/model.h"
#include "engine/numerics/index.h"
#include "engine/scene/quantity_place.h"

namespace kurbel {
namespace {

constexpr double same = 1e-6;  // of a guard

class StarterJudge {
 public:
  StarterJudge(Equations& equations, double t, const std::vector<double>& y)
      : equations_(equations), m_(equations.model()), guards_(equations.guard_count()) {
    equations.guards(t, y, guards_);
    now_ = &equations.snapshot(t, y);
  }

  // `mean`: of the link.
  Claims all(double mean) const {
    Claims claims;
    for (const MotorTorque& motor : m_.motors) {
      const bool is_on = std::any_of(motor.elements.begin(), motor.elements.end(),
                                     [&](std::size_t e) { return equations_.modes().active[e] != 0; });
      if (!is_on) continue;
      const std::optional<double> at_speed = given(motor, "switch_speed"), at_current = given(motor, "switch_current");
      if (at_speed && waits(motor, (*at_speed - speed_of(motor)) / *at_speed)) {
        const double speed = mean * m_.node_ratio[at(motor.node)];
        add(claims,
            claimed(Predicate::starter_waits,
                    fmt::format("\"{}\" stays in star: its switching speed, {}, is not reached ({})", motor.component,
                                m_.scene.speed_unit.text(*at_speed, 4), m_.scene.speed_unit.text(speed, 4)),
                    motor.component, {.value = speed, .limit = *at_speed, .unit = "rad/s"}));
      } else if (const double current = current_of(motor); at_current && waits(motor, current / *at_current - 1)) {
        add(claims,
            claimed(Predicate::starter_waits,
                    fmt::format("\"{}\" stays on its starting resistances: its current, {:.4g} A, does not fall "
                                "to the {:.4g} A at which the next is cut out",
                                motor.component, current, *at_current),
                    motor.component, {.value = current, .limit = *at_current, .unit = "A"}));
      }
    }
    return claims;
  }

 private:
  std::optional<double> given(const MotorTorque& motor, const char* key) const {
    const Setting* const setting = quantity_place(m_.scene.components, motor.component + "." + key).setting;
    return setting && setting->number > 0 ? std::optional(setting->number) : std::nullopt;
  }
  double speed_of(const MotorTorque& motor) const {
    return m_.gain_of_node[at(motor.node)] * now_->now.speed[m_.shaft_of_node[at(motor.node)]];
  }
  // Of a DC motor, by its torque; 0: it has none [A].
  double current_of(const MotorTorque& motor) const {
    const auto* const by = m_.network.data.find<ArmatureCurrent>(motor.component);
    const double torque = std::abs(motor.torque(*now_));
    return by ? std::sqrt(by->by_mean * torque + by->by_square * torque * torque) : 0;
  }
  // One of its guards has this value, > 0: that of a starter whose next stage has not begun. In its last one it has none.
  bool waits(const MotorTorque& motor, double left) const {
    if (!(left > 0) || !(left < 1)) return false;
    for (std::size_t g = 0; g < guards_.size(); ++g)
      if (std::abs(guards_[g] - left) < same && equations_.guard_owner(g) == motor.component) return true;
    return false;
  }

  Equations& equations_;
  const Model& m_;
  std::vector<double> guards_;
  const Snapshot* now_ = nullptr;
};

}  // namespace

Claims starter_claims(Equations& equations, double t, const std::vector<double>& y, double mean_speed) {
  return StarterJudge(equations, t, y).all(mean_speed);
}

}  // namespace kurbel
