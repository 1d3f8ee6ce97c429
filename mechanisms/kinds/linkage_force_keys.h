// linkage_force_keys.h — keys of springs, forces and couples within a linkage.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/network.h"
#include "engine/scene/fields.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/linkage/linkage.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// Tables of one kind with names given by the user.
template <class K>
Tables<Reading<K>> by_names(const char* name, const char* doc, const Fields<K>& fields) {
  Tables<Reading<K>> tables;
  tables.named = true;
  tables.add(name, doc, fields);
  return tables;
}

std::vector<std::string> words_in(const std::string& text);
template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const T& t : list) names.push_back(t.name);
  return names;
}

struct SpringKeys {
  std::string between;                // two points
  double stiffness = 0, preload = 0;  // [N/m], [N]
  std::optional<double> free_length;  // [m]
  double damping = 0;                 // [N·s/m]
};
struct PointForceKeys {
  std::optional<std::string> between, on;  // two points, or one
  std::optional<double> along;             // [rad]
  std::vector<LoadReading> loads;
};
struct CoupleKeys {
  std::string between;                                             // two links
  double stiffness = 0, free_angle = 0, preload = 0, damping = 0;  // [N·m/rad], [rad], [N·m], [N·m·s/rad]
  std::vector<LoadReading> torques;
};
struct LinkageForceKeys {
  std::vector<Reading<SpringKeys>> springs;
  std::vector<Reading<PointForceKeys>> forces;
  std::vector<Reading<CoupleKeys>> couples;
};
Fields<LinkageForceKeys> linkage_force_fields();

// Each as a mechanism without inertia. Faults go into the messages.
std::vector<Mechanism> linkage_forces(const Section& section, const LinkageForceKeys& keys,
                                      const std::shared_ptr<const Linkage>& linkage, double phase);
// Adds an element for each on the node of the linkage, which must be in the network.
void put_linkage_forces(const Section& section, std::vector<Mechanism> forces, Network& net);

}  // namespace kurbel
