// machine_cycle.cpp — samples the rigid machine over its cycle; operating speed.
#include "studies/cycle/machine_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

struct MeanTorque {
  double drive = 0, load = 0;
  double net() const { return drive - load; }
};

MeanTorque mean_torque(RigidMachine& machine, double speed) {
  const MachineCycle c = machine_cycle(machine, speed);
  return {c.drive.mean(), c.load.mean()};
}

// Mean torques at a constant speed [rad/s].
struct Balance {
  double speed;
  MeanTorque mean;
};

// From nearly standstill up to a speed at which the load exceeds the drive, if there is one.
std::vector<Balance> scan_of_speeds(RigidMachine& machine) {
  const double top = 2 * machine.model().speed_scale;
  std::vector<Balance> scan;
  const auto look = [&](double speed) {
    Deadline::check();
    scan.push_back({speed, mean_torque(machine, speed)});
  };
  // Equidistant, and denser towards standstill: a soft motor runs far below its no-load speed.
  constexpr int steps = 80;
  for (double speed = 1e-5 * top; speed < top / steps; speed *= 1.6) look(speed);
  for (int i = 1; i <= steps; ++i) look(top * i / steps);
  // Rated quantities may be far from the operating speed: a series motor's R/κ is far below.
  constexpr double farthest = 1e3;
  while (scan.back().mean.net() > 0 && scan.back().speed < farthest * top) look(1.1 * scan.back().speed);
  return scan;
}

// The fastest speed at which the net torque changes from driving to braking with rising speed, the slower ones as
// others. Speed 0: there is none.
OperatingSpeed where_balance_falls(RigidMachine& machine, const std::vector<Balance>& scan) {
  OperatingSpeed found;
  for (std::size_t i = 0; i + 1 < scan.size(); ++i) {
    if (!(scan[i].mean.net() > 0 && scan[i + 1].mean.net() <= 0)) continue;
    if (found.speed > 0) found.others.push_back(found.speed);
    found.speed = find_root([&](double speed) { return mean_torque(machine, speed).net(); }, scan[i].speed,
                            scan[i].mean.net(), scan[i + 1].speed, scan[i + 1].mean.net());
  }
  return found;
}

void set_slopes(RigidMachine& machine, OperatingSpeed& found) {
  const double step = 1e-4 * found.speed;
  found.mean_drive = mean_torque(machine, found.speed).drive;
  const MeanTorque faster = mean_torque(machine, found.speed + step), slower = mean_torque(machine, found.speed - step);
  found.slope = (faster.net() - slower.net()) / (2 * step);
  found.drive_slope = (faster.drive - slower.drive) / (2 * step);
}

// The drive is too strong at every examined speed, or too weak.
[[noreturn]] void refuse_unbalanced(const RigidMachine& machine, const std::vector<Balance>& scan) {
  const auto best = std::max_element(scan.begin(), scan.end(),
                                     [](const Balance& a, const Balance& b) { return a.mean.net() < b.mean.net(); });
  const SpeedUnit& unit = machine.model().scene.speed_unit;
  if (std::all_of(scan.begin(), scan.end(), [](const Balance& b) { return b.mean.drive < 0; }))
    throw WeakDrive(fmt::format(
        "the drive turns the machine backwards: its mean torque is {:.4g} N·m at {}, and negative at every forward "
        "speed, at which alone a balance is sought; give --mid-speed, or let its torque drive forwards",
        scan.front().mean.drive, unit.text(scan.front().speed)));
  if (best->mean.net() > 0)
    throw std::invalid_argument(fmt::format(
        "no speed up to {} balances the machine: the drive gives more there than the load takes, at the end "
        "{:.4g} against {:.4g} N·m; give --mid-speed, or a motor whose torque falls with its speed",
        unit.text(scan.back().speed), scan.back().mean.drive, scan.back().mean.load));
  const std::string balance = fmt::format(
      "at its best, at {} of the reduction link, it gives a mean torque of {:.6g} N·m there while the load "
      "takes {:.6g} N·m; {:.6g} N·m are missing{}",
      unit.text(best->speed), best->mean.drive, best->mean.load, -best->mean.net(),
      best->mean.load == 0
          ? ""
          : fmt::format(" ({:.3g} % of the load)", 100 * -best->mean.net() / std::abs(best->mean.load)));
  if (machine.uses_time())
    throw WeakDrive(fmt::format(
        "as it is at t = 0 the drive is too weak for the cycle: {}. Some torque depends on time and may be another "
        "later (a converter's ramp, a switching): give the machine without that, or simulate it with kurbel run",
        balance));
  throw WeakDrive(fmt::format(
      "the drive is too weak for the cycle: {}; take a stronger motor, a larger ratio, or a smaller load", balance));
}

}  // namespace

std::vector<double> cycle_edges(RigidMachine& machine) {
  constexpr double near = 1e-9;
  const double end = machine.begin() + machine.cycle();
  std::vector<double> edges = {machine.begin()};
  for (const double edge : machine.edges(1))
    if (edge > edges.back() + near && edge < end - near) edges.push_back(edge);
  edges.push_back(end);
  return edges;
}

MachineCycle machine_cycle(RigidMachine& machine, double speed, double sampling) {
  if (!machine.periodic())
    throw std::invalid_argument(
        "the machine has no cycle: its parts do not come back together within 24 turns of the reduction link");
  const std::vector<WorkAccount>& accounts = machine.model().accounts;
  const std::size_t n = accounts.size();
  // Shares, then drive and load, then I_em and I_em′.
  const auto sampler = [&](double phi, std::span<double> out) {
    const RigidMachine::At at = machine.at(phi, speed, true);
    double drive = 0, load = 0;
    for (std::size_t k = 0; k < n; ++k) {
      out[k] = at.share[k];
      (accounts[k].kind == Account::driving ? drive : load) += at.share[k];
    }
    const RigidMachine::Inertia inertia = machine.mechanism_inertia(phi);
    out[n] = drive, out[n + 1] = -load, out[n + 2] = inertia.value, out[n + 3] = inertia.slope;
  };
  const auto enter = [&](double middle) {
    Deadline::check();
    machine.set_modes(middle, speed);
  };
  auto all = Piecewise::sample(cycle_edges(machine), n + 4, sampler, enter, sampling);
  MachineCycle c{speed, all[n], all[n + 1], {}, {all[n + 2], all[n + 3]}};
  all.resize(n);
  c.share = std::move(all);
  return c;
}

OperatingSpeed operating_speed(RigidMachine& machine) {
  if (!machine.uses_speed())
    throw std::invalid_argument(
        "no torque of the machine depends on its speed: every speed is as steady as any other, and the mid speed must "
        "be given; write e.g. --mid-speed \"60 rpm\"");
  const std::vector<Balance> scan = scan_of_speeds(machine);
  OperatingSpeed found = where_balance_falls(machine, scan);
  if (!(found.speed > 0)) refuse_unbalanced(machine, scan);
  set_slopes(machine, found);
  return found;
}

}  // namespace kurbel
