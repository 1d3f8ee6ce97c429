// simbody_reactions.h — the joint reactions of the slider-crank as Simbody computes them: the check of d'Alembert's.
#pragma once

#include "mechanisms/linkages/slider_crank_geometry.h"

namespace kurbel {

// Senses as in slider_crank_forces.h; frame's axes [N, N·m].
struct SimbodyReactions {
  double main_bearing[2];  // frame on crank
  double crank_pin[2];     // crank on rod
  double slider_pin[2];    // rod on slider
  double guide;            // frame on slider, along y
  double guide_moment;     // frame on slider, about the slider pin
  double torque;           // that the motion needs, on the crank
};

// A model with the slider as a body of its own, so that pin and guide are seen apart; the crank's acceleration is
// prescribed. slider_force acts along +x through the pin. Throws std::invalid_argument for data outside its domain or
// a rod or slider without mass, for which Simbody's equations are singular; std::runtime_error if the loop is open.
SimbodyReactions simbody_reactions(const SliderCrankData& data, double phi, double omega, double alpha,
                                   double slider_force);

}  // namespace kurbel
