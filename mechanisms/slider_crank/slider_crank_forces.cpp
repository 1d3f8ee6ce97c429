// slider_crank_forces.cpp — equilibrium of slider, rod and crank, and the friction laws solved together with it.
#include "mechanisms/slider_crank/slider_crank_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/equations/jam.h"

namespace kurbel {
namespace {

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Sines and cosines of a position, and the motion ratios of every centre of mass.
struct Position {
  Position(const SliderCrankData& d, const SliderCrankGeometry& geometry, double phi)
      : beta(geometry.rod(phi)), slider(geometry.slider(phi)), c(std::cos(phi)), s(std::sin(phi)) {
    cos_beta = std::cos(beta.value);
    sin_beta = (d.offset - d.radius * s) / d.rod_length;
  }
  // Accelerations at ω² = w, ε = a.
  Force2 crank_com(const SliderCrankData& d, double w, double a) const {
    return d.crank_com * Force2{-c * w - s * a, -s * w + c * a};
  }
  Force2 rod_com(const SliderCrankData& d, double w, double a) const {
    const double w_rod = beta.slope * beta.slope * w, a_rod = rod_angular(w, a);
    return d.radius * Force2{-c * w - s * a, -s * w + c * a} +
           d.rod_com * Force2{-cos_beta * w_rod - sin_beta * a_rod, -sin_beta * w_rod + cos_beta * a_rod};
  }
  double rod_angular(double w, double a) const { return beta.curvature * w + beta.slope * a; }
  double slider_acceleration(double w, double a) const { return slider.curvature * w + slider.slope * a; }

  ValueSlopeCurvature<double> beta, slider;
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
double cross(Force2 a, Force2 b) { return a.x * b.y - a.y * b.x; }

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

bool SliderCrankJoints::frictionless() const {
  const auto slides = [](const RevoluteJoint& j) { return j.radius > 0 && !j.friction.none(); };
  return !slides(main_bearing) && !slides(crank_pin) && !slides(slider_pin) && guide.friction.none() &&
         guide.rolling_arm == 0;
}

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

const char* name_of(Joint joint) {
  switch (joint) {
    case Joint::main_bearing:
      return "main bearing";
    case Joint::crank_pin:
      return "crank pin";
    case Joint::slider_pin:
      return "slider pin";
    case Joint::guide:
      return "guide";
  }
  return "";
}

double SliderCrankForces::friction_loss() const {
  return std::accumulate(friction_power.begin(), friction_power.end(), 0.0);
}

SliderCrankStatics::SliderCrankStatics(const SliderCrankData& data, const SliderCrankJoints& joints)
    : data_(data), joints_(joints), geometry_(data) {
  validate(joints);
}

SliderCrankStatics::Table SliderCrankStatics::unit_cases(double phi) const {
  const Position p(data_, geometry_, phi);
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
  const double rod = geometry_.rod(phi).slope * omega;
  return {omega, rod - omega, -rod, geometry_.slider(phi).slope * omega};
}

// --- friction ---

// q = law(reactions): the friction loads, each against its joint's motion.
struct SliderCrankStatics::Law {
  using Loads = Eigen::Matrix<double, frictions, 1>;
  // ∂q/∂reactions: each friction hangs on two reactions at most.
  struct Slopes {
    struct Entry {
      int reaction = 0;
      double value = 0;
    };
    Entry on[frictions][2];
    template <class M>
    Eigen::Matrix<double, frictions, M::ColsAtCompileTime> operator*(const M& m) const {
      Eigen::Matrix<double, frictions, M::ColsAtCompileTime> product;
      for (int k = 0; k < frictions; ++k)
        product.row(k) = on[k][0].value * m.row(on[k][0].reaction) + on[k][1].value * m.row(on[k][1].reaction);
      return product;
    }
    friend Slopes operator*(double s, Slopes d) {
      for (auto& row : d.on)
        for (Entry& entry : row) entry.value *= s;
      return d;
    }
  };

  double circle[3];  // −sgn(rate) ρ of the revolute joints [m]
  double guide;      // −sgn(v) (f + k_r/R)
  double length, middle, half_width;

