// gear_mesh_kinds.cpp — a pair of wheels with elastic teeth.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/gears/gear_keys.h"
#include "drivetrain/gears/gear_mesh.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct MeshKeys {
  std::vector<int> teeth;
  std::optional<double> stiffness, mesh_stiffness;                // [N·m/rad], [N/m]
  std::optional<std::vector<double>> mesh_variation, mesh_phase;  // [1], [rad]
  ContactLaw contact = ContactLaw::no_pulling;
  std::optional<std::vector<double>> inertia;  // [kg·m²]
  Damping damping;
  GearGeometryKeys geometry;
};

Fields<MeshKeys> mesh_fields() {
  using Keys = MeshKeys;
  return Fields<Keys>()
      .add(teeth_key(), &Keys::teeth)
      .add(quantity("stiffness", "N*m/rad", positive,
                    "mean stiffness about the driving wheel; default: ISO 6336-1 method B from module and width"),
           &Keys::stiffness)
      .add(quantity("mesh_stiffness", "N/m", positive,
                    "mean stiffness along the line of action, in its place; needs the module"),
           &Keys::mesh_stiffness)
      .add(quantity("mesh_variation", "", {.low = -1, .high = 1},
                    "amplitudes a_n of the stiffness's harmonics of the tooth frequency, over its mean",
                    "mesh_variation"),
           &Keys::mesh_variation)
      .add(quantity("mesh_phase", "rad", any_number, "their phases ψ_n; default: 0"), &Keys::mesh_phase)
      .add(choice("contact", "no pulling", "law of contact of the flanks where a backlash is given (backlash.h)"),
           &Keys::contact, {{"no pulling", ContactLaw::no_pulling}, {"clipped", ContactLaw::clipped}})
      .add(quantity("inertia", "kg*m2", not_negative,
                    "of the driving and of the driven wheel, each on its own shaft; default: from module and "
                    "width, else 0"),
           &Keys::inertia)
      .add(damping_fields(), &Keys::damping)
      .add(gear_geometry_fields("backlash"), &Keys::geometry);  // an effect here; in an ideal stage only stated
}

// Mean stiffness about the driving wheel: as it is, along the line of action, or estimated from the teeth.
double stiffness_of(const Reading<MeshKeys>& m, const std::optional<GearPair>& pair) {
  using Keys = MeshKeys;
  const auto refuse = [&](auto member, const std::string& text) {
    m.refuse(member, text);
    return 1.0;
  };
  if (!m.keep_one(&Keys::stiffness, &Keys::mesh_stiffness)) return 1;
  if (m.stiffness) return *m.stiffness;
  if (!pair)
    return refuse(&Keys::stiffness,
                  "\"stiffness\" is missing; give it, or \"module\" with \"mesh_stiffness\" or \"width\"");
  if (m.mesh_stiffness) return *m.mesh_stiffness * std::pow(0.5 * pair->wheel[0].base_diameter, 2);
  if (m.geometry.width_of_both == 0)
    return refuse(&Keys::geometry,
                  "\"width\" is missing: the stiffness estimated from the teeth needs it; or give \"stiffness\"");
  return mesh_stiffness(*pair).torsional;
}

MeshVariation variation_of(const Reading<MeshKeys>& m) {
  using Keys = MeshKeys;
  MeshVariation variation;
  variation.teeth = m.teeth[0];
  m.drop_without(&Keys::mesh_variation, &Keys::mesh_phase);
  if (!m.mesh_variation) return variation;
  const std::vector<double>& amplitudes = *m.mesh_variation;
  const std::vector<double> phases = m.mesh_phase.value_or(std::vector<double>{});
  double sum = 0;
  for (std::size_t n = 0; n < amplitudes.size(); ++n) {
    variation.harmonic.push_back({amplitudes[n], n < phases.size() ? phases[n] : 0});
    sum += std::abs(amplitudes[n]);
  }
  if (sum >= 1)
    m.refuse(&Keys::mesh_variation, fmt::format("the amplitudes of mesh_variation add up to {:g}; must be < 1, or the "
                                                "stiffness could vanish",
                                                sum));
  if (phases.size() > amplitudes.size())
    m.refuse(&Keys::mesh_phase,
             fmt::format("{} phases for {} harmonics of mesh_variation", phases.size(), amplitudes.size()));
  return variation;
}

template <class Data>
void connect_mesh(const Section& s, Network& net, int in, int out, double ratio, const Data& contact,
                  const MeshVariation& variation) {
  if (variation.harmonic.empty())
    net.connect(in, out, ratio, s.name, contact);
  else
    net.connect(in, out, ratio, s.name, MeshData<Data>{contact, variation});
}

void build_gear_mesh(const Section& s, const Reading<MeshKeys>& m, Network& net) {
  if (!has_two(m, &MeshKeys::teeth) || !has_two(m, &MeshKeys::inertia)) return;
  const std::optional<GearPair> pair =
      gear_pair_of(m.geometry, m.teeth, [&](const std::string& text) { m.refuse(&MeshKeys::geometry, text); });
  if (!m.valid()) return;
  std::array<double, 2> inertia{};
  if (m.inertia)
    inertia = {m.inertia->at(0), m.inertia->at(1)};
  else if (pair)
    inertia = {pair->wheel[0].inertia, pair->wheel[1].inertia};
  const auto [in, out] = two_shafts(s, {inertia[0], inertia[1]}, net);
  const double ratio = static_cast<double>(m.teeth[1]) / m.teeth[0], stiffness = stiffness_of(m, pair);
  if (m.geometry.allowance.value_or(0) > 0) net.data.add(s.name, StatedPlay{});
  const MeshVariation variation = variation_of(m);
  if (m.geometry.allowance && pair) {
    BacklashData contact;
    contact.contact.law = m.contact;
    contact.contact.stiffness = stiffness;
    contact.contact.gap = pair->backlash_angle(0);
    contact.given = m.damping;
    connect_mesh(s, net, in, out, ratio, contact, variation);
  } else {
    connect_mesh(s, net, in, out, ratio, CouplingData{stiffness, m.damping}, variation);
  }
}

}  // namespace

std::vector<Kind> gear_mesh_kinds() {
  return {
      kind_of<mesh_fields, build_gear_mesh>(
          elastic_between_shafts, "gear mesh",
          "pair of wheels with elastic teeth, mean and tooth-frequency stiffness; ideal when its elasticity is off"),
  };
}

}  // namespace kurbel
