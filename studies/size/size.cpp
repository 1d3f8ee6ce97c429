// size.cpp — from a scene to the flywheel that a demanded δ needs, and back to the δ that the sized machine has.
#include "studies/size/size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/scene/units.h"
#include "studies/scenes/kinds.h"
#include "studies/steady/steady_simulation.h"

namespace kurbel {
namespace {

const Kind& flywheel_kind() {
  for (const Kind& kind : all_kinds())
    if (kind.name == "flywheel") return kind;
  throw std::logic_error("no kind \"flywheel\"");
}

// The component that is sized: the one named, else the scene's only flywheel; empty: one is put on the crank's shaft.
std::string chosen_flywheel(const Scene& scene, const std::string& named) {
  std::vector<std::string> bodies, flywheels;
  for (const Section& s : scene.components) {
    if (s.kind->name == "flywheel" || s.kind->name == "inertia") bodies.push_back(s.name);
    if (s.kind->name == "flywheel") flywheels.push_back(s.name);
  }
  if (!named.empty()) {
    if (std::count(bodies.begin(), bodies.end(), named)) return named;
    throw std::invalid_argument(
        fmt::format("--flywheel {}: no flywheel or inertia of the scene; {}", in_quotes(named),
                    bodies.empty() ? "it has none: leave the option out, and one is put on the crank's shaft"
                                   : "allowed: " + listed(bodies)));
  }
  if (flywheels.size() > 1)
    throw std::invalid_argument(
        fmt::format("the scene has several flywheels, {}; say which one is to be sized: --flywheel NAME",
                    listed(flywheels, "and")));
  return flywheels.empty() ? "" : flywheels.front();
}

class Sizer {
 public:
  Sizer(const Scene& scene, const SizeOptions& options) : options_(options) {
    choose_delta();
    s_.flywheel = chosen_flywheel(scene, options.flywheel);
    s_.flywheel_added = s_.flywheel.empty();
    scene_ = scene;
    if (s_.flywheel_added) {
      const RigidMachine bare(scene);
      s_.flywheel = scene.find("flywheel") ? "sized_flywheel" : "flywheel";
      scene_ = with_flywheel(scene, s_.flywheel, 0, component_of(bare.model(), bare.model().reduction_node));
    }
    machine_.emplace(scene_);
    s_.title = scene.heading();
    s_.speed_unit = scene.speed_unit;
    s_.scene_file = scene.file;
    s_.link = model().node_label(model().reduction_node);
    s_.sheet = options.sheet;
  }

  Sizing run() {
    list_inertias();
    find_speed();
    find_cycle();
    if (machine_->uses_time()) s_.notes.push_back("some torque depends on time; the torques are those at t = 0");
    if (model().scene.run.start.speed == 0)
      s_.notes.push_back(
          "sizing looks at steady motion; whether the machine starts from rest is what kurbel run shows");
    apply_methods();
    count_motor();
    find_punch();
    find_dimensions();
    if (options_.simulate) simulate_sized();
    return std::move(s_);
  }

 private:
  const Model& model() const { return machine_->model(); }
  static std::string component_of(const Model& m, int node) { return m.network.nodes[at(node)].component; }

  void choose_delta() {
    if (options_.delta && !options_.machine.empty())
      throw std::invalid_argument("--delta and --machine both given; keep one");
    if (options_.delta) {
      s_.delta = *options_.delta;
      s_.delta_source = "demanded";
    } else if (!options_.machine.empty()) {
      const CustomaryDelta& c = customary_delta(options_.machine);
      s_.delta = c.high;
      s_.delta_source = c.low == c.high
                            ? fmt::format("customary for {} ({})", c.doc, c.source)
                            : fmt::format("customary for {}: {:g} … {:g} ({})", c.doc, c.low, c.high, c.source);
    } else {
      throw std::invalid_argument(
          "which speed fluctuation is demanded? Give --delta, e.g. --delta 0.05, or --machine "
          "press for a customary value");
    }
    check_delta(s_.delta);
  }

