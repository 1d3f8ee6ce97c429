// flywheel.h — flywheel synthesis from one steady cycle (theory 3): work diagram, inertia, speed, punch presses.
//
// Everything is reduced to the reduction link. Torques are functions of its angle over one cycle; I_em(φ) is the
// reduced inertia of the executive mechanism, I₀ the constant inertia of the drive including its flywheel:
//     ½ (I₀ + I_em) ω² = T₀ + ΔT(φ),   ΔT = A_d − A_c,   a = ½ ω_max²,  b = ½ ω_min²
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/piecewise.h"
#include "studies/cycle/mechanism_inertia.h"

namespace kurbel {

// --- work diagram ---

struct WorkDiagram {
  Piecewise drive_torque, load_torque;  // M_d, M_c [N·m]
  Piecewise net_torque;                 // M_d − M_c
  Piecewise drive_work, load_work;      // A_d, A_c [J]
  Piecewise excess;                     // ΔT = A_d − A_c [J]
  Extreme most, least;                  // of ΔT, where M_d = M_c
  double work = 0;                      // driving work of a cycle [J]

  double fluctuation() const { return most.value - least.value; }  // greatest fluctuation of energy ΔA_max [J]
  double energy_coefficient() const { return fluctuation() / work; }
  double mean_torque() const { return work / drive_torque.length(); }
};

// Both torques over the same breaks. Throws std::invalid_argument if the works of a cycle differ by more than 1e-9:
// then the motion is not steady.
WorkDiagram work_diagram(const Piecewise& drive_torque, const Piecewise& load_torque);
// With the constant driving torque that balances the load, or the constant load that balances the drive. Throw
// std::invalid_argument if there is no net work to balance (≤ 0 J per cycle).
WorkDiagram with_constant_drive(const Piecewise& load_torque);
WorkDiagram with_constant_load(const Piecewise& drive_torque);

// --- inertia for a demanded δ ---

// A tangent to the energy–mass curve (ΔT over I_em) and the angle at which it touches.
struct Tangent {
  double slope = 0;                                              // ½ ω² [J/(kg·m²)]
  double phi = 0, inertia = 0, excess = 0;                       // where: φ [rad], I_em, ΔT
  double intercept() const { return excess - slope * inertia; }  // on the ΔT axis [J]
};

struct Wittenbauer {
  Tangent upper, lower;       // of ½ω_max² and ½ω_min²
  double inertia = 0;         // I₀ [kg·m²] (theory 3.2)
  double kinetic_energy = 0;  // T₀ at the cycle's begin [J]
};

// Exact. I₀ ≤ 0 means that the mechanism needs no flywheel. Throws std::invalid_argument unless 0 < δ < 2 and ω_mid >
// 0.
Wittenbauer wittenbauer(const WorkDiagram& diagram, const MechanismInertia& mechanism, double mid_speed, double delta);

struct Mertsalov {
  Extreme most, least;  // of ΔT₁ = ΔT − ½ ω_mid² I_em
  double inertia = 0;   // I₀ = (max ΔT₁ − min ΔT₁)/(ω_mid² δ)
};
Mertsalov mertsalov(const WorkDiagram& diagram, const MechanismInertia& mechanism, double mid_speed, double delta);

// Without I_em: I₀ = ΔA_max/(ω_mid² δ) (turning-moment diagrams).
double inertia_by_fluctuation(double fluctuation, double mid_speed, double delta);

// I_fly = I_drive − 1.1 I_motor − I_gearbox (theory 3.1), all on the flywheel's shaft.
double flywheel_by_parts(double drive, double motor, double gearbox);

void check_delta(double delta);  // std::invalid_argument unless 0 < δ < 2

// --- speed of a machine with a given inertia ---

// Steady motion with torques that depend on the angle only: ω(φ) from energy, exactly.
class SpeedCycle {
 public:
  // The cycle of the family with the requested ω_mid = (ω_max + ω_min)/2. Throws std::invalid_argument if the inertia
  // is too small to carry the machine through the cycle at that speed.
  SpeedCycle(const WorkDiagram& diagram, const MechanismInertia& mechanism, double inertia, double mid_speed);

