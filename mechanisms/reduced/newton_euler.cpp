// newton_euler.cpp — the equations of all links at once, and what follows from their solution.
#include "mechanisms/reduced/newton_euler.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

#include "mechanisms/reduced/crank_cycle.h"

namespace kurbel {
namespace {

using Real = long double;
constexpr int most = 3 * PlanarLinkage::most_bodies;
enum Case : int { speed_case, acceleration_case, weight_case, load_case, applied_case, cases };
using CaseMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most, most>;
using Columns = Eigen::Matrix<Real, Eigen::Dynamic, cases, Eigen::RowMajor, most, cases>;
using RightSides = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using CaseColumn = Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, most, 1>;

using Vector = Planar<Real>;
Vector at(const Path& p) { return {p.x.value(), p.y.value()}; }
Force2 rounded(Vector v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }
double rounded(Real v) { return static_cast<double>(v); }

const char* name_in(const PlanarLinkage& l, int body) {
  return body == PlanarLinkage::frame ? "frame" : l.bodies[body].name;
}

// The two unknowns of a joint act along these; a slide's second is a moment.
Vector first_direction(const PlanarLinkage::Joint& j) {
  return j.slides ? Vector{-j.along.sin.value(), j.along.cos.value()} : Vector{1, 0};
}

// Gauss' elimination with pivots by rows, which passes over zeros: a link's equations hold the unknowns of its own joints
// alone.
class Elimination {
 public:
  explicit Elimination(const CaseMatrix& matrix) : n_(static_cast<int>(matrix.rows())), lu_(matrix) {
    for (int k = 0; k < n_; ++k) {
      int pivot = k;
      for (int i = k + 1; i < n_; ++i)
        if (std::fabs(lu_(i, k)) > std::fabs(lu_(pivot, k))) pivot = i;
      pivot_[at(k)] = pivot;
      if (pivot != k) lu_.row(pivot).swap(lu_.row(k));
      std::array<int, most> filled;
      int count = 0;
      for (int j = k + 1; j < n_; ++j)
        if (lu_(k, j) != 0) filled[at(count++)] = j;
      for (int i = k + 1; i < n_; ++i) {
        if (lu_(i, k) == 0) continue;
        const Real part = lu_(i, k) /= lu_(k, k);
        for (int j = 0; j < count; ++j) lu_(i, filled[at(j)]) -= part * lu_(k, filled[at(j)]);
      }
    }
  }
  template <class Right>
  Right solve(Right x) const {
    for (int k = 0; k < n_; ++k)
      if (pivot_[at(k)] != k) x.row(pivot_[at(k)]).swap(x.row(k));
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < i; ++j)
        if (lu_(i, j) != 0) x.row(i) -= lu_(i, j) * x.row(j);
    for (int i = n_; i-- > 0;) {
      for (int j = i + 1; j < n_; ++j)
        if (lu_(i, j) != 0) x.row(i) -= lu_(i, j) * x.row(j);
      x.row(i) /= lu_(i, i);
    }
    return x;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int n_;
  CaseMatrix lu_;
  std::array<int, most> pivot_{};
};

class Equations {
 public:
  Equations(const PlanarLinkage& l, const std::vector<AppliedForce>& applied)
      : l_(l),
        n_(3 * l.body_count),
        length_(std::hypot(l.joints[1].at.x.value(), l.joints[1].at.y.value())),
        matrix_(CaseMatrix::Zero(n_, n_)),
        right_(Columns::Zero(n_, cases)) {
    for (int k = 0; k < l.joint_count; ++k) put(k);
    matrix_(2, n_ - 1) = 1;  // the balancing torque, on the crank
    for (int i = 0; i < l.body_count; ++i) load(i);
    put(applied, applied_case, right_);
  }
  // Forces [N] and moments over length() [N].
  Columns solve() const { return solve(right_); }
  template <class Right>
  Right solve(const Right& right) const {
    const Elimination factors(matrix_);
    Right x = factors.solve(right), left = right;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j)
        if (matrix_(i, j) != 0) left.row(i) -= matrix_(i, j) * x.row(j);
    return x + factors.solve(left);
  }
  // The four cases, behind them each of what else is applied, and a unit of each friction load.
  RightSides with_units(std::span<const FrictionPlace> friction,
                        std::span<const std::vector<AppliedForce>> applied) const {
    Eigen::Index column = applied_case;
    RightSides right = RightSides::Zero(n_, column + static_cast<Eigen::Index>(applied.size() + friction.size()));
    right.leftCols(column) = right_.leftCols(column);
    for (const std::vector<AppliedForce>& unit : applied) put(unit, column++, right);
    for (const FrictionPlace& unit : friction) {
      const PlanarLinkage::Joint& j = l_.joints[static_cast<std::size_t>(unit.joint)];
      const Vector along{j.along.cos.value(), j.along.sin.value()};
      for (const auto& [body, sense] : {std::pair{j.on, Real(1)}, std::pair{j.from, Real(-1)}})
        if (body != PlanarLinkage::frame)
          put(body, at(j.at), unit.couple ? Vector{} : sense * along, unit.couple ? sense : 0, column, right);
      ++column;
    }
    return right;
  }
  // Of the equations for one mixture of the cases, relative to their largest term.
  double residual(const CaseColumn& solution, const Eigen::Matrix<Real, cases, 1>& mixture) const {
    Real largest = 0, most_left = 0;
    for (int i = 0; i < n_; ++i) {
      Real left = 0;
      const auto add = [&](Real term) { left += term, largest = std::max(largest, std::fabs(term)); };
      for (int k = 0; k < n_; ++k) add(matrix_(i, k) * solution(k));
      for (int k = 0; k < cases; ++k) add(-right_(i, k) * mixture(k));
      most_left = std::max(most_left, std::fabs(left));
    }
    return largest > 0 ? rounded(most_left / largest) : 0.0;
  }
  Real length() const { return length_; }  // the crank's: of moments' rows and unknowns

