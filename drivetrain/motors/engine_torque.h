// engine_torque.h — piston engine of several equal cylinders on a rigid crankshaft, by the diagram of one cylinder.
//     M(φ) = Σ_k M₁(φ − φ_k),   φ_k: firing angle of cylinder k; the period of M₁ is two turns (four-stroke) or one
//     (two-stroke)
// M₁ is given over the crank angle, 0 = top dead centre at firing, either
//     as torque: the tangential force (tangential-pressure diagram times piston area) times the crank's radius r, or
//     from the indicator diagram p: M₁ = (p − p_out) A r (sin φ + λ sin φ cos φ/√(1 − λ² sin² φ)), λ = r/l.
// A misfiring cylinder has its own diagram, the motored one; M₁ is then the diagram of each cylinder.
// With n equal firing intervals and equal diagrams only multiples of the n-th harmonic of the cycle remain: orders n/2, n,
// 3n/2, … of a four-stroke engine. Source: e.g. W. Ker Wilson, Practical Solution of Torsional Vibration Problems, vol. 2.
// Masses: the engine has only its rotating inertia; for reciprocating masses use slider-cranks.
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

// From gas pressure to torque; area 0: the diagram is a torque.
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
  static constexpr ShaftTraits is{.account = Account::driving, .uses_angle = true, .guards = 2, .described = true};

  struct Cylinder {
    double fires_at = 0;      // φ_k [rad]
    std::size_t diagram = 0;  // index of its diagram
  };

  // diagrams: each of one cylinder, with the cycle of the engine as period. substitute: description of a default diagram
  // used where the scene gives none.
  EngineTorque(std::vector<Curve> diagrams, CylinderGeometry geometry, std::vector<Cylinder> cylinders,
               std::string substitute = {})
      : diagrams_(std::move(diagrams)),
        geometry_(geometry),
        cylinders_(std::move(cylinders)),
        substitute_(std::move(substitute)) {
    std::vector<double> points = edges();
    if (points.size() == 1) points.push_back(points.front() + 0.5 * cycle());  // one edge needs its event
    points.push_back(points.front() + cycle());
    edges_ = Curve(points, std::vector<double>(points.size(), 0.0), Curve::Form::linear, cycle()).over_angle();
    for (std::size_t i = 0; i + 1 < edges_.x().size(); ++i)
      for (const Cylinder& c : cylinders_) {
        const double middle = 0.5 * (edges_.x()[i] + edges_.x()[i + 1]), read = middle - c.fires_at;
        part_.push_back({diagrams_[c.diagram].piece(read), middle - diagrams_[c.diagram].within(read)});
      }
  }

  // The modes are the pieces between the points of all cylinders' diagrams.
  template <class T>
  T torque(const ShaftState<T>& x) const {
    T sum(0.0);
    const std::size_t n = cylinders_.size();
    const PieceGuard::Place at = PieceGuard::place(edges_, x.mode, value_of(x.angle));
    const std::size_t row = std::min(static_cast<std::size_t>(at.piece) * n, part_.size() - n);
    const T angle = x.angle + (at.x - value_of(x.angle));
    for (std::size_t k = 0; k < n; ++k) sum = sum + of_cylinder(k, part_[row + k], angle);
    return sum;
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  double angle_period() const { return cycle(); }
  void guard(const ShaftState<double>& x, double* g) const { PieceGuard::guard(edges_, x.mode, x.angle, 1.0, g); }
  int first_mode(const ShaftState<double>& x) const { return PieceGuard::first(edges_, x.angle); }
  int next_mode(const ShaftState<double>& x, int which) const { return PieceGuard::next(edges_, x.mode, which); }
  std::string mode_name(int) const { return {}; }  // passing a point of a diagram is not reported
  std::string describe() const { return substitute_; }
  Rated rated() const {
    double most = 0;
    for (const Curve& diagram : diagrams_) most = std::max(most, diagram.max_abs());
    return {geometry_.area > 0 ? most * geometry_.area * geometry_.radius : most, 0};
  }

 private:
  // Of a cylinder's diagram between two edges.
  struct Part {
    int piece;
    double begin;  // angle at which the diagram begins [rad]
  };
  double cycle() const { return diagrams_.front().period(); }
  template <class T>
  T of_cylinder(std::size_t k, const Part& part, const T& angle) const {
    const T phi = angle - part.begin, read = diagrams_[cylinders_[k].diagram].value_in(part.piece, phi);
    return geometry_.area > 0 ? geometry_.torque(read, phi) : read;
  }
  // The points of all cylinders within one cycle; coinciding points count once.
  std::vector<double> edges() const {
    const double cycle = this->cycle(), together = 1e-9 * cycle;
    std::vector<double> all;
    for (const Cylinder& c : cylinders_) {
      const std::vector<double>& x = diagrams_[c.diagram].x();
      for (std::size_t i = 0; i + 1 < x.size(); ++i) all.push_back(place_within(x[i] + c.fires_at, cycle));
    }
    std::sort(all.begin(), all.end());
    std::vector<double> apart;
    for (const double x : all)
      if (apart.empty() || x - apart.back() > together) apart.push_back(x);
    if (apart.size() > 1 && apart.front() + cycle - apart.back() <= together) apart.pop_back();
    return apart;
  }

  std::vector<Curve> diagrams_;
  CylinderGeometry geometry_;
  std::vector<Cylinder> cylinders_;
  std::string substitute_;
  Curve edges_;
  std::vector<Part> part_;  // of each cylinder between each two edges
};

}  // namespace kurbel
