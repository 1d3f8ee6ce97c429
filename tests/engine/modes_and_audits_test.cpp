// modes_and_audits_test.cpp — linearised drives through ratios, with held shafts and torques over the angle; many equal
// modes among others; the audit of what creeps; error scales in any unit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivetrain/couplings/coupling.h"
#include "engine/linear/eigen_modes.h"
#include "engine/linear/linearise.h"
#include "engine/run/run.h"
#include "engine/steppers/stepper.h"
#include "studies/modes/modes.h"
#include "tests/published/published.h"

namespace kurbel::modes_and_audits_test {
namespace {

using test::model_of;
using test::run;
using test::scene_from;
using test::series;

std::string body(const std::string& name, double inertia) {
  return fmt::format("{} = {{ kind = \"inertia\", inertia = \"{} kg*m2\" }}\n", name, inertia);
}
const std::string gear_2_5 = "gear = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }\n";
const std::string elastic =
    "effects = { elasticity = true }\nrun = { until = \"1 s\", start = { speed = \"30 rad/s\" } }\n";

// --- linearised ------------------------------------------------------------------------------------------------------

// Where the speed is given behind the coupling, what drives before it goes through: M, or i M behind a gear.
TEST(LinearDrive, MeanTorqueOfACouplingIsWhatDrivesTowardsAHeldShaft) {
  const std::string ends =
      "motor = { kind = \"torque source\", torque = \"40 N*m\", inertia = \"0.4 kg*m2\" }\nc = { kind = "
      "\"coupling\", stiffness = \"5 kN*m/rad\" }\nout = { kind = \"prescribed speed\", speed = \"12 "
      "rad/s\" }\n";
  const LinearDrive plain = linearise(model_of("line = [\"motor\", \"c\", \"out\"]\n" + ends + elastic), {.speed = 12});
  ASSERT_EQ(plain.joints.size(), 1u);
  EXPECT_NEAR(plain.joints[0].torque, 40, 1e-10);
  const LinearDrive geared =
      linearise(model_of("line = [\"motor\", \"gear\", \"c\", \"out\"]\n" + ends + gear_2_5 + elastic), {.speed = 30});
  EXPECT_NEAR(geared.joints[0].torque, 100, 1e-10);
}

// Wheel 1 is held: wheel 2 vibrates on k i² about its own axis.
TEST(LinearDrive, MeshBehindAHeldWheelHasItsStiffnessByTheSquareOfItsRatio) {
  const Scene scene = scene_from(
      "line = [\"a\", \"mesh\", \"b\"]\na = { kind = \"prescribed speed\", speed = \"30 rad/s\" }\n" + body("b", 3) +
      "mesh = { kind = \"gear mesh\", teeth = [20, 50], stiffness = \"900 N*m/rad\", "
      "damping = \"2 N*m*s/rad\" }\n" +
      elastic);
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].omega, std::sqrt(900 * 2.5 * 2.5 / 3), 1e-8);
  EXPECT_NEAR(modes.modes[0].ratio, 2 * 2.5 * 2.5 / (2 * std::sqrt(900 * 2.5 * 2.5 * 3)), 1e-9);
}

// A torque that falls with the angle of a geared shaft is a spring −M′ there, −M′ (ω_own/ω)² on its merged shaft.
TEST(LinearDrive, TorqueOverTheAngleOfAGearedShaftIsASpringByTheSquareOfItsRatio) {
  const auto model =
      model_of("line = [\"a\", \"c\", \"gear\", \"b\"]\n" + body("a", 0.5) +
               "c = { kind = \"coupling\", stiffness = \"5 kN*m/rad\" }\n" + gear_2_5 +
               "b = { kind = \"torque source\", inertia = \"2 kg*m2\", table = { over = \"angle\", unit = "
               "[\"rad\", \"N*m\"], points = [[0, 80], [3, -70], [5, 20]] } }\n" +
               elastic);
  const LinearDrive drive = linearise(model, {.speed = 30, .angle = 2.5 * 1.2});
  const auto node = static_cast<std::size_t>(model->network.ports.at("b").in);
  const auto coordinate =
      std::find(drive.shaft.begin(), drive.shaft.end(), model->shaft_of_node[node]) - drive.shaft.begin();
  const double gain = model->gain_of_node[node];
  ASSERT_NE(std::abs(gain), 1);
  EXPECT_NEAR(drive.other_stiffness.coeff(coordinate, coordinate), 50 * gain * gain, 1e-9);
}

