// steady.cpp — operating point, steady cycle and start, for every requested model.
#include "studies/steady/steady.h"
#include "studies/run/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/default_moment.h"
#include "engine/orbit/link_speeds.h"
#include "engine/run/run.h"
#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/steady/cycle_figures.h"
#include "studies/steady/cycle_search.h"

namespace kurbel {
namespace {

// After the scene's own start the link vibrates without completing a turn.
bool turns_back(const std::shared_ptr<const Model>& rigid, double cycle) {
  const Model& m = *rigid;
  const std::size_t tracked = at(m.reduction_angle);
  double time = 2 * cycle / std::max(std::abs(m.scene.run.start.speed), 0.05 * m.speed_scale);
  for (int k = 0; k < 6; ++k, time *= 2) {
    Equations equations(rigid, false);
    TurningTimes turning(m);
    RunOptions run{.tolerance = 1e-10,
                   .method = "auto",
                   .until = time,
                   .budget = m.scene.run.budget,
                   .interrupted = nullptr,
                   .progress = {}};
    run.from = {0, equations.start(0)};
    const double begin = equations.angle_with_turns(tracked, run.from->y);
    run.stop = [&](double, std::span<const double> y) {
      return std::min(1.0, cycle - std::abs(equations.angle_with_turns(tracked, y) - begin));
    };
    const RunOutcome outcome = integrate(equations, run, {&turning});
    if (!outcome.complete || outcome.stopped) return false;
    if (turning.times().size() > 1) return true;
  }
  return false;
}

// A gain or loss per cycle counts only beyond the error of the balance.
bool is_balanced(const OperatingDiagram& d) {
  const MeanTorques& m = d.curve.back();
  const double scale = std::max({std::abs(m.drive), std::abs(m.load), 1e-300});
  return std::abs(m.net()) <= std::max(1e-9 * scale, d.balance_error);
}

// Steady motion of a family: constant drive torque and loads of the angle alone.
std::string family_text(const OperatingDiagram& d, double cycle, const std::string& link) {
  const double net = d.curve.back().net();
  const std::string why = fmt::format(
      "no torque of this machine depends on the speed, so no speed is preferred: what a cycle gains or loses is the "
      "same at every speed of \"{}\"",
      link);
  if (is_balanced(d))
    return fmt::format(
        "{}, here nothing. Steady motion is a family of cycles, one for every mid speed (multiplier exactly 1); say "
        "which one: --mid-speed \"60 rpm\"",
        why);
  return fmt::format(
      "{}, here {} of {} ({} driving, {} resisting): it {} for ever, and there is no steady cycle. The drive torque "
      "that a steady cycle of a given speed needs is found with --mid-speed \"60 rpm\"",
      why, net > 0 ? "a gain" : "a loss", with_unit(std::abs(net) * cycle, "J", 4),
      with_unit(d.curve.back().drive, "N*m", 5), with_unit(d.curve.back().load, "N*m", 5),
      net > 0 ? "accelerates" : "slows down");
}

// "frequency 13 Hz, amplitude 0.0153 rad of "disc" …": of the shaft with the largest amplitude.
std::string vibration_text(const SteadyCycle& c) {
  const Figure* most = nullptr;
  for (const Figure& f : c.figures)
    if (f.what == quantities::vibration_amplitude && (!most || f.value > most->value)) most = &f;
  if (most && most->value == 0) return "it stands still";
  return fmt::format("frequency {}{}", with_error(*c.find("vibration_frequency"), "Hz"),
                     most ? fmt::format(", amplitude {} of \"{}\"", with_error(*most, "rad"), most->of) : "");
}

class Study {
 public:
  Study(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options)
      : scene_(scene), effects_(effects), options_(options) {
    if (!options.hold_by.empty() && !options.holds_speed())
      throw std::invalid_argument(fmt::format(
          "--hold-by {}: which speed is it to hold? Give --mid-speed or --mean-speed, e.g. --mean-speed \"60 rpm\"",
          in_quotes(options.hold_by)));
    const OrbitOptions search = orbit_options(scene, options.periods, options.watch);
    out_.later = choose_default_moment(scene, effects.back(), search, options_.at);
  }

