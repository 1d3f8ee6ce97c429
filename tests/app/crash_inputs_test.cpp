// crash_inputs_test.cpp — inputs that once crashed, hung or were answered without a place, by the program as it is
// called: exit code, message, and the processor time that the answer took.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/files.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace kurbel::crash_inputs_test {
namespace {

namespace fs = std::filesystem;

struct Answer {
  int code = 0;
  std::string out, err;
  double seconds = 0;  // of processor time
};

double seconds_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

class CrashInputs : public testing::Test {
 protected:
  Answer answer(const std::string& verb, const std::string& name, const std::string& more = "") const {
    const double before = seconds_of_children();
    const int status = std::system(fmt::format("cd '{}' && timeout 100 '{}' {} '{}' {} > out 2> err", folder_.string(),
                                               KURBEL_EXECUTABLE, verb, path(name), more)
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::text_of(folder_ / "out"),
            test::text_of(folder_ / "err"), seconds_of_children() - before};
  }
  static std::string path(const std::string& name) { return test::source_path("tests/cases/crashes/" + name); }

  // Refused at a place, in these words, at once.
  void expect_refused(const std::string& verb, const std::string& name, const std::string& place,
                      const std::string& words) const {
    const Answer a = answer(verb, name);
    EXPECT_EQ(a.code, 2) << verb << a.out << a.err;
    EXPECT_NE(a.err.find(path(name) + place), std::string::npos) << verb << a.err;
    EXPECT_NE(a.err.find(words), std::string::npos) << verb << a.err;
    EXPECT_LT(a.seconds, 1 * test::slower) << verb;
  }

  const test::ScratchFolder folder_;
};

TEST_F(CrashInputs, AnEmptyListIsRefusedByEveryCommand) {
  for (const char* verb : {"check", "run", "steady", "modes", "forces", "reduce", "gears", "effects"})
    expect_refused(verb, "dc_motor_without_switch_times.toml",
                   ":3:194: ", "dc shunt motor \"motor\": switch_times = []; must hold one value at least");
}

TEST_F(CrashInputs, AStartGivenAtWhatAScrewMovesIsRefused) {
  for (const char* verb : {"check", "run", "steady", "reduce"})
    expect_refused(verb, "slide_before_it_is_compiled.toml", ":4:24: ",
                   "start: on = \"engine.slider\": \"engine\" has no slider; allowed: \"engine\", its shaft");
}

TEST_F(CrashInputs, TheBudgetReachesEveryLoop) {
  for (const char* verb : {"modes", "reduce", "steady", "forces", "effects"}) {
    const Answer a = answer(verb, "modes_and_reduce_do_not_end.toml", "--set 'run.budget=1 s'");
    EXPECT_TRUE(a.code == 0 || a.code == 2 || a.code == 3) << verb << a.code;
    EXPECT_LT(a.seconds, 10 * test::slower) << verb << a.err;
    if (std::string(verb) == "modes" || std::string(verb) == "reduce") {
      EXPECT_EQ(a.code, 3) << verb;
      EXPECT_LT(a.seconds, 3 * test::slower) << verb;
      EXPECT_NE(a.err.find("the budget of 1 s of processor time is spent"), std::string::npos) << a.err;
    }
  }
}

TEST_F(CrashInputs, AHeavySliderOnALightCrankRunsAsFarAsItsBudget) {
  const Answer a = answer("run", "heavy_slider_without_place.toml");
  EXPECT_TRUE(a.code == 0 || a.code == 3) << a.code << a.err;
  EXPECT_EQ(a.err.find("another reduced inertia than its equations"), std::string::npos) << a.err;
  EXPECT_LT(a.seconds, 10 * test::slower);
}

// T = 151.492424049175 N·m at 45° and 1 rad/s: the motion that is given, whatever becomes of the other.
TEST_F(CrashInputs, ForcesOfEqualLinksEnd) {
  const Answer a = answer("forces", "equal_links.toml", "--positions 8");
  EXPECT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("     45         1  151.492 "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("the crank does not turn fully in the steady motion"), std::string::npos) << a.out;
  EXPECT_LT(a.seconds, 30 * test::slower);
}

}  // namespace
}  // namespace kurbel::crash_inputs_test
