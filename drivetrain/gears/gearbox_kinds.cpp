// gearbox_kinds.cpp — gear stages by tooth numbers; inertias and mesh of the wheels given, or from their teeth.
#include "drivetrain/gears/kinds.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/gears/gear_keys.h"
#include "drivetrain/gears/gear_train_keys.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

std::vector<Key> mesh_keys() {
  return {{.name = "mesh",
           .type = KeyType::flag,
           .fallback = "false",
           .doc = "elastic flanks: stiffness c_γα b r_b1² by ISO 6336-1 method B from the geometry"},
          {.name = "mesh_stiffness",
           .unit = "N*m/rad",
           .domain = positive,
           .doc = "of elastic flanks about the driving wheel, in place of mesh"},
          {.name = "mesh_damping_ratio",
           .fallback = "0.05",
           .domain = not_negative,
           .doc = "ζ of elastic flanks, of the two shafts that they join"},
          {.name = "mesh_backlash",
           .unit = "rad",
           .domain = not_negative,
           .doc = "whole gap between elastic flanks, about the driving wheel",
           .effect = "backlash"},
          {.name = "mesh_gap",
           .type = KeyType::flag,
           .fallback = "false",
           .doc = "the backlash of the geometry is a gap between elastic flanks",
           .effect = "backlash"}};
}

std::vector<Key> support_keys() {
  return {{.name = "support_stiffness",
           .unit = "N*m/rad",
           .domain = positive,
           .doc = "of the housing against the frame, about the input shaft; the housing is the frame unless given"},
          {.name = "support_damping",
           .unit = "N*m*s/rad",
           .fallback = "\"0 N*m*s/rad\"",
           .domain = not_negative,
           .doc = "viscous damping of the support"},
          {.name = "housing_inertia",
           .unit = "kg*m2",
           .fallback = "\"0 kg*m2\"",
           .domain = not_negative,
           .doc = "of the housing; needed where its support is elastic"},
          {.name = "reversing",
           .type = KeyType::flag,
           .doc = "the output turns against the input, which the reaction on the housing depends on; default: by the "
                  "number of external stages"}};
}

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
                     joined(joined(gear_geometry_keys(), mesh_keys()), efficiency_keys())),
  }};
  return kinds;
}

// Given, or those of the wheels that teeth, module and width describe.
std::vector<double> inertias_of(const Section& stage, const std::optional<GearPair>& pair, const std::string& what,
                                Messages& messages) {
  if (stage.has("inertia")) return stage["inertia"].numbers;
  if (pair && !stage.has("width"))
    messages.add(stage.where("module"), fmt::format("{}: module without inertia needs the width of the wheels, e.g. "
                                                    "width = \"40 mm\"",
                                                    what));
  if (!pair) return {0, 0};
  return {pair->wheel[0].inertia, pair->wheel[1].inertia};
}

// One stage as it stands in the chain.
struct Stage {
  double ratio = 1;
  std::array<double, 2> inertia{};
  std::optional<GearEfficiency> losses = {};
  std::optional<BacklashData> mesh = {};  // elastic flanks
  bool gap = false;                       // with backlash between them
};