  SteadyStudy run() {
    const auto model = compile(scene_, effects_.back());
    out_.is_of(scene_);
    out_.link = name_of_link(*model);
    out_.mid_speed = options_.mid_speed;
    if (!out_.later.empty())
      out_.notes.push_back(out_.later);
    else if (options_.at.any())
      out_.notes.push_back(
          fmt::format("the machine as it is {}: what is switched later is omitted", options_.at.describe()));
    find_diagram(*model);
    refuse_family();
    for (const Effects& effects : effects_)
      if (&effects == &effects_.back() || is_determined(effects)) find_cycle(effects);
    if (options_.start_search && out_.complete) find_start();
    conclude();
    return std::move(out_);
  }

 private:
  void progress(const std::string& what, double fraction) const { options_.watch.at(what, fraction); }
  void log(const std::string& text) const { options_.watch.say(text); }

  // Mean torques over a cycle at constant speed are meaningful for a machine of one coordinate without memory.
  void find_diagram(const Model& model) {
    out_.no_diagram = why_no_diagram(model);
    if (!out_.no_diagram.empty()) return;
    progress("operating points", 0);
    std::optional<RigidMachine> machine;
    try {
      rigid_ = compile(scene_, rigid_effects());
      machine.emplace(rigid_);
    } catch (const std::invalid_argument& error) {
      out_.no_diagram = error.what();
      rigid_.reset();
      return;
    }
    lossy_ = machine_with_losses(build_network(scene_), scene_, effects_.back());
    out_.diagram = operating_diagram(*machine, sense(), lossy_);
    // The drive may turn the machine the other way than it starts.
    if (!out_.diagram->working_point() && out_.diagram->strongest.value < 0 && !options_.holds_speed())
      out_.diagram = operating_diagram(*machine, -sense(), lossy_);
    log(fmt::format("operating points: {} of {} speeds scanned", out_.diagram->points.size(),
                    out_.diagram->curve.size()));
    const bool without_losses = out_.diagram->estimate;
    if (model.has_memory()) out_.diagram->become_estimate();
    if (out_.diagram->estimate)
      out_.notes.push_back(fmt::format(
          "operating points are estimates, by the static torques of the rigid machine: {} are not in them; the steady "
          "cycle and the start from rest include them",
          !without_losses      ? "internal states"
          : model.has_memory() ? "losses that depend on the load and internal states"
                               : "losses that depend on the load"));
  }
  std::string why_no_diagram(const Model& m) const {
    if (!scene_.sequence.steps.empty()) return "the operating sequence sets what drives and brakes";
    for (const ElasticJoint& e : m.elastic)
      if (e.slips || e.springless)
        return fmt::format("\"{}\" may slip, so that one speed does not determine all torques",
                           m.network.joints[at(e.joint)].component);
    if (prescribed_node(m) >= 0) return "a speed is prescribed: the drive gives whatever torque that needs";
    const Periodicity periodicity = periodicity_of(m);
    if (periodicity.by_time || periodicity.settled_from > 0 || is_switched(m.network))
      return "a torque depends on time: angle and speed alone do not determine the mean torques";
    return {};
  }
  int sense() const {
    const double speed = options_.held_speed().value_or(scene_.run.start.speed);
    const StartSettings& start = scene_.run.start;
    const int on =
        start.on.empty() || options_.holds_speed() ? rigid_->reduction_node : rigid_->network.ports.at(start.on).in;
    return speed / rigid_->node_ratio[at(on)] < 0 ? -1 : 1;
  }
  void refuse_family() const {
    if (!out_.diagram || out_.diagram->uses_speed || out_.diagram->estimate || options_.holds_speed()) return;
    // If losses balance the machine, or if it completes no turn, the scene's own start determines the member of the
    // family.
    const double cycle = periodicity_of(*rigid_).angle;
    if (is_balanced(*out_.diagram) && (lossy_.model || turns_back(rigid_, cycle))) return;
    throw std::invalid_argument(family_text(*out_.diagram, cycle, out_.link));
  }

