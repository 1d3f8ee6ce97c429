// gearbox_kinds.cpp — gear stages by tooth numbers; inertias and mesh of the wheels given, or from their teeth.
#include <fmt/format.h>

#include <array>
#include <optional>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/gears/gear_keys.h"
#include "drivetrain/gears/gear_train_keys.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// Elastic flanks of a stage.
struct FlankKeys {
  bool mesh = false;                     // their stiffness is that of the geometry
  std::optional<double> mesh_stiffness;  // about the driving wheel [N·m/rad]
  double mesh_damping_ratio = 0;         // ζ
  std::optional<double> mesh_backlash;   // [rad]
  bool mesh_gap = false;                 // the backlash of the geometry

  bool elastic() const { return mesh || mesh_stiffness; }
};
struct StageKeys : FlankKeys {
  std::vector<int> teeth;
  std::optional<std::vector<double>> inertia;  // [kg·m²]
  GearGeometryKeys geometry;
  EfficiencyKeys losses;
};

Fields<StageKeys> flank_fields(Fields<StageKeys> fields) {
  using Keys = StageKeys;
  return fields
      .add(flag("mesh", "false", "elastic flanks: stiffness c_γα b r_b1² by ISO 6336-1 method B from the geometry"),
           &Keys::mesh)
      .add(quantity("mesh_stiffness", "N*m/rad", positive,
                    "of elastic flanks about the driving wheel, in place of mesh"),
           &Keys::mesh_stiffness)
      .add(defaulted("mesh_damping_ratio", "", "0.05", not_negative,
                     "ζ of elastic flanks, of the two shafts that they join"),
           &Keys::mesh_damping_ratio)
      .add(quantity("mesh_backlash", "rad", not_negative, "whole gap between elastic flanks, about the driving wheel",
                    "backlash"),
           &Keys::mesh_backlash)
      .add(flag("mesh_gap", "false", "the backlash of the geometry is a gap between elastic flanks", "backlash"),
           &Keys::mesh_gap);
}

const Tables<Reading<StageKeys>>& stages() {
  using Keys = StageKeys;
  static const auto made = [] {
    auto tables = Tables<Reading<Keys>>().add(
        "stage", "one pair of wheels",
        flank_fields(Fields<Keys>()
                         .add(teeth_key(), &Keys::teeth)
                         .add(quantity("inertia", "kg*m2", not_negative,
                                       "inertia of the driving and of the driven wheel, each on its own shaft; "
                                       "default: from module and width, else 0"),
                              &Keys::inertia)
                         .add(gear_geometry_fields(), &Keys::geometry))
            .add(efficiency_fields(), &Keys::losses));
    tables.numbered = true;
    return tables;
  }();
  return made;
}

struct GearboxKeys {
  std::vector<Reading<StageKeys>> stages;
  EfficiencyKeys losses;
  std::optional<double> support_stiffness;          // [N·m/rad]
  double support_damping = 0, housing_inertia = 0;  // [N·m·s/rad], [kg·m²]
  std::optional<bool> reversing;
};

Fields<GearboxKeys> gearbox_fields() {
  using Keys = GearboxKeys;
  return Fields<Keys>()
      .add({.name = "stages", .doc = "stages from the driving side", .required = true}, &Keys::stages, stages())
      .add(efficiency_fields(), &Keys::losses)
      .add(quantity("support_stiffness", "N*m/rad", positive,
                    "of the housing against the frame, about the input shaft; the housing is the frame unless "
                    "given"),
           &Keys::support_stiffness)
      .add(defaulted("support_damping", "N*m*s/rad", "0 N*m*s/rad", not_negative, "viscous damping of the support"),
           &Keys::support_damping)
      .add(defaulted("housing_inertia", "kg*m2", "0 kg*m2", not_negative,
                     "of the housing; needed where its support is elastic"),
           &Keys::housing_inertia)
      .add({.name = "reversing",
            .doc = "the output turns against the input, which the reaction on the housing depends on; default: by "
                   "the number of external stages"},
           &Keys::reversing);
}

