// classify.h — what a machine did, by definitions on sampled states and commands in force; nothing of the program's own words.
//
// usual speed, usual torque: rated ones of the reduction link, as the model has them. A shaft turns above 1e-3 of its usual
// speed; a torque acts above 1e-6 of the usual one.
//
//   begins      "at rest": the link does not turn at the first point; else "turning"
//   moves       the link turns at any point
//   end         "rests":      it does not turn at the end, and is held there or has not turned for the last 2 % of the time,
//                             nor for as long as the last two reversals of a vibration lie apart, which stands at its
//                             turns (the time between the two before is that within a factor of two); unless it has
//                             reversed since it last turned, and passed its greatest speed in that sense
//               "vibrates":   in the last quarter of the time it turns in both senses, twice at least, and the angle that it
//                             gained is less than a quarter of the way it went there, or in the last whole cycle of its
//                             oscillation: the quarter may end at the other end of it than it begins
//               "forwards", "backwards": else, by the sense of the last 2 % of the time
//   to_and_fro  the smallest one of these two shares of the way and that of its last oscillation, of any speed, which
//               reversed in the last quarter of the time and goes on within it; 1: it does not turn to and fro
//   fastest_late     the speed at the end; of one that vibrates the greatest of its last half cycle, or of the last 2 %
//               of the time
//   rests_since when it last turned, of one that rests; 0 where it never did
//   held_since  the last point at which its shaft neither was tied to the frame nor stood (gears hold without a tie), of one
//               that does so at the end
//   driven      a source is within its window of time and its command is not 0;  drives: and gives a torque that acts
//   pushed      at the end a source whose own shaft stands gives more than 1e-3 of the usual torque, or a clutch, limiter or
//               belt slips under torque
//   does_not_start   begins at rest, never moves, and is pushed at the end
//   stalls      turned at 1 % of the usual speed at least, rests at the end, and is pushed there
//   falls       at the end it turns backwards at 1 % of the usual speed at least, more than half a turn behind its foremost
//               point since a source last drove it backwards, or left it turning so, faster than at the
//               end, or, with no source on, faster than its usual speed; and began at rest or forwards
//   turns_back  at the end it turns against what drives it, at 1 % of the usual speed at least, and lies more than half a turn
//               behind the foremost point in the sense of the drive, or of the start
//   no_round    a machine with a cycle has not turned by one cycle, moved, and rests or vibrates at the end, driven
//   rounds      whole cycles of the link's angle, whichever way
//   steady      of the time since the last command, window of time or start; where that has no three cycles, since the last
//               command, window of a source or start:
//               "yes"  cycles repeat: the mean speeds of the last p cycles and of the p before them differ by less than 0.1 %,
//                      extremes by less than 0.5 % of the mean speed, p = 1 … 6, and the mean speed of the last eighth differs
//                      by less than 1 % from that of the eighth before it; with a cycle: of the whole periods in an eighth
//               "no"   for no p that fits do they differ by less than 1 %, or the eighths differ by more than 5 %
//               else "unclear"; without a cycle ten equal parts of that time stand for the cycles, and p = 1
//   run_up      when the link's speed enters for good the range of the last p cycles, wider by 1 % of the mean speed; earliest,
//               latest: wider by 1.1 %, 0.9 % (an oscillation that just touches the edge may belong to either side)
//   driven_part the same, of the time up to which any source is on, where none is at the end
//   stands_within    share of the time of the last p cycles in which the link does not turn
//   later       the same machine run on to several times the time: its mean speed in the last tenth (of whole cycles,
//               as many as it takes), what it does at the end
//   drift_of_motors  later: the greatest change of a motor's mean speed from the last eighth but one of the time to the last:
//               a machine is steady when all of its shafts are, and the link may be so long before
//   fastest_shaft    at the end, of any shaft over its usual speed
//   two_periods a torque depends on time and something on the link's angle: nothing need ever repeat
//   contacts    lets_go: slips at a command of 1 unchanged since it held; engages: slips otherwise, command above 0;
//               open: command 0; slips count from 1e-3 of the usual speed or 1e-2 rad in all; lets_go_at_all: any slip
//               stopped_within: the longest time of slip that ended in a hold
//   motors      late_rms_torque: the smaller one of the last two eighths of the time: a motor may run up while the link is steady
//   limits      of ratings that the scene states: greatest value sampled over the limit
#pragma once

#include <nlohmann/json.hpp>

#include "tests/oracle/observed.h"

namespace kurbel::oracle {

// `seen`: to the scene's own end; `later`: the same machine for longer, null: not run.
nlohmann::json classify(const Observed& seen, const Observed* later);

}  // namespace kurbel::oracle
