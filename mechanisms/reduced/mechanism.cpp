// mechanism.cpp — a mechanism with its tables and its travel, and its properties as an element.
#include "mechanisms/reduced/mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/roots.h"
#include "engine/scene/scene.h"

namespace kurbel {
namespace {

// x′ = 0 between two angles where it changes sign: bisection, which needs no good start.
double reversal_between(const ReducedMechanism& reduced, double from, double to) {
  const bool grows = reduced.output_velocity(from).value > 0;
  const auto before = [&](double phi) { return (reduced.output_velocity(phi).value > 0) == grows; };
  return halved({from, to}, 60, before).middle();
}

// "; change points at 90° and 270°; …" for a mechanism with a special cycle.
std::string words_of(const CrankCycle& cycle) {
  std::string text;
  for (const double phi : cycle.change_points())
    text += fmt::format("{}{:.6g}°", text.empty() ? "; passes change points at " : ", ", phi * 180 / std::numbers::pi);
  if (cycle.turns() > 1) text += "; its links come back after two turns of the crank";
  if (cycle.winding() != 0) text += fmt::format("; turns of its output per turn of the crank: {:g}", cycle.winding());
  return text;
}

}  // namespace

std::string words_of_arc(const Mechanism& mechanism) {
  const CrankArc& arc = *mechanism.arc();
  return fmt::format("crank rocks between φ = {:.4g}° and {:.4g}°, where {}", (arc.middle - arc.half) / degree,
                     (arc.middle + arc.half) / degree,
                     !mechanism.data.locks().empty() ? mechanism.data.locks()
                     : mechanism.rocks()             ? "coupler and rocker lie in one line"
                                                     : "the rod stands square to the slider's line");
}

std::string limit_reached(const Mechanism& mechanism, int end) {
  const CrankArc& arc = *mechanism.arc();
  return fmt::format(
      "\"{}\" comes to the end of its arc at φ = {:.4g}°: its {}; there quantities reduced to the crank have no "
      "bound; let a load, a spring or a brake reverse it before, or let a link that turns fully be the crank",
      mechanism.name, (arc.middle + end * arc.reach()) / degree, words_of_arc(mechanism));
}

void require_on_arc(const Mechanism& mechanism, double phi) {
  const CrankArc* arc = mechanism.arc();
  if (!arc || std::abs(arc->near(phi) - arc->middle) < arc->reach()) return;
  throw std::runtime_error(fmt::format(
      "\"{}\" cannot stand at φ = {:.4g}°: its {}; give another start angle or phase, in the middle {:.4g}°",
      mechanism.name, arc->near(phi) / degree, words_of_arc(mechanism), arc->middle / degree));
}

// I_r has its minimum where the output is at rest or near a sample.
TravelOfTurn travel_of_turn(const ReducedMechanism& reduced) {
  const int n = 1024 * reduced.cycle().turns();
  const auto& arc = reduced.cycle().arc();
  const double from = arc ? arc->middle - arc->reach() : 0;
  const double cycle = arc ? 2 * arc->reach() : reduced.cycle().angle(),
               shift = 0.37;  // no symmetric angle is a sample
  const auto angle = [&](int i) { return from + cycle * (i + shift) / n; };
  TravelOfTurn travel;
  travel.winding = reduced.cycle().winding();
  travel.least_inertia = travel.least = HUGE_VAL;
  travel.greatest = -HUGE_VAL;
  const auto visit = [&](double phi) {
    const double x = reduced.output_position(phi).value, inertia = reduced.inertia(phi).value;
    travel.least = std::min(travel.least, x);
    travel.greatest = std::max(travel.greatest, x);
    travel.least_inertia = std::min(travel.least_inertia, inertia);
    travel.weight = std::max(travel.weight, std::abs(reduced.gravity_torque(phi).value));
  };
  travel.mean_inertia = reduced.mean(ReducedMechanism::inertia_channel);
  if (arc) visit(from), visit(from + cycle);
  for (int i = 0; i < n; ++i) {
    visit(angle(i));
    if (arc && i + 1 == n) break;
    const bool grows = reduced.output_velocity(angle(i)).value > 0;
    if (grows == (reduced.output_velocity(angle(i + 1)).value > 0)) continue;
    const double phi = reversal_between(reduced, angle(i), angle(i + 1));
    visit(phi);
    travel.reversals.push_back(phi < from + cycle ? phi : phi - cycle);
  }
  std::sort(travel.reversals.begin(), travel.reversals.end());
  return travel;
}

Mechanism::Mechanism(std::string component, const MechanismData& what, Extraction from)
    : name(std::move(component)),
      data(what),
      extraction(from),
      reduced(reduce_mechanism(what, table_tolerance, table_max_pieces, from)),
      bodies(what.make_bodies()),
      travel(travel_of_turn(*reduced)) {}

Mechanism Mechanism::extracted_from(Extraction from) const {
  Mechanism other = *this;
  other.extraction = from;
  other.reduced = reduce_mechanism(data, table_tolerance, table_max_pieces, from);
  other.travel = travel_of_turn(*other.reduced);
  for (SliderLoad& load : other.loads)
    std::visit(
        [&](auto& law) {
          if constexpr (requires { law.end; })
            law.end.position = law.end.side > 0 ? other.travel.greatest : other.travel.least;
          if constexpr (requires { law.stroke; }) law.stroke = other.stroke();
        },
        load.law);
  return other;
}

const MechanismElement* mechanism_of(const Network::ShaftElement& element) {
  const auto* const found = dynamic_cast<const MechanismElement*>(element.element.get());
  return found && !found->mechanism().is_force() ? found : nullptr;
}

const Mechanism* find_mechanism(const Network& network, const std::string& component) {
  for (const Network::ShaftElement& e : network.elements)
    if (const MechanismElement* element = mechanism_of(e); element && e.component == component)
      return &element->mechanism();
  return nullptr;
}

Network extracted_from(Network network, Extraction from) {
  for (Network::ShaftElement& e : network.elements)
    if (const auto* const element = dynamic_cast<const MechanismElement*>(e.element.get()))
      e.element = std::make_shared<MechanismElement>(element->mechanism().extracted_from(from));
  return network;
}

bool has_tables(const Network& network) {
  return std::any_of(network.elements.begin(), network.elements.end(), mechanism_of);
}

bool Mechanism::watches_travel() const {
  return !stands_still() &&
         std::any_of(loads.begin(), loads.end(), [](const SliderLoad& l) { return l.depends_on_travel(); });
}

int Mechanism::growth(double angle, int direction) const {
  const auto here = reduced->at(angle);
  double ratio = here.output_position().slope;
  if (std::abs(ratio) < 1e-12 * output_scale()) ratio = here.output_velocity().slope * (direction >= 0 ? 1 : -1);
  return ratio >= 0 ? 1 : -1;
}

double Mechanism::load(double angle, double speed, const std::vector<bool>& acting) const {
  require_on_arc(*this, angle);
  const auto [x, ratio] = reduced->at(angle).output_position();
  const int direction = speed > 0 ? 1 : speed < 0 ? -1 : 0;
  SliderState<double> s{angle, x, ratio * speed, 0, 0};
  s.travel = watches_travel() ? growth(angle, direction) * direction : direction_of(s.v);
  double sum = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!acting.empty() && !acting[k]) continue;
    loads[k].take_first_piece(s, s.mode);
    sum += loads[k].value(s);
  }
  return sum;
}

