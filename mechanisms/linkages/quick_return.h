// quick_return.h — ram driven by crank and slotted lever: shaper and Whitworth quick return.
//
//            E────────────[ram]─ y = guide        O  crank axis, origin        A  crank pin and block, OA = radius
//           /    link                             P  lever's bearing, pivot_distance below O on the −y axis
//      A ··/·   φ from +x to OA                   E  lever's end, PE = lever, lever_angle ahead of the slot P → A
//        O/  `                                    guide: guide_height above P, parallel to x
//        /
//       P          output: the ram's position x from the crank axis
//
// pivot_distance > radius: the lever rocks (shaper). pivot_distance < radius: it turns fully (Whitworth), usually with
// lever_angle = 180° and the guide through P. The working stroke of the shaper takes the crank angle π + 2γ, the return
// stroke π − 2γ, sin γ = radius/pivot_distance. The link points from E towards +x, or backward towards −x.
#pragma once

#include <vector>

#include "mechanisms/linkages/data_fault.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

struct QuickReturnData {
  double radius = 0;                // OA [m], > 0
  double pivot_distance = 0;        // OP [m], > 0, not radius
  double lever = 0;                 // PE [m], > 0
  double lever_angle = 0;           // from the slot to PE [rad]
  double link = 0;                  // from E to the ram's pin [m], > maximum distance of E from the guide
  double guide_height = 0;          // of the ram's line above P [m]
  bool backward = false;            // the link points towards −x
  LinkBody crank_body, lever_body;  // com from O towards A, from P along the slot
  double block_mass = 0;            // [kg], ≥ 0, centre of mass on the crank pin
  double block_inertia = 0;         // central; the block turns with the lever [kg·m²], ≥ 0
  LinkBody link_body;               // com from E
  double ram_mass = 0;              // [kg], ≥ 0
  double gravity = 0;               // [m/s²], ≥ 0
  double stroke_angle = 0;          // of +x above the horizontal [rad]; +y is 90° ahead of +x

  bool lever_turns_fully() const { return pivot_distance < radius; }
};

DataFaults faults_of(const QuickReturnData& data);
std::vector<double> values_of(const QuickReturnData& data);  // all of them
LinkageDrawing drawing_of(const QuickReturnData& data);

// Bodies: crank, lever, block, link, ram. The data must be without faults.
PlanarLinkage linkage_of(const QuickReturnData& data, long double phi);

}  // namespace kurbel
