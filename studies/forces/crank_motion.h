// crank_motion.h — along which motion forces are found: where the cycle is looked at, the loads there, peaks on the
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

// At an instant of a machine whose element that is.
ActingLoads acting_loads(const Model& model, std::size_t element, const Instant& now);

struct LinkageState;
struct Mechanism;

// A mechanism of a scene, and the network that it stands in, as drawn: before any effect, its tables as they are given.
struct AskedMechanism {
  // The one of this name, or the first. Throws as chosen_mechanism and build_network.
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

// The loads on a mechanism's output, from its own element on a shaft of its own: angle and speed are the crank's.
class OutputLoads {
 public:
  // Of the effects those count that are part of the machine.
  OutputLoads(const AskedMechanism& asked, const Effects& effects);
  const Model& model() const { return machine_.model(); }
  double cycle() const { return machine_.cycle(); }
  // Angles within the cycle where forces jump or bend: edges of the loads, and those that are added of a turn.
  std::vector<double> edges(int direction);
  void add_edges(const std::vector<double>& of_a_turn) { added_ = of_a_turn; }

  // As the operating sequence leaves them in the end; one that goes round leaves them as they come, and all count here.
  const ActingLoads& left() const { return left_; }
  // What is to be said of that; empty: all act.
  std::string words_of_sequence() const;
  // Sum of all forces along +x [N], or of all torques on an output that rocks [N·m].
  double force(double phi, const CrankMotion& motion) const;
  // With that sum and what acts within a linkage, for its bodies at φ.
  LinkageState state(double phi, const CrankMotion& motion, const PlanarLinkage& at) const;
  // What those that act take from beyond the ends of their tables while the crank turns round at this speed [rad/s]. A
  // sentence each.
  std::vector<std::string> outside_data(double speed);
  // Of each of model().accounts, reduced to the crank [N·m]; omega ≠ 0.
  std::span<const double> shares(double phi, const CrankMotion& motion);

 private:
  RigidMachine machine_;
  // Within one cycle, both ends counting as they are.
  double within(double phi) const {
    return phi <= cycle() * (1 + 1e-12) ? phi : phi - cycle() * std::ceil(phi / cycle() * (1 - 1e-12) - 1);
  }

  const Mechanism& mechanism_;            // of that machine
  std::vector<const Mechanism*> within_;  // what acts within it, where it is a linkage
  ActingLoads left_;
  bool goes_round_ = false;      // the sequence, and sets loads on its way
  std::vector<int> of_account_;  // the load that an account is of; −1: of none
  std::vector<double> acting_;
  std::vector<double> added_;
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
  double aside = 0;   // where it is an edge: looked at just after it [rad]
  int side = 0;       // of an edge, in the order of the motion: just before it (−1), just after it (1)
  double place() const { return phi + aside; }
};
// The same for any number of rows: an even grid, Gauss' three points between its points and the load edges, a point on
// either side of each edge; and the rows, up to an angle. `direction`: ±1, in which they are gone through.
std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int direction, int rows_of_turn,
                                double rows_end = HUGE_VAL);

struct MotionSample {
  double phi = 0;
  CrankMotion motion;
};
// Motion between samples that ascend by angle.
CrankMotion motion_between(const std::vector<MotionSample>& samples, double phi);

// Least and greatest speed of the motion between samples that ascend by angle [rad/s]: its peaks, with their errors.
std::pair<Estimate, Estimate> speed_range(const std::vector<MotionSample>& samples);

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

// Throws std::invalid_argument for senseless ones.
void check(const ForcesOptions& options);

// A cycle of the crank at the abscissae, in the order of time.
struct MotionAlong {
  double cycle = 0;  // [rad]
  std::vector<Abscissa> where;
  std::vector<CrankMotion> motion;

  double mean_speed() const;  // by time
};
// What is told of it to those who ask for more positions.
PrescribedCycle prescribed_cycle(OutputLoads& loads, double speed);
// At this speed throughout.
// The same way at speeds greater by this share.
MotionAlong sped_up(MotionAlong along, double by);
double closure_of(const MotionAlong& along);
MotionAlong steady_motion(OutputLoads& loads, double speed, int positions);

}  // namespace kurbel
