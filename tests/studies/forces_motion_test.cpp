// forces_motion_test.cpp — the second problem's motion is the one that the machine keeps: against long runs, against the
// torque in the machine's own equations, and against what is left to come where nothing is kept.
#include "studies/forces/machine_motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/forces/crank_motion.h"
#include "studies/forces/forces_findings.h"
#include "studies/forces/forces_plots.h"
#include "studies/forces/linkage_cycle.h"
#include "studies/steady/steady.h"
#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel::forces_motion_test {
namespace {

constexpr double same_physics = 1e-10;  // of the largest torque: what tables of the mechanism leave

// Reactions and crank torque of the steady motion are those of a long settled run, within their errors: friction of bearings,
// losses of gears, currents, elastic shafts, slipping brakes, and a rod that bends.
TEST(ForcesOfTheSteadyMotion, AreThoseOfALongSettledRun) {
  for (const char* name : {"exact_bearing", "dc_with_current", "slender_rod_small", "vibrations/drag_and_bearing",
                           "vibrations/worm_losses_shaft", "vibrations/two_axis_motor_shaft"}) {
    const agreement::Row row =
        agreement::compare_forces(test::scene_file(fmt::format("tests/agreement/{}.toml", name)));
    ASSERT_FALSE(row.figures.empty()) << name << ": " << row.orbit;
    for (const agreement::Compared& c : row.figures)
      EXPECT_EQ(c.verdict, agreement::Verdict::agrees)
          << name << ", " << c.figure << ": run " << c.run << ", study " << c.study << " ± " << c.allowed << c.words;
  }
}

// The steady motion does not know for how long the scene would have run.
TEST(ForcesOfTheSteadyMotion, DoNotDependOnTheLengthOfTheRun) {
  Scene scene = test::scene_file("tests/agreement/exact_bearing.toml");
  const Forces a = find_forces(scene, {});
  scene.run.until = 0.01;
  const Forces b = find_forces(scene, {});
  ASSERT_TRUE(a.simulated && b.simulated);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(a.simulated->reaction(k).value, b.simulated->reaction(k).value);
  EXPECT_TRUE(a.notes.empty());
}

// Least and greatest speed are those of the motion, not of the samples: of ω = 30 + sin(φ − φ₀) rad/s,
// whose top no sample meets.
TEST(SpeedRange, IsThatOfTheMotionBetweenSamples) {
  constexpr double mean = 30, swing = 1;
  for (const double phase : {0.0, 0.003, 1.0})
    for (const double sense : {1.0, -1.0}) {
      std::vector<MotionSample> samples;
      for (int i = 0; i <= 720; ++i) {
        const double phi = 2 * std::numbers::pi * i / 720, omega = mean + swing * std::sin(phi - phase);
        samples.push_back({phi, {sense * omega, omega * swing * std::cos(phi - phase)}});
      }
      const auto [least, greatest] = speed_range(samples);
      EXPECT_NEAR(least.value, sense * mean - swing, 1e-11) << phase << ", " << sense;
      EXPECT_NEAR(greatest.value, sense * mean + swing, 1e-11) << phase << ", " << sense;
      EXPECT_LE(std::abs(greatest.value - sense * mean - swing), greatest.error.value());
    }
}

// And they are those of the steady cycle, within both errors; so are the works of the loads, where a joint with clearance
// moves otherwise than the ideal one that forces are found for.
TEST(ForcesOfTheSteadyMotion, HaveTheSpeedsAndWorksOfTheSteadyCycle) {
  const auto expect_steady = [](const std::string& name, const ForceCycle& forces, const std::string& link) {
    const Scene scene = test::scene_file(name);
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    ASSERT_TRUE(study.cycles.size() == 1 && study.cycles[0].found) << name;
    const auto expect = [&](const std::string& figure, const Estimate& here) {
      const Figure* there = study.cycles[0].find(figure);
      ASSERT_NE(there, nullptr) << name << ": " << figure;
      EXPECT_LE(std::abs(here.value - there->value),
                here.error.value() + there->error.value() + 1e-10 * std::abs(there->value))
          << name << ": " << figure << ' ' << here.value << " ± " << *here.error << ", steady " << there->value;
    };
    expect("cycle_min_speed." + link, forces.least_speed);
    expect("cycle_max_speed." + link, forces.greatest_speed);
    for (const CycleWork& w : forces.work)
      if (w.name == link + ".load") expect("work_per_cycle." + w.name + " (" + w.kind + ")", w.work);
  };
  for (const auto& [name, link] :
       {std::pair("scenes/piston_pump.toml", "plunger1"), std::pair("scenes/steam_engine.toml", "engine"),
        std::pair("tests/agreement/worn_pin_small.toml", "crank"), std::pair("scenes/shaper.toml", "shaper"),
        std::pair("scenes/four_bar_rocker.toml", "rocker")})
    expect_steady(name, *find_forces(test::scene_file(name), {}).simulated, link);
}

// A soft shaft lets the slider's weight turn the crank back, between two of the positions: it passes some angles three
// times. With a little less weight it passes each once.
TEST(ForcesOfTheSteadyMotion, OfACrankThatTurnsBackAreNone) {
  const auto forces = [](const std::string& mass) {
    return find_forces(test::scene_from(R"(
      line = ["drive", "soft", "crank"]
      drive = { kind = "prescribed speed", speed = "10 rad/s" }
      soft = { kind = "coupling", stiffness = "8 N*m/rad", damping_ratio = 0.1 }
      crank = { kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_inertia = "0.03 kg*m2", gravity = "9.81 m/s2", stroke_angle = "90 deg", slider_mass = ")" +
                                        mass + R"(" }
      effects = { elasticity = true }
      run = { start = { speed = "10 rad/s" }, until = "10 s" }
    )"),
                       {});
  };
  EXPECT_TRUE(forces("3.05 kg").simulated);
  for (const char* mass : {"3.06 kg", "3.2 kg", "4 kg"}) {
    const Forces f = forces(mass);
    EXPECT_FALSE(f.simulated) << mass;
    EXPECT_TRUE(
        std::any_of(f.notes.begin(), f.notes.end(),
                    [](const std::string& note) { return note.find("stops or turns back") != std::string::npos; }))
        << mass << fmt::format(": {}", fmt::join(f.notes, "\n"));
  }
}

// Behind an elastic machine's curves stand those of the rigid one: what the study says of it alone, to the last bit.
TEST(ForcesOfTheSteadyMotion, OfTheRigidMachineStandBehind) {
  const Scene scene = test::scene_file("tests/agreement/vibrations/worm_losses_shaft.toml");
  ForcesOptions options;
  options.rigid_behind = true;
  const Forces f = find_forces(scene, options);
  ASSERT_TRUE(f.elastic && f.rigid);
  options.effects = without_elasticity(scene.effects);
  const Forces alone = find_forces(scene, options);
  ASSERT_TRUE(alone.simulated);
  EXPECT_FALSE(alone.elastic || alone.rigid);
  EXPECT_EQ(f.rigid->torque.value, alone.simulated->torque.value);
  EXPECT_NE(f.rigid->torque.value, f.simulated->torque.value);
  const Plot torque = torque_plot(f), of_rigid = torque_plot(alone);
  ASSERT_EQ(torque.series.size(), 3u);
  EXPECT_EQ(torque.series[0].role, Role::rigid);
  EXPECT_EQ(torque.series[1].role, Role::reference);
  EXPECT_EQ(torque.series[2].role, Role::elastic);
  EXPECT_EQ(torque.series[0].y, of_rigid.series[1].y);
  EXPECT_EQ(of_rigid.series[1].role, Role::rigid);
}

// M of the links' equilibrium, friction of the joints included, and I ε − Q of the compiled machine are one torque: the
// simulated crank moves with the friction that its reactions have.
TEST(CompiledMachine, TurnsTheCrankWithTheTorqueThatItsLinksNeed) {
  for (const char* name : {"joint_friction_rigid", "joint_friction_crank", "compressor", "light_flywheel"}) {
    const std::string folder = std::string(name) == "compressor"       ? "scenes"
                               : std::string(name) == "light_flywheel" ? "tests/agreement/vibrations"
                                                                       : "tests/agreement";
    const Forces f = find_forces(test::scene_file(fmt::format("{}/{}.toml", folder, name)), {});
    ASSERT_TRUE(f.simulated && f.simulated->machine_residual) << name;
    EXPECT_LT(*f.simulated->machine_residual, same_physics) << name;
    EXPECT_NEAR(f.simulated->closure.value, 0, 1e-9) << name;
  }
  for (const char* name : {"four_bar_small", "knuckle_small", "whitworth_small"}) {
    const Forces f = find_forces(test::scene_file(fmt::format("tests/agreement/{}.toml", name)), {});
    ASSERT_TRUE(f.simulated && f.simulated->machine_residual) << name;
    EXPECT_LT(*f.simulated->machine_residual, same_physics) << name;
    EXPECT_NEAR(f.simulated->closure.value, 0, 1e-9) << name;
  }
}

// A rod that bends counts as rigid: stated with its size, and the error holds the torque that the machine really takes.
TEST(CompiledMachine, ReportsWhatABendingRodChanges) {
  const Forces f = find_forces(test::scene_file("tests/agreement/slender_rod_small.toml"), {});
  ASSERT_TRUE(f.simulated);
  ASSERT_EQ(f.notes.size(), 1U);
  EXPECT_NE(f.notes[0].find("counts as rigid links in ideal joints"), std::string::npos) << f.notes[0];
  EXPECT_GT(*f.simulated->machine_residual, 1e-3);
  EXPECT_GE(*f.simulated->torque.error, *f.simulated->machine_residual * std::abs(f.simulated->torque.value) * 0.9);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_GT(*f.simulated->reaction(k).error, 1e-4 * std::abs(f.simulated->reaction(k).value));
}

const char* const coasting = R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.5 kg*m2"
slider_mass = "3 kg"
load = {{ kind = "medium", viscous = "20 N*s/m" }}
[run]
start = {{ speed = "30 rad/s" }}
until = "{} s"
accuracy = 1e-9
)";

