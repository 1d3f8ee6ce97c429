// limits.cpp — ratings by their own formulas, of sampled values.
#include "tests/oracle/limits.h"

#include <algorithm>
#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/induction/induction_law.h"
#include "drivetrain/shared/rating_keys.h"

namespace kurbel::oracle {
namespace {

class List {
 public:
  explicit List(const Observed& seen) : seen_(seen), until_(seen.moments.back().t) {}

  nlohmann::json all() {
    const ComponentData& data = seen_.model->network.data;
    for (const auto& [component, rating] : data.all<HeatRating>()) heat(component, rating);
    for (const auto& [component, rating] : data.all<BeltRating>()) belt(component, rating);
    for (const auto& [component, limits] : data.all<CouplingLimits>())
      if (limits.maximum > 0)
        add(component, "maximum torque", limits.temperature_factor * torque(component), limits.maximum, "N*m");
    for (const auto& [component, shaft] : data.all<ShaftKeys>())
      if (shaft.allowable_shear_stress && shaft.diameter)
        add(component, "shear stress", torque(component) / shaft.polar_modulus(), *shaft.allowable_shear_stress, "Pa");
    for (const auto& [component, rating] : data.all<RimRating>()) rim(component, rating);
    for (const auto& [component, rating] : data.all<MotorRating>()) motor(component, rating);
    return std::move(list_);
  }

 private:
  void add(const std::string& component, const char* what, double value, double limit, const char* unit) {
    list_.push_back({{"component", component}, {"what", what}, {"value", value}, {"limit", limit}, {"unit", unit}});
  }
  // Of its own joint and of its segments.
  double torque(const std::string& component) const {
    double greatest = 0;
    for (const Extremes& e : seen_.torques)
      if (e.of == component || (e.of.starts_with(component + ".") && !e.of.ends_with(".in") && !e.of.ends_with(".out")))
        greatest = std::max(greatest, e.magnitude());
    return greatest;
  }
  void heat(const std::string& component, const HeatRating& rating) {
    double all = 0, hottest = 0, together = 0;
    for (const Contact& c : seen_.contacts)
      if (c.component == component)
        for (const Stretch& s : c.stretches) {
          together = s.state == Stretch::State::slips ? together + s.heat : 0;
          all += s.heat, hottest = std::max(hottest, together);
        }
    if (rating.engagement) add(component, "heat", hottest, *rating.engagement, "J");
    if (rating.power) add(component, "heat power", all / until_, *rating.power, "W");
  }
  void belt(const std::string& component, const BeltRating& b) {
    if (b.tension) add(component, "tension", b.tight_strand(torque(component)), *b.tension, "N");
    if (b.reserve) add(component, "reserve", *b.reserve * torque(component), b.limit, "N*m");
  }
  void rim(const std::string& component, const RimRating& rating) {
    if (!rating.radius) return;
    for (const Extremes& e : seen_.speeds) {
      if (e.of != component) continue;
      const double v = *rating.radius * e.magnitude();
      if (rating.speed) add(component, "rim speed", v, *rating.speed, "m/s");
      if (rating.stress && rating.density) add(component, "rim stress", *rating.density * v * v, *rating.stress, "Pa");
    }
  }
  // Over the whole run; a start counts as it lasted.
  void motor(const std::string& component, const MotorRating& rating) {
    if (!rating.states_duty()) return;
    const auto* data = seen_.model->network.data.find<InductionData>(component);
    const double rated = data ? data->rated_torque : rating.torque.value_or(0);
    for (const MotorSeen& m : seen_.motors)
      if (m.component == component && rated > 0) {
        const double part = rating.duty.time ? *rating.duty.time / until_ : rating.duty.share.value_or(1);
        add(component, "rms torque", std::sqrt(m.squares / until_), rated * std::sqrt(part), "N*m");
      }
  }

  const Observed& seen_;
  double until_;
  nlohmann::json list_ = nlohmann::json::array();
};

}  // namespace

nlohmann::json limits_of(const Observed& seen) { return List(seen).all(); }

}  // namespace kurbel::oracle
