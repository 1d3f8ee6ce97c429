// modes.cpp — from the linearised drive to its modes, critical speeds, and swings over the speed range.
#include "studies/modes/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/torque_history.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int sweep_points = 240;
constexpr std::size_t most_solves = 400'000;  // of n-by-n systems in a sweep, over n
constexpr int coarse_positions = 16;          // of the average at each speed of the sweep

class Study {
 public:
  Study(const Scene& scene, const Effects& effects, const ModesOptions& options)
      : scene_(scene), options_(options), effects_(effects), model_(compile(scene, linear(effects))) {
    for (const EffectFlag& flag : effect_flags())
      if (effects.*(flag.flag) && flag.unsaid != EffectFlag::Unsaid::part_of_machine && has_parameters(scene, flag))
        found_.notes.push_back(fmt::format("{} left out of modes and forced response{}", flag.words,
                                           options.torque.empty() ? "" : ", counted in the simulated torque"));
    const auto told_to = [&](std::string_view what) {
      return std::any_of(scene.components.begin(), scene.components.end(),
                         [&](const Section& s) { return s.kind && s.kind->name.find(what) != std::string::npos; });
    };
    if (told_to("clutch")) found_.notes.push_back("clutches count as locked");
    if (told_to("brake")) found_.notes.push_back("brakes count as released");
    found_.title = scene.heading();
    found_.speed_unit = scene.speed_unit;
    found_.scene_file = scene.file;
    found_.scene_text = scene.text;
    found_.link = model_->node_label(model_->reduction_node);
  }

  static Effects linear(Effects effects) {
    for (const EffectFlag& flag : effect_flags())
      if (flag.unsaid != EffectFlag::Unsaid::part_of_machine) effects.*(flag.flag) = false;
    effects.locked = true;
    return effects;
  }

  ModesStudy result() {
    check_options();
    find_operating_point();
    say("modes", 0);
    find_all_modes();
    name_parts();
    choose_range();
    say("excitation", 0.1);
    find_forcing();
    say("forced response", 0.2);
    find_critical_speeds();
    find_zones();
    sweep();
    find_barred_ranges(
        *model_, options_.barred_factor, [this](double speed) { return respond(drive_at(speed), found_.excitations); },
        found_);
    if (!options_.torque.empty()) add_history();
    judge_all_limits();
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
    if (options_.barred_factor <= 0) throw std::invalid_argument("--barred: must be > 0");
  }

