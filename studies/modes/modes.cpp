// modes.cpp — from the linearised drive to its modes, critical speeds, and responses over the speed range.
#include "studies/modes/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/linear/rest_position.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/default_moment.h"
#include "studies/modes/critical_speeds.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/mode_list.h"
#include "studies/modes/spot_checks.h"
#include "studies/validity/outside_data.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr std::size_t cycle_samples = 4096;  // of a cycle of the steady motion
constexpr int cycles_of_rocking = 12;        // what oscillates then, oscillates on; each takes up to 64 times as long

class Study {
 public:
  Study(const Scene& scene, const Effects& effects, const ModesOptions& options)
      : options_(options), given_(scene), effects_(effects), scene_(as_of(scene, effects, options.at)) {
    model_ = compile_network(network_as_of(scene_, options.at), scene_, effects);
    found_.is_of(scene);
    found_.link = model_->node_label(model_->reduction_node);
  }

  // When the budget is spent, the results so far are returned, from the first modes on.
  ModesStudy result() {
    check_options();
    std::optional<ModesStudy> at_the_state;
    if (searches_start() && !options_.response_alone) at_the_state = modes_at_the_state();
    try {
      refine();
    } catch (const OutOfTime& out) {
      if (options_.response_alone || out.budget() != scene_.run.budget) throw;
      if (!listed_ && !at_the_state) throw;
      if (!listed_) found_ = std::move(*at_the_state);
      end_early();
    } catch (
        const std::invalid_argument& refused) {  // no small motions about the steady one: friction holds every shaft
      if (listed_ || !at_the_state) throw;
      found_ = std::move(*at_the_state);
      found_.notes.push_back(fmt::format("not assessed is what depends on the steady motion: {}", refused.what()));
    }
    return std::move(found_);
  }

 private:
  void refine() {
    begin("steady motion", 0.01);
    find_operating_point();
    begin("modes", 0.1);
    name_parts(found_);
    list_modes(options_.count, found_);
    listed_ = true;
    if (options_.modes_alone) return;
    if (!options_.angle) find_frozen_range(options_.count, found_);
    if (samples_ && !options_.speed) {
      note_changes(*samples_, found_);
      find_rattles(*samples_, options_.count, found_);
    }
    if (samples_ && !options_.speed && !options_.angle) find_exponents(*orbit_, *samples_, found_);
    choose_range();
    begin("excitation", 0.15);
    find_forcing();
    begin("forced response", 0.2);
    find_critical_speeds(found_);
    find_zones(found_);
    sweep();
    find_barred_ranges(
        *model_, options_.barred_factor, [this](double speed) { return respond(drive_at(speed), found_.excitations); },
        found_);
    if (!options_.response_alone) find_margins(given_, effects_, options_, found_);
    if (!options_.angle) check_spots_of_range();
    if (!options_.torque.empty()) add_history();
    if (options_.response_alone) return;
    begin("limits", 0.9);
    judge_all_limits();
    begin("stresses of shafts", 0.95);
    find_stresses();
  }

  void begin(const std::string& what, double fraction) {
    at_work_ = what;
    options_.watch.at(what, fraction);
    options_.watch.say(what);
  }
  // The budget is spent: removes incomplete tables.
  void end_early() {
    found_.break_off(fmt::format(
        "the budget of {:g} s of processor time is spent at work on the {}: what would follow is not assessed",
        scene_.run.budget, at_work_));
    std::erase_if(found_.spots, [](const SpotCheck& spot) { return spot.linear.joints.empty(); });
    if (found_.limited.empty()) found_.sweep.clear(), found_.rigid.clear(), found_.critical.clear();
  }
  bool stopped() const { return options_.watch.stopped(); }

  void check_options() const {
    if (options_.slowest < 0 || (options_.fastest != 0 && options_.fastest <= options_.slowest))
      throw std::invalid_argument("--range: give two speeds ≥ 0, the smaller one first, e.g. \"0 rpm\" \"3000 rpm\"");
  }

  // The motion at a requested speed depends on the start if there are contacts or internal states; otherwise all
  // turns as geared.
  bool searches_start() const {
    const bool plain = !model_->has_contacts() && !model_->has_memory() && scene_.sequence.steps.empty();
    return options_.start && !(options_.speed && plain);
  }

