// slider_crank_statics.cpp — equilibrium of slider, rod and crank, and the reactions and inertia forces of one state.
#include "tests/mechanisms/slider_crank_statics.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/mechanisms/slider_crank_statics_friction.h"

namespace kurbel {
namespace {

using Pose = SliderCrankGeometry::Pose<double>;
Pose pose_of(SliderCrankData d, bool changes, double phi) {
  if (changes) d.rod_length = d.radius + std::fabs(d.offset);
  return {d, changes, phi};
}

// Sines and cosines of a position, and the motion ratios of every centre of mass.
struct Position {
  Position(const SliderCrankData& d, bool changes, double phi) : Position(pose_of(d, changes, phi)) {}
  explicit Position(const Pose& p)
      : beta1(p.beta1),
        beta2(p.beta2),
        slider{p.x, p.x1, p.x2},
        c(p.cos_phi),
        s(p.sin_phi),
        cos_beta(p.cos_beta),
        sin_beta(p.sin_beta) {}
  // Accelerations at ω² = w, ε = a.
  Force2 crank_com(const SliderCrankData& d, double w, double a) const {
    return d.crank_com * Force2{-c * w - s * a, -s * w + c * a};
  }
  Force2 rod_com(const SliderCrankData& d, double w, double a) const {
    const double w_rod = beta1 * beta1 * w, a_rod = rod_angular(w, a);
    return d.radius * Force2{-c * w - s * a, -s * w + c * a} +
           d.rod_com * Force2{-cos_beta * w_rod - sin_beta * a_rod, -sin_beta * w_rod + cos_beta * a_rod};
  }
  double rod_angular(double w, double a) const { return beta2 * w + beta1 * a; }
  double slider_acceleration(double w, double a) const { return slider.curvature * w + slider.slope * a; }

