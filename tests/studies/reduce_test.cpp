// reduce_test.cpp — reduction against closed forms, power and energy; gear trains; chain; harmonics.
#include "studies/reduce/reduce.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::reduce_test {
namespace {

using test::Against;
using test::Validation;

constexpr double pi = std::numbers::pi, degree = pi / 180;

const char* const press_scene = R"(
title = "press with a slow shaft"
line  = ["motor", "belt", "gearbox", "shaft", "press"]
motor   = { kind = "torque source", torque = "30 N*m", inertia = "0.09 kg*m2" }
belt    = { kind = "coupling", stiffness = "4 kN*m/rad", damping = "2 N*m*s/rad", inertia_in = "0.008 kg*m2", inertia_out = "0.01 kg*m2" }
gearbox = { kind = "gearbox", stages = [{ teeth = [20, 90], inertia = ["0.004 kg*m2", "0.35 kg*m2"] }] }
shaft   = { kind = "coupling", stiffness = "900 kN*m/rad", damping = "30 N*m*s/rad", inertia_in = "0.5 kg*m2", inertia_out = "0.7 kg*m2" }
press   = { kind = "slider-crank", radius = "50 mm", rod = "180 mm", offset = "12 mm", crank_mass = "10 kg", crank_com = "15 mm", crank_inertia = "0.4 kg*m2", rod_mass = "12 kg", rod_com = "60 mm", rod_inertia = "0.06 kg*m2", slider_mass = "30 kg", gravity = "9.81 m/s2", stroke_angle = "-90 deg", load = [{ kind = "constant", force = "-700 N" }, { kind = "medium", viscous = "120 N*s/m", work = "harmful" }] }
)";

SliderCrankGeometry press_geometry() {
  SliderCrankData d;
  d.radius = 0.05, d.rod_length = 0.18, d.offset = 0.012, d.crank_mass = 10, d.crank_com = 0.015;
  d.crank_inertia = 0.4, d.rod_mass = 12, d.rod_com = 0.06, d.rod_inertia = 0.06, d.slider_mass = 30;
  d.gravity = 9.81, d.stroke_angle = -pi / 2;
  return SliderCrankGeometry(d);
}

ReduceOptions options_of(int positions, const std::string& to, double speed = 3) {
  ReduceOptions options;
  options.positions = positions;
  options.to = to;
  options.speed = speed;
  return options;
}

// Of everything at a constant ratio, on the crank.
const double drive_inertia = 4.5 * 4.5 * (0.09 + 0.008 + 0.01 + 0.004) + 0.35 + 0.5 + 0.7;

double share(const MachineReduction& r, const ReducedPosition& p, const std::string& account) {
  for (std::size_t k = 0; k < r.accounts.size(); ++k)
    if (r.accounts[k] == account) return p.share[k];
  ADD_FAILURE() << "no account " << account;
  return std::nan("");
}

TEST(Reduce, TwelvePositionsOfASliderCrankMatchItsGeometry) {
  ReduceOptions options;
  options.speed = 3;
  const MachineReduction r = reduce(test::scene_from(press_scene), options);
  const SliderCrankGeometry geometry = press_geometry();
  ASSERT_EQ(r.positions.size(), 12U);
  for (const ReducedPosition& p : r.positions) {
    const auto inertia = geometry.inertia(p.phi);
    const double ratio = geometry.slider(p.phi).slope;
    EXPECT_NEAR(p.phi, 30 * degree * p.number, 1e-15 * p.number);
    EXPECT_NEAR(p.mechanism_inertia, inertia.value, 1e-10 * inertia.value);
    EXPECT_NEAR(p.drive_inertia, drive_inertia, 1e-13 * drive_inertia);
    EXPECT_NEAR(p.inertia, drive_inertia + inertia.value, 1e-10);
    EXPECT_NEAR(p.slope, inertia.slope, 1e-10);
    EXPECT_NEAR(p.drive, 4.5 * 30, 1e-10);
    EXPECT_NEAR(share(r, p, "press (weight)"), geometry.gravity_torque(p.phi).value, 1e-10);
    EXPECT_NEAR(share(r, p, "press.load1 (useful)"), -700 * ratio, 700e-10);
    EXPECT_NEAR(share(r, p, "press.load2 (harmful)"), -120 * ratio * ratio * 3, 1e-9);
    double sum = 0;
    for (const double s : p.share) sum += s;
    EXPECT_NEAR(p.drive - p.load, sum, 1e-10);
  }
}

