// forces_command.cpp — kurbel forces: kinetostatics of a scene's mechanism.

#include <memory>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "studies/forces/forces_findings.h"
#include "studies/handout/forces_sheet.h"

namespace kurbel::app::forces_command {
namespace {

struct ForcesArguments {
  StudyOptions study;
  std::string speed, mechanism, effects;
  int positions = 12;
  bool no_run = false;
  SheetOptions sheet;
};

int forces(const ForcesArguments& arguments) {
  const Paper paper = paper_of(arguments.sheet, arguments.study);
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  ForcesOptions options;
  options.positions = arguments.positions;
  options.mechanism = arguments.mechanism;
  options.simulate = !arguments.no_run;
  options.rigid_behind = true;
  if (!arguments.effects.empty()) options.effects = parse_effects(arguments.effects, scene);
  if (!arguments.speed.empty())
    options.speed = quantity_of("--speed", arguments.speed, "a speed", "300 rpm", any_number);
  Progress progress(arguments.study.quiet);
  options.watch = watch_of(arguments.study, progress);
  if (!arguments.sheet.wanted) return present(output_of_forces(scene, options), arguments.study);
  return present_with_sheet(output_of(sheet_of(scene, options, paper, arguments.study.author)), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<ForcesArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--positions", arguments->positions, "positions of a turn in the tables (default: 12)");
  command.add_option("--speed", arguments->speed,
                     "speed of the crank in the first problem, e.g. \"300 rpm\" (default: the scene's start speed)");
  command.add_option(
      "--mechanism", arguments->mechanism,
      "which slider-crank, four-bar, quick-return, inverted slider-crank or knuckle press (default: the first)");
  command.add_option("--effects", arguments->effects,
                     "of the machine in the second problem: none, all, or as in [effects] (default: the scene's, with "
                     "friction in the joints where they have any)");
  command.add_flag("--no-run", arguments->no_run, "prescribed motion only: do not simulate the machine");
  add_sheet_options(command, arguments->sheet);
  command.action([&code, arguments] { code = forces(*arguments); });
}

const Verb verb{
    {.place = 50,
     .name = "forces",
     .arguments = "scene.toml",
     .help = "reactions in every joint of a mechanism, balancing torque, friction, shaking forces, inertia forces of "
             "its links",
     .does = "kinetostatics of any mechanism: reactions in every joint, balancing torque, shaking forces, motion and "
             "inertia forces of every link, its share in I_r; a slider-crank's joint friction and counterweights "
             "(`--speed`, `--positions`, `--mechanism`); a sheet of the positions to be printed (`--sheet`)",
     .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::forces_command
