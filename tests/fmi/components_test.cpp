// components_test.cpp — exported components, by an importer that shares no code with what exports them: what they say of
// themselves, how they move against `kurbel run`, what of them is kept and restored.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>
#include <thread>

#include "tests/fmi/exported.h"

namespace components_test {
namespace {

using namespace exported_components;

class Components : public testing::TestWithParam<std::tuple<Machine, int>> {
 protected:
  Machine machine() const { return std::get<0>(GetParam()); }
  int fmi() const { return std::get<1>(GetParam()); }
};
std::string name_of(const testing::TestParamInfo<std::tuple<Machine, int>>& info) {
  return std::string(std::get<0>(info.param).scene) + "_fmi" + std::to_string(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Scenes, Components, testing::Combine(testing::ValuesIn(machines), testing::Values(2, 3)),
                         name_of);

// Largest difference of a column over its largest magnitude, at all rows.
struct Difference {
  double largest = 0;
  std::string of;
};
Difference difference(const Trajectory& expected, const std::vector<std::vector<double>>& rows) {
  Difference all;
  for (std::size_t c = 1; c < expected.names.size(); ++c) {
    double scale = 0, apart = 0;
    for (std::size_t r = 0; r < expected.rows.size(); ++r) {
      scale = std::max(scale, std::abs(expected.rows[r][c]));
      apart = std::max(apart, std::abs(expected.rows[r][c] - rows[r][c]));
    }
    if (scale > 0 && apart / scale > all.largest) all = {apart / scale, expected.names[c]};
  }
  return all;
}
std::vector<double> row(Slave& slave, const Trajectory& t, double time) {
  std::vector<double> values = {time};
  for (std::size_t c = 1; c < t.names.size(); ++c) values.push_back(slave[t.names[c]]);
  return values;
}

// What the scenes state of their errors: the strictest of them.
constexpr double stated = 1e-6;

TEST_P(Components, SaysTheTruthOfItself) {
  const auto unpacked = exported(scene(machine().scene), fmi());
  EXPECT_EQ(unpacked->complaints, std::vector<std::string>());
  EXPECT_EQ(unpacked->fmi, fmi());
  const Library library(unpacked->library());
  for (const std::string& function : functions_of(fmi())) EXPECT_TRUE(library.find(function)) << function;
#ifdef KURBEL_AS_RELEASED
  EXPECT_LE(fs::file_size(unpacked->library()), 3'000'000u);
  std::istringstream needs(command("readelf -d " + unpacked->library()));
  for (std::string line; std::getline(needs, line);)
    if (line.find("NEEDED") != std::string::npos) {
      EXPECT_TRUE(line.find("libc.so") != std::string::npos || line.find("libm.so") != std::string::npos ||
                  line.find("libstdc++.so") != std::string::npos || line.find("libgcc_s.so") != std::string::npos ||
                  line.find("ld-linux") != std::string::npos)
          << line;
    }
#endif
}

TEST_P(Components, StepsAsARunDoes) {
  const Trajectory& expected = run(scene(machine().scene), machine().until);
  const auto unpacked = exported(scene(machine().scene), fmi());
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::co_simulation);
  slave.initialise(0);
  std::vector<std::vector<double>> rows;
  double t = 0;
  for (const auto& at : expected.rows) {
    if (at[0] > t) t = slave.step(t, at[0] - t);
    rows.push_back(row(slave, expected, at[0]));
  }
  const Difference apart = difference(expected, rows);
  RecordProperty("difference", std::to_string(apart.largest));
  std::printf("    %s: %.2g of %s\n", machine().scene, apart.largest, apart.of.c_str());
  EXPECT_LT(apart.largest, stated) << apart.of;
}

TEST_P(Components, IsIntegratedByOthersAsARunIs) {
  const Trajectory& expected = run(scene(machine().scene), machine().until);
  const auto unpacked = exported(scene(machine().scene), fmi());
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::model_exchange);
  slave.initialise(0);
  std::vector<double> times;
  for (const auto& at : expected.rows) times.push_back(at[0]);
  std::vector<std::vector<double>> rows;
  integrate(slave, 0, times, 1e-8, [&](std::size_t k) { rows.push_back(row(slave, expected, times[k])); });
  const Difference apart = difference(expected, rows);
  std::printf("    %s: %.2g of %s\n", machine().scene, apart.largest, apart.of.c_str());
  EXPECT_LT(apart.largest, stated) << apart.of;
}

TEST_P(Components, GoesOnFromAKeptStateToTheLastBit) {
  const auto unpacked = exported(scene(machine().scene), fmi());
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::co_simulation), other(*unpacked, library, Kind::co_simulation, "other");
  slave.initialise(0), other.initialise(0);
  std::mt19937 random(20);
  std::uniform_real_distribution<double> part(0.01, 0.2);
  double t = 0;
  for (int k = 0; k < 3; ++k) {
    t = slave.step(t, machine().until * part(random));
    void* const kept = slave.keep();
    const double h = machine().until * part(random);
    slave.step(t, h);
    std::vector<double> first;
    for (const Variable& v : unpacked->variables) first.push_back(slave.get(v.reference));
    slave.restore(kept);
    void* const elsewhere = other.deserialise(slave.serialise(kept));
    other.restore(elsewhere);
    slave.step(t, h), other.step(t, h);
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(slave.get(unpacked->variables[i].reference), first[i]) << unpacked->variables[i].name;
      EXPECT_EQ(other.get(unpacked->variables[i].reference), first[i]) << unpacked->variables[i].name;
    }
    t += h;
    slave.free_state(kept), other.free_state(elsewhere);
  }
}

