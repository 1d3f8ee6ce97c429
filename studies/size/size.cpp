// size.cpp — from a scene to the flywheel for a demanded δ, and back to δ of the sized machine.
#include "studies/size/size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/orbit/default_moment.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/size/reach_sized.h"
#include "studies/steady/cycle_search.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

constexpr double looser_sampling = 1e-9;

class Sizer : MachineOnBasis {
 public:
  Sizer(const Scene& scene, const SizeOptions& options) : options_(options) {
    choose_delta();
    s_.flywheel = chosen_flywheel(scene, options.flywheel);
    s_.flywheel_added = s_.flywheel.empty();
    scene_ = as_of(scene, scene.effects, options.at);
    if (s_.flywheel_added) {
      const auto bare = compile(scene, scene.effects);
      s_.flywheel = scene.find("flywheel") ? "sized_flywheel" : "flywheel";
      scene_ = with_flywheel(scene_, s_.flywheel, 0, component_of(*bare, bare->reduction_node));
    }
    s_.basis = choose_basis(scene_, options_.at, options_.basis);
    s_.is_of(scene);
    s_.link = model().node_label(model().reduction_node);
    s_.link_is_crank = find_mechanism(model().network, component_of(model(), model().reduction_node)) != nullptr;
    s_.diagram_length = options.diagram_length;
  }

  Sizing run() {
    list_inertias();
    for (const std::string& note : substitutes(model())) s_.notes.push_back(note);
    if (s_.basis == CycleBasis::classical) {
      find_speed();
      find_cycle();
    } else {
      find_orbit_cycle();
    }
    if (s_.basis == CycleBasis::classical && machine_->uses_time())
      s_.notes.push_back("some torque depends on time; the torques are those at t = 0");
    if (model().scene.run.start.speed == 0)
      s_.notes.push_back("size considers steady motion only; kurbel run shows whether the machine starts from rest");
    apply_methods();
    find_punch();
    if (options_.simulate) reach_sized(s_, scene_, options_, s_.operating ? s_.operating->speed : start_speed_);
    find_dimensions();
    report_omitted(s_, beyond_);
    return std::move(s_);
  }

