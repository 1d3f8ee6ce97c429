// joint_friction.cpp — Newton's method for the friction loads of all joints at once, and the derivatives of their torque.
#include "mechanisms/friction/joint_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/equations/jam.h"
#include "engine/numerics/dual.h"

namespace kurbel {
namespace {

constexpr std::size_t most_loads = JointFriction::most_loads, most_reactions = 2 * JointFriction::most_joints;
constexpr double quadratic = 1e-8;  // after such a small step of Newton's method the error is its square

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Stribeck's coefficient over the sliding speed against the friction, smooth through 0.
template <class T>
T coefficient(const FrictionCoefficient& f, const T& sliding, bool at_rest) {
  if (at_rest) return T(f.resting);
  const T moving = f.stribeck_speed > 0 ? stribeck(sliding, f.kinetic, f.resting, f.stribeck_speed) : T(f.kinetic);
  return f.viscous > 0 ? moving + f.viscous * sliding : moving;
}

// ρ of a pin or f + k_r/r_r of a slide, by the sliding speed against the friction.
template <class T>
T strength(const RubbingJoint& j, bool slides, const T& sliding, bool at_rest) {
  using std::sqrt;
  const T f = coefficient(j.friction, sliding, at_rest);
  if (slides) return j.rolling_arm > 0 ? f + j.rolling_arm / j.roller_radius : f;
  return j.radius * f / sqrt(1.0 + f * f);
}

// u = L N − 2 M and w = L N + 2 M about the guide's middle; without length N, and nothing.
struct Edges {
  Edges(const RubbingJoint& j, double normal, double moment) {
    const double about_middle = moment - j.middle * normal;
    if (j.length > 0) {
      u = j.length * normal - 2 * about_middle, w = j.length * normal + 2 * about_middle;
    } else {
      u = normal;
    }
  }
  double u = 0, w = 0;
};

}  // namespace

// One state: the laws' coefficients, (1) of the header, its solution.
struct JointFriction::Work {
  std::size_t n = 0, reactions = 0;
  double phi = 0;
  bool given = false;                                   // the acceleration is given
  double strength[most_joints], edge[2 * most_joints];  // −sgn(v) times ρ or f + k_r/r_r; shares of u and w in Σ|N|
  double base[most_reactions], influence[most_reactions][most_loads];  // R₀, U + m b vᵀ
  double q[most_loads], r[most_reactions], wanted[most_loads];
  double by[most_loads][2];           // ∂law/∂ the two reactions of its joint
  std::size_t of[most_loads];         // the first of these
  double lu[most_loads][most_loads];  // of 1 − s ∂law/∂R (U + m b vᵀ)
  double inverse[most_loads];         // of its pivots
  std::size_t row[most_loads];
  double determinant = 1;
  double answer[most_reactions];  // b

  // N: the number of loads if known at compile time; else 0.
  template <std::size_t N>
  void react() {
    const std::size_t n = N > 0 ? N : this->n;
    for (std::size_t i = 0; i < reactions; ++i) {
      double sum = base[i];
      for (std::size_t k = 0; k < n; ++k) sum += influence[i][k] * q[k];
      r[i] = sum;
    }
  }
  template <std::size_t N>
  void factorise(double share) {
    const std::size_t n = N > 0 ? N : this->n;
    for (std::size_t i = 0; i < n; ++i) {
      const double *first = influence[of[i]], *second = influence[of[i] + 1];
      const double a = share * by[i][0], b = share * by[i][1];
      for (std::size_t k = 0; k < n; ++k) lu[i][k] = -a * first[k] - b * second[k];
      lu[i][i] += 1;
    }
    determinant = 1;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::abs(lu[i][k]) > std::abs(lu[pivot][k])) pivot = i;
      row[k] = pivot;
      if (pivot != k) {
        std::swap_ranges(lu[k], lu[k] + n, lu[pivot]);
        determinant = -determinant;
      }
      determinant *= lu[k][k];
      if (lu[k][k] == 0) continue;
      inverse[k] = 1 / lu[k][k];
      for (std::size_t i = k + 1; i < n; ++i) {
        const double factor = lu[i][k] *= inverse[k];
        if (factor != 0)
          for (std::size_t j = k + 1; j < n; ++j) lu[i][j] -= factor * lu[k][j];
      }
    }
  }
  template <std::size_t N>
  void solve(double* x) const {
    const std::size_t n = N > 0 ? N : this->n;
    for (std::size_t k = 0; k < n; ++k) std::swap(x[k], x[row[k]]);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i) x[i] -= lu[i][k] * x[k];
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t j = k + 1; j < n; ++j) x[k] -= lu[k][j] * x[j];
      x[k] *= inverse[k];
    }
  }
};

