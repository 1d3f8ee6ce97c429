// travel_bodies.cpp — a travel within a linkage as Simbody's bodies have it (C++17 island).
#include <utility>
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"
#include "mechanisms/bodies/planar_system.h"
#include "mechanisms/bodies/sketched_linkage.h"

namespace kurbel {
namespace {

// Places: where the travel begins, where it ends.
BodiesOf bodies_with_ends(const LinkageTravelData& data) {
  const Linkage& linkage = *data.linkage;
  BodiesOf of;
  of.kind = "linkage";
  of.linkage = [whole = LinkageData{data.linkage, 0}](long double phi) { return linkage_of(whole, phi); };
  of.place = double(linkage.drawn_at());
  of.turns = linkage.turns();
  const PlanarLinkage drawn = of.linkage(of.place);
  const LinkPoses poses = linkage.poses(of.place);
  for (const LinkageTravel::Place& end : {data.travel.from, data.travel.to}) {
    const int body = body_of(drawn, linkage, end.body);
    if (end.point >= 0)
      of.tracked.push_back({body, poses[end.body](linkage.spot_of(end.point))});
    else
      of.tracked.push_back({body, body == PlanarLinkage::frame ? Path{} : drawn.bodies[std::size_t(body)].com});
  }
  return of;
}

class TravelBodies final : public MechanismBodies {
 public:
  explicit TravelBodies(const LinkageTravelData& data)
      : data_(data), planar_(planar_system(bodies_with_ends(data))), state_(planar_->realize_topology()) {
    if (!data.travel.rocks()) return;
    for (const auto& [end, sense] : {std::pair{1, 1.0}, std::pair{0, -1.0}})
      for (const int q : planar_->places[std::size_t(end)].pins) angles_.emplace_back(q, sense);
    std::vector<double> drawn = planar_->start(planar_->drawn_at);
    drawn.insert(drawn.begin(), planar_->drawn_at);
    for (const auto& [q, sense] : angles_) in_sketch_ += sense * drawn[std::size_t(q)];
  }

  ReducedSample sample(double phi) override {
    return sample_of(planar_->reduce_at(state_, planar_->within_a_cycle(phi)), phi);
  }
  ReducedSample sample_from(double phi, const std::vector<double>& start) override {
    return sample_of(planar_->reduce_at(state_, planar_->within_a_cycle(phi), start), phi);
  }
  double kinetic_energy(double, double) override { return 0; }
  double potential_energy(double) override { return 0; }

 private:
  using Of = LinkageTravel::Of;

  ReducedSample sample_of(const Reduction& reduced, double phi) const {
    ReducedSample sample{};
    sample.closure_determinant = planar_->sign_at(planar_->within_a_cycle(phi)) * reduced.determinant;
    double &s = sample.output_position, &s1 = sample.output_velocity_ratio, &s2 = sample.output_acceleration_ratio;
    if (data_.travel.rocks()) {
      s = -in_sketch_;
      for (const auto& [q, sense] : angles_)
        s += sense * state_.getQ()[q], s1 += sense * reduced.q1[q], s2 += sense * reduced.q2[q];
      return sample;
    }
    const PointMotion& to = reduced.points[planar_->places[1].point];
    const SimTK::Vec3 &v = to.velocity_ratio, &a = to.acceleration_ratio;
    if (data_.travel.of == Of::way) {
      const SimTK::Vec3 along = flat_vector(data_.linkage->structure().axes.direction(data_.travel.angle));
      s = SimTK::dot(along, to.position), s1 = SimTK::dot(along, v), s2 = SimTK::dot(along, a);
    } else if (data_.travel.of == Of::distance) {
      const PointMotion& from = reduced.points[planar_->places[0].point];
      const SimTK::Vec3 way = to.position - from.position, way1 = v - from.velocity_ratio,
                        way2 = a - from.acceleration_ratio;
      s = way.norm(), s1 = SimTK::dot(way, way1) / s;
      s2 = (SimTK::dot(way1, way1) + SimTK::dot(way, way2) - s1 * s1) / s;
    } else {
      const PathGuide guide = path_guide(*data_.linkage, data_.travel);
      if (guide.direction) {
        s1 = SimTK::dot(flat_vector(*guide.direction), v), s2 = SimTK::dot(flat_vector(*guide.direction), a);
      } else if (guide.bearing) {
        const SimTK::Vec3 arm = to.position - flat_vector(data_.linkage->spot_of(*guide.bearing));
        s1 = (arm[0] * v[1] - arm[1] * v[0]) / arm.norm(), s2 = (arm[0] * a[1] - arm[1] * a[0]) / arm.norm();
      } else {
        s1 = v.norm(), s2 = SimTK::dot(v, a) / s1;
      }
    }
    return sample;
  }
  static SimTK::Vec3 flat_vector(SketchSpot s) { return {double(s.x), double(s.y), 0}; }

  LinkageTravelData data_;
  std::unique_ptr<PlanarSystem> planar_;
  SimTK::State state_;
  std::vector<std::pair<int, double>> angles_;  // coordinates that add up to the rotation, each with its sense
  double in_sketch_ = 0;                        // their sum there [rad]
};

}  // namespace

std::unique_ptr<MechanismBodies> own_bodies(const LinkageTravelData& data) {
  return std::make_unique<TravelBodies>(data);
}

}  // namespace kurbel
