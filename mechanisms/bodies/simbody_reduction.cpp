// simbody_reduction.cpp — reduced inertia and its derivatives from Simbody's constraint and mass matrices.
#include "mechanisms/bodies/simbody_reduction.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace kurbel {

using SimTK::Matrix;
using SimTK::MobilizedBody;
using SimTK::MobilizedBodyIndex;
using SimTK::SpatialVec;
using SimTK::Stage;
using SimTK::State;
using SimTK::Vec3;
using SimTK::Vector;
using SimTK::Vector_;

namespace {

template <class T>
Planar<T> rotated(T angle, Planar<double> a) {
  const T c = std::cos(angle), s = std::sin(angle);
  return {c * T(a.x) - s * T(a.y), s * T(a.x) + c * T(a.y)};
}

template <class V>
Planar<double> planar(const V& v) {
  return {v[0], v[1]};
}

// First, second and third derivative of a vector a that turns with a body.
Planar<double> turn1(const BodyMotion& b, Planar<double> a) { return b.w * left(a); }
Planar<double> turn2(const BodyMotion& b, Planar<double> a) { return b.alpha * left(a) - (b.w * b.w) * a; }
Planar<double> turn3(const BodyMotion& b, Planar<double> a) {
  return (b.zeta - b.w * b.w * b.w) * left(a) - (3 * b.w * b.alpha) * a;
}

// A body frame's angle in the plane. Throws if the frame is tipped out of it.
double plane_angle(const SimTK::Rotation& rotation) {
  if (std::fabs(rotation[2][2] - 1) > 1e-14) throw std::logic_error("simbody_reduction: a joint axis is not along z");
  return std::atan2(rotation[1][0], rotation[0][0]);
}

}  // namespace

SimbodyReduction::SimbodyReduction(const SimTK::MultibodySystem& system, const SimTK::SimbodyMatterSubsystem& matter,
                                   int coordinate, std::vector<TrackedPoint> points, bool redundant)
    : system_(system), matter_(matter), coordinate_(coordinate), points_(std::move(points)) {
  read_joints();
  read_closures();
  // One coordinate a joint; the ground is no joint.
  if (redundant ? closures_.size() + 2 < joints_.size() : closures_.size() + 2 != joints_.size())
    throw std::logic_error("simbody_reduction: the mechanism must have one degree of freedom and no redundant closure");
}

void SimbodyReduction::read_joints() {
  const State& state = system_.getDefaultState();
  joints_.push_back({-1, false, {}, {}, 0, -1});
  for (MobilizedBodyIndex k(1); k < matter_.getNumBodies(); ++k) {
    const MobilizedBody& body = matter_.getMobilizedBody(k);
    const bool slides = MobilizedBody::Slider::isInstanceOf(body);
    if (!slides && !MobilizedBody::Pin::isInstanceOf(body))
      throw std::logic_error("simbody_reduction: only Pin and Slider mobilizers are known");
    const SimTK::Transform& inboard = body.getDefaultInboardFrame();
    const SimTK::Transform& outboard = body.getDefaultOutboardFrame();
    if (plane_angle(outboard.R()) != 0) throw std::logic_error("simbody_reduction: an outboard frame is turned");
    joints_.push_back({int(body.getParentMobilizedBody().getMobilizedBodyIndex()), slides, planar(inboard.p()),
                       planar(outboard.p()), plane_angle(inboard.R()), int(body.getFirstQIndex(state))});
    size_ += length(joints_.back().in_parent) + length(joints_.back().in_body);
  }
}

void SimbodyReduction::read_closures() {
  for (SimTK::ConstraintIndex k(0); k < matter_.getNumConstraints(); ++k) {
    const SimTK::Constraint& constraint = matter_.getConstraint(k);
    if (!SimTK::Constraint::PointInPlane::isInstanceOf(constraint))
      throw std::logic_error("simbody_reduction: only PointInPlane constraints are known");
    const auto& plane = SimTK::Constraint::PointInPlane::downcast(constraint);
    closures_.push_back({int(plane.getPlaneMobilizedBodyIndex()), int(plane.getFollowerMobilizedBodyIndex()),
                         planar(plane.getDefaultPlaneNormal()), planar(plane.getDefaultFollowerPoint()),
                         plane.getDefaultPlaneHeight()});
    size_ += length(closures_.back().follower) + std::fabs(closures_.back().height);
  }
}

