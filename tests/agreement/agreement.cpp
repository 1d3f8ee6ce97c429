// agreement.cpp — each verb's answer held against the settled run.
#include "tests/agreement/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/return_map/periodicity.h"
#include "studies/reduce/reduce.h"
#include "studies/run/compare.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"

namespace kurbel::agreement {
namespace {

constexpr double left_by_runs = 1e-7;       // of the scale
constexpr double settled_within = 1e-5;     // δ as `size` simulates it, by its own account, over itself
constexpr double most_whole_periods = 100;  // of the run within a study's cycle

// --- which figure of `steady` stands for which of the run: the only place that knows their names ---

const Figure* figure_of(const SteadyCycle& cycle, const Name& name) { return find(cycle.figures, name.text); }

struct Reported {
  double value = 0, error = 0;
};
using Find = std::optional<Reported> (*)(const SteadyCycle&, const Measured&);

std::optional<Reported> by_name(const SteadyCycle& cycle, const Measured& m) {
  const Figure* f = figure_of(cycle, m.name.of_cycle());
  return f ? std::optional(Reported{f->value, f->error.value_or(0)}) : std::nullopt;
}
// Two elements of one component may have accounts of one name: their sum. What works nothing is not listed.
std::optional<Reported> summed_by_name(const SteadyCycle& cycle, const Measured& m) {
  Reported sum;
  for (const Figure& f : cycle.figures)
    if (f.name == m.name.text) sum.value += f.value, sum.error += f.error.value_or(0);
  return sum;
}
std::optional<Reported> mid_speed(const SteadyCycle& cycle, const Measured& m) {
  const Figure* f = figure_of(cycle, Name::make(quantities::mid_speed, m.name.of));
  return f ? std::optional(Reported{f->value, f->error.value_or(0)}) : std::nullopt;
}
// All that repeats, whatever the link's own cycle is.
std::optional<Reported> period(const SteadyCycle& cycle, const Measured&) {
  const Figure* f = figure_of(cycle, Name::make(quantities::period));
  return f ? std::optional(Reported{f->value, f->error.value_or(0)}) : std::nullopt;
}

struct Counterpart {
  QuantityKind what;
  Topic topic;
  Find find;
  bool per_cycle = false;  // of a study's cycle of r periods of the run: r times as much
};
constexpr Counterpart counterparts[] = {
    {quantities::mean_speed, Topic::mean_speed, by_name},
    {quantities::other, Topic::mid_speed, mid_speed},  // the only one of the run without a kind
    {quantities::delta, Topic::delta, by_name},
    {quantities::cycle_time, Topic::period, period, true},
    {quantities::peak_torque, Topic::peaks, by_name},
    {quantities::rms_torque, Topic::rms, by_name},
    {quantities::driving_work_per_cycle, Topic::works, by_name, true},
    {quantities::useful_work_per_cycle, Topic::works, by_name, true},
    {quantities::harmful_work_per_cycle, Topic::works, by_name, true},
    {quantities::weight_work_per_cycle, Topic::works, by_name, true},
    {quantities::work_per_cycle, Topic::works, summed_by_name, true},
};

// ---------------------------------------------------------------------------------------------------------------------

Verdict worse_of(bool agrees, const std::vector<std::string>& notes) {
  return agrees ? Verdict::agrees : reports_how_much(notes) ? Verdict::reported : Verdict::silent;
}

class Comparison {
 public:
  Comparison(const Scene& scene, const Questions& questions, const SettleSettings& settings)
      : scene_(scene), questions_(questions), settings_(settings) {}

  Row run() {
    const double begin = processor_time();
    run_ = settle(scene_, scene_.effects, settings_);
    row_.kind = run_.kind;
    row_.orbit = run_.words;
    if (run_.kind != Motion::none) {
      if (questions_.steady) refusable(steady_topics(), [this] { ask_steady(); });
      if (questions_.reduce && run_.kind == Motion::repeats)
        refusable({Topic::energy, Topic::mean_torques}, [this] { ask_reduce(); });
      if (questions_.size && run_.kind == Motion::repeats && !run_.equilibrium())
        refusable({Topic::sized_delta}, [this] { ask_size(); });
    }
    row_.cpu_seconds = processor_time() - begin;
    return std::move(row_);
  }

