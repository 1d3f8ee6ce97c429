// event_match_test.cpp — the events of two runs side by side.
#include "studies/run/event_match.h"

#include <gtest/gtest.h>

#include <random>

namespace kurbel::event_match_test {
namespace {

TEST(EventMatch, PairsByKindInOrderThoughTheOrderOfKindsDiffers) {
  const std::vector<Event> coarse = {{1.0, "clutch", "locks"}, {1.01, "press", "load edge"}, {2.0, "clutch", "locks"}};
  const std::vector<Event> fine = {{1.005, "press", "load edge"}, {1.02, "clutch", "locks"}, {2.5, "clutch", "locks"}};
  const EventMatch match = match_events(coarse, fine);
  EXPECT_NEAR(*match.error[0], 0.005, 1e-15);
  EXPECT_NEAR(*match.error[1], 0.02, 1e-15);
  EXPECT_NEAR(*match.error[2], 0.5, 1e-15);
  EXPECT_EQ(match.only_in_fine + match.only_in_coarse, 0u);
}

TEST(EventMatch, ReportsWhatOneRunAloneHas) {
  const std::vector<Event> coarse = {{1.0, "gear", "touches", "in flight"}, {3.0, "gear", "touches", "in flight"}};
  const std::vector<Event> fine = {{1.1, "gear", "touches", "in flight"},
                                   {1.2, "gear", "touches", "in flight"},
                                   {3.1, "gear", "touches", "in flight"},
                                   {3.1, "gear", "touches", "on the other flank"}};
  const EventMatch match = match_events(coarse, fine);
  EXPECT_NEAR(*match.error[0], 0.1, 1e-15);
  EXPECT_FALSE(match.error[1]);
  EXPECT_NEAR(*match.error[2], 0.1, 1e-15);
  EXPECT_FALSE(match.error[3]);
  EXPECT_EQ(match.only_in_fine, 2u);
  EXPECT_EQ(match.only_in_coarse, 0u);
}

// Moved by less than half of their distance, some missing in either run: partners are found, and no event has two.
TEST(EventMatch, FindsEventsThatMovedALittleAmongMissingOnes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.2, 0.2), chance(0, 1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Event> coarse, fine;
    std::vector<double> moved;  // of each event of `fine`; NaN: alone
    for (int k = 0; k < 30; ++k) {
      const double by = shift(random);
      const bool in_coarse = chance(random) > 0.1, in_fine = chance(random) > 0.1;
      const std::string kind = k % 3 == 0 ? "locks" : "slips";
      if (in_coarse) coarse.push_back({static_cast<double>(k), "clutch", kind});
      if (in_fine) {
        fine.push_back({k + by, "clutch", kind});
        moved.push_back(in_coarse ? std::abs(by) : std::nan(""));
      }
    }
    const EventMatch match = match_events(coarse, fine);
    std::size_t matched = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
      matched += match.error[k].has_value();
      // As many of a kind, but not the same ones, pair in their order: then the error is only too large.
      if (!std::isnan(moved[k]) && match.error[k]) {
        EXPECT_GE(*match.error[k], moved[k] - 1e-12);
      }
    }
    EXPECT_EQ(match.only_in_fine, fine.size() - matched);
    EXPECT_EQ(match.only_in_coarse, coarse.size() - matched);
  }
}

}  // namespace
}  // namespace kurbel::event_match_test
