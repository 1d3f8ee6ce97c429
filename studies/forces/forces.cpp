// forces.cpp — the two problems over a cycle: motion given or simulated, then d'Alembert position by position.
#include "studies/forces/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"
#include "engine/rigid/rigid_machine.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/cycle/classical.h"
#include "studies/cycle/machine_cycle.h"
#include "studies/forces/force_cycle.h"
#include "studies/forces/linkage_cycle.h"
#include "studies/forces/machine_motion.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

ForceCycle cycle_along(const SliderCrankStatics& statics, OutputLoads& loads, const MotionAlong& along,
                       std::vector<Counterweight>* counterweights = nullptr) {
  ForceCycle cycle;
  cycle.cycle = along.cycle;
  CycleBuilder builder(statics, loads, cycle);
  for (std::size_t i = 0; i < along.where.size(); ++i) builder.add(along.where[i], along.motion[i]);
  builder.finish();
  if (counterweights) *counterweights = propose_counterweights(statics, builder, cycle.positions);
  return cycle;
}

// What the machine's own equations have otherwise than rigid links in ideal joints, pointwise at most: an error of every
// figure that it touches.
struct Missed {
  double torque = 0, greatest_torque = 0;
  std::array<double, joint_count> reaction{}, greatest{};
};

Missed missed_by(const SliderCrankStatics& statics, OutputLoads& loads, const SimulatedMotion& simulated) {
  Missed missed;
  for (std::size_t i = 0; i < simulated.machine.size(); ++i) {
    const CrankMotion& m = simulated.along.motion[i];
    const double phi = simulated.along.where[i].place();
    const SliderCrankForces f = statics.solve({phi, m.omega, m.alpha, loads.force(phi, m)});
    const MachineForces& own = simulated.machine[i];
    missed.torque = std::max(missed.torque, std::abs(own.torque - f.torque));
    missed.greatest_torque = std::max(missed.greatest_torque, std::abs(own.torque));
    if (!simulated.deforms) continue;
    const std::array<double, joint_count> ideal = {f.main_bearing.magnitude(), f.crank_pin.magnitude(),
                                                   f.slider_pin.magnitude(), std::abs(f.guide)};
    for (std::size_t k = 0; k < joint_count; ++k) {
      missed.reaction[k] = std::max(missed.reaction[k], std::abs(own.reaction[k] - ideal[k]));
      missed.greatest[k] = std::max(missed.greatest[k], own.reaction[k]);
    }
  }
  return missed;
}

void add_missed(const Missed& missed, const SliderCrankData& d, ForceCycle& cycle) {
  const double force = missed.reaction[0] + missed.reaction[3];  // what the frame feels
  const double moment = missed.torque + missed.reaction[3] * (d.radius + d.rod_length);
  for (std::size_t k = 0; k < joint_count; ++k) cycle.reaction[k].widen(missed.reaction[k]);
  cycle.torque.widen(missed.torque);
  cycle.shaking_force.widen(force);
  cycle.shaking_moment.widen(moment);
  for (const auto& [orders, by] :
       {std::pair{&ForceCycle::shaking_x, force}, std::pair{&ForceCycle::shaking_y, force},
        std::pair{&ForceCycle::shaking_couple, moment}, std::pair{&ForceCycle::torque_orders, missed.torque}})
    for (ForceHarmonic& h : cycle.*orders) h.amplitude.widen(2 * by);  // 2/N Σ, each at most this
  cycle.torque_mean.widen(missed.torque);
  for (CycleWork& w : cycle.work)
    if (w.turnover > 0) w.work.widen(missed.torque * cycle.cycle);
  judge_works(cycle);
}

std::string words_of(const Missed& missed, const ForceCycle& cycle) {
  std::string text = fmt::format(
      "the mechanism counts as rigid links in ideal joints; in the same motion the machine's own equations have a "
      "crank torque of up to {} for {}",
      with_unit(missed.greatest_torque, "N*m", 5), with_unit(std::abs(cycle.torque.value), "N*m", 5));
  for (std::size_t k = 0; k < joint_count && missed.greatest[0] > 0; ++k)
    text += fmt::format(", at the {} {} for {}", name_of(static_cast<Joint>(k)), with_unit(missed.greatest[k], "N", 5),
                        with_unit(std::abs(cycle.reaction[k].value), "N", 5));
  return text + "; the greatest difference at an angle is counted as an error of every figure";
}

