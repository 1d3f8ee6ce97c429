// joint_keys.cpp — fields of the joints.
#include "mechanisms/kinds/joint_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace kurbel {
namespace {

using Friction = FrictionCoefficient;

void check_friction(const Reading<Friction>& f) {
  if (f.resting < f.kinetic)
    f.refuse(&Friction::resting, fmt::format("static_friction = {:g}; must be ≥ friction = {:g}, else standing still "
                                             "would be easier to leave than to keep",
                                             f.resting, f.kinetic));
}

Fields<Friction> friction() {
  return Fields<Friction>()
      .add(defaulted("friction", "", "0", not_negative,
                     "coefficient of kinetic friction; of a rolling bearing its equivalent one (0.001 … 0.005)",
                     "joint_friction"),
           &Friction::kinetic)
      .add(quantity("static_friction", "", not_negative, "≥ friction; default: the same"), &Friction::resting,
           &Friction::kinetic)
      .add(defaulted("stribeck_speed", "m/s", "0 m/s", not_negative,
                     "sliding speed v_s within which static friction falls to kinetic: f + (f_s − f) exp(−(v/v_s)²); "
                     "0: at once"),
           &Friction::stribeck_speed)
      .add(defaulted("viscous_friction", "s/m", "0 s/m", not_negative,
                     "rise of the coefficient with sliding speed (fluid friction)"),
           &Friction::viscous)
      .check(check_friction);
}

// Of the oil film in a pin. Text as arrays: the run-time of exported components has no relocations for it.
constexpr struct FilmKey {
  char name[15], unit[5];
  double RubbingJoint::*member;
  KeyDocText doc;
} film_keys[] = {{"roughness", "m", &RubbingJoint::roughness,
                  "R_q of the journal, for which friction it is (figure of forces; the run's friction is unchanged)"},
                 {"bore_roughness", "m", &RubbingJoint::bore_roughness, "R_q of its bore"},
                 {"viscosity", "Pa*s", &RubbingJoint::viscosity, "of the oil at its temperature; 0: dry"},
                 {"clearance", "m", &RubbingJoint::clearance, "radial: bore's radius less journal's"},
                 {"film_length", "m", &RubbingJoint::film_length, "of the bearing along its axis"}};

// All of it or nothing; without viscosity it is dry.
void check_film(const Reading<RubbingJoint>& joint) {
  const bool any = std::any_of(std::begin(film_keys), std::end(film_keys),
                               [&](const FilmKey& key) { return joint.given(key.member); });
  if (!any || (joint.given(&RubbingJoint::viscosity) && joint.viscosity == 0)) return;
  std::string missing;
  for (const FilmKey& key : film_keys) {
    const bool rough = key.member == &RubbingJoint::roughness && joint.bore_roughness > 0;
    if (key.member == &RubbingJoint::bore_roughness || rough || joint.*key.member > 0) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(key.name);
  }
  if (missing.empty()) return;
  joint.refuse(
      fmt::format("which friction it is depends on roughness, viscosity, clearance and film_length together; "
                  "missing: {} (viscosity = \"0 Pa*s\": dry)",
                  missing));
}

void add_film(Fields<RubbingJoint>& to) {
  for (const FilmKey& key : film_keys) to.add(quantity(key.name, key.unit, not_negative, key.doc), key.member);
  if constexpr (has_bodies) to.check(check_film);
}

const Tables<RubbingJoint>& journals() {
  static const auto made = [] {
    Fields<RubbingJoint> fields;
    fields
        .add(required("radius", "m", positive, "of the journal; of a rolling bearing half its bore"),
             &RubbingJoint::radius)
        .add(friction(), &RubbingJoint::friction);
    add_film(fields);
    return Tables<RubbingJoint>().add("journal",
                                      "journal or pin in its bearing; friction torque is ρ times the reaction, ρ = r "
                                      "sin(atan f) the radius of the friction circle",
                                      fields);
  }();
  return made;
}

using Guide = SliderCrankJointKeys::Guide;

// What is said of a joint that slides: its length from where, between which faces.
template <class Joint>
Fields<Joint>& add_sliding(Fields<Joint>& to, const std::string& slide, const std::string& from,
                           const std::string& faces) {
  return to
      .add(defaulted("length", "m", "0 m", not_negative,
                     "bearing length of " + slide + "; 0: its tilting is not considered"),
           &Joint::length)
      .add(defaulted("middle", "m", "0 m", any_number, "of that length, from the " + from), &Joint::middle)
      .add(defaulted("width", "m", "0 m", not_negative, "between the two " + faces + ": lever of their friction"),
           &Joint::width)
      .add(defaulted("rolling_arm", "m", "0 m", not_negative,
                     "lever arm k_r of rolling friction, for a " + slide.substr(slide.find(' ') + 1) + " on rollers"),
           &Joint::rolling_arm)
      .add(quantity("roller_radius", "m", positive, "of these rollers"), &Joint::roller_radius)
      .check([](const Reading<Joint>& joint) {
        if (joint.rolling_arm > 0 && joint.roller_radius == 0)
          joint.refuse(&Joint::rolling_arm, "rolling_arm without roller_radius; give the rollers' radius");
      });
}

Fields<Guide> guide() {
  Fields<Guide> fields;
  fields.add(friction(), &Guide::friction);
  return add_sliding(fields, "the slider", "slider pin towards the extended end",
                     "guiding surfaces (bore of a cylinder)")
      .add(Fields<OffThePin>()
               .add(defaulted("slider_com", "m", "0 m", any_number,
                              "slider's centre of mass from its pin towards the extended end"),
                    &OffThePin::com)
               .add(defaulted("force_offset", "m", "0 m", any_number,
                              "of the load's line from the slider pin, positive 90° ahead of the stroke"),
                    &OffThePin::load),
           &Guide::off);
}

// "crank pin" of crank_pin; of a linkage "pin A" of A and "slide ram" of ram, unless there are both of one name.
std::string joint_named(const std::string& name, const std::set<std::string>& joints) {
  std::string spaced = name;
  std::replace(spaced.begin(), spaced.end(), '_', ' ');
  std::set<std::string> found;
  for (const std::string& known : {name, spaced, "pin " + name, "slide " + name})
    if (joints.count(known)) found.insert(known);
  return found.size() == 1 ? *found.begin() : std::string();
}

const Tables<Guide>& guides() {
  static const auto made = Tables<Guide>().add(
      "guide", "of the slider: friction f N, from both edges where the reaction leaves the guide's length", guide());
  return made;
}

// A pin has a radius, a slide has none: what belongs to the other sort is refused.
bool fits(const Reading<RubbingJoint>& joint, bool slides) {
  const auto keep_off = [&](auto member, const char* of) {
    return !joint.given(member) ||
           joint.refuse(member, fmt::format("belongs to a {}; this joint is a {}", of, slides ? "slide" : "pin"));
  };
  bool valid = !slides || keep_off(&RubbingJoint::radius, "pin");
  if (slides)
    for (const FilmKey& key : film_keys) valid = keep_off(key.member, "pin") && valid;
  if (slides) return valid;
  for (const auto member : {&RubbingJoint::length, &RubbingJoint::middle, &RubbingJoint::width,
                            &RubbingJoint::rolling_arm, &RubbingJoint::roller_radius})
    valid = keep_off(member, "slide") && valid;
  if (!joint.friction.none() && joint.radius == 0)
    valid = joint.refuse("has friction but no radius; give radius = \"20 mm\", of a rolling bearing half its bore");
  return valid;
}

}  // namespace

