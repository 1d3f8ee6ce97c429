// take_lengths.cpp — the sketch moved to given lengths: Gauss–Newton steps of least norm on the places of its points.
#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "mechanisms/linkage/link_pose.h"
#include "mechanisms/linkage/sketch.h"

namespace kurbel {
namespace {

using Unknowns = Eigen::Matrix<long double, Eigen::Dynamic, 1>;  // x, y of every point
using Slopes = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

SketchSpot point_in(const Unknowns& q, int p) { return {q(2 * p), q(2 * p + 1)}; }
SketchSpot left_of(SketchSpot a) { return {-a.y, a.x}; }

// What must be zero [m], with its derivatives by the points that it is a function of.
struct Condition {
  std::vector<int> points;
  // Value, and a derivative by each of the points in their order.
  std::function<long double(const Unknowns&, std::vector<SketchSpot>&)> of;
};

Condition distance(int a, int b, long double wanted) {
  return {{a, b}, [a, b, wanted](const Unknowns& q, std::vector<SketchSpot>& by) {
            const SketchSpot way = point_in(q, b) - point_in(q, a);
            const long double now = length(way);
            by = {(-1 / now) * way, (1 / now) * way};
            return now - wanted;
          }};
}
// Of the way from a to b across a direction that stands.
Condition across(int a, int b, SketchSpot direction, long double wanted) {
  return {{a, b}, [=](const Unknowns& q, std::vector<SketchSpot>& by) {
            const SketchSpot n = left_of(direction);
            by = {-1 * n, n};
            return dot(n, point_in(q, b) - point_in(q, a)) - wanted;
          }};
}
// Of the way from a to c across that from a to b.
Condition beside(int a, int b, int c, long double wanted) {
  return {{a, b, c}, [=](const Unknowns& q, std::vector<SketchSpot>& by) {
            const SketchSpot way = point_in(q, b) - point_in(q, a), arm = point_in(q, c) - point_in(q, a);
            const long double l = length(way), value = cross(way, arm) / l;
            const SketchSpot by_way = (-1 / l) * left_of(arm) - (value / (l * l)) * way,
                             by_arm = (1 / l) * left_of(way);
            by = {-1 * (by_way + by_arm), by_way, by_arm};
            return value - wanted;
          }};
}
// The way from c to d keeps its angle against that from a to b, times a length.
Condition angle_kept(int a, int b, int c, int d, SketchSpot relative, long double size) {
  return {{a, b, c, d}, [=](const Unknowns& q, std::vector<SketchSpot>& by) {
            const SketchSpot u = point_in(q, b) - point_in(q, a), v = point_in(q, d) - point_in(q, c);
            const SketchSpot turned = {relative.x * u.x - relative.y * u.y, relative.x * u.y + relative.y * u.x};
            const long double scale = size / (length(u) * length(v)), value = scale * cross(turned, v);
            const SketchSpot by_turned = (-scale) * left_of(v);
            const SketchSpot by_u = {relative.x * by_turned.x + relative.y * by_turned.y,
                                     relative.x * by_turned.y - relative.y * by_turned.x};
            const SketchSpot by_v = scale * left_of(turned);
            by = {-1 * by_u, by_u, -1 * by_v, by_v};
            return value;
          }};
}

class LengthsTaker {
 public:
  LengthsTaker(LinkageSketch& s, const std::vector<LinkageSketch::Length>& lengths)
      : s_(s), lengths_(lengths), q_(2 * static_cast<Eigen::Index>(s.points.size())) {
    for (std::size_t p = 0; p < s.points.size(); ++p) {
      q_(2 * static_cast<Eigen::Index>(p)) = s.points[p].x, q_(2 * static_cast<Eigen::Index>(p) + 1) = s.points[p].y;
      for (std::size_t k = 0; k < p; ++k)
        size_ = std::max(size_, length(place(static_cast<int>(p)) - place(static_cast<int>(k))));
    }
    drawn_ = q_;
  }

