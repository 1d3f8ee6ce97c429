// coupling_kinds.cpp — what joins two shafts elastically: coupling and shaft.
#include "drivetrain/couplings/coupling_keys.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/couplings/coupling.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/continuous_shafts.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct ContactKeys : Backlash {
  std::optional<double> backlash;  // the gap, where there is one [rad]
};

void check_contact(const Reading<ContactKeys>& contact) {
  if (!contact.backlash || contact.law == ContactLaw::hunt_crossley) return;
  for (const auto member : {&Backlash::damping, &Backlash::exponent})
    if (contact.given(member))
      contact.refuse(member,
                     fmt::format("\"{}\" belongs to contact = \"Hunt-Crossley\"; drop it", contact.key(member)));
}

Fields<ContactKeys> contact_fields() {
  return Fields<ContactKeys>()
      .add(quantity("backlash", "rad", not_negative, "whole gap b between the flanks", "backlash"),
           &ContactKeys::backlash)
      .add(choice("contact", "no pulling", "law of contact of the flanks (backlash.h)"), &Backlash::law,
           {{"no pulling", ContactLaw::no_pulling},
            {"Hunt-Crossley", ContactLaw::hunt_crossley},
            {"clipped", ContactLaw::clipped}})
      .add(defaulted("contact_exponent", "", "1.5", {.low = 1, .high = 3},
                     "n of Hunt–Crossley; the stiffness then counts per rad^n"),
           &Backlash::exponent)
      .add(quantity("contact_damping", "s/rad", not_negative, "d of Hunt–Crossley"), &Backlash::damping)
      .derive([](ContactKeys& contact) {
        contact.gap = contact.backlash.value_or(0);
        if (contact.law != ContactLaw::hunt_crossley) contact.exponent = 1, contact.damping = 0;
      })
      .check(check_contact);
}

struct CouplingKeys : CouplingData {
  SideInertias inertia;
  ContactKeys contact;
  CouplingLimits limits;
};

void check_coupling(const Reading<CouplingKeys>& c) {
  if (!c.contact.backlash || c.contact.law != ContactLaw::hunt_crossley) return;
  for (const std::string& key : c.given_keys(&CouplingKeys::damping))
    if (key != "damping_frequency")
      c.refuse(key, fmt::format("\"{}\" does not apply to Hunt–Crossley contact; give contact_damping", key));
}

Fields<CouplingKeys> coupling_fields() {
  return Fields<CouplingKeys>()
      .add(required("stiffness", "N*m/rad", positive, "torsional stiffness k"), &CouplingKeys::stiffness)
      .add(side_inertia_fields(), &CouplingKeys::inertia)
      .add(damping_fields(), &CouplingKeys::damping)
      .add(contact_fields(), &CouplingKeys::contact)
      .add(coupling_limit_fields(), &CouplingKeys::limits)
      .check(check_coupling);
}

void build_coupling(const Section& s, const Reading<CouplingKeys>& coupling, Network& net) {
  const auto [in, out] = two_shafts(s, coupling.inertia, net);
  net.data.add(s.name, coupling.limits);
  if (coupling.contact.gap > 0) net.data.add(s.name, StatedPlay{});
  if (!coupling.contact.backlash) return net.connect(in, out, 1, s.name, static_cast<const CouplingData&>(coupling));
  BacklashData data{coupling.contact, coupling.damping};
  data.contact.stiffness = coupling.stiffness;
  net.connect(in, out, 1, s.name, data);
}

// A stress is torque over a section.
void check_stress_without_diameter(const Reading<ShaftKeys>& shaft) {
  for (const char* key :
       {"allowable_shear_stress", "allowable_vibratory_stress", "endurance_limit", "yield_strength", "role"})
    if (shaft.section().given(key))
      return void(shaft.refuse(key, fmt::format("\"{}\" needs \"diameter\"; give that, too", key)));
}

// By its stiffness, or by length and diameters.
void check_shaft(const Reading<ShaftKeys>& shaft) {
  if (shaft.stiffness.has_value() == shaft.length.has_value()) {
    shaft.refuse(&ShaftKeys::stiffness, shaft.length
                                            ? "\"stiffness\" and \"length\" both given; keep one"
                                            : "\"stiffness\" is missing; give it, or \"length\" and \"diameter\"");
  } else if (shaft.length && !shaft.diameter) {
    shaft.refuse(&ShaftKeys::length, "\"diameter\" is missing beside \"length\"");
  } else if (shaft.judges_stress() && !shaft.diameter) {
    check_stress_without_diameter(shaft);
  } else if (shaft.stiffness && shaft.diameter && !shaft.judges_stress()) {
    shaft.refuse(&ShaftKeys::diameter,
                 "\"diameter\" beside \"stiffness\" is for stresses alone, and none is judged; drop it, or give a "
                 "limit, e.g. \"allowable_shear_stress\"");
  } else if (!shaft.drop_without(&ShaftKeys::diameter, &ShaftKeys::bore)) {
    return;
  } else if (shaft.diameter && shaft.bore >= *shaft.diameter) {
    shaft.refuse(&ShaftKeys::bore,
                 fmt::format("bore = {:g} mm; must be < diameter = {:g} mm", shaft.bore * 1e3, *shaft.diameter * 1e3));
  }
}

