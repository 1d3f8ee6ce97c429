// reduce_plots.cpp — reduced inertia and torques over the angle, bars of harmonics, discs on a shaft.
#include "studies/reduce/reduce_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"

namespace kurbel {
namespace {

double angle_of(const ReducedPosition& p) { return p.phi * in_degrees; }

using PlottedQuantity = std::function<double(const ReducedPosition&)>;

Series over_angle(const MachineReduction& r, const std::string& name, Role role, const PlottedQuantity& value) {
  return series_of(name, role, r.curve, angle_of, value);
}
Series at_positions(const MachineReduction& r, Role role, const PlottedQuantity& value) {
  std::vector<ReducedPosition> regular = r.positions;
  std::erase_if(regular, [](const ReducedPosition& p) { return !p.singular.empty(); });
  return marks(series_of(fmt::format("{} positions", r.positions.size()), role, regular, angle_of, value));
}

Plot harmonics_plot(const Spectrum& s, const std::string& link) {
  Plot plot{.title = fmt::format("Harmonics of the {}", s.name),
            .x = {fmt::format("order (per turn of {})", link), ""},
            .y = {"amplitude", pretty_unit(s.unit)},
            .series = {{.name = s.name, .role = Role::elastic}},
            .note = fmt::format("Without the mean of {:.4g} {}; these orders hold {:.4g} % of the mean square.",
                                s.harmonics.front().amplitude.value, pretty_unit(s.unit), 100 * s.captured),
            .bars = true};
  for (std::size_t n = 1; n < s.harmonics.size(); ++n)
    plot.series[0].add(s.harmonics[n].order, is_dust(s.harmonics[n], s) ? 0 : s.harmonics[n].amplitude.value);
  return in_readable_unit(std::move(plot), s.unit);
}

// Position of an inertia in the drawing: compliance from the first one along the x-axis, branches below each other, last
// what dampers alone hold.
struct Place {
  double x = 0;
  int row = 0;
};
std::vector<Place> places_of(const Chain& chain) {
  std::vector<Place> places(chain.inertias.size());
  std::vector<char> placed(chain.inertias.size(), 0);
  std::vector<int> branches(chain.inertias.size(), 0);
  int rows = 1;
  if (!placed.empty()) placed[0] = 1;
  const auto grow = [&](bool by_springs) {
    bool grown = false;
    for (const ChainSpring& s : chain.springs) {
      if (placed[s.a] == placed[s.b] || by_springs != (s.reduced_stiffness > 0)) continue;
      const std::size_t from = placed[s.a] ? s.a : s.b, to = placed[s.a] ? s.b : s.a;
      places[to] = {places[from].x + (by_springs ? 1 / s.reduced_stiffness : 0.0),
                    by_springs && branches[from]++ == 0 ? places[from].row : rows++};
      placed[to] = 1;
      grown = true;
    }
    return grown;
  };
  while (grow(true) || grow(false)) {
  }
  return places;
}

}  // namespace

ReducedNames names_of(const MachineReduction& r) {
  if (r.to_output && !r.to_rocker) return {"m", "kg", "kg/m", "F", "N"};
  return {"I", "kg*m2", "kg*m2/rad", "M", "N*m"};
}

std::vector<std::size_t> acting(const MachineReduction& r, double least) {
  std::vector<double> greatest(r.accounts.size());
  for (const ReducedPosition& p : r.curve)
    for (std::size_t k = 0; k < std::min(greatest.size(), p.share.size()); ++k)
      greatest[k] = std::max(greatest[k], std::abs(p.share[k]));
  const double largest = greatest.empty() ? 0 : *std::max_element(greatest.begin(), greatest.end());
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < greatest.size(); ++k)
    if (greatest[k] > least * largest) list.push_back(k);
  return list;
}

bool is_dust(const Harmonic& h, const Spectrum& s) {
  return std::abs(h.amplitude.value) < 1e-10 * std::sqrt(s.mean_square);
}

std::string speed_text(const MachineReduction& r) {
  return fmt::format("torques at {} of {} ({})", r.speed_unit.text(r.speed, 4), r.link, r.speed_source);
}

