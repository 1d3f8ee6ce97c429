// cycle_search.cpp — from a starting value to the return map's fixed point, and its results.
#include "studies/steady/cycle_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"
#include "engine/orbit/held_speeds.h"
#include "engine/return_map/family.h"
#include "engine/scene/quantity_place.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/answers/starter_claims.h"
#include "studies/findings/trace.h"
#include "studies/run/compare.h"
#include "studies/run/measured_errors.h"
#include "studies/steady/cycle_figures.h"
#include "studies/steady/steady_words.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/static_curve.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr double map_tolerance = 1e-12, looser_tolerance = 1e-10;
constexpr double enough = 1e-11;  // residual of the map, over the rated values
constexpr double rounding_of_multipliers = 1e-12;
constexpr double rounding_of_works = 1e-13;  // a quadrature adds up that of all its steps, which both searches share
constexpr double orbit_cost_limit = 40;      // cycles

// (ω_max + ω_min)/2 of the link over a cycle, as an observer.
class LinkSpeed {
 public:
  explicit LinkSpeed(const Model& m) : recorder_(wanted(m)) {}
  Observer* observer() { return &recorder_; }
  double mid() const { return 0.5 * (recorder_.found()[0].value + recorder_.found()[1].value); }

 private:
  static std::vector<ExtremeOf> wanted(const Model& m) {
    std::vector<ExtremeOf> both;
    for (ExtremeOf& e : extremes_of(m))
      if (e.name.what == quantities::max_speed || e.name.what == quantities::min_speed) both.push_back(std::move(e));
    return both;
  }
  ExtremeRecorder recorder_;
};

double nearest_of(const std::vector<std::complex<double>>& list, std::complex<double> wanted) {
  double least = HUGE_VAL;
  for (const std::complex<double>& z : list) least = std::min(least, std::abs(z - wanted));
  return least;
}

// One model of the study.
class Search {
 public:
  Search(const Scene& scene, const Effects& effects, const SteadyOptions& options)
      : scene_(as_of(scene, effects, options.at)), effects_(effects), options_(options) {
    network_ = network_as_of(scene_, options.at);
  }

  SteadyCycle run() {
    const double begin = processor_time();
    out_.effects = effects_.describe();
    if (options_.holds_speed()) {
      at_speed(*options_.held_speed());
    } else {
      freely();
    }
    if (out_.found) describe();
    out_.cpu_seconds = processor_time() - begin;
    return std::move(out_);
  }

  HeldOrbit held() {
    HeldOrbit held;
    at_speed(*options_.held_speed());
    held.orbit.kind = out_.found                                ? Orbit::Kind::cycle
                      : out_.end == ReturnMap::End::interrupted ? Orbit::Kind::interrupted
                                                                : Orbit::Kind::failed;
    held.orbit.words = out_.found ? "the mid speed is held by a torque added to the drive" : out_.why;
    held.orbit.cost = cost_;
    held.added_torque = out_.added_torque, held.added_at = added_to_;
    if (!out_.found) return held;
    held.orbit.polished = true;
    held.orbit.map = map_, held.orbit.point = out_.point;
    return held;
  }

 private:
  OrbitOptions search_options() const { return orbit_options(scene_, options_.periods, options_.watch); }

  void prepare(std::shared_ptr<const Model> model) {
    map_ = std::make_shared<ReturnMap>(model, map_options(search_options()));
    describe_model(std::move(model));
  }
  void describe_model(std::shared_ptr<const Model> model) {
    out_.model = std::move(model);
    out_.label = is_elastic(*out_.model) ? "elastic" : "rigid";
  }

