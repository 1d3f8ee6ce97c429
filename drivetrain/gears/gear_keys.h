// gear_keys.h — fields of a gear stage given by the geometry of its teeth.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivetrain/gears/gear_pair.h"
#include "engine/scene/fields.h"

namespace kurbel {

// A list, if given, must have one value for each wheel; other lengths are rejected.
std::string two_wanted(const std::string& key, std::size_t count);
template <class D, class B, class List>
bool has_two(const Reading<D>& reading, List B::*member) {
  std::size_t count = 2;
  if constexpr (requires { (reading.*member).size(); })
    count = (reading.*member).size();
  else if (reading.*member)
    count = (reading.*member)->size();
  return count == 2 || reading.refuse(member, two_wanted(reading.key(member), count));
}

Key teeth_key();  // of both wheels, driving wheel first

struct GearGeometryKeys : GearPairData {
  double width_of_both = 0;         // b [m]; 0: unknown
  std::optional<double> allowance;  // j_bn [m]
  bool is_internal = false;         // the driven wheel
  std::optional<std::vector<double>> shifts, tip_diameters, bores;

  bool is_given() const { return module > 0; }
};
// `gap_effect`: name of the effect that uses the backlash allowance as a gap in the motion; empty: none.
Fields<GearGeometryKeys> gear_geometry_fields(const std::string& gap_effect = "");

// The gear pair of a stage; empty if the stage has no module or the geometry is invalid. `refuse` receives the reason.
std::optional<GearPair> gear_pair_of(const GearGeometryKeys& geometry, const std::vector<int>& teeth,
                                     const std::function<void(const std::string&)>& refuse);

// The stages of a gearbox from its driving side (Network::data).
struct GearStages {
  struct Stage {
    std::array<double, 2> teeth{};  // of the driving and of the driven wheel
    std::optional<GearPair> pair;   // where its module is given
  };
  std::vector<Stage> stages;
};

}  // namespace kurbel