// A press that makes a stroke each 2 s turns at 30 rpm on average, though it stands in none of its positions.
TEST(ForcesOfTheSteadyMotion, CountTheTimeThatStrokesAreApart) {
  const Forces f = find_forces(test::scene_from(R"(
    line = ["motor", "gear", "wheel", "clutch", "press"]
    motor = { kind = "dc shunt motor", stall_torque = "120 N*m", no_load_speed = "1000 rpm", inertia = "0.05 kg*m2" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 120], inertia = ["0.001 kg*m2", "0.3 kg*m2"] }] }
    wheel = { kind = "flywheel", inertia = "60 kg*m2" }
    clutch = { kind = "clutch", torque = "2500 N*m", static_torque = "2800 N*m" }
    press = { kind = "slider-crank", radius = "50 mm", rod = "300 mm", crank_inertia = "2 kg*m2", slider_mass = "120 kg" }
    brake = { kind = "brake", on = "press", torque = "900 N*m" }
    sequence = { every = "2 s", steps = [{ at = "0 s", set = ["brake"], to = 0 }, { at = "0.02 s", set = ["clutch"], to = 1, over = "40 ms" }, { angle = "140 deg", of = "press", set = ["clutch"], to = 0 }, { angle = "150 deg", of = "press", set = ["brake"], to = 1 }] }
    run = { start = { angle = "180 deg", wheel = { speed = "160 rpm" } }, until = "10 s" }
  )"),
                               {});
  ASSERT_TRUE(f.simulated);
  EXPECT_NEAR(f.simulated->mean_speed.value, std::numbers::pi, 0.02);
}

