// linearise.h — the machine as a linear system about its motion, from the exact Jacobian of the same equations.
//
//     M q̈ + C q̇ + K q = B z + f,   ż = F z + H q̇ + G θ + h,   θ = T q     (theory 12.1)
// q are the small departures of the coordinates (coordinates.h) from the base motion (base_motion.h), z those of the
// elements' own states. C holds the slopes of motors and loads and of whatever slips, K the springs (Tᵀ k T) and what else
// hangs on the twists: friction of gears that grows with what they transmit. Coefficients that change with the angle enter
// by their mean over the cycle, unless the link is held at one.
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
  std::vector<int> shaft;         // those that may move
  SparseMatrix motion;            // of them by the coordinates: ω = motion · q̇
  Eigen::VectorXd shaft_inertia;  // of them [kg·m²]
  std::vector<double> ratio;      // of them: speed over the reduction link's when all turns as geared
  std::vector<Joint> joints;      // per elastic joint of the model
  // What springs in a row that hang on each other do beyond that, by twists and rates of all joints; empty: there are none.
  SparseRows row_stiffness, row_damping;
  SparseRows twists;        // T: joints × coordinates
  Eigen::VectorXd inertia;  // M, diagonal [kg·m²]
  SparseMatrix stiffness;   // Tᵀ k T of the springs, symmetric
  SparseMatrix
      other_stiffness;   // of K, what is not: losses by torque; what depends on the angle, with the link held at one
  SparseMatrix damping;  // C
  SparseMatrix torque_by_own, own_by_twist, own_by_speed, own_by_angle, own_by_own;  // B, G, H, with the link held, F
  SparseMatrix torque_by_twist;               // −K = torque_by_twist · T + …
  SparseMatrix joint_by_speed, joint_by_own;  // of the joints' torques, by coordinates' speeds and own states
  Eigen::VectorXd own_scale;                  // orders of magnitude of z
  double mean_torque = 0;  // Σ of all shares on the reduction link: 0 where the point is one of steady motion [N·m]
  std::string mode_set;    // for people: what was assumed of pieces, directions, stuck shafts

  Eigen::Index size() const { return inertia.size(); }
  Eigen::Index own_states() const { return own_scale.size(); }
  bool is_symmetric() const { return other_stiffness.nonZeros() == 0 && own_states() == 0; }
  // Of the springs by the twists, of the dampers by their rates.
  Eigen::VectorXcd spring_torques(const Eigen::VectorXcd& twist) const;
  Eigen::VectorXcd damper_torques(const Eigen::VectorXcd& rate) const;
  Eigen::VectorXd spring_work(const Eigen::VectorXd& twist) const;  // twice their energy, by joints
  void stiffen(double factor);                                      // all springs
  double twist(std::size_t joint, const Eigen::VectorXd& q) const {
    return twists.row(static_cast<Eigen::Index>(joint)).dot(q);
  }
};

// Throws std::invalid_argument where nothing can swing: no spring and no own state, or no coordinate that is free.
LinearDrive linearise(BaseMotion& base);
LinearDrive linearise(std::shared_ptr<const Model> model, const LinearisationPoint& point);

// The speed at which a scene is linearised where it has no steady motion and none is asked for: of its start, else the rated one
// of its elements.
double usual_speed(const Model& model);
// Where mean torques balance near the rated speed and a faster motion is braked, if they do; else `usual_speed`.
double balanced_speed(const std::shared_ptr<const Model>& model);

}  // namespace kurbel
