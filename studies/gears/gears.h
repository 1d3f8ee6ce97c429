// gears.h — the gear pairs of a scene, or one alone: geometry, verdicts, and what they give to the drive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivetrain/gears/gear_pair.h"
#include "engine/scene/scene.h"
#include "studies/findings/output.h"

namespace kurbel {

struct GearStage {
  std::string name;  // "gearbox.stage1"
  GearPair pair;
  MeshStiffness stiffness;
  std::vector<GearVerdict> verdicts;
  std::optional<double> speed = {};  // of wheel 1 [rad/s]
};

struct Gears {
  std::string title, scene_file, scene_text;
  std::vector<GearStage> stages;
  std::vector<std::string> notes;
};

struct GearsOptions {
  std::string pair;                  // "gearbox.stage1", or a gearbox; empty: all
  std::optional<double> speed = {};  // of the first wheel of each gearbox [rad/s]
};

// Every stage of the scene's gearboxes whose module is given. Throws std::invalid_argument in words where there is
// none, or none of that name.
Gears find_gears(const Scene& scene, const GearsOptions& options);

// A pair without a scene. Throws std::invalid_argument.
Gears single_pair(const GearPairData& data, std::optional<double> speed = {});

// Worst finding of a stage.
Finding worst_of(const GearStage& stage);

// Files: STAGE.path.csv, STAGE.wheel1.csv, STAGE.wheel2.csv. The gears must outlive the findings.
Findings findings_of(const Gears& gears);

}  // namespace kurbel
