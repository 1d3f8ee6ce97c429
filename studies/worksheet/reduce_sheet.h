// reduce_sheet.h — the classical sheet of the reduced machine: its mechanisms in their positions, torques, works, reduced
// inertia, and the flywheel by Wittenbauer's diagram.
//
// Every number is one of reduce or of size (theory 2, 3); here they are only set out on paper.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/reduce/reduce.h"
#include "studies/sheet/mechanism_sheets.h"
#include "studies/sheet/paper.h"
#include "studies/size/size.h"

namespace kurbel {

struct ReduceSheetRequest {
  Paper paper;
  std::optional<double> delta;  // demanded; default: what the machine has with the flywheel that it has
  std::string flywheel;         // component, as of size
  std::string author;
};

// Works of the cycle and the flywheel from them.
struct WorksOnSheet {
  Sizing sizing;
  Wittenbauer exact;
  double delta = 0;
  bool demanded = false;
};

struct ReduceSheet {
  ReduceSheetRequest request;
  MachineReduction reduction;
  std::vector<MechanismOnSheet> mechanisms;
  SheetMotion motion;
  std::vector<ReducedPosition> at;  // at each position; before, at and after each: reduction.also
  std::optional<WorksOnSheet> works;
  std::string why_no_works;

  // Of a function over the study's way, zero at φ = 0: from position 0 on.
  double from_origin(const Piecewise& work, double way) const;
  double study_way(double way) const;  // of a way from position 0
  std::string html() const;
};

// Throws as reduce does; std::invalid_argument for a machine without a mechanism that goes round, for a target (`to`)
// other than the link, and as size does where a δ is demanded that cannot be had.
ReduceSheet sheet_of(const Scene& scene, const ReduceOptions& options, const ReduceSheetRequest& request);
// What is said of the reduction, the sheet among the files: sheet.html.
StudyOutput output_of(ReduceSheet sheet);

}  // namespace kurbel
