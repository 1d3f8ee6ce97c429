// flywheel.cpp — work diagram, inertia for a demanded δ, speed over the cycle, punch presses.
#include "studies/size/flywheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/data/named.h"

namespace kurbel {
namespace {

void check_speed(double mid_speed) {
  if (!(mid_speed > 0) || !std::isfinite(mid_speed))
    throw std::invalid_argument(fmt::format("mid speed = {:.6g} rad/s; must be > 0", mid_speed));
}

}  // namespace

void check_delta(double delta) {
  if (!(delta > 0 && delta < 2))
    throw std::invalid_argument(
        fmt::format("delta = {:.6g}; must be > 0 and < 2: δ = (ω_max − ω_min)/ω_mid, and at 2 the machine stops in "
                    "every cycle; write e.g. 0.05",
                    delta));
}

WorkDiagram work_diagram(const Piecewise& drive_torque, const Piecewise& load_torque) {
  WorkDiagram d;
  d.drive_torque = drive_torque;
  d.load_torque = load_torque;
  d.net_torque = drive_torque - load_torque;
  d.drive_work = drive_torque.integral();
  d.load_work = load_torque.integral();
  d.excess = d.drive_work - d.load_work;
  d.work = drive_torque.total();
  const double rest = d.net_torque.total();
  if (!(std::abs(rest) <= 1e-9 * (d.drive_work.largest() + d.load_work.largest())))
    throw std::invalid_argument(
        fmt::format("the cycle is not steady: driving work {:.6g} J, work of resistance {:.6g} J; they must be equal",
                    d.work, load_torque.total()));
  d.most = d.excess.maximum(d.net_torque);
  d.least = d.excess.minimum(d.net_torque);
  return d;
}

WorkDiagram with_constant_drive(const Piecewise& load_torque) {
  const double work = load_torque.total(), rounding = 1e-12 * load_torque.largest() * load_torque.length();
  if (!(work > rounding))
    throw std::invalid_argument(fmt::format(
        "the load has no net resistance: its work over a cycle is {:.6g} J; must be > 0, else nothing is to "
        "be driven and the machine runs away",
        work >= -rounding ? 0 : work));
  return work_diagram(load_torque.constant(work / load_torque.length()), load_torque);
}

WorkDiagram with_constant_load(const Piecewise& drive_torque) {
  const double work = drive_torque.total();
  if (!(work > 1e-12 * drive_torque.largest() * drive_torque.length()))
    throw std::invalid_argument(fmt::format(
        "the drive does no net work: {:.6g} J over a cycle; must be > 0, else no load can be driven", work));
  return work_diagram(drive_torque, drive_torque.constant(work / drive_torque.length()));
}

Wittenbauer wittenbauer(const WorkDiagram& diagram, const MechanismInertia& mechanism, double mid_speed, double delta) {
  check_delta(delta);
  check_speed(mid_speed);
  const double fastest = mid_speed * (1 + delta / 2), slowest = mid_speed * (1 - delta / 2);
  const double a = fastest * fastest / 2, b = slowest * slowest / 2;
  // A tangent touches where ΔT − slope · I_em is extreme.
  const auto tangent = [&](double slope, bool upper) {
    const Piecewise height = diagram.excess - slope * mechanism.value;
    const Piecewise rate = diagram.net_torque - slope * mechanism.slope;
    const double phi = (upper ? height.maximum(rate) : height.minimum(rate)).x;
    return Tangent{slope, phi, mechanism.value.value(phi), diagram.excess.value(phi)};
  };
  Wittenbauer w{tangent(a, true), tangent(b, false)};
  w.inertia = (w.upper.intercept() - w.lower.intercept()) / (a - b);
  w.kinetic_energy = a * w.inertia - w.upper.intercept();
  return w;
}

Mertsalov mertsalov(const WorkDiagram& diagram, const MechanismInertia& mechanism, double mid_speed, double delta) {
  check_delta(delta);
  check_speed(mid_speed);
  const double mean = mid_speed * mid_speed / 2;
  const Piecewise height = diagram.excess - mean * mechanism.value;
  const Piecewise rate = diagram.net_torque - mean * mechanism.slope;
  Mertsalov m{height.maximum(rate), height.minimum(rate)};
  m.inertia = (m.most.value - m.least.value) / (mid_speed * mid_speed * delta);
  return m;
}

double inertia_by_fluctuation(double fluctuation, double mid_speed, double delta) {
  check_delta(delta);
  check_speed(mid_speed);
  return fluctuation / (mid_speed * mid_speed * delta);
}

double flywheel_by_parts(double drive, double motor, double gearbox) { return drive - 1.1 * motor - gearbox; }

// --- speed ---

SpeedCycle::SpeedCycle(const WorkDiagram& diagram, const MechanismInertia& mechanism, double inertia, double mid_speed)
    : diagram_(&diagram), mechanism_(&mechanism), inertia_(inertia) {
  check_speed(mid_speed);
  const double least_inertia = inertia + mechanism.value.minimum(mechanism.slope).value;
  if (!(least_inertia > 0))
    throw std::invalid_argument(
        fmt::format("inertia = {:.6g} kg·m²: with it the machine has no inertia somewhere in the cycle", inertia));
  // ω_mid grows steadily with T₀: Newton's method with a numeric slope, from the energy at ω_mid.
  const auto mean_at = [&](double energy) {
    const Extremes z = extremes_at(energy);
    return z.least.value > 0 ? 0.5 * (std::sqrt(2 * z.most.value) + std::sqrt(2 * z.least.value)) : 0.0;
  };
  // With the slowest point at rest: the smallest T₀ that carries the machine through its cycle.
  const double floor = -diagram.excess.minimum(diagram.net_torque).value;
  const double needed = mean_at(std::max(floor, 0.0) * (1 + 1e-14) + 1e-300);
  if (needed >= mid_speed)
    throw std::invalid_argument(fmt::format(
        "inertia = {:.6g} kg·m² is too small: at a mid speed of {:.6g} rad/s the machine would stop within the cycle",
        inertia, mid_speed));
  double low = std::max(floor, 0.0),
         high = mid_speed * mid_speed * (inertia + mechanism.value.largest()) + 2 * diagram.fluctuation();
  energy_ = std::clamp(0.5 * mid_speed * mid_speed * (inertia + mechanism.value.mean()), low, high);
  for (int i = 0; i < 100; ++i) {
    const double f = mean_at(energy_) - mid_speed;
    (f > 0 ? high : low) = energy_;
    if (std::abs(f) < 1e-15 * mid_speed) break;
    const Extremes z = extremes_at(energy_);
    double next = 0.5 * (low + high);
    if (z.least.value > 0) {  // dω/dT₀ = 1/(ω I) at either extreme
      const auto slope = [&](const Extreme& e) {
        return 1 / (std::sqrt(2 * e.value) * (inertia_ + mechanism_->value.value(e.x)));
      };
      const double newton = energy_ - f / (0.5 * (slope(z.most) + slope(z.least)));
      if (newton > low && newton < high) next = newton;
    }
    if (std::abs(next - energy_) <= 1e-16 * energy_) break;
    energy_ = next;
  }
  const Extremes z = extremes_at(energy_);
  fastest_ = {z.most.x, std::sqrt(2 * z.most.value)};
  slowest_ = {z.least.x, std::sqrt(2 * std::max(0.0, z.least.value))};
}

// Extremes of the quotient z = (T₀ + ΔT)/(I₀ + I_em) after Dinkelbach: those of T₀ + ΔT − z (I₀ + I_em), z renewed.
Extreme SpeedCycle::extreme(double energy, bool most) const {
  const auto quotient = [&](double phi) {
    return (energy + diagram_->excess.value(phi)) / (inertia_ + mechanism_->value.value(phi));
  };
  Extreme best{diagram_->excess.begin(), quotient(diagram_->excess.begin())};
  for (int i = 0; i < 50; ++i) {
    const Piecewise height = diagram_->excess - best.value * mechanism_->value;
    const Piecewise rate = diagram_->net_torque - best.value * mechanism_->slope;
    const double phi = (most ? height.maximum(rate) : height.minimum(rate)).x;
    const double next = quotient(phi);
    if (most ? next <= best.value * (1 + 1e-16) : next >= best.value * (1 - 1e-16)) break;
    best = {phi, next};
  }
  return best;
}

SpeedCycle::Extremes SpeedCycle::extremes_at(double energy) const {
  return {extreme(energy, true), extreme(energy, false)};
}

double SpeedCycle::speed(double phi) const {
  const double z = (energy_ + diagram_->excess.value(phi)) / (inertia_ + mechanism_->value.value(phi));
  return std::sqrt(2 * std::max(0.0, z));
}

double SpeedCycle::delta() const {
  return (fastest_.value - slowest_.value) / (0.5 * (fastest_.value + slowest_.value));
}

// --- customary δ ---

const std::vector<CustomaryDelta>& customary_deltas() {
  static const std::string theory = "theory of machines, customary range",
                           khurmi = "Khurmi and Gupta, A Textbook of Machine Design, table 22.2";
  static const std::vector<CustomaryDelta> all = {
      {"machine tool", 0.02, 0.05, "metal-cutting machine tools", theory},
      {"press", 0.10, 0.15, "presses and shears", theory},
      {"shear", 0.10, 0.15, "presses and shears", theory},
      {"crusher", 0.2, 0.2, "crushing machines", khurmi},
      {"hammer", 0.2, 0.2, "hammering machines", khurmi},
      {"pump", 0.03, 0.05, "pumping machines", khurmi},
      {"rolling mill", 0.025, 0.025, "rolling mills and mining machines", khurmi},
      {"weaving", 0.025, 0.025, "paper making, textile and weaving machines", khurmi},
      {"spinning", 0.01, 0.02, "spinning machinery", khurmi},
      {"belt drive", 0.03, 0.03, "engines with belt transmission", khurmi},
      {"gear drive", 0.02, 0.02, "gear wheel transmission", khurmi},
      {"generator", 0.003, 0.003, "electrical machines", khurmi},
      {"direct generator", 0.002, 0.002, "electrical machines, direct drive", khurmi}};
  return all;
}

const CustomaryDelta& customary_delta(const std::string& machine) {
  return named(customary_deltas(), &CustomaryDelta::machine, machine,
               "no customary δ for a machine {}{}; known: {}; or give --delta");
}

// What the sizing puts beside the scene's torques, which alone would change the machine's speed from cycle to cycle.
std::string unbalanced(double drive, double load, double rest) {
  const std::string text = load == 0 ? fmt::format(
                                           "the driving torque varies with the angle and the scene has no load on "
                                           "the cycle: its mean of {:.4g} N·m is not balanced",
                                           drive)
                                     : fmt::format(
                                           "the driving torque varies with the angle; of its mean of {:.4g} N·m the "
                                           "load of the scene takes {:.4g} N·m{}",
                                           drive, load, rest < 0 ? ", more than there is" : "");
  return text + fmt::format("; sized as if a constant {} of {:.4g} N·m, which the scene does not have, balanced them",
                            rest > 0 ? "load" : "drive", std::abs(rest));
}

}  // namespace kurbel
