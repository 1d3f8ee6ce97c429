// poincare_section.h — a state on a Poincaré section, and coordinates of the neighbouring states on it.
//
//     δy = D z,   z = L δy                                      D: directions, L: reads z from a state
// Angles and twists are constrained by the kinematics (δθ = gain_a δφ_A − gain_b δφ_B, gears' relations), by contacts that
// stick over the whole period, and by the section (the link's angle); speeds by contacts that stick at the section. Where
// possible, the coordinates are states: twists, angles used by some law, independent speeds, internal states. States used by
// no law are omitted: slip angles of clutches and films, and for a slipping elastic belt the common drift of twist and
// slipped angle. Scales: twists by rated torque over stiffness, speeds by the rated speed, angles by 1 rad.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/events/equations.h"

namespace kurbel {

struct SectionOptions {
  bool by_angle = true;                 // the section is at an angle of the link; else at a time
  std::vector<char> sticks_throughout;  // per contact (contacts_of): it sticks over the whole period
};

// Binds a state's modes for a neighbouring y; pieces of laws that are not valid there are replaced.
void bind_beside(Equations& equations, const State& state, std::span<const double> y);

class PoincareSection {
 public:
  // Section through this state; the equations have its modes.
  PoincareSection(Equations& equations, State state, const SectionOptions& options);

  const State& state() const { return state_; }
  std::size_t size() const { return coordinates_.size(); }
  // The neighbouring state at z, for equations of the same machine: sets their modes to those of the section; pieces of laws
  // that are not valid there are replaced.
  std::vector<double> place(Equations& equations, const Eigen::VectorXd& z) const;
  // z of a state after a period; angles modulo the periods of the laws that use them.
  Eigen::VectorXd read(const Modes& modes, std::span<const double> y) const;
  // Greatest difference between the speeds of the state y and those of the state that z describes, over the usual speeds.
  // It is above rounding where a contact that sticks on the section slips in y.
  double missed(const Equations& equations, const Eigen::VectorXd& z, std::span<const double> y) const;
  const Eigen::MatrixXd& directions() const { return directions_; }    // D = ∂y/∂z, states × size
  Eigen::MatrixXd read_directions(const Eigen::MatrixXd& of_y) const;  // L · δy
  // The same for directions that end on a section at an angle while y changes at this rate: the section is reached later
  // by `slowing` [s].
  Eigen::MatrixXd read_at_end(Eigen::MatrixXd directions, std::span<const double> rate,
                              Eigen::RowVectorXd& slowing) const;
  const SectionOptions& options() const { return options_; }
  bool is_angle(std::size_t coordinate) const { return coordinates_[coordinate].period > 0; }
  double magnitude() const;  // of the state, in the scales of z
  std::string name(const Equations& equations, std::size_t coordinate) const;

 private:
  // One coordinate: a sum of states over a scale.
  struct Coordinate {
    std::vector<std::pair<std::size_t, double>> terms;  // state, weight
    double scale = 1;
    double period = 0;  // of the laws that use an angle [rad]; 0: not an angle
  };
  class Maker;

  State state_;
  SectionOptions options_;
  std::size_t link_;  // the reduction link's angle in y
  std::vector<Coordinate> coordinates_;
  Eigen::MatrixXd directions_;
};

}  // namespace kurbel