  LinkageFaults run() {
    for (const LinkageSketch::Length& l : lengths_)
      if (!body_of(l.from, l.to))
        faults_.push_back(
            {"lengths." + l.name, fmt::format("no link has both {} and {}; give lengths of links or of the frame",
                                              s_.points[index(l.from)].name, s_.points[index(l.to)].name)});
    if (!faults_.empty()) return faults_;
    keep_body(LinkageSketch::frame, s_.frame_points);
    for (std::size_t k = 0; k < s_.links.size(); ++k) keep_body(static_cast<int>(k), s_.links[k].points);
    for (const LinkageSketch::Slide& slide : s_.slides) keep_slide(slide);
    if (faults_.empty() && !solve())
      faults_.push_back({"lengths", fmt::format("the linkage cannot be closed near to the sketch with these lengths{}; "
                                                "draw it in a position that is clearer, or check them",
                                                kept_.empty() ? "" : " and with " + kept_ + " as drawn")});
    if (faults_.empty()) put();
    return faults_;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  SketchSpot place(int p) const { return point_in(q_, p); }
  SketchSpot drawn(int p) const { return point_in(drawn_, p); }
  std::optional<int> body_of(int a, int b) const {
    for (int body = LinkageSketch::frame; body < static_cast<int>(s_.links.size()); ++body)
      if (s_.has(body, a) && s_.has(body, b)) return body;
    return {};
  }

  // Given distances of the body first, then as many drawn ones as make it rigid.
  void keep_body(int body, const std::vector<int>& points) {
    struct Side {
      int a, b;
      const LinkageSketch::Length* given;
    };
    std::vector<Side> sides;
    for (const LinkageSketch::Length& l : lengths_)
      if (body_of(l.from, l.to) == body) sides.push_back({l.from, l.to, &l});
    std::vector<int> own = points;
    if (body == LinkageSketch::frame) own = hold_frame();
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) sides.push_back({own[k], own[i], nullptr});
    Slopes rows(0, q_.size());
    for (const Side& side : sides) {
      const long double wanted = side.given ? side.given->value : length(drawn(side.a) - drawn(side.b));
      const Condition condition = distance(side.a, side.b, wanted);
      Slopes more(rows.rows() + 1, q_.size());
      more << rows, row_of(condition, q_);
      Eigen::ColPivHouseholderQR<Slopes> factors(more.transpose());
      factors.setThreshold(1e-10L);
      if (factors.rank() == more.rows()) {
        rows = more;
        conditions_.push_back(condition);
        if (!side.given && !sides.empty() && sides.front().given)
          kept_ += fmt::format("{}{}{}", kept_.empty() ? "" : ", ", s_.points[index(side.a)].name,
                               s_.points[index(side.b)].name);
      } else if (side.given) {
        faults_.push_back(
            {"lengths." + side.given->name,
             fmt::format("{} has more lengths than make it rigid: {} follows from the others; leave one out",
                         s_.name_of(body), side.given->name)});
      }
    }
  }
  // The frame neither moves nor turns: points that no given length ends in stand; of those that one ends in, which are
  // returned, the first stands, and the second moves along its direction from there.
  std::vector<int> hold_frame() {
    std::vector<int> moved;
    for (const int p : s_.frame_points) {
      const bool named = std::any_of(lengths_.begin(), lengths_.end(), [&](const LinkageSketch::Length& l) {
        return (l.from == p || l.to == p) && body_of(l.from, l.to) == LinkageSketch::frame;
      });
      if (named)
        moved.push_back(p);
      else
        hold(p);
    }
    if (moved.empty()) return {};
    hold(moved[0]);
    const SketchSpot way = drawn(moved[1]) - drawn(moved[0]);
    conditions_.push_back(across(moved[0], moved[1], (1 / length(way)) * way, 0));
    return moved;
  }
  void hold(int p) {
    for (const SketchSpot n : {SketchSpot{1, 0}, SketchSpot{0, 1}}) hold_along(n, p);
  }
  void hold_along(SketchSpot n, int p) {
    const long double wanted = dot(n, drawn(p));
    conditions_.push_back({{p}, [=](const Unknowns& q, std::vector<SketchSpot>& by) {
                             by = {n};
                             return dot(n, point_in(q, p)) - wanted;
                           }});
  }

