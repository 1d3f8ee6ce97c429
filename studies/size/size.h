// size.h — flywheel for a demanded δ: by Wittenbauer, Mertsalov and without I_em; with the actual motor; by steady motion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/cycle/classical.h"
#include "studies/cycle/machine_cycle.h"
#include "studies/findings/output.h"
#include "studies/run/simulate.h"
#include "studies/size/flywheel.h"
#include "studies/size/sized_orbits.h"

namespace kurbel {

struct SizeOptions {
  std::optional<CycleBasis> basis;  // of the loads, at constant drive torque; default: as for MachineOnBasis
  std::optional<double> delta;      // demanded, 0 < δ < 2
  std::string machine;              // or the customary value for a machine: "press" (the upper end of the range)
  std::optional<double> mid_speed;  // of the reduction link [rad/s]; default: the operating speed
  Moment at = {};                   // state of the machine at that moment; default: after all switching
  std::string flywheel;             // component to be sized; default: the scene's only flywheel, else one on the crank
  FlywheelForm form = FlywheelForm::rim;
  std::string material = "grey cast iron";
  double diameter = 0, rim_speed = 0;    // [m], [m/s]; 0: by proportion, by the material
  std::optional<double> diagram_length;  // length of the diagrams' angle axis [m]
  bool simulate = true;                  // find the steady motion of the sized machine
  SimulateOptions simulation = {};
};

// Result of one sizing method.
struct SizeMethod {
  std::string name;
  double drive_inertia = 0;      // I₀, on the reduction link [kg·m²]
  Estimate flywheel = {};        // minus all other parts that turn at constant ratio, on its own shaft [kg·m²]
  double flywheel_by_parts = 0;  // (theory 3.1)
  // Resulting δ at constant driving torque, exact, or in the steady motion; empty: the machine would stop.
  std::optional<double> delta;
  bool none_needed = false;  // δ is smaller than demanded without any flywheel
};

// Model of the machine with the sized flywheel.
enum class SizedModel { work_equation, rigid, elastic };
constexpr const char* name_of(SizedModel model) {
  return model == SizedModel::work_equation ? "rigid, work equation"
         : model == SizedModel::rigid       ? "rigid, simulated"
                                            : "elastic, simulated";
}
// Sizing method: constant driving torque, with the motor's slope, or by δ of the steady motion.
enum class SizedBy { constant_drive, slope, steady_motion };

// The sized machine with its actual motor, in steady motion.
struct DeltaReached : SizedCycle {
  SizedModel model = SizedModel::work_equation;
  SizedBy by = SizedBy::constant_drive;
  std::string sized_by;  // name of that method
};

struct Sizing : SceneStudy {
  std::string link;
  double delta = 0;
  std::string delta_source;
  double mid_speed = 0;
  std::string mid_speed_source;
  CycleBasis basis = CycleBasis::classical;

  MachineCycle cycle;
  WorkDiagram diagram;
  Estimate fluctuation;   // of energy, in the diagram [J]
  bool held = false;      // mid speed held by a torque added to the drive: its own start leads to no cycle
  bool estimate = false;  // effects omitted by the rigid machine at constant speed are not included: no error is given
  bool engine = false;    // the drive varies with the angle, the load is chosen to balance it
  Wittenbauer exact;
  Mertsalov approximate;
  std::vector<SizeMethod> methods;  // Wittenbauer, Mertsalov, without I_em

  std::string flywheel;                                              // component
  bool link_is_crank = true;                                         // else it turns without a mechanism
  bool flywheel_added = false;                                       // the scene has none
  double flywheel_ratio = 1;                                         // its speed over the link's
  double flywheel_now = 0;                                           // in the scene, on its own shaft [kg·m²]
  double motor_inertia = 0, gearbox_inertia = 0, other_inertia = 0;  // on the flywheel's shaft [kg·m²]
  std::vector<std::pair<std::string, double>> other_parts;           // on the flywheel's shaft
  double delta_now = 0;                  // of the given scene, at constant driving torque; NaN: it stops
  std::optional<double> delta_of_orbit;  // of the given scene with its effects; if the basis is the steady motion
  bool needed = true;                    // a flywheel with I > 0

  // With the motor's slope.
  std::string motor;  // first driving component; empty: none
  std::optional<OperatingSpeed> operating;
  std::optional<SizedOrbit> with_motor;  // rigid, with Wittenbauer's flywheel; empty: no motion was found
  bool stalls = false;                   // with that flywheel it comes to rest
  std::optional<SizeMethod> soft;        // inertia whose steady motion, rigid, has this δ, or none is needed
  double soft_speed = 0;                 // its mid speed [rad/s]
  std::string soft_why;                  // reason if there is none

  // The inertia whose steady motion has the demanded δ, if the flywheel by the work equation misses it.
  std::optional<SizeMethod> meeting;
  std::string meeting_words;  // the δ reached, or the least δ found; empty: no search

  // The result: the flywheel that meets δ with the scene's effects, else that by the work equation.
  const SizeMethod& chosen() const { return meeting ? *meeting : methods.front(); }

  std::optional<FlywheelDimensions> dimensions;  // of the chosen one
  Estimate mass;                                 // of these [kg]
  std::string dimensions_why;
  std::optional<PunchPress> punch;  // for loads that act during a part of the cycle only
  std::vector<DeltaReached> reached;
  std::optional<double> diagram_length;
};

// Throws SceneError if no machine can be made; std::invalid_argument with the reason for bad options, a load without
// net resistance, a motor too weak for the cycle, and a machine whose own start leads to no cycle.
Sizing size_flywheel(const Scene& scene, const SizeOptions& options);

// Source of the speed dependence of torque at the operating point: "the motor's slope", "the load's slope".
std::string slope_of_what(const Sizing& sizing);

// Files: diagrams.csv. The sizing must outlive the findings.
Findings findings_of(const Sizing& sizing);

}  // namespace kurbel
