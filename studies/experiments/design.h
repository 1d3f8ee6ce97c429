// design.h — the variants of a sweep: the values of row i depend on i (and the seed) only, so that shards, threads
// and resumed sweeps compute the same rows.
//
//   grid:21x3      every combination; the last parameter changes fastest
//   sobol:4096     points of low discrepancy (Sobol; Joe and Kuo 2008), shifted by the seed
//   lhs:500        Latin hypercube: one point in each of 500 equal parts of every range (McKay, Beckman, Conover 1979)
//   random:500     independent points
//   saltelli:1024  N (k + 2) rows for Sobol indices: A, A with each column from B, B (Saltelli et al. 2010)
#pragma once

#include <boost/random/sobol.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "studies/experiments/parameter.h"

namespace kurbel {

class Design {
 public:
  enum class Kind { grid, sobol, lhs, random, saltelli, variants };

  // Throws std::invalid_argument with the reason. "grid" without steps is for lists only.
  Design(const std::string& text, std::vector<SweptParameter> parameters, std::uint64_t seed);
  explicit Design(VariantTable table);

  Kind kind() const { return kind_; }
  const std::string& text() const { return text_; }
  std::size_t rows() const { return rows_; }
  const std::vector<SweptParameter>& parameters() const { return parameters_; }
  // For saltelli N, otherwise the number of rows.
  std::size_t base() const { return base_; }
  // In the parameters' units.
  std::vector<double> row(std::size_t i) const;

 private:
  void read_grid(const std::string& steps);
  void make_permutations();
  std::vector<double> shares(std::size_t i) const;
  std::vector<double> sobol_point(std::size_t i) const;

  std::string text_;
  Kind kind_ = Kind::grid;
  std::vector<SweptParameter> parameters_;
  std::uint64_t seed_ = 0;
  std::size_t rows_ = 0, base_ = 0;
  std::vector<std::size_t> steps_;                       // of a grid
  std::vector<std::vector<std::uint32_t>> permutation_;  // of a Latin hypercube, per parameter
  std::vector<std::vector<double>> table_;               // of variants
  boost::random::sobol sobol_{1};
};

}  // namespace kurbel
