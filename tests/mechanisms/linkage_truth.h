// linkage_truth.h — four-bar, quick-return and knuckle press by their loop equations in closed form, in long double.
//
// Independent of Simbody and of the sources under test: positions by Freudenstein's equation and by the slider-crank's
// triangle, derivatives by Taylor series, I_r and M_g by theory 2.1 and 2.2 over all links.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "mechanisms/loops/taylor.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel::test {

// In the order of ReducedMechanism's channels.
struct LinkageTruth {
  long double value[8];
  long double potential_energy = 0;
};

class LinkageSum {
 public:
  LinkageSum(double gravity, double elevation) : gravity_(gravity), elevation_(elevation) {}

  void turning(const LinkBody& link, const Path& bearing, const Direction& direction) {  // inertia about its bearing
    point(link.mass, bearing + along(direction, Taylor(link.com)));
    const long double central = link.inertia - static_cast<long double>(link.mass) * link.com * link.com;
    inertia_ = inertia_ + Taylor(central) * direction.rate() * direction.rate();
  }
  void floating(const LinkBody& link, const Path& joint, const Direction& direction) {  // central inertia
    point(link.mass, joint + along(direction, Taylor(link.com)));
    inertia_ = inertia_ + Taylor(link.inertia) * direction.rate() * direction.rate();
  }
  void point(double mass, const Path& p) {
    const Taylor vx = p.x.derivative(), vy = p.y.derivative();
    inertia_ = inertia_ + Taylor(mass) * (vx * vx + vy * vy);
    height_ = height_ + Taylor(mass) * (Taylor(std::sin(elevation_)) * p.x + Taylor(std::cos(elevation_)) * p.y);
  }
  LinkageTruth truth(long double x, long double x1, long double x2) const {
    return {{inertia_.value(), inertia_.slope(), inertia_.curvature(), x, x1, x2, -gravity_ * height_.slope(),
             -gravity_ * height_.curvature()},
            gravity_ * height_.value()};
  }

 private:
  long double gravity_, elevation_;
  Taylor inertia_, height_;
};

// The follower c of a four-bar with crank a, coupler b, ground d along direction 0:
//     E cos ψ + F sin ψ + G = 0                                                                   (Freudenstein, 1955)
// with the solution that has sin ψ > 0 (left) or < 0.
inline Direction follower(const Direction& crank, double crank_length, double coupler_length, double follower_length,
                          double ground_length, bool left) {
  const Taylor a(crank_length), b(coupler_length), c(follower_length), d(ground_length), two(2);
  const Taylor e = two * c * (d - a * crank.cos), f = -(two * a * c * crank.sin);
  const Taylor g = a * a + c * c + d * d - b * b - two * a * d * crank.cos;
  const Taylor square = e * e + f * f, root = sqrt(square - g * g);
  const Taylor sign(left ? 1 : -1);
  return {(-(e * g) - sign * f * root) / square, (-(f * g) + sign * e * root) / square};
}

// Direction of a link of this length from `joint` to the line y = height, towards +x or −x.
inline Direction to_line(const Path& joint, double height, double length, bool backward) {
  const Taylor sine = (Taylor(height) - joint.y) / Taylor(length);
  const Taylor cosine = sqrt(Taylor(1) - sine * sine);
  return {backward ? -cosine : cosine, sine};
}

inline Direction between(const Path& from, const Path& to, double length) {
  return {(to.x - from.x) / Taylor(length), (to.y - from.y) / Taylor(length)};
}

inline LinkageTruth truth_of(const FourBarData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Direction rocker = follower(crank, m.crank, m.coupler, m.rocker, m.ground, !m.crossed);
  const Path o{}, a = along(crank, Taylor(m.crank)), d = {Taylor(m.ground), Taylor(0)};
  const Path b = d + along(rocker, Taylor(m.rocker));
  LinkageSum sum(m.gravity, m.ground_angle);
  sum.turning(m.crank_body, o, crank);
  sum.floating(m.coupler_body, a, between(a, b, m.coupler));
  sum.turning(m.rocker_body, d, rocker);
  const Taylor rate = rocker.rate();
  return sum.truth(rocker.angle(), rate.value(), rate.slope());
}

inline LinkageTruth truth_of(const QuickReturnData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path o{}, a = along(crank, Taylor(m.radius)), p = {Taylor(0), Taylor(-m.pivot_distance)};
  const Path slot_to_pin = a - p;
  const Taylor slot_length = sqrt(slot_to_pin.x * slot_to_pin.x + slot_to_pin.y * slot_to_pin.y);
  const Direction slot = {slot_to_pin.x / slot_length, slot_to_pin.y / slot_length};
  const Path e = p + along(slot + Direction::constant(m.lever_angle), Taylor(m.lever));
  const Direction link = to_line(e, m.guide_height - m.pivot_distance, m.link, m.backward);
  const Path ram = e + along(link, Taylor(m.link));
  LinkageSum sum(m.gravity, m.stroke_angle);
  sum.turning(m.crank_body, o, crank);
  sum.turning(m.lever_body, p, slot);
  sum.floating({m.block_mass, 0, m.block_inertia}, a, slot);
  sum.floating(m.link_body, e, link);
  sum.point(m.ram_mass, ram);
  return sum.truth(ram.x.value(), ram.x.slope(), ram.x.curvature());
}

