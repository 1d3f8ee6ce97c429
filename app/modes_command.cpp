// modes_command.cpp — kurbel modes: natural frequencies, critical speeds, forced response.

#include <memory>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "studies/modes/modes.h"

namespace kurbel::app::modes_command {
namespace {

struct ModesArguments {
  StudyOptions study;
  std::string effects, speed, at, angle, torque;
  std::vector<std::string> range, spots;
  int count = 20, spot_checks = 2;
  bool no_misfires = false;
  double orders = 0, barred = 1;
};

double speed_of(const std::string& option, const std::string& text, const Domain& domain) {
  return quantity_of(option, text, "a speed", "300 rpm", domain);
}

int modes(const ModesArguments& arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  ModesOptions options;
  options.count = arguments.count;
  options.orders = arguments.orders;
  options.barred_factor = arguments.barred;
  options.spot_checks = arguments.spot_checks;
  for (const std::string& spot : arguments.spots) options.spots.push_back(speed_of("--spot", spot, positive));
  options.torque = arguments.torque;
  options.misfires = !arguments.no_misfires;
  if (!arguments.speed.empty()) options.speed = speed_of("--speed", arguments.speed, any_number);
  options.at = moment_of(arguments.at, options.speed);
  if (!arguments.angle.empty())
    options.angle = quantity_of("--angle", arguments.angle, "an angle", "90 deg", any_number);
  if (!arguments.range.empty()) {
    options.slowest = speed_of("--range", arguments.range[0], not_negative);
    options.fastest = speed_of("--range", arguments.range[1], positive);
  }
  Progress progress(arguments.study.quiet);
  options.watch = watch_of(arguments.study, progress);
  const Effects effects = arguments.effects.empty() ? effects_of_modes(scene) : parse_effects(arguments.effects, scene);
  return present(output_of(find_modes(scene, effects, options)), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<ModesArguments>();
  add_study_options(command, arguments->study);
  command.add_option(
      "--effects", arguments->effects,
      "as in [effects], or elasticity:COUPLING,... (default: the scene's, with all elasticity where it has none)");
  command.add_option("--count", arguments->count, "number of modes (default: 20)");
  command.add_option(
      "--speed", arguments->speed,
      "operating point, e.g. \"300 rpm\" of the reduction link (default: where the scene's own start leads to)");
  command.add_option("--at", arguments->at,
                     "as the machine is after a step of its sequence or at a time: \"step 2\", \"1.5 s\"");
  command.add_option("--angle", arguments->angle,
                     "holds the reduction link at an angle instead of averaging over the cycle, e.g. \"90 deg\"");
  command
      .add_option("--range", arguments->range, "two speeds that the forced response spans, e.g. \"0 rpm\" \"3000 rpm\"")
      .values(2);
  command.add_option("--orders", arguments->orders, "highest excitation order (default: 12 … 24)");
  command.add_option("--barred", arguments->barred,
                     "bars speeds where a joint without limits swings by more than this times its mean or the rated "
                     "torque (default: 1)");
  command.add_option("--spot-checks", arguments->spot_checks,
                     "speeds of the range, where most is borne, at which the nonlinear cycle is held against the "
                     "response (default: 2; 0: none)");
  command.add_option("--spot", arguments->spots, "another such speed, e.g. \"250 rpm\"; may be given again")
      .one_value_each_time();
  command.add_flag("--no-misfires", arguments->no_misfires,
                   "where stresses of shafts are judged: leaves out the same as one cylinder after the other misfires");
  command.add_option("--torque", arguments->torque,
                     "simulates the scene and analyses this component's torque: spectrum, orders, waterfall, rainflow");
  command.action([&code, arguments] { code = modes(*arguments); });
}

const Verb verb{
    {.place = 70,
     .name = "modes",
     .arguments = "scene.toml",
     .help = "natural frequencies, shapes, critical speeds, forced response over the speed, limits, spectra",
     .does = "natural frequencies, shapes, damping; Campbell diagram; forced response by orders, barred speeds, "
             "parametric zones, limits after DIN 740-2, stresses of shafts after IACS UR M68; spectrum of a simulated "
             "torque (`--count`, `--speed`, `--range`, `--orders`, `--spot-checks`, `--torque`)",
     .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::modes_command