  Loads value(const Column& r) const {
    Loads q;
    for (int k = 0; k < 3; ++k) q[k] = circle[k] * size(r, k);
    q[3] = guide * bearing_sum(r);
    q[4] = guide * half_width * r[guide_n];
    return q;
  }
  Slopes slope(const Column& r) const {
    Slopes d;
    for (int k = 0; k < 3; ++k) {
      const double force = size(r, k);
      if (force == 0) continue;
      d.on[k][0] = {2 * k, circle[k] * r[2 * k] / force};
      d.on[k][1] = {2 * k + 1, circle[k] * r[2 * k + 1] / force};
    }
    if (at_edges(r)) {
      const int side = sign(moment(r));
      d.on[3][0] = {guide_m, guide * side * 2 / length};
      d.on[3][1] = {guide_n, -guide * side * 2 / length * middle};
    } else {
      d.on[3][0] = {guide_n, guide * sign(r[guide_n])};
    }
    d.on[4][0] = {guide_n, guide * half_width};
    return d;
  }
  static double size(const Column& r, int k) { return std::sqrt(r[2 * k] * r[2 * k] + r[2 * k + 1] * r[2 * k + 1]); }
  double moment(const Column& r) const { return r[guide_m] - middle * r[guide_n]; }  // about the guide's middle
  bool at_edges(const Column& r) const { return length > 0 && 2 * std::abs(moment(r)) > length * std::abs(r[guide_n]); }
  double bearing_sum(const Column& r) const {
    return at_edges(r) ? 2 * std::abs(moment(r)) / length : std::abs(r[guide_n]);
  }
  bool none() const { return circle[0] == 0 && circle[1] == 0 && circle[2] == 0 && guide == 0; }
};

SliderCrankStatics::Law SliderCrankStatics::law_at(const CrankState& state) const {
  const int direction = state.direction != 0 ? state.direction : sign(state.omega);
  const Rates unit = rates(state.phi, direction);  // for the signs, also at standstill
  const double speed = std::abs(state.omega);
  const auto coefficient = [&](const FrictionCoefficient& f, double sliding_speed) {
    return state.at_rest ? f.resting : f.in_motion(sliding_speed);
  };
  const auto revolute = [&](const RevoluteJoint& joint, double rate) {
    return -sign(rate) * friction_circle_radius(joint.radius, coefficient(joint.friction, rate * speed * joint.radius));
  };
  const SliderGuide& g = joints_.guide;
  Law law{};
  law.circle[0] = revolute(joints_.main_bearing, unit.main_bearing);
  law.circle[1] = revolute(joints_.crank_pin, unit.crank_pin);
  law.circle[2] = revolute(joints_.slider_pin, unit.slider_pin);
  law.guide = -sign(unit.slider) * (coefficient(g.friction, unit.slider * speed) +
                                    (g.rolling_arm > 0 ? g.rolling_arm / g.roller_radius : 0.0));
  law.length = g.length;
  law.middle = g.middle;
  law.half_width = 0.5 * g.width;
  return law;
}

namespace {

// LU of a matrix of the frictions, with partial pivoting: of a size that the compiler unrolls.
class FrictionLu {
 public:
  static constexpr int n = SliderCrankStatics::frictions;
  using Matrix = Eigen::Matrix<double, n, n>;
  using Vector = Eigen::Matrix<double, n, 1>;

  FrictionLu() : FrictionLu(Matrix::Identity()) {}
  explicit FrictionLu(const Matrix& matrix) : lu_(matrix) {
    for (int k = 0; k < n; ++k) {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (std::abs(lu_(i, k)) > std::abs(lu_(pivot, k))) pivot = i;
      row_[k] = pivot;
      if (pivot != k) {
        for (int j = 0; j < n; ++j) std::swap(lu_(k, j), lu_(pivot, j));
        determinant_ = -determinant_;
      }
      determinant_ *= lu_(k, k);
      if (lu_(k, k) == 0) continue;
      for (int i = k + 1; i < n; ++i) {
        const double factor = lu_(i, k) /= lu_(k, k);
        for (int j = k + 1; j < n; ++j) lu_(i, j) -= factor * lu_(k, j);
      }
    }
  }
  double determinant() const { return determinant_; }
  Vector solve(Vector x) const {
    for (int k = 0; k < n; ++k) std::swap(x[k], x[row_[k]]);
    for (int k = 0; k < n; ++k)
      for (int i = k + 1; i < n; ++i) x[i] -= lu_(i, k) * x[k];
    for (int k = n; k-- > 0;) {
      for (int j = k + 1; j < n; ++j) x[k] -= lu_(k, j) * x[j];
      x[k] /= lu_(k, k);
    }
    return x;
  }

