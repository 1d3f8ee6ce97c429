// modes.cpp — from the linearised drive to its modes, critical speeds, and swings over the speed range.
#include "studies/modes/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/linear/rest_place.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "studies/history/torque_history.h"
#include "studies/modes/critical_speeds.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/mode_list.h"
#include "studies/modes/spot_checks.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr int sweep_points = 240;
constexpr std::size_t most_solves = 400'000;  // of n-by-n systems in a sweep, over n
constexpr std::size_t cycle_samples = 4096;   // of a round of the steady motion
constexpr int rounds_of_rocking = 12;         // what swings on then, swings on; each takes up to 64 times as long

class Study {
 public:
  Study(const Scene& scene, const Effects& effects, const ModesOptions& options)
      : options_(options), given_(scene), effects_(effects), scene_(as_of(scene, effects, options.at)) {
    model_ = compile_network(network_as_of(scene_, options.at), scene_, effects);
    found_.title = scene.heading(), found_.speed_unit = scene.speed_unit;
    found_.scene_file = scene.file, found_.scene_text = scene.text;
    found_.link = model_->node_label(model_->reduction_node);
  }

  ModesStudy result() {
    check_options();
    say("regime", 0);
    find_operating_point();
    say("modes", 0.1);
    name_parts();
    list_modes(options_.count, found_);
    if (!options_.angle) find_frozen_range(options_.count, found_);
    if (samples_ && !options_.speed) {
      note_changes(*samples_, found_);
      find_rattles(*samples_, options_.count, found_);
    }
    if (samples_ && !options_.speed && !options_.angle) find_exponents(*orbit_, *samples_, found_);
    choose_range();
    say("excitation", 0.15);
    find_forcing();
    say("forced response", 0.2);
    find_critical_speeds(found_);
    find_zones();
    sweep();
    find_barred_ranges(
        *model_, options_.barred_factor, [this](double speed) { return respond(drive_at(speed), found_.excitations); },
        found_);
    if (!options_.angle) check_spots_of_range();
    if (!options_.torque.empty()) add_history();
    if (options_.response_alone) return std::move(found_);
    judge_all_limits();
    find_stresses();
    return std::move(found_);
  }

 private:
  void say(const std::string& what, double fraction) const {
    options_.watch.at(what, fraction);
    options_.watch.say(what);
  }
  bool stopped() const { return options_.watch.stopped(); }

  void check_options() const {
    if (options_.count < 1) throw std::invalid_argument(fmt::format("--count {}: must be ≥ 1", options_.count));
    if (options_.orders < 0 || options_.orders > 1000)
      throw std::invalid_argument(fmt::format("--orders {:g}: must be > 0 and ≤ 1000", options_.orders));
    if (options_.slowest < 0 || (options_.fastest != 0 && options_.fastest <= options_.slowest))
      throw std::invalid_argument("--range: give two speeds ≥ 0, the smaller one first, e.g. \"0 rpm\" \"3000 rpm\"");
    if (options_.spot_checks < 0 || options_.spot_checks > 100)
      throw std::invalid_argument(fmt::format("--spot-checks {}: must be from 0 to 100", options_.spot_checks));
    if (options_.barred_factor <= 0) throw std::invalid_argument("--barred: must be > 0");
  }

