// linkage_cycle.cpp — every position of a cycle by the links' equilibrium; peaks, means, orders and works with errors.
#include "studies/forces/linkage_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "engine/model/model.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/units.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {
namespace {

using LinkageQuantity = std::function<double(const PositionForces&)>;

class Builder {
 public:
  Builder(const MechanismStatics& statics, OutputLoads& loads, const MotionAlong& along, ForceCycle& cycle)
      : statics_(statics), loads_(loads), along_(along), cycle_(cycle) {
    for (const WorkAccount& account : loads_.model().accounts)
      cycle_.work.push_back({account.name, name_of(account.kind)});
    cycle_.work.push_back({"balancing torque", "driving"});
    for (const RubbingJoint& joint : statics_.joints().joints)
      cycle_.work.push_back({"friction of " + joint.name, "harmful"});
  }

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
    collect_curve();
    balance();
    judge_works(cycle_);
  }
  std::vector<PositionForces>& samples() { return samples_; }

 private:
  PositionForces at(double phi, CrankMotion motion) { return linkage_position(statics_, loads_, phi, motion); }
  void add(const Abscissa& where, CrankMotion motion);
  void find_speeds();
  void find_scales();
  void find_peaks();
  void find_links();
  void find_orders();
  void balance();
  void collect_curve();

  // Motion of the links only, without reactions, which take most time.
  PositionForces moving_at(double phi, CrankMotion motion) {
    PositionForces p;
    const PlanarLinkage linkage = statics_.linkage(phi);
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
    if (std::abs(found.value) <= rounding_of_forces * scale) found = {{0, rounding_of_forces * scale}, cycle_.begin};
    found.scale = scale;
    return found;
  }
  // From equidistant positions, by trapezia: all of them, and every other one.
  Estimate mean(const LinkageQuantity& value, const LinkageQuantity& weight) const {
    const auto with_step = [&](std::size_t step) {
      double sum = 0, weights = 0;
      const std::size_t last = cycle_.positions.size() - 1;
      for (std::size_t i = 0; i < last + (cycle_.repeats ? 0 : 1); i += step) {
        const PositionForces& p = cycle_.positions[i];
        const double w = (weight ? weight(p) : 1) * (!cycle_.repeats && (i == 0 || i == last) ? 0.5 : 1);
        sum += w * value(p), weights += w;
      }
      return sum / weights;
    };
    const double fine = with_step(1);
    return estimate_from(fine, with_step(2), rounding_of_forces * std::abs(fine));
  }

  const MechanismStatics& statics_;
  OutputLoads& loads_;
  const MotionAlong& along_;
  ForceCycle& cycle_;
  std::vector<PositionForces> samples_;  // every abscissa but rows alone
  std::vector<double> phi_;
  std::vector<MotionSample> motion_;
  double force_ = 0, moment_ = 0;            // the largest: rounding is measured by them
  double inertia_ = 0, inertia_moment_ = 0;  // of the links' inertia, which what shakes the frame is the sum of
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
  const double dt = where.weight / std::abs(motion.omega);
  std::size_t k = 0;
  const auto account = [&](double power) {
    cycle_.work[k].work.value += power * dt;
    cycle_.work[k++].turnover += std::abs(power) * dt;
  };
  for (const double torque : loads_.shares(where.place(), motion)) account(torque * motion.omega);
  account(p.power.crank);
  for (const RubbingJoint& joint : statics_.joints().joints) account(-p.forces.friction_loss(joint.name));
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
      inertia_ = std::max(inertia_, l.inertia_force.magnitude());
      inertia_moment_ =
          std::max({inertia_moment_, std::abs(l.inertia_couple), l.com.magnitude() * l.inertia_force.magnitude()});
    }
    moment_ = std::max(moment_, std::abs(p.forces.torque));
  }
  force_ = std::max(force_, inertia_);
  moment_ = std::max({moment_, inertia_moment_, force_ * arm});
}