std::shared_ptr<const JointFrictionSource> friction_of(const MechanismData& data, const MechanismJoints& joints,
                                                       const std::vector<ActsWithin>& within) {
  if (joints.joints.empty()) return nullptr;
  const PlanarLinkage linkage = data.linkage(data.arc() ? data.arc()->middle : 0.5);
  const bool any = std::any_of(joints.joints.begin(), joints.joints.end(), [&](const RubbingJoint& r) {
    return std::any_of(linkage.joints.begin(), linkage.joints.end(),
                       [&](const PlanarLinkage::Joint& j) { return r.name == j.name && r.rubs(j.slides); });
  });
  if (!any) return nullptr;
  return std::make_shared<const JointFrictionSource>([=](bool second) {
    return tabulate_joint_friction(data, joints.joints, joints.off, within,
                                   second ? Extraction::second : Extraction::first);
  });
}

MechanismJoints joints_of(const SliderCrankJointKeys& keys) {
  MechanismJoints joints{{keys.main_bearing, keys.crank_pin, keys.slider_pin, keys.guide}, keys.guide.off};
  const char* const names[] = {"main bearing", "crank pin", "slider pin", "guide"};
  for (std::size_t k = 0; k < std::size(names); ++k) joints.joints[k].name = names[k];
  return joints;
}

