// trajectory_csv_test.cpp — rows at equal times, and one at each peak that is a figure, however coarse the rows are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/numerics/index.h"
#include "engine/run/recorders.h"
#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "tests/support/scenes.h"

namespace kurbel::test::trajectory_csv_test {
namespace {

struct Csv {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  std::size_t column(const std::string& name) const {
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.starts_with(name + " ["); });
    return at(found - names.begin());
  }
};
Csv read_csv(const std::string& text) {
  Csv csv;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> found;
    for (std::string cell; std::getline(cells, cell, ',');) found.push_back(cell);
    if (csv.names.empty()) {
      csv.names = found;
      continue;
    }
    csv.rows.emplace_back();
    for (const std::string& cell : found) csv.rows.back().push_back(std::stod(cell));
  }
  return csv;
}

// Two masses on a spring, pulled up by a step of torque: M (1 − cos Ω t) J₂/(J₁ + J₂) in the shaft, Ω² = k (1/J₁ + 1/J₂),
// peak at t = π/Ω, where no row of ten stands.
const char* const step =
    "line = [\"a\", \"shaft\", \"b\"]\na = { kind = \"load\", torque = \"-10 N*m\", acts = \"always\", inertia = \"1 "
    "kg*m2\" }\n"
    "shaft = { kind = \"shaft\", stiffness = \"400 N*m/rad\" }\nb = { kind = \"flywheel\", inertia = \"3 kg*m2\" }\n"
    "[effects]\nelasticity = true\n[run]\nstart = { speed = \"1 rad/s\" }\nuntil = \"0.5 s\"\naccuracy = 1e-8\n";

Result run_with(int samples) {
  const Scene scene = scene_from(fmt::format("{}samples = {}\n", step, samples));
  return simulate(compile(scene, scene.effects), "", {});
}

TEST(TrajectoryCsv, HoldsThePeakBetweenItsRows) {
  const Result r = run_with(4);
  const Csv csv = read_csv(csv_text(trajectory_data(r)));
  const double omega = std::sqrt(400 * (1 + 1 / 3.0)), peak = 2 * 10 * 3 / 4.0;
  const Figure* figure = r.find(quantities::peak_torque, "shaft");
  ASSERT_TRUE(figure && figure->at);
  EXPECT_NEAR(std::abs(figure->value), peak, 1e-6);
  const std::size_t torque = csv.column("torque.shaft");
  ASSERT_LT(torque, csv.names.size());
  double greatest = 0, when = 0, before = -1;
  for (const auto& row : csv.rows) {
    EXPECT_GT(row[0], before) << "times ascend, none stands twice";
    before = row[0];
    EXPECT_EQ(row.size(), csv.names.size());
    if (std::abs(row[torque]) > greatest) greatest = std::abs(row[torque]), when = row[0];
    // Whole rows: the twist and the angle of the same time.
    EXPECT_NEAR(std::abs(row[torque]), 7.5 * (1 - std::cos(omega * row[0])), 1e-5) << row[0];
  }
  EXPECT_NEAR(greatest, peak, 1e-6);
  EXPECT_NEAR(std::remainder(when - std::numbers::pi / omega, 2 * std::numbers::pi / omega), 0, 1e-5);
  EXPECT_NEAR(csv.rows.front()[0], 0, 0);
  EXPECT_EQ(csv.rows.back()[0], 0.5);
}

TEST(TrajectoryCsv, CoarseRowsAreReported) {
  const auto reported = [](const Result& r) {
    return std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
      return note.find("are too coarse for the motion") != std::string::npos;
    });
  };
  EXPECT_TRUE(reported(run_with(4)));
  EXPECT_FALSE(reported(run_with(1000)));
}

// Two masses with 4 rows as with 1001: the equidistant rows do not move.
TEST(TrajectoryCsv, EquidistantRowsStay) {
  const Result few = run_with(6), many = run_with(501);
  ASSERT_EQ(few.trajectory->time().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(few.trajectory->time()[i], many.trajectory->time()[100 * i], 1e-15);
    for (std::size_t k = 0; k < few.trajectory->channels().size(); ++k)
      EXPECT_NEAR(few.trajectory->value(i, k), many.trajectory->value(100 * i, k), 1e-9);
  }
}

}  // namespace
}  // namespace kurbel::test::trajectory_csv_test