JointFriction::JointFriction(std::vector<Joint> joints, std::vector<Turning> turnings,
                             std::shared_ptr<const ReactionTable> table, std::vector<std::string> applied)
    : joints_(std::move(joints)),
      turnings_(std::move(turnings)),
      table_(std::move(table)),
      places_(table_->places()),
      applied_(std::move(applied)) {
  for (Joint& j : joints_) {
    validate(j.data);
    if (!j.slides) continue;
    j.first_side = static_cast<std::size_t>(sides_);
    sides_ += j.data.length > 0 ? 2 : 1;
  }
}

ReactionTable::One JointFriction::turning(int which, double phi) const {
  const Turning& t = turnings_[static_cast<std::size_t>(which)];
  const auto [value, slope] = table_->read_one(phi, places_.ratio(t.load));
  return {value / t.scale, slope / t.scale};
}

// ω² a + ε b + w + F c + Σ F_i c_i, of one reaction's row.
double JointFriction::without_friction(const State& s, const double* row) const {
  double sum = s.omega * s.omega * row[0] + s.alpha * row[1] + (s.weightless ? 0 : 1) * row[2] + s.load * row[3];
  for (std::size_t i = 0; s.applied && i < places_.applied; ++i) sum += s.applied[i] * row[ReactionPlaces::cases + i];
  return sum;
}

// fold: couples of slides are included in the influence of the other loads, as they are proportional to N.
void JointFriction::prepare(const State& s, double response, const double* values, bool fold, Work& w) const {
  const std::size_t n = places_.loads, stride = places_.stride();
  w.n = fold ? places_.joints : n, w.reactions = places_.reactions(), w.phi = s.phi;
  const double* ratio = values + places_.ratio(0);
  const int direction = s.direction != 0 ? s.direction : sign_of(s.omega);
  for (std::size_t i = 0; i < w.reactions; ++i) {
    const double* c = values + i * stride;
    w.base[i] = without_friction(s, c);
    w.answer[i] = c[1];
    const double answer = response * c[1];
    for (std::size_t k = 0; k < n; ++k) w.influence[i][k] = c[places_.friction(k)] + answer * ratio[k];
  }
  const auto held = [&](int place) {
    const int mode = s.modes ? s.modes[place] : 0;
    return mode == 1 || mode == -1 ? mode : 0;
  };
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    const double v = ratio[joint.load];
    int sign = joint.sign >= 0 ? held(joint.sign) : joint.sign == Joint::of_travel ? s.travel : 0;
    sign = direction * (sign != 0 ? joint.sense * sign : sign_of(v));
    const double sliding = sign * v * s.omega * (joint.slides ? 1 : joint.data.radius);
    w.strength[j] = -sign * strength(joint.data, joint.slides, sliding, s.at_rest);
    w.of[joint.load] = 2 * j;
    if (!joint.slides) continue;
    for (const int k : {0, 1}) w.edge[2 * j + static_cast<std::size_t>(k)] = 0;
    for (int k = 0; k < (joint.data.length > 0 ? 2 : 1); ++k)
      w.edge[2 * j + static_cast<std::size_t>(k)] = held(sign_count() + static_cast<int>(joint.first_side) + k);
    if (!joint.couple) continue;
    const double lever = 0.5 * joint.between * joint.data.width * w.strength[j];
    const std::size_t couple = *joint.couple, normal = 2 * j;
    w.of[couple] = normal, w.by[couple][0] = lever, w.by[couple][1] = 0;
    if (!fold) continue;
    // A slide keeps its bodies from turning: its couple changes the moment in it, and no other reaction.
    const std::size_t moment = normal + 1;
    const double part = lever * w.influence[moment][couple];
    w.base[moment] += part * w.base[normal], w.answer[moment] += part * w.answer[normal];
    for (std::size_t k = 0; k < n; ++k) w.influence[moment][k] += part * w.influence[normal][k];
  }
}