inline LinkageTruth truth_of(const KnucklePressData& m, long double phi) {
  const double ground = std::hypot(m.bearing_x, m.bearing_y);
  const long double tilt = std::atan2(static_cast<long double>(m.bearing_y), static_cast<long double>(m.bearing_x));
  // The loop crank – rod – upper link in axes turned towards the bearing, and back.
  const Direction seen = Direction::of_variable(phi - tilt);
  const Direction crank = Direction::of_variable(phi);
  const Direction upper = follower(seen, m.radius, m.rod, m.upper, ground, !m.knee_right) + Direction::constant(tilt);
  const Path o{}, a = along(crank, Taylor(m.radius)), g = {Taylor(m.bearing_x), Taylor(m.bearing_y)};
  const Path k = g + along(upper, Taylor(m.upper));
  const Direction lower = to_line(k, m.guide, m.lower, false);
  const Path ram = k + along(lower, Taylor(m.lower));
  LinkageSum sum(m.gravity, m.stroke_angle);
  sum.turning(m.crank_body, o, crank);
  sum.floating(m.rod_body, a, between(a, k, m.rod));
  sum.turning(m.upper_body, g, upper);
  sum.floating(m.lower_body, k, lower);
  sum.point(m.ram_mass, ram);
  return sum.truth(ram.x.value(), ram.x.slope(), ram.x.curvature());
}

// --- anything valid, every mass absent now and then ---

class RandomLinkage {
 public:
  explicit RandomLinkage(unsigned seed) : random_(seed) {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  bool coin() { return uniform(0, 1) < 0.5; }
  double sometimes_zero(double value) { return uniform(0, 1) < 0.2 ? 0.0 : value; }

  LinkBody pivoted(double length) {
    LinkBody b{sometimes_zero(uniform(0.1, 20)), sometimes_zero(uniform(-0.5, 1) * length), 0};
    b.inertia = b.mass * b.com * b.com + sometimes_zero(uniform(0.05, 1) * length * length);
    return b;
  }
  LinkBody floating(double length) {
    const double mass = sometimes_zero(uniform(0.1, 20));
    return {mass, uniform(-0.2, 1.2) * length, mass > 0 ? sometimes_zero(uniform(0.01, 2) * length * length) : 0};
  }

  // Crank, coupler, rocker, ground with each Grashof margin at least 2 % of the longest link.
  void crank_rocker(double& crank, double& coupler, double& rocker, double& ground) {
    do {
      crank = uniform(0.05, 0.5), coupler = uniform(0.1, 1), rocker = uniform(0.1, 1), ground = uniform(0.1, 1);
    } while (crank + coupler > rocker + ground - 0.02 || crank + rocker > coupler + ground - 0.02 ||
             crank + ground > coupler + rocker - 0.02);
  }

  FourBarData four_bar() {
    FourBarData m;
    crank_rocker(m.crank, m.coupler, m.rocker, m.ground);
    m.crossed = coin();
    m.crank_body = pivoted(m.crank);
    m.crank_body.inertia += 0.1 * m.crank * m.crank;  // never all massless
    m.coupler_body = floating(m.coupler);
    m.rocker_body = pivoted(m.rocker);
    m.gravity = sometimes_zero(9.80665);
    m.ground_angle = uniform(-3.2, 3.2);
    return m;
  }

  QuickReturnData quick_return() {
    QuickReturnData m;
    do {
      m.radius = uniform(0.05, 0.5);
      m.pivot_distance = m.radius * (coin() ? uniform(1.1, 4) : uniform(0.05, 0.9));
      m.lever = uniform(0.1, 1.5);
      m.lever_angle = sometimes_zero(uniform(-3.2, 3.2));
      m.link = uniform(0.2, 3);
      m.guide_height = uniform(-1, 1) * m.lever;
    } while (!faults_of(m).empty() || nearly_short(m));
    m.backward = coin();
    m.crank_body = pivoted(m.radius);
    m.crank_body.inertia += 0.1 * m.radius * m.radius;
    m.lever_body = pivoted(m.lever);
    m.block_mass = sometimes_zero(uniform(0.1, 3));
    m.block_inertia = m.block_mass > 0 ? sometimes_zero(uniform(0.001, 0.1)) : 0;
    m.link_body = floating(m.link);
    m.ram_mass = sometimes_zero(uniform(1, 100));
    m.gravity = sometimes_zero(9.80665);
    m.stroke_angle = uniform(-3.2, 3.2);
    return m;
  }

  KnucklePressData knuckle_press() {
    KnucklePressData m;
    do {
      double ground = 0;
      crank_rocker(m.radius, m.rod, m.upper, ground);
      const double tilt = uniform(-3.1, 3.1);
      m.bearing_x = ground * std::cos(tilt), m.bearing_y = ground * std::sin(tilt);
      m.lower = uniform(0.2, 2);
      m.guide = m.bearing_y + sometimes_zero(uniform(-0.3, 0.3));
      m.knee_right = coin();
    } while (!faults_of(m).empty() || nearly_short(m));
    m.crank_body = pivoted(m.radius);
    m.crank_body.inertia += 0.1 * m.radius * m.radius;
    m.rod_body = floating(m.rod);
    m.upper_body = pivoted(m.upper);
    m.lower_body = floating(m.lower);
    m.ram_mass = sometimes_zero(uniform(1, 100));
    m.gravity = sometimes_zero(9.80665);
    m.stroke_angle = uniform(-3.2, 3.2);
    return m;
  }

 private:
  // A last link that comes within 1 % of standing across the guide.
  static bool nearly_short(QuickReturnData m) {
    m.link *= 0.99;
    return !faults_of(m).empty();
  }
  static bool nearly_short(KnucklePressData m) {
    m.lower *= 0.99;
    return !faults_of(m).empty();
  }

  std::mt19937 random_;
};

}  // namespace kurbel::test