TEST(Reduce, SliderAndCrankHaveTheSameKineticEnergyAndPower) {
  ReduceOptions to_crank, to_slider;
  to_crank.positions = to_slider.positions = 37;
  to_crank.speed = to_slider.speed = 2.5;
  to_slider.to = "press.slider";
  const Scene scene = test::scene_from(press_scene);
  const MachineReduction crank = reduce(scene, to_crank), slider = reduce(scene, to_slider);
  const SliderCrankGeometry geometry = press_geometry();
  for (std::size_t k = 0; k < 37; ++k) {
    const ReducedPosition &c = crank.positions[k], &s = slider.positions[k];
    ASSERT_TRUE(s.ratio && s.singular.empty());
    const double omega = 2.5, v = *s.ratio * omega;
    EXPECT_NEAR(*s.ratio, geometry.slider(c.phi).slope, 1e-12);
    EXPECT_NEAR(0.5 * s.inertia * v * v, 0.5 * c.inertia * omega * omega, 1e-12 * c.inertia * omega * omega);
    EXPECT_NEAR((s.drive - s.load) * v, (c.drive - c.load) * omega, 1e-10);
    // dm_r/dx by differences of the closed form along the stroke.
    const auto mass = [&](double phi) {
      return (drive_inertia + geometry.inertia(phi).value) / std::pow(geometry.slider(phi).slope, 2);
    };
    const double h = 1e-5;
    const double slope =
        (mass(c.phi + h) - mass(c.phi - h)) / (geometry.slider(c.phi + h).value - geometry.slider(c.phi - h).value);
    EXPECT_NEAR(s.slope, slope, 1e-5 * std::abs(slope) + 1e-3 * s.inertia);
  }
}

TEST(Reduce, DeadCentresOfTheSliderAreOmittedWithTheReason) {
  const MachineReduction r = reduce(test::scene_file("scenes/crank_press.toml"), options_of(12, "press.slider", 6));
  ASSERT_EQ(r.positions.size(), 12U);
  for (const ReducedPosition& p : r.positions) EXPECT_EQ(!p.singular.empty(), p.number == 0 || p.number == 6);
  ASSERT_FALSE(r.notes.empty());
  const StudyOutput output = output_of(r);
  EXPECT_NE(output.text().find("position 0 (0°), 6 (180°): a dead centre"), std::string::npos) << output.text();
  const std::string csv = csv_text(output.tables.front().table());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 11);  // the heading and ten rows
  EXPECT_EQ(csv.find("—"), std::string::npos);
}

// A linear motor of 200 N against 50 N·s/m moves 40 kg: m_r = 40 kg and F_r = 200 N − 50 N·s/m · 2 m/s wherever it stands.
TEST(Reduce, ALinearMotorMovesByItsReducedMassAndForce) {
  const Scene scene = test::scene_from(R"(
line = ["carriage"]
carriage = { kind = "slide", radius = "0.5 m", mass = "40 kg", force = "-200 N", acts = "always", work = "driving", damping = "50 N*s/m" }
run = { start = "rest", until = "1 s" }
)");
  const MachineReduction r = reduce(scene, options_of(12, "carriage.slider", 4));
  EXPECT_FALSE(r.turns_back);
  for (const ReducedPosition& p : r.positions) {
    EXPECT_NEAR(p.inertia, 40, 1e-9);
    EXPECT_NEAR(p.slope, 0, 1e-9);
    EXPECT_NEAR(p.drive - p.load, 100, 1e-9);
  }
  EXPECT_TRUE(std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
    return note.find("may be the reduction link: it moves by m_r a + ½ m_r′ v² = F_d − F_c") != std::string::npos;
  }));
}

TEST(Reduce, AnotherShaftTakesInertiaOverTheSquareAndTorqueOverTheRatio) {
  const Scene scene = test::scene_from(press_scene);
  ReduceOptions options;
  options.speed = 3;
  const MachineReduction crank = reduce(scene, options);
  options.to = "gearbox.in";
  const MachineReduction fast = reduce(scene, options);
  EXPECT_NEAR(fast.to_ratio, 4.5, 1e-14);
  for (std::size_t k = 0; k < 12; ++k) {
    const ReducedPosition &c = crank.positions[k], &f = fast.positions[k];
    EXPECT_NEAR(f.inertia * 4.5 * 4.5, c.inertia, 1e-13 * c.inertia);
    EXPECT_NEAR(f.slope * std::pow(4.5, 3), c.slope, 1e-13);
    EXPECT_NEAR(f.load * 4.5, c.load, 1e-11);
    EXPECT_NEAR(f.drive, 30, 1e-12);
  }
}

