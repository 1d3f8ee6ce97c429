// linearise.h — the drive as a linear system about an operating point: inertias, springs and dampers of a compiled
// model.
//
//     M q̈ + C q̇ + K q = f,   K = Σ k_j g_j g_jᵀ with θ_j = g_jᵀ q = gain_a q_a − gain_b q_b     (theory 12.1)
// q are the small departures of the shafts' angles from uniform motion (or rest). Everything comes from the exact
// Jacobian of the same compiled equations, so C holds the slopes of motors and loads at the operating point, too.
// Mechanisms enter by the mean of their inertia over the cycle, unless the crank is held at an angle.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

using SparseMatrix = Eigen::SparseMatrix<double>;

struct LinearisationPoint {
  double speed = 0;                  // of the reduction link [rad/s]; 0: at rest
  std::optional<double> angle = {};  // of the reduction link [rad]; empty: averaged over the cycle
  int positions = 512;               // of the average, a turn: piecewise loads have edges anywhere
  std::vector<double> added = {};    // per shaft: mean torque beyond what acts at t = 0 [N·m]; empty: none
  bool angle_torques = true;         // false: `added` holds the mean of what depends on the angle
};

struct LinearDrive {
  struct Joint {
    int a = -1, b = -1;  // coordinates that it joins; −1: held
    double gain_a = 1, gain_b = 1;
    double stiffness = 0;  // dτ/dθ at its mean twist [N·m/rad]
    double damping = 0;    // dτ/dθ̇ there [N·m·s/rad]
    double torque = 0;     // mean transmitted torque at the operating point [N·m]
  };

  std::shared_ptr<const Model> model;
  LinearisationPoint at;
  std::vector<int> coordinate;   // per shaft of the model; −1: its speed is prescribed, or it sticks
  std::vector<int> shaft;        // per coordinate
  std::vector<double> ratio;     // per coordinate: speed over the reduction link's when all turns rigidly
  std::vector<Joint> joints;     // per elastic joint of the model
  Eigen::VectorXd inertia;       // M, diagonal [kg·m²]
  SparseMatrix stiffness;        // K of the elastic joints, symmetric
  SparseMatrix angle_stiffness;  // of what depends on the angle; only with the crank held at one
  SparseMatrix damping;          // C of joints, motors, loads
  double mean_torque = 0;  // Σ of all shares on the reduction link: 0 where the point is one of steady motion [N·m]
  std::string mode_set;    // for people: what was assumed of pieces, directions, stuck shafts

  Eigen::Index size() const { return inertia.size(); }
  double twist(std::size_t joint, const Eigen::VectorXd& q) const;
};

// Throws std::invalid_argument where nothing is elastic, or no coordinate is free.
LinearDrive linearise(std::shared_ptr<const Model> model, const LinearisationPoint& at);

// The speed at which a scene is linearised unless told otherwise: of its start, else the rated one of its elements.
double usual_speed(const Model& model);

}  // namespace kurbel
