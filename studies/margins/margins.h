// margins.h — separation margins: how far natural frequencies keep from what excites a drive where it runs for long.
//
//     margin of mode n and excitation f(Ω) = |a Ω + b| over the operating speeds Ω₁ … Ω₂:
//     (ω_n − f)/f of the nearest f there; 0 where ω_n lies between them           (theory 12.17)
// Of an order, b = 0, that is n_c/n − 1 of the crossing speed n_c and the nearest operating speed n. ω_n is that of springs
// and inertias alone: no slope of a motor's curve, and no winding, moves it.
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
  double margin = 0.1;              // wanted
  bool said = false;                // by [operation]
  std::string words = {};           // "of [operation]", "rated speed of motor", …
  bool known() const { return fastest > 0; }
};

// By [operation], else the speed asked for, else the first motor's rated one, else the given one, else that of the start.
OperatingSpeeds operating_speeds(const Model& model, std::optional<double> asked, std::optional<double> otherwise);

struct MarginMode {
  int number = 0;
  double omega = 0;           // undamped [rad/s]
  double ratio = 0;           // ζ; ≥ 1: does not vibrate
  std::string name, damping;  // "motor against fan"; "coupling 97 %, motors and loads 3 %"
};

// What the drive answers where a harmonic, or a law of fixed frequency, meets a mode.
struct CrossingResponse {
  int mode = 0;
  std::size_t harmonic = 0;  // 0: of a fixed frequency
  double fixed = 0;          // that one [rad/s]
  std::string joint = {};
  double amplitude = 0;                                     // [N·m]
  double share = std::numeric_limits<double>::quiet_NaN();  // of what the joint may bear; NaN: not known
  std::string not_assessed = {};                            // why; empty: assessed
};

struct Margin {
  std::size_t mode = 0, line = 0;  // of Margins::modes, lines
  // Speeds [rad/s] at which the excitation meets the mode, that next to the operating ones first; two where a converter's line
  // comes down from above.
  std::optional<double> crossing = {}, further_crossing = {};
  double margin = 0;    // signed; > 0: the mode lies above
  bool within = false;  // |margin| below what is wanted
  std::optional<CrossingResponse> response = {};
  std::string not_assessed = {};  // why the response is not; empty: it is
  // By tolerances: 2.5 % and 97.5 % quantiles, and the probability that the wanted margin is kept.
  double low = 0, high = 0;
  std::optional<Estimate> kept = {};
};

struct Margins {
  OperatingSpeeds speeds;
  std::vector<MarginMode> modes;
  std::vector<ExcitationLine> lines;
  std::vector<Margin>
      rows;  // every mode with every line, those within first, then by |margin|; none: no speed is known
  std::vector<std::string> tolerances;  // paths of those that move a natural frequency
};

// Signed as above.
double margin_of(double omega, const ExcitationLine& line, const OperatingSpeeds& speeds);
// Speeds > 0 at which a line meets a frequency, ascending [rad/s].
std::vector<double> crossings(double omega, const ExcitationLine& line);

// Fills `rows` of modes, lines and speeds that are there. `slowest`, `fastest`: over which responses were looked for.
void find_rows(const std::vector<CrossingResponse>& responses, double slowest, double fastest, Margins& margins);

// Of the damping of an undamped shape, what dissipates: joints by name, then all torques that follow speeds, then internal
// states, which move the eigenvalue's real part further: "coupling 97 %, excited by motor's torque with 3 %": shares of the sum of
// all magnitudes, the three largest by name. "none" where nothing does.
std::string damping_of(const LinearDrive& drive, const std::vector<std::string>& joints, const Eigen::VectorXd& shape,
                       std::optional<double> real_part);

// Intervals and probabilities. `frequencies` gives ω of the same modes with one toleranced value changed [its unit]. What one
// tolerance does to ln ω is a parabola of ln value through its ends and middle; what several do adds up.
void add_tolerances(const std::vector<Tolerance>& tolerances,
                    const std::function<std::vector<double>(const Tolerance&, double value)>& frequencies,
                    Margins& margins);

}  // namespace kurbel
