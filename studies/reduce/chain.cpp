// chain.cpp — the drive as a chain: inertias and the elastic parts between them.
#include <cmath>
#include <string>
#include <vector>

#include "engine/numerics/index.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

namespace {

// Whether one damping describes it: not what slips, has play, or internal states.
bool is_linear(const AnyConnection& joint) {
  return joint.damping > 0 || !(joint.is.slips || joint.is.states > 0 || joint.is.guards > 0);
}

}  // namespace

Chain elastic_chain(const Model& model, int node) {
  const Network& net = model.network;
  const double target = model.node_ratio[at(node)];
  // A continuous shaft is drawn as one spring between its halves.
  std::vector<const Network::Chain*> within(net.nodes.size(), nullptr);
  for (const Network::Chain& shaft : net.chains)
    for (std::size_t i = 1; shaft.degree > 0 && i + 1 < shaft.nodes.size(); ++i) within[at(shaft.nodes[i])] = &shaft;
  // Nodes connected rigidly are one inertia, counted on its first node.
  std::vector<int> group(net.nodes.size(), -1);
  Chain chain;
  for (std::size_t first = 0; first < net.nodes.size(); ++first) {
    if (group[first] >= 0 || within[first]) continue;
    const int number = static_cast<int>(chain.inertias.size());
    chain.inertias.push_back({"", 0, model.node_ratio[first] / target, 0, false});
    group[first] = number;
    for (bool grown = true; grown;) {
      grown = false;
      for (const Network::Joint& joint : net.joints) {
        if (joint.element) continue;
        if ((group[at(joint.a)] == number) == (group[at(joint.b)] == number)) continue;
        group[at(joint.a)] = group[at(joint.b)] = number;
        grown = true;
      }
    }
  }
  const auto add = [&](std::size_t n, double inertia, const std::string& label) {
    ChainInertia& i = chain.inertias[at(group[n])];
    const double ratio = model.node_ratio[n] / target;
    i.reduced += inertia * ratio * ratio;
    if (i.ratio == 0) i.own += inertia;  // stands in the usual motion, such as a housing
    if (inertia > 0 && i.name.find(label) == std::string::npos) i.name += (i.name.empty() ? "" : ", ") + label;
  };
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (!within[n])
      add(n, net.nodes[n].inertia, model.node_label(static_cast<int>(n)));
    else
      for (const int end : {within[n]->nodes.front(), within[n]->nodes.back()})
        add(at(end), 0.5 * net.nodes[n].inertia, model.node_label(end));
  for (const Network::ShaftElement& e : net.elements)
    if (e.element->cycle > 0) {
      add(at(e.node), e.element->mean_inertia, e.component);
      ChainInertia& i = chain.inertias[at(group[at(e.node)])];
      i.mechanism = i.mechanism || e.element->mean_inertia > 0;
      i.rocks = i.rocks || std::isinf(e.element->cycle);
    }
  for (ChainInertia& i : chain.inertias)
    if (i.ratio != 0) i.own = i.reduced / (i.ratio * i.ratio);
  for (const Network::Joint& joint : net.joints) {
    if (!joint.element || within[at(joint.a)]) continue;
    const bool whole = joint.chain >= 0 && net.chains[at(joint.chain)].degree > 0;
    const double share = whole ? net.chains[at(joint.chain)].stiffness / joint.element->stiffness : 1;
    const double ratio = model.node_ratio[at(joint.a)] / target, k = share * joint.element->stiffness,
                 c = is_linear(*joint.element) ? share * joint.element->damping : std::nan("");
    const int b = whole ? net.chains[at(joint.chain)].nodes.back() : joint.b;
    chain.springs.push_back(
        {joint.component, at(group[at(joint.a)]), at(group[at(b)]), k, c, ratio, k * ratio * ratio, c * ratio * ratio});
  }
  return chain;
}

}  // namespace kurbel