// q by the laws at the present q, and its slopes; returns the maximum.
template <std::size_t N>
double JointFriction::apply_laws(Work& w) const {
  w.react<N>();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    const double strength = w.strength[j], *r = w.r + 2 * j;
    double* by = w.by[joint.load];
    if (!joint.slides) {
      const double size = std::sqrt(r[0] * r[0] + r[1] * r[1]), unit = size > 0 ? strength / size : 0;
      by[0] = unit * r[0], by[1] = unit * r[1];
      w.wanted[joint.load] = strength * size;
      continue;
    }
    const RubbingJoint& d = joint.data;
    const Edges edges(d, r[0], r[1]);
    const double u = w.edge[2 * j] != 0 ? w.edge[2 * j] : sign_of(edges.u);
    by[0] = strength * u, by[1] = 0;
    if (d.length > 0) {
      const double v = w.edge[2 * j + 1] != 0 ? w.edge[2 * j + 1] : sign_of(edges.w), part = strength / (2 * d.length);
      by[0] = part * ((u + v) * d.length + 2 * (u - v) * d.middle), by[1] = 2 * part * (v - u);
    }
    w.wanted[joint.load] = by[0] * r[0] + by[1] * r[1];
    if (joint.couple && *joint.couple < w.n) w.wanted[*joint.couple] = w.by[*joint.couple][0] * r[0];
  }
  double largest = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < w.n; ++k) largest = std::max(largest, std::abs(w.wanted[k]));
  return largest;
}

// Newton's method at one share of the coefficients from q; false if it does not converge on the right branch.
template <std::size_t N>
bool JointFriction::settle(double share, Work& w) const {
  const std::size_t n = N > 0 ? N : w.n;
  double last = HUGE_VAL;
  for (int i = 0; i < 40; ++i) {
    const double largest = apply_laws<N>(w);
    if (!std::isfinite(largest)) return false;
    w.factorise<N>(share);
    if (w.determinant == 0 || !std::isfinite(w.determinant)) return false;
    double step[most_loads], size = 0;
    for (std::size_t k = 0; k < n; ++k) step[k] = share * w.wanted[k] - w.q[k];
    w.solve<N>(step);
    for (std::size_t k = 0; k < n; ++k) w.q[k] += step[k], size = std::max(size, std::abs(step[k]));
    // By the square of the step; for a pin with a nearly zero reaction, where its law has a kink, by rounding.
    double least = largest;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (!joints_[j].slides && w.strength[j] != 0) least = std::min(least, std::abs(w.wanted[joints_[j].load]));
    if (size <= quadratic * least || size <= 4e-16 * largest || (size <= 1e-13 * largest && size >= last))
      return w.determinant > 0;
    last = size;
  }
  return false;
}

bool JointFriction::settle_any(double share, Work& w) const {
  switch (w.n) {
    case 1:
      return settle<1>(share, w);
    case 2:
      return settle<2>(share, w);
    case 3:
      return settle<3>(share, w);
    case 4:
      return settle<4>(share, w);
    case 5:
      return settle<5>(share, w);
    case 7:
      return settle<7>(share, w);
    default:
      return settle<0>(share, w);
  }
}

