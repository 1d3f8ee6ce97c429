// motion_plans.cpp — motions of the links' points, and the parts that they are made of.
#include "studies/worksheet/motion_plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <string_view>

namespace kurbel {
namespace {

using Real = long double;
using Vector = std::complex<Real>;
const Vector across(0, 1);  // turns by 90°

// Of a point, or of a link: about its centre of mass.
struct Motion {
  Vector place, velocity, acceleration;
};
PlanePoint rounded(Vector v) { return {static_cast<double>(v.real()), static_cast<double>(v.imag())}; }

struct PointOfLink {
  std::string name;  // "B"; "A3": of link 3, under A
  Motion motion;
  bool fixed = false;  // in the frame
};
struct Slide {
  std::string point, under;
  Motion of_point, of_under;
  Real omega = 0;  // of the link that has the point under it
};

Real size_of_changes(const Path& p) {
  Real sum = 0;
  for (int k = 1; k <= Taylor::order; ++k) sum += std::abs(p.x.c[k]) + std::abs(p.y.c[k]);
  return sum;
}

class Points {
 public:
  Points(const MechanismOnSheet& m, const LinkAt& at)
      : m_(m),
        w_(static_cast<Real>(m.ratio) * at.omega),
        e_(static_cast<Real>(m.ratio) * at.alpha),
        l_(m.mechanism.data.linkage(m.crank_angle(at.phi))),
        of_link_(l_.bodies.size()) {
    // Names follow from positions, so they are taken away from a dead centre, where joints may coincide.
    const double apart = m.crank_angle(0.7);
    const PlanarLinkage there = m.mechanism.data.linkage(apart);
    const std::vector<PlanePoint> drawn = m.joints(apart);
    for (std::size_t k = 0; k < l_.joints.size(); ++k) {
      const Path& place = there.joints[k].at;
      const auto near = std::find_if(drawn.begin(), drawn.end(), [&](PlanePoint p) {
        return std::hypot(p.x - place.x.value(), p.y - place.y.value()) < 1e-9L;
      });
      const std::string letter = near == drawn.end() ? "" : m.letter(static_cast<std::size_t>(near - drawn.begin()));
      add_joint(l_.joints[k], letter.empty() ? fmt::format("K{}", k + 1) : letter);
    }
  }

  const PlanarLinkage& linkage() const { return l_; }
  const std::vector<Slide>& slides() const { return slides_; }
  std::size_t links() const { return of_link_.size(); }
  const std::vector<PointOfLink>& of_link(std::size_t i) const { return of_link_[i]; }
  Real omega(int body) const { return body == PlanarLinkage::frame ? 0 : turning(body).value() * w_; }
  Real alpha(int body) const { return turning(body).slope() * w_ * w_ + turning(body).value() * e_; }

  Motion motion_of(const Path& p) const {
    return {Vector(p.x.value(), p.y.value()), w_ * Vector(p.x.slope(), p.y.slope()),
            w_ * w_ * Vector(p.x.curvature(), p.y.curvature()) + e_ * Vector(p.x.slope(), p.y.slope())};
  }

  // The point from which a link's motion is drawn: its fixed bearing, else its first joint.
  const PointOfLink& base(std::size_t i) const {
    const auto fixed =
        std::find_if(of_link_[i].begin(), of_link_[i].end(), [](const PointOfLink& p) { return p.fixed; });
    return fixed == of_link_[i].end() ? of_link_[i].front() : *fixed;
  }

 private:
  Taylor turning(int body) const { return l_.bodies[static_cast<std::size_t>(body)].direction.rate(); }

  Motion of_body_at(int body, Vector place) const {
    if (body == PlanarLinkage::frame) return {place, 0, 0};
    const Motion com = motion_of(l_.bodies[static_cast<std::size_t>(body)].com);
    const Vector way = place - com.place;
    const Real w = omega(body);
    return {place, com.velocity + w * across * way, com.acceleration + alpha(body) * across * way - w * w * way};
  }
  // By how much the joint moves against a body.
  Real moves_in(int body, const Path& at) const {
    if (body == PlanarLinkage::frame) return size_of_changes(at);
    const PlanarLinkage::Body& b = l_.bodies[static_cast<std::size_t>(body)];
    const Path way = at - b.com;
    const Direction& d = b.direction;
    return size_of_changes({way.x * d.cos + way.y * d.sin, way.y * d.cos - way.x * d.sin});
  }
  void add(int body, const PointOfLink& point) {
    if (body == PlanarLinkage::frame) return;
    std::vector<PointOfLink>& list = of_link_[static_cast<std::size_t>(body)];
    if (std::none_of(list.begin(), list.end(), [&](const PointOfLink& p) { return p.name == point.name; }))
      list.push_back(point);
  }
  void add_joint(const PlanarLinkage::Joint& j, const std::string& name) {
    const Motion motion = motion_of(j.at);
    if (!j.slides) {
      const bool fixed = j.from == PlanarLinkage::frame || j.on == PlanarLinkage::frame;
      add(j.from, {name, motion, fixed});
      add(j.on, {name, motion, fixed});
      return;
    }
    const bool first = moves_in(j.from, j.at) <= moves_in(j.on, j.at);
    const int carrier = first ? j.from : j.on, line = first ? j.on : j.from;
    add(carrier, {name, motion, false});
    if (line == PlanarLinkage::frame) return;  // it moves along a guide at rest
    const Motion under = of_body_at(line, motion.place);
    const std::string there = fmt::format("{}{}", name, line + 1);
    add(line, {there, under, false});
    slides_.push_back({name, there, motion, under, omega(line)});
  }

