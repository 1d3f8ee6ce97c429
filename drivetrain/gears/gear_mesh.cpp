// gear_mesh.cpp — the mesh in words, and its plainer forms: without variation, without a gap.
#include "drivetrain/gears/gear_mesh.h"

#include <fmt/format.h>

#include "engine/elements/any_connection.h"
#include "engine/scene/effects.h"

namespace kurbel {

template <class Contact>
std::string VaryingMesh<Contact>::describe() const {
  std::string text;
  if constexpr (Contact::is.described) text = Contact::describe() + "; ";
  text += fmt::format("mesh stiffness varies {} times in a turn of the driving wheel", variation.teeth);
  for (std::size_t n = 0; n < variation.harmonic.size(); ++n)
    text += fmt::format("{} {:.4g} %", n == 0 ? ", by harmonics" : ",", 100 * variation.harmonic[n].amplitude);
  return text;
}

template <class Data>
ConnectionForm under(const MeshData<Data>& given, const Effects& effects) {
  if constexpr (std::is_same_v<Data, BacklashData>) {
    if (!effects.backlash) {
      const CouplingData flanks_touch = given.contact.without_gap();
      if (!effects.mesh_variation) return connection_form(flanks_touch);
      return connection_form(MeshData<CouplingData>{flanks_touch, given.variation});
    }
  }
  return effects.mesh_variation ? nullptr : connection_form(given.contact);
}

template struct VaryingMesh<Coupling>;
template struct VaryingMesh<Backlash>;
template ConnectionForm under(const MeshData<CouplingData>&, const Effects&);
template ConnectionForm under(const MeshData<BacklashData>&, const Effects&);

}  // namespace kurbel
