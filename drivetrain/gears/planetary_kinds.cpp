// planetary_kinds.cpp — planetary gear and differential with all three shafts free, or one held; worm gear.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/gears/bevel_worm.h"
#include "drivetrain/gears/gear_train_keys.h"
#include "drivetrain/gears/planetary.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

Key teeth_key(const char* name, const char* doc, bool required) {
  return {.name = name, .domain = {.low = 5, .high = 100000}, .doc = doc, .required = required};
}
Key inertia_of_key(const char* name, const char* doc) { return defaulted(name, "kg*m2", "0 kg*m2", not_negative, doc); }
Key basic_efficiency_key(const char* doc) {
  return quantity("efficiency", "", {.low = 0, .high = 1, .low_open = true}, doc, "gear_losses");
}
std::vector<std::string> central_shafts() { return {"sun", "ring", "carrier"}; }

// ω_s − i₀ ω_r − (1 − i₀) ω_c = 0. Losses are those of the rolling against the carrier.
Network::Relation willis(const std::string& name, std::array<int, 3> nodes, const PlanetaryTrain& train,
                         std::optional<double> efficiency) {
  const double i0 = train.basic_ratio;
  Network::Relation relation{.node = nodes, .gain = {1, -i0, i0 - 1}, .usual = {1, 1, 1}, .component = name};
  if (efficiency) {
    const GearEfficiency losses{*efficiency, *efficiency};
    relation.lossy = true;
    relation.loss = losses.law();
    relation.words = "with the carrier held: " + losses.describe(i0);
  }
  return relation;
}

// --- planetary gear ---

struct PlanetaryKeys {
  int sun = 0, ring = 0;                     // z_s, z_r
  std::optional<int> planet, second_planet;  // teeth
  std::string in, out, fixed;
  std::optional<double> efficiency;                               // η₀
  double sun_inertia = 0, ring_inertia = 0, carrier_inertia = 0;  // [kg·m²]
  int planets = 3;                                                // how many
  double planet_inertia = 0, planet_mass = 0;                     // [kg·m²], [kg]
  std::optional<double> module, planet_distance;                  // [m]

  double planet_teeth() const { return planet ? *planet : 0.5 * (ring - sun); }
  double second_teeth() const { return second_planet ? *second_planet : planet_teeth(); }
};

Fields<PlanetaryKeys> planets(Fields<PlanetaryKeys> fields) {
  using Keys = PlanetaryKeys;
  return fields.add(defaulted("planets", "", "3", {.low = 1, .high = 24}, "number of planets"), &Keys::planets)
      .add(inertia_of_key("planet_inertia", "of one planet about its own axis"), &Keys::planet_inertia)
      .add(defaulted("planet_mass", "kg", "0 kg", not_negative, "of one planet; needs module or planet_distance"),
           &Keys::planet_mass)
      .add(quantity("module", "m", positive, "for the distance of the planets ½ m (z_s + z_p)"), &Keys::module)
      .add(quantity("planet_distance", "m", positive, "of the planets' axes from the central one, in place of module"),
           &Keys::planet_distance);
}

Fields<PlanetaryKeys> planetary_fields() {
  using Keys = PlanetaryKeys;
  return planets(
      Fields<Keys>()
          .add(teeth_key("sun", "teeth of the sun z_s", true), &Keys::sun)
          .add(teeth_key("ring", "teeth of the ring z_r", true), &Keys::ring)
          .add(teeth_key("planet", "teeth of a planet; default: (z_r − z_s)/2", false), &Keys::planet)
          .add(teeth_key("second_planet", "teeth of the planet that meshes with the ring, where it is stepped", false),
               &Keys::second_planet)
          .add({.name = "in", .fallback = "\"sun\"", .doc = "driving shaft", .choices = central_shafts()}, &Keys::in)
          .add({.name = "out", .fallback = "\"carrier\"", .doc = "driven shaft", .choices = central_shafts()},
               &Keys::out)
          .add({.name = "fixed",
                .fallback = "\"none\"",
                .doc = "shaft that is held by the frame; the others are then one coordinate",
                .choices = {"none", "sun", "ring", "carrier"}},
               &Keys::fixed)
          .add(basic_efficiency_key("η₀ with the carrier held, whichever side drives"), &Keys::efficiency)
          .add(inertia_of_key("sun_inertia", "of the sun and its shaft"), &Keys::sun_inertia)
          .add(inertia_of_key("ring_inertia", "of the ring"), &Keys::ring_inertia)
          .add(inertia_of_key("carrier_inertia", "of the carrier, without the planets unless they have no planet_mass"),
               &Keys::carrier_inertia));
}

