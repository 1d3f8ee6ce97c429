// machine_cycle.cpp — samples the rigid machine over its cycle; operating speed; steady motion by collocation.
#include "studies/cycle/machine_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/gauss.h"
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

// One pass over the cycle from an initial kinetic energy: Picard iteration on the collocation of each piece.
class Pass {
 public:
  Pass(RigidMachine& machine, const std::vector<double>& breaks, double more_inertia)
      : machine_(machine), breaks_(breaks), more_(more_inertia), samples_(3) {}

  // Kinetic energy at the end; negative if the machine stalls, at stalled_at.
  double run(double energy, double& growth, double& time) {
    for (auto& s : samples_) s.clear();
    growth = 1, time = 0;
    double log_growth = 0;
    for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
      energy = piece(breaks_[i], breaks_[i + 1], energy, log_growth, time);
      if (!(energy > 0)) return -1;
    }
    growth = std::exp(log_growth);
    return energy;
  }
  double stalled_at() const { return stalled_at_; }
  Piecewise speed() const { return Piecewise::through(breaks_, samples_[0]); }
  Piecewise drive() const { return Piecewise::through(breaks_, samples_[1]); }

 private:
  static constexpr std::size_t n = Piecewise::nodes;

  RigidMachine::At at(double phi, double omega, bool shares = false) {
    if (!machine_.edges_are_of_angle()) machine_.set_modes(phi, omega);
    return machine_.at(phi, omega, shares);
  }

  double piece(double lo, double hi, double energy, double& log_growth, double& time) {
    const double half = 0.5 * (hi - lo);
    const RigidMachine::At begin = machine_.at(lo, 1.0);
    machine_.set_modes(0.5 * (lo + hi), std::sqrt(2 * energy / (begin.inertia + more_)));
    std::vector<double> phi(n), inertia(n), level(n, energy), torque(n), omega(n);
    for (std::size_t k = 0; k < n; ++k) {
      phi[k] = lo + half * (1 + Piecewise::node(k));
      inertia[k] = machine_.at(phi[k], 1.0).inertia + more_;
      if (!(inertia[k] > 0)) return stall(phi[k]);
    }
    double end = energy;
    for (int iteration = 0; iteration < 60; ++iteration) {
      for (std::size_t k = 0; k < n; ++k) {
        if (!(level[k] > 0)) return stall(phi[k]);
        omega[k] = std::sqrt(2 * level[k] / inertia[k]);
        torque[k] = at(phi[k], omega[k]).torque;
      }
      const Piecewise work = Piecewise::through({lo, hi}, torque).integral();
      double change = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double next = energy + work.value_in(0, phi[k]);
        change = std::max(change, std::abs(next - level[k]));
        level[k] = next;
      }
      end = energy + work.value_in(0, hi);
      if (change < 4e-15 * energy) break;
    }
    if (!(end > 0)) return stall(hi);
    finish(lo, hi, phi, inertia, level, log_growth, time);
    return end;
  }

  // ∂M/∂T = ∂M/∂ω /(I ω) along the solution; time = ∫dφ/ω.
  void finish(double lo, double hi, const std::vector<double>& phi, const std::vector<double>& inertia,
              const std::vector<double>& level, double& log_growth, double& time) {
    const double half = 0.5 * (hi - lo);
    for (std::size_t k = 0; k < n; ++k) {
      const double omega = std::sqrt(2 * std::max(level[k], 0.0) / inertia[k]), step = 1e-5 * omega;
      const double faster = at(phi[k], omega + step).torque, slower = at(phi[k], omega - step).torque;
      const double weight = half * gauss<n>.w[k];
      log_growth += weight * (faster - slower) / (2 * step) / (inertia[k] * omega);
      time += weight / omega;
      const RigidMachine::At here = at(phi[k], omega, true);
      double drive = 0;
      for (std::size_t a = 0; a < here.share.size(); ++a)
        if (machine_.model().accounts[a].kind == Account::driving) drive += here.share[a];
      samples_[0].push_back(omega);
      samples_[1].push_back(drive);
    }
  }

  double stall(double phi) {
    stalled_at_ = phi;
    return -1;
  }

  RigidMachine& machine_;
  const std::vector<double>& breaks_;
  double more_, stalled_at_ = 0;
  std::vector<std::vector<double>> samples_;
};

