// gear_mesh_kinds.cpp — a pair of wheels with elastic teeth.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/gears/gear_keys.h"
#include "drivetrain/gears/gear_mesh.h"
#include "drivetrain/gears/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// Mean stiffness about the driving wheel: as it is, along the line of action, or estimated from the teeth.
double stiffness_of(const Section& s, const std::optional<GearPair>& pair, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("gear mesh \"{}\": {}", s.name, text));
    return 1.0;
  };
  if (s.given("stiffness") && s.given("mesh_stiffness"))
    return refuse("mesh_stiffness", "\"stiffness\" and \"mesh_stiffness\" both given; keep one");
  if (s.given("stiffness")) return s.number("stiffness");
  if (!pair)
    return refuse("stiffness", "\"stiffness\" is missing; give it, or \"module\" with \"mesh_stiffness\" or \"width\"");
  if (s.given("mesh_stiffness")) return s.number("mesh_stiffness") * std::pow(0.5 * pair->wheel[0].base_diameter, 2);
  if (!s.given("width"))
    return refuse("module",
                  "\"width\" is missing: the stiffness estimated from the teeth needs it; or give \"stiffness\"");
  return mesh_stiffness(*pair).torsional;
}

MeshVariation variation_of(const Section& s, int teeth, Messages& messages) {
  MeshVariation variation;
  variation.teeth = teeth;
  if (!s.has("mesh_variation")) {
    if (s.given("mesh_phase"))
      messages.add(s.where("mesh_phase"), fmt::format("gear mesh \"{}\": \"mesh_phase\" belongs to \"mesh_variation\", "
                                                      "which is not given; drop it",
                                                      s.name));
    return variation;
  }
  const std::vector<double>& amplitudes = s["mesh_variation"].numbers;
  const std::vector<double> phases = s.has("mesh_phase") ? s["mesh_phase"].numbers : std::vector<double>{};
  double sum = 0;
  for (std::size_t n = 0; n < amplitudes.size(); ++n) {
    variation.harmonic.push_back({amplitudes[n], n < phases.size() ? phases[n] : 0});
    sum += std::abs(amplitudes[n]);
  }
  if (sum >= 1)
    messages.add(s.where("mesh_variation"),
                 fmt::format("gear mesh \"{}\": the amplitudes of mesh_variation add up to {:g}; must be < 1, or the "
                             "stiffness could vanish",
                             s.name, sum));
  if (phases.size() > amplitudes.size())
    messages.add(s.where("mesh_phase"), fmt::format("gear mesh \"{}\": {} phases for {} harmonics of mesh_variation",
                                                    s.name, phases.size(), amplitudes.size()));
  return variation;
}

template <class Data>
void connect_mesh(const Section& s, Network& net, int in, int out, double ratio, const Data& contact,
                  const MeshVariation& variation) {
  if (variation.harmonic.empty())
    net.connect(in, out, ratio, s.name, contact);
  else
    net.connect(in, out, ratio, s.name, MeshData<Data>{contact, variation});
}

void build_gear_mesh(const Section& s, Network& net, Messages& messages) {
  const std::string what = fmt::format("gear mesh \"{}\"", s.name);
  const std::vector<double>& teeth = s["teeth"].numbers;
  const std::size_t given = s.has("inertia") ? s["inertia"].numbers.size() : 2;
  if (teeth.size() != 2 || given != 2) {
    const bool of_teeth = teeth.size() != 2;
    messages.add(
        s.where(of_teeth ? "teeth" : "inertia"),
        fmt::format("{}: {} has {} value{}; must be two, driving wheel first", what, of_teeth ? "teeth" : "inertia",
                    of_teeth ? teeth.size() : given, (of_teeth ? teeth.size() : given) == 1 ? "" : "s"));
    return;
  }
  const std::size_t before = messages.all().size();
  const std::optional<GearPair> pair = gear_pair_of(s, what, messages);
  if (messages.all().size() > before) return;
  std::array<double, 2> inertia{};
  if (s.has("inertia"))
    inertia = {s["inertia"].numbers[0], s["inertia"].numbers[1]};
  else if (pair)
    inertia = {pair->wheel[0].inertia, pair->wheel[1].inertia};
  const int in = net.add_node(s.name, "in", inertia[0]), out = net.add_node(s.name, "out", inertia[1]);
  net.ports[s.name] = {in, out, {}};
  const double ratio = teeth[1] / teeth[0], stiffness = stiffness_of(s, pair, messages);
  const Damping damping = damping_of(s, messages);
  const MeshVariation variation = variation_of(s, static_cast<int>(teeth[0]), messages);
  if (s.given("backlash") && pair) {
    BacklashData contact;
    contact.contact.law = s.text("contact") == "clipped" ? ContactLaw::clipped : ContactLaw::no_pulling;
    contact.contact.stiffness = stiffness;
    contact.contact.gap = pair->backlash_angle(0);
    contact.given = damping;
    connect_mesh(s, net, in, out, ratio, contact, variation);
  } else {
    connect_mesh(s, net, in, out, ratio, CouplingData{stiffness, damping}, variation);
  }
}

// The gap is an effect here; in an ideal stage it is only stated.
std::vector<Key> geometry_keys_with_gap() {
  std::vector<Key> keys = gear_geometry_keys();
  for (Key& key : keys)
    if (key.name == "backlash") key.effect = "backlash";
  return keys;
}

}  // namespace

std::vector<Kind> gear_mesh_kinds() {
  return {
      {.name = "gear mesh",
       .doc = "pair of wheels with elastic teeth, mean and tooth-frequency stiffness; ideal when its elasticity is off",
       .placement = Placement::inline_two,
       .keys = joined(
           joined(
               {{.name = "teeth",
                 .type = KeyType::integers,
                 .domain = {.low = 1, .high = 100000},
                 .doc = "teeth of the driving and of the driven wheel",
                 .required = true},
                {.name = "stiffness",
                 .unit = "N*m/rad",
                 .domain = positive,
                 .doc = "mean stiffness about the driving wheel; default: ISO 6336-1 method B from module and width"},
                {.name = "mesh_stiffness",
                 .unit = "N/m",
                 .domain = positive,
                 .doc = "mean stiffness along the line of action, in its place; needs the module"},
                {.name = "mesh_variation",
                 .type = KeyType::quantities,
                 .domain = {.low = -1, .high = 1},
                 .doc = "amplitudes a_n of the stiffness's harmonics of the tooth frequency, over its mean",
                 .effect = "mesh_variation"},
                {.name = "mesh_phase",
                 .type = KeyType::quantities,
                 .unit = "rad",
                 .doc = "their phases ψ_n; default: 0"},
                {.name = "contact",
                 .type = KeyType::text,
                 .fallback = "\"no pulling\"",
                 .doc = "law of contact of the flanks where a backlash is given (backlash.h)",
                 .choices = {"no pulling", "clipped"}},
                {.name = "inertia",
                 .type = KeyType::quantities,
                 .unit = "kg*m2",
                 .domain = not_negative,
                 .doc = "of the driving and of the driven wheel, each on its own shaft; default: from module and "
                        "width, else 0"}},
               damping_keys()),
           geometry_keys_with_gap()),
       .build = build_gear_mesh,
       .elastic = true},
  };
}

}  // namespace kurbel
