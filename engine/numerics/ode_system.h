// ode_system.h — the system to be integrated, y' = f(t, y) with its sparse Jacobian, and the error control.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kurbel {

// Compressed-column pattern of a square sparse matrix. All diagonal entries are stored, including zeros (needed by KLU).
struct SparsityPattern {
  std::size_t size = 0;
  std::vector<std::int64_t> column_start;  // size + 1 entries
  std::vector<std::int64_t> row;           // row of each stored entry, ascending within a column
};

// y' = f(t, y), with its exact sparse Jacobian ∂f/∂y.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  virtual std::size_t size() const = 0;
  virtual void flow(double t, std::span<const double> y, std::span<double> ydot) = 0;
  virtual const SparsityPattern& jacobian_pattern() = 0;
  virtual void jacobian(double t, std::span<const double> y, std::span<double> values) = 0;
};

// Local error control in the maximum norm: a step is accepted when |error_i| ≤ tolerance · scale_i for every i.
// A scale of 0 excludes a state from the control (quadratures). The maximum norm detects one active state among 10⁵ at
// rest.
struct ErrorControl {
  double tolerance = 1e-8;
  std::vector<double> scale;  // per state, in the state's own unit, ≥ 0
};

}  // namespace kurbel
