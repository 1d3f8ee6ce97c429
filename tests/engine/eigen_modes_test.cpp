// eigen_modes_test.cpp — modes of linearised drives: closed forms, published lines, dense against sparse, counting.
#include "engine/linear/eigen_modes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/loads/loads.h"
#include "engine/events/equations.h"
#include "engine/numerics/deadline.h"
#include "tests/support/scenes.h"

namespace kurbel::eigen_modes_test {
namespace {

constexpr double pi = std::numbers::pi;

// A drive made by hand; all springs elastic.
class Hand {
 public:
  int inertia(double j) {
    const std::string name = fmt::format("j{}", net_.nodes.size());
    const int node = net_.add_node(name, "", j);
    net_.ports[name] = {node, node};
    net_.components.push_back(name);
    return node;
  }
  Hand& spring(int a, int b, double k, double c = 0, double ratio = 1) {
    net_.connect(a, b, ratio, fmt::format("k{}", net_.joints.size()), Coupling{k, c});
    return *this;
  }
  Hand& gear(int a, int b, double ratio) {
    net_.join(a, b, ratio, "gear");
    return *this;
  }
  Hand& viscous(int node, double b) {
    net_.put(node, fmt::format("b{}", node), SpeedLoad{Account::useful, b, 0});
    return *this;
  }
  LinearDrive drive() {
    return linearise(compile_network(net_, Scene{}, Effects{.all_elastic = true, .elastic = {}}), {});
  }

