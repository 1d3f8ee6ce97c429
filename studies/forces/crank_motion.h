// crank_motion.h — along which motion forces are found: where the cycle is looked at, the loads there, the motion given
// or simulated, peaks on the continuous motion.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/rigid/rigid_machine.h"
#include "engine/run/run.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "studies/forces/forces.h"

namespace kurbel {

// The loads on a mechanism's output, from its own element on a shaft of its own: angle and speed are the crank's.
class OutputLoads {
 public:
  OutputLoads(const Scene& scene, const std::string& component);
  const Model& model() const { return machine_.model(); }
  double cycle() const { return machine_.cycle(); }
  std::vector<double> edges(int direction) { return machine_.edges(direction); }

  // Sum of all forces along +x [N], or of all torques on an output that rocks [N·m].
  double force(double phi, double omega);
  // Of each of model().accounts, reduced to the crank [N·m]; omega ≠ 0.
  std::span<const double> shares(double phi, double omega);

 private:
  explicit OutputLoads(const std::shared_ptr<const Model>& model) : machine_(model), equations_(model, false) {}

  RigidMachine machine_;
  Equations equations_;
  int channel_ = -1;
};

// The element by which a mechanism works on its shaft.
const Network::ShaftElement& mechanism_element(const Network& network, const std::string& component);

inline constexpr double beside = 1e-9;  // rad: samples on either side of a load edge

// An angle of the crank that is looked at.
struct Abscissa {
  double phi = 0;
  double weight = 0;  // of the integral over the cycle
  bool grid = false;  // one of the even positions that curves and orders are made of
  bool row = false;   // one of the positions asked for; alone, it takes no part in anything else
};
// The same for any number of rows: an even grid, Gauss' three points between its points and the load edges, a point on
// either side of each edge; and the rows.
std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int rows_of_turn);

struct CrankMotion {
  double omega = 0, alpha = 0;  // [rad/s], [rad/s²]
};

struct MotionSample {
  double phi = 0;
  CrankMotion motion;
};
// Motion between samples that ascend by angle.
CrankMotion motion_between(const std::vector<MotionSample>& samples, double phi);

// The largest magnitude of a function of the crank's angle. Local peaks of the samples near the largest one are
// refined by the golden section between their neighbours, so that the peak is one of the function, not of the samples;
// at an edge the samples stand on either side of it. Of equal peaks (a crank's two strokes) the first one counts,
// however rounding decides between them.
Peak peak_of(const std::vector<double>& phi, const std::vector<double>& values,
             const std::function<double(double)>& value);
// The same with what a search through every other sample finds otherwise, and rounding of `scale`, as its error.
Peak measured_peak_of(const std::vector<double>& phi, const std::vector<double>& values,
                      const std::function<double(double)>& value, double scale);
// Of a search by golden section and of sums of terms: of the largest force or moment.
inline constexpr double rounding_of_forces = 1e-12;

// The mechanism that was asked for, or the first; throws std::invalid_argument naming those there are.
const Section& chosen_mechanism(const Scene& scene, const std::string& wanted);

MechanismData mechanism_data(const Scene& scene, const std::string& component);
// Throws std::invalid_argument for senseless ones.
void check(const ForcesOptions& options);

// A cycle of the crank at the abscissae, in the order of time.
struct MotionAlong {
  double cycle = 0;  // [rad]
  std::vector<Abscissa> where;
  std::vector<CrankMotion> motion;
  std::optional<double> speed_before;  // one cycle before its begin, where the run has it

  double mean_speed() const;  // by time
};
struct SimulatedMotion {
  MotionAlong loose, tight;  // tolerances 30 : 1
  std::string description;
};

// The rigid machine as its torques drive it, for the mechanism's last whole cycle.
class MachineMotion {
 public:
  MachineMotion(const Scene& scene, const Effects& effects, const std::string& component, const ForcesOptions& options);

  double start_speed() const;  // of the crank [rad/s]
  double rated_speed() const;
  // What went wrong and what is not steady is told in `notes`. Empty where the run holds no whole cycle.
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
  static Crank crank_in(const Model& model, const std::string& component);
  RunOptions run_options(double tolerance) const;
  WholeRun whole_run(double tolerance) const;
  MotionAlong one_run(OutputLoads& loads, double origin, int direction, double tolerance, bool cycle_before) const;
  static void note_unsteady(const SimulatedMotion& motion, std::vector<std::string>& notes);

  const ForcesOptions& options_;
  RunSettings settings_;
  std::shared_ptr<const Model> model_;
  Crank crank_;
};

// Of the first problem, and where it comes from.
struct CrankSpeed {
  double value = 0;  // [rad/s]
  std::string source;
};
CrankSpeed prescribed_speed(const MachineMotion& machine, const ForcesOptions& options);
// At that speed throughout.
MotionAlong steady_motion(OutputLoads& loads, double speed, int positions);

}  // namespace kurbel
