// load_kinds.cpp — what resists on a shaft.
#include <fmt/format.h>

#include "drivetrain/loads/loads.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct DragKeys {
  double damping = 0;  // b [N·m·s/rad]
  double inertia = 0;  // [kg·m²]
};
Fields<DragKeys> drag_fields() {
  return Fields<DragKeys>()
      .add(required("damping", "N*m*s/rad", not_negative, "b in M = −b ω"), &DragKeys::damping)
      .add(own_inertia_key(), &DragKeys::inertia);
}

void build_drag(const Section& s, const Reading<DragKeys>& drag, Network& net) {
  net.put(single_shaft(s, drag.inertia, net), s.name, SpeedLoad{Account::harmful, drag.damping, 0});
}

struct LoadKeys {
  double torque = 0;  // M₀ [N·m]
  bool always_backwards = false;
  double viscous = 0, quadratic = 0;  // b [N·m·s/rad], q [N·m·s²/rad²]
  std::optional<CurveData> table;     // [N·m]
  Account work = Account::useful;
  double inertia = 0;  // [kg·m²]
  Window window;
};

void check_load(const Reading<LoadKeys>& load) {
  if (!load.given(&LoadKeys::torque) && !load.given(&LoadKeys::viscous) && !load.given(&LoadKeys::quadratic) &&
      !load.table)
    load.refuse("nothing given; allowed: \"torque\", \"damping\", \"quadratic\", \"table\"");
  if (load.torque < 0 && !load.always_backwards)
    load.refuse(&LoadKeys::torque, fmt::format("torque = {:g} N·m; a load against the motion must be ≥ 0 (with acts = "
                                               "\"always\" it may be negative)",
                                               load.torque));
}

Fields<LoadKeys> load_fields() {
  using Keys = LoadKeys;
  return Fields<Keys>()
      .add(quantity("torque", "N*m", any_number, "constant part M₀"), &Keys::torque)
      .add(choice("acts", "against motion",
                  "the constant part opposes motion and holds at standstill, or acts always backwards (a weight)"),
           &Keys::always_backwards, {{"against motion", false}, {"always", true}})
      .add(defaulted("damping", "N*m*s/rad", "0 N*m*s/rad", not_negative, "b in b ω"), &Keys::viscous)
      .add(defaulted("quadratic", "N*m*s2/rad2", "0 N*m*s2/rad2", not_negative, "q in q ω |ω|: fan, centrifugal pump"),
           &Keys::quadratic)
      .add(curve("table", any_abscissa(), "N*m", "resisting torque over time, angle or speed"), &Keys::table)
      .add(choice("work", "useful", "line of the energy balance"), &Keys::work,
           {{"useful", Account::useful}, {"harmful", Account::harmful}, {"driving", Account::driving}})
      .add(own_inertia_key(), &Keys::inertia)
      .add(window_fields(), &Keys::window)
      .check(check_load);
}

void build_load(const Section& s, const Reading<LoadKeys>& load, Network& net) {
  const int node = single_shaft(s, load.inertia, net);
  const bool with_speed = load.viscous > 0 || load.quadratic > 0;
  const SpeedLoad by_speed{load.work, load.viscous, load.quadratic};
  if (load.always_backwards) {
    if (load.torque != 0) net.put(node, s.name, HarmonicTorque{load.work, -load.torque, 0, 0, 0}, load.window);
    if (with_speed) net.put(node, s.name, by_speed, load.window);
  } else if (load.torque > 0) {
    net.put(node, s.name, OpposingLoad{load.work, load.torque, load.viscous, load.quadratic, 0}, load.window);
  } else if (with_speed) {
    net.put(node, s.name, by_speed, load.window);
  }
  if (load.table)
    put_curve(net, node, s.name, {*load.table, -1, load.work, load.window},
              [&](const std::string& text) { load.refuse(&LoadKeys::table, text); });
}

}  // namespace

std::vector<Kind> load_kinds() {
  return {
      kind_of<drag_fields, build_drag>(on_a_shaft, "bearing drag", "viscous friction against the frame"),
      kind_of<load_fields, build_load>(
          on_a_shaft, "load", "resistance on a shaft: constant, viscous, quadratic, table; several may be given"),
  };
}

}  // namespace kurbel
