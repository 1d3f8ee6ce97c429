// machine_motion.h — the second problem's motion: how the compiled machine moves the crank in the cycle that it keeps.
//
// The machine is the scene's, with its effects, and the cycle that of its steady motion (engine/orbit/orbit.h): where the
// scene's own start leads to; of a machine that rests in the end, the last one that it keeps before. Where nothing comes again, the last whole cycle of the scene's run stands in for it, and by
// how much its next cycles would differ is an error of every figure.
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
  // Another motion, by which the figures of this one are uncertain: `times` the difference of the two.
  struct Other {
    MotionAlong motion;
    double times = 1;
  };
  MotionAlong along;
  std::vector<MachineForces> machine;  // at each of its abscissae, by the machine's own equations
  std::vector<Other> others;
  std::vector<std::string> outside_data;  // what it takes from beyond the ends of tables
  bool kept = false;                      // by the machine: its steady motion
  bool deforms = false;                   // the mechanism does
  std::string effects;                    // of the machine, in words
  std::string description;
};

// The compiled machine, asked for the motion of a mechanism's crank.
class MachineMotion {
 public:
  MachineMotion(const AskedMechanism& asked, const Effects& effects, const ForcesOptions& options);

  double start_speed() const;  // of the crank [rad/s]
  double rated_speed() const;
  const Model& model() const { return *model_; }
  bool deforms() const;     // its joints have clearance, or its rod bends
  bool is_elastic() const;  // its shafts twist
  // What went wrong and what is not steady is told in `notes`. Empty where the crank goes through no whole cycle.
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
  Window round_of(const ReturnMap& map, const Eigen::VectorXd& z, double tolerance, double cycle) const;
  Sampled along_round(OutputLoads& loads, const ReturnMap& map, const Eigen::VectorXd& z, double tolerance) const;
  std::optional<SimulatedMotion> last_cycle(OutputLoads& loads, const std::string& why, Account out) const;
  Sampled one_run(const std::vector<Abscissa>& where, double cycle, double origin, int direction,
                  double tolerance) const;
  std::vector<double> targets_of(const std::vector<Abscissa>& where, double origin) const;
  RunOptions run_options(double tolerance) const;
  WholeRun whole_run(double tolerance) const;
  double angle_in(const Equations& equations, std::span<const double> y) const {
    return equations.angle_with_turns(crank_.tracked, y) + crank_.phase;
  }
  void check_sense(const MotionAlong& along, int direction) const;

  const ForcesOptions& options_;
  Moment at_;  // that the model is of
  std::string mechanism_;
  RunSettings settings_;
  std::string effects_;
  std::shared_ptr<const Model> model_;
  Crank crank_;
  DeformedMechanism forces_;
};

// Of the same machine without elasticity, to be drawn behind it. Empty where the machine is rigid itself, or where the
// rigid one makes no machine or turns the crank through no whole cycle.
std::optional<MotionAlong> rigid_motion(const AskedMechanism& asked, const Effects& effects, OutputLoads& loads,
                                        const ForcesOptions& options);

// What a quantity that is looked at once a cycle has still to change, from its course so far: the change over the last
// quarter of it, going on as a geometric sequence with the ratio q to the quarter before: d q/(1 − q); swinging,
// q < 0: |d|. ∞ where the changes do not shrink (a runaway at any rate: q = 1), 0 where they are below `noise`.
double still_to_come(const std::vector<double>& course, double noise);

// Of the first problem, and where it comes from.
struct CrankSpeed {
  double value = 0;  // [rad/s]
  std::string source;
};
CrankSpeed prescribed_speed(const MachineMotion& machine, const ForcesOptions& options);

// Names scene and mechanism.
void describe(const AskedMechanism& asked, Forces& out);
// How the first problem was posed, and notes on what it leaves out.
void describe_first(const CrankSpeed& speed, const OutputLoads& loads, const MachineMotion& machine, Forces& out,
                    ForceCycle& cycle);

}  // namespace kurbel
