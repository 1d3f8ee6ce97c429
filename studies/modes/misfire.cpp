// misfire.cpp — the same drive as one cylinder after the other does not fire: no injection, but compression.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "engine/scene/messages.h"
#include "studies/modes/modes.h"

namespace kurbel {
namespace {

// The cylinder's name, and the scene in which it does not fire.
struct Misfiring {
  std::string name;
  Scene scene;
};

bool misfires(const Section& section) {
  return std::any_of(section.settings.begin(), section.settings.end(), [](const Setting& s) {
    return (s.key == "misfire" && (s.flag || !s.numbers.empty())) ||
           std::any_of(s.sections.begin(), s.sections.end(), misfires);
  });
}

// That of a compressor is told over the angle, too, and does not drive.
bool is_fired(const Section& load) {
  return load.has("misfire") && load.has("work") && load.text("work") == "driving" &&
         std::any_of(load.settings.begin(), load.settings.end(),
                     [](const Setting& s) { return s.curve.over == "angle"; });
}

// Of an engine by its firing order: each of its numbers.
void add_engine(const Scene& scene, std::size_t component, std::vector<Misfiring>& out) {
  const Section& engine = scene.components[component];
  std::vector<double> numbers = engine["firing_order"].numbers;
  if (numbers.size() < 2) return;
  std::sort(numbers.begin(), numbers.end());
  for (const double number : numbers) {
    Misfiring& made = out.emplace_back(Misfiring{fmt::format("cylinder {:g} of {}", number, engine.name), scene});
    std::vector<Setting>& settings = made.scene.components[component].settings;
    std::erase_if(settings, [](const Setting& s) { return s.key == "misfire"; });
    Setting misfire;
    misfire.key = "misfire", misfire.at = engine.at, misfire.given = true, misfire.numbers = {number};
    settings.push_back(std::move(misfire));
  }
}

// Of a mechanism: its load, where that is a driving diagram over the angle.
void add_mechanism(const Scene& scene, std::size_t component, std::vector<Misfiring>& out) {
  const Section& mechanism = scene.components[component];
  for (std::size_t s = 0; s < mechanism.settings.size(); ++s)
    for (std::size_t k = 0; k < mechanism.settings[s].sections.size(); ++k) {
      if (!is_fired(mechanism.settings[s].sections[k])) continue;
      Misfiring& made = out.emplace_back(Misfiring{mechanism.name, scene});
      for (Setting& setting : made.scene.components[component].settings[s].sections[k].settings)
        if (setting.key == "misfire") setting.flag = setting.given = true;
    }
}

std::vector<Misfiring> misfiring(const Scene& scene) {
  std::vector<Misfiring> cases;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (scene.components[i].has("firing_order") && scene.components[i].kind->name == "engine")
      add_engine(scene, i, cases);
    else
      add_mechanism(scene, i, cases);
  }
  return cases;
}

}  // namespace

ShaftStresses stresses_of_sweep(const ModesStudy& study) {
  return {.joints = study.limited,
          .normal = {"", study.sweep, study.barred, study.excitations.fundamental},
          .misfires = {},
          .link = study.link,
          .unit = study.speed_unit};
}

std::vector<Firing> find_misfires(const Scene& scene, const Effects& effects, const ModesOptions& options,
                                  const ModesStudy& normal, std::vector<std::string>& notes) {
  std::vector<Firing> found;
  if (std::any_of(scene.components.begin(), scene.components.end(), misfires)) return found;
  const std::vector<Misfiring> cases = misfiring(scene);
  if (cases.size() < 2) return found;
  ModesOptions same = options;
  same.speed = normal.drive.at.speed;
  same.slowest = normal.slowest, same.fastest = normal.fastest;
  same.spot_checks = 0, same.spots.clear(), same.torque.clear();
  same.response_alone = true;
  same.start = !normal.start_unknown;
  same.watch.progress = {};
  for (const Misfiring& one : cases) {
    if (options.watch.stopped()) break;
    options.watch.say("as " + one.name + " misfires");
    try {
      ModesStudy study = find_modes(one.scene, effects, same);
      found.push_back({one.name, std::move(study.sweep), std::move(study.barred), study.excitations.fundamental});
    } catch (const SceneError&) {
      notes.push_back(fmt::format("{} cannot misfire in this scene: its load needs \"motored\"", one.name));
    }
  }
  return found;
}

}  // namespace kurbel
