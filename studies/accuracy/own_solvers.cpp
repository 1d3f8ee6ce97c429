// own_solvers.cpp — levels of modelling with solvers of their own: the work diagram, and Simbody's closed loop.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/period.h"
#include "studies/accuracy/accuracy_work.h"

namespace kurbel {
namespace {

// A level with the rigid model's result that yields only the motion of the link.
std::size_t motion_level(AccuracyWork& work, const std::string& name) {
  const LevelAtWork& rigid = work.levels.front();
  ModelLevel reported = rigid.reported;
  reported.name = name, reported.called = name + " model";
  work.study.levels.push_back(reported);
  return work.study.levels.size() - 1;
}

// Motion of the link at the end of the run.
void add_motion(AccuracyWork& work, MeasuredSetting s, double angle, double speed) {
  const LevelAtWork& rigid = work.levels.front();
  const Model& m = *rigid.model;
  const std::string link = link_of(m);
  const double difference =
      std::max(std::abs(angle - rigid.end_angle), std::abs(speed - rigid.end_speed) / m.speed_scale);
  s.trajectory_error = std::max(difference, rigid.reported.agreement);
  measure_figures(s, work, rigid, [&](const std::string& name) {
    return name == "final_angle." + link ? angle : name == "final_speed." + link ? speed : not_known;
  });
  work.study.settings.push_back(std::move(s));
}

double figure_of(const Result& r, const std::string& name) {
  const Figure* f = r.find(name);
  return f ? f->value : not_known;
}

}  // namespace

// Motion from the work diagram: T(φ) = T₀ + A(φ), t = ∫dφ/ω. No tolerance, no steps.
void add_energy_method(AccuracyWork& work) {
  const LevelAtWork& rigid = work.levels.front();
  if (!rigid.tables || rigid.reported.name != "rigid") return;
  if (!rigid.tables->of_angle_alone())
    return work.omit("energy method", "a torque depends on the speed: the work done is not known beforehand");
  Equations equations(rigid.model, false);
  const std::vector<double> y = equations.start(0);
  const double omega = y[equations.speed_index(0)];
  const int direction = omega >= 0 ? 1 : -1;
  const double phi = equations.angle_with_turns(at(rigid.model->reduction_angle), y);
  const WorkOverAngle& diagram = rigid.tables->diagram(direction);
  const double s0 = place_within(direction * phi, diagram.cycle());
  WorkOverAngle::Motion end;
  std::vector<double> seconds;
  constexpr int many = 200;
  for (int i = 0; i < work.options.most_repetitions; ++i) {
    const double before = processor_time();
    for (int k = 0; k < many; ++k) end = diagram.advance(s0, std::abs(omega), work.scene.run.until);
    seconds.push_back((processor_time() - before) / many);
  }
  if (end.stalled) return work.omit("energy method", "the machine comes to rest, and the diagram ends there");
  MeasuredSetting s;
  s.level = motion_level(work, "energy method");
  s.method = "work diagram";
  set_times(s, seconds);
  const double turned = static_cast<double>(end.cycles) * diagram.cycle() + end.s - s0;
  add_motion(work, std::move(s), phi + direction * turned, direction * end.speed);
}

// Simbody's closed loop at every step, by its own integrators.
void add_multibody(AccuracyWork& work) {
  const LevelAtWork& rigid = work.levels.front();
  if (!work.options.multibody || rigid.reported.name != "rigid") return;
  constexpr double seconds_per_turn = 0.004;  // at a loose accuracy, measured
  const double turns = std::abs(rigid.end_angle) / (2 * M_PI);
  const std::string link = link_of(*rigid.model);
  Scene scene = work.scene;
  scene.run.model = "multibody";
  std::shared_ptr<const Model> model;
  std::optional<std::size_t> level;
  for (const char* method : {"RungeKuttaMerson", "RungeKuttaFeldberg", "CPodes"}) {
    double expected = seconds_per_turn * turns, last = 0;
    int beaten = 0;
    for (const double tolerance : work.options.tolerances) {
      if (work.interrupted() || tolerance < 1e-9) break;
      if (expected > work.options.time / 6) {
        work.omit(fmt::format("multibody, {} at {:.0e} and tighter", method, tolerance),
                  fmt::format("would take some {:.2g} s of the study's {:g} s", expected, work.options.time));
        break;
      }
      work.progress(fmt::format("multibody, {} at {:.0e}", method, tolerance), 1);
      Result r;
      try {
        if (!model) model = compile(scene, rigid.model->effects);
        SimulateOptions o = work.simulate_options(method, tolerance);
        o.accuracy = tolerance;
        r = simulate(model, "multibody", o);
      } catch (const SceneError& refusal) {
        return work.omit("multibody", refusal.what());
      }
      if (!r.complete) {
        work.omit(fmt::format("multibody, {} at {:.0e} and tighter", method, tolerance), r.diagnosis);
        break;
      }
      if (!level) level = motion_level(work, "multibody");
      MeasuredSetting s;
      s.level = *level;
      s.method = method;
      s.tolerance = tolerance;
      set_times(s, {r.statistics.cpu_seconds});
      s.steps = r.statistics.stepper.steps;
      s.rejected = r.statistics.stepper.rejected;
      s.flow_calls = r.statistics.stepper.flow_calls;
      s.energy_drift = not_known;
      expected = r.statistics.cpu_seconds * std::max(1.5, last > 0 ? r.statistics.cpu_seconds / last : 2);
      last = r.statistics.cpu_seconds;
      add_motion(work, std::move(s), figure_of(r, "final_angle." + link), figure_of(r, "final_speed." + link));
      beaten = times_beaten(work.study, work.study.settings.back(), last) > hopeless ? beaten + 1 : 0;
      if (beaten == hopeless_rungs) {
        give_up(work, "multibody", method, tolerance);
        break;
      }
    }
  }
}

}  // namespace kurbel