// Where the planets' inertia about their own axes counts: on sun, ring and carrier, as pure squares, exactly, whatever
// the shafts do (planetary.h).
bool place_planets(const Reading<PlanetaryKeys>& g, Network& net, const std::array<int, 3>& nodes) {
  using Keys = PlanetaryKeys;
  const double sun = g.sun, ring = g.ring, planet = g.planet_teeth(), count = g.planets;
  if (!g.keep_one(&Keys::module, &Keys::planet_distance)) return false;
  const double distance = g.planet_distance ? *g.planet_distance : g.module ? 0.5 * *g.module * (sun + planet) : 0;
  if (g.given(&Keys::planet_mass) && distance == 0)
    return g.refuse(&Keys::planet_mass,
                    "\"planet_mass\" needs the distance of the planets from the axis; give module or planet_distance");
  if (g.given(&Keys::planet_inertia) && planet != std::floor(planet))
    return g.refuse(&Keys::planet_inertia,
                    fmt::format("ring − sun = {:g} teeth is odd; say how many teeth a planet has", ring - sun));
  const PlanetShares share = shares_of_planet(sun / planet, ring / g.second_teeth());
  const double own = g.planet_inertia;
  const double inertia[] = {share.sun * own * count, share.ring * own * count,
                            count * (share.carrier * own + g.planet_mass * distance * distance)};
  for (std::size_t k = 0; k < 3; ++k) net.nodes[static_cast<std::size_t>(nodes[k])].inertia += inertia[k];
  const double carrier = net.nodes[static_cast<std::size_t>(nodes[2])].inertia;
  if (carrier < 0)
    return g.refuse(
        &Keys::planet_inertia,
        fmt::format(
            "the planets' {:g} kg·m² about their own axes is more than their mass can have: carrier_inertia with "
            "planet_mass · distance² for each planet must be ≥ {:g} kg·m²; give carrier_inertia or planet_mass",
            own, -share.carrier * own * count));
  return true;
}

// Usual motion with one shaft held: what Willis gives the others.
std::array<double, 3> usual_motion(const PlanetaryTrain& train, const std::string& held) {
  if (held == "ring") return {1, 0, train.carrier_speed(1, 0)};
  if (held == "sun") return {0, 1, train.carrier_speed(0, 1)};
  if (held == "carrier") return {1, train.ring_speed(1, 0), 0};
  return {1, 1, 1};
}

bool fits(const Reading<PlanetaryKeys>& g) {
  using Keys = PlanetaryKeys;
  if (g.ring <= g.sun)
    return g.refuse(&Keys::ring, fmt::format("ring = {} teeth; must be more than the sun's {}", g.ring, g.sun));
  if (g.second_planet && !g.planet)
    return g.refuse(&Keys::second_planet,
                    "\"second_planet\" meshes with the ring; give \"planet\" too, which meshes with the sun");
  if (g.second_teeth() >= g.ring)
    return g.refuse(g.second_planet ? &Keys::second_planet : &Keys::planet,
                    fmt::format("a planet with {:g} teeth does not fit into a ring with {}", g.second_teeth(), g.ring));
  if (g.in == g.out) return g.refuse(&Keys::out, fmt::format("in and out are both \"{}\"; they must differ", g.in));
  if (g.fixed == g.in || g.fixed == g.out)
    return g.refuse(&Keys::fixed,
                    fmt::format("the {} is fixed and is the {}; fix another one, or take another one there", g.fixed,
                                g.fixed == g.in ? "input (in)" : "output (out)"));
  return true;
}

