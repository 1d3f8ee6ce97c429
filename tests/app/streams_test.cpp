// streams_test.cpp — output arrives, or its loss is reported; options without a value; signals at once; completion.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace kurbel::streams_test {
namespace {

namespace fs = std::filesystem;

using test::Ended;
using test::text_of;

class Streams : public test::ProgramTest {
 protected:
  Streams() {
    // A pulsation: without one the steps would grow without limit.
    std::ofstream(folder_ / "wheel.toml")
        << "line = [\"wheel\"]\nwheel = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n"
           "pulse = { kind = \"torque source\", amplitude = \"5 N*m\", frequency = \"5 Hz\", on = \"wheel\" }\n"
           "run = { until = \"1 s\", start = { speed = \"1 rad/s\" } }\n";
  }
  static std::function<void()> onto_full(int stream) {
    return [stream] { dup2(open("/dev/full", O_WRONLY), stream); };
  }
};

TEST_F(Streams, LossOfWhatWasSaidIsReportedAndNoSuccess) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--version"},
                                                                                     {"--help"},
                                                                                     {"run", "--help"},
                                                                                     {"keys"},
                                                                                     {"schema"},
                                                                                     {"check", "wheel.toml"},
                                                                                     {"figures", "wheel.toml"},
                                                                                     {"effects"},
                                                                                     {"run", "wheel.toml"},
                                                                                     {"run", "wheel.toml", "--json"}}) {
    const Ended r = kurbel(words, onto_full(STDOUT_FILENO));
    EXPECT_EQ(r.code, 3) << words[0];
    EXPECT_NE(r.err.find("could not be written: No space left on device"), std::string::npos) << words[0] << r.err;
  }
  EXPECT_TRUE(fs::exists(folder_ / "results/wheel/run/set.sha256")) << "the files are there all the same";
  EXPECT_EQ(kurbel({"check", "absent.toml"}, onto_full(STDOUT_FILENO)).code, 2);
}

TEST_F(Streams, ClosedStreamsTakeNothingFromFilesAndGetNothingIntoThem) {
  const Ended r = kurbel({"run", "wheel.toml", "--out", "out"}, [] { close(STDOUT_FILENO), close(STDERR_FILENO); });
  EXPECT_EQ(r.code, 3);
  EXPECT_EQ(text_of(folder_ / "out/summary.json")[0], '{');
  EXPECT_EQ(text_of(folder_ / "out/report.html").find("results: "), std::string::npos);
  EXPECT_EQ(kurbel({"run", "wheel.toml", "--out", "out"}, [] { close(STDIN_FILENO); }).code, 0);
}

TEST_F(Streams, ReaderThatLeavesEndsNothingBeforeTheFilesAreThere) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const Ended r = kurbel({"run", "wheel.toml", "--json", "--out", "out"}, [&] { dup2(ends[1], STDOUT_FILENO); });
  close(ends[1]);
  EXPECT_EQ(r.code, 3);
  EXPECT_EQ(r.signal, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/set.sha256"));
}

TEST_F(Streams, FullStderrChangesNoExitCode) {
  EXPECT_EQ(kurbel({"check", "absent.toml"}, onto_full(STDERR_FILENO)).code, 2);
  EXPECT_EQ(kurbel({"nonsense"}, onto_full(STDERR_FILENO)).code, 2);
  EXPECT_EQ(kurbel({"run", "wheel.toml", "--verbose"}, onto_full(STDERR_FILENO)).code, 0);
  EXPECT_EQ(kurbel({"run", "wheel.toml"},
                   [] {
                     onto_full(STDERR_FILENO)();
                     onto_full(STDOUT_FILENO)();
                   })
                .code,
            3);
}

// Waits until a program that has been started catches a signal, however slow the machine is.
bool holds(pid_t child, int signal) {
  const std::string status = "/proc/" + std::to_string(child) + "/status";
  for (;;) {
    const std::string text = text_of(status);
    const std::size_t at = text.find("SigCgt:");
    if (at == std::string::npos) return false;  // it has ended
    if (std::stoull(text.substr(at + 7), nullptr, 16) >> (signal - 1) & 1) return true;
  }
}

