// positions.h — positions of a cycle shown on a sheet: numbered from a dead centre, and lettered where the load
// begins, ends or is greatest, so that a short peak between two numbers is shown.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

struct SheetPosition {
  std::string label;  // "0" … "11"; "a", "b" …
  double way = 0;     // from position 0 in the direction of motion [rad]
  double phi = 0;     // of the link, 0 ≤ φ < cycle [rad]
  bool numbered = true;
  bool edge = false;      // of a load: values before and after may differ
  bool greatest = false;  // the load is greatest there
};

// One cycle of the link, from position 0 on.
struct SheetCycle {
  double length = 0;   // [rad]
  double origin = 0;   // φ of position 0 [rad]
  double sense = 1;    // ±1, of the motion
  int positions = 12;  // numbered, equidistant

  double phi_at(double way) const;  // within the cycle
  double way_at(double phi) const;  // within the cycle
};

// Edges and the place of the greatest load are angles of the link; those at a number or the cycle's begin get no
// letter. If there are more edges than letters, those of least `weight` (one each) are omitted.
std::vector<SheetPosition> sheet_positions(const SheetCycle& cycle, const std::vector<double>& edges,
                                           std::optional<double> greatest = {}, const std::vector<double>& weight = {});

inline constexpr std::size_t most_letters = 14;

// Of a load's edges those where it bends visibly (a dead centre of a load that opposes is none), with how much it does.
// largest: of the load over the cycle.
struct BentEdges {
  std::vector<double> at, bend;
};
BentEdges bent_edges(const std::vector<double>& edges, double cycle, const std::function<double(double phi)>& load,
                     double largest);

// Angles evaluated for the positions: before, at and after each, `beside_edge` apart [rad].
inline constexpr double beside_edge = 1e-7;
std::vector<double> looked_at(const SheetCycle& cycle, const std::vector<SheetPosition>& positions);

// A position as a row of a table; at a jump one row before ("a⁻") and one after it ("a⁺").
template <class Values>
struct SheetRow {
  std::string label;
  const SheetPosition* position;
  const Values* values;
};
template <class Values, class Jumps>
std::vector<SheetRow<Values>> sheet_rows(const std::vector<SheetPosition>& positions, const std::vector<Values>& looks,
                                         const Jumps& jumps) {
  std::vector<SheetRow<Values>> rows;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const SheetPosition& p = positions[k];
    const Values* look = &looks[3 * k];
    if (p.edge && jumps(look[0], look[2])) {
      rows.push_back({p.label + "⁻", &p, &look[0]});
      rows.push_back({p.label + "⁺", &p, &look[2]});
    } else {
      rows.push_back({p.label, &p, &look[1]});
    }
  }
  return rows;
}

// Points of a curve over the cycle, each with its angle `phi`, by their angle from position 0; the first one is repeated
// at the end.
template <class Point, class Angle>
std::vector<std::pair<double, const Point*>> by_way(const SheetCycle& cycle, const std::vector<Point>& curve,
                                                    const Angle& phi) {
  std::vector<std::pair<double, const Point*>> points;
  for (const Point& p : curve)
    if (const double at = std::invoke(phi, p); at < cycle.length * (1 - 1e-12))
      points.emplace_back(cycle.way_at(at), &p);
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  points.emplace_back(cycle.length, points.front().second);
  return points;
}

}  // namespace kurbel
