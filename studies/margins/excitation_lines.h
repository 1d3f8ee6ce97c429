// excitation_lines.h — possible torsional excitations of a drive, as frequencies over the speed: |a Ω + b|.
//
// Orders of every shaft (1× and 2×; blades and teeth given for components), orders contained in the scene's own laws,
// tooth meshes, the mains, harmonics of a frequency converter, laws of fixed frequency.                (theory 12.17)
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
  std::string label = {};                    // customary label: "3×", "1× pump", "2× mains"
  std::string source = {};                   // "every shaft", "4 × cylinder", "blades of fan"; empty: not known
  double order = 0;                          // a, of the reduction link's turn, ≥ 0
  double fixed = 0;                          // b [rad/s]
  std::optional<std::size_t> harmonic = {};  // of Excitations::by_order, if the scene's laws contain it
  bool in_scene = false;                     // the scene's laws contain it
  double at(double speed) const { return std::abs(order * speed + fixed); }  // [rad/s]
};

// Harmonics in any torque, twist or internal state at this speed, above 1e-6 of the strongest of its sort; entry 0: none.
std::vector<char> acting_harmonics(const Excitations& excitations, double speed);

// Components with the largest torques of a harmonic at the speed: "press", "4 × cylinder", "fan and 2 more".
// `shafts`: names of the shafts if coordinates are shafts, else empty.
std::string source_of(const Excitations& excitations, std::size_t harmonic, double speed,
                      const std::vector<std::string>& shafts);

// Each line once; what they do not include is stated in `notes`.
std::vector<ExcitationLine> excitation_lines(const Model& model, const Excitations& excitations, double speed,
                                             const std::vector<std::string>& shafts, std::vector<std::string>& notes);

}  // namespace kurbel
