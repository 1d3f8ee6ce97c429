// vibrations_agreement_test.cpp — free and forced vibrations as runs show them, against closed forms; and `modes`,
// `forces` against them: a small form of `kurbel_bench agreement2`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "drivetrain/kinds.h"
#include "engine/matrices/linear_algebra.h"
#include "mechanisms/kinds/kinds.h"
#include "tests/agreement/agreement.h"
#include "tests/agreement/forced_vibration.h"
#include "tests/agreement/free_vibration.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/scenes.h"

namespace kurbel::agreement::vibrations_agreement_test {
namespace {

constexpr double pi = std::numbers::pi;

Scene vibration_scene(const std::string& name) {
  return test::scene_file("tests/agreement/vibrations/" + name + ".toml");
}
SettledRun settled(const Scene& scene) { return settle(scene, scene.effects); }

// Eigenvalues of vibrations, with Im > 0, by frequency.
std::vector<std::complex<double>> vibrations_of(const Eigen::MatrixXd& a) {
  std::vector<std::complex<double>> list;
  for (const std::complex<double>& value : eigenvalues(a))
    if (value.imag() > 0) list.push_back(value);
  std::sort(list.begin(), list.end(), [](auto u, auto v) { return u.imag() < v.imag(); });
  return list;
}
void expect_vibrations(const std::string& text, const Eigen::MatrixXd& a) {
  const FreeVibrations found = free_vibrations_of(settled(test::scene_from(text)));
  ASSERT_TRUE(found.measured) << found.why;
  const std::vector<std::complex<double>> exact = vibrations_of(a);
  ASSERT_EQ(found.list.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double allowed = 1e-6 * std::abs(exact[i]) + found.list[i].omega_error;
    EXPECT_NEAR(found.list[i].omega, exact[i].imag(), allowed);
    EXPECT_NEAR(found.list[i].decay, -exact[i].real(), allowed);
    EXPECT_LT(found.list[i].omega_error, 1e-4 * std::abs(exact[i]));
  }
}

// M = 60 (1 − ω/40) drives J = 0.5, a spring joins it to J = 0.6 with b = 1.25 N·m·s/rad.
std::string drive(const std::string& between, const std::string& line) {
  return R"(line = ["motor", )" + line + R"(, "drum"]
[motor]
kind = "dc shunt motor"
stall_torque = "60 N*m"
no_load_speed = "40 rad/s"
rated_torque = "20 N*m"
inertia = "0.5 kg*m2"
)" + between +
         R"(
[drum]
kind = "load"
damping = "1.25 N*m*s/rad"
inertia = "0.6 kg*m2"
[effects]
elasticity = true
[run]
start = "rest"
until = "10 s"
accuracy = 1e-6
)";
}
const char* const spring = R"([coupling]
kind = "coupling"
stiffness = "6 kN*m/rad"
damping = "3 N*m*s/rad"
)";

// --- free vibrations ---

TEST(FreeOscillation, OfTwoInertiasHasTheirEigenvalues) {
  Eigen::MatrixXd a(3, 3);                     // twist, speeds
  a << 0, 1, -1,                               //
      -6000 / 0.5, -(3 + 1.5) / 0.5, 3 / 0.5,  //
      6000 / 0.6, 3 / 0.6, -(3 + 1.25) / 0.6;
  expect_vibrations(drive(spring, R"("coupling")"), a);
}

// A branch k₁ in series with k₁ T₁ beside the spring: its torque is a state, τ̇₁ = k₁ θ̇ − τ₁/T₁.
TEST(FreeOscillation, OfRubberHasItsBranchAsAState) {
  Eigen::MatrixXd a(4, 4);                               // twist, branch, speeds
  a << 0, 0, 1, -1,                                      //
      0, -1 / 0.01, 3000, -3000,                         //
      -3000 / 0.5, -1 / 0.5, -(1 + 1.5) / 0.5, 1 / 0.5,  //
      3000 / 0.6, 1 / 0.6, 1 / 0.6, -(1 + 1.25) / 0.6;
  expect_vibrations(drive(R"([rubber]
kind = "rubber coupling"
stiffness = "3 kN*m/rad"
damping = "1 N*m*s/rad"
branches = [{ stiffness = "3 kN*m/rad", relaxation_time = "10 ms" }]
)",
                          R"("rubber")"),
                    a);
}

