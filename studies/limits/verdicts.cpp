// verdicts.cpp — every limit against what the steady motion and the run-up bring.
#include "studies/limits/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

Estimate times(double factor, const Estimate& m) { return factor * abs(m); }

class Judge {
 public:
  Judge(const LimitedJoint& joint, const JointLoad& load, double speed, const RunUp& run_up, const RunUp::Peak* peak,
        const Passing* passing, const SpeedUnit& unit, std::vector<Verdict>& out)
      : joint_(joint),
        limits_(joint.limits),
        load_(load),
        speed_(speed),
        run_up_(run_up),
        peak_(peak),
        passing_(passing),
        unit_(unit),
        out_(out) {}

  void all() {
    if (limits_.nominal > 0)
      add("nominal torque: K_A S_t |T_mean| ≤ T_KN",
          times(limits_.application_factor * limits_.temperature_factor, load_.mean), limits_.nominal, "N*m",
          fmt::format("K_A = {:g}, S_t = {:g}", limits_.application_factor, limits_.temperature_factor),
          "nominal_torque");
    if (limits_.maximum > 0) maximum();
    if (limits_.vibratory > 0)
      add("vibratory torque: S_t S_f T_W ≤ T_KW", times(limits_.temperature_factor, load_.weighted), limits_.vibratory,
          "N*m",
          load_.frequency > 0 ? fmt::format("S_t = {:g}, S_f = {:.3g}, strongest at {:.4g} Hz",
                                            limits_.temperature_factor, load_.frequency_factor, load_.frequency)
                              : "it does not swing",
          "vibratory_torque");
    if (limits_.power > 0)
      add("dissipated power: P_W ≤ P_KW", times(1, load_.power), limits_.power, "W", "", "dissipated_power");
    if (limits_.shear_stress > 0) shear();
    if (limits_.shaft.any()) swinging_stress();
  }

 private:
  // `key`: of the limit in the scene, with which it would hold; null: the section carries it.
  Verdict& add(std::string requirement, const Estimate& value, double limit, std::string unit, std::string note,
               const char* key = nullptr) {
    Verdict v{joint_.name,     std::move(requirement), value.value, limit, std::move(unit),
              std::move(note), value.error.value_or(0)};
    if (v.state() == Compliance::exceeded) {
      const double needed = v.value + v.error;
      const std::string mends = key ? fmt::format("it holds from {} = {} on", key, told_shortly(needed, v.unit))
                                    : fmt::format("it holds from {:.3g} times this diameter on, at the same torque",
                                                  std::cbrt(needed / limit));
      if (std::isfinite(needed)) v.note = mends + (v.note.empty() ? "" : "; ") + v.note;
    }
    out_.push_back(std::move(v));
    return out_.back();
  }

  // The largest of the way there: simulated, else a bound. What of the steady motion is larger, stands apart.
  struct Largest {
    Estimate start = {}, steady = {};
    bool bound = false;
    std::string note = {};
  };
  Largest largest() const {
    Largest found{.steady = load_.largest()};
    if (peak_) {
      found.start = peak_->torque;
      found.note = fmt::format("at {:.4g} s of {}", peak_->time, run_up_.words);
    } else if (passing_ && std::abs(passing_->torque) > std::abs(found.steady.value)) {
      found.start = {passing_->torque, 0};
      found.bound = true;
      found.note = fmt::format("a bound only: steady swing at {}, which a quick passage stays below; no run-up: {}",
                               unit_.text(passing_->speed, 5), run_up_.words);
    } else {
      found.note = fmt::format("in steady motion; no run-up: {}", run_up_.words);
    }
    return found;
  }

  void maximum() {
    const Largest l = largest();
    const Estimate steady = times(limits_.temperature_factor, l.steady),
                   start = start_torque(limits_, l.start, load_.mean);
    const bool starts = start.value > steady.value;
    std::string note = starts ? l.note : "in steady motion" + (peak_ ? std::string() : "; no run-up: " + run_up_.words);
    if (limits_.temperature_factor > 1 || limits_.start_factor > 1)
      note += fmt::format("; S_t = {:g}, S_z = {:g}", limits_.temperature_factor, limits_.start_factor);
    add(requirement::maximum, starts ? start : steady, limits_.maximum, "N*m", note, "maximum_torque").bound =
        starts && l.bound;
  }

  void shear() {
    const Largest l = largest();
    const double modulus = limits_.polar_modulus;
    const Estimate steady = times(limits_.application_factor / modulus, l.steady), start = times(1 / modulus, l.start);
    const bool starts = start.value > steady.value;
    add("shear stress: K_A |T|/W_p ≤ τ_allowable", starts ? start : steady, limits_.shear_stress, "Pa",
        starts
            ? fmt::format("W_p = {:.5g} cm³, without K_A: {}", 1e6 * modulus, l.note)
            : fmt::format("W_p = {:.5g} cm³, K_A = {:g}, in steady motion", 1e6 * modulus, limits_.application_factor))
        .bound = starts && l.bound;
  }

  void swinging_stress() {
    const ShaftRating& shaft = limits_.shaft;
    const Estimate amplitude = times(1 / limits_.polar_modulus, load_.amplitude());
    if (shaft.vibratory) add(requirement::vibratory_stress, amplitude, *shaft.vibratory, "Pa", "in steady motion");
    if (shaft.endurance) {
      const Fatigue f = fatigue_of(shaft, amplitude, times(1 / limits_.polar_modulus, load_.middle()));
      add(requirement::fatigue, f.stress, *shaft.endurance, "Pa", f.note);
    }
    if (shaft.yield) yield();
    if (shaft.is_of_propulsion() && std::isfinite(joint_.continuous(speed_)))
      add(requirement::continuous, amplitude, joint_.continuous(speed_), "Pa",
          fmt::format("λ = {:.3g}, in steady motion", joint_.speed_ratio(speed_)));
  }

