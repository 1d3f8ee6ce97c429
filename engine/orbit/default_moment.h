// default_moment.h — the default moment of a machine for studies of steady motion: the last one with a steady motion.
#pragma once

#include <string>

#include "engine/orbit/moment.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

// Sets `at` if it is empty and the machine is at rest after all switching: to the last step of its sequence, or else the
// last time between the edges of its sources' windows, with a periodic motion; returns a text, "the machine comes to rest at
// 21.2 s …". For other machines `at` stays empty (the end of all switching), and so does the text. Searches like
// find_orbit(), only if something is switched; `last`: the steady motion after all switching; null: unknown. Throws as
// find_orbit().
std::string choose_default_moment(const Scene& scene, const Effects& effects, const OrbitOptions& options, Moment& at,
                                  const Orbit* last = nullptr);

}  // namespace kurbel