// What coasts keeps no motion: the cycle before and the ones to come lie within the errors of the one that is shown.
TEST(ForcesWithoutASteadyMotion, HaveAnErrorThatHoldsTheNextCycle) {
  const Forces now = find_forces(test::scene_from(fmt::format(fmt::runtime(coasting), 1.2)), {}),
               later = find_forces(test::scene_from(fmt::format(fmt::runtime(coasting), 1.5)), {});
  ASSERT_TRUE(now.simulated && later.simulated);
  ASSERT_FALSE(now.notes.empty());
  EXPECT_NE(now.notes[0].find("counted as an error of every figure"), std::string::npos) << now.notes[0];
  EXPECT_NE(output_of(now).conclusion().find(
                fmt::format("the motion is not steady: over this cycle the crank's speed changes by {:+.2g} %",
                            100 * now.simulated->closure.value)),
            std::string::npos)
      << output_of(now).conclusion();
  const ForceCycle &a = *now.simulated, &b = *later.simulated;
  ASSERT_GT(a.mean_speed.value - b.mean_speed.value, 0.01);
  EXPECT_LE(a.mean_speed.value - b.mean_speed.value, *a.mean_speed.error);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LE(std::abs(a.reaction(k).value - b.reaction(k).value), *a.reaction(k).error) << k;
  EXPECT_LE(std::abs(a.shaking_force.value - b.shaking_force.value), *a.shaking_force.error);
  double work = 0;  // is what the mechanism loses
  for (const CycleWork& w : a.work) work += w.work.value;
  EXPECT_LT(a.kinetic_change.value, -1e-3);
  EXPECT_NEAR(work, a.kinetic_change.value, -1e-6 * a.kinetic_change.value);
}

