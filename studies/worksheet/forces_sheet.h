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

// Forces at one position, of any mechanism.
struct ForcesAt {
  struct Reaction {
    Force2 force;       // [N]
    double moment = 0;  // of a slide [N·m]
  };
  struct Inertia {
    Force2 force;       // −m a_S [N]
    double couple = 0;  // −I ε [N·m]
  };
  double phi = 0, load = 0, torque = 0;  // [rad], [N] or [N·m], [N·m]
  std::vector<Reaction> reactions;       // of the joints
  std::vector<Inertia> inertia;          // of the links
};

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
  std::vector<ForcesAt> looks;  // before, at and after each position
  std::vector<ForcesAt> at;     // at each
  std::vector<ForcesAt> curve;  // over the cycle, ascending
  std::vector<double> way;

  std::string html() const;
};

// Throws as the study does, and std::invalid_argument for a crank that only rocks.
ForcesSheet sheet_of(const Scene& scene, const ForcesOptions& options, const Paper& paper, const std::string& author);
// Findings of the forces, with the sheet as a file: sheet.html.
StudyOutput output_of(ForcesSheet sheet);

}  // namespace kurbel
