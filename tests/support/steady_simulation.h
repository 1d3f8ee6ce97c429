// steady_simulation.h — simulates a scene until its cycles repeat, and measures δ at the crank and at the motor: the
// reference for the studies' steady cycles.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/numerics/roots.h"
#include "studies/forces/machine_motion.h"
#include "studies/run/simulate.h"

namespace kurbel::test {

struct SteadySimulation {
  bool complete = false;
  std::string diagnosis;
  double link_delta = 0, motor_delta = 0;  // of the last cycle; the motor's shaft by its own mid speed
  double link_error = 0, motor_error = 0;  // difference to a run with 100 × looser tolerances
  double mid_speed = 0;                    // of the link [rad/s]
  bool settled = false;                    // speed and δ are within 1e-5 of their limits
  double speed_change = 0;                 // of the link's mid speed from cycle to cycle, over itself
  double speed_to_come = 0;                // its remaining change, relative; ∞: no limit
  int cycles = 0;
  std::vector<double> phi, link, motor;  // last cycle: angle [rad], speeds [rad/s], the motor's reduced to the link
};

namespace settling {

// Speeds of two nodes over each cycle; their extremes are located as roots of the acceleration.
class CycleSpeeds final : public Observer {
 public:
  struct Cycle {
    double most[2] = {-HUGE_VAL, -HUGE_VAL}, least[2] = {HUGE_VAL, HUGE_VAL};
    std::vector<double> phi, speed[2];
    double mid(int which) const { return 0.5 * (most[which] + least[which]); }
    double delta(int which) const { return (most[which] - least[which]) / std::abs(mid(which)); }
  };

  CycleSpeeds(const Model& model, double cycle, int link, int motor)
      : model_(model), cycle_(cycle), node_{link, motor} {}

  void begin(double t, std::span<const double> y, Equations& equations) override {
    see(equations.snapshot(t, y), equations, y);
  }
  void step(StepView& view) override {
    const double a = view.t_previous(), b = view.t(), middle = 0.5 * (a + b);
    const auto rate = [&](int which) {
      return [this, &view, which](double t) { return value(view.snapshot(t).alpha, which); };
    };
    std::vector<double> times = {middle, b};
    for (int which : {0, 1}) {
      const double at_a = rate(which)(a), at_middle = rate(which)(middle), at_b = rate(which)(b);
      if (at_a * at_middle < 0) times.push_back(find_root(rate(which), a, at_a, middle, at_middle));
      if (at_middle * at_b < 0) times.push_back(find_root(rate(which), middle, at_middle, b, at_b));
    }
    std::sort(times.begin(), times.end());
    for (const double t : times) {
      const std::span<const double> now = view.at(t);
      const std::vector<double> y(now.begin(), now.end());
      see(view.equations().snapshot(t, y), view.equations(), y);
    }
  }
  // Number of whole cycles, without the open one.
  std::size_t whole() const { return cycles_.empty() ? 0 : cycles_.size() - 1; }
  const Cycle& cycle(std::size_t i) const { return cycles_[i]; }

 private:
  double value(const double* per_shaft, int which) const {
    const auto n = static_cast<std::size_t>(node_[which]);
    return model_.gain_of_node[n] * per_shaft[model_.shaft_of_node[n]];
  }
  void see(const Snapshot& s, Equations& equations, std::span<const double> y) {
    const double angle = equations.angle_with_turns(static_cast<std::size_t>(model_.reduction_angle), y);
    const auto index = static_cast<std::size_t>(std::max(0.0, std::floor(angle / cycle_)));
    if (index >= cycles_.size()) {
      if (cycles_.size() > 2)  // only the last two are used again
        for (auto* list : {&cycles_[cycles_.size() - 2].phi, &cycles_[cycles_.size() - 2].speed[0],
                           &cycles_[cycles_.size() - 2].speed[1]})
          list->clear();
      cycles_.resize(index + 1);
    }
    Cycle& c = cycles_[index];
    c.phi.push_back(angle - cycle_ * static_cast<double>(index));
    for (int which : {0, 1}) {
      const double v = value(s.now.speed, which);
      c.most[which] = std::max(c.most[which], v);
      c.least[which] = std::min(c.least[which], v);
      c.speed[which].push_back(v);
    }
  }

