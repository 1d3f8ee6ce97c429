// engine_torque.h — a piston engine of several equal cylinders on one rigid crankshaft, from the diagram of one of
// them.
//     M(φ) = Σ_k M₁(φ − φ_k),   φ_k where cylinder k fires; M₁ repeats after two turns (four-stroke) or one
//     (two-stroke)
// M₁ is given over the crank angle, 0 = top dead centre at firing, either
//     as torque: the tangential force (tangential-pressure diagram times piston area) times the crank's radius r, or
//     from the indicator diagram p: M₁ = (p − p_out) A r (sin φ + λ sin φ cos φ/√(1 − λ² sin² φ)), λ = r/l.
// With n equal intervals all harmonics cancel but multiples of the n-th of the cycle: orders n/2, n, 3n/2, … of a
// four-stroke engine. Source: e.g. W. Ker Wilson, Practical Solution of Torsional Vibration Problems, vol. 2.
// Masses: what rotates is the engine's inertia; for oscillating masses take slider-cranks.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivetrain/shared/torque_source.h"
#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// From gas pressure to torque; area 0: the diagram is a torque already.
struct CylinderGeometry {
  double area = 0;              // A [m²]
  double radius = 0, rod = 0;   // r, l [m], r < l
  double outside_pressure = 0;  // p_out under the piston [Pa]

  template <class T>
  T torque(const T& pressure, const T& phi) const {
    using std::cos, std::sin, std::sqrt;
    const double ratio = radius / rod;
    const T s = sin(phi);
    return (pressure - outside_pressure) * (area * radius) *
           (s + ratio * s * cos(phi) / sqrt(1.0 - ratio * ratio * s * s));
  }
};

class EngineTorque {
 public:
  static constexpr ShaftTraits is{.account = Account::driving, .uses_angle = true, .guards = 2};

  // cylinder: one cylinder's diagram with the engine's cycle as its period; fires_at: angles φ_k [rad].
  EngineTorque(Curve cylinder, CylinderGeometry geometry, std::vector<double> fires_at)
      : cylinder_(std::move(cylinder)), geometry_(geometry), fires_at_(std::move(fires_at)) {
    std::vector<double> points = edges();
    points.push_back(points.front() + cylinder_.period());
    edges_ = Curve(points, std::vector<double>(points.size(), 0.0), Curve::Form::linear, cylinder_.period());
    const auto count = edges_.x().size() - 1;
    for (std::size_t i = 0; i < count; ++i)
      for (const double at : fires_at_) {
        const double middle = 0.5 * (edges_.x()[i] + edges_.x()[i + 1]) - at;
        piece_.push_back(cylinder_.piece(middle));
      }
  }

  // The modes are the pieces between the points of all cylinders' diagrams.
  template <class T>
  T torque(const ShaftState<T>& x) const {
    T sum(0.0);
    const std::size_t n = fires_at_.size();
    const std::size_t row = std::min(static_cast<std::size_t>(x.mode) * n, piece_.size() - n);
    for (std::size_t k = 0; k < n; ++k) sum = sum + of_cylinder(piece_[row + k], x.angle - fires_at_[k]);
    return sum;
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  double angle_period() const { return cylinder_.period(); }
  void guard(const ShaftState<double>& x, double* g) const { PieceGuard::guard(edges_, x.mode, x.angle, 1.0, g); }
  int first_mode(const ShaftState<double>& x) const { return PieceGuard::first(edges_, x.angle); }
  int next_mode(const ShaftState<double>& x, int which) const { return PieceGuard::next(edges_, x.mode, which); }
  std::string mode_name(int) const { return {}; }  // a diagram's points are no events worth telling
  Rated rated() const {
    const double most = cylinder_.max_abs();
    return {geometry_.area > 0 ? most * geometry_.area * geometry_.radius : most, 0};
  }

 private:
  template <class T>
  T of_cylinder(int piece, const T& phi) const {
    const T diagram =
        cylinder_.value_in(piece, phi + (PieceGuard::near_piece(cylinder_, piece, value_of(phi)) - value_of(phi)));
    return geometry_.area > 0 ? geometry_.torque(diagram, phi) : diagram;
  }
  // The points of all cylinders within one cycle; those that fall together count once.
  std::vector<double> edges() const {
    const double cycle = cylinder_.period(), together = 1e-9 * cycle;
    std::vector<double> all;
    for (const double at : fires_at_)
      for (std::size_t i = 0; i + 1 < cylinder_.x().size(); ++i)
        all.push_back(place_within(cylinder_.x()[i] + at, cycle));
    std::sort(all.begin(), all.end());
    std::vector<double> apart;
    for (const double x : all)
      if (apart.empty() || x - apart.back() > together) apart.push_back(x);
    if (apart.size() > 1 && apart.front() + cycle - apart.back() <= together) apart.pop_back();
    return apart;
  }

  Curve cylinder_;
  CylinderGeometry geometry_;
  std::vector<double> fires_at_;
  Curve edges_;
  std::vector<int> piece_;  // of each cylinder's diagram in each piece between edges
};

}  // namespace kurbel
