// forces.cpp — the two problems over a cycle: motion given or simulated, then d'Alembert position by position.
#include "studies/forces/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/scene/units.h"
#include "mechanisms/kinds/joint_keys.h"
#include "studies/forces/force_cycle.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {
namespace {

ForceCycle cycle_along(const SliderCrankStatics& statics, OutputLoads& loads, const MotionAlong& along,
                       std::vector<Counterweight>* counterweights = nullptr) {
  ForceCycle cycle;
  cycle.cycle = along.cycle;
  CycleBuilder builder(statics, loads, cycle);
  for (std::size_t i = 0; i < along.where.size(); ++i) builder.add(along.where[i], along.motion[i]);
  builder.finish();
  cycle.speed_before = along.speed_before;
  if (counterweights) *counterweights = propose_counterweights(statics, builder, cycle.positions);
  return cycle;
}

void add_errors(const ForceCycle& loose, ForceCycle& tight) {
  const auto set = [](const Peak& a, Peak& b) {
    b.error = b.error.value_or(0) + std::abs(std::abs(a.value) - std::abs(b.value));
  };
  for (std::size_t k = 0; k < joint_count; ++k) set(loose.reaction[k], tight.reaction[k]);
  set(loose.torque, tight.torque);
  set(loose.shaking_force, tight.shaking_force);
  set(loose.shaking_moment, tight.shaking_moment);
  for (auto orders :
       {&ForceCycle::shaking_x, &ForceCycle::shaking_y, &ForceCycle::shaking_couple, &ForceCycle::torque_orders})
    for (std::size_t k = 0; k < (tight.*orders).size(); ++k)
      (tight.*orders)[k].error += std::abs((tight.*orders)[k].amplitude - (loose.*orders)[k].amplitude);
  for (std::size_t k = 0; k < tight.work.size(); ++k)
    tight.work[k].error += std::abs(loose.work[k].work - tight.work[k].work);
  tight.torque_mean_error += std::abs(loose.torque_mean - tight.torque_mean);
  tight.mean_speed_error += std::abs(loose.mean_speed - tight.mean_speed);
  tight.kinetic_error = std::abs(loose.kinetic_change - tight.kinetic_change);
  judge_works(tight);
}

}  // namespace

std::optional<double> PowerFlow::efficiency() const {
  double in = 0;
  for (const double power : {crank, load, weight, -kinetic_rate}) in += std::max(0.0, power);
  if (!(in > nothing)) return {};
  return std::max(0.0, 1 - friction / in);  // what goes out is no less than nothing
}

Forces find_forces(const Scene& scene, const ForcesOptions& options) {
  check(options);
  const Deadline deadline(scene.run.budget);
  const Section& section = chosen_mechanism(scene, options.mechanism);
  if (section.kind->name != "slider-crank")
    throw std::invalid_argument(
        fmt::format("{}: {} is no slider-crank but a {}", scene.file, section.name, section.kind->name));
  Forces out;
  out.title = scene.heading();
  out.speed_unit = scene.speed_unit;
  out.scene_file = scene.file;
  out.scene_text = scene.text;
  out.mechanism = section.name;
  out.data = slider_crank_data(section);
  out.joints = slider_crank_joints(section);
  // Rigid, with the joints' friction where they have any: motion and forces follow the same laws.
  Effects effects;
  effects.joint_friction = !out.joints.frictionless();
  const MachineMotion machine(scene, effects, section.name, options);
  if (scene.effects.joint_clearance || scene.effects.flexible_rod)
    out.notes.push_back(fmt::format("joints count as ideal and the rod as rigid: {} left out",
                                    !scene.effects.flexible_rod      ? "joint clearance is"
                                    : !scene.effects.joint_clearance ? "the flexible rod is"
                                                                     : "joint clearance and flexible rod are"));
  const SliderCrankStatics statics(out.data, out.joints);
  OutputLoads loads(scene, section.name);
  const double share = out.data.rod_com / out.data.rod_length;
  out.rotating_moment = out.data.crank_mass * out.data.crank_com + out.data.rod_mass * (1 - share) * out.data.radius;
  out.reciprocating_mass = out.data.slider_mass + out.data.rod_mass * share;

  const CrankSpeed speed = prescribed_speed(machine, options);
  const std::string at = out.speed_unit.text(speed.value);
  options.watch.say(fmt::format("first problem: {} at {} ({})", section.name, at, speed.source));
  MotionAlong motion = steady_motion(loads, speed.value, options.positions);
  out.prescribed = cycle_along(statics, loads, motion, &out.counterweights);
  out.prescribed->label = "prescribed";
  note_unbounded_reactions(out.data, loads, speed.value, out.notes);
  out.prescribed->description = fmt::format("crank turning at {} throughout, {}", at, speed.source);
  std::optional<SimulatedMotion> simulated;
  if (options.simulate) {
    options.watch.say("second problem: running the rigid machine");
    simulated = machine.solve(loads, {out.notes, out.complete, out.diagnosis});
  }
  if (simulated) {
    out.simulated = cycle_along(statics, loads, simulated->tight);
    add_errors(cycle_along(statics, loads, simulated->loose), *out.simulated);
    out.simulated->label = "simulated";
    out.simulated->description = simulated->description;
    motion = simulated->tight;
  }
  LinkageCycle links = linkage_cycle(out.data, loads, motion);
  if (simulated) add_errors(linkage_cycle(out.data, loads, simulated->loose), links);
  out.links = std::make_shared<const LinkageCycle>(std::move(links));
  return out;
}

}  // namespace kurbel