 private:
  Network net_;
};

LinearDrive equal_chain(int n, double j, double k, double c = 0) {
  Hand hand;
  int before = hand.inertia(j);
  for (int i = 1; i < n; ++i) {
    const int next = hand.inertia(j);
    hand.spring(before, next, k, c);
    before = next;
  }
  return hand.drive();
}

LinearDrive random_tree(int n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Hand hand;
  std::vector<int> nodes = {hand.inertia(1)};
  for (int i = 1; i < n; ++i) {
    const int to = nodes[static_cast<std::size_t>(uniform(random) * static_cast<double>(nodes.size()))];
    const int next = hand.inertia(std::pow(10, -3 + 3 * uniform(random)));
    hand.spring(to, next, std::pow(10, 3 + 3 * uniform(random)), 0.1 * uniform(random), 0.2 + 3 * uniform(random));
    nodes.push_back(next);
  }
  return hand.drive();
}

TEST(UndampedModes, TwoMassesOscillateAtRootOfStiffnessOverReducedInertia) {
  Hand hand;
  const int a = hand.inertia(2.5), b = hand.inertia(0.4);
  const UndampedModes m = undamped_modes(hand.spring(a, b, 3000).drive());
  EXPECT_EQ(m.rigid, 1);
  EXPECT_EQ(m.omega[0], 0.0);
  EXPECT_NEAR(m.omega[1], std::sqrt(3000 * (1 / 2.5 + 1 / 0.4)), 1e-12 * m.omega[1]);
  EXPECT_NEAR(m.shapes(0, 1) / m.shapes(1, 1), -0.4 / 2.5, 1e-13);  // node where the moments balance
}

// ω_k = 2 √(k/J) sin(kπ/2N)
TEST(UndampedModes, FreeChainOfEqualInertiasHasSineFrequencies) {
  for (const int n : {2, 7, 60, 1000, 10000}) {
    const UndampedModes m = undamped_modes(equal_chain(n, 0.01, 1e5), {.count = 20});
    const double scale = 2 * std::sqrt(1e5 / 0.01);
    EXPECT_EQ(m.counted_below, m.omega.size()) << n;
    EXPECT_EQ(m.omega.size(), n <= 160 ? n : 21) << n;
    for (Eigen::Index k = 1; k < m.omega.size(); ++k) {
      const double expected = scale * std::sin(static_cast<double>(k) * pi / (2 * n));
      EXPECT_NEAR(m.omega[k], expected, 1e-10 * expected) << n << " inertias, mode " << k;
    }
  }
}

// A chain twenty times as long takes some twenty times as long; visits to all columns for each row took 170 times.
TEST(LinearDrives, MatricesOfALongChainAreMadeInLinearTime) {
  const auto seconds = [](int n) {
    double least = HUGE_VAL;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const double begin = processor_time();
      EXPECT_EQ(equal_chain(n, 0.01, 1e5).size(), n);
      least = std::min(least, processor_time() - begin);
    }
    return least;
  };
  const double of_short = seconds(2000);
  EXPECT_LT(seconds(40000), 70 * of_short);
}

// A gear of ratio i between two springs: reduced to the first shaft k₂/i², J₃/i².
TEST(UndampedModes, GearedTrainEqualsTheTrainReducedToOneShaft) {
  const double i = 3.5;
  Hand geared, reduced;
  {
    const int a = geared.inertia(1), b = geared.inertia(0.2), c = geared.inertia(0.5), d = geared.inertia(7);
    geared.spring(a, b, 4e4).gear(b, c, i).spring(c, d, 9e4);
  }
  {
    const int a = reduced.inertia(1), b = reduced.inertia(0.2 + 0.5 / (i * i)), d = reduced.inertia(7 / (i * i));
    reduced.spring(a, b, 4e4).spring(b, d, 9e4 / (i * i));
  }
  const Eigen::VectorXd x = undamped_modes(geared.drive()).omega, y = undamped_modes(reduced.drive()).omega;
  ASSERT_EQ(x.size(), y.size());
  for (Eigen::Index k = 1; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-12 * y[k]);
}

// Gunter and Chen 2001, ex. 8.1 (tests/cases/torsional.toml): lb in, two turbines on one propeller through two stages.
TEST(UndampedModes, BranchedMarineDriveHasThePublishedFrequencies) {
  Hand hand;
  const int propeller = hand.inertia(2.454e6), bull = hand.inertia(0.826e6), hp_gear = hand.inertia(2.723e4),
            hp_turbine = hand.inertia(261.2), lp_gear = hand.inertia(1.283e4), lp_turbine = hand.inertia(1.509e4);
  const int hp_quill = hand.inertia(0), lp_quill = hand.inertia(0), hp_pinion = hand.inertia(0),
            lp_pinion = hand.inertia(0);
  hand.spring(propeller, bull, 826e6).gear(bull, hp_quill, 1 / 9.4094).gear(bull, lp_quill, 1 / 9.4094);
  hand.spring(hp_quill, hp_gear, 24.17e6)
      .gear(hp_gear, hp_pinion, 9.4094 / 78.2365)
      .spring(hp_pinion, hp_turbine, 14.26e6);
  hand.spring(lp_quill, lp_gear, 203.94e6)
      .gear(lp_gear, lp_pinion, 9.4094 / 40.0424)
      .spring(lp_pinion, lp_turbine, 30.51e6);
  const UndampedModes m = undamped_modes(hand.drive());
  const double published[] = {177.71, 220.18, 1282.6, 2496.9, 2883.4};
  ASSERT_EQ(m.omega.size(), 6);
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(m.omega[k + 1] * 30 / pi, published[k], 5e-4 * published[k]) << "mode " << k + 1;
}

TEST(UndampedModes, ShapesAreOrthonormalInMassAndDiagonaliseTheStiffness) {
  std::mt19937_64 random(7);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const LinearDrive d = random_tree(3 + 4 * repeat, random);
    const UndampedModes m = undamped_modes(d);
    const Eigen::MatrixXd mass = m.shapes.transpose() * d.inertia.asDiagonal() * m.shapes;
    EXPECT_LT((mass - Eigen::MatrixXd::Identity(mass.rows(), mass.cols())).norm(), 1e-11);
    const Eigen::MatrixXd k = m.shapes.transpose() * (d.stiffness * m.shapes);
    EXPECT_LT((k - Eigen::MatrixXd(m.omega.cwiseAbs2().asDiagonal())).norm(), 1e-11 * k.norm());
  }
}

TEST(UndampedModes, SparseSearchFindsWhatTheDenseSolverFinds) {
  std::mt19937_64 random(11);
  for (int repeat = 0; repeat < 10; ++repeat) {
    const LinearDrive d = random_tree(120 + 7 * repeat, random);
    const UndampedModes dense = undamped_modes(d, {.count = 20, .dense_below = 1000});
    const UndampedModes sparse = undamped_modes(d, {.count = 20, .dense_below = 0});
    ASSERT_EQ(sparse.omega.size(), 21);
    EXPECT_GT(sparse.basis, 0);
    EXPECT_LT(sparse.residual, 1e-11);
    for (Eigen::Index k = 1; k < 21; ++k) EXPECT_NEAR(sparse.omega[k], dense.omega[k], 1e-9 * dense.omega[k]) << k;
  }
}

