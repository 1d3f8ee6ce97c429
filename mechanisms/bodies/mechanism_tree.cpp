// mechanism_tree.cpp — a tree of Pin and Slider mobilizers through all links, closed by points in planes (C++17 island).
//
// A link's frame has its origin in its pin of the tree and the link's direction. That of a link that slides has it in the
// centre of mass, and the slide's direction: Simbody's sliders move along x.
#include "mechanisms/bodies/mechanism_tree.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "mechanisms/bodies/planar_system.h"

namespace kurbel {
namespace {

constexpr int still = PlanarLinkage::frame;
using Joint = PlanarLinkage::Joint;

int other_end(const Joint& j, int body) { return j.from == body ? j.on : j.from; }
Planar<long double> value_of(const Path& p) { return {p.x.value(), p.y.value()}; }

struct TreeLink {
  int joint = -1;  // of the tree, to the link before
  int parent = still;
  Planar<long double> origin;  // in the parent's frame, of the position in which shapes are read off
  // Of a slider that rides as a point mass on another link: the pin there, and its slide on the frame.
  int pin = -1, slide = -1;
};

class LinkageTree {
 public:
  explicit LinkageTree(const BodiesOf& of)
      : of_(of), drawn_(of.linkage(of.place)), links_(drawn_.bodies.size()), used_(drawn_.joints.size(), false) {
    for (const Joint& j : drawn_.joints) size_ = std::fmax(size_, std::hypot(j.at.x.value(), j.at.y.value()));
    links_[0].joint = 0;
    used_[0] = true;
    for (int k = 1; k < count(); ++k) let_ride(k);
    for (int k = next(); k >= 0; k = next()) attach(k);
    put_in_order();
  }

  const BodiesOf& of() const { return of_; }
  const PlanarLinkage& drawn() const { return drawn_; }
  const std::vector<int>& order() const { return order_; }
  const TreeLink& link(int body) const { return links_[at(body)]; }
  bool rides(int body) const { return body != still && link(body).pin >= 0; }
  // The link that has the body's mass.
  int bearer(int body) const { return rides(body) ? other_end(joint(link(body).pin), body) : body; }
  const Joint& joint(int k) const { return drawn_.joints[at(k)]; }
  std::vector<const Joint*> closing() const {
    std::vector<const Joint*> left;
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (!used_[k]) left.push_back(&drawn_.joints[k]);
    return left;
  }
  bool slides(int body) const { return joint(link(body).joint).slides; }

  // Of a place in the position in which shapes are read off, in the body's frame.
  SimTK::Vec3 station(int body, const Path& place) const {
    const Planar<long double> s = local(body, value_of(place) - value_of(origin(drawn_, body)));
    return {rounded(s.x), rounded(s.y), 0};
  }
  SimTK::Vec3 across(int body, const Direction& of) const {
    const Planar<long double> n = local(body, {-of.sin.value(), of.cos.value()});
    return {std::fabs(n.x) < nothing ? 0 : double(n.x), std::fabs(n.y) < nothing ? 0 : double(n.y), 0};
  }
  // Of the inboard frame against the parent's; of the crank, whose coordinate is φ.
  double tilt(int body) const {
    const TreeLink& l = link(body);
    long double tilt = 0;
    if (slides(body)) tilt = towards(drawn_, body).angle() - towards(drawn_, l.parent).angle();
    if (body == 0) tilt = std::remainder(towards(drawn_, 0).angle() - of_.place, 2 * std::acos(-1.0L));
    return std::fabs(tilt) < nothing ? 0 : double(tilt);
  }

  // Of a link in the tree, where the linkage stands like that; without `series` the value alone.
  Taylor coordinate(const PlanarLinkage& l, int body, bool series) const {
    const TreeLink& to = link(body);
    const Direction own = towards(l, body), before = towards(l, to.parent);
    if (slides(body)) {
      const Path from =
          origin(l, to.parent) + along(before, to.origin.x) + along(Direction{-before.sin, before.cos}, to.origin.y);
      const Path way = origin(l, body) - from;
      return way.x * own.cos + way.y * own.sin;
    }
    const long double c = own.cos.value(), s = own.sin.value(), cb = before.cos.value(), sb = before.sin.value();
    Taylor q(std::atan2(s * cb - c * sb, c * cb + s * sb));
    if (!series) return q;
    const Taylor rate = own.rate() - before.rate();
    for (int k = 0; k < Taylor::order; ++k) q.c[k + 1] = rate.c[k] / (k + 1);
    return q;
  }
  // After the crank's.
  std::vector<Taylor> coordinates(const PlanarLinkage& l, bool series) const {
    std::vector<Taylor> q;
    for (std::size_t k = 1; k < order_.size(); ++k) q.push_back(coordinate(l, order_[k], series));
    return q;
  }

