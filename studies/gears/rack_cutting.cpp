// rack_cutting.cpp — the rack's profile, rolled; the drawing with the tooth upwards.
#include "studies/gears/rack_cutting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/findings/plots.h"
#include "studies/gears/figure_errors.h"

namespace kurbel {
namespace {

constexpr int positions = 19;           // of the rack that are drawn
constexpr double rolled_pitches = 1.4;  // from the middle to either end

// (h, u): above the datum line, along the rack from the middle of its space; in transverse section.
std::vector<OutlinePoint> half_space(const GearWheel& w, int n) {
  const double m = w.module, a = w.rack.pressure_angle, radius = w.rack.root_radius * m;
  const auto flank = [&](double h) { return std::numbers::pi * m / 4 - h * std::tan(a); };
  const double centre = radius - w.rack.dedendum() * m, beside = flank(centre) + radius / std::cos(a);
  std::vector<OutlinePoint> half;
  const double root = std::min(w.rack.dedendum() * m, std::numbers::pi * m / 4 / std::tan(a));
  half.push_back({root, 0});
  half.push_back({root, flank(root)});
  for (int i = 0; i <= n; ++i) {
    const double t = a + (std::numbers::pi / 2 - a) * i / n;
    half.push_back({centre - radius * std::sin(t), beside - radius * std::cos(t)});
  }
  half.push_back({half.back().x, std::numbers::pi * m / 2});
  for (OutlinePoint& p : half) p.y /= std::cos(w.helix);
  return half;
}

OutlinePoint in_wheel(const GearWheel& w, double roll, double h, double along) {
  const double radius = 0.5 * w.reference_diameter;
  const double x = radius + w.generating_shift * w.module + h, y = along + radius * roll;
  return {x * std::cos(roll) + y * std::sin(roll), y * std::cos(roll) - x * std::sin(roll)};
}

// With the tooth upwards, in mm.
void put(Series& series, OutlinePoint p) { series.add(-in_millimetres * p.y, in_millimetres * p.x); }

class CuttingDrawing {
 public:
  CuttingDrawing(const GearWheel& wheel, int number) : w_(wheel), number_(number) {
    pitch_ = std::numbers::pi * w_.transverse_module;
    side_ = 0.85 * pitch_;
    bottom_ = 0.5 * w_.root_diameter * std::cos(2 * side_ / w_.reference_diameter) - 0.6 * w_.module;
    top_ = 0.5 * w_.reference_diameter + (w_.generating_shift + w_.rack.dedendum() + 0.5) * w_.module;
  }

  Plot draw() const {
    Plot plot{.title = title(), .x = {"along the reference circle", "mm"}, .y = {"from the wheel's axis", "mm"}};
    plot.x.least = -in_millimetres * side_, plot.x.greatest = in_millimetres * side_;
    plot.y.least = in_millimetres * bottom_, plot.y.greatest = in_millimetres * top_;
    plot.series.push_back(rack_positions());
    plot.series.push_back(tooth(w_, fmt::format("wheel {}", number_), Role::elastic));
    if (std::abs(w_.generating_shift) > 1e-3) add_unshifted(plot);
    if (w_.undercut) plot.series.push_back(involute_alone());
    plot.series.push_back(
        dashed(circle("reference circle, on which the rack rolls", Role::green, w_.reference_diameter)));
    plot.series.push_back(dashed(circle("base circle", Role::reference, w_.base_diameter)));
    plot.series.push_back(middle_rack());
    plot.series.push_back(dashed(datum_line()));
    plot.equal_axes = true;
    plot.note =
        fmt::format("The rack rolls on the reference circle, its datum line {}; drawn every {:.3g}° of the wheel{}.",
                    datum_in_words(), step() * 180 / std::numbers::pi,
                    w_.undercut ? "; its corners go beyond the involute's begin and cut into it" : "");
    if (number_ == 1)
      plot.note +=
          " Transverse section. The envelope of the straight flanks is the involute, that of the rounded corners the "
          "fillet; a hob or a pinion cutter makes the same flank. Form cutting: a disc or end mill of the space's own "
          "shape cuts one space after the other; it is right for one z and x alone, so a set of cutters shares the "
          "range of z, and flanks between are approximate.";
    return plot;
  }

