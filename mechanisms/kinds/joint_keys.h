// joint_keys.h — the slider-crank's joints in a scene: journals, pins and guide with their friction.
#pragma once

#include "engine/scene/fields.h"
#include "mechanisms/slider_crank/slider_crank_forces.h"

namespace kurbel {

// main_bearing, crank_pin, slider_pin, guide: a table each, all without friction by default.
Fields<SliderCrankJoints> joint_fields();

}  // namespace kurbel
