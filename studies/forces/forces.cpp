// forces.cpp — the two problems over a cycle: motion given or simulated, then d'Alembert position by position.
#include "studies/forces/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/model/model.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"
#include "engine/run/run.h"
#include "engine/scene/units.h"
#include "mechanisms/kinds/joint_keys.h"
#include "studies/forces/force_cycle.h"
#include "studies/steady/steady_simulation.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;
std::size_t index(int i) { return static_cast<std::size_t>(i); }

// --- the mechanism and where it stands in the machine ---

const Section& chosen_slider_crank(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> names;
  for (const Section& s : scene.components) {
    if (s.kind->name != "slider-crank") continue;
    if (wanted.empty() || s.name == wanted) return s;
    names.push_back(s.name);
  }
  if (names.empty())
    throw std::invalid_argument(fmt::format(
        "{}: forces are found for slider-cranks, and there is none on its lines; add one (kurbel keys slider-crank)",
        scene.file));
  throw std::invalid_argument(
      fmt::format("--mechanism {}: no slider-crank of that name; allowed: {}", wanted, listed(names)));
}

// --- first problem ---

void first_problem(const SliderCrankStatics& statics, SliderLoads& loads, int positions, double speed, Forces& out) {
  ForceCycle cycle;
  cycle.label = "prescribed";
  cycle.description = fmt::format("crank turning at {} throughout", out.speed_unit.text(speed));
  cycle.cycle = loads.cycle();
  CycleBuilder builder(statics, loads, cycle);
  for (const Abscissa& a : abscissae(cycle.cycle, loads.edges(speed < 0 ? -1 : 1), positions))
    builder.add(a, {speed, 0});
  builder.finish();
  out.counterweights = propose_counterweights(statics, builder, cycle.positions);
  out.prescribed = std::move(cycle);
}

// --- second problem ---

// Motion of the crank when it comes past given angles.
class PassageRecorder final : public Observer {
 public:
  PassageRecorder(std::size_t tracked, int node, std::vector<double> targets, int direction)
      : tracked_(tracked), node_(node), targets_(std::move(targets)), direction_(direction) {}
  void step(StepView& view) override {
    Equations& equations = view.equations();
    const Model& m = equations.model();
    const int shaft = m.shaft_of_node[index(node_)];
    const double gain = m.gain_of_node[index(node_)];
    const auto beyond = [&](double t) {
      return direction_ * (equations.angle_with_turns(tracked_, view.at(t)) - targets_[passed_.size()]);
    };
    // Each within the whole step, so that no target moves for those asked for beside it.
    const double from = view.t_previous();
    while (passed_.size() < targets_.size()) {
      Deadline::check();
      const double at_end = beyond(view.t());
      if (at_end < 0) return;
      const double at_begin = beyond(from);
      const double time = at_begin < 0 ? find_root(beyond, from, at_begin, view.t(), at_end) : from;
      const Snapshot& s = view.snapshot(time);
      passed_.push_back({gain * s.now.speed[shaft], gain * s.alpha[shaft]});
    }
  }
  const std::vector<CrankMotion>& passed() const { return passed_; }

 private:
  std::size_t tracked_;
  int node_;
  std::vector<double> targets_;
  int direction_;
  std::vector<CrankMotion> passed_;
};

struct Crank {
  int node = 0;
  std::size_t tracked = 0;
  double phase = 0;
};

Crank crank_in(const Model& model, const std::string& component) {
  const Network::ShaftElement& element = slider_crank_element(model.network, component);
  for (std::size_t i = 0; i < model.angles.size(); ++i)
    if (model.angles[i].node == element.node) return {element.node, i, element.phase};
  throw std::logic_error("the crank's angle is not tracked");
}

double crank_speed(const Model& model, Equations& equations, const Crank& crank, std::span<const double> y) {
  const Snapshot& s = equations.snapshot(0, y);
  return model.gain_of_node[index(crank.node)] * s.now.speed[model.shaft_of_node[index(crank.node)]];
}

class SecondProblem {
 public:
  SecondProblem(const Scene& scene, const Effects& effects, const std::string& component, const ForcesOptions& options)
      : options_(options),
        settings_(scene.run),
        model_(compile(scene, effects)),
        crank_(crank_in(*model_, component)) {}