  double beta1, beta2;  // β′, β″
  ValueSlopeCurvature<double> slider;
  double c, s, cos_beta, sin_beta;
};

// Forces and moments on the three links, reactions not counted; moments about their centres of mass, the slider's about
// its pin.
struct Loads {
  Force2 crank, rod, slider;
  double crank_moment = 0, rod_moment = 0, slider_moment = 0;
};

double central_crank_inertia(const SliderCrankData& d) {
  return d.crank_inertia - d.crank_mass * d.crank_com * d.crank_com;
}

Loads inertia_loads(const SliderCrankData& d, const SliderGuide&, const Position& p, double w, double a) {
  Loads loads;
  loads.crank = -d.crank_mass * p.crank_com(d, w, a);
  loads.rod = -d.rod_mass * p.rod_com(d, w, a);
  loads.slider = {-d.slider_mass * p.slider_acceleration(w, a), 0};
  loads.crank_moment = -central_crank_inertia(d) * a;
  loads.rod_moment = -d.rod_inertia * p.rod_angular(w, a);
  return loads;  // the slider's centre of mass lies in the line of its pin and its acceleration: no moment
}

Loads weight_loads(const SliderCrankData& d, const SliderGuide& guide) {
  const Force2 down = -d.gravity * Force2{std::sin(d.stroke_angle), std::cos(d.stroke_angle)};
  Loads loads;
  loads.crank = d.crank_mass * down;
  loads.rod = d.rod_mass * down;
  loads.slider = d.slider_mass * down;
  loads.slider_moment = guide.com_x * loads.slider.y;
  return loads;
}

Force2 crank_com_at(const SliderCrankData& d, const Position& p) { return d.crank_com * Force2{p.c, p.s}; }

// Slider, then rod, then crank in equilibrium.
SliderCrankStatics::Column equilibrium(const SliderCrankData& d, const Position& p, const Loads& on) {
  using S = SliderCrankStatics;
  S::Column r;
  const Force2 along_rod{p.cos_beta, p.sin_beta};
  // Slider along x: R_B. Rod about A: c × f + m − l × R_B = 0.
  const double bx = -on.slider.x;
  const double by = (d.rod_com * cross(along_rod, on.rod) + on.rod_moment + d.rod_length * p.sin_beta * bx) /
                    (d.rod_length * p.cos_beta);
  const Force2 pin_b{bx, by}, pin_a = pin_b - on.rod, bearing = pin_a - on.crank;
  r[S::main_x] = bearing.x;
  r[S::main_y] = bearing.y;
  r[S::crank_x] = pin_a.x;
  r[S::crank_y] = pin_a.y;
  r[S::slider_x] = pin_b.x;
  r[S::slider_y] = pin_b.y;
  r[S::guide_n] = -on.slider.y - by;
  r[S::guide_m] = -on.slider_moment;
  // Crank about O.
  r[S::torque_m] = d.radius * cross({p.c, p.s}, pin_a) - cross(crank_com_at(d, p), on.crank) - on.crank_moment;
  return r;
}

void require(bool holds, const std::string& what, double got, const char* domain) {
  if (!holds) throw std::invalid_argument(fmt::format("slider-crank: {} = {:g}; must be {}", what, got, domain));
}

void validate(const FrictionCoefficient& f, const std::string& joint) {
  for (const double value : {f.kinetic, f.resting, f.stribeck_speed, f.viscous})
    require(std::isfinite(value) && value >= 0, joint + ": a friction value", value, "finite and >= 0");
  require(f.resting >= f.kinetic, joint + ": static friction coefficient", f.resting,
          fmt::format(">= the kinetic one, {:g}", f.kinetic).c_str());
}

}  // namespace

void validate(const SliderCrankJoints& joints) {
  const auto revolute = [](const RevoluteJoint& joint, const std::string& name) {
    require(std::isfinite(joint.radius) && joint.radius >= 0, name + ": radius", joint.radius, ">= 0 m");
    validate(joint.friction, name);
  };
  revolute(joints.main_bearing, "main bearing");
  revolute(joints.crank_pin, "crank pin");
  revolute(joints.slider_pin, "slider pin");
  const SliderGuide& g = joints.guide;
  validate(g.friction, "guide");
  require(std::isfinite(g.length) && g.length >= 0, "guide length", g.length, ">= 0 m");
  require(std::isfinite(g.width) && g.width >= 0, "guide width", g.width, ">= 0 m");
  require(std::isfinite(g.rolling_arm) && g.rolling_arm >= 0, "guide rolling_arm", g.rolling_arm, ">= 0 m");
  require(std::isfinite(g.roller_radius) && (g.rolling_arm == 0 || g.roller_radius > 0), "guide roller_radius",
          g.roller_radius, "> 0 m where there is a rolling_arm");
  for (const double value : {g.middle, g.com_x, g.force_offset})
    require(std::isfinite(value), "a length of the guide", value, "finite");
}

double SliderCrankForces::friction_loss() const {
  return std::accumulate(friction_power.begin(), friction_power.end(), 0.0);
}

SliderCrankStatics::SliderCrankStatics(const SliderCrankData& data, const SliderCrankJoints& joints)
    : data_(data),
      joints_(joints),
      changes_(data.changes()),
      down_(-data.gravity * Force2{std::sin(data.stroke_angle), std::cos(data.stroke_angle)}) {
  validate(joints);
}

SliderCrankStatics::Table SliderCrankStatics::unit_cases(double phi) const {
  const Position p(data_, changes_, phi);
  Table table;
  table.col(speed_case) = equilibrium(data_, p, inertia_loads(data_, joints_.guide, p, 1, 0));
  table.col(acceleration_case) = equilibrium(data_, p, inertia_loads(data_, joints_.guide, p, 0, 1));
  table.col(gravity_case) = equilibrium(data_, p, weight_loads(data_, joints_.guide));
  Loads unit;
  unit.slider = {1, 0};
  unit.slider_moment = -joints_.guide.force_offset;
  table.col(force_case) = equilibrium(data_, p, unit);
  unit = {};
  unit.crank_moment = 1;
  table.col(main_friction) = equilibrium(data_, p, unit);
  unit = {};
  unit.rod_moment = 1, unit.crank_moment = -1;
  table.col(crank_friction) = equilibrium(data_, p, unit);
  unit = {};
  unit.slider_moment = 1, unit.rod_moment = -1;
  table.col(slider_friction) = equilibrium(data_, p, unit);
  unit = {};
  unit.slider = {1, 0};
  table.col(guide_friction) = equilibrium(data_, p, unit);
  unit = {};
  unit.slider_moment = 1;
  table.col(guide_couple) = equilibrium(data_, p, unit);
  return table;
}

SliderCrankStatics::Rates SliderCrankStatics::rates(double phi, double omega) const {
  const Pose p = pose_of(data_, changes_, phi);
  const double rod = p.beta1 * omega;
  return {omega, rod - omega, -rod, p.x1 * omega};
}

SliderCrankStatics::Column SliderCrankStatics::load_column(const Table& unit, const CrankState& s) const {
  return unit.col(speed_case) * (s.omega * s.omega) + unit.col(acceleration_case) * s.alpha + unit.col(gravity_case) +
         unit.col(force_case) * s.slider_force;
}

SliderCrankForces SliderCrankStatics::solve(const CrankState& state) const {
  const Table unit = unit_cases(state.phi);
  const Column base = load_column(unit, state);
  const Solution solution = solve_friction(unit, base, law_at(state), state.phi);
  return assemble(base + unit.rightCols<frictions>() * solution.q, solution, state);
}

SliderCrankForces SliderCrankStatics::solve_frictionless(const CrankState& state) const {
  return assemble(load_column(unit_cases(state.phi), state), Solution{}, state);
}

SliderCrankForces SliderCrankStatics::assemble(const Column& r, const Solution& solution,
                                               const CrankState& state) const {
  SliderCrankForces out;
  out.main_bearing = {r[main_x], r[main_y]};
  out.crank_pin = {r[crank_x], r[crank_y]};
  out.slider_pin = {r[slider_x], r[slider_y]};
  out.guide = r[guide_n];
  out.guide_moment = r[guide_m];
  out.guide_point = r[guide_m] == 0 ? 0 : r[guide_m] / r[guide_n];
  out.torque = r[torque_m];
  const SliderGuide& g = joints_.guide;
  const double moment = out.guide_moment - g.middle * out.guide;
  out.both_edges = g.length > 0 && 2 * std::abs(moment) > g.length * std::abs(out.guide);
  if (out.both_edges) {
    out.edge_front = 0.5 * out.guide + moment / g.length;
    out.edge_back = 0.5 * out.guide - moment / g.length;
  }
  for (std::size_t k = 0; k < 3; ++k) out.friction_torque[k] = solution.q[static_cast<int>(k)];
  out.guide_friction = solution.q[3];
  const Rates rate = rates(state.phi, state.omega);
  out.friction_power = {-out.friction_torque[0] * rate.main_bearing, -out.friction_torque[1] * rate.crank_pin,
                        -out.friction_torque[2] * rate.slider_pin, -out.guide_friction * rate.slider};
  out.residual = solution.residual;
  out.iterations = solution.iterations;
  add_motion(state, out);
  return out;
}

void SliderCrankStatics::add_motion(const CrankState& state, SliderCrankForces& out) const {
  const Position p(data_, changes_, state.phi);
  const Loads inertia = inertia_loads(data_, joints_.guide, p, state.omega * state.omega, state.alpha);
  out.crank_inertia = inertia.crank;
  out.rod_inertia = inertia.rod;
  out.slider_inertia = inertia.slider;
  out.crank_couple = inertia.crank_moment;
  out.rod_couple = inertia.rod_moment;
  out.shaking_force = inertia.crank + inertia.rod + inertia.slider;
  const Force2 rod_com{data_.radius * p.c + data_.rod_com * p.cos_beta,
                       data_.radius * p.s + data_.rod_com * p.sin_beta};
  out.shaking_moment = cross(crank_com_at(data_, p), inertia.crank) + cross(rod_com, inertia.rod) +
                       cross({p.slider.value, data_.offset}, inertia.slider) + inertia.crank_moment +
                       inertia.rod_moment;
}

}  // namespace kurbel
