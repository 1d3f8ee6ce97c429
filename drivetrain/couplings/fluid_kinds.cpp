// fluid_kinds.cpp — what transmits by a fluid: hydrodynamic coupling, viscous torsional damper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/couplings/fluid_coupling.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct FluidCouplingKeys {
  double diameter = 0, density = 0;  // D [m], ρ [kg/m³]
  CurveData lambda;                  // λ(ν) [1]
  SideInertias inertia;
};

Fields<FluidCouplingKeys> fluid_coupling_fields() {
  using Keys = FluidCouplingKeys;
  return Fields<Keys>()
      .add(required("diameter", "m", positive, "profile diameter D"), &Keys::diameter)
      .add(defaulted("density", "kg/m3", "870 kg/m3", positive, "ρ of the fluid; oil unless given"), &Keys::density)
      .add(required_curve("lambda", {"speed ratio"}, "1",
                          "λ over ν = ω_slower/ω_faster, ending in [1, 0]; M = λ ρ D⁵ ω²"),
           &Keys::lambda)
      .add(side_inertia_fields(), &Keys::inertia);
}

void build_fluid_coupling(const Section& s, const Reading<FluidCouplingKeys>& coupling, Network& net) {
  const auto [in, out] = two_shafts(s, coupling.inertia, net);
  const CurveData& table = coupling.lambda;
  const auto refuse = [&](const std::string& text) { coupling.refuse(&FluidCouplingKeys::lambda, "lambda: " + text); };
  if (table.period > 0) return refuse("a table over the speed ratio has no period; drop it");
  const Curve lambda = table.curve();
  if (table.x.front() < -1 || table.x.back() != 1 || std::abs(table.y.back()) > 1e-12 * lambda.max_abs())
    return refuse(
        fmt::format("it runs from [{:g}, {:g}] to [{:g}, {:g}]; it must lie within −1 … 1 and end in [1, 0], "
                    "for nothing is transmitted without slip",
                    table.x.front(), table.y.front(), table.x.back(), table.y.back()));
  if (lambda.jumps()) return refuse("it jumps; let it rise within a part of the speed ratio");
  constexpr int samples = 1000;
  double least = *std::min_element(table.y.begin(), table.y.end());
  for (int k = 0; k <= samples; ++k)
    least = std::min(least, lambda.value(table.x.front() + (table.x.back() - table.x.front()) * k / samples));
  if (least < -1e-12 * lambda.max_abs()) return refuse("λ < 0; the faster side always drives the slower one");
  net.limit({.component = s.name,
             .of = "lambda",
             .over = Network::DataRange::Over::ratio_of_speeds,
             .node = in,
             .other = out},
            lambda);
  net.connect(in, out, 1, s.name, FluidCoupling{lambda, coupling.density * std::pow(coupling.diameter, 5)});
}

struct ViscousDamperKeys : ViscousFilm {
  double ring_inertia = 0, inertia = 0;  // [kg·m²]
};

Fields<ViscousDamperKeys> viscous_damper_fields() {
  using Keys = ViscousDamperKeys;
  return Fields<Keys>()
      .add(required("ring_inertia", "kg*m2", positive, "of the free ring"), &Keys::ring_inertia)
      .add(required("damping", "N*m*s/rad", positive, "c of the film between ring and hub"), &Keys::damping)
      .add(own_inertia_key(), &Keys::inertia);
}

void build_viscous_damper(const Section& s, const Reading<ViscousDamperKeys>& damper, Network& net) {
  const int hub = single_shaft(s, damper.inertia, net);
  const int ring = net.add_node(s.name, "ring", damper.ring_inertia);
  net.ports[s.name].others = {{"ring", ring}};
  net.connect(hub, ring, 1, s.name, static_cast<const ViscousFilm&>(damper));
}

}  // namespace

std::vector<Kind> fluid_kinds() {
  return {
      kind_of<fluid_coupling_fields, build_fluid_coupling>(
          between_shafts, "fluid coupling",
          "hydrodynamic coupling by its performance coefficient over the speed ratio; slips always"),
      kind_of<viscous_damper_fields, build_viscous_damper>(
          on_a_shaft, "viscous damper", "ring that is driven by the shaft through a viscous film (Houdaille)"),
  };
}

}  // namespace kurbel
