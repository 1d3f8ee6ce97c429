// size_plots.cpp — torques, works and kinetic energy over a cycle, the energy–mass curve with its tangents, the speed.
#include "studies/size/size_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"

namespace kurbel {
namespace {

// Both sides of every jump are points.
std::vector<double> angles_of(const Piecewise& f) {
  std::vector<double> list;
  for (int k = 0; k <= curve_points; ++k) list.push_back(f.begin() + f.length() * k / curve_points);
  for (const double edge : f.breaks()) {
    list.push_back(std::max(f.begin(), edge - 1e-7));
    list.push_back(std::min(f.end(), edge + 1e-7));
  }
  std::sort(list.begin(), list.end());
  return list;
}

Series curve(const std::string& name, Role role, const Piecewise& f, double factor = 1) {
  return series_of(
      name, role, angles_of(f), [](double phi) { return phi * in_degrees; },
      [&](double phi) { return f.value(phi) * factor; });
}

Series marks_at(const std::string& name, Role role, std::vector<double> x, std::vector<double> y) {
  return marks({.name = name, .role = role, .x = std::move(x), .y = std::move(y)});
}

Series tangent_line(const std::string& name, Role role, const Tangent& t, double from, double to, double factor) {
  return {.name = name,
          .role = role,
          .x = {from, to},
          .y = {(t.intercept() + t.slope * from) * factor, (t.intercept() + t.slope * to) * factor},
          .dashed = true};
}

}  // namespace

std::vector<Plot> cycle_diagrams(const Sizing& s) {
  const WorkDiagram& d = s.diagram;
  const Axis angle{fmt::format("angle of {}", s.link), "°"};
  const ReadableUnit torque = readable_unit(d.load_torque.largest(), "N*m"),
                     energy = readable_unit(d.load_work.largest(), "J"), excess = readable_unit(d.fluctuation(), "J");
  std::vector<Plot> plots;
  plots.push_back(
      {.title = s.engine ? "Driving torque and the load that balances it"
                         : "Torque of resistance, and the constant driving torque that balances it",
       .x = angle,
       .y = {"M", torque.unit},
       .series = {curve("M_c", Role::orange, d.load_torque, torque.factor),
                  curve("M_d", Role::green, d.drive_torque, torque.factor)},
       .note = fmt::format("Mean torque {:.4g} N·m at {}.", d.mean_torque(), s.speed_unit.text(s.mid_speed, 4))});
  plots.push_back({.title = "Work of resistance and of the drive: equal at the end of the cycle",
                   .x = angle,
                   .y = {"A", energy.unit},
                   .series = {curve("A_c", Role::orange, d.load_work, energy.factor),
                              curve("A_d", Role::green, d.drive_work, energy.factor)}});
  Plot change{.title = "Change of kinetic energy ΔT = A_d − A_c",
              .x = angle,
              .y = {"ΔT", excess.unit},
              .series = {curve("ΔT", Role::elastic, d.excess, excess.factor),
                         marks_at("extremes, where M_d = M_c", Role::vermillion,
                                  {d.most.x * in_degrees, d.least.x * in_degrees},
                                  {d.most.value * excess.factor, d.least.value * excess.factor})},
              .note = fmt::format("Greatest fluctuation {}.", short_text(d.fluctuation(), "J"))};
  plots.push_back(std::move(change));
  plots.push_back({.title = "Reduced inertia of the executive mechanism",
                   .x = angle,
                   .y = {"I_em", "kg·m²"},
                   .series = {curve("I_em", Role::elastic, s.cycle.mechanism.value)}});
  return plots;
}

// ΔT over I_em with both tangents, their touching points and their intercepts on the axis I_em = 0.
std::vector<Plot> energy_mass_plots(const Sizing& s) {
  const Piecewise &excess = s.diagram.excess, &inertia = s.cycle.mechanism.value;
  const double least = inertia.minimum(s.cycle.mechanism.slope).value,
               most = inertia.maximum(s.cycle.mechanism.slope).value;
  Series closed{.name = "ΔT over I_em", .role = Role::elastic};
  const Tangent &upper = s.exact.upper, &lower = s.exact.lower;
  const ReadableUnit unit = readable_unit(std::max(std::abs(upper.intercept()), std::abs(lower.intercept())), "J");
  for (const double phi : angles_of(excess)) closed.add(inertia.value(phi), excess.value(phi) * unit.factor);
  const double span = std::max(most - least, 1e-3 * std::abs(most));
  const auto plot = [&](const std::string& title, double from, double to, const std::string& note) {
    Plot p{.title = title, .x = {"I_em", "kg·m²"}, .y = {"ΔT", unit.unit}, .series = {closed}, .note = note};
    p.series.push_back(tangent_line("tangent of slope ½ ω_max²", Role::vermillion, upper, from, to, unit.factor));
    p.series.push_back(tangent_line("tangent of slope ½ ω_min²", Role::purple, lower, from, to, unit.factor));
    p.series.push_back(marks_at("touching points", Role::orange, {upper.inertia, lower.inertia},
                                {upper.excess * unit.factor, lower.excess * unit.factor}));
    return p;
  };
  std::vector<Plot> plots;
  plots.push_back(plot("Energy–mass curve with the tangents of Wittenbauer", least - 0.2 * span, most + 0.2 * span,
                       fmt::format("Touching at φ = {:.6g}° (fastest) and {:.6g}° (slowest).", upper.phi * in_degrees,
                                   lower.phi * in_degrees)));
  if (least > 0) {
    plots.push_back(plot("The same to the axis I_em = 0: the intercepts give the inertia", 0, most + 0.05 * most,
                         fmt::format("Intercepts {} and {}; their difference over ½ (ω_max² − ω_min²) is I₀.",
                                     with_unit(upper.intercept(), "J"), with_unit(lower.intercept(), "J"))));
    plots.back().series.push_back(marks_at("intercepts", Role::green, {0, 0},
                                           {upper.intercept() * unit.factor, lower.intercept() * unit.factor}));
  }
  return plots;
}

// Speed over the cycle: at constant torque before and after, with the motor, simulated.
std::optional<Plot> speed_plot(const Sizing& s) {
  const double now = s.methods.front().drive_inertia +
                     (s.flywheel_now - s.methods.front().flywheel.value) * s.flywheel_ratio * s.flywheel_ratio;
  Plot p{.title = "Speed over the cycle, before and after",
         .x = {fmt::format("angle of {}", s.link), "°"},
         .y = {fmt::format("speed of {}", s.link), s.speed_unit.name}};
  const auto add = [&](const std::string& name, Role role, double inertia, bool dashed) {
    try {
      const SpeedCycle cycle(s.diagram, s.cycle.mechanism, inertia, s.mid_speed);
      Series series{.name = name, .role = role, .dashed = dashed};
      for (const double phi : angles_of(s.diagram.excess))
        series.add(phi * in_degrees, s.speed_unit.of(cycle.speed(phi)));
      p.series.push_back(std::move(series));
    } catch (const std::invalid_argument&) {  // it would stop within the cycle
    }
  };
  if (!s.flywheel_added && s.flywheel_now > 0) add("scene as it is, " + basis_of(s), Role::reference, now, true);
  if (s.needed) add("sized, " + basis_of(s), Role::green, s.exact.inertia, true);
  for (const DeltaReached& r : s.reached) {
    if (r.by != SizedBy::constant_drive || r.model == SizedModel::work_equation) continue;
    Series series{.name = fmt::format("sized, {}", name_of(r.model)),
                  .role = r.model == SizedModel::rigid ? Role::rigid : Role::elastic};
    for (std::size_t k = 0; k < r.phi.size(); ++k) series.add(r.phi[k] * in_degrees, s.speed_unit.of(r.speed[k]));
    p.series.push_back(std::move(series));
    if (r.model != SizedModel::elastic || s.motor.empty()) continue;
    Series motor{.name = fmt::format("sized, elastic, {} (reduced)", s.motor),
                 .role = Role::sky,
                 .x = p.series.back().x,
                 .y = {}};
    for (const double v : r.motor_speed) motor.y.push_back(s.speed_unit.of(v));
    p.series.push_back(std::move(motor));
  }
  if (p.series.empty()) return {};
  return p;
}

}  // namespace kurbel
