// steady_simulation.cpp — runs of growing length, watched cycle by cycle.
#include "studies/steady/steady_simulation.h"
#include "engine/numerics/roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace kurbel {
namespace {

// Speeds of two nodes over each cycle; their extremes are located by roots of the acceleration.
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
  // Whole ones, the open one left out.
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
      if (cycles_.size() > 2)  // only the last two are looked at again
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

constexpr double tolerance = 1e-9, near_enough = 1e-5;
constexpr double noise = 100 * tolerance;  // that integration leaves in a speed, over itself

// Settled is what has nothing left to change: δ of a machine that runs away may stand still long before.
void judge(const CycleSpeeds& speeds, SteadySimulation& result) {
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

}  // namespace

double still_to_come(const std::vector<double>& course, double noise) {
  if (course.size() < 3) return HUGE_VAL;
  const std::size_t last = course.size() - 1, quarter = std::max<std::size_t>(1, last / 4);
  const double now = course[last] - course[last - quarter];
  const double before = course[last - quarter] - course[last - 2 * quarter];
  if (std::abs(now) <= noise) return 0;
  constexpr double no_nearer = 0.999;  // of the quarter before: shrinking so slowly is not told from a straight run
  if (!(std::abs(now) < no_nearer * std::abs(before))) return HUGE_VAL;
  const double ratio = now / before;
  return std::abs(now) * (ratio > 0 ? ratio / (1 - ratio) : 1);
}

SteadySimulation simulate_steady(Scene scene, const Effects& effects, double start_speed, double cycle, int motor_node,
                                 const SimulateOptions& options, int most_cycles) {
  scene.run.start = {};
  scene.run.start.speed = start_speed;
  scene.run.start.equilibrium = true;
  const auto model = compile(scene, effects);
  const double period = cycle / start_speed;
  SteadySimulation result;
  const auto once = [&](double local_tolerance, int cycles, CycleSpeeds& speeds) {
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
    CycleSpeeds speeds(*model, cycle, model->reduction_node, motor_node);
    const RunOutcome outcome = once(tolerance, cycles, speeds);
    result.complete = outcome.complete;
    result.diagnosis = outcome.diagnosis;
    const std::size_t whole = speeds.whole();
    if (whole < 2) {
      if (result.complete) result.diagnosis = "the machine does not complete two cycles: it slows down and stalls";
      result.complete = false;
      return result;
    }
    const CycleSpeeds::Cycle& last = speeds.cycle(whole - 1);
    judge(speeds, result);
    result.cycles = static_cast<int>(whole);
    result.link_delta = last.delta(0);
    result.motor_delta = last.delta(1);
    result.mid_speed = last.mid(0);
    result.phi = last.phi;
    result.link = last.speed[0];
    result.motor = last.speed[1];
    // The cycle closes: its first point comes again.
    result.phi.push_back(result.phi.front() + cycle);
    result.link.push_back(result.link.front());
    result.motor.push_back(result.motor.front());
    const double ratio = model->node_ratio[static_cast<std::size_t>(motor_node)];
    for (double& v : result.motor) v /= ratio;
    if (!outcome.complete) return result;
    if (!result.settled && 2 * cycles <= most_cycles) continue;
    CycleSpeeds looser(*model, cycle, model->reduction_node, motor_node);
    if (once(100 * tolerance, cycles, looser).complete && looser.whole() >= whole) {
      result.link_error = std::abs(looser.cycle(whole - 1).delta(0) - result.link_delta);
      result.motor_error = std::abs(looser.cycle(whole - 1).delta(1) - result.motor_delta);
    }
    return result;
  }
}

}  // namespace kurbel
