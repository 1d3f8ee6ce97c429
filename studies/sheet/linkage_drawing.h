// linkage_drawing.h — a mechanism drawn to scale in all positions, with the paths of its pins and centres of mass.
#pragma once

#include <string>
#include <vector>

#include "studies/sheet/kinematics.h"
#include "studies/sheet/paper.h"
#include "studies/sheet/scales.h"

namespace kurbel {

// Mapping of the mechanism's axes to the paper.
struct PlanPlaced {
  Scale scale;           // μ_l [m/mm]
  double direction = 0;  // of +x above the horizontal [rad]
  Spot origin;           // of the crank's axis
  Spot spot(PlanePoint p) const;
};

// `sense`: ±1, of the link's motion.
PlanPlaced draw_linkage(Canvas& canvas, const Box& box, const MechanismOnSheet& mechanism,
                        const std::vector<SheetPosition>& positions, double sense);

// "μ_l = 0.002 m/mm (1:2); OA = 60 mm, drawn 30 mm; …"
std::string lengths_in_words(const MechanismOnSheet& mechanism, const Scale& scale);

}  // namespace kurbel
