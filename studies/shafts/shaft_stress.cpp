// shaft_stress.cpp — along the sweep over the speeds, shaft by shaft.
#include "studies/shafts/shaft_stress.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace kurbel {
namespace {

constexpr double reported_from = 0.01;  // of the sum: an order below it is not reported
constexpr double barred_below = 0.8;    // λ
constexpr double last_ratio = 1.05;     // λ
constexpr double nothing = 1e-9;        // of a stress in Pa

// The speed of the largest stress over its allowable value, or of the largest stress if there is none.
StressPeak peak_of(const LimitedJoint& joint, const Firing& firing,
                   const std::function<double(const SpeedResponse&)>& stress) {
  StressPeak by_use, by_size;
  double most_used = 0;
  for (const SpeedResponse& s : firing.sweep) {
    if (!s.kept) continue;
    StressPeak here;
    here.stress = stress(s), here.speed = s.speed, here.allowed = allowed_amplitude(joint, s.speed);
    if (here.stress > by_size.stress) by_size = here;
    if (here.use() > most_used) most_used = here.use(), by_use = here;
  }
  StressPeak peak = most_used > 0 ? by_use : by_size;
  peak.shaft = joint.name, peak.misfires = firing.misfires;
  return peak;
}

// The worst value of a ratio in a range of the sweep, as a verdict.
class Worst {
 public:
  void consider(double stress, double allowed, double lambda) {
    if (!(stress / allowed > stress_ / allowed_) && known_) return;
    stress_ = stress, allowed_ = allowed, lambda_ = lambda, known_ = true;
  }
  void add(const LimitedJoint& joint, const char* what, std::vector<Verdict>& verdicts) const {
    if (!known_) return;
    verdicts.push_back(
        {{stress_, 0}, joint.name, what, allowed_, "Pa", fmt::format("worst at λ = {:.3g}, linear response", lambda_)});
    verdicts.back().load_case = what == requirement::passing ? load_case::passing : load_case::speed_range;
  }

 private:
  bool known_ = false;
  double stress_ = 0, allowed_ = 1, lambda_ = 0;
};

}  // namespace

bool ShaftStresses::any() const { return !judged_shafts(joints).empty() && !normal.sweep.empty(); }

std::vector<std::size_t> judged_shafts(const std::vector<LimitedJoint>& joints) {
  std::vector<std::size_t> shafts;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].limits.polar_modulus > 0) shafts.push_back(j);
  return shafts;
}

double summed_stress(const LimitedJoint& joint, const JointResponse& response) {
  return 0.5 * (response.upper - response.lower) / joint.limits.polar_modulus;
}

double order_stress(const LimitedJoint& joint, Complex order) { return std::abs(order) / joint.limits.polar_modulus; }

double allowed_amplitude(const LimitedJoint& joint, double speed) {
  const ShaftRating& shaft = joint.limits.shaft;
  return std::min(shaft.vibratory.value_or(HUGE_VAL), shaft.is_of_propulsion() ? joint.continuous(speed) : HUGE_VAL);
}

std::vector<StressPeak> stress_peaks(const std::vector<LimitedJoint>& joints, const Firing& firing) {
  std::vector<StressPeak> peaks;
  for (const std::size_t j : judged_shafts(joints)) {
    const LimitedJoint& joint = joints[j];
    const auto add = [&](double order, const auto& stress) {
      peaks.push_back(peak_of(joint, firing, stress));
      peaks.back().joint = j, peaks.back().order = order;
    };
    add(0, [&](const SpeedResponse& s) { return summed_stress(joint, s.joints[j]); });
    const std::size_t begin = peaks.size();
    const double least = std::max(reported_from * peaks.back().stress, nothing);
    const std::size_t harmonics = firing.sweep.empty() ? 0 : firing.sweep.front().orders[j].size();
    for (std::size_t r = 1; r < harmonics; ++r)
      add(firing.fundamental * static_cast<double>(r),
          [&](const SpeedResponse& s) { return order_stress(joint, s.orders[j][r]); });
    peaks.erase(std::remove_if(peaks.begin() + static_cast<std::ptrdiff_t>(begin), peaks.end(),
                               [&](const StressPeak& p) { return p.stress < least; }),
                peaks.end());
    std::sort(peaks.begin() + static_cast<std::ptrdiff_t>(begin), peaks.end(),
              [](const StressPeak& a, const StressPeak& b) { return a.stress > b.stress; });
  }
  return peaks;
}

const StressPeak* worst_sum(const std::vector<StressPeak>& peaks, std::size_t joint) {
  const StressPeak* worst = nullptr;
  for (const StressPeak& p : peaks) {
    if (p.joint != joint || p.order != 0) continue;
    if (!worst || p.use() > worst->use() || (p.use() == worst->use() && p.stress > worst->stress)) worst = &p;
  }
  return worst;
}

void judge_over_speeds(const std::vector<LimitedJoint>& joints, const std::vector<SpeedResponse>& sweep,
                       std::vector<Verdict>& verdicts) {
  for (const std::size_t j : judged_shafts(joints)) {
    const LimitedJoint& joint = joints[j];
    if (!joint.limits.shaft.is_of_propulsion()) continue;
    Worst above, passing;
    for (const SpeedResponse& s : sweep) {
      const double lambda = joint.speed_ratio(s.speed), stress = summed_stress(joint, s.joints[j]);
      if (!s.kept || lambda > last_ratio) continue;
      if (lambda > barred_below)
        above.consider(stress, joint.continuous(s.speed), lambda);
      else
        passing.consider(stress, joint.transient(s.speed), lambda);
    }
    above.add(joint, requirement::upper_range, verdicts);
    passing.add(joint, requirement::passing, verdicts);
  }
}

}  // namespace kurbel
