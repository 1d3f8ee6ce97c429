// multibody.cpp — hands a compiled rigid model to the multibody run and gathers its figures.
#include "studies/run/multibody.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "mechanisms/linkages/multibody_run.h"
#include "mechanisms/reduced/deforming_mechanism.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/findings/trace.h"

namespace kurbel {
namespace {

// Simbody's closed loop gains nothing below this.
constexpr double tightest_accuracy = 1e-11;

const MechanismElement* only_mechanism(const Model& model) {
  const MechanismElement* found = nullptr;
  int count = 0;
  for (const Network::ShaftElement& e : model.network.elements)
    if (const MechanismElement* element = mechanism_of(e)) {
      found = element;
      ++count;
    }
  return count == 1 ? found : nullptr;
}

// Torque of everything but the mechanism, from scratch at each call: Simbody's integrators know no events.
class ShaftTorque {
 public:
  explicit ShaftTorque(std::shared_ptr<const Model> model) : model_(std::move(model)), equations_(model_, false) {}
  double operator()(double t, double phi, double omega) {
    const Model& m = *model_;
    std::vector<double> y = equations_.modes_from_scratch(t, phi, omega);
    const Snapshot& s = equations_.snapshot(t, y);
    double sum = 0;
    for (std::size_t e = 0; e < m.network.elements.size(); ++e)
      if (static_cast<int>(e) != m.reduction_element)
        sum += m.gain_of_node[at(m.network.elements[e].node)] * s.sums.element_torque[e];
    return sum;
  }