void Builder::find_peaks() {
  const LinkageForces& first = samples_.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string joint(j.name), between = fmt::format("{} on {}", j.from, j.on), name = joint + ": " + between;
    const LinkageQuantity force = [k](const PositionForces& p) {
      const JointForces& here = p.forces.joints[k];
      return here.slides ? here.normal : here.force.magnitude();
    };
    cycle_.reactions.push_back({name, "N", "reaction", peak(force, force_), joint, between});
    if (j.slides)
      cycle_.reactions.push_back({name + ", moment", "N*m", "reaction_moment",
                                  peak([k](const PositionForces& p) { return p.forces.joints[k].moment; }, moment_),
                                  joint, between});
  }
  cycle_.torque = peak([](const PositionForces& p) { return p.forces.torque; }, moment_);
  cycle_.at_torque_peak = at(cycle_.torque.phi, motion_between(motion_, cycle_.torque.phi));
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
  const LinkageQuantity torque = [](const PositionForces& p) { return p.forces.torque; };
  cycle_.torque_mean = mean(torque, {});
  cycle_.torque_mean.widen(rounding_of_forces * moment_);
  if (!cycle_.repeats) return;
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
  cycle_.shaking_x = orders_of([](const PositionForces& p) { return p.forces.shaking_force.x; }, inertia_);
  cycle_.shaking_y = orders_of([](const PositionForces& p) { return p.forces.shaking_force.y; }, inertia_);
  cycle_.shaking_couple = orders_of([](const PositionForces& p) { return p.forces.shaking_moment; }, inertia_moment_);
  cycle_.torque_orders = orders_of(torque, moment_);
}

// The works of a cycle equal its change of kinetic energy: the residual is an error of every work.
void Builder::balance() {
  constexpr double nothing = 1e-9;  // of the largest power
  double scale = 0, left = -cycle_.kinetic_change.value;
  for (const PositionForces& p : samples_)
    for (const double power : {p.power.crank, p.power.load, p.power.weight, p.power.kinetic_rate, p.power.friction})
      scale = std::max(scale, std::abs(power));
  for (auto* list : {&samples_, &cycle_.positions, &cycle_.rows, &cycle_.curve})
    for (PositionForces& p : *list) {
      const PowerFlow& w = p.power;
      const double open = w.crank + w.load + w.weight - w.friction - w.kinetic_rate;
      p.power.residual = scale > 0 ? open / scale : 0;
      p.power.nothing = nothing * scale;
      cycle_.power_residual = std::max(cycle_.power_residual, std::abs(p.power.residual));
      cycle_.equation_residual = std::max(cycle_.equation_residual, p.forces.residual);
      cycle_.friction_residual = std::max(cycle_.friction_residual, p.forces.friction_residual);
    }
  for (const PositionForces& p : cycle_.positions) {
    cycle_.kinetic_most = std::max(cycle_.kinetic_most, p.forces.kinetic_energy);
    const auto& joints = p.forces.joints;
    if (std::any_of(joints.begin(), joints.end(), [](const JointForces& j) { return j.both_edges; }))
      ++cycle_.both_edges;
  }
  for (const CycleWork& w : cycle_.work) left += w.work.value;
  cycle_.kinetic_change.error = rounding_of_forces * cycle_.kinetic_most;
  for (CycleWork& w : cycle_.work) w.work.error = std::abs(left) + rounding_of_forces * w.turnover;
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

PositionForces linkage_position(const MechanismStatics& statics, OutputLoads& loads, double phi, CrankMotion motion) {
  const PlanarLinkage linkage = statics.linkage(phi);
  PositionForces p;
  p.loads = motion.loads;
  p.forces = statics.solve(linkage, loads.state(phi, motion, linkage));
  p.power = {.crank = p.forces.torque * motion.omega,
             .load = p.forces.load_power,
             .weight = p.forces.weight_power,
             .kinetic_rate = p.forces.kinetic_rate,
             .friction = p.forces.friction_loss()};
  return p;
}

ForceCycle linkage_cycle(const MechanismStatics& statics, OutputLoads& loads, const MotionAlong& motion,
                         std::vector<PositionForces>* samples) {
  ForceCycle cycle;
  cycle.begin = motion.begin, cycle.cycle = motion.cycle, cycle.repeats = motion.repeats;
  Builder builder(statics, loads, motion, cycle);
  builder.build();
  if (samples) *samples = std::move(builder.samples());
  return cycle;
}

UnboundedReactions unbounded_reactions(const MechanismData& data, OutputLoads& loads, double speed) {
  return unbounded_reactions(data, [&](double phi) {
    return LinkageState{phi, speed, 0, loads.force(phi, {speed, 0, loads.left()})};
  });
}

void mark_unbounded(const UnboundedReactions& unbounded, ForceCycle& cycle) {
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

}  // namespace kurbel