  // Everything that turns at constant ratio, on the flywheel's shaft.
  void list_inertias() {
    const Model& m = model();
    const int node = m.network.ports.at(s_.flywheel).in;
    s_.flywheel_ratio = m.node_ratio[at(node)];
    std::vector<std::string> motors;
    for (const Network::ShaftElement& e : m.network.elements)
      if (e.element->account == Account::driving && !(e.element->cycle > 0)) motors.push_back(e.component);
    if (!motors.empty()) s_.motor = motors.front();
    for (std::size_t n = 0; n < m.network.nodes.size(); ++n) {
      const std::string& name = m.network.nodes[n].component;
      const double ratio = m.node_ratio[n] / s_.flywheel_ratio, inertia = m.network.nodes[n].inertia * ratio * ratio;
      const Section* section = m.scene.find(name);
      if (name == s_.flywheel) {
        s_.flywheel_now += inertia;
      } else if (std::count(motors.begin(), motors.end(), name)) {
        s_.motor_inertia += inertia;
        add_part(name, inertia);
      } else if (section && section->kind->name.find("gear") != std::string::npos) {
        s_.gearbox_inertia += inertia;
        add_part(name, inertia);
      } else {
        s_.other_inertia += inertia;
        add_part(name, inertia);
      }
    }
  }
  void add_part(const std::string& name, double inertia) {
    if (inertia == 0) return;
    for (auto& [known, sum] : s_.other_parts)
      if (known == name) {
        sum += inertia;
        return;
      }
    s_.other_parts.emplace_back(name, inertia);
  }

  void find_speed() {
    if (machine_->uses_speed()) {
      try {
        s_.operating = operating_speed(*machine_);
      } catch (const WeakDrive&) {
        throw;
      } catch (const std::invalid_argument& error) {
        if (!options_.mid_speed) throw;
        s_.notes.push_back(fmt::format("no operating speed: {}", error.what()));
      }
    }
    if (options_.mid_speed) {
      s_.mid_speed = *options_.mid_speed;
      s_.mid_speed_source = "given";
      if (s_.operating && std::abs(s_.operating->speed / s_.mid_speed - 1) > 0.01)
        s_.notes.push_back(fmt::format("the mid speed given is {}, but with its motor the machine runs at {}",
                                       s_.speed_unit.text(s_.mid_speed, 5),
                                       s_.speed_unit.text(s_.operating->speed, 5)));
    } else if (s_.operating) {
      s_.mid_speed = s_.operating->speed;
      s_.mid_speed_source = s_.motor.empty() ? "operating speed, where the mean torques balance"
                                             : "operating speed of the motor under the mean load";
      for (const double other : s_.operating->others)
        s_.notes.push_back(fmt::format("the machine can also run steadily at {}", s_.speed_unit.text(other, 5)));
    } else {
      throw std::invalid_argument(
          "with torques that do not depend on speed every speed is a steady one, so it must be given: "
          "--mid-speed \"60 rpm\"");
    }
  }

  void find_cycle() {
    s_.cycle = machine_cycle(*machine_, s_.mid_speed);
    const Piecewise &drive = s_.cycle.drive, &load = s_.cycle.load;
    const double scale = std::max(drive.largest(), load.largest());
    s_.engine = drive.maximum().value - drive.minimum().value > 1e-9 * scale;
    if (!s_.engine) {
      if (!machine_->uses_speed() && drive.mean() > 1e-12 * scale) compare_constant_drive(drive.mean(), load.mean());
      s_.diagram = with_constant_drive(load);
      return;
    }
    const double rest = drive.mean() - load.mean();
    if (!(drive.mean() > 0)) with_constant_load(drive);  // says that the drive does no net work
    if (std::abs(rest) > 1e-6 * drive.mean())
      s_.notes.push_back(unbalanced(drive.mean(), load.largest() > 0 ? load.mean() : 0, rest));
    s_.diagram = work_diagram(drive, load + load.constant(rest));
  }

  // What the sizing puts beside the scene's torques, which alone would change the machine's speed from cycle to cycle.
  static std::string unbalanced(double drive, double load, double rest) {
    const std::string text =
        load == 0 ? fmt::format(
                        "the driving torque varies with the angle and the scene has no load on the cycle: its "
                        "mean of {:.5g} N·m is not balanced",
                        drive)
                  : fmt::format(
                        "the driving torque varies with the angle; of its mean of {:.5g} N·m the load of the "
                        "scene takes {:.5g} N·m{}",
                        drive, load, rest < 0 ? ", more than there is" : "");
    return text + fmt::format("; sized as if a constant {} of {:.5g} N·m, which the scene does not have, balanced them",
                              rest > 0 ? "load" : "drive", std::abs(rest));
  }

