// kept_moment.h — which moment of a machine is meant where none is asked for: the last one at which it keeps a motion.
#pragma once

#include <string>

#include "engine/orbit/moment.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

// Where `at` is no moment: of a machine that rests when all is switched, `at` becomes the last step of its sequence, or else
// the last time between the edges of its sources' windows, at which its motion repeats; then the words say so: "the machine
// comes to rest at 21.2 s …". Of any other machine `at` stays the end of all switching, and there are no words. Searches as
// find_orbit() does, and only where something is switched; `last`: where all that is switched leads to, null: not known yet.
// Throws as find_orbit() does.
std::string choose_kept_moment(const Scene& scene, const Effects& effects, const OrbitOptions& options, Moment& at,
                               const Orbit* last = nullptr);

}  // namespace kurbel
