// crank_cycle.h — after how many turns of the crank a mechanism comes back, by following its branch.
//
// Most loops are closed after one turn. Links that pass through one line once a turn come back on the other side and
// are closed after two. A link that carries the loads and goes round with the crank has an angle ψ that grows:
// A crank that rocks has no cycle: what is asked of one beyond its arc is told of the arc's end.
//     ψ(φ) = w φ + p(φ),   p with the cycle's period,   w = (turns of ψ)/(turns of φ) in a cycle
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {

class CrankCycle {
 public:
  CrankCycle() = default;  // one turn of a sliding output
  // Follows the branch in steps in which no link turns by more than a bound. Throws std::runtime_error where the loop is
  // closed neither after one turn nor after two.
  explicit CrankCycle(const MechanismData& data);

  int turns() const { return turns_; }                         // of the crank
  double angle() const;                                        // of the crank in a cycle [rad]
  double winding() const { return winding_; }                  // w
  const std::optional<CrankArc>& arc() const { return arc_; }  // of a crank that rocks
  // φ, or the end of the arc that it lies beyond.
  double within(double phi) const;
  const std::vector<double>& change_points() const {
    return change_points_;
  }  // crank angles in a cycle, ascending [rad]

  // p(φ) from a ψ that is known but for whole turns; of a sliding output, x itself.
  double periodic_part(double phi, double output) const;
  // ψ(φ) from the same.
  double unwound(double phi, double output) const { return periodic_part(phi, output) + winding_ * phi; }

 private:
  void follow_output(const MechanismData& data, double from, double to);
  void find_change_points(const MechanismData& data);

  std::optional<CrankArc> arc_;
  int turns_ = 1;
  double winding_ = 0;
  std::vector<double> change_points_;
  std::vector<double> phi_, part_;  // p at places close enough for what lies between; empty for a sliding output
};

}  // namespace kurbel
