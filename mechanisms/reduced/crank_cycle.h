// crank_cycle.h — number of crank turns in the cycle of a mechanism, by following its branch.
//
// Most mechanisms have a cycle of one turn. If the links pass through one line once per turn, they are mirrored after one
// turn and the cycle is two turns. A rocking crank has no cycle; beyond its arc it has the values of the arc's end.
// The angle ψ of an output that turns fully with the crank grows:
//     ψ(φ) = w φ + p(φ),   p has the period of the cycle,   w = (turns of ψ)/(turns of φ) in a cycle
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {

class CrankCycle {
 public:
  CrankCycle() = default;  // one turn of a sliding output
  // Follows the branch with steps that limit the rotation of every link. Throws std::runtime_error if the loop is closed
  // neither after one turn nor after two.
  explicit CrankCycle(const MechanismData& data);

  int turns() const { return turns_; }                         // of the crank in a cycle
  double angle() const;                                        // of the crank in a cycle [rad]
  double winding() const { return winding_; }                  // w
  const std::optional<CrankArc>& arc() const { return arc_; }  // range of a rocking crank
  // φ, limited to the arc.
  double within(double phi) const;
  // A table over the cycle has the period 2π: its place part = φ/turns, of a rocking crank σ with cos σ = (φ − middle)/reach.
  double angle_at(double part) const;
  double part_of(double phi) const;
  double part_rate(double phi) const;  // ∂part/∂φ, 0 at the ends of an arc
  const std::vector<double>& change_points() const {
    return change_points_;
  }  // crank angles in a cycle, ascending [rad]

  // p(φ) from ψ known modulo a turn; for a sliding output, x itself.
  double periodic_part(double phi, double output) const;
  // ψ(φ) without jumps from the same.
  double unwound(double phi, double output) const { return periodic_part(phi, output) + winding_ * phi; }

 private:
  void follow_output(const MechanismData& data, double from, double to);
  void find_change_points(const MechanismData& data);
  double along_arc(double phi) const;  // cos σ

  std::optional<CrankArc> arc_;
  int turns_ = 1;
  double winding_ = 0;
  std::vector<double> change_points_;
  std::vector<double> phi_, part_;  // p at points dense enough to unwrap ψ; empty for a sliding output
};

}  // namespace kurbel
