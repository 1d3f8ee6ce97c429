// influence.cpp — Sobol indices from given data and from Saltelli's design.
#include "studies/sweep/influence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace kurbel {
namespace {

constexpr int resamples = 400;
constexpr std::size_t fewest_rows = 8, most_bins = 40;

struct Moments {
  double mean = 0, variance = 0;
};
Moments moments_of(const std::vector<double>& y) {
  Moments m;
  for (const double v : y) m.mean += v / static_cast<double>(y.size());
  for (const double v : y) m.variance += (v - m.mean) * (v - m.mean) / static_cast<double>(y.size());
  return m;
}

// The same random numbers each time: a report is a function of its file.
class Draws {
 public:
  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(((state_ >> 32) * static_cast<std::uint64_t>(n)) >> 32);
  }

 private:
  std::uint64_t state_ = 20260101;
};

// 95 % interval of the bootstrap's values about the estimate.
template <class Estimate>
Index with_interval(std::size_t items, const Estimate& estimate) {
  std::vector<std::size_t> all(items), drawn(items);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const double value = estimate(all);
  Draws draws;
  std::vector<double> values;
  for (int b = 0; b < resamples; ++b) {
    for (std::size_t& d : drawn) d = draws.below(items);
    if (const double v = estimate(drawn); std::isfinite(v)) values.push_back(v);
  }
  if (values.empty()) return {value, value, value};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {value, at(0.025), at(0.975)};
}

// --- given data ---

// A parameter's values in ascending order, or bins of them.
struct Levels {
  std::vector<std::size_t> of;  // of each row
  std::size_t count = 0;
};
Levels levels_of(const std::vector<double>& x) {
  const std::vector<double> values = distinct(x);
  Levels levels{.of = {}, .count = values.size()};
  for (const double value : x) levels.of.push_back(place_in(values, value));
  return levels;
}

std::vector<double> column_of(const std::vector<const SweepRow*>& rows, std::size_t parameter) {
  std::vector<double> x;
  for (const SweepRow* r : rows) x.push_back(r->parameters[parameter]);
  return x;
}

// Bins of x: its values, if there are few; else bins with equal numbers of rows.
Levels bins_of(const std::vector<double>& x, const Levels& values) {
  const auto wanted =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::cbrt(static_cast<double>(x.size())) * 1.5), 2, most_bins);
  if (values.count <= wanted || values.count * 2 <= x.size()) return values;
  Levels bins{.of = std::vector<std::size_t>(x.size()), .count = wanted};
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  for (std::size_t r = 0; r < order.size(); ++r) bins.of[order[r]] = r * bins.count / order.size();
  return bins;
}

double first_order(const std::vector<std::size_t>& bins, std::size_t count, const std::vector<double>& y,
                   const std::vector<std::size_t>& rows) {
  std::vector<double> sum(count, 0.0), number(count, 0.0);
  double mean = 0;
  for (const std::size_t i : rows)
    sum[bins[i]] += y[i], number[bins[i]] += 1, mean += y[i] / static_cast<double>(rows.size());
  double between = 0, total = 0, filled = 0;
  for (std::size_t b = 0; b < count; ++b)
    if (number[b] > 0) between += number[b] * std::pow(sum[b] / number[b] - mean, 2), filled += 1;
  for (const std::size_t i : rows) total += std::pow(y[i] - mean, 2);
  const auto n = static_cast<double>(rows.size());
  if (!(total > 0) || n <= filled) return total > 0 ? between / total : 0;
  // Scatter between the means by chance: (bins − 1) times that within a bin.
  const double within = (total - between) / (n - filled);
  return std::max(0.0, (between - (filled - 1) * within) / total);
}

// --- a complete table: each combination of values once ---

// Row i's place in the table without one parameter (which = none: in the whole table).
std::vector<std::size_t> places(const std::vector<Levels>& levels, std::size_t rows, std::size_t without) {
  std::vector<std::size_t> place(rows, 0);
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (k != without)
      for (std::size_t i = 0; i < rows; ++i) place[i] = place[i] * levels[k].count + levels[k].of[i];
  return place;
}

bool is_complete(const std::vector<Levels>& levels, std::size_t rows) {
  std::size_t cells = 1;
  for (const Levels& l : levels) {
    if (l.count > rows / cells) return false;
    cells *= l.count;
  }
  if (cells != rows) return false;
  std::vector<std::size_t> place = places(levels, rows, levels.size());
  std::sort(place.begin(), place.end());
  return std::adjacent_find(place.begin(), place.end()) == place.end();
}

double variance_of_means(const std::vector<std::size_t>& group, std::size_t count, const std::vector<double>& y,
                         double mean) {
  std::vector<double> sum(count, 0.0);
  const double each = static_cast<double>(y.size()) / static_cast<double>(count);
  for (std::size_t i = 0; i < y.size(); ++i) sum[group[i]] += y[i] / each;
  double variance = 0;
  for (const double m : sum) variance += (m - mean) * (m - mean) / static_cast<double>(count);
  return variance;
}

