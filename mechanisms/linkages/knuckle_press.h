// knuckle_press.h — knuckle-joint (toggle) press: crank and rod move the knee joint between a link on a fixed bearing and
// a link to the ram.
//
//        G──────K──────[ram]─ y = guide   O  crank axis, origin           A  crank pin, OA = radius
//         upper ⋮ lower                   G  upper link's bearing (bearing_x, bearing_y)
//               ⋮ rod                     K  knee, AK = rod, GK = upper
//            A ─┘                         ram: on the line y = guide (by default through G), KB = lower towards +x
//          O´ φ from +x to OA             output: the ram's position x from the crank axis
//
// With G on the guide, the ram is at its far end when both links are in line; if the crank moves the knee across this line,
// there are two working ends per turn. Branches: knee left or right of the line A → G.
#pragma once

#include <vector>

#include "mechanisms/linkages/data_fault.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

struct KnucklePressData {
  double radius = 0, rod = 0;           // [m], > 0
  double bearing_x = 0, bearing_y = 0;  // of G [m]
  double upper = 0, lower = 0;          // [m], > 0
  double guide = 0;                     // y of the ram's line [m]
  bool knee_right = false;              // of the line A → G
  LinkBody crank_body, rod_body;        // com from O towards A, from A towards K
  LinkBody upper_body, lower_body;      // com from G towards K, from K towards the ram
  double ram_mass = 0;                  // [kg], ≥ 0
  double gravity = 0;                   // [m/s²], ≥ 0
  double stroke_angle = 0;              // of +x above the horizontal [rad]; +y is 90° ahead of +x
};

DataFaults faults_of(const KnucklePressData& data);
std::vector<double> values_of(const KnucklePressData& data);  // all of them
LinkageDrawing drawing_of(const KnucklePressData& data);

// Bodies: crank, rod, upper link, lower link, ram. The data must be without faults.
PlanarLinkage linkage_of(const KnucklePressData& data, long double phi);

}  // namespace kurbel