 private:
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
          "which speed fluctuation is demanded? Give --delta, e.g. --delta 0.05, or --machine press for a customary "
          "value");
    }
    check_delta(s_.delta);
  }

  // Everything that turns at constant ratio, reduced to the flywheel's shaft.
  void list_inertias() {
    const Model& m = model();
    if (at(m.shaft_of_node[at(m.reduction_node)]) >= m.free_shafts)
      throw std::invalid_argument(
          fmt::format("the speed of \"{}\" is prescribed: no flywheel changes its fluctuation; size needs a drive that "
                      "gives a torque",
                      component_of(m, m.reduction_node)));
    const int node = m.network.ports.at(s_.flywheel).in;
    s_.flywheel_ratio = m.node_ratio[at(node)];
    if (s_.flywheel_ratio == 0)
      throw std::invalid_argument(
          fmt::format("\"{}\" stands in the machine's usual motion, so that its inertia evens out nothing; name "
                      "another one: --flywheel NAME",
                      s_.flywheel));
    constant_inertia_ = machine_ ? machine_->constant_inertia() : constant_inertia(m);
    std::vector<std::string> motors;
    for (const Network::ShaftElement& e : m.network.elements)
      if (e.element->account == Account::driving && !(e.element->cycle > 0)) motors.push_back(e.component);
    if (!motors.empty()) s_.motor = motors.front();
    for (std::size_t n = 0; n < m.network.nodes.size(); ++n) {
      const std::string& name = m.network.nodes[n].component;
      const double ratio = m.node_ratio[n] / s_.flywheel_ratio, inertia = m.network.nodes[n].inertia * ratio * ratio;
      if (name == s_.flywheel) {
        s_.flywheel_now += inertia;
        continue;
      }
      const bool motor = std::count(motors.begin(), motors.end(), name) > 0,
                 gears = m.network.kind_of(name).find("gear") != std::string::npos;
      (motor ? s_.motor_inertia : gears ? s_.gearbox_inertia : s_.other_inertia) += inertia;
      add_part(name, inertia);
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
          "with torques that do not depend on speed every speed is a steady one, so it must be given: --mid-speed \"60 "
          "rpm\"");
    }
  }

  void find_cycle() {
    s_.cycle = machine_cycle(*machine_, s_.mid_speed);
    looser_ = machine_cycle(*machine_, s_.mid_speed, looser_sampling);
    const Piecewise &drive = s_.cycle.drive, &load = s_.cycle.load;
    const double scale = std::max(drive.largest(), load.largest());
    s_.engine = drive.maximum().value - drive.minimum().value > 1e-9 * scale;
    if (!s_.engine && !machine_->uses_speed() && drive.mean() > 1e-12 * scale)
      compare_constant_drive(drive.mean(), load.mean());
    const double rest = drive.mean() - load.mean();
    if (s_.engine && !(drive.mean() > 0)) with_constant_load(drive);  // says that the drive does no net work
    if (s_.engine && std::abs(rest) > 1e-6 * drive.mean())
      s_.notes.push_back(unbalanced(drive.mean(), load.largest() > 0 ? load.mean() : 0, rest));
    s_.diagram = balanced(s_.cycle);
  }
  // The drive is constant; if it varies with the angle, a constant load balances it.
  WorkDiagram balanced(const MachineCycle& c) const {
    if (!s_.engine) return with_constant_drive(c.load);
    return work_diagram(c.drive, c.load + c.load.constant(c.drive.mean() - c.load.mean()));
  }

  // Torques along the steady cycle after the scene's own start. A machine that stalls for lack of inertia is examined
  // with more of it.
  void find_orbit_cycle() {
    const OrbitOptions options = orbit_options(scene_.run, options_.simulation.watch.interrupted);
    Orbit orbit = find_orbit(model_, options);
    Deadline::check();
    const std::string as_it_is = orbit.words;
    double tried = s_.flywheel_now;
    for (int k = 0; k < 3 && orbit.kind == Orbit::Kind::at_rest; ++k) {
      tried = std::max(10 * tried, 10 * others());
      orbit = find_orbit(compile_at(with_flywheel(scene_, s_.flywheel, tried, s_.link), scene_.effects, options_.at),
                         options);
      Deadline::check();
    }
    if (!orbit.repeats() && options_.mid_speed && !options_.basis) orbit = hold(*options_.mid_speed, as_it_is, tried);
    if (!orbit.repeats()) return without_a_cycle(as_it_is);
    const OrbitCycle found = orbit_cycle(orbit);
    along_ = orbit.map->shared_model();
    s_.cycle = found.cycle;
    if (!options_.mid_speed) cycle_time_ = found.time;
    if (const auto looser = looser_orbit_cycle(orbit)) looser_ = looser->cycle;
    s_.engine = drive_varies_with_angle();
    s_.diagram = balanced(s_.cycle);
    take_speed(found);
    if (tried == s_.flywheel_now) {
      s_.delta_of_orbit = found.delta();
    } else {
      s_.notes.push_back(fmt::format("as the scene is, {}; the torques are those with {:.4g} kg·m² on \"{}\"", as_it_is,
                                     tried, s_.flywheel));
    }
    start_speed_ = found.sense * found.speed.value(0);
  }
  // A given mid speed, held by a torque added to the drive, with as much inertia as necessary.
  Orbit hold(double mid_speed, const std::string& as_it_is, double& tried) try {
    tried = s_.flywheel_now;
    for (int k = 0; k < 3; ++k, tried = std::max(10 * tried, 10 * others())) {
      HeldOrbit held = held_orbit(with_flywheel(scene_, s_.flywheel, tried, s_.link), scene_.effects, mid_speed,
                                  options_.at, options_.simulation.watch);
      Deadline::check();
      if (!held.orbit.repeats()) continue;
      s_.held = true;
      s_.notes.push_back(fmt::format("{}; the mid speed given is held by {} {} than the drive gives at \"{}\"",
                                     as_it_is, with_unit(std::abs(held.added_torque), "N*m", 4),
                                     held.added_torque < 0 ? "less" : "more", held.added_at));
      return std::move(held.orbit);
    }
    return {};
  } catch (const std::invalid_argument&) {  // time drives it
    return {};
  }
  // At a given mid speed the rigid machine may still give the torques.
  void without_a_cycle(const std::string& why) {
    const std::string text = fmt::format("no steady cycle was found to size a flywheel for: {}", why);
    if (!options_.mid_speed || options_.basis) throw std::invalid_argument(text);
    try {
      make_rigid(scene_, options_.at);
    } catch (const std::invalid_argument&) {
      throw std::invalid_argument(text);
    }
    s_.basis = CycleBasis::classical;
    s_.notes.push_back(text + "; the work equation takes the rigid machine at the mid speed given");
    find_speed();
    find_cycle();
  }
  void take_speed(const OrbitCycle& found) {
    s_.mid_speed = options_.mid_speed.value_or(found.mid_speed());
    s_.mid_speed_source = options_.mid_speed ? "given" : "of the steady cycle that the scene's own start leads to";
    if (options_.mid_speed && std::abs(found.mid_speed() / s_.mid_speed - 1) > 0.01)
      s_.notes.push_back(fmt::format("the mid speed given is {}, but in its steady cycle the machine has {}",
                                     s_.speed_unit.text(s_.mid_speed, 5), s_.speed_unit.text(found.mid_speed(), 5)));
  }
  bool drive_varies_with_angle() const {
    const auto& elements = model().network.elements;
    return std::any_of(elements.begin(), elements.end(), [](const Network::ShaftElement& e) {
      const auto& more = e.element->further_accounts;
      const bool drives =
          e.element->account == Account::driving ||
          std::any_of(more.begin(), more.end(), [](const auto& account) { return account.second == Account::driving; });
      return drives && e.element->is.uses_angle;
    });
  }

  void compare_constant_drive(double drive, double load) {
    if (drive < load * (1 - 1e-9))
      throw WeakDrive(
          fmt::format("the drive is too weak for the cycle: it gives {:.4g} N·m on {} at any speed, the load takes "
                      "{:.4g} N·m on the mean; {:.4g} N·m are missing ({:.3g} % of the load)",
                      drive, s_.link, load, load - drive, 100 * (load - drive) / load));
    if (drive > load * (1 + 1e-9))
      s_.notes.push_back(
          fmt::format("the scene's drive gives {:.4g} N·m at any speed, {:.4g} N·m more than the mean load: the "
                      "machine would run ever faster; sized for the torque that balances the load",
                      drive, drive - load));
  }

  SizeMethod method(const std::string& name, double drive_inertia) {
    const double on_shaft = drive_inertia / square(s_.flywheel_ratio);
    SizeMethod m{name,
                 drive_inertia,
                 {on_shaft - others()},
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
    s_.delta_now = delta_of(constant_inertia_).value_or(std::nan(""));
    s_.needed = s_.methods.front().flywheel.value > 0;
    s_.fluctuation.value = s_.diagram.fluctuation();
    s_.estimate = s_.basis == CycleBasis::classical && !beyond_.empty();
    if (looser_ && !s_.estimate) measure_errors(balanced(*looser_), looser_->mechanism);
  }
  // The same with torques sampled, or found, with looser tolerances.
  void measure_errors(const WorkDiagram& looser, const MechanismInertia& mechanism) {
    const double speed = options_.mid_speed || machine_ ? s_.mid_speed : looser_->speed;
    const double other[] = {wittenbauer(looser, mechanism, speed, s_.delta).inertia,
                            mertsalov(looser, mechanism, speed, s_.delta).inertia,
                            inertia_by_fluctuation(looser.fluctuation(), speed, s_.delta)};
    const auto error = [](double a, double b, double size) { return *estimate_from(a, b, 1e-12 * size).error; };
    const double fluctuation = s_.diagram.fluctuation(), work = s_.diagram.load_work.largest();
    const double by_tables = left_by_tables(scene_) * work;  // [J]
    for (std::size_t k = 0; k < std::size(other); ++k) {
      const double inertia = std::abs(s_.methods[k].drive_inertia);
      s_.methods[k].flywheel.error = (error(s_.methods[k].drive_inertia, other[k], inertia) +
                                      (by_tables > 0 ? by_tables / fluctuation * inertia : 0)) /
                                     square(s_.flywheel_ratio);
    }
    s_.fluctuation.error = error(fluctuation, looser.fluctuation(), work) + by_tables;
  }

  // A tool that works during less than half of the cycle.
  void find_punch() {
    const std::vector<WorkAccount>& accounts = (along_ ? *along_ : model()).accounts;
    double energy = 0, acting = 0;
    for (std::size_t k = 0; k < s_.cycle.share.size(); ++k) {
      if (accounts[k].kind != Account::useful) continue;
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
    if (!(energy > 0) || acting >= 0.5 * s_.cycle.drive.length()) return;
    s_.punch = PunchPress{energy, cycle_time_.value_or(s_.cycle.drive.length() / s_.mid_speed), acting / s_.mid_speed,
                          s_.diagram.work};
    s_.methods.push_back(
        method("punch-press form", inertia_by_fluctuation(s_.punch->from_flywheel(), s_.mid_speed, s_.delta)));
    // The classical estimate uses the stroke's energy without transmission losses.
    const bool lossless = std::abs(s_.diagram.work - energy) <= 1e-9 * energy;
    if (lossless) s_.methods.back().flywheel.error = s_.methods[2].flywheel.error;
  }

  void find_dimensions() {
    const Estimate& flywheel = s_.chosen().flywheel;
    if (!(flywheel.value > 0)) return;
    FlywheelRequest request{options_.form,     flywheel_material(options_.material),
                            flywheel.value,    s_.mid_speed * (1 + s_.delta / 2) * std::abs(s_.flywheel_ratio),
                            options_.diameter, options_.rim_speed};
    try {
      s_.dimensions = flywheel_dimensions(request);
      request.inertia += flywheel.error.value_or(0);
      s_.mass.value = s_.dimensions->mass;
      if (!s_.estimate)
        s_.mass = estimate_from(s_.mass.value, flywheel_dimensions(request).mass, 1e-12 * s_.mass.value);
    } catch (const std::invalid_argument& error) {
      if (options_.diameter > 0) throw;
      s_.dimensions_why = error.what();
    }
  }

  const SizeOptions& options_;
  Scene scene_;
  std::optional<double> cycle_time_;    // of the orbit [s]; else that of the mid speed
  std::shared_ptr<const Model> along_;  // of the cycle along an orbit: a held speed adds an account
  std::optional<MachineCycle> looser_;
  double constant_inertia_ = 0;        // on the link [kg·m²]
  std::optional<double> start_speed_;  // of the link at its angle 0 in steady motion [rad/s]
  Sizing s_;
};

}  // namespace

Sizing size_flywheel(const Scene& scene, const SizeOptions& options) {
  const Deadline deadline(scene.run.budget);
  SizeOptions asked = options;
  const std::string later = choose_default_moment(
      scene, scene.effects, orbit_options(scene.run, options.simulation.watch.interrupted), asked.at);
  Sizing sizing = Sizer(scene, asked).run();
  if (!later.empty()) sizing.notes.push_back(later);
  return sizing;
}

}  // namespace kurbel
