// reduce_command.cpp — kurbel reduce: inertia and torques reduced to one link.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/verb.h"
#include "studies/reduce/reduce.h"

namespace kurbel::app {
namespace {

struct ReduceArguments {
  StudyOptions study;
  ReduceOptions options;
  std::string speed, basis, at;
};

int reduce_scene(ReduceArguments arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  arguments.options.at = moment_of(arguments.at, arguments.options.speed);
  if (!arguments.speed.empty())
    arguments.options.speed = quantity_of("--speed", arguments.speed, "a speed > 0", "60 rpm", positive);
  if (!arguments.basis.empty() && arguments.basis != "classical" && arguments.basis != "regime")
    throw std::invalid_argument(fmt::format("--basis \"{}\": must be classical or regime", arguments.basis));
  if (!arguments.basis.empty())
    arguments.options.basis = arguments.basis == "classical" ? ReduceBasis::classical : ReduceBasis::regime;
  return present(output_of(reduce(scene, arguments.options)), arguments.study);
}

void set_up(CLI::App& command, int& code) {
  const auto arguments = std::make_shared<ReduceArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--positions", arguments->options.positions, "positions over the cycle (default: 12)");
  command.add_option("--to", arguments->options.to,
                     "shaft or slider, e.g. gearbox.in, flywheel, press.slider (default: the crank)");
  command.add_option("--speed", arguments->speed,
                     "of the crank, for torques that depend on it (default: the operating speed)");
  command.add_option(
      "--basis", arguments->basis,
      "classical (rigid machine at constant speed) or regime (the steady cycle with the scene's effects; "
      "default where the classical one leaves something out)");
  command.add_option("--at", arguments->at,
                     "the machine as it is at another moment: after \"step 2\" of the sequence, at \"1.5 s\", or at a "
                     "speed such as \"60 rpm\"");
  command.add_option("--orders", arguments->options.orders, "harmonics up to this order (default: 12)");
  command.callback([&code, arguments] { code = reduce_scene(*arguments); });
}

const Verb verb{{.place = 30,
                 .name = "reduce",
                 .arguments = "scene.toml",
                 .help = "inertia, torques and drive reduced to one shaft or slider",
                 .does = "inertia, torques and the drive's elastic chain on any shaft or slider (`--to`), harmonics",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app
