// closed_forms.cpp — the loops of the mechanisms, solved one triangle after the other.
#include "mechanisms/reduced/closed_forms.h"

#include <algorithm>
#include <cmath>

#include "mechanisms/loops/loops.h"
#include "mechanisms/reduced/links_summed.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {
namespace {

using Body = PlanarLinkage::Body;

Body pivoted(const char* name, const LinkBody& link, const Path& bearing, const Direction& direction) {
  const long double central = link.inertia - static_cast<long double>(link.mass) * link.com * link.com;
  return {name, link.mass, central > 0 ? central : 0, bearing + along(direction, Taylor(link.com)), direction};
}
Body floating(const char* name, const LinkBody& link, const Path& joint, const Direction& direction) {
  return {name, link.mass, link.inertia, joint + along(direction, Taylor(link.com)), direction};
}
// What slides along x in the frame: its weight and its load stand in its pin.
void add_slider(PlanarLinkage& to, const char* name, double mass, const char* pin, const Path& at) {
  const int link = to.body_count - 1;
  to.add(Body{name, mass, 0, at, Direction::constant(0)});
  to.join({pin, link, link + 1, at});
  to.join({"guide", PlanarLinkage::frame, link + 1, at, true, Direction::constant(0)});
  to.load_at = at;
  to.output[0] = at.x.value(), to.output[1] = at.x.slope(), to.output[2] = at.x.curvature();
}

}  // namespace

ClosedForm closed_form_of(const PlanarLinkage& linkage) {
  const long double elevation = linkage.elevation, gravity = linkage.gravity;
  const Path up = {Taylor(std::sin(elevation)), Taylor(std::cos(elevation))};
  Taylor inertia, moment;  // moment: of mass over height
  long double scale = 0;
  for (int i = 0; i < linkage.body_count; ++i) {
    const PlanarLinkage::Body& body = linkage.bodies[i];
    const Taylor vx = body.com.x.derivative(), vy = body.com.y.derivative();
    inertia = inertia + Taylor(body.mass) * (vx * vx + vy * vy);
    moment = moment + Taylor(body.mass) * (up.x * body.com.x + up.y * body.com.y);
    scale += gravity * body.mass * std::hypot(vx.value(), vy.value());
    const Taylor rate = body.direction.rate();
    inertia = inertia + Taylor(body.inertia) * rate * rate;
  }
  return {inertia.value(),
          inertia.slope(),
          inertia.curvature(),
          linkage.output[0],
          linkage.output[1],
          linkage.output[2],
          -gravity * moment.slope(),
          -gravity * moment.curvature(),
          scale,
          gravity * moment.value()};
}

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

PlanarLinkage linkage_of(const SliderCrankData& d, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, Taylor(d.radius));
  const Direction rod = rod_to_line(d.loop(), phi, d.folds);
  PlanarLinkage l;
  l.gravity = d.gravity, l.elevation = d.stroke_angle;
  l.add(pivoted("crank", {d.crank_mass, d.crank_com, d.crank_inertia}, {}, crank));
  l.add(floating("rod", {d.rod_mass, d.rod_com, d.rod_inertia}, pin, rod));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  add_slider(l, "slider", d.slider_mass, "slider pin", pin + along(rod, Taylor(d.rod_length)));
  if (d.changes()) l.sine = rod.cos.value();
  return l;
}

PlanarLinkage linkage_of(const FourBarData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Meeting meeting = meet(m.loop(), phi, !m.crossed);
  const Path pin = along(crank, Taylor(m.crank)), bearing = {Taylor(m.ground), Taylor()};
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.ground_angle, l.rocks = true;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("coupler", m.coupler_body, pin, meeting.coupler));
  l.add(pivoted("rocker", m.rocker_body, bearing, meeting.follower));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"coupler pin", 1, 2, bearing + along(meeting.follower, Taylor(m.rocker))});
  l.join({"rocker bearing", PlanarLinkage::frame, 2, bearing});
  l.load_at = bearing;
  if (m.loop().changes()) l.sine = meeting.sine;
  const Taylor rate = meeting.follower.rate();
  l.output[0] = meeting.follower.angle();
  if (!m.loop().folds(!m.crossed)) l.output[1] = rate.value(), l.output[2] = rate.slope();
  return l;
}

PlanarLinkage linkage_of(const QuickReturnData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, Taylor(m.radius)), pivot = {Taylor(), Taylor(-m.pivot_distance)};
  const Path to_pin = pin - pivot;
  const Taylor distance = sqrt(to_pin.x * to_pin.x + to_pin.y * to_pin.y);
  const Direction slot = {to_pin.x / distance, to_pin.y / distance};
  const Path end = pivot + along(slot + Direction::constant(m.lever_angle), Taylor(m.lever));
  const Direction link = to_line(end, static_cast<long double>(m.guide_height) - m.pivot_distance, m.link, m.backward);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.stroke_angle;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(pivoted("lever", m.lever_body, pivot, slot));
  l.add(floating("block", {m.block_mass, 0, m.block_inertia}, pin, slot));
  l.add(floating("link", m.link_body, end, link));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 2, pin});
  l.join({"slot", 2, 1, pin, true, slot});
  l.join({"lever bearing", PlanarLinkage::frame, 1, pivot});
  l.join({"lever pin", 1, 3, end});
  add_slider(l, "ram", m.ram_mass, "ram pin", end + along(link, Taylor(m.link)));
  return l;
}

