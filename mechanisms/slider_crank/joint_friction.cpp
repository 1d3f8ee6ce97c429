// joint_friction.cpp — Newton's method for the slider pin's force with friction, and the derivatives of its torque.
#include "mechanisms/slider_crank/joint_friction.h"
#include "mechanisms/slider_crank/slider_crank_pose.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/dual.h"
#include "mechanisms/slider_crank/slider_crank_friction.h"

namespace kurbel {
namespace {

constexpr double quadratic = 1e-9;  // a step of Newton's method this small leaves its square

template <class T>
T length_of(const PlaneVector<T>& v) {
  using std::sqrt;
  const T squared = v.x * v.x + v.y * v.y;
  return value_of(squared) == 0 ? T(0.0) : sqrt(squared);
}

// Stribeck's coefficient, smooth through a sliding speed of 0.
template <class T>
T coefficient(const FrictionCoefficient& f, const T& sliding, bool at_rest) {
  if (at_rest) return T(f.resting);
  const T moving = f.stribeck_speed > 0 ? stribeck(sliding, f.kinetic, f.resting, f.stribeck_speed) : T(f.kinetic);
  return f.viscous > 0 ? moving + f.viscous * sliding : moving;
}

// Friction circle r sin(atan f) of a joint, against its rate's sign.
template <class T>
T signed_circle(const RevoluteJoint& joint, int direction, const T& rate, bool at_rest) {
  using std::sqrt;
  if (joint.radius == 0 || joint.friction.none()) return T(0.0);
  const T f = coefficient(joint.friction, joint.radius * (direction * rate), at_rest);
  return -direction * joint.radius * f / sqrt(1.0 + f * f);
}

// Forces at one ε.
template <class T>
struct Forces {
  Forces(const FrictionFrame<T>& f, double alpha)
      : pin(f.pin[0] + alpha * f.pin[1]), rod(f.rod[0] + alpha * f.rod[1]), crank(f.crank[0] + alpha * f.crank[1]) {}
  PlaneVector<T> pin, rod, crank;
};

// Loads of the guide at the normal force and the slider pin's friction: what its edges bear, D by their signs.
template <class T>
struct GuideLoads {
  GuideLoads(const SliderGuide& g, const FrictionFrame<T>& f, const T& pin_y, const T& pin_friction,
             const CrankState::Signs& signs) {
    normal = -f.across - pin_y;
    if (g.length > 0) {
      const T off_middle = -(f.moment + pin_friction + f.guide * (0.5 * g.width) * normal) - g.middle * normal;
      edge[0] = g.length * normal - 2.0 * off_middle, edge[1] = g.length * normal + 2.0 * off_middle;
    } else {
      edge[0] = normal, edge[1] = T(0.0);
    }
    for (int k = 0; k < 2; ++k) {
      const int given = signs.edge[static_cast<std::size_t>(k)];
      share[k] = (given != 0 ? given : sign(value_of(edge[k]))) / (g.length > 0 ? 2 * g.length : 1.0);
    }
    if (!(g.length > 0)) share[1] = 0;
    drag = f.guide * (share[0] * edge[0] + share[1] * edge[1]);
  }
  T normal, edge[2], drag;
  double share[2];  // of u and w in ΣN, signed
};

// The two equations at one b: what is left of them, the loads.
template <class T>
struct FrictionLoads {
  FrictionLoads(const SliderGuide& g, const FrictionFrame<T>& f, const Forces<T>& at, const PlaneVector<T>& b,
                const CrankState::Signs& signs)
      : force{b - at.rod - at.crank, b - at.rod, b},
        size{length_of(force[0]), length_of(force[1]), length_of(force[2])},
        torque{f.circle[0] * size[0], f.circle[1] * size[1], f.circle[2] * size[2]},
        guide(g, f, b.y, torque[2], signs),
        left{b.x - at.pin.x + guide.drag,
             b.y - at.pin.y + f.tan_beta * guide.drag - (torque[1] - torque[2]) / f.lever} {}
  T on_crank(const FrictionFrame<T>& f) const {
    return (1.0 - f.beta1) * torque[1] - torque[0] + f.beta1 * torque[2] - f.x1 * guide.drag;
  }
  PlaneVector<T> force[3];
  T size[3], torque[3];
  GuideLoads<T> guide;
  PlaneVector<T> left;
};

using Vector = PlaneVector<double>;
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }

// Derivatives by b.
struct Slopes {
  Slopes(const SliderGuide& g, const FrictionFrame<double>& f, const FrictionLoads<double>& l) {
    for (int k = 0; k < 3; ++k)
      if (l.size[k] > 0) torque[k] = (f.circle[k] / l.size[k]) * l.force[k];
    if (g.length > 0) {
      const Vector off_middle{-torque[2].x, -torque[2].y + f.guide * 0.5 * g.width + g.middle};
      const double difference = 2 * (l.guide.share[1] - l.guide.share[0]);
      drag = {f.guide * difference * off_middle.x,
              f.guide * (difference * off_middle.y - g.length * (l.guide.share[0] + l.guide.share[1]))};
    } else {
      drag.y = -f.guide * (l.guide.share[0] + l.guide.share[1]);
    }
    left[0] = {1 + drag.x, drag.y};
    left[1] = {f.tan_beta * drag.x - (torque[1].x - torque[2].x) / f.lever,
               1 + f.tan_beta * drag.y - (torque[1].y - torque[2].y) / f.lever};
  }
  Vector on_crank(const FrictionFrame<double>& f) const {
    return (1 - f.beta1) * torque[1] - torque[0] + f.beta1 * torque[2] - f.x1 * drag;
  }
  double determinant() const { return left[0].x * left[1].y - left[0].y * left[1].x; }
  Vector torque[3], drag, left[2];
};

Vector apply(const double (&m)[2][2], const Vector& v) {
  return {m[0][0] * v.x + m[0][1] * v.y, m[1][0] * v.x + m[1][1] * v.y};
}

// By the implicit function theorem; M_f is carried on by the last step, whose square is nothing.
void differentiate(const FrictionFrame<double>& f, const FrictionLoads<double>& l, const Slopes& slopes,
                   const Vector& step, FrictionBalance& out) {
  const Vector rod = f.rod[1], bearing = f.rod[1] + f.crank[1], by_pin = slopes.on_crank(f);
  const double q0 = -dot(slopes.torque[0], bearing), q1 = -dot(slopes.torque[1], rod);  // at a constant b
  out.pin_by_alpha = apply(out.inverse, Vector{f.pin[1].x, f.pin[1].y + q1 / f.lever});
  out.torque.torque = l.on_crank(f) + dot(by_pin, step);
  out.torque.slope = dot(by_pin, out.pin_by_alpha) - q0 + (1 - f.beta1) * q1;
}

// From b on. False where it does not come to an end, or to one beyond a determinant of 0.
bool settle(const SliderGuide& g, const FrictionFrame<double>& f, const CrankState& state, FrictionBalance& out) {
  const Forces<double> at(f, state.alpha);
  const double scale = std::abs(at.pin.x) + std::abs(at.pin.y) + std::abs(at.rod.x) + std::abs(at.rod.y);
  double last = HUGE_VAL;
  for (int i = 0; i < 40; ++i) {
    const FrictionLoads<double> loads(g, f, at, out.pin, state.sign);
    const Slopes slopes(g, f, loads);
    const double determinant = slopes.determinant();
    if (!(determinant > 0) || !std::isfinite(determinant)) return false;
    const Vector* const row = slopes.left;
    out.inverse[0][0] = row[1].y / determinant, out.inverse[0][1] = -row[0].y / determinant;
    out.inverse[1][0] = -row[1].x / determinant, out.inverse[1][1] = row[0].x / determinant;
    const Vector step = -1.0 * apply(out.inverse, loads.left);
    const double size = std::max(std::abs(step.x), std::abs(step.y));
    if (!std::isfinite(size)) return false;
    out.pin = out.pin + step;
    const double least = std::min({loads.size[1], loads.size[2], scale});
    // By the square of the step, unless a pin bears next to nothing; then by rounding.
    if (size <= quadratic * least || size <= 4e-16 * scale || (size <= 1e-13 * scale && size >= last)) {
      differentiate(f, loads, slopes, step, out);
      return true;
    }
    last = size;
  }
  return false;
}

}  // namespace

