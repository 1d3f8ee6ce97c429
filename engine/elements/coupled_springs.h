// coupled_springs.h — connections in a row whose torques depend on the twists of all of them: the parts of a shaft that is
// one spectral element.
//     τ_k = Σ_l S_kl (θ_l + T θ̇_l),   E = ½ θᵀ S θ
// If all carry the same torque τ at rest, each acts as a separate spring: θ_k = τ/k_k.
#pragma once

#include <memory>
#include <vector>

#include "engine/elements/any_connection.h"

namespace kurbel {

// The law of a row; immutable.
struct SpringRow {
  int size = 1;
  std::vector<double> stiffness;   // S, by rows [N·m/rad]
  std::vector<double> compliance;  // S⁻¹ [rad/(N·m)]
  double retardation = 0;          // T = c/k [s]

  double spring_torque(int k, const double* twist) const { return row_of(stiffness, k, twist); }
  double twist_at(int k, const double* torque) const { return row_of(compliance, k, torque); }

 private:
  double row_of(const std::vector<double>& matrix, int k, const double* x) const {
    const double* row = matrix.data() + static_cast<std::ptrdiff_t>(k) * size;
    double sum = 0;
    for (int l = 0; l < size; ++l) sum += row[l] * x[l];
    return sum;
  }
};

// All rows of a model. The parts of a row are consecutive.
class SpringRowPool final : public ElementPool {
 public:
  void place(const std::shared_ptr<const SpringRow>& law, int part, const ConnectionPorts& ports);

  void add(const Instant& now, Sums& sums) const override;
  void register_jacobian(JacobianPattern& pattern) override;
  void add_jacobian(const Instant& now, const double* alpha, double* slots) const override;
  void add_torque_slopes(const Instant& now, std::vector<TorqueSlope>& slopes) const override;
  bool guards_are_of_angle() const override { return true; }
  double energy(const Instant& now) const override;

 private:
  struct Placed {
    std::shared_ptr<const SpringRow> law;
    std::vector<ConnectionPorts> at;  // of the parts
    std::vector<int> slots;           // per part k, per part l: of θ_l, ω_al, ω_bl in the row of a_k, then of b_k
  };
  // Calls do(part, θ, θ̇, torque of the spring, torque) for all parts.
  template <class Do>
  static void for_parts(const Placed& row, const Instant& now, Do&& action);

  std::vector<Placed> rows_;
};

// One part of a row, for a network. `whole`: the shaft as one spring between its ends; share[k]: the part of its compliance
// in part k; stiffness, compliance: the matrices for a whole of 1 N·m/rad.
ConnectionForm spring_row_part(ConnectionForm whole, int part, std::vector<double> share, std::vector<double> stiffness,
                               std::vector<double> compliance);

}  // namespace kurbel
