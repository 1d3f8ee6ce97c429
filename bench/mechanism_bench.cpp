// mechanism_bench.cpp — what does a slider-crank cost: in closed form, from the table, to extract, and as a full
// multibody?
//
// Prints tables and ends in a conclusion. Errors are measured: against the closed form in long double, and for the
// multibody run against φ(10 s) of the free slider-crank from 30 rad/s, 47 turns, known to 12 digits.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "bench/benches.h"
#include "mechanisms/bodies/multibody_run.h"
#include "mechanisms/reduced/reduced_mechanism.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace {

using namespace kurbel;

// r = 0.1 m, l = ratio · r, all inertias of the reference machine.
SliderCrankData machine(double ratio) {
  SliderCrankData d;
  d.radius = 0.1;
  d.rod_length = ratio * d.radius;
  d.crank_inertia = 0.55;
  d.rod_mass = 2;
  d.rod_com = 0.35 * d.rod_length;
  d.rod_inertia = 0.020;
  d.slider_mass = 3;
  return d;
}

double seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

volatile double sink;

// Nanoseconds a call of f(φ) → {value, slope} over random angles, best of several repetitions.
template <class F>
double nanoseconds(F&& f) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  std::vector<double> phi(1 << 12);
  for (double& p : phi) p = angle(random);
  double best = 1e9;
  for (int round = 0; round < 30; ++round) {
    double sum = 0;
    const double start = seconds();
    for (int repeat = 0; repeat < 16; ++repeat)
      for (const double p : phi) {
        const auto pair = f(p);
        sum += pair.value + pair.slope;
      }
    best = std::min(best, (seconds() - start) / (16.0 * static_cast<double>(phi.size())) * 1e9);
    sink = sum;
  }
  return best;
}

// Nanoseconds where each angle waits for the result before, as in an integrator.
template <class F>
double latency(F&& f) {
  double best = 1e9;
  for (int round = 0; round < 30; ++round) {
    double phi = 0.1;
    const double start = seconds();
    for (int i = 0; i < 50000; ++i) {
      const auto pair = f(phi);
      phi += 0.37 + 1e-9 * (pair.value + pair.slope);
      if (phi > 6) phi -= 6;
    }
    best = std::min(best, (seconds() - start) / 50000 * 1e9);
    sink = phi;
  }
  return best;
}

// Microseconds of one Simbody sample, best of several repetitions.
double extraction_microseconds(const SliderCrankData& d) {
  const auto bodies = make_bodies(d);
  double best = 1e9;
  for (int round = 0; round < 5; ++round) {
    const double start = seconds();
    for (int i = 0; i < 500; ++i) sink = bodies->sample(0.0126 * i).inertia;
    best = std::min(best, (seconds() - start) / 500 * 1e6);
  }
  return best;
}

struct Errors {
  double inertia = 0, slope = 0, curvature = 0;  // of own value; of own maximum; of own maximum
};

Errors table_errors(const ReducedMechanism& table, const SliderCrankGeometry& exact) {
  Errors e;
  double slope_maximum = 0, curvature_maximum = 0;
  for (int i = 0; i < 200000; ++i) {
    const double phi = 2 * std::numbers::pi * (i + 0.5) / 200000;
    const auto truth = exact.inertia(static_cast<long double>(phi));
    const auto at = table.at(phi);
    e.inertia = std::max(e.inertia, std::fabs(static_cast<double>((at.inertia().value - truth.value) / truth.value)));
    e.slope = std::max(e.slope, std::fabs(static_cast<double>(at.inertia().slope - truth.slope)));
    e.curvature =
        std::max(e.curvature, std::fabs(static_cast<double>(at.inertia_derivative().slope - truth.curvature)));
    slope_maximum = std::max(slope_maximum, std::fabs(static_cast<double>(truth.slope)));
    curvature_maximum = std::max(curvature_maximum, std::fabs(static_cast<double>(truth.curvature)));
  }
  e.slope /= slope_maximum, e.curvature /= curvature_maximum;
  return e;
}

