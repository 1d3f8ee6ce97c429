// parallel_group.cpp — rods and cranks by trial from pin to pin; what rounding of the sketch leaves between pins.
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

// The links of a group by the points that stand: from each of them on as a rod, else as a crank.
class ParallelTrial {
 public:
  struct Placed {
    ParallelMotion motion;
    std::array<bool, LinkageSketch::most_links> put = {};
    std::array<std::optional<SketchSpot>, LinkageSketch::most_points> arm;  // a point stands at F(x) + (T_K − T_F) arm
    std::array<SketchSpot, LinkageSketch::most_points> spot;
  };

  // Places agree within `same` [m]; cranks move their pins by what is more than `exact`.
  ParallelTrial(const AssurGroup& g, const LinkageSketch& s, const LinkageStructure& all, long double exact,
                long double same)
      : g_(g), s_(s), all_(all), exact_(exact), same_(same) {}

  std::optional<Placed> by(int base, int leader, int bearing) const {
    Placed placed;
    placed.motion.base = base, placed.motion.leader = leader;
    for (std::size_t p = 0; p < s_.points.size(); ++p) placed.spot[p] = all_.axes.spot(s_.points[p].x, s_.points[p].y);
    for (const int p : points_of(leader)) placed.arm[nth(p)] = placed.spot[nth(p)] - placed.spot[nth(bearing)];
    for (const int p : points_of(base)) placed.arm[nth(p)] = SketchSpot{};
    const bool starts = std::all_of(g_.joints.begin(), g_.joints.end(), [&](int k) {
      const LinkageJoint& j = all_.joints[nth(k)];
      return std::find(g_.links.begin(), g_.links.end(), j.a) != g_.links.end() || placed.arm[nth(j.point)];
    });
    if (!starts) return {};
    return continued(placed);
  }
  // The lines of rods and cranks, straight within `same` [m].
  void find_lines(Placed& placed, int bearing, long double same) const {
    ParallelMotion& motion = placed.motion;
    PinLine rods, cranks;
    const auto add = [&](int body, bool is_rod) {
      std::optional<int> first;
      const auto through = [&](int p) {
        if (!s_.has(body, p)) return;
        if (first) (is_rod ? rods : cranks).add(placed.spot[nth(p)] - placed.spot[nth(*first)], same);
        if (!first) first = p;
      };
      through(bearing);
      for (const int k : g_.joints) through(all_.joints[nth(k)].point);
    };
    add(motion.base, true), add(motion.leader, false);
    for (std::size_t i = 0; i < g_.links.size(); ++i) add(g_.links[i], motion.links[i].rod);
    motion.along_rods = rods.along, motion.along_cranks = cranks.along;
    motion.changes = rods.straight && cranks.straight;
  }

 private:
  const std::vector<int>& points_of(int body) const {
    return body == ground ? s_.frame_points : s_.links[nth(body)].points;
  }

  std::optional<Placed> continued(const Placed& placed) const {
    std::optional<std::size_t> next;  // one on the base only after all others: its pins move to those that stand
    const auto on_base = [&](std::size_t i) {
      return first_on(placed.motion.base, points_of(g_.links[i])).has_value();
    };
    for (std::size_t i = 0; i < g_.links.size(); ++i) {
      const std::vector<int>& points = points_of(g_.links[i]);
      const bool stands = std::any_of(points.begin(), points.end(), [&](int p) { return placed.arm[nth(p)]; });
      if (stands && !placed.put[i] && (!next || (on_base(*next) && !on_base(i)))) next = i;
    }
    if (!next) {
      const auto count = std::count(placed.put.begin(), placed.put.end(), true);
      return nth(static_cast<int>(count)) == g_.links.size() ? std::optional(placed) : std::nullopt;
    }
    for (const bool rod : {true, false}) {
      Placed with = placed;
      if (!put(with, *next, rod)) continue;
      if (auto all = continued(with)) return all;
    }
    return {};
  }
  std::optional<int> first_on(int body, const std::vector<int>& points) const {
    const auto found = std::find_if(points.begin(), points.end(), [&](int p) { return s_.has(body, p); });
    return found == points.end() ? std::nullopt : std::optional(*found);
  }
  bool put(Placed& to, std::size_t i, bool rod) const {
    const std::vector<int>& points = points_of(g_.links[i]);
    const auto own = [&](int p) { return rod ? SketchSpot{} : to.spot[nth(p)]; };
    const auto stands = std::find_if(points.begin(), points.end(), [&](int p) { return to.arm[nth(p)]; });
    const int from = first_on(to.motion.base, points).value_or(*stands);
    const SketchSpot offset = *to.arm[nth(from)] - own(from);
    to.motion.links[i] = {rod, offset}, to.put[i] = true;
    for (const int p : points) {
      const SketchSpot wanted = offset + own(p);
      if (!to.arm[nth(p)]) to.arm[nth(p)] = wanted;
      const SketchSpot off = *to.arm[nth(p)] - wanted;
      if (length(off) <= exact_) continue;
      if (length(off) > same_ || rod || s_.has(to.motion.base, p) || s_.has(to.motion.leader, p)) return false;
      to.spot[nth(p)] = to.spot[nth(p)] + off;
    }
    return true;
  }

