// diagram.h — a diagram over the cycle with its scales: axes, curves, the positions' numbers below, their points on it.
#pragma once

#include <string>
#include <vector>

#include "studies/sheet/paper.h"
#include "studies/sheet/positions.h"
#include "studies/sheet/scales.h"

namespace kurbel {

struct SheetCurve {
  std::string symbol;                // "M_c"
  std::vector<double> way, value;    // ascending; two points at one place make a jump
  std::vector<double> at_positions;  // values there; empty: not marked
  Pen pen = Pen::main;
};

struct SheetDiagram {
  std::string title;        // "Torques on the crank"
  std::string scale, unit;  // "μ_M", "N·m"
  std::vector<SheetCurve> curves;
};

// The axis of the angle, common to the diagrams of a sheet.
struct AngleAxis {
  double left = 0;   // of position 0 on the paper [mm]
  double cycle = 0;  // [rad]
  double degrees_per_mm = 1;
  double x(double way) const;
  double right() const { return x(cycle); }
  std::string words() const;  // "μ_φ = 0.0349 rad/mm (2°/mm)"
};
AngleAxis angle_axis(double cycle, double left, double width);

// Where the values lie on the paper.
struct Placed {
  Scale scale;
  double zero = 0;  // height of the value 0 [mm]
  double y(double value) const { return zero - scale.mm(value); }
};

// What a diagram's title and its positions' numbers take of its box [mm].
inline constexpr double diagram_head = 6, diagram_foot = 7;

// Ordinates of the positions with their numbers at the box's foot; letters stand lower, for they may be close to a
// number, and beside each other where they would meet.
void draw_ordinates(Canvas& canvas, const Box& box, const AngleAxis& axis, const std::vector<SheetPosition>& positions);

// In the finest round scale that goes into the box.
Placed draw_diagram(Canvas& canvas, const Box& box, const AngleAxis& axis, const SheetDiagram& diagram,
                    const std::vector<SheetPosition>& positions);

}  // namespace kurbel
