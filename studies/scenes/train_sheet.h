// train_sheet.h — converts a manufacturer's mass–elastic sheet to a scene.
//
//     station, inertia [kg*m2], stiffness [N*m/rad], speed ratio, diameter [mm]
//     motor,   12.4,            rigid,               1,
//     gear,    0.8,             gear,                1,                            the wheel; the next row is its pinion
//     pinion,  0.06,            2.1e6,               3.52,        90               stiffness: of the shaft to the next station
//     pump,    0.9,             ,                    3.52,
//
// With a column `to` the stiffness connects to that station instead of the next row, and a station may have several rows,
// or separate rows of inertia and of shafts: lists of discs and shafts, and branches. Values refer to each station's own
// shaft; in columns "referred inertia" and "referred stiffness" they are reduced to the shaft with ratio 1. The ratio may
// be replaced by a column `speed`, the inertia by "GD2" (4 J) or "WR2". Further columns: bore, damping; remarks are
// ignored. A diameter beside a stiffness is kept as a remark: it is used for stresses once a limit is given.
#pragma once

#include <string>

namespace kurbel {

// Throws SceneError with file and line for missing or ambiguous entries.
std::string scene_of_sheet(const std::string& path);

}  // namespace kurbel