void build_planetary(const Section& s, const Reading<PlanetaryKeys>& g, Network& net) {
  if (!fits(g)) return;
  const PlanetaryTrain train{-g.planet_teeth() / g.sun * g.ring / g.second_teeth()};
  std::array<int, 3> nodes{};
  Network::Ports& ports = net.ports[s.name];
  const std::vector<std::string> names = central_shafts();
  const double inertia[] = {g.sun_inertia, g.ring_inertia, g.carrier_inertia};
  for (std::size_t k = 0; k < 3; ++k) {
    nodes[k] = net.add_node(s.name, names[k], inertia[k]);
    ports.others[names[k]] = nodes[k];
    if (names[k] == g.fixed) net.prescribe(nodes[k], {.time = {0}, .speed = {0}});
  }
  ports.in = ports.others.at(g.in);
  ports.out = ports.others.at(g.out);
  if (!place_planets(g, net, nodes)) return;
  Network::Relation relation = willis(s.name, nodes, train, g.efficiency);
  relation.usual = usual_motion(train, g.fixed);
  net.relate(std::move(relation));
}

// --- differential ---

struct DifferentialKeys {
  double ratio = 1;                                             // ω_in/ω_cage
  std::optional<double> efficiency;                             // η₀
  double inertia_in = 0, cage_inertia = 0, output_inertia = 0;  // [kg·m²]
};

Fields<DifferentialKeys> differential_fields() {
  using Keys = DifferentialKeys;
  return Fields<Keys>()
      .add(defaulted("ratio", "", "1", positive, "of pinion and crown wheel, ω_in/ω_cage"), &Keys::ratio)
      .add(basic_efficiency_key("η₀ with the cage held: what the bevel wheels inside lose"), &Keys::efficiency)
      .add(inertia_of_key("inertia_in", "of the pinion and its shaft"), &Keys::inertia_in)
      .add(inertia_of_key("cage_inertia", "of the cage with the crown wheel"), &Keys::cage_inertia)
      .add(inertia_of_key("output_inertia", "of either output shaft with its bevel wheel"), &Keys::output_inertia);
}

// Crown wheel and pinion onto the cage, and two output shafts: ω₁ + ω₂ = 2 ω_cage.
void build_differential(const Section& s, const Reading<DifferentialKeys>& g, Network& net) {
  const int in = net.add_node(s.name, "in", g.inertia_in);
  const int cage = net.add_node(s.name, "cage", g.cage_inertia);
  const int first = net.add_node(s.name, "out", g.output_inertia);
  const int second = net.add_node(s.name, "second", g.output_inertia);
  net.ports[s.name] = {in, first, {{"second", second}, {"cage", cage}}};
  net.join(in, cage, g.ratio, s.name);
  net.relate(willis(s.name, {first, second, cage}, bevel_differential(), g.efficiency));
}

// --- worm gear ---

struct WormKeys {
  int starts = 1, teeth = 0;                                // z₁, z₂
  std::optional<double> lead_angle, module, worm_diameter;  // γ [rad], [m]
  std::optional<double> friction;                           // μ
  double pressure_angle = 0;                                // α_n [rad]
  std::optional<double> bearing_torque;                     // [N·m]
  SideInertias inertia;
};

Fields<SideInertias> worm_inertia_fields() {
  return Fields<SideInertias>()
      .add(inertia_of_key("inertia_in", "of the worm and its shaft"), &SideInertias::in)
      .add(inertia_of_key("inertia_out", "of the wheel and its shaft"), &SideInertias::out);
}

