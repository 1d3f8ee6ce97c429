// spawn.cpp — only system calls between fork and exec.
#include "studies/files/spawn.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>

namespace kurbel {
namespace {

constexpr int no_such_program = 127;

pid_t start(const std::vector<std::string>& words, int folder, int kept, bool dies_with_parent) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child != 0) return child;
  if (dies_with_parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(no_such_program);  // it was too late
  }
  const int nothing = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
  if (kept >= 0) fcntl(kept, F_SETFD, 0);
  // Restores signals that this program ignores.
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  if (folder < 0 || fchdir(folder) == 0) execvp(arguments[0], arguments.data());
  _exit(no_such_program);
}

}  // namespace

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

pid_t spawn(const std::vector<std::string>& words) { return start(words, -1, -1, false); }

bool run_and_wait(const std::vector<std::string>& words, int folder, int kept) {
  const pid_t child = start(words, folder, kept, true);
  if (child < 0) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace kurbel
