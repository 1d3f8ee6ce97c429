// export_question.cpp — kurbel export: a machine for the tools of others.
#include <fmt/format.h>

#include <filesystem>

#include "library/export/export_machine.h"
#include "studies/question/question.h"
#include "studies/sweep/program_version.h"

namespace kurbel {
namespace {

StudyOutput exported(const Inquiry& inquiry, ExportRequest asked) {
  const std::filesystem::path path(inquiry.scene.file);
  ExportedComponent component = component_of(inquiry.scene, asked);
  component.machine.version = program_version();
  const std::string archive = packed(component, asked.fmi, path.has_parent_path() ? path.parent_path().string() : ".");
  const ExportedMachine& machine = component.machine;
  StudyOutput output;
  output.title = fmt::format("{} as a component of FMI {}.0", machine.title, asked.fmi);
  output.scene_file = inquiry.scene.file;
  const char* const kind = !machine.model_exchange  ? "co-simulation"
                           : !machine.co_simulation ? "model exchange"
                                                    : "co-simulation and model exchange";
  std::size_t states = 0, indicators = 0;
  for (const ExportedVariable& v : component.view.variables) {
    states += v.role == ExportedVariable::Role::state ? 1 : 0;
    indicators += v.role == ExportedVariable::Role::indicator ? 1 : 0;
  }
  output.conclude(true, fmt::format("{}.fmu holds the machine for {} by FMI {}.0: {} states, {} event indicators, {} "
                                    "inputs, {} parameters, {} outputs; {:.2g} MB.",
                                    machine.name, kind, asked.fmi, states, indicators, machine.inputs.size(),
                                    machine.parameters.size(), machine.outputs.size() + machine.peaks.size(),
                                    1e-6 * static_cast<double>(archive.size())));
  const Chapter results = output.chapter("Ports");
  const auto list = [&](const char* heading, const char* key, std::vector<std::string> lines) {
    if (!lines.empty())
      output.say(results, Sentences{.lines = std::move(lines),
                                    .title = heading,
                                    .heading = heading,
                                    .indent = "  ",
                                    .key = key,
                                    .apart = true});
  };
  std::vector<std::string> inputs, parameters, outputs = machine.outputs;
  for (const ExportedInput& in : machine.inputs)
    inputs.push_back(
        in.what == ExportedInput::What::torque ? fmt::format("{} [N·m]", in.name)
        : in.what == ExportedInput::What::speed
            ? fmt::format("{} [rad/s]", in.name)
            : fmt::format("{}, {}", in.name, in.whole ? "0 or 1" : fmt::format("{:g} … {:g}", in.low, in.high)));
  for (const ExportedParameter& p : machine.parameters)
    parameters.push_back(fmt::format("{} = {:g} {} ({})", p.path, p.start, p.unit, p.tunable ? "tunable" : "fixed"));
  outputs.insert(outputs.end(), machine.peaks.begin(), machine.peaks.end());
  list("Inputs", "inputs", inputs);
  list("Parameters", "parameters", parameters);
  list("Outputs", "outputs", outputs);
  output.files.emplace_back(machine.name + ".fmu", archive);
  return output;
}

OptionsOf<ExportRequest> options() {
  using Asked = ExportRequest;
  return OptionsOf<Asked>()
      .add({.name = "fmi", .doc = "version of the standard: 3 (default) or 2"}, &Asked::fmi,
           std::vector{std::pair("3", 3), std::pair("2", 2)})
      .add({.name = "kind", .doc = "cs (co-simulation), me (model exchange) or both (default)"}, &Asked::kind,
           std::vector{std::pair("cs", ExportKind::co_simulation), std::pair("me", ExportKind::model_exchange),
                       std::pair("both", ExportKind::both)})
      .add({.name = "input",
            .doc = "what others set while it runs: NAME.command of a motor, clutch or brake, NAME.torque on a shaft, "
                   "NAME.speed of a prescribed speed",
            .each_time = true},
           &Asked::inputs)
      .add({.name = "parameter",
            .doc = "a quantity of the scene that others may set: main_coupling.stiffness",
            .each_time = true},
           &Asked::parameters)
      .add({.name = "output",
            .doc = "what others see: a channel, torque.main_coupling (default: all), or with --kind cs an extreme "
                   "within each step, peak_torque.main_coupling",
            .each_time = true},
           &Asked::outputs)
      .add({.name = "effects", .doc = "in place of the scene's, as in kurbel run"}, &Asked::effects)
      .add({.name = "name", .doc = "of the component (default: of the scene's file)"}, &Asked::name);
}

}  // namespace

Question export_question() {
  return make_question(
      {.place = 120,
       .name = "export",
       .arguments = "scene.toml --fmi 3 --input motor.command",
       .help = "the machine as a component of FMI 2.0 or 3.0 for other simulators",
       .does = "the machine as a component (FMU) for co-simulation and model exchange by FMI 2.0 or 3.0, Linux on "
               "x86-64: inputs, parameters and outputs by their names; needs no compiler"},
      options(), exported);
}

}  // namespace kurbel
