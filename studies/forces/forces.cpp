// forces.cpp — the two problems over a cycle: motion given or simulated, then d'Alembert position by position.
#include "studies/forces/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/rigid/rigid_machine.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/cycle/classical.h"
#include "studies/cycle/machine_cycle.h"
#include "studies/forces/linkage_cycle.h"
#include "studies/forces/machine_motion.h"
#include "studies/forces/oil_film.h"
#include "studies/margins/margins.h"
#include "studies/reduce/mechanism_words.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

// Largest difference at any position between the machine's own equations and rigid links with ideal joints: an error
// of every figure concerned.
struct Missed {
  double torque = 0, greatest_torque = 0;
  double scale = 0;                        // of torques, by what the joints' forces make at their places
  std::vector<double> reaction, greatest;  // of each joint, of a mechanism that deforms [N]
};

Missed missed_by(const MechanismStatics& statics, OutputLoads& loads, const SimulatedMotion& simulated) {
  constexpr double least = 1e-3;  // of what the joints' forces make at their places: less is no torque to measure by
  Missed missed;
  for (std::size_t i = 0; i < simulated.machine.size(); ++i) {
    const double there = simulated.along.where[i].place();
    double phi = there;
    const PlanarLinkage linkage = statics.linkage(phi);
    if (phi != there) continue;  // what the links need there is that of a place beside it
    const CrankMotion& m = simulated.along.motion[i];
    const LinkageForces f = statics.solve(linkage, loads.state(phi, m, linkage));
    const MachineForces& own = simulated.machine[i];
    missed.torque = std::max(missed.torque, std::abs(own.torque - f.torque));
    missed.greatest_torque = std::max(missed.greatest_torque, std::abs(own.torque));
    for (const JointForces& j : f.joints)
      missed.scale = std::max(missed.scale, least * j.force.magnitude() * j.at.magnitude());
    missed.reaction.resize(own.reaction.size()), missed.greatest.resize(own.reaction.size());
    for (std::size_t k = 0; k < own.reaction.size(); ++k) {
      const double ideal = f.joints[k].force.magnitude();
      missed.reaction[k] = std::max(missed.reaction[k], std::abs(own.reaction[k] - ideal));
      missed.greatest[k] = std::max(missed.greatest[k], own.reaction[k]);
    }
  }
  missed.scale = std::max(missed.scale, missed.greatest_torque);
  return missed;
}

void add_missed(const Missed& missed, ForceCycle& cycle) {
  double force = 0, moment = missed.torque;  // what the frame feels
  const std::vector<JointForces>& joints = cycle.positions.front().forces.joints;
  for (std::size_t k = 0; k < missed.reaction.size(); ++k) {
    cycle.reaction(k).widen(missed.reaction[k]);
    if (joints[k].from != std::string_view("frame")) continue;
    double arm = 0;
    for (const PositionForces& p : cycle.positions) arm = std::max(arm, p.forces.joints[k].at.magnitude());
    force += missed.reaction[k], moment += missed.reaction[k] * arm;
  }
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
  for (std::size_t k = 0; k < missed.greatest.size(); ++k)
    text += fmt::format(", at the {} {} for {}", cycle.positions.front().forces.joints[k].name,
                        with_unit(missed.greatest[k], "N", 5), with_unit(std::abs(cycle.reaction(k).value), "N", 5));
  return text + "; the greatest difference at an angle is counted as an error of every figure";
}

// Effects of the machine, also used for the joints, so that motion and forces follow the same laws.
Effects effects_of(const AskedMechanism& asked, const ForcesOptions& options) {
  if (options.effects) return *options.effects;
  Effects effects = asked.scene.effects;
  // Joints with clearance, or at a bending rod, have no friction law by ideal reactions.
  if (!effects.joint_clearance && !effects.flexible_rod)
    effects.joint_friction = effects.joint_friction || asked.mechanism().joints != nullptr;
  return effects;
}

// Adds the extrapolation of a problem's load tables. A table also left in another problem is mentioned once only.
void report_outside_data(Forces& out, const std::vector<std::string>& sentences, ForceCycle& cycle, bool simulated) {
  if (sentences.empty()) return;
  const auto table = [](const std::string& reported) {
    return reported.substr(0, reported.find(", and the motion goes to"));
  };
  for (const std::string& sentence : sentences)
    if (std::none_of(out.outside_data.begin(), out.outside_data.end(),
                     [&](const std::string& reported) { return table(reported) == table(sentence); }))
      out.outside_data.push_back(sentence);
  cycle.drop_errors(simulated);
}

