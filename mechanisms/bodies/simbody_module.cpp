// simbody_module.cpp — the module's one symbol (C++17 island).
#include "mechanisms/bodies/simbody_module.h"

#include "mechanisms/bodies/planar_system.h"

extern "C" __attribute__((visibility("default"))) const kurbel::SimbodyModule kurbel_simbody_module;
const kurbel::SimbodyModule kurbel_simbody_module = {
    [](const kurbel::BodiesOf& of) { return kurbel::sampled(kurbel::planar_system(of)); },
    kurbel::simbody::run_multibody, kurbel::simbody::multibody_integrators};
