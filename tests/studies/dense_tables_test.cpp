// dense_tables_test.cpp — tables of thousands of points, taken by fewer pieces: what that changes is within the stated errors.
#include "engine/values/dense_tables.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/reduce/reduce.h"
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

TEST(DenseTables, AreTakenOnlyWhereThereAreManyPointsAndNoEdgesToRound) {
  const Scene few = scene_from(engine(500)), many = scene_from(engine(1200));
  EXPECT_EQ(tables_within(with_tables_within(few, 1e-5)), 0);
  EXPECT_EQ(tables_within(many), 0);
  EXPECT_EQ(tables_within(with_tables_within(many, 1e-5)), 1e-5);
  EXPECT_EQ(words_of_dense_tables(many), "");
  EXPECT_NE(words_of_dense_tables(with_tables_within(many, 1e-5)).find("crank.load.force (1201 points)"),
            std::string::npos);
  const Scene rounded = scene_from([] {
    std::string text = engine(1200);
    return text.replace(text.find("work = "), 0, "rounding_angle = \"2 deg\", ");
  }());
  EXPECT_EQ(tables_within(with_tables_within(rounded, 1e-5)), 0);
}

TEST(DenseTables, SteadyMotionIsThatOfTheTableWithinItsErrors) {
  const Scene scene = scene_from(engine(1200));
  const SteadyCycle exact = search_cycle(scene, scene.effects, {.start_search = false});
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(exact.found && study.complete) << exact.why << study.diagnosis;
  const SteadyCycle& fewer = study.cycles.front();
  EXPECT_NE(study.notes.front().find("re-tabulated"), std::string::npos) << study.notes.front();
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
  Scene closer = dense;
  closer.run.accuracy = 1e-9;
  const MachineReduction a = reduce(dense, {}), b = reduce(closer, {});
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

}  // namespace
}  // namespace kurbel::test::dense_tables_test