// Stiffness and gap of the flanks, about the driving wheel: given, or by the teeth's geometry.
void read_mesh(const Section& s, const std::optional<GearPair>& pair, const std::string& what, Stage& stage,
               Messages& messages) {
  const bool elastic = s["mesh"].flag || s.given("mesh_stiffness");
  if (!elastic) {
    for (const char* key : {"mesh_damping_ratio", "mesh_backlash", "mesh_gap"})
      if (s.given(key))
        messages.add(s.where(key), fmt::format("{}: \"{}\" needs an elastic mesh; give mesh = true (stiffness by the "
                                               "geometry) or mesh_stiffness",
                                               what, key));
    return;
  }
  BacklashData& mesh = stage.mesh.emplace();
  mesh.given = {Damping::As::ratio, s.number("mesh_damping_ratio"), 0};
  stage.gap = s["mesh_gap"].flag || s.given("mesh_backlash");
  if (!pair && !s.given("mesh_stiffness")) {
    if (!s.given("module"))
      messages.add(s.where("mesh"),
                   fmt::format("{}: mesh = true needs the teeth's geometry, e.g. module = \"4 mm\" and "
                               "width = \"40 mm\", or a mesh_stiffness",
                               what));
    mesh.contact.stiffness = 1;
    return;
  }
  mesh.contact.stiffness = s.given("mesh_stiffness") ? s.number("mesh_stiffness") : mesh_stiffness(*pair).torsional;
  if (mesh.contact.stiffness == 0)
    messages.add(s.where("mesh"),
                 fmt::format("{}: mesh = true needs the width of the wheels, e.g. width = \"40 mm\"", what));
  if (s["mesh_gap"].flag && s.given("mesh_backlash"))
    messages.add(s.where("mesh_backlash"),
                 fmt::format("{}: \"mesh_gap\" and \"mesh_backlash\" both given; keep one", what));
  if (s["mesh_gap"].flag && !pair)
    messages.add(
        s.where("mesh_gap"),
        fmt::format("{}: mesh_gap needs the teeth's geometry, e.g. module = \"4 mm\"; or give mesh_backlash", what));
  mesh.contact.gap = s.given("mesh_backlash") ? s.number("mesh_backlash") : pair ? pair->backlash_angle(0) : 0;
}

std::optional<Stage> read_stage(const Section& s, const std::string& what, Messages& messages) {
  if (!s.sound) return {};
  const std::vector<double>& teeth = s["teeth"].numbers;
  std::optional<GearPair> pair;
  if (teeth.size() == 2) pair = gear_pair_of(s, what, messages);
  const std::vector<double> inertia = inertias_of(s, pair, what, messages);
  if (teeth.size() != 2 || inertia.size() != 2) {
    const std::size_t count = teeth.size() != 2 ? teeth.size() : inertia.size();
    messages.add(s.where(teeth.size() != 2 ? "teeth" : "inertia"),
                 fmt::format("{}: {} has {} value{}; must be two, driving wheel first", what,
                             teeth.size() != 2 ? "teeth" : "inertia", count, count == 1 ? "" : "s"));
    return {};
  }
  Stage stage{.ratio = teeth[1] / teeth[0], .inertia = {inertia[0], inertia[1]}};
  if (gives_efficiency(s)) stage.losses = efficiency_of(s, what, messages);
  read_mesh(s, pair, what, stage, messages);
  if (stage.mesh && stage.losses)
    messages.add(s.where("mesh"),
                 fmt::format("{}: an elastic mesh has no efficiency; give that to another stage", what));
  return stage;
}

// A housing that may turn against the frame: φ_a − φ_h = σ i (σ φ_b − φ_h), σ = −1 where the output reverses.
void put_housing(const Section& s, Network& net, double ratio, bool reverses, const GearEfficiency* losses) {
  Network::Ports& ports = net.ports[s.name];
  const int housing = net.add_node(s.name, "housing", s.number("housing_inertia"));
  const int frame = net.add_node(s.name, "frame", 0);
  net.prescribe(frame, {.time = {0}, .speed = {0}});
  ports.others["housing"] = housing;
  Network::Relation relation{.node = {ports.in, ports.out, housing},
                             .gain = {1, -ratio, (reverses ? -ratio : ratio) - 1},
                             .usual = {1, 1 / ratio, 0},
                             .component = s.name};
  if (losses) {
    relation.lossy = true;
    relation.loss = losses->law();
    relation.words = losses->describe(ratio);
  }
  net.relate(std::move(relation));
  net.connect(housing, frame, 1, s.name,
              CouplingData{s.number("support_stiffness"), {Damping::As::viscous, s.number("support_damping")}},
              "support");
}