// Two cranks, one at twice the speed: the machine repeats after two cycles of the fast one, which its peaks know.
TEST(ForcesOfTheSteadyMotion, GoOnUntilTheWholeMachineRepeats) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "fast", "gear", "slow"]
[motor]
kind = "dc shunt motor"
stall_torque = "100 N*m"
no_load_speed = "40 rad/s"
inertia = "0.3 kg*m2"
[fast]
kind = "slider-crank"
radius = "60 mm"
rod = "200 mm"
crank_inertia = "0.05 kg*m2"
slider_mass = "2 kg"
[gear]
kind = "gearbox"
stages = [{ teeth = [20, 40] }]
[slow]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.2 kg*m2"
slider_mass = "6 kg"
load = { kind = "medium", viscous = "300 N*s/m" }
[run]
start = { speed = "30 rad/s" }
until = "1 s"
)");
  ForcesOptions options;
  options.mechanism = "fast";
  const Forces fast = find_forces(scene, options);
  options.mechanism = "slow";
  const Forces slow = find_forces(scene, options);
  ASSERT_TRUE(fast.simulated && slow.simulated);
  EXPECT_NEAR(fast.simulated->cycle, 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(slow.simulated->cycle, 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(fast.simulated->mean_speed.value, 2 * slow.simulated->mean_speed.value,
              1e-9 * fast.simulated->mean_speed.value);
  EXPECT_LT(*fast.simulated->machine_residual, same_physics);
  EXPECT_EQ(fast.simulated->rows.size(), 13U);  // of one cycle
  EXPECT_EQ(fast.simulated->positions.size(), 1441U);
}

// Two like throws at 180° on one shaft: all that the shaft feels has the period of half a turn, so that at the same angle of
// its own crank each throw has the reactions of the other.
TEST(ForcesOfTheSteadyMotion, ThrowsOnOneShaftAreAskedForEach) {
  std::string text = R"(
line = ["motor", "left", "right"]
[motor]
kind = "dc shunt motor"
stall_torque = "100 N*m"
no_load_speed = "40 rad/s"
inertia = "0.3 kg*m2"
[run]
start = { speed = "30 rad/s" }
until = "1 s"
)";
  for (const auto& [name, phase] : {std::pair("left", 0), std::pair("right", 180)})
    text += fmt::format(R"(
[{}]
kind = "slider-crank"
radius = "60 mm"
rod = "200 mm"
crank_inertia = "0.05 kg*m2"
rod_mass = "1 kg"
rod_inertia = "0.01 kg*m2"
slider_mass = "2 kg"
phase = "{} deg"
load = {{ kind = "medium", viscous = "300 N*s/m" }}
)",
                        name, phase);
  const Scene scene = test::scene_from(text);
  ForcesOptions left, right;
  left.mechanism = "left", right.mechanism = "right";
  const Forces a = find_forces(scene, left), b = find_forces(scene, right);
  ASSERT_TRUE(a.simulated && b.simulated);
  ASSERT_EQ(a.simulated->reactions.size(), b.simulated->reactions.size());
  for (std::size_t k = 0; k < a.simulated->reactions.size(); ++k)
    EXPECT_NEAR(b.simulated->reactions[k].peak.value, a.simulated->reactions[k].peak.value,
                1e-6 * std::abs(a.simulated->reactions[k].peak.value))
        << a.simulated->reactions[k].name;
}

