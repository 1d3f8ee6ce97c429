// base_motion.h — the motion about which a machine is linearised: uniform, twists and internal states at their means.
//
//     φ = φ₀ + Ω t,   ω = Z q̇,   θ = θ̄ + rest(φ),   z = z̄;   contacts stick or slip as in the steady motion
// In steady motion θ̄, z̄ and the mean speeds are those of its period. At another speed θ̄ and z̄ follow from the mean of the
// full equations over the cycle; the remaining torque accelerates the machine as a whole:
//     mean of Zᵀ (M − I ω̇) = 0,   mean of ż = 0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/linear/coordinates.h"

namespace kurbel {

// A steady motion: one of its states, with its modes, and the means over its period.
struct MeanMotion {
  State state;                       // on the section
  double speed = 0;                  // mean, of the reduction link [rad/s]
  std::vector<double> mean;          // per state of y, over time; those of angles have no meaning
  std::vector<double> joint_torque;  // per elastic joint, over time [N·m]
};

struct LinearisationPoint {
  double speed = 0;                              // of the reduction link [rad/s]; 0: at rest
  std::optional<double> angle = {};              // of the reduction link [rad]; empty: averaged over the cycle
  int positions = 512;                           // of the average, per turn: edges of piecewise loads may be anywhere
  std::shared_ptr<const MeanMotion> orbit = {};  // null: speeds by the gear ratios, clutches locked, brakes released
  std::shared_ptr<const Eigen::VectorXd> added = {};  // per coordinate: mean torque not covered by the positions [N·m]
};

// Derivatives of Zᵀ I ω̇ and of ż by the states, averaged.
struct MeanDerivatives {
  SparseMatrix torque_by_twist, torque_by_speed,
      torque_by_internal;  // coordinates × joints, coordinates, internal states
  SparseMatrix internal_by_twist, internal_by_speed, internal_by_internal;
  SparseMatrix torque_by_angle, internal_by_angle;  // by the coordinates' angles; only at a given angle of the link
};

class BaseMotion {
 public:
  // Throws std::invalid_argument if all shafts are held.
  BaseMotion(std::shared_ptr<const Model> model, LinearisationPoint point);

  const Model& model() const { return m_; }
  Equations& equations() { return equations_; }
  const LinearisationPoint& point() const { return point_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const Eigen::VectorXd& rates() const { return rates_; }      // q̇ [rad/s]
  const Eigen::VectorXd& inertia() const { return inertia_; }  // of the coordinates, mean [kg·m²]
  const Eigen::VectorXd& shaft_inertia() const { return shaft_inertia_; }
  const SparseMatrix& twists() const { return twists_; }                 // elastic joints × coordinates: θ̇ = T q̇
  const Eigen::VectorXd& acceleration() const { return acceleration_; }  // q̈ by the remaining torque
  double left_over() const { return left_over_; }      // remaining torque, on the reduction link [N·m]
  const std::string& words() const { return words_; }  // what could not be balanced; empty: nothing
  // The torque or the unloaded twist of a joint changes along this motion.
  bool joints_change() const;
  bool turns() const { return turns_; }                // something depends on an angle
  double cycle() const { return cycle_; }              // of the link [rad]
  double time_period() const { return time_period_; }  // period of laws over time [s]; 0: none

  // A position for the mean.
  struct Position {
    double angle = 0, time = 0;
  };
  const std::vector<Position>& positions() const { return positions_; }
  // The state at a position, with its modes set; valid until the next call.
  std::span<const double> at(const Position& position);
  double time(const Position& position) const { return begin_time_ + position.time; }
  // Unbalanced torques Zᵀ I ω̇ − M q̈ on the coordinates [N·m], and rates of the internal states.
  struct Residual {
    Eigen::VectorXd torque, own;
    Eigen::VectorXd joint_torque, twist_rate;  // per elastic joint, only by residual_with_joints [N·m], [rad/s]
  };
  Residual residual(const Position& position);
  Residual residual_with_joints(const Position& position);
  // Twist without load of a joint with a varying ratio at a position [rad]; 0 for others.
  double rest_twist(std::size_t joint, const Position& position);
  MeanDerivatives mean_derivatives();
  Eigen::VectorXd mean_joint_torques();  // per elastic joint [N·m]
  bool has_spring(std::size_t joint) const;

 private:
  class Balance;
  friend class Balance;

  void choose_positions();
  void take_modes();
  void find_inertia();
  void find_coordinates();
  void balance();
  bool turn_flanks();
  // The pieces of laws that hold where the balance has led from the state before: true if one has changed.
  bool pass_pieces(const std::vector<double>& before);
  double angle_rate(std::size_t tracked) const;

  std::shared_ptr<const Model> shared_;
  const Model& m_;
  Equations equations_;
  LinearisationPoint point_;
  Coordinates coordinates_;
  Eigen::VectorXd rates_, inertia_, shaft_inertia_, acceleration_;
  SparseMatrix twists_;
  std::vector<Position> positions_;
  std::vector<int> turn_of_joint_;  // tracked angle of a, if the unloaded twist depends on it; else −1
  std::vector<double> begin_, y_, ydot_;
  double begin_angle_ = 0, begin_time_ = 0, cycle_ = 0, time_period_ = 0, left_over_ = 0;
  bool turns_ = false;
  std::string words_;
};

}  // namespace kurbel
