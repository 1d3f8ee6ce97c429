// slider_crank.cpp — domain of the data, the loop as bodies and joints, the drawing.
#include "mechanisms/linkages/slider_crank.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "mechanisms/linkages/link_bodies.h"

namespace kurbel {

void validate(const SliderCrankData& d) {
  const auto require = [](bool holds, const char* what, double got, const char* domain) {
    if (holds) return;
    std::ostringstream message;
    message << "slider-crank: " << what << " = " << got << "; must be " << domain;
    throw std::invalid_argument(message.str());
  };
  const double values[] = {d.radius,   d.rod_length, d.offset,      d.crank_mass,  d.crank_com, d.crank_inertia,
                           d.rod_mass, d.rod_com,    d.rod_inertia, d.slider_mass, d.gravity,   d.stroke_angle};
  for (const double value : values) require(std::isfinite(value), "a value", value, "finite");
  require(d.radius > 0, "radius", d.radius, "> 0 m");
  require(d.rod_length > 0, "rod_length", d.rod_length, "> 0 m");
  require(d.rod_length > std::fabs(d.offset) - d.radius, "rod_length", d.rod_length, "> |offset| - radius");
  require(!d.folds || d.changes() || d.rocks(), "rod_length", d.rod_length,
          "<= radius + |offset| for a rod that folds");
  require(d.crank_mass >= 0, "crank_mass", d.crank_mass, ">= 0 kg");
  require(d.rod_mass >= 0, "rod_mass", d.rod_mass, ">= 0 kg");
  require(d.slider_mass >= 0, "slider_mass", d.slider_mass, ">= 0 kg");
  require(d.rod_inertia >= 0, "rod_inertia", d.rod_inertia, ">= 0 kg m2");
  const double least_inertia = d.crank_mass * d.crank_com * d.crank_com;
  require(d.crank_inertia >= least_inertia * (1 - 1e-12), "crank_inertia", d.crank_inertia,
          ">= crank_mass crank_com^2 (it is taken about the crank's axis)");
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
