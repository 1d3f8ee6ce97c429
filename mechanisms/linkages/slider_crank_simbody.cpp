// slider_crank_simbody.cpp — builds the slider-crank in Simbody (C++17 island).
#include "mechanisms/linkages/slider_crank_simbody.h"

#include <cmath>

#include "mechanisms/linkages/slider_crank_system.h"

namespace kurbel {

using SimTK::Transform;
using SimTK::Vec3;

namespace {

LinkBody crank_of(const SliderCrankData& d, double shaft_inertia) {
  return {d.crank_mass, d.crank_com,
          std::fmax(d.crank_inertia, d.crank_mass * d.crank_com * d.crank_com) + shaft_inertia};
}
LinkBody rod_of(const SliderCrankData& d) { return {d.rod_mass, d.rod_com, d.rod_inertia}; }

// β on the closed loop; the right branch has cos β > 0, of a rod that folds < 0.
double rod_angle(const SliderCrankData& d, double phi) {
  const double beta = std::asin((d.offset - d.radius * std::sin(phi)) / d.rod_length);
  return d.folds ? std::acos(-1.0) - beta : beta;
}

}  // namespace

SliderCrankSystem::SliderCrankSystem(const SliderCrankData& d, double shaft_inertia)
    : PlanarSystem("slider-crank"),
      data((validate(d), d)),
      crank(matter.Ground(), Transform(), pivoted_link(crank_of(d, shaft_inertia)), Transform()),
      rod(crank, Vec3(d.radius, 0, 0),
          floating_link(rod_of(d), "slider-crank: rod_inertia", d.slider_mass, d.rod_length), Vec3(0)) {
  const Vec3 pin(d.rod_length, 0, 0);
  SimTK::Constraint::PointInPlane(matter.Ground(), SimTK::UnitVec3(0, 1, 0), d.offset, rod, pin);
  gravity = d.gravity;
  elevation = d.stroke_angle;
  start = [this](double phi) { return std::vector<double>{rod_angle(data, phi) - phi}; };
  if (d.changes())
    follow = [d](double phi) {
      const Direction beta = rod_to_line(d.loop(), phi, d.folds);
      return Followed{{beta.series() - Taylor::variable(phi)}, beta.cos.value()};
    };
  if (d.folds) determinant_sign = -1;
  if (d.stands_still()) stands_at = 0;
  add_weight(d.crank_mass, crank, Vec3(d.crank_com, 0, 0));
  add_weight(d.rod_mass, rod, Vec3(d.rod_com, 0, 0));
  add_weight(d.slider_mass, rod, pin);
  set_output(rod, pin);
  add_joint(crank, Vec3(0));
  add_joint(rod, Vec3(0));
  add_joint(rod, pin);
}

std::vector<double> values_of(const SliderCrankData& d) {
  return {d.radius,  d.rod_length,  d.offset,      d.crank_mass, d.crank_com,    d.crank_inertia, d.rod_mass,
          d.rod_com, d.rod_inertia, d.slider_mass, d.gravity,    d.stroke_angle, double(d.folds)};
}

std::optional<CrankArc> arc_of(const SliderCrankData& d) { return d.loop().arc(); }

LinkageDrawing drawing_of(const SliderCrankData& d) {
  return {"Slider-crank", d.stroke_angle, {{"link", {1, 2}}, {"slider", {2}}, {"crank", {0, 1}}}, {0}, 2, false};
}

std::unique_ptr<MechanismBodies> make_bodies(const SliderCrankData& data) {
  return sampled(std::make_unique<SliderCrankSystem>(data));
}

}  // namespace kurbel
