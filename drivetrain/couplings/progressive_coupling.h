// progressive_coupling.h — coupling with a tabulated torque over twist, and a damper.
//     τ = M(θ) + c θ̇,   E = ∫ M dθ from 0 to θ                                           (theory 5.8)
// M(0) = 0, M rises strictly; linear between the points, a monotone cubic or a formula (curve.h). If only points θ ≥ 0 are
// given, M(−θ) = −M(θ). Beyond the last point M is continued linearly. The pieces are modes: passing a point is an event.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "drivetrain/couplings/coupling.h"
#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

class ProgressiveCoupling {
 public:
  static constexpr int regularised = -1;  // mode: no piece begins before the first point
  static constexpr ConnectionTraits is{.guards = 2, .regularised_mode = regularised, .described = true};

  ProgressiveCoupling() = default;
  // Torques in N·m over twists in rad, with the damping c [N·m·s/rad]. Throws std::invalid_argument with a message.
  ProgressiveCoupling(const std::vector<double>& twist, const std::vector<double>& torque, Curve::Form form,
                      double damping = 0);

  explicit ProgressiveCoupling(const Curve& formula);

  template <class T>
  T torque(const Twist<T>& x) const {
    const int piece = x.mode == regularised ? piece_at(value_of(x.angle)) : x.mode;
    return curve_.value_in(piece, x.angle) + damping_ * x.rate;
  }
  double spring_torque(double twist) const { return curve_.value_in(piece_at(twist), twist); }
  double energy(double twist) const;
  double twist_at(double torque) const;
  double stiffness_at_rest() const { return rest_stiffness_; }  // mean of the slopes on either side of θ = 0
  double damping() const { return damping_; }
  void set_damping(double damping) { damping_ = damping; }

  int first_mode(const Twist<double>& x) const {
    const int piece = piece_at(x.angle);
    return x.rate < 0 && x.angle == curve_.piece_begin(piece) && piece > 0 ? piece - 1 : piece;
  }
  void guard(const Twist<double>& x, double* g) const {
    g[0] = (curve_.piece_end(x.mode) - x.angle) / twist_scale_;
    g[1] = (x.angle - curve_.piece_begin(x.mode)) / twist_scale_;
  }
  int next_mode(const Twist<double>& x, int which) const {
    const int last = static_cast<int>(curve_.x().size()) - 2;
    return std::clamp(x.mode + (which == 0 ? 1 : -1), 0, last);
  }
  std::string mode_name(int) const { return {}; }
  std::string describe() const;

 private:
  int piece_at(double twist) const {
    return std::clamp(curve_.piece(twist), 0, static_cast<int>(curve_.x().size()) - 2);
  }
  void sum_up();  // energies at the points, stiffness at rest

  Curve curve_;
  std::vector<double> energy_;  // at the points [J]
  double damping_ = 0, rest_stiffness_ = 0;
  double twist_scale_ = 1;                     // of the points [rad]
  double given_twist_ = 0, given_torque_ = 0;  // last point, for describe()
};

// Data of a data sheet; relative damping refers to the stiffness at rest.
struct ProgressiveCouplingData {
  using Element = ProgressiveCoupling;
  ProgressiveCoupling spring;
  Damping given;

  bool damping_hangs_on_inertia() const { return given.hangs_on_inertia(); }
  ProgressiveCoupling settled(double inertia) const {
    ProgressiveCoupling element = spring;
    element.set_damping(CouplingData{spring.stiffness_at_rest(), given}.settled(inertia).damping);
    return element;
  }
};

}  // namespace kurbel