// n·(follower − plane's origin) − height of every closure, by forward kinematics.
SimbodyReduction::Extended SimbodyReduction::closure_errors(const Extended& q) const {
  std::vector<long double> angle(joints_.size());
  std::vector<Planar<long double>> origin(joints_.size());
  for (std::size_t k = 1; k < joints_.size(); ++k) {
    const Joint& joint = joints_[k];
    const auto parent = std::size_t(joint.parent);
    const long double inboard = angle[parent] + joint.tilt;
    angle[k] = joint.slides ? inboard : inboard + q[joint.q];
    origin[k] = origin[parent] + rotated(angle[parent], joint.in_parent) - rotated(angle[k], joint.in_body);
    if (joint.slides) origin[k] = origin[k] + q[joint.q] * rotated(inboard, {1, 0});
  }
  Extended errors(Eigen::Index(closures_.size()));
  for (std::size_t i = 0; i < closures_.size(); ++i) {
    const auto plane = std::size_t(closures_[i].plane_body), body = std::size_t(closures_[i].follower_body);
    const Planar<long double> follower = origin[body] + rotated(angle[body], closures_[i].follower);
    errors[Eigen::Index(i)] =
        dot(rotated(angle[plane], closures_[i].normal), follower - origin[plane]) - closures_[i].height;
  }
  return errors;
}

void SimbodyReduction::close(State& state) const {
  const int n = state.getNQ();
  Extended q(n);
  for (int j = 0; j < n; ++j) q[j] = state.getQ()[j];

  long double step = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    // Differences serve as derivatives: in extended precision they are good to ten digits, ample for Newton's method.
    const long double difference = 1e-9L;
    const Extended errors = closure_errors(q);
    Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> derivative(errors.size(), n - 1);
    for (int j = 0; j < n - 1; ++j) {
      Extended moved = q;
      moved[dependent(j)] += difference;
      derivative.col(j) = (closure_errors(moved) - errors) / difference;
    }
    const bool square = derivative.rows() == derivative.cols();
    const Extended correction = square ? Extended(derivative.partialPivLu().solve(-errors))
                                       : Extended(derivative.colPivHouseholderQr().solve(-errors));
    for (int j = 0; j < n - 1; ++j) q[dependent(j)] += correction[j];

    step = correction.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(step)) break;
    if (step <= SimTK::Eps * std::fmax(1.0L, q.lpNorm<Eigen::Infinity>())) {  // what is left is far less
      for (int j = 0; j < n; ++j) state.updQ()[j] = double(q[j]);
      return;
    }
  }
  throw std::runtime_error(fmt::format("loop closure does not converge at phi = {:.17g} rad: last Newton step {:.3g}",
                                       state.getQ()[coordinate_], double(step)));
}

// Simbody's velocity and acceleration ratios of all bodies, and the jerk ratios that they alone cause (d³q/dφ³ = 0).
std::vector<BodyMotion> SimbodyReduction::motion_without_q3(const State& state, const Vector& q2,
                                                            const Vector_<SpatialVec>& a) const {
  std::vector<BodyMotion> motion(joints_.size());
  for (std::size_t k = 1; k < joints_.size(); ++k) {
    const Joint& joint = joints_[k];
    const MobilizedBody& body = matter_.getMobilizedBody(MobilizedBodyIndex(int(k)));
    const SimTK::Rotation& frame = body.getBodyRotation(state);
    const SimTK::Rotation& parent_frame = body.getParentMobilizedBody().getBodyRotation(state);
    const BodyMotion& parent = motion[std::size_t(joint.parent)];
    BodyMotion& b = motion[k];
    b.v = planar(body.getBodyOriginVelocity(state)), b.a = planar(a[int(k)][1]);
    b.w = body.getBodyAngularVelocity(state)[2], b.alpha = a[int(k)][0][2];

    // origin = parent's origin + arm + s d − heel, where arm and d turn with the parent and heel with the body.
    const Planar<double> arm = planar(parent_frame * Vec3(joint.in_parent.x, joint.in_parent.y, 0));
    const Planar<double> heel = planar(frame * Vec3(joint.in_body.x, joint.in_body.y, 0));
    b.j = parent.j + turn3(parent, arm) - turn3(b, heel);
    if (joint.slides) {
      const Planar<double> d = planar(frame * Vec3(1, 0, 0));
      const double s = state.getQ()[joint.q], s1 = state.getU()[joint.q], s2 = q2[joint.q];
      b.j = b.j + s * turn3(parent, d) + (3 * s1) * turn2(parent, d) + (3 * s2) * turn1(parent, d);
    }
  }
  return motion;
}

