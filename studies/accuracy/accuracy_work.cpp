// accuracy_work.cpp — options of the study's runs, messages, difference of trajectories, times of repeated runs.
#include "studies/accuracy/accuracy_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {

AccuracyWork::AccuracyWork(const Scene& of, const AccuracyOptions& asked)
    : scene(of), options(asked), begin(processor_time()) {
  scene.run.model = "reduced";
  scene.run.method = "auto";
  study.is_of(of);
}

void AccuracyWork::log(const std::string& text) const { options.watch.say(text); }

void AccuracyWork::progress(const std::string& what, double fraction) const { options.watch.at(what, fraction); }

void AccuracyWork::omit(const std::string& what, const std::string& why) {
  study.omissions.push_back({what, why});
  log(fmt::format("omitted: {}: {}", what, why));
}

SimulateOptions AccuracyWork::simulate_options(const std::string& method, double tolerance) const {
  SimulateOptions o;
  o.measure_error = false;
  o.method = method;
  o.accuracy = 10 * tolerance;  // a single run takes a tenth of the accuracy as its local tolerance
  o.watch.interrupted = options.watch.interrupted;
  return o;
}

std::string link_of(const Model& model) { return model.network.nodes[at(model.reduction_node)].component; }

namespace {

// Angles count in rad, whatever was turned; speeds and twists over the largest that they reach.
bool is_state(const Channel& channel) {
  const QuantityKind& what = channel.name.what;
  return what == quantities::angle || what == quantities::speed || what == quantities::twist;
}

}  // namespace

double trajectory_difference(const TrajectoryRecorder& a, const TrajectoryRecorder& reference) {
  if (a.time().size() != reference.time().size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t k = 0; k < a.channels().size(); ++k) {
    if (!is_state(a.channels()[k])) continue;
    double scale = 0, difference = 0;
    for (std::size_t row = 0; row < a.time().size(); ++row) {
      scale = std::max(scale, std::abs(reference.value(row, k)));
      difference = std::max(difference, std::abs(a.value(row, k) - reference.value(row, k)));
    }
    if (a.channels()[k].name.what == quantities::angle) scale = 1;
    if (scale > 0) largest = std::max(largest, difference / scale);
  }
  return largest;
}

void set_times(MeasuredSetting& s, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  s.seconds = seconds[seconds.size() / 2];
  s.fastest = seconds.front();
  s.slowest = seconds.back();
  s.repetitions = static_cast<int>(seconds.size());
}

double times_beaten(const AccuracyStudy& study, const MeasuredSetting& s, double seconds) {
  const auto key = [&](const MeasuredSetting& of) {
    return study.key < of.numerical_error.size() ? of.numerical_error[study.key] : 0;
  };
  double times = 0;
  for (const MeasuredSetting& other : study.settings)
    if (other.level == s.level && other.trajectory_error <= s.trajectory_error && key(other) <= key(s))
      times = std::max(times, seconds / other.seconds);
  return times;
}

void give_up(AccuracyWork& work, const std::string& level, const std::string& method, double tolerance) {
  work.omit(fmt::format("{}, {} at tolerances below {:.0e}", level, method, tolerance),
            fmt::format("at {} tolerances running it took more than {} × the time of another method that is as exact",
                        hopeless_rungs, hopeless));
}

}  // namespace kurbel
