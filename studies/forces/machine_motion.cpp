// machine_motion.cpp — a period of the steady motion through the cycle's angles; else the last whole cycle of the run.
#include "studies/forces/machine_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/orbit/default_moment.h"
#include "engine/orbit/follow_period.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/forces/passages.h"
#include "studies/validity/outside_data.h"

namespace kurbel {
namespace {

constexpr double map_tolerance = 1e-12, looser_tolerance = 1e-10, enough = 1e-9;
constexpr int most_turns = 64;           // of the crank until everything repeats
constexpr int periods_undriven = 40;     // what nothing drives comes to rest, or has repeated long before
constexpr std::size_t most_edges = 200;  // events of a cycle; of more none is examined from both sides

// Neither the steady motion nor a cycle of the run is one over the crank's angle.
struct TurnsBack : std::invalid_argument {
  TurnsBack()
      : std::invalid_argument(
            "the crank stops or turns back within the cycle, so that forces are not a function of its angle") {}
};

// Edges of the loads in each of several cycles, and edges by events, once each.
std::vector<double> edges_of_all(const std::vector<double>& loads, double cycle, int cycles,
                                 const std::vector<double>& events) {
  constexpr double same = 1e-7;
  std::vector<double> all;
  for (int k = 0; k < cycles; ++k)
    for (const double e : loads) all.push_back(e + k * cycle);
  const std::size_t given = all.size();
  if (events.size() > most_edges) return all;
  for (const double e : events) {
    const bool known = std::any_of(all.begin(), all.end(),
                                   [&](double k) { return std::abs(std::remainder(e - k, cycles * cycle)) < same; });
    if (!known) all.push_back(e);
  }
  std::sort(all.begin() + static_cast<std::ptrdiff_t>(given), all.end());
  return all;
}

}  // namespace

MachineMotion::Crank MachineMotion::crank_in(const Model& model, const std::string& component) {
  const Network::ShaftElement& element = mechanism_element(model.network, component);
  // Cranks on one shaft share its angle.
  const int shaft = model.shaft_of_node[at(element.node)];
  for (std::size_t i = 0; i < model.angles.size(); ++i)
    if (model.angles[i].shaft == shaft && model.angles[i].gain == model.gain_of_node[at(element.node)])
      return {element.node, i, element.phase};
  throw std::logic_error("the crank's angle is not tracked");
}

MachineMotion::MachineMotion(const AskedMechanism& asked, const Effects& effects, const ForcesOptions& options)
    : MachineMotion(compile(asked.scene, effects), asked.name, options, {}) {}

MachineMotion::MachineMotion(std::shared_ptr<const Model> model, const std::string& mechanism,
                             const ForcesOptions& options, const Moment& at)
    : options_(options),
      at_(at),
      mechanism_(mechanism),
      settings_(model->scene.run),
      effects_(model->effects.describe()),
      model_(std::move(model)),
      crank_(crank_in(*model_, mechanism)),
      forces_(model_, mechanism) {}

bool MachineMotion::deforms() const { return forces_.deforms(); }
bool MachineMotion::is_elastic() const { return !model_->elastic.empty(); }

double MachineMotion::start_speed() const {
  Equations equations(model_, false);
  const std::vector<double> y = equations.start(0);
  const Snapshot& s = equations.snapshot(0, y);
  return model_->gain_of_node[at(crank_.node)] * s.now.speed[model_->shaft_of_node[at(crank_.node)]];
}

double MachineMotion::rated_speed() const {
  return model_->speed_scale * std::abs(model_->node_ratio[at(crank_.node)]);
}

std::optional<SimulatedMotion> MachineMotion::solve(OutputLoads& loads, Account out) const {
  const Orbit found = orbit();
  Moment at;
  const std::string later = choose_default_moment(model_->scene, model_->effects, search_options(), at, &found);
  if (later.empty()) return motion_of(found, loads, out);
  out.notes.push_back(later);
  const Scene then = as_of(model_->scene, model_->effects, at);
  const MachineMotion machine(compile_network(network_as_of(then, at), then, model_->effects), mechanism_, options_,
                              at);
  return machine.motion_of(machine.orbit(), loads, out);
}

std::optional<SimulatedMotion> MachineMotion::motion_of(const Orbit& found, OutputLoads& loads, Account out) const {
  std::string why_not;
  std::optional<SimulatedMotion> motion;
  try {
    motion = kept_motion(loads, found, why_not);
    if (!motion && found.kind != Orbit::Kind::interrupted) motion = last_cycle(loads, why_not, out);
  } catch (const TurnsBack& refused) {
    out.notes.push_back(fmt::format("second problem omitted: {}", refused.what()));
  }
  if (found.kind == Orbit::Kind::interrupted) out.complete = false, out.diagnosis = found.words;
  if (motion) motion->effects = effects_, motion->deforms = deforms();
  return motion;
}

// In terms of the tracked angle, without the phase of the crank on its shaft.
std::vector<double> MachineMotion::targets_of(const std::vector<Abscissa>& where, double origin) const {
  std::vector<double> targets;
  for (const Abscissa& a : where) targets.push_back(origin + a.place() - crank_.phase);
  return targets;
}

// --- the steady motion ---

bool MachineMotion::is_driven() const {
  return !model_->network.prescribed.empty() ||
         std::any_of(model_->accounts.begin(), model_->accounts.end(),
                     [](const WorkAccount& a) { return a.kind == kurbel::Account::driving; });
}

OrbitOptions MachineMotion::search_options() const {
  OrbitOptions options = orbit_options(settings_, options_.watch.interrupted);
  options.tolerance = map_tolerance;
  options.progress = [this](const std::string& what, double part) { options_.watch.at(what, part); };
  if (!is_driven()) options.most_periods = periods_undriven;
  return options;
}

Orbit MachineMotion::orbit() const {
  try {
    return find_orbit(model_, search_options());
  } catch (const std::invalid_argument& refused) {
    Orbit none;
    none.words = refused.what();
    return none;
  }
}

// The same machine with coarser dense tables; null: it has none.
std::shared_ptr<const Model> MachineMotion::model_elsewhere() const {
  constexpr double rougher = 4;
  if (tables_within(model_->scene) == 0) return nullptr;
  const Scene scene = with_rougher_tables(model_->scene, rougher);
  return compile_network(network_as_of(scene, at_), scene, model_->effects);
}

struct MachineMotion::Sampled {
  MotionAlong along;
  std::vector<MachineForces> machine;
  std::vector<std::string> outside_data;  // of a run