// A clutch that slips for good hands on 12 N·m whatever the speeds: the motor takes no part.
TEST(FreeOscillation, BehindAClutchThatSlipsIsThatOfWhatIsBehindIt) {
  Eigen::MatrixXd a(3, 3);
  a << 0, 1, -1,                       //
      -6000 / 0.2, -3 / 0.2, 3 / 0.2,  //
      6000 / 0.6, 3 / 0.6, -(3 + 1.25) / 0.6;
  expect_vibrations(drive(std::string(R"([clutch]
kind = "clutch"
torque = "12 N*m"
static_torque = "15 N*m"
inertia_out = "0.2 kg*m2"
)") + spring,
                          R"("clutch", "coupling")"),
                    a);
}

// A ring of 0.15 kg·m² on a film: neither locked to the drum nor free of it.
TEST(FreeOscillation, OfAViscousDamperHasItsRingAsABodyOfItsOwn) {
  for (const double film : {0.05, 2.2, 150.0}) {
    SCOPED_TRACE(film);
    Eigen::MatrixXd a(4, 4);                                        // twist, motor, drum, ring
    a << 0, 1, -1, 0,                                               //
        -6000 / 0.5, -(3 + 1.5) / 0.5, 3 / 0.5, 0,                  //
        6000 / 0.6, 3 / 0.6, -(3 + 1.25 + film) / 0.6, film / 0.6,  //
        0, 0, film / 0.15, -film / 0.15;
    expect_vibrations(drive(std::string(spring) + fmt::format(R"([damper]
kind = "viscous damper"
on = "drum"
ring_inertia = "0.15 kg*m2"
damping = "{} N*m*s/rad"
)",
                                                              film),
                            R"("coupling")"),
                      a);
  }
}

// The crank's inertia varies: the swing is a Floquet solution, and its decay over a turn that of one run beside another.
TEST(FreeOscillation, OfACrankIsWhatALongRingDownShows) {
  const Scene scene = vibration_scene("light_flywheel");
  const SettledRun run = settled(scene);
  const FreeVibrations found = free_vibrations_of(run);
  ASSERT_EQ(found.list.size(), 1u) << found.why;
  const double vibration = std::exp(-found.list[0].decay * run.period);
  const Decay slow = decay_of(run);  // the slower motion, of the speed as a whole
  ASSERT_TRUE(slow.measured);
  EXPECT_LT(vibration, slow.factor);
  EXPECT_NEAR(found.list[0].omega / (2 * pi), 26.956, 0.001);  // 26.468 by the mean of its inertia
}

// --- forced vibrations ---

// 5 sin(2π 11 t) N·m on the drum: the coupling's torque is (k + iωc) θ of the linear drive.
TEST(ForcedOscillation, OfASineIsTheComplexResponse) {
  const SettledRun run = settled(test::scene_from(drive(std::string(spring) + R"([shaker]
kind = "torque source"
on = "drum"
amplitude = "5 N*m"
frequency = "11 Hz"
)",
                                                        R"("coupling")")));
  const std::vector<JointVibration> vibrations = joint_vibrations_of(run, 4);
  ASSERT_EQ(vibrations.size(), 1u);
  using Complex = std::complex<double>;
  const Complex s(0, 2 * pi * 11), spring_torque = 6000.0 + 3.0 * s;
  Eigen::Matrix2cd dynamic;  // of the angles
  dynamic << 0.5 * s * s + 1.5 * s + spring_torque, -spring_torque, -spring_torque,
      0.6 * s * s + 1.25 * s + spring_torque;
  const Eigen::Vector2cd q = test::solved_complex(dynamic, Eigen::Vector2cd(0, 5));
  EXPECT_NEAR(std::abs(vibrations[0].harmonic[1]), std::abs(spring_torque * (q[0] - q[1])), 1e-5);
  EXPECT_NEAR(std::abs(vibrations[0].harmonic[2]), 0, 1e-6);
  EXPECT_NEAR(vibrations[0].mean, 60 * 1.25 / 2.75, 1e-5);
}

