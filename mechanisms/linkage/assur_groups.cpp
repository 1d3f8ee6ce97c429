// assur_groups.cpp — sets of links by count, the smallest first; what is left over, in words.
#include "mechanisms/linkage/assur_groups.h"

#include <fmt/core.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <optional>

#include "mechanisms/linkage/newton_group.h"

namespace kurbel {
namespace {

using Links = std::uint32_t;  // a set: bit i is link i
constexpr int frame = LinkageSketch::frame;

Links one(int link) { return Links(1) << link; }
int count_of(Links links) { return static_cast<int>(std::bitset<32>(links).count()); }
std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

class Decomposer {
 public:
  Decomposer(const LinkageSketch& sketch, LinkageStructure& into) : s_(sketch), out_(into), at_(s_.points.size()) {
    for (std::size_t k = 0; k < s_.links.size(); ++k)
      for (const int p : s_.links[k].points) at_[index_of(p)] |= one(static_cast<int>(k));
  }

  // Links that no group holds.
  Links run() {
    const Links all = static_cast<Links>((std::uint64_t(1) << s_.links.size()) - 1);
    Links known = one(s_.driver);
    out_.order = {s_.driver};
    out_.freedom = 3 * static_cast<int>(s_.links.size()) - 2 * joints(all, 0);
    while (const Links left = all & ~known) {
      const std::optional<Links> group = next_group(left, known);
      if (!group) return left;
      AssurGroup g;
      for (int k = 0; k < static_cast<int>(s_.links.size()); ++k)
        if (*group & one(k)) g.links.push_back(k);
      g.superfluous = 2 * joints(*group, known) - 3 * count_of(*group);
      out_.order.insert(out_.order.end(), g.links.begin(), g.links.end());
      out_.groups.push_back(std::move(g));
      known |= *group;
    }
    return 0;
  }

  // Joints of these links with each other, with known ones and with the frame.
  int joints(Links links, Links known) const {
    int sum = 0;
    for (std::size_t p = 0; p < at_.size(); ++p) {
      const int own = count_of(at_[p] & links);
      if (own > 0) sum += own - 1 + ((at_[p] & known) || s_.has(frame, static_cast<int>(p)) ? 1 : 0);
    }
    for (const LinkageSketch::Slide& slide : s_.slides) {
      const Links a = one(slide.link), b = slide.on == frame ? 0 : one(slide.on), within = links | known;
      const bool both = (a & within) && (b == 0 || (b & within));
      if (both && ((a | b) & links)) ++sum;
    }
    return sum;
  }

 private:
  // The smallest set that adds no freedom, no part of which is held too often; where that is part of one with more joints
  // than it needs, this one.
  std::optional<Links> next_group(Links left, Links known) const {
    std::vector<Links> subsets;
    for (Links sub = left; sub; sub = (sub - 1) & left) subsets.push_back(sub);
    std::stable_sort(subsets.begin(), subsets.end(), [](Links a, Links b) { return count_of(a) < count_of(b); });
    std::optional<Links> exact;
    std::vector<Links> over;
    for (const Links sub : subsets) {
      const int freedom = 3 * count_of(sub) - 2 * joints(sub, known);
      const auto within = [sub](Links part) { return (part & ~sub) == 0; };
      if (freedom == 0 && !exact && std::none_of(over.begin(), over.end(), within)) exact = sub;
      if (freedom < 0) over.push_back(sub);
    }
    if (!over.empty() && (!exact || (*exact & ~over.front()) == 0)) return over.front();
    return exact;
  }

