// coverage_ladder.cpp — runs of random variants at many tolerances, by other methods and from other angles, with their
// references: estimators of errors are tried on this table without running anything again.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "bench/coverage.h"
#include "bench/workers.h"
#include "tests/coverage/single_run.h"
#include "tests/coverage/variant.h"

namespace kurbel::bench {
namespace {

using coverage::Variant;

constexpr double rungs[] = {3, 10, 30, 100, 300, 900, 3000, 9000};  // tolerance = accuracy over this
constexpr double few_rungs[] = {10, 100, 300};
constexpr double reference_budget = 6;  // [s]

// Another family of formulas, or another order.
std::string other_method(const std::string& method) {
  if (method == "dop853" || method == "auto" || method == "work") return "verner6";
  if (method == "esdirk3") return "esdirk";
  if (method == "esdirk" || method == "bdf") return "esdirk5";
  if (method == "esdirk5") return "esdirk";
  return "dop853";
}

class Rows {
 public:
  explicit Rows(const Variant& variant) : variant_(variant) {}

  void add(const std::string& run, const std::string& method, double tolerance, const Result& r,
           const std::map<std::string, double>& shifts = {}) {
    const std::string head = fmt::format(
        "{},{},{},{:.0e},{},{},{:.3e},{},{},{},{},{:.4g},{:.3e}", variant_.scene, variant_.seed, variant_.method,
        variant_.accuracy, run, method, tolerance, r.complete ? 1 : 0, r.statistics.stepper.flow_calls,
        r.statistics.stepper.steps, r.statistics.events, r.statistics.cpu_seconds, r.energy.relative);
    for (const Figure& f : r.figures) {
      const auto shift = shifts.find(f.name);
      text_ +=
          fmt::format("{},{},{},{:.6g},{:.3g},{:.17g},{}\n", head, f.name, f.unit, f.scale, f.resolution,
                      f.value - (shift == shifts.end() ? 0 : shift->second), f.at ? fmt::format("{:.17g}", *f.at) : "");
    }
  }
  std::string take() { return std::move(text_); }

 private:
  const Variant& variant_;
  std::string text_;
};

// Two that end: by the high order, from one cycle on; by other formulas; where both are too slow, by implicit ones.
void add_references(Rows& rows, const Variant& variant, const std::shared_ptr<const Model>& model,
                    const std::shared_ptr<const Model>& shifted, const std::map<std::string, double>& shifts) {
  const double tolerance = std::clamp(variant.accuracy * 1e-5, 1e-13, 1e-10);
  int found = 0;
  for (const char* method : {"dop853", "verner6", "esdirk5", "adams"}) {
    const bool on = found == 0 && shifted;
    const Result r = coverage::single_run(on ? shifted : model, {method, tolerance, reference_budget});
    if (!r.complete) continue;
    rows.add(fmt::format("reference_{}{}", found == 0 ? "a" : "b", on ? "_shifted" : ""), method, tolerance, r,
             on ? shifts : std::map<std::string, double>{});
    if (++found == 2) return;
  }
}

std::string ladder_of(const Variant& variant, double budget) {
  const auto model = compile(variant.read, variant.read.effects);
  std::shared_ptr<const Model> shifted;
  std::map<std::string, double> shifts;
  if (const auto scene = coverage::started_a_cycle_on(*model)) {
    shifted = compile(*scene, scene->effects);
    shifts = coverage::shifts_of_angles(model, shifted);
  }
  Rows rows(variant);
  bool whole = true;
  for (const double rung : rungs) {
    const double tolerance = std::max(variant.accuracy / rung, 2e-15);
    const Result r = coverage::single_run(model, {variant.method, tolerance, budget});
    rows.add(fmt::format("rung_{:g}", rung), variant.method, tolerance, r);
    whole = whole && r.complete;
    if (!whole) break;
  }
  if (!whole) return rows.take();
  for (const double rung : few_rungs) {
    const double tolerance = variant.accuracy / rung;
    const std::string other = other_method(variant.method);
    rows.add(fmt::format("other_{:g}", rung), other, tolerance,
             coverage::single_run(model, {other, tolerance, budget}));
    if (shifted)
      rows.add(fmt::format("shifted_{:g}", rung), variant.method, tolerance,
               coverage::single_run(shifted, {variant.method, tolerance, budget}), shifts);
  }
  // Hooks: a run with another table of the mechanism, and one with another first step, belong here once the compiler
  // and RunOptions take them.
  add_references(rows, variant, model, shifted, shifts);
  return rows.take();
}

}  // namespace

void dump_ladders(const CoverageOptions& options, const std::string& path) {
  std::ofstream out(path);
  out << "scene,seed,method,accuracy,run,run_method,tolerance,complete,flow_calls,steps,events,cpu,energy,figure,unit,"
         "scale,resolution,value,at\n";
  std::size_t done = 0;
  const auto begin = std::chrono::steady_clock::now();
  run_tasks(
      options.variants, options.jobs, 90,
      [&](std::size_t k) {
        const Variant v = coverage::make_variant(scene_of(k), seed_of(options, k));
        return ladder_of(v, options.budget);
      },
      [&](const TaskEnd& end) {
        out << end.text << std::flush;
        ++done;
        if (!end.whole) std::fprintf(stderr, "%s %zu: %s\n", scene_of(end.task).c_str(), end.task, end.words.c_str());
        if (done % 30 == 0) std::fprintf(stderr, "%zu of %zu variants\n", done, options.variants);
      },
      [&] {
        const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
        return gone.count() < 60 * options.minutes;
      });
}

}  // namespace kurbel::bench
