// growth_bench.cpp — how does the cost of a step grow with the number of inertias, and does the error stay?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/benches.h"
#include "bench/machines.h"

namespace kurbel::bench {
namespace {

// The wave from the first inertia passes 632 of them in 0.2 s: the first 900 move alike in every longer chain.
constexpr std::size_t moving = 900;

struct Grown {
  int size;
  double per_step, steps;
  std::vector<double> speeds;  // of the moving ones

  double error(const Grown& reference) const {
    double largest = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
      largest = std::max(largest, std::abs(speeds[i] - reference.speeds[i]));
    return largest;
  }
};

Grown grown(int n, const std::string& method, double tolerance, double until = 0.2) {
  const auto model = equal_chain(n, false, until);
  const TimedRun t = timed(n >= 100000 ? 1 : n >= 10000 ? 3 : 5, [&] { return bare_run(model, tolerance, method); });
  const double steps = static_cast<double>(t.outcome.statistics.stepper.steps);
  const auto first = t.outcome.state.begin() + n;  // an angle and n − 1 twists come before the speeds
  const std::size_t count = std::min(moving, static_cast<std::size_t>(n));
  return {n, t.median_seconds / steps, steps, {first, first + static_cast<std::ptrdiff_t>(count)}};
}

// Least squares of log(time per step) over log N.
double exponent(const std::vector<Grown>& of) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Grown& g : of) {
    const double x = std::log(g.size), y = std::log(g.per_step);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double n = static_cast<double>(of.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

// E2: N equal inertias for 0.2 s.
void growth_with_size(BenchBook& book) {
  Table table{.title = "E2: cost of a step, chains of N equal inertias",
              .columns = {"method", "N", "steps", "per step and inertia [ns]", "largest error of a speed [rad/s]"},
              .rows = {}};
  Plot plot{.title = "Cost of a step over the number of inertias",
            .x = {"inertias", "", true},
            .y = {"time of a step", "ms", true},
            .series = {}};
  const double tolerance = 1e-5;
  const Grown reference = grown(1000, "dop853", 1e-12);
  std::size_t colour = 0;
  for (const char* method : {"dopri5", "verner6", "dop853", "esdirk", "bdf"}) {
    std::vector<Grown> all;
    const bool implicit = std::string(method) == "esdirk" || std::string(method) == "bdf";
    for (const int n : {100, 1000, 10000, 100000}) {
      // A step of an implicit method is known after a few hundred of them.
      const double until = !implicit || n <= 1000 ? 0.2 : 200.0 / n;
      all.push_back(grown(n, method, tolerance, until));
      const Grown& g = all.back();
      table.rows.push_back({method, fmt::format("{}", n), fmt::format("{:.0f}", g.steps),
                            fmt::format("{:.1f}", 1e9 * g.per_step / n),
                            n >= 1000 && until == 0.2 ? fmt::format("{:.1e}", g.error(reference)) : ""});
    }
    Series series{.name = method, .role = further_role(colour++), .x = {}, .y = {}, .points = true};
    for (const Grown& g : all) {
      series.x.push_back(g.size);
      series.y.push_back(1e3 * g.per_step);
    }
    plot.series.push_back(std::move(series));
    const double p = exponent(all), first = all[1].error(reference), last = all[3].error(reference);
    if (std::string(method) == "dopri5")
      book.target("E2, N = 1e5, per step and inertia, 7 stages", "≤ 40 ns",
                  fmt::format("{:.0f} ns", 1e9 * all[3].per_step / 1e5), all[3].per_step <= 40e-9 * 1e5);
    if (implicit)
      book.target(fmt::format("E2, {}: exponent of the time of a step over N", method), "≤ 1.1",
                  fmt::format("{:.2f}", p), p <= 1.1);
    if (!implicit)
      book.target(fmt::format("E2, {}: error at N = 1e5 against N = 1e3, tolerance {:.0e}", method, tolerance), "≤ 2 ×",
                  fmt::format("{:.2g} ×", last / first), last <= 2 * first);
  }
  book.tables.push_back(table);
  book.plots.push_back(plot);
}

}  // namespace kurbel::bench
