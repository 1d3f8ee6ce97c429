// dense_tables.h — tables with more points than needed, approximated by fewer pieces within the required accuracy.
//
// At every point of a table a law changes and the integration restarts. In a scene that is read, dense tables of loads over
// angle or travel are approximated by fewer cubic pieces (Curve::by_fewer_pieces) if this reduces them enough; every study
// includes the effect in its errors.
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace kurbel {

// Allowed error of the pieces over the required accuracy.
inline constexpr double tables_of_accuracy = 1.0 / 3;

// The scene with its dense tables approximated within that part of the accuracy of [run], relative to their maxima: tables
// of at least 200 points for which a third as many pieces are sufficient. Tables over speed or time are kept because their
// slopes matter, and tables whose edges are rounded by the scene.
Scene with_fewer_points(Scene scene);
// The scene with the allowed error of its approximated tables multiplied by `times`; 0: tables as given.
Scene with_rougher_tables(Scene scene, double times);

// Maximum allowed error of a table of the scene over its maximum; 0: no table is approximated.
double tables_within(const Scene& scene);
// Relative error of a figure by this approximation: direct error of the forces, and vibrations excited by it.
inline double left_by_tables(const Scene& scene) { return tables_within(scene) / tables_of_accuracy; }

// "cylinder1.load.force (7201 points): by fewer pieces, within 1e-05 of …"; empty: no table is approximated.
std::string words_of_dense_tables(const Scene& scene);

}  // namespace kurbel