// One stage as it stands in the chain.
struct Stage {
  double ratio = 1;
  std::array<double, 2> inertia{};
  std::optional<GearEfficiency> losses = {};
  std::optional<BacklashData> mesh = {};  // elastic flanks
  bool gap = false;                       // with backlash between them
  GearStages::Stage data = {};
};

// Stiffness and gap of the flanks, about the driving wheel: given, or by the teeth's geometry.
void read_mesh(const Reading<StageKeys>& s, const std::optional<GearPair>& pair, Stage& stage) {
  using Keys = StageKeys;
  if (!s.elastic()) {
    const auto refuse = [&](auto member) {
      if (s.given(member))
        s.refuse(member, fmt::format("\"{}\" needs an elastic mesh; give mesh = true (stiffness by the geometry) or "
                                     "mesh_stiffness",
                                     s.key(member)));
    };
    refuse(&Keys::mesh_damping_ratio);
    refuse(&Keys::mesh_backlash);
    refuse(&Keys::mesh_gap);
    return;
  }
  BacklashData& mesh = stage.mesh.emplace();
  mesh.given = {Damping::As::ratio, s.mesh_damping_ratio, 0};
  stage.gap = s.mesh_gap || s.mesh_backlash;
  if (!pair && !s.mesh_stiffness) {
    if (!s.geometry.is_given())
      s.refuse(&Keys::mesh,
               "mesh = true needs the teeth's geometry, e.g. module = \"4 mm\" and width = \"40 mm\", or a "
               "mesh_stiffness");
    mesh.contact.stiffness = 1;
    return;
  }
  mesh.contact.stiffness = s.mesh_stiffness ? *s.mesh_stiffness : mesh_stiffness(*pair).torsional;
  if (mesh.contact.stiffness == 0)
    s.refuse(&Keys::mesh, "mesh = true needs the width of the wheels, e.g. width = \"40 mm\"");
  if (s.mesh_gap) s.keep_one(&Keys::mesh_gap, &Keys::mesh_backlash);
  if (s.mesh_gap && !pair)
    s.refuse(&Keys::mesh_gap, "mesh_gap needs the teeth's geometry, e.g. module = \"4 mm\"; or give mesh_backlash");
  mesh.contact.gap = s.mesh_backlash ? *s.mesh_backlash : pair ? pair->backlash_angle(0) : 0;
}

// Inertias are given, or those of the wheels that teeth, module and width describe.
std::optional<Stage> stage_of(const Reading<StageKeys>& s) {
  using Keys = StageKeys;
  std::optional<GearPair> pair;
  if (s.teeth.size() == 2)
    pair = gear_pair_of(s.geometry, s.teeth, [&](const std::string& text) { s.refuse(&Keys::geometry, text); });
  if (!s.inertia && pair && s.geometry.width_of_both == 0)
    s.refuse(&Keys::geometry, "module without inertia needs the width of the wheels, e.g. width = \"40 mm\"");
  if (!has_two(s, &Keys::teeth) || !has_two(s, &Keys::inertia)) return {};
  Stage stage{.ratio = static_cast<double>(s.teeth[1]) / s.teeth[0]};
  if (s.inertia)
    stage.inertia = {s.inertia->at(0), s.inertia->at(1)};
  else if (pair)
    stage.inertia = {pair->wheel[0].inertia, pair->wheel[1].inertia};
  if (s.given(&Keys::losses)) stage.losses = s.losses;
  read_mesh(s, pair, stage);
  stage.data = {{1.0 * s.teeth[0], 1.0 * s.teeth[1]}, std::move(pair)};
  if (stage.mesh && stage.losses)
    s.refuse(&Keys::mesh, "an elastic mesh has no efficiency; give that to another stage");
  return stage;
}