// M_r ω = Σ F v + Σ M ω at random positions and speeds: each share against the force times the velocity of its point.
TEST(Reduce, ReducedTorqueDoesThePowerOfTheForces) {
  RigidMachine machine(test::scene_from(press_scene));
  const SliderCrankGeometry geometry = press_geometry();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double phi = 2 * pi * u(random), omega = 0.1 + 20 * u(random);
    machine.set_modes(phi, omega);
    const double v = geometry.slider(phi).slope * omega, h = 1e-6;
    const double lift = (geometry.potential_energy(phi + h) - geometry.potential_energy(phi - h)) / (2 * h) * omega;
    const double power = 30 * 4.5 * omega - 700 * v - 120 * v * v - lift;
    EXPECT_NEAR(machine.at(phi, omega).torque * omega, power, 1e-7 * (1 + std::abs(power)));
  }
}

TEST(Reduce, DriveBecomesTheChainThatAnEngineerDrawsByHand) {
  ReduceOptions options;
  options.speed = 3;
  const MachineReduction r = reduce(test::scene_from(press_scene), options);
  ASSERT_EQ(r.chain.inertias.size(), 3U);
  ASSERT_EQ(r.chain.springs.size(), 2U);
  const double i2 = 4.5 * 4.5;
  EXPECT_NEAR(r.chain.inertias[0].reduced, i2 * 0.098, 1e-12);
  EXPECT_NEAR(r.chain.inertias[1].reduced, i2 * 0.014 + 0.35 + 0.5, 1e-12);
  EXPECT_NEAR(r.chain.springs[0].reduced_stiffness, i2 * 4000, 1e-9);
  EXPECT_NEAR(r.chain.springs[0].reduced_damping, i2 * 2, 1e-12);
  EXPECT_NEAR(r.chain.springs[1].reduced_stiffness, 900e3, 1e-7);
  // The sum is the rigid machine with the mechanism's mean.
  double total = 0;
  for (const ChainInertia& i : r.chain.inertias) total += i.reduced;
  EXPECT_NEAR(total, r.spectra[0].harmonics[0].amplitude.value, 1e-10);
  // On the motor's shaft the same frequencies must come out: k/J is the same on every shaft.
  options.to = "motor";
  const Chain fast = reduce(test::scene_from(press_scene), options).chain;
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(fast.springs[k].reduced_stiffness / fast.inertias[k].reduced,
                r.chain.springs[k].reduced_stiffness / r.chain.inertias[k].reduced, 1e-6);
}

// Dubey 2.1 (tests/cases/mo02_closed_forms.toml) without its gear losses, which a reduction of inertia has not: motor,
// a load through a gear of 0.1, a mass hoisted at 1.5 m/s with the motor at 1420 rpm.
TEST(Reduce, GearTrainOfDubey) {
  const Validation is(Against::published,
                      "Dubey: Fundamentals of Electrical Drives, ex. 2.1, reduced inertia without losses");
  const double hoist = 1000 * std::pow(1.5 / (1420 * pi / 30), 2);
  const std::string scene = R"(
line = ["motor", "gear", "load"]
motor = { kind = "torque source", torque = "1 N*m", inertia = ")" +
                            test::digits(0.2 + hoist) + R"( kg*m2" }
gear  = { kind = "gearbox", stages = [{ teeth = [20, 200] }] }
load  = { kind = "load", torque = "10 N*m", inertia = "10 kg*m2" }
)";
  const MachineReduction r = reduce(test::scene_from(scene), {});
  is.near("inertia reduced to the motor", "kg·m²", r.positions.front().inertia, 0.4017533212, 1e-9);
  EXPECT_NEAR(r.positions.front().load, 1.0, 1e-12);  // 10 N·m through 0.1
}

// Khurmi 3.17: 0.6 kg·m² drives 45 kg·m² through 9: without losses I on B is 45 + 81 · 0.6 = 93.6; the book's 91.17
// counts the efficiency of 0.95 into the driving side.
TEST(Reduce, GearTrainOfKhurmi) {
  const std::string scene = R"(
line = ["a", "gear", "b"]
a    = { kind = "torque source", torque = "30 N*m", inertia = "0.6 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 180] }] }
b    = { kind = "load", torque = "100 N*m", inertia = "45 kg*m2" }
)";
  const MachineReduction r = reduce(test::scene_from(scene), options_of(12, "b"));
  EXPECT_NEAR(r.positions.front().inertia, 93.6, 1e-11);
  EXPECT_NEAR(45 + 0.95 * (r.positions.front().inertia - 45), 91.17, 1e-11);
  EXPECT_NEAR((0.95 * r.positions.front().drive - r.positions.front().load) / 91.17, 1.716573434, 1e-9);
}

