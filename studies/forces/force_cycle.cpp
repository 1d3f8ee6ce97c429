// force_cycle.cpp — increase and removal of errors of a cycle's figures; its works and efficiency.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/scene/units.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {

void widen_peak(Peak& peak, const Peak& other, double times) {
  peak.widen(times * std::abs(std::abs(other.value) - std::abs(peak.value)));
}

const Peak& ForceCycle::reaction(std::size_t joint) const {
  for (const NamedPeak& r : reactions)
    if (r.means == "reaction" && joint-- == 0) return r.peak;
  throw std::out_of_range("no such joint");
}

void ForceCycle::widen_to(const ForceCycle& other, double times) {
  using C = ForceCycle;
  using L = LinkOfCycle;
  for (auto figure : {&C::mean_speed, &C::least_speed, &C::greatest_speed, &C::closure, &C::torque_mean,
                      &C::kinetic_change, &C::input, &C::useful, &C::harmful})
    (this->*figure).widen_to(other.*figure, times);
  if (efficiency && other.efficiency) efficiency->widen_to(*other.efficiency, times);
  for (auto peak : {&C::torque, &C::shaking_force, &C::shaking_moment}) widen_peak(this->*peak, other.*peak, times);
  for (std::size_t k = 0; k < reactions.size(); ++k) widen_peak(reactions[k].peak, other.reactions[k].peak, times);
  for (auto orders : {&C::shaking_x, &C::shaking_y, &C::shaking_couple, &C::torque_orders})
    for (std::size_t k = 0; k < (this->*orders).size(); ++k)
      (this->*orders)[k].amplitude.widen_to((other.*orders)[k].amplitude, times);
  for (std::size_t k = 0; k < work.size(); ++k) work[k].work.widen_to(other.work[k].work, times);
  for (std::size_t k = 0; k < links.size(); ++k) {
    for (auto peak : {&L::omega, &L::alpha, &L::inertia_force, &L::inertia_couple})
      widen_peak(links[k].*peak, other.links[k].*peak, times);
    for (auto figure : {&L::reduced_inertia, &L::inertia_share, &L::energy, &L::energy_share})
      (links[k].*figure).widen_to(other.links[k].*figure, times);
  }
}

void ForceCycle::drop_errors(bool of_motion) {
  const auto drop = [](auto&... figures) { (figures.error.reset(), ...); };
  const auto drop_all = [](auto&... lists) {
    for (auto* orders : {&lists...})
      for (ForceHarmonic& h : *orders) h.amplitude.error.reset();
  };
  drop(torque, torque_mean, input, useful, harmful), drop_all(torque_orders);
  if (efficiency) efficiency->error.reset();
  for (CycleWork& w : work) w.work.error.reset();
  for (NamedPeak& r : reactions) r.peak.error.reset();
  if (!of_motion) return;
  drop(mean_speed, least_speed, greatest_speed, closure, kinetic_change, shaking_force, shaking_moment);
  drop_all(shaking_x, shaking_y, shaking_couple);
  for (LinkOfCycle& l : links)
    drop(l.omega, l.alpha, l.inertia_force, l.inertia_couple, l.reduced_inertia, l.inertia_share, l.least_share,
         l.greatest_share, l.energy, l.energy_share);
}

// --- works ---

namespace {

// Of the energy exchanged in a cycle: quadrature and rounding errors of works that cancel.
constexpr double nothing_left = 1e-9;

// Why the works of a cycle do not give an efficiency; empty: they do.
std::string why_no_efficiency(const ForceCycle& c, double spent, double uncertain) {
  constexpr double nothing = 0.5, enough = 0.05;  // of what is spent: an efficiency is not to be less certain
  if (!(uncertain <= nothing * spent))
    return fmt::format("no work goes through the mechanism {} beyond its error: what its parts take they give back",
                       c.in_it());
  if (uncertain > enough * spent)
    return fmt::format("the works {}, {} spent, are only known to within {} together", c.in_it(),
                       with_unit(spent, "J", 4), with_unit(uncertain, "J", 2));
  if (!(c.useful.value > uncertain))
    return c.harmful.value > 0 ? "no useful work is done: what goes in is lost" : "no useful work is done";
  return "";
}

}  // namespace

// Net input over the cycle is input, net output is useful unless its account is harmful. The change of kinetic energy
// is neither: η = A_useful/(A_in − ΔT), which lies within 0 … 1 by the balance.
void judge_works(ForceCycle& c) {
  constexpr double rounding = 1e-12;  // of what goes to and fro
  constexpr double steady = 1e-6;     // of the input: less is no change of the motion's energy
  double largest = c.kinetic_most;
  for (const CycleWork& w : c.work) largest = std::max(largest, w.turnover);
  double uncertain = c.kinetic_change.error.value_or(0), input = 0, useful = 0, harmful = 0;
  c.efficiency.reset();
  for (CycleWork& w : c.work) {
    double& work = w.work.value;
    uncertain += *w.work.error;
    if (std::abs(work) <= rounding * largest) work = 0;  // of weights over a cycle
    if (w.name == "balancing torque") w.kind = work < 0 ? "useful" : "driving";
    if (std::abs(work) <= *w.work.error + nothing_left * largest) continue;
    if (work > 0) input += work;
    if (work < 0) (w.kind == "harmful" ? harmful : useful) -= work;
  }
  uncertain += nothing_left * largest;
  c.input = {input, uncertain}, c.useful = {useful, uncertain}, c.harmful = {harmful, uncertain};
  c.spent = std::abs(c.kinetic_change.value) <= steady * input ? input : input - c.kinetic_change.value;
  c.no_efficiency = why_no_efficiency(c, c.spent, uncertain);
  if (!c.no_efficiency.empty()) return;
  const double ratio = useful / c.spent;
  if (ratio > 1 + uncertain / c.spent + steady)
    c.no_efficiency = fmt::format("the works do not balance: {} come out of {}", with_unit(useful, "J", 4),
                                  with_unit(c.spent, "J", 4));
  else
    c.efficiency = {std::min(1.0, ratio), (1 + ratio) * uncertain / c.spent};
}

}  // namespace kurbel