  double start_speed() const {
    Equations equations(model_, false);
    const std::vector<double> y = equations.start(0);
    return crank_speed(*model_, equations, crank_, y);
  }
  double rated_speed() const { return model_->speed_scale * std::abs(model_->node_ratio[index(crank_.node)]); }

  // Empty with a note where the run holds no whole cycle.
  std::optional<ForceCycle> solve(const SliderCrankStatics& statics, SliderLoads& loads, Forces& out) {
    const double tolerance = std::max(settings_.accuracy, 1e-12) / 10;
    const auto [begin_angle, end_angle, outcome] = whole_run(30 * tolerance);
    if (!outcome.complete) {
      out.complete = false;
      out.diagnosis = outcome.diagnosis;
    }
    const double cycle = loads.cycle();
    const int direction = end_angle >= begin_angle ? 1 : -1;
    // The last cycle that begins and ends at a multiple of the cycle, in the crank's own angle.
    const double last = direction > 0 ? std::floor((end_angle - 1e-9) / cycle) : std::ceil((end_angle + 1e-9) / cycle);
    const double first = last - direction;
    if (direction * (first * cycle - begin_angle) < -1e-9) {
      out.notes.push_back(fmt::format(
          "second problem left out: within {} the crank turns by {:.4g}°, less than a whole cycle of {:.0f}° that "
          "begins "
          "at a multiple of it; simulate longer (run.until) or start the machine",
          with_unit(outcome.t, "s", 4), std::abs(end_angle - begin_angle) * 360 / turn, cycle * 360 / turn));
      return {};
    }
    const double origin = (direction > 0 ? first : last) * cycle;
    const bool cycle_before = direction * (first * cycle - direction * cycle - begin_angle) >= -1e-9;
    ForceCycle loose = one_run(statics, loads, origin, direction, 30 * tolerance, cycle_before);
    ForceCycle tight = one_run(statics, loads, origin, direction, tolerance, cycle_before);
    set_errors(loose, tight);
    tight.description = fmt::format("rigid machine as its torques drive it, cycle no. {:.0f} of a run of {}",
                                    std::abs(first) + 1, with_unit(settings_.until, "s", 4));
    note_unsteady(loose, tight, out);
    return tight;
  }

 private:
  struct WholeRun {
    double begin, end;  // crank's own angle [rad]
    RunOutcome outcome;
  };
  RunOptions run_options(double tolerance) const {
    return {.tolerance = tolerance,
            .method = settings_.model == "reduced" ? settings_.method : "auto",
            .until = settings_.until,
            .budget = settings_.budget,
            .interrupted = options_.watch.interrupted,
            .progress = [this](double fraction) { options_.watch.at("simulating", fraction); }};
  }
  WholeRun whole_run(double tolerance) const {
    Equations equations(model_, false);
    const std::vector<double> y = equations.start(0);
    const double begin = equations.angle_with_turns(crank_.tracked, y) + crank_.phase;
    RunOutcome outcome = integrate(equations, run_options(tolerance), {});
    return {begin, equations.angle_with_turns(crank_.tracked, outcome.state) + crank_.phase, std::move(outcome)};
  }

  ForceCycle one_run(const SliderCrankStatics& statics, SliderLoads& loads, double origin, int direction,
                     double tolerance, bool cycle_before) const {
    ForceCycle cycle;
    cycle.label = "simulated";
    cycle.cycle = loads.cycle();
    std::vector<Abscissa> where = abscissae(cycle.cycle, loads.edges(direction), options_.positions);
    if (direction < 0) std::reverse(where.begin(), where.end());
    std::vector<double> targets;
    if (cycle_before) targets.push_back(origin + where.front().phi - direction * cycle.cycle - crank_.phase);
    for (const Abscissa& a : where) targets.push_back(origin + a.phi - crank_.phase);
    PassageRecorder passages(crank_.tracked, crank_.node, std::move(targets), direction);
    Equations equations(model_, false);
    integrate(equations, run_options(tolerance), {&passages});
    const std::size_t before = cycle_before ? 1 : 0;
    if (passages.passed().size() != where.size() + before)
      throw std::runtime_error(
          "the simulated crank does not repeat its way between two tolerances; ask for more accuracy (run.accuracy)");
    CycleBuilder builder(statics, loads, cycle);
    for (std::size_t i = 0; i < where.size(); ++i) builder.add(where[i], passages.passed()[i + before]);
    builder.finish();
    if (cycle_before) cycle.speed_before = passages.passed().front().omega;
    return cycle;
  }

