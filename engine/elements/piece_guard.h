// piece_guard.h — guards and modes for the active piece of a curve: for laws given by points.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/numerics/curve.h"

namespace kurbel {

// Guards of a law given by a curve over a quantity q: positive while q lies in the piece given by the mode.
//
// The modes of a periodic law number the pieces of all its periods that are distinguished (Curve::over_angle).
struct PieceGuard {
  struct Place {
    int piece;  // of the curve
    double x;   // q shifted by whole periods to lie near the piece
  };
  static Place place(const Curve& curve, int mode, double q) {
    if (curve.period() == 0) return {mode, q};
    const int period = mode / curve.pieces(), piece = mode - period * curve.pieces();
    const double span = curve.periods() * curve.period(), x = q - period * curve.period();
    const double middle = 0.5 * (curve.piece_begin(piece) + curve.piece_end(piece));
    return {piece, x - span * std::round((x - middle) / span)};
  }
  template <class T>
  static T value(const Curve& curve, int mode, const T& q) {
    using kurbel::value_of;
    const Place at = place(curve, mode, value_of(q));
    return curve.value_in(at.piece, q + (at.x - value_of(q)));
  }
  static void guard(const Curve& curve, int mode, double q, double scale, double* g) {
    g[0] = g[1] = 1;
    if (curve.is_seamless()) return;
    // A mode of another curve, or of a state that was tampered with.
    if (curve.period() > 0 && (mode < 0 || mode >= modes(curve))) {
      g[0] = g[1] = -1;
      return;
    }
    const Place at = place(curve, mode, q);
    g[0] = std::min(1.0, (at.x - curve.piece_begin(at.piece)) / scale);
    g[1] = std::min(1.0, (curve.piece_end(at.piece) - at.x) / scale);
  }
  static int next(const Curve& curve, int mode, int which) {
    const int moved = which == 0 ? mode - 1 : mode + 1;
    if (curve.period() > 0) return (moved + modes(curve)) % modes(curve);
    return std::clamp(moved, -1, curve.pieces());
  }
  static int first(const Curve& curve, double q) {
    if (curve.period() == 0) return curve.piece(q);
    const auto period = static_cast<int>(std::lround((q - curve.within(q)) / curve.period()) % curve.periods());
    return curve.piece(q) + curve.pieces() * (period < 0 ? period + curve.periods() : period);
  }

 private:
  static int modes(const Curve& curve) { return curve.periods() * curve.pieces(); }
};

// The same for a law over time, whose edges are known beforehand.
struct TimedPiece {
  // A time so close before a knot counts as on it, because of rounding in k · period.
  static double slack(const Curve& curve, double t) {
    return 1e-12 * (curve.x().back() - curve.x().front()) + 1e-15 * std::abs(t);
  }
  static int at(const Curve& curve, double t) { return curve.piece(t + slack(curve, t)); }
  static double next_edge(const Curve& curve, double t) {
    const double here = t + slack(curve, t), past = here - curve.within(here);  // whole periods
    return past + curve.piece_end(at(curve, t));
  }
  // t shifted near the active piece, so that there is no jump at the end of a period within a step.
  static double near(const Curve& curve, int piece, double t) {
    if (curve.period() == 0) return t;
    const double middle = 0.5 * (curve.piece_begin(piece) + curve.piece_end(piece));
    return t - curve.period() * std::round((t - middle) / curve.period());
  }
  // Time from which the law is constant.
  static double settled_from(const Curve& curve) { return curve.period() > 0 ? -HUGE_VAL : curve.x().back(); }
};

}  // namespace kurbel
