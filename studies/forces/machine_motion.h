// machine_motion.h — motion of the second problem: how the compiled machine moves the crank in its steady cycle.
//
// The machine is the scene's, with its effects; the cycle is its steady motion (engine/orbit/orbit.h) after the
// scene's own start, or the last one before it comes to rest. If nothing repeats, the last whole cycle of the scene's
// run is used instead, and the expected change of the following cycles is an error of every figure.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/orbit/moment.h"
#include "engine/orbit/orbit.h"
#include "studies/forces/crank_motion.h"
#include "studies/forces/deformed_mechanism.h"

namespace kurbel {

struct SimulatedMotion {
  // Another motion, for the uncertainty of the figures: `times` the difference of both.
  struct Other {
    MotionAlong motion;
    double times = 1;
  };
  MotionAlong along;
  std::vector<MachineForces> machine;  // at each abscissa, by the machine's own equations
  std::vector<Other> others;
  std::vector<std::string> outside_data;  // extrapolation of tables
  bool kept = false;                      // it is the machine's steady motion
  bool deforms = false;                   // the mechanism deforms
  std::string effects;                    // of the machine, in words
  std::string description;
};

// The compiled machine, for the motion of a mechanism's crank.
class MachineMotion {
 public:
  MachineMotion(const AskedMechanism& asked, const Effects& effects, const ForcesOptions& options);

  double start_speed() const;  // of the crank [rad/s]
  double rated_speed() const;
  const Model& model() const { return *model_; }
  bool deforms() const;     // joint clearance or bending rod
  bool is_elastic() const;  // twisting shafts
  // Errors and unsteady motion are reported in `notes`. Empty if the crank completes no cycle.
  struct Account {
    std::vector<std::string>& notes;
    bool& complete;
    std::string& diagnosis;
  };
  std::optional<SimulatedMotion> solve(OutputLoads& loads, Account out) const;

 private:
  struct Crank {
    int node = 0;
    std::size_t tracked = 0;
    double phase = 0;
  };
  struct WholeRun;
  struct Sampled;
  struct Window;
  static Crank crank_in(const Model& model, const std::string& component);
  MachineMotion(std::shared_ptr<const Model> model, const std::string& mechanism, const ForcesOptions& options,
                const Moment& at);
  std::shared_ptr<const Model> model_elsewhere() const;
  OrbitOptions search_options() const;
  Orbit orbit() const;
  bool is_driven() const;
  std::optional<SimulatedMotion> motion_of(const Orbit& found, OutputLoads& loads, Account out) const;
  std::optional<SimulatedMotion> kept_motion(OutputLoads& loads, const Orbit& orbit, std::string& why_not) const;
  Window period_of(const ReturnMap& map, const Eigen::VectorXd& z, double tolerance, double cycle) const;
  Sampled along_period(OutputLoads& loads, const ReturnMap& map, const Eigen::VectorXd& z, double tolerance) const;
  std::optional<SimulatedMotion> last_cycle(OutputLoads& loads, const std::string& why, Account out) const;
  Sampled one_run(const std::vector<Abscissa>& where, double cycle, double origin, int direction,
                  double tolerance) const;
  std::vector<double> targets_of(const std::vector<Abscissa>& where, double origin) const;
  RunOptions run_options(double tolerance) const;
  WholeRun whole_run(double tolerance) const;
  double angle_in(const Equations& equations, std::span<const double> y) const {
    return equations.angle_with_turns(crank_.tracked, y) + crank_.phase;
  }

  const ForcesOptions& options_;
  Moment at_;  // of the model
  std::string mechanism_;
  RunSettings settings_;
  std::string effects_;
  std::shared_ptr<const Model> model_;
  Crank crank_;
  DeformedMechanism forces_;
};

// The same machine without elasticity, drawn behind it. Empty if the machine is rigid itself, or if no rigid machine
// can be made or its crank completes no cycle.
std::optional<MotionAlong> rigid_motion(const AskedMechanism& asked, const Effects& effects, OutputLoads& loads,
                                        const ForcesOptions& options);

// Crank speed of the first problem, and its source.
struct CrankSpeed {
  double value = 0;  // [rad/s]
  std::string source;
  bool assumed = false;  // neither requested nor from the scene
};
CrankSpeed prescribed_speed(const MachineMotion& machine, const ForcesOptions& options);

// Sets the names of scene and mechanism.
void describe(const AskedMechanism& asked, Forces& out);
// Description of the first problem, and notes on what it omits.
void describe_first(const CrankSpeed& speed, const OutputLoads& loads, const MachineMotion& machine, Forces& out,
                    ForceCycle& cycle);

}  // namespace kurbel