SliderCrankJoints without_friction(SliderCrankJoints joints) {
  for (RevoluteJoint* j : {&joints.main_bearing, &joints.crank_pin, &joints.slider_pin}) j->friction = {};
  joints.guide.friction = {};
  joints.guide.rolling_arm = 0;
  return joints;
}

// Where friction turns round in a turn: at the ends of the slider's travel, and where the rod turns back.
std::vector<double> turnings_of(const SliderCrankData& data) {
  const auto rod = [&](double phi) {
    return static_cast<double>(linkage_of(data, phi).bodies[1].direction.rate().value());
  };
  std::vector<double> angles;
  for (const auto& slope :
       {std::function<double(double)>([&](double phi) { return static_cast<double>(linkage_of(data, phi).output[1]); }),
        std::function<double(double)>(rod)}) {
    constexpr int cells = 24;
    const double step = 2 * std::numbers::pi / cells, begin = 0.3 * step;  // off the angles where they like to lie
    for (int i = 0; i < cells; ++i) {
      const double a = begin + step * i, b = a + step, at_a = slope(a), at_b = slope(b);
      if (at_a * at_b < 0) angles.push_back(find_root(slope, a, at_a, b, at_b));
    }
  }
  return angles;
}

// Of the machine, and with them of the joints: motion and forces follow the same laws.
Effects effects_of(const Scene& scene, const ForcesOptions& options, const SliderCrankJoints& joints) {
  if (options.effects) return *options.effects;
  Effects effects = scene.effects;
  // Joints with clearance, or at a rod that bends, know no friction by the reactions of ideal ones.
  if (!effects.joint_clearance && !effects.flexible_rod)
    effects.joint_friction = effects.joint_friction || !joints.frictionless();
  return effects;
}

class Study {
 public:
  Study(const AskedMechanism& asked, const ForcesOptions& options) : asked_(asked), options_(options) {
    const Scene& scene = asked.scene;
    describe(asked, out_);
    out_.data = *asked.mechanism().data.as<SliderCrankData>();
    out_.joints = *asked.network.data.find<SliderCrankJoints>(asked.name);
    const Effects effects = effects_of(scene, options, out_.joints);
    if (!effects.gravity) out_.data.gravity = 0;
    machine_.emplace(asked, effects, options);
    effects_ = effects;
    loads_.emplace(asked, effects);
    if (effects.joint_friction && !out_.joints.frictionless()) loads_->add_edges(turnings_of(out_.data));
    const SliderCrankJoints given = out_.joints;
    if (!effects.joint_friction) out_.joints = without_friction(given);
    statics_.emplace(out_.data, out_.joints);
    const double share = out_.data.rod_com / out_.data.rod_length;
    out_.rotating_moment =
        out_.data.crank_mass * out_.data.crank_com + out_.data.rod_mass * (1 - share) * out_.data.radius;
    out_.reciprocating_mass = out_.data.slider_mass + out_.data.rod_mass * share;
    solve_first();
    if (!effects.joint_friction && !given.frictionless()) tell_friction_left_out(given);
  }

