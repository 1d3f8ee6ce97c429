// influence.h — influence of parameters on a figure: Sobol indices from the rows of a sweep.
//
//     S_i  = V(E[y | x_i]) / V(y)          first order: reduction of the variance if x_i alone were known
//     S_Ti = E[V(y | x_~i)] / V(y)         total: including all interactions of x_i
//
// For a complete table (a grid in which every row has the figure) both are sums over the table, without intervals. For
// other designs by given data: rows are sorted into bins of x_i; the variance between the bins' means, minus what their
// scatter gives by chance, is S_i (analysis of variance, ω²; Plischke, Borgonovo, Smith 2013). For saltelli by the
// estimators of Saltelli et al. 2010 (first) and Jansen 1999 (total); 95 % intervals by bootstrap over its groups.
#pragma once

#include <optional>
#include <vector>

#include "studies/sweep/store.h"

namespace kurbel {

struct Index {
  double value = 0, low = 0, high = 0;  // 95 %
};

struct Influence {
  std::size_t parameter = 0;
  Index first = {};
  std::optional<Index> total = {};  // for saltelli and complete tables
};

struct FigureInfluence {
  std::size_t figure = 0;
  std::size_t rows = 0;  // that have the figure; for saltelli: whole groups
  double mean = 0, deviation = 0;
  std::vector<Influence> ranked = {};  // the greatest first; empty: no variation, or too few rows
};

// `saltelli`: the rows have that design.
FigureInfluence influence_on(std::size_t figure, const SweepIdentity& identity, const std::vector<SweepRow>& rows,
                             bool saltelli);

// Sorted values without repetition; and the index of a value among them.
std::vector<double> distinct(std::vector<double> values);
std::size_t place_in(const std::vector<double>& sorted, double value);

}  // namespace kurbel
