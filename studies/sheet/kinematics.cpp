// kinematics.cpp — series of the linkage at a crank angle, read as motions.
#include "studies/sheet/kinematics.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

double rounded(long double v) { return static_cast<double>(v); }

JointMotion motion_of(const std::string& name, const Path& p, double w, double e) {
  const auto at = [&](long double x, long double y) { return PlanePoint{rounded(x), rounded(y)}; };
  return {name, at(p.x.value(), p.y.value()), at(p.x.slope() * w, p.y.slope() * w),
          at(p.x.curvature() * w * w + p.x.slope() * e, p.y.curvature() * w * w + p.y.slope() * e)};
}

bool moves(const Path& p) {
  for (int k = 1; k <= Taylor::order; ++k)
    if (p.x.c[k] != 0 || p.y.c[k] != 0) return true;
  return false;
}

// The drawing's joint at a place; the number of joints where there is none.
std::size_t joint_at(const std::vector<PlanePoint>& joints, PlanePoint place) {
  double size = 0;
  for (const PlanePoint& p : joints) size = std::max(size, std::hypot(p.x, p.y));
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (std::hypot(joints[k].x - place.x, joints[k].y - place.y) < 1e-6 * size) return k;
  return joints.size();
}

void add_pins(const MechanismOnSheet& m, const PlanarLinkage& l, MechanismMotionAt& out) {
  const std::vector<PlanePoint> joints = m.joints(out.crank);
  std::vector<bool> known(joints.size() + 1, false);
  known.back() = true;
  for (int k = 0; k < l.joint_count; ++k) {
    const PlanarLinkage::Joint& j = l.joints[k];
    if (!moves(j.at)) continue;
    const JointMotion motion = motion_of("", j.at, out.omega, out.alpha);
    const std::size_t joint = joint_at(joints, motion.place);
    if (known[joint]) continue;
    known[joint] = true;
    out.pins.push_back(motion);
    out.pins.back().name = m.letter(joint);
  }
}

bool same(const Path& a, const Path& b) {
  for (int k = 0; k < Taylor::order; ++k)
    if (a.x.c[k] != b.x.c[k] || a.y.c[k] != b.y.c[k]) return false;
  return true;
}

// Of links whose centre of mass has a motion of its own: it is no pin's, and the link is not borne by the frame.
bool floats(const PlanarLinkage& l, int body) {
  for (int k = 0; k < l.joint_count; ++k) {
    const bool joins = l.joints[k].on == body || l.joints[k].from == body;
    if (joins && (l.joints[k].from == PlanarLinkage::frame || same(l.joints[k].at, l.bodies[body].com))) return false;
  }
  return true;
}

}  // namespace

std::vector<PlanePoint> MechanismOnSheet::joints(double crank_angle) const {
  return mechanism.data.places(mechanism.reduced->cycle().within(crank_angle));
}

std::string MechanismOnSheet::letter(std::size_t joint) const {
  const std::vector<std::string> names = mechanism.data.drawing().names;
  return names.empty() ? std::string(1, "OABCDEFGHK"[joint % 10]) : names[joint];
}

void check_rotates(const Mechanism& m) {
  if (m.arc())
    throw std::invalid_argument(
        fmt::format("--sheet: \"{}\" goes through no positions of a whole turn: its {}; leave the option out", m.name,
                    words_of_arc(m)));
}

std::vector<MechanismOnSheet> mechanisms_of(const Model& model) {
  std::vector<MechanismOnSheet> list;
  const auto add = [&](const Network::ShaftElement& e) {
    const MechanismElement* element = mechanism_of(e);
    if (!element) return;
    const Mechanism& m = element->mechanism();
    for (const MechanismOnSheet& known : list)
      if (known.mechanism.name == m.name) return;
    check_rotates(m);
    if (model.node_ratio[at(e.node)] != 0) list.push_back({m, model.node_ratio[at(e.node)]});
  };
  if (model.reduction_element >= 0) add(model.network.elements[at(model.reduction_element)]);
  for (const Network::ShaftElement& e : model.network.elements) add(e);
  if (list.empty())
    throw std::invalid_argument(
        "--sheet: a sheet shows a mechanism in its positions, and the machine has none on its lines that moves; leave "
        "the option out, or add one (kurbel keys slider-crank)");
  return list;
}

double dead_centre(const MechanismOnSheet& m) {
  double nearest = 0, distance = HUGE_VAL;
  const double cycle = m.mechanism.cycle();
  for (const double reversal : m.mechanism.travel.reversals) {
    const double phi = std::remainder(reversal - m.mechanism.phase, cycle) / m.ratio;
    if (std::abs(phi) < distance - 1e-9) nearest = phi, distance = std::abs(phi);
  }
  return std::abs(nearest) < 1e-9 ? 0 : nearest;
}

MechanismMotionAt motion_at(const MechanismOnSheet& m, double phi, double omega, double alpha) {
  MechanismMotionAt out;
  out.crank = m.crank_angle(phi), out.omega = m.ratio * omega, out.alpha = m.ratio * alpha;
  const double w = out.omega, e = out.alpha;
  const PlanarLinkage l = m.mechanism.data.linkage(out.crank);
  out.output = rounded(l.output[0]), out.first = rounded(l.output[1]), out.second = rounded(l.output[2]);
  out.velocity = out.first * w, out.acceleration = out.second * w * w + out.first * e;
  for (int i = 0; i < l.body_count; ++i) {
    const PlanarLinkage::Body& b = l.bodies[i];
    const Taylor rate = b.direction.rate();
    out.links.push_back({b.name, rounded(b.direction.angle()), rounded(rate.value()) * w,
                         rounded(rate.slope()) * w * w + rounded(rate.value()) * e});
    if (b.mass > 0 && floats(l, i)) out.centres.push_back(motion_of(fmt::format("S_{}", i + 1), b.com, w, e));
  }
  add_pins(m, l, out);
  return out;
}

}  // namespace kurbel