  // The motion after the scene's own start.
  void freely() {
    describe_model(compile_network(network_, scene_, effects_));
    Orbit orbit = find_orbit(out_.model, search_options());
    out_.kind = orbit.kind;
    out_.orbit = orbit.words;
    out_.run_cycles = orbit.cycles;
    out_.cost = orbit.cost;
    out_.repeats_after = orbit.map ? orbit.map->options().cycles : options_.periods;
    out_.cost_limit = orbit_cost_limit * out_.repeats_after;
    out_.found = orbit.repeats();
    out_.why = orbit.words;
    out_.uncertain = !orbit.stable;
    out_.point = std::move(orbit.point);
    map_ = orbit.map;
    polished_ = orbit.polished, still_changes_ = orbit.still_changes;
  }

  // --- a speed is demanded: a torque beside the drive, or a quantity of the scene, is one more unknown ---

  // The driving component for the added torque; without one, the link.
  void choose_drive() {
    if (!options_.hold_by.empty()) return choose_quantity();
    const Network& net = network_;
    added_node_ = compile_network(net, scene_, effects_)->reduction_node;
    added_to_ = net.nodes[at(added_node_)].component;
    for (const Network::ShaftElement& e : net.elements)
      if (e.element->account == Account::driving && e.element->cycle == 0) {
        added_node_ = e.node;
        added_to_ = e.component;
        return;
      }
  }
  void choose_quantity() {
    const Setting* const setting = quantity_place(scene_.components, options_.hold_by).setting;
    if (!setting || setting->number == 0)
      throw std::invalid_argument(fmt::format(
          "--hold-by {}: must name a quantity that the scene gives as a number other than 0, e.g. \"load.torque\"",
          in_quotes(options_.hold_by)));
    unit_ = setting->number;
  }
  // The machine with its speed held by `held`: a torque beside the drive [N·m], or the quantity's value.
  Network network_with(double held) const {
    Network net = network_;
    if (options_.hold_by.empty()) {
      net.put(added_node_, added_to_, HoldingTorque{held});
      return net;
    }
    Scene other = scene_;
    quantity_at(other.components, options_.hold_by)->number = held;
    return network_as_of(other, options_.at);
  }
  std::shared_ptr<const Model> model_with(double held) const {
    return compile_network(network_with(held), scene_, effects_);
  }
  double first_held(double speed) const { return options_.hold_by.empty() ? first_torque(speed) : unit_; }

  void at_speed(double speed) {
    choose_drive();
    prepare(model_with(first_held(speed)));
    if (map_->periodicity().by_time)
      throw std::invalid_argument(fmt::format(
          "{}: time drives this machine (a prescribed speed or a torque over time), so its speed is not free; drop the "
          "option",
          option()));
    if (options_.hold_by.empty()) unit_ = out_.model->torque_scale / out_.model->scale_ratio[at(added_node_)];
    const ReturnMap::Image guess = begin_at(speed);
    cost_ += map_->cost();
    out_.end = guess.end;
    out_.why = guess.why;
    if (guess.end != ReturnMap::End::returned) return;
    Eigen::VectorXd x(guess.z.size() + 1);
    x << guess.z, first_held(speed) / unit_;
    const HeldMotion motion = hold(speed, x);
    cost_ += motion.cost;
    out_.point = motion.orbit.point;
    out_.end = motion.last.end;
    if (out_.point.found) {
      out_.why = why_not_held(scene_, options_.hold_by, motion.by[0] * unit_);
      if (out_.why.empty()) settle(motion);
      return;
    }
    out_.why = motion.orbit.words;
    if (motion.last.end == ReturnMap::End::interrupted) return;
    const std::string what =
        motion.last.end != ReturnMap::End::returned ? trial_ended(motion.newton, out_.why) : out_.why;
    out_.end = ReturnMap::End::failed;
    const std::string asked =
        fmt::format("with which \"{}\" turns at {} on average", out_.model->node_label(out_.model->reduction_node),
                    out_.model->scene.speed_unit.text(speed, 5));
    out_.why = options_.hold_by.empty()
                   ? fmt::format(
                         "no added torque was found {} (tried from {} on \"{}\" on): {}. Try a speed further up first, "
                         "more inertia, or a long kurbel run with that torque",
                         asked, with_unit(first_torque(speed), "N*m", 5), added_to_, what)
                   : fmt::format(
                         "no {} was found {} (tried from the scene's value on): {}. Try a speed nearer to that of the "
                         "scene, or another quantity",
                         options_.hold_by, asked, what);
  }
  std::string option() const { return options_.mid_speed ? "--mid-speed" : "--mean-speed"; }