template <class T>
FrictionFrame<T> SliderCrankStatics::friction_frame(const CrankState& state, const T& phi, const T& omega,
                                                    const T& force) const {
  const SliderCrankData& d = data_;
  const SliderCrankPose<T> p(d, changes_, phi);
  const T turning = omega * omega;
  FrictionFrame<T> f;
  f.beta1 = p.beta1, f.x1 = p.x1, f.lever = d.rod_length * p.cos_beta, f.tan_beta = p.sin_beta / p.cos_beta;
  // Accelerations by ω², then by ε: of the crank pin over r, angular and centripetal of the rod, of the slider.
  const PlaneVector<T> turn[2] = {{-turning * p.cos_phi, -turning * p.sin_phi}, {-p.sin_phi, p.cos_phi}};
  const T swing[2] = {turning * p.beta2, p.beta1}, inwards[2] = {turning * p.beta1 * p.beta1, T(0.0)};
  const T slide[2] = {turning * p.x2, p.x1};
  for (int k = 0; k < 2; ++k) {
    const PlaneVector<T> arm{-p.cos_beta * inwards[k] - p.sin_beta * swing[k],
                             p.cos_beta * swing[k] - p.sin_beta * inwards[k]};
    const Force2 weight = k == 0 ? down_ : Force2{};
    const auto inertia = [&](double mass, const PlaneVector<T>& a) {
      return PlaneVector<T>{mass * (weight.x - a.x), mass * (weight.y - a.y)};
    };
    f.crank[k] = inertia(d.crank_mass, d.crank_com * turn[k]);
    f.rod[k] = inertia(d.rod_mass, d.radius * turn[k] + d.rod_com * arm);
    f.pin[k].x = d.slider_mass * (slide[k] - weight.x);
    if (k == 0) f.pin[k].x = f.pin[k].x - force;
    f.pin[k].y =
        (d.rod_com * (p.cos_beta * f.rod[k].y - p.sin_beta * f.rod[k].x) - d.rod_inertia * swing[k]) / f.lever +
        f.tan_beta * f.pin[k].x;
  }
  const SliderGuide& g = joints_.guide;
  f.across = d.slider_mass * down_.y;
  f.moment = g.com_x * f.across - g.force_offset * force;
  const int direction = state.direction != 0 ? state.direction : sign(value_of(omega));
  const int rod = state.sign.rod != 0 ? state.sign.rod : sign(value_of(p.beta1));
  const int slider = state.sign.slider != 0 ? state.sign.slider : sign(value_of(p.x1));
  const auto rate = [&](const T& unit) { return unit * omega; };
  f.circle[0] = signed_circle(joints_.main_bearing, direction, omega, state.at_rest);
  f.circle[1] = signed_circle(joints_.crank_pin, -direction, rate(p.beta1 - 1.0), state.at_rest);
  f.circle[2] = signed_circle(joints_.slider_pin, -direction * rod, rate(-p.beta1), state.at_rest);
  const int along = direction * slider;
  f.guide = -along * (coefficient(g.friction, along * rate(p.x1), state.at_rest) +
                      (g.rolling_arm > 0 ? g.rolling_arm / g.roller_radius : 0.0));
  return f;
}

