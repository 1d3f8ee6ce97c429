// dips_test.cpp — a law that changes for a moment within one long step is not overlooked.
#include <fmt/format.h>

#include "tests/support/scenes.h"

namespace kurbel::dips_test {
namespace {

// Two free masses on a spring that is four times as stiff beyond θ₁, vibrating just over it:
//     ½ J ω₀² = ½ k θ₁² + k θ₁ x + 2 k x²,   peak torque k θ₁ + 4 k x,   four changes of the law in a period
class KneeBarelyPassed : public ::testing::TestWithParam<const char*> {};

TEST_P(KneeBarelyPassed, IsPassedFourTimesAPeriod) {
  const double k = 1000, knee = 0.02, inertia = 0.5;  // of two masses of 1 kg·m²
  for (const double beyond : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double x = beyond * knee, energy = 0.5 * k * knee * knee + k * knee * x + 2 * k * x * x;
    const double speed = std::sqrt(2 * energy / inertia);
    const Result r = test::run(
        fmt::format(
            "line = [\"a\", \"c\", \"b\"]\na = {{ kind = \"inertia\", inertia = \"1 kg*m2\" }}\nb = {{ kind = "
            "\"inertia\", inertia = \"1 kg*m2\" }}\nc = {{ kind = \"progressive coupling\", damping = \"0 "
            "N*m*s/rad\", table = {{ over = \"twist\", unit = [\"rad\", \"N*m\"], points = [[0, 0], [0.02, 20], "
            "[0.04, 100]] }} }}\neffects = {{ elasticity = true }}\nrun = {{ start = {{ a = {{ speed = "
            "\"{:.17g} rad/s\" }}, b = {{ speed = \"{:.17g} rad/s\" }} }}, until = \"1.95 s\", accuracy = 1e-7, "
            "method = \"{}\" }}\n",
            0.5 * speed, -0.5 * speed, GetParam()),
        false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(std::abs(test::figure(r, "peak_spring_torque.c")), k * knee + 4 * k * x, 1e-5 * k * knee) << beyond;
    // 1.95 s are 13.9 periods of √(k/J): 28 peaks to either side
    EXPECT_EQ(r.statistics.knots, 2 * 28) << beyond;
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, KneeBarelyPassed,
                         ::testing::Values("dop853", "dopri5", "verner6", "fehlberg8", "esdirk"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace kurbel::dips_test
