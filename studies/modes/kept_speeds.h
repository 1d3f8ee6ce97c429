// kept_speeds.h — at which speeds a machine can run for long at all.
#pragma once

#include <string>

#include "studies/modes/modes.h"

namespace kurbel {

// Whether small motions about a mean speed that is held grow (Re λ > 0): beyond its breakdown an induction motor pulls
// the less the slower it turns. Only of drives that a dense solver takes (160 coordinates); of larger ones never.
bool grows(const LinearDrive& drive);

// A speed is kept where nothing grows and the link's speed swings by less than itself; what the linear response says of
// any other is of no motion that lasts. Where the operating point is none that is kept, nothing is told of the others.
void judge_kept_speeds(const ModesStudy& found, const LinearDrive& drive, SpeedResponse& response);

// Takes the critical speeds away that are not kept, and notes what is left out.
void leave_out_what_is_not_kept(ModesStudy& found);

// A stretch of the sweep whose speeds are all kept, or all not.
struct SpeedStretch {
  std::size_t begin = 0, end = 0;  // of the sweep's entries
  bool kept = true;
};
std::vector<SpeedStretch> stretches(const std::vector<SpeedResponse>& sweep);

}  // namespace kurbel