// Third derivative of every closure error for d³q/dφ³ = 0, by Leibniz's rule on n·(follower − plane's origin).
Vector SimbodyReduction::closure_jerks(const State& state, const std::vector<BodyMotion>& motion) const {
  Vector jerks(int(closures_.size()));
  for (int i = 0; i < jerks.size(); ++i) {
    const Closure& c = closures_[std::size_t(i)];
    const MobilizedBody& plane_body = matter_.getMobilizedBody(MobilizedBodyIndex(c.plane_body));
    const MobilizedBody& follower_body = matter_.getMobilizedBody(MobilizedBodyIndex(c.follower_body));
    const BodyMotion& p = motion[std::size_t(c.plane_body)];
    const BodyMotion& f = motion[std::size_t(c.follower_body)];
    const Planar<double> n = planar(plane_body.getBodyRotation(state) * Vec3(c.normal.x, c.normal.y, 0));
    const Planar<double> arm = planar(follower_body.getBodyRotation(state) * Vec3(c.follower.x, c.follower.y, 0));

    const Planar<double> d =
        planar(follower_body.getBodyOriginLocation(state)) + arm - planar(plane_body.getBodyOriginLocation(state));
    const Planar<double> d1 = f.v + turn1(f, arm) - p.v;
    const Planar<double> d2 = f.a + turn2(f, arm) - p.a;
    const Planar<double> d3 = f.j + turn3(f, arm) - p.j;
    jerks[i] = dot(turn3(p, n), d) + 3 * dot(turn2(p, n), d1) + 3 * dot(turn1(p, n), d2) + dot(n, d3);
  }
  return jerks;
}

// I_r″ = 2 Σ [ m (a·a + v·j) + I_S (α² + ω ζ) ], the derivative of theory 2.1 taken twice; jerk: what d³q/dφ³ adds.
double SimbodyReduction::curvature(const State& state, const std::vector<BodyMotion>& motion,
                                   const Vector_<SpatialVec>& jerk) const {
  double sum = 0;
  for (std::size_t k = 1; k < motion.size(); ++k) {
    const MobilizedBody& body = matter_.getMobilizedBody(MobilizedBodyIndex(int(k)));
    const SimTK::MassProperties& mass = body.getBodyMassProperties(state);
    BodyMotion b = motion[k];
    b.j = b.j + planar(jerk[int(k)][1]);
    b.zeta = jerk[int(k)][0][2];
    const Planar<double> com = planar(body.getBodyRotation(state) * mass.getMassCenter());
    const Planar<double> v = b.v + turn1(b, com), a = b.a + turn2(b, com), j = b.j + turn3(b, com);
    const double central = mass.getMass() > 0 ? mass.calcCentralInertia().getMoments()[2] : 0;
    sum += 2 * (mass.getMass() * (dot(a, a) + dot(v, j)) + central * (b.alpha * b.alpha + b.w * b.zeta));
  }
  return sum;
}

// From the bodies' velocities in the state and their accelerations.
std::vector<PointMotion> SimbodyReduction::point_motions(const State& state,
                                                         const Vector_<SpatialVec>& acceleration) const {
  std::vector<PointMotion> points;
  for (const TrackedPoint& point : points_) {
    const MobilizedBody& body = matter_.getMobilizedBody(point.body);
    const Vec3 arm = body.getBodyRotation(state) * point.station;
    const Vec3 w = body.getBodyAngularVelocity(state);
    points.push_back({body.getBodyOriginLocation(state) + arm, body.getBodyOriginVelocity(state) + w % arm,
                      acceleration[point.body][1] + acceleration[point.body][0] % arm + w % (w % arm)});
  }
  return points;
}

