// linkage_cycle.cpp — every position of a cycle by the links' equilibrium; peaks, means, orders and works with errors.
#include "studies/forces/linkage_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "engine/model/model.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/forces/machine_motion.h"

namespace kurbel {
namespace {

using LinkageQuantity = std::function<double(const PositionForces&)>;

class Builder {
 public:
  Builder(const MechanismData& data, OutputLoads& loads, const MotionAlong& along, LinkageCycle& cycle)
      : data_(data), loads_(loads), along_(along), cycle_(cycle) {}

  void build() {
    for (std::size_t i = 0; i < along_.where.size(); ++i) add(along_.where[i], along_.motion[i]);
    const auto by_angle = [](const PositionForces& a, const PositionForces& b) {
      return a.forces.state.phi < b.forces.state.phi;
    };
    const auto kinetic = [](const PositionForces& p) { return p.forces.kinetic_energy; };
    cycle_.kinetic_change.value = kinetic(cycle_.positions.back()) - kinetic(cycle_.positions.front());
    for (auto* list : {&samples_, &cycle_.positions, &cycle_.rows}) std::sort(list->begin(), list->end(), by_angle);
    for (const PositionForces& p : samples_) {
      phi_.push_back(p.forces.state.phi);
      motion_.push_back({p.forces.state.phi, {p.forces.state.omega, p.forces.state.alpha, p.loads}});
    }
    find_speeds();
    find_scales();
    find_peaks();
    find_links();
    find_orders();
    balance();
    collect_curve();
  }

 private:
  PositionForces at(double phi, CrankMotion motion) { return linkage_position(data_, loads_, phi, motion); }
  void add(const Abscissa& where, CrankMotion motion);
  void find_speeds();
  void find_scales();
  void find_peaks();
  void find_links();
  void find_orders();
  void balance();
  void collect_curve();

  // Of a link's motion: without the reactions, which cost the most.
  PositionForces moving_at(double phi, CrankMotion motion) {
    PositionForces p;
    const PlanarLinkage linkage = linkage_beside(data_, phi);
    p.forces = motion_in(linkage, {phi, motion.omega, motion.alpha});
    return p;
  }
  Peak peak(const LinkageQuantity& value, double scale, bool of_motion = false) {
    std::vector<double> values;
    for (const PositionForces& p : samples_) values.push_back(value(p));
    const auto value_at = [&](double x) {
      const CrankMotion motion = motion_between(motion_, x);
      return value(of_motion ? moving_at(x, motion) : at(x, motion));
    };
    Peak found = measured_peak_of(phi_, values, value_at, scale);
    if (std::abs(found.value) <= rounding_of_forces * scale) found = {{0, rounding_of_forces * scale}};
    found.scale = scale;
    return found;
  }
  // Of positions that are even over the cycle: all of them, and every other one.
  Estimate mean(const LinkageQuantity& value, const LinkageQuantity& weight) const {
    const auto with_step = [&](std::size_t step) {
      double sum = 0, weights = 0;
      for (std::size_t i = 0; i + 1 < cycle_.positions.size(); i += step) {
        const PositionForces& p = cycle_.positions[i];
        const double w = weight ? weight(p) : 1;
        sum += w * value(p), weights += w;
      }
      return sum / weights;
    };
    const double fine = with_step(1);
    return estimate_from(fine, with_step(2), rounding_of_forces * std::abs(fine));
  }

