// ports.cpp — inputs become steps of the operating sequence at its begin, and elements that follow a command.
#include "library/fmi/ports.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "drivetrain/kinds.h"
#include "engine/base/find_by.h"
#include "engine/model/network.h"
#include "engine/reading/read_scene.h"
#include "mechanisms/kinds/kinds.h"

namespace kurbel {
namespace {

// M = c · unit, c its command: a torque that comes from outside. None: what a prescribed speed follows.
struct TorqueFromOutside {
  double unit = 1;  // [N·m]
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true};
  template <class T>
  T torque(const ShaftState<T>& x) const {
    return T(unit * x.command);
  }
  bool opens_at_zero() const { return false; }
  bool uses_time() const { return true; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};

// "gearbox.stages[2].module": a segment with its place in a list, from 1; 0: no list.
struct Segment {
  std::string name;
  std::size_t item = 0;
};
std::vector<Segment> segments_of(const std::string& path) {
  std::vector<Segment> segments;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    Segment segment{path.substr(begin, end - begin)};
    if (const std::size_t open = segment.name.find('['); open != std::string::npos && segment.name.ends_with(']')) {
      const char* const last = segment.name.data() + segment.name.size() - 1;
      if (std::from_chars(segment.name.data() + open + 1, last, segment.item).ptr != last) segment.item = 0;
      segment.name.resize(open);
    }
    segments.push_back(std::move(segment));
    begin = end + 1;
  }
  return segments;
}

void put_number(DocumentValue& table, std::span<const Segment> path, double value, const std::string& unit) {
  const std::string& name = path.front().name;
  auto* found = find_by(table.entries, &DocumentEntry::key, name);
  if (!found) {
    if (path.size() > 1) throw std::invalid_argument(fmt::format("the scene has no table \"{}\"", name));
    table.entries.push_back({name, table.at, {}});
    found = &table.entries.back();
  }
  DocumentValue* to = &found->value;
  if (path.front().item > 0) {
    if (path.front().item > to->items.size()) throw std::invalid_argument(fmt::format("\"{}\" has no such item", name));
    to = &to->items[path.front().item - 1];
  }
  if (path.size() > 1) return put_number(*to, path.subspan(1), value, unit);
  const Location at = to->at, end = to->end;
  *to = {};
  to->at = at, to->end = end;
  to->type = unit.empty() ? DocumentValue::Type::number : DocumentValue::Type::text;
  to->number = value;
  if (!unit.empty()) to->text = fmt::format("{} {}", value, unit);
}

}  // namespace

const std::vector<Kind>& exported_kinds() {
  static const std::vector<Kind> all = [] {
    std::vector<Kind> kinds = drivetrain_kinds();
    for (Kind& kind : mechanism_kinds()) kinds.push_back(std::move(kind));
    return kinds;
  }();
  return all;
}

FoundNumber number_at(const Scene& scene, const std::string& path) {
  const std::vector<Segment> segments = segments_of(path);
  const Section* section = segments.front().item == 0 ? scene.find(segments.front().name) : nullptr;
  for (std::size_t k = 1; section && k < segments.size(); ++k) {
    const Setting* setting = section->find(segments[k].name);
    if (!setting) return {};
    const Key* const key = section->kind->key(segments[k].name);
    if (k + 1 == segments.size()) {
      if (!key || key->type != KeyType::quantity || segments[k].item > 0) return {};
      return {setting, key};
    }
    const std::size_t item = segments[k].item > 0 ? segments[k].item - 1 : 0;
    section = item < setting->sections.size() ? &setting->sections[item] : nullptr;
  }
  return {};
}

Scene scene_of(const ExportedMachine& machine, const std::string& folder, std::span<const double> parameters) {
  DocumentValue document = machine.document;
  for (std::size_t k = 0; k < machine.parameters.size(); ++k)
    if (const ExportedParameter& parameter = machine.parameters[k]; parameters[k] != parameter.start)
      put_number(document, segments_of(parameter.path), parameters[k], parameter.unit);
  Scene scene = scene_from(std::move(document), "", folder + "/" + machine.file, exported_kinds());
  if (!machine.effects.empty()) scene.effects = parse_effects(machine.effects, scene);
  return scene;
}

int node_of(const Network& network, const std::string& shaft) {
  const std::size_t dot = shaft.find('.');
  const Network::Ports& ports = network.ports.at(shaft.substr(0, dot));
  if (dot == std::string::npos) return ports.in;
  const std::string port = shaft.substr(dot + 1);
  const auto other = ports.others.find(port);
  return other != ports.others.end() ? other->second : port == "in" ? ports.in : ports.out;
}

std::shared_ptr<const Model> model_of(ExportedMachine& machine, const Scene& given, std::span<const double> inputs) {
  const TableBook::Open book(machine.tables);
  Scene scene = given;
  Network network = build_network(scene);
  std::vector<SequenceStep> first;
  for (std::size_t k = 0; k < machine.inputs.size(); ++k) {
    const ExportedInput& input = machine.inputs[k];
    first.push_back({.when = SequenceStep::When::at, .value = 0, .set = {input.target()}, .to = inputs[k]});
    if (input.what == ExportedInput::What::command) continue;
    const int node = node_of(network, input.of);
    const bool torque = input.what == ExportedInput::What::torque;
    network.put(node, input.target(), TorqueFromOutside{torque ? 1.0 : 0.0});
    if (torque) continue;
    const int given = network.nodes[static_cast<std::size_t>(node)].prescribed;
    if (given < 0) throw std::invalid_argument(fmt::format("the speed of \"{}\" is not prescribed", input.of));
    network.prescribed[static_cast<std::size_t>(given)].follows = input.target();
  }
  scene.sequence.steps.insert(scene.sequence.steps.begin(), first.begin(), first.end());
  return compile_network(std::move(network), scene, scene.effects);
}

std::vector<std::size_t> commands_of(const ExportedMachine& machine, const Model& model) {
  std::vector<std::size_t> places;
  for (const ExportedInput& input : machine.inputs) {
    const int command = model.command_of(input.target());
    if (command < 0) throw std::invalid_argument(fmt::format("\"{}\" takes no command", input.of));
    places.push_back(static_cast<std::size_t>(command));
  }
  return places;
}

}  // namespace kurbel