// --- the machines ---

// Kinds that join, drive, load or move: each vibrates, or is forced, in some machine of the matrix.
TEST(AgreementOfOscillations, EveryKindOccursInSomeMachine) {
  std::string all;
  for (const char* folder : {"scenes", "tests/agreement", "tests/agreement/vibrations"})
    for (const std::string& file : scene_files(test::source_path(folder))) {
      const Scene scene = read_scene(file, all_kinds());
      for (const Section& s : scene.components) {
        all += "|" + s.kind->name + "|";
        for (const Setting& setting : s.settings)
          for (const Section& nested : setting.sections)
            if (nested.kind && setting.key == "load") all += "|load " + nested.kind->name + "|";
      }
    }
  for (const auto& kinds : {drivetrain_kinds(), mechanism_kinds()})
    for (const Kind& kind : kinds) {
      EXPECT_NE(all.find("|" + kind.name + "|"), std::string::npos) << kind.name;
      for (const Key& key : kind.keys)
        if (key.nested && key.name == "load")
          for (const Kind& load : *key.nested) {
            const std::string name = "load " + load.name;
            EXPECT_NE(all.find("|" + name + "|"), std::string::npos) << name;
          }
    }
}

// --- verbs ---

void expect_agreement(const Row& row, const std::string& name) {
  EXPECT_NE(row.kind, Motion::none) << name << ": " << row.orbit;
  EXPECT_FALSE(row.figures.empty()) << name;
  std::string wrong;
  for (const Compared& c : row.figures)
    if (c.verdict == Verdict::silent)
      wrong += fmt::format("  {}: {}: run {:.9g}, told {:.9g}\n", name_of(c.topic), c.figure, c.run, c.study);
    else if (c.verdict == Verdict::refused)
      wrong += fmt::format("  {}: {}\n", name_of(c.topic), c.words);
  EXPECT_TRUE(wrong.empty()) << name << "\n" << wrong;
}

TEST(AgreementOfOscillations, ModesSpeakOfDrivesWhoseInertiaIsConstant) {
  for (const char* name : {"backlash_closed", "limiter_holds", "one_way_clutch_drives", "brake_drags_shaft"})
    expect_agreement(compare_modes(vibration_scene(name)), name);
}
// Locked, a belt that slips vibrated at 18.0 Hz for 42.1, a clutch at 15.3 for 22.5, a damper of 0.05 and of 150
// N·m·s/rad alike; rubber without its branches had ζ 0.280 for 0.180.
TEST(AgreementOfOscillations, ModesSpeakOfWhatSlipsAndOfWhatRelaxes) {
  for (const char* name : {"belt_slips", "clutch_slips", "damper_loose", "damper_tuned", "damper_tight",
                           "fluid_coupling_shaft", "rubber_stiff_branch", "one_way_clutch_overruns"})
    expect_agreement(compare_modes(vibration_scene(name)), name);
}
// A universal joint's order 2 was 0 for 21 N·m; these gears were refused.
TEST(AgreementOfOscillations, ModesSpeakOfUniversalJointsAndOfGearsThatTieShafts) {
  for (const char* name : {"hooke_joint_crank", "housing_support_fan", "planetary_free"})
    expect_agreement(compare_modes(vibration_scene(name)), name);
}
TEST(AgreementOfOscillations, ForcesSpeakOfTheTorqueThatTheCouplingHandsOn) {
  for (const char* name : {"light_flywheel"}) expect_agreement(compare_forces(vibration_scene(name)), name);
}

}  // namespace
}  // namespace kurbel::agreement::vibrations_agreement_test
