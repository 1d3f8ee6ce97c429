// simbody_reactions.h — the joint reactions of the mechanisms as Simbody computes them: the check of d'Alembert's.
#pragma once

#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel {

// Senses as in slider_crank_statics.h; frame's axes [N, N·m].
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

// What its mobilizer does to each body, in the order of make_bodies' bodies (a ram rides on its link): at the body's joint, in the frame's axes.
struct MobilizerReaction {
  double x, y, moment;  // [N], [N·m]
};
struct MechanismReactions {
  std::vector<MobilizerReaction> on;
  double torque = 0;  // that the motion needs, on the crank [N·m]
};
// The crank's acceleration is prescribed; the load is a force along +x at the ram's pin or a torque on the rocker.
// Every link must have mass: Simbody's stand-in for a massless crank would weigh. Throw as make_bodies and
// MechanismBodies do.
MechanismReactions simbody_reactions(const BodiesOf& of, double phi, double omega, double alpha, double load);

}  // namespace kurbel
