// dyads.cpp — triangles and pairs of lines, in series.
#include "mechanisms/linkage/dyads.h"

#include <fmt/core.h>

#include <algorithm>

namespace kurbel {
namespace {

// The dyad's joints with the bodies outside, and its links.
struct Dyad {
  Dyad(const AssurGroup& g, const std::vector<LinkageJoint>& joints, const LinkPoses& poses)
      : first(g.links[0]),
        second(g.links[1]),
        outer_first(joints[static_cast<std::size_t>(g.joints[0])]),
        inner(joints[static_cast<std::size_t>(g.joints[1])]),
        outer_second(joints[static_cast<std::size_t>(g.joints[2])]),
        before_first(poses[outer_first.other(first)]),
        before_second(poses[outer_second.other(second)]) {}
  int first, second;
  const LinkageJoint &outer_first, &inner, &outer_second;
  const LinkPose before_first, before_second;  // links that stand already
};

Taylor sign(long double of) { return Taylor(of < 0 ? -1 : 1); }
Path aside(const Path& p) { return {-p.y, p.x}; }

long double close_rrr(const Dyad& d, LinkPoses& poses) {
  const SketchSpot arm = d.inner.at - d.outer_first.at, other = d.inner.at - d.outer_second.at;
  const long double a = length(arm), b = length(other);
  const Path from = d.before_first(d.outer_first.at), to = d.before_second(d.outer_second.at), way = to - from;
  const Taylor square = dot(way, way);
  if (!(square.value() > 0)) return 0;
  const Taylor side = sqrt(square);
  const Taylor foot = (square + Taylor((a - b) * (a + b))) / (Taylor(2) * side);
  const Taylor height = (Taylor(a) - foot) * (Taylor(a) + foot);  // squared
  const long double margin = height.value() * square.value() / (a * a * b * b);
  if (!(margin > 0)) return margin;
  const Taylor root = sign(cross(d.outer_second.at - d.outer_first.at, arm)) * sqrt(height);
  const Path out = (foot / side) * way + (root / side) * aside(way);  // from the first outer pin to the inner one
  poses.of(d.first) = LinkPose::through(LinkPose::rotation(arm, out), d.outer_first.at, from);
  poses.of(d.second) = LinkPose::through(LinkPose::rotation(other, out - way), d.outer_second.at, to);
  return margin;
}

long double close_rrp(const Dyad& d, LinkPoses& poses) {
  const SketchSpot arm = d.inner.at - d.outer_first.at, u = d.outer_second.along;
  const long double a = length(arm);
  const Path from = d.before_first(d.outer_first.at), base = d.before_second(d.inner.at);
  const Path line = d.before_second.turned(u), back = base - from;
  const Taylor height = cross(line, back), square = (Taylor(a) - height) * (Taylor(a) + height);
  const long double margin = square.value() / (a * a);
  if (!(margin > 0)) return margin;
  const Taylor shift = sign(dot(arm, u)) * sqrt(square) - dot(line, back);  // of the inner pin along the line
  const Path pin = back + shift * line;                                     // from the outer one
  poses.of(d.second) = d.before_second.shifted(shift * line);
  poses.of(d.first) = LinkPose::through(LinkPose::rotation(arm, pin), d.outer_first.at, from);
  return margin;
}

long double close_rpr(const Dyad& d, LinkPoses& poses) {
  const SketchSpot span = d.outer_second.at - d.outer_first.at, u = d.inner.along;
  const long double offset = cross(u, span), size = dot(span, span);
  const Path from = d.before_first(d.outer_first.at), to = d.before_second(d.outer_second.at), way = to - from;
  const Taylor square = dot(way, way), reach = square - Taylor(offset * offset);
  const long double margin = reach.value() / std::max(square.value(), size);
  if (!(margin > 0)) return margin;
  // turn · (along + i offset) u = way, as complex numbers
  const Taylor along = sign(dot(u, span)) * sqrt(reach), e(offset), ux(u.x), uy(u.y);
  const Taylor vx = along * ux - e * uy, vy = along * uy + e * ux;
  const Direction turn = {(way.x * vx + way.y * vy) / square, (way.y * vx - way.x * vy) / square};
  poses.of(d.first) = LinkPose::through(turn, d.outer_first.at, from);
  poses.of(d.second) = LinkPose::through(turn, d.outer_second.at, to);
  return margin;
}

// s w − t v = way
std::pair<Taylor, Taylor> shifts(const Path& w, const Path& v, const Path& way) {
  const Taylor sine = cross(w, v);
  return {cross(way, v) / sine, cross(way, w) / sine};
}

long double close_prp(const Dyad& d, LinkPoses& poses) {
  const Path w = d.before_first.turned(d.outer_first.along), v = d.before_second.turned(d.outer_second.along);
  const long double drawn = cross(d.outer_first.along, d.outer_second.along);
  const long double margin = cross(w, v).value() * (drawn < 0 ? -1 : 1);
  if (!(margin > 0)) return margin;
  const auto [s, t] = shifts(w, v, d.before_second(d.inner.at) - d.before_first(d.inner.at));
  poses.of(d.first) = d.before_first.shifted(s * w);
  poses.of(d.second) = d.before_second.shifted(t * v);
  return margin;
}

long double close_rpp(const Dyad& d, LinkPoses& poses) {
  const LinkPose& guide = d.before_second;
  const Path outer = guide.turned(d.outer_second.along), inner = guide.turned(d.inner.along);
  const long double margin = std::fabs(cross(d.outer_second.along, d.inner.along));
  if (!(margin > 0)) return margin;
  const auto [s, t] = shifts(outer, inner, d.before_first(d.outer_first.at) - guide(d.outer_first.at));
  poses.of(d.second) = guide.shifted(s * outer);
  poses.of(d.first) = guide.shifted(s * outer - t * inner);
  return margin;
}

}  // namespace

long double close_dyad(const AssurGroup& g, const std::vector<LinkageJoint>& joints, LinkPoses& poses) {
  const Dyad d(g, joints, poses);
  switch (g.form) {
    case AssurGroup::Form::rrr:
      return close_rrr(d, poses);
    case AssurGroup::Form::rrp:
      return close_rrp(d, poses);
    case AssurGroup::Form::rpr:
      return close_rpr(d, poses);
    case AssurGroup::Form::prp:
      return close_prp(d, poses);
    case AssurGroup::Form::rpp:
      return close_rpp(d, poses);
    case AssurGroup::Form::newton:
      break;
  }
  return 0;
}

std::string dead_position_of(const AssurGroup& g, const LinkageSketch& s) {
  const std::string& first = s.links[static_cast<std::size_t>(g.links[0])].name;
  const std::string& second = s.links[static_cast<std::size_t>(g.links[1])].name;
  switch (g.form) {
    case AssurGroup::Form::rrr:
      return fmt::format("{} and {} lie in one line", first, second);
    case AssurGroup::Form::rrp:
      return fmt::format("{} stands square to the line that {} slides on", first, second);
    case AssurGroup::Form::rpr:
      return fmt::format("the pins of {} and {} come square to their slide", first, second);
    case AssurGroup::Form::prp:
    case AssurGroup::Form::rpp:
      return fmt::format("the slides of {} and {} are parallel", first, second);
    case AssurGroup::Form::newton:
      break;
  }
  return fmt::format("the links {} can be closed no further", links_of(g, s));
}

}  // namespace kurbel