 private:
  // Of the size, and of a radian: what long doubles leave of places that coincide.
  static constexpr long double nothing = 1e-17L;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int count() const { return static_cast<int>(links_.size()); }
  double rounded(long double length) const { return std::fabs(length) < nothing * size_ ? 0 : double(length); }
  Direction towards(const PlanarLinkage& l, int body) const {
    if (body == still) return Direction::constant(0);
    return slides(body) ? l.joints[at(link(body).joint)].along : l.bodies[at(body)].direction;
  }
  Path origin(const PlanarLinkage& l, int body) const {
    if (body == still) return {};
    return slides(body) ? l.bodies[at(body)].com : l.joints[at(link(body).joint)].at;
  }
  Planar<long double> local(int body, Planar<long double> v) const {
    const Direction d = towards(drawn_, body);
    const long double c = d.cos.value(), s = d.sin.value();
    return {c * v.x + s * v.y, c * v.y - s * v.x};
  }

  // What slides on the frame does not turn. With one pin beside, and its centre of mass and all that is read off it in it, it
  // rides on what it is pinned to, and the slide keeps the pin on a line: one closure in place of two.
  void let_ride(int body) {
    int pin = -1, slide = -1, joints = 0;
    for (int k = 0; k < static_cast<int>(used_.size()); ++k) {
      if (joint(k).from != body && joint(k).on != body) continue;
      ++joints;
      const bool on_frame = other_end(joint(k), body) == still;
      if (joint(k).slides && on_frame) slide = k;
      if (!joint(k).slides && !on_frame && !rides(other_end(joint(k), body))) pin = k;
    }
    if (joints != 2 || pin < 0 || slide < 0) return;
    const auto is_off = [&](const Path& place) {
      const Planar<long double> off = value_of(place) - value_of(joint(pin).at);
      return std::hypot(off.x, off.y) > nothing * size_;
    };
    if (is_off(drawn_.bodies[at(body)].com)) return;
    if (body == count() - 1 && !drawn_.rocks && is_off(drawn_.load_at)) return;
    for (const BodiesOf::Place& tracked : of_.tracked)
      if (tracked.body == body && is_off(tracked.at)) return;
    links_[at(body)].pin = pin, links_[at(body)].slide = slide;
    used_[at(pin)] = used_[at(slide)] = true;
  }
  bool stands(int body) const { return body == still || link(body).joint >= 0; }
  // A joint from a link of the tree to one that is in it not yet: slides first, so that closures are pins; then the frame's.
  int next() const {
    int best = -1, least = 4;
    for (int k = 0; k < static_cast<int>(used_.size()); ++k) {
      const Joint& j = joint(k);
      const int rank = (j.slides ? 0 : 2) + (j.from == still || j.on == still ? 0 : 1);
      if (!used_[at(k)] && stands(j.from) != stands(j.on) && rank < least) best = k, least = rank;
    }
    return best;
  }
  void attach(int k) {
    const int parent = stands(joint(k).from) ? joint(k).from : joint(k).on, body = other_end(joint(k), parent);
    TreeLink& to = links_[at(body)];
    to.joint = k, to.parent = parent;
    used_[at(k)] = true;
    to.origin = local(parent, value_of(origin(drawn_, body)) - value_of(origin(drawn_, parent)));
  }
  // As they are described, each after the link that it is attached to.
  void put_in_order() {
    std::vector<bool> put(links_.size(), false);
    bool more = true;
    while (more) {
      more = false;
      for (int k = 0; k < count(); ++k) {
        const TreeLink& l = link(k);
        if (put[at(k)] || l.joint < 0 || (l.parent != still && !put[at(l.parent)])) continue;
        put[at(k)] = more = true;
        order_.push_back(k);
      }
    }
    for (int k = 0; k < count(); ++k)
      if (!put[at(k)] && !rides(k)) throw std::logic_error("mechanism_tree: a link is connected with nothing");
  }

