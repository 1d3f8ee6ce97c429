// linkage_bodies.cpp — a tree of Pin and Slider mobilizers through all links, closed by points in planes (C++17 island).
//
// Every body's frame stands in its joint of the tree. Turned as the sketch is drawn, that of the driving link along it, that
// of a link that slides along the line: Simbody's sliders move along x.
#include "mechanisms/bodies/linkage_bodies.h"

#include <cmath>
#include <stdexcept>

#include "mechanisms/bodies/drawn_linkage.h"
#include "mechanisms/linkages/planar_system.h"

namespace kurbel {
namespace {

struct TreeLink {
  const LinkageJoint* joint = nullptr;  // to the body before
  int parent = LinkageSketch::frame;
  SketchSpot origin;
  long double angle = 0;  // of the frame, in the position of the sketch [rad]
};

class LinkageTree {
 public:
  explicit LinkageTree(std::shared_ptr<const Linkage> linkage)
      : linkage_(std::move(linkage)), links_(linkage_->sketch().links.size()) {
    const std::vector<LinkageJoint>& joints = linkage_->structure().joints;
    std::vector<bool> used(joints.size(), false);
    const int driver = linkage_->sketch().driver;
    links_[at(driver)] = {&joints[0], LinkageSketch::frame, joints[0].at,
                          linkage_->drawn_at() - linkage_->structure().axes.turned()};
    used[0] = true;
    order_ = {driver};
    while (order_.size() < links_.size()) {
      const std::size_t k = next(used);
      used[k] = true;
      attach(joints[k]);
    }
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (!used[k]) closing_.push_back(&joints[k]);
  }

  const Linkage& linkage() const { return *linkage_; }
  const std::vector<int>& order() const { return order_; }
  const std::vector<const LinkageJoint*>& closing() const { return closing_; }
  const TreeLink& link(int body) const { return links_[at(body)]; }
  double angle_of(int body) const { return body == LinkageSketch::frame ? 0 : double(link(body).angle); }

  // Of the sketch, in the body's frame.
  SimTK::Vec3 station(int body, SketchSpot s) const {
    return body == LinkageSketch::frame ? SimTK::Vec3(double(s.x), double(s.y), 0)
                                        : vector(body, s - link(body).origin);
  }
  SimTK::Vec3 vector(int body, SketchSpot v) const {
    if (body == LinkageSketch::frame) return {double(v.x), double(v.y), 0};
    const long double c = std::cos(link(body).angle), s = std::sin(link(body).angle);
    return {double(c * v.x + s * v.y), double(c * v.y - s * v.x), 0};
  }

  // Coordinates after the driving link's, on the branch of the sketch.
  std::vector<double> coordinates(double phi) const {
    const LinkPoses poses = linkage_->poses(phi);
    std::vector<double> q;
    for (std::size_t k = 1; k < order_.size(); ++k) {
      const TreeLink& l = link(order_[k]);
      const LinkPose &own = poses[order_[k]], &before = poses[l.parent];
      if (l.joint->slides) {
        q.push_back(double(dot(own(l.origin) - before(l.origin), before.turned(l.joint->along)).value()));
      } else {
        const long double parent = l.parent == LinkageSketch::frame ? 0 : link(l.parent).angle;
        q.push_back(within_a_turn(double(own.turn.angle() + l.angle - before.turn.angle() - parent)));
      }
    }
    return q;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool stands(int body) const {
    if (body == LinkageSketch::frame) return true;
    for (const int link : order_)
      if (link == body) return true;
    return false;
  }
  // A joint from a body of the tree to one that is in it not yet.
  std::size_t next(const std::vector<bool>& used) const {
    const std::vector<LinkageJoint>& joints = linkage_->structure().joints;
    for (const bool slides : {true, false})
      for (std::size_t k = 0; k < joints.size(); ++k)
        if (!used[k] && joints[k].slides == slides && stands(joints[k].a) != stands(joints[k].b)) return k;
    throw std::logic_error("linkage_bodies: a link is connected with nothing");
  }
  void attach(const LinkageJoint& j) {
    const int parent = stands(j.a) ? j.a : j.b, body = j.other(parent);
    links_[at(body)] = {&j, parent, j.at, j.slides ? std::atan2(j.along.y, j.along.x) : 0.0L};
    order_.push_back(body);
  }

  std::shared_ptr<const Linkage> linkage_;
  std::vector<TreeLink> links_;
  std::vector<int> order_;
  std::vector<const LinkageJoint*> closing_;
};

// Mass on a fixed bearing neither moves nor has a torque: inertia without mass is given one there.
SimTK::Body::Rigid rigid(const LinkageTree& tree, int body) {
  const LinkageSketch& s = tree.linkage().sketch();
  const LinkageSketch::Link& link = s.links[static_cast<std::size_t>(body)];
  double mass = link.mass;
  SimTK::Vec3 com = tree.station(body, tree.linkage().centre_of(body));
  if (mass == 0 && link.inertia == 0)
    return SimTK::Body::Rigid(SimTK::MassProperties(0, SimTK::Vec3(0), SimTK::Inertia(0)));
  for (const int p : link.points)
    if (mass == 0 && s.has(LinkageSketch::frame, p)) mass = 1, com = tree.station(body, tree.linkage().spot_of(p));
  return SimTK::Body::Rigid(massive(mass, com, flat(link.inertia) + SimTK::Inertia(com, mass)));
}

class LinkageSystem {
 public:
  explicit LinkageSystem(std::shared_ptr<const Linkage> linkage)
      : tree_(std::make_shared<const LinkageTree>(std::move(linkage))), bodies_(tree_->order().size()) {}

