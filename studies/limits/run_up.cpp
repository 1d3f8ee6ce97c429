// run_up.cpp — final motion of a start from rest, its duration, and its peaks by three runs.
#include "studies/limits/run_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "engine/run/recorders.h"
#include "engine/values/dense_tables.h"

namespace kurbel {
namespace {

constexpr double tolerance = 1e-9, looser = 30;  // of the steps
constexpr double arrived = 0.99;                 // of the least speed of the link in steady motion
constexpr double same_motion = 1e-3;             // of two mean speeds
constexpr int most_periods = 200;                // to find where a run-up made from rest leads
constexpr double longest = 20;                   // times what the search or the scene takes

class Search {
 public:
  Search(std::shared_ptr<const Model> machine, const Orbit& orbit, const SteadyLoads& loads,
         const std::vector<LimitedJoint>& joints, const Watch& watch)
      : machine_(std::move(machine)), orbit_(&orbit), loads_(loads), joints_(joints), watch_(watch) {}

  RunUp result() {
    if (!begins_at_rest(machine_)) {
      if (!loads_.found) return none(loads_.words);
      if (!make_from_rest()) return out_;
    } else if (loads_.found) {
      if (!find_end()) return out_;
    } else if (orbit_->kind == Orbit::Kind::drifting || orbit_->kind == Orbit::Kind::at_rest) {
      out_.until = std::max(machine_->scene.run.until, orbit_->state.t);  // all is switched by then
    } else {
      return none("the scene's own start leads to no steady motion: " + loads_.words);
    }
    find_peaks();
    return out_;
  }

 private:
  RunUp none(std::string why) {
    out_.words = std::move(why);
    return out_;
  }

  static double link_speed(const Model& m, Equations& equations, double t, std::span<const double> y) {
    const TrackedAngle& link = m.angles[at(m.reduction_angle)];
    if (static_cast<std::size_t>(link.shaft) < m.free_shafts) return link.gain * y[equations.speed_index(link.shaft)];
    return link.gain * equations.snapshot(t, y).now.speed[link.shaft];
  }
  // The same machine, initially standing and unloaded; whether it reaches the same motion.
  bool make_from_rest() {
    out_.made = true;
    Scene scene = machine_->scene;
    const Location where = scene.run.start.at;
    scene.run.start = {};
    scene.run.start.at = where;
    try {
      machine_ = compile(scene, machine_->effects);
      if (!begins_at_rest(machine_)) return none("the scene prescribes a speed: there is no start from rest"), false;
      if (!find_end()) return false;
      OrbitOptions options;
      options.budget = scene.run.budget;
      options.most_periods = most_periods;
      options.interrupted = watch_.interrupted;
      made_ = find_orbit(machine_, options);
    } catch (const std::exception& error) {
      return none(fmt::format("from rest, which the scene does not give: {}", error.what())), false;
    }
    const SteadyLoads there = steady_loads(made_, machine_, joints_);
    if (!there.found || std::abs(there.speed - loads_.speed) > same_motion * std::abs(loads_.speed)) {
      none(there.found ? fmt::format("from rest the machine does not reach this motion: its mean speed would be "
                                     "{}, not {}",
                                     speed_text(there.speed), speed_text(loads_.speed))
                       : "from rest the machine does not reach this motion: " + made_.words);
      return false;
    }
    out_.until = std::max(out_.until, made_.state.t + 2 * loads_.round);
    return true;
  }
  std::string where_to() const {
    if (loads_.found) return "to " + speed_text(loads_.speed);
    return orbit_->kind == Orbit::Kind::at_rest ? "until it stands" : "to a motion that does not repeat";
  }
  std::string speed_text(double speed) const { return machine_->scene.speed_unit.text(speed, 5); }

  RunOptions run_options(double until) const {
    return {.tolerance = tolerance,
            .method = "auto",
            .until = until,
            .budget = machine_->scene.run.budget,
            .interrupted = watch_.interrupted,
            .progress = {}};
  }

