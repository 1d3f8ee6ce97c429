// joint_friction.cpp — Newton's method for the friction loads of all joints at once, and the derivatives of their torque.
#include "mechanisms/friction/joint_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/equations/jam.h"
#include "engine/numerics/dual.h"
#include "mechanisms/friction/friction_loads.h"

namespace kurbel {
namespace {

constexpr std::size_t most_loads = JointFriction::most_loads;
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
  Edges(double length, double middle, double normal, double moment) {
    const double about_middle = moment - middle * normal;
    if (length > 0) {
      u = length * normal - 2 * about_middle, w = length * normal + 2 * about_middle;
    } else {
      u = normal;
    }
  }
  double u = 0, w = 0;
};

}  // namespace

JointFriction::JointFriction(std::vector<Joint> joints, std::vector<Turning> turnings,
                             std::shared_ptr<const ReactionTable> table, std::vector<std::string> applied)
    : joints_(std::move(joints)),
      turnings_(std::move(turnings)),
      table_(std::move(table)),
      places_(table_->places()),
      applied_(std::move(applied)) {
  for (Joint& j : joints_) {
    validate(j.data);
    laws_.push_back({j.slides, j.data.length, j.data.middle, j.couple});
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

// ω² a + ε b + w + F c + Σ F_i c_i of all reactions.
void JointFriction::without_friction(const State& s, const double* values, double* sums) const {
  const auto column = [&](std::size_t number) { return values + places_.column(number); };
  const std::size_t reactions = places_.reactions();
  const double square = s.omega * s.omega, weight = s.weightless ? 0 : 1;
  const double *speed = column(ReactionPlaces::speed_case), *acceleration = column(ReactionPlaces::acceleration_case),
               *weights = column(ReactionPlaces::weight_case), *load = column(ReactionPlaces::load_case);
  for (std::size_t i = 0; i < reactions; ++i)
    sums[i] = square * speed[i] + s.alpha * acceleration[i] + weight * weights[i] + s.load * load[i];
  for (std::size_t k = 0; s.applied && k < places_.applied; ++k)
    for (std::size_t i = 0; i < reactions; ++i) sums[i] += s.applied[k] * column(ReactionPlaces::cases + k)[i];
}

// fold: couples of slides are included in the influence of the other loads, as they are proportional to N.
void JointFriction::prepare(const State& s, double response, const double* values, bool fold, Work& w) const {
  const std::size_t n = places_.loads, reactions = places_.reactions();
  w.n = fold ? places_.joints : n, w.joints = places_.joints, w.phi = s.phi;
  w.answers = response != 0;
  const double* ratio = values + places_.ratio(0);
  const int direction = s.direction != 0 ? s.direction : sign_of(s.omega);
  without_friction(s, values, w.base);
  std::copy_n(values + places_.column(ReactionPlaces::acceleration_case), reactions, w.answer);
  for (std::size_t k = 0; k < n; ++k) {
    const double* unit = values + places_.column(places_.friction(k));
    if (response == 0)
      std::copy_n(unit, reactions, w.influence[k]);
    else
      for (std::size_t i = 0; i < reactions; ++i) w.influence[k][i] = unit[i] + response * w.answer[i] * ratio[k];
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
    w.of[joint.load] = j;
    if (!joint.slides) continue;
    for (const int k : {0, 1})
      w.edge[k][j] = k == 0 || joint.data.length > 0 ? held(sign_count() + static_cast<int>(joint.first_side) + k) : 0;
    if (!joint.couple) continue;
    const double lever = 0.5 * joint.between * joint.data.width * w.strength[j];
    const std::size_t couple = *joint.couple, normal = j;
    w.of[couple] = j, w.by[0][couple] = lever, w.by[1][couple] = 0;
    if (!fold) continue;
    // A slide keeps its bodies from turning: its couple changes the moment in it, and no other reaction.
    const std::size_t moment = w.joints + j;
    const double part = lever * w.influence[couple][moment];
    w.base[moment] += part * w.base[normal], w.answer[moment] += part * w.answer[normal];
    for (std::size_t k = 0; k < n; ++k) w.influence[k][moment] += part * w.influence[k][normal];
  }
}

// q by the laws at the present q, and its slopes.
template <std::size_t N>
void JointFriction::apply_laws(Work& w) const {
  w.react<N>();
  const std::size_t joints = N > 0 ? N : w.joints;
  w.largest = std::numeric_limits<double>::min(), w.least = HUGE_VAL;
  for (std::size_t j = 0; j < joints; ++j) {  // the n-th joint has the n-th load
    const Law& law = laws_[j];
    const double strength = w.strength[j], first = w.r[j], second = w.r[joints + j];
    if (!law.slides) {
      const double size = std::sqrt(first * first + second * second), unit = size > 0 ? strength / size : 0;
      w.by[0][j] = unit * first, w.by[1][j] = unit * second;
      w.wanted[j] = strength * size;
      if (strength != 0) w.least = std::min(w.least, std::abs(w.wanted[j]));
    } else {
      const Edges edges(law.length, law.middle, first, second);
      const double u = w.edge[0][j] != 0 ? w.edge[0][j] : sign_of(edges.u);
      double by = strength * u, by_moment = 0;
      if (law.length > 0) {
        const double v = w.edge[1][j] != 0 ? w.edge[1][j] : sign_of(edges.w), part = strength / (2 * law.length);
        by = part * ((u + v) * law.length + 2 * (u - v) * law.middle), by_moment = 2 * part * (v - u);
      }
      w.by[0][j] = by, w.by[1][j] = by_moment;
      w.wanted[j] = by * first + by_moment * second;
      if (N == 0 && law.couple && *law.couple < w.n) {
        w.wanted[*law.couple] = w.by[0][*law.couple] * first;
        w.largest = std::max(w.largest, std::abs(w.wanted[*law.couple]));
      }
    }
    w.largest = std::max(w.largest, std::abs(w.wanted[j]));
  }
}

// Newton's method at one share of the coefficients from q; false if it does not converge on the right branch.
template <std::size_t N>
bool JointFriction::settle(double share, Work& w) const {
  const std::size_t n = N > 0 ? N : w.n;
  double last = HUGE_VAL;
  for (int i = 0; i < 40; ++i) {
    apply_laws<N>(w);
    const double largest = w.largest;
    if (!std::isfinite(largest)) return false;
    w.factorise<N>(share);
    if (w.determinant == 0 || !std::isfinite(w.determinant)) return false;
    double step[most_loads], size = 0;
    for (std::size_t k = 0; k < n; ++k) step[k] = share * w.wanted[k] - w.q[k];
    w.solve<N>(step);
    for (std::size_t k = 0; k < n; ++k) w.q[k] += step[k], size = std::max(size, std::abs(step[k]));
    // By the square of the step; for a pin with a nearly zero reaction, where its law has a kink, by rounding.
    const double least = std::min(largest, w.least);
    if (size <= quadratic * least || size <= 4e-16 * largest || (size <= 1e-13 * largest && size >= last))
      return w.determinant > 0;
    last = size;
  }
  return false;
}

bool JointFriction::settle_any(double share, Work& w) const {
  return w.sized([&](auto n) { return settle<n>(share, w); });
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
                      s.at_rest   ? "finite reactions at rest"
                      : w.answers ? "reactions and no acceleration"
                                  : "finite reactions"));
  }
}

