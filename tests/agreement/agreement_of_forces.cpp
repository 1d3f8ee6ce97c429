// agreement_of_forces.cpp — what `forces` reports of the simulated machine, held against couplings and Simbody.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/forces/forces.h"
#include "tests/agreement/agreement.h"
#include "tests/mechanisms/simbody_reactions.h"

namespace kurbel::agreement {
namespace {

constexpr int looks = 3000;                 // a period
constexpr double left_by_runs = 1e-6;       // of the largest: what a run settled to 1e-7 leaves of forces
constexpr double as_good_as_stated = 0.05;  // of a figure: a study that states more as its error leaves something out

// One value along a period.
struct Curve {
  std::vector<double> values;
  void add(double value) { values.push_back(value); }
  double mean() const {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  // By how much an extreme between looks may be beyond the one of the looks: where it is smooth by an eighth of the second
  // difference, at an edge by the slope on the smooth side of it.
  double between(std::size_t k) const {
    const std::size_t n = values.size();
    const auto v = [&](std::size_t i) { return values[i % n]; };
    const double after = std::abs(v(k + 2) - 2 * v(k + 1) + v(k)),
                 before = std::abs(v(k + n - 2) - 2 * v(k + n - 1) + v(k));
    return std::min(std::abs(v(k) - v(k + 1)), std::abs(v(k) - v(k + n - 1))) + 0.25 * std::min(after, before);
  }
  std::size_t greatest() const {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  }
  std::size_t least() const {
    return static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  }
};

// --- what the study reports, under one roof: the only place that knows its names ---

struct ReportedForces {
  double greatest = 0, least = 0, mean = 0;  // torque on the crank
  double torque_error = 0;                   // stated by the study
  double between = 0;                        // what positions leave open
  Peak main_bearing, slider_pin;             // of a slider-crank
};
// Torques stand at positions; between them an extreme may be beyond by as much as they differ on its smooth side.
ReportedForces reported_forces(const ForceCycle& cycle) {
  Curve torque;
  for (const PositionForces& p : cycle.curve) torque.add(p.forces.torque);
  const std::size_t high = torque.greatest(), low = torque.least();
  return {torque.values[high],
          torque.values[low],
          cycle.torque_mean.value,
          cycle.torque.error.value_or(0),
          std::max(torque.between(high), torque.between(low)),
          cycle.reaction(0),
          cycle.reaction(2)};
}

// The mechanism's element, and the coupling whose torque is all that drives it.
struct Driven {
  const Network::ShaftElement* element = nullptr;
  const Mechanism* mechanism = nullptr;
  int joint = -1;    // of the network; −1: none
  double sense = 1;  // of its torque on the crank
};

// Nodes that are one body with this one, without the connections through one joint.
std::vector<int> body_of(const Network& network, int node, int without) {
  std::vector<int> body = {node};
  for (std::size_t i = 0; i < body.size(); ++i)
    for (int j = 0; j < static_cast<int>(network.joints.size()); ++j) {
      const Network::Joint& joint = network.joints[at(j)];
      if (j == without || (joint.a != body[i] && joint.b != body[i])) continue;
      const int other = joint.a == body[i] ? joint.b : joint.a;
      if (std::find(body.begin(), body.end(), other) == body.end()) body.push_back(other);
    }
  return body;
}

// Empty where there is none, or several; without a coupling where others act on its crank.
Driven driven_mechanism(const Model& m) {
  Driven driven;
  for (const Network::ShaftElement& e : m.network.elements)
    if (const MechanismElement* element = mechanism_of(e)) {
      if (driven.element) return {};
      driven.element = &e;
      driven.mechanism = &element->mechanism();
    }
  if (!driven.element) return {};
  for (const TorqueJoint& t : m.torque_joints) {
    const Network::Joint& joint = m.network.joints[at(t.joint)];
    for (const int side : {joint.a, joint.b}) {
      const std::vector<int> body = body_of(m.network, side, t.joint);
      const auto holds = [&](int node) { return std::find(body.begin(), body.end(), node) != body.end(); };
      if (!holds(driven.element->node) || (holds(joint.a) && holds(joint.b))) continue;
      double inertia = 0;
      for (const int n : body) inertia += m.network.nodes[at(n)].inertia;
      const bool alone = inertia == 0 &&
                         std::none_of(m.network.elements.begin(), m.network.elements.end(),
                                      [&](const auto& e) {
                                        const auto* const one = dynamic_cast<const MechanismElement*>(e.element.get());
                                        const bool within = one && one->mechanism().is_force();  // the linkage
                                        return &e != driven.element && !within && holds(e.node);
                                      }) &&
                         std::none_of(m.network.relations.begin(), m.network.relations.end(), [&](const auto& r) {
                           return holds(r.node[0]) || holds(r.node[1]) || (r.node[2] >= 0 && holds(r.node[2]));
                         });
      if (!alone || body.size() > 2) continue;
      driven.joint = t.joint;
      driven.sense = side == joint.b ? joint.ratio : -1;
    }
  }
  return driven;
}

// A period of the settled machine.
class Cycle final : public Observer {
 public:
  Cycle(const Driven& driven, bool with_reactions, double from, double step)
      : driven_(driven), with_reactions_(with_reactions), from_(from), step_(step) {}
  void step(StepView& view) override {
    while (taken_ < looks) {
      const double t = from_ + step_ * taken_;
      if (t > view.t()) break;
      if (driven_.joint >= 0) torque.add(driven_.sense * view.snapshot(t).joint_torque[driven_.joint]);
      if (with_reactions_) take(view.snapshot(t), view.equations().model(), true);
      ++taken_;
    }
    // A corner of a load is where a step ends.
    if (with_reactions_) take(view.snapshot(view.t()), view.equations().model(), false);
  }
  Curve torque, main_bearing, slider_pin;
  double most_main_bearing = 0, most_slider_pin = 0;  // corners included