  const MechanismData& data_;
  OutputLoads& loads_;
  const MotionAlong& along_;
  LinkageCycle& cycle_;
  std::vector<PositionForces> samples_;  // every abscissa but rows alone
  std::vector<double> phi_;
  std::vector<MotionSample> motion_;
  std::vector<CycleWork> shares_;
  double force_ = 0, moment_ = 0;  // the largest: rounding is measured by them
};

void Builder::add(const Abscissa& where, CrankMotion motion) {
  Deadline::check();
  PositionForces p = at(where.place(), motion);
  p.forces.state.phi = where.phi;
  if (where.row) cycle_.rows.push_back(p);
  if (where.grid) cycle_.positions.push_back(p);
  if (where.row && !where.grid) return;
  samples_.push_back(p);
  if (where.weight == 0) return;
  if (cycle_.work.empty()) {
    for (const WorkAccount& account : loads_.model().accounts)
      cycle_.work.push_back({account.name, name_of(account.kind)});
    cycle_.work.push_back({"balancing torque", "driving"});
  }
  const double dt = where.weight / std::abs(motion.omega);
  std::size_t k = 0;
  const auto account = [&](double power) {
    cycle_.work[k].work.value += power * dt;
    cycle_.work[k++].turnover += std::abs(power) * dt;
  };
  for (const double torque : loads_.shares(where.place(), motion)) account(torque * motion.omega);
  account(p.power.crank);
}

void Builder::find_speeds() {
  cycle_.mean_speed = {along_.mean_speed(), rounding_of_forces * std::abs(along_.mean_speed())};
  cycle_.closure = {(along_.motion.back().omega - along_.motion.front().omega) / cycle_.mean_speed.value,
                    2 * rounding_of_forces};
  std::tie(cycle_.least_speed, cycle_.greatest_speed) = speed_range(motion_);
}

void Builder::find_scales() {
  double arm = 0;
  for (const PositionForces& p : cycle_.positions) {
    for (const JointForces& j : p.forces.joints) {
      force_ = std::max(force_, j.force.magnitude());
      arm = std::max(arm, j.at.magnitude());
    }
    for (const LinkForces& l : p.forces.links) {
      force_ = std::max(force_, l.inertia_force.magnitude());
      moment_ = std::max(moment_, std::abs(l.inertia_couple));
    }
    moment_ = std::max(moment_, std::abs(p.forces.torque));
  }
  moment_ = std::max(moment_, force_ * arm);
}

void Builder::find_peaks() {
  const LinkageForces& first = samples_.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string name = fmt::format("{}: {} on {}", j.name, j.from, j.on);
    const LinkageQuantity force = [k](const PositionForces& p) {
      const JointForces& here = p.forces.joints[k];
      return here.slides ? here.normal : here.force.magnitude();
    };
    cycle_.reactions.push_back({name, "N", "reaction", peak(force, force_)});
    if (j.slides)
      cycle_.reactions.push_back({name + ", moment", "N*m", "reaction_moment",
                                  peak([k](const PositionForces& p) { return p.forces.joints[k].moment; }, moment_)});
  }
  cycle_.torque = peak([](const PositionForces& p) { return p.forces.torque; }, moment_);
  cycle_.shaking_force = peak([](const PositionForces& p) { return p.forces.shaking_force.magnitude(); }, force_);
  cycle_.shaking_moment = peak([](const PositionForces& p) { return p.forces.shaking_moment; }, moment_);
}

void Builder::find_links() {
  const LinkageQuantity time = [](const PositionForces& p) { return 1 / std::abs(p.forces.state.omega); };
  const Estimate inertia = mean([](const PositionForces& p) { return p.forces.reduced_inertia; }, {});
  const Estimate energy = mean([](const PositionForces& p) { return p.forces.kinetic_energy; }, time);
  const auto share = [](const Estimate& part, const Estimate& whole) {
    return whole.value > 0 ? part / whole : Estimate{0, 0.0};
  };
  for (std::size_t k = 0; k < samples_.front().forces.links.size(); ++k) {
    using P = const PositionForces&;
    const auto link = [k](P p) -> const LinkForces& { return p.forces.links[k]; };
    const auto largest = [&](auto&& of) {
      double most = 0;
      for (P p : cycle_.positions) most = std::max(most, std::abs(of(link(p))));
      return most;
    };
    const auto peak_of_link = [&](auto&& of, double scale) {
      return peak([&](P p) { return of(link(p)); }, scale, true);
    };
    LinkOfCycle out;
    out.name = link(samples_.front()).name;
    const auto omega = [](const LinkForces& l) { return l.omega; };
    const auto alpha = [](const LinkForces& l) { return l.alpha; };
    const double speed = std::max(std::abs(cycle_.least_speed.value), std::abs(cycle_.greatest_speed.value));
    out.omega = peak_of_link(omega, std::max(speed, largest(omega)));
    out.alpha = peak_of_link(alpha, std::max(speed * speed, largest(alpha)));
    out.inertia_force = peak_of_link([](const LinkForces& l) { return l.inertia_force.magnitude(); }, force_);
    out.inertia_couple = peak_of_link([](const LinkForces& l) { return l.inertia_couple; }, moment_);
    out.reduced_inertia = mean([&](P p) { return link(p).reduced_inertia; }, {});
    out.inertia_share = share(out.reduced_inertia, inertia);
    out.energy = mean([&](P p) { return link(p).kinetic_energy; }, time);
    out.energy_share = share(out.energy, energy);
    const auto shares = [&](std::size_t step) {
      std::pair<double, double> range{1, 0};
      for (std::size_t i = 0; i < cycle_.positions.size(); i += step) {
        P p = cycle_.positions[i];
        const double here = p.forces.reduced_inertia > 0 ? link(p).reduced_inertia / p.forces.reduced_inertia : 0;
        range = {std::min(range.first, here), std::max(range.second, here)};
      }
      return range;
    };
    const auto [least, greatest] = shares(1);
    const auto [least_of_half, greatest_of_half] = shares(2);
    out.least_share = estimate_from(least, least_of_half, rounding_of_forces);
    out.greatest_share = estimate_from(greatest, greatest_of_half, rounding_of_forces);
    cycle_.links.push_back(std::move(out));
  }
}

void Builder::find_orders() {
  const int turns = static_cast<int>(std::lround(along_.cycle / turn));
  const auto orders_of = [&](const LinkageQuantity& value, double scale) {
    return measured_harmonics(
        [&] {
          std::vector<double> values;
          for (const PositionForces& p : cycle_.positions) values.push_back(value(p));
          return values;
        }(),
        turns, scale);
  };
  cycle_.shaking_x = orders_of([](const PositionForces& p) { return p.forces.shaking_force.x; }, force_);
  cycle_.shaking_y = orders_of([](const PositionForces& p) { return p.forces.shaking_force.y; }, force_);
  cycle_.shaking_couple = orders_of([](const PositionForces& p) { return p.forces.shaking_moment; }, moment_);
  const LinkageQuantity torque = [](const PositionForces& p) { return p.forces.torque; };
  cycle_.torque_orders = orders_of(torque, moment_);
  cycle_.torque_mean = mean(torque, {});
  cycle_.torque_mean.widen(rounding_of_forces * moment_);
}

// The works of a cycle make its change of kinetic energy: what is left over is every work's error.
void Builder::balance() {
  double scale = 0, left = -cycle_.kinetic_change.value;
  for (const PositionForces& p : samples_)
    for (const double power : {p.power.crank, p.power.load, p.power.weight, p.power.kinetic_rate})
      scale = std::max(scale, std::abs(power));
  for (auto* list : {&samples_, &cycle_.positions, &cycle_.rows})
    for (PositionForces& p : *list) {
      const double open = p.power.crank + p.power.load + p.power.weight - p.power.kinetic_rate;
      p.power.residual = scale > 0 ? open / scale : 0;
      cycle_.power_residual = std::max(cycle_.power_residual, std::abs(p.power.residual));
      cycle_.equation_residual = std::max(cycle_.equation_residual, p.forces.residual);
    }
  for (const CycleWork& w : cycle_.work) left += w.work.value;
  cycle_.kinetic_change.error =
      std::abs(left) + rounding_of_forces * std::abs(cycle_.positions.front().forces.kinetic_energy);
  for (CycleWork& w : cycle_.work) {
    w.work.error = std::abs(left) + rounding_of_forces * w.turnover;
    if (std::abs(w.work.value) <= rounding_of_forces * w.turnover) w.work.value = 0;
    if (w.name == "balancing torque" && w.work.value < 0) w.kind = "useful";
  }
}

void Builder::collect_curve() {
  cycle_.curve = cycle_.positions;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (phi_[i] - phi_[i - 1] > 2.5 * beside) continue;
    cycle_.curve.push_back(samples_[i - 1]);
    cycle_.curve.push_back(samples_[i]);
  }
  const auto add_peak = [&](const Peak& p) { cycle_.curve.push_back(at(p.phi, motion_between(motion_, p.phi))); };
  for (const NamedPeak& reaction : cycle_.reactions) add_peak(reaction.peak);
  for (const Peak* p : {&cycle_.torque, &cycle_.shaking_force, &cycle_.shaking_moment}) add_peak(*p);
  std::stable_sort(cycle_.curve.begin(), cycle_.curve.end(), [](const PositionForces& a, const PositionForces& b) {
    return a.forces.state.phi < b.forces.state.phi;
  });
}

}  // namespace

