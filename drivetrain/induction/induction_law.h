// induction_law.h — what the keys of an induction motor make of it: Kloss' curve, a curve through the catalogue's points,
// or its two-axis circuit.
#pragma once

#include <optional>
#include <variant>

#include "drivetrain/induction/catalogue_motor.h"
#include "drivetrain/induction/induction_circuit.h"
#include "drivetrain/induction/induction_keys.h"
#include "drivetrain/induction/kloss.h"

namespace kurbel {

using InductionLaw = std::variant<InductionMotor, CatalogueMotor, TwoAxisMotor>;

// None where the keys do not fit each other; what is wrong stands in the reading's messages.
std::optional<InductionLaw> induction_law(const Reading<InductionKeys>& motor);

// An induction motor as a study sees it, whatever keys described it (Network::data).
struct InductionData {
  double rated_torque = 0;       // M_n [N·m]; where the scene does not say it half of the breakdown torque
  double synchronous_speed = 0;  // ω_s [rad/s]
  double breakdown_slip = 0;     // s_b [1], of the curve that it follows
  double mains = 0;              // f [Hz]; not given: 50 Hz, or 60 Hz where only that makes whole pole pairs
  bool has_circuit = false;      // data of the two-axis model
  bool by_converter = false;     // its supply is no mains
  double rated_speed = 0;        // ω_n [rad/s]; 0: the scene does not say it
};

// Of its two-axis circuit, where it has one (Network::data).
struct InductionWindings {
  double stator_resistance = 0, rotor_resistance = 0;  // R_s, R_r′ [Ω]
  double rated_current = 0;                            // effective, of a line, at the rated slip [A]; 0: not known
};

}  // namespace kurbel
