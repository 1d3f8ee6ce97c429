// linearise.h — the machine linearised about its motion, from the exact Jacobian of the same equations.
//
//     M q̈ + C q̇ + K q = B z + f,   ż = F z + H q̇ + G θ + h,   θ = T q     (theory 12.1)
// q: small deviations of the coordinates (coordinates.h) from the base motion (base_motion.h); z: those of the internal
// states of elements. C contains the slopes of motors, loads and slipping contacts, K the springs (Tᵀ k T) and other terms
// by the twists, such as gear friction that depends on the transmitted torque. Coefficients that depend on the angle are
// averaged over the cycle, unless an angle of the link is given.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

#include "engine/linear/base_motion.h"

namespace kurbel {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct LinearDrive {
  struct Joint {
    enum class State { spring, slips, film, sticks };
    State state = State::spring;
    double stiffness = 0;  // dτ/dθ at its mean twist [N·m/rad]
    double damping = 0;    // dτ/dθ̇ there [N·m·s/rad]
    double torque = 0;     // mean transmitted torque at the operating point [N·m]
  };

  std::shared_ptr<const Model> model;
  LinearisationPoint at;
  std::vector<int> shaft;         // the movable shafts
  SparseMatrix motion;            // their speeds by the coordinates: ω = motion · q̇
  Eigen::VectorXd shaft_inertia;  // their inertias [kg·m²]
  std::vector<double> ratio;      // their speeds over the reduction link's by the gear ratios
  std::vector<Joint> joints;      // per elastic joint of the model
  // Additional terms of coupled springs in a row, by twists and rates of all joints; empty: none.
  SparseRows row_stiffness, row_damping;
  SparseRows twists;             // T: joints × coordinates
  Eigen::VectorXd inertia;       // M, diagonal [kg·m²]
  SparseMatrix stiffness;        // Tᵀ k T of the springs, symmetric
  SparseMatrix other_stiffness;  // other terms of K: losses by torque; by the angle, if one is given
  SparseMatrix damping;          // C
  SparseMatrix torque_by_internal, internal_by_twist, internal_by_speed, internal_by_angle,
      internal_by_internal;      // B, G, H, by a given angle, F
  SparseMatrix torque_by_twist;  // −K = torque_by_twist · T + …
  SparseMatrix joint_by_speed,
      joint_by_internal;           // of the joints' torques, by speeds of coordinates and internal states
  Eigen::VectorXd internal_scale;  // orders of magnitude of z
  double mean_torque = 0;          // Σ of all shares on the reduction link: 0 in steady motion [N·m]
  std::string mode_set;            // for reports: the assumed pieces, directions and stuck shafts

  Eigen::Index size() const { return inertia.size(); }
  Eigen::Index internal_states() const { return internal_scale.size(); }
  bool is_symmetric() const { return other_stiffness.nonZeros() == 0 && internal_states() == 0; }
  // Torques of the springs by the twists, of the dampers by their rates.
  Eigen::VectorXcd spring_torques(const Eigen::VectorXcd& twist) const;
  Eigen::VectorXcd damper_torques(const Eigen::VectorXcd& rate) const;
  Eigen::VectorXd spring_work(const Eigen::VectorXd& twist) const;  // twice their energy, by joints
  void stiffen(double factor);                                      // all springs
  double twist(std::size_t joint, const Eigen::VectorXd& q) const {
    return twists.row(static_cast<Eigen::Index>(joint)).dot(q);
  }
};

// Throws std::invalid_argument if nothing can oscillate: no spring and no internal state, or no free coordinate.
LinearDrive linearise(BaseMotion& base);
LinearDrive linearise(std::shared_ptr<const Model> model, const LinearisationPoint& point);

// Default speed of the linearisation without a steady motion: that of the start, else the rated speed of the elements.
double usual_speed(const Model& model);
// The speed near the rated one with a stable balance of the mean torques; if there is none, `usual_speed`.
double balanced_speed(const std::shared_ptr<const Model>& model);

}  // namespace kurbel