// Newton's method from what is near, or from the frictionless force; where that does not lead to the solution that hangs
// together with the frictionless one, along the whole way from there.
FrictionBalance SliderCrankStatics::balance(const FrictionFrame<double>& frame, const CrankState& state,
                                            const FrictionBalance* near) const {
  FrictionBalance out;
  out.alpha = state.alpha;
  if (near) {
    out.pin = near->pin + (state.alpha - near->alpha) * near->pin_by_alpha;
    if (settle(joints_.guide, frame, state, out)) return out;
  }
  out.pin = Forces<double>(frame, state.alpha).pin;
  if (settle(joints_.guide, frame, state, out)) return out;
  const Table unit = unit_cases(state.phi);
  const Column base = load_column(unit, state);
  const Solution led = solve_friction(unit, base, law_at(state), state.phi);
  const Column r = base + unit.rightCols<frictions>() * led.q;
  out.pin = {r[slider_x], r[slider_y]};
  if (settle(joints_.guide, frame, state, out)) return out;
  out.torque = torque_of(unit, led);
  return out;
}

// The position and speed asked about last, and what was found there.
struct SliderCrankStatics::Memory::Content {
  CrankState state;
  FrictionFrame<double> frame;
  bool any = false, solved = false;
  FrictionBalance balance;
};
SliderCrankStatics::Memory::Memory() : content_(std::make_unique<Content>()) {}
SliderCrankStatics::Memory::~Memory() = default;
SliderCrankStatics::Memory::Memory(Memory&&) noexcept = default;
void SliderCrankStatics::Memory::forget() { content_->any = false; }

