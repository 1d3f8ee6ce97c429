// diagram.h — a diagram over the cycle with its scales: axes, curves, position numbers below, points of the positions.
#pragma once

#include <string>
#include <vector>

#include "studies/sheet/paper.h"
#include "studies/sheet/positions.h"
#include "studies/sheet/scales.h"

namespace kurbel {

struct SheetCurve {
  std::string symbol;                // "M_c"
  std::vector<double> way, value;    // ascending; two points at one place form a jump
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
  double left = 0;   // of position 0 on paper [mm]
  double cycle = 0;  // [rad]
  double degrees_per_mm = 1;
  double x(double way) const;
  double right() const { return x(cycle); }
  std::string words() const;  // "μ_φ = 0.0349 rad/mm (2°/mm)"
};
AngleAxis angle_axis(double cycle, double left, double width);

// Position of the values on paper.
struct Placed {
  Scale scale;
  double zero = 0;  // height of the value 0 [mm]
  double y(double value) const { return zero - scale.mm(value); }
};

// Space of a diagram's title and its position numbers in its box [mm].
inline constexpr double diagram_head = 6, diagram_foot = 7;

// Ordinates of the positions with their numbers at the foot of the box; letters are placed lower, as they may be
// close to a number, and side by side where they would overlap.
void draw_ordinates(Canvas& canvas, const Box& box, const AngleAxis& axis, const std::vector<SheetPosition>& positions);

// In the finest round scale that fits the box.
Placed draw_diagram(Canvas& canvas, const Box& box, const AngleAxis& axis, const SheetDiagram& diagram,
                    const std::vector<SheetPosition>& positions);

// Diagrams below one another on a sheet of their own, a note at its foot. rows: how many fit there; 0: the diagrams.
void add_diagrams(Sheets& sheets, const std::string& title, double cycle, const std::vector<SheetPosition>& positions,
                  const std::vector<SheetDiagram>& diagrams, const std::string& note, std::size_t rows = 0);

}  // namespace kurbel