// Pieces short enough for the motor's slope and for tables over speed, whose knots are no breaks.
std::vector<double> refined(RigidMachine& machine, const MachineCycle& cycle, double more_inertia, double speed) {
  const double inertia = machine.constant_inertia() + more_inertia + cycle.mechanism.value.mean();
  const double step = 1e-4 * speed;
  const double middle = 0.5 * (cycle.drive.begin() + cycle.drive.end());
  machine.set_modes(middle, speed);
  const double slope = (machine.at(middle, speed + step).torque - machine.at(middle, speed - step).torque) / (2 * step);
  double longest = 1 / std::max(std::abs(slope) / (inertia * speed), 0.5);
  if (!machine.edges_are_of_angle()) longest = std::min(longest, cycle.drive.length() / 400);
  longest = std::max(longest, cycle.drive.length() / 4000);
  std::vector<double> breaks;
  const std::vector<double>& given = cycle.drive.breaks();
  for (std::size_t i = 0; i + 1 < given.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil((given[i + 1] - given[i]) / longest)));
    for (int k = 0; k < parts; ++k) breaks.push_back(given[i] + (given[i + 1] - given[i]) * k / parts);
  }
  breaks.push_back(given.back());
  return breaks;
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
  std::vector<double> edges = {0};
  for (const double edge : machine.edges(1))
    if (edge > edges.back() + near && edge < machine.cycle() - near) edges.push_back(edge);
  edges.push_back(machine.cycle());
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

SteadyRigidCycle steady_rigid_cycle(RigidMachine& machine, const MachineCycle& cycle, double more_inertia,
                                    double near) {
  SteadyRigidCycle result;
  const std::vector<double> breaks = refined(machine, cycle, more_inertia, near);
  const double inertia = machine.constant_inertia() + more_inertia + machine.mechanism_inertia(0).value;
  if (!(inertia > 0)) {
    result.why = fmt::format("no inertia is left: {:.6g} kg·m²", inertia);
    return result;
  }
  Pass pass(machine, breaks, more_inertia);
  // Newton's method on T ↦ T after a cycle; steps are limited, so that a poor starting value does not stall at once.
  double energy = 0.5 * inertia * near * near;
  for (int i = 0; i < 60; ++i) {
    double growth = 0, time = 0;
    const double after = pass.run(energy, growth, time);
    if (!(after > 0)) {
      result.why = fmt::format("from {} the machine stalls at {:.5g}° of the cycle",
                               machine.model().scene.speed_unit.text(std::sqrt(2 * energy / inertia), 5),
                               pass.stalled_at() * 180 / std::numbers::pi);
      result.stalls = i > 20 || energy > 1e3 * inertia * near * near;
      if (result.stalls) return result;
      energy *= 1.5;
      continue;
    }
    result.multiplier = growth;
    result.time = time;
    if (std::abs(after - energy) <= 1e-13 * energy) {
      result.found = true;
      break;
    }
    const double step = growth < 1 ? (after - energy) / (1 - growth) : after - energy;
    energy = std::clamp(energy + step, 0.3 * energy, 3 * energy);
  }
  if (!result.found) {
    result.why = "Newton's method finds no speed that comes back after a cycle, which does not say that there is none";
    return result;
  }
  result.why.clear();
  result.speed = pass.speed();
  result.drive = pass.drive();
  result.fastest = result.speed.maximum();
  result.slowest = result.speed.minimum();
  return result;
}

}  // namespace kurbel
