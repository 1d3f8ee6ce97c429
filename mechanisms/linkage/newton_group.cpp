// newton_group.cpp — closures of pins and slides with their matrix.
#include "mechanisms/linkage/newton_group.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// cos and sin of a series: s′ = c a′, c′ = −s a′.
Direction direction_at(const Taylor& angle) {
  Direction d{Taylor(std::cos(angle.c[0])), Taylor(std::sin(angle.c[0]))};
  for (int k = 1; k <= Taylor::order; ++k) {
    for (int j = 1; j <= k; ++j) {
      d.sin.c[k] += j * angle.c[j] * d.cos.c[k - j];
      d.cos.c[k] -= j * angle.c[j] * d.sin.c[k - j];
    }
    d.sin.c[k] /= k, d.cos.c[k] /= k;
  }
  return d;
}

class Closures {
 public:
  Closures(const AssurGroup& g, const std::vector<LinkageJoint>& joints, long double size)
      : g_(g), joints_(joints), size_(size), spot_(g.links.size()) {
    for (std::size_t i = 0; i < g.links.size(); ++i)
      for (const int k : g.joints)
        if (joint(k).a == g.links[i] || joint(k).b == g.links[i]) spot_[i] = joint(k).at;
  }
  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(g_.joints.size()); }
  Eigen::Index columns() const { return 3 * static_cast<Eigen::Index>(g_.links.size()); }

  void put(const std::vector<LinkShift>& shifts, LinkPoses& poses) const {
    for (std::size_t i = 0; i < g_.links.size(); ++i) {
      const LinkShift& u = shifts[i];
      poses.of(g_.links[i]) =
          LinkPose::through(direction_at(u.angle), spot_[i], {Taylor(spot_[i].x) + u.x, Taylor(spot_[i].y) + u.y});
    }
  }
  // Coefficient k of all closures [m].
  Column error(const LinkPoses& poses, int k) const {
    Column e(rows());
    for (std::size_t i = 0; i < g_.joints.size(); ++i) {
      const LinkageJoint& j = joint(g_.joints[i]);
      const auto row = 2 * static_cast<Eigen::Index>(i);
      if (!j.slides) {
        const Path apart = poses[j.b](j.at) - poses[j.a](j.at);
        e(row) = apart.x.c[k], e(row + 1) = apart.y.c[k];
      } else {
        const LinkPose &line = poses[j.other(j.carrier)], &point = poses[j.carrier];
        const Taylor turned = line.turn.cos * point.turn.sin - line.turn.sin * point.turn.cos;
        e(row) = size_ * turned.c[k];
        e(row + 1) = cross(line.turned(j.along), point(j.at) - line(j.at)).c[k];
      }
    }
    return e;
  }
  // By the shifts, and by the rotations times the size.
  Matrix derivative(const LinkPoses& poses) const {
    Matrix m = Matrix::Zero(rows(), columns());
    for (std::size_t i = 0; i < g_.joints.size(); ++i) {
      const LinkageJoint& j = joint(g_.joints[i]);
      const auto row = 2 * static_cast<Eigen::Index>(i);
      if (j.slides)
        add_slide(j, row, poses, m);
      else
        for (const int body : {j.a, j.b}) {
          const Eigen::Index column = column_of(body);
          if (column < 0) continue;
          const long double sense = body == j.b ? 1 : -1;
          const SketchSpot arm = arm_of(body, j.at, poses);
          m(row, column) = sense, m(row + 1, column + 1) = sense;
          m(row, column + 2) = -sense * arm.y / size_, m(row + 1, column + 2) = sense * arm.x / size_;
        }
    }
    return m;
  }

 private:
  const LinkageJoint& joint(int k) const { return joints_[static_cast<std::size_t>(k)]; }
  Eigen::Index column_of(int body) const {
    const auto found = std::find(g_.links.begin(), g_.links.end(), body);
    return found == g_.links.end() ? -1 : 3 * static_cast<Eigen::Index>(found - g_.links.begin());
  }
  // From the link's own point to this one, as it stands.
  SketchSpot arm_of(int body, SketchSpot s, const LinkPoses& poses) const {
    const Path arm = poses[body].turned(s - spot_[static_cast<std::size_t>(column_of(body) / 3)]);
    return {arm.x.value(), arm.y.value()};
  }
  void add_slide(const LinkageJoint& j, Eigen::Index row, const LinkPoses& poses, Matrix& m) const {
    const int line = j.other(j.carrier), point = j.carrier;
    const LinkPose &l = poses[line], &p = poses[point];
    const long double cosine = l.turn.cos.value() * p.turn.cos.value() + l.turn.sin.value() * p.turn.sin.value();
    const Path along = l.turned(j.along), apart = p(j.at) - l(j.at);
    const SketchSpot w{along.x.value(), along.y.value()}, q{apart.x.value(), apart.y.value()};
    if (const Eigen::Index c = column_of(point); c >= 0) {
      m(row, c + 2) = cosine;
      m(row + 1, c) = -w.y, m(row + 1, c + 1) = w.x;
      m(row + 1, c + 2) = dot(w, arm_of(point, j.at, poses)) / size_;
    }
    if (const Eigen::Index c = column_of(line); c >= 0) {
      m(row, c + 2) = -cosine;
      m(row + 1, c) = w.y, m(row + 1, c + 1) = -w.x;
      m(row + 1, c + 2) = -(dot(w, q) + dot(w, arm_of(line, j.at, poses))) / size_;
    }
  }

  const AssurGroup& g_;
  const std::vector<LinkageJoint>& joints_;
  long double size_;
  std::vector<SketchSpot> spot_;  // of each link, the point that its shift is that of
};