  Forces result() {
    std::optional<SimulatedMotion> simulated;
    if (options_.simulate) {
      options_.watch.say("second problem: the motion that the machine keeps");
      simulated = machine_->solve(*loads_, {out_.notes, out_.complete, out_.diagnosis});
    }
    if (simulated) solve_second(*simulated), solve_rigid();
    LinkageCycle links = linkage_cycle(out_.data, *loads_, simulated ? simulated->along : prescribed_);
    if (simulated)
      for (const SimulatedMotion::Other& other : simulated->others)
        links.widen_to(linkage_cycle(out_.data, *loads_, other.motion), other.times);
    mark_unbounded(out_.unbounded, links);
    tell_outside_data(out_, loads_->outside_data(prescribed_.motion.front().omega), *out_.prescribed, false);
    if (simulated) {
      tell_outside_data(out_, simulated->outside_data, *out_.simulated, true);
      tell_outside_data(out_, simulated->outside_data, links, true);
    }
    if (!out_.prescribed->torque.error)
      for (Counterweight& c : out_.counterweights) c.peak_bearing.error.reset();
    out_.links = std::make_shared<const LinkageCycle>(std::move(links));
    for (std::optional<ForceCycle>* cycle : {&out_.prescribed, &out_.simulated})
      for (std::size_t k = 0; *cycle && k < out_.unbounded.of_joint.size(); ++k)
        (*cycle)->reaction[k].unbounded = out_.unbounded.of_joint[k];
    return std::move(out_);
  }

 private:
  void solve_first() {
    const CrankSpeed speed = prescribed_speed(*machine_, options_);
    options_.watch.say(
        fmt::format("first problem: {} at {} ({})", out_.mechanism, out_.speed_unit.text(speed.value), speed.source));
    prescribed_ = steady_motion(*loads_, speed.value, options_.positions);
    out_.prescribed = cycle_along(*statics_, *loads_, prescribed_, &out_.counterweights);
    out_.unbounded = unbounded_reactions(out_.data, *loads_, speed.value);
    describe_first(speed, *loads_, *machine_, out_, *out_.prescribed);
    if (options_.also) look_further(speed.value);
  }

  void look_further(double speed) {
    ForceCycle none;
    const CycleBuilder builder(*statics_, *loads_, none);
    for (const double phi : options_.also(prescribed_cycle(*loads_, speed)))
      out_.also.push_back(builder.at(phi, {speed, 0, loads_->left()}));
  }

  void tell_friction_left_out(const SliderCrankJoints& given) {
    const SliderCrankStatics rough(out_.data, given);
    const ForceCycle cycle = cycle_along(rough, *loads_, prescribed_);
    out_.notes.push_back(
        fmt::format("friction in the joints is omitted{}: in the first problem it would take {} per cycle, and the "
                    "crank's torque would peak at {} instead of {}",
                    machine_->deforms() ? ", for clearance and a rod that bends cannot be had with it" : "",
                    with_unit(cycle.harmful.value, "J", 4), with_unit(std::abs(cycle.torque.value), "N*m", 5),
                    with_unit(std::abs(out_.prescribed->torque.value), "N*m", 5)));
  }

  void solve_second(const SimulatedMotion& simulated) {
    ForceCycle& cycle = out_.simulated.emplace(cycle_along(*statics_, *loads_, simulated.along));
    for (std::size_t i = 0; i < simulated.others.size(); ++i) {
      const SimulatedMotion::Other& other = simulated.others[i];
      cycle.widen_to(cycle_along(*statics_, *loads_, other.motion), other.times);
      if (i == 0) judge_works(cycle);  // of this cycle itself, whether or not it comes again
    }
    cycle.label = "simulated";
    cycle.description = simulated.description;
    const Missed missed = missed_by(*statics_, *loads_, simulated);
    const double scale =
        std::max(missed.greatest_torque, rounding_of_torque * std::abs(cycle.reaction[1].value) * out_.data.radius);
    cycle.machine_residual = scale > 0 ? missed.torque / scale : 0;
    if (machine_->deforms() || *cycle.machine_residual > same_physics + left_by_tables(asked_.scene)) {
      add_missed(missed, out_.data, cycle);
      out_.notes.push_back(words_of(missed, cycle));
    }
  }

  void solve_rigid() {
    out_.elastic = machine_->is_elastic();
    if (!out_.elastic || !options_.rigid_behind) return;
    if (const auto rigid = rigid_motion(asked_, effects_, *loads_, options_))
      out_.rigid = cycle_along(*statics_, *loads_, *rigid);
  }

