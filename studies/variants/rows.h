// rows.h — a matrix of variants: in each row the values of a variant, its state, and its figures with errors.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"

namespace kurbel {

struct SweptFigure {
  std::string name, unit;
};

struct RowFigure : Estimate {
  std::size_t figure = 0;  // its index
};

enum class RowState { done, unconfirmed, failed };
inline std::string name_of(RowState state) {
  return state == RowState::done ? "done" : state == RowState::unconfirmed ? "unconfirmed" : "failed";
}

struct SweepRow {
  std::size_t row = 0;
  RowState state = RowState::done;
  double seconds = 0;  // processor time
  std::string diagnosis = {};
  std::vector<double> parameters = {};
  std::vector<RowFigure> figures = {};
};

// Fills a row with given parameters: state, diagnosis, figures. False if it was interrupted.
using Evaluator = std::function<bool(SweepRow& row)>;

// The figure in a row; NaN without an error if the row has none.
inline Estimate figure_in(const SweepRow& row, std::size_t figure) {
  for (const RowFigure& f : row.figures)
    if (f.figure == figure) return f;
  return {std::numeric_limits<double>::quiet_NaN()};
}
inline double value_in(const SweepRow& row, std::size_t figure) { return figure_in(row, figure).value; }

}  // namespace kurbel
