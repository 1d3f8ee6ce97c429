// linkage.cpp — checks of the description; the poses of all links, group by group.
#include "mechanisms/linkage/linkage.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>

#include "mechanisms/linkage/parallel_group.h"

namespace kurbel {
namespace {

constexpr int still = LinkageSketch::frame;

std::size_t place_in_list(int i) { return static_cast<std::size_t>(i); }

// Results hold names beyond the linkage's life.
const char* lasting(const std::string& name) {
  static std::mutex mutex;
  static std::set<std::string> names;
  const std::scoped_lock lock(mutex);
  return names.insert(name).first->c_str();
}

}  // namespace

const std::string& LinkageSketch::name_of(int body) const {
  static const std::string of_frame = "frame";
  return body == frame ? of_frame : links[static_cast<std::size_t>(body)].name;
}

Linkage::Linkage(LinkageSketch sketch) : sketch_(std::move(sketch)) {
  if (!check() || !check_links()) return;
  structure_ = structure_of(sketch_, faults_);
  if (!faults_.empty()) return;
  for (const LinkageSketch::Link& link : sketch_.links) link_names_.push_back(lasting(link.name));
  for (const LinkageJoint& j : structure_.joints)
    joint_names_.push_back(lasting(j.slides ? "slide " + sketch_.name_of(j.carrier)
                                            : "pin " + sketch_.points[place_in_list(j.point)].name));
  for (std::size_t p = 0; p < sketch_.points.size(); ++p) size_ = std::max(size_, length(spot_of(static_cast<int>(p))));
  if (sketch_.rounded > 0) take_as_parallel();
  for (const int p : sketch_.links[place_in_list(sketch_.driver)].points)
    if (p != structure_.bearing) {
      const auto &from = sketch_.points[place_in_list(structure_.bearing)], &to = sketch_.points[place_in_list(p)];
      drawn_at_ = std::atan2(static_cast<long double>(to.y) - from.y, static_cast<long double>(to.x) - from.x);
      break;
    }
  explore();
  if (faults_.empty()) find_margins();
  if (faults_.empty()) close_in_parallel();
}

// What must hold before anything is counted. The driving link turns about one bearing, and another link is the output.
bool Linkage::check() {
  const auto& s = sketch_;
  if (s.links.size() < 2 || s.links.size() > s.most_links)
    refuse("links", fmt::format("{} link{} beside the frame; must be 2 … {}", s.links.size(),
                                s.links.size() == 1 ? "" : "s", +s.most_links));
  if (s.points.size() > s.most_points)
    refuse("points", fmt::format("{} points; must be at most {}", s.points.size(), +s.most_points));
  if (!faults_.empty()) return false;
  const LinkageSketch::Link& driver = s.links[place_in_list(s.driver)];
  const auto bearings =
      std::count_if(driver.points.begin(), driver.points.end(), [&](int p) { return s.has(still, p); });
  if (bearings != 1)
    refuse("links." + driver.name,
           fmt::format("the driving link {} has {} points on the frame; must have one, its bearing", driver.name,
                       bearings));
  for (const LinkageSketch::Slide& slide : s.slides)
    if ((slide.link == s.driver && slide.on == still) || slide.link == slide.on)
      refuse("slides." + s.links[place_in_list(slide.link)].name,
             slide.link == slide.on ? "a link does not slide on itself"
                                    : fmt::format("the driving link {} turns about its bearing and cannot slide on the "
                                                  "frame; let another link drive",
                                                  driver.name));
  if (s.output.link == s.driver)
    refuse("output",
           fmt::format("the output is the driving link {} itself; name another link, or a point of one", driver.name));
  return faults_.empty();
}

bool Linkage::check_links() {
  const auto& s = sketch_;
  for (const LinkageSketch::Link& link : s.links) {
    const std::string at = "links." + link.name;
    if (!(link.mass >= 0) || !(link.inertia >= 0) || !std::isfinite(link.com_x) || !std::isfinite(link.com_y))
      refuse(at, fmt::format("mass {} kg, inertia {} kg·m²; both must be ≥ 0", link.mass, link.inertia));
    const bool pinned = std::any_of(link.points.begin(), link.points.end(), [&](int p) { return s.has(still, p); });
    if (link.mass == 0 && link.inertia > 0 && !pinned)
      refuse(at, fmt::format("inertia {:.6g} kg·m² without mass; give {} a mass, or leave the inertia out",
                             link.inertia, link.name));
    for (std::size_t i = 0; i < link.points.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const auto &a = s.points[place_in_list(link.points[i])], &b = s.points[place_in_list(link.points[k])];
        if (a.x == b.x && a.y == b.y)
          refuse(at, fmt::format("{} goes through {} and {}, which stand in one place; draw them apart", link.name,
                                 a.name, b.name));
      }
  }
  if (s.output.rocks() && s.links[place_in_list(s.output.link)].points.size() < 2)
    refuse("output", fmt::format("{} has one point, so that no line of it rocks; name a link of two points, or a point",
                                 s.links[place_in_list(s.output.link)].name));
  return faults_.empty();
}

Linkage::Closed Linkage::close(long double phi, const Shifts& start) const {
  Closed out(sketch_.links.size());
  out.shifts = start;
  out.poses.of(sketch_.driver).turn = Direction::of_variable(phi - drawn_at_);
  for (std::size_t k = 0; k < structure_.groups.size() && close_group(k, out); ++k) continue;
  return out;
}

bool Linkage::close_group(std::size_t k, Closed& out) const {
  const AssurGroup& group = structure_.groups[k];
  if (group.parallel) {
    move_in_parallel(group, out.poses);
    const long double sine = group.changes() ? sine_of(*group.parallel, out.poses).value() : 1;
    out.margin.push_back(sine * sine);
    return true;
  }
  if (group.is_dyad()) {
    out.margin.push_back(close_dyad(group, structure_.joints, out.poses));
  } else {
    const GroupClosure how = close_by_newton(group, structure_.joints, size_, out.poses, out.shifts[k]);
    out.margin.push_back(how.closed ? how.pivot * how.pivot : 0);
  }
  if (!(out.margin.back() > 0)) out.failed = static_cast<int>(k);
  return out.failed < 0;
}

Linkage::Shifts Linkage::predicted(const Node& from, long double phi) const {
  const long double h = phi - from.phi;
  const auto at = [h](const Taylor& t) { return Taylor(t.c[0] + h * (t.c[1] + h * (t.c[2] + h * t.c[3]))); };
  Shifts to = from.shifts;
  for (std::vector<LinkShift>& group : to)
    for (LinkShift& u : group) u = {at(u.x), at(u.y), at(u.angle)};
  return to;
}

Linkage::Shifts Linkage::start_near(long double phi) const {
  if (nodes_.empty()) return {};
  const auto next = std::lower_bound(nodes_.begin(), nodes_.end(), phi,
                                     [](const Node& node, long double at) { return node.phi < at; });
  if (next == nodes_.end()) return predicted(nodes_.back(), phi);
  if (next == nodes_.begin() || next->phi - phi < phi - std::prev(next)->phi) return predicted(*next, phi);
  return predicted(*std::prev(next), phi);
}

std::optional<Taylor> Linkage::change_sine(const LinkPoses& poses) const {
  for (const AssurGroup& group : structure_.groups)
    if (group.changes()) return sine_of(*group.parallel, poses);
  return {};
}

bool Linkage::change_turns_over() const {
  int single = 0;
  for (const AssurGroup& group : structure_.groups) {
    if (group.superfluous > 0) return false;
    single += group.changes() ? 1 : 0;
  }
  return single % 2 == 1;
}

LinkPoses Linkage::poses(long double phi) const {
  const long double turn = 2 * std::acos(-1.0L), cycle = turns_ * turn, begin = nodes_.empty() ? 0 : nodes_.front().phi;
  long double place = phi - begin;
  if (arc_)
    place = arc_->middle + std::remainder(phi - arc_->middle, turn) - begin;
  else
    place -= cycle * std::floor(place / cycle);
  Closed closed = close(begin + place, start_near(begin + place));
  if (closed.failed >= 0)
    throw std::runtime_error(fmt::format("the linkage cannot be closed at φ = {:.6g}°: {}",
                                         static_cast<double>(phi * 360 / turn), stop_in_words(closed)));
  return std::move(closed.poses);
}

SketchSpot Linkage::spot_of(int point) const {
  const LinkageSketch::Point& p = sketch_.points[place_in_list(point)];
  return structure_.axes.spot(p.x, p.y);
}

SketchSpot Linkage::centre_of(int link) const {
  const LinkageSketch::Link& l = sketch_.links[place_in_list(link)];
  return structure_.axes.spot(l.com_x, l.com_y);
}

SketchSpot Linkage::direction_of(int link) const {
  const std::vector<int>& points = sketch_.links[place_in_list(link)].points;
  if (points.size() < 2) return {1, 0};
  // Of the driving link the way that φ is the angle of.
  const bool swapped = link == sketch_.driver && points[0] != structure_.bearing;
  const int from = swapped ? structure_.bearing : points[0], to = swapped ? points[0] : points[1];
  const SketchSpot way = spot_of(to) - spot_of(from);
  return (1 / length(way)) * way;
}

int Linkage::output_point() const {
  if (!sketch_.output.rocks()) return sketch_.output.point;
  const std::vector<int>& points = sketch_.links[place_in_list(sketch_.output.link)].points;
  for (const int p : points)
    if (sketch_.has(still, p)) return p;
  return points.front();
}

std::vector<double> values_of(const LinkageData& data) {
  const LinkageSketch& s = data.linkage->sketch();
  std::vector<double> values = {data.gravity,           s.elevation,    double(s.driver),        double(s.output.link),
                                double(s.output.point), s.output.angle, double(s.points.size()), double(s.links.size()),
                                double(s.slides.size())};
  for (const LinkageSketch::Point& p : s.points) values.insert(values.end(), {p.x, p.y});
  for (const LinkageSketch::Link& l : s.links) {
    values.insert(values.end(), {l.mass, l.com_x, l.com_y, l.inertia, double(l.points.size())});
    for (const int p : l.points) values.push_back(p);
  }
  for (const LinkageSketch::Slide& slide : s.slides)
    values.insert(values.end(), {double(slide.link), double(slide.on), slide.angle});
  for (const int p : s.frame_points) values.push_back(p);
  return values;
}

std::optional<CrankArc> arc_of(const LinkageData& data) { return data.linkage->arc(); }
std::string locks_of(const LinkageData& data) { return data.linkage->locks_in_words(); }
int turns_of(const LinkageData& data) { return data.linkage->turns(); }
double drawn_at(const LinkageData& data) {
  constexpr double beside = 0.3;
  const Linkage& l = *data.linkage;
  const auto at = static_cast<double>(l.drawn_at());
  const auto sine = l.change_sine(l.poses(at));
  return !sine || std::fabs(sine->value()) > 0.1L ? at : l.arc() ? l.arc()->middle : at + beside;
}

std::string undetermined_reactions(const LinkageData& data) {
  for (const AssurGroup& group : data.linkage->structure().groups)
    if (group.superfluous > 0)
      return fmt::format(
          "reactions are not assessed: the links {} have {}, so that play "
          "and elasticity share the forces out",
          links_of(group, data.linkage->sketch()), superfluous_of(group));
  return {};
}

}  // namespace kurbel
