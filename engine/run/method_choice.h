// method_choice.h — integration method of a run: the requested one if it applies; "auto": the work equation if it is
// faster, explicit steps while accuracy limits them, implicit steps if stability does.
#pragma once

#include <optional>
#include <string>

#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "engine/steppers/stepper.h"

namespace kurbel {

class MethodChoice {
 public:
  MethodChoice(const Equations& equations, const RunOptions& options, LoopMemory& memory);

  // The initial method. Throws std::invalid_argument, or SceneError if the scene requests it, if it does not apply.
  Method first();
  const std::string& reason() const { return reason_; }  // of the last choice
  // Description: the first and the present method, and the number of changes.
  std::string describe() const;

  // Method with which "auto" continues after a checkpoint.
  Method resumed(Method first) const { return automatic() && memory_.implicit ? implicit_ : first; }
  bool is_implicit(Method method) const { return automatic() && method == implicit_; }

  // After a step: another method, if it is faster.
  std::optional<Method> after(const Stepper& stepper, Method now);
  // After a failure of implicit steps: explicit ones, for a while; empty if implicit ones are requested.
  std::optional<Method> after_failure(double t, Method now, const std::string& why);

 private:
  bool automatic() const { return options_.method == "auto"; }
  Method as_asked();
  [[noreturn]] void refuse(const std::string& why) const;
  std::string rates_of_time_alone() const;
  bool work_equation_pays() const;
  Method change(Method to, double t, const std::string& why);

  const Equations& equations_;
  const RunOptions& options_;
  LoopMemory& memory_;
  Method explicit_ = Method::dormand_prince_853, implicit_ = Method::esdirk_43;  // used by "auto"
  Method first_ = Method::dormand_prince_853, now_ = Method::dormand_prince_853;
  std::string reason_;
  int changes_ = 0;
};

// Methods of SUNDIALS.
bool is_of_library(Method method);

}  // namespace kurbel
