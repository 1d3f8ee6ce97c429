// slider_crank.cpp — gathers the crank's motion, applies the reduced functions, scatters torque and inertia.
#include "mechanisms/slider_crank.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kurbel {
namespace {

template <class L>
constexpr bool has_pieces = requires(const L& l, SliderState<double> s) {
  l.first_mode(s);
};

double angle_of(const ShaftPorts& at, const Instant& now) { return now.angle[at.angle] + at.phase; }

}  // namespace

bool SliderCrankMaker::directional() const {
  return std::any_of(crank_.loads.begin(), crank_.loads.end(),
                     [](const SliderLoad& l) { return l.depends_on_travel(); });
}

// Weight and forces over travel depend on the angle alone; so does I_r.
bool SliderCrankMaker::uses_speed() const {
  return std::any_of(crank_.loads.begin(), crank_.loads.end(), [](const SliderLoad& l) { return l.uses_speed(); });
}

// Loads give a scale of torque: greatest force times crank radius.
Rated SliderCrankMaker::rated() const {
  double force = 0;
  for (const SliderLoad& load : crank_.loads) force = std::max(force, load.greatest_force());
  return {force * crank_.data.radius, 0};
}

double SliderCrankMaker::cycle() const {
  double cycle = 2 * std::numbers::pi;
  for (const SliderLoad& load : crank_.loads) cycle = std::max(cycle, load.period());
  return cycle;
}

std::string SliderCrankMaker::describe() const {
  const TableReport& report = crank_.reduced->report();
  std::string text = fmt::format("table of {}: {} pieces from {} samples of Simbody, errors", crank_.name,
                                 report.pieces, report.samples);
  for (const TableReport::Channel& channel : report.channels)
    text += fmt::format(" {} {:.0e},", channel.name, channel.error);
  text.back() = report.converged ? ' ' : ';';
  return text + (report.converged ? "(relative)" : " the tolerance was not reached");
}

std::vector<std::pair<std::string, Account>> SliderCrankMaker::further_accounts() const {
  std::vector<std::pair<std::string, Account>> accounts;
  for (const SliderLoad& load : crank_.loads) accounts.emplace_back(load.name, load.account);
  return accounts;
}

void SliderCrankMaker::place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel&) const {
  pools.of<SliderCrankPool>().place(crank_, ports);
}

void SliderCrankPool::place(SliderCrank crank, ShaftPorts at) {
  Placed placed{std::move(crank), std::move(at)};
  for (const SliderLoad& load : placed.crank.loads)
    placed.watches_travel = placed.watches_travel || load.depends_on_travel();
  const std::size_t index = placed_.size();
  if (placed.watches_travel) owners_.push_back({index, -1, 0});
  for (std::size_t k = 0; k < placed.crank.loads.size(); ++k)
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>) {
            owners_.push_back({index, static_cast<int>(k), 0});
            owners_.push_back({index, static_cast<int>(k), 1});
          }
        },
        placed.crank.loads[k].law);
  guards_ = static_cast<int>(owners_.size());
  placed_.push_back(std::move(placed));
}

SliderState<double> SliderCrankPool::slider(const Placed& p, const Instant& now, std::size_t load) const {
  const double phi = angle_of(p.at, now), omega = p.at.gain * now.speed[p.at.shaft];
  const auto here = p.crank.reduced->at(phi);
  const auto [x, ratio] = here.slider_position();
  const int travel = p.watches_travel ? now.mode[p.at.mode] * now.direction[p.at.shaft] : (ratio * omega >= 0 ? 1 : -1);
  return {phi, x, ratio * omega, travel, now.mode[p.at.mode + 1 + static_cast<int>(load)]};
}

double SliderCrankPool::load_force(const Placed& p, const Instant& now) const {
  double sum = 0;
  for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
    const SliderState<double> s = slider(p, now, k);
    sum += std::visit([&](const auto& law) { return law.value(s); }, p.crank.loads[k].law);
  }
  return sum;
}

