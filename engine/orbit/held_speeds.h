// held_speeds.h — the cycle of a machine with given speeds: one additional unknown for each speed.
//
//     P(z, a) = z,   speeds over the period = given speeds
// a: the holding quantities, torques in addition to the drive or a quantity of the scene.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

// A constant torque in addition to the drive; it has no rated value, so that all machines of a search have the same scales.
struct HoldingTorque {
  static constexpr ShaftTraits is{.account = Account::driving};
  double value = 0;  // [N·m]
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(value);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};

// The given speeds, and the quantities that hold them.
struct HeldSpeeds {
  // The machine with these a, each of order one.
  std::function<std::shared_ptr<const Model>(const Eigen::VectorXd& a)> machine;
  // A new observer of the speeds for each period; owned by the caller.
  std::function<Observer*(const Model& machine)> record;
  // Deviation of the recorded period from each given speed, over its scale.
  std::function<Eigen::VectorXd(const ReturnMap::Image& round)> miss;
  // ∂miss/∂z of a period with derivative; empty: by differences.
  std::function<Eigen::MatrixXd(const ReturnMap::Image& round)> slope = {};
  bool by_differences = false;  // also ∂P/∂z, without additional cost if the slopes are
  double enough = 1e-11;        // residual of convergence
  double magnitude = 0.2;       // of the state from which z deviates (newton.h)
  double most_cost = HUGE_VAL;  // limit for all searches so far [cycles]
};

struct HeldMotion {
  Orbit orbit;                 // a cycle of this machine; failed or interrupted: its words state the reason
  Eigen::VectorXd by;          // a
  Eigen::MatrixXd derivative;  // of all residuals, first P(z, a) − z
  ReturnMap::Image last;       // of the periods tried
  NewtonOutcome newton;
  // For all searches so far.
  double cost = 0;     // [cycles]
  std::string broken;  // end of the last period that was not completed; empty: all were completed
};

// Newton's method from the guess (z, a); section, period and limits of a period are those of a map of a similar machine.
// Only options of the return map are used. Throws OutOfTime; even then `motion` has the cost and `broken`.
void find_held_orbit(const HeldSpeeds& held, const ReturnMap& like, const Eigen::VectorXd& guess,
                     const OrbitOptions& options, HeldMotion& motion);

}  // namespace kurbel