  const AssurGroup& g_;
  const LinkageSketch& s_;
  const LinkageStructure& all_;
  long double exact_, same_;
};

constexpr long double exactly = 2e-14L;  // of the size: rounding of doubles

// Of coordinates that are rounded, what pins and lines may differ by: four coordinates with half a unit of their last place
// each; of that at most this part of the size.
long double rounding(const LinkageSketch& s, long double size, long double most) {
  return std::max(exactly * size, std::min(6 * static_cast<long double>(s.rounded), most * size));
}
constexpr long double hardly = 1e-4L, clearly = 1e-3L;

// Calls found(base, leader, bearing) for pairs of links before the group that are pinned together, until it returns true.
template <class Found>
void find_pair(const AssurGroup& g, const LinkageSketch& s, const LinkageStructure& all, const Found& found) {
  for (const int k : g.joints)
    if (all.joints[nth(k)].slides) return;
  std::vector<int> known = {ground};
  for (auto link = all.order.begin(); std::find(g.links.begin(), g.links.end(), *link) == g.links.end(); ++link)
    known.push_back(*link);
  for (const int base : known)
    for (const int leader : known)
      for (int p = 0; p < static_cast<int>(s.points.size()); ++p)
        if (base != leader && s.has(base, p) && s.has(leader, p) && found(base, leader, p)) return;
}

}  // namespace

std::optional<ParallelMotion> parallel_motion(const AssurGroup& g, const LinkageSketch& s, const LinkageStructure& all,
                                              const LinkPoses& poses, long double size) {
  constexpr long double turning = 1e-3L;
  std::optional<ParallelMotion> motion;
  const ParallelTrial trial(g, s, all, exactly * size, exactly * size);
  find_pair(g, s, all, [&](int base, int leader, int bearing) {
    if (std::fabs(poses[base].turn.rate().value() - poses[leader].turn.rate().value()) < turning) return false;
    auto placed = trial.by(base, leader, bearing);
    if (!placed) return false;
    trial.find_lines(*placed, bearing, rounding(s, size, hardly));
    motion = placed->motion;
    return true;
  });
  return motion;
}

std::optional<std::vector<MovedPoint>> parallel_pins(const AssurGroup& g, const LinkageSketch& s,
                                                     const LinkageStructure& all, long double size) {
  std::optional<std::vector<MovedPoint>> moved;
  const ParallelTrial trial(g, s, all, exactly * size, rounding(s, size, g.superfluous > 0 ? clearly : hardly));
  find_pair(g, s, all, [&](int base, int leader, int bearing) {
    const auto placed = trial.by(base, leader, bearing);
    if (!placed) return false;
    moved.emplace();
    for (int p = 0; p < static_cast<int>(s.points.size()); ++p) {
      const SketchSpot by = placed->spot[nth(p)] - all.axes.spot(s.points[nth(p)].x, s.points[nth(p)].y);
      if (length(by) > 0) moved->push_back({p, all.axes.in_sketch(by)});
    }
    return true;
  });
  return moved;
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
