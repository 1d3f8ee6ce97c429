// motors.h — DC shunt motor by its static characteristic M(ω) (theory 4); armature currents of DC motors by their torques.
#pragma once

#include "engine/elements/element.h"

namespace kurbel {

// DC shunt (separately excited) motor, static: M = M_stall (c − ω/ω₀). c: voltage over rated voltage, set by the operating
// sequence; default 1; −1: reversed (plugging); 0: off, the circuit is open.
struct DcShuntMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true};
  double stall_torque = 0;   // M_stall [N·m], > 0
  double no_load_speed = 0;  // ω₀ [rad/s], > 0
  double rated_torque = 0;   // for error scales; 0: the stall torque

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return stall_torque * (x.command - x.rate / no_load_speed);
  }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {rated_torque > 0 ? rated_torque : stall_torque, no_load_speed}; }
};

// Mean square of the armature current from mean torque and mean square torque (Network::data).
struct ArmatureCurrent {
  double by_mean = 0;    // A² for a mean torque of 1 N·m: a series motor, M = κ i²
  double by_square = 0;  // A² for a mean square of 1 N²·m²: a shunt motor under its full field, M = k i
};

}  // namespace kurbel
