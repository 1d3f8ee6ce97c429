// dense_tables_test.cpp — tables of thousands of points, taken by fewer pieces: what that changes is within the stated errors.
#include "engine/values/dense_tables.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/forces/forces.h"
#include "studies/reduce/reduce.h"
#include "studies/run/simulate.h"
#include "studies/steady/cycle_search.h"
#include "tests/support/scenes.h"

namespace kurbel::test::dense_tables_test {
namespace {

// A crank that a smooth gas force over two turns drives against a fan.
std::string engine(int points) {
  std::string table;
  for (int k = 0; k <= points; ++k) {
    const double phi = 720.0 * k / points, within = k < points ? phi : 0;  // the last point is the first
    const double from = std::remainder(within - 400, 720) / 30;
    table +=
        fmt::format("{}[{:.10g}, {:.10g}]", k == 0 ? "" : ", ", phi,
                    3500 * std::exp(-0.5 * from * from) + 200 * std::pow(std::sin(within * std::numbers::pi / 720), 2));
  }
  return fmt::format(R"(line = ["crank", "coupling", "fan"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.55 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.020 kg*m2"
slider_mass = "3 kg"
load = {{ kind = "table", work = "driving", force = {{ over = "angle", unit = ["deg", "N"], points = [{}], period = "720 deg" }} }}
[coupling]
kind = "coupling"
stiffness = "6 kN*m/rad"
damping_ratio = 0.03
[fan]
kind = "load"
quadratic = "0.05 N*m*s2/rad2"
inertia = "1.5 kg*m2"
[effects]
elasticity = true
[run]
start = {{ speed = "20 rad/s" }}
until = "15 s"
accuracy = 1e-5
)",
                     table);
}

bool reports_of_tables(const std::vector<std::string>& notes) {
  return std::any_of(notes.begin(), notes.end(),
                     [](const std::string& note) { return note.find("re-tabulated") != std::string::npos; });
}

TEST(DenseTables, AreTakenWhereItPaysAndNoEdgesAreRounded) {
  const Scene few = scene_from(engine(150)), many = scene_from(engine(1200));
  EXPECT_EQ(tables_within(few), 0);
  EXPECT_NEAR(tables_within(many), 1e-5 / 3, 1e-20);
  EXPECT_NEAR(tables_within(with_rougher_tables(many, 4)), 4e-5 / 3, 1e-20);
  EXPECT_EQ(tables_within(with_rougher_tables(many, 0)), 0);
  EXPECT_EQ(words_of_dense_tables(few), "");
  EXPECT_NE(words_of_dense_tables(many).find("crank.load.force (1201 points)"), std::string::npos);
  const Scene rounded = scene_from([] {
    std::string text = engine(1200);
    return text.replace(text.find("work = "), 0, "rounding_angle = \"2 deg\", ");
  }());
  EXPECT_EQ(tables_within(rounded), 0);
}

// Points at every degree cost no more than at every tenth of a degree; noise of a measurement stays as it is.
TEST(DenseTables, TheThresholdIsByCost) {
  EXPECT_GT(tables_within(scene_from(engine(720))), 0);
  Scene noisy = scene_from(engine(720));
  for (Setting& setting : noisy.components[0].settings)
    for (Section& load : setting.sections)
      for (Setting& force : load.settings)
        for (std::size_t i = 1; i + 1 < force.curve.y.size(); ++i)  // the last point is the first
          force.curve.y[i] += (i % 3 == 0 ? 5.0 : -3.0), force.curve.within = 0;
  EXPECT_EQ(tables_within(with_fewer_points(noisy)), 0);
}

TEST(DenseTables, SteadyMotionIsThatOfTheTableWithinItsErrors) {
  const Scene scene = scene_from(engine(1200));
  const SteadyCycle exact = search_cycle(with_rougher_tables(scene, 0), scene.effects, {.start_search = false});
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(exact.found && study.complete) << exact.why << study.diagnosis;
  const SteadyCycle& fewer = study.cycles.front();
  EXPECT_TRUE(reports_of_tables(fewer.notes));
  int compared = 0;
  for (const Figure& f : fewer.figures)
    if (const Figure* g = exact.find(f.name); g && f.error) {
      ++compared;
      EXPECT_LE(std::abs(f.value - g->value), *f.error + g->error.value_or(0)) << f.name << " " << f.value;
    }
  EXPECT_GT(compared, 30);
  const Figure* mean = fewer.find("mean_speed.crank");
  EXPECT_LT(*mean->error, 3e-5 * mean->value);
}

TEST(DenseTables, AReductionStatesWhatTheyLeaveOpen) {
  const Scene dense = scene_from(engine(1200));
  const MachineReduction a = reduce(dense, {}), b = reduce(with_rougher_tables(dense, 0), {});
  EXPECT_TRUE(reports_of_tables(a.notes));
  ASSERT_TRUE(a.mean_drive.error && b.mean_drive.error);
  EXPECT_LE(std::abs(a.mean_drive.value - b.mean_drive.value), *a.mean_drive.error + *b.mean_drive.error);
  ASSERT_EQ(a.spectra.size(), b.spectra.size());
  for (std::size_t i = 0; i < a.spectra.size(); ++i)
    for (std::size_t n = 0; n < a.spectra[i].harmonics.size(); ++n) {
      const Estimate &x = a.spectra[i].harmonics[n].amplitude, &y = b.spectra[i].harmonics[n].amplitude;
      ASSERT_TRUE(x.error && y.error);
      EXPECT_LE(std::abs(x.value - y.value), *x.error + *y.error) << a.spectra[i].name << " " << n;
    }
}

// Runs and forces of the same machine, by fewer pieces and as the table is given.
TEST(DenseTables, ARunStatesWhatTheyLeaveOpen) {
  Scene scene = scene_from(engine(1200));
  scene.run.until = 2;
  const Result fewer = simulate(scene, scene.effects, "", {}),
               exact = simulate(with_rougher_tables(scene, 0), scene.effects, "", {});
  EXPECT_TRUE(reports_of_tables(fewer.notes));
  int compared = 0;
  for (const Figure& f : fewer.figures)
    if (const Figure* g = find(exact.figures, f.name); g && f.error) {
      ++compared;
      EXPECT_LE(std::abs(f.value - g->value), *f.error + g->error.value_or(0)) << f.name << " " << f.value;
    }
  EXPECT_GT(compared, 20);
}

TEST(DenseTables, ForcesStateWhatTheyLeaveOpen) {
  const Scene scene = scene_from(engine(1200));
  ForcesOptions options;
  options.speed = 20;  // else that of the motion
  const Forces fewer = find_forces(scene, options), exact = find_forces(with_rougher_tables(scene, 0), options);
  ASSERT_TRUE(fewer.simulated && exact.simulated);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(fewer.prescribed->reaction(k).value, exact.prescribed->reaction(k).value);
    const Peak &a = fewer.simulated->reaction(k), &b = exact.simulated->reaction(k);
    EXPECT_LE(std::abs(a.value - b.value), *a.error + *b.error) << k;
    EXPECT_LT(*a.error, 1e-4 * std::abs(a.value)) << k;
  }
  EXPECT_TRUE(reports_of_tables(fewer.notes));
}

}  // namespace
}  // namespace kurbel::test::dense_tables_test
