// load_kinds.cpp — what resists on a shaft.
#include "drivetrain/loads/kinds.h"

#include <fmt/format.h>

#include "drivetrain/loads/loads.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_drag(const Section& s, Network& net, Messages&) {
  net.put(single_shaft(s, net), s.name, SpeedLoad{Account::harmful, s.number("damping"), 0});
}

void build_load(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const Window window = window_of(s, messages);
  const Account account = account_of(s, Account::useful);
  const double torque = s.number_or("torque", 0), viscous = s.number("damping"), quadratic = s.number("quadratic");
  if (!s.given("torque") && !s.given("damping") && !s.given("quadratic") && !s.has("table"))
    messages.add(
        s.at,
        fmt::format("load \"{}\": nothing given; allowed: \"torque\", \"damping\", \"quadratic\", \"table\"", s.name));
  if (s.text("acts") == "always") {
    if (torque != 0) net.put(node, s.name, HarmonicTorque{account, -torque, 0, 0, 0}, window);
    if (viscous > 0 || quadratic > 0) net.put(node, s.name, SpeedLoad{account, viscous, quadratic}, window);
  } else if (torque > 0) {
    net.put(node, s.name, OpposingLoad{account, torque, viscous, quadratic, 0}, window);
  } else if (torque < 0) {
    messages.add(s.where("torque"), fmt::format("load \"{}\": torque = {:g} N·m; a load against the motion must be ≥ 0 "
                                                "(with acts = \"always\" it may be negative)",
                                                s.name, torque));
  } else if (viscous > 0 || quadratic > 0) {
    net.put(node, s.name, SpeedLoad{account, viscous, quadratic}, window);
  }
  if (s.has("table")) put_curve(net, node, s, s["table"].curve, -1, account, window, messages);
}

}  // namespace

std::vector<Kind> load_kinds() {
  return {
      {.name = "bearing drag",
       .doc = "viscous friction against the frame",
       .keys =
           {{.name = "damping", .unit = "N*m*s/rad", .domain = not_negative, .doc = "b in M = −b ω", .required = true},
            own_inertia_key()},
       .build = build_drag},
      {.name = "load",
       .doc = "resistance on a shaft: constant, viscous, quadratic, table; several may be given",
       .keys = joined(
           {{.name = "torque", .unit = "N*m", .doc = "constant part M₀"},
            {.name = "acts",
             .type = KeyType::text,
             .fallback = "\"against motion\"",
             .doc = "the constant part opposes motion and holds at standstill, or acts always backwards (a weight)",
             .choices = {"against motion", "always"}},
            {.name = "damping",
             .unit = "N*m*s/rad",
             .fallback = "\"0 N*m*s/rad\"",
             .domain = not_negative,
             .doc = "b in b ω"},
            {.name = "quadratic",
             .unit = "N*m*s2/rad2",
             .fallback = "\"0 N*m*s2/rad2\"",
             .domain = not_negative,
             .doc = "q in q ω |ω|: fan, centrifugal pump"},
            {.name = "table",
             .type = KeyType::curve,
             .unit = "N*m",
             .doc = "resisting torque over time, angle or speed",
             .choices = any_abscissa()},
            {.name = "work",
             .type = KeyType::text,
             .fallback = "\"useful\"",
             .doc = "line of the energy balance",
             .choices = {"useful", "harmful", "driving"}},
            own_inertia_key()},
           window_keys()),
       .build = build_load},
  };
}

}  // namespace kurbel
