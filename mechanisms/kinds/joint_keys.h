// joint_keys.h — the slider-crank's joints in a scene: journals, pins and guide with their friction.
#pragma once

#include <vector>

#include "engine/scene/keys.h"
#include "mechanisms/slider_crank/slider_crank_forces.h"

namespace kurbel {

// main_bearing, crank_pin, slider_pin, guide: a table each, all without friction by default.
std::vector<Key> slider_crank_joint_keys();

// From a sound section of kind slider-crank.
SliderCrankJoints slider_crank_joints(const Section& section);
SliderCrankData slider_crank_data(const Section& section);

// What is wrong with the joints taken together goes into the messages; false then.
bool check_joints(const Section& section, Messages& messages);

}  // namespace kurbel
