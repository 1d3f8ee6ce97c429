// rack_cutting.h — how a rack cuts the flanks of an external wheel: the rack in the wheel's axes, and the drawing of its
// positions with the envelope.
//
// The rack's rolling line goes without slip on the reference circle; its datum line lies x m outside of it. Its spaces
// make the teeth: half as wide as π m_t/4 − h tan α_t at the height h above the datum line.
#pragma once

#include <vector>

#include "drivetrain/gears/gear_wheel.h"
#include "studies/findings/report.h"

namespace kurbel {

// The profile from the middle of one rack tooth to that of the next, with its space on the wheel's tooth about the x-axis,
// while the wheel has turned by `roll` [rad] and the rack has gone by r · roll; `space` steps of the pitch further on. In the
// wheel's axes [m], n points a rounding.
std::vector<OutlinePoint> rack_at(const GearWheel& wheel, double roll, int space = 0, int n = 6);

// Of wheel 1 or 2. An internal wheel has none: its cutter is not known.
Plot cutting_plot(const GearWheel& wheel, int number);

}  // namespace kurbel