// All of them, or none where one is unsound.
std::vector<Stage> stages_of(const Reading<GearboxKeys>& box) {
  std::vector<Stage> all;
  bool valid = !box.stages.empty();
  if (!valid) box.refuse(&GearboxKeys::stages, "stages = []; give one or more { teeth = [z1, z2] }");
  for (const Reading<StageKeys>& keys : box.stages) {
    const std::optional<Stage> stage = stage_of(keys);
    valid = valid && stage;
    if (stage) all.push_back(*stage);
    const bool housed = box.support_stiffness.has_value(), whole = housed || box.given(&GearboxKeys::losses);
    if (stage && whole && (stage->losses || stage->mesh)) {
      const std::string has = stage->mesh ? "an elastic mesh" : "an efficiency";
      const std::string text =
          fmt::format("{} has {}, and the gearbox {}; keep one", keys.what().substr(box.what().size() + 2), has,
                      housed ? "an elastic support" : "an efficiency");
      box.messages().add(stage->mesh ? keys.where(&StageKeys::mesh) : keys.where(&StageKeys::teeth),
                         box.what() + ": " + text);
    }
  }
  return valid ? all : std::vector<Stage>{};
}

// A housing that may turn against the frame: φ_a − φ_h = σ i (σ φ_b − φ_h), σ = −1 where the output reverses.
void put_housing(const std::string& name, const GearboxKeys& box, Network& net, double ratio, bool reverses,
                 const GearEfficiency* losses) {
  Network::Ports& ports = net.ports[name];
  const int housing = net.add_node(name, "housing", box.housing_inertia);
  const int frame = net.add_node(name, "frame", 0);
  net.prescribe(frame, {.time = {0}, .speed = {0}});
  ports.others["housing"] = housing;
  Network::Relation relation{.node = {ports.in, ports.out, housing},
                             .gain = {1, -ratio, (reverses ? -ratio : ratio) - 1},
                             .usual = {1, 1 / ratio, 0},
                             .component = name};
  if (losses) {
    relation.lossy = true;
    relation.loss = losses->law();
    relation.words = losses->describe(ratio);
  }
  net.relate(std::move(relation));
  net.connect(housing, frame, 1, name,
              CouplingData{box.support_stiffness.value(), {Damping::As::viscous, box.support_damping}}, "support");
}

bool reverses(const GearboxKeys& box) {
  bool odd = false;
  for (const StageKeys& stage : box.stages) odd = odd != !stage.geometry.is_internal;
  return box.reversing.value_or(odd);
}

// Stages, i = z₂/z₁. Each shaft counts its angle positive in its own direction of drive. Losses or a housing of the
// whole box tie its input to its output; the wheels between then turn with the input.
void build_gearbox(const Section& s, const Reading<GearboxKeys>& box, Network& net) {
  using Keys = GearboxKeys;
  const std::vector<Stage> stages = stages_of(box);
  const bool housed = box.support_stiffness.has_value();
  const auto needs_support = [&](auto member) {
    if (box.given(member) && !housed)
      box.refuse(member, fmt::format("\"{}\" belongs to an elastic support; give support_stiffness", box.key(member)));
  };
  needs_support(&Keys::support_damping);
  needs_support(&Keys::housing_inertia);
  needs_support(&Keys::reversing);
  if (stages.empty()) return;
  GearStages data;
  for (const Stage& stage : stages) data.stages.push_back(stage.data);
  net.data.add(s.name, std::move(data));

  const GearEfficiency* losses = box.given(&Keys::losses) ? &box.losses : nullptr;
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
    else if (!(housed || losses) || !last)
      join_gear(net, before, driven, stage.ratio, s.name, stage.losses ? &*stage.losses : nullptr);
    before = driven;
  }
  net.ports[s.name].out = before;
  if (housed)
    put_housing(s.name, box, net, ratio, reverses(box), losses);
  else if (losses)
    join_gear(net, net.ports[s.name].in, before, ratio, s.name, losses);
}

}  // namespace

std::vector<Kind> gearbox_kinds() {
  return {
      kind_of<gearbox_fields, build_gearbox>(
          elastic_between_shafts, "gearbox",
          "gear stages by tooth numbers: ideal, or with losses, elastic flanks, an elastic support of the housing"),
  };
}

}  // namespace kurbel
