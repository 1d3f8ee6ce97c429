// reduce.h — a machine reduced to one link: inertia, torques, harmonics, and the drive's elastic chain (theory 2, 5).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/orbit/moment.h"
#include "studies/cycle/classical.h"
#include "studies/cycle/machine_cycle.h"
#include "studies/findings/output.h"

namespace kurbel {

struct MachineReduction;

struct ReduceOptions {
  int positions = 12;           // per cycle, ≥ 1
  std::string to;               // "gearbox.in", "flywheel", "press.slider", "screen.rocker"; empty: the reduction link
  std::optional<double> speed;  // of the reduction link, for torques that depend on it [rad/s]
  int orders = 12;              // of the harmonics, per turn of the reduction link
  Moment at = {};               // state of the machine at that moment; default: after all switching
  std::optional<CycleBasis> basis = {};  // default: as for MachineOnBasis
  // Of a crank that rocks: over these angles of the reduction link; default: rocking_range.
  std::optional<AngleRange> range = {};
  // Further angles [rad], 0 ≤ φ < cycle, chosen when all other results are known.
  std::function<std::vector<double>(const MachineReduction&)> also = {};
};

// The machine at one position. Reduced to a shaft: kg·m², kg·m²/rad, N·m. Reduced to a slider: kg, kg/m, N. Along a
// steady cycle I_r is twice the kinetic energy over the square of the speed, and I_drive is I_r − I_em.
struct ReducedPosition {
  int number = 0;
  double phi = 0;                                                           // of the reduction link [rad]
  double omega = 0, alpha = 0;                                              // of the link [rad/s], [rad/s²]
  double inertia = 0, drive_inertia = 0, mechanism_inertia = 0, slope = 0;  // I_r = I_drive + I_em, I_r′
  double drive = 0, load = 0;                                               // M_d, M_c
  std::vector<double> share;                                                // per account, positive if it drives
  std::optional<double> ratio;                                              // for a slider: x′ = v/ω [m/rad]
  std::string singular;  // reason for missing values: a dead centre of the slider
};

// a_n cos(n φ − ψ_n) of one quantity; order 1 is once per turn of the reduction link.
struct Harmonic {
  double order = 0;
  Estimate amplitude;
  double phase = 0;  // of the maximum after φ = 0 [rad of n φ]; order 0: the mean
};
struct Spectrum {
  std::string name, unit;
  std::vector<Harmonic> harmonics;
  double mean_square = 0;  // of the quantity over the cycle, by quadrature
  // Parseval: (a₀² + ½ Σ a_n²)/mean_square; the difference to 1 lies in higher orders.
  double captured = 1;
};
// Exact sums over the pieces. Orders 0 … `orders` in steps of 2π/length.
Spectrum spectrum(const std::string& name, const std::string& unit, const Piecewise& f, int orders);
inline constexpr double rounding_of_reduction = 1e-12;  // of the largest value
// Largest difference of one quantity from two samplings, at least that rounding.
double largest_difference(const Piecewise& f, const Piecewise& looser);

// An inertia of the drive, and an elastic part between two.
struct ChainInertia {
  std::string name;           // components on it
  double own = 0, ratio = 1;  // on its own shaft [kg·m²]; its speed over the chosen shaft's
  double reduced = 0;         // own · ratio² [kg·m²]
  bool mechanism = false;     // includes I_em by its mean, of a crank that rocks
  bool rocks = false;         // by its value in the middle of the arc
};
struct ChainSpring {
  std::string name;
  std::size_t a = 0, b = 0;  // the inertias that it connects
  // Own [N·m/rad], at rest; [N·m·s/rad], NaN where one number is not its damping (slip, play, internal states); of its
  // driving shaft.
  double stiffness = 0, damping = 0, ratio = 1;
  double reduced_stiffness = 0, reduced_damping = 0;
};
// The chain with every coupling and shaft elastic, whatever effects are on.
struct Chain {
  std::vector<ChainInertia> inertias;
  std::vector<ChainSpring> springs;
};

// A coupler curve: positions of a linkage's point at equal steps of its driving link's angle.
struct PointPath {
  std::string name;               // "press.D"
  std::vector<double> phi, x, y;  // [rad]; in the sketch's axes, from the driving link's bearing [m]
};

struct MachineReduction : SceneStudy {
  std::string link, to;    // the reduction link, and the target of the reduction
  bool turns_back = true;  // the target reverses: dead centres
  bool to_output = false;  // the mechanism's slider or rocker, whose ratio varies
  bool to_rocker = false;
  double to_ratio = 1;  // speed of the chosen shaft over the link's
  double speed = 0;     // of the link, if torques depend on it [rad/s]
  std::string speed_source;
  CycleBasis basis = CycleBasis::classical;
  double begin = 0, cycle = 0;        // of the link: where the cycle or range begins, and its length [rad]
  bool over_a_range = false;          // a crank rocks: the cycle is a range of its angle, and nothing repeats
  double sense = 1;                   // ±1, of its motion
  double constant_inertia = 0;        // on the chosen shaft [kg·m²]; of a slider: on the link
  std::vector<std::string> accounts;  // names with their line: "press.load (useful)"
  std::vector<ReducedPosition> positions;
  std::vector<ReducedPosition> curve;  // dense, for plots
  std::vector<ReducedPosition> also;   // at the further angles requested
  std::vector<Spectrum> spectra;       // on the link: I_r, M_d − M_c
  Chain chain;                         // on the chosen shaft, or on the link
  Estimate mean_drive, mean_load;      // on the link [N·m]
  // Largest errors over the cycle, on the link: of I_r [kg·m²], M_d and M_c [N·m]. Empty if nothing repeats.
  std::optional<double> inertia_error, drive_error, load_error;
  std::vector<std::string> outside_data;  // extrapolation of tables in the torques; it has no error
  std::vector<PointPath> paths;           // of a linkage's moving points, over a cycle of its driving link
};

// Throws SceneError if no machine can be made, std::invalid_argument with the reason for invalid options, and if
// neither the rigid machine nor a steady cycle determines the torques.
MachineReduction reduce(const Scene& scene, const ReduceOptions& options);

// The elastic chain reduced to a node of a compiled model.
Chain elastic_chain(const Model& model, int node);

// Its mass–elastic table: each value on its own shaft and reduced to `to`, with the speeds of each if those of `to`
// are known (fastest > 0) [rad/s]; and a drawing of the chain.
Rows chain_table(const Chain& chain, const std::string& to, double slowest = 0, double fastest = 0,
                 const SpeedUnit& unit = {});
Plot chain_plot(const Chain& chain);

// "gearbox.in", "flywheel" → node of the network. Throws std::invalid_argument with the allowed names.
int node_named(const Model& model, const std::string& name);

// Files: positions.csv, harmonics.csv, of linkages coupler_curves.csv. The reduction must outlive the findings.
Findings findings_of(const MachineReduction& reduction);

}  // namespace kurbel
