// parallel_group.cpp — rods and cranks by their rates in the sketch, offsets from pin to pin.
#include "mechanisms/linkage/parallel_group.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kurbel {
namespace {

constexpr int ground = LinkageSketch::frame;
std::size_t nth(int i) { return static_cast<std::size_t>(i); }

// All of a list of vectors along one line.
struct PinLine {
  SketchSpot along = {0, 0};
  bool straight = true;
  void add(SketchSpot v, long double same) {
    if (length(v) <= same) return;
    if (length(along) == 0) along = (1 / length(v)) * v;
    straight = straight && std::fabs(cross(along, v)) <= same;
  }
};

class ParallelTrial {
 public:
  ParallelTrial(const AssurGroup& g, const LinkageSketch& s, const LinkageStructure& all, const LinkPoses& drawn,
                long double same)
      : g_(g), s_(s), all_(all), drawn_(drawn), same_(same) {}

  std::optional<ParallelMotion> by(int base, int leader, int bearing) {
    motion_ = {};
    motion_.base = base, motion_.leader = leader;
    if (!put_rotations() || !starts_at(bearing) || !put_offsets()) return {};
    find_lines(bearing);
    return motion_;
  }

 private:
  SketchSpot spot(int p) const { return all_.axes.spot(s_.points[nth(p)].x, s_.points[nth(p)].y); }
  const std::vector<int>& points_of(int body) const {
    return body == ground ? s_.frame_points : s_.links[nth(body)].points;
  }
  long double rate(int body) const { return drawn_[body].turn.rate().value(); }

  bool put_rotations() {
    constexpr long double alike = 1e-6L;
    if (std::fabs(rate(motion_.base) - rate(motion_.leader)) < 1e3L * alike) return false;
    for (std::size_t i = 0; i < g_.links.size(); ++i) {
      const long double own = rate(g_.links[i]);
      bool& rod = motion_.links[i].rod;
      rod = std::fabs(own - rate(motion_.base)) < alike;
      if (!rod && std::fabs(own - rate(motion_.leader)) > alike) return false;
    }
    return true;
  }
  // The arm of a point: it stands at F(x) + (T_K − T_F) arm.
  bool starts_at(int bearing) {
    arm_ = {};
    for (const int p : points_of(motion_.leader)) arm_[nth(p)] = spot(p) - spot(bearing);
    for (const int p : points_of(motion_.base)) arm_[nth(p)] = SketchSpot{};
    return std::all_of(g_.joints.begin(), g_.joints.end(), [&](int k) {
      const LinkageJoint& j = all_.joints[nth(k)];
      return std::find(g_.links.begin(), g_.links.end(), j.a) != g_.links.end() || arm_[nth(j.point)];
    });
  }
  bool put_offsets() {
    std::array<bool, LinkageSketch::most_links> put = {};
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < g_.links.size(); ++i)
        for (const int p : points_of(g_.links[i])) {
          ParallelMotion::Link& link = motion_.links[i];
          const SketchSpot own = link.rod ? SketchSpot{} : spot(p);
          std::optional<SketchSpot>& arm = arm_[nth(p)];
          if (arm && !put[i]) link.offset = *arm - own, put[i] = more = true;
          if (!arm && put[i]) arm = link.offset + own, more = true;
          if (arm && put[i] && length(*arm - own - link.offset) > same_) return false;
        }
    }
    return std::all_of(put.begin(), put.begin() + static_cast<std::ptrdiff_t>(g_.links.size()),
                       [](bool is) { return is; });
  }
  void find_lines(int bearing) {
    PinLine rods, cranks;
    const auto add = [&](int body, bool is_rod) {
      std::optional<int> first;
      const auto through = [&](int p) {
        if (!s_.has(body, p)) return;
        if (first) (is_rod ? rods : cranks).add(spot(p) - spot(*first), same_);
        if (!first) first = p;
      };
      through(bearing);
      for (const int k : g_.joints) through(all_.joints[nth(k)].point);
    };
    add(motion_.base, true), add(motion_.leader, false);
    for (std::size_t i = 0; i < g_.links.size(); ++i) add(g_.links[i], motion_.links[i].rod);
    motion_.along_rods = rods.along, motion_.along_cranks = cranks.along;
    motion_.changes = rods.straight && cranks.straight;
  }

  const AssurGroup& g_;
  const LinkageSketch& s_;
  const LinkageStructure& all_;
  const LinkPoses& drawn_;
  long double same_;  // length within which places agree [m]
  ParallelMotion motion_;
  std::array<std::optional<SketchSpot>, LinkageSketch::most_points> arm_;
};

}  // namespace

std::optional<ParallelMotion> parallel_motion(const AssurGroup& g, const LinkageSketch& s, const LinkageStructure& all,
                                              const LinkPoses& drawn, long double size) {
  for (const int k : g.joints)
    if (all.joints[nth(k)].slides) return {};
  std::vector<int> known = {ground};
  for (auto link = all.order.begin(); std::find(g.links.begin(), g.links.end(), *link) == g.links.end(); ++link)
    known.push_back(*link);
  ParallelTrial trial(g, s, all, drawn, 2e-14L * size);
  for (const int base : known)
    for (const int leader : known)
      for (int p = 0; p < static_cast<int>(s.points.size()); ++p)
        if (base != leader && s.has(base, p) && s.has(leader, p))
          if (auto motion = trial.by(base, leader, p)) return motion;
  return {};
}

void move_in_parallel(const AssurGroup& g, LinkPoses& poses) {
  const ParallelMotion& m = *g.parallel;
  const LinkPose base = poses[m.base], leader = poses[m.leader];
  for (std::size_t i = 0; i < g.links.size(); ++i) {
    const auto& [rod, offset] = m.links[i];
    poses.of(g.links[i]) = {base.at + (leader.turned(offset) - base.turned(offset)), rod ? base.turn : leader.turn};
  }
}

Taylor sine_of(const ParallelMotion& m, const LinkPoses& poses) {
  return cross(poses[m.base].turned(m.along_rods), poses[m.leader].turned(m.along_cranks));
}

}  // namespace kurbel
