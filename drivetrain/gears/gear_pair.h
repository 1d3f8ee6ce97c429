// gear_pair.h — a pair of involute wheels on parallel shafts: geometry of the mesh, and what it gives to the drive.
//
// theory 6; symbols and signs of ISO 21771. An internal pair has z₂ < 0, and so d₂, a, a_w and u = z₂/z₁ < 0. Wheel 1
// drives. Places on the path of contact are distances g from the pitch point C, positive in the direction in which the
// contact moves: it begins at A on the tip of wheel 2 and ends at E on the tip of wheel 1.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drivetrain/gears/gear_wheel.h"

namespace kurbel {

struct GearPairData {
  double module = 0;           // m_n [m], > 0
  std::array<int, 2> teeth{};  // z₁ ≥ 5; z₂ ≥ 5, or < 0: internal, with more teeth than wheel 1
  std::array<std::optional<double>, 2> shift{};  // x; see solve_gear_pair for what is not given
  double helix = 0;                              // β [rad], −60° … 60°
  BasicRack rack = {};
  std::optional<double> centre_distance = {};  // |a_w| [m], > 0
  double backlash = 0;                         // j_bn [m], ≥ 0: allowance along the normal, half off each wheel
  std::array<std::optional<double>, 2> tip_diameter{};  // |d_a| [m]; by addendum, shift and shortening otherwise
  bool shorten_tips = true;                             // of external pairs, so that the clearance stays c* m
  std::array<double, 2> width{};                        // b [m], 0: not known
  std::array<double, 2> bore{};                         // [m]; of an internal wheel: outer diameter, 0: rim of 3.5 m_n
  double density = 7850;                                // [kg/m³]
  double young = 206e9;                                 // E [Pa]
};

// Geometry of a wheel in its mesh.
struct MeshedWheel : GearWheel {
  double working_diameter = 0;       // d_w
  double active_diameter = 0;        // d_Nf: the mate's tip reaches down to here
  double tip_clearance = 0;          // c, from its tip to the mate's root
  double greatest_tip_diameter = 0;  // |d_a| whose path ends at the mate's T: beyond it involutes interfere
  double reached_diameter = 0;       // |d| that the mate's tip comes down to on the line of action, ≥ |d_b|
  double width = 0, inertia = 0;     // b; J [kg·m²], 0 without a width
  double bore = 0;                   // or rim of an internal wheel
};

// Gravity of a finding.
enum class Finding { good, note, warning, fault };

struct GearVerdict {
  Finding finding = Finding::good;
  std::string text;
};

struct GearPair {
  GearPairData data;
  std::array<MeshedWheel, 2> wheel;

  double ratio = 1;                             // u = z₂/z₁, with its sign
  double reference_centre_distance = 0;         // a
  double centre_distance = 0;                   // a_w
  double working_angle = 0;                     // α_wt
  double shift_sum = 0;                         // x₁ + x₂
  double mating_shift_sum = 0;                  // Σx whose flanks touch on both sides at this a_w
  double tip_shortening = 0;                    // k, in modules, ≤ 0
  double base_pitch = 0;                        // p_et = π m_t cos α_t
  double start = 0, end = 0;                    // g of A and E: by the tips, or where undercut flanks begin
  double tip_start = 0, tip_end = 0;            // g where the tip circles of wheel 2 and wheel 1 cut the line of action
  double limit_start = 0, limit_end = 0;        // g of T₁ and T₂, where the line of action leaves the base circles
  double contact_ratio = 0, overlap_ratio = 0;  // ε_α, ε_β
  double backlash_arc = 0, backlash_normal = 0;  // j_wt on the working circle, j_bn [m]

