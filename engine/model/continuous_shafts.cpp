// continuous_shafts.cpp — degree of every shaft's element, and its points and springs instead of the whole.
#include "engine/model/continuous_shafts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/elements/coupled_springs.h"
#include "engine/model/seen_inertia.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/numerics/lobatto_element.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr double farthest = 2 * pi;  // x up to which a shaft resolves vibrations faster than its own
constexpr int next_odd = 2;          // odd degrees have a part in the middle, whose torque is the shaft's

// First root of tan x = (r_a + r_b) x/(r_a r_b x² − 1), r = J/J_shaft (theory 5.19); it lies in 0 … π.
double first_root(double a, double b) {
  constexpr double heavy = 1e12;
  a = std::min(a, heavy), b = std::min(b, heavy);
  const auto value = [&](double x) {
    return (std::sin(x) * (a * b * x * x - 1) - (a + b) * x * std::cos(x)) / ((1 + a) * (1 + b));
  };
  return halved({0, pi}, 60, [&](double x) { return value(x) < 0; }).high;
}

int degree_for(double x) {
  int degree = 1;
  while (degree + next_odd <= highest_lobatto_degree - next_odd && dispersion(degree, x) > resolved_within)
    degree += next_odd;
  return degree;
}

// x of its first natural frequency between the adjacent inertias.
double own_x(const Network::Chain& chain, const SeenInertias& seen, std::size_t joint) {
  const auto beside = [&](double side) { return std::max(0.0, side / chain.inertia - 0.5); };
  return first_root(beside(seen.on_side_a(joint)), beside(seen.on_side_b(joint)));
}

// The points between the ends, and a spring for each part, in place of the whole.
std::vector<Network::Joint> parts_of(Network& net, Network::Chain& chain, const Network::Joint& whole) {
  const LobattoElement& element = lobatto_element(chain.degree);
  const int in = chain.nodes.front(), out = chain.nodes.back();
  chain.nodes = {in};
  for (int i = 1; i < chain.degree; ++i) chain.nodes.push_back(net.add_node(chain.component, fmt::format("{}", i), 0));
  chain.nodes.push_back(out);
  for (std::size_t i = 0; i < chain.nodes.size(); ++i)
    net.nodes[at(chain.nodes[i])].inertia = chain.inertia * element.weight[i];
  std::vector<double> share;
  for (int k = 0; k < chain.degree; ++k) share.push_back(element.share(k));
  std::vector<Network::Joint> parts;
  for (int k = 0; k < chain.degree; ++k) {
    Network::Joint part = whole;
    part.a = chain.nodes[at(k)], part.b = chain.nodes[at(k + 1)];
    if (chain.degree > 1)
      part.element = spring_row_part(whole.element, k, share, element.stiffness, element.compliance);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

void add_continuous_shaft(Network& net, const std::string& component, const ContinuousShaft& shaft) {
  const int in = net.add_node(component, "in_end", 0), first = net.add_node(component, "in", shaft.inertia / 2),
            last = net.add_node(component, "out", shaft.inertia / 2), out = net.add_node(component, "out_end", 0);
  net.ports[component] = {in, out, {}};
  const auto end = [&](int a, int b, const char* label) {
    net.joints.push_back({.a = a, .b = b, .component = component, .label = label, .reported = true});
  };
  end(in, first, "in");
  net.joints.push_back({.a = first,
                        .b = last,
                        .component = component,
                        .element = shaft.whole,
                        .chain = static_cast<int>(net.chains.size())});
  end(last, out, "out");
  net.chains.push_back({component, {first, last}, shaft.stiffness, shaft.inertia, 1});
}

void cut_continuous_shafts(Network& net, int finer) {
  if (std::none_of(net.chains.begin(), net.chains.end(), [](const Network::Chain& c) { return c.degree > 0; })) return;
  const SeenInertias seen(net);
  std::vector<double> x(net.chains.size(), 0.0);
  double highest = 0;
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    const int c = net.joints[j].chain;
    if (c < 0 || net.chains[at(c)].degree == 0) continue;
    x[at(c)] = own_x(net.chains[at(c)], seen, j);
    highest = std::max(highest, x[at(c)] * net.chains[at(c)].wave_rate());
  }
  std::vector<Network::Joint> joints;
  std::vector<std::size_t> place;  // of every joint among the new ones
  for (const Network::Joint& joint : std::exchange(net.joints, {})) {
    place.push_back(joints.size());
    Network::Chain* chain = joint.chain >= 0 ? &net.chains[at(joint.chain)] : nullptr;
    if (!chain || chain->degree == 0) {
      joints.push_back(joint);
      continue;
    }
    const double most = std::max(x[at(joint.chain)], std::min(highest / chain->wave_rate(), farthest));
    chain->degree = std::min(degree_for(most) + next_odd * finer, highest_lobatto_degree);
    for (Network::Joint& part : parts_of(net, *chain, joint)) joints.push_back(std::move(part));
  }
  place.push_back(joints.size());
  net.joints = std::move(joints);
  for (Network::Relation& relation : net.relations) relation.joints_before = place[relation.joints_before];
}

}  // namespace kurbel
