// kept_speeds.cpp — by eigenvalues of the drive at each speed, and by what its speed swings.
#include "studies/modes/kept_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr Eigen::Index most_coordinates = 160;
constexpr double growth = 1e-6;  // of a turn's radian

}  // namespace

bool grows(const LinearDrive& drive) {
  if (drive.size() + drive.own_states() > most_coordinates) return false;
  const std::vector<DampedMode> modes = damped_modes(drive, undamped_modes(drive));
  const double pace = std::abs(drive.at.speed);
  return std::any_of(modes.begin(), modes.end(),
                     [&](const DampedMode& mode) { return mode.lambda.real() > std::max(growth * pace, mode.error); });
}

void judge_kept_speeds(const ModesStudy& found, const LinearDrive& drive, SpeedResponse& response) {
  if (!found.keeps_its_speed) return;
  response.kept = response.speed_swing < std::abs(response.speed) && !grows(drive);
}

std::vector<SpeedStretch> stretches(const std::vector<SpeedResponse>& sweep) {
  std::vector<SpeedStretch> list;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    if (list.empty() || list.back().kept != sweep[i].kept) list.push_back({i, i, sweep[i].kept});
    list.back().end = i + 1;
  }
  return list;
}

void leave_out_what_is_not_kept(ModesStudy& found) {
  std::string where;
  for (const SpeedStretch& s : stretches(found.sweep))
    if (!s.kept)
      where += fmt::format("{}{:.4g} … {}", where.empty() ? "" : ", ", found.speed_unit.of(found.sweep[s.begin].speed),
                           found.speed_unit.text(found.sweep[s.end - 1].speed, 4));
  if (where.empty()) return;
  const auto is_kept = [&](const CriticalSpeed& c) {
    const auto nearest = std::min_element(found.sweep.begin(), found.sweep.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.speed - c.speed) < std::abs(b.speed - c.speed);
    });
    return nearest->kept;
  };
  const std::size_t before = found.critical.size();
  std::erase_if(found.critical, [&](const CriticalSpeed& c) { return !is_kept(c); });
  const std::size_t gone = before - found.critical.size();
  found.notes.push_back(fmt::format(
      "at {} the machine does not stay by itself: small motions grow (a motor beyond its breakdown), or the "
      "speed would swing by more than itself; {}what is barred there and spot checks are left out. Passing "
      "through on the way up is judged by the start",
      where, gone > 0 ? fmt::format("{} critical speed{}, ", gone, gone == 1 ? "" : "s") : ""));
}

}  // namespace kurbel
