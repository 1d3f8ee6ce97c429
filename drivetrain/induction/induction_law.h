// induction_law.h — the law of an induction motor by its keys: Kloss' curve, a curve through the points of the catalogue,
// or the two-axis circuit.
#pragma once

#include <optional>
#include <variant>

#include "drivetrain/induction/catalogue_motor.h"
#include "drivetrain/induction/induction_circuit.h"
#include "drivetrain/induction/induction_keys.h"
#include "drivetrain/induction/kloss.h"

namespace kurbel {

using InductionLaw = std::variant<InductionMotor, CatalogueMotor, TwoAxisMotor>;

// Empty if the keys are inconsistent; the reading's messages state the fault.
std::optional<InductionLaw> induction_law(const Reading<InductionKeys>& motor);

// Data of an induction motor for studies, whichever keys were given (Network::data).
struct InductionData {
  double rated_torque = 0;       // M_n [N·m]; default: half of the breakdown torque
  double synchronous_speed = 0;  // ω_s [rad/s]
  double breakdown_slip = 0;     // s_b [1] of its curve
  double mains = 0;              // f [Hz]; default: 50 Hz, or 60 Hz if only that gives an integer number of pole pairs
  bool has_circuit = false;      // has data of the two-axis model
  bool by_converter = false;     // supplied by a converter, not by the mains
  double rated_speed = 0;        // ω_n [rad/s]; 0: not given in the scene
};

// Data of its two-axis circuit, if it has one (Network::data).
struct InductionWindings {
  double stator_resistance = 0, rotor_resistance = 0;  // R_s, R_r′ [Ω]
  double rated_current = 0;                            // RMS line current at the rated slip [A]; 0: unknown
};

}  // namespace kurbel