 private:
  // What acts on a body, on the right side.
  template <class Right>
  void put(int body, Vector place, Vector force, Real moment, Eigen::Index column, Right& right) const {
    const Vector com = at(l_.bodies[static_cast<std::size_t>(body)].com);
    right(3 * body, column) -= force.x, right(3 * body + 1, column) -= force.y;
    right(3 * body + 2, column) -= (cross({place.x - com.x, place.y - com.y}, force) + moment) / length_;
  }
  template <class Right>
  void put(const std::vector<AppliedForce>& applied, Eigen::Index column, Right& right) const {
    for (const AppliedForce& a : applied)
      put(a.body, {a.at.x, a.at.y}, {a.force.x, a.force.y}, a.moment, column, right);
  }
  void act(int body, int column, Vector place, Vector along, Real sense) {
    if (body == PlanarLinkage::frame) return;
    const Vector com = at(l_.bodies[body].com);
    matrix_(3 * body, column) += sense * along.x;
    matrix_(3 * body + 1, column) += sense * along.y;
    matrix_(3 * body + 2, column) += sense * cross({place.x - com.x, place.y - com.y}, along) / length_;
  }
  void put(int k) {
    const PlanarLinkage::Joint& j = l_.joints[k];
    for (const auto& [body, sense] : {std::pair{j.on, Real(1)}, std::pair{j.from, Real(-1)}}) {
      act(body, 2 * k, at(j.at), first_direction(j), sense);
      if (!j.slides)
        act(body, 2 * k + 1, at(j.at), {0, 1}, sense);
      else if (body != PlanarLinkage::frame)
        matrix_(3 * body + 2, 2 * k + 1) += sense;
    }
  }
  // Reactions = m a − W − F.
  void load(int i) {
    const PlanarLinkage::Body& b = l_.bodies[i];
    const Taylor rate = b.direction.rate();
    const Real m = b.mass, down = -m * l_.gravity, elevation = l_.elevation;
    const auto row = [&](int k, Real velocity, Real acceleration, Real weight) {
      right_(3 * i + k, speed_case) = velocity;
      right_(3 * i + k, acceleration_case) = acceleration;
      right_(3 * i + k, weight_case) = -weight;
    };
    row(0, m * b.com.x.curvature(), m * b.com.x.slope(), down * std::sin(elevation));
    row(1, m * b.com.y.curvature(), m * b.com.y.slope(), down * std::cos(elevation));
    row(2, b.inertia * rate.slope() / length_, b.inertia * rate.value() / length_, 0);
    if (i + 1 < l_.body_count) return;
    if (l_.rocks) {
      right_(3 * i + 2, load_case) = -1 / length_;
    } else {
      const Vector place = at(l_.load_at), com = at(b.com);
      right_(3 * i, load_case) = -1;
      right_(3 * i + 2, load_case) = (place.y - com.y) / length_;
    }
  }

