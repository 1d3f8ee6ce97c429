// travel_bodies.cpp — a travel within a linkage as Simbody's bodies have it.
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"
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
      : data_(data), whole_(make_bodies(bodies_with_ends(data))), stands_at_(kurbel::stands_at(data)) {
    whole_->sample(double(data.linkage->drawn_at()));
    in_sketch_ = relative_rotation();
  }

  ReducedSample sample(double phi) override { return travel_of(whole_->sample(phi)); }
  ReducedSample sample_from(double phi, const std::vector<double>& start) override {
    return travel_of(whole_->sample_from(phi, start));
  }
  double kinetic_energy(double, double) override { return 0; }
  double potential_energy(double) override { return 0; }

 private:
  using Of = LinkageTravel::Of;

  double relative_rotation() const {
    const std::vector<TrackedMotion> ends = whole_->tracked();
    return ends[1].rotation - ends[0].rotation;
  }

  ReducedSample travel_of(const ReducedSample& whole) const {
    ReducedSample sample{};
    sample.closure_determinant = whole.closure_determinant;
    double &s = sample.output_position, &s1 = sample.output_velocity_ratio, &s2 = sample.output_acceleration_ratio;
    if (stands_at_) {
      s = double(*stands_at_);
      return sample;
    }
    const std::vector<TrackedMotion> ends = whole_->tracked();
    const TrackedMotion &from = ends[0], &to = ends[1];
    const Planar<double>&v = to.velocity_ratio, &a = to.acceleration_ratio;
    if (data_.travel.rocks()) {
      s = relative_rotation() - in_sketch_;
      s1 = to.rotation_velocity_ratio - from.rotation_velocity_ratio;
      s2 = to.rotation_acceleration_ratio - from.rotation_acceleration_ratio;
    } else if (data_.travel.of == Of::way) {
      const Planar<double> along = plane(data_.linkage->structure().axes.direction(data_.travel.angle));
      s = dot(along, to.position), s1 = dot(along, v), s2 = dot(along, a);
    } else if (data_.travel.of == Of::distance) {
      const Planar<double> way = to.position - from.position, way1 = v - from.velocity_ratio,
                           way2 = a - from.acceleration_ratio;
      s = length(way), s1 = dot(way, way1) / s;
      s2 = (dot(way1, way1) + dot(way, way2) - s1 * s1) / s;
    } else if (const PathGuide guide = path_guide(*data_.linkage, data_.travel); guide.direction) {
      s1 = dot(plane(*guide.direction), v), s2 = dot(plane(*guide.direction), a);
    } else if (guide.bearing) {
      const Planar<double> arm = to.position - plane(data_.linkage->spot_of(*guide.bearing));
      s1 = cross(arm, v) / length(arm), s2 = cross(arm, a) / length(arm);
    } else {
      s1 = length(v), s2 = dot(v, a) / s1;
    }
    return sample;
  }
  static Planar<double> plane(SketchSpot s) { return {double(s.x), double(s.y)}; }

  LinkageTravelData data_;
  std::unique_ptr<MechanismBodies> whole_;
  std::optional<long double> stands_at_;
  double in_sketch_ = 0;  // the relative rotation there [rad]
};

}  // namespace

std::unique_ptr<MechanismBodies> own_bodies(const LinkageTravelData& data) {
  return std::make_unique<TravelBodies>(data);
}

}  // namespace kurbel
