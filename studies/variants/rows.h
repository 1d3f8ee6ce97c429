// rows.h — a matrix of variants: in each row a variant's values, what became of it, and its figures with their errors.
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

struct RowFigure {
  std::size_t figure = 0;  // its number
  double value = 0;
  std::optional<double> error = {};
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

// Of a row with these values of the parameters: state, diagnosis, figures. A row that was interrupted returns false.
using Evaluator = std::function<bool(SweepRow& row)>;

// The figure in a row: not a number, without an error, where it has none.
inline Estimate figure_in(const SweepRow& row, std::size_t figure) {
  for (const RowFigure& f : row.figures)
    if (f.figure == figure) return {f.value, f.error};
  return {std::numeric_limits<double>::quiet_NaN()};
}
inline double value_in(const SweepRow& row, std::size_t figure) { return figure_in(row, figure).value; }
inline std::optional<double> error_in(const SweepRow& row, std::size_t figure) { return figure_in(row, figure).error; }

}  // namespace kurbel
