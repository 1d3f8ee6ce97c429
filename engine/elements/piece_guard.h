// piece_guard.h — guards and modes for the active piece of a curve: for laws given by points.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/numerics/curve.h"

namespace kurbel {

// Guards of a law given by a curve over a quantity q: positive while q lies in the piece given by the mode.
struct PieceGuard {
  // q shifted by whole periods to lie near the piece.
  static double near_piece(const Curve& curve, int piece, double q) {
    if (curve.period() == 0) return q;
    const double middle = 0.5 * (curve.piece_begin(piece) + curve.piece_end(piece));
    return q - curve.period() * std::round((q - middle) / curve.period());
  }
  static void guard(const Curve& curve, int piece, double q, double scale, double* g) {
    // A piece of another curve, or of a state that was tampered with.
    if (curve.period() > 0 && (piece < 0 || piece + 1 >= static_cast<int>(curve.x().size()))) {
      g[0] = g[1] = -1;
      return;
    }
    const double x = near_piece(curve, piece, q);
    g[0] = std::min(1.0, (x - curve.piece_begin(piece)) / scale);
    g[1] = std::min(1.0, (curve.piece_end(piece) - x) / scale);
  }
  static int next(const Curve& curve, int piece, int which) {
    const int pieces = static_cast<int>(curve.x().size()) - 1;
    const int moved = which == 0 ? piece - 1 : piece + 1;
    if (curve.period() > 0) return (moved + pieces) % pieces;
    return std::clamp(moved, -1, pieces);
  }
  static int first(const Curve& curve, double q) { return curve.piece(q); }
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
  static double near(const Curve& curve, int piece, double t) { return PieceGuard::near_piece(curve, piece, t); }
  // Time from which the law is constant.
  static double settled_from(const Curve& curve) { return curve.period() > 0 ? -HUGE_VAL : curve.x().back(); }
};

}  // namespace kurbel
