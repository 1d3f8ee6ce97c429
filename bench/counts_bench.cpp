// counts_bench.cpp — is what is off free? Instructions of right-hand side and Jacobian with an effect off, against the
// same scene written without it; and what joint friction costs where it is on.
#include <fmt/format.h>

#include <filesystem>

#include "bench/benches.h"
#include "bench/instruction_counts.h"
#include "bench/machines.h"

namespace kurbel::bench {
namespace {

// What joint friction costs a whole run: its own evaluations, and the steps that it requires.
Table cost_of_joint_friction(const std::string& counter) {
  Table table{.title = "Instructions of a bare run at 1e-7, joint friction on : off, counted by callgrind",
              .columns = {"scene", "method", "off", "on", "on : off"},
              .rows = {}};
  const std::string source = KURBEL_SOURCE_DIR;
  for (const char* scene : {"bench/scenes/press_with_everything", "tests/agreement/joint_friction_rigid"})
    for (const char* method : {"dop853", "esdirk", "bdf"}) {
      const auto count = [&](const std::string& how) {
        return counted_instructions(counter, source + "/" + scene + ".toml", "joint_friction", how + method);
      };
      const auto off = count("run-off:"), on = count("run-on:");
      if (off && on)
        table.rows.push_back({scene, method, fmt::format("{}", *off), fmt::format("{}", *on),
                              fmt::format("{:.3g} ×", static_cast<double>(*on) / static_cast<double>(*off))});
    }
  return table;
}

}  // namespace

// Of the scenes as they stand: what a structural change must not make dearer.
Table counts_of_single_machines(const std::string& counter) {
  Table table{
      .title = "Instructions of one right-hand side, one Jacobian, one step of dop853 at 1e-7, counted by callgrind",
      .columns = {"scene", "right-hand side", "Jacobian", "step"},
      .rows = {}};
  if (!callgrind_is_installed()) {
    table.title += ": valgrind is not installed";
    return table;
  }
  const std::string source = KURBEL_SOURCE_DIR;
  for (const char* scene :
       {"free_slider_crank", "driven_slider_crank", "six_inertia_chain", "crank_press", "piston_pump", "scotch_yoke",
        "stick_slip", "planetary_brake", "diesel_generator", "belt_mill"}) {
    const std::string file = source + "/scenes/" + scene + ".toml";
    const auto each = [&](const char* how, double times) {
      const auto count = counted_instructions(counter, file, "-", how);
      return count ? fmt::format("{:.0f}", static_cast<double>(*count) / times) : std::string("—");
    };
    constexpr double evaluations = 50;
    table.rows.push_back({scene, each("flow", evaluations), each("jacobian", evaluations),
                          each("run:dop853", steps_of_run(counter, file, "run:dop853"))});
  }
  return table;
}

void counts_of_instructions(BenchBook& book, const std::string& counter) {
  Table table{.title = "Instructions of 50 right-hand sides and Jacobians, counted by callgrind",
              .columns = {"scene", "effect off", "switched off", "never written", "difference"},
              .rows = {}};
  if (!callgrind_is_installed()) {
    table.title += ": valgrind is not installed";
    book.tables.push_back(table);
    return;
  }
  const std::string source = KURBEL_SOURCE_DIR;
  std::vector<std::string> scenes = {source + "/bench/scenes/press_with_everything.toml"};
  for (const auto& entry : std::filesystem::directory_iterator(source + "/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path().string());
  std::sort(scenes.begin(), scenes.end());
  for (const std::string& file : scenes) {
    const Scene scene = read_scene(file, all_kinds());
    for (const EffectFlag& flag : effect_flags()) {
      if (flag.is_usual() || !has_parameters(scene, flag)) continue;
      if (flag.flag == &Effects::multibody) continue;  // any mechanism gives it its parameters
      const auto off = counted_instructions(counter, file, flag.name, "off"),
                 without = counted_instructions(counter, file, flag.name, "without");
      const auto text = [](const std::optional<long>& n) { return n ? fmt::format("{}", *n) : std::string("—"); };
      table.rows.push_back({std::filesystem::path(file).stem().string(), flag.words, text(off), text(without),
                            off && without ? fmt::format("{}", *off - *without) : "a component that is the effect"});
    }
  }
  book.tables.push_back(table);
  book.tables.push_back(cost_of_joint_friction(counter));
}

}  // namespace kurbel::bench