// 40 equal branches on one hub: 39 modes at √(k/J) with the hub still, found by counting though a Krylov space of four
// vectors knows four of them.
TEST(UndampedModes, ManyEqualBranchesGiveAsManyEqualFrequencies) {
  Hand hand;
  const int hub = hand.inertia(3);
  for (int i = 0; i < 40; ++i) {
    const int middle = hand.inertia(0.1), end = hand.inertia(0.1);
    hand.spring(hub, middle, 1000).spring(middle, end, 1000);
  }
  const double lower = std::sqrt(1000 / 0.1 * (3 - std::sqrt(5)) / 2);  // fixed-free pair of equal inertias
  const LinearDrive d = hand.drive();
  const UndampedModes m = undamped_modes(d, {.count = 26, .dense_below = 0});
  for (int k = 1; k <= 26; ++k) EXPECT_NEAR(m.omega[k], lower, 1e-9 * lower) << k;
  EXPECT_EQ(m.counted_below, 40);  // with the rigid motion
}

TEST(UndampedModes, CountOfModesBelowAFrequencyIsThatOfTheDenseSolver) {
  std::mt19937_64 random(5);
  const LinearDrive d = random_tree(50, random);
  const Eigen::VectorXd dense = undamped_modes(d).omega;
  for (int count = 2; 3 * count < d.size(); ++count) {
    const UndampedModes m = undamped_modes(d, {.count = count, .dense_below = 0});
    const double last = m.omega[m.omega.size() - 1] * (1 + 1e-9);
    EXPECT_EQ(m.counted_below, (dense.array() < last).count()) << count;
  }
}

TEST(UndampedModes, EnergySharesSumToOneAndKnowTheTwistedSpring) {
  Hand hand;
  const int a = hand.inertia(10), b = hand.inertia(10), c = hand.inertia(10);
  const LinearDrive d = hand.spring(a, b, 1e8).spring(b, c, 1e3).drive();
  const UndampedModes m = undamped_modes(d);
  const EnergyShares shares = energy_shares(d, m.shapes.col(1));
  EXPECT_NEAR(shares.joint[0] + shares.joint[1], 1, 1e-14);
  EXPECT_GT(shares.joint[1], 0.9999);
  EXPECT_NEAR(shares.shaft[0] + shares.shaft[1] + shares.shaft[2], 1, 1e-14);
  EXPECT_NEAR(shares.shaft[2], 2.0 / 3, 1e-4);  // 20 against 10: amplitudes 1 : −2
}

// λ² + 2ζω₀λ + ω₀² = 0 with c and k in parallel, 2ζω₀ = c/J_red.
TEST(DampedModes, TwoMassesHaveTheRootsOfTheQuadratic) {
  for (const double c : {0.0, 3.0, 60.0}) {
    Hand hand;
    const int a = hand.inertia(2), b = hand.inertia(0.5);
    const LinearDrive d = hand.spring(a, b, 1000, c).drive();
    const std::vector<DampedMode> m = damped_modes(d, undamped_modes(d));
    const double reduced = 0.4, half = 0.5 * c / reduced, omega0 = std::sqrt(1000 / reduced);
    if (half < omega0) {
      EXPECT_NEAR(m[0].lambda.real(), -half, 1e-11 * omega0);
      EXPECT_NEAR(m[0].lambda.imag(), std::sqrt(omega0 * omega0 - half * half), 1e-11 * omega0);
      EXPECT_NEAR(m[0].ratio(), half / omega0, 1e-12);
      EXPECT_EQ(m[1].lambda, 0.0);  // rigid motion, undamped
    } else {
      const double root = std::sqrt(half * half - omega0 * omega0);
      EXPECT_EQ(m[0].lambda, 0.0);
      EXPECT_NEAR(m[1].lambda.real(), -half + root, 1e-10 * omega0);
      EXPECT_NEAR(m[2].lambda.real(), -half - root, 1e-10 * half);
    }
  }
}

