// flywheel_falls.cpp — running maximum and the fall below it; extremes within a step by its dense output.
#include "studies/duty/flywheel_falls.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "drivetrain/shared/rating_keys.h"
#include "engine/numerics/index.h"
#include "engine/numerics/straight.h"
#include "engine/numerics/turns.h"

namespace kurbel {
namespace {

constexpr double likeness = 1e-4;  // falls that differ by less are one fall that repeats
constexpr double nothing =
    1e-9;  // of the usual speed: a fall below it is none, as of a solution that rings in its first steps

}  // namespace

FlywheelFalls::FlywheelFalls(const Model& model) : sources_(model) {
  for (const auto& [component, flywheel] : model.network.data.all<Flywheel>()) {
    const std::size_t node = at(model.network.ports.at(component).out);
    if (at(model.shaft_of_node[node]) >= model.free_shafts) continue;  // its speed is given
    wheels_.push_back({.component = component,
                       .inertia = flywheel.inertia,
                       .shaft = model.shaft_of_node[node],
                       .gain = model.gain_of_node[node]});
  }
}

// In a periodic motion the falls differ by rounding: the time is that of the first.
void FlywheelFalls::Wheel::look(double t, double speed) {
  const double fall = highest - speed;
  if (speed > to + 0.01 * (from - to)) risen = true;
  if (!(fall > from - to)) return;
  from = highest, to = speed;
  if (risen && fall < alike * (1 + likeness)) return;
  low_at = t, alike = fall, risen = false;
}

void FlywheelFalls::begin(double /*t*/, std::span<const double> y, Equations& equations) {
  for (Wheel& w : wheels_) {
    w.state = equations.speed_index(w.shaft);
    w.highest = std::max(w.highest, std::abs(w.gain * y[w.state]));
  }
}

void FlywheelFalls::step(StepView& view) {
  const bool driven = sources_.drive(view.equations().modes().active);
  for (Wheel& w : wheels_) {
    const auto see = [&](double t, double speed) {
      w.highest = std::max(w.highest, speed);
      if (driven) w.look(t, speed);
    };
    if (!driven) w.highest = 0;  // what nothing drives runs down
    const double y0 = view.y_previous()[w.state], y1 = view.y()[w.state];
    const double w0 = std::abs(w.gain * y0), w1 = std::abs(w.gain * y1);
    see(view.t_previous(), w0);
    // Within the step it may exceed both ends; searched for only if it could matter.
    const double change = std::abs(w1 - w0), reach = 2 * (change + w.change);
    w.change = change;
    const double mean_slope = (y1 - y0) / (view.t() - view.t_previous());
    const bool runs_on =
        y0 * y1 > 0 && runs_straight(view.ydot_previous()[w.state], view.ydot()[w.state], mean_slope, closely);
    if (driven && (std::max(w0, w1) + reach > w.highest || w.highest - std::min(w0, w1) + reach > w.from - w.to) &&
        !runs_on)
      search(view, w, see);
    see(view.t(), w1);
  }
}

template <class See>
void FlywheelFalls::search(StepView& view, const Wheel& w, const See& see) {
  const auto speed = [&](double t) { return std::abs(w.gain * view.at(t, w.state)); };
  for_each_turn_within(view.t_previous(), view.t(), speed, [&](double t) { see(t, speed(t)); });
}

void FlywheelFalls::report(const Model& model, const FlywheelFalls* seen, double energy_scale, FigureReporter& report) {
  for (const auto& [component, flywheel] : model.network.data.all<Flywheel>()) {
    const Wheel* wheel = nullptr;
    for (const Wheel& w : seen ? std::span(seen->wheels_) : std::span<const Wheel>())
      if (w.component == component && w.from - w.to > nothing * model.speed_scale) wheel = &w;
    report("speed_drop", component, [&]() -> std::optional<Found> {
      if (!wheel) return {};
      return Found{(wheel->from - wheel->to) / wheel->from, 1, wheel->low_at};
    });
    report("energy_given", component, [&]() -> std::optional<Found> {
      if (!wheel) return {};
      return Found{0.5 * wheel->inertia * (wheel->from * wheel->from - wheel->to * wheel->to), energy_scale,
                   wheel->low_at};
    });
  }
}

}  // namespace kurbel
