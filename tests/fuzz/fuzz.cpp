// fuzz.cpp — throws inputs at one target by the number: every one has a seed, so every one can be had again.
//
//     kurbel_fuzz reader --count 1000000 --seconds 600 --out build/fuzz/reader    from a clock's number on, printed
//     kurbel_fuzz reader --from 1 --count 1000
//     kurbel_fuzz run FILE…           judges these files
//
// Inputs are judged in a process of their own, so that a crash ends that one alone; what crashes, hangs or is answered
// wrongly is kept in the folder, a few of each kind.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/fuzz/targets.h"

namespace {

using namespace kurbel::fuzz;
namespace fs = std::filesystem;

struct Arguments {
  const Target* target = nullptr;
  std::uint64_t from = number_of_now(), count = 1000;
  double seconds = 1e9;
  std::string out = "fuzz";
  std::vector<std::string> files;
};

// What the worker reports to its parent while it works.
struct Shared {
  std::atomic<std::uint64_t> at, done;
  std::atomic<double> begun;  // processor time of the worker when the input came [s]
};

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The same fault with other numbers is the same fault.
std::string kind_of(const std::string& fault) {
  std::string kind;
  for (const char c : fault.substr(0, 160))
    if (std::isalpha(static_cast<unsigned char>(c)))
      kind += c;
    else if (!kind.empty() && kind.back() != '-')
      kind += '-';
  return kind.substr(0, 80);
}

class Findings {
 public:
  Findings(const Arguments& arguments) : a_(arguments) { fs::create_directories(a_.out); }
  void keep(const std::string& what, std::uint64_t number, const std::string& fault) {
    const std::string kind = what + "-" + kind_of(fault);
    if (++times_[kind] > 3) return;
    const fs::path path = fs::path(a_.out) / fmt::format("{}-{}-{}.toml", a_.target->name, what, number);
    std::ofstream(path, std::ios::binary) << input_of(*a_.target, number);
    fmt::print("{} {}: {}\n  {}\n", what, number, fault, path.string());
    std::fflush(stdout);
  }
  std::size_t kinds() const { return times_.size(); }
  std::uint64_t all() const {
    std::uint64_t sum = 0;
    for (const auto& [kind, times] : times_) sum += times;
    return sum;
  }

 private:
  const Arguments& a_;
  std::map<std::string, std::uint64_t> times_;
};

// In the worker: a line for each fault goes to the parent.
[[noreturn]] void work(const Arguments& a, Shared& shared, std::uint64_t from, std::uint64_t to, double until,
                       int pipe) {
  for (std::uint64_t number = from; number < to && seconds_of(CLOCK_MONOTONIC) < until; ++number) {
    shared.begun = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    shared.at = number;
    std::string fault = a.target->judge(input_of(*a.target, number));
    shared.done = number + 1;
    if (fault.empty()) continue;
    std::replace(fault.begin(), fault.end(), '\n', ' ');
    const std::string line = fmt::format("{} {}\n", number, fault.substr(0, 600));
    if (write(pipe, line.data(), line.size()) < 0) _exit(1);
  }
  _exit(0);
}

double processor_time(pid_t process) {
  clockid_t clock = 0;
  return clock_getcpuclockid(process, &clock) == 0 ? seconds_of(clock) : 0;
}

void read_faults(int pipe, std::string& rest, Findings& findings) {
  char buffer[4096];
  for (ssize_t n = 0; (n = read(pipe, buffer, sizeof buffer)) > 0;) rest.append(buffer, static_cast<std::size_t>(n));
  for (std::size_t end = 0; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1)) {
    const std::size_t blank = rest.find(' ');
    findings.keep("fault", std::strtoull(rest.c_str(), nullptr, 10), rest.substr(blank + 1, end - blank - 1));
  }
}

