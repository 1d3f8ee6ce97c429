// mechanism_keys.cpp — keys of links, and the element of a mechanism from its data.
#include "mechanisms/kinds/mechanism_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

Fields<LinkBody> link(const std::string& name, const Key& com, const char* inertia_doc) {
  return Fields<LinkBody>()
      .add(mass_key(name + "_mass", "mass of the " + name), &LinkBody::mass)
      .add(com, &LinkBody::com)
      .add(defaulted(name + "_inertia", "kg*m2", "0 kg*m2", not_negative, inertia_doc), &LinkBody::inertia);
}

// "crank 2 kg, rod 1 kg"
std::string masses_of(const Section& s) {
  std::string text;
  for (const Key& key : s.kind->keys)
    if (key.name.ends_with("_mass"))
      text += fmt::format("{}{} {:g} kg", text.empty() ? "" : ", ", key.name.substr(0, key.name.size() - 5),
                          s.number(key.name));
  return text;
}

// Whether two lengths, masses or inertias that are given differ by more than units of the same sort usually do.
bool far_apart(const Section& s) {
  constexpr double usual = 1e6;
  for (const char* unit : {"m", "kg", "kg*m2"}) {
    double least = HUGE_VAL, most = 0;
    for (const Key& key : s.kind->keys)
      if (const double size = key.unit == unit && s.has(key.name) ? std::abs(s.number(key.name)) : 0; size > 0)
        least = std::min(least, size), most = std::max(most, size);
    if (most > usual * least) return true;
  }
  return false;
}

// Positions are sums of lengths, so that each loses what the longest is rounded by.
constexpr double longest = 1e9;  // of the crank

// The crank is the first length of every kind that has any. False, with messages, where another one lies too far from it.
bool lengths_fit(const Section& s, Messages& messages) {
  const auto is_length = [](const Key& key) { return key.unit == "m"; };
  const auto first = std::find_if(s.kind->keys.begin(), s.kind->keys.end(), is_length);
  if (first == s.kind->keys.end()) return true;
  const Key& crank = *first;
  bool fit = true;
  for (const Key& key : s.kind->keys) {
    if (!is_length(key) || !s.has(key.name) || std::abs(s.number(key.name)) <= longest * s.number(crank.name)) continue;
    fit = false;
    messages.add(
        s.where(key.name),
        fmt::format("{} \"{}\": {} = {:.3g} m is {:.1e} times {} = {:.3g} m; must be at most {:.0e} times, else "
                    "positions are lost to round-off; check both units",
                    s.kind->name, s.name, key.name, s.number(key.name),
                    std::abs(s.number(key.name)) / s.number(crank.name), crank.name, s.number(crank.name), longest));
  }
  return fit;
}

}  // namespace

Key mass_key(const std::string& name, const std::string& doc) {
  return defaulted(name, "kg", "0 kg", not_negative, doc);
}

Fields<LinkBody> pivoted_link(const std::string& name, const std::string& from) {
  return link(name, defaulted(name + "_com", "m", "0 m", any_number, "its centre of mass " + from),
              "about its fixed bearing");
}

Fields<LinkBody> floating_link(const std::string& name, const std::string& from) {
  return link(name,
              quantity(name + "_com", "m", any_number, "its centre of mass " + from + "; default: half the length"),
              "about its centre of mass");
}

Key gravity_key() { return defaulted("gravity", "m/s2", "0 m/s2", not_negative, "0: weight is neglected", "gravity"); }

Fields<Mounting> mounting(const std::string& load_doc, const Tables<LoadReading>& loads) {
  return mounting_without_joints(load_doc, loads)
      .add({.name = "joints",
            .doc = "joints with friction, by their names: joints = { crank_pin = { radius = \"20 mm\", friction = 0.05 "
                   "} }; of a linkage by the point of a pin and the link that slides"},
           &Mounting::joints, rubbing_tables());
}

Fields<Mounting> mounting_without_joints(const std::string& load_doc, const Tables<LoadReading>& loads) {
  return Fields<Mounting>()
      .add(defaulted("phase", "rad", "0 deg", any_number, "crank angle ahead of the shaft's angle (several cylinders)"),
           &Mounting::phase)
      .add({.name = "load", .doc = load_doc}, &Mounting::loads, loads);
}

void limit_loads(const Mechanism& mechanism, const std::string& component, int node, Network& net) {
  for (std::size_t k = 0; k < mechanism.loads.size(); ++k)
    std::visit(
        [&]<class Law>(const Law& law) {
          if constexpr (std::is_base_of_v<TravelForce, Law>)
            for (const Curve* curve : {&law.approach, &law.retreat})
              net.limit({.component = component,
                         .of = "load",
                         .over = Network::DataRange::Over::channel,
                         .node = node,
                         .part = component == mechanism.name ? static_cast<int>(k) : -1,
                         .channel = Name::make(quantities::position, mechanism.name).text,
                         .sign = -static_cast<double>(law.end.side),
                         .offset = law.end.side * law.end.position,
                         .unit = mechanism.rocks() ? "rad" : "m"},
                        *curve);
        },
        mechanism.loads[k].law);
}

void build_mechanism(const Section& s, const MechanismData& data, const Mounting& mounting, const DataFaults& faults,
                     Network& net, Messages& messages, std::optional<MechanismJoints> joints,
                     std::shared_ptr<const DeformingParts> deforming) {
  const int node = net.add_node(s.name, "", 0);
  net.ports[s.name] = {node, node};
  for (const DataFault& fault : faults)
    messages.add(s.where(fault.key), fmt::format("{} \"{}\": {}", s.kind->name, s.name, fault.text));
  if (!faults.empty() || !lengths_fit(s, messages)) return;
  std::optional<Mechanism> mechanism;
  try {
    mechanism.emplace(s.name, data);
    if (has_bodies && far_apart(s)) mechanism->bodies->sample(data.bodies_of().place);  // Simbody may refuse them
  } catch (const OutOfTime&) {
    throw;
  } catch (const std::exception& why) {
    // A sketch has its own words; Simbody's checks speak of matrices.
    const std::string masses = masses_of(s),
                      by_sketch = has_bodies && masses.empty() ? fmt::format(" ({})", why.what()) : "";
    messages.add(s.at, !far_apart(s) || !by_sketch.empty()
                           ? fmt::format("{} \"{}\": its links cannot be followed over the cycle{}; probably a dead "
                                         "position or change point is too near: change a length clearly",
                                         s.kind->name, s.name, by_sketch)
                           : fmt::format("{} \"{}\": its lengths, masses and inertias lie too far apart to be computed "
                                         "together ({}); check their units",
                                         s.kind->name, s.name, masses));
    return;
  }
  if (mechanism->stands_still() && !mounting.loads.empty()) {
    const char* const key = s.has("load") ? "load" : "torque";
    messages.add(s.where(key), fmt::format("{} \"{}\": {}: its output stands still on this branch, so that no load on "
                                           "it does work; leave the load out, or choose another branch or output",
                                           s.kind->name, s.name, key));
    return;
  }
  mechanism->phase = mounting.phase;
  if (!joints) joints = joints_of(data, mounting.joints);
  mechanism->joints = friction_of(data, *joints, mounting.within);
  net.data.add(s.name, std::move(*joints));
  mechanism->deforming = std::move(deforming);
  put_loads(mounting.loads, *mechanism);
  limit_loads(*mechanism, s.name, node, net);
  net.put(node, s.name, std::make_shared<MechanismElement>(std::move(*mechanism)), {}, mounting.phase);
}

}  // namespace kurbel
