// gears.h — the gear pairs of a scene, or a single pair: geometry, verdicts, and parameters for the drive.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivetrain/gears/gear_pair.h"
#include "engine/scene/scene.h"
#include "studies/findings/output.h"
#include "studies/gears/figure_errors.h"

namespace kurbel {

struct GearStage {
  std::string name;  // "gearbox.stage1"
  GearPair pair;
  MeshStiffness stiffness;
  std::vector<GearVerdict> verdicts;
  std::optional<double> speed = {};  // of wheel 1 [rad/s]
  Moved<GearPair> moved = {};        // for the errors of its figures

  // Rounding error of a figure of the pair, in its unit; NaN: not known.
  template <class Get>
  double error_of(Get get, double terms = 0) const {
    return error_by_rounding(pair, moved, get, terms);
  }
};

// Error of the stiffness after ISO 6336-1 B: −8 % … +5 % for loads of 100 … 1600 N/mm (as quoted; the standard itself
// was not available), within the range of the method; otherwise unknown (NaN).
double stiffness_error(const MeshStiffness& stiffness, double value);
// Error of a wheel's moment of inertia computed from a polygonal outline: twice the change when the number of
// segments is doubled, plus rounding.
double inertia_error(const GearStage& stage, std::size_t wheel);
// Of j_bn, j_wt and derived values: values below 10⁻¹² modules are reported as zero.
double backlash_error(const GearStage& stage, const std::function<double(const GearPair&)>& get);

struct Gears : SceneStudy {
  std::vector<GearStage> stages;
};

struct GearsOptions {
  std::string pair;                  // "gearbox.stage1", or a gearbox; empty: all
  std::optional<double> speed = {};  // of the first wheel of each gearbox [rad/s]
};

// Every stage of the scene's gearboxes whose module is given. Throws std::invalid_argument with the reason if there
// is none, or none of that name.
Gears find_gears(const Scene& scene, const GearsOptions& options);

// A pair without a scene. Throws std::invalid_argument.
Gears single_pair(const GearPairData& data, std::optional<double> speed = {});

// Worst finding of a stage.
Finding worst_of(const GearStage& stage);

// Files: STAGE.path.csv, STAGE.wheel1.csv, STAGE.wheel2.csv. The gears must outlive the findings.
Findings findings_of(const Gears& gears);

}  // namespace kurbel
