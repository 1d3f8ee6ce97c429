// classical.cpp — finds in a compiled scene what angle and speed of one link do not determine.
#include "studies/cycle/classical.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/return_map/periodicity.h"
#include "engine/scene/units.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {
namespace {

void list_effects(const Effects& effects, std::vector<std::string>& list) {
  for (const EffectFlag& effect : effect_flags())
    if (effects.*(effect.flag) && !effect.of_elasticity && !effect.is_usual() && effect.flag != &Effects::multibody)
      list.emplace_back(effect.words);
}

void list_parts(const Model& m, std::vector<std::string>& list) {
  const auto add = [&](const std::string& component, const std::string& what) {
    const std::string name = fmt::format("\"{}\"", component);
    const bool known = std::any_of(list.begin(), list.end(),
                                   [&](const std::string& other) { return other.find(name) != std::string::npos; });
    if (!known) list.push_back(name + what);
  };
  for (const PlacedInternalState& own : m.internal_states)
    add(own.component, fmt::format(", which has an internal state ({})", own.state.name));
  for (const ElasticJoint& e : m.elastic)
    if (e.slips || e.springless) add(m.network.joints[at(e.joint)].component, ", which may slip");
  for (const ShaftRelation& r : m.relations)
    if (!m.effects.gear_losses || r.loss_account < 0)  // else said already
      add(m.network.relations[at(r.relation)].component, ", which ties shafts only while the machine runs");
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->uses_time || e.window.start > Window{}.start || e.window.stop < Window{}.stop)
      add(e.component, ", whose torque depends on time");
}

}  // namespace

std::shared_ptr<const Model> compile_at(const Scene& scene, const Effects& effects, const Moment& at) {
  return at.time ? compile_network(network_as_of(scene, at), scene, effects) : compile(scene, effects);
}

Effects classical_effects(const Scene& scene) {
  Effects effects = bare_machine(scene.effects);
  effects.locked = true;
  return effects;
}

std::vector<std::string> beyond_the_rigid_machine(const Scene& scene, const Moment& at) {
  std::vector<std::string> list;
  if (!scene.sequence.steps.empty()) list.emplace_back("the operating sequence");
  list_effects(scene.effects, list);
  const auto model = compile_at(scene, without_elasticity(scene.effects), at);
  list_parts(*model, list);
  if (prescribed_node(*model) >= 0) list.emplace_back("a prescribed speed");
  return list;
}

double reduction_angle_at_start(const Model& m) {
  const StartSettings& start = m.scene.run.start;
  return start.on.empty() ? start.angle : start.angle / m.node_ratio[at(m.network.ports.at(start.on).in)];
}

std::optional<AngleRange> rocking_range(const Model& m, const std::optional<AngleRange>& given) {
  std::optional<AngleRange> range;
  for (const Network::ShaftElement& e : m.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    const CrankArc* const arc = element && !element->mechanism().is_force() ? element->mechanism().arc() : nullptr;
    const double ratio = m.node_ratio[at(e.node)];
    if (!arc || ratio == 0) continue;  // 0: it stands in the usual motion
    const double period = turn / std::abs(ratio);
    const double start = reduction_angle_at_start(m), middle = (arc->middle - e.phase) / ratio;
    const double near = start + std::remainder(middle - start, period);
    const auto about = [&](double part) {
      const double half = part * arc->half / std::abs(ratio);
      return AngleRange{near - half, near + half};
    };
    if (const AngleRange whole = about(CrankArc::share);
        given && !(given->from < given->to && whole.holds(given->from) && whole.holds(given->to)))
      throw std::invalid_argument(fmt::format(
          "--range: {:.6g}° to {:.6g}°; must rise, within {:.6g}° to {:.6g}°, where the crank of \"{}\" rocks",
          given->from / degree, given->to / degree, whole.from / degree, whole.to / degree, e.component));
    const AngleRange part = about(share_of_arc);
    range = range ? AngleRange{std::max(range->from, part.from), std::min(range->to, part.to)} : part;
  }
  if (given && !range)
    throw std::invalid_argument("--range: for a crank that rocks; every crank of this machine turns fully");
  if (range && !(range->from < range->to))
    throw std::invalid_argument("the arcs of the machine's rocking cranks have no common range; give --range");
  return given ? given : range;
}

CycleBasis MachineOnBasis::choose_basis(const Scene& scene, const Moment& at, std::optional<CycleBasis> wanted,
                                        bool needs_cycle) {
  beyond_ = beyond_the_rigid_machine(scene, at);
  const CycleBasis basis =
      wanted.value_or(beyond_.empty() || !needs_cycle ? CycleBasis::classical : CycleBasis::steady);
  if (basis == CycleBasis::classical)
    make_rigid(scene, at);
  else
    model_ = compile_at(scene, scene.effects, at);
  return basis;
}

void MachineOnBasis::make_rigid(const Scene& scene, const Moment& at) {
  machine_.emplace(compile_at(scene, classical_effects(scene), at));
}

}  // namespace kurbel