// From the frictionless solution; if Newton's method does not converge directly, by continuation with growing shares.
void JointFriction::find(const State& s, Work& w) const {
  std::fill_n(w.q, w.n, 0.0);
  double share = 0, step = 1;
  constexpr double least_step = 1.0 / 4096;
  // Reactions are unbounded as the determinant vanishes; integration over time does not reach this.
  const double least_determinant = s.at_rest || w.given ? 0 : 1e-4;
  while (share < 1) {
    const double next = std::min(1.0, share + step);
    double before[most_loads];
    std::copy_n(w.q, w.n, before);
    if (settle_any(next, w) && (next < 1 || w.determinant > least_determinant)) {
      share = next;
      step *= 2;
      continue;
    }
    std::copy_n(before, w.n, w.q);
    step /= 2;
    if (step < least_step)
      throw Jam(
          fmt::format("its joints jam at phi = {:.6g} deg: from {:.3g} % of the given friction on no {} satisfy the "
                      "friction laws; lower the coefficients, or lengthen guides and the links that push against them",
                      s.phi * 180 / std::numbers::pi, 100 * share,
                      s.at_rest ? "finite reactions at rest"
                      : w.given ? "finite reactions"
                                : "reactions and no acceleration"));
  }
}

JointFriction::Torque JointFriction::torque(const State& state, double response) const {
  Place place;
  return torque(state, response, place);
}

JointFriction::Torque JointFriction::torque(const State& s, double response, Place& place) const {
  if (place.phi != s.phi) table_->read(s.phi, place.values), place.phi = s.phi;
  Work w;
  prepare(s, response, place.values, true, w);
  place.found = false;
  find(s, w);
  std::copy_n(w.q, w.n, place.loads), place.found = true;
  const double* ratio = place.values + places_.ratio(0);
  Torque out;
  double by_alpha[most_loads];
  for (std::size_t k = 0; k < w.n; ++k) {
    out.torque += ratio[k] * w.q[k];
    by_alpha[k] = w.by[k][0] * w.answer[2 * k] + w.by[k][1] * w.answer[2 * k + 1];
  }
  w.solve<0>(by_alpha);
  double slope = 0;
  for (std::size_t k = 0; k < w.n; ++k) slope += ratio[k] * by_alpha[k];
  out.slope = response != 0 ? slope / (1 + response * slope) : slope;
  out.alpha = s.alpha + response * out.torque;
  return out;
}

// q = law(x, R(x, q)): by the implicit function theorem.
JointFriction::Slopes JointFriction::slopes(const State& s) const {
  double values[most_values], along[most_values];
  table_->read(s.phi, values, along);
  Work w;
  prepare(s, 0, values, false, w);
  find(s, w);
  const std::size_t stride = places_.stride();
  const double *ratio = values + places_.ratio(0), *ratio_along = along + places_.ratio(0);
  double by_angle[most_loads], by_speed[most_loads], by_load[most_loads], by_applied[most_applied][most_loads];
  for (std::size_t k = 0; k < w.n; ++k) {
    double angle = 0, speed = 0, load = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double *c = values + (w.of[k] + i) * stride, *d = along + (w.of[k] + i) * stride;
      double moved = without_friction(s, d);
      for (std::size_t m = 0; m < w.n; ++m) moved += d[places_.friction(m)] * w.q[m];
      angle += w.by[k][i] * moved, speed += w.by[k][i] * 2 * s.omega * c[0], load += w.by[k][i] * c[3];
    }
    by_angle[k] = angle, by_speed[k] = speed, by_load[k] = load;
    for (std::size_t a = 0; a < places_.applied; ++a) {
      const double* c = values + w.of[k] * stride + ReactionPlaces::cases + a;
      by_applied[a][k] = w.by[k][0] * c[0] + w.by[k][1] * c[stride];
    }
  }
  // The coefficients change with the sliding speed.
  for (std::size_t j = 0; j < joints_.size() && !s.at_rest; ++j) {
    const Joint& joint = joints_[j];
    if (w.strength[j] == 0) continue;
    using D = Dual<2>;
    const int sign = w.strength[j] > 0 ? -1 : 1;
    const double arm = sign * (joint.slides ? 1 : joint.data.radius), v = ratio[joint.load];
    D sliding(arm * v * s.omega);
    sliding.d = {arm * ratio_along[joint.load] * s.omega, arm * v};
    const D changed = strength(joint.data, joint.slides, sliding, false);
    const auto grow = [&](std::size_t k) {
      by_angle[k] += w.q[k] / changed.value * changed.d[0], by_speed[k] += w.q[k] / changed.value * changed.d[1];
    };
    grow(joint.load);
    if (joint.couple) grow(*joint.couple);
  }
  for (double* by : {by_angle, by_speed, by_load}) w.solve<0>(by);
  Slopes out;
  for (std::size_t a = 0; a < places_.applied; ++a) {
    w.solve<0>(by_applied[a]);
    for (std::size_t k = 0; k < w.n; ++k) out.by_applied[a] += ratio[k] * by_applied[a][k];
  }
  for (std::size_t k = 0; k < w.n; ++k) {
    out.by_angle += ratio[k] * by_angle[k] + ratio_along[k] * w.q[k];
    out.by_speed += ratio[k] * by_speed[k];
    out.by_load += ratio[k] * by_load[k];
  }
  return out;
}

