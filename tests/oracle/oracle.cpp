// oracle.cpp — a program: what each scene's machine did by the classifier, and what the studies say of it, a line of JSON each.
//
//     kurbel_oracle FILE…                      scenes one after the other; without any their names come by standard input
//     kurbel_oracle --classify FILE…           the classifier alone
//
// {"scene": …, "truth": classify.h, "run": summary of `run`, "steady": summary of `steady`, "cpu": …}; what was refused
// stands as {"refused": why} in its place.
#include <fmt/format.h>
#include <kurbel/kurbel.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "engine/numerics/deadline.h"
#include "studies/scenes/kinds.h"
#include "tests/oracle/classify.h"

namespace {

using namespace kurbel;
using nlohmann::json;

constexpr double budget = 4;         // of an integration, and of a study [s]
constexpr double cheap = 0.3;        // a run that took less goes on for longer
constexpr double times_as_long = 4;  // than the scene says
constexpr double fast = 1.5;         // times the usual speed: does it settle, or run away?
constexpr double times_to_settle = 60;

// Sets a flag when the process has worked for so long.
class Watchdog {
 public:
  Watchdog() : thread_([this] { watch(); }) {}
  ~Watchdog() { ended_ = true, thread_.join(); }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  const std::atomic<bool>* from_now() {
    interrupted_ = false, until_ = process_time() + budget;
    return &interrupted_;
  }
  bool barked() const { return interrupted_; }

 private:
  static double process_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
  void watch() {
    while (!ended_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (process_time() > until_) interrupted_ = true;
    }
  }
  std::atomic<bool> interrupted_ = false, ended_ = false;
  std::atomic<double> until_ = HUGE_VAL;
  std::thread thread_;
};

template <class Of>
json unless_refused(Of&& of) {
  try {
    return of();
  } catch (const std::exception& error) {
    return {{"refused", error.what()}};
  }
}

json truth_of(const std::string& file) {
  const Scene scene = read_scene(file, all_kinds());
  const auto model = compile(scene, scene.effects);
  const oracle::Observed seen = oracle::observe(model, scene.run.until, budget);
  if (!seen.outcome.complete || seen.cpu_seconds > cheap) return oracle::classify(seen, nullptr);
  const bool far = std::abs(seen.moments.back().speed) > fast * model->speed_scale;
  const oracle::Observed later =
      oracle::observe(model, (far ? times_to_settle : times_as_long) * scene.run.until, budget);
  return oracle::classify(seen, &later);
}

json answers_of(const std::string& file, bool of_run, Watchdog& watchdog) {
  const Machine machine = Machine::from_file(file);
  const Watcher watcher{.interrupted = watchdog.from_now()};
  const Study reported =
      of_run ? run(machine, {.page = false, .watcher = watcher}).study() : study("steady", machine, {}, watcher);
  if (watchdog.barked()) return {{"refused", "too dear"}};
  json summary = json::parse(reported.json());
  if (of_run) summary["text"] = reported.text();  // has the table of works by periods, which is for people alone
  return summary;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> files(arguments + 1, arguments + count);
  bool classify_alone = false;
  std::erase_if(files, [&](const std::string& text) {
    const bool is = text == "--classify";
    classify_alone = classify_alone || is;
    return is;
  });
  Watchdog watchdog;
  const auto answer = [&](const std::string& file) {
    const double begin = processor_time();
    json line{{"scene", file}};
    line["truth"] = unless_refused([&] { return truth_of(file); });
    line["cpu_truth"] = processor_time() - begin;
    if (!classify_alone && !line["truth"].contains("refused")) {
      line["run"] = unless_refused([&] { return answers_of(file, true, watchdog); });
      line["steady"] = unless_refused([&] { return answers_of(file, false, watchdog); });
    }
    line["cpu"] = processor_time() - begin;
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
  };
  for (const std::string& file : files) answer(file);
  if (files.empty())
    for (std::string file; std::getline(std::cin, file);)
      if (!file.empty()) answer(file);
}