void SliderCrankPool::add(const Instant& now, Sums& sums) const {
  for (const Placed& p : placed_) {
    const double omega = p.at.gain * now.speed[p.at.shaft];
    const double phi = angle_of(p.at, now);
    const auto here = p.crank.reduced->at(phi);
    const auto [inertia, slope] = here.inertia();
    double torque = -0.5 * slope * omega * omega;
    if (p.crank.has_weight()) {
      const double weight = here.gravity_torque().value;
      torque += weight;
      if (sums.work_rate) sums.work_rate[p.at.account] += weight * omega;
    }
    if (!p.crank.loads.empty()) {
      const auto [x, ratio] = here.slider_position();
      SliderState<double> s{phi, x, ratio * omega, 0, 0};
      s.travel = p.watches_travel ? now.mode[p.at.mode] * now.direction[p.at.shaft] : (s.v >= 0 ? 1 : -1);
      for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
        s.mode = now.mode[p.at.mode + 1 + static_cast<int>(k)];
        const double force = std::visit([&](const auto& law) { return law.value(s); }, p.crank.loads[k].law);
        torque += force * ratio;
        if (sums.work_rate) sums.work_rate[p.at.account + 1 + static_cast<int>(k)] += force * s.v;
      }
    }
    sums.element_torque[p.at.id] = torque;
    sums.element_inertia[p.at.id] = inertia;
    sums.torque[p.at.shaft] += p.at.gain * torque;
    sums.inertia[p.at.shaft] += p.at.gain * p.at.gain * inertia;
  }
}

void SliderCrankPool::register_jacobian(JacobianPattern& pattern) {
  for (Placed& p : placed_) {
    const int speed = pattern.speed(p.at.shaft);
    p.slot_angle = pattern.entry(speed, pattern.angle(p.at.angle));
    p.slot_rate = pattern.entry(speed, speed);
  }
}

void SliderCrankPool::add_jacobian(const Instant& now, const double* alpha, double* slots) const {
  using D = Dual<2>;  // by crank angle and crank speed
  for (const Placed& p : placed_) {
    const double omega = p.at.gain * now.speed[p.at.shaft], phi = angle_of(p.at, now);
    const auto here = p.crank.reduced->at(phi);
    const auto [slope, curvature] = here.inertia_derivative();
    const D angle = D::input(phi, 0), speed = D::input(omega, 1);
    D torque = -0.5 * angle.chain(slope, curvature) * speed * speed;
    if (p.crank.has_weight()) {
      const auto weight = here.gravity_torque();
      torque = torque + angle.chain(weight.value, weight.slope);
    }
    const auto [x, ratio] = here.slider_position();
    const D x_ratio = angle.chain(ratio, here.slider_velocity().slope);
    const D v = x_ratio * speed;
    for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
      const SliderState<double> s = slider(p, now, k);
      const SliderState<D> dual{angle, angle.chain(x, ratio), v, s.travel, s.mode};
      torque = torque + std::visit([&](const auto& law) { return D(law.value(dual)); }, p.crank.loads[k].law) * x_ratio;
    }
    slots[p.slot_angle] += p.at.gain * (torque.d[0] - slope * p.at.gain * alpha[p.at.shaft]);
    slots[p.slot_rate] += p.at.gain * torque.d[1] * p.at.gain;
  }
}

void SliderCrankPool::guards(const Instant& now, double* g) const {
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    const GuardOwner& owner = owners_[i];
    const Placed& p = placed_[owner.placed];
    if (owner.load < 0) {
      const double ratio = p.crank.reduced->at(angle_of(p.at, now)).slider_position().slope;
      g[i] = now.mode[p.at.mode] * ratio / p.crank.data.radius;
      continue;
    }
    const auto load = static_cast<std::size_t>(owner.load);
    const SliderState<double> s = slider(p, now, load);
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>) law.guard(s, g + i);
        },
        p.crank.loads[load].law);
    ++i;  // both ends of the piece were written
  }
}

void SliderCrankPool::fire(const Instant& now, int guard, int* mode) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.load >= 0) {
    const auto load = static_cast<std::size_t>(owner.load);
    const SliderState<double> s = slider(p, now, load);
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>)
            mode[p.at.mode + 1 + owner.load] = law.next_mode(s, owner.which);
        },
        p.crank.loads[load].law);
    return;
  }
  // Dead centre: the slider turns round, and each load takes up the branch of the other stroke.
  mode[p.at.mode] = -mode[p.at.mode];
  for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
    if (!p.crank.loads[k].depends_on_travel()) continue;
    SliderState<double> s = slider(p, now, k);
    s.travel = mode[p.at.mode] * now.direction[p.at.shaft];
    std::visit(
        [&](const auto& law) {
          if constexpr (has_pieces<std::decay_t<decltype(law)>>)
            mode[p.at.mode + 1 + static_cast<int>(k)] = law.first_mode(s);
        },
        p.crank.loads[k].law);
  }
}