  static constexpr double same_physics = 1e-7;  // tables of the mechanism, and what the step leaves of friction's laws
  static constexpr double rounding_of_torque =
      1e-3;  // of the crank pin's load at the radius: less is no torque to measure by

  const AskedMechanism& asked_;
  const ForcesOptions& options_;
  Effects effects_;
  Forces out_;
  std::optional<MachineMotion> machine_;
  std::optional<OutputLoads> loads_;
  std::optional<SliderCrankStatics> statics_;
  MotionAlong prescribed_;
};

}  // namespace

std::optional<double> PowerFlow::efficiency() const {
  double in = 0;
  for (const double power : {crank, load, weight, -kinetic_rate}) in += std::max(0.0, power);
  if (!(in > nothing)) return {};
  return std::max(0.0, 1 - friction / in);  // what goes out is no less than nothing
}

// --- what the studies of both kinds of mechanism share ---

std::optional<MotionAlong> rigid_motion(const AskedMechanism& asked, const Effects& effects, OutputLoads& loads,
                                        const ForcesOptions& options) {
  try {
    const MachineMotion machine(asked, without_elasticity(effects), options);
    if (machine.is_elastic()) return {};
    std::vector<std::string> notes;
    bool complete = true;
    std::string diagnosis;
    std::optional<SimulatedMotion> motion = machine.solve(loads, {notes, complete, diagnosis});
    if (!motion || !complete) return {};
    return std::move(motion->along);
  } catch (const SceneError&) {
    return {};
  } catch (const std::runtime_error&) {  // its way does not come again between two tolerances
    return {};
  }
}

namespace {

// Of the crank, where the mean torques of drive and loads of the rigid machine balance, as `size` and `reduce` take it; none:
// no torque depends on the speed, nothing balances, or a sequence sets what drives.
std::optional<double> operating_speed_of(const MachineMotion& machine) try {
  const Model& m = machine.model();
  if (!m.scene.sequence.steps.empty() || machine.start_speed() < 0) return {};
  RigidMachine rigid(compile(m.scene, classical_effects(m.scene)));
  if (!rigid.uses_speed() || !rigid.periodic()) return {};
  return operating_speed(rigid).speed * machine.rated_speed() / m.speed_scale;
} catch (const std::invalid_argument&) {  // nothing balances, or no rigid machine tells torques
  return {};
}

}  // namespace

CrankSpeed prescribed_speed(const MachineMotion& machine, const ForcesOptions& options) {
  if (options.speed) return {*options.speed, "as requested"};
  if (const std::optional<double> operating = operating_speed_of(machine))
    return {*operating, "the operating speed, at which the mean torques of drive and load balance"};
  if (const double start = machine.start_speed(); start != 0) return {start, "the scene's start speed"};
  return {machine.rated_speed(), "rated speed, as the scene starts from rest"};
}

void describe(const AskedMechanism& asked, AboutForces& out) {
  out.title = asked.scene.heading();
  out.speed_unit = asked.scene.speed_unit;
  out.scene_file = asked.scene.file;
  out.scene_text = asked.scene.text;
  out.mechanism = asked.name;
}

void describe_first(const CrankSpeed& speed, const OutputLoads& loads, const MachineMotion& machine, AboutForces& out,
                    CycleOfForces& cycle) {
  cycle.label = "prescribed";
  cycle.description = fmt::format("crank turning at {} throughout, {}", out.speed_unit.text(speed.value), speed.source);
  for (const std::string& words : {out.unbounded.any() ? out.unbounded.words : "", loads.words_of_sequence()})
    if (!words.empty()) out.notes.push_back(words);
  for (const std::string& note : substitutes(machine.model())) out.notes.push_back(note);
}

// --- the study ---

Forces find_forces(const Scene& scene, const ForcesOptions& options) {
  check(options);
  const Deadline deadline(scene.run.budget);
  const AskedMechanism asked(scene, options.mechanism);
  if (asked.kind != "slider-crank")
    throw std::invalid_argument(fmt::format("{}: {} is no slider-crank but a {}", scene.file, asked.name, asked.kind));
  return Study(asked, options).result();
}

}  // namespace kurbel