// Twelve equal branches on the middle of a long chain: eleven modes at their own frequency with the hub still, in the
// midst of those of the chain; none is missed by the sparse search.
TEST(UndampedModes, EqualBranchesAmongOtherModesAreAllFound) {
  Network net;
  const auto add = [&](double inertia) {
    const std::string name = fmt::format("j{}", net.nodes.size());
    const int node = net.add_node(name, "", inertia);
    net.ports[name] = {node, node, {}};
    net.components.push_back(name);
    return node;
  };
  int before = add(1), hub = before;
  for (int i = 1; i < 150; ++i) {
    const int next = add(1);
    net.connect(before, next, 1, fmt::format("k{}", i), Coupling{1000, 0});
    before = next;
    if (i == 73) hub = next;
  }
  for (int i = 0; i < 12; ++i) net.connect(hub, add(0.02), 1, fmt::format("b{}", i), Coupling{0.02 * 1.5 * 1.5, 0});
  const LinearDrive drive = linearise(compile_network(net, Scene{}, Effects{.all_elastic = true, .elastic = {}}), {});
  const UndampedModes dense = undamped_modes(drive, {.count = 20, .dense_below = 1000}),
                      sparse = undamped_modes(drive, {.count = 20, .dense_below = 0});
  ASSERT_EQ(sparse.omega.size(), 21);
  EXPECT_GT(sparse.basis, 0);
  int equal = 0;
  for (Eigen::Index k = 1; k < 21; ++k) {
    EXPECT_NEAR(sparse.omega[k], dense.omega[k], 1e-8) << k;
    equal += std::abs(sparse.omega[k] - 1.5) < 1e-8;
  }
  EXPECT_EQ(equal, 11);
}

// --- what holds and what creeps --------------------------------------------------------------------------------------

// Standing, two brakes hold 24 N·m by 3 : 1 on either side of a rigid coupling, which carries the share of the far one;
// behind a gear it counts by its ratio.
TEST(Standstill, CouplingsCarryWhatIsHeldBeyondThem) {
  for (const double push : {24.0, -24.0}) {
    const Result r =
        run(fmt::format("line = [\"a\", \"near\", \"gear\", \"far\", \"b\"]\npush = {{ kind = \"torque source\", "
                        "on = \"a\", torque = \"{} N*m\" }}\nfirst = {{ kind = \"brake\", on = \"a\", torque = "
                        "\"10 N*m\" }}\nsecond = {{ kind = \"brake\", on = \"b\", torque = \"75 N*m\" }}\n",
                        push) +
                body("a", 0.5) + body("b", 0.7) + gear_2_5 +
                "near = { kind = \"coupling\", stiffness = \"5 kN*m/rad\" }\nfar = { kind = \"coupling\", "
                "stiffness = \"5 kN*m/rad\" }\nrun = { until = \"0.1 s\", samples = 3 }\n",
            false);
    for (const double torque : series(r, "torque.near")) EXPECT_NEAR(torque, 0.75 * push, 1e-9);
    for (const double torque : series(r, "torque.far")) EXPECT_NEAR(torque, 0.75 * push * 2.5, 1e-9);
  }
}

// Without events a one-way clutch creeps with its drag backwards and with much more forwards; what it loses is what the
// machine lacks.
TEST(Creep, OfAOneWayClutchKnowsBothItsLimitsAndItsLoss) {
  const auto model = model_of("line = [\"a\", \"wheel\", \"b\"]\n" + body("a", 0.5) + body("b", 0.8) +
                              "wheel = { kind = \"one-way clutch\", drag = \"10 N*m\" }\n"
                              "push = { kind = \"torque source\", on = \"a\", torque = \"3 N*m\" }\n"
                              "run = { until = \"1 s\", start = { speed = \"5 rad/s\" } }\n");
  Equations equations(model, true);
  const std::vector<double> begin = equations.start(0);
  ASSERT_FALSE(equations.regularise({0}).empty());
  const double creep = 1e-4 * model->shafts[0].speed_scale;
  for (const double slip : {-0.5, 0.3}) {
    std::vector<double> y = begin, rate(y.size());
    y[equations.speed_index(0)] += slip * creep;
    equations.flow(0, y, rate);
    const double torque = (slip < 0 ? 10 : 1e3 * model->shafts[0].torque_scale) * std::tanh(slip);
    const double a = rate[equations.speed_index(0)], b = rate[equations.speed_index(1)];
    EXPECT_NEAR(b, torque / 0.8, 1e-9 * std::abs(torque));
    EXPECT_NEAR(a, (3 - torque) / 0.5, 1e-9 * std::abs(torque));
    double work = 0;
    for (std::size_t k = 0; k < model->accounts.size(); ++k) {
      work += rate[equations.work_index(k)];
      if (model->accounts[k].name == "wheel") {
        EXPECT_LT(rate[equations.work_index(k)], 0);
        EXPECT_NEAR(rate[equations.work_index(k)], -torque * slip * creep, 1e-6 * torque * slip * creep);
      }
    }
    const double kinetic = 0.5 * y[equations.speed_index(0)] * a + 0.8 * y[equations.speed_index(1)] * b;
    EXPECT_NEAR(work, kinetic, 1e-9 * std::abs(torque) * 5);
  }
}

