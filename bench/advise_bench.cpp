// advise_bench.cpp — how far does advice carry? Every example scene within 5, 1 and 0.1 %, checked on operating points
// that took no part in the choice.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "bench/benches.h"
#include "bench/machines.h"
#include "studies/advise/advise.h"

namespace kurbel::bench {
namespace {

std::string percent(double part) { return std::isfinite(part) ? fmt::format("{:.2g} %", 100 * part) : "lost"; }

std::string held_out_of(const Advice& advice) {
  if (advice.held_out.empty()) return "—";
  double worst = 0;
  bool refused = false;
  for (const HeldOut& h : advice.held_out) worst = std::max(worst, h.deviation), refused |= !h.refused.empty();
  return percent(worst) + (refused ? ", not all ran" : "");
}

}  // namespace

void advice_on_scenes(BenchBook& book) {
  Table table{
      .title = "Advice on the example scenes: recommended set, its deviation, and that at loads and speeds ± 20 %",
      .columns = {"scene", "effects", "within", "recommended", "deviation", "held out", "warned", "runs", "time"},
      .rows = {}};
  int within_held_out = 0, warned = 0, quiet_misses = 0;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(KURBEL_SOURCE_DIR) + "/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const Scene scene = read_scene(file.string(), all_kinds());
    if (effect_units(scene).empty()) continue;
    for (const double within : {0.05, 0.01, 0.001}) {
      std::fprintf(stderr, "%s within %g %%\n", file.stem().c_str(), 100 * within);
      AdviseOptions options;
      options.within = within;
      options.simulate.accuracy = std::min(scene.run.accuracy, 0.1 * within);
      Advice advice;
      try {
        advice = advise(scene, options);
      } catch (const std::exception& refusal) {
        table.rows.push_back({file.stem().string(), "", percent(within), refusal.what(), "", "", "", "", ""});
        continue;
      }
      const TriedSet &chosen = advice.tried[advice.chosen], &full = advice.tried.front();
      const bool carries =
          std::all_of(advice.held_out.begin(), advice.held_out.end(), [](const HeldOut& h) { return h.within; });
      if (advice.chosen != 0) {
        if (carries)
          ++within_held_out;
        else if (!advice.warnings.empty())
          ++warned;
        else
          ++quiet_misses;
      }
      table.rows.push_back({file.stem().string(), fmt::format("{}", advice.units.size()), percent(within),
                            advice.chosen == 0 ? "everything" : chosen.words, percent(chosen.deviation),
                            held_out_of(advice), advice.warnings.empty() ? "" : "yes",
                            fmt::format("{}", advice.tried.size() + 2 * advice.held_out.size()),
                            fmt::format("{:.2f}", chosen.cpu_seconds / std::max(full.cpu_seconds, 1e-9))});
    }
  }
  book.tables.push_back(table);
  book.target("advice that leaves something out", "holds at loads and speeds ± 20 %, or warns",
              fmt::format("{} hold, {} warn, {} neither", within_held_out, warned, quiet_misses), quiet_misses == 0);
}

}  // namespace kurbel::bench
