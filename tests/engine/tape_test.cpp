// tape_test.cpp — what an observer remembers comes back as it was; a damaged memory is refused, never undefined.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/run/tape.h"

namespace kurbel::tape_test {
namespace {

template <class T>
T through(const T& value) {
  T copy = value;
  Tape write;
  write(copy);
  Tape read(write.take());
  T back{};
  read(back);
  EXPECT_TRUE(read.at_end());
  return back;
}

TEST(Tape, GivesBackWhatItTook) {
  EXPECT_EQ(through(std::size_t{1} << 52), std::size_t{1} << 52);
  EXPECT_EQ(through(-7), -7);
  EXPECT_EQ(through(std::numeric_limits<int>::max()), std::numeric_limits<int>::max());
  EXPECT_EQ(through(true), true);
  EXPECT_EQ(through(std::optional<double>()), std::optional<double>());
  EXPECT_EQ(through(std::vector<double>{1, -0.5}), (std::vector<double>{1, -0.5}));
}

template <class Whole>
void expect_refused(double number) {
  Tape tape(std::vector<double>{number});
  Whole whole{};
  EXPECT_THROW(tape(whole), std::invalid_argument) << number;
}

// A cast of such a double to the whole type has no defined value.
TEST(Tape, RefusesACountThatIsNone) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const double number : {nan, inf, -inf, 1e300, 0.5}) {
    expect_refused<int>(number);
    expect_refused<std::size_t>(number);
    expect_refused<bool>(number);
    expect_refused<std::int64_t>(number);
  }
  expect_refused<std::size_t>(-1);
  expect_refused<int>(2147483648.0);
  expect_refused<bool>(2);
  Tape list(std::vector<double>{1e18, 0});
  std::vector<double> values;
  EXPECT_THROW(list(values), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::tape_test
