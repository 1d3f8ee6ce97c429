// planetary_kinds.cpp — planetary gear and differential with all three shafts free, or one held; worm gear.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/gears/bevel_worm.h"
#include "drivetrain/gears/gear_train_keys.h"
#include "drivetrain/gears/kinds.h"
#include "drivetrain/gears/planetary.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

Key teeth_key(const char* name, const char* doc, bool required) {
  return {
      .name = name, .type = KeyType::integer, .domain = {.low = 5, .high = 100000}, .doc = doc, .required = required};
}
Key inertia_of_key(const char* name, const char* doc) {
  return {.name = name, .unit = "kg*m2", .fallback = "\"0 kg*m2\"", .domain = not_negative, .doc = doc};
}
Key basic_efficiency_key(const char* doc) {
  return {.name = "efficiency", .domain = {.low = 0, .high = 1, .low_open = true}, .doc = doc, .effect = "gear_losses"};
}
std::vector<std::string> central_shafts() { return {"sun", "ring", "carrier"}; }

// ω_s − i₀ ω_r − (1 − i₀) ω_c = 0. Losses are those of the rolling against the carrier.
Network::Relation willis(const Section& s, std::array<int, 3> nodes, const PlanetaryTrain& train) {
  const double i0 = train.basic_ratio;
  Network::Relation relation{.node = nodes, .gain = {1, -i0, i0 - 1}, .usual = {1, 1, 1}, .component = s.name};
  if (s.given("efficiency")) {
    const GearEfficiency losses{s.number("efficiency"), s.number("efficiency")};
    relation.lossy = true;
    relation.loss = losses.law();
    relation.words = "with the carrier held: " + losses.describe(i0);
  }
  return relation;
}

// Where the planets' inertia about their own axes counts: on sun, ring and carrier, as pure squares, exactly, whatever
// the shafts do (planetary.h).
bool place_planets(const Section& s, double planet, double second, Network& net, const std::array<int, 3>& nodes,
                   Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("planetary gear \"{}\": {}", s.name, text));
    return false;
  };
  const double sun = s.number("sun"), ring = s.number("ring"), count = s.number("planets");
  double distance = 0;
  if (s.given("module") && s.given("planet_distance"))
    return refuse("planet_distance", "\"module\" and \"planet_distance\" both given; keep one");
  if (s.given("planet_distance")) distance = s.number("planet_distance");
  if (s.given("module")) distance = 0.5 * s.number("module") * (sun + planet);
  if (s.given("planet_mass") && distance == 0)
    return refuse("planet_mass",
                  "\"planet_mass\" needs the distance of the planets from the axis; give module or "
                  "planet_distance");
  if (s.given("planet_inertia") && planet != std::floor(planet))
    return refuse("planet_inertia",
                  fmt::format("ring − sun = {:g} teeth is odd; say how many teeth a planet has", ring - sun));
  const PlanetShares share = shares_of_planet(sun / planet, ring / second);
  const double own = s.number("planet_inertia");
  const double inertia[] = {share.sun * own * count, share.ring * own * count,
                            count * (share.carrier * own + s.number("planet_mass") * distance * distance)};
  for (std::size_t k = 0; k < 3; ++k) net.nodes[static_cast<std::size_t>(nodes[k])].inertia += inertia[k];
  const double carrier = net.nodes[static_cast<std::size_t>(nodes[2])].inertia;
  if (carrier < 0)
    return refuse("planet_inertia",
                  fmt::format("the planets' {:g} kg·m² about their own axes is more than their mass can have: "
                              "carrier_inertia with planet_mass · distance² for each planet must be ≥ {:g} kg·m²; "
                              "give carrier_inertia or planet_mass",
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

void build_planetary(const Section& s, Network& net, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("planetary gear \"{}\": {}", s.name, text));
  };
  const double sun = s.number("sun"), ring = s.number("ring");
  if (ring <= sun) return refuse("ring", fmt::format("ring = {:g} teeth; must be more than the sun's {:g}", ring, sun));
  if (s.given("second_planet") && !s.given("planet"))
    return refuse("second_planet",
                  "\"second_planet\" meshes with the ring; give \"planet\" too, which meshes with the "
                  "sun");
  const double planet = s.number_or("planet", 0.5 * (ring - sun)), second = s.number_or("second_planet", planet);
  if (second >= ring)
    return refuse(s.given("second_planet") ? "second_planet" : "planet",
                  fmt::format("a planet with {:g} teeth does not fit into a ring with {:g}", second, ring));
  const std::string &in = s.text("in"), &out = s.text("out"), &held = s.text("fixed");
  if (in == out) return refuse("out", fmt::format("in and out are both \"{}\"; they must differ", in));
  if (held == in || held == out)
    return refuse("fixed", fmt::format("the {} is fixed and is the {}; fix another one, or take another one there",
                                       held, held == in ? "input (in)" : "output (out)"));
  const PlanetaryTrain train{-planet / sun * ring / second};
  std::array<int, 3> nodes{};
  Network::Ports& ports = net.ports[s.name];
  const std::vector<std::string> names = central_shafts();
  for (std::size_t k = 0; k < 3; ++k) {
    nodes[k] = net.add_node(s.name, names[k], s.number(names[k] + "_inertia"));
    ports.others[names[k]] = nodes[k];
    if (names[k] == held) net.prescribe(nodes[k], {.time = {0}, .speed = {0}});
  }
  ports.in = ports.others.at(in);
  ports.out = ports.others.at(out);
  if (!place_planets(s, planet, second, net, nodes, messages)) return;
  Network::Relation relation = willis(s, nodes, train);
  relation.usual = usual_motion(train, held);
  net.relate(std::move(relation));
}