MechanismJoints joints_of(const MechanismData& data, const std::vector<Reading<RubbingJoint>>& joints) {
  if (joints.empty()) return {};
  const PlanarLinkage linkage = data.linkage(data.arc() ? data.arc()->middle : 0.5);
  std::set<std::string> names;
  std::vector<std::string> list;
  for (const PlanarLinkage::Joint& j : linkage.joints)
    if (names.insert(j.name).second) list.emplace_back(j.name);
  const std::string why = refusal_of_joint_friction(data, CrankCycle(data));
  std::vector<RubbingJoint> rubbing;
  bool valid = true;
  for (const Reading<RubbingJoint>& joint : joints) {
    RubbingJoint to = joint;
    to.name = joint_named(joint.section().name, names);
    if (to.name.empty()) {
      valid = joint.refuse(fmt::format("no joint of this name{}; joints are {}", suggestion(joint.section().name, list),
                                       shortened_list(list, "and")));
      continue;
    }
    for (const PlanarLinkage::Joint& j : linkage.joints)
      if (to.name == j.name) valid = fits(joint, j.slides) && valid;
    if (!why.empty())
      valid = joint.refuse(
          fmt::format("friction of its joints cannot be found: {}; leave the joints out, or change the lengths", why));
    rubbing.push_back(std::move(to));
  }
  if (!valid) return {};
  return {std::move(rubbing), {}};
}

const Tables<Reading<RubbingJoint>>& rubbing_tables() {
  static const auto made = [] {
    using Joint = RubbingJoint;
    Tables<Reading<Joint>> tables;
    tables.named = true;
    Fields<Joint> fields;
    fields
        .add(quantity("radius", "m", positive, "of a pin's journal; of a rolling bearing half its bore"),
             &Joint::radius)
        .add(friction(), &Joint::friction);
    add_film(fields);
    tables.add(
        "joint",
        "A joint with friction: of a pin ρ times the reaction, ρ = r sin(atan f) the radius of the friction "
        "circle; of a slide f N, from both edges where the reaction leaves its length",
        add_sliding(fields, "a slide", "joint along the slide", "faces of a slide, which its link lies between"));
    return tables;
  }();
  return made;
}

Fields<SliderCrankJointKeys> joint_fields() {
  using Joints = SliderCrankJointKeys;
  return Fields<Joints>()
      .add({.name = "main_bearing", .doc = "bearing of the crank"}, &Joints::main_bearing, journals())
      .add({.name = "crank_pin", .doc = "pin between crank and rod"}, &Joints::crank_pin, journals())
      .add({.name = "slider_pin", .doc = "pin between rod and slider"}, &Joints::slider_pin, journals())
      .add({.name = "guide", .doc = "guide of the slider"}, &Joints::guide, guides());
}

}  // namespace kurbel