PositionForces linkage_position(const MechanismData& data, OutputLoads& loads, double phi, CrankMotion motion) {
  const PlanarLinkage linkage = linkage_beside(data, phi);
  PositionForces p;
  p.loads = motion.loads;
  p.forces = forces_in(linkage, loads.state(phi, motion, linkage));
  p.power = {.crank = p.forces.torque * motion.omega,
             .load = p.forces.load_power,
             .weight = p.forces.weight_power,
             .kinetic_rate = p.forces.kinetic_rate};
  return p;
}

LinkageCycle linkage_cycle(const MechanismData& data, OutputLoads& loads, const MotionAlong& motion) {
  LinkageCycle cycle;
  cycle.cycle = motion.cycle;
  Builder(data, loads, motion, cycle).build();
  return cycle;
}

UnboundedReactions unbounded_reactions(const MechanismData& data, OutputLoads& loads, double speed) {
  return unbounded_reactions(data, [&](double phi) {
    return LinkageState{phi, speed, 0, loads.force(phi, {speed, 0, loads.left()})};
  });
}

void mark_unbounded(const UnboundedReactions& unbounded, LinkageCycle& cycle) {
  const auto& joints = cycle.positions.front().forces.joints;
  for (NamedPeak& reaction : cycle.reactions)
    for (std::size_t k = 0; k < unbounded.of_joint.size(); ++k)
      if (unbounded.of_joint[k] && reaction.name.starts_with(joints[k].name)) reaction.peak.unbounded = true;
}

