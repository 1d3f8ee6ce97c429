// train_sheet.h — a maker's mass–elastic sheet as a scene.
//
//     station, inertia [kg*m2], stiffness [N*m/rad], speed ratio, diameter [mm]
//     motor,   12.4,            rigid,               1,
//     gear,    0.8,             gear,                1,                            the wheel; the next row is its pinion
//     pinion,  0.06,            2.1e6,               3.52,        90               stiffness: of the shaft to the next station
//     pump,    0.9,             ,                    3.52,
//
// With a column `to` the stiffness leads to that station instead of the next row's, and a station may have several rows, or
// rows of inertia and rows of shafts apart: lists of discs and shafts, and branches. Values are those of each station's own
// shaft; of columns named "referred inertia" and "referred stiffness" they are reduced to the one whose ratio is 1. In place
// of the ratio a column `speed` may stand, in place of the inertia "GD2" (4 J) or "WR2". Further columns: bore, damping;
// remarks are passed over. A diameter beside a stiffness is kept as a remark: it counts for stresses, once a limit is given.
#pragma once

#include <string>

namespace kurbel {

// Throws SceneError with file and line of whatever is missing or may be meant in two ways.
std::string scene_of_sheet(const std::string& path);

}  // namespace kurbel
