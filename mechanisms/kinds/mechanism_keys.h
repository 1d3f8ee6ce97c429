// mechanism_keys.h — fields shared by mechanisms, and the element from the data of a mechanism.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/network.h"
#include "engine/scene/fields.h"
#include "mechanisms/kinds/joint_keys.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// NAME_mass, NAME_com, NAME_inertia of a link; `from`: the point from which its centre of mass is measured.
Fields<LinkBody> pivoted_link(const std::string& name, const std::string& from);   // inertia about its bearing
Fields<LinkBody> floating_link(const std::string& name, const std::string& from);  // central inertia
// Default of a floating link.
template <class D>
auto in_the_middle_of(double D::*length) {
  return [length](const D& data) { return LinkBody{.com = data.*length / 2}; };
}

Key mass_key(const std::string& name, const std::string& doc);
Key gravity_key();

// Data of every mechanism in addition to its linkage.
struct Mounting {
  double phase = 0;  // crank angle ahead of the shaft's [rad]
  std::vector<LoadReading> loads;
  std::vector<Reading<RubbingJoint>> joints;
  std::vector<ActsWithin> within = {};  // forces within a linkage, which load these joints
};
Fields<Mounting> mounting(const std::string& load_doc, const Tables<LoadReading>& loads);
// The same for a kind with its own keys of joints.
Fields<Mounting> mounting_without_joints(const std::string& load_doc, const Tables<LoadReading>& loads);

template <class Linkage>
struct Mounted {
  Linkage linkage;
  Mounting mounting;
};
template <class Linkage>
Fields<Mounted<Linkage>> mounted(const Fields<Linkage>& linkage, const Fields<Mounting>& mounting) {
  return Fields<Mounted<Linkage>>().add(linkage, &Mounted<Linkage>::linkage).add(mounting, &Mounted<Linkage>::mounting);
}

// Adds the component: its node first, so that others can refer to it, then the element with its loads. The `faults` and
// the errors of Simbody go into the messages. joints: replace those of the mounting; deforming: what deforms.
void build_mechanism(const Section& section, const MechanismData& data, const Mounting& mounting,
                     const DataFaults& faults, Network& net, Messages& messages,
                     std::optional<MechanismJoints> joints = {},
                     std::shared_ptr<const DeformingParts> deforming = nullptr);
// Registers the range of load tables over the travel; `component`: their component in the scene.
void limit_loads(const Mechanism& mechanism, const std::string& component, int node, Network& net);
// A kind of mechanism by its fields alone.
template <auto fields>
Kind mounted_kind(std::string name, KeyDoc doc) {
  return on_a_shaft(std::move(name), std::move(doc), made_once<fields>().keys(),
                    [](const Section& section, Network& net, Messages& messages) {
                      const auto mechanism = made_once<fields>().read(section, messages);
                      build_mechanism(section, mechanism.linkage, mechanism.mounting, faults_of(mechanism.linkage), net,
                                      messages);
                    });
}

}  // namespace kurbel