  void yield() {
    const Largest l = largest();
    const double factor = limits_.shaft.safety / limits_.polar_modulus;
    const Estimate steady = times(factor, l.steady), start = times(factor, l.start);
    const bool starts = start.value > steady.value;
    add(requirement::yield, starts ? start : steady, limits_.shaft.yield_in_shear(), "Pa",
        starts ? l.note : "in steady motion")
        .bound = starts && l.bound;
  }

  const LimitedJoint& joint_;
  const DriveLimits& limits_;
  const JointLoad& load_;
  double speed_;  // of the link [rad/s]
  const RunUp& run_up_;
  const RunUp::Peak* peak_;
  const Passing* passing_;
  const SpeedUnit& unit_;
  std::vector<Verdict>& out_;
};

}  // namespace

Fatigue fatigue_of(const ShaftRating& shaft, const Estimate& amplitude, const Estimate& mean) {
  return {
      {shaft.fatigue_stress(amplitude.value, mean.value),
       shaft.fatigue_stress(amplitude.error.value_or(0), mean.error.value_or(0))},
      fmt::format("τ_a = {:.4g} MPa, τ_m = {:.4g} MPa, τ_B = {:.4g} MPa, K_f = {:g}, S = {:g}", 1e-6 * amplitude.value,
                  1e-6 * mean.value, 1e-6 * shaft.strength_in_shear(), shaft.notch, shaft.safety)};
}

const char* name_of(Compliance c) {
  return c == Compliance::holds ? "holds" : c == Compliance::exceeded ? "exceeded" : "undecided";
}

Compliance Verdict::state() const {
  if (std::isnan(value) || std::isnan(error)) return Compliance::undecided;
  if (value + error <= limit) return Compliance::holds;
  return bound || value - error <= limit ? Compliance::undecided : Compliance::exceeded;
}

double worst_excess(const std::vector<Verdict>& verdicts) {
  double worst = 0;
  for (const Verdict& v : verdicts)
    if (v.state() == Compliance::exceeded) worst = std::max(worst, v.value / v.limit);
  return worst;
}

namespace {

// "clutch", heat of an engagement: 132 % of what is allowed
std::string use_in_words(const Verdict& v) {
  return fmt::format("\"{}\", {}: {:.0f} % of what is allowed", v.component,
                     v.requirement.substr(0, v.requirement.find(':')), 100 * v.value / v.limit);
}

// Of those in that state the one that is nearest to its limit, or farthest beyond it; null: none is.
const Verdict* worst_of(const std::vector<Verdict>& verdicts, Compliance state) {
  const Verdict* worst = nullptr;
  for (const Verdict& v : verdicts)
    if (v.state() == state && (!worst || v.value / v.limit > worst->value / worst->limit)) worst = &v;
  return worst;
}

}  // namespace

std::string sentence_of(const std::vector<Verdict>& verdicts, const std::string& what) {
  if (verdicts.empty()) return "";
  const auto count = [&](Compliance state) {
    return std::count_if(verdicts.begin(), verdicts.end(), [&](const Verdict& v) { return v.state() == state; });
  };
  const bool one = verdicts.size() == 1;
  const std::string all = one                    ? "its " + what
                          : verdicts.size() == 2 ? "both " + what + "s"
                                                 : fmt::format("all {} {}s", verdicts.size(), what);
  if (const Verdict* worst = worst_of(verdicts, Compliance::exceeded)) {
    return fmt::format(
        "{}{}, {} of {}{}",
        one ? "a " + what + " is EXCEEDED, "
            : fmt::format("{} of {} {}s EXCEEDED, worst ", count(Compliance::exceeded), verdicts.size(), what),
        use_in_words(*worst), told_shortly(worst->value, worst->unit), told_shortly(worst->limit, worst->unit),
        worst->note.empty() ? "" : "; " + worst->note);
  }
  if (const Verdict* open = worst_of(verdicts, Compliance::undecided))
    return fmt::format("{} of {} {}s undecided, {}", count(Compliance::undecided), verdicts.size(), what,
                       use_in_words(*open));
  return fmt::format("{} hold{}, {}{}", all, one ? "s" : "", one ? "" : "the nearest ",
                     use_in_words(*worst_of(verdicts, Compliance::holds)));
}

Estimate start_torque(const DriveLimits& limits, const Estimate& peak, const Estimate& mean) {
  const double whole = std::abs(peak.value);
  if (!std::isfinite(whole)) return {whole, 0};
  const double steady = std::clamp(std::copysign(1.0, peak.value) * mean.value, 0.0, whole);
  const double most = limits.start_factor * whole, least = steady + limits.start_factor * (whole - steady);
  const double factor = limits.temperature_factor;
  return {factor * 0.5 * (most + least),
          factor * (0.5 * (most - least) + limits.start_factor * peak.error.value_or(0))};
}

std::vector<Verdict> judge(const std::vector<LimitedJoint>& joints, const SteadyLoads& loads, const RunUp& run_up,
                           const std::vector<Passing>& passing, const SpeedUnit& speed_unit) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].limits.any())
      Judge(joints[i], loads.joints[i], loads.speed, run_up, run_up.found ? &run_up.peaks[i] : nullptr,
            i < passing.size() ? &passing[i] : nullptr, speed_unit, verdicts)
          .all();
  return verdicts;
}

}  // namespace kurbel
