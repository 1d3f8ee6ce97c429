// catalogue_motor.h — induction motor by the points of its catalogue: starting (locked rotor), pull-up, breakdown,
// rated, synchronous. Kloss' formula underrates the starting torque of cage motors (theory 4.1: deep bars, double
// cages), so starts are computed with these points.
//
//     M
//     |          .-B.                 S  starting      (0, M_st)
//     S.       .'    '.               P  pull-up       slope zero, minimum during run-up
//     | '-.P.-'        R              B  breakdown     slope zero, maximum
//     |                 \             R  rated
//     +------------------O---- ω      O  synchronous   (ω_s, 0)
//
// Between the points a monotone cubic (Fritsch & Carlson 1980): extrema only at P and B, continuous slope.
// Command c of an operating sequence: M = sgn c · c² M(ω sgn c); 0 is off.
// Generating, ω > ω_s: odd about O, M(2 ω_s − ω) = −M(ω). Plugging, ω < 0, and beyond 2 ω_s: constant, ±M_st.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivetrain/shared/torque_source.h"
#include "engine/numerics/curve.h"

namespace kurbel {

struct CataloguePoints {
  struct Point {
    double speed, torque;  // [rad/s], [N·m]
  };
  double starting_torque = 0;         // M_st [N·m], > 0
  std::optional<Point> pull_up = {};  // none: M rises from S to B
  Point breakdown{}, rated{};         // ascending in speed
  double synchronous_speed = 0;       // ω_s [rad/s]

  Curve curve() const;
};

inline Curve CataloguePoints::curve() const {
  // Up to the synchronous speed; the point below standstill makes the slope at S zero.
  std::vector<Point> half = {{-synchronous_speed, starting_torque}, {0, starting_torque}};
  if (pull_up) half.push_back(*pull_up);
  half.push_back(breakdown);
  half.push_back(rated);
  std::vector<double> speed, torque;
  for (const Point& p : half) {
    speed.push_back(p.speed);
    torque.push_back(p.torque);
  }
  speed.push_back(synchronous_speed);
  torque.push_back(0);
  for (auto p = half.rbegin(); p != half.rend(); ++p) {
    speed.push_back(2 * synchronous_speed - p->speed);
    torque.push_back(-p->torque);
  }
  for (std::size_t i = 1; i < speed.size(); ++i)
    if (!(speed[i] > speed[i - 1]))  // no jump is meant
      throw std::invalid_argument("the first column must ascend; row " + std::to_string(i + 1) + " does not");
  return Curve(speed, torque, Curve::Form::smooth);
}

struct CatalogueMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true, .guards = 2};
  static constexpr int pieces = 16;  // maximum number of pieces in a mode
  Curve curve;                       // [rad/s] → [N·m]
  double synchronous_speed = 0;      // ω_s [rad/s]
  double rated_torque = 0;           // M_n [N·m]
  double breakdown_speed = 0;        // [rad/s]

  template <class T>
  T torque_in(int piece, const T& speed) const {
    return curve.value_in(piece - 1, speed);
  }
  int piece_at(double speed) const { return curve.piece(speed) + 1; }
  void guard_piece(int piece, double speed, double* g) const {
    PieceGuard::guard(curve, piece - 1, speed, synchronous_speed, g);
  }
  int next_piece(int piece, int which) const { return PieceGuard::next(curve, piece - 1, which) + 1; }

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return sense(x) * x.command * x.command * torque_in(x.mode, sense(x) * x.rate);
  }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {rated_torque, synchronous_speed}; }
  void guard(const ShaftState<double>& x, double* g) const { guard_piece(x.mode, sense(x) * x.rate, g); }
  int first_mode(const ShaftState<double>& x) const { return piece_at(sense(x) * x.rate); }
  int next_mode(const ShaftState<double>& x, int which) const { return next_piece(x.mode, which); }
  std::string mode_name(int) const { return {}; }  // passing a point of the table is not reported

 private:
  template <class T>
  static double sense(const ShaftState<T>& x) {
    return x.command < 0 ? -1 : 1;
  }
};

}  // namespace kurbel