  const LinkageSketch& s_;
  LinkageStructure& out_;
  std::vector<Links> at_;  // by point
};

// Pins lead to the first body that has the point, slides to the body that comes first.
void add_joints(const LinkageSketch& s, LinkageStructure& out) {
  const auto rank = [&](int body) {
    if (body == frame) return -1;
    return static_cast<int>(std::find(out.order.begin(), out.order.end(), body) - out.order.begin());
  };
  std::vector<LinkageJoint> joints;
  for (int p = 0; p < static_cast<int>(s.points.size()); ++p) {
    std::vector<int> bodies;
    if (s.has(frame, p)) bodies.push_back(frame);
    for (const int link : out.order)
      if (s.has(link, p)) bodies.push_back(link);
    const LinkageSketch::Point& point = s.points[index_of(p)];
    for (std::size_t k = 1; k < bodies.size(); ++k)
      joints.push_back({bodies[0], bodies[k], false, p, bodies[k], out.axes.spot(point.x, point.y), {}});
  }
  for (const LinkageSketch::Slide& slide : s.slides) {
    const int p = s.links[index_of(slide.link)].points.front();
    const LinkageSketch::Point& point = s.points[index_of(p)];
    const bool first = rank(slide.on) < rank(slide.link);
    joints.push_back({first ? slide.on : slide.link, first ? slide.link : slide.on, true, p, slide.link,
                      out.axes.spot(point.x, point.y), out.axes.direction(slide.angle)});
  }
  // The bearing, then those on the driving link, so that the second one does not stand in the bearing.
  const auto place = [&](const LinkageJoint& j) {
    const bool on_driver = j.a == s.driver && j.point != out.bearing;
    return std::pair(j.b == s.driver ? 0 : on_driver ? 1 : 2, rank(j.b));
  };
  std::stable_sort(joints.begin(), joints.end(),
                   [&](const LinkageJoint& a, const LinkageJoint& b) { return place(a) < place(b); });
  out.joints = std::move(joints);
}

// Two links with one joint between them and one outwards each.
void name_dyad(const std::vector<LinkageJoint>& joints, AssurGroup& g) {
  if (g.links.size() != 2 || g.joints.size() != 3 || g.superfluous != 0) return;
  int first = g.links[0], second = g.links[1];
  const auto within = [&](const LinkageJoint& j) {
    return (j.a == first || j.a == second) && (j.b == first || j.b == second);
  };
  std::optional<int> inner, of_first, of_second;
  for (const int k : g.joints) {
    const LinkageJoint& j = joints[index_of(k)];
    std::optional<int>& to = within(j) ? inner : j.b == first ? of_first : of_second;
    if (to) return;
    to = k;
  }
  if (!inner || !of_first || !of_second) return;
  const auto slides = [&](int k) { return joints[index_of(k)].slides; };
  if (slides(*of_first) && !slides(*of_second)) std::swap(first, second), std::swap(of_first, of_second);
  const bool a = slides(*of_first), b = slides(*inner), c = slides(*of_second);
  if (a && b) return;  // three slides: the dyad cannot turn, and its closure is none
  g.form = a   ? AssurGroup::Form::prp
           : b ? (c ? AssurGroup::Form::rpp : AssurGroup::Form::rpr)
               : (c ? AssurGroup::Form::rrp : AssurGroup::Form::rrr);
  g.links = {first, second};
  g.joints = {*of_first, *inner, *of_second};
}

// Sides of the shortest closed contour of links and inner joints; 0: there is none.
int contour(const std::vector<LinkageJoint>& joints, const AssurGroup& g) {
  int shortest = 0;
  const auto inner = [&](int k) {
    return std::find(g.links.begin(), g.links.end(), joints[index_of(k)].a) != g.links.end();
  };
  for (const int closing : g.joints) {
    if (!inner(closing)) continue;
    // Links at one, two, … joints from one of its ends, without itself.
    std::vector<std::pair<int, int>> reached = {{joints[index_of(closing)].a, 1}};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const auto [link, sides] = reached[i];
      if (link == joints[index_of(closing)].b) shortest = shortest == 0 ? sides : std::min(shortest, sides);
      for (const int k : g.joints) {
        const LinkageJoint& j = joints[index_of(k)];
        if (k == closing || !inner(k) || (j.a != link && j.b != link)) continue;
        const int next = j.other(link);
        if (std::none_of(reached.begin(), reached.end(), [&](const auto& r) { return r.first == next; }))
          reached.emplace_back(next, sides + 1);
      }
    }
  }
  return shortest;
}

void describe_groups(LinkageStructure& out) {
  for (AssurGroup& g : out.groups) {
    const auto mine = [&](int link) { return std::find(g.links.begin(), g.links.end(), link) != g.links.end(); };
    g.order = 0;
    for (int k = 0; k < static_cast<int>(out.joints.size()); ++k) {
      if (!mine(out.joints[index_of(k)].b)) continue;
      g.joints.push_back(k);
      if (!mine(out.joints[index_of(k)].a)) ++g.order;
    }
    name_dyad(out.joints, g);
    if (!g.is_dyad() && g.links.size() > 2) g.group_class = std::max(3, contour(out.joints, g));
  }
}

std::string names_of(Links links, const LinkageSketch& s) {
  std::string text;
  for (int k = 0; k < static_cast<int>(s.links.size()); ++k)
    if (links & one(k)) text += (text.empty() ? "" : ", ") + s.links[index_of(k)].name;
  return text;
}

// Why some links are in no group.
void report_left_over(const LinkageSketch& s, const Decomposer& parts, Links left, const LinkageStructure& out,
                      LinkageFaults& faults) {
  for (int k = 0; k < static_cast<int>(s.links.size()); ++k)
    if ((left & one(k)) && parts.joints(one(k), static_cast<Links>(~one(k))) == 0) {
      faults.push_back(
          {"links." + s.links[index_of(k)].name,
           fmt::format("{} is connected with nothing: no other link and not the frame has one of its points; "
                       "let them share a point, or give it a slide",
                       s.links[index_of(k)].name)});
      return;
    }
  const int n = static_cast<int>(s.links.size()), p = (3 * n - out.freedom) / 2;
  const int actual = 3 * n - closure_rank(out);
  std::string count = fmt::format("degrees of freedom: 3·{} − 2·{} = {}", n, p, out.freedom);
  if (actual != out.freedom) count += fmt::format(", in this position {}", actual);
  for (const AssurGroup& g : out.groups)
    if (g.superfluous > 0) count += fmt::format("; the links {} have {}", links_of(g, s), superfluous_of(g));
  if (out.freedom != 1) count += "; must be 1";
  faults.push_back({"links", fmt::format("{}. The driving link {} does not determine: {}; pin or guide one of "
                                         "them once more for each degree of freedom too many",
                                         count, s.links[index_of(s.driver)].name, names_of(left, s))});
}

}  // namespace

