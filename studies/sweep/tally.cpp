// tally.cpp — statistics over all rows of a sweep, in one pass without storing them.

#include <algorithm>
#include <map>

#include "engine/base/find_by.h"
#include "studies/sweep/sweep_findings.h"

namespace kurbel {
namespace {

// Reasons that differ only in numbers are the same.
std::string reason_of(const std::string& diagnosis) {
  std::string reason;
  for (std::size_t i = 0; i < diagnosis.size(); ++i) {
    const bool number = (diagnosis[i] >= '0' && diagnosis[i] <= '9');
    if (!number)
      reason += diagnosis[i];
    else if (!reason.ends_with("#"))
      reason += '#';
    while (number && i + 1 < diagnosis.size() &&
           std::string("0123456789.e-+").find(diagnosis[i + 1]) != std::string::npos)
      ++i;
  }
  return reason;
}

void take_up(Spread& spread, const SweepRow& row, std::size_t figure) {
  const double v = value_in(row, figure);
  if (!std::isfinite(v)) return;
  ++spread.rows;
  const double before = v - spread.mean;
  spread.mean += before / static_cast<double>(spread.rows);
  spread.deviation += before * (v - spread.mean);  // a sum of squares as yet (Welford)
  spread.least = std::min(spread.least, v), spread.greatest = std::max(spread.greatest, v);
  if (const auto error = figure_in(row, figure).error) spread.error = std::max(spread.error.value_or(0), *error);
}

void end(Spread& spread) {
  spread.deviation = spread.rows > 1 ? std::sqrt(spread.deviation / static_cast<double>(spread.rows - 1)) : 0;
  if (spread.rows == 0) spread.least = spread.mean = spread.greatest = std::nan("");
}

// For points that are not random no interval is given.
void end(LimitCount& c, const SweepIdentity& identity) {
  const std::string design = identity.reported("design");
  c.interval = {std::nan(""), std::nan("")};
  if (design.starts_with("random") || design.starts_with("lhs") || is_shifted_sobol(identity)) c.end(c.decided());
}

// The worst rows of a figure: by its limit; without limit the greatest values.
class WorstRows {
 public:
  WorstRows(std::size_t figure, const SweepIdentity& identity, const std::vector<FigureLimit>& limits)
      : figure_(figure) {
    const auto* const limit = find_by(limits, &FigureLimit::figure, figure);
    few_ = !limits.empty() && !limit ? 0 : identity.figures.size() > 4 ? 1 : 3;
    sign_ = limit && !limit->from_above ? -1 : 1;
  }
  void take_up(const SweepRow& row) {
    if (few_ == 0 || !std::isfinite(value_in(row, figure_))) return;
    if (rows_.size() == few_ && !is_worse(row, rows_.back())) return;
    const auto place = std::find_if(rows_.begin(), rows_.end(), [&](const SweepRow& r) { return is_worse(row, r); });
    rows_.insert(place, row);
    if (rows_.size() > few_) rows_.pop_back();
  }
  std::vector<SweepRow>& rows() { return rows_; }

 private:
  // Of equal ones the earlier row.
  bool is_worse(const SweepRow& a, const SweepRow& b) const {
    return sign_ * value_in(a, figure_) > sign_ * value_in(b, figure_);
  }

  std::size_t figure_, few_ = 0;
  double sign_ = 1;
  std::vector<SweepRow> rows_;
};

}  // namespace

bool is_shifted_sobol(const SweepIdentity& identity) {
  return identity.reported("design").starts_with("sobol") && identity.reported("seed") != "0";
}

SweepTally tally_of(const SweepStore& store, const std::vector<FigureLimit>& limits) {
  const SweepIdentity& identity = store.identity();
  SweepTally t;
  std::vector<WorstRows> worst;
  std::map<std::string, Failures> by_reason;
  for (std::size_t k = 0; k < identity.figures.size(); ++k)
    t.spreads.push_back({.figure = identity.figures[k]}), worst.emplace_back(k, identity, limits);
  for (const FigureLimit& limit : limits) t.limits.push_back({.limit = limit.given});
  store.each([&](SweepRow&& row) {
    if (t.rows++ % rows_in_table == 0) t.pieces.push_back(row.row);
    ++(row.state == RowState::done ? t.done : row.state == RowState::failed ? t.failed : t.unconfirmed);
    for (std::size_t k = 0; k < t.spreads.size(); ++k) take_up(t.spreads[k], row, k), worst[k].take_up(row);
    for (std::size_t k = 0; k < limits.size(); ++k) t.limits[k].take_up(side_of(limits[k], row));
    if (row.state == RowState::done) return;
    Failures& f = by_reason[name_of(row.state) + reason_of(row.diagnosis)];
    if (f.count++ == 0) f.first = std::move(row);
  });
  for (Spread& spread : t.spreads) end(spread);
  for (LimitCount& count : t.limits) end(count, identity);
  for (auto& [reason, f] : by_reason) t.failures.push_back(std::move(f));
  std::stable_sort(t.failures.begin(), t.failures.end(),
                   [](const Failures& a, const Failures& b) { return a.count > b.count; });
  for (WorstRows& w : worst) t.worst.push_back(std::move(w.rows()));
  return t;
}

}  // namespace kurbel