 private:
  std::shared_ptr<const Model> model_;
  Equations equations_;
};

double slider_force(const Mechanism& crank, double phi, double x, double v) {
  double sum = 0;
  for (const SliderLoad& load : crank.loads) {
    SliderState<double> s{phi, x, v, v > 0 ? 1 : v < 0 ? -1 : 0, 0};
    sum += std::visit(
        [&](const auto& law) {
          if constexpr (requires { law.first_mode(s); }) s.mode = law.first_mode(s);
          return law.value(s);
        },
        load.law);
  }
  return sum;
}

// Under the names of the reduced model's traces, so that one report draws both.
std::shared_ptr<const Traces> traces_of(const Model& model, const Mechanism& crank, const MultibodyResult& run) {
  const std::string link = model.network.nodes[at(model.reduction_node)].component;
  const auto traces = std::make_shared<Traces>();
  traces->over_time = {{"angle", "rad", {}, {}},
                       {"speed." + link, "rad/s", {}, {}},
                       {"position." + crank.name, "m", {}, {}},
                       {"velocity." + crank.name, "m/s", {}, {}},
                       {"kinetic_energy", "J", {}, {}}};
  for (const MultibodySample& s : run.samples) {
    const double values[] = {s.phi - crank.phase, s.omega, s.x, s.v, s.kinetic_energy};
    for (std::size_t i = 0; i < traces->over_time.size(); ++i) {
      traces->over_time[i].x.push_back(s.t);
      traces->over_time[i].y.push_back(values[i]);
    }
  }
  return traces;
}

}  // namespace

Result simulate_multibody(std::shared_ptr<const Model> shared, const std::string& label,
                          const SimulateOptions& options) {
  const Model& model = *shared;
  const RunSettings& settings = model.scene.run;
  const MechanismElement* mechanism = only_mechanism(model);
  const auto refuse = [&](const std::string& why) {
    throw SceneError({{model.scene.file, settings.model_at,
                       fmt::format("model = \"multibody\": {}; use model = \"reduced\"", why)}});
  };
  if (!mechanism || !mechanism->mechanism().data.as<SliderCrankData>())
    refuse("needs exactly one slider-crank, and no other mechanism");
  if (mechanism->dynamics())
    refuse("its joints are ideal and its links rigid, so joint_clearance and flexible_rod must be off");
  if (model.shafts.size() != 1 || model.shafts.front().prescribed >= 0)
    refuse("runs rigid scenes with one free shaft (effects: none)");
  const Mechanism& crank = mechanism->mechanism();
  const auto torque = std::make_shared<ShaftTorque>(shared);
  Equations equations(shared, false);
  const std::vector<double> start = equations.start(0);

  MultibodyProblem problem;
  problem.mechanism = *crank.data.as<SliderCrankData>();
  problem.shaft_inertia = model.shafts.front().inertia;
  const auto phi_now = std::make_shared<double>(0);
  problem.shaft_torque = [torque, phi_now, phase = crank.phase, &options](double t, double phi, double omega) {
    Deadline::check();
    *phi_now = phi;
    return (*torque)(t, phi - phase, omega);
  };
  if (!crank.loads.empty())
    problem.slider_force = [&crank, phi_now](double, double x, double v) {
      return slider_force(crank, *phi_now, x, v);
    };
  problem.phi0 = equations.angle_with_turns(at(model.reduction_angle), start) + crank.phase;
  problem.omega0 = start[equations.speed_index(0)];
  problem.t_end = options.until.value_or(settings.until);
  const std::vector<std::string> integrators = multibody_integrators();
  const std::string method = options.method.value_or(settings.method);
  problem.integrator = std::count(integrators.begin(), integrators.end(), method) ? method : integrators.front();
  // Each report time ends a step of Simbody's: only a report's plots are worth that.
  const int rows = options.traces ? std::clamp(settings.samples, 2, 1001) : 2;
  for (int i = 0; i < rows; ++i) problem.times.push_back(problem.t_end * i / (rows - 1));

  Result result;
  result.model = shared;
  result.title = model.scene.heading();
  result.label = label;
  result.scene_file = model.scene.file;
  result.effects = model.effects.describe();
  result.coordinates = 1;
  result.states = 2;
  result.explanation = model.explain() + "model: multibody, the loop closed by Simbody at every step\n";
  result.until = problem.t_end;
  result.accuracy = options.accuracy.value_or(settings.accuracy);
  const double begin = processor_time();
  const auto run_at = [&](double accuracy) {
    problem.accuracy = accuracy;
    ++result.runs;
    const Deadline deadline(std::min(settings.budget, options.budget.value_or(settings.budget)),
                            options.watch.interrupted);
    return run_multibody(problem);
  };
  try {
    const auto scaled_difference = [&](const MultibodyResult& a, const MultibodyResult& b) {
      return std::max(std::abs(a.samples.back().phi - b.samples.back().phi),
                      std::abs(a.samples.back().omega - b.samples.back().omega) / model.speed_scale);
    };
    double last_begin = processor_time();
    MultibodyResult coarse, fine = run_at(std::clamp(result.accuracy, tightest_accuracy, 1e-3));
    while (options.measure_error && problem.accuracy / 10 >= tightest_accuracy) {
      coarse = std::move(fine);
      last_begin = processor_time();
      fine = run_at(problem.accuracy / 10);
      if (scaled_difference(coarse, fine) <= result.accuracy) break;
    }
    if (coarse.samples.empty()) coarse = fine;
    result.tolerance = problem.accuracy;
    result.statistics.cpu_seconds = processor_time() - last_begin;
    result.statistics.stepper.steps = fine.steps;
    result.statistics.stepper.rejected = fine.rejected;
    result.statistics.stepper.flow_calls = fine.evaluations;
    const MultibodySample &a = coarse.samples.back(), &b = fine.samples.back();
    const auto add = [&](QuantityKind what, double value, double other, const std::string& unit, double scale) {
      Figure figure = Figure::of_name(Name::make(what, crank.name), value, unit, scale);
      figure.at = b.t;
      if (options.measure_error) {
        figure.error = std::abs(value - other);
        result.measured_accuracy = std::max(result.measured_accuracy, *figure.error / scale);
      }
      result.figures.push_back(figure);
    };
    add(QuantityKind::final_angle, b.phi - crank.phase, a.phi - crank.phase, "rad", 1);
    add(QuantityKind::final_speed, b.omega, a.omega, "rad/s", model.speed_scale);
    result.errors_measured = result.confirmation_asked = options.measure_error;
    result.accuracy_confirmed = options.measure_error && result.measured_accuracy <= result.accuracy;
    result.final_state[crank.name] = {b.phi - crank.phase, b.omega, {}, {}};
    result.energy.kinetic_start = fine.samples.front().kinetic_energy;
    result.energy.kinetic_end = b.kinetic_energy;
    if (options.traces) result.traces = traces_of(model, crank, fine);
    result.notes.push_back(fmt::format(
        "multibody run: load edges are stepped over, not located; reference accuracy is what the errors say"));
  } catch (const OutOfTime& over) {
    result.complete = false;
    result.diagnosis = over.interrupted() ? over.what()
                                          : fmt::format(
                                                "the multibody run was stopped: {}. Raise `budget`, loosen "
                                                "`accuracy`, or shorten `until`",
                                                over.what());
  } catch (const std::runtime_error& error) {
    result.complete = false;
    result.diagnosis = fmt::format("the multibody run failed: {}. Try another method ({}) or a looser accuracy",
                                   error.what(), listed(integrators));
  }
  result.statistics.method = "Simbody " + problem.integrator;
  result.statistics.reason = "model = \"multibody\"";
  result.cpu_total = processor_time() - begin;
  return result;
}

}  // namespace kurbel