  // Before any start: at the requested speed, else at the scene's or the rated one, all as geared. Empty if small
  // motions exist about the steady motion only: clearance in a joint, a rocking crank.
  std::optional<ModesStudy> modes_at_the_state() {
    begin("modes at the scene's state", 0);
    ModesStudy first = found_;
    try {
      BaseMotion base(model_, {.speed = options_.speed.value_or(usual_speed(*model_)),
                               .angle = options_.angle,
                               .positions = 4 * coarse_positions});
      if (base.equations().has_followers()) return {};
      first.drive = linearise(base);
      name_parts(first);
      list_modes(options_.count, first);
    } catch (const std::runtime_error&) {
      return {};
    } catch (const std::logic_error&) {
      return {};
    }
    if (const std::size_t count = natural_modes(first); count > 0)
      options_.watch.say(fmt::format("at {}, all as geared: {} natural frequenc{}, the first {:.5g} Hz",
                                     first.speed_unit.text(first.drive.at.speed, 5), count, count == 1 ? "y" : "ies",
                                     first.modes.front().omega / (2 * pi)));
    first.notes.push_back(
        "the modes are those at the scene's state, clutches locked and brakes released: no steady motion refines them");
    return first;
  }

  // The steady motion after the scene's own start, if anything depends on it.
  void find_operating_point() {
    if (searches_start()) find_orbit_cycle();
    if (!options_.speed && !options_.angle) stay_at_rest();
    LinearisationPoint point{.speed = options_.speed.value_or(samples_ ? samples_->mean->speed : 0),
                             .angle = options_.angle};
    if (samples_) point.orbit = samples_->mean;
    if (rest_ && !options_.speed) point.orbit = rest_;
    if (!options_.speed && !point.orbit && !vibrates_about_rest()) point.speed = balanced_speed(model_);
    if (!options_.speed && !point.orbit && !vibrates_about_rest() && orbit_) {
      found_.comes_to_rest = orbit_->kind == Orbit::Kind::at_rest;
      found_.runs_away = orbit_->kind == Orbit::Kind::runaway;
    }
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
    else if (const Network::DataRange* table = table_left_at(*model_, point.speed))
      found_.outside_data = {beyond_in_words(*model_, *table, point.speed)};
    note_unsteady_motion();
    if (!samples_ || options_.speed) return;
    found_.cycle = response_of_samples(samples_->torque, samples_->mean->speed, samples_->time);
    if (orbit_->kind == Orbit::Kind::equilibrium) remove_vibrations(*found_.cycle);
    found_.cycle_order = 2 * pi / (samples_->time * std::abs(samples_->mean->speed));
  }

  // A failing start costs at most a fifth of the budget: independent results are still computed.
  void search_start(const std::function<void()>& search) {
    const double most = scene_.run.budget / 5, begin = processor_time();
    bool ended = false;
    try {
      const Deadline deadline(most);
      search();
      ended = orbit_->kind != Orbit::Kind::failed || processor_time() - begin < most;
    } catch (const OutOfTime& out) {
      if (out.budget() != most) throw;
    }
    if (ended) return;
    found_.start_unknown = true;
    samples_.reset(), rest_.reset();
    orbit_.emplace();
    orbit_->words = fmt::format(
        "the scene's own start leads to none within a fifth of the budget ({:.3g} s of processor time)", most);
    found_.notes.push_back(
        "not assessed, for want of a steady motion: torques in it, contacts that change within its cycle, limits in it "
        "and on the way to it; a larger budget in [run] gives the start more time");
  }

  OrbitOptions search_options() const {
    OrbitOptions options = orbit_options(scene_.run, options_.watch.interrupted);
    if (has_rocking_crank(*model_)) options.most_periods = cycles_of_rocking;
    options.progress = [this](const std::string& what, double part) { options_.watch.at(what, 0.1 * part); };
    return options;
  }
  void look_for_orbit() {
    orbit_.emplace();
    try {
      orbit_ = find_orbit(model_, search_options());
    } catch (const std::invalid_argument& refused) {
      orbit_->words = refused.what();
    }
  }
  // A machine that comes to rest is linearised in its last steady motion; the run-up is the complete one.
  void choose_moment() {
    if (options_.speed || options_.angle) return;
    const std::string later = choose_default_moment(given_, effects_, search_options(), options_.at, &*orbit_);
    if (later.empty()) return;
    end_ = MachineAndOrbit{model_, std::move(*orbit_)};
    found_.notes.push_back(later);
    scene_ = as_of(given_, effects_, options_.at);
    model_ = compile_network(network_as_of(scene_, options_.at), scene_, effects_);
    look_for_orbit();
  }

