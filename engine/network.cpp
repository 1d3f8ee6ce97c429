// network.cpp — building blocks of the unmerged machine.
#include "engine/network.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kurbel {

std::vector<std::unique_ptr<ElementPool>> PoolSet::release() {
  std::vector<std::unique_ptr<ElementPool>> result;
  for (auto& pool : pools_) result.push_back(std::move(*pool));
  pools_.clear();
  by_type_.clear();
  return result;
}

int Network::add_node(const std::string& component, const std::string& label, double inertia) {
  nodes.push_back({component, label, inertia, -1});
  return static_cast<int>(nodes.size()) - 1;
}

void Network::join(int a, int b, double ratio, const std::string& component) {
  joints.push_back({a, b, ratio, component, nullptr, false});
}

void Network::put_made(int node, const std::string& component, std::shared_ptr<ShaftElementMaker> maker, Window window,
                       double phase) {
  elements.push_back({node, component, std::move(maker), window, phase});
}

void Network::prescribe(int node, PrescribedSpeed speed) {
  nodes[static_cast<std::size_t>(node)].prescribed = static_cast<int>(prescribed.size());
  prescribed.push_back(std::move(speed));
}

double PrescribedSpeed::value(double t) const {
  const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  double base;
  if (after == 0) {
    base = speed.front();
  } else if (after == time.size()) {
    base = speed.back();
  } else {
    const double s = (t - time[after - 1]) / (time[after] - time[after - 1]);
    base = speed[after - 1] + s * (speed[after] - speed[after - 1]);
  }
  return base + amplitude * std::sin(2 * M_PI * frequency * t + phase);
}

double PrescribedSpeed::slope(double t) const {
  const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  double base = 0;
  if (after > 0 && after < time.size())
    base = (speed[after] - speed[after - 1]) / (time[after] - time[after - 1]);
  return base + amplitude * 2 * M_PI * frequency * std::cos(2 * M_PI * frequency * t + phase);
}

double PrescribedSpeed::next_edge(double t) const {
  if (time.size() < 2) return std::numeric_limits<double>::infinity();
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  return after == time.end() ? std::numeric_limits<double>::infinity() : *after;
}

}  // namespace kurbel
