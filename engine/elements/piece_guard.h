// piece_guard.h — which piece of a curve is in force, as guards and modes: for laws given by points.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/numerics/curve.h"

namespace kurbel {

// Guards of a law given by a curve over a quantity q: positive while q lies in the piece that is the mode.
struct PieceGuard {
  // q brought near the piece by whole periods.
  static double near_piece(const Curve& curve, int piece, double q) {
    if (curve.period() == 0) return q;
    const double middle = 0.5 * (curve.piece_begin(piece) + curve.piece_end(piece));
    return q - curve.period() * std::round((q - middle) / curve.period());
  }
  static void guard(const Curve& curve, int piece, double q, double scale, double* g) {
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

}  // namespace kurbel