SketchAxes::SketchAxes(const LinkageSketch& sketch, int bearing) {
  const LinkageSketch::Point& origin = sketch.points[index_of(bearing)];
  x_ = origin.x, y_ = origin.y;
  if (sketch.output.rocks()) return;
  turned_ = sketch.output.angle;
  cos_ = std::cos(static_cast<long double>(turned_)), sin_ = std::sin(static_cast<long double>(turned_));
}

SketchSpot SketchAxes::spot(double x, double y) const {
  const long double u = x - x_, v = y - y_;
  return {cos_ * u + sin_ * v, cos_ * v - sin_ * u};
}

SketchSpot SketchAxes::direction(double angle) const {
  const long double a = static_cast<long double>(angle) - turned_;
  return {std::cos(a), std::sin(a)};
}

LinkageStructure structure_of(const LinkageSketch& s, LinkageFaults& faults) {
  LinkageStructure out;
  for (const int p : s.links[index_of(s.driver)].points)
    if (s.has(frame, p)) out.bearing = p;
  out.axes = SketchAxes(s, out.bearing);
  Decomposer parts(s, out);
  const Links left = parts.run();
  for (int k = 0; k < static_cast<int>(s.links.size()); ++k)
    if (left & one(k)) out.order.push_back(k);
  add_joints(s, out);
  if (left)
    report_left_over(s, parts, left, out, faults);
  else
    describe_groups(out);
  return out;
}

std::string name_of(const AssurGroup& g) {
  switch (g.form) {
    case AssurGroup::Form::rrr:
      return "RRR";
    case AssurGroup::Form::rrp:
      return "RRP";
    case AssurGroup::Form::rpr:
      return "RPR";
    case AssurGroup::Form::prp:
      return "PRP";
    case AssurGroup::Form::rpp:
      return "RPP";
    case AssurGroup::Form::newton:
      break;
  }
  const char* const roman[] = {"0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X"};
  return fmt::format("class {} of order {}", roman[std::min(g.group_class, 10)], g.order);
}

std::string superfluous_of(const AssurGroup& g) {
  return fmt::format("{} closure{} more than they need", g.superfluous, g.superfluous == 1 ? "" : "s");
}

std::string links_of(const AssurGroup& g, const LinkageSketch& s) {
  std::string text;
  for (const int link : g.links) text += (text.empty() ? "" : ", ") + s.links[index_of(link)].name;
  return text;
}

}  // namespace kurbel