 private:
  std::vector<Topic> steady_topics() const {
    if (run_.kind == Motion::rests) return {Topic::mean_speed};
    std::vector<Topic> topics;
    for (const Measured& m : run_.figures)
      for (const Counterpart& c : counterparts)
        if (m.needed && c.what == m.name.what && std::find(topics.begin(), topics.end(), c.topic) == topics.end())
          topics.push_back(c.topic);
    if (questions_.multipliers && dies_away()) topics.push_back(Topic::multipliers);
    return topics;
  }
  // Elsewhere a phase stays behind, and no section is the same for run and disturbed run.
  bool dies_away() const { return run_.base == Base::angle || run_.base == Base::time; }
  // What a verb throws is a refusal of every topic requested from it.
  void refusable(const std::vector<Topic>& topics, const std::function<void()>& ask) {
    try {
      ask();
    } catch (const SceneError& error) {
      refuse(topics, error.what());
    } catch (const std::invalid_argument& error) {
      refuse(topics, error.what());
    }
  }
  void refuse(const std::vector<Topic>& topics, const std::string& why) {
    for (const Topic topic : topics)
      row_.figures.push_back({topic, "", 0, 0, 0, Verdict::refused, why.empty() ? "no reason given" : why});
  }
  void compare(Topic topic, const std::string& figure, double run, double study, double allowed,
               const std::vector<std::string>& notes) {
    const Verdict verdict = worse_of(std::abs(run - study) <= allowed, notes);
    row_.figures.push_back({topic, figure, run, study, allowed, verdict, {}});
  }

  // --- steady ---

  void ask_steady() {
    const SteadyStudy study = steady(scene_, {scene_.effects}, {.start_search = false});
    const SteadyCycle* cycle = study.cycles.empty() ? nullptr : &study.cycles.front();
    const std::string why = cycle && !cycle->why.empty() ? cycle->why : study.diagnosis;
    if (run_.kind == Motion::rests) return judge_rest(study, cycle && cycle->found, why);
    if (!cycle || !cycle->found) return refuse(steady_topics(), why);
    for (const Measured& m : run_.figures) judge(m, *cycle, study.notes);
    if (questions_.multipliers) judge_multipliers(*cycle, study.notes);
  }
  // A machine that comes to rest has no cycle: that it has none is the answer.
  void judge_rest(const SteadyStudy& study, bool found, const std::string& why) {
    Compared c{Topic::mean_speed, "at rest", 0, 0, 0, Verdict::agrees, why};
    if (found) {
      const Figure* mean = figure_of(study.cycles.front(), Name::make(quantities::mean_speed, run_.link));
      c.study = mean ? mean->value : NAN;
      c.verdict = worse_of(mean && std::abs(mean->value) <= mean->error.value_or(0), study.notes);
    }
    row_.figures.push_back(std::move(c));
  }
  void judge(const Measured& m, const SteadyCycle& cycle, const std::vector<std::string>& notes) {
    for (const Counterpart& c : counterparts) {
      if (c.what != m.name.what || (c.what == quantities::other && !m.needed)) continue;
      if (c.per_cycle && run_.base == Base::none) return;  // any time is a period
      const std::optional<Reported> reported = c.find(cycle, m);
      if (!reported) {
        if (m.needed) refuse({c.topic}, m.name.text + " is not told");
        return;
      }
      const double rounds = c.per_cycle ? periods_in(cycle) : 1;
      double study = reported->value;
      if (is_peak(m.name.what)) study = std::copysign(study, m.value);  // of two equal ones either may be taken
      compare(c.topic, m.name.text, rounds * m.value, study,
              rounds * (m.error + left_by_runs * m.scale) + reported->error, notes);
      return;
    }
  }
  // A study's cycle may be several periods of the run.
  double periods_in(const SteadyCycle& cycle) const {
    const double rounds = std::round(cycle.cycle_time / run_.period);
    const bool whole =
        rounds >= 1 && rounds < most_whole_periods && std::abs(cycle.cycle_time / run_.period - rounds) < 1e-3 * rounds;
    return whole ? rounds : 1;
  }
  void judge_multipliers(const SteadyCycle& cycle, const std::vector<std::string>& notes) {
    if (cycle.neutral || !dies_away()) return;
    const Decay decay = decay_of(run_);
    if (cycle.point.multipliers.empty() && decay.factor > 0) {
      row_.figures.push_back({Topic::multipliers, "largest", decay.factor, 0, 0, Verdict::refused,
                              "a period told by events: no multipliers, and steady says so"});
      return;
    }
    const double reported = std::pow(cycle.point.largest(), 1 / periods_in(cycle));
    if (decay.measured)
      return compare(Topic::multipliers, "largest", decay.factor, reported, decay.error + 1e-3, notes);
    if (decay.periods == 0 && decay.factor == 0) return;
    // Too fast to be measured: it must be reported as at least so fast.
    const Verdict verdict = worse_of(reported <= decay.factor + 1e-3, notes);
    row_.figures.push_back({Topic::multipliers, "largest, at most", decay.factor, reported, 0, verdict, {}});
  }

  // --- reduce ---

