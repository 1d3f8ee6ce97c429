// slider_crank.cpp — checks of the lengths, the loop as bodies and joints, the drawing.
#include "mechanisms/linkages/slider_crank.h"

#include <fmt/core.h>

#include <cmath>

#include "mechanisms/linkages/link_bodies.h"

namespace kurbel {

namespace {

// A rod shorter than r + |e| lets the crank rock, if its pin comes within the rod's reach of the slider's line, and clearly
// so: at a stop that is hardly one a millionth of a length would decide the branch.
void add_rod_faults(const SliderCrankData& d, DataFaults& faults) {
  constexpr double hardly = 1e-6;
  const double reach = d.radius + std::abs(d.offset), near = std::abs(d.offset) - d.radius;
  const auto close_to = [&](double length) { return std::abs(d.rod_length - length) <= hardly * reach; };
  if (d.rod_length <= near)
    faults.push_back({"rod", fmt::format("rod = {}; must be > |offset| - radius = {}, else the rod cannot reach the "
                                         "slider's line; lengthen the rod or the crank",
                                         in_mm(d.rod_length), in_mm(near))});
  else if (d.rocks() && (close_to(reach) || close_to(std::abs(near))))
    faults.push_back(
        {"rod", fmt::format("rod = {} differs by only {:.1e} of itself from the length at which crank and rod pass "
                            "upright: a millionth of a length would decide the branch; lengthen or shorten it clearly",
                            in_mm(d.rod_length),
                            std::abs(d.rod_length - (close_to(reach) ? reach : std::abs(near))) / d.rod_length)});
  else if (d.folds && !d.changes() && !d.rocks())
    faults.push_back({"branch", fmt::format("branch = \"folds\" needs a rod of at most radius + |offset| = {}; the rod "
                                            "is {} long: leave the branch out",
                                            in_mm(reach), in_mm(d.rod_length))});
}

}  // namespace

DataFaults faults_of(const SliderCrankData& d) {
  DataFaults faults;
  add_rod_faults(d, faults);
  const double least = d.crank_mass * d.crank_com * d.crank_com;
  if (d.crank_inertia < least * (1 - 1e-12))
    faults.push_back({"crank_inertia", fmt::format("crank_inertia = {:.6g} kg·m²; is about the axis and must be ≥ "
                                                   "crank_mass · crank_com² = {:.6g} kg·m²",
                                                   d.crank_inertia, least)});
  return faults;
}

std::vector<double> values_of(const SliderCrankData& d) {
  return {d.radius,  d.rod_length,  d.offset,      d.crank_mass, d.crank_com,    d.crank_inertia, d.rod_mass,
          d.rod_com, d.rod_inertia, d.slider_mass, d.gravity,    d.stroke_angle, double(d.folds)};
}

std::optional<CrankArc> arc_of(const SliderCrankData& d) { return d.loop().arc(); }

LinkageDrawing drawing_of(const SliderCrankData& d) {
  return {"Slider-crank", d.stroke_angle, {0, 1, 2}, {{"link", {1, 2}}, {"slider", {2}}, {"crank", {0, 1}}}, {0}, 2,
          false};
}

PlanarLinkage linkage_of(const SliderCrankData& d, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, d.radius);
  const Direction rod = rod_to_line(d.loop(), crank, phi, d.folds);
  PlanarLinkage l;
  l.gravity = d.gravity, l.elevation = d.stroke_angle;
  l.add(pivoted("crank", {d.crank_mass, d.crank_com, d.crank_inertia}, {}, crank));
  l.add(floating("rod", {d.rod_mass, d.rod_com, d.rod_inertia}, pin, rod));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  add_slider(l, "slider", d.slider_mass, "slider pin", pin + along(rod, d.rod_length));
  if (d.changes()) l.changes = true, l.sine = rod.cos.value();
  if (d.stands_still()) {
    l.stands_still = true;
    for (long double& motion : l.output) motion = 0;
  }
  return l;
}

}  // namespace kurbel