  const MechanismOnSheet& m_;
  Real w_, e_;  // of the crank
  PlanarLinkage l_;
  std::vector<std::vector<PointOfLink>> of_link_;
  std::vector<Slide> slides_;
};

// "a_3" of "A3": as points of a plan are called.
std::string in_plan(const std::string& point, const std::string& behind) {
  std::string name;
  for (const char c : point) {
    if (std::isdigit(static_cast<unsigned char>(c)) && name.size() == 1) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name + behind;
}

// The plan's points, absolute vectors to them and, in between, the parts; `get`: of which vectors it is.
template <class Parts>
VectorPlan plan_of(const MechanismOnSheet& m, const LinkAt& at, const std::string& label, Vector Motion::*get,
                   const std::string& prime, const Parts& parts) {
  const Points points(m, at);
  VectorPlan plan{.title = label};
  plan.points.push_back({prime.empty() ? "p_v" : "p_a", {0, 0}});
  std::vector<std::string> known;
  const auto add_point = [&](const std::string& name, const Motion& motion, Pen pen) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    known.push_back(name);
    plan.points.push_back({in_plan(name, prime), rounded(motion.*get)});
    plan.arrows.push_back({"", {0, 0}, rounded(motion.*get), pen});
  };
  for (std::size_t i = 0; i < points.links(); ++i)
    for (const PointOfLink& p : points.of_link(i))
      if (!p.fixed) add_point(p.name, p.motion, Pen::main);
  for (int i = 0; i < points.linkage().body_count; ++i) {
    const Motion com = points.motion_of(points.linkage().bodies[static_cast<std::size_t>(i)].com);
    const auto stands_there = [&](const PointOfLink& p) { return std::abs(p.motion.place - com.place) < 1e-12L; };
    const std::vector<PointOfLink>& list = points.of_link(static_cast<std::size_t>(i));
    if (points.linkage().bodies[static_cast<std::size_t>(i)].mass > 0 &&
        std::none_of(list.begin(), list.end(), stands_there))
      add_point(fmt::format("S{}", i + 1), com, Pen::path);
  }
  Real largest = 0;
  for (const VectorPlan::Point& p : plan.points) largest = std::max<Real>(largest, std::hypot(p.at.x, p.at.y));
  const auto put = [&](const std::string& name, Vector from, Vector part, Pen pen) {
    if (std::abs(part) > 1e-12L * largest) plan.arrows.push_back({name, rounded(from), rounded(from + part), pen});
  };
  for (std::size_t i = 0; i < points.links(); ++i)
    for (const PointOfLink& p : points.of_link(i))
      if (!p.fixed && &p != &points.base(i)) parts(points, static_cast<int>(i), points.base(i), p, put);
  for (const Slide& s : points.slides()) parts(s, put);
  return plan;
}

struct VelocityParts {
  // About a fixed bearing the absolute velocity is it.
  template <class Put>
  void operator()(const Points& points, int link, const PointOfLink& base, const PointOfLink& p, const Put& put) const {
    const Vector way = p.motion.place - base.motion.place;
    if (!base.fixed) put("v_" + p.name + base.name, base.motion.velocity, points.omega(link) * across * way, Pen::load);
  }
  template <class Put>
  void operator()(const Slide& s, const Put& put) const {
    put("v_" + s.point + s.under, s.of_under.velocity, s.of_point.velocity - s.of_under.velocity, Pen::accent);
  }
};

struct AccelerationParts {
  template <class Put>
  void operator()(const Points& points, int link, const PointOfLink& base, const PointOfLink& p, const Put& put) const {
    const Vector way = p.motion.place - base.motion.place, from = base.motion.acceleration;
    const Real w = points.omega(link);
    const std::string of = "_" + p.name + (base.fixed ? "" : base.name);
    put("aⁿ" + of, from, -w * w * way, Pen::load);
    put("aᵗ" + of, from - w * w * way, points.alpha(link) * across * way, Pen::load);
  }
  template <class Put>
  void operator()(const Slide& s, const Put& put) const {
    const Vector from = s.of_under.acceleration,
                 coriolis = 2 * s.omega * across * (s.of_point.velocity - s.of_under.velocity);
    put("aᶜ_" + s.point + s.under, from, coriolis, Pen::accent);
    put("aʳ_" + s.point + s.under, from + coriolis, s.of_point.acceleration - from - coriolis, Pen::accent);
  }
};

}  // namespace

VectorPlan velocity_plan(const MechanismOnSheet& m, const LinkAt& at, const std::string& label) {
  return plan_of(m, at, label, &Motion::velocity, "", VelocityParts());
}

VectorPlan acceleration_plan(const MechanismOnSheet& m, const LinkAt& at, const std::string& label) {
  return plan_of(m, at, label, &Motion::acceleration, "′", AccelerationParts());
}

void add_motion_plans(Sheets& sheets, const MechanismOnSheet& m, const SheetMotion& motion, const std::string& speed) {
  std::vector<VectorPlan> velocities, accelerations;
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    velocities.push_back(velocity_plan(m, motion.at[k], motion.positions[k].label));
    accelerations.push_back(acceleration_plan(m, motion.at[k], motion.positions[k].label));
  }
  const double direction = m.mechanism.data.drawing().direction;
  const std::string digits =
      "A digit behind a letter: the point of that link which the slide's point covers. Parts under 1.2 mm are not "
      "named; ";
  add_plans(
      sheets,
      {.what = m.mechanism.name + ": plans of velocity",
       .note = "From the pole p_v: velocities of the points a, b … of the pins A, B …, and of the centres of mass "
               "s. v_BA: of B against A of the same link, across BA; along a slide, of its point against the link "
               "below. " +
               digits + speed + ".",
       .scale = "μ_v",
       .unit = "m/s",
       .direction = direction},
      velocities);
  add_plans(sheets,
            {.what = m.mechanism.name + ": plans of acceleration",
             .note = "From the pole p_a: accelerations. aⁿ_BA = ω² BA from B to A, aᵗ_BA = ε BA across it; on a slide "
                     "Coriolis’ aᶜ = 2 ω v across it and aʳ along it. " +
                     digits + speed + ".",
             .scale = "μ_a",
             .unit = "m/s²",
             .direction = direction,
             .each_to_its_own = true},
            accelerations);
}

