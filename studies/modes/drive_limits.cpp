// drive_limits.cpp — limits that the scene's components state, where swings exceed them, and DIN 740-2.
#include "studies/modes/drive_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "drivetrain/couplings/coupling_keys.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;

DriveLimits stated_limits(const Section* s) {
  if (!s || !s->kind) return {};
  const CouplingLimits given = coupling_limit_fields().read(*s);
  DriveLimits limits = {given.nominal, given.maximum, given.vibratory, given.power, given.application_factor};
  if (s->kind->name == "shaft") {
    const ShaftKeys shaft = shaft_fields().read(*s);
    limits.shear_stress = shaft.allowable_shear_stress.value_or(0);
    if (limits.shear_stress > 0) limits.polar_modulus = 2 * shaft.polar_moment() / *shaft.diameter;
  }
  return limits;
}

// Excess of a joint's swing over what it may have; > 0: barred.
struct Bar {
  double limit = 0, value = 0;
  std::string reason;
};
// `mean_factor`: what bars a joint without limits, times its mean torque.
Bar bar(const DriveLimits& limits, const JointResponse& joint, bool mean_judges, double mean_factor) {
  if (limits.vibratory > 0) return {limits.vibratory, joint.peak, "vibratory_torque"};
  if (limits.maximum > 0)
    return {limits.maximum, std::max(std::abs(joint.upper), std::abs(joint.lower)), "maximum_torque"};
  if (limits.shear_stress > 0)
    return {limits.shear_stress * limits.polar_modulus, std::max(std::abs(joint.upper), std::abs(joint.lower)),
            "allowable_shear_stress"};
  return {mean_judges ? mean_factor * std::abs(joint.mean) : HUGE_VAL, joint.peak,
          fmt::format("{:g} × mean torque", mean_factor)};
}

// Along the sweep over the speeds.
void add_barred_ranges(std::size_t j, bool mean_judges, double mean_factor, ModesStudy& found) {
  std::optional<BarredRange> open;
  double speed_before = 0, excess_before = 0;
  for (std::size_t i = 0; i < found.sweep.size(); ++i) {
    const SpeedResponse& s = found.sweep[i];
    const Bar b = bar(found.limits[j], s.joints[j], mean_judges, mean_factor);
    const double excess = b.value - b.limit;
    const bool barred = excess > 0;
    // Ends between two points of the sweep: straight between them.
    const double share = i > 0 && excess != excess_before && std::isfinite(excess) && std::isfinite(excess_before)
                             ? std::clamp(-excess_before / (excess - excess_before), 0.0, 1.0)
                             : 1.0;
    const double edge = i > 0 ? speed_before + share * (s.speed - speed_before) : s.speed;
    if (barred && !open) open = BarredRange{j, edge, s.speed, b.limit, b.value, b.reason};
    if (barred) {
      open->to = s.speed;
      if (b.value > open->peak) open->peak = b.value, open->limit = b.limit;
    } else if (open) {
      open->to = edge;
      found.barred.push_back(*open);
      open.reset();
    }
    speed_before = s.speed;
    excess_before = excess;
  }
  if (open) found.barred.push_back(*open);
}

// DIN 740-2 at the operating point, and passing through the resonances of the range below it.
void add_verdicts(std::size_t j, ModesStudy& found) {
  const DriveLimits& limits = found.limits[j];
  const JointResponse& here = found.here.joints[j];
  const std::string& name = found.joint_names[j];
  double passing = 0, speed = 0;
  for (const SpeedResponse& s : found.sweep) {
    const double most = std::max(std::abs(s.joints[j].upper), std::abs(s.joints[j].lower));
    if (s.speed <= std::abs(found.drive.at.speed) * (1 + 1e-9) && most > passing) passing = most, speed = s.speed;
  }
  double largest = std::max(std::abs(here.upper), std::abs(here.lower));
  if (limits.nominal > 0)
    found.verdicts.push_back({name, "nominal torque: K_A |T_mean| ≤ T_KN",
                              limits.application_factor * std::abs(here.mean), limits.nominal, "N*m",
                              fmt::format("K_A = {:g}", limits.application_factor)});
  if (limits.maximum > 0) {
    found.verdicts.push_back({name, "maximum torque while passing resonances: |T| ≤ T_Kmax", std::max(passing, largest),
                              limits.maximum, "N*m",
                              passing > largest ? fmt::format("steady swing at {}; a quick passage stays below it",
                                                              found.speed_unit.text(speed, 5))
                                                : "at the operating point"});
    if (found.history && found.history->component == name)
      found.verdicts.push_back({name, "maximum torque of the simulated run: |T| ≤ T_Kmax",
                                std::max(found.history->greatest, -found.history->least), limits.maximum, "N*m",
                                "of the samples"});
  }
  if (limits.vibratory > 0) {
    // Continuous swing: S_f = √(f/10 Hz) above 10 Hz.
    const double f = here.dominant_omega / (2 * pi);
    const double factor = f > 10 ? std::sqrt(f / 10) : 1;
    found.verdicts.push_back({name, "vibratory torque: S_f T_W ≤ T_KW", factor * here.peak, limits.vibratory, "N*m",
                              fmt::format("S_f = √(f/10 Hz) = {:.3g} at {:.4g} Hz", factor, f)});
  }
  if (limits.power > 0)
    found.verdicts.push_back({name, "dissipated power: P_W ≤ P_KW", here.power, limits.power, "W", ""});
  if (limits.shear_stress > 0)
    found.verdicts.push_back(
        {name, "shear stress: K_A |T|/W_p ≤ τ_allowable", limits.application_factor * largest / limits.polar_modulus,
         limits.shear_stress, "Pa",
         fmt::format("W_p = {:.5g} cm³, K_A = {:g}", 1e6 * limits.polar_modulus, limits.application_factor)});
}

}  // namespace

void find_barred_ranges(const Model& model, double barred_factor, ModesStudy& found) {
  std::vector<char> mean_judges;  // per joint: without limits of its own, its mean torque bounds its swing
  for (const ElasticJoint& e : model.elastic) {
    const Section* s = model.scene.find(model.network.joints[at(e.joint)].component);
    // A coupling hammers where its torque changes sign; crankshafts do so by nature, idle ends carry no mean torque.
    const std::size_t j = found.limits.size();
    const double rated = model.torque_scale / model.scale_ratio[at(model.network.joints[at(e.joint)].a)];
    mean_judges.push_back((!s || !s->kind || s->kind->name == "coupling") &&
                          std::abs(found.here.joints[j].mean) > 0.02 * rated);
    found.limits.push_back(stated_limits(s));
  }
  for (std::size_t j = 0; j < found.joint_names.size(); ++j) add_barred_ranges(j, mean_judges[j], barred_factor, found);
}

void judge_limits(ModesStudy& found) {
  for (std::size_t j = 0; j < found.limits.size(); ++j)
    if (found.limits[j].any()) add_verdicts(j, found);
}

}  // namespace kurbel
