// mode_list.h — the modes of a linearised drive: undamped and damped in pairs, and their range of validity.
//
// Natural frequencies are those of the undamped drive: springs and inertias, with internal states fixed; if the link
// is held at rest, weights act as springs, too. Each is paired with the damped mode of most similar shape whose
// energy is in springs and inertias, not in windings. Unpaired oscillating modes are modes of internal states.
#pragma once

#include "studies/modes/modes.h"

namespace kurbel {

// Fills `undamped`, `damped`, `modes` of the study's drive; notes unstable modes.
void list_modes(int count, ModesStudy& found);
// Fills `least` and `greatest` of the modes with the link held at angles throughout the cycle.
void find_frozen_range(int count, ModesStudy& found);
// Fills `periodic` and `only_of_mean` of the modes of a small machine: the corresponding Floquet exponents of the
// cycle. Each oscillating mode has one, two, or a note with the reason why none.
void find_exponents(const Orbit& orbit, const CycleSamples& samples, ModesStudy& found);
// Locking or slipping, contact or separation.
bool changes_contact(const Event& event);
// Notes contacts that lock and slip, or touch and part, within the period: the linear machine has only one of these states.
void note_changes(const CycleSamples& samples, ModesStudy& found);
// Notes joints that hardly vibrate in the linear response but do in the steady motion: the linear results do not apply to them.
void note_missing_modes(ModesStudy& found);
// Fills `rattles`: joints whose law changes its piece within the period.
void find_rattles(const CycleSamples& samples, int count, ModesStudy& found);

// Removes rounding errors from a response computed from samples of an equilibrium, in which nothing vibrates.
void remove_vibrations(SpeedResponse& response);

}  // namespace kurbel