bool Mechanism::has_weight() const { return !weightless && data.gravity() != 0; }

MechanismElement::MechanismElement(Mechanism mechanism) : mechanism_(std::move(mechanism)) {
  const auto& loads = mechanism_.loads;
  const auto any = [&](auto what) { return std::any_of(loads.begin(), loads.end(), what); };
  is = {.directional = mechanism_.friction || mechanism_.watches_travel(), .uses_angle = true};
  account = Account::weight;
  // Weight and forces over travel depend on the angle alone; so does I_r.
  uses_time = false;
  uses_speed = mechanism_.friction || any([](const SliderLoad& l) { return l.uses_speed(); });
  mean_inertia = mechanism_.travel.mean_inertia;
  least_inertia = mechanism_.travel.least_inertia;
  cycle = mechanism_.cycle();
  double force = 0;
  for (const SliderLoad& load : loads) {
    force = std::max(force, load.greatest_force());
    cycle = std::max(cycle, load.period());
    further_accounts.emplace_back(load.name, load.account);
  }
  if (mechanism_.is_force()) account = loads.front().account, further_accounts.erase(further_accounts.begin());
  if (mechanism_.friction) further_accounts.emplace_back(mechanism_.name + ".joints", Account::harmful);
  angle_period = cycle;
  if (mechanism_.arc()) cycle = HUGE_VAL;  // it never completes a turn
  // Greatest force times half the stroke; of a mechanism without loads its weights, where they are more than rounding.
  rated = {mechanism_.stands_still() ? 0 : force * mechanism_.output_scale(), 0};
  if (const double at = mechanism_.arc() ? mechanism_.arc()->middle : 0.7, weight = mechanism_.travel.weight;
      force == 0 && mechanism_.has_weight() && weight > 1e-9 * closed_sample(mechanism_.data, at).gravity_torque_scale)
    rated.torque = weight;
  if (mechanism_.is_force()) cycle = 0;  // the linkage has it
  modes = 1 + static_cast<int>(loads.size()) +
          (mechanism_.friction ? mechanism_.friction->sign_count() + mechanism_.friction->side_count() : 0);
}

