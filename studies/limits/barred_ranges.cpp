// barred_ranges.cpp — finds along the speed sweep, joint by joint, where a load exceeds its allowable value.
#include "studies/limits/barred_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr double nothing = 1e-6;     // of the rated torque: an amplitude below it is none
constexpr double end_within = 1e-6;  // of the limit: where the load is so near to it, a range ends

// A load and its allowable value [N·m].
struct Use {
  double load = 0, limit = 0;
  std::string reason;
  double excess() const { return load - limit; }
  double share() const { return limit > 0 ? load / limit : load > 0 ? HUGE_VAL : 0; }
};
const Use none{0, HUGE_VAL, ""};

// Limits of the torque itself, without the factors of a standard [N·m]; 0: not given.
double most_torque(const DriveLimits& l) { return l.maximum / l.temperature_factor; }
double most_by_shear(const DriveLimits& l) { return l.shear_stress * l.polar_modulus / l.application_factor; }

// By the limit with the highest utilisation; factors of a standard reduce the limit, so that loads are torques. Not by T_KN: at
// speeds that are not held, the mean torque is the accelerating excess of drive over load, not that at constant speed.
Use by_limits(const LimitedJoint& joint, const JointLoad& load) {
  const DriveLimits& l = joint.limits;
  Use most = none;
  const auto consider = [&](double torque, double limit, const char* reason) {
    if (limit > 0 && (most.reason.empty() || torque / limit > most.share())) most = {torque, limit, reason};
  };
  const double largest = std::abs(load.largest().value);
  consider(load.vibratory.value, l.vibratory / (l.temperature_factor * l.frequency_factor(load.frequency_factor)),
           "vibratory_torque");
  consider(largest, most_torque(l), "maximum_torque");
  consider(largest, most_by_shear(l), "allowable_shear_stress");
  const double amplitude = load.amplitude().value;
  if (l.shaft.vibratory) consider(amplitude, *l.shaft.vibratory * l.polar_modulus, "allowable_vibratory_stress");
  if (l.shaft.endurance)
    consider(amplitude,
             amplitude * *l.shaft.endurance * l.polar_modulus / l.shaft.fatigue_stress(amplitude, load.middle().value),
             "endurance_limit");
  // Heat grows with the square of the amplitude.
  if (l.power > 0 && load.power.value > 0)
    consider(load.vibratory.value, load.vibratory.value * std::sqrt(l.power / load.power.value), "dissipated_power");
  return most;
}

// By the lower limit of the torque itself: the mean alone.
Use by_mean(const LimitedJoint& joint, const JointLoad& load) {
  Use use = none;
  for (const auto& [limit, reason] : {std::pair(most_torque(joint.limits), "maximum_torque"),
                                      std::pair(most_by_shear(joint.limits), "allowable_shear_stress")})
    if (limit > 0 && limit < use.limit) use = {std::abs(load.mean.value), limit, reason};
  return use;
}

// Of what alternates: a mean beyond a limit bars nothing.
Use by_vibration(LimitedJoint joint, const JointLoad& load) {
  if (!(load.vibratory.value > nothing * joint.rated)) return none;
  const double mean = std::abs(load.mean.value);
  if (mean >= most_torque(joint.limits)) joint.limits.maximum = 0;
  if (mean >= most_by_shear(joint.limits)) joint.limits.shear_stress = 0;
  return by_limits(joint, load);
}

Use by_class(const LimitedJoint& joint, const JointLoad& load, double speed) {
  return {load.amplitude().value, joint.continuous(speed) * joint.limits.polar_modulus, "UR M68"};
}

Use by_rule(const LimitedJoint& joint, const JointLoad& load, double factor) {
  const double mean = std::abs(load.mean.value);
  if (joint.stands) return none;
  return {load.vibratory.value, factor * std::max(mean, joint.rated),
          fmt::format("{:g} × {} torque", factor, mean > joint.rated ? "mean" : "rated")};
}

Use by_sign(const LimitedJoint& joint, const JointLoad& load) {
  return {load.vibratory.value, std::max(std::abs(load.mean.value), nothing * joint.rated), "torque changes sign"};
}

class Along {
 public:
  Along(std::size_t joint, BarredRange::By by, std::function<Use(const SpeedLoads&)> use,
        const std::vector<SpeedLoads>& sweep, const std::function<std::vector<JointLoad>(double)>& at,
        std::vector<BarredRange>& out)
      : joint_(joint), by_(by), use_(std::move(use)), sweep_(sweep), at_(at), out_(out) {}

  void go() {
    std::optional<BarredRange> open;
    Use before;
    for (std::size_t i = 0; i < sweep_.size(); ++i) {
      const Use now = use_(sweep_[i]);
      const bool barred = now.excess() > 0;
      const double edge = i > 0 && barred != open.has_value() ? edge_between(i, before, now) : sweep_[i].speed;
      if (barred && !open)
        open = BarredRange{joint_, edge, edge, now.limit, now.load, now.reason, by_, false, sweep_[i].speed};
      if (barred) {
        open->to = sweep_[i].speed;
        if (now.share() > open->peak / open->limit)
          open->peak = now.load, open->limit = now.limit, open->reason = now.reason, open->worst = sweep_[i].speed;
      } else if (open) {
        open->to = edge;
        close(*open);
        open.reset();
      }
      before = now;
    }
    if (open) close(*open);
  }

