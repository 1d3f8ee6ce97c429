// rod_flexibility.h — bending and stretching of a prismatic rod between its pins, as amplitudes of shape functions.
//
//     w(s) = Σ q_i sin(iπ s/l)           transverse, i = 1 … n: modes of the simply supported rod
//     u(s) = U_m 4ξ(1 − ξ) + U_e ξ(2ξ − 1),  ξ = s/l      axial: displacement of middle and end (quadratic element)
// Source: B. Simeon, Modelling a flexible slider crank mechanism by a mixed system of DAEs and PDEs, Math. Modelling of
// Systems 2 (1996), 1–18; the linear stiffness of its Test Set problem "slider crank".
#pragma once

#include <array>
#include <cstddef>

namespace kurbel {

// Data of the scene.
struct RodFlexibility {
  double modulus = 0;        // E [Pa], > 0
  double area = 0;           // A [m²], > 0
  double second_moment = 0;  // I of the bending in the plane of motion [m⁴], > 0
  double edge = 0;           // distance of the outer fibre from the axis [m]; 0: stress is not computed
  int modes = 2;             // of bending, 0 … 6
  bool axial = true;         // includes stretching
  double damping_ratio = 0;  // ζ of each bending mode, and of the first stretching one
  // Factor on the consistent masses of the stretching amplitudes. 15 gives the problem of the Test Set, whose matrix lacks
  // the factor 1/15 of the quadratic element.
  double stretching_mass_factor = 1;

  static constexpr int most_modes = 6;
  int count() const { return modes + (axial ? 2 : 0); }
};

// Masses and stiffnesses of the rod, integrated over its length. Amplitudes: bending first, then U_m and U_e.
struct RodModes {
  static constexpr std::size_t most = RodFlexibility::most_modes + 2;
  using Vector = std::array<double, most>;

  RodModes() = default;
  RodModes(const RodFlexibility& rod, double length, double mass);

  int bending = 0;  // number of bending modes
  bool axial = false;
  double length = 0, mass_per_length = 0;
  Vector along{};                  // ∫U_j ds, at the indices of the axial amplitudes [m]
  Vector across{};                 // ∫W_i ds [m]
  Vector moment_along{};           // ∫s U_j ds [m²]
  Vector moment_across{};          // ∫s W_i ds [m²]
  double product[2][most]{};       // ∫U_j W_i ds [m]
  double mass[most][most]{};       // μ∫U_j U_k ds, μ∫W_i W_k ds [kg]
  double stiffness[most][most]{};  // [N/m]
  double damping[most][most]{};    // [N·s/m]

  int count() const { return bending + (axial ? 2 : 0); }
  int end() const { return axial ? bending + 1 : -1; }  // index of U_e
  double frequency(int bending_mode) const;             // of the simply supported rod, mode 1 … [rad/s]

  // Shape functions at ξ = s/l, and the curvature w″ per amplitude.
  double shape(int amplitude, double xi) const;
  double curvature(int amplitude, double xi) const;
};

}  // namespace kurbel