  // A link that stands in steady motion is no criterion; the end is then where the search found the steady motion.
  bool find_end() {
    const Model& m = *machine_;
    out_.until = orbit_->state.t;
    if (loads_.slowest > 1e-6 * m.speed_scale) {
      Equations equations(machine_, false);
      const double sense = loads_.speed < 0 ? -1 : 1;
      RunOptions run = run_options(longest * std::max({m.scene.run.until, orbit_->state.t, 10 * loads_.round}));
      run.tolerance *= looser;
      run.stop = [&, sense](double t, std::span<const double> y) {
        return std::clamp(1 - sense * link_speed(m, equations, t, y) / (arrived * loads_.slowest), -1.0, 1.0);
      };
      watch_.at("run-up from rest", 0.1);
      const RunOutcome outcome = integrate(equations, run, {});
      if (!outcome.stopped)
        return none(fmt::format("from rest the machine does not reach {} within {:.4g} s{}{}",
                                speed_text(loads_.slowest), outcome.t, outcome.diagnosis.empty() ? "" : ": ",
                                outcome.diagnosis)),
               false;
      out_.until = std::max(out_.until, outcome.t);
    }
    out_.until += 2 * loads_.round;
    return true;
  }

  std::vector<RunUp::Peak> peaks(double tolerance_of_steps, bool elsewhere) {
    std::vector<ExtremeOf> wanted;
    for (const LimitedJoint& joint : joints_) wanted.push_back(torque_extreme(*machine_, joint, Functional::peak));
    ExtremeRecorder recorder(std::move(wanted));
    Equations equations(machine_, false);
    RunOptions run = run_options(out_.until);
    run.tolerance = tolerance_of_steps;
    run.elsewhere = elsewhere;
    const RunOutcome outcome = integrate(equations, run, {&recorder});
    if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
    std::vector<RunUp::Peak> found;
    for (const ExtremeRecorder::Found& f : recorder.found()) found.push_back({{f.value, 0}, f.time});
    return found;
  }

  void find_peaks() {
    try {
      watch_.at("run-up from rest", 0.3);
      out_.peaks = peaks(tolerance, false);
      watch_.at("run-up from rest", 0.6);
      const std::vector<RunUp::Peak> coarse = peaks(looser * tolerance, false);
      const std::vector<RunUp::Peak> elsewhere = peaks(tolerance, true);
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        // Of two peaks of similar size either may be the larger.
        const auto apart = [&](const RunUp::Peak& other) {
          return std::abs(std::abs(other.torque.value) - std::abs(out_.peaks[i].torque.value));
        };
        const double scale = std::max(joints_[i].rated, std::abs(out_.peaks[i].torque.value));
        out_.peaks[i].torque.error = std::max(apart(coarse[i]), 2 * apart(elsewhere[i])) + 1e-9 * joints_[i].rated +
                                     left_by_tables(machine_->scene) * scale;
      }
    } catch (const std::runtime_error& error) {
      none(error.what());
      return;
    }
    out_.found = true;
    out_.words =
        fmt::format("{} from rest{}, {} at {:.4g} s",
                    out_.made ? "a run-up made for this purpose, not given by the scene," : "the scene's own start",
                    machine_->scene.run.start.equilibrium ? " with its twists in balance" : "", where_to(), out_.until);
  }

  std::shared_ptr<const Model> machine_;
  const Orbit* orbit_;
  const SteadyLoads& loads_;
  const std::vector<LimitedJoint>& joints_;
  const Watch& watch_;
  Orbit made_;
  RunUp out_;
};

}  // namespace

bool begins_at_rest(const std::shared_ptr<const Model>& machine) {
  Equations equations(machine, false);
  const std::vector<double> y = equations.start(0);
  const Snapshot& s = equations.snapshot(0, y);
  for (std::size_t k = 0; k < machine->shafts.size(); ++k)
    if (std::abs(s.now.speed[k]) > 1e-9 * machine->shafts[k].speed_scale) return false;
  return true;
}

RunUp find_run_up(const std::shared_ptr<const Model>& machine, const Orbit& orbit, const SteadyLoads& loads,
                  const std::vector<LimitedJoint>& joints, const Watch& watch) {
  return Search(machine, orbit, loads, joints, watch).result();
}

}  // namespace kurbel