  // A simpler machine for comparison may have an indeterminate torque that the scene's own does not: a loop that becomes rigid.
  bool is_determined(const Effects& effects) try {
    compile(scene_, effects);
    return true;
  } catch (const SceneError& open) {
    out_.notes.push_back(fmt::format("the machine with {} is omitted: {}",
                                     effects.describe() == "none" ? "no effects" : effects.describe(),
                                     open.messages.front().text));
    return false;
  }

  void find_cycle(const Effects& effects) {
    const bool stopped = options_.watch.stopped();
    if (stopped) return incomplete("interrupted");
    progress("steady cycle with effects: " + effects.describe(), 0);
    SteadyCycle cycle = search_cycle(scene_, effects, options_);
    log(
        fmt::format("{}: {} unknowns; {} after a run of {} cycles and {} of Newton's, {} with derivative; cost {:.1f} "
                    "cycles (target {:.0f}); residual {:.1e}; {:.3g} ms",
                    cycle.label, cycle.unknowns, cycle.found ? "found" : "not found: " + cycle.why, cycle.run_cycles,
                    cycle.point.periods, cycle.point.derivatives, cycle.cost, cycle.cost_limit, cycle.point.residual,
                    1e3 * cycle.cpu_seconds));
    if (!cycle.found) {
      cycle.why = diagnose(cycle);
      incomplete(is_interrupted(cycle) ? "interrupted"
                                       : fmt::format("no steady cycle ({}): {}", cycle.label, cycle.why));
    }
    for (const std::string& note : cycle.notes) {
      const auto same = std::find(out_.notes.begin(), out_.notes.end(),
                                  out_.cycles.empty() ? "" : out_.cycles.front().label + ": " + note);
      if (same != out_.notes.end())
        *same = note;  // of both models
      else
        out_.notes.push_back(cycle.label + ": " + note);
    }
    out_.cycles.push_back(std::move(cycle));
  }
  void incomplete(const std::string& why) {
    if (out_.complete) out_.break_off(why);
  }

  // The mean torques explain why there is none; else the machine's motion.
  std::string diagnose(const SteadyCycle& cycle) const {
    const bool stands = cycle.kind == Orbit::Kind::at_rest || cycle.kind == Orbit::Kind::equilibrium;
    if (stands && !scene_.sequence.steps.empty() && !options_.at.any())
      return fmt::format(
          "{}. All steps of the sequence are done then; --at \"step N\" gives the steady motion after the Nth of them "
          "({} in all)",
          cycle.why, scene_.sequence.steps.size());
    if (is_interrupted(cycle) || !out_.diagram || options_.holds_speed()) return cycle.why;
    if (const std::string none = out_.diagram->why_none(out_.link); !none.empty()) return none;
    const OperatingPoint* p = out_.diagram->working_point();
    if (p && cycle.kind == Orbit::Kind::at_rest)
      return fmt::format("stall: on average the drive would hold {} ({}), but from the scene's own start {}",
                         scene_.speed_unit.text(p->speed.value, 5), with_unit(p->torque.value, "N*m", 4), cycle.why);
    return cycle.why;
  }
  static bool is_interrupted(const SteadyCycle& cycle) {
    return cycle.end == ReturnMap::End::interrupted || cycle.kind == Orbit::Kind::interrupted;
  }

  // Several times the time by the mean torques; if these do not or hardly suffice, by the rated torque.
  double start_limit(double target) const {
    RigidMachine machine(rigid_);
    const double inertia = machine.constant_inertia() + machine.mechanism_inertia(1).value;
    const double by_rated_torque = inertia * target / rigid_->torque_scale;
    double time = 0;
    const std::vector<MeanTorques>& curve = out_.diagram->curve;
    for (std::size_t i = 0; i + 1 < curve.size() && std::abs(curve[i + 1].omega) < target; ++i) {
      const double net = std::min(curve[i].net(), curve[i + 1].net());
      if (net <= 0) return 100 * by_rated_torque;
      time += inertia * std::abs(curve[i + 1].omega - curve[i].omega) / net;
    }
    return std::min(5 * time, 1000 * by_rated_torque);
  }

