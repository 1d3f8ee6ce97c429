// compressor_force_test.cpp — work and volumetric efficiency of a compressor's indicator diagram in closed form.
#include "mechanisms/loads/compressor_force.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/published/published.h"

namespace kurbel::compressor_force_test {
namespace {

using test::figure;
using test::run;

struct Diagram {
  double ratio, clearance, n, m;
  const char* end;
};
void PrintTo(const Diagram& d, std::ostream* out) {
  *out << "p2/p1 = " << d.ratio << ", c = " << d.clearance << ", n = " << d.n << ", m = " << d.m << ", " << d.end;
}
class CompressorDiagram : public ::testing::TestWithParam<Diagram> {
 protected:
  static constexpr double r = 0.05, l = 0.2, speed = 10, bore = 0.1, suction = 1e5;
  const Diagram d = GetParam();
  const double swept = std::numbers::pi / 4 * bore * bore * 2 * r;
  const double efficiency = 1 - d.clearance * (std::pow(d.ratio, 1 / d.m) - 1);

  Result turning(const std::string& more = "") const {
    return run(fmt::format(R"(
line = ["drive", "crank"]
drive = {{ kind = "prescribed speed", speed = "{} rad/s" }}
[crank]
kind = "slider-crank"
radius = "{} m"
rod = "{} m"
slider_mass = "2 kg"
[crank.load]
kind = "compressor"
bore = "{} m"
suction_pressure = "{} Pa"
delivery_pressure = "{} Pa"
clearance = {}
compression_exponent = {}
expansion_exponent = {}
working_end = "{}"
{}
[run]
until = "3 s"
accuracy = 1e-10
)",
                           speed, r, l, bore, suction, d.ratio * suction, d.clearance, d.n, d.m, d.end, more));
  }
  // ∫ p dV along p Vⁿ = const from p₁ V₁ up to the pressure ratio.
  static double work_along(double p1v1, double ratio, double n) {
    return n == 1 ? p1v1 * std::log(ratio) : p1v1 * n / (n - 1) * (std::pow(ratio, (n - 1) / n) - 1);
  }
};

// W = n/(n−1) p₁ V₁ ((p₂/p₁)^((n−1)/n) − 1) − m/(m−1) p₁ V₄ ((p₂/p₁)^((m−1)/m) − 1), V₁ at the far end, V₄ where
// suction begins: what compression and delivery take less what re-expansion gives back.
TEST_P(CompressorDiagram, TakesTheIndicatedWorkOfTheClosedForm) {
  const double v1 = swept * (1 + d.clearance), v4 = swept * d.clearance * std::pow(d.ratio, 1 / d.m);
  const double work = work_along(suction * v1, d.ratio, d.n) - work_along(suction * v4, d.ratio, d.m);
  EXPECT_NEAR(-figure(turning(), "useful_work_per_cycle"), work, 1e-9 * work);
  // What presses on the piston's other face gives back in one stroke what it took in the other.
  EXPECT_NEAR(-figure(turning("outside_pressure = \"3 bar\""), "useful_work_per_cycle"), work, 1e-9 * work);
}

// The suction valve opens at (1 − λ) of the stroke, λ = 1 − c ((p₂/p₁)^(1/m) − 1); the delivery valve where p = p₂.
TEST_P(CompressorDiagram, OpensItsValvesWhereThePressuresMeet) {
  const Result result = turning();
  ASSERT_TRUE(result.complete) << result.diagnosis;
  int suctions = 0, deliveries = 0;
  for (const Event& event : result.events) {
    const double phi = speed * event.t, s = std::sin(phi);
    const double x = r * std::cos(phi) + std::sqrt(l * l - r * r * s * s);
    const double from_end = d.end == std::string("extended") ? r + l - x : x - (l - r);
    if (event.what == "suction valve opens") {
      EXPECT_NEAR(1 - from_end / (2 * r), efficiency, 1e-10);
      ++suctions;
    } else if (event.what == "delivery valve opens") {
      const double volume = d.clearance + from_end / (2 * r);
      EXPECT_NEAR(std::pow((1 + d.clearance) / volume, d.n), d.ratio, 1e-9 * d.ratio);
      ++deliveries;
    }
  }
  EXPECT_GE(suctions, 4);  // 4.77 turns
  EXPECT_GE(deliveries, 4);
}

// Valves held open have no events: those listed lie within the times that the load is on, of every form of the crank.
TEST(Compressor, HasNoEventsOfItsValvesWhileItsLoadIsOff) {
  Scene scene = test::scene_file("scenes/unloaded_compressor.toml");
  for (const bool deforms : {false, true}) {
    if (deforms)
      scene = test::scene_from(R"(
line = ["drive", "compressor"]
drive = { kind = "prescribed speed", speed = "20 rad/s" }
[compressor]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
rod_mass = "0.5 kg"
rod_com = "100 mm"
rod_inertia = "0.002 kg*m2"
slider_mass = "2 kg"
rod_flexibility = { modulus = "200 GPa", height = "20 mm", width = "16 mm", modes = 1, damping_ratio = 0.05 }
load = { kind = "compressor", bore = "100 mm", suction_pressure = "1 bar", delivery_pressure = "5 bar", clearance = 0.06, working_end = "extended" }
[sequence]
steps = [{ at = "0 s", set = "compressor", to = 0 }, { at = "1 s", set = "compressor" }, { at = "2 s", set = "compressor", to = 0 }]
[effects]
flexible_rod = true
[run]
until = "3 s"
)");
    const Result result = run(scene, false);
    ASSERT_TRUE(result.complete) << result.diagnosis;
    int valves = 0;
    std::map<std::string, bool> off;
    for (const Event& event : result.events) {
      if (event.kind == EventKind::command) off[event.component] = event.value == 0;
      if (event.what.find("valve opens") == std::string::npos) continue;
      ++valves;
      EXPECT_FALSE(off[event.component] || off["compressor"]) << event.component << " at " << event.t;
    }
    EXPECT_GT(valves, 5);
  }
}

// The force falls from delivery to suction pressure without a jump; it never leaves their range.
TEST_P(CompressorDiagram, StaysBetweenItsPressures) {
  const Result result = turning();
  for (const double force : test::series(result, "force.crank")) {
    const double pressure = suction + std::abs(force) / (std::numbers::pi / 4 * bore * bore);
    EXPECT_GE(pressure, suction * (1 - 1e-12));
    EXPECT_LE(pressure, suction * d.ratio * (1 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Over, CompressorDiagram,
                         ::testing::Values(Diagram{8, 0.05, 1.3, 1.3, "extended"}, Diagram{8, 0.05, 1.3, 1.2, "folded"},
                                           Diagram{3, 0.12, 1.4, 1.25, "extended"}, Diagram{2, 0.2, 1, 1, "folded"},
                                           Diagram{20, 0.02, 1.2, 1.35, "extended"},
                                           Diagram{1.05, 0.5, 1.3, 1.3, "extended"}));

// dF/dx from dual numbers against differences, on all four pieces.
TEST(CompressorForce, DerivativesAreExact) {
  const CompressorForce law{.end = {0.25, 1},
                            .stroke = 0.1,
                            .area = 0.02,
                            .suction = 1e5,
                            .delivery = 7e5,
                            .outside = 1e5,
                            .clearance = 0.06,
                            .compression_exponent = 1.32,
                            .expansion_exponent = 1.2};
  for (int i = 0; i <= 100; ++i)
    for (const int travel : {-1, 1}) {
      SliderState<double> s{0, 0.15 + 0.001 * i, 0, travel, 0};
      s.mode = law.first_mode(s);
      const SliderState<Dual<1>> dual{Dual<1>(0.0), Dual<1>::input(s.x, 0), Dual<1>(0.0), travel, s.mode};
      SliderState<double> up = s, down = s;
      up.x += 1e-7;
      down.x -= 1e-7;
      EXPECT_EQ(law.value(dual).value, law.value(s));
      EXPECT_NEAR(law.value(dual).d[0], (law.value(up) - law.value(down)) / 2e-7, 1e-6 * law.greatest() / 0.006);
    }
}

}  // namespace
}  // namespace kurbel::compressor_force_test
