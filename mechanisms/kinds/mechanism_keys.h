// mechanism_keys.h — keys that mechanisms share, and from a section's data to the element.
#pragma once

#include <string>
#include <vector>

#include "engine/model/network.h"
#include "engine/scene/keys.h"
#include "mechanisms/kinds/deformation_keys.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// NAME_mass, NAME_com, NAME_inertia of a link; `from` says where its centre of mass is measured from.
std::vector<Key> pivoted_link_keys(const std::string& name, const std::string& from);   // inertia about its bearing
std::vector<Key> floating_link_keys(const std::string& name, const std::string& from);  // central inertia
LinkBody read_link(const Section& section, const std::string& name, double default_com = 0);

Key mass_key(const std::string& name, const std::string& doc);
Key gravity_key();
Key phase_key();
Key load_key(const std::string& doc, const std::vector<Kind>& kinds);
std::vector<Key> joined(std::initializer_list<std::vector<Key>> parts);

// Adds the component: its node first, so that others may refer to it, then the element with its loads. What `faults`
// holds, and what Simbody refuses, goes into the messages. Joints, deformation: of a slider-crank.
void build_mechanism(const Section& section, const MechanismData& data, const DataFaults& faults, Network& net,
                     Messages& messages, std::shared_ptr<const SliderCrankStatics> joints = nullptr,
                     Deformation deformation = {});

}  // namespace kurbel