struct TableCost {
  double table_ns = 0, closed_ns = 0, build_ms = 0;
};

TableCost bench_tables() {
  TableCost reference;
  fmt::print("I_r and I_r' together [ns]; error of I_r by value, of I_r', I_r'' by maximum\n");
  fmt::print("{:>7} {:>7} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8}\n", "l/r", "pieces", "samples",
             "build ms", "sample us", "table ns", "(latency)", "closed", "I_r", "I_r'", "I_r''");
  for (const double ratio : {10.0, 3.5, 2.0, 1.2, 1.05, 1.01, 1.001, 1.0001}) {
    const SliderCrankData data = machine(ratio);
    const SliderCrankGeometry closed(data);
    double build = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double start = seconds();
      sink = extract_mechanism(data, table_tolerance, table_max_pieces, Extraction::second).inertia(1).value;
      build = std::min(build, (seconds() - start) * 1e3);
    }
    const ReducedMechanism table = extract_mechanism(data, table_tolerance, table_max_pieces, Extraction::second);
    const auto from_table = [&](double phi) { return table.inertia(phi); };
    const auto from_closed_form = [&](double phi) { return closed.inertia(phi); };
    const double table_ns = nanoseconds(from_table), closed_ns = nanoseconds(from_closed_form);
    const Errors e = table_errors(table, closed);
    fmt::print("{:>7} {:>7} {:>8} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>8.1f} {:>8.1e} {:>8.1e} {:>8.1e}\n", ratio,
               table.report().pieces, table.report().samples, build, extraction_microseconds(data), table_ns,
               latency(from_table), closed_ns, e.inertia, e.slope, e.curvature);
    if (ratio == 3.5) reference = {table_ns, closed_ns, build};
  }
  return reference;
}

struct RunCost {
  double error = 0, cpu = 0;
};

// The cheapest multibody run within 1e-6 rad.
RunCost bench_multibody() {
  RunCost best{0, 1e9};
  fmt::print("\nfull multibody run, free slider-crank, 10 s: error of phi(10 s) [rad] over CPU time\n");
  fmt::print("{:>20} {:>9} {:>8} {:>9} {:>10} {:>10} {:>8}\n", "integrator", "accuracy", "steps", "evals", "error rad",
             "energy", "CPU s");
  for (const char* integrator : {"RungeKuttaMerson", "RungeKuttaFeldberg", "RungeKutta3"})
    for (const double accuracy : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10}) {
      if (std::string(integrator) == "RungeKutta3" && accuracy < 1e-7) continue;  // takes minutes
      MultibodyProblem p;
      p.mechanism = MechanismData(machine(3.5)).bodies_of();
      p.omega0 = 30;
      p.t_end = 10;
      p.accuracy = accuracy;
      p.integrator = integrator;
      const std::clock_t start = std::clock();
      const MultibodyResult result = run_multibody(p);
      const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      const MultibodySample end = result.samples.back();
      const double error = std::fabs(end.phi - 294.719373652657);
      fmt::print("{:>20} {:>9.0e} {:>8} {:>9} {:>10.1e} {:>10.1e} {:>8.2f}\n", integrator, accuracy, result.steps,
                 result.evaluations, error, end.kinetic_energy / 252.037193877551 - 1, cpu);
      if (error <= 1e-6 && cpu < best.cpu) best = {error, cpu};
    }
  return best;
}

}  // namespace

namespace kurbel::bench {

void costs_of_mechanisms() {
  const TableCost table = bench_tables();
  const RunCost run = bench_multibody();
  fmt::print(
      "\nAt l/r = 3.5 the table extracted from Simbody gives I_r and I_r' in {:.0f} ns where the closed form takes "
      "{:.0f} "
      "ns, and is built in {:.0f} ms; a full multibody run to {:.0e} rad costs {:.1f} s, {:.0f} such tables.\n",
      table.table_ns, table.closed_ns, table.build_ms, run.error, run.cpu, run.cpu / table.build_ms * 1e3);
}

}  // namespace kurbel::bench
