// forces_plots.cpp — curves over the angle of the crank, tips of forces over the cycle, orders.
#include "studies/forces/forces_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

Plot guide_point_plot(const Forces& f) {
  Plot plot =
      angle_plot("Where the guide's reaction acts, from the slider pin towards the extended end", "point of action");
  plot.note = "Beyond the guide's ends both edges are in contact.";
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

}  // namespace

Plot angle_plot(const std::string& title, const std::string& quantity) {
  return {.title = title, .x = {"crank angle", "°"}, .y = {quantity, ""}};
}

Plot in_forces(Plot plot, double largest) {
  const double factor = readable_unit(largest, "N").factor;
  plot = in_readable_unit(std::move(plot), "N", largest);
  plot.x.unit = plot.y.unit;
  for (Series& s : plot.series)
    for (double& v : s.x) v *= factor;
  plot.equal_axes = true;
  return plot;
}

std::vector<Plot> reaction_plots(const Forces& f) {
  const auto reaction = [&](const char* title, Force2 SliderCrankForces::*force) {
    return over_angle(f, title, "reaction", "N", [=](const CyclePosition& p) { return (p.forces.*force).magnitude(); });
  };
  return {reaction("Load of the main bearing", &SliderCrankForces::main_bearing),
          reaction("Load of the crank pin", &SliderCrankForces::crank_pin),
          reaction("Load of the slider pin", &SliderCrankForces::slider_pin),
          over_angle(f, "Reaction of the guide, positive 90° ahead of the stroke", "normal reaction N", "N",
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
          locus(f, "Rod's big end: pin on rod, in axes of the rod", "along the rod", "across",
                [](P p) { return p.forces.crank_pin.seen_from(p.rod_angle); }),
          locus(f, "Slider pin: slider on rod, in axes of the rod", "along the rod", "across",
                [](P p) { return (-1.0 * p.forces.slider_pin).seen_from(p.rod_angle); }),
          locus(f, "Slider pin: rod on slider, in the frame", "along the stroke", "across",
                [](P p) { return p.forces.slider_pin; })};
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
          over_angle(f, "Efficiency of the mechanism at each position", "η", "",
                     [](const CyclePosition& p) { return p.power.efficiency().value_or(std::nan("")); })};
}

}  // namespace kurbel
