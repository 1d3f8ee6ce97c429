// slotted_lever.h — the inverted slider-crank: crank, block on its pin, slotted lever on a bearing.
//
//                 A_            O  crank axis, origin        A  crank pin and block, OA = crank
//              ,·´ ╲╲           D  lever's bearing, OD = ground along +x
//           ,·´ φ   ╲╲  ψ       slot: from D through A
//          O─────────D── x      output: the lever's angle ψ from +x to the slot, counter-clockwise
//
// ground > crank: the lever rocks by 2 arcsin(crank/ground). ground < crank: it turns fully with the crank (Whitworth).
// ground = crank: the pin passes over the bearing, a change point, and ψ = φ/2 + 90°: the lever makes one turn in two
// turns of the crank.
#pragma once

#include <vector>

#include "mechanisms/linkages/data_fault.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/loops.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

struct SlottedLeverData {
  double crank = 0, ground = 0;     // lengths [m], > 0
  LinkBody crank_body, lever_body;  // com from O towards A, from D along the slot
  double block_mass = 0;            // [kg], ≥ 0, centre of mass on the crank pin
  double block_inertia = 0;         // central; the block turns with the lever [kg·m²], ≥ 0
  double gravity = 0;               // [m/s²], ≥ 0
  double ground_angle = 0;          // of +x above the horizontal [rad]; +y is 90° ahead of +x

  SlotLoop loop() const { return {crank, ground}; }
};

DataFaults faults_of(const SlottedLeverData& data);
std::vector<double> values_of(const SlottedLeverData& data);  // all of them
LinkageDrawing drawing_of(const SlottedLeverData& data);

// Bodies: crank, block, lever. The data must be without faults.
PlanarLinkage linkage_of(const SlottedLeverData& data, long double phi);

}  // namespace kurbel