  const PlanarLinkage& l_;
  int n_;
  Real length_;
  CaseMatrix matrix_;
  Columns right_;
};

void add_link(const PlanarLinkage::Body& b, LinkageForces& f) {
  const Real w = f.state.omega, a = f.state.alpha, m = b.mass;
  const Taylor rate = b.direction.rate();
  const Vector acceleration = {b.com.x.curvature() * w * w + b.com.x.slope() * a,
                               b.com.y.curvature() * w * w + b.com.y.slope() * a};
  const Real turning = rate.slope() * w * w + rate.value() * a;
  const Vector force = -m * acceleration;
  const Real couple = -b.inertia * turning, vx = b.com.x.slope(), vy = b.com.y.slope();
  const Real inertia = m * (vx * vx + vy * vy) + b.inertia * rate.value() * rate.value();
  const Real slope =
      2 * (m * (vx * b.com.x.curvature() + vy * b.com.y.curvature()) + b.inertia * rate.value() * rate.slope());
  f.links.push_back({.name = b.name,
                     .direction = rounded(b.direction.angle()),
                     .com = rounded(at(b.com)),
                     .acceleration = rounded(acceleration),
                     .omega = rounded(rate.value() * w),
                     .alpha = rounded(turning),
                     .inertia_force = rounded(force),
                     .inertia_couple = rounded(couple),
                     .reduced_inertia = rounded(inertia),
                     .reduced_inertia_rate = rounded(slope),
                     .kinetic_energy = rounded(inertia * w * w / 2)});
  f.shaking_force = f.shaking_force + rounded(force);
  f.shaking_moment += rounded(cross(at(b.com), force) + couple);
  f.reduced_inertia += rounded(inertia);
  f.kinetic_energy += rounded(inertia * w * w / 2);
  f.kinetic_rate += rounded((inertia * a + slope * w * w / 2) * w);
}

}  // namespace

double LinkageForces::friction_loss() const {
  double loss = 0;
  for (const JointForces& j : joints) loss += j.friction_power;
  return loss;
}

double LinkageForces::friction_loss(std::string_view joint) const {
  double loss = 0;
  for (const JointForces& j : joints)
    if (j.name == joint) loss += j.friction_power;
  return loss;
}

LinkageForces motion_in(const PlanarLinkage& l, const LinkageState& state) {
  LinkageForces f;
  f.state = state;
  const Real w = state.omega;
  f.output = rounded(l.output[0]);
  f.output_velocity = rounded(l.output[1] * w);
  for (int i = 0; i < l.body_count; ++i) add_link(l.bodies[i], f);
  return f;
}

namespace {

void add_reactions(const PlanarLinkage& l, LinkageForces& f) {
  const LinkageState& state = f.state;
  const Equations equations(l, state.applied);
  const Columns unit = equations.solve();
  const Real w = state.omega;
  const Eigen::Matrix<Real, cases, 1> mixture(w * w, Real(state.alpha), Real(1), Real(state.load), Real(1));
  const CaseColumn x = unit * mixture;
  if (!x.allFinite())
    throw std::runtime_error(
        fmt::format("no finite reactions at phi = {:.17g} rad: the crank cannot move the mechanism there", state.phi));
  for (int k = 0; k < l.joint_count; ++k) {
    const PlanarLinkage::Joint& j = l.joints[k];
    JointForces out;
    out.name = j.name;
    out.from = name_in(l, j.from), out.on = name_in(l, j.on);
    out.slides = j.slides;
    out.at = rounded(at(j.at));
    const Vector first = first_direction(j);
    if (j.slides) {
      out.along = rounded(j.along.angle());
      out.normal = rounded(x(2 * k));
      out.force = rounded(Vector{first.x * x(2 * k), first.y * x(2 * k)});
      out.moment = rounded(x(2 * k + 1) * equations.length());
    } else {
      out.force = rounded(Vector{x(2 * k), x(2 * k + 1)});
    }
    f.joints.push_back(std::move(out));
  }
  f.torque = rounded(x(3 * l.body_count - 1) * equations.length());
  f.residual = equations.residual(x, mixture);
}

}  // namespace

