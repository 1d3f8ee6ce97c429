// excitation_lines.h — what may excite a drive torsionally, as frequencies over the speed: |a Ω + b|.
//
// Orders of every shaft (1× and 2×; blades and teeth that components state), orders that the scene's own laws contain, tooth
// meshes, the mains, harmonics of a frequency converter, laws of fixed frequency.                       (theory 12.17)
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "studies/response/excitation.h"

namespace kurbel {

struct ExcitationLine {
  enum class Kind { order, mesh, mains, converter, frequency };
  Kind kind = Kind::order;
  std::string label = {};                    // as the field writes it: "3×", "1× pump", "2× mains"
  std::string source = {};                   // "every shaft", "4 × cylinder", "blades of fan"; empty: not known
  double order = 0;                          // a, of the reduction link's turn, ≥ 0
  double fixed = 0;                          // b [rad/s]
  std::optional<std::size_t> harmonic = {};  // of Excitations::by_order, where the scene's laws contain it
  bool in_scene = false;                     // the scene's laws contain it
  double at(double speed) const { return std::abs(order * speed + fixed); }  // [rad/s]
};

// Which harmonics any torque, twist or own state contains at this speed, by 1e-6 of the strongest of its sort; entry 0: none.
std::vector<char> acting_harmonics(const Excitations& excitations, double speed);

// Components with the largest torques of a harmonic at the speed: "press", "4 × cylinder", "fan and 2 more". `shafts`: names
// of the coordinates' shafts where they are such, else empty.
std::string source_of(const Excitations& excitations, std::size_t harmonic, double speed,
                      const std::vector<std::string>& shafts);

// Each once; what they cannot tell is said in `notes`.
std::vector<ExcitationLine> excitation_lines(const Model& model, const Excitations& excitations, double speed,
                                             const std::vector<std::string>& shafts, std::vector<std::string>& notes);

}  // namespace kurbel
