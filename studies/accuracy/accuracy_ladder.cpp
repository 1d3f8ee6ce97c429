// accuracy_ladder.cpp — the sequence of methods and tolerances: error and time of every setting.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "studies/accuracy/accuracy_work.h"
#include "studies/findings/figure_changes.h"

namespace kurbel {
namespace {

// A method whose trajectory differs from the references by this multiple of their agreement cannot improve.
constexpr double floor_is_reached = 2;

// Motion error below which an intermediate level needs no further tolerances, unless methods are named.
constexpr double enough_between = 1e-6;

struct Climber {
  std::size_t level;
  std::string method;
  bool open = true;
  double last_cost = 0, growth = 2;  // of a whole rung [s], from rung to rung
  int beaten = 0;                    // rungs running
};

std::vector<std::string> methods_for(const AccuracyWork& work, const LevelAtWork& level) {
  std::vector<std::string> methods = work.options.methods;
  if (methods.empty() && level.between) return {level.reported.first, level.reported.second};
  if (methods.empty())
    methods = {"work", "dopri5", "verner6", "dop853", "fehlberg8", "adams", "esdirk3", "esdirk", "esdirk5", "bdf"};
  if (!level.tables) std::erase(methods, "work");
  return methods;
}

// The integration with its peaks and cycles, as a user needs it, without samples and energy audit. A setting far
// slower than others is timed once.
bool time_runs(MeasuredSetting& s, const AccuracyWork& work, const LevelAtWork& level) {
  constexpr double by_far = 1.5;
  std::vector<double> seconds;
  double sum = 0;
  const int least = 3;
  while (static_cast<int>(seconds.size()) < work.options.most_repetitions &&
         (static_cast<int>(seconds.size()) < least || sum < 0.03)) {
    Equations equations(level.model, false);
    ExtremeRecorder extremes(extremes_of(*level.model));
    CycleRecorder cycles;
    RunOptions o{.tolerance = s.tolerance,
                 .method = s.method,
                 .until = level.model->scene.run.until,
                 .budget = work.options.time,
                 .interrupted = work.options.watch.interrupted,
                 .progress = {},
                 .work_tables = level.tables};
    const RunOutcome outcome = integrate(equations, o, {&extremes, &cycles});
    if (!outcome.complete) return false;
    seconds.push_back(outcome.statistics.cpu_seconds);
    sum += seconds.back();
    if (sum > 1 || times_beaten(work.study, s, seconds.back()) > by_far) break;
  }
  set_times(s, seconds);
  return true;
}

void take_rung(AccuracyWork& work, Climber& c, double tolerance) {
  LevelAtWork& level = work.levels[c.level];
  MeasuredSetting s;
  s.level = c.level;
  s.method = c.method;
  s.tolerance = tolerance;
  Result r;
  try {
    SimulateOptions o = work.simulate_options(c.method, tolerance);
    o.budget = work.options.time / 15;
    r = simulate(level.model, level.reported.name, o);
  } catch (const std::invalid_argument& refusal) {
    c.open = false;
    return work.omit(fmt::format("{}, {}", level.reported.name, c.method), refusal.what());
  }
  if (!r.complete) {
    c.open = false;
    return work.omit(fmt::format("{}, {} at {:.0e} and tighter", level.reported.name, c.method, tolerance),
                     r.diagnosis);
  }
  const double difference = trajectory_difference(*r.trajectory, *level.reference.trajectory);
  s.trajectory_error = std::max(difference, level.reported.agreement);
  measure_figures(s, work, level, [&](const std::string& name) {
    const Figure* f = like_in(r, *work.levels[work.study.fullest].reference.find(name));
    return f ? f->value : not_known;
  });
  const StepperStatistics& counts = r.statistics.stepper;
  s.steps = counts.steps;
  s.rejected = counts.rejected;
  s.flow_calls = counts.flow_calls;
  s.jacobian_calls = counts.jacobian_calls;
  s.events = r.statistics.events;
  s.energy_drift = r.energy.relative;
  if (!time_runs(s, work, level)) {
    c.open = false;
    return;
  }
  c.beaten = times_beaten(work.study, s, s.seconds) > hopeless ? c.beaten + 1 : 0;
  if (c.beaten == hopeless_rungs && !level.between && work.options.methods.empty()) {
    c.open = false;
    give_up(work, level.reported.name, c.method, tolerance);
  }
  work.study.settings.push_back(s);
  // One more tolerance at the floor confirms it.
  if (difference <= floor_is_reached * level.reported.agreement) c.open = false;
  if (level.between && work.options.methods.empty() && difference <= enough_between) c.open = false;
}

}  // namespace

// Loose tolerances of all methods before tight ones of any, so that a study cut short covers all methods.
void climb_ladder(AccuracyWork& work) {
  std::vector<Climber> climbers;
  for (std::size_t i = 0; i < work.levels.size(); ++i)
    for (const std::string& method : methods_for(work, work.levels[i]))
      climbers.push_back({.level = i, .method = method});
  const double rung_limit = work.options.time / 15;
  const double rungs = static_cast<double>(climbers.size() * work.options.tolerances.size());
  double done = 0;
  for (const double tolerance : work.options.tolerances)
    for (Climber& c : climbers) {
      done += 1;
      if (!c.open) continue;
      if (work.interrupted()) return;
      work.progress(fmt::format("{}, {} at {:.0e}", work.levels[c.level].reported.name, c.method, tolerance),
                    done / rungs);
      const double expected = c.growth * c.last_cost;
      if (expected > rung_limit || work.spent() + expected > work.options.time) {
        work.omit(fmt::format("{}, {} at {:.0e} and tighter", work.levels[c.level].reported.name, c.method, tolerance),
                  fmt::format("would take some {:.2g} s of the study's {:g} s", expected, work.options.time));
        c.open = false;
        continue;
      }
      const double before = work.spent();
      take_rung(work, c, tolerance);
      const double cost = work.spent() - before;
      if (c.last_cost > 0) c.growth = std::clamp(cost / c.last_cost, 1.2, 10.0);
      c.last_cost = cost;
    }
}

}  // namespace kurbel
