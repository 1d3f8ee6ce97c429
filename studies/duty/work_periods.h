// work_periods.h — run-up, steady motion and run-down: their borders, the same everywhere, and their works.
//
//     run-up          from the start until the speed finally enters the range of steady motion     (run/periods.h)
//     steady motion   from there until the last source is switched off, or to the end
//     run-down        from there to standstill, or to the end
//
//     A_d + A_u + A_h + A_w = ΔE      driving, useful, harmful works, that of weights; kinetic and stored energy
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "studies/findings/result.h"

namespace kurbel {

// Sums over the accounts of each kind, by Account: driving, useful, harmful, weight [J].
std::array<double, 4> works_by_kind(const Model& model, std::span<const double> work);
// Per account, up to a state of audited equations [J].
std::vector<double> works_done(const Equations& equations, std::span<const double> y);

// Useful work over the work spent: driving work, work of weights, and the decrease of stored energy. It is at most 1
// as long as harmful work is negative, whether the period closes or not; empty if there is no useful work.
//     η = −A_u/(A_d + A_w − ΔE)
std::optional<double> efficiency_of(double driving, double useful, double weight, double energy);

// The observer's data for a Result.
EnergyBalance energy_balance(const Model& model, const EnergyAudit& audit);
// Works and energies up to the end of a run that stopped between two checks of its balance.
void close_balance(Equations& equations, const RunOutcome& outcome, EnergyAudit& audit);

struct WorkPeriod {
  const char* name = "";  // "run_up", "steady_motion", "run_down"
  QuantityKind::Window window = QuantityKind::Window::run;
  double begin = 0, end = 0;     // [s]
  std::array<double, 4> work{};  // by Account: driving, useful, harmful, weight [J]
  double energy = 0;             // ΔE, of kinetic and stored energy as they are at both ends [J]
  // Changes of these if a border is shifted by the resolution of its time [J].
  std::array<double, 4> work_resolution{};
  double energy_resolution = 0;
  double residual() const;  // ΔE minus all works: residual of the balance [J]
  std::optional<double> efficiency() const { return efficiency_of(work[0], work[1], work[3], energy); }
};

// Kinetic and stored energy at begin and end of a run, and its works by account.
struct WholeRun {
  double begin = 0, end = 0, energy_begin = 0, energy_end = 0;  // [s], [J]
  std::vector<double> work;                                     // per account [J]
};

// The periods of a run between two times, without works; empty if the motion is not steady.
std::vector<WorkPeriod> three_periods(const Periods& periods, double begin, double end);

// The same with their works: `works_at` gives the works from the start to a border; empty if it cannot. The energy at
// a border is that at the begin of its cycle plus the works since then.
std::vector<WorkPeriod> work_periods(const Model& model, const Periods& periods, const std::vector<CycleRecord>& cycles,
                                     const WholeRun& whole,
                                     const std::function<std::optional<std::array<double, 4>>(double t)>& works_at);

// "work_of_run_up.driving" … "work_of_run_up.energy": their errors, with those of the end of run-up, are reported, not
// judged, as borders may differ between runs.
void report_works(const Model& model, const std::vector<WorkPeriod>& periods, FigureReporter& report);

}  // namespace kurbel
