// forces_command.cpp — kurbel forces: kinetostatics of a scene's slider-crank.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "app/command_line.h"
#include "app/terminal.h"
#include "studies/forces/forces_output.h"

namespace kurbel::app {
namespace {

struct ForcesArguments {
  StudyOptions study;
  std::string speed, mechanism;
  int positions = 12;
  bool no_run = false;
};

int forces(const ForcesArguments& arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  ForcesOptions options;
  options.positions = arguments.positions;
  options.mechanism = arguments.mechanism;
  options.simulate = !arguments.no_run;
  if (!arguments.speed.empty())
    options.speed = quantity_of("--speed", arguments.speed, "a speed", "300 rpm", any_number);
  Progress progress(arguments.study.quiet);
  options.interrupted = &interrupted();
  options.progress = [&progress](const std::string& what, double fraction) { progress(what, fraction); };
  options.log = make_log(arguments.study.verbose);
  const Forces found = find_forces(scene, options);
  return present(output_of(found), arguments.study);
}

}  // namespace

void add_forces_command(CLI::App& app, int& code) {
  const auto arguments = std::make_shared<ForcesArguments>();
  CLI::App* command = app.add_subcommand(
      "forces",
      "reactions in every joint, balancing torque, friction, shaking forces and counterweights of a slider-crank");
  add_study_options(*command, arguments->study, "forces");
  command->add_option("--positions", arguments->positions, "positions of a turn in the tables (default: 12)");
  command->add_option("--speed", arguments->speed,
                      "speed of the crank in the first problem, e.g. \"300 rpm\" (default: the scene's start speed)");
  command->add_option("--mechanism", arguments->mechanism, "which slider-crank (default: the first)");
  command->add_flag("--no-run", arguments->no_run, "prescribed motion only: do not simulate the machine");
  command->callback([&code, arguments] { code = forces(*arguments); });
}

}  // namespace kurbel::app
