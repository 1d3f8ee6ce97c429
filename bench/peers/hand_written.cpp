// hand_written.cpp — the loops, without any layer between the equations and the table.
#include "bench/peers/hand_written.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/machines.h"
#include "engine/steppers/butcher_tables.h"

namespace kurbel::bench {
namespace {

// Explicit embedded Runge–Kutta for n states known to the compiler.
template <std::size_t n, class Flow>
class Loop {
 public:
  using State = std::array<double, n>;
  Loop(const EmbeddedTable& table, Flow flow, const State& scale, double tolerance)
      : table_(table), flow_(flow), scale_(scale), tolerance_(tolerance) {}

  double t = 0, t_before = 0, h = 1e-4;
  State y{}, before{};
  long steps = 0;

  void start(double at, const State& state) {
    t = at;
    y = state;
    flow_(t, y, k_[table_.stages]);
  }

  // One accepted step, at most to `limit`.
  void step(double limit) {
    t_before = t;
    before = y;
    k_[0] = k_[table_.stages];
    for (;;) {
      const double use = std::min(h, limit - t_before);
      const double error = attempt(use);
      const double factor = std::clamp(
          0.85 * std::pow(error, -table_.integral_exponent) * std::pow(previous_, table_.proportional_exponent),
          table_.smallest_factor, table_.largest_factor);
      if (error <= 1) {
        t = use < h ? limit : t_before + use;
        if (use == h || factor < 1) h = use * factor;
        previous_ = std::max(error, 1e-4);
        ++steps;
        return;
      }
      h = use * std::min(factor, 0.9);
    }
  }
  // The last step again, of length `use`.
  void retake(double use) {
    attempt(use);
    t = t_before + use;
  }
  // A state within the last step.
  double between(double x, std::size_t i) {
    const double step = t - t_before, u = 1 - x, f0 = k_[0][i], f1 = k_[table_.stages][i];
    double tail = 0;
    for (std::size_t d = table_.dense.size(); d-- > 0;) {
      double sum = 0;
      for (const Term& term : table_.dense[d]) sum += term.weight * k_[term.stage][i];
      tail = step * sum + (d % 2 == 0 ? x : u) * tail;
    }
    const double rise = y[i] - before[i];
    return before[i] + x * (rise + u * (step * f0 - rise + x * (2 * rise - step * (f0 + f1) + u * tail)));
  }
  void prepare_between() {
    const double step = t - t_before;
    for (std::size_t s = table_.stages + 1; s < table_.row.size(); ++s) stage(s, step);
  }

 private:
  void stage(std::size_t s, double step) {
    State z = before;
    for (const Term& term : table_.row[s]) {
      const double w = step * term.weight;
      const State& k = k_[term.stage];
      for (std::size_t i = 0; i < n; ++i) z[i] += w * k[i];
    }
    flow_(t_before + table_.node[s] * step, z, k_[s]);
    if (s == table_.stages) y = z;
  }
  double attempt(double step) {
    for (std::size_t s = 1; s <= table_.stages; ++s) stage(s, step);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (scale_[i] == 0) continue;
      double e = 0, r = 0;
      for (const Term& term : table_.error) e += term.weight * k_[term.stage][i];
      for (const Term& term : table_.rough_error) r += term.weight * k_[term.stage][i];
      e *= step / (tolerance_ * scale_[i]);
      r *= step / (tolerance_ * scale_[i]);
      largest = std::max(largest,
                         table_.rough_error.empty() ? std::abs(e) : e * e / std::sqrt(e * e + 0.01 * r * r + 1e-300));
    }
    return largest;
  }