 private:
  void take(const Snapshot& s, const Model& m, bool is_look) {
    const int node = driven_.element->node;
    const double gain = m.gain_of_node[at(node)];
    const int shaft = m.shaft_of_node[at(node)];
    double force = 0;
    for (const Channel& channel : m.pool_channels)
      if (channel.name.what == quantities::force && channel.name.of == driven_.mechanism->name)
        force += channel.value(s);
    const SimbodyReactions r =
        simbody_reactions(*driven_.mechanism->data.as<SliderCrankData>(),
                          std::remainder(s.node_angle[node] + driven_.element->phase, 2 * std::numbers::pi),
                          gain * s.now.speed[shaft], gain * s.alpha[shaft], force);
    const double main = std::hypot(r.main_bearing[0], r.main_bearing[1]),
                 pin = std::hypot(r.slider_pin[0], r.slider_pin[1]);
    most_main_bearing = std::max(most_main_bearing, main), most_slider_pin = std::max(most_slider_pin, pin);
    if (is_look) main_bearing.add(main), slider_pin.add(pin);
  }

  const Driven& driven_;
  bool with_reactions_;
  double from_, step_;
  int taken_ = 0;
};

class ForcesComparison {
 public:
  ForcesComparison(const Scene& scene, const SettleSettings& settings) : scene_(scene), settings_(settings) {}

  Row run() {
    const double begin = processor_time();
    Effects effects = scene_.effects;  // as `forces` takes the machine
    if (!effects.joint_clearance && !effects.flexible_rod)
      for (const EffectFlag& flag : effect_flags())
        if (flag.flag == &Effects::joint_friction) effects.joint_friction = has_parameters(scene_, flag);
    driven_ = driven_mechanism(*compile(scene_, effects));
    if (driven_.element) {
      run_ = settle(scene_, effects, settings_);
      driven_ = driven_mechanism(*run_.model);
      row_.kind = run_.kind;
      row_.orbit = run_.words;
      if (run_.kind == Motion::repeats) ask(effects);
    } else {
      row_.kind = Motion::repeats;
      row_.orbit = "no mechanism, or several";
    }
    row_.cpu_seconds = processor_time() - begin;
    return std::move(row_);
  }