 private:
  Matrix lu_;
  int row_[n];
  double determinant_ = 1;
};

}  // namespace

struct SliderCrankStatics::Solution {
  Law::Loads q = Law::Loads::Zero();
  Law::Slopes law_slope = {};
  FrictionLu lu;  // of 1 − ∂law/∂q
  bool both_edges = false;
  double residual = 0;
  int iterations = 0;
};

// q = s · law(base + U q), led from s = 0 to 1. The solution wanted is the one that hangs together with the
// frictionless one: along it the determinant of 1 − s ∂law/∂q keeps its sign; where it would vanish the joints jam.
SliderCrankStatics::Solution SliderCrankStatics::solve_friction(const Table& unit, const Column& base, const Law& law,
                                                                double phi, const Solution* near) const {
  Solution solution;
  if (law.none()) return solution;
  const Eigen::Matrix<double, reactions, frictions> loads = unit.rightCols<frictions>();
  // Newton at one share; false where it does not converge to the branch wanted.
  const auto newton = [&](double s, Solution& at) {
    double last = HUGE_VAL;
    Law::Loads before = at.q;
    for (int i = 0; i < 40; ++i) {
      const Column r = base + loads * at.q;
      const Law::Loads wanted = s * law.value(r);
      const Law::Loads error = at.q - wanted;
      const double scale = std::max(wanted.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
      const double residual = error.cwiseAbs().maxCoeff() / scale;
      if (!std::isfinite(residual)) return false;
      // At the rounding floor a step no longer helps.
      if (last < 1e-12 && residual >= last) {
        at.q = before;
        return at.lu.determinant() > 0;
      }
      ++at.iterations;
      at.residual = residual;
      at.both_edges = law.at_edges(r);
      at.law_slope = s * law.slope(r);
      at.lu = FrictionLu(FrictionLu::Matrix::Identity() - at.law_slope * loads);
      if (!std::isfinite(at.lu.determinant())) return false;
      if (residual <= 4e-15) return at.lu.determinant() > 0;
      if (at.lu.determinant() == 0) return false;
      before = at.q;
      last = residual;
      at.q -= at.lu.solve(error);
    }
    return false;
  };
  if (near) {
    solution = *near;
    solution.iterations = 0;
    if (newton(1, solution)) return solution;
    solution = {};
  }
  double share = 0, step = 1;
  constexpr double least_step = 1.0 / 4096;
  while (share < 1) {
    const double next = std::min(1.0, share + step);
    Solution trial = solution;
    if (newton(next, trial)) {
      solution = trial;
      share = next;
      step *= 2;
      continue;
    }
    solution.iterations = trial.iterations;
    step /= 2;
    if (step < least_step)
      throw Jam(
          fmt::format("slider-crank: its joints jam at phi = {:.6g} deg: from {:.3g} % of the given friction on no "
                      "finite reactions satisfy the friction laws; lower the coefficients, lengthen the rod, or "
                      "lengthen the guide",
                      phi * 180 / std::acos(-1.0), 100 * share));
  }
  return solution;
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
  const Position p(data_, geometry_, state.phi);
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

// --- second problem ---

// dq/dε = (1 − ∂law/∂q)⁻¹ (∂law/∂R) R_ε.
SliderCrankStatics::FrictionTorque SliderCrankStatics::torque_of(const Table& unit, const Solution& solution) const {
  const auto row = unit.rightCols<frictions>().row(torque_m);
  const Law::Loads dq = solution.lu.solve(solution.law_slope * unit.col(acceleration_case));
  return {row.dot(solution.q), row.dot(dq)};
}

// The position and speed asked about last, and what was found there.
struct SliderCrankStatics::Memory::Content {
  CrankState state;
  Table unit;
  Law law;
  bool any = false, solved = false;
  Solution solution;
  FrictionTorque torque;

  bool is_of(const CrankState& s) const {
    return any && state.phi == s.phi && state.omega == s.omega && state.direction == s.direction &&
           state.at_rest == s.at_rest;
  }
};
SliderCrankStatics::Memory::Memory() : content_(std::make_unique<Content>()) {}
SliderCrankStatics::Memory::~Memory() = default;
SliderCrankStatics::Memory::Memory(Memory&&) noexcept = default;
void SliderCrankStatics::Memory::forget() { content_->any = false; }

SliderCrankStatics::FrictionTorque SliderCrankStatics::friction_torque(const CrankState& state) const {
  const Table unit = unit_cases(state.phi);
  return torque_of(unit, solve_friction(unit, load_column(unit, state), law_at(state), state.phi));
}

SliderCrankStatics::FrictionTorque SliderCrankStatics::friction_torque(const CrankState& state, Memory& memory) const {
  Memory::Content& last = *memory.content_;
  if (!last.is_of(state)) {
    last.unit = unit_cases(state.phi);
    last.law = law_at(state);
    last.solved = false;
    last.any = true;
  } else if (last.solved && last.state.alpha == state.alpha && last.state.slider_force == state.slider_force) {
    return last.torque;
  }
  last.state = state;
  const Solution* near = last.solved ? &last.solution : nullptr;
  last.solved = false;  // until it is: a jam throws
  last.solution = solve_friction(last.unit, load_column(last.unit, state), last.law, state.phi, near);
  last.solved = true;
  return last.torque = torque_of(last.unit, last.solution);
}

double SliderCrankStatics::acceleration(CrankState state, double torque, double shaft_inertia) const {
  const Table unit = unit_cases(state.phi);
  const Law law = law_at(state);
  const double inertia = unit(torque_m, acceleration_case) + shaft_inertia;
  if (!(inertia > 0))
    throw std::invalid_argument(
        fmt::format("slider-crank: reduced inertia at phi = {:g} rad is {:g} kg m2 with the shaft's {:g}; must be > 0 "
                    "for a torque to accelerate it: give crank or slider a mass",
                    state.phi, inertia, shaft_inertia));
  const auto excess = [&](double alpha, double& slope) {  // M(ε) + J ε − torque
    state.alpha = alpha;
    const FrictionTorque friction = torque_of(unit, solve_friction(unit, load_column(unit, state), law, state.phi));
    slope = inertia + friction.slope;
    return load_column(unit, state)[torque_m] + friction.torque + shaft_inertia * alpha - torque;
  };
  state.alpha = 0;
  double alpha = (torque - load_column(unit, state)[torque_m]) / inertia;  // frictionless
  double low = -HUGE_VAL, high = HUGE_VAL, slope = 0;
  for (int i = 0; i < 200; ++i) {
    const double error = excess(alpha, slope);
    (error < 0 ? low : high) = alpha;
    if (error == 0) return alpha;
    double next = alpha - error / slope;
    // Newton's step where the slope is that of an inertia and leads into the bracket; else the bracket's middle.
    if (!(slope > 0) || !(next > low && next < high)) {
      if (!std::isfinite(low) || !std::isfinite(high))
        next = alpha - 2 * error / inertia;
      else
        next = 0.5 * (low + high);
    }
    if (std::abs(next - alpha) <= 4e-16 * std::abs(next) || high - low <= 4e-16 * std::abs(alpha)) return next;
    alpha = next;
  }
  return alpha;
}

SliderCrankStatics::Range SliderCrankStatics::resting_torque(double phi, double slider_force) const {
  const auto limit = [&](int direction) {
    try {
      return solve({.phi = phi, .slider_force = slider_force, .direction = direction, .at_rest = true}).torque;
    } catch (const std::runtime_error&) {  // locks itself
      return direction * HUGE_VAL;
    }
  };
  return {limit(-1), limit(1)};
}

}  // namespace kurbel