// Fourth-order differences of some values over a state.
std::vector<double> slopes(Slave& slave, const std::vector<double>& x, std::size_t j, double h,
                           const std::function<std::vector<double>()>& values) {
  std::vector<std::vector<double>> at;
  for (const double by : {-2.0, -1.0, 1.0, 2.0}) {
    std::vector<double> moved = x;
    moved[j] += by * h;
    slave.states(moved);
    at.push_back(values());
  }
  slave.states(x);
  std::vector<double> slope(at[0].size());
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = (at[0][i] - 8 * at[1][i] + 8 * at[2][i] - at[3][i]) / (12 * h);
  return slope;
}

// ∂ẋ/∂x and ∂y/∂x by the component against differences of its own rates; and where no dependency is said, there is none.
TEST_P(Components, KnowsItsDerivatives) {
  const auto unpacked = exported(scene(machine().scene), fmi());
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::model_exchange);
  slave.initialise(0);
  std::vector<double> times = {0.37 * machine().until};
  integrate(slave, 0, times, 1e-7, [](std::size_t) {});
  const std::vector<double> x = slave.states(), nominal = slave.nominals(), rates = slave.rates();
  const auto outputs = [&] {
    std::vector<double> values;
    for (const unsigned output : unpacked->outputs) values.push_back(slave.get(output));
    return values;
  };
  const std::vector<double> shown = outputs();
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double h = 1e-5 * nominal[j];
    const std::vector<double> slope = slopes(slave, x, j, h, [&] { return slave.rates(); });
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double found = slave.directional(unpacked->derivatives[i], unpacked->states[j]);
      const double size = std::abs(found) + 1e-5 * (std::abs(rates[i]) + nominal[i]) / nominal[j];
      EXPECT_NEAR(found, slope[i], 2e-5 * size) << i << " by " << j;
      const auto& on = unpacked->dependencies.at(unpacked->derivatives[i]);
      if (std::find(on.begin(), on.end(), unpacked->states[j]) == on.end()) {
        EXPECT_EQ(found, 0) << "no dependency is said: " << i << " on " << j;
      }
    }
    const std::vector<double> of_outputs = slopes(slave, x, j, h, outputs);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const double found = slave.directional(unpacked->outputs[i], unpacked->states[j]);
      const double size = std::abs(found) + 1e-5 * std::abs(shown[i]) / nominal[j];
      EXPECT_NEAR(found, of_outputs[i], 2e-5 * size) << unpacked->variables[unpacked->outputs[i]].name << " by " << j;
    }
  }
}

