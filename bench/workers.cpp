// workers.cpp — forks a process for each task; its text comes back through an unnamed file.
#include "bench/workers.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>

namespace kurbel::bench {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

struct Worker {
  std::size_t task;
  File file;
};

constexpr int reported_in_words = 3;  // exit code of a task that threw

[[noreturn]] void work(std::size_t task, int seconds, std::FILE* file,
                       const std::function<std::string(std::size_t)>& function) {
  const auto limit = static_cast<rlim_t>(seconds);
  const rlimit most{limit, limit + 1};
  setrlimit(RLIMIT_CPU, &most);
  int code = 0;
  std::string text;
  try {
    text = function(task);
  } catch (const std::exception& error) {
    text = error.what();
    code = reported_in_words;
  }
  std::fwrite(text.data(), 1, text.size(), file);
  std::fflush(file);
  _exit(code);
}

std::string all_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, n);
  return text;
}

TaskEnd end_of(const Worker& worker, int status) {
  TaskEnd end{.task = worker.task, .whole = false, .text = {}, .words = {}};
  if (WIFSIGNALED(status)) {
    end.words = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
                    ? std::string("its processor time was spent")
                    : std::string("ended by signal ") + std::to_string(WTERMSIG(status));
    return end;
  }
  std::string text = all_of(worker.file.get());
  end.whole = WEXITSTATUS(status) == 0;
  (end.whole ? end.text : end.words) = std::move(text);
  if (!end.whole && end.words.empty()) end.words = "ended with code " + std::to_string(WEXITSTATUS(status));
  return end;
}

}  // namespace

void run_tasks(std::size_t count, int jobs, int seconds_each, const std::function<std::string(std::size_t)>& task,
               const std::function<void(const TaskEnd&)>& take, const std::function<bool()>& go_on) {
  std::map<pid_t, Worker> working;
  std::size_t next = 0;
  while (true) {
    while (next < count && working.size() < static_cast<std::size_t>(jobs) && go_on()) {
      File file(std::tmpfile());
      if (!file) throw std::runtime_error("no temporary file can be made");
      std::fflush(nullptr);
      const pid_t child = fork();
      if (child < 0) throw std::runtime_error("no further process can be made");
      if (child == 0) work(next, seconds_each, file.get(), task);
      working.emplace(child, Worker{next++, std::move(file)});
    }
    if (working.empty()) return;
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    const auto worker = working.find(ended);
    if (worker == working.end()) continue;
    take(end_of(worker->second, status));
    working.erase(worker);
  }
}

}  // namespace kurbel::bench
