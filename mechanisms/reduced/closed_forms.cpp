// closed_forms.cpp — the loops of the mechanisms, solved one triangle after the other.
#include "mechanisms/reduced/closed_forms.h"

#include <cmath>

#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/taylor.h"

namespace kurbel {
namespace {

// Gathers theory 2.1 and 2.2 over the links.
class LinkSum {
 public:
  LinkSum(double gravity, double elevation)
      : gravity_(gravity),
        up_{Taylor(std::sin(static_cast<long double>(elevation))),
            Taylor(std::cos(static_cast<long double>(elevation)))} {}

  void turning(const LinkBody& link, const Path& bearing, const Direction& direction) {  // inertia about its bearing
    point(link.mass, bearing + along(direction, Taylor(link.com)));
    const long double central = link.inertia - static_cast<long double>(link.mass) * link.com * link.com;
    turn(central > 0 ? central : 0, direction);
  }
  void floating(const LinkBody& link, const Path& joint, const Direction& direction) {  // central inertia
    point(link.mass, joint + along(direction, Taylor(link.com)));
    turn(link.inertia, direction);
  }
  void point(double mass, const Path& p) {
    const Taylor vx = p.x.derivative(), vy = p.y.derivative();
    inertia_ = inertia_ + Taylor(mass) * (vx * vx + vy * vy);
    moment_ = moment_ + Taylor(mass) * (up_.x * p.x + up_.y * p.y);
    scale_ += gravity_ * mass * std::hypot(vx.value(), vy.value());
  }
  ClosedForm with_output(long double x, long double x1, long double x2) const {
    return {inertia_.value(),
            inertia_.slope(),
            inertia_.curvature(),
            x,
            x1,
            x2,
            -gravity_ * moment_.slope(),
            -gravity_ * moment_.curvature(),
            scale_,
            gravity_ * moment_.value()};
  }
  ClosedForm with_output(const Taylor& x) const { return with_output(x.value(), x.slope(), x.curvature()); }

 private:
  void turn(long double inertia, const Direction& direction) {
    const Taylor rate = direction.rate();
    inertia_ = inertia_ + Taylor(inertia) * rate * rate;
  }

