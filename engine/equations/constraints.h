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

#include <Eigen/Dense>
#include <cstddef>
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
  // From now on these; the same ones again cost nothing.
  void set(const std::vector<ConstraintRow>& rows);
  bool empty() const { return rows_.empty(); }
  bool repeats() const { return !repeating_.empty(); }  // some rows say what others say, as the last solve found

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
  const std::optional<Trouble>& trouble() const { return trouble_; }

  // The speeds nearest to the given ones, by kinetic energy, that obey the rows.
  void project(std::span<const double> inertia, std::span<double> speed);
  // ∂α/∂M over these free shafts: Z (Yᵀ I Z)⁻¹ Yᵀ.
  Eigen::MatrixXd mobility(std::span<const double> inertia, std::span<const int> shafts);
  // What one unit of a torque, as it acts on the shafts, adds to Σ gain α.
  double mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                  std::span<const ShaftGain> torque);

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void list_shafts();
  void factorise(std::span<const double> inertia);
  Eigen::VectorXd shaft_weights() const;
  void choose_leaders();
  void find_torque_space();
  bool reduce(const Matrix& left, const std::vector<std::size_t>& unit, Matrix& inverse) const;
  void respond_to_repeating();
  void share();
  void accelerate(const double* torque, const double* shift, double* alpha, double* lambda);
  bool is_kept(std::span<const double> alpha, std::span<const double> multiplier);
  void look_for_trouble(std::span<const double> alpha, std::span<const double> multiplier);
  bool is_lossy() const;
  std::size_t lossiest() const;

  std::size_t free_;
  std::vector<ConstraintRow> rows_;
  std::vector<int> tied_, given_, loose_;  // free shafts in rows, prescribed ones in rows, the other free ones
  std::vector<int> place_;                 // of every shaft in its list
  Matrix motion_, torque_;                 // G over the tied, then the given shafts; −T over the tied ones; by rows
  std::vector<double> lossy_, strength_;   // per row: how far T is from −Gᵀ; capacity as a torque on its shafts

  // By the magnitudes of the inertias. Places among the tied shafts:
  std::vector<int> magnitude_;                  // of each inertia, in steps of 2⁸
  std::vector<std::size_t> basic_, repeating_;  // rows that say something new, and the others
  std::vector<std::size_t> follow_, lead_;      // shafts, in the rows' motion
  std::vector<std::size_t> bear_, free_of_;     // equations of motion that give λ, and the others: Yᵀ's unit part
  Matrix allowed_, torque_free_;                // Z, Y: by tied shafts
  Matrix by_given_;                             // what accelerations of the given shafts add to α
  Matrix follow_inverse_, bear_inverse_;  // G⁻¹ and (−T)⁻¹ of basic rows and those shafts: by shafts, basic rows

  // By the inertias:
  std::vector<double> inertia_;  // of the tied shafts; empty: unknown
  Matrix reduced_inverse_;       // (Yᵀ I Z)⁻¹
  bool locked_ = false;          // there is none
  // λ of the repeating rows from that of the basic ones without them; what their λ = 1 then does to basic λ and to α.
  Matrix shares_, share_multiplier_, share_alpha_;

  std::optional<Trouble> trouble_;
  std::vector<double> tied_torque_, alpha_, lambda_, shift_, right_, rest_, size_;  // working arrays
};

}  // namespace kurbel