JointFriction::Torque JointFriction::torque(const State& state, double response) const {
  Place place;
  return torque(state, response, place);
}

void JointFriction::read(double phi, Place& place) const {
  if (place.phi == phi) return;
  if (std::isnan(place.phi))
    table_->read(phi, place.values);
  else
    table_->move(phi, place.values);
  place.phi = phi;
}

JointFriction::Torque JointFriction::torque(const State& s, double response, Place& place) const {
  read(s.phi, place);
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
    by_alpha[k] = w.by[0][k] * w.answer[k] + w.by[1][k] * w.answer[w.joints + k];
  }
  w.sized([&](auto n) { w.solve<n>(by_alpha); });
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
  double along_without[2 * most_joints];
  without_friction(s, along, along_without);
  const double *ratio = values + places_.ratio(0), *ratio_along = along + places_.ratio(0);
  double by_angle[most_loads], by_speed[most_loads], by_load[most_loads], by_applied[most_applied][most_loads];
  for (std::size_t k = 0; k < w.n; ++k) {
    double angle = 0, speed = 0, load = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t reaction = places_.reaction(w.of[k], i);
      double moved = along_without[reaction];
      for (std::size_t m = 0; m < w.n; ++m) moved += along[places_.column(places_.friction(m)) + reaction] * w.q[m];
      angle += w.by[i][k] * moved, speed += w.by[i][k] * 2 * s.omega * values[reaction];
      load += w.by[i][k] * values[places_.column(ReactionPlaces::load_case) + reaction];
    }
    by_angle[k] = angle, by_speed[k] = speed, by_load[k] = load;
    for (std::size_t a = 0; a < places_.applied; ++a) {
      const double* c = values + places_.column(ReactionPlaces::cases + a) + w.of[k];
      by_applied[a][k] = w.by[0][k] * c[0] + w.by[1][k] * c[w.joints];
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
  read(s.phi, place);
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
    const auto c = [&](std::size_t column) { return values[places_.column(column) + i]; };
    double sum = std::abs(s.omega * s.omega * c(0)) + std::abs(s.alpha * c(1)) + std::abs(weight * c(2)) +
                 std::abs(s.load * c(3));
    for (std::size_t a = 0; s.applied && a < places_.applied; ++a)
      sum += std::abs(s.applied[a] * c(ReactionPlaces::cases + a));
    for (std::size_t k = 0; k < w.n; ++k) sum += std::abs(w.influence[k][i] * w.q[k]);
    return sum;
  };
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!joints_[j].slides) continue;
    const RubbingJoint& d = joints_[j].data;
    const Edges edges(d.length, d.middle, w.r[j], w.r[w.joints + j]);
    const double least = std::numeric_limits<double>::min();
    if (d.length > 0) {
      const double scale = (d.length + 2 * std::abs(d.middle)) * terms(j) + 2 * terms(w.joints + j) + least;
      *side++ = edges.u / scale, *side++ = edges.w / scale;
    } else {
      *side++ = edges.u / (terms(j) + least);
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
  apply_laws<0>(w);
  Solved out{{}, {w.q, w.q + w.n}, 0, 0};
  for (std::size_t j = 0; j < w.joints; ++j)
    for (const std::size_t part : {0, 1}) out.reactions.push_back(w.r[places_.reaction(j, part)]);
  for (std::size_t k = 0; k < w.n; ++k)
    out.residual = std::max(out.residual, std::abs(w.wanted[k] - w.q[k]) / w.largest);
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
