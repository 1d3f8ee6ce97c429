// work_periods.cpp — cycles sorted into periods, works summed up between them.
#include "studies/duty/work_periods.h"

#include <string>

namespace kurbel {
namespace {

constexpr std::array names = {"run_up", "steady_motion", "run_down"};

// A moment at which works and energy are known.
struct Border {
  double t = 0, energy = 0;
  std::array<double, 4> work{};
};

WorkPeriod between(const char* name, const Border& a, const Border& b) {
  WorkPeriod p{.name = name, .begin = a.t, .end = b.t};
  for (std::size_t i = 0; i < p.work.size(); ++i) p.work[i] = b.work[i] - a.work[i];
  p.energy = b.energy - a.energy;
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
  if (!(spent > 0) || !(useful < 0)) return {};
  return -useful / spent;
}

std::vector<WorkPeriod> work_periods(const Model& m, const Periods& periods, const std::vector<CycleRecord>& cycles,
                                     const WholeRun& whole) {
  if (!periods.steady || whole.work.empty()) return {};
  const double from = periods.run_up_end.value_or(whole.begin), to = periods.run_down_begin.value_or(whole.end);
  const CycleRecord *first = nullptr, *last = nullptr;
  for (const CycleRecord& c : cycles) {
    if (c.begin < from || c.end > to || c.work_before.empty()) continue;
    if (!first) first = &c;
    last = &c;
  }
  if (!first) return {};
  const auto at_begin = [&](const CycleRecord& c) {
    return Border{c.begin, c.energy_before, works_by_kind(m, c.work_before)};
  };
  // The end of a cycle is the begin of the next, seen or not: its works are those before it and its own.
  const auto at_end = [&](const CycleRecord& c) {
    Border b{c.end, c.energy_after, works_by_kind(m, c.work_before)};
    const std::array<double, 4> own = works_by_kind(m, c.work);
    for (std::size_t i = 0; i < own.size(); ++i) b.work[i] += own[i];
    return b;
  };
  const Border start{whole.begin, whole.energy_begin, {}},
      end{whole.end, whole.energy_end, works_by_kind(m, whole.work)};
  std::vector<WorkPeriod> list;
  if (first->begin > whole.begin) list.push_back(between(names[0], start, at_begin(*first)));
  list.push_back(between(names[1], at_begin(*first), at_end(*last)));
  if (periods.run_down_begin) list.push_back(between(names[2], at_end(*last), end));
  return list;
}

void tell_works(const Model& m, const std::vector<WorkPeriod>& periods, FigureTeller& tell) {
  if (m.cycle == 0) return;
  for (const std::string name : names) {
    const auto period =
        std::find_if(periods.begin(), periods.end(), [&](const WorkPeriod& p) { return p.name == name; });
    const auto tell_one = [&](const char* of, auto value) {
      tell(Name::own("work_of_" + name, of), [&]() -> std::optional<Found> {
        if (period == periods.end()) return {};
        return Found{value(*period)};
      });
    };
    for (std::size_t i = 0; i < all_accounts.size(); ++i)
      tell_one(name_of(all_accounts[i]), [i](const WorkPeriod& p) { return p.work[i]; });
    tell_one("energy", [](const WorkPeriod& p) { return p.energy; });
  }
}

}  // namespace kurbel