// From when the program has been loaded (ten milliseconds, in which the system answers signals), it ends as documented.
TEST_F(Streams, SignalInTheFirstMillisecondsEndsWith130) {
  int held = 0;
  for (int n = 0; n < 20; ++n) {
    const pid_t child = start({"run", "wheel.toml", "--until", "1000000 s", "--no-files"});
    ASSERT_TRUE(holds(child, SIGTERM));
    std::this_thread::sleep_for(std::chrono::microseconds(500 * n));
    kill(child, n % 2 ? SIGTERM : SIGINT);
    const Ended r = wait(child);
    EXPECT_EQ(r.signal, 0) << n;
    EXPECT_TRUE(r.code == 130 || r.code == 0) << r.code;
    held += r.code == 130;
  }
  EXPECT_GT(held, 10);
}

// timeout(1) signals its child and the child's group: two signals within microseconds are one, and what was computed is
// reported. A second one later ends at once.
TEST_F(Streams, TwoSignalsAtOnceAreOne) {
  for (int n = 0; n < 8; ++n) {
    const pid_t child = start({"run", "wheel.toml", "--until", "1000000 s", "--no-files"});
    ASSERT_TRUE(holds(child, SIGINT));
    kill(child, SIGINT);
    std::this_thread::sleep_for(std::chrono::microseconds(40 * n));
    kill(child, SIGINT);
    const Ended r = wait(child);
    EXPECT_EQ(r.code, 130) << n;
    EXPECT_NE(r.err.find("interrupted"), std::string::npos) << r.err;
  }
}

// Every option of every command that takes a value, as --help lists them.
TEST_F(Streams, NoOptionTakesAnEmptyValue) {
  const std::string help = kurbel({"--help"}).out;
  const std::string list = help.substr(help.find("Subcommands:"));
  const std::regex command("\n  ([a-z]+) "), option("\n  (--[a-z-]+) (?:TEXT|FLOAT|INT|UINT)");
  int options = 0;
  for (std::sregex_iterator c(list.begin(), list.end(), command), end; c != end; ++c) {
    const std::string name = (*c)[1], own = kurbel({name, "--help"}).out;
    for (std::sregex_iterator o(own.begin(), own.end(), option); o != end; ++o, ++options) {
      const std::string word = (*o)[1];
      const Ended r = kurbel({name, "wheel.toml", word, ""});
      EXPECT_EQ(r.code, 2) << name << " " << word;
      EXPECT_NE(r.err.find(word + ": must not be empty"), std::string::npos) << r.err;
    }
  }
  EXPECT_GT(options, 40);
  EXPECT_EQ(kurbel({"run", ""}).code, 2);
  EXPECT_EQ(kurbel({"new", ""}).code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(Streams, ScenesOfOddNamesAreReadAndCompletionDoesNotWaitForThem) {
  for (const char* name : {".toml", "x=1.toml", "-x.toml"}) {
    ASSERT_EQ(kurbel({"new", "press", std::string("./") + name}).code, 0);
    EXPECT_EQ(kurbel({"check", std::string("./") + name}).code, 0);
  }
  ASSERT_EQ(mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
  const std::string script = std::string(KURBEL_SOURCE_DIR) + "/scripts/kurbel.bash-completion";
  int nobody_writes[2];
  ASSERT_EQ(pipe(nobody_writes), 0);
  for (const std::string name : {"x=1.toml", "./x=1.toml", ".toml", "-x.toml", "pipe.toml", "absent.toml"}) {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.path.c_str()) != 0) _exit(99);
      dup2(nobody_writes[0], STDIN_FILENO);
      dup2(open("completed", O_CREAT | O_WRONLY | O_TRUNC, 0644), STDOUT_FILENO);
      const std::string command = "source '" + script + "'; COMP_WORDS=(kurbel run '" + name +
                                  "' --effects elasticity:m); COMP_CWORD=4; _kurbel; echo ${COMPREPLY[*]}";
      execlp("timeout", "timeout", "5", "bash", "-c", command.c_str(), nullptr);
      _exit(98);
    }
    EXPECT_EQ(wait(child).code, 0) << name;
    const bool couplings = text_of(folder_ / "completed").find("elasticity:motor_coupling") != std::string::npos;
    EXPECT_EQ(couplings, name != "pipe.toml" && name != "absent.toml") << name;
  }
  close(nobody_writes[0]);
  close(nobody_writes[1]);
}

}  // namespace
}  // namespace kurbel::streams_test
