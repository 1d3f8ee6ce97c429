// work_periods.cpp — cycles sorted into periods, works summed up between them.
#include "studies/duty/work_periods.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/find_by.h"

namespace kurbel {
namespace {

constexpr std::array names = {"run_up", "steady_motion", "run_down"};

// A time at which works and energy are known.
struct Border {
  double t = 0, energy = 0;
  std::array<double, 4> work{}, resolution{};
};

double sum_of(const std::array<double, 4>& work) { return work[0] + work[1] + work[2] + work[3]; }

WorkPeriod between(const WorkPeriod& which, const Border& a, const Border& b) {
  WorkPeriod p = which;
  p.begin = a.t, p.end = b.t;
  for (std::size_t i = 0; i < p.work.size(); ++i) {
    p.work[i] = b.work[i] - a.work[i];
    p.work_resolution[i] = std::abs(a.resolution[i]) + std::abs(b.resolution[i]);
  }
  p.energy = b.energy - a.energy;
  p.energy_resolution = std::abs(sum_of(a.resolution)) + std::abs(sum_of(b.resolution));
  return p;
}

}  // namespace

std::array<double, 4> works_by_kind(const Model& m, std::span<const double> work) {
  std::array<double, 4> sums{};
  for (std::size_t k = 0; k < work.size(); ++k) sums[static_cast<std::size_t>(m.accounts[k].kind)] += work[k];
  return sums;
}

std::vector<double> works_done(const Equations& equations, std::span<const double> y) {
  std::vector<double> work;
  for (std::size_t k = 0; k < equations.model().accounts.size(); ++k) work.push_back(y[equations.work_index(k)]);
  return work;
}

double WorkPeriod::residual() const {
  double sum = 0;
  for (const double w : work) sum += w;
  return energy - sum;
}

std::optional<double> efficiency_of(double driving, double useful, double weight, double energy) {
  const double spent = driving + weight - energy;
  constexpr double rounding = 1e-9;  // of what is spent
  if (!(spent > 0) || !(-useful > rounding * spent)) return {};
  return -useful / spent;
}

std::vector<WorkPeriod> three_periods(const Periods& p, double begin, double end) {
  if (!p.steady) return {};
  std::vector<WorkPeriod> list;
  const double from = p.run_up_end.value_or(begin), to = p.run_down_begin.value_or(end);
  using enum QuantityKind::Window;
  if (from > begin) list.push_back({.name = names[0], .window = run_up, .begin = begin, .end = from});
  if (to > from) list.push_back({.name = names[1], .window = steady_motion, .begin = from, .end = to});
  if (p.run_down_begin)
    list.push_back({.name = names[2], .window = run_down, .begin = to, .end = p.standstill.value_or(end)});
  return list;
}

std::vector<WorkPeriod> work_periods(const Model& m, const Periods& periods, const std::vector<CycleRecord>& cycles,
                                     const WholeRun& whole,
                                     const std::function<std::optional<std::array<double, 4>>(double t)>& works_at) {
  if (whole.work.empty()) return {};
  const auto border_at = [&](double t) -> std::optional<Border> {
    if (t == whole.begin) return Border{t, whole.energy_begin, {}};
    if (t == whole.end || t == periods.standstill) return Border{t, whole.energy_end, works_by_kind(m, whole.work)};
    const std::optional<std::array<double, 4>> work = works_at(t);
    if (!work) return {};
    Border known{whole.begin, whole.energy_begin, {}};
    for (const CycleRecord& c : cycles)
      if (c.begin <= t && !c.work_before.empty()) known = {c.begin, c.energy_before, works_by_kind(m, c.work_before)};
    Border border{t, known.energy + sum_of(*work) - sum_of(known.work), *work};
    if (t != periods.run_up_end) return border;
    // Works near the border are known within a step to either side of it, which may be shorter than the shift.
    for (double shift = periods.run_up_resolution, part = 1; part > 1e-3; part /= 2)
      for (const double h : {part * shift, -part * shift})
        if (const auto beside = t + h == t ? std::nullopt : works_at(t + h)) {
          for (std::size_t i = 0; i < work->size(); ++i) border.resolution[i] = ((*beside)[i] - (*work)[i]) / part;
          return border;
        }
    return border;
  };
  std::vector<WorkPeriod> list;
  for (const WorkPeriod& p : three_periods(periods, whole.begin, whole.end)) {
    const std::optional<Border> begin = border_at(p.begin), end = border_at(p.end);
    if (!begin || !end) return {};
    list.push_back(between(p, *begin, *end));
  }
  return list;
}

void report_works(const Model& m, const std::vector<WorkPeriod>& periods, FigureReporter& report) {
  if (m.cycle == 0) return;
  for (const std::string name : names) {
    const auto* const period = find_by(periods, &WorkPeriod::name, name);
    const auto report_one = [&](const char* of, auto value) {
      report(Name::own("work_of_" + name, of), [&]() -> std::optional<Found> {
        if (!period) return {};
        return value(*period);
      });
    };
    for (std::size_t i = 0; i < all_accounts.size(); ++i)
      report_one(name_of(all_accounts[i]),
                 [i](const WorkPeriod& p) { return Found{.value = p.work[i], .resolution = p.work_resolution[i]}; });
    report_one("energy",
               [](const WorkPeriod& p) { return Found{.value = p.energy, .resolution = p.energy_resolution}; });
  }
}

EnergyBalance energy_balance(const Model& model, const EnergyAudit& audit) {
  EnergyBalance e;
  for (std::size_t k = 0; k < audit.work.size(); ++k) {
    e.by_line[name_of(model.accounts[k].kind)] += audit.work[k];
    e.by_account[model.accounts[k].name] += audit.work[k];
  }
  e.kinetic_start = audit.kinetic_start;
  e.kinetic_end = audit.kinetic_end;
  e.stored_start = audit.stored_start;
  e.stored_end = audit.stored_end;
  e.residual = audit.largest_residual;
  e.relative = audit.relative();
  e.reduction_residual = audit.reduction_residual;
  e.free_bodies = audit.open_body.part;
  e.checks = audit.checked;
  return e;
}

void close_balance(Equations& equations, const RunOutcome& outcome, EnergyAudit& audit) {
  if (outcome.complete || !equations.audit() || outcome.state.size() < equations.size()) return;
  const double kinetic = equations.kinetic_energy_of_bodies(outcome.t, outcome.state),
               stored = equations.stored_energy(outcome.t, outcome.state);
  std::vector<double> work = works_done(equations, outcome.state);
  double sum = 0, turned_over = 0;
  for (std::size_t k = 0; k < work.size(); ++k) {
    sum += work[k];
    turned_over += std::abs(work[k] - (k < audit.work.size() ? audit.work[k] : 0));
  }
  if (!std::isfinite(kinetic + stored + sum)) return;  // at the end of its reach: the balance of the last check
  audit.turnover += turned_over;
  audit.largest_kinetic = std::max(audit.largest_kinetic, kinetic);
  audit.largest_residual =
      std::max(audit.largest_residual, std::abs(kinetic + stored - audit.kinetic_start - audit.stored_start - sum));
  audit.kinetic_end = kinetic, audit.stored_end = stored;
  audit.work = std::move(work);
}

}  // namespace kurbel