TEST(DampedModes, NewtonOnTheSparseProblemFindsTheRootsOfTheDenseOne) {
  std::mt19937_64 random(3);
  for (int repeat = 0; repeat < 5; ++repeat) {
    LinearDrive d = random_tree(40, random);
    const UndampedModes m = undamped_modes(d, {.count = 8, .dense_below = 0});
    const std::vector<DampedMode> sparse = damped_modes(d, m, {.count = 8, .dense_below = 0});
    const std::vector<DampedMode> dense = damped_modes(d, m);
    EXPECT_EQ(sparse.size(), 8u);
    for (const DampedMode& s : sparse) {
      const DampedMode& x =
          *std::min_element(dense.begin(), dense.end(), [&](const DampedMode& a, const DampedMode& b) {
            return std::abs(a.lambda - s.lambda) < std::abs(b.lambda - s.lambda);
          });
      EXPECT_LT(std::abs(x.lambda - s.lambda), 1e-9 * std::abs(s.lambda));
      EXPECT_NEAR(s.energy.springs, x.energy.springs, 1e-6);
      EXPECT_NEAR(s.energy.inertias, x.energy.inertias, 1e-6);
    }
  }
}

const char* const motor_and_fan = R"(
line = ["motor", "c", "fan"]
[motor]
kind = "dc shunt motor"
stall_torque = "200 N*m"
no_load_speed = "150 rad/s"
inertia = "0.1 kg*m2"
[c]
kind = "coupling"
stiffness = "4 kN*m/rad"
damping = "2 N*m*s/rad"
[fan]
kind = "load"
quadratic = "0.02 N*m*s2/rad2"
inertia = "0.6 kg*m2"
[effects]
elasticity = true
)";

// Slopes of motor and fan stand in C at the requested speed; the mean torque in the coupling is the fan's where steady.
TEST(Linearisation, HoldsTheSlopesOfMotorAndLoadAtTheOperatingPoint) {
  const Scene scene = test::scene_from(motor_and_fan);
  const auto model = compile(scene, scene.effects);
  const double steady = (-200.0 / 150 + std::sqrt(std::pow(200.0 / 150, 2) + 4 * 0.02 * 200)) / (2 * 0.02);
  const LinearDrive d = linearise(model, {.speed = steady});
  const Eigen::MatrixXd c(d.damping);
  EXPECT_NEAR(c(0, 0), 2 + 200.0 / 150, 1e-12);
  EXPECT_NEAR(c(1, 1), 2 + 2 * 0.02 * steady, 1e-12);
  EXPECT_NEAR(c(0, 1), -2, 1e-12);
  EXPECT_NEAR(d.joints[0].stiffness, 4000, 1e-9);
  EXPECT_NEAR(d.joints[0].damping, 2, 1e-12);
  EXPECT_NEAR(d.joints[0].torque, 0.02 * steady * steady, 1e-10);
  EXPECT_NEAR(d.mean_torque, 0, 1e-10);
}

TEST(Linearisation, MechanismEntersByTheMeanOfItsInertiaOrByThatAtTheAngle) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const auto model = compile(scene, scene.effects);
  const LinearDrive mean = linearise(model, {.speed = 6});
  double sum = 0, least = HUGE_VAL, greatest = 0;
  const Eigen::Index last = mean.size() - 1;
  for (int i = 0; i < 64; ++i) {
    const LinearDrive held = linearise(model, {.speed = 6, .angle = 2 * pi * (i + 0.5) / 64});
    sum += held.inertia[last] / 64;
    least = std::min(least, held.inertia[last]);
    greatest = std::max(greatest, held.inertia[last]);
  }
  EXPECT_NEAR(mean.inertia[last], sum, 1e-10 * sum);
  EXPECT_GT(greatest - least, 1e-3 * sum);
}

// A prescribed speed holds its shaft: the other one vibrates against it at √(k/J).
TEST(Linearisation, PrescribedSpeedHoldsItsShaft) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "c", "disc"]
[drive]
kind = "prescribed speed"
speed = "10 rad/s"
[c]
kind = "coupling"
stiffness = "500 N*m/rad"
[disc]
kind = "inertia"
inertia = "0.2 kg*m2"
[effects]
elasticity = true
)");
  const UndampedModes m = undamped_modes(linearise(compile(scene, scene.effects), {.speed = 10}));
  EXPECT_EQ(m.rigid, 0);
  ASSERT_EQ(m.omega.size(), 1);
  EXPECT_NEAR(m.omega[0], std::sqrt(500 / 0.2), 1e-11);
}

TEST(Linearisation, RefusesARigidMachineInWords) {
  const Scene scene = test::scene_from(motor_and_fan);
  try {
    linearise(compile(scene, Effects{}), {});
    FAIL() << "no refusal";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("--effects elasticity"), std::string::npos);
  }
}

}  // namespace
}  // namespace kurbel::eigen_modes_test