// --positions chooses rows of a table and nothing else, in the simulated motion of every mechanism.
TEST(ForcesOfTheSteadyMotion, HavePeaksThatNoPositionsMove) {
  for (const char* name : {"four_bar_small", "knuckle_small", "whitworth_small"}) {
    const Scene scene = test::scene_file(fmt::format("tests/agreement/{}.toml", name));
    ForcesOptions coarse, fine;
    coarse.positions = 5, fine.positions = 77;
    const ForceCycle a = *find_forces(scene, coarse).simulated, b = *find_forces(scene, fine).simulated;
    for (std::size_t k = 0; k < a.reactions.size(); ++k) {
      EXPECT_EQ(a.reactions[k].peak.value, b.reactions[k].peak.value) << name << a.reactions[k].name;
      EXPECT_EQ(a.reactions[k].peak.error, b.reactions[k].peak.error) << name;
    }
    EXPECT_EQ(a.torque.value, b.torque.value) << name;
  }
}

// What the frame does to the links, by the columns "of frame on …", is what the masses need beyond weight and load, which
// no speed changes: minus the shaking force. So senses and axes are those that the headers name.
TEST(ForcesInALinkage, PushTheWayThatTheirColumnsName) {
  ForcesOptions options;
  options.simulate = false;
  for (const char* name : {"four_bar_small", "knuckle_small", "whitworth_small"}) {
    const Scene scene = test::scene_file(fmt::format("tests/agreement/{}.toml", name));
    options.speed = 20;
    const Forces slow = find_forces(scene, options);
    options.speed = 40;
    const Forces fast = find_forces(scene, options);
    const std::string csv = csv_text(findings_of(fast).tables[0].table()), header = csv.substr(0, csv.find('\n'));
    const auto left = [](const PositionForces& p) {
      Force2 sum = p.forces.shaking_force;
      for (const JointForces& j : p.forces.joints)
        if (std::string(j.from) == "frame") sum = sum + j.force;
      return sum;
    };
    for (std::size_t i = 0; i < fast.prescribed->positions.size(); ++i) {
      const Force2 open = left(fast.prescribed->positions[i]) - left(slow.prescribed->positions[i]);
      EXPECT_NEAR(open.magnitude(), 0, 1e-9 * fast.prescribed->shaking_force.value) << name << " " << i;
    }
    int bearings = 0;
    for (const JointForces& j : fast.prescribed->positions.front().forces.joints) {
      std::string column = fmt::format("{} of {} on {}", j.name, j.from, j.on);
      for (char& c : column)
        if (c == ' ' || c == ',') c = '_';
      EXPECT_NE(header.find(column + "_x [N]"), std::string::npos) << column << " in " << header;
      bearings += std::string(j.from) == "frame" ? 1 : 0;
    }
    EXPECT_GE(bearings, 2) << name;
  }
}

}  // namespace
}  // namespace kurbel::forces_motion_test
