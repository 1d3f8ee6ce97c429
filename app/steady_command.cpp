// steady_command.cpp — the steady cycle found directly, rigid and elastic side by side.
#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "app/command_line.h"
#include "app/verb.h"
#include "studies/measured/overlay.h"
#include "studies/steady/steady.h"

namespace kurbel::app::steady_command {
namespace {

struct SteadyArguments {
  StudyOptions study;
  std::string effects, mid_speed, at;
  int periods = 1;
  bool no_start = false;
  MeasurementRequest measured;
};

SteadyOptions options_of(const SteadyArguments& arguments, Progress& progress) {
  const SimulateOptions common = simulate_options(arguments.study, progress);
  SteadyOptions options;
  options.watch = common.watch;
  options.traces = common.traces;
  options.start_search = !arguments.no_start;
  if (arguments.periods < 1 || arguments.periods > 64)
    throw std::invalid_argument(fmt::format("--periods {}: must be 1 … 64", arguments.periods));
  options.periods = arguments.periods;
  options.at = moment_of(arguments.at, options.mid_speed);
  if (!arguments.mid_speed.empty()) {
    options.mid_speed = quantity_of("--mid-speed", arguments.mid_speed, "a speed other than 0", "60 rpm", any_number);
    if (*options.mid_speed == 0)
      throw std::invalid_argument(
          fmt::format("--mid-speed \"{}\": must be a speed other than 0, e.g. \"60 rpm\"", arguments.mid_speed));
  }
  return options;
}

int steady(const SteadyArguments& arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  Progress progress(arguments.study.quiet);
  const std::vector<Effects> effects =
      arguments.effects.empty() ? effects_side_by_side(scene) : std::vector{parse_effects(arguments.effects, scene)};
  const SteadyOptions options = options_of(arguments, progress);
  return present(cycles_under(arguments.measured, scene, effects, options), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<SteadyArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--effects", arguments->effects,
                     "none, elasticity, or elasticity:COUPLING,… (default: rigid and the scene's, side by side)");
  command.add_option("--mid-speed", arguments->mid_speed,
                     "(ω_max + ω_min)/2 of the crank, e.g. \"60 1/min\": finds the drive torque that it needs");
  add_former_name(command, "--mean-speed", arguments->mid_speed);
  command.add_option("--at", arguments->at,
                     "the machine as it is at another moment: after \"step 2\" of the sequence, at \"1.5 s\", or at a "
                     "mid speed (default: where its own start leads to)");
  command.add_option("--periods", arguments->periods, "cycles after which the motion repeats (default: 1)");
  add_measured_options(command, arguments->measured);
  command.add_flag("--no-start", arguments->no_start,
                   "skip the start from rest and the gearbox ratio that starts fastest");
  command.action([&code, arguments] { code = steady(*arguments); });
}

const Verb verb{
    {.place = 80,
     .name = "steady",
     .arguments = "scene.toml",
     .help = "the steady cycle directly: its figures, its stability, operating points",
     .does = "the steady cycle directly, rigid and elastic: δ at every shaft, torques, works, Floquet multipliers (is "
             "it stable?), operating points, motor use, start time; `--mid-speed \"60 rpm\"` finds the drive torque "
             "for a speed; `--measured test.csv --map \"T1=torque.main_coupling\"` lays a test's record over the "
             "cycle, its time taken modulo the period",
     .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::steady_command