std::string MechanismElement::describe() const {
  const TableReport& report = mechanism_.reduced->report();
  std::string text = fmt::format(
      "table of {}: {} pieces from {} samples of {}, errors", mechanism_.name, report.pieces, report.samples,
      mechanism_.extraction == Extraction::first ? "the closed form" : "the closed form and Simbody");
  for (const TableReport::Channel& channel : report.channels)
    text += fmt::format(" {} {:.0e},", channel.name, channel.error);
  text.back() = report.converged ? ' ' : ';';
  return text + (report.converged ? "(relative)" : " the tolerance was not reached") +
         (mechanism_.friction ? "; " + mechanism_.friction->describe() : "") +
         (mechanism_.arc() ? "; its " + words_of_arc(mechanism_) : words_of(mechanism_.reduced->cycle()));
}

// A crank with constant inertia has no rod and no joints, so that nothing can deform without variable inertia.
ShaftForm MechanismElement::form_under(const Effects& effects) const {
  Mechanism changed = mechanism_;
  changed.friction = effects.joint_friction && mechanism_.joints
                         ? mechanism_.joints->get(mechanism_.extraction == Extraction::second)
                         : nullptr;
  changed.weightless = !effects.gravity;
  changed.mean_inertia = !effects.variable_inertia;
  changed.in_the_loop = effects.multibody;
  bool rounded = false;
  if (!effects.load_edges)
    for (SliderLoad& load : changed.loads)
      if (load.can_be_rounded()) load = load.rounded(), rounded = true;
  if (changed.deforming) changed.deforming = changed.deforming->under(effects);
  if (const auto parts = changed.deforming; parts && !changed.mean_inertia) return parts->form(std::move(changed));
  if (!changed.friction && !changed.weightless && !changed.mean_inertia && !changed.in_the_loop && !rounded)
    return nullptr;
  return std::make_shared<MechanismElement>(std::move(changed));
}

void MechanismElement::place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel&) const {
  pools.of<MechanismPool>().place(mechanism_, ports);
}

}  // namespace kurbel
