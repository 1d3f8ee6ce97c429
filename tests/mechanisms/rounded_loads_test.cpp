// rounded_loads_test.cpp — load edges off: the same force with its edges rounded; and mechanisms evaluated in the loop.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mechanisms/loads/rounded_profile.h"
#include "tests/support/elements.h"

namespace kurbel::rounded_loads_test {
namespace {

using test::figure;
using test::run;

const std::vector<double> knot = {0, 0.3, 0.5, 1}, left = {2, 5, -1}, right = {4, 5, -3};
const Curve pieces({0, 0, 0.3, 0.3, 0.5, 0.5, 1, 1}, {0.7, 2, 4, 5, 5, -1, -3, -0.2}, Curve::Form::linear);

double sharp(double x) {
  for (std::size_t i = 0; i + 1 < knot.size(); ++i)
    if (x >= knot[i] && x < knot[i + 1])
      return left[i] + (right[i] - left[i]) * (x - knot[i]) / (knot[i + 1] - knot[i]);
  return x < 0 ? 0.7 : -0.2;
}

// The definition: ∫ f(x − w u) κ(u) du, by Simpson's rule between the edges that it meets.
double convolved(double x, double w) {
  const auto kernel = [](double u) { return 35.0 / 32 * std::pow(1 - u * u, 3); };
  std::vector<double> cuts = {-1, 1};
  for (const double k : knot)
    if (std::abs(x - k) < w) cuts.push_back((x - k) / w);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const int n = 4000;
    const double a = cuts[c], b = cuts[c + 1], h = (b - a) / n, inset = 1e-10 * (b - a);
    for (int i = 0; i <= n; ++i) {
      const double u = std::clamp(a + h * i, a + inset, b - inset);
      sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * h / 3 * sharp(x - w * u) * kernel(u);
    }
  }
  return sum;
}

TEST(RoundedProfile, IsTheConvolutionWithItsKernel) {
  for (const double w : {0.01, 0.1, 0.4}) {  // the widest meets several edges at once
    const RoundedProfile rounded(pieces, w);
    for (double x = -0.6; x < 1.6; x += 0.0137)
      EXPECT_NEAR(rounded.value(x), convolved(x, w), 1e-9) << x << " at " << w;
  }
}

TEST(RoundedProfile, DerivativeIsThatOfItsValues) {
  const RoundedProfile rounded(pieces, 0.1);
  const Curve table({0, 1, 3}, {5, 8, 5}, Curve::Form::linear, 3.0);
  const RoundedProfile periodic(table, 0.25);
  for (double x = -0.5; x < 3.5; x += 0.0171) {
    using D = Dual<1>;
    const double h = 1e-6;
    EXPECT_NEAR(rounded.value(D::input(x, 0)).d[0], (rounded.value(x + h) - rounded.value(x - h)) / (2 * h), 1e-6);
    EXPECT_NEAR(periodic.value(D::input(x, 0)).d[0], (periodic.value(x + h) - periodic.value(x - h)) / (2 * h), 1e-6);
    EXPECT_NEAR(periodic.value(x), periodic.value(x + 3), 1e-13);
    // Away from the edges nothing is changed.
    const double within = std::fmod(x + 30, 3);
    if (std::min({within, std::abs(within - 1), 3 - within}) > 0.25) {
      EXPECT_NEAR(periodic.value(x), table.value(x), 1e-13);
    }
  }
}

std::string press(const char* drive, const std::string& rounding, const char* edges) {
  return fmt::format(R"(
line = ["drive", "crank"]
drive = {}
effects = {{ load_edges = {} }}
run = {{ start = {{ speed = "10 rad/s" }}, until = "3 s", accuracy = 1e-8 }}
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
slider_mass = "2 kg"
load = {{ kind = "press", nominal_force = "8 kN", nominal_travel = "20 mm", breakthrough = "6 mm"{} }}
)",
                     drive, edges, rounding.empty() ? "" : fmt::format(", rounding = \"{}\"", rounding));
}
const char* const prescribed = "{ kind = \"prescribed speed\", speed = \"10 rad/s\" }";
const char* const motor =
    "{ kind = \"dc shunt motor\", stall_torque = \"400 N*m\", no_load_speed = \"15 rad/s\", inertia = \"20 kg*m2\" }";

// Rounding leaves the area: F · (20 − 6) mm, whatever the width.
TEST(RoundedLoads, DoTheSameWorkWithoutEvents) {
  for (const char* width : {"0.2 mm", "2 mm", "8 mm"}) {
    const Result r = run(press(prescribed, width, "false"));
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -8e3 * 0.014, 1e-6) << width;
    const Scene scene = test::scene_from(press(prescribed, width, "false"));
    const Equations rounded(compile(scene, scene.effects), false);
    const Scene sharp_scene = test::scene_from(press(prescribed, width, "true"));
    const Equations sharp_one(compile(sharp_scene, sharp_scene.effects), false);
    EXPECT_EQ(rounded.guard_count() + 2, sharp_one.guard_count());  // the pieces' two; that of the travel stays
  }
}

// The motion tends to the sharp one's, as the square of the width; the scene without a width is the sharp one.
TEST(RoundedLoads, TendToSharpOnesAsTheSquareOfTheirWidth) {
  const double exact = figure(run(press(motor, "", "true")), "final_speed.crank");
  double last = 0;
  for (const char* width : {"4 mm", "2 mm", "1 mm"}) {
    const double off = std::abs(figure(run(press(motor, width, "false")), "final_speed.crank") - exact);
    if (last > 0) {
      EXPECT_NEAR(last / off, 4, 1) << width;
    }
    last = off;
  }
  test::expect_same_machine(press(motor, "2 mm", "true"), press(motor, "", "true"));
}

TEST(RoundedLoads, JacobianIsExact) {
  for (const double phi : {-0.5, -0.62, -0.9})
    test::expect_exact_jacobian(press(motor, "3 mm", "false"), phi, {}, {9.0});
}

// The tables are extracted from the very bodies that are evaluated in the loop.
TEST(MultibodyInTheLoop, RunsAsItsTables) {
  const std::string tables = R"(
line = ["motor", "coupling", "crank"]
motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "15 rad/s", inertia = "2 kg*m2" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping_ratio = 0.05 }
effects = { elasticity = true, multibody = false }
run = { until = "1 s", accuracy = 1e-9 }
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "120 mm"
offset = "10 mm"
crank_inertia = "0.5 kg*m2"
rod_mass = "6 kg"
rod_com = "50 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "20 kg"
gravity = "9.81 m/s2"
load = { kind = "medium", viscous = "90 N*s/m" }
)";
  std::string loop = tables;
  loop.replace(loop.find("multibody = false"), 17, "multibody = true");
  const Result a = run(tables), b = run(loop);
  for (const char* name : {"final_angle.crank", "final_speed.crank", "peak_torque.coupling", "work.useful"})
    EXPECT_NEAR(figure(a, name), figure(b, name), 1e-9 * std::abs(figure(a, name))) << name;
  EXPECT_LT(b.energy.relative, 1e-9);
}

}  // namespace
}  // namespace kurbel::rounded_loads_test