  void sample_orbit() {
    found_.orbit = orbit_->words;
    try {
      if (orbit_->repeats() && orbit_->point.time > 0) samples_ = sample_cycle(*orbit_, cycle_samples);
      if (!samples_ && orbit_->kind == Orbit::Kind::equilibrium) rest_ = means_of_equilibrium(model_, orbit_->state);
    } catch (const std::invalid_argument& refused) {
      found_.orbit = refused.what();
    }
  }

  void find_orbit_cycle() {
    search_start([this] { look_for_orbit(), choose_moment(), sample_orbit(); });
    if (found_.start_unknown) found_.orbit = orbit_->words;
    if (samples_ && samples_->mean->speed == 0) rest_ = samples_->mean, samples_.reset();  // the link stands
    if (!samples_ && !rest_ && !vibrates_about_rest())
      found_.notes.push_back(fmt::format(
          "no motion that repeats to linearise at: {}; instead everything turns as geared, clutches locked and brakes "
          "released, at the speed said",
          found_.orbit));
  }

  bool vibrates_about_rest() const {
    return has_rocking_crank(*model_) || (orbit_ && rests_by_its_angle(*model_, *orbit_));
  }

  // A link that never completes a turn, or rests by its weights, vibrates about rest: it is held there, not averaged.
  void stay_at_rest() {
    if (!orbit_ || !vibrates_about_rest()) return;
    const RestPosition place = position_of_rest(model_, *orbit_);
    options_.angle = found_.rests_at = place.angle;
    rest_ = place.orbit;
    samples_.reset();
    found_.notes.push_back(
        fmt::format("small vibrations about the position of rest at {:.4g}° of \"{}\": weights and loads that depend "
                    "on the angle act as springs, K = −∂M/∂φ; valid for small amplitudes",
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

  double signed_speed(double speed) const { return std::copysign(speed, found_.drive.at.speed); }

  void name_parts(ModesStudy& of) const {
    const std::vector<std::string> names = names_of_nodes(*model_);
    for (const int s : of.drive.shaft) {
      const Shaft& shaft = model_->shafts[at(s)];
      std::string name = names[at(shaft.reference)];
      double largest = -1;
      for (const int n : shaft.nodes) {  // the heaviest part gives the name
        double inertia = model_->network.nodes[at(n)].inertia;
        for (const Network::ShaftElement& e : model_->network.elements)
          if (e.node == n) inertia += e.element->mean_inertia;
        inertia *= std::pow(model_->gain_of_node[at(n)], 2);
        if (inertia > largest) largest = inertia, name = names[at(n)];
      }
      of.shaft_names.push_back(name);
    }
    of.joint_names = names_of_joints(*model_);
  }

  void choose_range() {
    const double speed = std::abs(found_.drive.at.speed);
    OperatingSpeeds& run = found_.margins.speeds;
    if (!found_.rests_at)
      run = operating_speeds(*model_, options_.speed,
                             found_.drive.at.orbit ? std::optional(found_.drive.at.orbit->speed) : std::nullopt);
    found_.fastest = options_.fastest > 0 ? options_.fastest : 1.25 * (speed > 0 ? speed : model_->speed_scale);
    if (run.said && options_.fastest == 0) found_.fastest = std::max(found_.fastest, (1.05 + run.margin) * run.fastest);
    found_.slowest = options_.slowest > 0 ? options_.slowest : 0.05 * found_.fastest;
    found_.highest_order = options_.orders > 0 ? options_.orders : 12;
    if (options_.orders == 0 && !found_.modes.empty()) {
      const std::size_t natural = std::max<std::size_t>(1, natural_modes(found_));
      const double second = found_.modes[std::min<std::size_t>(1, natural - 1)].omega;
      found_.highest_order = std::clamp(std::ceil(second / std::max(speed, 0.2 * found_.fastest)), 12.0, 24.0);
    }
  }

  void find_forcing() {
    Excitations excitations =
        find_excitations(found_.drive, signed_speed(found_.fastest), found_.highest_order, options_.orders == 0);
    found_.here = respond(found_.drive, excitations);
    found_.excitations = std::move(excitations);
    for (const std::string& note : found_.excitations.notes) found_.notes.push_back(note);
    if (found_.excitations.none())
      found_.notes.push_back(
          "nothing in the scene excites the drive by order or frequency: no torque depends on an angle or oscillates "
          "over time");
    note_missing_modes(found_);
  }

  LinearDrive drive_at(double speed) const {
    LinearisationPoint point = found_.drive.at;
    point.speed = signed_speed(speed);
    point.positions = coarse_positions;
    if (!options_.angle && !found_.excitations.by_order.empty())
      point.added = mean_missed(found_.drive, found_.excitations, point.speed);
    return linearise(model_, point);
  }

  // A point of the sweep.
  SpeedResponse respond_at(double speed) const {
    const LinearDrive drive = drive_at(speed);
    SpeedResponse response = respond(drive, found_.excitations);
    response.speed = speed;
    judge_operating_speeds(found_, drive, response);
    return response;
  }

  void sweep() {
    const Excitations& x = found_.excitations;
    const bool limited = any_limits(limited_joints(*model_));
    // Vibrations at fixed frequencies load the joints at every speed, too.
    if (found_.joint_names.empty() || (x.none() && !limited)) return;
    const std::vector<double> speeds = sweep_speeds(found_);
    found_.keeps_its_speed = !grows(found_.drive) && found_.here.speed_amplitude < std::abs(found_.drive.at.speed);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (stopped()) {
        found_.break_off("interrupted within the sweep over the speeds");
        return found_.critical.clear();  // their amplitudes are not known
      }
      Deadline::check();
      if (speeds[i] == 0) continue;
      const double fraction = static_cast<double>(i) / static_cast<double>(speeds.size());
      options_.watch.at("forced response", 0.2 + 0.6 * fraction);
      found_.sweep.push_back(respond_at(speeds[i]));
    }
    if (!options_.response_alone) sweep_as_if_rigid();
    measure_critical_speeds([this](double speed) { return respond_at(speed); },
                            [this](double part) { options_.watch.at("largest responses", 0.8 + 0.05 * part); }, found_);
    omit_speeds_not_held(found_);
  }

  // The reference curves over speed: smooth, so that some points suffice.
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
    if (found_.excitations.none()) return;
    const Network network = network_as_of(scene_, options_.at);
    check_spots(
        {network, scene_, effects_, samples_ ? &*orbit_ : nullptr},
        [this](double speed) { return speed == std::abs(found_.drive.at.speed) ? found_.drive : drive_at(speed); },
        options_, found_);
  }

  // A requested speed is assessed by its linear response; peaks are those of a run-up in any case.
  void judge_all_limits() {
    if (!orbit_ && any_limits(found_.limited)) search_start([this] { look_for_orbit(); });
    judge_limits({model_, orbit_.value_or(Orbit{})}, end_, !options_.speed && !options_.angle, options_.watch, found_);
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
    found_.history = simulate_torque(end_ ? given_ : scene_, effects_,
                                     {.torque = options_.torque, .link = link, .highest = highest, .watch = watch});
    if (!found_.history->complete) found_.break_off(found_.history->diagnosis);
  }

  ModesOptions options_;
  const Scene& given_;
  Effects effects_;
  Scene scene_;
  std::shared_ptr<const Model> model_;
  std::optional<Orbit> orbit_;
  std::optional<MachineAndOrbit> end_;      // where all that is switched leads to, unless it is orbit_
  std::shared_ptr<const MeanMotion> rest_;  // where the link stands and others turn
  std::optional<CycleSamples> samples_;
  std::string at_work_;
  bool listed_ = false;  // the modes at the operating point
  ModesStudy found_;
};

}  // namespace

ModesStudy find_modes(const Scene& scene, const Effects& effects, const ModesOptions& options) {
  if (scene.run.model == "multibody")
    throw std::invalid_argument("modes belong to the reduced model; set model = \"reduced\" in [run]");
  const Deadline deadline(scene.run.budget);
  return Study(scene, effects, options).result();
}

}  // namespace kurbel
