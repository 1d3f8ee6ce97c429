// fit_checks.cpp — other starts, records omitted, effects that are off.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/experiments/design.h"
#include "studies/fit/fit.h"
#include "studies/trials/off_effects.h"

namespace kurbel {
namespace {

constexpr double same_cost = 1e-3, same_place = 1e-2;  // relative; of the ranges
constexpr int steps_of_checks = 12;

double rms_of(const Eigen::VectorXd& v) {
  return v.size() > 0 ? std::sqrt(v.squaredNorm() / static_cast<double>(v.size())) : 0;
}

// The part of one record in the stacked residuals.
Eigen::VectorXd part_of(const FitProblem& problem, const Eigen::VectorXd& r, std::size_t record) {
  Eigen::Index begin = 0;
  for (std::size_t k = 0; k < record; ++k) begin += problem.comparisons()[k].size();
  return r.segment(begin, problem.comparisons()[record].size());
}

}  // namespace

// Sobol's points within the bounds; the best of all is kept.
void try_starts(FitProblem& problem, const FitOptions& options, FitState& state, FitStudy& study) {
  std::vector<SweptParameter> unit;
  for (const Unknown& u : problem.unknowns()) unit.push_back({.path = u.name, .low = 0, .high = 1});
  const Design design(fmt::format("sobol:{}", options.starts - 1), unit, options.seed);
  std::vector<BoundedFit> found = {state.best};
  for (std::size_t i = 0; i + 1 < options.starts; ++i) {
    const std::vector<double> row = design.row(i);
    found.push_back(problem.fit(Eigen::Map<const Eigen::VectorXd>(row.data(), problem.size())));
    if (found.back().r.size() && (state.best.r.size() == 0 || found.back().cost() < state.best.cost()))
      state.best = found.back();
  }
  std::size_t same = 0, other = 0;
  for (const BoundedFit& f : found) {
    if (f.r.size() == 0 || f.cost() > state.best.cost() * (1 + same_cost) + 1e-9) continue;
    ++same;
    other += (f.u - state.best.u).cwiseAbs().maxCoeff() > same_place;
  }
  study.notes.push_back(
      fmt::format("{} of {} starts came to the best fit{}", same, found.size(),
                  other ? fmt::format(", {} of them with other values: the data do not separate them", other) : ""));
}

void leave_records_out(FitProblem& problem, const FitState& state, FitStudy& study) {
  const std::size_t count = problem.records().size();
  if (count < 2) return;
  for (std::size_t r = 0; r < count; ++r) {
    // What concerns this record alone keeps its value, and so does what the others cannot determine.
    problem.active[r] = false;
    const BoundedFit others = problem.fit(state.best.u, steps_of_checks);
    problem.active[r] = true;
    const auto all = problem.residuals(others.u);
    if (!all) continue;
    const double rms = rms_of(part_of(problem, *all, r)), rms_fitted = rms_of(part_of(problem, state.best.r, r));
    for (std::size_t k = 0; k < problem.unknowns().size(); ++k) {
      const FittedUnknown& u = study.unknowns[k];
      WithoutRecord& reported = study.omitted.emplace_back(WithoutRecord{
          problem.records()[r].name, u.unknown.name, u.unknown.range.unit, 0, u.value, {}, rms, rms_fitted});
      reported.value = u.unknown.at(others.u[static_cast<Eigen::Index>(k)]);
      if (u.error && *u.error > 0) reported.errors = (reported.value - u.value) / *u.error;
    }
  }
}

// Refitted with each effect that any of the scenes has data for and that is off.
void try_off_effects(FitProblem& problem, const FitState& state, FitStudy& study) {
  std::vector<std::vector<OffEffect>> of_record;
  std::vector<OffEffect> all;
  for (std::size_t r = 0; r < problem.records().size(); ++r) {
    RecordMachine machine = problem.machines()[r];
    const Scene& scene = machine.scene_at(state.best.u);
    of_record.push_back(problem.records()[r].over == Over::mode ? std::vector<OffEffect>{}
                                                                : effects_that_are_off(scene, scene.effects));
    for (const OffEffect& e : of_record.back())
      if (std::none_of(all.begin(), all.end(), [&](const OffEffect& a) { return a.name == e.name; })) all.push_back(e);
  }
  for (const OffEffect& effect : all) {
    for (std::size_t r = 0; r < of_record.size(); ++r)
      for (const OffEffect& e : of_record[r])
        if (e.name == effect.name) problem.effects[r] = e.effects;
    const BoundedFit with = problem.fit(state.best.u, steps_of_checks);
    EffectTried& reported = study.effects.emplace_back(EffectTried{.words = effect.words});
    if (with.r.size() == 0)
      reported.failed = problem.failure();
    else
      reported.reduction = 1 - with.cost() / std::max(state.best.cost(), 1e-300);
    problem.effects.assign(of_record.size(), std::nullopt);
  }
  std::stable_sort(study.effects.begin(), study.effects.end(), [](const EffectTried& a, const EffectTried& b) {
    return (a.failed.empty() ? a.reduction : -HUGE_VAL) > (b.failed.empty() ? b.reduction : -HUGE_VAL);
  });
  if (study.effects.empty()) study.notes.push_back("no trial: the scenes have no data for a further effect");
  constexpr double worth_saying = 0.05;
  if (!study.effects.empty() && study.effects.front().failed.empty() && study.effects.front().reduction > worth_saying)
    study.notes.push_back(fmt::format("{}, which is off, would take {:.2g} % off the sum of squares that is left",
                                      study.effects.front().words, 100 * study.effects.front().reduction));
}

}  // namespace kurbel
