// four_bar.h — the four-bar linkage: crank, coupler, rocker on the ground link.
//
//                B             O  crank axis, origin       A  crank pin, OA = crank
//             ,·´ `.           D  rocker's bearing, OD = ground along +x
//         A ,·´     `.         B  coupler pin, AB = coupler, DB = rocker
//          ´. φ     ψ `.
//            O──────────D── x  output: the rocker's angle ψ from +x, counter-clockwise
//
// φ is measured from +x to OA, counter-clockwise. Branches: open, B left of the line A → D; crossed, B right of it, which
// is the mirror image run backwards. The rocker rocks (the crank is the shortest link: crank–rocker, 0 < |ψ| < π) or goes
// round with the crank (the ground is: drag link, double crank).
// A crank that cannot turn fully (double and triple rockers) rocks within CrankArc, on the branch that is given.
//
// Where two links are as long as the two others (crank + ground = coupler + rocker, …) all pass through one line: a
// change point. The motion goes on smoothly there; the branch is that of 0 < φ < π. Open parallelogram: ψ = φ; crossed:
// the antiparallelogram. Kites whose crank is as long as the ground (or with one change point a turn) come back after two
// turns (mechanisms/loops).
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
std::optional<CrankArc> arc_of(const FourBarData& data);  // of a crank that rocks

// Bodies: crank, coupler, rocker. For data without faults.
PlanarLinkage linkage_of(const FourBarData& data, long double phi);

}  // namespace kurbel