// Without random errors: the shares are those of the table itself.
void by_complete_table(FigureInfluence& found, const std::vector<Levels>& levels, const std::vector<double>& y,
                       const Moments& m) {
  const auto sure = [](double share) { return Index{share, share, share}; };
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels[k].count < 2) continue;
    const double alone = variance_of_means(levels[k].of, levels[k].count, y, m.mean) / m.variance;
    const double others =
        variance_of_means(places(levels, y.size(), k), y.size() / levels[k].count, y, m.mean) / m.variance;
    found.ranked.push_back({.parameter = k, .first = sure(alone), .total = sure(std::max(alone, 1 - others))});
  }
}

void by_given_data(FigureInfluence& found, const SweepIdentity& identity, const std::vector<SweepRow>& rows) {
  std::vector<double> y;
  std::vector<const SweepRow*> used;
  for (const SweepRow& r : rows)
    if (const double v = value_in(r, found.figure); std::isfinite(v)) y.push_back(v), used.push_back(&r);
  const Moments m = moments_of(y);
  found.rows = y.size(), found.mean = m.mean, found.deviation = std::sqrt(m.variance);
  if (y.size() < 2 || !(m.variance > 1e-24 * m.mean * m.mean)) return;
  std::vector<Levels> levels;
  for (std::size_t k = 0; k < identity.parameters.size(); ++k) levels.push_back(levels_of(column_of(used, k)));
  if (used.size() == rows.size() && is_complete(levels, used.size())) return by_complete_table(found, levels, y, m);
  if (y.size() < fewest_rows) return;
  for (std::size_t k = 0; k < identity.parameters.size(); ++k) {
    const Levels bins = bins_of(column_of(used, k), levels[k]);
    if (bins.count < 2) continue;
    const auto estimate = [&](const std::vector<std::size_t>& of) { return first_order(bins.of, bins.count, y, of); };
    found.ranked.push_back({.parameter = k, .first = with_interval(y.size(), estimate)});
  }
}

// --- Saltelli's design ---

// Rows A, A with each column from B, B of the complete groups.
std::vector<std::vector<double>> whole_groups(std::size_t figure, std::size_t parameters,
                                              const std::vector<SweepRow>& rows) {
  const std::size_t size = parameters + 2;
  std::vector<std::vector<double>> groups;
  std::vector<double> group(size);
  std::size_t filled = 0, current = std::numeric_limits<std::size_t>::max();
  for (const SweepRow& r : rows) {
    if (r.row / size != current) current = r.row / size, filled = 0;
    const double v = value_in(r, figure);
    if (!std::isfinite(v)) continue;
    group[r.row % size] = v;
    if (++filled == size) groups.push_back(group);
  }
  return groups;
}

void by_saltelli(FigureInfluence& found, const SweepIdentity& identity, const std::vector<SweepRow>& rows) {
  const std::size_t n = identity.parameters.size();
  std::vector<std::vector<double>> groups = whole_groups(found.figure, n, rows);
  found.rows = groups.size();
  std::vector<double> y;
  for (const auto& g : groups) y.push_back(g.front()), y.push_back(g.back());
  if (groups.size() < fewest_rows) return;
  const Moments m = moments_of(y);
  found.mean = m.mean, found.deviation = std::sqrt(m.variance);
  if (!(m.variance > 1e-24 * m.mean * m.mean)) return;
  // Centred, as the scatter of the first-order estimator depends on the mean.
  for (auto& g : groups)
    for (double& v : g) v -= m.mean;
  const auto variance = [&](const std::vector<std::size_t>& of) {
    double sum = 0, squares = 0;
    for (const std::size_t i : of)
      sum += groups[i].front() + groups[i].back(),
          squares += groups[i].front() * groups[i].front() + groups[i].back() * groups[i].back();
    const double count = 2 * static_cast<double>(of.size());
    return squares / count - sum * sum / count / count;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const auto first = [&](const std::vector<std::size_t>& of) {
      double sum = 0;
      for (const std::size_t i : of) sum += groups[i].back() * (groups[i][k + 1] - groups[i].front());
      return sum / static_cast<double>(of.size()) / variance(of);
    };
    const auto total = [&](const std::vector<std::size_t>& of) {
      double sum = 0;
      for (const std::size_t i : of) sum += std::pow(groups[i].front() - groups[i][k + 1], 2);
      return sum / (2 * static_cast<double>(of.size())) / variance(of);
    };
    found.ranked.push_back(
        {.parameter = k, .first = with_interval(groups.size(), first), .total = with_interval(groups.size(), total)});
  }
}

}  // namespace

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}
std::size_t place_in(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

FigureInfluence influence_on(std::size_t figure, const SweepIdentity& identity, const std::vector<SweepRow>& rows,
                             bool saltelli) {
  FigureInfluence found{.figure = figure};
  if (saltelli)
    by_saltelli(found, identity, rows);
  else
    by_given_data(found, identity, rows);
  const auto weight = [](const Influence& i) { return i.total ? i.total->value : i.first.value; };
  std::stable_sort(found.ranked.begin(), found.ranked.end(),
                   [&](const Influence& a, const Influence& b) { return weight(a) > weight(b); });
  return found;
}

}  // namespace kurbel
