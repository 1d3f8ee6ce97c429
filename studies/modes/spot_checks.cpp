// spot_checks.cpp — selects speeds of the sweep and solves the full equations there.
#include "studies/modes/spot_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/modes_plots.h"

namespace kurbel {
namespace {

constexpr double apart = 0.05;      // of the speed, of two checks
constexpr double least_use = 0.01;  // of the allowable load of a joint
constexpr double most_seconds = 2;  // of processor time, of all checks together

struct Candidate {
  double speed = 0, use = 0;
  std::size_t joint = 0;
  bool is_end = false;
};

// The joint with the highest utilisation at every speed of the sweep.
std::vector<Candidate> uses_of(const ModesStudy& found, double factor) {
  std::vector<Candidate> uses;
  for (const SpeedResponse& s : found.sweep) {
    if (!s.kept) continue;
    Candidate most{.speed = s.speed};
    for (std::size_t j = 0; j < s.joints.size() && j < found.limited.size(); ++j) {
      const double use = share_of_bearable(found.limited[j], load_of(s.joints[j]), s.speed, factor);
      if (std::isfinite(use) && use > most.use) most.use = use, most.joint = j;
    }
    uses.push_back(most);
  }
  return uses;
}

std::vector<Candidate> choose(const ModesStudy& found, double factor, std::size_t count) {
  const std::vector<Candidate> uses = uses_of(found, factor);
  std::vector<Candidate> peaks;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool end = i == 0 || i + 1 == uses.size();
    const bool peak = !end && uses[i].use > uses[i - 1].use && uses[i].use >= uses[i + 1].use;
    if (uses[i].use < least_use || (!end && !peak)) continue;
    peaks.push_back(uses[i]);
    peaks.back().is_end = end;
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const Candidate& a, const Candidate& b) {
    return a.is_end != b.is_end ? b.is_end : a.use > b.use;
  });
  std::vector<Candidate> chosen;
  std::vector<double> taken;
  if (found.cycle) taken.push_back(std::abs(found.cycle->speed));
  for (const SpotCheck& spot : found.spots) taken.push_back(spot.speed);
  for (const Candidate& c : peaks) {
    const bool near = std::any_of(taken.begin(), taken.end(),
                                  [&](double speed) { return std::abs(speed - c.speed) < apart * c.speed; });
    if (near || chosen.size() >= count) continue;
    chosen.push_back(c);
    taken.push_back(c.speed);
  }
  return chosen;
}

void look_at(const HeldMachine& machine, const LinearDrive& drive, const HeldCycleOptions& options,
             const ModesStudy& found, SpotCheck& spot) {
  spot.linear = respond(drive, found.excitations);
  spot.linear.speed = spot.speed;
  if (!spot.share) spot.joint = modes::joint_with_largest_amplitude(spot.linear);
  if (!(options.seconds > 0)) {
    spot.why = fmt::format("earlier checks used up the {:g} s allowed for all", most_seconds);
    return;
  }
  HeldCycle held;
  try {
    held = find_held_cycle(machine, drive, found.excitations, options);
  } catch (const std::invalid_argument& refused) {
    held.why = refused.what();
  } catch (const std::runtime_error& broken) {  // an element that knows no answer, such as joints that jam
    held.why = broken.what();
  }
  spot.why = held.why;
  if (!held.found) return;
  spot.cycle = response_of_samples(held.samples->torque, held.samples->mean->speed, held.samples->time);
  spot.cycle_order = 2 * std::numbers::pi / (held.samples->time * std::abs(held.samples->mean->speed));
  spot.acceleration = held.acceleration;
  spot.stable = held.uncertain || held.stable();
}

}  // namespace

void check_spots(const HeldMachine& machine, const std::function<LinearDrive(double speed)>& drive_at,
                 const ModesOptions& options, ModesStudy& found) {
  if (found.joint_names.empty()) return;
  const double begin = processor_time();
  for (const double speed : options.spots) found.spots.push_back({.speed = speed});
  if (options.spot_checks > 0)
    for (const Candidate& c : choose(found, options.barred_factor, static_cast<std::size_t>(options.spot_checks)))
      found.spots.push_back({.speed = c.speed, .share = c.use, .joint = c.joint});
  auto left = static_cast<double>(found.spots.size());
  for (SpotCheck& spot : found.spots) {
    if (options.watch.stopped()) {
      spot.why = "interrupted";
      continue;
    }
    options.watch.at("spot checks", 0.85);
    look_at(machine, drive_at(spot.speed),
            {.seconds = (most_seconds - (processor_time() - begin)) / left--, .interrupted = options.watch.interrupted},
            found, spot);
  }
  std::erase_if(found.spots, [](const SpotCheck& spot) { return spot.linear.joints.empty(); });
  std::sort(found.spots.begin(), found.spots.end(),
            [](const SpotCheck& a, const SpotCheck& b) { return a.speed < b.speed; });
}

}  // namespace kurbel
