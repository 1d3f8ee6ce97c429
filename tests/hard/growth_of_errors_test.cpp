// growth_of_errors_test.cpp — over many turns of a free slider-crank the work equation keeps the energy, and its angle
// goes wrong at most in proportion to the turns (closed form: ½ I ω² = T₀, t = ∫dφ/ω). Over time every Runge–Kutta
// method loses energy in proportion and phase as the square: kurbel_bench hard measures their laws.
#include <gtest/gtest.h>

#include "tests/hard/families.h"

namespace kurbel::hard::growth_of_errors_test {
namespace {

double angle_error(const HardCase& machine, const Result& result) {
  double worst = 0;
  for (const Truth& truth : machine.truths) worst = std::max(worst, truth.judge(result).error);
  return worst;
}

TEST(GrowthOfErrors, OfTheWorkEquationIsAtMostLinearInTheTurns) {
  constexpr double per_turn = 5e-9;  // [rad] at local tolerances of 1e-8; a square law from 1000 turns on gives 2e-8
  for (const double turns : {10.0, 100.0, 1e3, 1e4}) {
    HardCase machine = free_crank_over(turns);
    machine.budget = 60;
    const Result r = single_run(machine, "work", 1e-7);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LE(angle_error(machine, r), per_turn * turns) << turns;
    EXPECT_LE(r.energy.relative, 1e-13) << turns;
  }
}

// The square law of the others is no accident of ours: energy lost in proportion makes it.
TEST(GrowthOfErrors, OverTimeEnergyDriftsInProportionAndPhaseAsTheSquare) {
  const HardCase few = free_crank_over(100), many = free_crank_over(1000);
  const Result a = single_run(few, "dopri5", 1e-7), b = single_run(many, "dopri5", 1e-7);
  EXPECT_NEAR(std::log10(b.energy.relative / a.energy.relative), 1, 0.15);
  EXPECT_NEAR(std::log10(angle_error(many, b) / angle_error(few, a)), 2, 0.15);
}

}  // namespace
}  // namespace kurbel::hard::growth_of_errors_test