  double speed(double phi) const;  // [rad/s]
  Extreme fastest() const { return fastest_; }
  Extreme slowest() const { return slowest_; }
  double delta() const;  // (theory 2.6)

 private:
  struct Extremes {
    Extreme most, least;  // of ½ω²
  };
  Extremes extremes_at(double energy) const;
  Extreme extreme(double energy, bool most) const;

  const WorkDiagram* diagram_;
  const MechanismInertia* mechanism_;
  double inertia_, energy_ = 0;
  Extreme fastest_, slowest_;
};

// --- punch presses: energy per stroke, time ---

struct PunchPress {
  double energy = 0;                // per stroke E [J], > 0
  double cycle_time = 0;            // between strokes t_c [s], > 0
  double working_time = 0;          // of a stroke t_w [s], 0 ≤ t_w ≤ t_c
  std::optional<double> work = {};  // of the drive per stroke, with losses and further loads [J]; default: E

  double power() const { return work.value_or(energy) / cycle_time; }  // of the motor at constant load [W]
  // The motor delivers energy during the working time, too: ΔE = E (1 − t_w/t_c).
  double from_flywheel() const { return energy * (1 - working_time / cycle_time); }
};

// --- dimensions ---

struct FlywheelMaterial {
  std::string name;
  double density = 0;    // [kg/m³]
  double poisson = 0;    // ν
  double strength = 0;   // tensile [Pa]
  double rim_speed = 0;  // customary limit [m/s]
};
const std::vector<FlywheelMaterial>& flywheel_materials();
// Throws std::invalid_argument with the list of names.
const FlywheelMaterial& flywheel_material(const std::string& name);

enum class FlywheelForm { disc, rim };

struct FlywheelRequest {
  FlywheelForm form = FlywheelForm::rim;
  FlywheelMaterial material;
  double inertia = 0;    // [kg·m²], > 0
  double fastest = 0;    // ω_max of its shaft [rad/s], > 0
  double diameter = 0;   // outer [m]; 0: by proportion, as the rim speed allows
  double rim_speed = 0;  // limit [m/s]; 0: the material's
};

// A solid disc; or a rim of rectangular section, breadth b = 2 h, on six elliptical spokes (axes h and h/2) and a hub
// of a fifth of the outer diameter. All parts contribute to the inertia.
struct FlywheelDimensions {
  FlywheelForm form = FlywheelForm::rim;
  FlywheelMaterial material;
  double inertia = 0, diameter = 0, breadth = 0;  // [kg·m²], [m]
  double thickness = 0;                           // of the rim, radially [m]; 0: disc
  double mass = 0, rim_mass = 0;                  // [kg]
  double rim_share = 1;                           // of the inertia
  double rim_speed = 0, rim_speed_limit = 0;      // at the outer diameter and ω_max [m/s]
  double stress = 0;          // disc: (3+ν)/8 ρ v²; rim: ρ v_m² (free ring, mean diameter) [Pa]
  double spoked_stress = 0;   // rim between spokes: ρ v_m² (0.75 + 4.935 R_m/(n² h)); disc: the same as stress [Pa]
  double allowed_stress = 0;  // ρ v² at the limit of rim speed (disc: (3+ν)/8 of it) [Pa]
  double safety = 0;          // tensile strength over the larger stress
  double energy = 0;          // stored at ω_max [J]
  bool within_limit = true;   // of rim speed
};
inline constexpr int flywheel_spokes = 6;

// Throws std::invalid_argument if the inertia does not fit the diameter, or a value is outside its domain.
FlywheelDimensions flywheel_dimensions(const FlywheelRequest& request);

// --- customary δ ---

struct CustomaryDelta {
  std::string machine;  // as in --machine
  double low = 0, high = 0;
  std::string doc, source;
};
const std::vector<CustomaryDelta>& customary_deltas();
// Throws std::invalid_argument with the list of names.
const CustomaryDelta& customary_delta(const std::string& machine);

// Sentence on mean torques on the link [N·m] that do not balance (`rest`: drive minus load) and the constant torque added.
std::string unbalanced(double drive, double load, double rest);

}  // namespace kurbel