std::string begin_unbounded(const std::string& mechanism, const UnboundedReactions& unbounded) {
  if (!unbounded.any()) return {};
  std::vector<std::string> angles;
  for (const double phi : unbounded.at) angles.push_back(fmt::format("{:.4g}°", phi * 180 / std::numbers::pi));
  return fmt::format("{}: reactions in its joints have no bound at φ = {} ({} at {:g} rad beside)", mechanism,
                     fmt::join(angles, ", "), with_unit(unbounded.greatest, "N", 4), unbounded.beside);
}

void LinkageCycle::widen_to(const LinkageCycle& other, double times) {
  using L = LinkOfCycle;
  CycleOfForces::widen_to(other, times);
  for (std::size_t k = 0; k < reactions.size(); ++k) widen_peak(reactions[k].peak, other.reactions[k].peak, times);
  for (std::size_t k = 0; k < links.size(); ++k) {
    for (auto peak : {&L::omega, &L::alpha, &L::inertia_force, &L::inertia_couple})
      widen_peak(links[k].*peak, other.links[k].*peak, times);
    for (auto figure : {&L::reduced_inertia, &L::inertia_share, &L::energy, &L::energy_share})
      (links[k].*figure).widen_to(other.links[k].*figure, times);
  }
}

void LinkageCycle::drop_errors(bool of_motion) {
  CycleOfForces::drop_errors(of_motion);
  for (NamedPeak& reaction : reactions) reaction.peak.error.reset();
  for (LinkOfCycle& l : links) {
    if (!of_motion) return;
    for (Peak* peak : {&l.omega, &l.alpha, &l.inertia_force, &l.inertia_couple}) peak->error.reset();
    for (Estimate* mean :
         {&l.reduced_inertia, &l.inertia_share, &l.least_share, &l.greatest_share, &l.energy, &l.energy_share})
      mean->error.reset();
  }
}