  // The steady motion that the scene's own start leads to, unless a speed is asked for of a machine that knows no contacts and
  // no states of its own: then all turns as geared, whatever the speed.
  void find_operating_point() {
    const bool plain = !model_->has_contacts() && model_->own_states.empty() && scene_.sequence.steps.empty();
    if (!(options_.speed && plain)) find_orbit_cycle();
    if (!options_.speed && !options_.angle) stay_at_rest();
    LinearisationPoint point{.speed = options_.speed.value_or(samples_ ? samples_->mean->speed : 0),
                             .angle = options_.angle};
    if (samples_) point.orbit = samples_->mean;
    if (rest_ && !options_.speed) point.orbit = rest_;
    if (!options_.speed && !point.orbit && !swings_about_rest()) point.speed = balanced_or_usual_speed();
    BaseMotion base(model_, point);
    if (!point.orbit && base.equations().has_followers())
      throw std::invalid_argument(
          "its own start leads to no motion that repeats, and a joint with clearance or a rod that bends has no small "
          "motions about any other: leave those effects out, e.g. --effects elasticity, or look at kurbel run");
    found_.drive = linearise(base);
    if (!base.words().empty()) found_.notes.push_back("at this speed " + base.words());
    for (const std::string& note : substitutes(*model_)) found_.notes.push_back(note);
    if (!options_.speed && orbit_ && orbit_->repeats() && orbit_->map)
      found_.outside_data = outside_data(*orbit_->map, orbit_->point);
    else if (lies_beyond_a_table(*model_, point.speed))
      found_.outside_data = {
          "this speed lies beyond the end of a table over the speed, whose slope there is not known"};
    note_unsteady_motion();
    if (!samples_ || options_.speed) return;
    found_.cycle = response_of_samples(samples_->torque, samples_->mean->speed, samples_->time);
    if (orbit_->kind == Orbit::Kind::equilibrium) take_swings_away(*found_.cycle);
    found_.cycle_order = 2 * pi / (samples_->time * std::abs(samples_->mean->speed));
  }

  // In an equilibrium nothing swings: what samples tell of it is rounding.
  static void take_swings_away(SpeedResponse& response) {
    for (JointResponse& joint : response.joints) {
      JointResponse still;
      still.mean = still.upper = still.lower = joint.mean;
      joint = still;
    }
    for (std::vector<Complex>& orders : response.orders) std::fill(orders.begin() + 1, orders.end(), Complex{});
  }

  void look_for_orbit() {
    OrbitOptions options;
    options.method = scene_.run.method == "work" ? "auto" : scene_.run.method;
    options.budget = scene_.run.budget;
    options.interrupted = options_.watch.interrupted;
    if (has_rocking_crank(*model_)) options.most_rounds = rounds_of_rocking;
    options.progress = [this](const std::string& what, double part) { options_.watch.at(what, 0.1 * part); };
    orbit_.emplace();
    try {
      orbit_ = find_orbit(model_, options);
    } catch (const std::invalid_argument& refused) {
      orbit_->words = refused.what();
    }
  }

  void find_orbit_cycle() {
    look_for_orbit();
    found_.orbit = orbit_->words;
    try {
      if (orbit_->repeats() && orbit_->point.time > 0) samples_ = sample_cycle(*orbit_, cycle_samples);
      if (!samples_ && orbit_->kind == Orbit::Kind::equilibrium) rest_ = means_of_equilibrium(model_, orbit_->state);
    } catch (const std::invalid_argument& refused) {
      found_.orbit = refused.what();
    }
    if (samples_ && samples_->mean->speed == 0) rest_ = samples_->mean, samples_.reset();  // the link stands
    if (!samples_ && !rest_ && !swings_about_rest())
      found_.notes.push_back(fmt::format(
          "no motion that repeats to linearise at: {}; instead everything turns as geared, clutches locked and brakes "
          "released, at the speed said",
          found_.orbit));
  }

  bool swings_about_rest() const {
    return has_rocking_crank(*model_) || (orbit_ && rests_by_its_angle(*model_, *orbit_));
  }

  // What never comes round, or rests by its weights, swings about a rest: there the link is held, not averaged.
  void stay_at_rest() {
    if (!orbit_ || !swings_about_rest()) return;
    const RestPlace place = place_of_rest(model_, *orbit_);
    options_.angle = found_.rests_at = place.angle;
    rest_ = place.orbit;
    samples_.reset();
    found_.notes.push_back(fmt::format(
        "small swings about the rest at {:.4g}° of \"{}\": weights and loads that hang on the angle act as springs, "
        "K = −∂M/∂φ; the farther it swings, the less they hold",
        place.angle * 180 / pi, found_.link));
  }

  void note_unsteady_motion() {
    const double speed = found_.drive.at.speed;
    const double torque = found_.drive.mean_torque;
    if (speed != 0 && std::abs(torque) > 0.01 * model_->torque_scale)
      found_.notes.push_back(fmt::format(
          "at {} the machine is not in steady motion: {:.4g} N·m on {} are left over; mean torques are those "
          "of the machine that accelerates as a whole",
          found_.speed_unit.text(speed, 5), torque, found_.link));
  }