// One worker until it is through, crashes or hangs; the number to go on from.
std::uint64_t batch(const Arguments& a, Shared& shared, std::uint64_t from, std::uint64_t to, double until,
                    Findings& findings) {
  int ends[2];
  if (pipe2(ends, O_NONBLOCK) != 0) std::abort();
  shared.at = shared.done = from;
  const pid_t worker = fork();
  if (worker == 0) {
    close(ends[0]);
    work(a, shared, from, to, until, ends[1]);
  }
  close(ends[1]);
  std::string rest;
  int status = 0;
  bool hung = false;
  while (waitpid(worker, &status, WNOHANG) == 0) {
    usleep(20'000);
    read_faults(ends[0], rest, findings);
    if (hung || shared.done > shared.at || processor_time(worker) - shared.begun < a.target->patience) continue;
    hung = true;
    kill(worker, SIGKILL);
  }
  read_faults(ends[0], rest, findings);
  close(ends[0]);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return shared.done;
  const std::uint64_t at = shared.at;
  if (hung)
    findings.keep("hang", at, fmt::format("no answer within {} s", a.target->patience));
  else
    findings.keep("crash", at, WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "ended by a sanitizer");
  return at + 1;
}

int campaign(const Arguments& a) {
  auto* shared =
      static_cast<Shared*>(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  Findings findings(a);
  const double begin = seconds_of(CLOCK_MONOTONIC);
  fmt::print("{}: inputs from {} on\n", a.target->name, a.from);
  std::fflush(stdout);
  const std::uint64_t end = a.from + a.count, at_once = 2000;
  std::uint64_t number = a.from;
  for (double reported = begin; number < end && seconds_of(CLOCK_MONOTONIC) - begin < a.seconds;) {
    number = batch(a, *shared, number, std::min(end, number + at_once), std::min(begin + a.seconds, reported + 60),
                   findings);
    if (seconds_of(CLOCK_MONOTONIC) - reported < 60 || number >= end) continue;
    reported = seconds_of(CLOCK_MONOTONIC);
    fmt::print("{}: {} inputs in {:.0f} s, {} findings of {} kinds\n", a.target->name, number - a.from,
               reported - begin, findings.all(), findings.kinds());
    std::fflush(stdout);
  }
  fmt::print("{}: {} inputs from {} in {:.0f} s: {} findings of {} kinds\n", a.target->name, number - a.from, a.from,
             seconds_of(CLOCK_MONOTONIC) - begin, findings.all(), findings.kinds());
  return findings.all() == 0 ? 0 : 1;
}

int replay(const Arguments& a) {
  int faults = 0;
  for (const std::string& file : a.files) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    const double begin = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    const std::string fault = a.target->judge(text.str());
    faults += !fault.empty();
    fmt::print("{}: {} ({:.2f} s)\n", file, fault.empty() ? "no fault" : fault,
               seconds_of(CLOCK_PROCESS_CPUTIME_ID) - begin);
  }
  return faults == 0 ? 0 : 1;
}

int refuse() {
  fmt::print(
      stderr,
      "kurbel_fuzz TARGET [--from NUMBER] [--count INPUTS] [--seconds S] [--out FOLDER] [--print] [FILE…]; targets:\n");
  for (const Target& target : targets()) fmt::print(stderr, "  {:8} {}\n", target.name, target.asks);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  bool print = false;
  if (argc < 2 || !(a.target = target_named(argv[1]))) return refuse();
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--from" && more)
      a.from = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--count" && more)
      a.count = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--seconds" && more)
      a.seconds = std::strtod(argv[++i], nullptr);
    else if (word == "--out" && more)
      a.out = argv[++i];
    else if (word == "--print")
      print = true;
    else if (word.starts_with("--"))
      return refuse();
    else
      a.files.push_back(word);
  }
  if (print) {
    for (std::uint64_t k = 0; k < a.count; ++k) fmt::print("{}", input_of(*a.target, a.from + k));
    return 0;
  }
  return a.files.empty() ? campaign(a) : replay(a);
}
