// dense_tables.h — tables with more points than a motion needs: taken by fewer pieces, as exactly as is asked for.
//
// Every point of a table is a place where a law changes and an integration begins anew. A study that counts what it does
// among its errors may take a dense table of a load over angle or travel by fewer cubic pieces (Curve::by_fewer_pieces).
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace kurbel {

// Points from which on a table is dense.
inline constexpr std::size_t dense_points = 1000;

// The scene with its dense tables taken by fewer pieces that are off by no more than this part of their greatest value;
// 0: as given. Those over speed or time stay, for their slopes count, and those whose edges the scene rounds.
Scene with_tables_within(Scene scene, double within);

// By which part of its greatest value a table of the scene may be off at most; 0: none is taken by fewer pieces.
double tables_within(const Scene& scene);

// Pieces within this part of the accuracy that is asked for.
inline constexpr double tables_of_accuracy = 1.0 / 3;
inline Scene with_fewer_points(const Scene& scene) {
  return with_tables_within(scene, tables_of_accuracy * scene.run.accuracy);
}
// What that may leave open of a figure, as part of it: forces that are off by so much at once, and what swings by them.
inline double left_by_tables(const Scene& scene) { return tables_within(scene) / tables_of_accuracy; }

// "cylinder1.load.force (7201 points): by fewer pieces, within 1e-05 of …"; empty: there is none.
std::string words_of_dense_tables(const Scene& scene);

}  // namespace kurbel
