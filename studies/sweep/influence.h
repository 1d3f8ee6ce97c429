// influence.h — which parameter moves a figure: Sobol's indices of a sweep's rows.
//
//     S_i  = V(E[y | x_i]) / V(y)          first order: what knowing x_i alone would take off the variance
//     S_Ti = E[V(y | x_~i)] / V(y)         total: with all interactions that x_i has a part in
//
// Of a complete table (a grid of which every row has the figure) both are sums over the table, without any interval. From
// any other design by given data: rows are put into bins of x_i; what lies between the bins' means beyond what their
// scatter gives by chance is S_i (analysis of variance, ω²; Plischke, Borgonovo, Smith 2013). From saltelli by the
// estimators of Saltelli et al. 2010 (first) and Jansen 1999 (total); 95 % intervals by the bootstrap over its groups.
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
  std::optional<Index> total = {};  // of saltelli and of complete tables
};

struct FigureInfluence {
  std::size_t figure = 0;
  std::size_t rows = 0;  // that have it; of saltelli: whole groups
  double mean = 0, deviation = 0;
  std::vector<Influence> ranked = {};  // the greatest first; none: it does not vary, or too few rows
};

// `saltelli`: rows are of that design.
FigureInfluence influence_on(std::size_t figure, const SweepIdentity& identity, const std::vector<SweepRow>& rows,
                             bool saltelli);

// Each value once, from the least on; and the place of one among them.
std::vector<double> distinct(std::vector<double> values);
std::size_t place_in(const std::vector<double>& sorted, double value);

}  // namespace kurbel
