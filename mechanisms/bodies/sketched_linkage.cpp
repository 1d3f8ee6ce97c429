// sketched_linkage.cpp — poses of the links as bodies and joints.
#include "mechanisms/bodies/sketched_linkage.h"

#include <algorithm>
#include <cmath>

namespace kurbel {

namespace {

PlanarLinkage linkage_in(const LinkPoses& poses, const LinkageData& data) {
  const Linkage& linkage = *data.linkage;
  const LinkageSketch& s = linkage.sketch();
  const LinkageStructure& parts = linkage.structure();
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
            j.slides ? Direction{along.x, along.y} : Direction{}, j.carrier == j.a});
  }
  if (const auto sine = linkage.change_sine(poses))
    l.changes = true, l.sine = sine->value(), l.turns_over = linkage.change_turns_over();
  l.load_at = poses[s.output.link](linkage.spot_of(linkage.output_point()));
  const Direction output = towards(s.output.link);
  const Taylor rate = output.rate();
  if (l.rocks)
    l.output[0] = output.angle(), l.output[1] = rate.value(), l.output[2] = rate.slope();
  else
    l.output[0] = l.load_at.x.value(), l.output[1] = l.load_at.x.slope(), l.output[2] = l.load_at.x.curvature();
  return l;
}

// By the mean of |x′|, which positions that are rounded leave where x is constant.
template <class Data>
std::optional<long double> rest_of(const Data& data) {
  constexpr int angles = 16;
  constexpr long double rounding = 1e-12L;
  const Linkage& linkage = *data.linkage;
  const auto& arc = linkage.arc();
  long double moved = 0, size = 0;
  for (int i = 0; i < angles; ++i) {
    const long double part = 2 * std::acos(-1.0L) * (i + 0.5L) / angles;
    const PlanarLinkage at =
        linkage_of(data, arc ? arc->middle + arc->reach() * std::cos(part) : linkage.turns() * part);
    moved += std::fabs(at.output[1]) / angles;
    for (const PlanarLinkage::Joint& j : at.joints) size = std::max(size, std::hypot(j.at.x.value(), j.at.y.value()));
    if (at.rocks) size = 1;
  }
  if (!(moved <= rounding * size)) return {};
  const long double x = linkage_of(data, linkage.drawn_at()).output[0];
  return std::fabs(x) <= rounding * size ? 0 : x;
}

}  // namespace

PlanarLinkage linkage_of(const LinkageData& data, long double phi) {
  return linkage_in(data.linkage->poses(phi), data);
}

int body_of(const PlanarLinkage& bodies, const Linkage& linkage, int link) {
  if (link == LinkageSketch::frame) return PlanarLinkage::frame;
  int body = 0;
  while (bodies.bodies[static_cast<std::size_t>(body)].name != linkage.link_name(link)) ++body;
  return body;
}

PlanarLinkage linkage_of(const LinkageTravelData& data, long double phi) {
  const LinkPoses poses = data.linkage->poses(phi);
  PlanarLinkage l = linkage_in(poses, {data.linkage, 0});
  for (PlanarLinkage::Body& body : l.bodies) body.mass = 0, body.inertia = 0;
  const Taylor s = travel_series(*data.linkage, poses, data.travel);
  l.rocks = data.travel.rocks();
  l.output[0] = s.value(), l.output[1] = s.slope(), l.output[2] = s.curvature();
  return l;
}

std::optional<long double> stands_at(const LinkageData& data) { return rest_of(data); }
std::optional<long double> stands_at(const LinkageTravelData& data) { return rest_of(data); }

}  // namespace kurbel