// A brake on a wheel that a spring with a damper drives: τ = k θ + d (ω_a − ω_b), J ω̇_b = τ − c M.
TEST(Derivatives, AreThoseOfTheClosedForms) {
  const Folder folder;
  const std::string file = written(folder, R"(
title = "Braked wheel"
line = ["rotor", "spring", "wheel"]
[rotor]
kind = "flywheel"
inertia = "3 kg*m2"
[spring]
kind = "coupling"
stiffness = "700 N*m/rad"
damping = "0.3 N*m*s/rad"
[wheel]
kind = "flywheel"
inertia = "5 kg*m2"
[brake]
kind = "brake"
torque = "44 N*m"
[[branch]]
from = "wheel"
line = ["brake"]
[effects]
elasticity = ["spring"]
[run]
start = { speed = "10 rad/s" }
until = "1 s"
accuracy = 1e-8
)");
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi, "--input brake.command --input wheel.torque");
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::co_simulation);
    slave.set("brake.command", 0.7);
    slave.initialise(0);
    slave.step(0, 0.1);
    const auto by = [&](const std::string& unknown, const std::string& known) {
      return slave.directional((*unpacked)[unknown].reference, (*unpacked)[known].reference);
    };
    const std::string a = "state: speed of rotor", b = "state: speed of spring.out", twist = "state: twist of spring";
    EXPECT_EQ(by("torque.spring", twist), 700);
    EXPECT_EQ(by("torque.spring", a), 0.3);
    EXPECT_EQ(by("torque.spring", b), -0.3);
    EXPECT_EQ(by("twist.spring", twist), 1);
    EXPECT_EQ(by("speed.wheel", b), 1);
    EXPECT_EQ(by("speed.wheel", twist), 0);
    EXPECT_NEAR(by("spring_torque.spring", twist), 700, 1e-9 * 700);  // of those by differences
    EXPECT_NEAR(by("derivative: speed of spring.out", "brake.command"), -44.0 / 5, 1e-12 * 44 / 5);
    EXPECT_NEAR(by("torque.brake", "brake.command"), -44, 1e-12 * 44);
    EXPECT_EQ(by("torque.spring", "brake.command"), 0);
    EXPECT_NEAR(by("derivative: speed of spring.out", "wheel.torque"), 1.0 / 5, 1e-12 / 5);
    if (fmi == 3) {
      const std::vector<unsigned> both = {(*unpacked)["derivative: speed of spring.out"].reference,
                                          (*unpacked)["torque.spring"].reference};
      EXPECT_NEAR(slave.adjoint(both, {2, 3}, (*unpacked)[twist].reference), 2 * 700.0 / 5 + 3 * 700, 1e-12 * 2380);
    }
    const double speed = slave["speed.wheel"];
    EXPECT_THROW(slave.directional(100000, unpacked->states[0]), std::runtime_error);
    EXPECT_EQ(slave["speed.wheel"], speed);
  }
}

const char* const shaft_alone = R"(
title = "Flywheel"
line = ["brakeless", "wheel"]
[brakeless]
kind = "flywheel"
inertia = "3 kg*m2"
[wheel]
kind = "flywheel"
inertia = "5 kg*m2"
[drag]
kind = "bearing drag"
on = "wheel"
damping = "0.5 N*m*s/rad"
[run]
start = { speed = "10 rad/s" }
until = "4 s"
accuracy = 1e-8
)";

// (I₁ + I₂) ω̇ = M − b ω: ω = M/b + (ω₀ − M/b) exp(−b t/I)
TEST(Inputs, ATorqueTurnsAWheelAsItsClosedFormSays) {
  const Folder folder;
  const std::string file = written(folder, shaft_alone);
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi, "--input wheel.torque --parameter wheel.inertia --output speed.wheel");
    EXPECT_EQ(unpacked->complaints, std::vector<std::string>());
    const Library library(unpacked->library());
    for (const double inertia : {5.0, 13.0}) {
      Slave slave(*unpacked, library, Kind::co_simulation);
      slave.set("wheel.inertia", inertia);
      slave.set("wheel.torque", 8);
      slave.initialise(0);
      double t = 0, omega = 10;
      for (const double torque : {8.0, -20.0, 0.0}) {
        slave.set("wheel.torque", torque);
        t = slave.step(t, 0.7);
        omega = torque / 0.5 + (omega - torque / 0.5) * std::exp(-0.5 * 0.7 / (3 + inertia));
        EXPECT_NEAR(slave["speed.wheel"], omega, 1e-9 * 10);
      }
      // ∂ω̇/∂M = 1/I, ∂ω̇/∂ω = −b/I
      EXPECT_NEAR(slave.directional(unpacked->derivatives.back(), (*unpacked)["wheel.torque"].reference),
                  1 / (3 + inertia), 1e-13);
      EXPECT_NEAR(slave.directional(unpacked->derivatives.back(), unpacked->states.back()), -0.5 / (3 + inertia),
                  1e-12);
    }
  }
}