 private:
  void close(BarredRange& range) {
    range.everywhere = range.from <= sweep_.front().speed && range.to >= sweep_.back().speed;
    out_.push_back(std::move(range));
  }
  // By linear interpolation between two points of the sweep, or at the root of the excess.
  double edge_between(std::size_t i, const Use& before, const Use& now) const {
    const double a = sweep_[i - 1].speed, b = sweep_[i].speed, fa = before.excess(), fb = now.excess();
    if (!std::isfinite(fa) || !std::isfinite(fb)) return std::isfinite(fa) ? a : b;
    if (fa == 0) return a;
    if (fb == 0) return b;
    if (!at_) return a - fa * (b - a) / (fb - fa);
    return find_root(
        [this](double speed) {
          return use_({speed, at_(speed)}).excess();
        },
        a, fa, b, fb, end_within * std::max(before.limit, now.limit));
  }

  std::size_t joint_;
  BarredRange::By by_;
  std::function<Use(const SpeedLoads&)> use_;
  const std::vector<SpeedLoads>& sweep_;
  const std::function<std::vector<JointLoad>(double)>& at_;
  std::vector<BarredRange>& out_;
};

// A resonance within the sweep bars at least the range of the rule; touching ranges are merged.
void bar_by_class(const LimitedJoint& joint, std::size_t j, const std::vector<SpeedLoads>& sweep,
                  const std::function<std::vector<JointLoad>(double)>& at, std::vector<BarredRange>& out) {
  std::vector<BarredRange> found;
  const auto use = [&joint, j](const SpeedLoads& s) { return by_class(joint, s.joints[j], s.speed); };
  Along(j, BarredRange::By::limit, use, sweep, at, found).go();
  const std::size_t before = out.size();
  for (BarredRange& range : found) {
    if (range.worst > sweep.front().speed && range.worst < sweep.back().speed) {
      const BarredAround around = barred_around(joint.speed_ratio(range.worst));
      range.from = std::min(range.from, around.from * range.worst);
      range.to = std::max(range.to, around.to * range.worst);
    }
    if (out.size() == before || range.from > out.back().to) {
      out.push_back(std::move(range));
      continue;
    }
    BarredRange& last = out.back();
    last.to = std::max(last.to, range.to);
    if (range.peak / range.limit > last.peak / last.limit)
      last.peak = range.peak, last.limit = range.limit, last.worst = range.worst;
  }
}

}  // namespace

const char* name_of(BarredRange::By by) {
  return by == BarredRange::By::limit ? "limit" : by == BarredRange::By::rule ? "rule" : "sign";
}

std::vector<BarredRange> barred_ranges(const std::vector<LimitedJoint>& joints, const std::vector<SpeedLoads>& sweep,
                                       double factor, const std::function<std::vector<JointLoad>(double)>& at) {
  std::vector<BarredRange> ranges;
  if (sweep.empty()) return ranges;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const LimitedJoint& joint = joints[j];
    if (joint.beside_middle) continue;
    const auto along = [&](BarredRange::By by, auto use) {
      Along(
          j, by, [&, j, use](const SpeedLoads& loads) { return use(loads.joints[j]); }, sweep, at, ranges)
          .go();
    };
    if (joint.limits.shaft.is_of_propulsion()) bar_by_class(joint, j, sweep, at, ranges);
    if (joint.limits.any())
      along(BarredRange::By::limit, [&](const JointLoad& load) { return by_vibration(joint, load); });
    else
      along(BarredRange::By::rule, [&](const JointLoad& load) { return by_rule(joint, load, factor); });
    if (joint.has_play) along(BarredRange::By::sign, [&](const JointLoad& load) { return by_sign(joint, load); });
  }
  return ranges;
}

std::vector<BarredRange> beyond_by_mean(const std::vector<LimitedJoint>& joints, const std::vector<SpeedLoads>& sweep,
                                        const std::function<std::vector<JointLoad>(double)>& at) {
  std::vector<BarredRange> ranges;
  for (std::size_t j = 0; j < joints.size() && !sweep.empty(); ++j)
    Along(
        j, BarredRange::By::limit, [&, j](const SpeedLoads& loads) { return by_mean(joints[j], loads.joints[j]); },
        sweep, at, ranges)
        .go();
  return ranges;
}

double share_of_bearable(const LimitedJoint& joint, const JointLoad& load, double speed, double factor) {
  if (!joint.limits.any()) return by_rule(joint, load, factor).share();
  const double share = by_limits(joint, load).share();
  return joint.limits.shaft.is_of_propulsion() ? std::max(share, by_class(joint, load, speed).share()) : share;
}

const BarredRange* worst_of(const std::vector<BarredRange>& ranges) {
  const auto worse = [](const BarredRange& a, const BarredRange& b) {
    if (a.by != b.by) return a.by > b.by;
    return a.peak / a.limit < b.peak / b.limit;
  };
  const auto worst = std::max_element(ranges.begin(), ranges.end(), worse);
  return worst == ranges.end() ? nullptr : &*worst;
}

}  // namespace kurbel