  void take(PassageRecorder& passages, int direction) {
    along.motion = std::move(passages.passed), along.time = passages.last - passages.first;
    machine = std::move(passages.machine);
    if (passages.turns_back || std::any_of(along.motion.begin(), along.motion.end(),
                                           [&](const CrankMotion& m) { return !(direction * m.omega > 0); }))
      throw TurnsBack();
  }
};

std::optional<SimulatedMotion> MachineMotion::kept_motion(OutputLoads& loads, const Orbit& orbit,
                                                          std::string& why_not) const {
  why_not = orbit.words;
  if (!orbit.repeats() || !(orbit.point.time > 0)) return {};
  try {
    SimulatedMotion motion;
    Sampled tight = along_period(loads, *orbit.map, orbit.point.z, map_tolerance);
    const auto [loose, other] = looser_twin(*orbit.map, orbit.point, looser_tolerance, model_elsewhere());
    motion.others.push_back(
        {along_period(loads, *loose, other.found ? other.z : orbit.point.z, looser_tolerance).along, 1});
    if (!other.found) motion.others.push_back({sped_up(tight.along, std::max(orbit.still_changes, enough)), 1});
    const int cycles = static_cast<int>(std::lround(tight.along.cycle / loads.cycle()));
    motion.description = fmt::format("steady motion of the machine ({}), crank's cycle of {:.0f}°{}",
                                     effects_ == "none" ? "rigid" : effects_, loads.cycle() * 360 / turn,
                                     cycles > 1 ? fmt::format(", {} of them until it repeats", cycles) : "");
    motion.along = std::move(tight.along), motion.machine = std::move(tight.machine);
    motion.outside_data = kurbel::outside_data(*orbit.map, orbit.point);
    motion.kept = true;
    return motion;
  } catch (const TurnsBack&) {
    throw;
  } catch (const std::invalid_argument& refused) {
    why_not = refused.what();
    return {};
  }
}

// One period: rotation of the crank, and the angles of its events.
struct MachineMotion::Window {
  double begin = 0, way = 0;   // of the crank [rad]
  std::vector<double> events;  // its angles [rad]
};

MachineMotion::Window MachineMotion::period_of(const ReturnMap& map, const Eigen::VectorXd& z, double tolerance,
                                               double cycle) const {
  Equations equations(model_, false);
  const std::vector<double> y = map.place(equations, z);
  Window window;
  window.begin = angle_in(equations, y);
  StepEnds ends(crank_.tracked);
  const RunOutcome outcome = follow_period(map, z, equations, {.tolerance = tolerance}, {&ends});
  if (!outcome.diagnosis.empty()) throw std::invalid_argument(outcome.diagnosis);
  window.way = angle_in(equations, outcome.state) - window.begin;
  for (const Event& e : outcome.events) window.events.push_back(ends.angle(e.t) + crank_.phase);
  const double cycles = std::abs(window.way) / cycle;
  if (cycles < 0.5) throw std::invalid_argument("the crank does not turn fully in the steady motion");
  if (std::abs(cycles - std::round(cycles)) > 1e-6 || cycles * cycle / turn > most_turns + 0.5)
    throw std::invalid_argument(fmt::format("the steady motion repeats after {:.6g} cycles of the crank", cycles));
  return window;
}

MachineMotion::Sampled MachineMotion::along_period(OutputLoads& loads, const ReturnMap& map, const Eigen::VectorXd& z,
                                                   double tolerance) const {
  const double cycle = loads.cycle();
  const Window window = period_of(map, z, tolerance, cycle);
  const int direction = window.way < 0 ? -1 : 1, cycles = static_cast<int>(std::lround(std::abs(window.way) / cycle));
  Sampled out;
  out.along.cycle = cycles * cycle;
  const double first = direction > 0 ? std::ceil(window.begin / cycle) : std::floor(window.begin / cycle) - cycles;
  const double origin = first * cycle;
  std::vector<double> events;
  for (const double e : window.events) {
    const double within = std::fmod(e - origin, out.along.cycle);
    events.push_back(within < 0 ? within + out.along.cycle : within);
  }
  std::vector<Abscissa>& where = out.along.where;
  where = abscissae(out.along.cycle, edges_of_all(loads.edges(direction), cycle, cycles, events), direction,
                    options_.positions,
                    cycle);  // tables show one of the crank's cycles
  if (direction < 0) std::reverse(where.begin(), where.end());
  std::vector<double> targets = targets_of(where, origin);
  Equations equations(model_, false);
  const std::vector<double> y = map.place(equations, z);
  const double last = targets.back();
  FollowOptions follow{.tolerance = tolerance, .periods = 2.5};
  follow.stop = [&, last](double, std::span<const double> now) {
    return std::min(1.0, 1e-3 + direction * (last - equations.angle_with_turns(crank_.tracked, now)));
  };
  PassageRecorder passages(crank_.tracked, crank_.node, forces_, where, std::move(targets), direction);
  const RunOutcome outcome = follow_period(map, z, equations, follow, {&passages});
  if (passages.passed.size() != where.size())
    throw std::invalid_argument(outcome.diagnosis.empty() ? "the motion ended before the crank's cycle"
                                                          : outcome.diagnosis);
  out.take(passages, direction);
  return out;
}

// --- the scene's run ---

struct MachineMotion::WholeRun {
  double begin, end;  // crank's own angle [rad]
  RunOutcome outcome;
};

RunOptions MachineMotion::run_options(double tolerance) const {
  return {.tolerance = tolerance,
          .method = settings_.model == "reduced" ? settings_.method : "auto",
          .until = settings_.until,
          .budget = settings_.budget,
          .interrupted = options_.watch.interrupted,
          .progress = [this](double fraction) { options_.watch.at("simulating", fraction); }};
}

MachineMotion::WholeRun MachineMotion::whole_run(double tolerance) const {
  Equations equations(model_, false);
  const std::vector<double> y = equations.start(0);
  const double begin = angle_in(equations, y);
  RunOutcome outcome = integrate(equations, run_options(tolerance), {});
  return {begin, angle_in(equations, outcome.state), std::move(outcome)};
}

MachineMotion::Sampled MachineMotion::one_run(const std::vector<Abscissa>& where, double cycle, double origin,
                                              int direction, double tolerance) const {
  Sampled out;
  out.along.cycle = cycle;
  out.along.where = where;
  std::vector<double> targets = targets_of(where, origin);
  PassageRecorder passages(crank_.tracked, crank_.node, forces_, where, std::move(targets), direction);
  DataRangeRecorder ranges(*model_);
  Equations equations(model_, false);
  integrate(equations, run_options(tolerance), {&passages, &ranges});
  if (passages.passed.size() != where.size())
    throw std::runtime_error(
        "the simulated crank does not repeat its motion between two tolerances; request more accuracy (run.accuracy)");
  out.take(passages, direction);
  out.outside_data = ranges.sentences();
  return out;
}

namespace {

// Remaining change of the speed, over its mean; ∞: the changes do not decrease.
double left_to_come(const MotionAlong* before, const MotionAlong& now, double noise) {
  const double first = now.motion.front().omega, last = now.motion.back().omega, mean = std::abs(now.mean_speed());
  if (!before) return std::abs(last - first) / mean;
  return still_to_come({before->motion.front().omega, first, last}, noise + 1e-9 * mean) / mean;
}

std::string not_closed(double closure, bool before, double to_come) {
  return fmt::format("over the cycle shown the crank's speed changes by {:.2g} % of its mean{}", 100 * closure,
                     !before                  ? std::string()
                     : std::isfinite(to_come) ? fmt::format(", and has {:.2g} % still to change", 100 * to_come)
                                              : std::string(", no less than over the cycle before"));
}

}  // namespace

// The last cycle between multiples of the cycle, in the crank's own angle.
std::optional<SimulatedMotion> MachineMotion::last_cycle(OutputLoads& loads, const std::string& why,
                                                         Account out) const {
  const double tolerance = std::max(settings_.accuracy, 1e-12) / 10, cycle = loads.cycle();
  const auto [begin_angle, end_angle, outcome] = whole_run(30 * tolerance);
  if (!outcome.complete) {
    out.complete = false;
    out.diagnosis = outcome.diagnosis;
  }
  const int direction = end_angle >= begin_angle ? 1 : -1;
  const double last =
      direction > 0 ? std::floor((end_angle - 2 * near_edge) / cycle) : std::ceil((end_angle + 2 * near_edge) / cycle);
  const double first = last - direction;
  if (direction * (first * cycle - begin_angle) < -1e-9) {
    out.notes.push_back(fmt::format(
        "second problem omitted: the machine has no steady motion with a turning crank ({}), and within {} the crank "
        "turns by {:.4g}°, less than a whole cycle of {:.0f}° that begins at a multiple of it; simulate longer "
        "(run.until) or start the machine",
        why, with_unit(outcome.t, "s", 4), std::abs(end_angle - begin_angle) * 360 / turn, cycle * 360 / turn));
    return {};
  }
  const double origin = (direction > 0 ? first : last) * cycle;
  std::vector<Abscissa> where = abscissae(cycle, loads.edges(direction), direction, options_.positions);
  if (direction < 0) std::reverse(where.begin(), where.end());
  SimulatedMotion motion;
  Sampled tight = one_run(where, cycle, origin, direction, tolerance);
  MotionAlong loose = one_run(where, cycle, origin, direction, 30 * tolerance).along;
  std::optional<MotionAlong> before;
  if (direction * (first * cycle - direction * cycle - begin_angle) >= -1e-9)
    before = one_run(where, cycle, origin - direction * cycle, direction, tolerance).along;
  const MotionAlong& along = tight.along;
  const double closure = closure_of(along);
  const double noise = std::abs(loose.motion.back().omega - along.motion.back().omega);
  const double to_come = left_to_come(before ? &*before : nullptr, along, noise);
  motion.others.push_back({std::move(loose), 1});
  if (std::isfinite(to_come)) motion.others.push_back({sped_up(along, std::copysign(to_come, closure)), 1});
  if (before) {
    // Changes that do not decrease continue with their growth, from the middle of the last two cycles to that of the next two.
    constexpr double most_grown = 100;  // next to no change allows no judgement
    const double grew = std::abs(closure / closure_of(*before));
    const double times = closure == 0             ? 1
                         : std::isfinite(to_come) ? std::max(1.0, to_come / std::abs(closure))
                                                  : std::clamp(grew * grew, 1.0, most_grown);
    motion.others.push_back({std::move(*before), times});
  }
  motion.description =
      fmt::format("the machine as its torques drive it ({}), cycle no. {:.0f} of a run of {}",
                  effects_ == "none" ? "rigid" : effects_, std::abs(first) + 1, with_unit(settings_.until, "s", 4));
  constexpr double shown = 1e-6;  // of the mean speed
  if (to_come > shown)
    out.notes.push_back(
        fmt::format("the simulated motion is not steady ({}): {}; that is counted as an error of every figure; {}", why,
                    not_closed(closure, before.has_value(), to_come),
                    std::isfinite(to_come) ? "simulate longer (run.until)" : "nothing says that it ever will be"));
  else
    out.notes.push_back(fmt::format("the simulated motion is the last whole cycle of the scene's run ({})", why));
  motion.along = std::move(tight.along), motion.machine = std::move(tight.machine);
  motion.outside_data = std::move(tight.outside_data);
  return motion;
}

}  // namespace kurbel
