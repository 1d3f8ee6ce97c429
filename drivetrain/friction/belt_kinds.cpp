// belt_kinds.cpp — belt drive with slip.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/shared/kinds.h"
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
    text += fmt::format("; elastic creep there {:.3g} % (not in the motion)", 100 * limit / radius / axial_stiffness);
  return text;
}

namespace {

struct BeltKeys {
  double diameter_in = 0, diameter_out = 0;                         // d₁, d₂ [m]
  double pretension = 0, friction = 0;                              // F₀ [N], μ
  std::optional<double> wrap_angle, centre_distance, groove_angle;  // α [rad], [m], γ [rad]
  std::optional<double> stiffness, axial_stiffness;                 // k [N·m/rad], EA [N]
  std::optional<double> allowable_tension, slip_reserve;            // [N]; M over torque, ≥ 1
  SideInertias inertia;
  Damping damping;

  // α on the pulley that the belt wraps less.
  double wrap() const {
    return wrap_angle ? *wrap_angle : open_belt_wrap(diameter_in, diameter_out, centre_distance.value());
  }
  // M at which it slips, on the driving pulley [N·m].
  double limit() const {
    const double counts = groove_angle ? friction / std::sin(0.5 * *groove_angle) : friction;
    return 0.5 * diameter_in * eytelwein_force(pretension, counts, wrap());
  }
  // Of one strand of the open drive [m].
  double strand() const {
    const double difference = diameter_out - diameter_in;
    return std::sqrt(*centre_distance * *centre_distance - 0.25 * difference * difference);
  }
};

Fields<BeltKeys> belt_fields() {
  using Keys = BeltKeys;
  return Fields<Keys>()
      .add(required("diameter_in", "m", positive, "d₁ of the driving pulley"), &Keys::diameter_in)
      .add(required("diameter_out", "m", positive, "d₂ of the driven pulley"), &Keys::diameter_out)
      .add(required("pretension", "N", positive, "F₀ in each strand, unloaded and at speed"), &Keys::pretension)
      .add(required("friction_coefficient", "", positive, "μ between belt and pulley"), &Keys::friction)
      .add(quantity("wrap_angle", "rad", {.low = 0, .high = 2 * std::numbers::pi, .low_open = true},
                    "α on the pulley that the belt wraps less; default: of the open drive, by centre_distance"),
           &Keys::wrap_angle)
      .add(quantity("centre_distance", "m", positive, "of the pulleys"), &Keys::centre_distance)
      .add(quantity("groove_angle", "rad", {.low = 0, .high = std::numbers::pi, .low_open = true},
                    "γ of a V-belt's groove: μ counts as μ/sin(γ/2); default: flat belt"),
           &Keys::groove_angle)
      .add(quantity("stiffness", "N*m/rad", positive, "k, referred to the driving pulley"), &Keys::stiffness)
      .add(quantity("axial_stiffness", "N", positive, "EA of the belt, in place of the stiffness: k = 2 EA r₁²/L"),
           &Keys::axial_stiffness)
      .add(quantity("allowable_tension", "N", positive, "allowable force of a strand, limit for kurbel run"),
           &Keys::allowable_tension)
      .add(quantity("slip_reserve", "", {.low = 1},
                    "demanded: torque at which it slips over the largest one, for kurbel run"),
           &Keys::slip_reserve)
      .add(side_inertia_fields(), &Keys::inertia)
      .add(damping_fields(), &Keys::damping);
}

bool fits(const Reading<BeltKeys>& b) {
  using Keys = BeltKeys;
  const double mean = 0.5 * (b.diameter_in + b.diameter_out);
  if (b.centre_distance && *b.centre_distance <= mean)
    return b.refuse(&Keys::centre_distance, fmt::format("centre_distance = {:g} mm; the pulleys touch below {:g} mm",
                                                        *b.centre_distance * 1e3, mean * 1e3));
  if (!b.wrap_angle && !b.centre_distance)
    return b.refuse(&Keys::wrap_angle, "\"wrap_angle\" is missing; give it, or \"centre_distance\"");
  if (!b.keep_one(&Keys::stiffness, &Keys::axial_stiffness)) return false;
  if (b.axial_stiffness && !b.centre_distance)
    return b.refuse(&Keys::axial_stiffness,
                    "\"axial_stiffness\" needs \"centre_distance\", which gives the length of the strands");
  if (!b.stiffness && !b.axial_stiffness)
    for (const std::string& key : b.given_keys(&Keys::damping))
      if (key != "damping_frequency")
        return b.refuse(
            key, fmt::format("\"{}\" needs the belt's elasticity; give \"stiffness\" or \"axial_stiffness\"", key));
  return true;
}

void build_belt(const Section& s, const Reading<BeltKeys>& b, Network& net) {
  const auto [in, out] = two_shafts(s, b.inertia, net);
  if (!fits(b)) return;
  BeltData data{.name = s.name,
                .ratio = b.diameter_out / b.diameter_in,
                .radius = 0.5 * b.diameter_in,
                .stiffness = b.stiffness.value_or(0),
                .axial_stiffness = b.axial_stiffness.value_or(0),
                .damping = b.damping};
  data.limit = b.limit();
  net.data.add(s.name, BeltRating{b.pretension, data.radius, data.limit, b.allowable_tension, b.slip_reserve});
  if (b.axial_stiffness) data.stiffness = 2 * data.axial_stiffness * data.radius * data.radius / b.strand();
  if (data.stiffness > 0) return net.connect(in, out, data.ratio, s.name, data);
  net.connect(in, out, data.ratio, s.name, RigidBelt{data.limit, data.describe()});
}

}  // namespace

std::vector<Kind> belt_kinds() {
  return {
      kind_of<belt_fields, build_belt>(
          elastic_between_shafts, "belt",
          "belt drive that slips at the limit of Euler and Eytelwein; elastic where a stiffness is given"),
  };
}

}  // namespace kurbel