  const Model& model_;
  double cycle_;
  int node_[2];
  std::vector<Cycle> cycles_;
};

inline constexpr double tolerance = 1e-9, near_enough = 1e-5;
inline constexpr double noise = 100 * tolerance;  // integration error of a speed, relative

// Settled means that no change remains: δ of a runaway machine may be constant long before.
inline void judge(const CycleSpeeds& speeds, SteadySimulation& result) {
  const std::size_t n = speeds.whole();
  std::vector<double> mid, delta[2];
  for (std::size_t i = 0; i < n; ++i) {
    mid.push_back(speeds.cycle(i).mid(0));
    for (const std::size_t which : {0u, 1u}) delta[which].push_back(speeds.cycle(i).delta(static_cast<int>(which)));
  }
  const double speed = std::abs(mid.back());
  result.speed_change = (mid[n - 1] - mid[n - 2]) / speed;
  result.speed_to_come = still_to_come(mid, noise * speed) / speed;
  result.settled = n > 2 && result.speed_to_come <= near_enough;
  for (const std::vector<double>& d : delta)
    result.settled = result.settled && still_to_come(d, noise) <= std::max(noise, near_enough * std::abs(d.back()));
}

}  // namespace settling

// Starts at the cycle's begin with `start_speed` of the reduction link and twists in equilibrium. `cycle` is the
// cycle's angle; the length of runs is doubled until settled, at most `most_cycles`. Throws as compile does.
inline SteadySimulation simulate_steady(Scene scene, const Effects& effects, double start_speed, double cycle,
                                        int motor_node, const SimulateOptions& options, int most_cycles = 320) {
  scene.run.start = {};
  scene.run.start.speed = start_speed;
  scene.run.start.equilibrium = true;
  const auto model = compile(scene, effects);
  const double period = cycle / start_speed;
  SteadySimulation result;
  const auto once = [&](double local_tolerance, int cycles, settling::CycleSpeeds& speeds) {
    Equations equations(model, false);
    RunOptions run{.tolerance = local_tolerance,
                   .method = options.method.value_or("auto"),
                   .until = (cycles + 0.5) * period,
                   .budget = scene.run.budget,
                   .interrupted = options.watch.interrupted,
                   .progress = {}};
    return integrate(equations, run, {&speeds});
  };
  for (int cycles = 10;; cycles *= 2) {
    options.watch.say(fmt::format("sized machine, effects {}: {} cycles", effects.describe(), cycles));
    settling::CycleSpeeds speeds(*model, cycle, model->reduction_node, motor_node);
    const RunOutcome outcome = once(settling::tolerance, cycles, speeds);
    result.complete = outcome.complete;
    result.diagnosis = outcome.diagnosis;
    const std::size_t whole = speeds.whole();
    if (whole < 2) {
      if (result.complete) result.diagnosis = "the machine does not complete two cycles: it slows down and stalls";
      result.complete = false;
      return result;
    }
    const settling::CycleSpeeds::Cycle& last = speeds.cycle(whole - 1);
    settling::judge(speeds, result);
    result.cycles = static_cast<int>(whole);
    result.link_delta = last.delta(0);
    result.motor_delta = last.delta(1);
    result.mid_speed = last.mid(0);
    result.phi = last.phi;
    result.link = last.speed[0];
    result.motor = last.speed[1];
    // The cycle closes: its first point is repeated.
    result.phi.push_back(result.phi.front() + cycle);
    result.link.push_back(result.link.front());
    result.motor.push_back(result.motor.front());
    const double ratio = model->node_ratio[static_cast<std::size_t>(motor_node)];
    for (double& v : result.motor) v /= ratio;
    if (!outcome.complete) return result;
    if (!result.settled && 2 * cycles <= most_cycles) continue;
    settling::CycleSpeeds looser(*model, cycle, model->reduction_node, motor_node);
    if (once(100 * settling::tolerance, cycles, looser).complete && looser.whole() >= whole) {
      result.link_error = std::abs(looser.cycle(whole - 1).delta(0) - result.link_delta);
      result.motor_error = std::abs(looser.cycle(whole - 1).delta(1) - result.motor_delta);
    }
    return result;
  }
}

}  // namespace kurbel::test