  void compare_constant_drive(double drive, double load) {
    if (drive < load * (1 - 1e-9))
      throw WeakDrive(
          fmt::format("the drive is too weak for the cycle: it gives {:.6g} N·m on {} at any speed, the load takes "
                      "{:.6g} N·m on the mean; {:.6g} N·m are missing ({:.3g} % of the load)",
                      drive, s_.link, load, load - drive, 100 * (load - drive) / load));
    if (drive > load * (1 + 1e-9))
      s_.notes.push_back(
          fmt::format("the scene's drive gives {:.6g} N·m at any speed, {:.6g} N·m more than the mean load: the "
                      "machine would run ever faster; sized for the torque that balances the load",
                      drive, drive - load));
  }

  SizeMethod method(const std::string& name, double drive_inertia) {
    const double on_shaft = drive_inertia / square(s_.flywheel_ratio);
    SizeMethod m{name,
                 drive_inertia,
                 on_shaft - others(),
                 flywheel_by_parts(on_shaft, s_.motor_inertia, s_.gearbox_inertia),
                 {}};
    m.delta = delta_of(drive_inertia);
    return m;
  }
  static double square(double x) { return x * x; }
  double others() const { return s_.motor_inertia + s_.gearbox_inertia + s_.other_inertia; }
  std::optional<double> delta_of(double drive_inertia) {
    try {
      return SpeedCycle(s_.diagram, s_.cycle.mechanism, drive_inertia, s_.mid_speed).delta();
    } catch (const std::invalid_argument&) {
      return {};
    }
  }

  void apply_methods() {
    s_.exact = wittenbauer(s_.diagram, s_.cycle.mechanism, s_.mid_speed, s_.delta);
    s_.approximate = mertsalov(s_.diagram, s_.cycle.mechanism, s_.mid_speed, s_.delta);
    s_.methods = {method("Wittenbauer (exact)", s_.exact.inertia), method("Mertsalov", s_.approximate.inertia),
                  method("neglecting I_em", inertia_by_fluctuation(s_.diagram.fluctuation(), s_.mid_speed, s_.delta))};
    s_.delta_now = delta_of(machine_->constant_inertia()).value_or(std::nan(""));
    s_.needed = s_.methods.front().flywheel > 0;
  }

  SteadyRigidCycle steady(double drive_inertia) {
    return steady_rigid_cycle(*machine_, s_.cycle, drive_inertia - machine_->constant_inertia(), s_.operating->speed);
  }

  // δ falls as the inertia grows; a machine that stalls counts as δ = 2.
  void count_motor() {
    if (!s_.operating || !s_.needed) return;
    const double exact = s_.methods.front().drive_inertia;
    s_.with_motor = steady(exact);
    if (!s_.with_motor->found)
      s_.notes.push_back("with its torques as they are the sized machine has no steady cycle: " + s_.with_motor->why);
    else if (s_.with_motor->multiplier > 1)
      s_.notes.push_back(fmt::format(
          "with its torques as they are the sized machine's cycle is unstable: a disturbance of its energy grows to "
          "{:.3g} of itself within a cycle, and the machine leaves it",
          s_.with_motor->multiplier));
    const auto excess = [&](double log_inertia) {
      const SteadyRigidCycle c = steady(std::exp(log_inertia));
      return (c.found ? c.delta() : 2.0) - s_.delta;
    };
    double high = std::log(exact), low = high, at_high = excess(high), at_low = at_high;
    for (int i = 0; i < 20 && at_high > 0; ++i) low = high, at_low = at_high, at_high = excess(high += 0.5);
    for (int i = 0; i < 14 && at_low <= 0; ++i) high = low, at_high = at_low, at_low = excess(low -= 0.5);
    if (at_low <= 0 || at_high > 0) {
      s_.soft_why = at_high > 0
                        ? "no inertia tried gives the demanded δ with the torques as they are over the speed"
                        : "with the torques as they are over the speed δ holds down to a thousandth of the inertia";
      return;
    }
    const double root = find_root(excess, low, at_low, high, at_high, 1e-12 * s_.delta);
    s_.soft = method(slope_of_what(s_).substr(4) + " counted", std::exp(root));
    s_.soft_cycle = steady(std::exp(root));
    s_.soft->delta = s_.soft_cycle->found ? std::optional(s_.soft_cycle->delta()) : std::nullopt;
  }

