// forces_sheet.h — the classical sheet of a mechanism's forces: the mechanism in its positions, reactions in every
// joint, inertia forces, balancing torque, with uniformly rotating crank (theory 9, first problem).
//
// All numbers are results of the first problem of find_forces.
#pragma once

#include <string>
#include <vector>

#include "studies/forces/forces_findings.h"
#include "studies/sheet/mechanism_sheets.h"
#include "studies/sheet/paper.h"

namespace kurbel {

struct ForcesSheet {
  struct Joint {
    std::string symbol, words;  // "R_12", "crank pin: crank on rod"
    bool slides = false;
  };
  Paper paper;
  std::string author, title, scene_file, speed;
  Forces forces;
  std::vector<MechanismOnSheet> mechanisms;  // the one
  bool weightless = false;                   // the effect gravity is off
  SheetMotion motion;
  std::vector<Joint> joints;
  std::vector<std::string> links;

  // At a position; before, at and after each: forces.also.
  const LinkageForces& at(std::size_t position) const { return forces.also[3 * position + 1].forces; }

  std::string html() const;
};

// Throws as the study does, and std::invalid_argument for a crank that only rocks.
ForcesSheet sheet_of(const Scene& scene, const ForcesOptions& options, const Paper& paper, const std::string& author);
// Findings of the forces, with the sheet as a file: sheet.html.
StudyOutput output_of(ForcesSheet sheet);

}  // namespace kurbel
