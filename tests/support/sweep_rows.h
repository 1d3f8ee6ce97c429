// sweep_rows.h — all rows of a sweep's file.
#pragma once

#include <utility>
#include <vector>

#include "studies/sweep/store.h"

namespace kurbel::test {

inline std::vector<SweepRow> rows_of(const SweepStore& store) {
  std::vector<SweepRow> rows;
  store.each([&](SweepRow&& row) { rows.push_back(std::move(row)); });
  return rows;
}

}  // namespace kurbel::test