  // A tool that works in less than half of the cycle.
  void find_punch() {
    double energy = 0, acting = 0;
    for (std::size_t k = 0; k < s_.cycle.share.size(); ++k) {
      if (model().accounts[k].kind != Account::useful) continue;
      const Piecewise& share = s_.cycle.share[k];
      energy -= share.total();
      const double noise = 1e-9 * share.largest();
      double angle = 0;
      for (std::size_t i = 0; i < share.pieces(); ++i) {
        const double lo = share.breaks()[i], hi = share.breaks()[i + 1];
        if (std::abs(share.value_in(i, 0.5 * (lo + hi))) > noise) angle += hi - lo;
      }
      acting = std::max(acting, angle);
    }
    if (!(energy > 0) || acting >= 0.5 * machine_->cycle()) return;
    s_.punch = PunchPress{energy, machine_->cycle() / s_.mid_speed, acting / s_.mid_speed};
    s_.methods.push_back(
        method("punch-press form", inertia_by_fluctuation(s_.punch->from_flywheel(), s_.mid_speed, s_.delta)));
  }

  void find_dimensions() {
    if (!s_.needed) return;
    FlywheelRequest request{options_.form,
                            flywheel_material(options_.material),
                            s_.methods.front().flywheel,
                            s_.mid_speed * (1 + s_.delta / 2) * std::abs(s_.flywheel_ratio),
                            options_.diameter,
                            options_.rim_speed};
    try {
      s_.dimensions = flywheel_dimensions(request);
    } catch (const std::invalid_argument& error) {
      if (options_.diameter > 0) throw;
      s_.dimensions_why = error.what();
    }
  }

  // --- simulation ---

  void simulate_sized() {
    if (!s_.needed) return;
    if (!s_.operating) return simulate_family();
    if (!s_.with_motor || !s_.with_motor->found) return;
    reach(SizedBy::constant_drive, "Wittenbauer", s_.methods.front().flywheel, *s_.with_motor);
    if (s_.soft && s_.soft->flywheel > 0 && s_.soft_cycle && s_.soft_cycle->found)
      reach(SizedBy::slope, s_.soft->name, s_.soft->flywheel, *s_.soft_cycle);
  }

  // Torques of the angle alone, in balance: the cycle is the one that energy gives.
  void simulate_family() {
    if (std::abs(s_.cycle.drive.mean() / s_.diagram.mean_torque() - 1) > 1e-6) {
      s_.notes.push_back("not simulated: the drive of the scene does not balance its load at any speed");
      return;
    }
    const SpeedCycle cycle(s_.diagram, s_.cycle.mechanism, s_.exact.inertia, s_.mid_speed);
    SteadyRigidCycle family;
    family.found = true;
    family.speed = Piecewise::of(
        s_.cycle.drive.breaks(), [&](double phi) { return cycle.speed(phi); }, 1e-11);
    family.fastest = cycle.fastest(), family.slowest = cycle.slowest();
    reach(SizedBy::constant_drive, "Wittenbauer", s_.methods.front().flywheel, family);
  }

  int motor_node() const { return s_.motor.empty() ? model().reduction_node : model().network.ports.at(s_.motor).out; }