TEST(Reduce, HarmonicsHoldTheMeanSquare) {
  ReduceOptions options = options_of(12, "");
  options.orders = 40;
  const MachineReduction r = reduce(test::scene_from(press_scene), options);
  ASSERT_EQ(r.spectra.size(), 3U);
  const Spectrum& inertia = r.spectra[0];
  EXPECT_NEAR(inertia.captured, 1, 1e-14);
  // Parseval for the part that varies, where the mean does not hide it.
  const SliderCrankGeometry geometry = press_geometry();
  const double mean = inertia.harmonics[0].amplitude.value;
  double square = 0, sum = 0;
  for (int k = 0; k < 4096; ++k)
    square += std::pow(drive_inertia + geometry.inertia(2 * pi * k / 4096).value - mean, 2) / 4096;
  for (std::size_t n = 1; n < inertia.harmonics.size(); ++n)
    sum += 0.5 * std::pow(inertia.harmonics[n].amplitude.value, 2);
  EXPECT_NEAR(sum / square, 1, 1e-11);
  // The series is the function.
  for (const double phi : {0.3, 2.0, 5.5}) {
    double value = mean;
    for (std::size_t n = 1; n < inertia.harmonics.size(); ++n)
      value +=
          inertia.harmonics[n].amplitude.value * std::cos(static_cast<double>(n) * phi - inertia.harmonics[n].phase);
    EXPECT_NEAR(value, drive_inertia + geometry.inertia(phi).value, 1e-11);
  }
}

TEST(Reduce, HarmonicsOfAStepAreThoseOfTheTextbook) {
  const Piecewise step = Piecewise::linear({0, pi, pi, 2 * pi}, {1, 1, -1, -1});
  const Spectrum s = spectrum("step", "", step, 25);
  for (std::size_t n = 1; n <= 25; ++n) {
    EXPECT_NEAR(s.harmonics[n].amplitude.value, n % 2 ? 4 / (pi * static_cast<double>(n)) : 0, 1e-13);
    if (n % 2 == 1) {
      EXPECT_NEAR(s.harmonics[n].phase, pi / 2, 1e-12);
    }
  }
}

// A shaking screen: the rocker is a rotating link of its own, kg·m² and N·m.
TEST(Reduce, RockerOfAFourBarHasTheSameKineticEnergy) {
  const Scene scene = test::scene_file("scenes/four_bar_rocker.toml");
  std::string name;
  for (const Section& s : scene.components)
    if (s.kind->name == "four-bar") name = s.name;
  const MachineReduction crank = reduce(scene, options_of(25, "", 30)),
                         rocker = reduce(scene, options_of(25, name + ".rocker", 30));
  EXPECT_TRUE(rocker.to_rocker);
  for (std::size_t k = 0; k < 25; ++k) {
    const ReducedPosition &c = crank.positions[k], &r = rocker.positions[k];
    if (!r.singular.empty()) continue;
    EXPECT_NEAR(r.inertia * *r.ratio * *r.ratio, c.inertia, 1e-11 * c.inertia);
    EXPECT_NEAR(r.load * *r.ratio, c.load, 1e-9 * (1 + std::abs(c.load)));
  }
  EXPECT_THROW(reduce(scene, options_of(12, name + ".slider")), std::invalid_argument);
}

// Weights alone take no work over a cycle: what is left of the torques is rounding, and the speed's rounding on the
// steep characteristic is most of it.
TEST(Reduce, ABalanceOfNothingIsZeroWithinItsError) {
  for (int i = 0; i < 24; ++i) {
    const std::string scene = fmt::format(
        R"(
line = ["motor", "press"]
motor = {{ kind = "induction motor", rated_power = "{} kW", rated_speed = "{} rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.5, inertia = "0.1 kg*m2" }}
press = {{ kind = "slider-crank", radius = "{} mm", rod = "180 mm", slider_mass = "3 kg", gravity = "9.81 m/s2", stroke_angle = "90 deg" }}
)",
        2.2 + 1.37 * i, 1420 + 2.3 * i, 30 + i);
    const MachineReduction r = reduce(test::scene_from(scene), {});
    EXPECT_LE(std::abs(r.mean_drive.value), r.mean_drive.error.value()) << i;
    EXPECT_LT(*r.mean_drive.error, 2e-11) << i;
    EXPECT_LE(r.spectra[1].harmonics[0].amplitude.value, *r.spectra[1].harmonics[0].amplitude.error) << i;
    EXPECT_NE(r.notes.back().find("N·m, as here, the mean resisting torque"), std::string::npos) << r.notes.back();
  }
}

TEST(Reduce, RefusesInWords) {
  const Scene scene = test::scene_from(press_scene);
  const auto message = [&](const ReduceOptions& options) {
    try {
      reduce(scene, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(options_of(12, "pres.slider")).find("did you mean \"press.slider\""), std::string::npos);
  EXPECT_NE(message(options_of(12, "gearbox")).find("\"gearbox.in\" or \"gearbox.out\""), std::string::npos);
  EXPECT_NE(message(options_of(12, "wheel")).find("allowed: \"motor\""), std::string::npos)
      << message(options_of(12, "wheel"));
}

}  // namespace
}  // namespace kurbel::reduce_test