  // A line in a link goes with the first two points of it, a line in the frame or in a link of one point keeps its angle.
  void keep_slide(const LinkageSketch::Slide& slide) {
    const std::vector<int>& mine = s_.links[index(slide.link)].points;
    const SketchSpot along = {std::cos(static_cast<long double>(slide.angle)),
                              std::sin(static_cast<long double>(slide.angle))};
    const int p = mine.front();
    static const std::vector<int> none;
    const std::vector<int>& guide = slide.on == LinkageSketch::frame ? none : s_.links[index(slide.on)].points;
    if (guide.size() > 1) {
      const SketchSpot way = drawn(guide[1]) - drawn(guide[0]);
      const bool through = p == guide[0] || p == guide[1];
      if (!through)
        conditions_.push_back(beside(guide[0], guide[1], p, cross(way, drawn(p) - drawn(guide[0])) / length(way)));
      if (mine.size() > 1) {
        const SketchSpot own = drawn(mine[1]) - drawn(p);
        const long double l = length(way) * length(own);
        conditions_.push_back(
            angle_kept(guide[0], guide[1], p, mine[1], {dot(way, own) / l, cross(way, own) / l}, size_));
      }
      return;
    }
    if (slide.on == LinkageSketch::frame) {
      hold_along(left_of(along), p);
    } else {
      conditions_.push_back(across(guide[0], p, along, dot(left_of(along), drawn(p) - drawn(guide[0]))));
    }
    for (std::size_t k = 1; k < std::min<std::size_t>(mine.size(), 2); ++k) {
      const SketchSpot way = drawn(mine[k]) - drawn(p);
      conditions_.push_back(across(p, mine[k], (1 / length(way)) * way, 0));
    }
  }

  Slopes row_of(const Condition& c, const Unknowns& q, long double* value = nullptr) const {
    Slopes row = Slopes::Zero(1, q.size());
    std::vector<SketchSpot> by;
    const long double now = c.of(q, by);
    if (value) *value = now;
    for (std::size_t k = 0; k < by.size(); ++k) {
      row(0, 2 * c.points[k]) += by[k].x;
      row(0, 2 * c.points[k] + 1) += by[k].y;
    }
    return row;
  }

  bool solve() {
    for (int i = 0; i < 60; ++i) {
      const auto n = static_cast<Eigen::Index>(conditions_.size());
      Slopes rows(n, q_.size());
      Unknowns left(n);
      for (Eigen::Index k = 0; k < n; ++k) rows.row(k) = row_of(conditions_[static_cast<std::size_t>(k)], q_, &left(k));
      const Unknowns step = rows.completeOrthogonalDecomposition().solve(-left);
      const long double way = step.lpNorm<Eigen::Infinity>();
      if (!(way < 1e3L * size_)) return false;
      q_ += way > 0.1L * size_ ? Unknowns(0.1L * size_ / way * step) : step;
      if (left.lpNorm<Eigen::Infinity>() < 1e-16L * size_) return true;
    }
    return false;
  }

  // Slides turn with what they are fixed to, centres of mass with their links.
  void put() {
    for (LinkageSketch::Slide& slide : s_.slides)
      if (slide.on != LinkageSketch::frame) slide.angle += turned(s_.links[index(slide.on)].points);
    for (LinkageSketch::Link& link : s_.links) {
      const int p = link.points.front();
      const auto angle = static_cast<long double>(turned(link.points));
      const SketchSpot arm = SketchSpot{link.com_x, link.com_y} - drawn(p);
      const SketchSpot to = {std::cos(angle) * arm.x - std::sin(angle) * arm.y,
                             std::sin(angle) * arm.x + std::cos(angle) * arm.y};
      link.com_x = static_cast<double>(place(p).x + to.x), link.com_y = static_cast<double>(place(p).y + to.y);
    }
    for (std::size_t p = 0; p < s_.points.size(); ++p) {
      const SketchSpot at = place(static_cast<int>(p));
      s_.points[p].x = static_cast<double>(at.x), s_.points[p].y = static_cast<double>(at.y);
    }
  }
  double turned(const std::vector<int>& points) const {
    if (points.size() < 2) return 0;
    const SketchSpot before = drawn(points[1]) - drawn(points[0]), now = place(points[1]) - place(points[0]);
    return static_cast<double>(std::atan2(cross(before, now), dot(before, now)));
  }

  LinkageSketch& s_;
  const std::vector<LinkageSketch::Length>& lengths_;
  Unknowns q_, drawn_;
  long double size_ = 0;
  std::vector<Condition> conditions_;
  std::string kept_;  // sides that keep the drawn length in a body of which others are given
  LinkageFaults faults_;
};

}  // namespace

LinkageFaults take_lengths(LinkageSketch& sketch, const std::vector<LinkageSketch::Length>& lengths) {
  if (lengths.empty()) return {};
  return LengthsTaker(sketch, lengths).run();
}

}  // namespace kurbel