std::string reaction_symbol(const LinkageForces& f, const std::string& from, const std::string& on) {
  const auto number = [&](const std::string& body) {
    for (std::size_t i = 0; i < f.links.size(); ++i)
      if (body == f.links[i].name) return i + 1;
    return std::size_t{0};
  };
  return fmt::format("R_{}{}", number(from), number(on));
}

std::vector<VectorPlan> force_polygons(const LinkageForces& f, const PlanarLinkage& l, const std::string& label) {
  std::vector<VectorPlan> plans;
  const Force2 down = {-std::sin(l.elevation), -std::cos(l.elevation)};
  for (std::size_t i = 0; i < f.links.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    VectorPlan plan{.title = fmt::format("{}: {} {}", label, number, f.links[i].name)};
    Force2 end;
    const auto add = [&](const std::string& name, Force2 force, Pen pen) {
      if (force.magnitude() == 0) return;
      const Force2 begin = end;
      end = begin + force;
      plan.arrows.push_back({name, {begin.x, begin.y}, {end.x, end.y}, pen});
    };
    if (i + 1 == f.links.size() && !l.rocks) add("F", {f.state.load, 0}, Pen::load);
    for (const AppliedForce& a : f.state.applied)
      if (a.body == static_cast<int>(i)) add("F_a" + number, a.force, Pen::load);
    add("G_" + number, l.bodies[i].mass * l.gravity * down, Pen::drive);
    add("F_" + number, f.links[i].inertia_force, Pen::accent);
    for (const JointForces& j : f.joints) {
      const bool on = j.on == std::string_view(f.links[i].name), from = j.from == std::string_view(f.links[i].name);
      if (!on && !from) continue;
      const std::string symbol = on ? reaction_symbol(f, j.from, j.on) : reaction_symbol(f, j.on, j.from);
      const double sense = on ? 1 : -1;
      add(symbol, sense * j.force, Pen::main);
      if (j.slides)
        add("T" + symbol.substr(1), sense * j.friction * Force2{std::cos(j.along), std::sin(j.along)}, Pen::edge);
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace kurbel
