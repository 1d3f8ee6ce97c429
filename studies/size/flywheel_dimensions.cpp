// flywheel_dimensions.cpp — a flywheel of given inertia as a disc, or as a rim on spokes: size, mass, stress.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/roots.h"
#include "studies/data/named.h"
#include "studies/size/flywheel.h"

namespace kurbel {
namespace {

constexpr double hub_share = 0.2;        // hub's over outer diameter
constexpr double breadth_share = 2.0;    // b/h of the rim
constexpr double rim_proportion = 0.06;  // h/D where no diameter is given
constexpr double disc_proportion = 0.1;  // b/D where no diameter is given

// A ring between two diameters: its mass and its inertia per breadth and density.
double ring_area(double outer, double inner) { return pi / 4 * (outer * outer - inner * inner); }
double ring_inertia(double outer, double inner) { return pi / 32 * (std::pow(outer, 4) - std::pow(inner, 4)); }

// Rim, spokes and hub over the outer diameter and the rim's thickness.
struct Spoked {
  double rim_mass, spoke_mass, hub_mass, rim_inertia, spoke_inertia, hub_inertia;

  Spoked(double diameter, double thickness, double density) {
    const double breadth = breadth_share * thickness, inner = diameter - 2 * thickness, hub = hub_share * diameter;
    rim_mass = density * breadth * ring_area(diameter, inner);
    rim_inertia = density * breadth * ring_inertia(diameter, inner);
    hub_mass = density * breadth * ring_area(hub, 0);
    hub_inertia = density * breadth * ring_inertia(hub, 0);
    const double length = 0.5 * (inner - hub), middle = 0.25 * (inner + hub);
    const double section = pi / 4 * thickness * (thickness / 2);
    spoke_mass = flywheel_spokes * density * section * length;
    spoke_inertia = spoke_mass * (length * length / 12 + middle * middle);
  }
  double mass() const { return rim_mass + spoke_mass + hub_mass; }
  double inertia() const { return rim_inertia + spoke_inertia + hub_inertia; }
};

void check(const FlywheelRequest& r) {
  const auto require = [](double value, const char* what, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
      throw std::invalid_argument(fmt::format("flywheel: {} = {:.6g} {}; must be > 0", what, value, unit));
  };
  require(r.inertia, "inertia", "kg·m²");
  require(r.fastest, "greatest speed", "rad/s");
  if (r.diameter != 0) require(r.diameter, "diameter", "m");
  if (r.rim_speed != 0) require(r.rim_speed, "rim speed", "m/s");
}

void make_disc(const FlywheelRequest& r, double limit, FlywheelDimensions& d) {
  const double density = r.material.density;
  if (d.diameter == 0)
    d.diameter = std::min(std::pow(r.inertia / (density * disc_proportion * pi / 32), 0.2), 2 * limit / r.fastest);
  d.breadth = r.inertia / (density * ring_inertia(d.diameter, 0));
  d.mass = d.rim_mass = density * d.breadth * ring_area(d.diameter, 0);
}

void make_rim(const FlywheelRequest& r, double limit, FlywheelDimensions& d) {
  const double density = r.material.density, widest = 0.5 * (1 - hub_share);
  if (d.diameter == 0) {
    const double unit = Spoked(1, rim_proportion, density).inertia();
    d.diameter = std::min(std::pow(r.inertia / unit, 0.2), 2 * limit / r.fastest);
  }
  const double most = Spoked(d.diameter, widest * d.diameter, density).inertia();
  if (!(most > r.inertia))
    throw std::invalid_argument(fmt::format(
        "flywheel: {:.6g} kg·m² do not go into a rim of {:.6g} m with b = 2 h (at most {:.6g} kg·m²); {}, or "
        "choose --form disc",
        r.inertia, d.diameter, most,
        r.diameter > 0
            ? "give a larger --diameter"
            : "choose a --material with a higher allowable rim speed, or put the flywheel on a slower shaft"));
  const auto too_thin = [&](double h) { return Spoked(d.diameter, h, density).inertia() < r.inertia; };
  d.thickness = halved({0, widest * d.diameter}, 200, too_thin).middle();
  const Spoked parts(d.diameter, d.thickness, density);
  d.breadth = breadth_share * d.thickness;
  d.mass = parts.mass();
  d.rim_mass = parts.rim_mass;
  d.rim_share = parts.rim_inertia / parts.inertia();
}

void find_stresses(const FlywheelRequest& r, FlywheelDimensions& d) {
  const double density = r.material.density, disc_factor = (3 + r.material.poisson) / 8;
  d.rim_speed = r.fastest * d.diameter / 2;
  d.within_limit = d.rim_speed <= d.rim_speed_limit * (1 + 1e-12);
  const double limit = density * d.rim_speed_limit * d.rim_speed_limit;
  if (d.form == FlywheelForm::disc) {
    d.stress = d.spoked_stress = disc_factor * density * d.rim_speed * d.rim_speed;
    d.allowed_stress = disc_factor * limit;
  } else {
    const double mean_radius = 0.5 * (d.diameter - d.thickness), speed = r.fastest * mean_radius;
    d.stress = density * speed * speed;
    // Khurmi and Gupta (22.3): three quarters of the ring's tension and a quarter of the bending between stiff spokes.
    constexpr double n = flywheel_spokes;
    d.spoked_stress = d.stress * (0.75 + 4.935 * mean_radius / (n * n * d.thickness));
    d.allowed_stress = limit;
  }
  d.safety = r.material.strength / std::max(d.stress, d.spoked_stress);
  d.energy = 0.5 * r.inertia * r.fastest * r.fastest;
}

}  // namespace

// Densities and strengths are those of the standards' grades; rim speeds are customary (grey cast iron: 6000 ft/min in
// machinery handbooks) and hold for castings without defects and joints.
const std::vector<FlywheelMaterial>& flywheel_materials() {
  static const std::vector<FlywheelMaterial> all = {{"grey cast iron", 7200, 0.26, 250e6, 30},
                                                    {"nodular cast iron", 7100, 0.275, 400e6, 45},
                                                    {"cast steel", 7800, 0.3, 450e6, 50},
                                                    {"steel", 7850, 0.3, 500e6, 80}};
  return all;
}

const FlywheelMaterial& flywheel_material(const std::string& name) {
  return named(flywheel_materials(), &FlywheelMaterial::name, name, "no flywheel material {}{}; known: {}");
}

FlywheelDimensions flywheel_dimensions(const FlywheelRequest& request) {
  check(request);
  FlywheelDimensions d;
  d.form = request.form;
  d.material = request.material;
  d.inertia = request.inertia;
  d.diameter = request.diameter;
  d.rim_speed_limit = request.rim_speed > 0 ? request.rim_speed : request.material.rim_speed;
  if (d.form == FlywheelForm::disc)
    make_disc(request, d.rim_speed_limit, d);
  else
    make_rim(request, d.rim_speed_limit, d);
  find_stresses(request, d);
  return d;
}

}  // namespace kurbel
