// dense_tables.h — tables with more points than a motion needs: taken by fewer pieces, as exactly as is asked for.
//
// Every point of a table is a place where a law changes and an integration begins anew. A scene that is read takes the dense
// tables of its loads over angle or travel by fewer cubic pieces (Curve::by_fewer_pieces), where they are so few that it pays;
// every study counts what that does among its errors.
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace kurbel {

// Pieces within this part of the accuracy that is asked for.
inline constexpr double tables_of_accuracy = 1.0 / 3;

// The scene with its dense tables taken by pieces that are off by no more than that part of the accuracy of [run], of their
// greatest value: tables of at least 200 points that a third as many pieces come near enough to. Those over speed or time stay,
// for their slopes count, and those whose edges the scene rounds.
Scene with_fewer_points(Scene scene);
// Tables that are taken by fewer pieces by ones that may be off by so many times as much; 0: as they are given.
Scene with_rougher_tables(Scene scene, double times);

// By which part of its greatest value a table of the scene may be off at most; 0: none is taken by fewer pieces.
double tables_within(const Scene& scene);
// What that may leave open of a figure, as part of it: forces that are off by so much at once, and what swings by them.
inline double left_by_tables(const Scene& scene) { return tables_within(scene) / tables_of_accuracy; }

// "cylinder1.load.force (7201 points): by fewer pieces, within 1e-05 of …"; empty: there is none.
std::string words_of_dense_tables(const Scene& scene);

}  // namespace kurbel