// Crown wheel and pinion onto the cage, and two output shafts: ω₁ + ω₂ = 2 ω_cage.
void build_differential(const Section& s, Network& net, Messages&) {
  const double ratio = s.number("ratio"), output = s.number("output_inertia");
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int cage = net.add_node(s.name, "cage", s.number("cage_inertia"));
  const int first = net.add_node(s.name, "out", output), second = net.add_node(s.name, "second", output);
  net.ports[s.name] = {in, first, {{"second", second}, {"cage", cage}}};
  net.join(in, cage, ratio, s.name);
  net.relate(willis(s, {first, second, cage}, bevel_differential()));
}

// η₁ = tan γ/tan(γ + ρ′), η₂ = tan(γ − ρ′)/tan γ (theory 6.15).
void build_worm(const Section& s, Network& net, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("worm gear \"{}\": {}", s.name, text));
  };
  const bool by_angle = s.given("lead_angle");
  if (by_angle && (s.given("module") || s.given("worm_diameter")))
    return refuse("lead_angle", "\"lead_angle\" and module with worm_diameter both given; keep one");
  if (!by_angle && !(s.given("module") && s.given("worm_diameter")))
    return refuse("lead_angle", "\"lead_angle\" is missing; give it, or \"module\" and \"worm_diameter\"");
  WormPair pair{
      static_cast<int>(s.number("starts")), static_cast<int>(s.number("teeth")),    s.number_or("module", 1),
      s.number_or("worm_diameter", 1),      s.number_or("friction_coefficient", 0), s.number("pressure_angle")};
  if (by_angle) pair.worm_diameter = pair.starts * pair.module / std::tan(s.number("lead_angle"));
  const double angle = pair.lead_angle();
  if (s.given("friction_coefficient") && angle + pair.friction_angle() >= 0.5 * std::numbers::pi)
    return refuse(
        "friction_coefficient",
        fmt::format("a lead angle of {:.4g} deg with friction {:g} lets the worm drive nothing; they must add "
                    "up to less than 90 deg",
                    angle * 180 / std::numbers::pi, pair.friction));
  try {
    check(pair);
  } catch (const std::invalid_argument& error) {
    return refuse("starts", error.what());
  }
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out, {}};
  const double bearing = s.number_or("bearing_torque", 0);
  const GearEfficiency losses{pair.efficiency(), pair.efficiency_back(), bearing, bearing};
  const bool lossy = s.given("friction_coefficient") || s.given("bearing_torque");
  join_gear(net, in, out, pair.ratio(), s.name, lossy ? &losses : nullptr);
}

