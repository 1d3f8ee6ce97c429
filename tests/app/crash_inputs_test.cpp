// crash_inputs_test.cpp — inputs that once crashed, hung or were answered without a place, by the program as it is
// called: exit code, message, and the processor time that the answer took.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace kurbel {
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
  CrashInputs() { fs::create_directories(folder_); }
  ~CrashInputs() override { fs::remove_all(folder_); }

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
    EXPECT_LT(a.seconds, 1) << verb;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("kurbel_crash_inputs_{}", getpid());
};

TEST_F(CrashInputs, AnEmptyListIsRefusedByEveryCommand) {
  for (const char* verb : {"check", "run", "steady", "modes", "forces", "reduce", "gears", "effects"})
    expect_refused(verb, "dc_motor_without_switch_times.toml",
                   ":3:194: ", "motor \"motor\": switch_times = []; must hold one value at least");
}

TEST_F(CrashInputs, AStartToldAtWhatAScrewMovesIsRefused) {
  for (const char* verb : {"check", "run", "steady", "reduce"})
    expect_refused(verb, "slide_before_it_is_compiled.toml", ":4:24: ",
                   "start: on = \"engine.slider\": \"engine\" has no slider; allowed: \"engine\", its shaft");
}

}  // namespace
}  // namespace kurbel