// Stages, i = z₂/z₁. Each shaft counts its angle positive in its own direction of drive. Losses or a housing of the
// whole box tie its input to its output; the wheels between then turn with the input.
void build_gearbox(const Section& s, Network& net, Messages& messages) {
  const std::string what = fmt::format("gearbox \"{}\"", s.name);
  const std::vector<Section>& sections = s["stages"].sections;
  if (sections.empty())
    messages.add(s.where("stages"), fmt::format("{}: stages = []; give one or more {{ teeth = [z1, z2] }}", what));
  std::vector<Stage> stages;
  bool reverses = false, sound = !sections.empty();
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const auto stage = read_stage(sections[k], fmt::format("{}: stages[{}]", what, k + 1), messages);
    sound = sound && stage;
    if (stage) stages.push_back(*stage);
    if (stage && !sections[k]["internal"].flag) reverses = !reverses;
  }
  if (s.given("reversing")) reverses = s["reversing"].flag;
  const bool housed = s.given("support_stiffness");
  for (const char* key : {"support_damping", "housing_inertia", "reversing"})
    if (s.given(key) && !housed)
      messages.add(s.where(key),
                   fmt::format("{}: \"{}\" belongs to an elastic support; give support_stiffness", what, key));
  std::optional<GearEfficiency> losses;
  if (gives_efficiency(s)) losses = efficiency_of(s, what, messages);
  const bool whole = housed || losses;
  for (std::size_t k = 0; whole && k < stages.size(); ++k)
    if (stages[k].losses || stages[k].mesh)
      messages.add(sections[k].where(stages[k].mesh ? "mesh" : "teeth"),
                   fmt::format("{}: stages[{}] has {}, and the gearbox {}; keep one", what, k + 1,
                               stages[k].mesh ? "an elastic mesh" : "an efficiency",
                               housed ? "an elastic support" : "an efficiency"));
  if (!sound) return;

  int before = net.add_node(s.name, "in", stages.front().inertia[0]);
  net.ports[s.name].in = before;
  double ratio = 1;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Stage& stage = stages[k];
    const bool last = k + 1 == stages.size();
    if (k > 0) net.nodes[static_cast<std::size_t>(before)].inertia += stage.inertia[0];
    const int driven = net.add_node(s.name, last ? "out" : fmt::format("shaft{}", k + 1), stage.inertia[1]);
    const std::string label = stages.size() == 1 ? "mesh" : fmt::format("mesh{}", k + 1);
    ratio *= stage.ratio;
    if (stage.mesh && stage.gap)
      net.connect(before, driven, stage.ratio, s.name, *stage.mesh, label);
    else if (stage.mesh)
      net.connect(before, driven, stage.ratio, s.name, CouplingData{stage.mesh->contact.stiffness, stage.mesh->given},
                  label);
    else if (!whole || !last)
      join_gear(net, before, driven, stage.ratio, s.name, stage.losses ? &*stage.losses : nullptr);
    before = driven;
  }
  net.ports[s.name].out = before;
  const GearEfficiency* of_all = losses ? &*losses : nullptr;
  if (housed)
    put_housing(s, net, ratio, reverses, of_all);
  else if (losses)
    join_gear(net, net.ports[s.name].in, before, ratio, s.name, of_all);
}

}  // namespace

std::vector<Kind> gearbox_kinds() {
  return {
      {.name = "gearbox",
       .doc = "gear stages by tooth numbers: ideal, or with losses, elastic flanks, an elastic support of the housing",
       .placement = Placement::inline_two,
       .keys = joined(joined({{.name = "stages",
                               .type = KeyType::sections,
                               .doc = "stages from the driving side",
                               .required = true,
                               .nested = &stage_kinds()}},
                             efficiency_keys()),
                      support_keys()),
       .build = build_gearbox,
       .elastic = true},
  };
}

}  // namespace kurbel
