// size_command.cpp — kurbel size: the flywheel for a demanded δ.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/verb.h"
#include "studies/size/size.h"

namespace kurbel::app::size_command {
namespace {

struct SizeArguments {
  StudyOptions study;
  SizeOptions options;
  std::string delta, mid_speed, form = "rim", diameter, rim_speed, sheet, basis, at;
};

int size_scene(SizeArguments arguments) {
  SizeOptions& o = arguments.options;
  if (!arguments.delta.empty()) o.delta = quantity_of("--delta", arguments.delta, "a plain number", "0.05", any_number);
  o.at = moment_of(arguments.at, o.mid_speed);
  if (!arguments.mid_speed.empty())
    o.mid_speed = quantity_of("--mid-speed", arguments.mid_speed, "a speed > 0", "60 rpm", positive);
  if (!arguments.diameter.empty())
    o.diameter = quantity_of("--diameter", arguments.diameter, "a length > 0", "1.2 m", positive);
  if (!arguments.rim_speed.empty())
    o.rim_speed = quantity_of("--rim-speed", arguments.rim_speed, "a speed > 0", "30 m/s", positive);
  if (!arguments.sheet.empty()) o.sheet = quantity_of("--sheet", arguments.sheet, "a length > 0", "240 mm", positive);
  if (arguments.form != "rim" && arguments.form != "disc")
    throw std::invalid_argument(fmt::format("--form \"{}\": must be rim or disc", arguments.form));
  if (!arguments.basis.empty() && arguments.basis != "classical" && arguments.basis != "regime")
    throw std::invalid_argument(fmt::format("--basis \"{}\": must be classical or regime", arguments.basis));
  if (!arguments.basis.empty()) o.basis = arguments.basis == "classical" ? SizeBasis::classical : SizeBasis::regime;
  o.form = arguments.form == "disc" ? FlywheelForm::disc : FlywheelForm::rim;
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  Progress progress(arguments.study.quiet);
  o.simulation = simulate_options(arguments.study, progress);
  return present(output_of(size_flywheel(scene, o)), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<SizeArguments>();
  SizeOptions& o = arguments->options;
  add_study_options(command, arguments->study);
  command.add_option("--delta", arguments->delta, "demanded δ = (ω_max − ω_min)/ω_mid, e.g. 0.05, 5% or 1/20");
  command.add_option("--machine", o.machine,
                     "customary δ of a machine in place of --delta: press, pump, \"machine tool\" …");
  command.add_option("--mid-speed", arguments->mid_speed,
                     "(ω_max + ω_min)/2 of the crank, e.g. \"60 1/min\" (default: where drive and mean load balance)");
  add_former_name(command, "--mean-speed", arguments->mid_speed);
  command.add_option(
      "--basis", arguments->basis,
      "classical (constant drive torque, loads of the rigid machine at constant speed) or regime (loads of the steady "
      "cycle with the scene's effects; default where the classical one leaves something out)");
  command.add_option("--at", arguments->at,
                     "the machine as it is at another moment: after \"step 2\" of the sequence, at \"1.5 s\", or at a "
                     "mid speed such as \"60 rpm\"");
  command.add_option("--flywheel", o.flywheel,
                     "component to size (default: the scene's flywheel, else one on the crank)");
  command.add_option("--form", arguments->form, "rim (on spokes; default) or disc");
  command.add_option("--material", o.material, "grey cast iron (default), nodular cast iron, cast steel, steel");
  command.add_option("--diameter", arguments->diameter, "outer diameter (default: by proportion)");
  command.add_option("--rim-speed", arguments->rim_speed, "limit, e.g. \"30 m/s\" (default: the material's)");
  command.add_option("--sheet", arguments->sheet, "length of the diagrams for their scales, e.g. \"240 mm\"");
  command.add_flag(
      "--no-simulation", [&o] { o.simulate = false; }, "do not look for the regime of the sized machine");
  command.action([&code, arguments] { code = size_scene(*arguments); });
}

const Verb verb{{.place = 40,
                 .name = "size",
                 .arguments = "scene.toml --delta 0.05",
                 .help = "the flywheel that keeps the speed's fluctuation δ within bounds",
                 .does = "flywheel for a demanded δ by three methods and with the motor's slope, its dimensions; δ "
                         "reached rigid and elastic",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::size_command
