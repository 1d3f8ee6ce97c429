// trapped_gas_test.cpp — a force over travel whose branches differ, as gas between valves: where the machine stops, the
// true force lies between the branches and holds it.
#include <cmath>
#include <numbers>

#include "tests/support/scenes.h"

namespace kurbel::trapped_gas_test {
namespace {

// x′ = r at φ = 270°, where the slider approaches the extended end: 1000 N resist there, 200 N push on the way back.
std::string crank(const std::string& torque, const std::string& angle = "270 deg") {
  return "line = [\"drive\", \"crank\"]\n"
         "drive = { kind = \"torque source\", torque = \"" +
         torque +
         "\" }\n"
         "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"0.5 kg*m2\", "
         "slider_mass = \"3 kg\", load = { kind = \"table\", force = { over = \"travel\", unit = [\"mm\", \"N\"], "
         "points = [[0, 1000], [200, 1000]], return_points = [[0, 200], [200, 200]] } } }\n"
         "run = { until = \"0.1 s\", accuracy = 1e-9, start = { angle = \"" +
         angle + "\" } }\n";
}

double final_angle(const std::string& torque) {
  const Result r = test::run(test::scene_from(crank(torque)));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  return test::figure(r, "final_angle.crank") - 1.5 * std::numbers::pi;
}

// Held while F_return r ≤ M ≤ F_approach r: 20 … 100 N·m.
TEST(TrappedGas, HoldsTheCrankBetweenItsBranches) {
  for (const char* torque : {"20.01 N*m", "60 N*m", "99.99 N*m"}) EXPECT_NEAR(final_angle(torque), 0, 1e-14) << torque;
  // Just beyond: J φ̈ = ΔM − k φ with k = F x″ = F r²/√(l² − r²), J = 0.5 + 3 · 0.1² = 0.53 kg·m².
  const auto moved = [](double excess, double force) {
    const double k = force * 0.01 / std::sqrt(0.35 * 0.35 - 0.01);
    return excess / k * (1 - std::cos(std::sqrt(k / 0.53) * 0.1));
  };
  EXPECT_NEAR(final_angle("100.1 N*m"), moved(0.1, 1000), 1e-7);
  EXPECT_NEAR(final_angle("19.9 N*m"), moved(-0.1, 200), 1e-7);
}

// Switched on at rest, a compressor's motor cannot always carry it over its compression: from wherever it starts it
// runs up or stalls against the gas, rigid and elastic, by time and by angle.
TEST(TrappedGas, CompressorRunsUpOrStallsFromAnyStart) {
  Scene scene = test::scene_file("scenes/compressor.toml");
  scene.run.until = 1.5;
  scene.run.accuracy = 1e-5;
  scene.run.start = {};
  int stalled = 0;
  for (int degrees = 0; degrees < 360; degrees += 40)
    for (const char* method : {"work", "dop853", "elastic"}) {
      const bool elastic = std::string(method) == "elastic";
      scene.run.start.angle = degrees * std::numbers::pi / 180;
      scene.run.method = elastic ? "auto" : method;
      Effects effects;
      effects.all_elastic = elastic;
      const Result r = simulate(scene, effects, "test", SimulateOptions{});
      EXPECT_TRUE(r.complete && r.accuracy_confirmed) << degrees << "° " << method << " " << r.diagnosis;
      EXPECT_LE(r.energy.relative, 1e-4) << degrees << "° " << method;
      const double speed = test::figure(r, "final_speed.compressor");
      EXPECT_TRUE(speed == 0 || speed > 10) << degrees << "° " << method << " ends at " << speed << " rad/s";
      stalled += speed == 0;
    }
  EXPECT_GE(stalled, 9);
}

// At rest in its dead centre an engine is in balance: said in words, since rounding alone decides what follows.
TEST(DeadCentre, StartAtRestWithoutTorqueIsSaidInWords) {
  Scene scene = test::scene_file("scenes/single_cylinder_engine.toml");
  scene.run.until = 0.01;
  scene.run.start = {};
  scene.run.start.angle = std::numbers::pi;
  const auto said = [&] {
    const Result r = simulate(scene, Effects{}, "rigid", SimulateOptions{});
    return std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
      return note.find("starts at rest where no torque moves it, and stays there (180° of \"engine\")") !=
             std::string::npos;
    });
  };
  EXPECT_TRUE(said());
  scene.run.start.angle += 0.01;
  EXPECT_FALSE(said());
}

}  // namespace
}  // namespace kurbel::trapped_gas_test