  void find_operating_point() {
    const double speed = options_.speed.value_or(steady_or_usual_speed());
    found_.drive = linearise(model_, {.speed = speed, .angle = options_.angle});
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

  // A machine that starts from rest is looked at where it runs steadily near its rated speed, if it does: mean torques
  // balance, and a faster motion is braked.
  double steady_or_usual_speed() const {
    const double rated = usual_speed(*model_);
    if (model_->scene.run.start.speed != 0 || model_->free_shafts < model_->shafts.size()) return rated;
    const LinearDrive coarse = linearise(model_, {.speed = rated, .positions = coarse_positions});
    const Excitations loads = find_excitations(coarse, 1.25 * rated, 1);
    const auto left = [&](double speed) {
      return linearise(model_, {.speed = speed,
                                .positions = coarse_positions,
                                .added = mean_of_angle(coarse, loads, speed),
                                .angle_torques = false})
          .mean_torque;
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

  void find_all_modes() {
    const ModesWanted wanted{.count = options_.count};
    found_.undamped = undamped_modes(found_.drive, wanted);
    found_.damped = damped_modes(found_.drive, found_.undamped, wanted);
    const UndampedModes& u = found_.undamped;
    for (Eigen::Index i = u.rigid; i < u.omega.size() && i < u.rigid + options_.count; ++i) {
      Mode mode;
      mode.number = static_cast<int>(i) - u.rigid + 1;
      mode.omega = u.omega[i];
      mode.shape = u.shapes.col(i);
      mode.shares = energy_shares(found_.drive, mode.shape);
      found_.modes.push_back(std::move(mode));
    }
    pair_damped();
    for (const DampedMode& d : found_.damped)
      if (d.lambda.real() > 1e-9 * std::abs(d.lambda) && d.lambda.real() > 0) {
        found_.notes.push_back(
            fmt::format("{} grows by itself at this point (λ = {:.4g} 1/s): the operating point is unstable: the "
                        "torques there feed it more than they damp it (as those of a motor below its breakdown speed)",
                        d.lambda.imag() > 0 ? fmt::format("the swing at {:.5g} Hz", d.lambda.imag() / (2 * pi))
                                            : "the motion as a "
                                              "whole",
                        d.lambda.real()));
        break;
      }
  }

  // The damped mode whose shape is most like the undamped one's, each used once; shapes are compared with M.
  void pair_damped() {
    std::vector<char> used(found_.damped.size(), 0);
    for (Mode& mode : found_.modes) {
      double best = 0;
      std::size_t which = found_.damped.size();
      for (std::size_t i = 0; i < found_.damped.size(); ++i) {
        const DampedMode& d = found_.damped[i];
        if (used[i] || d.lambda.imag() <= 0) continue;
        const Eigen::VectorXcd moved = found_.drive.inertia.cwiseProduct(mode.shape).cast<Complex>();
        const double norm = std::sqrt((found_.drive.inertia.array() * d.shape.array().abs2()).sum());
        const double near = 1 - std::min(1.0, std::abs(std::abs(d.lambda) - mode.omega) / mode.omega);
        const double like = std::abs(moved.dot(d.shape)) / norm * near;
        if (like > best) best = like, which = i;
      }
      mode.ratio = 1;  // until a swing is found that grows out of it
      if (best < 0.3) continue;
      used[which] = 1;
      mode.lambda = found_.damped[which].lambda;
      mode.ratio = found_.damped[which].ratio();
    }
  }

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
    std::map<std::string, int> total, seen;
    for (const ElasticJoint& e : model_->elastic) ++total[model_->network.joints[at(e.joint)].component];
    for (const ElasticJoint& e : model_->elastic) {
      const std::string& name = model_->network.joints[at(e.joint)].component;
      found_.joint_names.push_back(total[name] == 1 ? name : fmt::format("{}.{}", name, ++seen[name]));
    }
  }

  void choose_range() {
    const double speed = std::abs(found_.drive.at.speed);
    found_.fastest = options_.fastest > 0 ? options_.fastest : 1.25 * (speed > 0 ? speed : model_->speed_scale);
    found_.slowest = options_.slowest > 0 ? options_.slowest : 0.05 * found_.fastest;
    found_.highest_order = options_.orders > 0 ? options_.orders : 12;
    if (options_.orders == 0 && found_.modes.size() > 0) {
      const double second = found_.modes[std::min<std::size_t>(1, found_.modes.size() - 1)].omega;
      found_.highest_order = std::clamp(std::ceil(second / std::max(speed, 0.2 * found_.fastest)), 12.0, 24.0);
    }
  }

  void find_forcing() {
    found_.excitations = find_excitations(found_.drive, signed_speed(found_.fastest), found_.highest_order);
    for (const std::string& note : found_.excitations.notes) found_.notes.push_back(note);
    if (!found_.excitations.by_frequency.empty()) {
      LinearisationPoint point = found_.drive.at;
      point.added = mean_beyond_start(found_.drive, found_.excitations);
      found_.drive = linearise(model_, point);
    }
    note_unsteady_motion();
    if (found_.excitations.by_order.empty() && found_.excitations.by_frequency.empty())
      found_.notes.push_back(
          "nothing in the scene excites the drive by order or frequency: no torque depends on an "
          "angle, and no torque source swings");
    found_.here = respond(found_.drive, found_.excitations);
  }

  LinearDrive drive_at(double speed) const {
    LinearisationPoint point{.speed = signed_speed(speed), .angle = options_.angle, .positions = coarse_positions};
    point.added = found_.drive.at.added;
    if (!options_.angle) {
      point.angle_torques = false;
      point.added.resize(model_->shafts.size(), 0.0);
      const std::vector<double> mean = mean_of_angle(found_.drive, found_.excitations, point.speed);
      for (std::size_t s = 0; s < mean.size(); ++s) point.added[s] += mean[s];
    }
    return linearise(model_, point);
  }

  // Where an order that has any strength meets a mode.
  void find_critical_speeds() {
    const Excitations& x = found_.excitations;
    if (x.by_order.empty()) return;
    double strongest = 0;
    for (std::size_t r = 1; r <= x.harmonics; ++r)
      strongest = std::max(strongest, x.strength(r, signed_speed(found_.fastest)));
    for (const Mode& mode : found_.modes)
      for (std::size_t r = 1; r <= x.harmonics; ++r) {
        const double speed = mode.omega / x.order(r);
        if (speed < found_.slowest || speed > found_.fastest || x.strength(r, signed_speed(speed)) < 1e-6 * strongest)
          continue;
        found_.critical.push_back({.speed = speed, .mode = mode.number, .order = x.order(r), .harmonic = r});
      }
    std::sort(found_.critical.begin(), found_.critical.end(),
              [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.speed < b.speed; });
  }

  void find_zones() {
    const auto& elements = model_->network.elements;
    if (std::none_of(elements.begin(), elements.end(),
                     [](const Network::ShaftElement& e) { return e.element->cycle > 0; }))
      return;
    for (const Mode& mode : found_.modes) {
      const std::vector<double> variation = inertia_variation(found_.drive, mode.shape, found_.excitations.harmonics);
      for (std::size_t r = 1; r < variation.size(); ++r) {
        ParametricZone zone{.mode = mode.number, .harmonic = r};
        zone.centre = 2 * mode.omega / found_.excitations.order(r);
        zone.variation = variation[r];
        zone.half_width = parametric_half_width(variation[r], std::max(0.0, mode.ratio));
        if (zone.variation > 1e-6 && zone.centre >= found_.slowest && zone.centre <= found_.fastest)
          found_.zones.push_back(zone);
      }
    }
    std::sort(found_.zones.begin(), found_.zones.end(),
              [](const ParametricZone& a, const ParametricZone& b) { return a.centre < b.centre; });
  }

  std::vector<double> sweep_speeds() {
    std::vector<double> speeds;
    for (int i = 0; i <= sweep_points; ++i)
      speeds.push_back(found_.slowest + (found_.fastest - found_.slowest) * i / sweep_points);
    for (const CriticalSpeed& c : found_.critical) {
      const double zeta = std::clamp(found_.modes[at(c.mode - 1)].ratio, 1e-4, 0.2);
      for (const double factor : {1 - 2 * zeta, 1 - zeta, 1 - 0.4 * zeta, 1.0, 1 + 0.4 * zeta, 1 + zeta, 1 + 2 * zeta})
        speeds.push_back(c.speed * factor);
    }
    speeds.push_back(std::abs(found_.drive.at.speed));
    std::sort(speeds.begin(), speeds.end());
    std::erase_if(speeds, [&](double w) { return w < found_.slowest || w > found_.fastest; });
    speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
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
    // What swings at frequencies of its own bears loads at every speed, too.
    if (x.by_order.empty() && x.by_frequency.empty() && !any_limits(limited_joints(*model_))) return;
    const std::vector<double> speeds = sweep_speeds();
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (stopped()) {
        found_.complete = false;
        found_.diagnosis = "interrupted within the sweep over the speeds";
        return;
      }
      Deadline::check();
      if (speeds[i] == 0) continue;
      const double fraction = static_cast<double>(i) / static_cast<double>(speeds.size());
      options_.watch.at("forced response", 0.2 + 0.6 * fraction);
      found_.sweep.push_back(respond(drive_at(speeds[i]), x));
      found_.sweep.back().speed = speeds[i];
    }
    fill_critical_amplitudes();
  }

  // From the sweep, which has a point at every critical speed unless it was thinned.
  void fill_critical_amplitudes() {
    for (CriticalSpeed& c : found_.critical) {
      const SpeedResponse* nearest = nullptr;
      for (const SpeedResponse& s : found_.sweep)
        if (!nearest || std::abs(s.speed - c.speed) < std::abs(nearest->speed - c.speed)) nearest = &s;
      if (!nearest) return;
      double most = -1;
      for (std::size_t j = 0; j < nearest->orders.size(); ++j) {
        const double amplitude = std::abs(nearest->orders[j][c.harmonic]);
        if (amplitude > most) most = amplitude, c.joint = j;
      }
      c.amplitude = most;
    }
  }

  // By the motion that the machine with all its effects keeps, where any limits are stated.
  void judge_all_limits() {
    std::shared_ptr<const Model> machine;
    Regime regime;
    if (any_limits(found_.limited)) {
      machine = compile(scene_, effects_);  // the model's scene has no sequence: it is locked
      RegimeOptions options;
      options.budget = scene_.run.budget;
      options.interrupted = options_.watch.interrupted;
      try {
        regime = find_regime(machine, options);
      } catch (const std::invalid_argument& error) {
        regime.words = error.what();
      }
    }
    judge_limits(machine, regime, !options_.speed && !options_.angle, options_.watch, found_);
  }

  void add_history() {
    found_.history = simulate_torque(*model_, effects_, found_.modes.back().omega, options_);
    if (found_.history->complete) return;
    found_.complete = false;
    found_.diagnosis = found_.history->diagnosis;
  }

  const Scene& scene_;
  const ModesOptions& options_;
  Effects effects_;
  std::shared_ptr<const Model> model_;
  ModesStudy found_;
};

}  // namespace

double parametric_half_width(double variation, double damping_ratio) {
  const double rest = variation * variation / 16 - damping_ratio * damping_ratio;
  return rest > 0 ? std::sqrt(rest) : 0;
}

ModesStudy find_modes(const Scene& scene, const Effects& effects, const ModesOptions& options) {
  if (scene.run.model == "multibody")
    throw std::invalid_argument("modes belong to the reduced model; set model = \"reduced\" in [run]");
  const Deadline deadline(scene.run.budget);
  return Study(scene, effects, options).result();
}

}  // namespace kurbel
