// forces_plots.cpp — curves over the angle of the crank in readable units, tips of forces over the cycle, orders.
#include "studies/forces/forces_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/numerics/angles.h"
#include "studies/findings/plots.h"

namespace kurbel {
namespace {

using Quantity = std::function<double(const CyclePosition&)>;

// Where it is finite.
Series over_angle(const std::string& name, Role role, const ForceCycle& c, const Quantity& value) {
  Series series{.name = name, .role = role};
  for (const CyclePosition& p : c.curve)
    if (const double v = value(p); std::isfinite(v)) series.add(in_degrees * p.state.phi, v);
  return series;
}

Plot angle_plot(const std::string& title, const std::string& quantity) {
  return {.title = title, .x = {"crank angle", "°"}, .y = {quantity, ""}};
}

// Of both problems, in the unit in which it reads easily.
Plot both(const Forces& f, const std::string& title, const std::string& quantity, const std::string& unit,
          const Quantity& value) {
  Plot plot = angle_plot(title, quantity);
  for (const auto& c : force_curves_of(f)) plot.series.push_back(over_angle(c.name, c.role, *c.cycle, value));
  return unit.empty() ? plot : in_readable_unit(std::move(plot), unit);
}

Plot guide_point_plot(const Forces& f) {
  Plot plot =
      angle_plot("Where the guide's reaction acts, from the slider pin towards the extended end", "point of action");
  plot.note = "Beyond the guide's ends both edges bear.";
  // Where N passes through zero the point runs away to infinity: left out where it is as far beyond the guide's ends as
  // these are apart.
  const double reach = f.joints.guide.length > 0 ? 1.5 * f.joints.guide.length : 3 * f.data.radius;
  for (const auto& c : force_curves_of(f))
    plot.series.push_back(over_angle(c.name, c.role, *c.cycle, [&](const CyclePosition& p) {
      return std::abs(p.forces.guide_point - f.joints.guide.middle) < reach ? p.forces.guide_point : std::nan("");
    }));
  if (f.joints.guide.length > 0)
    for (const int side : {1, -1})
      plot.series.push_back(dashed(over_angle(
          side > 0 ? "ends of the guide" : "", Role::reference, front_of(f),
          [&](const CyclePosition&) { return f.joints.guide.middle + side * 0.5 * f.joints.guide.length; })));
  return in_readable_unit(std::move(plot), "m");
}

// Equal axes, both in the unit in which forces up to `largest` read easily.
Plot in_forces(Plot plot, double largest) {
  const double factor = readable_unit(largest, "N").factor;
  plot = in_readable_unit(std::move(plot), "N", largest);
  plot.x.unit = plot.y.unit;
  for (Series& s : plot.series)
    for (double& v : s.x) v *= factor;
  plot.equal_axes = true;
  return plot;
}

// Locus of a force's tip over the cycle.
Plot locus(const Forces& f, const std::string& title, const std::string& x, const std::string& y,
           const std::function<Force2(const CyclePosition&)>& force) {
  Plot plot{.title = title, .x = {x, ""}, .y = {y, ""}};
  double largest = 0;
  for (const auto& c : force_curves_of(f)) {
    Series& s = plot.series.emplace_back(Series{.name = c.name, .role = c.role});
    for (const CyclePosition& p : c.cycle->curve) {
      const Force2 v = force(p);
      s.add(v.x, v.y);
      largest = std::max(largest, v.magnitude());
    }
  }
  return in_forces(std::move(plot), largest);
}

}  // namespace

Plot torque_plot(const Forces& f) {
  return both(f, "Torque that the shaft must give the crank", "balancing torque M", "N*m",
              [](const CyclePosition& p) { return p.forces.torque; });
}

std::vector<Plot> reaction_plots(const Forces& f) {
  const auto reaction = [&](const char* title, Force2 SliderCrankForces::*force) {
    return both(f, title, "reaction", "N", [=](const CyclePosition& p) { return (p.forces.*force).magnitude(); });
  };
  return {reaction("Load of the main bearing", &SliderCrankForces::main_bearing),
          reaction("Load of the crank pin", &SliderCrankForces::crank_pin),
          reaction("Load of the slider pin", &SliderCrankForces::slider_pin),
          both(f, "Reaction of the guide, positive 90° ahead of the stroke", "normal reaction N", "N",
               [](const CyclePosition& p) { return p.forces.guide; }),
          guide_point_plot(f)};
}

std::vector<Plot> polar_plots(const Forces& f) {
  using P = const CyclePosition&;
  return {locus(f, "Main bearing: crank on frame, in the frame", "along the stroke", "across",
                [](P p) { return -1.0 * p.forces.main_bearing; }),
          locus(f, "Main journal: frame on crank, turning with the crank", "towards the crank pin", "ahead of it",
                [](P p) { return p.forces.main_bearing.seen_from(p.state.phi); }),
          locus(f, "Crank pin: rod on pin, in the frame", "along the stroke", "across",
                [](P p) { return -1.0 * p.forces.crank_pin; }),
          locus(f, "Crank pin: rod on pin, turning with the crank", "outwards", "ahead",
                [](P p) { return (-1.0 * p.forces.crank_pin).seen_from(p.state.phi); }),
          locus(f, "Rod's big end: pin on rod, swinging with the rod", "along the rod", "across",
                [](P p) { return p.forces.crank_pin.seen_from(p.rod_angle); }),
          locus(f, "Slider pin: slider on rod, swinging with the rod", "along the rod", "across",
                [](P p) { return (-1.0 * p.forces.slider_pin).seen_from(p.rod_angle); }),
          locus(f, "Slider pin: rod on slider, in the frame", "along the stroke", "across",
                [](P p) { return p.forces.slider_pin; })};
}

std::vector<Plot> shaking_plots(const Forces& f) {
  return {both(f, "Shaking force on the frame along the stroke", "force", "N",
               [](const CyclePosition& p) { return p.forces.shaking_force.x; }),
          both(f, "Shaking force on the frame across the stroke", "force", "N",
               [](const CyclePosition& p) { return p.forces.shaking_force.y; }),
          both(f, "Shaking moment on the frame about the crank's axis", "moment", "N*m",
               [](const CyclePosition& p) { return p.forces.shaking_moment; })};
}

Plot harmonic_plot(const ForceCycle& c) {
  const auto bars = [](const char* name, Role role, const std::vector<ForceHarmonic>& orders) {
    return series_of(name, role, orders, &ForceHarmonic::order,
                     [](const ForceHarmonic& h) { return h.amplitude.value; });
  };
  return {.title = fmt::format("Orders of the shaking force, {} motion", c.label),
          .x = {"order of the crank's turn", ""},
          .y = {"amplitude", "N"},
          .series = {bars("along the stroke", Role::elastic, c.shaking_x), bars("across", Role::orange, c.shaking_y)},
          .bars = true};
}

Plot counterweight_plot(const Forces& f) {
  Plot plot{.title = "Shaking force before and after balancing, at constant speed",
            .x = {"along the stroke", ""},
            .y = {"across", ""},
            .note = "Tip of the force on the frame over a turn."};
  double largest = 0;
  for (const Counterweight& c : f.counterweights) {
    largest = std::max(largest, c.peak_force.value);
    const std::size_t i = plot.series.size();
    plot.series.push_back(
        series_of(c.name, i == 0 ? Role::reference : further_role(i - 1), c.shaking, &Force2::x, &Force2::y));
    plot.series.back().dashed = i == 0;
  }
  return in_forces(std::move(plot), largest);
}

std::vector<Plot> friction_plots(const Forces& f) {
  Plot power = angle_plot("Power lost in the joints", "power");
  for (std::size_t k = 0; k < joint_count; ++k)
    power.series.push_back(over_angle(name_of(static_cast<Joint>(k)), further_role(k), front_of(f),
                                      [k](const CyclePosition& p) { return p.forces.friction_power[k]; }));
  return {in_readable_unit(std::move(power), "W"),
          both(f, "Efficiency of the mechanism at each position", "η", "",
               [](const CyclePosition& p) { return p.power.efficiency().value_or(std::nan("")); })};
}

}  // namespace kurbel