// Each relative to its terms, so that sides that vanish together are of order one elsewhere.
void JointFriction::sides(const State& s, double* side, Place& place) const {
  const bool known = place.found && place.phi == s.phi;
  if (!known) table_->read(s.phi, place.values), place.phi = s.phi;
  const double* const values = place.values;
  Work w;
  prepare(s, 0, values, true, w);
  if (known)
    std::copy_n(place.loads, w.n, w.q);
  else
    find(s, w);
  w.react<0>();
  const double weight = s.weightless ? 0 : 1;
  const auto terms = [&](std::size_t i) {
    const double* c = values + i * places_.stride();
    double sum = std::abs(s.omega * s.omega * c[0]) + std::abs(s.alpha * c[1]) + std::abs(weight * c[2]) +
                 std::abs(s.load * c[3]);
    for (std::size_t a = 0; s.applied && a < places_.applied; ++a)
      sum += std::abs(s.applied[a] * c[ReactionPlaces::cases + a]);
    for (std::size_t k = 0; k < w.n; ++k) sum += std::abs(w.influence[i][k] * w.q[k]);
    return sum;
  };
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!joints_[j].slides) continue;
    const RubbingJoint& d = joints_[j].data;
    const Edges edges(d, w.r[2 * j], w.r[2 * j + 1]);
    const double least = std::numeric_limits<double>::min();
    if (d.length > 0) {
      const double scale = (d.length + 2 * std::abs(d.middle)) * terms(2 * j) + 2 * terms(2 * j + 1) + least;
      *side++ = edges.u / scale, *side++ = edges.w / scale;
    } else {
      *side++ = edges.u / (terms(2 * j) + least);
    }
  }
}

JointFriction::Solved JointFriction::solve(const State& s) const {
  double values[most_values];
  table_->read(s.phi, values);
  Work w;
  w.given = true;
  prepare(s, 0, values, false, w);
  find(s, w);
  const double largest = apply_laws<0>(w);
  Solved out{{w.r, w.r + w.reactions}, {w.q, w.q + w.n}, 0, 0};
  for (std::size_t k = 0; k < w.n; ++k) out.residual = std::max(out.residual, std::abs(w.wanted[k] - w.q[k]) / largest);
  for (std::size_t k = 0; k < w.n; ++k) out.torque += values[places_.ratio(k)] * w.q[k];
  return out;
}

double JointFriction::resting(double phi, double load, int direction, bool weightless, const double* applied) const {
  try {
    return -torque({.phi = phi,
                    .load = load,
                    .applied = applied,
                    .direction = direction,
                    .at_rest = true,
                    .weightless = weightless})
                .torque;
  } catch (const Jam&) {  // self-locking
    return direction * HUGE_VAL;
  }
}

}  // namespace kurbel