  void ask_reduce() {
    constexpr int number = 12;
    ReduceOptions options;
    options.positions = number;
    const MachineReduction reduced = reduce(scene_, options);
    // Where time alone drives, the link's angle has no place in the cycle.
    const Periodicity laws = periodicity_of(*compile(scene_, scene_.effects));
    if (!laws.by_time || laws.angle_matters) compare_energies(reduced, places_of(run_, reduced.cycle, number));
    if (std::abs(run_.angle) < 1e-9) return;  // the link stands
    double driving = 0, resisting = 0, error = 0;
    for (const Measured& m : run_.figures) {
      const bool drives = m.name.what == quantities::driving_work_per_cycle;
      if (!drives && m.name.what != quantities::useful_work_per_cycle &&
          m.name.what != quantities::harmful_work_per_cycle && m.name.what != quantities::weight_work_per_cycle)
        continue;
      (drives ? driving : resisting) += m.value;
      error += m.error + left_by_runs * m.scale;
    }
    const double allowed = error / std::abs(run_.angle);
    compare(Topic::mean_torques, "mean drive torque", driving / run_.angle, reduced.mean_drive.value, allowed,
            reduced.notes);
    compare(Topic::mean_torques, "mean load torque", -resisting / run_.angle, reduced.mean_load.value, allowed,
            reduced.notes);
  }
  // ½ I_r ω² at the run's speeds against the kinetic energy that the run has.
  void compare_energies(const MachineReduction& reduced, const std::vector<Place>& places) {
    if (reduced.to_output || places.empty() || reduced.positions.empty()) return;
    Compared worst{Topic::energy, "", 0, 0, 0, Verdict::agrees, {}};
    double largest = -1;
    for (const Place& place : places) {
      const ReducedPosition* nearest = nullptr;
      double distance = HUGE_VAL;
      for (const ReducedPosition& p : reduced.positions) {
        const double apart = std::abs(std::remainder(p.phi - place.angle, reduced.cycle));
        if (apart < distance) distance = apart, nearest = &p;
      }
      if (distance > 1e-6) continue;
      const double reported = 0.5 * nearest->inertia * place.speed * place.speed;
      if (std::abs(reported - place.kinetic_energy) <= largest) continue;
      largest = std::abs(reported - place.kinetic_energy);
      worst.figure = fmt::format("at {:.4g} deg", nearest->phi * 180 / std::numbers::pi);
      worst.run = place.kinetic_energy, worst.study = reported;
      worst.allowed = left_by_runs * std::max(place.kinetic_energy, 1e-300);
    }
    if (largest < 0) return;
    worst.verdict = worse_of(largest <= worst.allowed, reduced.notes);
    row_.figures.push_back(std::move(worst));
  }

  // --- size ---

  // A flywheel for three fifths of the fluctuation that is there; what is said to be reached, put into the scene.
  void ask_size() {
    const Measured* delta = run_.find(quantities::delta, run_.link);
    SizeOptions options;
    options.delta = 0.6 * delta->value;
    if (*options.delta < 1e-4) return;
    const Sizing sizing = size_flywheel(scene_, options);
    if (!sizing.needed)
      return compare(Topic::sized_delta, "as it is, said to be enough", delta->value, *options.delta, 0, sizing.notes);
    const DeltaReached* reported = reached_by(sizing);
    if (!reported)
      return refuse({Topic::sized_delta}, sizing.diagnosis.empty() ? "no δ is told as reached" : sizing.diagnosis);
    const Scene sized = with_flywheel(scene_, sizing.flywheel, reported->flywheel, sizing.link);
    const SettledRun run = settle(sized, scene_.effects, settings_);
    const Measured* reached = run.find(quantities::delta, run_.link);
    std::vector<std::string> notes = sizing.notes;
    if (!reached) return refuse({Topic::sized_delta}, "the sized machine is not settled: " + run.words);
    compare(Topic::sized_delta, fmt::format("{}, {:.4g} kg*m2", sizing.flywheel, reported->flywheel), reached->value,
            reported->crank.value,
            reached->error + reported->crank.error.value_or(0) + left_by_runs + settled_within * reported->crank.value,
            notes);
  }
  // Of the scene's effects: the elastic machine where something of it is elastic; by the better of the sizings.
  const DeltaReached* reached_by(const Sizing& sizing) const {
    const SizedModel wanted = is_elastic(*run_.model) ? SizedModel::elastic : SizedModel::rigid;
    const DeltaReached* best = nullptr;
    for (const DeltaReached& r : sizing.reached)
      if (r.model == wanted && (!best || r.by != SizedBy::constant_drive)) best = &r;
    return best;
  }

  const Scene& scene_;
  Questions questions_;
  SettleSettings settings_;
  SettledRun run_;
  Row row_;
};

}  // namespace

Row compare_verbs(const Scene& scene, const Questions& questions, const SettleSettings& settings) {
  return Comparison(scene, questions, settings).run();
}

bool reports_how_much(const std::vector<std::string>& notes) {
  static const char* const leaving[] = {"omitted", "omits", "taken as", "counts as", "neglected", "not counted"};
  return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    const bool leaves = std::any_of(std::begin(leaving), std::end(leaving),
                                    [&](const char* words) { return note.find(words) != std::string::npos; });
    return leaves && note.find_first_of("0123456789") != std::string::npos;
  });
}

std::vector<std::string> scene_files(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    if (file.path().extension() == ".toml") found.push_back(file.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace kurbel::agreement