namespace {

// The machine's own torque on the crank, held against that of the links' equilibrium: where they differ (inertia that is
// taken at its mean), the difference is an error, and is told.
void hold_against_machine(const Scene& scene, const MechanismData& data, OutputLoads& loads,
                          const SimulatedMotion& simulated, LinkageCycle& cycle, std::vector<std::string>& notes) {
  const double same_physics = 1e-7 + left_by_tables(scene);  // tables of the mechanism, and of its loads
  constexpr double least = 1e-3;  // of what the joints' forces make at their places: less is no torque to measure by
  double missed = 0, greatest = 0;
  for (std::size_t i = 0; i < simulated.machine.size(); ++i) {
    const CrankMotion& m = simulated.along.motion[i];
    const double phi = simulated.along.where[i].place(), own = simulated.machine[i].torque;
    double beside = phi;
    const PlanarLinkage linkage = linkage_beside(data, beside);
    if (beside != phi) continue;  // what the links need there is that of a place beside it
    const LinkageForces f = forces_in(linkage, loads.state(phi, m, linkage));
    missed = std::max(missed, std::abs(own - f.torque));
    greatest = std::max(greatest, std::abs(own));
    for (const JointForces& j : f.joints) greatest = std::max(greatest, least * j.force.magnitude() * j.at.magnitude());
  }
  cycle.machine_residual = greatest > 0 ? missed / greatest : 0;
  if (missed <= same_physics * greatest) return;
  cycle.torque_mean.widen(missed);
  cycle.torque.widen(missed);
  for (ForceHarmonic& h : cycle.torque_orders) h.amplitude.widen(2 * missed);
  notes.push_back(fmt::format(
      "the mechanism counts as its links are; the machine's own equations have a crank torque that differs by up to {} "
      "in the same motion, which is counted as an error of the torque",
      with_unit(missed, "N*m", 4)));
}

}  // namespace

LinkageStudy find_linkage_forces(const Scene& scene, const ForcesOptions& options) {
  check(options);
  const Deadline deadline(scene.run.budget);
  const AskedMechanism asked(scene, options.mechanism);
  LinkageStudy out;
  describe(asked, out);
  out.kind = asked.kind;
  Effects effects = options.effects.value_or(scene.effects);
  if (effects.joint_friction && asked.mechanism().joints) {
    effects.joint_friction = false;
    out.notes.push_back(fmt::format(
        "{}: forces takes its joints as ideal: motion and reactions do not include their friction; run and steady do",
        asked.name));
  }
  const MachineMotion machine(asked, effects, options);
  const MechanismData& data = asked.mechanism().data;
  if (const std::string why = data.undetermined(); !why.empty())
    throw std::invalid_argument(fmt::format("{}: {}; ask run, steady or reduce", asked.name, why));
  out.rocks = data.rocks();
  for (const std::string& line : data.about()) out.notes.push_back(asked.name + ": " + line);
  OutputLoads loads(asked, effects);
  const CrankSpeed speed = prescribed_speed(machine, options);
  options.watch.say(
      fmt::format("first problem: {} at {} ({})", asked.name, out.speed_unit.text(speed.value), speed.source));
  out.prescribed = linkage_cycle(data, loads, steady_motion(loads, speed.value, options.positions));
  tell_outside_data(out, loads.outside_data(speed.value), *out.prescribed, false);
  out.unbounded = unbounded_reactions(data, loads, speed.value);
  describe_first(speed, loads, machine, out, *out.prescribed);
  mark_unbounded(out.unbounded, *out.prescribed);
  if (options.also)
    for (const double phi : options.also(prescribed_cycle(loads, speed.value)))
      out.also.push_back(linkage_position(data, loads, phi, {speed.value, 0, loads.left()}));
  if (!options.simulate) return out;
  options.watch.say("second problem: the motion that the machine keeps");
  const auto motion = machine.solve(loads, {out.notes, out.complete, out.diagnosis});
  if (!motion) return out;
  out.simulated = linkage_cycle(data, loads, motion->along);
  for (const SimulatedMotion::Other& other : motion->others)
    out.simulated->widen_to(linkage_cycle(data, loads, other.motion), other.times);
  hold_against_machine(scene, data, loads, *motion, *out.simulated, out.notes);
  tell_outside_data(out, motion->outside_data, *out.simulated, true);
  out.simulated->label = "simulated";
  out.simulated->description = motion->description;
  mark_unbounded(out.unbounded, *out.simulated);
  out.elastic = machine.is_elastic();
  if (!out.elastic || !options.rigid_behind) return out;
  if (const auto rigid = rigid_motion(asked, effects, loads, options)) out.rigid = linkage_cycle(data, loads, *rigid);
  return out;
}

}  // namespace kurbel
