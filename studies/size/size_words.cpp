// size_words.cpp — the sized flywheel in sentences.
#include "studies/size/size_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/size/size_plots.h"

namespace kurbel {
namespace {

const SizeMethod& exact_method(const Sizing& s) { return s.methods.front(); }

const DeltaReached* reached(const Sizing& s, SizedModel model) {
  for (const DeltaReached& r : s.reached)
    if (r.model == model && r.by == SizedBy::constant_drive) return &r;
  return nullptr;
}

const DeltaReached* motion_of_machine(const Sizing& s) {
  const DeltaReached* real = reached(s, SizedModel::elastic);
  return real ? real : reached(s, SizedModel::rigid);
}
// The machine as it is has a larger δ with the flywheel of the work equation, by more than its error.
bool misses(const Sizing& s) {
  constexpr double visible = 1.02;
  const DeltaReached* real = motion_of_machine(s);
  return s.needed && real && real->crank.value - real->crank.error.value_or(0) > visible * s.delta;
}

// Where the flywheel is.
std::string on_what(const Sizing& s) {
  return s.flywheel_added ? fmt::format("the shaft of \"{}\"", s.link) : fmt::format("\"{}\"", s.flywheel);
}

// What the drive needs without a flywheel, on the flywheel's shaft.
std::string without_flywheel(const Sizing& s) {
  const double others = s.motor_inertia + s.gearbox_inertia + s.other_inertia;
  const double needed = exact_method(s).flywheel.value + others;
  constexpr double rounding = 1e-9;  // of the inertias
  return needed > rounding * others
             ? fmt::format("of the drive's {:.4g} kg·m² on {} {:.4g} kg·m² suffice", others, on_what(s), needed)
             : std::string("its torques would not make the speed fluctuate as much with any inertia");
}

// Of an inertia against another: in percent, beyond twice as much in times.
std::string as_against(double inertia, double other) {
  const double less = 100 * (1 - inertia / other);
  return less < -100 ? fmt::format("{:.3g} times as much", inertia / other)
                     : fmt::format("{:.3g} % {}", std::abs(less), less >= 0 ? "less" : "more");
}

std::string at_link(const Sizing& s) { return s.link_is_crank ? "the crank" : fmt::format("the link \"{}\"", s.link); }

std::string at_motor(const Sizing& s, const DeltaReached& r) {
  return s.motor.empty() || r.model == SizedModel::rigid ? "" : fmt::format(", and {:.4g} at the motor", r.motor.value);
}

std::string fluctuation_in_words(const WorkDiagram& d) {
  constexpr double rounding = 1e-12;  // of the work
  return d.fluctuation() <= rounding * d.load_work.largest()
             ? std::string("its torques balance at every angle: the energy does not fluctuate")
             : fmt::format("greatest fluctuation of energy {} between {:.5g}° and {:.5g}°",
                           with_unit(d.fluctuation(), "J"), std::min(d.least.x, d.most.x) * in_degrees,
                           std::max(d.least.x, d.most.x) * in_degrees);
}

}  // namespace

std::string conclusion_of(const Sizing& s) {
  const SizeMethod& exact = exact_method(s);
  if (s.needed && exact.flywheel.value <= 0)
    return fmt::format("By the work equation no flywheel is needed for δ = {:g}{}", s.delta,
                       misses(s) && s.meeting
                           ? ""
                           : fmt::format(", but with the scene's effects the machine has δ = {:.4g}; {}",
                                         s.reached.front().crank.value, s.meeting_words));
  if (!s.needed)
    return fmt::format("{} flywheel is needed for δ = {:g}: without any, δ is smaller already; {}",
                       s.estimate ? "By an estimate, the rigid machine without its losses, no" : "No", s.delta,
                       without_flywheel(s));
  std::string text = s.estimate ? fmt::format(
                                      "An estimate, by the rigid machine without its losses: a flywheel of about "
                                      "{:.3g} kg·m² on {} for δ = {:g} {}",
                                      exact.flywheel.value, on_what(s), s.delta, basis_of(s))
                                : fmt::format("A flywheel of {:.4g} kg·m² on {} keeps δ at {:g} {}",
                                              exact.flywheel.value, on_what(s), s.delta, basis_of(s));
  text += fmt::format(", at a mid speed of {} of \"{}\" ({})", s.speed_unit.text(s.mid_speed, 4), s.link,
                      s.mid_speed_source);
  if (s.stalls) text += "; with the torques as they are over the speed the machine stalls with it";
  if (s.soft)
    text += s.soft->none_needed
                ? fmt::format("; with {} considered none is needed", slope_of_what(s))
                : fmt::format("; with {} considered {:.4g} kg·m² {} ({})", slope_of_what(s), s.soft->flywheel.value,
                              s.soft->flywheel.value <= exact.flywheel.value ? "suffice" : "are needed",
                              as_against(s.soft->flywheel.value, exact.flywheel.value));
  if (!s.meeting_words.empty() && !(misses(s) && s.meeting)) text += "; " + s.meeting_words;
  return text;
}

// One sentence per model: δ is demanded and assessed at the crank.
std::vector<std::string> motions_in_words(const Sizing& s) {
  std::vector<std::string> list;
  for (const SizedModel model : {SizedModel::rigid, SizedModel::elastic})
    if (const DeltaReached* r = s.needed ? reached(s, model) : nullptr; r && !(misses(s) && r == motion_of_machine(s)))
      list.push_back(fmt::format("{} with {:.4g} kg·m², δ is {:.4g} at {}{}",
                                 model == SizedModel::elastic ? "Simulated elastic" : "Simulated rigid", r->flywheel,
                                 r->crank.value, at_link(s), at_motor(s, *r)));
  return list;
}

std::string comparison_with_scene(const Sizing& s) {
  if (s.flywheel_added) return fmt::format("The scene has no flywheel; it is put on the shaft of \"{}\".", s.link);
  const double needed = s.chosen().flywheel.value;
  const std::string now = std::isnan(s.delta_now) ? "the machine would stop within the cycle"
                                                  : fmt::format("δ = {:.4g} {}", s.delta_now, basis_of(s));
  return fmt::format("The scene's \"{}\" has {:.4g} kg·m²: {}; {}.", s.flywheel, s.flywheel_now, now,
                     needed <= 0 ? std::string("none is needed")
                                 : fmt::format("{:.4g} kg·m² are needed{}", needed,
                                               s.meeting ? " with the torques as they are over the speed" : ""));
}

Sentences basis_words(const Sizing& s) {
  return {
      .lines = {fmt::format("δ = {:g} ({}), mid speed {} of {} ({})", s.delta, s.delta_source,
                            s.speed_unit.text(s.mid_speed), s.link, s.mid_speed_source),
                fmt::format("work of a cycle {}, {}", with_unit(s.diagram.work, "J"), fluctuation_in_words(s.diagram)),
                s.basis == CycleBasis::classical
                    ? std::string("classical: constant drive torque; loads of the rigid machine at constant speed")
                    : std::string("loads along the steady cycle that the machine has with the scene's effects, and "
                                  "the constant drive torque that balances them"),
                comparison_with_scene(s)},
      .indent = "  ",
      .page = false};
}

std::string punch_words(const PunchPress& p) {
  return fmt::format(
      "punch-press form: a stroke takes {} within {:.4g} s of {:.4g} s; the flywheel gives {}, the motor {}",
      with_unit(p.energy, "J"), p.working_time, p.cycle_time, with_unit(p.from_flywheel(), "J"),
      with_unit(p.power(), "W"));
}

std::optional<Claim> missed_demand(const Sizing& s) {
  if (!misses(s)) return {};
  const DeltaReached* real = motion_of_machine(s);
  const double by_work = exact_method(s).flywheel.value;
  const std::string needed = !s.meeting ? std::string()
                             : s.flywheel_added
                                 ? fmt::format("{:.4g} kg·m² are needed on {}; ", s.meeting->flywheel.value, on_what(s))
                                 : fmt::format("{} needs {:.4g} kg·m²; ", on_what(s), s.meeting->flywheel.value);
  const std::string equation = by_work > 0
                                   ? fmt::format("gives {:.4g} kg·m², too small for δ = {:g}:", by_work, s.delta)
                                   : fmt::format("requires no flywheel for δ = {:g}, but", s.delta);
  return claimed(Predicate::demand_missed,
                 fmt::format("{}the work equation {} simulated {}, δ is {:.4g} at {}, {:.3g} times that{}{}", needed,
                             equation, real->model == SizedModel::elastic ? "elastic" : "rigid", real->crank.value,
                             at_link(s), real->crank.value / s.delta, at_motor(s, *real),
                             s.meeting && !real->slips.empty() ? "; " + real->slips : ""),
                 s.link, {.value = real->crank.value, .limit = s.delta, .error = real->crank.error});
}

}  // namespace kurbel
