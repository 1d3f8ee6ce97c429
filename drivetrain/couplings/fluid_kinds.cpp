// fluid_kinds.cpp — what transmits by a fluid: hydrodynamic coupling, viscous torsional damper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/couplings/fluid_coupling.h"
#include "drivetrain/couplings/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_fluid_coupling(const Section& s, Network& net, Messages& messages) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out, {}};
  const CurveData& table = s["lambda"].curve;
  const auto refuse = [&](const std::string& text) {
    messages.add(s.where("lambda"), fmt::format("fluid coupling \"{}\": lambda: {}", s.name, text));
  };
  if (table.period > 0) return refuse("a table over the speed ratio has no period; drop it");
  if (table.x.front() < -1 || table.x.back() != 1 || table.y.back() != 0)
    return refuse(
        fmt::format("it runs from [{:g}, {:g}] to [{:g}, {:g}]; it must lie within −1 … 1 and end in [1, 0], "
                    "for nothing is transmitted without slip",
                    table.x.front(), table.y.front(), table.x.back(), table.y.back()));
  if (*std::min_element(table.y.begin(), table.y.end()) < 0)
    return refuse("λ < 0; the faster side always drives the slower one");
  net.connect(in, out, 1, s.name,
              FluidCoupling{curve_of(table), s.number("density") * std::pow(s.number("diameter"), 5)});
}

void build_viscous_damper(const Section& s, Network& net, Messages&) {
  const int hub = single_shaft(s, net);
  const int ring = net.add_node(s.name, "ring", s.number("ring_inertia"));
  net.ports[s.name].others = {{"ring", ring}};
  net.connect(hub, ring, 1, s.name, ViscousFilm{s.number("damping")});
}

}  // namespace

std::vector<Kind> fluid_kinds() {
  return {
      {.name = "fluid coupling",
       .doc = "hydrodynamic coupling by its performance coefficient over the speed ratio; slips always",
       .placement = Placement::inline_two,
       .keys =
           joined({{.name = "diameter", .unit = "m", .domain = positive, .doc = "profile diameter D", .required = true},
                   {.name = "density",
                    .unit = "kg/m3",
                    .fallback = "\"870 kg/m3\"",
                    .domain = positive,
                    .doc = "ρ of the fluid; oil unless given"},
                   {.name = "lambda",
                    .type = KeyType::curve,
                    .unit = "1",
                    .doc = "λ over ν = ω_slower/ω_faster, ending in [1, 0]; M = λ ρ D⁵ ω²",
                    .required = true,
                    .choices = {"speed ratio"}}},
                  side_inertia_keys()),
       .build = build_fluid_coupling},
      {.name = "viscous damper",
       .doc = "ring that hangs on the shaft by a viscous film (Houdaille)",
       .keys =
           {{.name = "ring_inertia", .unit = "kg*m2", .domain = positive, .doc = "of the free ring", .required = true},
            {.name = "damping",
             .unit = "N*m*s/rad",
             .domain = positive,
             .doc = "c of the film between ring and hub",
             .required = true},
            own_inertia_key()},
       .build = build_viscous_damper},
  };
}

}  // namespace kurbel