  // A quasi-static start at that speed, or higher for a machine that just stalls at its load's peak; if the scene
  // switches something, the machine after its own start, brought to that speed.
  ReturnMap::Image begin_at(double speed) {
    ReturnMap::Image guess;
    const bool switches = !scene_.sequence.steps.empty() || is_switched(network_);
    if (switches) {
      Orbit orbit = find_orbit(out_.model, search_options());
      cost_ += orbit.cost;
      guess.why = "its own start does not lead to a cycle: " + orbit.words;
      if (!orbit.repeats()) return guess;
      if (orbit.map->periodicity().by_time)
        throw std::invalid_argument(option() + ": a sequence that repeats gives the period, so the speed is not free");
      map_ = orbit.map;
      guess.end = ReturnMap::End::returned;
      guess.z = orbit.point.z;
      return guess;
    }
    for (const double faster : {1.0, 1.2, 1.5}) {
      guess = map_->approach(faster * speed);
      if (guess.end == ReturnMap::End::returned || guess.end == ReturnMap::End::interrupted) break;
    }
    return guess;
  }

  // A mid speed depends on two peaks: its derivatives need additional periods.
  HeldMotion hold(double speed, const Eigen::VectorXd& guess) const {
    std::optional<LinkSpeed> link;
    const HeldSpeeds held{.machine = [this](const Eigen::VectorXd& a) { return model_with(a[0] * unit_); },
                          .record = [&](const Model& m) { return link.emplace(m).observer(); },
                          .miss =
                              [&](const ReturnMap::Image& round) {
                                const double reached = options_.mid_speed ? link->mid() : round.turned / round.time;
                                return Eigen::VectorXd::Constant(1, (reached - speed) / std::abs(speed));
                              },
                          .enough = enough};
    HeldMotion motion;
    find_held_orbit(held, *map_, guess, search_options(), motion);
    return motion;
  }
  // Deficit of the drive against the loads' mean torque [N·m, on the drive's shaft].
  double first_torque(double speed) const try {
    RigidMachine machine(compile_network(network_, scene_, rigid_effects()));
    const int direction = speed < 0 ? -1 : 1;
    double net =
        MeanCharacteristic(machine, direction, 1, machine_with_losses(network_, scene_, effects_)).at(speed).net();
    if (!std::isfinite(net)) net = MeanCharacteristic(machine, direction).at(speed).net();
    return std::isfinite(net) ? -net / machine.model().node_ratio[at(added_node_)] : 0;
  } catch (const std::invalid_argument&) {  // one angle and its speed do not describe it
    return 0;
  }
  void settle(const HeldMotion& motion) {
    held_ = motion.by[0] * unit_;
    map_ = motion.orbit.map;
    out_.model = map_->shared_model();
    out_.found = true;
    out_.point.cost = out_.cost = cost_;
    out_.cost_limit = 6 * (static_cast<double>(map_->size()) + 2) * options_.periods;
    if (options_.hold_by.empty())
      out_.added_torque = held_, out_.added_at = added_to_;
    else
      out_.held_quantity = {options_.hold_by, held_, unit_,
                            quantity_place(scene_.components, options_.hold_by).key->unit};
  }

  // --- figures ---

