// base_motion.h — the motion about which a machine is linearised: uniform, with twists and own states at their means.
//
//     φ = φ₀ + Ω t,   ω = Z q̇,   θ = θ̄ + rest(φ),   z = z̄;   what sticks and what slips as in the steady motion
// In the steady motion θ̄, z̄ and the mean speeds are those of its round. At another speed θ̄ and z̄ are what the mean of the full
// equations over the cycle demands; what is then left over of the torques accelerates the machine as a whole:
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

// Of a steady motion: a state in it, whose modes hold, and the means of its round.
struct MeanMotion {
  State state;                       // on the section
  double speed = 0;                  // mean, of the reduction link [rad/s]
  std::vector<double> mean;          // per state of y, over time; those of angles count for nothing
  std::vector<double> joint_torque;  // per elastic joint, over time [N·m]
};

struct LinearisationPoint {
  double speed = 0;                                   // of the reduction link [rad/s]; 0: at rest
  std::optional<double> angle = {};                   // of the reduction link [rad]; empty: averaged over the cycle
  int positions = 512;                                // of the average, a turn: piecewise loads have edges anywhere
  std::shared_ptr<const MeanMotion> orbit = {};       // null: all turns as geared, clutches locked, brakes released
  std::shared_ptr<const Eigen::VectorXd> added = {};  // per coordinate: mean torque that the positions miss [N·m]
};

// Derivatives of Zᵀ I ω̇ and of ż by the states, averaged.
struct MeanDerivatives {
  SparseMatrix torque_by_twist, torque_by_speed, torque_by_own;  // coordinates × joints, coordinates, own states
  SparseMatrix own_by_twist, own_by_speed, own_by_own;
  SparseMatrix torque_by_angle, own_by_angle;  // by the coordinates' angles; only with the link held at one
};

class BaseMotion {
 public:
  // Throws std::invalid_argument in words where every shaft is held.
  BaseMotion(std::shared_ptr<const Model> model, LinearisationPoint point);

  const Model& model() const { return m_; }
  Equations& equations() { return equations_; }
  const LinearisationPoint& point() const { return point_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const Eigen::VectorXd& rates() const { return rates_; }      // q̇ [rad/s]
  const Eigen::VectorXd& inertia() const { return inertia_; }  // of the coordinates, mean [kg·m²]
  const Eigen::VectorXd& shaft_inertia() const { return shaft_inertia_; }
  const SparseMatrix& twists() const { return twists_; }                 // elastic joints × coordinates: θ̇ = T q̇
  const Eigen::VectorXd& acceleration() const { return acceleration_; }  // q̈ of the whole, where torques do not balance
  double left_over() const { return left_over_; }                        // that torque, on the reduction link [N·m]
  const std::string& words() const { return words_; }  // what the balance had to leave; empty: nothing
  // A joint's torque or its twist at rest changes along this motion.
  bool joints_change() const;
  bool turns() const { return turns_; }                // something depends on an angle
  double cycle() const { return cycle_; }              // of the link [rad]
  double time_period() const { return time_period_; }  // of what depends on time [s]; 0: nothing does

  // Where the mean is taken.
  struct Position {
    double angle = 0, time = 0;
  };
  const std::vector<Position>& positions() const { return positions_; }
  // The state there, its modes set; valid until the next one.
  std::span<const double> at(const Position& position);
  double time(const Position& position) const { return begin_time_ + position.time; }
  // Unbalanced torques Zᵀ I ω̇ − M q̈ on the coordinates [N·m], and rates of the own states.
  struct Residual {
    Eigen::VectorXd torque, own;
    Eigen::VectorXd joint_torque, twist_rate;  // per elastic joint, where asked for [N·m], [rad/s]
  };
  Residual residual(const Position& position);
  Residual residual_with_joints(const Position& position);
  // What a joint that turns unevenly is twisted there without load [rad]; 0 of others.
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
  double angle_rate(std::size_t tracked) const;

  std::shared_ptr<const Model> shared_;
  const Model& m_;
  Equations equations_;
  LinearisationPoint point_;
  Coordinates coordinates_;
  Eigen::VectorXd rates_, inertia_, shaft_inertia_, acceleration_;
  SparseMatrix twists_;
  std::vector<Position> positions_;
  std::vector<int> turn_of_joint_;  // tracked angle of a, where the joint's twist at rest depends on it; −1
  std::vector<double> begin_, y_, ydot_;
  double begin_angle_ = 0, begin_time_ = 0, cycle_ = 0, time_period_ = 0, left_over_ = 0;
  bool turns_ = false;
  std::string words_;
};

}  // namespace kurbel