Fields<WormKeys> worm_fields() {
  using Keys = WormKeys;
  return Fields<Keys>()
      .add(defaulted("starts", "", "1", {.low = 1, .high = 20}, "starts of the worm z₁"), &Keys::starts)
      .add(teeth_key("teeth", "teeth of the wheel z₂", true), &Keys::teeth)
      .add(quantity("lead_angle", "rad", {.low = 0, .high = 1.4, .low_open = true, .high_open = true},
                    "γ on the reference diameter of the worm"),
           &Keys::lead_angle)
      .add(quantity("module", "m", positive, "axial; with worm_diameter gives γ"), &Keys::module)
      .add(quantity("worm_diameter", "m", positive, "d₁; tan γ = z₁ m/d₁"), &Keys::worm_diameter)
      .add(
          quantity("friction_coefficient", "", {.low = 0, .high = 1},
                   "μ of the flanks: ρ′ = atan(μ/cos α_n), η = tan γ/tan(γ + ρ′) and tan(γ − ρ′)/tan γ", "gear_losses"),
          &Keys::friction)
      .add(defaulted("pressure_angle", "rad", "20 deg", any_number, "α_n of the flanks"), &Keys::pressure_angle)
      .add(quantity("bearing_torque", "N*m", not_negative, "friction of the bearings, on the worm's shaft",
                    "gear_losses"),
           &Keys::bearing_torque)
      .add(worm_inertia_fields(), &Keys::inertia);
}

// η₁ = tan γ/tan(γ + ρ′), η₂ = tan(γ − ρ′)/tan γ (theory 6.15).
void build_worm(const Section& s, const Reading<WormKeys>& g, Network& net) {
  using Keys = WormKeys;
  const auto refuse = [&](auto member, const std::string& text) { g.refuse(member, text); };
  if (g.lead_angle && (g.module || g.worm_diameter))
    return refuse(&Keys::lead_angle, "\"lead_angle\" and module with worm_diameter both given; keep one");
  if (!g.lead_angle && !(g.module && g.worm_diameter))
    return refuse(&Keys::lead_angle, "\"lead_angle\" is missing; give it, or \"module\" and \"worm_diameter\"");
  WormPair pair{g.starts,        g.teeth, g.module.value_or(1), g.worm_diameter.value_or(1), g.friction.value_or(0),
                g.pressure_angle};
  if (g.lead_angle) pair.worm_diameter = pair.starts * pair.module / std::tan(*g.lead_angle);
  const double angle = pair.lead_angle();
  if (g.friction && angle + pair.friction_angle() >= 0.5 * std::numbers::pi)
    return refuse(&Keys::friction, fmt::format("a lead angle of {:.4g} deg with friction {:g} lets the worm drive "
                                               "nothing; they must add up to less than 90 deg",
                                               angle * 180 / std::numbers::pi, pair.friction));
  try {
    check(pair);
  } catch (const std::invalid_argument& error) {
    return refuse(&Keys::starts, error.what());
  }
  const auto [in, out] = two_shafts(s, g.inertia, net);
  const double bearing = g.bearing_torque.value_or(0);
  const GearEfficiency losses{pair.efficiency(), pair.efficiency_back(), bearing, bearing};
  join_gear(net, in, out, pair.ratio(), s.name, g.friction || g.bearing_torque ? &losses : nullptr);
}

Kind with_further(Kind kind, std::vector<std::string> shafts) {
  kind.further_shafts = std::move(shafts);
  return kind;
}

}  // namespace

std::vector<Kind> planetary_kinds() {
  return {
      with_further(
          kind_of<planetary_fields, build_planetary>(
              between_shafts, "planetary gear",
              "sun, planets on a carrier, ring; all three central shafts are free unless one is fixed. A branch may "
              "begin at \"NAME.ring\" (sun, carrier). The three count the same sense of rotation as positive"),
          central_shafts()),
      with_further(kind_of<differential_fields, build_differential>(
                       between_shafts, "differential",
                       "divides the torque of its cage between two output shafts that may turn at different speeds; "
                       "the second branch begins at \"NAME.second\""),
                   {"second"}),
      kind_of<worm_fields, build_worm>(
          between_shafts, "worm gear",
          "worm and wheel; with a friction coefficient its efficiencies follow, and whether it is self-locking"),
  };
}

}  // namespace kurbel