class Study {
 public:
  Study(const AskedMechanism& asked, const ForcesOptions& options)
      : asked_(asked),
        options_(options),
        data_(asked.mechanism().data),
        effects_(effects_of(asked, options)),
        machine_(asked, effects_, options),
        loads_(asked, effects_, options.range) {
    describe(asked, out_);
    out_.over_a_range = !loads_.repeats();
    out_.rocks = data_.rocks();
    out_.joints = *asked.network.data.find<MechanismJoints>(asked.name);
    out_.friction = effects_.joint_friction && asked.mechanism().joints;
    if (const std::string why = data_.undetermined(); !why.empty())
      out_.notes.push_back(fmt::format("{}: {}; the balancing torque is that of the powers", asked.name, why));
    for (const std::string& line : mechanism_words(asked.mechanism())) out_.about.push_back(asked.name + ": " + line);
    statics_.emplace(data_, out_.joints, out_.friction, !effects_.gravity);
    loads_.add_edges(statics_->turnings());
    solve_first();
    if (!out_.friction && asked.mechanism().joints) report_omitted_friction();
  }

  Forces result() {
    std::optional<SimulatedMotion> simulated;
    if (options_.simulate && out_.over_a_range) {
      out_.notes.push_back(
          fmt::format("second problem omitted: the crank of \"{}\" rocks; forces along its motion over time are not "
                      "assessed",
                      out_.mechanism));
    } else if (options_.simulate) {
      options_.watch.say("second problem: the steady motion");
      simulated = machine_.solve(loads_, {out_.notes, out_.complete, out_.diagnosis});
    }
    if (simulated) solve_second(*simulated), solve_rigid();
    report_outside_data(out_, loads_.outside_data(prescribed_.motion.front().omega), *out_.prescribed, false);
    if (simulated) report_outside_data(out_, simulated->outside_data, *out_.simulated, true);
    if (out_.balancing && !out_.prescribed->torque.error)
      for (Counterweight& c : out_.balancing->counterweights) c.peak_bearing.error.reset();
    out_.films = films_of(out_.joints, out_.front());
    for (std::optional<ForceCycle>* cycle : {&out_.prescribed, &out_.simulated})
      if (*cycle) mark_unbounded(out_.unbounded, **cycle);
    return std::move(out_);
  }

 private:
  ForceCycle cycle_along(const MotionAlong& along) { return linkage_cycle(*statics_, loads_, along); }

  void solve_first() {
    const CrankSpeed speed = prescribed_speed(machine_, options_);
    options_.watch.say(
        fmt::format("first problem: {} at {} ({})", out_.mechanism, out_.speed_unit.text(speed.value), speed.source));
    prescribed_ = steady_motion(loads_, speed.value, options_.positions);
    std::vector<PositionForces> samples;
    out_.prescribed = linkage_cycle(*statics_, loads_, prescribed_, &samples);
    out_.prescribed->assumed_speed = speed.assumed;
    const auto at = [&](double phi) {
      return linkage_position(*statics_, loads_, phi, {speed.value, 0, loads_.left()});
    };
    if (loads_.repeats()) out_.balancing = balancing_of(data_, *out_.prescribed, samples, at);
    out_.unbounded = unbounded_reactions(data_, loads_, speed.value);
    describe_first(speed, loads_, machine_, out_, *out_.prescribed);
    if (!options_.also) return;
    for (const double phi : options_.also(prescribed_cycle(loads_, speed.value))) out_.also.push_back(at(phi));
  }

  void report_omitted_friction() {
    const MechanismStatics rough(data_, out_.joints, true, !effects_.gravity);
    const ForceCycle cycle = linkage_cycle(rough, loads_, prescribed_);
    out_.notes.push_back(
        fmt::format("friction in the joints is omitted{}: in the first problem it would take {} per cycle, and the "
                    "crank's torque would peak at {} instead of {}",
                    machine_.deforms() ? ", for clearance and a rod that bends cannot be had with it" : "",
                    with_unit(cycle.harmful.value, "J", 4), with_unit(std::abs(cycle.torque.value), "N*m", 5),
                    with_unit(std::abs(out_.prescribed->torque.value), "N*m", 5)));
  }

  void solve_second(const SimulatedMotion& simulated) {
    ForceCycle& cycle = out_.simulated.emplace(cycle_along(simulated.along));
    for (std::size_t i = 0; i < simulated.others.size(); ++i) {
      const SimulatedMotion::Other& other = simulated.others[i];
      cycle.widen_to(cycle_along(other.motion), other.times);
      if (i == 0) judge_works(cycle);  // of this cycle itself, whether or not it repeats
    }
    cycle.label = "simulated";
    cycle.description = simulated.description;
    const Missed missed = missed_by(*statics_, loads_, simulated);
    cycle.machine_residual = missed.scale > 0 ? missed.torque / missed.scale : 0;
    if (!machine_.deforms() && *cycle.machine_residual <= same_physics + left_by_tables(asked_.scene)) return;
    add_missed(missed, cycle);
    out_.notes.push_back(words_of(missed, cycle));
  }