  BodiesOf of_;
  PlanarLinkage drawn_;
  std::vector<TreeLink> links_;
  std::vector<bool> used_;  // joints of the tree and of what rides
  std::vector<int> order_;
  long double size_ = 0;
};

class LinkageSystem {
 public:
  LinkageSystem(const BodiesOf& of, double shaft_inertia)
      : tree_(std::make_shared<const LinkageTree>(of)),
        l_(tree_->drawn()),
        index_(l_.bodies.size()),
        shaft_inertia_(shaft_inertia) {}

  std::unique_ptr<PlanarSystem> make() {
    m_ = std::make_unique<PlanarSystem>(tree_->of().kind);
    for (const int body : tree_->order()) add(body);
    for (const Joint* j : tree_->closing()) close(*j);
    for (int body = 0; body < l_.body_count; ++body)
      if (tree_->rides(body)) hold_on_line(body);
    m_->gravity = l_.gravity;
    m_->elevation = l_.elevation;
    m_->drawn_at = tree_->of().place;
    m_->redundant = 2 * l_.joint_count > 3 * l_.body_count - 1;
    m_->turns = tree_->of().turns;
    m_->start = [tree = tree_](double phi) {
      std::vector<double> q;
      for (const Taylor& t : tree->coordinates(tree->of().linkage(phi), false)) q.push_back(double(t.value()));
      return q;
    };
    if (l_.changes)
      m_->follow = [tree = tree_](double phi) {
        const PlanarLinkage l = tree->of().linkage(phi);
        return PlanarSystem::Followed{tree->coordinates(l, true), l.sine, l.turns_over};
      };
    if (l_.stands_still) m_->stands_at = double(l_.output[0]);
    for (int body = 0; body < l_.body_count; ++body) {
      const PlanarLinkage::Body& b = l_.bodies[std::size_t(body)];
      if (b.mass > 0) m_->add_weight(b.mass, of(tree_->bearer(body)), tree_->station(tree_->bearer(body), b.com));
    }
    add_output();
    for (const BodiesOf::Place& place : tree_->of().tracked) {
      const int bearer = tree_->bearer(place.body);
      m_->add_place(of(bearer), tree_->station(bearer, place.at),
                    tree_->rides(place.body) ? std::vector<int>{} : pins_of(bearer));
    }
    return std::move(m_);
  }