constexpr long double least_pivot = 1e-10L;  // of the largest: below it a closure says nothing new

void add_to(std::vector<LinkShift>& shifts, const Column& step, long double size, int k) {
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    const auto column = 3 * static_cast<Eigen::Index>(i);
    shifts[i].x.c[k] += step(column), shifts[i].y.c[k] += step(column + 1);
    shifts[i].angle.c[k] += step(column + 2) / size;
  }
}

}  // namespace

GroupClosure close_by_newton(const AssurGroup& g, const std::vector<LinkageJoint>& joints, long double size,
                             LinkPoses& poses, std::vector<LinkShift>& shifts) {
  constexpr int most_steps = 20;
  constexpr long double nearly = 1e-9L, too_far = 0.5L, fitting = 1e-11L;  // of the size
  const Closures closures(g, joints, size);
  for (LinkShift& u : shifts) u = {Taylor(u.x.c[0]), Taylor(u.y.c[0]), Taylor(u.angle.c[0])};
  GroupClosure out;
  Eigen::ColPivHouseholderQR<Matrix> factors;
  factors.setThreshold(least_pivot);
  bool near = false;  // the next step is the last one: it leaves the square of what the one before left
  for (int i = 0; i < most_steps; ++i) {
    closures.put(shifts, poses);
    factors.compute(closures.derivative(poses));
    if (factors.rank() < closures.columns()) return out;
    const Column step = factors.solve(-closures.error(poses, 0));
    const long double way = step.lpNorm<Eigen::Infinity>();
    if (!(way < too_far * size)) return out;
    add_to(shifts, step, size, 0);
    if (near) break;
    near = way < nearly * size;
  }
  closures.put(shifts, poses);
  const long double misfit = closures.error(poses, 0).lpNorm<Eigen::Infinity>();  // of redundant closures
  if (!near || !(misfit <= fitting * size)) return out;
  for (int k = 1; k <= Taylor::order; ++k) {
    add_to(shifts, factors.solve(-closures.error(poses, k)), size, k);
    closures.put(shifts, poses);
  }
  out.closed = true;
  out.pivot = std::fabs(factors.matrixR()(closures.columns() - 1, closures.columns() - 1)) / factors.maxPivot();
  return out;
}

int closure_rank(const LinkageStructure& structure) {
  AssurGroup all;
  all.links = structure.order;
  long double size = 0;
  for (int k = 0; k < static_cast<int>(structure.joints.size()); ++k) {
    all.joints.push_back(k);
    size = std::max(size, length(structure.joints[static_cast<std::size_t>(k)].at));
  }
  if (all.joints.empty()) return 0;
  const Closures closures(all, structure.joints, size > 0 ? size : 1);
  Eigen::ColPivHouseholderQR<Matrix> factors;
  factors.setThreshold(least_pivot);
  factors.compute(closures.derivative(LinkPoses(structure.order.size())));
  return static_cast<int>(factors.rank());
}

}  // namespace kurbel