// The given solution of G · x + bias = 0, 0 at the reduction coordinate. Throws std::runtime_error where it is none.
Vector SimbodyReduction::kept(const Matrix& g, const Vector& bias, const Vector& given, double phi) const {
  Vector dependent_part = given;
  dependent_part[coordinate_] = 0;
  const double error = (g * dependent_part + bias).normInf(), size = size_ * (1 + std::pow(given.normInf(), 3));
  if (!(error <= 1e-11 * size))
    throw std::runtime_error(
        fmt::format("the closures are left at phi = {:.17g} rad: their derivative by phi is {:.3g} m", phi, error));
  return dependent_part;
}

Reduction SimbodyReduction::reduce(State& state, const KnownDerivatives* known, Upto last) const {
  Reduction result;

  // Position: the loops are closed, and on which branch.
  system_.realize(state, Stage::Position);
  result.closure_error = state.getQErr().normInf();
  if (!(result.closure_error <= 1e-13 * size_))
    throw std::runtime_error(fmt::format("open loop at phi = {:.17g} rad: closure error {:.3g} m of {:.3g} m",
                                         state.getQ()[coordinate_], result.closure_error, size_));
  Matrix g;
  matter_.calcG(state, g);
  Eigen::MatrixXd g_dependent(g.nrow(), g.ncol() - 1);
  for (int i = 0; i < g.nrow(); ++i)
    for (int j = 0; j < g.ncol() - 1; ++j) g_dependent(i, j) = g(i, dependent(j));
  const bool square = g_dependent.rows() == g_dependent.cols();
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> of_redundant;
  if (square) {
    factors.compute(g_dependent);
    result.determinant = factors.determinant();
  } else {
    of_redundant.compute(g_dependent);
    result.determinant = std::fabs(of_redundant.matrixR().diagonal().prod());
  }
  // G · solution + bias = 0 with 0 at the reduction coordinate.
  const auto solve = [&](const Vector& bias, const Vector* given) {
    if (given) return kept(g, bias, *given, state.getQ()[coordinate_]);
    const Eigen::Map<const Eigen::VectorXd> given_bias(&bias[0], bias.size());
    const Eigen::VectorXd solution =
        square ? Eigen::VectorXd(factors.solve(-given_bias)) : Eigen::VectorXd(of_redundant.solve(-given_bias));
    Vector all(g.ncol(), 0.0);
    for (int j = 0; j < g.ncol() - 1; ++j) all[dependent(j)] = solution[j];
    return all;
  };

  // Velocity: G u = 0 with u = 1 at the reduction coordinate; I_r = uᵀ M u.
  result.q1 = solve(Vector(g.col(coordinate_)), known ? &known->q1 : nullptr);
  result.q1[coordinate_] = 1;
  state.updU() = result.q1;
  system_.realize(state, Stage::Velocity);
  Vector momentum;
  matter_.multiplyByM(state, result.q1, momentum);
  result.inertia = ~result.q1 * momentum;
  if (last == Upto::velocity) return result;

  // Acceleration at constant speed: G u̇ + b = 0; the inertia forces then do I_r′ = 2 uᵀ (M u̇ + c), theory 2.4.
  Vector bias, residual;
  matter_.calcBiasForAccelerationConstraints(state, bias);
  result.q2 = solve(bias, known ? &known->q2 : nullptr);
  matter_.calcResidualForceIgnoringConstraints(state, Vector(), Vector_<SpatialVec>(), result.q2, residual);
  result.slope = 2 * (~result.q1 * residual);

  // Jerk at constant speed: G ü + (third derivative of the closures without ü) = 0.
  Vector_<SpatialVec> acceleration, jerk;
  matter_.calcBodyAccelerationFromUDot(state, result.q2, acceleration);
  const std::vector<BodyMotion> motion = motion_without_q3(state, result.q2, acceleration);
  result.q3 = solve(closure_jerks(state, motion), known ? &known->q3 : nullptr);
  matter_.multiplyBySystemJacobian(state, result.q3, jerk);

  result.curvature = curvature(state, motion, jerk);
  result.points = point_motions(state, acceleration);
  return result;
}

}  // namespace kurbel
