// load_cases.cpp — the sequence and the three periods of a run as load cases.
#include "studies/limits/load_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/limits/verdicts.h"

namespace kurbel {
namespace {

constexpr double again = 0.99;
constexpr int least_samples_of_a_cycle = 100;

bool comes_again(const Result& r, const Figure& peak) {
  if (!r.trajectory || r.cycles.empty() || r.trajectory->time().size() < 2) return true;
  const std::vector<double>& time = r.trajectory->time();
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  if (r.cycles.back().end - r.cycles.back().begin < least_samples_of_a_cycle * step) return true;
  const std::optional<double> later = largest_sample_from(r, peak, 0.5 * (time.front() + time.back()));
  const std::optional<double> ever = largest_sample_from(r, peak, time.front());
  return !later || *later >= again * *ever;
}

}  // namespace

std::string load_case_at(const Result& r, std::optional<double> at) {
  const Periods& p = r.periods;
  if (!at || !r.model || r.begins_at > 0) return load_case::run;
  const std::vector<SequenceStep>& steps = r.model->scene.sequence.steps;
  std::size_t taken = 0, given = 0;  // steps; commands of the one under way
  // Steps due at the start have no event.
  const auto due_at_once = [](const SequenceStep& step) {
    return (step.when == SequenceStep::When::at || step.when == SequenceStep::When::after) && step.value <= 0;
  };
  while (taken < steps.size() && due_at_once(steps[taken])) ++taken;
  for (const Event& e : r.events) {
    if (e.kind != EventKind::command || e.t > *at || steps.empty()) continue;
    if (++given == steps[taken % steps.size()].set.size()) ++taken, given = 0;
  }
  if (taken > 0) return fmt::format("after step {} of the sequence", (taken - 1) % steps.size() + 1);
  const bool starts =
      std::any_of(r.claims.begin(), r.claims.end(), [](const Claim& c) { return c.predicate == Predicate::starts; });
  if (!p.steady)
    return starts && begins_at_rest(r.model) ? load_case::start : load_case::run;  // it is still on its way
  if (p.run_down_begin && *at > *p.run_down_begin) return load_case::run_down;
  if (!p.run_up_end || *at > *p.run_up_end) return load_case::steady;
  return begins_at_rest(r.model) ? load_case::start : load_case::run;
}

std::optional<double> largest_sample_from(const Result& r, const Figure& peak, double from) {
  if (!r.trajectory) return {};
  const TrajectoryRecorder& trajectory = *r.trajectory;
  const std::vector<Channel>& channels = trajectory.channels();
  const auto torque = std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) {
    return channel.name.what == quantities::torque && channel.name.of == peak.of;
  });
  if (torque == channels.end()) return {};
  const auto column = static_cast<std::size_t>(torque - channels.begin());
  double largest = 0;
  for (std::size_t row = 0; row < trajectory.time().size(); ++row)
    if (trajectory.time()[row] >= from) largest = std::max(largest, std::abs(trajectory.value(row, column)));
  return largest;
}

std::string load_case_of_peak(const Result& r, const Figure& peak) {
  const std::string moment = load_case_at(r, peak.at);
  return moment == load_case::steady && !comes_again(r, peak) ? std::string(load_case::run) : moment;
}

}  // namespace kurbel