  void find_start() {
    const SteadyCycle* rigid = nullptr;
    for (const SteadyCycle& c : out_.cycles)
      if (c.found && c.kind != Orbit::Kind::vibrating && !is_elastic(*c.model)) rigid = &c;
    if (!rigid || !out_.diagram || options_.holds_speed()) return;
    const double target = 0.95 * rigid->find("mean_speed." + out_.link)->value;
    const double limit = start_limit(std::abs(target)) + 20 * rigid->cycle_time;
    progress("start from rest", 0.5);
    // For the machine with this cycle, including its losses and internal states.
    Effects effects = *std::find_if(effects_.begin(), effects_.end(),
                                    [&](const Effects& e) { return e.describe() == rigid->effects; });
    effects.locked = true;
    out_.start = start_from_rest(compile(scene_, effects), target, limit, options_.watch.interrupted);
    const double search_limit = out_.start->reached ? 4 * out_.start->time.value : limit;
    out_.ratios = fastest_ratios(scene_, effects, target, search_limit, options_.watch.interrupted);
  }

  std::string speed_text(const SteadyCycle& c) const {
    const SpeedUnit& unit = scene_.speed_unit;
    const Figure* delta = c.find("delta." + out_.link);
    return fmt::format("mean speed {}{}", with_error(*c.find("mean_speed." + out_.link) / unit.size, unit.name),
                       delta && c.kind != Orbit::Kind::equilibrium ? ", δ = " + with_error(*delta, "") : "");
  }
  void conclude() {
    if (!out_.complete) {
      out_.conclusion = out_.diagnosis;
      return;
    }
    std::string text;
    for (const SteadyCycle& c : out_.cycles) {
      const std::string begin = c.kind == Orbit::Kind::equilibrium ? fmt::format("Equilibrium of \"{}\", ", out_.link)
                                : c.kind == Orbit::Kind::vibrating ? std::string("Vibration about a position, ")
                                                                   : fmt::format("Steady cycle of \"{}\", ", out_.link);
      text += fmt::format("{}{}: {}, {}", text.empty() ? begin : "; ", c.label,
                          c.kind == Orbit::Kind::vibrating ? vibration_text(c) : speed_text(c), c.stability);
      if (c.repeats_after > options_.periods) text += fmt::format(", repeats after {} cycles only", c.repeats_after);
      if (c.held_quantity)
        text += fmt::format(", with {} = {} instead of {}", c.held_quantity->key,
                            with_unit(c.held_quantity->value, c.held_quantity->unit, 6),
                            with_unit(c.held_quantity->of_scene, c.held_quantity->unit, 6));
      else if (options_.holds_speed())
        text +=
            fmt::format(", with {} {} than the scene's drive at \"{}\"", with_unit(std::abs(c.added_torque), "N*m", 6),
                        c.added_torque < 0 ? "less" : "more", c.added_at);
    }
    if (out_.start && out_.start->falls_short) text += ". " + capitalised(out_.start->why);
    out_.conclusion = text + (out_.later.empty() ? "." : fmt::format(". At the end {}.", out_.later));
  }

  const Scene& scene_;
  const std::vector<Effects>& effects_;
  SteadyOptions options_;
  std::shared_ptr<const Model> rigid_;
  LossyMachine lossy_;
  SteadyStudy out_;
};

}  // namespace

std::vector<Effects> effects_side_by_side(const Scene& scene) {
  Effects full = scene.effects;
  if (full.describe() == "none") full.all_elastic = true;
  const auto elastic = compile(scene, full);
  if (!is_elastic(*elastic)) return {scene.effects};
  return {rigid_twin(*elastic), full};
}

SteadyStudy steady(const Scene& scene, const std::vector<Effects>& effects, const SteadyOptions& options) {
  const Deadline deadline(scene.run.budget);
  return Study(scene, effects, options).run();
}

}  // namespace kurbel
