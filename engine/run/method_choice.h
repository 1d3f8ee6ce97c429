// method_choice.h — which method a run takes: the one that is asked for where it applies, else ("auto") the work
// equation where it pays, explicit steps while accuracy holds them, implicit ones where stability does.
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

  // To begin with. Throws std::invalid_argument, or SceneError where the scene asked, for one that does not apply.
  Method first();
  const std::string& reason() const { return reason_; }  // of the last choice, in words
  // In words: what ran at first, what runs, and how often that changed.
  std::string describe() const;

  // That "auto" goes on with after a checkpoint.
  Method resumed(Method first) const { return automatic() && memory_.implicit ? implicit_ : first; }
  bool is_implicit(Method method) const { return automatic() && method == implicit_; }

  // After a step: another method, where it pays to go on with it.
  std::optional<Method> after(const Stepper& stepper, Method now);
  // After implicit steps that failed: explicit ones, for good; none where implicit ones were asked for.
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
  Method explicit_ = Method::dormand_prince_853, implicit_ = Method::esdirk_43;  // that "auto" takes
  Method first_ = Method::dormand_prince_853, now_ = Method::dormand_prince_853;
  std::string reason_;
  int changes_ = 0;
  int held_ = 0, implicit_steps_ = 0;
  double explicit_step_ = 0, trial_begin_ = 0;
};

// Methods of SUNDIALS.
bool is_of_library(Method method);

}  // namespace kurbel
