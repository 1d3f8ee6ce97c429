// effects_bench.cpp — what does an effect cost that is switched on, and what does it cost to make a machine nearly
// rigid?
#include <fmt/format.h>

#include <cmath>

#include "bench/benches.h"
#include "bench/machines.h"
#include "studies/effects/effect_units.h"

namespace kurbel::bench {
namespace {

std::string folder() { return std::string(KURBEL_SOURCE_DIR) + "/scenes/"; }

// The press that has parameters for every effect: each alone, against none.
void switched(BenchBook& book) {
  Table table{.title = "The press with each effect alone, tolerance 1e-7, bare runs",
              .columns = {"effects", "coordinates", "steps", "time [ms]", "of the rigid one"},
              .rows = {}};
  const Scene press = read_scene(KURBEL_SOURCE_DIR "/bench/scenes/press_with_everything.toml", all_kinds());
  std::vector<std::string> sets = {"none"};
  for (const EffectUnit& unit : effect_units(press))
    if (unit.name != "gravity" && unit.name != "variable_inertia") sets.push_back(unit.name);
  sets.insert(sets.end(), {"elasticity", "elasticity+backlash", "elasticity+relaxation"});
  double rigid = 0;
  for (const std::string& effects : sets) {
    try {
      const auto model = compile(press, parse_effects(effects, press));
      const TimedRun t = timed(9, [&] { return bare_run(model, 1e-7); });
      if (rigid == 0) rigid = t.median_seconds;
      table.rows.push_back({effects, fmt::format("{}", model->free_shafts + model->twist_count()),
                            fmt::format("{}", t.outcome.statistics.stepper.steps),
                            fmt::format("{:.3g}", 1e3 * t.median_seconds),
                            fmt::format("{:.3g} ×", t.median_seconds / rigid)});
    } catch (const std::exception& refusal) {
      table.rows.push_back({effects, "", "", refusal.what(), ""});
    }
  }
  book.tables.push_back(table);
}

Scene stiffened(Scene scene, double factor) {
  for (Section& section : scene.components) {
    for (Setting& setting : section.settings) {
      if (setting.key == "stiffness") setting.number *= factor;
      if (setting.key == "damping" && section.kind->elastic) {
        setting.key = "damping_ratio";
        setting.number = 0.03;
      }
    }
  }
  return scene;
}

// Couplings stiffened at constant damping ratio: smooth torques, a step torque, and a press with load edges.
void rigid_limit(BenchBook& book) {
  Table table{.title = "Rigid limit: couplings stiffened, damping ratio kept, tolerance 1e-7",
              .columns = {"machine", "stiffness ×", "time [ms]", "ratio", "steps", "method"},
              .rows = {}};
  Scene smooth = read_scene(folder() + "six_inertia_chain.toml", all_kinds()), step = smooth;
  smooth.run.start.equilibrium = true;
  const Scene press = read_scene(folder() + "crank_press.toml", all_kinds());
  const std::pair<const char*, const Scene*> cases[] = {{"chain E1 started in balance (smooth torques)", &smooth},
                                                        {"chain E1 from rest (step torque)", &step},
                                                        {"press (load edges that ring)", &press}};
  for (const auto& [name, scene] : cases) {
    double first = 0;
    for (const double factor : {1.0, 10.0, 100.0, 1000.0}) {
      const Scene stiff = stiffened(*scene, factor);
      const auto model = compile(stiff, stiff.effects);
      const TimedRun t = timed(5, [&] { return bare_run(model, 1e-7); });
      if (first == 0) first = t.median_seconds;
      table.rows.push_back({name, fmt::format("{:g}", factor), fmt::format("{:.3g}", 1e3 * t.median_seconds),
                            fmt::format("{:.2f}", t.median_seconds / first),
                            fmt::format("{}", t.outcome.statistics.stepper.steps), t.outcome.statistics.method});
    }
  }
  book.tables.push_back(table);
}

}  // namespace

void costs_of_effects(BenchBook& book) {
  switched(book);
  rigid_limit(book);
}

}  // namespace kurbel::bench
