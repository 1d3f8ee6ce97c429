// margins.h — separation margins: distance of natural frequencies from excitations in the operating speed range.
//
//     margin of mode n and excitation f(Ω) = |a Ω + b| over the operating speeds Ω₁ … Ω₂:
//     (ω_n − f)/f of the nearest f there; 0 if ω_n lies between them           (theory 12.17)
// For an order, b = 0, this is n_c/n − 1 with the crossing speed n_c and the nearest operating speed n. ω_n follows
// from springs and inertias alone, without slopes of motor curves and windings. Where the response is assessed, a pair is
// within the range also by the speed of the largest response.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/linear/linearise.h"
#include "engine/reading/tolerances.h"
#include "studies/margins/excitation_lines.h"

namespace kurbel {

// Of the reduction link [rad/s].
struct OperatingSpeeds {
  double slowest = 0, fastest = 0;  // 0: not known
  double margin = 0.1;              // required margin
  bool said = false;                // from [operation]
  std::string words = {};           // "of [operation]", "rated speed of motor", …
  bool known() const { return fastest > 0; }
  bool hold(double speed) const { return speed >= slowest && speed <= fastest; }
};

// From [operation], else the requested speed, else the first motor's rated one, else the given one, else that of the start.
OperatingSpeeds operating_speeds(const Model& model, std::optional<double> asked, std::optional<double> otherwise);

struct MarginMode {
  int number = 0;
  double omega = 0;           // undamped [rad/s]
  double ratio = 0;           // ζ; ≥ 1: does not vibrate
  std::string name, damping;  // "motor against fan"; "coupling 97 %, motors and loads 3 %"
};

// Response of the drive where a harmonic, or a law of fixed frequency, coincides with a mode.
struct CrossingResponse {
  int mode = 0;
  std::size_t harmonic = 0;  // 0: a fixed frequency
  double fixed = 0;          // the fixed frequency [rad/s]
  std::string joint = {};
  double amplitude = 0;                                     // [N·m]
  std::optional<double> peak = {};                          // speed at which it is largest [rad/s]
  double share = std::numeric_limits<double>::quiet_NaN();  // over the allowable load of the joint; NaN: not known
  std::string not_assessed = {};                            // why; empty: assessed
};

struct Margin {
  std::size_t mode = 0, line = 0;  // of Margins::modes, lines
  // Speeds [rad/s] at which the excitation coincides with the mode, the one next to the operating range first; two if
  // a converter's line also descends from higher frequency.
  std::optional<double> crossing = {}, further_crossing = {};
  // Speed of the largest response to it, if that is assessed and visibly apart from the crossing [rad/s].
  std::optional<double> largest = {};
  double margin = 0;      // signed; > 0: the mode lies above
  double at_largest = 0;  // the same by the speed of the largest response, if that is known
  bool within = false;    // |margin| is smaller than required
  std::optional<CrossingResponse> response = {};
  std::string not_assessed = {};  // why the response is not assessed; empty: it is
  // With tolerances: 2.5 % and 97.5 % quantiles, and the probability that the required margin is kept.
  double low = 0, high = 0;
  std::optional<Estimate> kept = {};
};

struct Margins {
  OperatingSpeeds speeds;
  std::vector<MarginMode> modes;
  std::vector<ExcitationLine> lines;
  std::vector<Margin> rows;  // every mode with every line, those within first, then by |margin|; empty: no known speed
  std::vector<std::string> tolerances;  // paths of tolerances that change a natural frequency
};

// Signed as defined above.
double margin_of(double omega, const ExcitationLine& line, const OperatingSpeeds& speeds);
// Speeds > 0 at which a line coincides with a frequency, ascending [rad/s].
std::vector<double> crossings(double omega, const ExcitationLine& line);

// Fills `rows` from the modes, lines and speeds given. `slowest`, `fastest`: speed range of the responses.
void find_rows(const std::vector<CrossingResponse>& responses, double slowest, double fastest, Margins& margins);

// Dissipation of an undamped shape by source: joints by name, then all torques that depend on speeds, then internal
// states, which also change the real part of the eigenvalue: "coupling 97 %, excited by motor's torque with 3 %":
// shares in the sum of all magnitudes, the three largest by name. "none" if nothing dissipates.
std::string damping_of(const LinearDrive& drive, const std::vector<std::string>& joints, const Eigen::VectorXd& shape,
                       std::optional<double> real_part);

// Intervals and probabilities. `frequencies` gives ω of the same modes with one toleranced value changed [its unit]. The
// effect of one tolerance on ln ω is a parabola in ln value through its ends and middle; effects of several are added.
void add_tolerances(const std::vector<Tolerance>& tolerances,
                    const std::function<std::vector<double>(const Tolerance&, double value)>& frequencies,
                    Margins& margins);

}  // namespace kurbel
