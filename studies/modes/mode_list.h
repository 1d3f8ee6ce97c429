// mode_list.h — the modes of a linearised drive, listed for people: undamped and damped in pairs, and how far they hold.
//
// Natural frequencies are those of the undamped drive, springs and inertias with internal states as they are; where the link is
// held at rest, weights are springs, too. To each belongs the damped mode whose shape is most like its own and whose energy
// is in springs and inertias, not in windings. What vibrates and belongs to none is a mode of internal states.
#pragma once

#include "studies/modes/modes.h"

namespace kurbel {

// Fills `undamped`, `damped`, `modes` of the study's drive; notes what grows by itself.
void list_modes(int count, ModesStudy& found);
// Fills `least` and `greatest` of the modes with the link held at angles all over the cycle.
void find_frozen_range(int count, ModesStudy& found);
// Fills `periodic` and `only_of_mean` of the modes of a small machine: exponents of the motions beside the cycle that belong
// to them. Each mode that swings has one, two, or a note that says why none.
void find_exponents(const Orbit& orbit, const CycleSamples& samples, ModesStudy& found);
// Locks or slips, touches or parts.
bool changes_contact(const Event& event);
// Notes contacts that lock and slip, touch and part within the round: the linear machine has them one way.
void note_changes(const CycleSamples& samples, ModesStudy& found);
// Notes joints that hardly swing in the linear response and do in the steady motion: what is linear says nothing of them.
void note_missing_swings(ModesStudy& found);
// Fills `rattles`: joints whose law changes its piece within the round.
void find_rattles(const CycleSamples& samples, int count, ModesStudy& found);

// Takes from a response of samples what rounding makes of an equilibrium, in which nothing vibrates.
void take_swings_away(SpeedResponse& response);

}  // namespace kurbel