GuardLabel SliderCrankPool::label(int guard, const int* mode) const {
  const GuardOwner& owner = owners_[static_cast<std::size_t>(guard)];
  const Placed& p = placed_[owner.placed];
  if (owner.load < 0) return {p.crank.name, mode[p.at.mode] > 0 ? "folded dead centre" : "extended dead centre"};
  const SliderLoad& load = p.crank.loads[static_cast<std::size_t>(owner.load)];
  SliderState<double> s{};
  s.mode = mode[p.at.mode + 1 + owner.load];
  std::string what;
  std::visit(
      [&](const auto& law) {
        if constexpr (has_pieces<std::decay_t<decltype(law)>>) what = law.mode_name(s);
      },
      load.law);
  return {load.name, what};
}

void SliderCrankPool::first_modes(const Instant& now, int* mode) const {
  for (const Placed& p : placed_) {
    const auto here = p.crank.reduced->at(angle_of(p.at, now));
    double ratio = here.slider_position().slope;
    // On a dead centre the sign is that of the motion to come.
    if (std::abs(ratio) < 1e-12 * p.crank.data.radius)
      ratio = here.slider_velocity().slope * (now.direction[p.at.shaft] >= 0 ? 1 : -1);
    mode[p.at.mode] = ratio >= 0 ? 1 : -1;
    for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
      const SliderState<double> s = slider(p, now, k);
      std::visit(
          [&](const auto& law) {
            if constexpr (has_pieces<std::decay_t<decltype(law)>>)
              mode[p.at.mode + 1 + static_cast<int>(k)] = law.first_mode(s);
          },
          p.crank.loads[k].law);
    }
  }
}

void SliderCrankPool::add_holds(const Instant& now, Hold* shaft, Hold* element) const {
  for (const Placed& p : placed_) {
    const double ratio = p.crank.reduced->at(angle_of(p.at, now)).slider_position().slope;
    for (std::size_t k = 0; k < p.crank.loads.size(); ++k) {
      const SliderState<double> s = slider(p, now, k);
      std::visit(
          [&](const auto& law) {
            if constexpr (Directional<std::decay_t<decltype(law)>>) {
              const Hold force = law.hold(s);
              const Hold torque = ratio >= 0 ? Hold{force.low * ratio, force.high * ratio}
                                             : Hold{force.high * ratio, force.low * ratio};
              element[p.at.id].low += torque.low;
              element[p.at.id].high += torque.high;
              shaft[p.at.shaft].low += p.at.gain * torque.low;
              shaft[p.at.shaft].high += p.at.gain * torque.high;
            }
          },
          p.crank.loads[k].law);
    }
  }
}

double SliderCrankPool::kinetic_energy_of_bodies(const Instant& now) const {
  double sum = 0;
  for (const Placed& p : placed_)
    sum += p.crank.bodies->kinetic_energy(angle_of(p.at, now), p.at.gain * now.speed[p.at.shaft]);
  return sum;
}

void SliderCrankPool::add_channels(std::vector<Channel>& channels) const {
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const auto here = [this, i](const Snapshot& s) {
      return placed_[i].crank.reduced->at(angle_of(placed_[i].at, s.now));
    };
    const auto omega = [this, i](const Snapshot& s) { return placed_[i].at.gain * s.now.speed[placed_[i].at.shaft]; };
    const auto alpha = [this, i](const Snapshot& s) { return placed_[i].at.gain * s.alpha[placed_[i].at.shaft]; };
    const std::string& name = placed_[i].crank.name;
    channels.push_back(
        {"position." + name, "m", [here](const Snapshot& s) { return here(s).slider_position().value; }});
    channels.push_back(
        {"velocity." + name, "m/s", [=](const Snapshot& s) { return here(s).slider_position().slope * omega(s); }});
    channels.push_back({"acceleration." + name, "m/s2", [=](const Snapshot& s) {
                          const auto [ratio, second] = here(s).slider_velocity();
                          return second * omega(s) * omega(s) + ratio * alpha(s);
                        }});
    if (!placed_[i].crank.loads.empty())
      channels.push_back(
          {"force." + name, "N", [this, i](const Snapshot& s) { return load_force(placed_[i], s.now); }});
  }
}

}  // namespace kurbel
