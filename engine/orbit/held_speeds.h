// held_speeds.h — the cycle of a machine whose speeds are held: one more unknown for each speed.
//
//     P(z, a) = z,   speeds over the round = those asked for
// a: what holds them, torques beside the drive or a quantity of the scene.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

// A constant torque beside the drive; it sets no scale, so that all members of a search are measured alike.
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

// What is held, and what by.
struct HeldSpeeds {
  // The machine that these a hold, each of order one.
  std::function<std::shared_ptr<const Model>(const Eigen::VectorXd& a)> machine;
  // What sees the speeds of a round: anew for each one, the caller's own.
  std::function<Observer*(const Model& machine)> record;
  // By how much the recorded round misses each of the speeds, over its scale.
  std::function<Eigen::VectorXd(const ReturnMap::Image& round)> miss;
  // ∂miss/∂z of a round with its derivative; empty: by differences.
  std::function<Eigen::MatrixXd(const ReturnMap::Image& round)> slope = {};
  bool by_differences = false;  // ∂P/∂z, too: at no cost where slopes are
  double enough = 1e-11;        // residual at which it ends
  double magnitude = 0.2;       // of what z deviates from (newton.h)
  double most_cost = HUGE_VAL;  // of all searches so far [cycles]
};

struct HeldMotion {
  Orbit orbit;                 // a cycle of the machine held; failed or interrupted: its words say why
  Eigen::VectorXd by;          // a
  Eigen::MatrixXd derivative;  // of all residuals, of P(z, a) − z first
  ReturnMap::Image last;       // of the rounds that were tried
  NewtonOutcome newton;
  // Of all searches so far.
  double cost = 0;     // [cycles]
  std::string broken;  // what became of the last round that did not come round; empty: all did
};

// By Newton's method from (z, a) on; section, period and limits of a round are those of a map of a like machine. Of the
// options those of the return map count. Throws OutOfTime; `motion` has its cost and what broke off even so.
void find_held_orbit(const HeldSpeeds& held, const ReturnMap& like, const Eigen::VectorXd& guess,
                     const OrbitOptions& options, HeldMotion& motion);

}  // namespace kurbel
