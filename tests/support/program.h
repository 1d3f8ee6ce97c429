// program.h — the program as a test starts it: by a line of a shell, or in a folder of its own; and what it says.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/files.h"

namespace kurbel::test {

struct Said {
  int code = -1;     // −1: by a signal
  std::string text;  // stdout and stderr
  bool has(const std::string& words) const { return text.find(words) != std::string::npos; }
};

// A line of a shell.
inline Said said_by(const std::string& line) {
  Said said;
  FILE* const pipe = popen((line + " 2>&1").c_str(), "r");
  std::array<char, 4096> part;
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) said.text.append(part.data(), n);
  const int status = pclose(pipe);
  said.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}
inline Said said_by_program(const std::string& arguments) { return said_by("'" KURBEL_EXECUTABLE "' " + arguments); }

// In a child: the program in its place.
[[noreturn]] inline void become_program(const std::vector<std::string>& arguments) {
  std::vector<char*> argv = {const_cast<char*>("kurbel")};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  execv(KURBEL_EXECUTABLE, argv.data());
  _exit(98);
}

struct Ended {
  int code = -1, signal = 0;  // −1: by the signal
  std::string out, err;
};

// A test with a folder, in which the program is started, or in a folder within.
class ProgramTest : public testing::Test {
 protected:
  explicit ProgramTest(const std::string& within = {}) : within_(folder_ / within) {
    std::filesystem::create_directories(within_);
  }

  using Prepare = std::function<void()>;  // in the child, before the program

  pid_t start(const std::vector<std::string>& arguments, const Prepare& prepare = {}) const {
    const pid_t child = fork();
    if (child != 0) return child;
    dup2(open((folder_ / "stdout").c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644), STDOUT_FILENO);
    dup2(open((folder_ / "stderr").c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644), STDERR_FILENO);
    if (chdir(within_.c_str()) != 0) _exit(99);
    if (prepare) prepare();
    become_program(arguments);
  }
  Ended wait(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
            text_of(folder_ / "stdout"), text_of(folder_ / "stderr")};
  }
  Ended kurbel(const std::vector<std::string>& arguments, const Prepare& prepare = {}) const {
    return wait(start(arguments, prepare));
  }

  const ScratchFolder folder_;

 private:
  const std::filesystem::path within_;
};

// Until `child` has a handler for Ctrl-C (SigCgt of its status, proc(5)), at most 20 s: however slowly it starts.
inline void wait_for_handler(pid_t child) {
  for (int tried = 0; tried < 2000; ++tried, std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1)) return;
  }
}

}  // namespace kurbel::test
