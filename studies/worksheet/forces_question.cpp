// forces_question.cpp — kurbel forces: kinetostatics of a scene's mechanism.
#include "studies/forces/forces_findings.h"
#include "studies/worksheet/forces_sheet.h"
#include "studies/worksheet/sheet_options.h"

namespace kurbel {
namespace {

struct ForcesRequest : ForcesOptions {
  SheetRequest sheet;
};

StudyOutput forces_in_joints(const Inquiry& inquiry, ForcesRequest asked) {
  asked.rigid_behind = true;
  asked.watch = inquiry.watch;
  if (const std::optional<Paper> paper = asked.sheet.sheet())
    return output_of(sheet_of(inquiry.scene, asked, *paper, inquiry.author));
  return output_of(find_forces(inquiry.scene, asked));
}

}  // namespace

Question forces_question() {
  return make_question(
      {.place = 50,
       .name = "forces",
       .arguments = "scene.toml",
       .help = "reactions in every joint of a mechanism, balancing torque, friction, shaking forces, inertia forces of "
               "its links",
       .does =
           "kinetostatics of any mechanism: reactions in every joint, balancing torque, shaking forces, motion and "
           "inertia forces of every link, its share in I_r, friction of the joints; a slider-crank's counterweights "
           "(`--speed`, `--positions`, `--mechanism`); a sheet of the positions to be printed (`--sheet`)"},
      OptionsOf<ForcesRequest>()
          .add({.name = "positions",
                .doc = "positions of a turn in the tables (default: 12)",
                .domain = {.low = 4, .high = 3600}},
               &ForcesOptions::positions)
          .add({.name = "speed",
                .doc = "speed of the crank in the first problem, e.g. \"300 rpm\" (default: the scene's start speed)",
                .example = "300 rpm",
                .what = "a speed"},
               &ForcesOptions::speed)
          .add(arc_range(), OptionForm::several, take_arc_range<ForcesRequest>)
          .add({.name = "mechanism",
                .doc = "which slider-crank, four-bar, quick-return, inverted slider-crank, knuckle press or linkage "
                       "(default: the first)"},
               &ForcesOptions::mechanism)
          .add({.name = "effects",
                .doc = "of the machine in the second problem: none, all, or as in [effects] (default: the scene's, "
                       "with friction in the joints where they have any)"},
               &ForcesOptions::effects)
          .add({.name = "no_run", .doc = "prescribed motion only: do not simulate the machine"},
               &ForcesOptions::simulate, false)
          .add(sheet_options(), &ForcesRequest::sheet),
      forces_in_joints);
}

}  // namespace kurbel