  static void set_errors(const ForceCycle& loose, ForceCycle& tight) {
    const auto set = [](const Peak& a, Peak& b) { b.error = std::abs(a.value - b.value); };
    for (std::size_t k = 0; k < joint_count; ++k) set(loose.reaction[k], tight.reaction[k]);
    set(loose.torque, tight.torque);
    set(loose.shaking_force, tight.shaking_force);
    set(loose.shaking_moment, tight.shaking_moment);
    for (std::size_t k = 0; k < tight.work.size(); ++k)
      tight.work[k].error = std::abs(loose.work[k].work - tight.work[k].work);
    tight.kinetic_error = std::abs(loose.kinetic_change - tight.kinetic_change);
    judge_works(tight);
  }

  // Steady is what has nothing left to change; one cycle alone tells no more than whether its ends agree.
  static void note_unsteady(const ForceCycle& loose, const ForceCycle& tight, Forces& out) {
    constexpr double shown = 1e-3;  // of the mean speed: figures of the cycle are as far from steady ones
    const double mean = std::abs(tight.mean_speed), noise = 1e-9 * mean + std::abs(loose.last_speed - tight.last_speed);
    const double to_come = tight.speed_before
                               ? still_to_come({*tight.speed_before, tight.first_speed, tight.last_speed}, noise) / mean
                               : std::abs(tight.closure);
    if (!(to_come > shown)) return;
    out.notes.push_back(fmt::format(
        "the simulated motion is not steady: over the cycle shown the crank's speed changes by {:.2g} % of its mean{}; "
        "{}",
        100 * tight.closure,
        !tight.speed_before      ? std::string()
        : std::isfinite(to_come) ? fmt::format(", and has {:.2g} % still to change", 100 * to_come)
                                 : std::string(", no less than over the cycle before"),
        std::isfinite(to_come) ? "simulate longer (run.until)" : "nothing says that it ever will be"));
  }

  const ForcesOptions& options_;
  RunSettings settings_;
  std::shared_ptr<const Model> model_;
  Crank crank_;
};

void check(const ForcesOptions& options) {
  if (options.positions < 4 || options.positions > 3600)
    throw std::invalid_argument(fmt::format("--positions {}: must be 4 … 3600 of a turn", options.positions));
  if (options.speed && !(std::isfinite(*options.speed) && *options.speed != 0))
    throw std::invalid_argument(fmt::format("--speed {}: must be a speed ≠ 0, e.g. \"300 rpm\"", *options.speed));
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
  const Section& section = chosen_slider_crank(scene, options.mechanism);
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
  SecondProblem machine(scene, effects, section.name, options);
  if (scene.effects.joint_clearance || scene.effects.flexible_rod)
    out.notes.push_back(fmt::format("joints count as ideal and the rod as rigid: {} left out",
                                    !scene.effects.flexible_rod      ? "joint clearance is"
                                    : !scene.effects.joint_clearance ? "the flexible rod is"
                                                                     : "joint clearance and flexible rod are"));
  const SliderCrankStatics statics(out.data, out.joints);
  SliderLoads loads(scene, section.name);
  const double share = out.data.rod_com / out.data.rod_length;
  out.rotating_moment = out.data.crank_mass * out.data.crank_com + out.data.rod_mass * (1 - share) * out.data.radius;
  out.reciprocating_mass = out.data.slider_mass + out.data.rod_mass * share;

  double speed = options.speed.value_or(machine.start_speed());
  std::string source = options.speed ? "as asked for" : "the scene's start speed";
  if (speed == 0) speed = machine.rated_speed(), source = "rated speed, as the scene starts from rest";
  options.watch.say(fmt::format("first problem: {} at {} ({})", section.name, out.speed_unit.text(speed), source));
  first_problem(statics, loads, options.positions, speed, out);
  out.prescribed->description += ", " + source;
  if (options.simulate) {
    options.watch.say("second problem: running the rigid machine");
    out.simulated = machine.solve(statics, loads, out);
  }
  return out;
}

}  // namespace kurbel
