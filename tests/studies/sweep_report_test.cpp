// sweep_report_test.cpp — what a sweep's report shows and counts, of rows that are known.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "studies/sweep/influence.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/sweep/sweep_plots.h"
#include "tests/support/files.h"

namespace kurbel::sweep_report_test {
namespace {

// A 2 × 2 × 2 grid of a, b, c ∈ {0, 1} with y = 10 a + 4 b + c, known to ± 2.
SweepStudyResult study_of_a_cube(const std::vector<std::string>& limits, const std::string& design = "random:8") {
  SweepIdentity identity;
  identity.meta = {{"design", design}, {"of", "run"}, {"scene file", "x.toml"}, {"seed", "1"}};
  for (const char* given : {"a.x=0..1", "b.x=0..1", "c.x=0..1"}) identity.parameters.push_back(parse_parameter(given));
  identity.figures = {{"y", ""}};
  identity.rows = 8;
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto a = static_cast<double>(i / 4), b = static_cast<double>(i / 2 % 2), c = static_cast<double>(i % 2);
    rows.push_back({.row = i, .parameters = {a, b, c}, .figures = {{{10 * a + 4 * b + c, 2.0}, 0}}});
  }
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "sweep.db";
  SweepStore(file, identity).write(rows);
  const SweepStudyResult study = study_of(SweepStore(file), limits);
  return study;
}

TEST(SweepReport, ACellOfAMapIsTheMeanOverAllOtherParameters) {
  const std::vector<Plot> maps = limit_maps(study_of_a_cube({}));
  ASSERT_TRUE(maps.size() == 1 && maps[0].map.has_value());
  const bool a_across = maps[0].x.label == "a.x";
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto a = static_cast<double>(a_across ? k : i), b = static_cast<double>(a_across ? i : k);
      EXPECT_NEAR(maps[0].map->z[i][k], 10 * a + 4 * b + 0.5, 1e-12);
    }
}

// Of a row its tiles' places follow from its values: 0 is 0.42 to the left of a tile's middle or below it.
TEST(SweepReport, ATileRunsFromTheLeastToTheGreatestValue) {
  const std::vector<Plot> matrix = scatter_matrix(study_of_a_cube({}));
  ASSERT_TRUE(matrix.size() == 1 && matrix[0].series.size() == 1);
  const Series& dots = matrix[0].series[0];
  ASSERT_EQ(dots.x.size(), 6u * 8u);
  for (std::size_t i = 0; i < dots.x.size(); ++i) {
    const bool least = dots.labels[i].starts_with("row 0:"), most = dots.labels[i].starts_with("row 7:");
    if (!least && !most) continue;
    const double to = most ? 0.42 : -0.42;
    EXPECT_NEAR(dots.x[i] - to, std::round(dots.x[i] - to), 1e-12) << dots.labels[i];
    EXPECT_NEAR(dots.y[i] - to, std::round(dots.y[i] - to), 1e-12) << dots.labels[i];
    EXPECT_GE(dots.x[i] - to, 0.99);
    EXPECT_LE(dots.y[i] - to, 3.01);
    EXPECT_LE(dots.x[i] + dots.y[i] - 2 * to, 4.01) << "below the diagonal";
  }
}

// y ≤ 6.5 ± 2: 0, 1, 4 hold, 5 is within its error, 10, 11, 14, 15 are beyond.
TEST(SweepReport, TheUndecidedCountAgainstALimitAtOneEndAndForItAtTheOther) {
  const SweepStudyResult s = study_of_a_cube({"y <= 6.5"});
  const LimitCount& c = s.tally.limits.at(0);
  EXPECT_EQ(c.holds, 3u);
  EXPECT_EQ(c.undecided, 1u);
  EXPECT_EQ(c.beyond, 4u);
  // Clopper and Pearson, 95 %: of 8 trials 3 and 4 successes (tables: 0.0852 … 0.7551, 0.1570 … 0.8430).
  EXPECT_NEAR(c.interval.low, 0.0852, 1e-4);
  EXPECT_NEAR(c.interval.high, 0.8430, 1e-4);
}

// Points of a grid are no random ones: a share without interval, in words and for programs.
TEST(SweepReport, AShareOfAGridHasNoInterval) {
  const SweepStudyResult s = study_of_a_cube({"y <= 6.5"}, "grid 2 x 2 x 2");
  EXPECT_TRUE(std::isnan(s.tally.limits.at(0).interval.low));
  const Claims claims = share_claims(s.tally.limits, 0, 8);
  ASSERT_EQ(claims.size(), 1u);
  EXPECT_EQ(claims[0].text, "y ≤ 6.5 holds in 3 of 8 machines");
  EXPECT_FALSE(claims[0].evidence.error);
  EXPECT_EQ(StudyOutput{findings_of(s)}.json().find("nan"), std::string::npos);
}

// Every combination once is the whole truth of a table: y = 7 a + a b over a ∈ {0, 1, 2, 3}, b ∈ {1, 3, 8} has V(E[y|a]) =
// (7 + b̄)² V_a, V(E[y|b]) = ā² V_b, and V_a V_b of both together. A row less, and it is estimated again.
TEST(SweepIndices, OfACompleteTableAreThoseOfItsSums) {
  SweepIdentity identity;
  for (const char* given : {"a.x=0,1,2,3", "b.x=1,3,8"}) identity.parameters.push_back(parse_parameter(given));
  identity.figures = {{"y", ""}};
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < 12; ++i) {
    const double a = static_cast<double>(i % 4), b = std::vector{1.0, 3.0, 8.0}[i / 4];
    rows.push_back({.row = i, .parameters = {a, b}, .figures = {{{7 * a + a * b, 0.0}, 0}}});
  }
  const FigureInfluence found = influence_on(0, identity, rows, false);
  ASSERT_EQ(found.ranked.size(), 2u);
  const double va = 1.25, vb = 26.0 / 3, of_a = 11 * 11 * va, of_b = 1.5 * 1.5 * vb, v = of_a + of_b + va * vb;
  EXPECT_NEAR(found.deviation, std::sqrt(v), 1e-12);
  EXPECT_EQ(found.ranked[0].parameter, 0u);
  EXPECT_NEAR(found.ranked[0].first.value, of_a / v, 1e-12);
  EXPECT_NEAR(found.ranked[1].first.value, of_b / v, 1e-12);
  EXPECT_NEAR(found.ranked[0].total.value().value, 1 - of_b / v, 1e-12);
  EXPECT_NEAR(found.ranked[1].total.value().value, 1 - of_a / v, 1e-12);
  EXPECT_EQ(found.ranked[1].first.low, found.ranked[1].first.high);
  rows.pop_back();
  const FigureInfluence estimated = influence_on(0, identity, rows, false);
  ASSERT_EQ(estimated.ranked.size(), 2u);
  EXPECT_FALSE(estimated.ranked[0].total.has_value());
  EXPECT_LT(estimated.ranked[0].first.low, estimated.ranked[0].first.high);
}

}  // namespace
}  // namespace kurbel::sweep_report_test
