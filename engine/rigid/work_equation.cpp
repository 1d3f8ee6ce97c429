// work_equation.cpp — panels of work and inertia over one cycle, halved until 16 nodes resolve them.
#include "engine/rigid/work_equation.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/gauss.h"
#include "engine/base/legendre.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/period.h"

namespace kurbel {
namespace {

using legendre::integral, legendre::sum, legendre::terms;

constexpr double tail_allowed = 3e-13;                    // of the largest value, for the last two coefficients
constexpr double closes_within = 1e-12;                   // work per cycle over turnover
constexpr double tail_of_narrow = 1e-11;                  // of the largest value: within 10⁻¹⁴ of a turn's work
constexpr double narrowest = std::numbers::pi * 0x1p-22;  // [rad]: a corner that is no edge of the machine
constexpr std::size_t many_panels = 8192;  // from this number on none is bisected below `narrow`: the rest is rounding
constexpr double rounding_torque = 1e-9;   // of the machine's scale: a machine without torques has nothing to resolve

double largest(std::span<const double> values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

WorkOverAngle::WorkOverAngle(RigidMachine& machine, const std::vector<double>& edges, int direction)
    : direction_(direction >= 0 ? 1 : -1), cycle_(machine.cycle()) {
  std::vector<double> end = edges;
  for (double& e : end)
    if (direction_ < 0) e = e > 0 ? cycle_ - e : 0;
  std::sort(end.begin(), end.end());
  end.push_back(cycle_);
  double largest_torque = rounding_torque * machine.model().torque_scale;
  for (int i = 0; i < 360; ++i) {
    const double phi = direction_ * cycle_ * (i + 0.5) / 360;
    machine.set_modes(phi, direction_);
    largest_torque = std::max(largest_torque, std::abs(machine.at(phi, direction_).torque));
  }
  double begin = 0;
  for (const double e : end) {
    if (e - begin < 1e-11) continue;
    const int parts = static_cast<int>(std::ceil((e - begin) / (0.5 * std::numbers::pi) - 1e-9));
    for (int i = 0; i < parts; ++i)
      add_panels(machine, begin + (e - begin) * i / parts, begin + (e - begin) * (i + 1) / parts, largest_torque);
    begin = e;
  }
  close_cycle();
}

// One panel where 16 nodes resolve I_r and M, else two halves.
void WorkOverAngle::add_panels(RigidMachine& machine, double begin, double end, double largest_torque) {
  Deadline::check();
  Panel panel;
  panel.begin = begin;
  panel.half = 0.5 * (end - begin);
  Values torque{};
  machine.set_modes(direction_ * (begin + panel.half), direction_);
  for (std::size_t i = 0; i < nodes; ++i) {
    const RigidMachine::At at =
        machine.at(direction_ * (begin + panel.half * (1 + gauss<nodes>.x[i])), static_cast<double>(direction_));
    panel.inertia[i] = at.inertia;
    torque[i] = direction_ * at.torque;
  }
  panel.inertia_term = terms(panel.inertia);
  panel.torque_term = terms(torque);
  const auto tail = [](const Values& c) { return std::abs(c[nodes - 1]) + std::abs(c[nodes - 2]); };
  const double allowed = end - begin > narrow ? tail_allowed : tail_of_narrow;
  const bool resolved = tail(panel.inertia_term) <= allowed * largest(panel.inertia) &&
                        tail(panel.torque_term) <= allowed * std::max(largest_torque, largest(torque));
  if (!resolved && end - begin > (panel_.size() < many_panels ? narrowest : narrow)) {
    add_panels(machine, begin, begin + panel.half, largest_torque);
    add_panels(machine, begin + panel.half, end, largest_torque);
    return;
  }
  panel.work_begin = per_cycle_;
  for (std::size_t i = 0; i < nodes; ++i) {
    panel.work[i] = panel.work_begin + panel.half * integral(panel.torque_term, gauss<nodes>.x[i]);
    turnover_ += panel.half * gauss<nodes>.w[i] * std::abs(torque[i]);
  }
  per_cycle_ = panel.work_begin + panel.half * integral(panel.torque_term, 1);
  panel_.push_back(panel);
}

// The work per cycle by rounding of the tables, of a cycle without work, is subtracted uniformly over the cycle.
void WorkOverAngle::close_cycle() {
  if (std::abs(per_cycle_) > closes_within * turnover_) return;
  const double excess = per_cycle_ / cycle_;
  for (Panel& panel : panel_) {
    panel.torque_term[0] -= excess;
    panel.work_begin -= excess * panel.begin;
    for (std::size_t i = 0; i < nodes; ++i)
      panel.work[i] -= excess * (panel.begin + panel.half * (1 + gauss<nodes>.x[i]));
  }
  per_cycle_ = 0;
}

const WorkOverAngle::Panel& WorkOverAngle::panel_at(double s) const {
  const auto after =
      std::upper_bound(panel_.begin(), panel_.end(), s, [](double x, const Panel& p) { return x < p.begin; });
  return after == panel_.begin() ? panel_.front() : *(after - 1);
}

double WorkOverAngle::work_in(const Panel& panel, double s) const {
  return panel.work_begin + panel.half * integral(panel.torque_term, (s - panel.begin) / panel.half - 1);
}

double WorkOverAngle::inertia_in(const Panel& panel, double s) const {
  return sum(panel.inertia_term, (s - panel.begin) / panel.half - 1);
}

double WorkOverAngle::work(double s) const {
  const double rest = place_within(s, cycle_), cycles = std::round((s - rest) / cycle_);
  return cycles * per_cycle_ + work_in(panel_at(rest), rest);
}

double WorkOverAngle::inertia(double s) const {
  const double rest = place_within(s, cycle_);
  return inertia_in(panel_at(rest), rest);
}

}  // namespace kurbel
