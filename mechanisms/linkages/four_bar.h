// four_bar.h — the four-bar linkage: crank, coupler, rocker on the ground link.
//
//                B             O  crank axis, origin       A  crank pin, OA = crank
//             ,·´ `.           D  rocker's bearing, OD = ground along +x
//         A ,·´     `.         B  coupler pin, AB = coupler, DB = rocker
//          ´. φ     ψ `.
//            O──────────D── x  output: the rocker's angle ψ from +x, counter-clockwise
//
// φ is measured from +x to OA, counter-clockwise. Branches: open, B left of the line A → D; crossed, B right of it, which
// is the mirror image in reverse. The rocker rocks (shortest link: crank; crank–rocker, 0 < |ψ| < π) or turns fully with
// the crank (shortest link: ground; drag link, double crank).
// A crank that cannot turn fully (double and triple rockers) rocks within CrankArc, on the given branch.
//
// If two links together are as long as the other two (crank + ground = coupler + rocker, …), all links pass through one
// line: a change point. The motion is continued smoothly; the branch is that of 0 < φ < π. Open parallelogram: ψ = φ;
// crossed: the antiparallelogram. The cycle of kites with the crank as long as the ground (or with one change point per
// turn) is two turns (mechanisms/loops).
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/linkages/data_fault.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/loops.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

struct FourBarData {
  double crank = 0, coupler = 0, rocker = 0, ground = 0;  // lengths [m], > 0
  bool crossed = false;
  LinkBody crank_body, coupler_body, rocker_body;  // com from O towards A, from A towards B, from D towards B
  double gravity = 0;                              // [m/s²], ≥ 0
  double ground_angle = 0;                         // of +x above the horizontal [rad]; +y is 90° ahead of +x

  FourBarLoop loop() const { return {crank, coupler, rocker, ground}; }
};

DataFaults faults_of(const FourBarData& data);
std::vector<double> values_of(const FourBarData& data);  // all of them
LinkageDrawing drawing_of(const FourBarData& data);
std::optional<CrankArc> arc_of(const FourBarData& data);  // range of a rocking crank

// Bodies: crank, coupler, rocker. The data must be without faults.
PlanarLinkage linkage_of(const FourBarData& data, long double phi);

}  // namespace kurbel