 private:
  std::string title() const {
    return fmt::format("How the rack cuts wheel {} (z = {}, x_E = {}): {}undercut, which begins below x_E = {}",
                       number_, w_.teeth, read_as(w_.generating_shift, {.digits = 3}), w_.undercut ? "" : "no ",
                       read_as(w_.least_shift_generated(), {.digits = 3}));
  }
  std::string datum_in_words() const {
    const double by = w_.generating_shift * w_.module;
    return by == 0 ? "touching it"
                   : fmt::format("{:.4g} mm {} of it (x_E m)", in_millimetres * std::abs(by),
                                 by < 0 ? "inside" : "outside");
  }
  double step() const { return 2 * rolled_pitches * pitch_ / (0.5 * w_.reference_diameter) / (positions - 1); }

  // Each position comes down beside what is seen, and goes up again.
  Series rack_positions() const {
    Series s{.name = "rack, position by position", .role = Role::sky};
    for (int k = 0; k < positions; ++k) {
      std::vector<OutlinePoint> seen;
      for (int space = -5; space <= 5; ++space)
        for (const OutlinePoint& p : rack_at(w_, step() * (k - (positions - 1) / 2), space))
          if (std::abs(p.y) < 2.4 * side_ && p.x < top_ + 3 * w_.module) seen.push_back(p);
      if (seen.empty()) continue;
      const double above = top_ + 4 * w_.module;
      put(s, {above, seen.front().y});
      for (const OutlinePoint& p : seen) put(s, p);
      put(s, {above, seen.back().y});
    }
    return s;
  }
  Series middle_rack() const {
    Series s{.name = "rack in its middle position", .role = Role::orange};
    for (int space = -2; space <= 2; ++space)
      for (const OutlinePoint& p : rack_at(w_, 0, space)) put(s, p);
    return s;
  }
  Series datum_line() const {
    Series s{.name = "its datum line", .role = Role::orange};
    for (const double along : {-2 * side_, 2 * side_}) put(s, in_wheel(w_, 0, 0, along));
    return s;
  }
  Series tooth(const GearWheel& w, const std::string& name, Role role) const {
    Series s{.name = name, .role = role};
    for (int k = -2; k <= 2; ++k) {
      const double c = std::cos(2 * k * std::numbers::pi / w.teeth), d = std::sin(2 * k * std::numbers::pi / w.teeth);
      for (const OutlinePoint& p : tooth_outline(w, 24)) put(s, {c * p.x - d * p.y, d * p.x + c * p.y});
    }
    return s;
  }
  void add_unshifted(Plot& plot) const {
    GearWheel same = w_;
    same.shift = same.generating_shift = 0;
    same.tip_diameter = same.reference_diameter + 2 * same.rack.addendum * same.module;
    try {
      plot.series.push_back(dashed(tooth(finish(same), "without shift, x = 0", Role::purple)));
    } catch (const std::invalid_argument&) {  // without it there is no such wheel
    }
  }
  // What would be there without undercut: both flanks down to the base circle.
  Series involute_alone() const {
    Series s{.name = "involute down to the base circle", .role = Role::vermillion, .dashed = true};
    constexpr int points = 24;
    for (int k = 0; k < 2 * points; ++k) {
      const double share = std::abs(k - points + 0.5) / (points - 0.5), side = k < points ? 1 : -1;
      const double d = w_.tip_diameter + (w_.base_diameter - w_.tip_diameter) * share,
                   half = w_.thickness(std::max(d, w_.base_diameter)) / d;
      put(s, {0.5 * d * std::cos(half), side * 0.5 * d * std::sin(half)});
    }
    return s;
  }
  Series circle(const std::string& name, Role role, double diameter) const {
    Series s{.name = name, .role = role};
    for (int i = -20; i <= 20; ++i) {
      const double angle = i / 20.0 * std::min(1.5, 4 * side_ / diameter);
      put(s, {0.5 * diameter * std::cos(angle), 0.5 * diameter * std::sin(angle)});
    }
    return s;
  }

  const GearWheel& w_;
  int number_;
  double pitch_ = 0, side_ = 0, bottom_ = 0, top_ = 0;
};

}  // namespace

std::vector<OutlinePoint> rack_at(const GearWheel& w, double roll, int space, int n) {
  const std::vector<OutlinePoint> half = half_space(w, n);
  const double middle = space * std::numbers::pi * w.transverse_module;
  std::vector<OutlinePoint> points;
  for (auto p = half.rbegin(); p + 1 != half.rend(); ++p) points.push_back(in_wheel(w, roll, p->x, middle - p->y));
  for (auto p = half.begin() + 1; p != half.end(); ++p) points.push_back(in_wheel(w, roll, p->x, middle + p->y));
  return points;
}

Plot cutting_plot(const GearWheel& wheel, int number) { return CuttingDrawing(wheel, number).draw(); }

}  // namespace kurbel
