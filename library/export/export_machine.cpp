// export_machine.cpp — checks whether a scene can be exported, with reasons; the archive of a component.
#include "library/export/export_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "engine/run/checkpoint.h"
#include "engine/scene/document.h"
#include "library/export/archive.h"
#include "library/fmi/ports.h"
#include "studies/files/sha256.h"

namespace kurbel {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("cannot be exported: " + why); }

// A name that a C function may have.
std::string identifier(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) && c > 0 ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) name.insert(name.begin(), '_');
  return name;
}

void refuse_unsupported_effects(const Scene& scene) {
  if (scene.run.model != "reduced" || scene.effects.multibody)
    refuse(
        "its mechanisms are evaluated by Simbody (model, multibody), which a component does not hold; the reduced "
        "model says the same");
  for (const Section& section : scene.components) {
    const auto is = [&](const Kind& kind) { return kind.name == section.kind->name; };
    if (std::none_of(exported_kinds().begin(), exported_kinds().end(), is))
      refuse(fmt::format("\"{}\" is an element of one's own, \"{}\", whose code is not in the run-time", section.name,
                         section.kind->name));
  }
}

// Files with points of characteristics, as the scene names them.
void list_files(const DocumentValue& value, std::vector<std::string>& files) {
  for (const DocumentEntry& entry : value.entries) {
    if ((entry.key == "file" || entry.key == "return_file") && entry.value.type == DocumentValue::Type::text)
      files.push_back(entry.value.text);
    list_files(entry.value, files);
  }
  for (const DocumentValue& item : value.items) list_files(item, files);
}
std::vector<std::string> files_of(const DocumentValue& document, const std::string& folder) {
  std::vector<std::string> files;
  list_files(document, files);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    if (path.is_absolute() || path.lexically_normal().string().starts_with(".."))
      refuse(fmt::format("it takes points from \"{}\", outside of the scene's folder; put the file beside the scene",
                         file));
    if (read_text_file(folder + "/" + file, max_scene_bytes * 4).starts_with("PK"))
      refuse(fmt::format("it takes points from a spreadsheet, \"{}\"; save it as .csv", file));
  }
  return files;
}

// Tries whether a component accepts these values.
bool takes(ExportedMachine machine, const Scene& scene, std::size_t input, double value) {
  std::vector<double> values;
  for (const ExportedInput& one : machine.inputs) values.push_back(one.start);
  values[input] = value;
  try {
    model_of(machine, scene, values);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

void add_inputs(ExportedMachine& machine, const Scene& scene, const std::vector<std::string>& asked) {
  for (const std::string& name : asked) {
    const std::size_t dot = name.rfind('.');
    const std::string of = name.substr(0, dot), what = dot == std::string::npos ? "" : name.substr(dot + 1);
    const std::string component = of.substr(0, of.find('.'));
    ExportedInput input{.of = of, .name = name};
    if (what != "command" && what != "torque" && what != "speed")
      refuse(
          fmt::format("input {}: must end in .command (of a motor, clutch or brake), .torque (on a shaft) or .speed "
                      "(of a prescribed speed)",
                      name));
    const Section* const section = scene.find(component);
    if (!section) {
      std::vector<std::string> names;
      for (const Section& section : scene.components) names.push_back(section.name);
      refuse(fmt::format("input {}: the scene has no component {}{}", name, in_quotes(component),
                         suggestion(component, names)));
    }
    if (std::any_of(machine.inputs.begin(), machine.inputs.end(), [&](const auto& one) { return one.name == name; }))
      refuse(fmt::format("input {} is given twice", name));
    if (what == "torque") {
      input.what = ExportedInput::What::torque;
    } else if (what == "speed") {
      if (section->kind->name != "prescribed speed")
        refuse(
            fmt::format("input {}: \"{}\" turns at whatever speed its torques take it to; the speed of a component of "
                        "kind \"prescribed speed\" can come from outside, and {}.torque",
                        name, component, of));
      if (machine.model_exchange)
        refuse(
            fmt::format("input {}: the acceleration of a speed that comes from outside is known in co-simulation "
                        "alone; give --kind cs",
                        name));
      const Network network = build_network(scene);
      const int given = network.nodes[static_cast<std::size_t>(node_of(network, of))].prescribed;
      const PrescribedSpeed& law = network.prescribed[static_cast<std::size_t>(given)];
      input.what = ExportedInput::What::speed;
      input.start = law.value(0, law.piece(0));
    } else {
      for (const SequenceStep& step : scene.sequence.steps)
        if (std::find(step.set.begin(), step.set.end(), of) != step.set.end())
          refuse(fmt::format("input {}: the operating sequence sets {}, too; take it out of the sequence", name, of));
      input.start = 1, input.low = -1, input.high = 10;
    }
    machine.inputs.push_back(std::move(input));
  }
  if (scene.sequence.repeat && !machine.inputs.empty())
    refuse("an operating sequence that repeats would set the inputs again; take the repetition out, or the inputs");
  for (std::size_t k = 0; k < machine.inputs.size(); ++k) {
    ExportedInput& input = machine.inputs[k];
    if (input.what != ExportedInput::What::command) continue;
    if (!takes(machine, scene, k, -1)) input.low = 0;
    input.whole = !takes(machine, scene, k, 0.5);
    if (input.whole) input.high = 1;
  }
}

// With another value the machine has the same states and the same rigidly connected shafts.
bool is_tunable(ExportedMachine machine, const std::string& folder, std::size_t parameter, Equations& usual,
                const std::vector<double>& inputs) {
  std::vector<double> values;
  for (const ExportedParameter& one : machine.parameters) values.push_back(one.start);
  values[parameter] = values[parameter] == 0 ? 1e-3 : 1.001 * values[parameter];
  try {
    Equations other(model_of(machine, scene_of(machine, folder, values), inputs), false);
    const Checkpoint here{{0, usual.start(0), usual.modes()}, {}, {}, {}};
    checkpoint_from(text_of(here, usual), other);
    return other.model().gain_of_node == usual.model().gain_of_node &&
           other.model().node_ratio == usual.model().node_ratio;
  } catch (const std::exception&) {
    return false;  // this value makes no machine
  }
}

void add_parameters(ExportedMachine& machine, const Scene& scene, const std::vector<std::string>& asked) {
  for (const std::string& path : asked) {
    const FoundNumber found = number_at(scene, path);
    if (!found.setting)
      refuse(
          fmt::format("parameter {}: the scene has no such quantity; name one that it gives, as "
                      "main_coupling.stiffness, or gearbox.stages[2].module",
                      path));
    machine.parameters.push_back(
        {.path = path, .unit = found.key->unit, .doc = found.key->doc, .start = found.setting->number});
  }
}

constexpr const char* licences =
    "This component holds parts of other programs:\n"
    "SUNDIALS (BSD 3-clause), KLU, BTF and COLAMD and AMD of SuiteSparse (KLU and BTF: GNU LGPL 2.1 or later; COLAMD,\n"
    "AMD: BSD 3-clause), Eigen (MPL 2.0), {fmt} (MIT), JSON for Modern C++ (MIT), linked statically. KLU and BTF may "
    "be\n"
    "replaced: the sources that the run-time is built from are kurbel's, which builds it anew with other versions.\n";

std::string in_html(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return safe;
}

std::string front_page(const ExportedMachine& machine) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title></head><body>\n<h1>{0}</h1>\n"
      "<p>A machine of {1}, exported from {2}. Its variables with their units are in modelDescription.xml; speeds and "
      "torques are positive in the positive sense of their shafts.</p>\n"
      "<p><a href=\"licenses/license.txt\">Licences</a></p>\n</body></html>\n",
      in_html(machine.title.empty() ? machine.name : machine.title), in_html(machine.version), in_html(machine.file));
}

}  // namespace