// A parallelogram's rocker turns as its crank does, whole turns included.
TEST(Outputs, AnOutputThatRotatesCountsItsTurns) {
  const Folder folder;
  const std::string file = written(folder, R"(
title = "Parallelogram"
line = ["wheel", "bars"]
wheel = { kind = "flywheel", inertia = "3 kg*m2" }
[bars]
kind = "four-bar"
crank = "100 mm"
coupler = "300 mm"
rocker = "100 mm"
ground = "300 mm"
rocker_inertia = "0.1 kg*m2"
[run]
start = { speed = "60 rpm" }
until = "11 s"
)");
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::co_simulation);
    slave.initialise(0);
    for (double t = 0; t < 10;) {
      t = slave.step(t, 0.7);
      EXPECT_NEAR(slave["position.bars"], 2 * std::numbers::pi * t, 1e-9);
    }
  }
}

TEST(Inputs, ACommandFromOutsideIsThatOfTheSequence) {
  const Folder folder;
  const auto without = exported(written(folder, without_sequence("planetary_brake")), 3, "--input brake.command");
  const auto with = exported(scene("planetary_brake"), 3);
  const Library library(without->library()), sequence(with->library());
  Slave own(*with, sequence, Kind::co_simulation), set(*without, library, Kind::co_simulation);
  set.set("brake.command", 0);
  own.initialise(0), set.initialise(0);
  own.step(0, 0.4), set.step(0, 0.4);
  for (const Variable& v : with->variables)
    if (v.causality == "output") {
      EXPECT_NEAR(set[v.name], own.get(v.reference), 1e-6 * (1 + std::abs(set[v.name])));
    }
}

TEST(Steps, AnOnlookerSeesThemAndEndsThem) {
  const auto unpacked = exported(scene("gear_pair"), 3);
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::co_simulation), straight(*unpacked, library, Kind::co_simulation);
  slave.initialise(0), straight.initialise(0);
  int seen = 0;
  double speed = 0;
  slave.onlooker = [&](double t) {
    ++seen;
    speed = slave["speed.motor"];
    return t < 0.01;
  };
  const double reached = slave.step(0, 0.1);
  EXPECT_GT(seen, 3);
  EXPECT_GE(reached, 0.01);
  EXPECT_LT(reached, 0.1);
  EXPECT_NEAR(slave["speed.motor"], speed, 1e-6 * speed);
  straight.step(0, reached);
  EXPECT_NEAR(straight["speed.motor"], slave["speed.motor"], 1e-12 * speed);
}

TEST(Steps, PeaksAreLocatedBetweenCommunicationPoints) {
  const auto unpacked = exported(scene("gear_pair"), 3, "--kind cs --output peak_torque.shaft --output torque.shaft");
  const Library library(unpacked->library());
  Slave whole(*unpacked, library, Kind::co_simulation), fine(*unpacked, library, Kind::co_simulation);
  whole.initialise(0), fine.initialise(0);
  whole.step(0, 0.05);
  double greatest = 0, t = 0;
  while (t < 0.05 - 1e-9) {
    t = fine.step(t, 1e-4);
    if (std::abs(fine["torque.shaft"]) > std::abs(greatest)) greatest = fine["torque.shaft"];
  }
  EXPECT_GE(std::abs(whole["peak_torque.shaft"]), std::abs(greatest) * (1 - 1e-7));
  EXPECT_NEAR(whole["peak_torque.shaft"], greatest, 0.02 * std::abs(greatest));
}

TEST(Instances, AreIndependentInThreads) {
  const auto unpacked = exported(scene("planetary_brake"), 3);
  const Library library(unpacked->library());
  const auto figures = [&](double h) {
    Slave slave(*unpacked, library, Kind::co_simulation);
    slave.initialise(0);
    std::vector<double> values;
    double t = 0;
    for (int k = 0; k < 20; ++k) t = slave.step(t, h), values.push_back(slave["torque.shaft"]);
    return values;
  };
  const auto alone = figures(0.02), other_alone = figures(0.03);
  std::vector<double> one, other;
  std::thread first([&] { one = figures(0.02); }), second([&] { other = figures(0.03); });
  first.join(), second.join();
  EXPECT_EQ(one, alone);
  EXPECT_EQ(other, other_alone);
}

