// method_choice_test.cpp — when "auto" tries implicit steps, and what it remembers of that.
#include "engine/run/method_choice.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace kurbel::method_choice_test {
namespace {

// Equal steps that stability holds.
class HeldSteps final : public Stepper {
 public:
  using Stepper::interpolate;
  void start(double, std::span<const double>) override {}
  void step(double h) override { from_ = to_, to_ += h; }
  void retake(double) override {}
  void interpolate(double, std::span<double>) override {}
  double t() const override { return to_; }
  double t_previous() const override { return from_; }
  std::span<const double> y() const override { return {}; }
  std::span<const double> y_previous() const override { return {}; }
  std::span<const double> ydot() const override { return {}; }
  std::span<const double> ydot_previous() const override { return {}; }
  bool held_by_stability() const override { return true; }

 private:
  double from_ = 0, to_ = 0;
};

struct Machine {
  Scene scene = test::scene_from(
      "line = [\"a\", \"c\", \"b\"]\na = { kind = \"inertia\", inertia = \"1 kg*m2\" }\nb = { kind = \"inertia\", "
      "inertia = \"1 kg*m2\" }\nc = { kind = \"coupling\", stiffness = \"1 kN*m/rad\" }\neffects = { elasticity = true "
      "}\n");
  Equations equations{compile(scene, scene.effects), false};
  RunOptions options;
  Machine() { options.until = 1e6; }
};

// Explicit steps until implicit ones are tried.
int steps_until_implicit(MethodChoice& choice, HeldSteps& stepper) {
  for (int steps = 1; steps < 100'000; ++steps) {
    stepper.step(1e-3);
    if (choice.after(stepper, Method::dormand_prince_853) == Method::esdirk_43) return steps;
  }
  return 0;
}

TEST(MethodChoice, AFailureForbidsImplicitStepsOnlyForAWhile) {
  Machine machine;
  LoopMemory memory;
  HeldSteps stepper;
  MethodChoice choice(machine.equations, machine.options, memory);
  choice.first();
  const int first = steps_until_implicit(choice, stepper);
  ASSERT_GT(first, 0);
  int last = first;
  for (int failures = 1; failures <= 2; ++failures) {
    EXPECT_EQ(choice.after_failure(stepper.t(), Method::esdirk_43, "no step"), Method::dormand_prince_853);
    const int next = steps_until_implicit(choice, stepper);
    EXPECT_GT(next, 4 * last) << failures;
    last = next;
  }
  // Once they pay, the wait is as short as at first.
  for (int i = 0; i < 80; ++i) {
    stepper.step(i < 72 ? 1 : 1e-3);
    choice.after(stepper, Method::esdirk_43);
  }
  EXPECT_EQ(steps_until_implicit(choice, stepper), first);
}

// A run that is cut after any step goes on as if it had not been.
TEST(MethodChoice, CountsGoOnInAContinuedRun) {
  Machine machine;
  LoopMemory memory;
  HeldSteps stepper;
  MethodChoice whole(machine.equations, machine.options, memory);
  whole.first();
  const int steps = steps_until_implicit(whole, stepper);
  LoopMemory passed_on;
  HeldSteps again;
  int cut = 0;
  for (bool implicit = false; !implicit && cut < 2 * steps; ++cut) {
    LoopMemory here = passed_on;
    MethodChoice choice(machine.equations, machine.options, here);
    choice.first();
    again.step(1e-3);
    implicit = choice.after(again, Method::dormand_prince_853).has_value();
    passed_on = here;
  }
  EXPECT_EQ(cut, steps);
}

}  // namespace
}  // namespace kurbel::method_choice_test
