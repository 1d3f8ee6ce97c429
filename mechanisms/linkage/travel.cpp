// travel.cpp — travels within a linkage from the poses of its links, with their derivatives.
#include "mechanisms/linkage/travel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

using Of = LinkageTravel::Of;

Path place_of(const Linkage& l, const LinkPoses& poses, const LinkageTravel::Place& place) {
  return poses[place.body](l.spot_of(place.point));
}
Path rate_of(const Path& p) { return {p.x.derivative(), p.y.derivative()}; }
Path constant(SketchSpot s) { return {Taylor(s.x), Taylor(s.y)}; }
SketchSpot values_in(const Path& p) { return {p.x.value(), p.y.value()}; }

// s from its rate, whose last coefficient is none.
Taylor from_rate(const Taylor& rate) {
  Taylor s;
  for (int k = 0; k < Taylor::order; ++k) s.c[k + 1] = rate.c[k] / (k + 1);
  return s;
}

// A unit vector along the path.
Path tangent_of(const Linkage& l, const LinkPoses& poses, const LinkageTravel& travel) {
  const Path at = place_of(l, poses, travel.to);
  const PathGuide guide = path_guide(l, travel);
  if (guide.direction) return constant(*guide.direction);
  const Path way = guide.bearing ? at - constant(l.spot_of(*guide.bearing)) : rate_of(at);
  const Taylor part = Taylor(1) / sqrt(dot(way, way));
  return guide.bearing ? part * Path{-way.y, way.x} : part * way;
}

// Of |what| over a cycle: the least, where, and the greatest.
struct LeastOfCycle {
  long double least = HUGE_VALL, at = 0, greatest = 0;
};
template <class What>
LeastOfCycle over_cycle(const Linkage& l, const What& what) {
  const long double turn = 2 * std::acos(-1.0L);
  const long double from = l.arc() ? l.arc()->middle - l.arc()->reach() : 0,
                    way = l.arc() ? 2 * l.arc()->reach() : l.turns() * turn;
  const int steps = 360 * l.turns();
  LeastOfCycle found;
  for (int i = 0; i <= steps; ++i) {
    const long double phi = from + way * i / steps, here = std::fabs(what(phi));
    found.greatest = std::max(found.greatest, here);
    if (here < found.least) found.least = here, found.at = phi;
  }
  long double a = found.at - way / steps, b = found.at + way / steps;
  if (l.arc()) a = std::max(a, from), b = std::min(b, from + way);
  for (int i = 0; i < 50; ++i) {
    const long double p = a + (b - a) * 0.382L, q = a + (b - a) * 0.618L;
    if (std::fabs(what(p)) < std::fabs(what(q)))
      b = q;
    else
      a = p;
  }
  found.at = (a + b) / 2;
  found.least = std::min(found.least, std::fabs(what(found.at)));
  return found;
}

}  // namespace

PathGuide path_guide(const Linkage& l, const LinkageTravel& travel) {
  const LinkageSketch& s = l.sketch();
  for (const int p : s.links[static_cast<std::size_t>(travel.to.body)].points)
    if (s.has(LinkageSketch::frame, p)) return {p, {}};
  for (const LinkageSketch::Slide& slide : s.slides)
    if (slide.link == travel.to.body && slide.on == LinkageSketch::frame)
      return {{}, l.structure().axes.direction(slide.angle)};
  return {};
}

Taylor travel_series(const Linkage& l, const LinkPoses& poses, const LinkageTravel& travel) {
  switch (travel.of) {
    case Of::distance: {
      const Path way = place_of(l, poses, travel.to) - place_of(l, poses, travel.from);
      return sqrt(dot(way, way));
    }
    case Of::way:
      return dot(constant(l.structure().axes.direction(travel.angle)), place_of(l, poses, travel.to));
    case Of::path: {
      const Path rate = rate_of(place_of(l, poses, travel.to));
      const PathGuide guide = path_guide(l, travel);
      if (guide.bearing || guide.direction) return from_rate(dot(tangent_of(l, poses, travel), rate));
      return from_rate(sqrt(dot(rate, rate)));
    }
    case Of::rotation:
      break;
  }
  const Direction &to = poses[travel.to.body].turn, from = poses[travel.from.body].turn;
  return Direction{to.cos * from.cos + to.sin * from.sin, to.sin * from.cos - to.cos * from.sin}.series();
}

std::vector<TravelAction> travel_actions(const Linkage& l, const LinkPoses& poses, const LinkageTravel& travel) {
  std::vector<TravelAction> actions;
  const auto act = [&](const LinkageTravel::Place& place, SketchSpot force, long double moment) {
    if (place.body == LinkageSketch::frame) return;
    const SketchSpot at = place.point < 0 ? SketchSpot{} : values_in(place_of(l, poses, place));
    actions.push_back({place.body, at, force, moment});
  };
  if (travel.of == Of::rotation) {
    act({travel.to.body, -1}, {}, 1), act({travel.from.body, -1}, {}, -1);
  } else if (travel.of == Of::distance) {
    const SketchSpot way = values_in(place_of(l, poses, travel.to) - place_of(l, poses, travel.from));
    const SketchSpot along = (1 / length(way)) * way;
    act(travel.to, along, 0), act(travel.from, -1 * along, 0);
  } else {
    const bool way = travel.of == Of::way;
    act(travel.to, way ? l.structure().axes.direction(travel.angle) : values_in(tangent_of(l, poses, travel)), 0);
  }
  return actions;
}

std::string fault_of(const Linkage& l, const LinkageTravel& travel) {
  constexpr long double least = 1e-6L, rounding = 1e-12L;  // of the greatest, of the size
  const auto degrees = [](long double phi) { return static_cast<double>(phi * 180 / std::acos(-1.0L)); };
  if (travel.of == Of::distance) {
    const LeastOfCycle d =
        over_cycle(l, [&](long double phi) { return travel_series(l, l.poses(phi), travel).value(); });
    if (d.least < least * d.greatest)
      return fmt::format(
          "its points come together at φ = {:.4g}°, where a force along their line has no direction; move one of them",
          degrees(d.at));
  }
  const PathGuide guide = travel.of == Of::path ? path_guide(l, travel) : PathGuide{};
  if (travel.of == Of::path && !guide.bearing && !guide.direction) {
    const LeastOfCycle v = over_cycle(l, [&](long double phi) {
      const Path rate = rate_of(place_of(l, l.poses(phi), travel.to));
      return sqrt(Taylor(dot(rate, rate).value())).value();
    });
    if (v.greatest <= rounding * length(l.spot_of(travel.to.point)))
      return "its point stands still, so that its path has no direction; take another point";
    if (v.least < least * v.greatest)
      return fmt::format(
          "its point stands still at φ = {:.4g}°, where its path has a cusp and no direction; take another point, or "
          "give a direction by along",
          degrees(v.at));
  }
  return {};
}

std::vector<double> values_of(const LinkageTravelData& data) {
  const LinkageTravel& t = data.travel;
  std::vector<double> values = values_of(LinkageData{data.linkage, 0});
  values.insert(values.end(), {double(static_cast<int>(t.of)), double(t.from.body), double(t.from.point),
                               double(t.to.body), double(t.to.point), t.angle});
  return values;
}
std::optional<CrankArc> arc_of(const LinkageTravelData& data) { return data.linkage->arc(); }
std::string locks_of(const LinkageTravelData& data) { return data.linkage->locks_in_words(); }

}  // namespace kurbel
