// simbody_reduction.h — reduces a planar Simbody mechanism of one degree of freedom to one coordinate, exactly.
//
// C++17 island: include it only from sources that are compiled against Simbody.
//
// The mechanism is a tree of Pin and Slider mobilizers moving parallel to the x-y plane, its loops closed by
// PointInPlane constraints (one for a slider's line, two for a pin). Inertia, speeds, accelerations and constraint
// matrices are Simbody's. Two results that Simbody does not provide are computed here from its topology and frames: the
// closure error in extended precision (near a dead position double precision loses half the digits) and the third
// derivative of the motion, for I_r″.
#pragma once

#include <Simbody.h>

#include <Eigen/Core>
#include <vector>

#include "mechanisms/loops/planar.h"

namespace kurbel {

// A point fixed to a body.
struct TrackedPoint {
  SimTK::MobilizedBodyIndex body;
  SimTK::Vec3 station;  // in the body's frame [m]
};

// Position of a tracked point and its first two derivatives by the reduction coordinate.
struct PointMotion {
  SimTK::Vec3 position, velocity_ratio, acceleration_ratio;
};

// The mechanism reduced to the coordinate φ at one configuration; derivatives are by φ.
struct Reduction {
  double inertia = 0, slope = 0, curvature = 0;  // I_r, I_r′, I_r″ (theory 2.1)
  SimTK::Vector q1, q2, q3;                      // dq/dφ, d²q/dφ², d³q/dφ³ of all coordinates
  std::vector<PointMotion> points;               // one for each tracked point
  double determinant = 0;    // of ∂(closure errors)/∂(dependent coordinates): changes sign only in a dead position
  double closure_error = 0;  // largest closure error by Simbody [m]
};

// dq/dφ, d²q/dφ², d³q/dφ³ of all coordinates from another source.
struct KnownDerivatives {
  SimTK::Vector q1, q2, q3;
};

// The highest derivatives of the coordinates that a reduction computes: dq/dφ, with I_r alone (I_r′ and I_r″ stay 0), or
// up to d³q/dφ³.
enum class Upto { velocity, jerk };

// Velocity, acceleration and jerk ratios of a body: of its origin and of its angle.
struct BodyMotion {
  Planar<double> v, a, j;
  double w = 0, alpha = 0, zeta = 0;
};

class SimbodyReduction {
 public:
  // `redundant`: there may be more closures than dependent coordinates; these then follow by least squares, and the
  // determinant is the square root of that of the normal equations.
  SimbodyReduction(const SimTK::MultibodySystem& system, const SimTK::SimbodyMatterSubsystem& matter, int coordinate,
                   std::vector<TrackedPoint> points, bool redundant = false);

  // Newton's method on the closure error: changes the dependent coordinates of `state` until the loops close to rounding
  // error. It converges to the nearest assembly branch; the caller checks the branch by reduce().determinant.
  // Throws std::runtime_error if it does not converge.
  void close(SimTK::State& state) const;

  // The reduction at a closed state, whose speeds are set to the velocity ratios (dφ/dt = 1). Throws std::runtime_error
  // if the loops are open by Simbody. In a change point, where the closures do not determine the motion, its derivatives
  // are given by `known`; they only have to satisfy the closures.
  Reduction reduce(SimTK::State& state, const KnownDerivatives* known = nullptr, Upto last = Upto::jerk) const;

 private:
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  struct Joint {
    int parent;
    bool slides;                        // Slider along x of its inboard frame, else Pin
    Planar<double> in_parent, in_body;  // origin of the inboard frame in the parent, of the outboard frame in the body
    double tilt;                        // of the inboard frame in the parent [rad]
    int q;                              // index of its coordinate
  };
  struct Closure {
    int plane_body, follower_body;
    Planar<double> normal, follower;
    double height;
  };

  void read_joints();
  void read_closures();
  Extended closure_errors(const Extended& q) const;
  int dependent(int j) const { return j < coordinate_ ? j : j + 1; }  // index of the j-th dependent coordinate
  std::vector<BodyMotion> motion_without_q3(const SimTK::State& state, const SimTK::Vector& q2,
                                            const SimTK::Vector_<SimTK::SpatialVec>& a) const;
  SimTK::Vector closure_jerks(const SimTK::State& state, const std::vector<BodyMotion>& motion) const;
  double curvature(const SimTK::State& state, const std::vector<BodyMotion>& motion,
                   const SimTK::Vector_<SimTK::SpatialVec>& jerk) const;
  SimTK::Vector kept(const SimTK::Matrix& g, const SimTK::Vector& bias, const SimTK::Vector& given, double phi) const;
  std::vector<PointMotion> point_motions(const SimTK::State& state,
                                         const SimTK::Vector_<SimTK::SpatialVec>& acceleration) const;

  const SimTK::MultibodySystem& system_;
  const SimTK::SimbodyMatterSubsystem& matter_;
  int coordinate_;
  std::vector<TrackedPoint> points_;
  std::vector<Joint> joints_;  // by body; [0] is the ground
  std::vector<Closure> closures_;
  double size_ = 0;  // a length ≥ the size of the mechanism [m]
};

}  // namespace kurbel
