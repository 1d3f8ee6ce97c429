// gear_mesh.cpp — the mesh in words, and its plainer forms: without variation, without a gap.
#include "drivetrain/gears/gear_mesh.h"

#include <fmt/format.h>

namespace kurbel {

template <class Contact>
std::string VaryingMesh<Contact>::describe() const {
  std::string text;
  if constexpr (requires(const Contact& c) { c.describe(); }) text = Contact::describe() + "; ";
  text += fmt::format("mesh stiffness varies {} times in a turn of the driving wheel", variation.teeth);
  for (std::size_t n = 0; n < variation.harmonic.size(); ++n)
    text += fmt::format("{} {:.4g} %", n == 0 ? ", by harmonics" : ",", 100 * variation.harmonic[n].amplitude);
  return text;
}

template <class Data>
std::shared_ptr<ConnectionMaker> MeshData<Data>::with(const Effects& effects) const {
  std::shared_ptr<ConnectionMaker> plainer;
  if constexpr (std::is_same_v<Data, BacklashData>) {
    if (!effects.backlash) {
      const CouplingData flanks_touch = contact.without_gap();
      if (effects.mesh_variation)
        return std::make_shared<ConnectionMakerOf<VaryingMesh<Coupling>, MeshData<CouplingData>>>(
            MeshData<CouplingData>{flanks_touch, variation});
      return std::make_shared<ConnectionMakerOf<Coupling, CouplingData>>(flanks_touch);
    }
  }
  if (effects.mesh_variation) return nullptr;
  return std::make_shared<ConnectionMakerOf<typename Data::Element, Data>>(contact);
}

template struct VaryingMesh<Coupling>;
template struct VaryingMesh<Backlash>;
template struct MeshData<CouplingData>;
template struct MeshData<BacklashData>;

}  // namespace kurbel
