// network.cpp — building blocks of the unmerged machine.
#include "engine/model/network.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kurbel {

int Network::add_node(const std::string& component, const std::string& label, double inertia) {
  nodes.push_back({component, label, inertia, -1});
  return static_cast<int>(nodes.size()) - 1;
}

void Network::join(int a, int b, double ratio, const std::string& component) {
  joints.push_back({.a = a, .b = b, .ratio = ratio, .component = component});
}

void Network::put(int node, const std::string& component, ShaftForm element, Window window, double phase) {
  elements.push_back({node, component, std::move(element), window, phase, -1});
}

void Network::prescribe(int node, PrescribedSpeed speed) {
  nodes[static_cast<std::size_t>(node)].prescribed = static_cast<int>(prescribed.size());
  prescribed.push_back(std::move(speed));
}

int PrescribedSpeed::piece(double t) const {
  return static_cast<int>(std::upper_bound(time.begin(), time.end(), t) - time.begin()) - 1;
}

double PrescribedSpeed::value(double t, int piece) const {
  const auto last = static_cast<int>(time.size()) - 1;
  const auto i = static_cast<std::size_t>(std::clamp(piece, 0, last));
  const double base = piece < 0 || piece >= last
                          ? speed[i]
                          : speed[i] + (t - time[i]) * (speed[i + 1] - speed[i]) / (time[i + 1] - time[i]);
  return base + amplitude * std::sin(2 * M_PI * frequency * t + phase);
}

double PrescribedSpeed::slope(double t, int piece) const {
  const auto last = static_cast<int>(time.size()) - 1;
  double base = 0;
  if (piece >= 0 && piece < last) {
    const auto i = static_cast<std::size_t>(piece);
    base = (speed[i + 1] - speed[i]) / (time[i + 1] - time[i]);
  }
  return base + amplitude * 2 * M_PI * frequency * std::cos(2 * M_PI * frequency * t + phase);
}

bool PrescribedSpeed::is_nothing() const {
  return amplitude == 0 && std::all_of(speed.begin(), speed.end(), [](double w) { return w == 0; });
}

double PrescribedSpeed::next_edge(double t) const {
  if (time.size() < 2) return std::numeric_limits<double>::infinity();
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  return after == time.end() ? std::numeric_limits<double>::infinity() : *after;
}

}  // namespace kurbel
