// slider_crank.h — the slider-crank: crank, rod, slider.
//
//                                        ___
//        y       A  r = OA, l = AB      |   |        O  crank axis, origin        β  rod's angle from +x
//        |      / `-._  β               | B |  y = e A  crank pin                 e  offset of the slider line
//        |     / φ    `-._______________|_o_|        B  slider pin
//        O----------------------------------- x      C  rod's centre of mass, AC = rod_com
//
// φ is measured from the +x stroke axis to OA, counter-clockwise, with and without offset. For e = 0, φ = 0 is the
// extended dead centre and φ = π the folded one. On the assembly branch the rod points towards +x (cos β > 0).
//
// At l = r + |e| crank and rod pass an upright change point, and the motion is continued smoothly (mechanisms/loops).
// Without offset β = −φ and x = 2 r cos φ, or β = φ + π and x = 0 (`folds`: the rod folds onto the crank). With an offset
// cos β changes its sign once per turn: the cycle is two turns, and the branch is defined at φ = 0.
//
// If the rod is shorter than r + |e|, the crank rocks within CrankArc; the rod points towards +x or, if `folds`, towards
// −x.
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/linkages/data_fault.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/loops.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

struct SliderCrankData {
  double radius = 0;         // r [m], > 0
  double rod_length = 0;     // l [m]; < r + |e|: the crank rocks
  double offset = 0;         // e [m], the slider moves on the line y = e
  double crank_mass = 0;     // [kg], ≥ 0
  double crank_com = 0;      // from the axis towards the pin [m], < 0: counterweighted
  double crank_inertia = 0;  // about the crank's axis [kg·m²], ≥ crank_mass · crank_com²
  double rod_mass = 0;       // [kg], ≥ 0
  double rod_com = 0;        // from the crank pin along the rod [m]
  double rod_inertia = 0;    // central [kg·m²], ≥ 0
  double slider_mass = 0;    // [kg], ≥ 0
  double gravity = 0;        // [m/s²]
  double stroke_angle = 0;   // of +x above the horizontal [rad]; +y is 90° ahead of +x
  bool folds = false;        // only for l ≤ r + |e|: the rod points towards −x; at l = r + |e|: at φ = 0

  SliderLoop loop() const { return {radius, rod_length, offset}; }
  bool changes() const { return loop().changes(); }  // passes change points
  bool rocks() const { return loop().arc().has_value(); }
  // The slider never moves: the rod lies on the crank.
  bool stands_still() const { return folds && offset == 0 && changes(); }
};

// The rod must reach the slider's line, and no body may have less inertia than its mass demands.
DataFaults faults_of(const SliderCrankData& data);
std::vector<double> values_of(const SliderCrankData& data);  // all of them
LinkageDrawing drawing_of(const SliderCrankData& data);
std::optional<CrankArc> arc_of(const SliderCrankData& data);  // range of a rocking crank

// Bodies: crank, rod, slider. The data must be without faults.
PlanarLinkage linkage_of(const SliderCrankData& data, long double phi);

}  // namespace kurbel
