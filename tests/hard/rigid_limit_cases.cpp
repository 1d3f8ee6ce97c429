// rigid_limit_cases.cpp — stiffness to infinity at constant damping ratio: cost bounded, smooth torques lead to the
// rigid machine, steps of torque to its motion but to twice its torque (theory 5.15).
#include <map>
#include <mutex>

#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"
#include "tests/hard/families.h"
#include "tests/hard/linear_chain.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "RigidLimit";
constexpr double first = 1, second = 2, reduced = first * second / (first + second);

// Steps that the program takes of its own choice at the same accuracy for 1e9 N·m/rad.
class SoftSteps {
 public:
  explicit SoftSteps(std::string scene) : scene_(std::move(scene)) {}
  double at(double accuracy) {
    const std::lock_guard lock(mutex_);
    const auto known = steps_.find(accuracy);
    if (known != steps_.end()) return known->second;
    const Scene scene = parse_scene(scene_, "soft.toml", all_kinds());
    SimulateOptions options;
    options.accuracy = accuracy;
    const Result r = simulate(scene, scene.effects, "soft", options);
    return steps_[accuracy] = static_cast<double>(r.statistics.stepper.steps);
  }

 private:
  std::string scene_;
  std::mutex mutex_;
  std::map<double, double> steps_;
};

LinearChain smooth_chain(int decades) {
  const double k = std::pow(10.0, decades);
  return {.inertia = {first, second},
          .stiffness = {k},
          .damping = {2 * 0.05 * std::sqrt(k * reduced)},
          .torque = 0,
          .amplitude = 20,
          .frequency = 2 * pi};
}

// The twist is 20 N·m/k: below this accuracy its tolerance is less than what the last digit of the speeds makes of a
// long step, and implicit steps stay as short as explicit ones.
double above_rounding(int decades) { return decades < 7 ? 0 : decades < 9 ? 1e-9 : decades < 11 ? 1e-8 : 1e-7; }

// M sin Ωt: no jump, so the stiff spring is not rung.
HardCase smooth(int decades, const std::shared_ptr<SoftSteps>& soft) {
  const double until = 0.13, from = 0.99 * above_rounding(decades);
  const LinearChain chain = smooth_chain(decades);
  const LinearChain::Motion end = chain.at(until);
  constexpr double most_times = 3;
  HardCase c{.family = family,
             .name = fmt::format("UnderSmoothTorqueStiffness1e{:02d}CostsNoMore", decades),
             .parameter = fmt::format("k = 1e{} N·m/rad", decades),
             .scene = chain.scene(until),
             .truths = {closed_form("exp(A t) in long double", {{"final_speed.j0", end.speed[0]},
                                                                {"final_speed.j1", end.speed[1]},
                                                                {"final_angle.j1", end.angle[1]}}),
                        residual(fmt::format("auto, accuracies from {:.0e}: at most 3 × the steps for 1e9 N·m/rad",
                                             above_rounding(decades)),
                                 [soft, from](const Result& r) {
                                   const bool own_choice = r.statistics.reason != "requested" && r.accuracy > from;
                                   const double steps = static_cast<double>(r.statistics.stepper.steps);
                                   return own_choice && steps > most_times * soft->at(r.accuracy) ? HUGE_VAL : 0.0;
                                 })}};
  if (decades < 7) return c;
  for (const char* method : {"esdirk3", "esdirk", "esdirk5", "bdf"})
    c.finest[method] = {above_rounding(decades),
                        "the last digit of the speeds is more than the twist's tolerance over a long step: implicit "
                        "steps stay as short as explicit ones"};
  return c;
}

// A step of torque on an undamped shaft: peak 2 M′, M′ = M J₂/(J₁ + J₂); twenty cycles of it.
HardCase step(int decades) {
  const double k = std::pow(10.0, decades), omega = std::sqrt(k / reduced), until = 20.3 * 2 * pi / omega, torque = 20;
  const LinearChain chain{.inertia = {first, second}, .stiffness = {k}, .damping = {0}, .torque = torque};
  const double rigid = torque * until / (first + second);
  const double swing = torque * reduced / (first * second) / omega * std::sin(omega * until);
  return {.family = family,
          .name = fmt::format("AStepOfTorqueDoublesThePeakAtStiffness1e{:02d}", decades),
          .parameter = fmt::format("k = 1e{} N·m/rad", decades),
          .scene = chain.scene(until),
          .truths = {closed_form("peak 2 M J₂/(J₁ + J₂); ω_a = M t/ΣJ + M J_red/(J_a J_b) sin(ω t)/ω · J_b/J_a",
                                 {{"peak_spring_torque.k0", 2 * torque * second / (first + second)},
                                  {"final_speed.j0", rigid + swing * second},
                                  {"final_speed.j1", rigid - swing * first}})}};
}

}  // namespace

std::vector<HardCase> rigid_limit_cases() {
  const auto soft = std::make_shared<SoftSteps>(smooth_chain(9).scene(0.13));
  std::vector<HardCase> cases;
  for (const int decades : {3, 5, 7, 9, 11}) cases.push_back(smooth(decades, soft));
  for (const int decades : {3, 6, 9, 12}) cases.push_back(step(decades));
  return cases;
}

}  // namespace kurbel::hard