ExportedComponent component_of(const Scene& given, const ExportRequest& asked) {
  Scene scene = given;
  if (!asked.effects.empty()) scene.effects = parse_effects(asked.effects, scene);
  refuse_unsupported_effects(scene);
  const std::filesystem::path path(scene.file);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  ExportedMachine machine{.name = identifier(asked.name.empty() ? path.stem().string() : asked.name),
                          .title = scene.title,
                          .file = path.filename().string(),
                          .effects = asked.effects,
                          .document = parse_toml(scene.text, scene.file),
                          .model_exchange = asked.kind != ExportKind::co_simulation,
                          .co_simulation = asked.kind != ExportKind::model_exchange};
  files_of(machine.document, folder);
  add_inputs(machine, scene, asked.inputs);
  add_parameters(machine, scene, asked.parameters);
  // Made as in the run-time, from the document, so that every required table enters the book.
  std::vector<double> parameters, inputs;
  for (const ExportedParameter& one : machine.parameters) parameters.push_back(one.start);
  for (const ExportedInput& one : machine.inputs) inputs.push_back(one.start);
  Equations equations(model_of(machine, scene_of(machine, folder, parameters), inputs), false);
  for (std::size_t k = 0; k < machine.parameters.size(); ++k)
    machine.parameters[k].tunable = is_tunable(machine, folder, k, equations, inputs);
  const std::vector<Channel> channels = channels_of(equations.model(), equations.model().network.components);
  for (const std::string& name : asked.outputs) {
    const bool channel =
        std::any_of(channels.begin(), channels.end(), [&](const Channel& c) { return c.name.text == name; });
    const std::vector<ExtremeOf> extremes = extremes_of(equations.model());
    const bool peak =
        std::any_of(extremes.begin(), extremes.end(), [&](const ExtremeOf& e) { return e.name.text == name; });
    if (!channel && peak && machine.model_exchange)
      refuse(fmt::format("{}: extremes within a step are known in co-simulation alone; give --kind cs", name));
    (!channel && peak ? machine.peaks : machine.outputs).push_back(name);
  }
  if (asked.outputs.empty())
    for (const Channel& channel : channels) machine.outputs.push_back(channel.name.text);
  ExportedView view(machine, equations);
  ExportedDependencies dependencies = dependencies_of(machine, view, equations);
  return {std::move(machine), scene.run.until, scene.run.accuracy, std::move(view), std::move(dependencies)};
}

std::string packed(const ExportedComponent& given, int fmi, const std::string& scene_folder) {
  ExportedComponent component = given;
  ExportedMachine& machine = component.machine;
  machine.token.clear();
  const std::string mark = sha256(machine.text() + std::string(run_time_image()) + std::to_string(fmi));
  machine.token = fmt::format("{{{}-{}-{}-{}-{}}}", mark.substr(0, 8), mark.substr(8, 4), mark.substr(12, 4),
                              mark.substr(16, 4), mark.substr(20, 12));
  const std::string binary = fmi == 3 ? "binaries/x86_64-linux/" : "binaries/linux64/";
  std::vector<std::pair<std::string, std::string>> files = {
      {"modelDescription.xml", model_description(component, fmi)},
      {binary + machine.name + ".so", std::string(run_time_image())},
      {"resources/machine.json", machine.text()},
      {"documentation/index.html", front_page(machine)},
      {"documentation/licenses/license.txt", licences}};
  for (const std::string& file : files_of(machine.document, scene_folder))
    files.emplace_back("resources/" + file, read_text_file(scene_folder + "/" + file, max_scene_bytes * 4));
  return zip_of(files);
}

}  // namespace kurbel
