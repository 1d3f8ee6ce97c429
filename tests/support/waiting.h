// waiting.h — a correct result that the program does not give yet: the test exists already, and fails as soon as the
// result is correct, so that it is converted.
#pragma once

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <exception>
#include <functional>

namespace kurbel::test {

// `expectations`: EXPECT_… with the correct values, valid once part `part` of the plan has corrected the error. Until
// then at least one of them fails, or an exception is thrown; once all hold, this test fails.
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