LinkageForces forces_in(const PlanarLinkage& l, const LinkageState& state) {
  const int superfluous = 2 * l.joint_count + 1 - 3 * l.body_count;
  if (superfluous < 0) throw std::logic_error("newton_euler: not one degree of freedom");
  LinkageForces f = motion_in(l, state);
  if (superfluous == 0) add_reactions(l, f);
  const Real w = state.omega;
  const Real elevation = l.elevation, up_x = std::sin(elevation), up_y = std::cos(elevation);
  for (int i = 0; i < l.body_count; ++i) {
    const PlanarLinkage::Body& b = l.bodies[i];
    f.weight_power -= rounded(b.mass * l.gravity * w * (up_x * b.com.x.slope() + up_y * b.com.y.slope()));
  }
  f.load_power = state.load * f.output_velocity;
  for (const AppliedForce& a : state.applied) {
    const PlanarLinkage::Body& b = l.bodies[a.body];
    const Real turning = b.direction.rate().value();
    const Vector com = at(b.com);
    const Real vx = b.com.x.slope() - turning * (a.at.y - com.y), vy = b.com.y.slope() + turning * (a.at.x - com.x);
    f.load_power += rounded(w * (a.force.x * vx + a.force.y * vy + a.moment * turning));
  }
  if (superfluous > 0) f.torque = (f.kinetic_rate - f.weight_power - f.load_power) / state.omega;
  return f;
}

std::vector<std::vector<long double>> unit_reactions(const PlanarLinkage& l, std::span<const FrictionPlace> friction,
                                                     std::span<const std::vector<AppliedForce>> applied) {
  const Equations equations(l, {});
  const RightSides unit = equations.solve(equations.with_units(friction, applied));
  std::vector<std::vector<long double>> columns(static_cast<std::size_t>(unit.cols()));
  for (Eigen::Index c = 0; c < unit.cols(); ++c) {
    std::vector<long double>& column = columns[static_cast<std::size_t>(c)];
    for (int k = 0; k < l.joint_count; ++k) {
      column.push_back(unit(2 * k, c));
      const Real second = unit(2 * k + 1, c);
      column.push_back(l.joints[static_cast<std::size_t>(k)].slides ? second * equations.length() : second);
    }
    column.push_back(unit(unit.rows() - 1, c) * equations.length());
  }
  return columns;
}

PlanarLinkage linkage_beside(const MechanismData& data, double& phi) {
  constexpr double least = 1e-3;  // of the sine
  PlanarLinkage there = data.linkage(phi);
  const long double here = there.sine;
  if (std::abs(here) >= least) return there;
  // The sine has a simple zero: two secants lead to the place.
  const long double wanted = std::copysign(least, here);
  for (int i = 0; i < 3; ++i) {
    const long double sine = data.linkage(phi).sine, slope = (data.linkage(phi + 1e-5).sine - sine) / 1e-5L;
    phi += static_cast<double>((wanted - sine) / slope);
  }
  return data.linkage(phi);
}

UnboundedReactions unbounded_reactions(const MechanismData& data,
                                       const std::function<LinkageState(double phi)>& state_at) {
  constexpr double far = 1e-2, near = 1e-3, grown = 5;
  UnboundedReactions found{.at = {}, .of_joint = {}, .beside = far, .greatest = 0, .words = {}};
  std::string places, forces;
  const CrankCycle cycle(data);
  for (const double phi : cycle.change_points()) {
    const auto at = [&](double beside) {
      LinkageState state = state_at(phi);
      state.phi = phi + beside;
      return forces_in(data.linkage(state.phi), state);
    };
    const LinkageForces there = at(far), nearer = at(near);
    found.of_joint.resize(there.joints.size(), false);
    std::string grow;
    for (std::size_t k = 0; k < there.joints.size(); ++k) {
      const double before = there.joints[k].force.magnitude(), now = nearer.joints[k].force.magnitude();
      if (now <= grown * before) continue;
      grow += fmt::format("{}{} {:.4g} N and {:.4g} N", grow.empty() ? "" : ", ", there.joints[k].name, before, now);
      found.of_joint[k] = true;
      found.greatest = std::max(found.greatest, before);
    }
    if (grow.empty()) continue;
    found.at.push_back(phi);
    const std::string angle = fmt::format("{:.6g}°", phi * 180 / std::numbers::pi);
    places += (places.empty() ? "" : ", ") + angle;
    forces += fmt::format("{}{}: {}", forces.empty() ? "" : "; ", angle, grow);
  }
  if (found.any())
    found.words = fmt::format(
        "at the change point{} φ = {} reactions have no bound: they go with the inverse of the distance "
        "({:.3g} rad and {:.3g} rad beside {}); positions nearer to it than that have the values there",
        found.at.size() > 1 ? "s" : "", places, far, near, forces);
  return found;
}

}  // namespace kurbel
