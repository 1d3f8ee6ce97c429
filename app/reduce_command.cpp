// reduce_command.cpp — kurbel reduce: inertia and torques reduced to one link.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/verb.h"
#include "studies/handout/reduce_sheet.h"
#include "studies/reduce/reduce.h"

namespace kurbel::app::reduce_command {
namespace {

struct ReduceArguments {
  StudyOptions study;
  ReduceOptions options;
  std::string speed, basis, at, delta;
  SheetOptions sheet;
  ReduceSheetRequest request;
};

int reduce_with_sheet(const Scene& scene, ReduceArguments& arguments) {
  ReduceSheetRequest& request = arguments.request;
  request.author = arguments.study.author;
  if (!arguments.delta.empty())
    request.delta = quantity_of("--delta", arguments.delta, "a plain number", "0.05", any_number);
  return present_with_sheet(output_of(sheet_of(scene, arguments.options, request)), arguments.study);
}

int reduce_scene(ReduceArguments arguments) {
  arguments.request.paper = paper_of(arguments.sheet, arguments.study);
  for (const auto& [option, value] :
       {std::pair("--delta", arguments.delta), {"--flywheel", arguments.request.flywheel}})
    if (!arguments.sheet.wanted && !value.empty())
      throw std::invalid_argument(
          fmt::format("{} {}: is of the sheet's flywheel; add --sheet, or ask kurbel size", option, value));
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  arguments.options.at = moment_of(arguments.at, arguments.options.speed);
  if (!arguments.speed.empty())
    arguments.options.speed = quantity_of("--speed", arguments.speed, "a speed > 0", "60 rpm", positive);
  if (!arguments.basis.empty() && arguments.basis != "classical" && arguments.basis != "regime")
    throw std::invalid_argument(fmt::format("--basis \"{}\": must be classical or regime", arguments.basis));
  if (!arguments.basis.empty())
    arguments.options.basis = arguments.basis == "classical" ? ReduceBasis::classical : ReduceBasis::regime;
  if (arguments.sheet.wanted) return reduce_with_sheet(scene, arguments);
  return present(output_of(reduce(scene, arguments.options)), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<ReduceArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--positions", arguments->options.positions, "positions over the cycle (default: 12)");
  command.add_option("--to", arguments->options.to,
                     "shaft or slider, e.g. gearbox.in, flywheel, press.slider (default: the crank)");
  command.add_option("--speed", arguments->speed,
                     "of the crank, for torques that depend on it (default: the operating speed)");
  command.add_option("--basis", arguments->basis,
                     "classical (rigid machine at constant speed) or regime (the steady cycle with the scene's "
                     "effects; default where the classical one leaves something out)");
  command.add_option("--at", arguments->at,
                     "the machine as it is at another moment: after \"step 2\" of the sequence, at \"1.5 s\", or at a "
                     "speed such as \"60 rpm\"");
  command.add_option("--orders", arguments->options.orders, "harmonics up to this order (default: 12)");
  add_sheet_options(command, arguments->sheet);
  command.add_option("--delta", arguments->delta,
                     "of the sheet's flywheel: demanded δ, e.g. 1/80 (default: what the machine has with its own)");
  command.add_option("--flywheel", arguments->request.flywheel,
                     "of the sheet: component to size (default: the scene's flywheel, else one on the crank)");
  command.action([&code, arguments] { code = reduce_scene(*arguments); });
}

const Verb verb{{.place = 30,
                 .name = "reduce",
                 .arguments = "scene.toml",
                 .help = "inertia, torques and drive reduced to one shaft or slider",
                 .does = "inertia, torques and the drive's elastic chain on any shaft or slider (`--to`), harmonics; a "
                         "sheet of the positions to be printed (`--sheet`)",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::reduce_command