  // Without a steady motion: where mean torques balance near the rated speed and a faster motion is braked, if they do.
  double balanced_or_usual_speed() const {
    const double rated = usual_speed(*model_);
    if (model_->scene.run.start.speed != 0 || model_->free_shafts < model_->shafts.size()) return rated;
    const auto left = [&](double speed) {
      return BaseMotion(model_, {.speed = speed, .positions = 4 * coarse_positions}).left_over();
    };
    double high = 1.05 * rated, above = left(high);
    for (int i = 1; i <= 60 && above <= 0; ++i) {
      const double low = rated * (1.05 - 0.01 * i), below = left(low);
      if (below > 0) return find_root(left, low, below, high, above);
      high = low;
      above = below;
    }
    return rated;
  }

  double signed_speed(double speed) const { return std::copysign(speed, found_.drive.at.speed); }

  void name_parts() {
    for (const int s : found_.drive.shaft) {
      const Shaft& shaft = model_->shafts[at(s)];
      std::string name = model_->node_label(shaft.reference);
      double largest = -1;
      for (const int n : shaft.nodes) {  // the heaviest part gives the name
        double inertia = model_->network.nodes[at(n)].inertia;
        for (const Network::ShaftElement& e : model_->network.elements)
          if (e.node == n) inertia += e.element->mean_inertia;
        inertia *= std::pow(model_->gain_of_node[at(n)], 2);
        if (inertia > largest) largest = inertia, name = model_->node_label(n);
      }
      found_.shaft_names.push_back(name);
    }
    found_.joint_names = model_->joint_names();
  }

  void choose_range() {
    const double speed = std::abs(found_.drive.at.speed);
    found_.fastest = options_.fastest > 0 ? options_.fastest : 1.25 * (speed > 0 ? speed : model_->speed_scale);
    found_.slowest = options_.slowest > 0 ? options_.slowest : 0.05 * found_.fastest;
    found_.highest_order = options_.orders > 0 ? options_.orders : 12;
    if (options_.orders == 0 && !found_.modes.empty()) {
      const std::size_t natural = std::max<std::size_t>(1, natural_modes(found_));
      const double second = found_.modes[std::min<std::size_t>(1, natural - 1)].omega;
      found_.highest_order = std::clamp(std::ceil(second / std::max(speed, 0.2 * found_.fastest)), 12.0, 24.0);
    }
  }

  void find_forcing() {
    found_.excitations =
        find_excitations(found_.drive, signed_speed(found_.fastest), found_.highest_order, options_.orders == 0);
    for (const std::string& note : found_.excitations.notes) found_.notes.push_back(note);
    if (found_.excitations.by_order.empty() && found_.excitations.by_frequency.empty())
      found_.notes.push_back(
          "nothing in the scene excites the drive by order or frequency: no torque depends on an angle or swings "
          "over time");
    found_.here = respond(found_.drive, found_.excitations);
    tell_swings_that_are_missing();
  }

  // A joint that hardly swings in the linear response and does in the steady motion: what is linear says nothing of it.
  void tell_swings_that_are_missing() {
    constexpr double hardly = 0.01;
    if (!found_.cycle) return;
    for (std::size_t j = 0; j < found_.joint_names.size(); ++j) {
      const double linear = found_.here.joints[j].peak, really = found_.cycle->joints[j].peak;
      if (!(really > 1e-6 * std::abs(found_.cycle->joints[j].mean) && linear < hardly * really)) continue;
      found_.notes.push_back(fmt::format(
          "the linear response says {} of {}, which swings by {} in the steady motion: its critical speeds, barred "
          "ranges and curves over the speed do not hold{}",
          with_unit(linear, "N*m", 3), found_.joint_names[j], with_unit(really, "N*m", 3),
          model_->effects.joint_clearance ? ". With clearance the linear drive takes the pin at its mean place, inside "
                                            "the gap, where nothing touches"
                                          : ""));
    }
  }

  LinearDrive drive_at(double speed) const {
    LinearisationPoint point = found_.drive.at;
    point.speed = signed_speed(speed);
    point.positions = coarse_positions;
    if (!options_.angle && !found_.excitations.by_order.empty())
      point.added = mean_missed(found_.drive, found_.excitations, point.speed);
    return linearise(model_, point);
  }

