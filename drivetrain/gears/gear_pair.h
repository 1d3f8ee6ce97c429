// gear_pair.h — a pair of involute gears on parallel shafts: geometry of the mesh, and parameters for the drive.
//
// theory 6; symbols and signs of ISO 21771. An internal pair has z₂ < 0 and therefore d₂, a, a_w and u = z₂/z₁ < 0. Wheel 1
// drives. Positions on the path of contact are distances g from the pitch point C, positive in the direction in which
// the contact moves: from A, at the tip of wheel 2, to E, at the tip of wheel 1.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drivetrain/gears/gear_wheel.h"

namespace kurbel {

struct GearPairData {
  double module = 0;           // m_n [m], > 0
  std::array<int, 2> teeth{};  // z₁ ≥ 5; z₂ ≥ 5, or < 0: internal, with more teeth than wheel 1
  std::array<std::optional<double>, 2> shift{};  // x; see solve_gear_pair for omitted values
  double helix = 0;                              // β [rad], −60° … 60°
  BasicRack rack = {};
  std::optional<double> centre_distance = {};           // |a_w| [m], > 0
  double backlash = 0;                                  // j_bn [m], ≥ 0: normal backlash, half taken from each wheel
  std::array<std::optional<double>, 2> tip_diameter{};  // |d_a| [m]; default by addendum, shift and shortening
  bool shorten_tips = true;                             // of external pairs, so that the clearance stays c* m
  std::array<double, 2> width{};                        // b [m], 0: not known
  std::array<double, 2> bore{};                         // [m]; of an internal wheel: outer diameter, 0: rim of 3.5 m_n
  double density = 7850;                                // [kg/m³]
  double young = 206e9;                                 // E [Pa]
};

// Geometry of a wheel in its mesh.
struct MeshedWheel : GearWheel {
  double working_diameter = 0;       // d_w
  double active_diameter = 0;        // d_Nf: start of active profile, set by the tip of the mating wheel
  double tip_clearance = 0;          // c, from this tip to the root of the mating wheel
  double greatest_tip_diameter = 0;  // |d_a| at which the path ends at T of the mating wheel; interference beyond
  double reached_diameter = 0;       // |d| reached by the mating wheel's tip on the line of action, ≥ |d_b|
  double width = 0, inertia = 0;     // b; J [kg·m²], 0 without a width
  double bore = 0;                   // or outer diameter of an internal wheel
};

// Severity of a finding.
enum class Finding { good, note, warning, fault };

struct GearVerdict {
  Finding finding = Finding::good;
  std::string text;
};

struct GearPair {
  GearPairData data;
  std::array<MeshedWheel, 2> wheel;

  double ratio = 1;                       // u = z₂/z₁, with its sign
  double reference_centre_distance = 0;   // a
  double centre_distance = 0;             // a_w
  double working_angle = 0;               // α_wt
  double shift_sum = 0;                   // x₁ + x₂
  double mating_shift_sum = 0;            // Σx without backlash at this a_w
  double tip_shortening = 0;              // k, in modules, ≤ 0
  double base_pitch = 0;                  // p_et = π m_t cos α_t
  double start = 0, end = 0;              // g of A and E: by the tips, or by the start of undercut flanks
  double tip_start = 0, tip_end = 0;      // g where the tip circles of wheels 2 and 1 intersect the line of action
  double limit_start = 0, limit_end = 0;  // g of T₁ and T₂, where the line of action touches the base circles
  double contact_ratio = 0, overlap_ratio = 0;   // ε_α, ε_β
  double backlash_arc = 0, backlash_normal = 0;  // j_wt on the working circle, j_bn [m]

