// targets.h — possible targets of a reduction: shafts, and the sliders and rockers of mechanisms.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/events/equations.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

// Speed of the target over the link's, and its derivative by the link's angle.
struct RatioAt {
  double first = 0, second = 0;
};

// x′ and x″ of a slider, or of a rocker's angle, by the link's angle, from the model's own channels at ω = 1.
class SliderRatio {
 public:
  SliderRatio(std::shared_ptr<const Model> model, const std::string& mechanism);
  bool found() const { return velocity_ && acceleration_; }
  bool rocks() const { return rocks_; }
  // x′ [m/rad], x″ [m/rad²]: v = x′ ω,  a = x″ ω² + x′ ε
  RatioAt operator()(double phi);

 private:
  std::shared_ptr<const Model> model_;
  Equations equations_;
  std::function<double(const Snapshot&)> velocity_, acceleration_;
  bool rocks_ = false;
};

// Throws std::invalid_argument with the allowed names.
[[noreturn]] void refuse_target(const Model& model, const std::string& to);

// For a reduction whose torques depend on speed: the given speed, the operating speed, or the rated speed.
// Returns dM_d/dω of the operating speed [N·m·s/rad], by which its rounding changes the mean driving torque; else 0.
double choose_speed(RigidMachine& machine, const ReduceOptions& options, MachineReduction& r);

}  // namespace kurbel
