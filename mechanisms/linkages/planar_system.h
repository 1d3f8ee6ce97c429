// planar_system.h — what every mechanism's Simbody model has in common (C++17 island).
//
// A mechanism is one function that fills a PlanarSystem: bodies and closures, then what is to be read off them.
#pragma once

#include <Simbody.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/linkages/simbody_reduction.h"
#include "mechanisms/loops/taylor.h"

namespace kurbel {

struct PlanarSystem {
  explicit PlanarSystem(std::string mechanism) : kind(std::move(mechanism)) {}
  PlanarSystem(const PlanarSystem&) = delete;
  PlanarSystem& operator=(const PlanarSystem&) = delete;
  virtual ~PlanarSystem() = default;

  // --- filled by the mechanism ---
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  std::string kind;  // "four-bar", for messages
  double gravity = 0;
  double elevation = 0;            // of +x above the horizontal [rad]; +y is 90° ahead of +x
  double determinant_sign = 1;     // of the closures' determinant on the right branch
  std::optional<double> drawn_at;  // φ of a position that is on the right branch: that sign is read off there
  bool redundant = false;          // more closures than coordinates, of which some say nothing new
  int turns = 1;                   // of the crank until the links come back, of one without change points
  // Coordinates after the crank's near the right branch: where Newton's method starts.
  std::function<std::vector<double>(double phi)> start;
  // Of a mechanism that passes change points, else empty: the coordinates after the crank's on the branch that the
  // motion follows, and a sine with the sign of the closures' determinant there. Newton's method starts from there;
  // near a change point, where the closures leave open which way it goes, they and their derivatives are taken as they
  // are, and the closures have to agree.
  struct Followed {
    std::vector<Taylor> coordinates;
    long double sine;
  };
  std::function<Followed(double phi)> follow;
  // Where the output stands still for good on this branch, which by rounding alone it would not.
  std::optional<double> stands_at;

  // A mass whose weight acts at a body's station.
  void add_weight(double mass, const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
  void add_joint(const SimTK::MobilizedBody& body, const SimTK::Vec3& station);  // drawn
  // The output is a station's way along x, or an angle: `from` with the coordinates of the pins between frame and link.
  void set_output(const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
  void set_output(std::vector<int> coordinates, double from) {
    output_coordinates = std::move(coordinates), output_from = from;
  }
  void set_output(int coordinate) { set_output({coordinate}, 0); }  // of a link on a fixed bearing

  // --- then ---
  // Ends the construction (forces may be added before) and returns the state that the system starts from.
  SimTK::State realize_topology();
  // Closes the loops at φ and reduces; throws std::runtime_error with the numbers on any but the right branch.
  Reduction reduce_at(SimTK::State& state, double phi) const;
  Reduction reduce_at(SimTK::State& state, double phi, const std::vector<double>& start_from) const;
  double sign_at(double phi) const;         // of the determinant on the right branch
  double within_a_cycle(double phi) const;  // one or, with change points, two turns; as near to 0 as can be
  SimTK::Vec3 up() const { return {std::sin(elevation), std::cos(elevation), 0}; }

  struct Weight {
    double mass;
    std::size_t point;
  };
  std::vector<TrackedPoint> points;
  std::vector<Weight> weights;
  std::vector<std::size_t> joint_points;
  std::size_t output_point = 0;
  std::vector<int> output_coordinates;          // empty: the output slides
  double output_from = 0;                       // [rad]
  std::unique_ptr<SimbodyReduction> reduction;  // made by realize_topology()

 private:
  Reduction reduce_through(SimTK::State& state, double phi) const;
  void check_branch(double phi, const Reduction& reduced, double sign) const;
  std::size_t track(const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
};

// Each beside its mechanism's data. Throw std::invalid_argument with the first fault.
std::unique_ptr<PlanarSystem> planar_system(const struct FourBarData& data);
std::unique_ptr<PlanarSystem> planar_system(const struct QuickReturnData& data);
std::unique_ptr<PlanarSystem> planar_system(const struct KnucklePressData& data);
std::unique_ptr<PlanarSystem> planar_system(const struct SlottedLeverData& data);

// Samples any system that a mechanism has filled.
std::unique_ptr<MechanismBodies> sampled(std::unique_ptr<PlanarSystem> planar);

// --- bodies: flat links along their x axis, joints at their ends ---

// Only the moment about z matters; half of it about x and y keeps Simbody content.
inline SimTK::Inertia flat(double about_z) { return SimTK::Inertia(about_z / 2, about_z / 2, about_z); }
// What a link weighs, with what rounding may take from its moments when they are moved to its centre of mass.
SimTK::MassProperties massive(double mass, const SimTK::Vec3& com, const SimTK::Inertia& about_origin);
// On a fixed bearing: inertia about it. Simbody refuses inertia without mass; mass on the bearing neither moves nor has
// a torque, so a massless link is given one.
SimTK::Body::Rigid pivoted_link(const LinkBody& link);
// Any other: central inertia, and a point mass that rides at `end` (a slider on its pin). Throws std::invalid_argument
// naming `what` for inertia without mass.
SimTK::Body::Rigid floating_link(const LinkBody& link, const char* what, double point_mass = 0, double end = 0);

// Closes a pin: a station of `follower` and one of `plane_body` coincide.
void close_pin(SimTK::MobilizedBody& plane_body, const SimTK::Vec3& place, SimTK::MobilizedBody& follower,
               const SimTK::Vec3& station);

// φ between −π and π. Coordinates relative to φ are doubles: small ones keep more digits.
double within_a_turn(double phi);

}  // namespace kurbel
