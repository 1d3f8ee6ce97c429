// positions.cpp — numbers and letters along a cycle.
#include "studies/sheet/positions.h"

#include <cmath>

#include "engine/numerics/angles.h"

namespace kurbel {
namespace {

constexpr double same_place = 1e-6, near_greatest = 1e-3;  // [rad]

double within(double x, double length) {
  const double rest = x - length * std::floor(x / length);
  return rest > length * (1 - 1e-14) ? 0 : rest;
}

SheetPosition* at_way(std::vector<SheetPosition>& list, double way, double length, double near) {
  for (SheetPosition& p : list)
    if (std::abs(std::remainder(p.way - way, length)) < near) return &p;
  return nullptr;
}

// Places by their weight, the heaviest first; without weights as they come.
std::vector<double> by_weight(const std::vector<double>& places, const std::vector<double>& weight) {
  std::vector<std::pair<double, double>> sorted;
  for (std::size_t i = 0; i < places.size(); ++i) sorted.emplace_back(i < weight.size() ? weight[i] : 0, places[i]);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<double> list;
  for (const auto& [w, place] : sorted) list.push_back(place);
  return list;
}

}  // namespace

double SheetCycle::phi_at(double way) const { return within(origin + sense * way, length); }
double SheetCycle::way_at(double phi) const { return within(sense * (phi - origin), length); }

BentEdges bent_edges(const std::vector<double>& edges, double cycle, const std::function<double(double)>& load,
                     double largest) {
  constexpr double step = 2 / in_degrees, visible = 2e-3;
  BentEdges bent;
  for (const double edge : edges) {
    const double bend = std::abs(load(edge + step) - 2 * load(edge) + load(edge - step));
    if (edge >= cycle * (1 - 1e-12) || bend < visible * largest) continue;
    bent.at.push_back(edge), bent.bend.push_back(bend);
  }
  return bent;
}

std::vector<double> looked_at(const SheetCycle& cycle, const std::vector<SheetPosition>& positions) {
  std::vector<double> phis;
  for (const SheetPosition& p : positions)
    for (const double side : {-beside_edge, 0.0, beside_edge})
      phis.push_back(p.edge && side != 0 ? cycle.phi_at(p.way + side) : p.phi);
  return phis;
}

std::vector<SheetPosition> sheet_positions(const SheetCycle& cycle, const std::vector<double>& edges,
                                           std::optional<double> greatest, const std::vector<double>& weight) {
  std::vector<SheetPosition> list;
  for (int k = 0; k < cycle.positions; ++k) {
    const double way = cycle.length * k / cycle.positions;
    list.push_back({.label = std::to_string(k), .way = way, .phi = cycle.phi_at(way)});
  }
  std::size_t letters = 0;
  const auto place = [&](double phi, double near, std::size_t most) -> SheetPosition* {
    const double way = cycle.way_at(phi);
    if (SheetPosition* known = at_way(list, way, cycle.length, near)) return known;
    if (letters == most) return nullptr;
    ++letters;
    list.push_back({.label = "", .way = way, .phi = within(phi, cycle.length), .numbered = false});
    return &list.back();
  };
  for (const double phi : by_weight(edges, weight))
    if (SheetPosition* p = place(phi, same_place, most_letters - 1)) p->edge = true;
  if (greatest) place(*greatest, near_greatest, most_letters)->greatest = true;
  std::sort(list.begin(), list.end(), [](const SheetPosition& a, const SheetPosition& b) { return a.way < b.way; });
  char letter = 'a';
  for (SheetPosition& p : list)
    if (!p.numbered) p.label = letter++;
  return list;
}

}  // namespace kurbel
