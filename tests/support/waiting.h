// waiting.h — a right answer that the program does not give yet: its test stands now, and asks to be turned round on the
// day it is given.
#pragma once

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <exception>
#include <functional>

namespace kurbel::test {

// `expectations`: EXPECT_… with the right values, as they will stand when part `part` of the plan has mended what is wrong.
// Until then at least one of them fails, or they meet a refusal, which is noted; once all hold, this test fails.
inline void waits_for_part(int part, const std::function<void()>& expectations) {
  testing::TestPartResultArray results;
  bool refused = false;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    try {
      expectations();
    } catch (const std::exception&) {
      refused = true;
    }
  }
  bool wrong = refused;
  for (int i = 0; i < results.size(); ++i) wrong = wrong || results.GetTestPartResult(i).failed();
  testing::Test::RecordProperty("waits_for_part", part);
  EXPECT_TRUE(wrong) << "The right answer is given now, before or by part " << part
                     << ": take waits_for_part() from around these expectations, which then guard it.";
}

}  // namespace kurbel::test