std::vector<Key> planetary_keys() {
  const std::vector<std::string> names = central_shafts();
  return {teeth_key("sun", "teeth of the sun z_s", true),
          teeth_key("ring", "teeth of the ring z_r", true),
          teeth_key("planet", "teeth of a planet; default: (z_r − z_s)/2", false),
          teeth_key("second_planet", "teeth of the planet that meshes with the ring, where it is stepped", false),
          {.name = "in", .type = KeyType::text, .fallback = "\"sun\"", .doc = "driving shaft", .choices = names},
          {.name = "out", .type = KeyType::text, .fallback = "\"carrier\"", .doc = "driven shaft", .choices = names},
          {.name = "fixed",
           .type = KeyType::text,
           .fallback = "\"none\"",
           .doc = "shaft that is held by the frame; the others are then one coordinate",
           .choices = {"none", "sun", "ring", "carrier"}},
          basic_efficiency_key("η₀ with the carrier held, whichever side drives"),
          inertia_of_key("sun_inertia", "of the sun and its shaft"),
          inertia_of_key("ring_inertia", "of the ring"),
          inertia_of_key("carrier_inertia", "of the carrier, without the planets unless they have no planet_mass"),
          {.name = "planets",
           .type = KeyType::integer,
           .fallback = "3",
           .domain = {.low = 1, .high = 24},
           .doc = "number of planets"},
          inertia_of_key("planet_inertia", "of one planet about its own axis"),
          {.name = "planet_mass",
           .unit = "kg",
           .fallback = "\"0 kg\"",
           .domain = not_negative,
           .doc = "of one planet; needs module or planet_distance"},
          {.name = "module", .unit = "m", .domain = positive, .doc = "for the distance of the planets ½ m (z_s + z_p)"},
          {.name = "planet_distance",
           .unit = "m",
           .domain = positive,
           .doc = "of the planets' axes from the central one, in place of module"}};
}

}  // namespace

std::vector<Kind> planetary_kinds() {
  return {
      {.name = "planetary gear",
       .doc = "sun, planets on a carrier, ring; all three central shafts are free unless one is fixed. A branch may "
              "begin at \"NAME.ring\" (sun, carrier). The three count the same sense of rotation as positive",
       .placement = Placement::inline_two,
       .keys = planetary_keys(),
       .build = build_planetary,
       .further_shafts = central_shafts()},
      {.name = "differential",
       .doc = "divides the torque of its cage between two output shafts that may turn at different speeds; the second "
              "branch begins at \"NAME.second\"",
       .placement = Placement::inline_two,
       .keys = {{.name = "ratio", .fallback = "1", .domain = positive, .doc = "of pinion and crown wheel, ω_in/ω_cage"},
                basic_efficiency_key("η₀ with the cage held: what the bevel wheels inside lose"),
                inertia_of_key("inertia_in", "of the pinion and its shaft"),
                inertia_of_key("cage_inertia", "of the cage with the crown wheel"),
                inertia_of_key("output_inertia", "of either output shaft with its bevel wheel")},
       .build = build_differential,
       .further_shafts = {"second"}},
      {.name = "worm gear",
       .doc = "worm and wheel; with a friction coefficient its efficiencies follow, and whether it locks itself",
       .placement = Placement::inline_two,
       .keys = {{.name = "starts",
                 .type = KeyType::integer,
                 .fallback = "1",
                 .domain = {.low = 1, .high = 20},
                 .doc = "starts of the worm z₁"},
                teeth_key("teeth", "teeth of the wheel z₂", true),
                {.name = "lead_angle",
                 .unit = "rad",
                 .domain = {.low = 0, .high = 1.4, .low_open = true, .high_open = true},
                 .doc = "γ on the reference diameter of the worm"},
                {.name = "module", .unit = "m", .domain = positive, .doc = "axial; with worm_diameter gives γ"},
                {.name = "worm_diameter", .unit = "m", .domain = positive, .doc = "d₁; tan γ = z₁ m/d₁"},
                {.name = "friction_coefficient",
                 .domain = {.low = 0, .high = 1},
                 .doc = "μ of the flanks: ρ′ = atan(μ/cos α_n), η = tan γ/tan(γ + ρ′) and tan(γ − ρ′)/tan γ",
                 .effect = "gear_losses"},
                {.name = "pressure_angle", .unit = "rad", .fallback = "\"20 deg\"", .doc = "α_n of the flanks"},
                {.name = "bearing_torque",
                 .unit = "N*m",
                 .domain = not_negative,
                 .doc = "friction of the bearings, on the worm's shaft",
                 .effect = "gear_losses"},
                inertia_of_key("inertia_in", "of the worm and its shaft"),
                inertia_of_key("inertia_out", "of the wheel and its shaft")},
       .build = build_worm},
  };
}

}  // namespace kurbel