  void find_zones() {
    const auto& elements = model_->network.elements;
    if (found_.rests_at || std::none_of(elements.begin(), elements.end(),
                                        [](const Network::ShaftElement& e) { return e.element->cycle > 0; }))
      return;
    for (const Mode& mode : found_.modes) {
      if (mode.of_own_states) continue;  // no spring holds it
      const std::vector<double> variation = inertia_variation(found_.drive, mode.shape, found_.excitations.harmonics);
      for (std::size_t r = 1; r < variation.size(); ++r) {
        ParametricZone zone{.mode = mode.number, .harmonic = r};
        zone.centre = 2 * frequency_of_resonance(found_.drive, mode) / found_.excitations.order(r);
        zone.variation = variation[r];
        zone.half_width = parametric_half_width(variation[r], std::max(0.0, mode.ratio));
        if (zone.variation > 1e-6 && zone.centre >= found_.slowest && zone.centre <= found_.fastest)
          found_.zones.push_back(zone);
      }
    }
    std::sort(found_.zones.begin(), found_.zones.end(),
              [](const ParametricZone& a, const ParametricZone& b) { return a.centre < b.centre; });
  }

  // A point of the sweep.
  SpeedResponse respond_at(double speed) const {
    const LinearDrive drive = drive_at(speed);
    SpeedResponse response = respond(drive, found_.excitations);
    response.speed = speed;
    judge_kept_speeds(found_, drive, response);
    return response;
  }

  std::vector<double> sweep_speeds() {
    std::vector<double> speeds;
    for (int i = 0; i <= sweep_points; ++i)
      speeds.push_back(std::min(found_.slowest + (found_.fastest - found_.slowest) * i / sweep_points, found_.fastest));
    for (const CriticalSpeed& c : found_.critical) {
      const Mode& mode = found_.modes[at(c.mode - 1)];
      const double zeta = std::clamp(mode.ratio, 1e-4, 0.2), damped = mode.magnitude() / c.order;
      for (const double factor : {1 - 2 * zeta, 1 - zeta, 1 - 0.4 * zeta, 1.0, 1 + 0.4 * zeta, 1 + zeta, 1 + 2 * zeta})
        speeds.push_back(damped * factor);
      speeds.push_back(c.speed);
    }
    speeds.push_back(std::abs(found_.drive.at.speed));
    std::sort(speeds.begin(), speeds.end());
    std::erase_if(speeds, [&](double w) { return w < found_.slowest || w > found_.fastest; });
    const auto same = [](double a, double b) { return b - a <= 1e-9 * b; };  // but for rounding
    speeds.erase(std::unique(speeds.begin(), speeds.end(), same), speeds.end());
    const std::size_t solves = speeds.size() * found_.excitations.harmonics * at(static_cast<int>(found_.drive.size()));
    if (solves > 20 * most_solves) {
      const std::size_t keep = std::max<std::size_t>(20, speeds.size() * 20 * most_solves / solves);
      std::vector<double> fewer;
      for (std::size_t i = 0; i < keep; ++i) fewer.push_back(speeds[i * (speeds.size() - 1) / (keep - 1)]);
      found_.notes.push_back(
          fmt::format("the drive is large: the sweep has {} speeds instead of {}", keep, speeds.size()));
      fewer.erase(std::unique(fewer.begin(), fewer.end()), fewer.end());
      return fewer;
    }
    return speeds;
  }