  void reach(SizedBy by, const std::string& sized_by, double flywheel, const SteadyRigidCycle& cycle) {
    DeltaReached exact;
    exact.by = by, exact.sized_by = sized_by, exact.flywheel = flywheel;
    exact.crank = exact.motor = cycle.delta();
    exact.mid_speed = cycle.mid_speed();
    for (int k = 0; k <= 720; ++k) {
      exact.phi.push_back(machine_->cycle() * k / 720);
      exact.speed.push_back(cycle.speed.value(exact.phi.back()));
    }
    s_.reached.push_back(std::move(exact));
    const Scene sized = with_flywheel(scene_, s_.flywheel, flywheel, s_.link);
    DeltaReached as_rigid;
    as_rigid.model = SizedModel::rigid, as_rigid.by = by, as_rigid.sized_by = sized_by, as_rigid.flywheel = flywheel;
    run(as_rigid, sized, rigid_effects(), cycle);
    Effects elastic = scene_.effects;
    elastic.locked = true;
    if (elastic.describe() == "none") elastic.all_elastic = true;
    const bool has_joints = std::any_of(model().network.joints.begin(), model().network.joints.end(),
                                        [](const Network::Joint& j) { return j.element != nullptr; });
    if (!has_joints) return;
    DeltaReached as_elastic = as_rigid;
    as_elastic.model = SizedModel::elastic;
    run(as_elastic, sized, elastic, cycle);
  }

  void run(DeltaReached r, const Scene& sized, const Effects& effects, const SteadyRigidCycle& cycle) {
    const std::string name = name_of(r.model);
    options_.simulation.watch.at(name + ", " + r.sized_by, 0);
    SteadySimulation sim;
    try {
      sim = simulate_steady(sized, effects, cycle.speed.value(0), machine_->cycle(), motor_node(), options_.simulation);
    } catch (const SceneError& error) {
      s_.notes.push_back(fmt::format("{}: {}", name, error.what()));
      return;
    }
    if (!sim.complete) {
      s_.complete = false;
      s_.diagnosis = fmt::format("{} ({}): {}", name, r.sized_by, sim.diagnosis);
      return;
    }
    r.crank = sim.link_delta, r.motor = sim.motor_delta;
    r.crank_error = sim.link_error, r.motor_error = sim.motor_error;
    r.mid_speed = sim.mid_speed, r.settled = sim.settled, r.cycles = sim.cycles;
    r.phi = std::move(sim.phi), r.speed = std::move(sim.link), r.motor_speed = std::move(sim.motor);
    if (!r.settled) s_.notes.push_back(unsettled(fmt::format("{} ({})", name, r.sized_by), sim));
    s_.reached.push_back(std::move(r));
  }

  static std::string unsettled(const std::string& name, const SteadySimulation& sim) {
    constexpr double still = 1e-5;
    const std::string text = fmt::format("{}: not settled after {} cycles: ", name, sim.cycles);
    const std::string last = "; the figures are those of the last cycle, not of steady motion";
    if (sim.speed_to_come <= still) return text + "the speed keeps, δ still changes" + last;
    const std::string change = fmt::format("the speed still {} by {:.2g} % a cycle",
                                           sim.speed_change > 0 ? "rises" : "falls", 100 * std::abs(sim.speed_change));
    return text + change +
           (std::isfinite(sim.speed_to_come) ? fmt::format(", some {:.2g} % are still to come", 100 * sim.speed_to_come)
                                             : std::string(" and tends nowhere within that time")) +
           last;
  }

  const SizeOptions& options_;
  Scene scene_;
  std::optional<RigidMachine> machine_;
  Sizing s_;
};

}  // namespace

Scene with_flywheel(Scene scene, const std::string& flywheel, double inertia, const std::string& on) {
  for (Section& section : scene.components) {
    if (section.name != flywheel) continue;
    for (Setting& setting : section.settings)
      if (setting.key == "inertia") setting.number = inertia;
    return scene;
  }
  Section section{.name = flywheel, .kind = &flywheel_kind(), .at = {}};
  Setting setting;
  setting.key = "inertia";
  setting.given = true;
  setting.number = inertia;
  section.settings.push_back(std::move(setting));
  scene.components.push_back(std::move(section));
  scene.lines.push_back({.from = on, .names = {flywheel}, .at = {}, .name_at = {}});
  return scene;
}

std::string slope_of_what(const Sizing& s) {
  const bool drive = s.operating && std::abs(s.operating->drive_slope) >= 0.5 * std::abs(s.operating->slope);
  return !drive ? "the load's slope" : s.motor.empty() ? "the drive's slope" : "the motor's slope";
}

Sizing size_flywheel(const Scene& scene, const SizeOptions& options) {
  const Deadline deadline(scene.run.budget);
  return Sizer(scene, options).run();
}

}  // namespace kurbel
