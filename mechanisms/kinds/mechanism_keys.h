// mechanism_keys.h — fields that mechanisms share, and from a mechanism's data to the element.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/network.h"
#include "engine/scene/fields.h"
#include "mechanisms/kinds/deformation_keys.h"
#include "mechanisms/kinds/joint_keys.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// NAME_mass, NAME_com, NAME_inertia of a link; `from` says where its centre of mass is measured from.
Fields<LinkBody> pivoted_link(const std::string& name, const std::string& from);   // inertia about its bearing
Fields<LinkBody> floating_link(const std::string& name, const std::string& from);  // central inertia
// What a floating link starts as.
template <class D>
auto in_the_middle_of(double D::*length) {
  return [length](const D& data) { return LinkBody{.com = data.*length / 2}; };
}

Key mass_key(const std::string& name, const std::string& doc);
Key gravity_key();

// What every mechanism has beside its linkage.
struct Mounting {
  double phase = 0;  // crank angle ahead of the shaft's [rad]
  std::vector<LoadReading> loads;
  std::vector<Reading<RubbingJoint>> joints;
  std::vector<ActsWithin> within = {};  // of a linkage, which press on these joints
};
Fields<Mounting> mounting(const std::string& load_doc, const Tables<LoadReading>& loads);
// The same for a kind that names its joints' keys itself.
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

// Adds the component: its node first, so that others may refer to it, then the element with its loads. What `faults`
// holds, and what Simbody refuses, goes into the messages. Joints: in place of the mounting's; deformation: of a
// slider-crank.
void build_mechanism(const Section& section, const MechanismData& data, const Mounting& mounting,
                     const DataFaults& faults, Network& net, Messages& messages,
                     std::optional<MechanismJoints> joints = {}, Deformation deformation = {});
// Tables of its loads over the travel end somewhere; `component`: as the scene names what they are of.
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
