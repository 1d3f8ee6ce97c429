// planar_system.h — the Simbody model of a mechanism and its evaluation (C++17 island).
#pragma once

#include <Simbody.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/bodies/simbody_reduction.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/taylor.h"

namespace kurbel {

struct BodiesOf;

struct PlanarSystem {
  explicit PlanarSystem(std::string mechanism) : kind(std::move(mechanism)) {}
  PlanarSystem(const PlanarSystem&) = delete;
  PlanarSystem& operator=(const PlanarSystem&) = delete;

  // --- filled by mechanism_tree.cpp ---
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  std::string kind;  // "four-bar", for messages
  double gravity = 0;
  double elevation = 0;    // of +x above the horizontal [rad]; +y is 90° ahead of +x
  double drawn_at = 0;     // φ of a position on the right branch, where the closure determinant has the right sign
  bool redundant = false;  // more closures than dependent coordinates, some of them redundant
  int turns = 1;           // turns of the crank in a cycle, for mechanisms without change points
  // Coordinates after the crank's, near the right branch: the start of Newton's method.
  std::function<std::vector<double>(double phi)> start;
  // For mechanisms with change points, else empty: the coordinates after the crank's on the branch of the motion, and a
  // sine that changes its sign there, with or without the closure determinant. Newton's method starts from them; near a change point, where
  // the closures do not determine the branch, they and their derivatives are used directly, and only the closure error
  // is checked.
  struct Followed {
    std::vector<Taylor> coordinates;
    long double sine;
    bool turns_over;
  };
  std::function<Followed(double phi)> follow;
  // Position of an output that never moves on this branch; avoids a motion by rounding errors.
  std::optional<double> stands_at;

  // Adds a mass whose weight acts at a station of a body.
  void add_weight(double mass, const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
  // The output is the x of a station, or the angle of a body: `from` plus the coordinates of the pins between frame and body.
  void set_output(const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
  void set_output(const SimTK::MobilizedBody& body, std::vector<int> coordinates, double from);

  // Adds a station whose motion is sampled, with the coordinates of the pins between frame and its body.
  void add_place(const SimTK::MobilizedBody& body, const SimTK::Vec3& station, std::vector<int> pins);

  // --- then ---
  // Ends the construction (forces may be added before) and returns the default state.
  SimTK::State realize_topology();
  // Closes the loops at φ and reduces; throws std::runtime_error with the numbers if not on the right branch.
  Reduction reduce_at(SimTK::State& state, double phi, Upto last = Upto::jerk) const;
  Reduction reduce_at(SimTK::State& state, double phi, const std::vector<double>& start_from,
                      Upto last = Upto::jerk) const;
  double sign_at(double phi) const;  // of the determinant on the right branch
  // Throws std::runtime_error with the numbers if a state with nearly closed loops is on another branch.
  void check_branch(SimTK::State state) const;
  double output_position(const SimTK::State& state) const;  // [m] or [rad], of a state realised to velocities …
  double output_speed(const SimTK::State& state) const;     // … and [m/s] or [rad/s]
  double within_a_cycle(double phi) const;                  // φ modulo the cycle, as near to 0 as possible
  const SimTK::MobilizedBody& crank() const { return matter.getMobilizedBody(SimTK::MobilizedBodyIndex(1)); }
  SimTK::Vec3 up() const { return {std::sin(elevation), std::cos(elevation), 0}; }

  struct Weight {
    double mass;
    std::size_t point;
  };
  std::vector<TrackedPoint> points;
  std::vector<Weight> weights;
  std::size_t output_point = 0;         // for a rocking output: a point on its body
  std::vector<int> output_coordinates;  // empty: the output slides
  double output_from = 0;               // [rad]
  struct Place {
    std::size_t point;
    std::vector<int> pins;  // their coordinates add up to the body's rotation
  };
  std::vector<Place> places;                    // in the order of BodiesOf::tracked
  std::unique_ptr<SimbodyReduction> reduction;  // made by realize_topology()

 private:
  double determinant_sign_ = 1;  // on the right branch; with change points: where the sine is > 0
  Reduction reduce_through(SimTK::State& state, double phi, Upto last) const;
  void check_branch(double phi, const Reduction& reduced, double sign) const;
  std::size_t track(const SimTK::MobilizedBody& body, const SimTK::Vec3& station);
};

// shaft_inertia: additional inertia on the crank's shaft [kg·m²]. Throws as make_bodies.
std::unique_ptr<PlanarSystem> planar_system(const BodiesOf& of, double shaft_inertia = 0);

std::unique_ptr<MechanismBodies> sampled(std::unique_ptr<PlanarSystem> planar);

// Only the moment about z matters; half of it about x and y satisfies Simbody's checks.
inline SimTK::Inertia flat(double about_z) { return SimTK::Inertia(about_z / 2, about_z / 2, about_z); }
// Mass properties of a link, with a margin for rounding when its moments are referred to its centre of mass.
SimTK::MassProperties massive(double mass, const SimTK::Vec3& com, const SimTK::Inertia& about_origin);
// φ wrapped to −π … π. Coordinates relative to φ are doubles: small values have smaller rounding errors.
double within_a_turn(double phi);

}  // namespace kurbel
