// constraints.h — constraints on speeds: locked clutches, held brakes, relations of gears, as rows G ω = 0.
//
//     I α = M + T λ,   G α = 0
// A row removes one degree of freedom. λ is the torque transmitted by the row. T = −Gᵀ, except for gears with losses.
//
// All motions allowed by the rows are α = Z α_i with the accelerations α_i of some shafts, and a combination Yᵀ of the
// equations of motion is free of λ, Yᵀ T = 0 (Y = Z without losses):
//     (Yᵀ I Z) α_i = Yᵀ M,   then λ from the other equations.
// The shafts of α_i are those with large inertia; light shafts are dependent. The numbers in I^½ Z I_i^-½ are then of
// order one, and round-off is small for any ratio of the inertias, including zero inertia. (G I⁻¹ T, which eliminates α
// first, loses the constraint between a light shaft and two heavy ones.)
// - The independence of rows depends only on the rank of G (elimination.h), not on the inertias.
// - A solution exists if Yᵀ I Z is regular. With losses, Y ≠ Z, it may be singular: the gear is self-locking.
// - Redundant rows (two brakes on one coordinate) share λ in proportion to their capacities: of all λ the one with the
//   least Σ λ²/capacity.
// Both equations are checked for every solution.
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
  std::vector<ShaftGain> torque;  // T: torques on the shafts by λ = 1
  double capacity = 1;            // [N·m], > 0
  bool unlimited = false;         // a relation: counts in no sum over capacities of contacts
  bool operator==(const ConstraintRow&) const = default;
};

class Constraints {
 public:
  // Shafts from index free_shafts on are prescribed: their accelerations are given.
  explicit Constraints(std::size_t free_shafts = 0);
  Constraints(const Constraints&);
  Constraints& operator=(const Constraints&);
  Constraints(Constraints&&) noexcept;
  Constraints& operator=(Constraints&&) noexcept;
  ~Constraints();
  // Sets the rows; no cost if they are unchanged.
  void set(const std::vector<ConstraintRow>& rows);
  bool empty() const;
  bool repeats() const;  // some rows are redundant, by the last solve
  // Other capacities for the shares of redundant rows than those of the rows, until rows are set that differ.
  void share_by(const std::vector<double>& capacity);

  // Accelerations of the free shafts from the torques on them, and the multipliers of the rows. Input: alpha of prescribed
  // shafts. Shafts in no row are included; shafts in rows may have no inertia if the rows define their motion.
  void solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
             std::span<double> multiplier);
  // The reason why the last solve has no solution, and the row concerned.
  struct Trouble {
    enum class Cause {
      locked,        // no torques with these losses are compatible with the motion allowed by the rows
      contradicted,  // the prescribed motion violates the rows
      lost           // the solution is lost to round-off
    };
    Cause cause = Cause::lost;
    std::size_t row = 0;
  };
  const std::optional<Trouble>& trouble() const;

  // Projects the speeds onto the rows with the least change in the norm of kinetic energy.
  void project(std::span<const double> inertia, std::span<double> speed);
  // ∂α/∂M over these free shafts, by rows: Z (Yᵀ I Z)⁻¹ Yᵀ.
  std::vector<double> mobility(std::span<const double> inertia, std::span<const int> shafts);
  // Change of Σ gain α (motion) by a unit of a torque that acts on the shafts (torque).
  double mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                  std::span<const ShaftGain> torque);

 private:
  class System;
  std::unique_ptr<System> system_;
};

}  // namespace kurbel