 private:
  SimTK::MobilizedBody& of(int body) {
    return m_->matter.updMobilizedBody(body == still ? SimTK::MobilizedBodyIndex(0) : index_[std::size_t(body)]);
  }
  // Mass on a fixed bearing neither moves nor has a torque: what is pinned there without mass is given one, as Simbody refuses
  // inertia without.
  SimTK::Body::Rigid rigid(int body) const {
    const PlanarLinkage::Body& b = l_.bodies[std::size_t(body)];
    const double central = double(b.inertia) + (body == 0 ? shaft_inertia_ : 0);
    const SimTK::Vec3 com = tree_->station(body, b.com);
    double mass = b.mass;
    SimTK::Vec3 moment = mass * com;
    SimTK::Inertia about_origin = flat(central) + SimTK::Inertia(com, mass);
    for (int rider = 0; rider < l_.body_count; ++rider) {
      const double carried = l_.bodies[std::size_t(rider)].mass;
      if (!tree_->rides(rider) || tree_->bearer(rider) != body || carried == 0) continue;
      const SimTK::Vec3 pin = tree_->station(body, l_.bodies[std::size_t(rider)].com);
      mass += carried, moment += carried * pin, about_origin += SimTK::Inertia(pin, carried);
    }
    if (mass > 0) return SimTK::Body::Rigid(massive(mass, mass == b.mass ? com : moment / mass, about_origin));
    if (tree_->link(body).parent == still && !tree_->slides(body))
      return SimTK::Body::Rigid(SimTK::MassProperties(1, SimTK::Vec3(0), flat(central)));
    if (central > 0)
      throw std::invalid_argument(
          fmt::format("{}: inertia of {} = {} kg m2 without any mass; give it a mass", m_->kind, b.name, central));
    return SimTK::Body::Rigid(SimTK::MassProperties(0, SimTK::Vec3(0), SimTK::Inertia(0)));
  }
  void add(int body) {
    const TreeLink& link = tree_->link(body);
    const Path place = tree_->slides(body) ? l_.bodies[std::size_t(body)].com : tree_->joint(link.joint).at;
    const SimTK::Transform inboard(SimTK::Rotation(tree_->tilt(body), SimTK::ZAxis),
                                   tree_->station(link.parent, place));
    if (tree_->slides(body)) {
      SimTK::MobilizedBody::Slider made(of(link.parent), inboard, rigid(body), SimTK::Transform());
      index_[std::size_t(body)] = made.getMobilizedBodyIndex();
    } else {
      SimTK::MobilizedBody::Pin made(of(link.parent), inboard, rigid(body), SimTK::Transform());
      index_[std::size_t(body)] = made.getMobilizedBodyIndex();
    }
  }
  // That place of the body stays on a line of another one.
  void keep_on_line(int line, const Direction& along, int body, const Path& place) {
    const SimTK::Vec3 normal = tree_->across(line, along);
    SimTK::Constraint::PointInPlane(of(line), SimTK::UnitVec3(normal), SimTK::dot(normal, tree_->station(line, place)),
                                    of(body), tree_->station(body, place));
  }
  // A pin by one point in two planes; a slide that the tree does not hold by two points of the one body on a line of the other.
  void close(const Joint& j) {
    if (j.slides) {
      keep_on_line(j.from, j.along, j.on, j.at);
      keep_on_line(j.from, j.along, j.on, j.at + along(j.along, Taylor(1)));
      return;
    }
    const int plane = j.from == still ? j.from : j.on, follower = other_end(j, plane);
    const SimTK::Vec3 place = tree_->station(plane, j.at), station = tree_->station(follower, j.at);
    for (const int axis : {0, 1})
      SimTK::Constraint::PointInPlane(of(plane), SimTK::UnitVec3(axis == 0, axis == 1, 0), place[axis], of(follower),
                                      station);
  }
  void hold_on_line(int rider) {
    const TreeLink& link = tree_->link(rider);
    keep_on_line(still, tree_->joint(link.slide).along, tree_->bearer(rider), tree_->joint(link.pin).at);
  }
  // Coordinates of the pins between frame and body: angles add up along the tree.
  std::vector<int> pins_of(int body) const {
    std::vector<int> coordinates;
    for (; body != still; body = tree_->link(body).parent)
      if (!tree_->slides(body)) coordinates.push_back(int(index_[std::size_t(body)]) - 1);
    return coordinates;
  }
  void add_output() {
    const int last = l_.body_count - 1;
    if (!l_.rocks) return m_->set_output(of(tree_->bearer(last)), tree_->station(tree_->bearer(last), l_.load_at));
    long double from = l_.output[0];
    for (int body = last; body != still; body = tree_->link(body).parent)
      if (!tree_->slides(body)) from -= body == 0 ? tree_->of().place : tree_->coordinate(l_, body, false).value();
    from = std::remainder(from, 2 * std::acos(-1.0L));
    m_->set_output(of(last), pins_of(last), std::fabs(from) < 1e-17L ? 0 : double(from));
  }

  std::shared_ptr<const LinkageTree> tree_;
  const PlanarLinkage& l_;
  std::vector<SimTK::MobilizedBodyIndex> index_;
  double shaft_inertia_;
  std::unique_ptr<PlanarSystem> m_;
};

}  // namespace

std::unique_ptr<PlanarSystem> planar_system(const BodiesOf& of, double shaft_inertia) {
  return LinkageSystem(of, shaft_inertia).make();
}

std::vector<BodyInTree> tree_of(const BodiesOf& of) {
  const LinkageTree tree(of);
  std::vector<BodyInTree> list;
  for (const int body : tree.order()) list.push_back({body, tree.link(body).joint});
  return list;
}

}  // namespace kurbel
