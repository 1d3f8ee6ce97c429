// sketched_linkage.cpp — poses of the links as bodies and joints.
#include "mechanisms/bodies/sketched_linkage.h"

#include <algorithm>

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

}  // namespace kurbel