SliderCrankStatics::FrictionTorque SliderCrankStatics::friction_torque(const CrankState& state) const {
  const auto frame = friction_frame(state, state.phi, state.omega, state.slider_force);
  return balance(frame, state, nullptr).torque;
}

SliderCrankStatics::FrictionTorque SliderCrankStatics::friction_torque(const CrankState& state, Memory& memory) const {
  Memory::Content& last = *memory.content_;
  CrankState asked = state;
  asked.alpha = last.state.alpha;
  if (!last.any || asked != last.state) {
    last.frame = friction_frame(state, state.phi, state.omega, state.slider_force);
    last.solved = false;
    last.any = true;
  } else if (last.solved && last.state.alpha == state.alpha) {
    return last.balance.torque;
  }
  last.state = state;
  const bool known = last.solved;
  last.solved = false;  // until it is: a jam throws
  last.balance = balance(last.frame, state, known ? &last.balance : nullptr);
  last.solved = true;
  return last.balance.torque;
}

SliderCrankStatics::FrictionSlopes SliderCrankStatics::friction_slopes(const CrankState& state) const {
  using D = Dual<3>;
  const FrictionBalance at = balance(friction_frame(state, state.phi, state.omega, state.slider_force), state, nullptr);
  const FrictionFrame<D> frame =
      friction_frame(state, D::input(state.phi, 0), D::input(state.omega, 1), D::input(state.slider_force, 2));
  const Forces<D> forces(frame, state.alpha);
  PlaneVector<D> pin{at.pin.x, at.pin.y};
  const PlaneVector<D> left = FrictionLoads<D>(joints_.guide, frame, forces, pin, state.sign).left;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector change = apply(at.inverse, Vector{left.x.d[i], left.y.d[i]});
    pin.x.d[i] = -change.x, pin.y.d[i] = -change.y;
  }
  const D torque = FrictionLoads<D>(joints_.guide, frame, forces, pin, state.sign).on_crank(frame);
  return {torque.d[0], torque.d[1], torque.d[2]};
}

std::array<double, 2> SliderCrankStatics::edge_shares(const CrankState& state) const {
  const auto frame = friction_frame(state, state.phi, state.omega, state.slider_force);
  const FrictionBalance at = balance(frame, state, nullptr);
  const SliderGuide& g = joints_.guide;
  const Forces<double> forces(frame, state.alpha);
  const FrictionLoads<double> loads(g, frame, forces, at.pin, state.sign);
  const double force = loads.size[2] + std::abs(frame.across) + std::numeric_limits<double>::min();
  const double scale =
      g.length > 0 ? g.length * force + 2 * (std::abs(frame.moment) + std::abs(loads.torque[2])) : force;
  if (!(g.length > 0)) return {loads.guide.edge[0] / scale, 1};
  return {loads.guide.edge[0] / scale, loads.guide.edge[1] / scale};
}

}  // namespace kurbel
