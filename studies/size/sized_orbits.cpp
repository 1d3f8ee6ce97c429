// sized_orbits.cpp — δ from the steady motion of the sized machine, and the inertia found by it.
#include "studies/size/sized_orbits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"
#include "engine/values/dense_tables.h"
#include "studies/answers/slip_recorder.h"
#include "studies/cycle/classical.h"
#include "studies/scenes/kinds.h"
#include "studies/steady/cycle_search.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/static_curve.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr int most_orbits = 8;
constexpr double near_enough = 1e-5;  // of the demanded δ
constexpr double least_error = 1e-9;  // that sampling leaves in δ, over itself
const Kind& flywheel_kind() {
  for (const Kind& kind : all_kinds())
    if (kind.name == "flywheel") return kind;
  throw std::logic_error("no kind \"flywheel\"");
}

double delta_of(const Piecewise& speed) {
  const double most = speed.maximum().value, least = speed.minimum().value;
  return (most - least) / std::abs(0.5 * (most + least));
}

// Clutches and torque limiters that slip within the period although they are closed.
std::string what_slips(const Orbit& orbit) {
  Equations equations(orbit.map->shared_model(), true);
  const Model& m = equations.model();
  SlipRecorder slips(m);
  follow_period(*orbit.map, orbit.point, equations, {.tolerance = orbit.map->options().tolerance}, {&slips});
  std::string text;
  for (const SlipRecorder::Joint& joint : slips.joints())
    if (joint.kind != "one-way clutch" && joint.let_go.times + (joint.open.times == 0 ? joint.engaging.times : 0) > 0)
      text +=
          fmt::format("{}\"{}\" slips, as the torque reaches the {:.4g} N·m that it holds", text.empty() ? "" : "; ",
                      joint.component, m.network.joints[kurbel::at(m.elastic[joint.elastic].joint)].element->capacity);
  return text;
}

void fill(SizedOrbit& r, const OrbitCycle& c, double motor_ratio) {
  r.found = true;
  r.crank.value = c.delta();
  r.motor.value = delta_of(c.others.front());
  r.mid_speed = c.sense * c.mid_speed();
  r.start_speed = c.sense * c.speed.value(0);
  for (int k = 0; k <= curve_points; ++k) {
    const double s = c.way() * k / curve_points;
    r.phi.push_back(s);
    r.speed.push_back(c.sense * c.speed.value(s));
    r.motor_speed.push_back(c.others.front().value(s) / motor_ratio);
  }
}

}  // namespace

std::string chosen_flywheel(const Scene& scene, const std::string& named) {
  std::vector<std::string> bodies, flywheels;
  for (const Section& s : scene.components) {
    if (s.kind->name == "flywheel" || s.kind->name == "inertia") bodies.push_back(s.name);
    if (s.kind->name == "flywheel") flywheels.push_back(s.name);
  }
  if (!named.empty()) {
    if (std::count(bodies.begin(), bodies.end(), named)) return named;
    throw std::invalid_argument(
        fmt::format("--flywheel {}: no flywheel or inertia of the scene; {}", in_quotes(named),
                    bodies.empty() ? "it has none: leave the option out, and one is put on the crank's shaft"
                                   : "allowed: " + listed(bodies)));
  }
  if (flywheels.size() > 1)
    throw std::invalid_argument(
        fmt::format("the scene has several flywheels, {}; say which one is to be sized: --flywheel NAME",
                    listed(flywheels, "and")));
  return flywheels.empty() ? "" : flywheels.front();
}

Scene with_flywheel(Scene scene, const std::string& flywheel, double inertia, const std::string& on) {
  for (Section& section : scene.components) {
    if (section.name != flywheel) continue;
    for (Setting& setting : section.settings)
      if (setting.key == "inertia") setting.number = inertia;
    return scene;
  }
  Section section{.name = flywheel, .kind = &flywheel_kind(), .at = {}};
  Setting setting;
  setting.key = "inertia";
  setting.given = true;
  setting.number = inertia;
  section.settings.push_back(std::move(setting));
  scene.components.push_back(std::move(section));
  scene.lines.push_back({.from = on, .names = {flywheel}, .at = {}, .name_at = {}});
  return scene;
}