  void solve_rigid() {
    out_.elastic = machine_.is_elastic();
    if (!out_.elastic || !options_.rigid_behind) return;
    if (const auto rigid = rigid_motion(asked_, effects_, loads_, options_)) out_.rigid = cycle_along(*rigid);
  }

  static constexpr double same_physics = 1e-7;  // tables of the mechanism, and what the step leaves of friction's laws

  const AskedMechanism& asked_;
  const ForcesOptions& options_;
  const MechanismData& data_;
  Effects effects_;
  Forces out_;
  MachineMotion machine_;
  OutputLoads loads_;
  std::optional<MechanismStatics> statics_;
  MotionAlong prescribed_;
};

}  // namespace

std::vector<const ForceCycle*> Forces::problems() const {
  std::vector<const ForceCycle*> list;
  for (const auto* problem : {&prescribed, &simulated})
    if (*problem) list.push_back(&**problem);
  return list;
}

std::optional<double> PowerFlow::efficiency() const {
  double in = 0;
  for (const double power : {crank, load, weight, -kinetic_rate}) in += std::max(0.0, power);
  if (!(in > nothing)) return {};
  return std::max(0.0, 1 - friction / in);  // what goes out is no less than nothing
}

// --- motions ---

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
  } catch (const std::runtime_error&) {  // at two tolerances its motion does not repeat alike
    return {};
  }
}

namespace {

// Crank speed at which the mean torques of drive and loads of the rigid machine balance, as in `size` and `reduce`;
// empty: no torque depends on the speed, nothing balances, or a sequence controls the drive.
std::optional<double> operating_speed_of(const MachineMotion& machine) try {
  const Model& m = machine.model();
  if (!m.scene.sequence.steps.empty() || machine.start_speed() < 0) return {};
  RigidMachine rigid(compile(m.scene, classical_effects(m.scene)));
  if (!rigid.uses_speed() || !rigid.periodic()) return {};
  return operating_speed(rigid).speed * machine.rated_speed() / m.speed_scale;
} catch (const std::invalid_argument&) {  // nothing balances, or no rigid machine gives torques
  return {};
}

}  // namespace

CrankSpeed prescribed_speed(const MachineMotion& machine, const ForcesOptions& options) {
  if (options.speed) return {*options.speed, "as requested"};
  if (const std::optional<double> operating = operating_speed_of(machine)) {
    const std::vector<std::string> beyond = beyond_the_rigid_machine(machine.model().scene);
    return {*operating, "the operating speed, at which the mean torques of drive and load balance" +
                            (beyond.empty() ? "" : fmt::format(" (not contained: {})", fmt::join(beyond, ", ")))};
  }
  if (const double start = machine.start_speed(); start != 0) return {start, "the scene's start speed"};
  const OperatingSpeeds run = operating_speeds(machine.model(), {}, {});
  const double to_crank = machine.rated_speed() / machine.model().speed_scale;
  if (run.known())
    return {run.fastest * to_crank,
            (run.said ? "the fastest " + run.words : run.words) + ", as the scene starts from rest"};
  return {machine.rated_speed(),
          "a reference speed, as the scene states none and starts from rest; --speed gives another", true};
}

void describe(const AskedMechanism& asked, Forces& out) {
  out.is_of(asked.scene);
  out.mechanism = asked.name;
  out.kind = asked.kind;
}

void describe_first(const CrankSpeed& speed, const OutputLoads& loads, const MachineMotion& machine, Forces& out,
                    ForceCycle& cycle) {
  cycle.label = "prescribed";
  cycle.description =
      fmt::format("crank turning at {} {}, {}", out.speed_unit.text(speed.value, 4),
                  loads.repeats() ? "throughout"
                                  : fmt::format("between φ = {:.4g}° and {:.4g}°", loads.begin() / degree,
                                                (loads.begin() + loads.cycle()) / degree),
                  speed.source);
  for (const std::string& words : {out.unbounded.any() ? out.unbounded.words : "", loads.words_of_sequence()})
    if (!words.empty()) out.notes.push_back(words);
  for (const std::string& note : substitutes(machine.model())) out.notes.push_back(note);
}

// --- the study ---

Forces find_forces(const Scene& scene, const ForcesOptions& options) {
  check(options);
  const Deadline deadline(scene.run.budget);
  const AskedMechanism asked(scene, options.mechanism);
  return Study(asked, options).result();
}

}  // namespace kurbel
