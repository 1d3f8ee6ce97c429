// multibody.cpp — hands a compiled rigid model to the multibody run and gathers its figures.
#include "studies/run/multibody.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "mechanisms/bodies/multibody_run.h"
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

// Torque of everything but the mechanism, computed anew at each call: Simbody's integrators have no events.
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

double load_on(const Mechanism& crank, double phi, double x, double v) {
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

// With the names of the reduced model's traces, so that one report draws both.
std::shared_ptr<const Traces> traces_of(const Model& model, const Mechanism& crank, const MultibodyResult& run) {
  const std::string link = model.network.nodes[at(model.reduction_node)].component;
  const auto traces = std::make_shared<Traces>();
  traces->over_time = {{"angle", "rad", {}, {}},
                       {"speed." + link, "rad/s", {}, {}},
                       {"position." + crank.name, crank.rocks() ? "rad" : "m", {}, {}},
                       {"velocity." + crank.name, crank.rocks() ? "rad/s" : "m/s", {}, {}},
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

// The machine's mechanism, or why a multibody run is not possible.
const Mechanism& crank_of(const Model& model) {
  const MechanismElement* mechanism = only_mechanism(model);
  const auto refuse = [&](const std::string& why) {
    throw SceneError({{model.scene.file, model.scene.run.model_at,
                       fmt::format("model = \"multibody\": {}; use model = \"reduced\"", why)}});
  };
  if (!mechanism) refuse("needs exactly one mechanism");
  if (!mechanism->mechanism().data.joints_are_known())
    refuse("needs a mechanism of which the joints are known, not a kind of its user's own");
  if (!mechanism->mechanism().reduced->cycle().change_points().empty())
    refuse("its links pass change points, where the closed loop leaves open which way they go on");
  if (mechanism->deforms())
    refuse("its joints are ideal and its links rigid, so joint_clearance and flexible_rod must be off");
  if (mechanism->mechanism().friction) refuse("its joints are ideal, so joint_friction must be off");
  if (!model.scene.sequence.steps.empty())
    refuse("its integrators know no events, so that no operating sequence is carried out");
  if (model.shafts.size() != 1 || model.shafts.front().prescribed >= 0)
    refuse("runs rigid scenes with one free shaft (effects: none)");
  return mechanism->mechanism();
}

class MultibodySimulation {
 public:
  MultibodySimulation(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options)
      : model_(std::move(model)), settings_(model_->scene.run), options_(options), crank_(crank_of(*model_)) {
    pose();
    result_.model = model_;
    result_.title = model_->scene.heading();
    result_.label = label;
    result_.scene_file = model_->scene.file;
    result_.effects = model_->effects.describe();
    result_.coordinates = 1;
    result_.states = 2;
    result_.explanation = model_->explain() + "model: multibody, the loop closed by Simbody at every step\n";
    result_.until = problem_.t_end;
    result_.accuracy = options_.accuracy.value_or(settings_.accuracy);
  }

  Result run() {
    const double begin = processor_time();
    try {
      confirm();
      collect();
    } catch (const OutOfTime& over) {
      result_.complete = false;
      result_.diagnosis = over.interrupted() ? over.what()
                                             : fmt::format(
                                                   "the multibody run was stopped: {}. Raise `budget`, loosen "
                                                   "`accuracy`, or shorten `until`",
                                                   over.what());
    } catch (const std::runtime_error& error) {
      result_.complete = false;
      result_.diagnosis = fmt::format("the multibody run failed: {}. Try another method ({}) or a looser accuracy",
                                      error.what(), listed(multibody_integrators()));
    }
    result_.statistics.method = "Simbody " + problem_.integrator;
    result_.statistics.reason = "model = \"multibody\"";
    result_.cpu_total = processor_time() - begin;
    return std::move(result_);
  }

 private:
  // Data for Simbody: bodies, torque and force computed at each call, start, times.
  void pose() {
    const auto torque = std::make_shared<ShaftTorque>(model_);
    Equations equations(model_, false);
    const std::vector<double> start = equations.start(0);
    problem_.mechanism = crank_.data.bodies_of();
    problem_.shaft_inertia = model_->shafts.front().inertia;
    const auto phi_now = std::make_shared<double>(0);
    problem_.shaft_torque = [torque, phi_now, phase = crank_.phase](double t, double phi, double omega) {
      Deadline::check();
      *phi_now = phi;
      return (*torque)(t, phi - phase, omega);
    };
    if (!crank_.loads.empty())
      problem_.load = [this, phi_now](double, double x, double v) { return load_on(crank_, *phi_now, x, v); };
    problem_.phi0 = equations.angle_with_turns(at(model_->reduction_angle), start) + crank_.phase;
    problem_.omega0 = start[equations.speed_index(0)];
    problem_.t_end = options_.until.value_or(settings_.until);
    const std::vector<std::string> integrators = multibody_integrators();
    const std::string method = options_.method.value_or(settings_.method);
    problem_.integrator = std::count(integrators.begin(), integrators.end(), method) ? method : integrators.front();
    // Each report time ends a step of Simbody: only used for a report's plots.
    const int rows = options_.traces ? std::clamp(settings_.samples, 2, 1001) : 2;
    for (int i = 0; i < rows; ++i) problem_.times.push_back(problem_.t_end * i / (rows - 1));
  }

  MultibodyResult run_at(double accuracy) {
    problem_.accuracy = accuracy;
    ++result_.runs;
    const Deadline deadline(std::min(settings_.budget, options_.budget.value_or(settings_.budget)),
                            options_.watch.interrupted);
    return run_multibody(problem_);
  }

  // With decreasing tolerance, until two runs agree.
  void confirm() {
    const auto difference = [&] {
      return std::max(std::abs(coarse_.samples.back().phi - fine_.samples.back().phi),
                      std::abs(coarse_.samples.back().omega - fine_.samples.back().omega) / model_->speed_scale);
    };
    double last_begin = processor_time();
    fine_ = run_at(std::clamp(result_.accuracy, tightest_accuracy, 1e-3));
    while (options_.measure_error && problem_.accuracy / 10 >= tightest_accuracy) {
      coarse_ = std::move(fine_);
      last_begin = processor_time();
      fine_ = run_at(problem_.accuracy / 10);
      if (difference() <= result_.accuracy) break;
    }
    if (coarse_.samples.empty()) coarse_ = fine_;
    result_.statistics.cpu_seconds = processor_time() - last_begin;
  }

  void add(const QuantityKind& what, double value, double other, double scale) {
    Figure figure = Figure::defined(Name::make(what, crank_.name), value, scale);
    figure.at = fine_.samples.back().t;
    if (options_.measure_error) {
      figure.error = std::abs(value - other);
      result_.measured_accuracy = std::max(result_.measured_accuracy, *figure.error / scale);
    }
    result_.figures.push_back(std::move(figure));
  }
  void collect() {
    result_.tolerance = problem_.accuracy;
    result_.statistics.stepper.steps = fine_.steps;
    result_.statistics.stepper.rejected = fine_.rejected;
    result_.statistics.stepper.flow_calls = fine_.evaluations;
    const MultibodySample &a = coarse_.samples.back(), &b = fine_.samples.back();
    add(quantities::final_angle, b.phi - crank_.phase, a.phi - crank_.phase, 1);
    add(quantities::final_speed, b.omega, a.omega, model_->speed_scale);
    result_.errors_measured = result_.confirmation_asked = options_.measure_error;
    result_.accuracy_confirmed = options_.measure_error && result_.measured_accuracy <= result_.accuracy;
    result_.final_state[crank_.name] = {{b.phi - crank_.phase}, {b.omega}};
    result_.energy.kinetic_start = fine_.samples.front().kinetic_energy;
    result_.energy.kinetic_end = b.kinetic_energy;
    if (options_.traces) result_.traces = traces_of(*model_, crank_, fine_);
    result_.notes.push_back(
        "multibody run: load edges are stepped over, not located; reference accuracy is what the errors say");
    if (!model_->scene.figures.empty())
      result_.notes.push_back("multibody run: it gives no [[figure]] of the scene; model = \"reduced\" does");
  }

  std::shared_ptr<const Model> model_;
  const RunSettings& settings_;
  const SimulateOptions& options_;
  const Mechanism& crank_;
  MultibodyProblem problem_;
  MultibodyResult coarse_, fine_;
  Result result_;
};

}  // namespace

Result simulate_multibody(std::shared_ptr<const Model> model, const std::string& label,
                          const SimulateOptions& options) {
  return MultibodySimulation(std::move(model), label, options).run();
}

}  // namespace kurbel
