// build_network.h — from one component's table to its nodes, joints and elements.
#pragma once

namespace kurbel {

struct Section;
class Network;
class Messages;

// What its parts refuse together is said with the component's place.
void build_component(const Section& section, Network& network, Messages& messages);

}  // namespace kurbel
