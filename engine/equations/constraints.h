// constraints.h — speeds that move together: locked clutches, held brakes, relations of gears, as rows G ω = 0.
//
//     I α = M + T λ,   G α = 0
// One row takes one degree of freedom out. λ is the torque that the row transmits. T = −Gᵀ, but for gears with losses.
//
// Every motion that the rows allow is α = Z α_i by some shafts' own accelerations, and a combination Yᵀ of the
// equations of motion is free of λ, Yᵀ T = 0 (Y = Z without losses):
//     (Yᵀ I Z) α_i = Yᵀ M,   then λ from the other equations.
// Which shafts follow and which lead is chosen by inertia: the light follow, the heavy lead. Then the numbers in
// I^½ Z I_i^-½ are of order one, and nothing is lost to round-off however far the inertias lie apart, down to none at
// all. (G I⁻¹ T, which eliminates α first, loses what ties a light shaft to two heavy ones.)
// - Whether a row says something new is the rank of G alone (elimination.h), whatever the inertias.
// - Whether there is an answer is the determinant of Yᵀ I Z: with losses the allowed motions and what the torques leave
//   free may part, and the gear locks itself.
// - Where rows say the same twice (two brakes on one coordinate) each carries its share in proportion to its capacity:
//   of all λ, the one of least Σ λ²/capacity.
// Both rows of every answer are checked.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

struct ConstraintRow {
  std::vector<ShaftGain> motion;  // G: Σ gain ω = 0
  std::vector<ShaftGain> torque;  // T: what λ = 1 does to the shafts
  double capacity = 1;            // [N·m], > 0
  bool operator==(const ConstraintRow&) const = default;
};

class Constraints {
 public:
  // Shafts from free_shafts on are prescribed: their accelerations are given.
  explicit Constraints(std::size_t free_shafts = 0);
  Constraints(const Constraints&);
  Constraints& operator=(const Constraints&);
  Constraints(Constraints&&) noexcept;
  Constraints& operator=(Constraints&&) noexcept;
  ~Constraints();
  // From now on these; the same ones again cost nothing.
  void set(const std::vector<ConstraintRow>& rows);
  bool empty() const;
  bool repeats() const;  // some rows say what others say, as the last solve found

  // Accelerations of the free shafts from the torques on them, and the rows' multipliers. In: alpha of prescribed
  // shafts. Shafts in no row are solved as well; others may be without inertia where the rows fix their motion.
  void solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
             std::span<double> multiplier);
  // Why the last solve has no answer, and the row that is to blame.
  struct Trouble {
    enum class Cause {
      locked,        // no torques with these losses go with the motion that the rows allow
      contradicted,  // the motion that is prescribed is not one that the rows allow
      lost           // round-off took the answer
    };
    Cause cause = Cause::lost;
    std::size_t row = 0;
  };
  const std::optional<Trouble>& trouble() const;

  // The speeds nearest to the given ones, by kinetic energy, that obey the rows.
  void project(std::span<const double> inertia, std::span<double> speed);
  // ∂α/∂M over these free shafts, by rows: Z (Yᵀ I Z)⁻¹ Yᵀ.
  std::vector<double> mobility(std::span<const double> inertia, std::span<const int> shafts);
  // What one unit of a torque, as it acts on the shafts, adds to Σ gain α.
  double mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                  std::span<const ShaftGain> torque);

 private:
  class System;
  std::unique_ptr<System> system_;
};

}  // namespace kurbel