// The loop crank – rod – upper link is a four-bar in axes turned towards the bearing.
PlanarLinkage linkage_of(const KnucklePressData& m, long double phi) {
  const long double x = m.bearing_x, y = m.bearing_y, ground = std::hypot(x, y), tilt = std::atan2(y, x);
  const Meeting meeting = meet({m.radius, m.rod, m.upper, ground}, phi - tilt, !m.knee_right);
  const Direction back = Direction::constant(tilt), crank = Direction::of_variable(phi);
  const Direction upper = meeting.follower + back, rod = meeting.coupler + back;
  const Path pin = along(crank, Taylor(m.radius)), bearing = {Taylor(x), Taylor(y)};
  const Path knee = bearing + along(upper, Taylor(m.upper));
  const Direction lower = to_line(knee, m.guide, m.lower, false);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.stroke_angle;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("rod", m.rod_body, pin, rod));
  l.add(pivoted("upper link", m.upper_body, bearing, upper));
  l.add(floating("lower link", m.lower_body, knee, lower));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"knee, rod", 1, 2, knee});
  l.join({"knee, lower link", 2, 3, knee});
  l.join({"upper bearing", PlanarLinkage::frame, 2, bearing});
  add_slider(l, "ram", m.ram_mass, "ram pin", knee + along(lower, Taylor(m.lower)));
  return l;
}

PlanarLinkage linkage_of(const SlottedLeverData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, Taylor(m.crank)), bearing = {Taylor(m.ground), Taylor()};
  const Slot slot = slot_to_pin(m.loop(), phi);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.ground_angle, l.rocks = true;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("block", {m.block_mass, 0, m.block_inertia}, pin, slot.along));
  l.add(pivoted("lever", m.lever_body, bearing, slot.along));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"slot", 1, 2, pin, true, slot.along});
  l.join({"lever bearing", PlanarLinkage::frame, 2, bearing});
  l.load_at = bearing;
  if (m.loop().changes()) l.sine = slot.reach.value() / (m.crank + m.ground);
  const Taylor rate = slot.along.rate();
  l.output[0] = slot.along.angle(), l.output[1] = rate.value(), l.output[2] = rate.slope();
  return l;
}

// The driving link first, the output last.
PlanarLinkage linkage_of(const LinkageData& data, long double phi) {
  const Linkage& linkage = *data.linkage;
  const LinkageSketch& s = linkage.sketch();
  const LinkageStructure& parts = linkage.structure();
  const LinkPoses poses = linkage.poses(phi);
  std::vector<int> order = parts.order, place(s.links.size(), 0);
  std::stable_partition(order.begin(), order.end(), [&](int link) { return link != s.output.link; });
  PlanarLinkage l;
  l.gravity = data.gravity, l.elevation = s.elevation + parts.axes.turned(), l.rocks = s.output.rocks();
  const auto towards = [&](int link) {
    const Path along = poses[link].turned(linkage.direction_of(link));
    return Direction{along.x, along.y};
  };
  for (const int link : order) {
    const LinkageSketch::Link& body = s.links[static_cast<std::size_t>(link)];
    place[static_cast<std::size_t>(link)] = l.body_count;
    l.add({linkage.link_name(link), body.mass, body.inertia, poses[link](linkage.centre_of(link)), towards(link)});
  }
  const auto number = [&](int body) {
    return body == LinkageSketch::frame ? PlanarLinkage::frame : place[static_cast<std::size_t>(body)];
  };
  for (std::size_t k = 0; k < parts.joints.size(); ++k) {
    const LinkageJoint& j = parts.joints[k];
    const Path along = poses[j.other(j.carrier)].turned(j.along);
    l.join({linkage.joint_name(k), number(j.a), number(j.b), poses[j.carrier](j.at), j.slides,
            j.slides ? Direction{along.x, along.y} : Direction{}});
  }
  l.load_at = poses[s.output.link](linkage.spot_of(linkage.output_point()));
  const Direction output = towards(s.output.link);
  const Taylor rate = output.rate();
  if (l.rocks)
    l.output[0] = output.angle(), l.output[1] = rate.value(), l.output[2] = rate.slope();
  else
    l.output[0] = l.load_at.x.value(), l.output[1] = l.load_at.x.slope(), l.output[2] = l.load_at.x.curvature();
  return l;
}

ClosedForm closed_form(const FourBarData& data, long double phi) { return closed_form_of(linkage_of(data, phi)); }
ClosedForm closed_form(const QuickReturnData& data, long double phi) { return closed_form_of(linkage_of(data, phi)); }
ClosedForm closed_form(const KnucklePressData& data, long double phi) { return closed_form_of(linkage_of(data, phi)); }
ClosedForm closed_form(const SlottedLeverData& data, long double phi) { return closed_form_of(linkage_of(data, phi)); }
ClosedForm closed_form(const LinkageData& data, long double phi) { return closed_form_of(linkage_of(data, phi)); }

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