  long double gravity_, scale_ = 0;
  Path up_;
  Taylor inertia_, moment_;  // of mass over height
};

// 1 + cos α = 2 cos²(α/2) and 1 − cos α = 2 sin²(α/2), which cos α itself would lose near π and 0.
struct CosineSums {
  explicit CosineSums(long double angle) {
    const Direction half = Direction::of_variable(angle, 0.5L);
    plus = Taylor(2) * half.cos * half.cos;
    minus = Taylor(2) * half.sin * half.sin;
  }
  Taylor plus, minus;
};

// Direction from A = a (cos α, sin α) along the coupler b, and from D = (d, 0) along the follower c, that meet.
struct Meeting {
  Direction coupler, follower;
};

// By the triangle A, D, B with s = AD: the coupler's direction is that of AD turned by the angle at A. Twice its area
// is ½ √((b+c+s)(b+c−s)(s+b−c)(s−b+c)) (Heron), whose differences vanish at a change point: with s² = (a+d)² −
// 2 a d (1 + cos α) = (a−d)² + 2 a d (1 − cos α) they come from the lengths alone.
Meeting meet(long double a, long double b, long double c, long double d, long double angle, bool left) {
  const Direction crank = Direction::of_variable(angle);
  const CosineSums cosine(angle);
  const Taylor product(2 * a * d);
  const Path ad = Path{Taylor(d), Taylor()} - along(crank, Taylor(a));
  const long double difference = std::fabs(a - d), gap = std::fabs(b - c);
  const Taylor s = sqrt(Taylor(difference * difference) + product * cosine.minus);
  const Taylor below = Taylor(b + c - a - d) + product * cosine.plus / (Taylor(a + d) + s);           // b + c − s
  const Taylor above = Taylor(difference - gap) + product * cosine.minus / (s + Taylor(difference));  // s − |b − c|
  const Taylor height = sqrt((Taylor(b + c) + s) * below * above * (s + Taylor(gap))) / (Taylor(2) * s);
  // Feet of the height on AD, seen from A and from D.
  const Taylor from_a = (s * s + Taylor((b - c) * (b + c))) / (Taylor(2) * s), from_d = s - from_a;
  const Direction line = {ad.x / s, ad.y / s};
  const Taylor side(left ? 1 : -1);
  const Path foot = along(line, from_a), aside = {-(side * height * line.sin), side * height * line.cos};
  const Path ab = foot + aside, db = aside - along(line, from_d);
  return {{ab.x / Taylor(b), ab.y / Taylor(b)}, {db.x / Taylor(c), db.y / Taylor(c)}};
}

// Direction of a link of this length from `joint` to the line y = height, towards +x or −x.
Direction to_line(const Path& joint, long double height, long double length, bool backward) {
  const Taylor rise = Taylor(height) - joint.y;
  const Taylor cosine = sqrt((Taylor(length) - rise) * (Taylor(length) + rise)) / Taylor(length);
  return {backward ? -cosine : cosine, rise / Taylor(length)};
}

}  // namespace

ClosedForm closed_form(const SliderCrankData& d, long double phi) {
  const SliderCrankGeometry geometry(d);
  const auto inertia = geometry.inertia(phi), x = geometry.slider(phi), beta = geometry.rod(phi);
  const auto weight = geometry.gravity_torque(phi);
  const long double c = d.rod_com, r = d.radius;
  const long double rod_speed =
      std::hypot(r + c * beta.slope * std::cos(phi - beta.value), c * beta.slope * std::sin(phi - beta.value));
  const long double scale =
      d.gravity * (d.crank_mass * std::fabs(d.crank_com) + d.rod_mass * rod_speed + d.slider_mass * std::fabs(x.slope));
  return {inertia.value, inertia.slope, inertia.curvature, x.value, x.slope,
          x.curvature,   weight.value,  weight.slope,      scale,   geometry.potential_energy(phi)};
}

ClosedForm closed_form(const FourBarData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Meeting meeting = meet(m.crank, m.coupler, m.rocker, m.ground, phi, !m.crossed);
  LinkSum sum(m.gravity, m.ground_angle);
  sum.turning(m.crank_body, {}, crank);
  sum.floating(m.coupler_body, along(crank, Taylor(m.crank)), meeting.coupler);
  sum.turning(m.rocker_body, {Taylor(m.ground), Taylor()}, meeting.follower);
  const Taylor rate = meeting.follower.rate();
  return sum.with_output(meeting.follower.angle(), rate.value(), rate.slope());
}

ClosedForm closed_form(const QuickReturnData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, Taylor(m.radius)), pivot = {Taylor(), Taylor(-m.pivot_distance)};
  const Path to_pin = pin - pivot;
  const Taylor distance = sqrt(to_pin.x * to_pin.x + to_pin.y * to_pin.y);
  const Direction slot = {to_pin.x / distance, to_pin.y / distance};
  const Path end = pivot + along(slot + Direction::constant(m.lever_angle), Taylor(m.lever));
  const Direction link = to_line(end, static_cast<long double>(m.guide_height) - m.pivot_distance, m.link, m.backward);
  const Path ram = end + along(link, Taylor(m.link));
  LinkSum sum(m.gravity, m.stroke_angle);
  sum.turning(m.crank_body, {}, crank);
  sum.turning(m.lever_body, pivot, slot);
  sum.floating({m.block_mass, 0, m.block_inertia}, pin, slot);
  sum.floating(m.link_body, end, link);
  sum.point(m.ram_mass, ram);
  return sum.with_output(ram.x);
}

// The loop crank – rod – upper link is a four-bar in axes turned towards the bearing.
ClosedForm closed_form(const KnucklePressData& m, long double phi) {
  const long double x = m.bearing_x, y = m.bearing_y, ground = std::hypot(x, y), tilt = std::atan2(y, x);
  const Meeting meeting = meet(m.radius, m.rod, m.upper, ground, phi - tilt, !m.knee_right);
  const Direction back = Direction::constant(tilt), crank = Direction::of_variable(phi);
  const Direction upper = meeting.follower + back;
  const Path bearing = {Taylor(x), Taylor(y)}, knee = bearing + along(upper, Taylor(m.upper));
  const Direction lower = to_line(knee, m.guide, m.lower, false);
  const Path ram = knee + along(lower, Taylor(m.lower));
  LinkSum sum(m.gravity, m.stroke_angle);
  sum.turning(m.crank_body, {}, crank);
  sum.floating(m.rod_body, along(crank, Taylor(m.radius)), meeting.coupler + back);
  sum.turning(m.upper_body, bearing, upper);
  sum.floating(m.lower_body, knee, lower);
  sum.point(m.ram_mass, ram);
  return sum.with_output(ram.x);
}

ReducedSample closed_sample(const MechanismData& data, double phi) {
  const ClosedForm f = data.closed_form(phi);
  const auto rounded = [](long double value) { return static_cast<double>(value); };
  return {rounded(f.inertia),
          rounded(f.inertia_slope),
          rounded(f.inertia_curvature),
          rounded(f.output_position),
          rounded(f.output_velocity_ratio),
          rounded(f.output_acceleration_ratio),
          rounded(f.gravity_torque),
          rounded(f.gravity_torque_slope),
          rounded(f.gravity_torque_scale),
          1};
}

}  // namespace kurbel
