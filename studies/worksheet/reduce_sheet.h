// reduce_sheet.h — the classical sheet of the reduced machine: its mechanisms in their positions, torques, works,
// reduced inertia, and the flywheel by Wittenbauer's diagram.
//
// All numbers are results of reduce or of size (theory 2, 3); here they are only drawn on paper.
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
  std::optional<double> delta;  // demanded; default: that of the machine with its present flywheel
  std::string flywheel;         // component, as in size
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

  // Of a function over the study's path, zero at φ = 0: values from position 0 on.
  double from_origin(const Piecewise& work, double way) const;
  double study_way(double way) const;  // of a way from position 0
  std::string html() const;
};

// Throws as reduce does; std::invalid_argument for a machine without a fully rotating mechanism, for a target (`to`)
// other than the link, and as size does for a δ that cannot be reached.
ReduceSheet sheet_of(const Scene& scene, const ReduceOptions& options, const ReduceSheetRequest& request);
// Findings of the reduction, with the sheet as a file: sheet.html.
StudyOutput output_of(ReduceSheet sheet);

}  // namespace kurbel