SizedOrbit SizedOrbits::at(double flywheel, const Effects& effects, std::optional<double> start_speed,
                           bool with_error) const {
  Scene sized = with_flywheel(scene_, parts_.flywheel, flywheel, parts_.on);
  if (start_speed && sized.sequence.steps.empty()) {
    sized.run.start = {};
    sized.run.start.speed = *start_speed;
    sized.run.start.equilibrium = true;
  }
  SizedOrbit r;
  r.flywheel = flywheel;
  r.start_speed = start_speed;
  try {
    const auto model = compile_at(sized, effects, parts_.moment);
    const int motor = parts_.motor.empty() ? model->reduction_node : model->network.ports.at(parts_.motor).out;
    OrbitOptions options = orbit_options(sized.run, watch_.interrupted);
    options.most_periods = parts_.most_periods;
    options.progress = [this](const std::string& what, double part) { watch_.at(what, part); };
    Orbit orbit = find_orbit(model, options);
    Deadline::check();
    if (!orbit.repeats() && parts_.held && orbit.kind != Orbit::Kind::interrupted)
      orbit = held_orbit(sized, effects, *parts_.held, parts_.moment, watch_).orbit;
    watch_.say(fmt::format("flywheel of {:.6g} kg·m², effects {}: {}: {}", flywheel, effects.describe(),
                           name_of(orbit.kind), orbit.words));
    r.cycles = static_cast<int>(std::lround(orbit.cost));
    r.interrupted = orbit.kind == Orbit::Kind::interrupted;
    r.stops = orbit.kind == Orbit::Kind::at_rest;
    r.why = orbit.words;
    if (!orbit.repeats()) return r;
    const OrbitCycle cycle = orbit_cycle(orbit, {motor});
    fill(r, cycle, model->node_ratio[kurbel::at(motor)]);
    if (!orbit.point.multipliers.empty()) r.multiplier = orbit.point.largest();
    r.notes = static_curve_notes(*orbit.map, orbit.point);
    if (r.slips = what_slips(orbit); !r.slips.empty()) r.notes.push_back(r.slips);
    for (std::string& sentence : substitutes(*model)) r.notes.push_back(std::move(sentence));
    for (std::string& sentence : outside_data(*orbit.map, orbit.point)) r.notes.push_back(std::move(sentence));
    if (!with_error) return r;
    if (const auto looser = looser_orbit_cycle(orbit, {motor})) {
      // Remaining change of the run, and the error of δ = ΔA/(I ω²) by dense tables.
      const double left = orbit.point.still_to_come() + left_by_tables(sized) * cycle.cycle.load.largest() *
                                                            cycle.way() /
                                                            (cycle.inertia.mean() * std::pow(cycle.mid_speed(), 2));
      for (const auto& [delta, other] :
           {std::pair{&r.crank, looser->delta()}, std::pair{&r.motor, delta_of(looser->others.front())}}) {
        *delta = estimate_from(delta->value, other, least_error * delta->value);
        delta->widen(left);
      }
    }
  } catch (const SceneError& error) {
    r.why = error.what();
  } catch (const std::invalid_argument& error) {
    r.why = error.what();
  }
  return r;
}

SizedOrbits::Meeting SizedOrbits::meeting(double delta, const SizedOrbit& first, double others, const Effects& effects,
                                          double met) const {
  Meeting m;
  constexpr double flattest = -0.05, furthest = 1.5, least_apart = 1e-5;  // of a slope's pair: nearer ones give noise
  double heavy_enough = HUGE_VAL, too_light = -HUGE_VAL;                  // ln I
  SizedOrbit last = first;
  const auto log_inertia = [&] { return std::log(std::max(last.flywheel + others, 1e-300)); };
  const auto unknown = [](const SizedOrbit& r) { return fmt::format("with {:.6g} kg·m²: {}", r.flywheel, r.why); };
  for (; last.stops && m.orbits < most_orbits; ++m.orbits) {
    too_light = log_inertia();
    last = at(2 * last.flywheel + others, effects, last.start_speed, false);
  }
  if (!last.found) {
    if (!last.stops) m.unknown = unknown(last);
    return m;
  }
  m.least = last.crank.value, m.least_at = last.flywheel, m.slips = last.slips;
  // u = ln I, v = ln δ/δ_demanded, which decreases as −u if the flywheel is the dominant inertia.
  double u = log_inertia(), v = std::log(last.crank.value / delta), slope = -1, damping = 1;
  (v > 0 ? too_light : heavy_enough) = u;
  const int most = m.orbits + most_orbits;
  int in_vain = 0;
  while (m.orbits < most && in_vain < 2) {
    double next = u + std::clamp(-v / (damping * std::min(slope, flattest)), -furthest, furthest);
    if (next <= too_light || next >= heavy_enough) next = 0.5 * (too_light + heavy_enough);
    if (!std::isfinite(next)) break;
    const double flywheel = std::max(0.0, std::exp(next) - others);
    SizedOrbit r = at(flywheel, effects, last.start_speed, false);
    ++m.orbits;
    if (!r.found) {
      if (r.interrupted) break;
      if (r.stops && next < u) {
        too_light = std::max(too_light, next);  // it stalls: that is too little inertia
      } else {
        m.unknown = unknown(r);
        ++in_vain;
      }
      damping *= 2;  // nearer to what has a motion
      continue;
    }
    const double now = std::log(r.crank.value / delta);
    const bool heavier_in_vain = next > u && now > v - 1e-3 * (next - u);
    in_vain = heavier_in_vain ? in_vain + 1 : 0;
    if (std::abs(next - u) > least_apart) slope = (now - v) / (next - u);
    u = next, v = now, damping = 1, last = std::move(r);
    if (last.crank.value < m.least) m.least = last.crank.value, m.least_at = last.flywheel, m.slips = last.slips;
    m.none_needed = flywheel == 0 && v < 0;
    if (std::abs(last.crank.value / delta - 1) <= met || m.none_needed) break;
    (v > 0 ? too_light : heavy_enough) = u;
  }
  if (m.orbits == 0 || !(m.none_needed || std::abs(last.crank.value / delta - 1) <= std::max(met, near_enough)))
    return m;
  m.orbit = at(last.flywheel, effects, last.start_speed, true);
  ++m.orbits;
  if (!m.orbit->found)
    m.orbit.reset();
  else if (!m.none_needed)
    m.error = (last.flywheel + others) *
              (std::abs(m.orbit->crank.value / delta - 1) + m.orbit->crank.error.value_or(0) / delta) / std::abs(slope);
  return m;
}

}  // namespace kurbel