// --- scales ----------------------------------------------------------------------------------------------------------

// Forty times as fast with 1600 times the torque is the same motion over the angle: by the same steps.
TEST(WorkStepper, StepsDoNotDependOnTheUnitOfTime) {
  std::int64_t steps[2];
  for (const double faster : {1.0, 40.0}) {
    const Scene scene = scene_from(fmt::format(
        R"(
line = ["wheel"]
wheel = {{ kind = "inertia", inertia = "0.5 kg*m2" }}
wave = {{ kind = "torque source", on = "wheel", table = {{ over = "angle", unit = ["rad", "N*m"], interpolation = "smooth", points = [[0, {0}], [1, {1}], [2.5, {2}], [4, {3}]] }} }}
fan = {{ kind = "load", on = "wheel", quadratic = "0.05 N*m*s2/rad2" }}
run = {{ until = "{4:.17g} s", start = {{ speed = "{5} rad/s" }} }}
)",
        90 * faster * faster, 10 * faster * faster, -60 * faster * faster, 120 * faster * faster, 3 / faster,
        25 * faster));
    Equations equations(compile(scene, scene.effects), false);
    RunOptions options;
    options.method = "work", options.until = scene.run.until, options.tolerance = 1e-12;
    const RunOutcome out = integrate(equations, options, {});
    ASSERT_TRUE(out.complete) << out.diagnosis;
    steps[faster > 1] = out.statistics.stepper.steps;
  }
  EXPECT_NEAR(static_cast<double>(steps[1]), static_cast<double>(steps[0]), 0.02 * static_cast<double>(steps[0]));
}

// An oscillator whose states are given in other units, with their scales.
class Scaled final : public OdeSystem {
 public:
  Scaled(double first, double second) : ratio_(first / second) { pattern_ = {2, {0, 2, 4}, {0, 1, 0, 1}}; }
  std::size_t size() const override { return 2; }
  void flow(double, std::span<const double> y, std::span<double> f) override {
    f[0] = ratio_ * y[1];
    f[1] = -y[0] / ratio_;
  }
  const SparsityPattern& jacobian_pattern() override { return pattern_; }
  void jacobian(double, std::span<const double>, std::span<double> values) override {
    values[0] = 0, values[1] = -1 / ratio_, values[2] = ratio_, values[3] = 0;
  }

 private:
  double ratio_;
  SparsityPattern pattern_;
};

class InAnyUnit : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, InAnyUnit,
                         testing::Values(Method::dormand_prince_853, Method::dormand_prince_54, Method::verner_65,
                                         Method::fehlberg_87, Method::esdirk_32, Method::esdirk_43, Method::esdirk_54,
                                         Method::bdf, Method::adams),
                         [](const auto& info) {
                           std::string name(name_of(info.param));
                           std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

TEST_P(InAnyUnit, StepsAreThoseOfTheScaledStates) {
  std::int64_t steps[2];
  int k = 0;
  for (const auto& [first, second] : {std::pair{1.0, 1.0}, std::pair{1e-4, 1e3}}) {
    Scaled system(first, second);
    const auto stepper = make_stepper(GetParam(), system, {1e-6, {first, second}});
    stepper->start(0, std::vector<double>{first, 0});
    while (stepper->t() < 20) stepper->step(20);
    EXPECT_NEAR(stepper->y()[0], first * std::cos(20.0), 1e-3 * first);
    EXPECT_NEAR(stepper->y()[1], -second * std::sin(20.0), 1e-3 * second);
    steps[k++] = stepper->statistics().steps;
  }
  EXPECT_NEAR(static_cast<double>(steps[1]), static_cast<double>(steps[0]), 0.1 * static_cast<double>(steps[0]));
}

}  // namespace
}  // namespace kurbel::modes_and_audits_test
