// vector_plan.h — plans of vectors to scale: velocities and accelerations from their pole, polygons of forces; each in a
// cell of a sheet.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism.h"
#include "studies/sheet/paper.h"

namespace kurbel {

// In the mechanism's axes and SI.
struct VectorPlan {
  struct Arrow {
    std::string name;  // "v_BA"; empty: its end is named
    PlanePoint from, to;
    Pen pen = Pen::body;
  };
  struct Point {
    std::string name;  // "b"
    PlanePoint at;
  };
  std::string title;  // "3"; empty: the cell stays free
  std::vector<Arrow> arrows = {};
  std::vector<Point> points = {};  // the pole first; of a polygon none
};

struct PlansOnSheet {
  std::string what, note;        // in the title block; beside it
  std::string scale, unit;       // "μ_v", "m/s"
  int columns = 0, rows = 0;     // of cells on a sheet at most; 0: as many as are 80 mm or more
  int together = 1;              // rows that one sheet takes
  double direction = 0;          // of the mechanism's +x above the horizontal [rad]
  bool each_to_its_own = false;  // each plan has its own scale; else all have one
};

// In the finest round scales that go into the cells, and on as many sheets as it takes.
void add_plans(Sheets& sheets, const PlansOnSheet& form, const std::vector<VectorPlan>& plans);

}  // namespace kurbel
