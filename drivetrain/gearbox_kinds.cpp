// gearbox_kinds.cpp — ideal gear stages by tooth numbers; inertias of the wheels given, or from their teeth.
#include "drivetrain/kinds.h"

#include <fmt/format.h>

#include "drivetrain/gear_keys.h"
#include "drivetrain/shared_keys.h"
#include "engine/network.h"

namespace kurbel {
namespace {

const std::vector<Kind>& stage_kinds() {
  static const std::vector<Kind> kinds = {{
      .name = "stage",
      .doc = "one pair of wheels",
      .placement = Placement::nested,
      .keys = joined({{.name = "teeth",
                       .type = KeyType::integers,
                       .domain = {.low = 1, .high = 100000},
                       .doc = "teeth of the driving and of the driven wheel",
                       .required = true},
                      {.name = "inertia",
                       .type = KeyType::quantities,
                       .unit = "kg*m2",
                       .domain = not_negative,
                       .doc = "inertia of the driving and of the driven wheel, each on its own shaft; "
                              "default: from module and width, else 0"}},
                     gear_geometry_keys()),
  }};
  return kinds;
}

// Given, or those of the wheels that teeth, module and width describe.
std::vector<double> inertias_of(const Section& stage, const std::string& what, Messages& messages) {
  if (stage["teeth"].numbers.size() != 2) return {0, 0};  // said by the caller
  const std::optional<GearPair> pair = gear_pair_of(stage, what, messages);
  if (stage.has("inertia")) return stage["inertia"].numbers;
  if (pair && !stage.has("width"))
    messages.add(stage.where("module"), fmt::format("{}: module without inertia needs the width of the wheels, e.g. "
                                                    "width = \"40 mm\"",
                                                    what));
  if (!pair) return {0, 0};
  return {pair->wheel[0].inertia, pair->wheel[1].inertia};
}

// Ideal stages; i = z₂/z₁. Each shaft counts its angle positive in its own direction of drive.
void build_gearbox(const Section& s, Network& net, Messages& messages) {
  const std::vector<Section>& stages = s["stages"].sections;
  if (stages.empty())
    messages.add(s.where("stages"),
                 fmt::format("gearbox \"{}\": stages = []; give one or more {{ teeth = [z1, z2] }}", s.name));
  int before = -1;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Section& stage = stages[k];
    if (!stage.sound) return;
    const std::vector<double>& teeth = stage["teeth"].numbers;
    const std::vector<double> inertia =
        inertias_of(stage, fmt::format("gearbox \"{}\": stages[{}]", s.name, k + 1), messages);
    if (teeth.size() != 2 || inertia.size() != 2) {
      const std::size_t count = teeth.size() != 2 ? teeth.size() : inertia.size();
      messages.add(stage.where(teeth.size() != 2 ? "teeth" : "inertia"),
                   fmt::format("gearbox \"{}\": stages[{}]: {} has {} value{}; must be two, driving wheel first",
                               s.name, k + 1, teeth.size() != 2 ? "teeth" : "inertia", count, count == 1 ? "" : "s"));
      return;
    }
    if (before < 0) {
      before = net.add_node(s.name, "in", inertia[0]);
      net.ports[s.name].in = before;
    } else {
      net.nodes[static_cast<std::size_t>(before)].inertia += inertia[0];
    }
    const bool last = k + 1 == stages.size();
    const int driven = net.add_node(s.name, last ? "out" : fmt::format("shaft{}", k + 1), inertia[1]);
    net.join(before, driven, teeth[1] / teeth[0], s.name);
    before = driven;
  }
  net.ports[s.name].out = before;
}

}  // namespace

std::vector<Kind> gearbox_kinds() {
  return {
      {.name = "gearbox",
       .doc = "ideal gear stages by tooth numbers",
       .placement = Placement::inline_two,
       .keys = {{.name = "stages",
                 .type = KeyType::sections,
                 .doc = "stages from the driving side",
                 .required = true,
                 .nested = &stage_kinds()}},
       .build = build_gearbox},
  };
}

}  // namespace kurbel