Fields<ShaftKeys> shaft_fields() {
  return Fields<ShaftKeys>()
      .add(quantity("stiffness", "N*m/rad", positive, "torsional stiffness k of the whole shaft"),
           &ShaftKeys::stiffness)
      .add(quantity("length", "m", positive, "length, in place of the stiffness"), &ShaftKeys::length)
      .add(quantity("diameter", "m", positive,
                    "outer diameter; beside a stiffness that of the section whose stress is judged"),
           &ShaftKeys::diameter)
      .add(defaulted("bore", "m", "0 m", not_negative, "inner diameter"), &ShaftKeys::bore)
      .add(defaulted("shear_modulus", "Pa", "79.3 GPa", positive, "G; steel unless given"), &ShaftKeys::shear_modulus)
      .add(defaulted("density", "kg/m3", "7850 kg/m3", positive, "ρ; steel unless given"), &ShaftKeys::density)
      .add(quantity("inertia", "kg*m2", not_negative, "of the whole shaft; default: from its dimensions, else 0"),
           &ShaftKeys::inertia)
      .add(quantity("segments", "", {.low = 1, .high = 100000},
                    "number of equal springs that it is cut into; default: by dimensions it is continuous, by its "
                    "stiffness one spring"),
           &ShaftKeys::segments)
      .add(quantity("allowable_shear_stress", "Pa", positive,
                    "limit of the largest stress for kurbel modes, run, steady; needs the diameter"),
           &ShaftKeys::allowable_shear_stress)
      .add(shaft_rating_fields(), &ShaftKeys::rating)
      .add(damping_fields(), &ShaftKeys::damping)
      .add(application_factor_key(), &ShaftKeys::application_factor)
      .check(check_shaft);
}

// k = G J_p/L, J = ρ J_p L. By its dimensions it is continuous; else, and where its segments are given, it is cut into
// equal springs with the inertia between and at the ends.
void build_shaft(const Section& s, const Reading<ShaftKeys>& shaft, Network& net) {
  if (!shaft.valid()) return;
  net.data.add<ShaftKeys>(s.name, shaft);
  const double stiffness = shaft.length ? shaft.shear_modulus * shaft.polar_moment() / *shaft.length : *shaft.stiffness;
  const double inertia =
      shaft.inertia.value_or(shaft.length ? shaft.density * shaft.polar_moment() * *shaft.length : 0);
  if (shaft.length && !shaft.segments && inertia > 0)
    return add_continuous_shaft(net, s.name,
                                {stiffness, inertia, connection_form(CouplingData{stiffness, shaft.damping})});
  // Springs and dampers in series: n of them, each n times as stiff and as damped.
  const int segments = shaft.segments.value_or(1);
  Damping part = shaft.damping;
  if (part.as == Damping::As::viscous) part.value *= segments;
  int node = net.add_node(s.name, "in", inertia / (2 * segments));
  net.ports[s.name].in = node;
  Network::Chain chain{.component = s.name, .nodes = {node}};
  for (int i = 1; i <= segments; ++i) {
    const bool last = i == segments;
    const int next = net.add_node(s.name, last ? "out" : fmt::format("{}", i), inertia / segments * (last ? 0.5 : 1));
    net.connect(node, next, 1, s.name, CouplingData{stiffness * segments, part});
    if (segments > 1) net.joints.back().chain = static_cast<int>(net.chains.size());
    chain.nodes.push_back(node = next);
  }
  if (segments > 1) net.chains.push_back(std::move(chain));
  net.ports[s.name].out = node;
}

}  // namespace

double ShaftKeys::polar_moment() const {
  return std::numbers::pi / 32 * (std::pow(diameter.value(), 4) - std::pow(bore, 4));
}

double ShaftKeys::polar_modulus() const { return 2 * polar_moment() / diameter.value(); }

std::vector<Kind> coupling_kinds() {
  return {
      kind_of<coupling_fields, build_coupling>(
          elastic_between_shafts, "coupling",
          "spring and damper between two half inertias; rigid when its elasticity is off"),
      kind_of<shaft_fields, build_shaft>(elastic_between_shafts, "shaft",
                                         "elastic shaft by stiffness, or by length, diameters and material"),
  };
}

}  // namespace kurbel
