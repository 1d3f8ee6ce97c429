// counts_bench.cpp — is what is off free? Instructions of right-hand side and Jacobian with an effect off, against the
// same scene written without it; and what joint friction costs where it is on.
#include <fmt/format.h>

#include <filesystem>

#include "bench/benches.h"
#include "bench/instruction_counts.h"
#include "bench/machines.h"

namespace kurbel::bench {
namespace {

// What joint friction costs a whole run: its own evaluations, and the steps that it asks for.
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
      if (flag.unsaid == EffectFlag::Unsaid::part_of_machine || !has_parameters(scene, flag)) continue;
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