TEST(Instances, AreMadeAndFreedAThousandTimes) {
  const Folder folder;
  const auto unpacked = exported(written(folder, shaft_alone), 3, "--input wheel.torque");
  std::unique_ptr<Library> library;
  for (int k = 0; k < 1000; ++k) {
    if (k % 10 == 0) {
      library.reset();  // unloaded, and loaded anew
      library = std::make_unique<Library>(unpacked->library());
    }
    Slave slave(*unpacked, *library, k % 2 ? Kind::co_simulation : Kind::model_exchange);
    if (k % 10 == 0) slave.initialise(0), slave.reset();
  }
}

TEST(Instances, RefuseWhatIsOutOfTurnAndHarmNobody) {
  const Folder folder;
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(written(folder, shaft_alone), fmi, "--input wheel.torque --parameter wheel.inertia");
    const Library library(unpacked->library());
    Slave bad(*unpacked, library, Kind::co_simulation, "bad"), good(*unpacked, library, Kind::co_simulation, "good");
    EXPECT_EQ(bad.raw_step_in_wrong_state(), 3);
    ASSERT_FALSE(bad.logged.empty());
    EXPECT_NE(bad.logged.back().find("t = "), std::string::npos);
    EXPECT_THROW(bad.set(unpacked->states[0], 1), std::runtime_error);
    bad.initialise(0), good.initialise(0);
    EXPECT_THROW(bad.set("wheel.torque", NAN), std::runtime_error);
    EXPECT_THROW(bad.get(100000), std::runtime_error);
    EXPECT_THROW(bad.step(0.5, 0.1), std::runtime_error);  // not where it is
    good.step(0, 0.1);
    EXPECT_NEAR(good["speed.wheel"], 10 * std::exp(-0.5 * 0.1 / 8), 1e-8);
    good.terminate();
    EXPECT_THROW(good.step(0.1, 0.1), std::runtime_error);
    const Folder other;
    std::string belted = shaft_alone;
    belted.replace(belted.find("[brakeless]"), 0,
                   "[belt]\nkind = \"belt\"\ndiameter_in = \"100 mm\"\ndiameter_out = \"200 mm\"\n"
                   "pretension = \"9 kN\"\nfriction_coefficient = 0.3\nwrap_angle = \"180 deg\"\n");
    belted.replace(belted.find("\"wheel\"]"), 0, "\"belt\", ");
    const auto fixed = exported(written(other, belted), fmi, "--parameter belt.diameter_out");
    EXPECT_EQ((*fixed)["belt.diameter_out"].variability, "fixed");
    const Library its(fixed->library());
    Slave slave(*fixed, its, Kind::co_simulation);
    slave.set("belt.diameter_out", 0.25);
    slave.initialise(0);
    EXPECT_NEAR(slave["speed.brakeless"] / slave["speed.wheel"], 2.5, 1e-12);
    EXPECT_THROW(slave.set("belt.diameter_out", 0.3), std::runtime_error);
    EXPECT_EQ(slave["belt.diameter_out"], 0.25);
  }
}

// docs/tasks/hoist_control.md: what its controller prints, digit by digit.
TEST(Export, TheWorkedTaskSaysWhatItsPageSays) {
  const fs::path folder = fs::path(KURBEL_SOURCE_DIR) / "docs/tasks";
  const auto unpacked = exported((folder / "hoist_control.toml").string(), 3,
                                 "--kind cs --input motor.command --input brake.command --output speed.motor "
                                 "--output torque.motor");
  const std::string printed = command("python3 " + (folder / "hoist_control.py").string() + " " + unpacked->folder);
  std::ifstream page(folder / "hoist_control.md");
  const std::string text((std::istreambuf_iterator<char>(page)), {});
  EXPECT_NE(text.find("```text\n" + printed + "```"), std::string::npos) << printed;
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 4);
}

TEST(Export, RefusesWithTheReason) {
  const std::string program = std::string(KURBEL_EXECUTABLE) + " export ";
  const auto refused = [&](const std::string& options, const char* why) {
    EXPECT_NE(command(program + options + " --no-files --quiet", 2).find(why), std::string::npos) << options;
  };
  refused(scene("planetary_brake") + " --input brake.command", "the operating sequence sets");
  refused(scene("crank_press") + " --input motor.speed", "of kind \"prescribed speed\"");
  refused(scene("crank_press") + " --input motor.comand", "must end in");
  refused(scene("crank_press") + " --input mottor.command", "motor");
  refused(scene("crank_press") + " --parameter press.stiffness", "no such quantity");
  refused(scene("crank_press") + " --output peak_torque.main_coupling", "--kind cs");
}

}  // namespace
}  // namespace components_test