  // An equilibrium has no cycles: the time is given instead.
  std::string stability_in_words() {
    if (out_.unknowns == 0) return "its speed is prescribed, and nothing deviates from it";
    const std::string text =
        stability_text(out_.point.multipliers, &out_.halving, out_.point.multiplier_error, map_->options().cycles);
    if (out_.kind != Orbit::Kind::equilibrium || !out_.halving) return text;
    const std::size_t after = text.find(" cycles");
    return text.substr(0, text.find(" in ") + 4) +
           fmt::format("{:.3g} s", *out_.halving * out_.cycle_time / map_->options().cycles) +
           text.substr(after + std::string_view(" cycles").size());
  }

  void describe() {
    out_.periodicity = map_->periodicity();
    out_.unknowns = map_->size();
    out_.section = map_->section_angle();
    out_.cycle_time = out_.point.time;
    out_.stability = !out_.uncertain                       ? stability_in_words()
                     : out_.kind == Orbit::Kind::vibrating ? "its stability is not assessed"
                     : out_.point.grazed
                         ? "of uncertain stability, because an event is only just touched; the run converges to it"
                         : "the run converges to it";
    out_.neutral = out_.point.neutral();
    Period fine = figures_of_period(*map_, out_.point, map_tolerance);
    if (!fine.failed.empty()) {
      out_.found = false;
      out_.why = fine.failed;
      return;
    }
    if (scene_.finer_shafts == 0) measure_errors(fine);
    out_.figures = std::move(fine.figures);
    out_.shafts = std::move(fine.shafts);
    out_.motors = std::move(fine.motors);
    out_.work_residual = fine.work_residual;
    out_.outside_data = std::move(fine.outside_data);
    out_.orders = std::move(fine.orders.all);
    if (!fine.orders.none.empty()) out_.notes.push_back(fine.orders.none);
    if (!out_.outside_data.empty()) drop_errors(out_.figures, -HUGE_VAL), drop_errors(out_.orders);
    report_orders(out_.orders, options_.every_order, out_.figures);
    for (std::string& note : static_curve_notes(*map_, out_.point)) out_.notes.push_back(std::move(note));
    for (const std::string& note : substitutes(*out_.model)) out_.notes.push_back(note);
    constexpr double all = 1 - 1e-6;
    for (const Figure& f : out_.figures)
      if (f.words() == "breakdown_use" && f.value >= all)
        out_.notes.push_back(fmt::format(
            "\"{}\" reaches its breakdown torque within the cycle: a heavier load, or a lower voltage, may stall it",
            f.of));
    find_loads();
    if (const Figure* const mean = out_.find("mean_speed." + name_of_link(*out_.model))) {
      Equations equations(map_->shared_model(), false);
      const std::vector<double> y = map_->place(equations, out_.point.z);
      out_.starters = starter_claims(equations, map_->start_time(), y, mean->value);
    }
    if (options_.traces) follow();
  }

  // Loads of joints with limits, as in `kurbel modes`.
  void find_loads() {
    const std::vector<LimitedJoint> joints = limited_joints(*out_.model);
    if (!any_limits(joints)) return;
    Orbit kept;
    kept.kind = Orbit::Kind::cycle;
    kept.polished = polished_, kept.still_changes = still_changes_;
    kept.map = map_;
    kept.point = out_.point;
    out_.loads = steady_loads(kept, out_.model, joints);
  }

  // The same machine with its mechanisms extracted anew, if they use tables, and with coarser dense tables.
  std::shared_ptr<const Model> model_elsewhere() const {
    constexpr double rougher = 4;
    const bool dense = tables_within(scene_) > 0;
    if (!dense && !has_tables(network_)) return out_.model;
    Search other = *this;
    if (dense) {
      other.scene_ = with_rougher_tables(scene_, rougher);
      other.network_ = network_as_of(other.scene_, options_.at);
    }
    const Network net = options_.holds_speed() ? other.network_with(held_) : other.network_;
    return compile_network(extracted_from(net, Extraction::second), scene_, effects_);
  }

