// crank_motion.h — the motion for which forces are computed: crank angles of the cycle, the loads there, peaks of the
// continuous motion.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/rigid/rigid_machine.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "studies/forces/forces.h"

namespace kurbel {

// Loads that act on this element of a machine at an instant.
ActingLoads acting_loads(const Model& model, std::size_t element, const Instant& now);

struct LinkageState;
struct Mechanism;

// A mechanism of a scene and its network, as described: before any effect, with its tables as given.
struct AskedMechanism {
  // The mechanism of this name, or the first. Throws as chosen_mechanism and build_network.
  AskedMechanism(const Scene& scene, const std::string& wanted);
  const Mechanism& mechanism() const;

  const Scene& scene;
  std::string name, kind;
  Network network;
};

struct CrankMotion {
  double omega = 0, alpha = 0;  // [rad/s], [rad/s²]
  ActingLoads loads = {};
};

// The loads on a mechanism's output, from its element alone on one shaft: angle and speed are the crank's.
class OutputLoads {
 public:
  // Only effects that are part of the machine are used.
  OutputLoads(const AskedMechanism& asked, const Effects& effects, const std::optional<AngleRange>& range);
  const Model& model() const { return machine_.model(); }
  double cycle() const { return machine_.cycle(); }
  double begin() const { return machine_.begin(); }
  bool repeats() const { return !machine_.has_range(); }
  // Angles within the cycle where forces have jumps or kinks: edges of the loads, and those added for a turn.
  std::vector<double> edges(int direction);
  void add_edges(const std::vector<double>& of_a_turn) { added_ = of_a_turn; }

  // Loads at the end of the operating sequence; for a repeating sequence they change, and all count here.
  const ActingLoads& left() const { return left_; }
  // The sentence about this for the report; empty: all act.
  std::string words_of_sequence() const;
  // Sum of all forces along +x [N], or of all torques on a rocking output [N·m].
  double force(double phi, const CrankMotion& motion) const;
  // The state of a linkage's bodies at φ, with this sum and the loads within the linkage.
  LinkageState state(double phi, const CrankMotion& motion, const PlanarLinkage& at) const;
  // Extrapolation of tables of the acting loads while the crank turns at this speed [rad/s]. One sentence each.
  std::vector<std::string> outside_data(double speed);
  // Of each of model().accounts, reduced to the crank [N·m]; omega ≠ 0.
  std::span<const double> shares(double phi, const CrankMotion& motion);

 private:
  RigidMachine machine_;
  // Angle within one cycle; both ends are unchanged.
  double within(double phi) const {
    return machine_.has_range() || phi <= cycle() * (1 + 1e-12)
               ? phi
               : phi - cycle() * std::ceil(phi / cycle() * (1 - 1e-12) - 1);
  }

  const Mechanism& mechanism_;            // of that machine
  std::vector<const Mechanism*> within_;  // elements within it, if it is a linkage
  ActingLoads left_;
  bool repeats_ = false;         // the sequence repeats and sets loads
  std::vector<int> of_account_;  // load of each account; −1: none
  std::vector<double> acting_;
  std::vector<double> added_;
};

// The element through which a mechanism acts on its shaft.
const Network::ShaftElement& mechanism_element(const Network& network, const std::string& component);

inline constexpr double beside = 1e-9;  // rad: samples on either side of a load edge

// A crank angle at which forces are evaluated.
struct Abscissa {
  double phi = 0;
  double weight = 0;  // for the integral over the cycle
  bool grid = false;  // one of the equidistant positions for curves and orders
  bool row = false;   // one of the requested positions; used for nothing else
  double aside = 0;   // at an edge: offset to just after it [rad]
  int side = 0;       // of an edge, in the order of the motion: just before (−1), just after (1)
  double place() const { return phi + aside; }
};
// The angles, the same for any number of rows: an equidistant grid, three Gauss points between its points and the load
// edges, a point on either side of each edge; and the rows, up to an angle. `direction`: ±1, order of the motion.
// Over the cycle from 0; over a range of a crank that rocks there are as many as of a turn.
std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int direction, int rows_of_turn,
                                double rows_end = HUGE_VAL);
std::vector<Abscissa> abscissae(const AngleRange& range, const std::vector<double>& edges, int direction, int rows);

struct MotionSample {
  double phi = 0;
  CrankMotion motion;
};
// Interpolates between samples that ascend by angle.
CrankMotion motion_between(const std::vector<MotionSample>& samples, double phi);

// Least and greatest speed between samples that ascend by angle [rad/s], with their errors.
std::pair<Estimate, Estimate> speed_range(const std::vector<MotionSample>& samples);

// The largest magnitude of a function of the crank angle. Local peaks of the samples near the largest one are refined
// by golden section between their neighbours, so that the result is independent of the sampling; at an edge there are
// samples on either side. Of equal peaks (two strokes of a crank) the first one counts, whatever the rounding.
Peak peak_of(const std::vector<double>& phi, const std::vector<double>& values,
             const std::function<double(double)>& value);
// The same with an error: difference to a search through every other sample, and rounding of `scale`.
Peak measured_peak_of(const std::vector<double>& phi, const std::vector<double>& values,
                      const std::function<double(double)>& value, double scale);
// Rounding of a golden-section search and of sums, relative to the largest force or moment.
inline constexpr double rounding_of_forces = 1e-12;

// The requested mechanism, or the first; throws std::invalid_argument that names the available ones.
const Section& chosen_mechanism(const Scene& scene, const std::string& wanted);

// Throws std::invalid_argument for invalid options.
void check(const ForcesOptions& options);

// A cycle of the crank at the abscissae, in the order of time.
struct MotionAlong {
  double begin = 0, cycle = 0;  // where it begins, and its length [rad]
  bool repeats = true;          // else a range of a crank that rocks
  double time = 0;  // that it takes, with stops between positions [s]; 0: as the speeds at the positions say
  std::vector<Abscissa> where;
  std::vector<CrankMotion> motion;

  double mean_speed() const;  // over time
};
// Data of the cycle for options that request further positions.
PrescribedCycle prescribed_cycle(OutputLoads& loads, double speed);
// The same path at speeds increased by this fraction.
MotionAlong sped_up(MotionAlong along, double by);
double closure_of(const MotionAlong& along);
// At this speed throughout.
MotionAlong steady_motion(OutputLoads& loads, double speed, int positions);

// Remaining change of a quantity sampled once per cycle: the change d over the last quarter of its course, continued
// as a geometric sequence with the ratio q to the quarter before: d q/(1 − q); for q < 0 (oscillating) |d|. ∞ if the
// changes do not shrink (constant growth: q = 1), 0 if they are below `noise`.
double still_to_come(const std::vector<double>& course, double noise);

}  // namespace kurbel
