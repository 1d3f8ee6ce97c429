// mechanism_sheets.h — sheets common to all studies' mechanisms: plan in all positions, tables and diagrams of
// position, velocity and acceleration.
#pragma once

#include <vector>

#include "studies/sheet/kinematics.h"
#include "studies/sheet/paper.h"

namespace kurbel {

// Motion of the link at each position, and between them over the cycle, for the curves.
struct LinkAt {
  double phi = 0, omega = 0, alpha = 0;  // [rad], [rad/s], [rad/s²]
};
struct SheetMotion {
  SheetCycle cycle;
  std::vector<SheetPosition> positions;
  std::vector<LinkAt> at, between;  // at each position; over the cycle, ascending, both ends
  std::vector<double> way;          // angle from position 0 for `between`
};

// At constant speed.
SheetMotion even_motion(const SheetCycle& cycle, std::vector<SheetPosition> positions, double omega);

void add_mechanism(Sheets& sheets, const MechanismOnSheet& mechanism, const SheetMotion& motion,
                   const std::string& speed_in_words, const std::string& structure_in_words);

// Labels of the positions, and which of them are letters or edges of a load.
std::vector<std::string> labels_of(const std::vector<SheetPosition>& positions);
std::vector<bool> stressed(const std::vector<SheetPosition>& positions);

}  // namespace kurbel