  // The same search with looser tolerances and other tables; the difference is the error.
  void measure_errors(Period& fine) {
    std::shared_ptr<const Model> elsewhere;
    try {
      elsewhere = model_elsewhere();
    } catch (const std::runtime_error&) {
      return;  // Simbody cannot follow a mechanism: nothing measures the errors
    }
    const auto [loose, point] = options_.holds_speed()
                                    ? SteadyTwin{looser_map(*map_, looser_tolerance, elsewhere), out_.point}
                                    : looser_twin(*map_, out_.point, looser_tolerance, elsewhere);
    if (!point.found) return;
    for (std::size_t i = 0; i < std::min(point.multipliers.size(), out_.point.multipliers.size()); ++i)
      out_.multiplier_errors.push_back(nearest_of(out_.point.multipliers, point.multipliers[i]) +
                                       out_.point.multiplier_error + rounding_of_multipliers);
    const Period other = figures_of_period(*loose, point, looser_tolerance);
    const double tables = left_by_tables(scene_);  // two sets of pieces may agree by chance
    for (Figure& f : fine.figures)
      for (const Figure& g : other.figures)
        if (f.name == g.name) {
          const double rounding = f.unit == "J" ? rounding_of_works : 8 * std::numeric_limits<double>::epsilon();
          // Resolution of the steps, common to both searches; zero if both are zero.
          const double shared = f.value == 0 && g.value == 0 ? 0 : map_tolerance * f.scale;
          f.error = std::max({std::abs(f.value - g.value), rounding * std::abs(f.value), shared}) +
                    tables * std::abs(f.value);
        }
    widen_errors(fine.orders.all, other.orders.all, map_tolerance, tables);
    if (out_.model->has_continuous_shafts()) add_errors_of_shafts(fine);
  }

  // The same search with finer continuous shafts; the change is their discretisation error.
  void add_errors_of_shafts(Period& fine) {
    Scene finer = scene_;
    ++finer.finer_shafts;
    SteadyOptions options = options_;
    options.traces = false;
    const SteadyCycle other = Search(finer, effects_, options).run();
    if (other.found) {
      add_differences(fine.figures, other.figures);
      widen_errors(fine.orders.all, other.orders);
    } else {
      out_.notes.push_back("what the cut of continuous shafts leaves open is not in the errors: " + other.why);
    }
  }

  // Two periods, so that one whole cycle from the link's zero is among them.
  void follow() {
    Equations equations(out_.model, true);
    TraceRecorder traces(*out_.model);
    follow_period(*map_, out_.point, equations, {.tolerance = 1e-9, .periods = 2.05}, {&traces});
    out_.traces = traces.traces();
  }

  Scene scene_;
  Effects effects_;
  const SteadyOptions& options_;
  Network network_;
  std::shared_ptr<ReturnMap> map_;
  bool polished_ = true;  // Orbit's, of what the scene's own start leads to
  double still_changes_ = 0;
  SteadyCycle out_;
  int added_node_ = 0;
  std::string added_to_;
  double cost_ = 0, unit_ = 1, held_ = 0;  // unit_: of what the speed is held by, held_
};

}  // namespace

OrbitOptions orbit_options(const Scene& scene, int periods, const Watch& watch) {
  OrbitOptions options = orbit_options(scene.run, watch.interrupted);
  options.tolerance = map_tolerance;
  options.cycles = periods;
  options.progress = [watch](const std::string& what, double part) { watch.at(what, part); };
  return options;
}

SteadyCycle search_cycle(const Scene& scene, const Effects& effects, const SteadyOptions& options) {
  return Search(scene, effects, options).run();
}

HeldOrbit held_orbit(const Scene& scene, const Effects& effects, double mid_speed, const Moment& at,
                     const Watch& watch) {
  SteadyOptions options;
  options.mid_speed = mid_speed, options.at = at, options.watch = watch;
  return Search(scene, effects, options).held();
}

}  // namespace kurbel