std::vector<Plot> motion_plots(const MachineReduction& r) {
  const ReducedNames n = names_of(r);
  const std::string angle = fmt::format("angle of {}", r.link);
  std::vector<Plot> plots;
  Plot inertia{.title = fmt::format("Reduced {} of the mechanism, on {}", n.inertia == "m" ? "mass" : "inertia", r.to),
               .x = {angle, "°"},
               .y = {n.inertia + "_em", pretty_unit(n.inertia_unit)}};
  const auto mechanism = [](const ReducedPosition& p) { return p.mechanism_inertia; };
  inertia.series = {over_angle(r, n.inertia + "_em", Role::elastic, mechanism),
                    at_positions(r, Role::vermillion, mechanism)};
  if (!r.to_output)
    inertia.note = fmt::format("The drive adds a constant {:.4g} kg·m².", r.constant_inertia);
  else if (r.turns_back)
    inertia.note = "Near the dead centres it grows without bound and is omitted.";
  Plot slope{
      .title = fmt::format("Its derivative {}_r′", n.inertia),
      .x = {angle, "°"},
      .y = {n.inertia + "_r′", pretty_unit(n.slope_unit)},
      .series = {over_angle(r, n.inertia + "_r′", Role::elastic, [](const ReducedPosition& p) { return p.slope; })}};
  Plot torque{
      .title = fmt::format("Driving and resisting {}, reduced to {}", n.torque == "F" ? "force" : "torque", r.to),
      .x = {angle, "°"},
      .y = {n.torque, pretty_unit(n.torque_unit)},
      .series = {over_angle(r, n.torque + "_d", Role::green, [](const ReducedPosition& p) { return p.drive; }),
                 over_angle(r, n.torque + "_c", Role::orange, [](const ReducedPosition& p) { return p.load; })},
      .note = speed_text(r) + "\n"};
  Plot shares{.title = "Share of each force, positive when it drives",
              .x = {angle, "°"},
              .y = {n.torque, pretty_unit(n.torque_unit)}};
  for (const std::size_t k : acting(r, above_rounding))
    shares.series.push_back(over_angle(r, r.accounts[k], further_role(shares.series.size()),
                                       [k](const ReducedPosition& p) { return p.share[k]; }));
  plots.push_back(std::move(inertia));
  plots.push_back(std::move(slope));
  plots.push_back(in_readable_unit(std::move(torque), n.torque_unit));
  if (!shares.series.empty()) plots.push_back(in_readable_unit(std::move(shares), n.torque_unit));
  return plots;
}

std::vector<Plot> harmonics_plots(const MachineReduction& r) {
  std::vector<Plot> plots;
  for (const Spectrum& s : r.spectra)
    if (std::any_of(s.harmonics.begin() + 1, s.harmonics.end(), [&](const Harmonic& h) { return !is_dust(h, s); }))
      plots.push_back(harmonics_plot(s, r.link));
  return plots;
}

std::vector<Plot> path_plots(const MachineReduction& r) {
  std::vector<Plot> plots;
  std::string linkage;
  for (const PointPath& path : r.paths) {
    const std::size_t dot = path.name.rfind('.');
    if (plots.empty() || path.name.substr(0, dot) != linkage) {
      linkage = path.name.substr(0, dot);
      plots.push_back({.title = fmt::format("Coupler curves of {}", linkage),
                       .x = {"x", "mm"},
                       .y = {"y", "mm"},
                       .note = "In the axes of the sketch, from the bearing of the driving link.",
                       .equal_axes = true});
    }
    std::vector<Series>& curves = plots.back().series;
    curves.push_back({.name = path.name.substr(dot + 1), .role = further_role(curves.size())});
    for (std::size_t i = 0; i < path.x.size(); ++i) curves.back().add(1e3 * path.x[i], 1e3 * path.y[i]);
  }
  return plots;
}

// Schematic drawing of the chain: discs with a height by the cube root of their inertia, at distances by the
// compliance of the shaft.
Plot chain_plot(const Chain& chain) {
  const std::vector<Place> places = places_of(chain);
  double largest = 0, length = 0;
  int rows = 0;
  for (const ChainInertia& i : chain.inertias) largest = std::max(largest, i.reduced);
  for (const Place& p : places) length = std::max(length, p.x), rows = std::max(rows, p.row + 1);
  if (length == 0) length = 1e-6;
  Plot plot{.title = "The elastic chain: discs are inertias, distances are compliances",
            .x = {"compliance from the first inertia", "µrad/(N·m)"},
            .y = {"branch of the drive", ""},
            .note = "Height of a disc: cube root of its reduced inertia. The table names what is on each."};
  for (int row = rows - 1; row > 0; --row) plot.y.names.push_back(fmt::format("branch {}", row));
  plot.y.names.emplace_back("main line");
  const auto height_of = [rows](const Place& p) { return static_cast<double>(rows - p.row); };
  for (const ChainSpring& s : chain.springs) {
    const Place a = places[s.a], b = places[s.b];
    const bool spring = s.reduced_stiffness > 0;
    plot.series.push_back({.name = spring
                                       ? fmt::format("{}: k = {}", s.name, short_text(s.reduced_stiffness, "N*m/rad"))
                                   : std::isnan(s.reduced_damping)
                                       ? s.name + ": not linear"
                                       : fmt::format("{}: c = {}", s.name, short_text(s.reduced_damping, "N*m*s/rad")),
                           .role = Role::elastic,
                           .x = {1e6 * a.x, 1e6 * b.x},
                           .y = {height_of(a), height_of(b)},
                           .dashed = !spring});
  }
  for (std::size_t k = 0; k < chain.inertias.size(); ++k) {
    const ChainInertia& i = chain.inertias[k];
    const double height = 0.4 * (largest > 0 ? std::max(0.05, std::cbrt(i.reduced / largest)) : 1),
                 width = 4e3 * length, x = 1e6 * places[k].x, y = height_of(places[k]);
    plot.series.push_back({.name = fmt::format("J{} = {:.4g} kg·m²", k + 1, i.reduced),
                           .role = further_role(k),
                           .x = {x - width, x + width, x + width, x - width, x - width},
                           .y = {y + height, y + height, y - height, y - height, y + height},
                           .text_at_start = fmt::format("J{}", k + 1)});
  }
  return plot;
}

}  // namespace kurbel