  bool internal() const { return data.teeth[1] < 0; }
  double total_contact_ratio() const { return contact_ratio + overlap_ratio; }  // ε_γ
  // g of a point of the path: 'A', 'B' (start of single-pair contact), 'C', 'D' (its end), 'E'.
  double point(char name) const;
  // Radii of curvature, and distances from the centres: ρ₁ = ½ d_b1 tan α_wt + g, ρ₂ = ½ d_b2 tan α_wt − g (signed).
  std::array<double, 2> curvature(double g) const;
  std::array<double, 2> radius(double g) const;
  // v_g = ω₁ (1 + 1/u) g: positive where the flank of wheel 1 slides towards its tip [m/s].
  double sliding_speed(double g, double omega_1) const;
  // ζ₁ = 1 − ρ₂/(u ρ₁), ζ₂ = 1 − u ρ₁/ρ₂; −∞ where the wheel's flank ends on its base circle.
  std::array<double, 2> specific_sliding(double g) const;
  // Backlash angle of a wheel (0 or 1) with the other wheel held [rad]; b of theory 5.6 is that of wheel 1.
  double backlash_angle(int i) const;
  // f = ω₁ z₁/2π [Hz].
  double mesh_frequency(double omega_1) const;
};

// Geometry from the data. Omitted shifts are 0 without a centre distance; with one they follow from it (theory 6.5
// inverted): the remainder goes to the omitted shift, or half of it to each. If both shifts and a centre distance are
// given, the backlash follows. Throws std::invalid_argument with a message.
GearPair solve_gear_pair(const GearPairData& data);

// α_wt from a centre distance (signed; theory 6.6): a_w = a cos α_t/cos α_wt.
double working_angle_of(double reference_distance, double transverse_angle, double centre_distance);
// Σx = (z₁ + z₂)(inv α_wt − inv α_t)/(2 tan α_n).
double shift_sum_of(const GearPairData& data, double working_angle);

// Findings on undercut, pointed tips, contact ratio, interference, clearance and backlash.
std::vector<GearVerdict> verdicts(const GearPair& pair);
// Interferences of internal pairs (SDP/SI, Handbook of Metric Gears, section 5.2) [rad]; ≥ 0: none.
double tip_fouling_margin(const GearPair& pair);      // tips outside the path of contact ("trochoid")
double radial_assembly_margin(const GearPair& pair);  // radial assembly of wheel 1 ("trimming")

// Interference of a wheel (0 or 1): on the line of action the tip of the mating wheel passes the start of the involute,
// that is the point T on the base circle, or the form circle at which fillet or undercut begins. The path of contact
// leaves the involute there, with or without undercut (theory 6; ISO 21771: d_Nf < d_Ff).
struct Interference {
  bool beyond_base_circle = false;  // past T
  bool below_form_circle = false;   // |d_reached| < |d_Ff|
  bool found() const { return beyond_base_circle || below_form_circle; }
};
Interference interference(const GearPair& pair, int wheel);
// Minimum distance along the arc between an undercut root and the tip corners of the mating wheel below the form
// circle [m]; < 0: interference, ∞: the corners do not reach below the form circle.
double root_room(const GearPair& pair, int wheel);

// Mesh stiffness by ISO 6336-1 method B. Simplifications: solid wheels (C_R = 1), loads of at least 100 N/mm, equal E of
// both wheels. Valid for x₁ ≥ x₂, −0.5 ≤ Σx ≤ 2, 1.2 < ε_α < 2.5 (then `within` is true). The torsional stiffness needs
// the width.
struct MeshStiffness {
  double single = 0;            // c′ of one pair of teeth per width [N/m per m]
  double mean = 0;              // c_γα = c′ (0.75 ε_α + 0.25)
  double torsional = 0;         // c_γα b r_b1² about wheel 1 [N·m/rad]
  double torsional_single = 0;  // c′ b r_b1²: one pair in contact
  bool within = true;
};
MeshStiffness mesh_stiffness(const GearPair& pair);

// Angles of both wheels in mesh with the working flanks in contact. Wheel 1 is at the origin and turns
// counterclockwise, one of its teeth is at angle_1; wheel 2 is at (a_w, 0).
struct MeshPlace {
  double angle_1 = 0, angle_2 = 0;  // of the middle of a tooth [rad]
};
MeshPlace mesh_place(const GearPair& pair, double angle_1);
// g of the contact of the tooth at angle_1.
double contact_at(const GearPair& pair, double angle_1);

}  // namespace kurbel
