// belt_kinds.cpp — belt drive with slip.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/friction/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"
#include "engine/scene/effects.h"

namespace kurbel {

ConnectionForm under(const BeltData& given, const Effects& effects) {
  return effects.is_elastic(given.name) ? nullptr : connection_form(RigidBelt{given.limit, given.describe()});
}

std::string BeltData::describe() const {
  std::string text =
      fmt::format("belt of ratio {:.6g}; slips at {:.6g} N·m on the driving pulley, {:.6g} N in the belt", ratio, limit,
                  limit / radius);
  if (axial_stiffness > 0)
    text +=
        fmt::format("; elastic creep there {:.3g} % (left out of the motion)", 100 * limit / radius / axial_stiffness);
  return text;
}

namespace {

void build_belt(const Section& s, Network& net, Messages& messages) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out, {}};
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("belt \"{}\": {}", s.name, text));
  };
  const double d1 = s.number("diameter_in"), d2 = s.number("diameter_out");
  const double distance = s.number_or("centre_distance", 0);
  const bool has_distance = s.given("centre_distance");
  if (has_distance && distance <= 0.5 * (d1 + d2))
    return refuse("centre_distance", fmt::format("centre_distance = {:g} mm; the pulleys touch below {:g} mm",
                                                 distance * 1e3, 500 * (d1 + d2)));
  if (!s.given("wrap_angle") && !has_distance)
    return refuse("wrap_angle", "\"wrap_angle\" is missing; give it, or \"centre_distance\"");
  if (s.given("stiffness") && s.given("axial_stiffness"))
    return refuse("axial_stiffness", "\"stiffness\" and \"axial_stiffness\" both given; keep one");
  if (s.given("axial_stiffness") && !has_distance)
    return refuse("axial_stiffness",
                  "\"axial_stiffness\" needs \"centre_distance\", which gives the length of the strands");
  const double wrap = s.number_or("wrap_angle", has_distance ? open_belt_wrap(d1, d2, distance) : 0);
  double friction = s.number("friction_coefficient");
  if (s.given("groove_angle")) friction /= std::sin(0.5 * s.number("groove_angle"));
  BeltData data{.name = s.name, .ratio = d2 / d1, .radius = 0.5 * d1, .damping = damping_of(s, messages)};
  data.limit = data.radius * eytelwein_force(s.number("pretension"), friction, wrap);
  data.axial_stiffness = s.number_or("axial_stiffness", 0);
  data.stiffness = s.number_or("stiffness", 0);
  if (has_distance && data.axial_stiffness > 0) {
    const double strand = std::sqrt(distance * distance - 0.25 * (d2 - d1) * (d2 - d1));
    data.stiffness = 2 * data.axial_stiffness * data.radius * data.radius / strand;
  }
  if (data.stiffness > 0) return net.connect(in, out, data.ratio, s.name, data);
  for (const char* key : {"damping", "damping_ratio", "relative_damping", "loss_factor"})
    if (s.given(key))
      return refuse(key,
                    fmt::format("\"{}\" needs the belt's elasticity; give \"stiffness\" or \"axial_stiffness\"", key));
  net.connect(in, out, data.ratio, s.name, RigidBelt{data.limit, data.describe()});
}

}  // namespace

std::vector<Kind> belt_kinds() {
  return {
      {.name = "belt",
       .doc = "belt drive that slips at the limit of Euler and Eytelwein; elastic where a stiffness is given",
       .placement = Placement::inline_two,
       .keys = joined(
           {{.name = "diameter_in",
             .unit = "m",
             .domain = positive,
             .doc = "d₁ of the driving pulley",
             .required = true},
            {.name = "diameter_out",
             .unit = "m",
             .domain = positive,
             .doc = "d₂ of the driven pulley",
             .required = true},
            {.name = "pretension",
             .unit = "N",
             .domain = positive,
             .doc = "F₀ in each strand, unloaded and at speed",
             .required = true},
            {.name = "friction_coefficient", .domain = positive, .doc = "μ between belt and pulley", .required = true},
            {.name = "wrap_angle",
             .unit = "rad",
             .domain = {.low = 0, .high = 2 * std::numbers::pi, .low_open = true},
             .doc = "α on the pulley that the belt wraps less; default: of the open drive, by centre_distance"},
            {.name = "centre_distance", .unit = "m", .domain = positive, .doc = "of the pulleys"},
            {.name = "groove_angle",
             .unit = "rad",
             .domain = {.low = 0, .high = std::numbers::pi, .low_open = true},
             .doc = "γ of a V-belt's groove: μ counts as μ/sin(γ/2); default: flat belt"},
            {.name = "stiffness", .unit = "N*m/rad", .domain = positive, .doc = "k, referred to the driving pulley"},
            {.name = "axial_stiffness",
             .unit = "N",
             .domain = positive,
             .doc = "EA of the belt, in place of the stiffness: k = 2 EA r₁²/L"}},
           joined(side_inertia_keys(), damping_keys())),
       .build = build_belt,
       .elastic = true},
  };
}

}  // namespace kurbel
