// stopping.cpp — events of a run, one after the other, until the link stands.
#include "studies/duty/stopping.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

enum class Purpose { neither, drives, stops };

// Kind of a component's commands that drive or stop.
enum class Role { none, motor, clutch, brake };
Role role_of(const Model& m, const std::string& component) {
  for (const Network::Joint& joint : m.network.joints)
    if (joint.component == component && joint.element && joint.element->is.commanded) return Role::clutch;
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.component == component) {
      if (e.element->account == Account::driving) return Role::motor;
      if (e.element->is.directional && e.element->is.commanded) return Role::brake;
    }
  return Role::none;
}

Purpose purpose_of(Role role, double before, double to) {
  switch (role) {
    case Role::none:
      return Purpose::neither;
    case Role::brake:
      return to > 0 ? Purpose::stops : Purpose::drives;
    case Role::clutch:
      return to > 0 ? Purpose::drives : Purpose::stops;
    case Role::motor:
      return to == 0 || before * to < 0 ? Purpose::stops : Purpose::drives;
  }
  return Purpose::neither;
}

}  // namespace

std::optional<Stopping> first_stopping(const Model& model, const EventLog& events, std::optional<double> standstill) {
  const std::string link = model.node_label(model.shafts[at(model.shaft_of_node[at(model.reduction_node)])].reference);
  const Event* signal = nullptr;
  std::map<std::string, double> last;  // value of each command
  std::set<std::string> slipped;  // since the signal: what carried torque before, and locks again, drives nothing anew
  for (const Event& e : events) {
    if (e.kind == EventKind::slip) slipped.insert(e.component);
    const bool drives_anew = e.kind == EventKind::lock && !slipped.count(e.component);
    if (drives_anew || (e.component == link && e.kind == EventKind::motion)) signal = nullptr;
    if (e.kind == EventKind::command) {
      const double to = e.value.value_or(0), before = last.try_emplace(e.component, 1).first->second;
      const Purpose purpose = purpose_of(role_of(model, e.component), before, to);
      if (purpose == Purpose::drives) signal = nullptr;
      if (purpose == Purpose::stops && !signal) signal = &e, slipped.clear();
      last[e.component] = to;
    }
    const bool link_rests = e.component == link || e.t == standstill;  // with a shaft that a closed contact joins to it
    if (link_rests && e.kind == EventKind::rest && signal)
      return Stopping{e.t - signal->t, e.angle - signal->angle, e.t,
                      std::max(std::abs(e.angle), std::abs(signal->angle))};
  }
  return {};
}

}  // namespace kurbel
