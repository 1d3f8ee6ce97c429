// drive_limits.cpp — responses as loads, and calls of the verdicts.
#include "studies/modes/drive_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/index.h"
#include "studies/claims/ranges.h"
#include "studies/limits/limits_findings.h"
#include "studies/modes/critical_speeds.h"

namespace kurbel {
namespace {

std::vector<JointLoad> loads_of(const SpeedResponse& response) {
  std::vector<JointLoad> loads;
  for (const JointResponse& joint : response.joints) loads.push_back(load_of(joint));
  return loads;
}

// Steady amplitudes below the operating speed.
std::vector<Passing> passing_of(const ModesStudy& found) {
  std::vector<Passing> passing(found.limited.size());
  for (const SpeedResponse& s : found.sweep)
    for (std::size_t j = 0; j < passing.size(); ++j) {
      if (!s.kept || s.speed > std::abs(found.drive.at.speed) * (1 + 1e-9)) continue;
      const double most = load_of(s.joints[j]).largest().value;
      if (std::abs(most) > std::abs(passing[j].torque)) passing[j] = {most, s.speed};
    }
  return passing;
}

// One order's amplitude about the mean at that speed, as a load of its joint.
void find_severity(double factor, ModesStudy& found) {
  for (CriticalSpeed& c : found.critical) {
    const double speed = c.severest();
    JointLoad load;
    load.mean.value = c.mean;
    load.upper.value = c.mean + c.amplitude, load.lower.value = c.mean - c.amplitude;
    load.vibratory.value = c.amplitude;
    load.frequency = c.order * speed / (2 * std::numbers::pi);
    load.frequency_factor = frequency_factor(load.frequency);
    load.weighted.value = load.frequency_factor * c.amplitude;
    c.share = share_of_bearable(found.limited[c.joint], load, speed, factor);
  }
}

void judge_history(ModesStudy& found) {
  if (!found.history || found.history->value.empty()) return;
  const TorqueHistory& h = *found.history;
  const bool below = -h.least.value > h.greatest.value;
  for (const LimitedJoint& joint : found.limited) {
    if (joint.name != h.component || !(joint.limits.maximum > 0)) continue;
    // Without an error the run was not confirmed, and is not used for verdicts.
    const Estimate most = joint.limits.temperature_factor * (below ? -h.least : h.greatest);
    found.verdicts.push_back({{most.value, most.error.value_or(std::nan(""))},
                              joint.name,
                              "maximum torque of the simulated run: S_t |T| ≤ T_Kmax",
                              joint.limits.maximum,
                              "N*m",
                              most.error ? "" : "of a run that was not confirmed"});
    found.verdicts.back().factor = joint.limits.temperature_factor;
  }
}

// A machine that comes to rest or runs away has no steady motion to be judged.
void leave_steady_limits(const std::string& why, SteadyLoads& loads, std::vector<Verdict>& verdicts) {
  loads.found = false, loads.words = why;
  for (Verdict& v : verdicts)
    if (v.load_case == load_case::steady)
      v = not_assessed(v.component, v.requirement, v.limit, v.unit, load_case::steady, why);
}

}  // namespace

JointLoad load_of(const JointResponse& response) {
  JointLoad load;
  load.mean.value = response.mean, load.upper.value = response.upper, load.lower.value = response.lower;
  load.vibratory.value = response.peak, load.power.value = response.power;
  load.frequency = response.dominant_omega / (2 * std::numbers::pi);
  load.frequency_factor = frequency_factor(load.frequency);
  load.weighted.value = load.frequency_factor * response.peak;
  return load;
}

void find_barred_ranges(const Model& model, double factor, const std::function<SpeedResponse(double speed)>& at,
                        ModesStudy& found) {
  found.limited = limited_joints(model);
  find_severity(factor, found);
  for (const SpeedStretch& stretch : stretches(found.sweep)) {
    if (!stretch.kept) continue;
    std::vector<SpeedLoads> sweep;
    for (std::size_t i = stretch.begin; i < stretch.end; ++i)
      sweep.push_back({found.sweep[i].speed, loads_of(found.sweep[i])});
    const auto loads = [&at](double speed) { return loads_of(at(speed)); };
    for (BarredRange& range : barred_ranges(found.limited, sweep, factor, loads))
      found.barred.push_back(std::move(range));
    for (const BarredRange& range : beyond_by_mean(found.limited, sweep, loads))
      found.notes.push_back(
          fmt::format("not assessed: whether \"{}\" may run at {}: the mean torque there, with what accelerates "
                      "the machine or slows it, is beyond its {} by itself; at constant speed it is another one",
                      found.limited[range.joint].name, speed_range(range.from, range.to, found.speed_unit),
                      reason_in_words(range)));
  }
}

void judge_limits(const MachineAndOrbit& here, const std::optional<MachineAndOrbit>& end, bool at_orbit,
                  const Watch& watch, ModesStudy& found) {
  const auto& [machine, orbit] = here;
  RunUp run_up;
  SteadyLoads loads;
  if (any_limits(found.limited)) {
    const std::vector<LimitedJoint> joints = joints_of(*machine, found.limited);
    const SteadyLoads kept = steady_loads(orbit, machine, joints);
    run_up = end ? find_run_up(end->machine, end->orbit, steady_loads(end->orbit, end->machine, joints), joints, watch)
                 : find_run_up(machine, orbit, kept, joints, watch);
    loads = kept;
    if (!at_orbit || !kept.found) {
      loads = {.found = true, .words = "the linear response at " + found.speed_unit.text(found.drive.at.speed, 5)};
      if (at_orbit) loads.words += "; " + kept.words;
      loads.joints = loads_of(found.here), loads.speed = found.drive.at.speed;
    } else {
      loads.words = fmt::format("the steady motion, at {}: {}", found.speed_unit.text(kept.speed, 5), orbit.words);
    }
    found.verdicts = judge(found.limited, loads, run_up, passing_of(found), found.speed_unit);
    if (at_orbit && (found.comes_to_rest || found.runs_away)) leave_steady_limits(orbit.words, loads, found.verdicts);
  }
  judge_history(found);
  for (std::string& note : limits_notes(found.verdicts, found.barred, found.limited, loads, run_up))
    found.notes.push_back(std::move(note));
}

}  // namespace kurbel