  std::unique_ptr<PlanarSystem> make(double gravity) {
    m_ = std::make_unique<PlanarSystem>("linkage");
    for (const int body : tree_->order()) add(body);
    for (const LinkageJoint* j : tree_->closing()) close(*j);
    const Linkage& l = tree_->linkage();
    m_->gravity = gravity;
    m_->elevation = l.sketch().elevation + l.structure().axes.turned();
    m_->drawn_at = double(l.drawn_at());
    m_->redundant = l.is_redundant();
    m_->turns = l.turns();
    m_->start = [tree = tree_](double phi) { return tree->coordinates(phi); };
    for (std::size_t k = 0; k < l.sketch().links.size(); ++k) {
      const int body = static_cast<int>(k);
      m_->add_weight(l.sketch().links[k].mass, of(body), tree_->station(body, l.centre_of(body)));
    }
    add_output();
    for (const DrawnJoint& j : drawn_joints(l)) m_->add_joint(of(j.body), tree_->station(j.body, j.at));
    return std::move(m_);
  }

 private:
  SimTK::MobilizedBody& of(int body) {
    return m_->matter.updMobilizedBody(body == LinkageSketch::frame ? SimTK::MobilizedBodyIndex(0)
                                                                    : bodies_[static_cast<std::size_t>(body)]);
  }
  void add(int body) {
    const TreeLink& l = tree_->link(body);
    const SimTK::Vec3 place = tree_->station(l.parent, l.origin);
    const SimTK::Body::Rigid mass = rigid(*tree_, body);
    double tilt = 0;
    if (body == tree_->order().front()) tilt = -tree_->linkage().structure().axes.turned();
    if (l.joint->slides) tilt = double(l.angle) - tree_->angle_of(l.parent);
    const SimTK::Transform inboard(SimTK::Rotation(tilt, SimTK::ZAxis), place);
    if (l.joint->slides) {
      SimTK::MobilizedBody::Slider made(of(l.parent), inboard, mass, SimTK::Transform());
      bodies_[static_cast<std::size_t>(body)] = made.getMobilizedBodyIndex();
    } else {
      SimTK::MobilizedBody::Pin made(of(l.parent), inboard, mass, SimTK::Transform());
      bodies_[static_cast<std::size_t>(body)] = made.getMobilizedBodyIndex();
    }
  }
  // A slide that the tree does not hold: two points of the one body stay on a line of the other.
  void close(const LinkageJoint& j) {
    if (!j.slides) return close_pin(of(j.a), tree_->station(j.a, j.at), of(j.b), tree_->station(j.b, j.at));
    const int line = j.other(j.carrier);
    const SketchSpot across = {-j.along.y, j.along.x};
    const SimTK::Vec3 normal = tree_->vector(line, across);
    const double height = SimTK::dot(normal, tree_->station(line, j.at));
    for (const SketchSpot s : {j.at, j.at + j.along})
      SimTK::Constraint::PointInPlane(of(line), SimTK::UnitVec3(normal), height, of(j.carrier),
                                      tree_->station(j.carrier, s));
  }
  // Angles add up along the tree.
  void add_output() {
    const Linkage& l = tree_->linkage();
    const LinkageSketch::Output& output = l.sketch().output;
    if (!output.rocks()) {
      m_->set_output(of(output.link), tree_->station(output.link, l.spot_of(output.point)));
      return;
    }
    const SketchSpot way = l.direction_of(output.link);
    long double from = std::atan2(way.y, way.x) - tree_->link(output.link).angle;
    std::vector<int> coordinates;
    int body = output.link;
    for (; body != LinkageSketch::frame; body = tree_->link(body).parent) {
      const TreeLink& link = tree_->link(body);
      if (!link.joint->slides) {
        coordinates.push_back(int(bodies_[static_cast<std::size_t>(body)]) - 1);
      } else {  // its frame is turned against the parent's
        const long double parent = link.parent == LinkageSketch::frame ? 0 : tree_->link(link.parent).angle;
        from += link.angle - parent;
      }
    }
    m_->set_output(std::move(coordinates), double(from));
  }

  std::shared_ptr<const LinkageTree> tree_;
  std::vector<SimTK::MobilizedBodyIndex> bodies_;
  std::unique_ptr<PlanarSystem> m_;
};

}  // namespace

std::unique_ptr<MechanismBodies> make_bodies(const LinkageData& data) {
  return sampled(LinkageSystem(data.linkage).make(data.gravity));
}

}  // namespace kurbel