  const EmbeddedTable& table_;
  Flow flow_;
  State scale_;
  double tolerance_, previous_ = 1e-4;
  std::array<State, most_stages> k_{};
};

const EmbeddedTable& table_named(const std::string& method) {
  return method == "dopri5" ? dormand_prince_54() : method == "verner6" ? verner_65() : dormand_prince_853();
}

// I_r and I_r′ of the reference slider-crank in closed form.
struct CrankInertia {
  double value, slope;
};
inline CrankInertia crank_inertia(double phi) {
  constexpr double r = 0.1, l = 0.35, J1 = 0.55, m2 = 2, s2 = 0.1225, J2 = 0.02, m3 = 3;
  const double s = std::sin(phi), c = std::cos(phi);
  const double sb = -r / l * s, cb = std::sqrt(1 - sb * sb);  // β from the stroke
  const double b1 = -r / l * c / cb, b2 = (r / l * s + sb * b1 * b1) / cb;
  const double x1 = -r * s - l * sb * b1, x2 = -r * c - l * (cb * b1 * b1 + sb * b2);
  const double px1 = -r * s - s2 * sb * b1, px2 = -r * c - s2 * (cb * b1 * b1 + sb * b2);
  const double py1 = r * c + s2 * cb * b1, py2 = -r * s + s2 * (-sb * b1 * b1 + cb * b2);
  return {J1 + m2 * (px1 * px1 + py1 * py1) + J2 * b1 * b1 + m3 * x1 * x1,
          2 * (m2 * (px1 * px2 + py1 * py2) + J2 * b1 * b2 + m3 * x1 * x2)};
}
// dx/dφ of the slider.
inline double slider_ratio(double phi) {
  constexpr double r = 0.1, l = 0.35;
  const double s = std::sin(phi), c = std::cos(phi), sb = -r / l * s, cb = std::sqrt(1 - sb * sb);
  return -r * s - l * sb * (-r / l * c / cb);
}

template <class Run>
BenchPoint measured(double tolerance, Run run) {
  BenchPoint p{.setting = tolerance};
  std::vector<double> seconds;
  run(p);  // warm
  double sum = 0;
  while (seconds.size() < 5 || (seconds.size() < 101 && sum < 0.2)) {
    const double before = processor_time();
    run(p);
    seconds.push_back(processor_time() - before);
    sum += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  p.seconds = seconds[seconds.size() / 2];
  p.fastest = seconds.front();
  p.slowest = seconds.back();
  return p;
}

}  // namespace

BenchPoint hand_written_r1(const std::string& method, double tolerance) {
  return measured(tolerance, [&](BenchPoint& p) {
    const auto flow = [](double, const std::array<double, 2>& y, std::array<double, 2>& f) {
      const CrankInertia i = crank_inertia(y[0]);
      f = {y[1], -0.5 * i.slope * y[1] * y[1] / i.value};
    };
    Loop<2, decltype(flow)> loop(table_named(method), flow, {1, 30}, tolerance);
    loop.start(0, {0, 30});
    while (loop.t < 10) loop.step(10);
    p.error = std::abs(loop.y[0] - 294.719373652657);
    p.steps = loop.steps;
  });
}

// The load works from cos φ = 1/7 to φ = π in every turn: each edge is landed on by Newton's method on true steps.
BenchPoint hand_written_r2b(const std::string& method, double tolerance) {
  return measured(tolerance, [&](BenchPoint& p) {
    bool loaded = false;
    const auto flow = [&loaded](double, const std::array<double, 2>& y, std::array<double, 2>& f) {
      const CrankInertia i = crank_inertia(y[0]);
      double torque = 60 * (1 - y[1] / 40) - 0.5 * i.slope * y[1] * y[1];
      if (loaded) torque += 2000 * slider_ratio(y[0]);
      f = {y[1], torque / i.value};
    };
    Loop<2, decltype(flow)> loop(table_named(method), flow, {1, 40}, tolerance);
    loop.start(0, {0, 20});
    const double first = std::acos(1.0 / 7);
    int turn = 0;
    while (loop.t < 10) {
      const double edge = 2 * M_PI * turn + (loaded ? M_PI : first);
      loop.step(10);
      if (loop.y[0] < edge) continue;
      for (int i = 0; i < 6 && std::abs(loop.y[0] - edge) > 1e-13; ++i)
        loop.retake(loop.t - loop.t_before + (edge - loop.y[0]) / loop.y[1]);
      if (loaded) ++turn;
      loaded = !loaded;
      loop.start(loop.t, loop.y);
    }
    p.error = std::abs(loop.y[0] - 175.990300636005);
    p.steps = loop.steps;
  });
}

// The largest spring torque of the first coupling over 5 s: roots of ω₁ − ω₂ on the dense output.
BenchPoint hand_written_e1(const std::string& method, double tolerance) {
  return measured(tolerance, [&](BenchPoint& p) {
    static constexpr std::array<double, 6> J = {0.10, 0.02, 0.05, 0.30, 1.5, 0.6};
    static constexpr std::array<double, 5> k = {4e3, 2e5, 2e5, 8e3, 5e4}, c = {2, 5, 5, 4, 10};
    using State = std::array<double, 11>;  // five twists, six speeds
    const auto flow = [](double, const State& y, State& f) {
      std::array<double, 6> torque = {200 * (1 - y[5] / 150), 0, 0, 0, 0, -0.02 * y[10] * y[10]};
      for (std::size_t i = 0; i < 5; ++i) {
        f[i] = y[5 + i] - y[6 + i];
        const double tau = k[i] * y[i] + c[i] * f[i];
        torque[i] -= tau;
        torque[i + 1] += tau;
      }
      for (std::size_t i = 0; i < 6; ++i) f[5 + i] = torque[i] / J[i];
    };
    const State scale = {0.05, 1e-3, 1e-3, 0.025, 4e-3, 150, 150, 150, 150, 150, 150};
    Loop<11, decltype(flow)> loop(table_named(method), flow, scale, tolerance);
    loop.start(0, {});
    double peak = 0;
    while (loop.t < 5) {
      loop.step(5);
      const double a = loop.before[5] - loop.before[6], b = loop.y[5] - loop.y[6];
      peak = std::max({peak, std::abs(k[0] * loop.y[0])});
      if ((a > 0) == (b > 0) || k[0] * std::max(std::abs(loop.before[0]), std::abs(loop.y[0])) < 0.5 * peak) continue;
      loop.prepare_between();
      double low = 0, high = 1;
      for (int i = 0; i < 50; ++i) {
        const double x = 0.5 * (low + high);
        ((loop.between(x, 5) - loop.between(x, 6) > 0) == (a > 0) ? low : high) = x;
      }
      peak = std::max(peak, std::abs(k[0] * loop.between(low, 0)));
    }
    p.error = std::abs(peak - 290.808843395416);
    p.steps = loop.steps;
  });
}

}  // namespace kurbel::bench