  void sweep() {
    const Excitations& x = found_.excitations;
    const bool limited = any_limits(limited_joints(*model_));
    // What swings at frequencies of its own bears loads at every speed, too.
    if (found_.joint_names.empty() || (x.by_order.empty() && x.by_frequency.empty() && !limited)) return;
    const std::vector<double> speeds = sweep_speeds();
    found_.keeps_its_speed = !grows(found_.drive) && found_.here.speed_swing < std::abs(found_.drive.at.speed);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (stopped()) {
        found_.complete = false;
        found_.diagnosis = "interrupted within the sweep over the speeds";
        return found_.critical.clear();  // their amplitudes are not known
      }
      Deadline::check();
      if (speeds[i] == 0) continue;
      const double fraction = static_cast<double>(i) / static_cast<double>(speeds.size());
      options_.watch.at("forced response", 0.2 + 0.6 * fraction);
      found_.sweep.push_back(respond_at(speeds[i]));
    }
    if (!options_.response_alone) sweep_as_if_rigid();
    measure_critical_speeds([this](double speed) { return respond_at(speed); }, found_);
    leave_out_what_is_not_kept(found_);
  }

  // What stands behind the curves over the speed: smooth, so that some points do.
  void sweep_as_if_rigid() {
    constexpr std::size_t points = 60;
    const std::size_t every = std::max<std::size_t>(1, found_.sweep.size() / points);
    for (std::size_t i = 0; i < found_.sweep.size() && !stopped(); i += every) {
      const std::optional<LinearDrive> rigid = as_if_rigid(drive_at(found_.sweep[i].speed));
      if (!rigid) return found_.rigid.clear();
      found_.rigid.push_back(respond(*rigid, found_.excitations));
      found_.rigid.back().speed = found_.sweep[i].speed;
      found_.rigid.back().kept = found_.sweep[i].kept;
    }
  }

  void check_spots_of_range() {
    if (options_.spot_checks == 0 && options_.spots.empty()) return;
    const Network network = network_as_of(scene_, options_.at);
    check_spots(
        {network, scene_, effects_, samples_ ? &*orbit_ : nullptr},
        [this](double speed) { return speed == std::abs(found_.drive.at.speed) ? found_.drive : drive_at(speed); },
        options_, found_);
  }

  // A speed that is asked for is judged by the linear response at it; peaks are those of a run-up all the same.
  void judge_all_limits() {
    if (!orbit_ && any_limits(found_.limited)) look_for_orbit();
    judge_limits(model_, orbit_.value_or(Orbit{}), !options_.speed && !options_.angle, options_.watch, found_);
  }

  void find_stresses() {
    if (judged_shafts(found_.limited).empty() || found_.sweep.empty()) return;
    judge_over_speeds(found_.limited, found_.sweep, found_.verdicts);
    found_.stresses = stresses_of_sweep(found_);
    if (!options_.misfires || options_.angle) return;
    found_.stresses.misfires = find_misfires(given_, effects_, options_, found_, found_.notes);
  }

  void add_history() {
    Watch watch = options_.watch;
    watch.progress = [this](const std::string& what, double f) { options_.watch.at(what, 0.8 + 0.2 * f); };
    const std::string& link = model_->network.nodes[at(model_->reduction_node)].component;
    double highest = 0;
    for (const Mode& mode : found_.modes) highest = std::max(highest, mode.magnitude());
    found_.history = simulate_torque(scene_, effects_,
                                     {.torque = options_.torque, .link = link, .highest = highest, .watch = watch});
    if (found_.history->complete) return;
    found_.complete = false, found_.diagnosis = found_.history->diagnosis;
  }

  ModesOptions options_;
  const Scene& given_;
  Effects effects_;
  Scene scene_;
  std::shared_ptr<const Model> model_;
  std::optional<Orbit> orbit_;
  std::shared_ptr<const MeanMotion> rest_;  // where the link stands and others turn
  std::optional<CycleSamples> samples_;
  ModesStudy found_;
};

}  // namespace

Eigen::VectorXd shaft_shape(const ModesStudy& study, const Mode& mode) { return study.drive.motion * mode.shape; }

double parametric_half_width(double variation, double damping_ratio) {
  const double rest = variation * variation / 16 - damping_ratio * damping_ratio;
  return rest > 0 ? std::sqrt(rest) : 0;
}

std::size_t natural_modes(const ModesStudy& study) {
  return static_cast<std::size_t>(
      std::count_if(study.modes.begin(), study.modes.end(), [](const Mode& mode) { return !mode.of_own_states; }));
}

Effects effects_of_modes(const Scene& scene) {
  Effects effects = scene.effects;
  if (effects.elastic.empty() && !effects.all_elastic) effects.all_elastic = true;
  return effects;
}

ModesStudy find_modes(const Scene& scene, const Effects& effects, const ModesOptions& options) {
  if (scene.run.model == "multibody")
    throw std::invalid_argument("modes belong to the reduced model; set model = \"reduced\" in [run]");
  const Deadline deadline(scene.run.budget);
  return Study(scene, effects, options).result();
}

}  // namespace kurbel