  bool internal() const { return data.teeth[1] < 0; }
  double total_contact_ratio() const { return contact_ratio + overlap_ratio; }  // ε_γ
  // g of a point of the path: 'A', 'B' (from here on one pair of teeth), 'C', 'D' (until here), 'E'.
  double point(char name) const;
  // Radii of curvature, and of the point from each centre: ρ₁ = ½ d_b1 tan α_wt + g, ρ₂ = ½ d_b2 tan α_wt − g (signed).
  std::array<double, 2> curvature(double g) const;
  std::array<double, 2> radius(double g) const;
  // v_g = ω₁ (1 + 1/u) g: positive where the flank of wheel 1 slides towards its tip [m/s].
  double sliding_speed(double g, double omega_1) const;
  // ζ₁ = 1 − ρ₂/(u ρ₁), ζ₂ = 1 − u ρ₁/ρ₂; −∞ where the own flank ends on its base circle.
  std::array<double, 2> specific_sliding(double g) const;
  // Free angle of a wheel (0 or 1) while its mate is held [rad]; the b of theory 5.6 is that of wheel 1.
  double backlash_angle(int i) const;
  // f = ω₁ z₁/2π [Hz].
  double mesh_frequency(double omega_1) const;
};

// Everything from the data. Shifts not given: without a centre distance they are 0; with one they follow from it
// (theory 6.5 backwards), the whole rest to the one that is missing, or half to each. Both shifts and a centre distance
// may be given: the backlash then follows. Throws std::invalid_argument in words.
GearPair solve_gear_pair(const GearPairData& data);

// α_wt from a centre distance, and back (signed distances; theory 6.6): a_w = a cos α_t/cos α_wt.
double working_angle_of(double reference_distance, double transverse_angle, double centre_distance);
// Σx = (z₁ + z₂)(inv α_wt − inv α_t)/(2 tan α_n).
double shift_sum_of(const GearPairData& data, double working_angle);

// What is wrong or worth knowing: undercut, pointed tips, contact ratio, interference, clearance, backlash.
std::vector<GearVerdict> verdicts(const GearPair& pair);
// Interferences of internal pairs (SDP/SI, Handbook of Metric Gears, section 5.2): ≥ 0 is free [rad].
double tip_fouling_margin(const GearPair& pair);      // tips outside the path of contact ("trochoid")
double radial_assembly_margin(const GearPair& pair);  // wheel 1 can be moved in radially ("trimming")

// Interference of a wheel (0 or 1): the mate's tip goes further down on the line of action than the involute does, to
// beyond the point T on the base circle, or below the form circle where fillet or undercut begins. The path of contact
// leaves the involute there, undercut or not (theory 6; ISO 21771: d_Nf < d_Ff).
struct Interference {
  bool beyond_base_circle = false;  // past T
  bool below_form_circle = false;   // |d_reached| < |d_Ff|
  bool found() const { return beyond_base_circle || below_form_circle; }
};
Interference interference(const GearPair& pair, int wheel);
// Room that an undercut root leaves to the corners of the mate's tip below its form circle, along the arc, at the
// nearest: < 0 they cut into it, ∞ they do not come there [m].
double root_room(const GearPair& pair, int wheel);

// Mesh stiffness by ISO 6336-1 method B. Simplified: solid wheels (C_R = 1), loads of at least 100 N/mm, E of both
// wheels the same; valid for x₁ ≥ x₂, −0.5 ≤ Σx ≤ 2, 1.2 < ε_α < 2.5: `within` says so. No width, no torsional
// stiffness.
struct MeshStiffness {
  double single = 0;            // c′ of one pair of teeth per width [N/m per m]
  double mean = 0;              // c_γα = c′ (0.75 ε_α + 0.25)
  double torsional = 0;         // c_γα b r_b1² about wheel 1 [N·m/rad]
  double torsional_single = 0;  // c′ b r_b1²: while one pair carries
  bool within = true;
};
MeshStiffness mesh_stiffness(const GearPair& pair);

// Places of both wheels in mesh, wheel 1 in the origin turning counterclockwise with its tooth at `angle`; wheel 2 at
// (a_w, 0). Working flanks touch.
struct MeshPlace {
  double angle_1 = 0, angle_2 = 0;  // of the middle of a tooth [rad]
};
MeshPlace mesh_place(const GearPair& pair, double angle_1);
// g of the contact of the tooth that stands at angle_1.
double contact_at(const GearPair& pair, double angle_1);

}  // namespace kurbel
