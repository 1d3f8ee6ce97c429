// gears.cpp — collects the pairs of wheels of a scene.
#include "studies/gears/gears.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drivetrain/gears/gear_keys.h"
#include "engine/model/model.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

GearStage stage_of(const std::string& name, GearPair pair, std::optional<double> speed) {
  GearStage stage{.name = name, .pair = std::move(pair), .stiffness = {}, .verdicts = {}, .speed = speed, .moved = {}};
  stage.stiffness = mesh_stiffness(stage.pair);
  stage.verdicts = verdicts(stage.pair);
  stage.moved = moved(stage.pair);
  return stage;
}

// The stages of one gearbox; the speed is transmitted from stage to stage.
void add_gearbox(const std::string& gearbox, const GearStages& given, std::optional<double> speed, Gears& gears,
                 std::vector<std::string>& without_module) {
  for (std::size_t k = 0; k < given.stages.size(); ++k) {
    const std::string name = fmt::format("{}.stage{}", gearbox, k + 1);
    const auto& [teeth, pair] = given.stages[k];
    if (pair)
      gears.stages.push_back(stage_of(name, *pair, speed));
    else
      without_module.push_back(name);
    if (speed) *speed *= teeth[0] / teeth[1];
  }
}

bool wanted(const std::string& stage, const std::string& pair) {
  return pair.empty() || stage == pair || stage.starts_with(pair + ".");
}

}  // namespace

Gears find_gears(const Scene& scene, const GearsOptions& options) {
  Gears gears;
  gears.is_of(scene);
  std::vector<std::string> without_module;
  const Network network = build_network(scene);
  for (const auto& [gearbox, given] : network.data.all<GearStages>())
    add_gearbox(gearbox, given, options.speed, gears, without_module);
  std::vector<std::string> names;
  for (const GearStage& stage : gears.stages) names.push_back(stage.name);
  if (names.empty())
    throw std::invalid_argument(
        fmt::format("{}: no gearbox stage has its module given; write e.g. {{ teeth = [19, 95], module = \"4 mm\", "
                    "width = \"40 mm\" }}{}",
                    scene.file, without_module.empty() ? "" : fmt::format(" for {}", listed(without_module, "and"))));
  std::erase_if(gears.stages, [&](const GearStage& stage) { return !wanted(stage.name, options.pair); });
  if (gears.stages.empty()) {
    throw std::invalid_argument(fmt::format("--pair {}: no such pair{}; allowed: {}", in_quotes(options.pair),
                                            suggestion(options.pair, names), listed(names)));
  }
  for (const std::string& name : without_module)
    if (wanted(name, options.pair)) gears.notes.push_back(fmt::format("{}: omitted, its module is not given.", name));
  return gears;
}

Gears single_pair(const GearPairData& data, std::optional<double> speed) {
  Gears gears;
  gears.title = "Gear pair";
  gears.stages.push_back(stage_of("pair", solve_gear_pair(data), speed));
  return gears;
}

double stiffness_error(const MeshStiffness& stiffness, double value) {
  constexpr double by_the_standard = 0.08;
  return stiffness.within ? by_the_standard * std::abs(value) : std::numeric_limits<double>::quiet_NaN();
}

double inertia_error(const GearStage& stage, std::size_t wheel) {
  const MeshedWheel& w = stage.pair.wheel[wheel];
  if (!(w.width > 0)) return 0;
  const double finer = wheel_inertia(w, w.width, stage.pair.data.density, w.bore, 2 * outline_points_of_inertia);
  return 2 * std::abs(finer - w.inertia) +
         stage.error_of([wheel](const GearPair& p) { return p.wheel[wheel].inertia; });
}

double backlash_error(const GearStage& stage, const std::function<double(const GearPair&)>& get) {
  GearPair least = stage.pair;
  least.backlash_arc = 1e-12 * stage.pair.data.module;
  least.backlash_normal = least.backlash_arc;
  return stage.error_of(get) + (stage.pair.backlash_arc == 0 ? std::abs(get(least)) : 0);
}

Finding worst_of(const GearStage& stage) {
  Finding worst = Finding::good;
  for (const GearVerdict& v : stage.verdicts) worst = std::max(worst, v.finding);
  return worst;
}

}  // namespace kurbel
