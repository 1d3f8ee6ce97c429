// poincare_section.h — a state on a section through the motion, and the coordinates of its neighbours: what may differ there.
//
//     δy = D z,   z = L δy                                      D: directions, L: what is read of a state
// Angles and twists are bound by the kinematics (δθ = gain_a δφ_A − gain_b δφ_B, gears' relations), by contacts that stick
// all the way round, and by the section itself (the link's angle); speeds by what sticks at the section. Of what is
// left, coordinates are states themselves as far as possible: twists, angles that some law reads, independent speeds, own
// states. Left out is what no law reads: slip angles of clutches and films, and where an elastic belt slips, twist and
// slipped angle drift together. Scaled: twists by rated torque over stiffness, speeds by the rated speed, angles by 1 rad.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/events/equations.h"

namespace kurbel {

struct SectionOptions {
  bool by_angle = true;                 // the section is the link at its angle; else a moment of time
  std::vector<char> sticks_throughout;  // per contact (contacts_of): its two sides never slip on the way round
};

// Binds a state's modes for y beside it; where a law's piece cannot hold there, those that do.
void bind_beside(Equations& equations, const State& state, std::span<const double> y);

class PoincareSection {
 public:
  // Through this state of the equations' machine, whose modes they carry.
  PoincareSection(Equations& equations, State state, const SectionOptions& options);

  const State& state() const { return state_; }
  std::size_t size() const { return coordinates_.size(); }
  // The neighbour at z, for equations of the same machine: sets their modes to the section's; where a law's piece cannot
  // hold there, to those that do.
  std::vector<double> place(Equations& equations, const Eigen::VectorXd& z) const;
  // z of a state after a round; angles less whole periods of what reads them.
  Eigen::VectorXd read(const Modes& modes, std::span<const double> y) const;
  const Eigen::MatrixXd& directions() const { return directions_; }    // D = ∂y/∂z, states × size
  Eigen::MatrixXd read_directions(const Eigen::MatrixXd& of_y) const;  // L · δy
  // The same of directions that end here while y moves at this rate: a section of the link's angle is reached later or
  // sooner by `slowing` [s].
  Eigen::MatrixXd read_at_end(Eigen::MatrixXd directions, std::span<const double> rate,
                              Eigen::RowVectorXd& slowing) const;
  const SectionOptions& options() const { return options_; }
  bool is_angle(std::size_t coordinate) const { return coordinates_[coordinate].period > 0; }
  double magnitude() const;  // of the state itself, in the scales of z
  std::string name(const Equations& equations, std::size_t coordinate) const;

 private:
  // One coordinate: a sum of states over a scale.
  struct Coordinate {
    std::vector<std::pair<std::size_t, double>> terms;  // state, weight
    double scale = 1;
    double period = 0;  // of what reads an angle [rad]; 0: it is no angle
  };
  class Maker;

  State state_;
  SectionOptions options_;
  std::size_t link_;  // the reduction link's angle in y
  std::vector<Coordinate> coordinates_;
  Eigen::MatrixXd directions_;
};

}  // namespace kurbel