 private:
  bool reactions_known(const Effects& effects) const {
    return !effects.joint_friction && !effects.joint_clearance && driven_.mechanism->data.as<SliderCrankData>();
  }
  void ask(const Effects& effects) {
    std::vector<Topic> topics;
    if (driven_.joint >= 0) topics.push_back(Topic::crank_torque);
    if (reactions_known(effects)) topics.push_back(Topic::reactions);
    if (topics.empty()) return;
    try {
      const Forces found = find_forces(scene_, {.speed = {}, .mechanism = driven_.mechanism->name, .watch = {}});
      if (!found.simulated) throw std::invalid_argument(found.notes.empty() ? "no cycle" : found.notes.back());
      judge(found.notes, reported_forces(*found.simulated), effects);
    } catch (const std::runtime_error& error) {
      refuse(topics, error.what());
    } catch (const std::invalid_argument& error) {
      refuse(topics, error.what());
    }
  }
  void refuse(const std::vector<Topic>& topics, const std::string& why) {
    row_.figures.clear();
    for (const Topic topic : topics) row_.figures.push_back({topic, "", 0, 0, 0, Verdict::refused, why});
  }
  void judge(const std::vector<std::string>& found, const ReportedForces& reported, const Effects& effects) {
    Cycle cycle(driven_, reactions_known(effects), run_.at.state.t, run_.period / looks);
    Equations equations(run_.model, false);
    RunOptions options{.tolerance = 1e-10,
                       .method = "auto",
                       .until = run_.at.state.t + run_.period,
                       .budget = 20,
                       .interrupted = nullptr,
                       .progress = {}};
    options.to_go_on = true;
    options.checkpoint = &run_.at;
    const RunOutcome outcome = integrate(equations, options, {&cycle});
    if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
    if (driven_.joint >= 0 && !cycle.torque.values.empty()) {
      const Curve& c = cycle.torque;
      const double scale = std::max(std::abs(c.values[c.greatest()]), std::abs(c.values[c.least()]));
      const double allowed = left_by_runs * scale + reported.between;
      compare(Topic::crank_torque, "greatest", {c.values[c.greatest()], allowed + c.between(c.greatest())},
              {reported.greatest, reported.torque_error}, found);
      compare(Topic::crank_torque, "least", {c.values[c.least()], allowed + c.between(c.least())},
              {reported.least, reported.torque_error}, found);
    }
    if (cycle.main_bearing.values.empty()) return;
    compare_peak("main bearing", cycle.main_bearing, cycle.most_main_bearing, reported.main_bearing, found);
    compare_peak("slider pin", cycle.slider_pin, cycle.most_slider_pin, reported.slider_pin, found);
  }
  void compare_peak(const std::string& name, const Curve& curve, double run, const Peak& reported,
                    const std::vector<std::string>& found) {
    compare(Topic::reactions, name, {run, left_by_runs * run + curve.between(curve.greatest())},
            {reported.value, reported.error.value_or(0)}, found);
  }
  struct Uncertain {
    double value, error;
  };
  void compare(Topic topic, const std::string& figure, Uncertain run, Uncertain study,
               const std::vector<std::string>& by) {
    const double apart = std::abs(run.value - study.value), allowed = run.error + study.error;
    const double size = std::max(std::abs(run.value), std::abs(study.value));
    const bool measures = study.error <= as_good_as_stated * size;
    const Verdict verdict = apart <= run.error || (measures && apart <= allowed) ? Verdict::agrees
                            : apart <= allowed || reports_how_much(by)           ? Verdict::reported
                                                                                 : Verdict::silent;
    row_.figures.push_back({topic, figure, run.value, study.value, allowed, verdict, {}});
  }

  const Scene& scene_;
  SettleSettings settings_;
  SettledRun run_;
  Driven driven_;
  Row row_;
};

}  // namespace

Row compare_forces(const Scene& scene, const SettleSettings& settings) {
  return ForcesComparison(scene, settings).run();
}

}  // namespace kurbel::agreement
