// slider_crank_kind.cpp — the slider-crank's keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/numerics/period.h"
#include "mechanisms/kinds/deformation_keys.h"
#include "mechanisms/kinds/joint_keys.h"
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

using Crank = SliderCrankData;

Key inertia_key(const char* name, const char* doc) { return defaulted(name, "kg*m2", "0 kg*m2", not_negative, doc); }

Fields<Crank> slider_crank_linkage() {
  return Fields<Crank>()
      .add(required("radius", "m", positive, "crank radius r", "variable_inertia multibody"), &Crank::radius)
      .add({.name = "rod",
            .unit = "m",
            .domain = positive,
            .doc = "rod length l; equal to radius + |offset|, crank and rod pass change points; shorter, the crank "
                   "rocks within its arc, where the run ends if it is reached",
            .required = true},
           &Crank::rod_length)
      .add(defaulted("offset", "m", "0 m", any_number, "of the slider's line from the crank axis"), &Crank::offset)
      .add(choice("branch", "follows",
                  "of rod = radius + |offset|: how the rod passes upright; follows: x = 2 r cos φ without offset; "
                  "folds: it lies on the crank and the slider rests; with offset, which of two turns φ = 0 is. Of a "
                  "shorter rod, whose crank rocks: follows: the rod points towards +x, folds: towards −x"),
           &Crank::folds, {{"follows", false}, {"folds", true}})
      .add(mass_key("crank_mass", "mass of the crank"), &Crank::crank_mass)
      .add(defaulted("crank_com", "m", "0 m", any_number,
                     "its centre of mass from the axis towards the pin; negative: counterweighted"),
           &Crank::crank_com)
      .add(inertia_key("crank_inertia", "about the crank's axis"), &Crank::crank_inertia)
      .add(mass_key("rod_mass", "mass of the rod"), &Crank::rod_mass)
      .add(quantity("rod_com", "m", any_number,
                    "its centre of mass from the crank pin along the rod; default: half the rod"),
           &Crank::rod_com, [](const Crank& d) { return d.rod_length / 2; })
      .add(inertia_key("rod_inertia", "about its centre of mass"), &Crank::rod_inertia)
      .add(mass_key("slider_mass", "mass of slider and what moves with it"), &Crank::slider_mass)
      .add(gravity_key(), &Crank::gravity)
      .add(defaulted("stroke_angle", "rad", "0 deg", any_number,
                     "direction from crank axis to extended end, above the horizontal: 90 deg slider on top, -90 deg "
                     "top-driven press"),
           &Crank::stroke_angle);
}

// Of one cylinder of several, each a throw: when it fires says where its crank stands.
struct FiringKeys {
  std::optional<int> cylinder;                   // its number
  std::optional<std::vector<int>> order;         // numbers as they fire
  std::optional<std::vector<double>> intervals;  // [rad]
  int strokes = 4;
};

Fields<FiringKeys> firing() {
  return Fields<FiringKeys>()
      .add(quantity("cylinder", "", positive, "its number in firing_order, of an engine of several throws"),
           &FiringKeys::cylinder)
      .add({.name = "firing_order",
            .doc = "numbers of the cylinders in the order in which they fire, the first at 0 deg of the shaft: gives "
                   "the phase, that of the working cycle included"},
           &FiringKeys::order)
      .add(quantity("firing_intervals", "rad", not_negative,
                    "crank angle from each firing to the next, the last back to the first; default: equal"),
           &FiringKeys::intervals)
      .add(choice("strokes", "four", "of a cycle: four take two turns, two take one"), &FiringKeys::strokes,
           {{"four", 4}, {"two", 2}});
}

struct SliderCrankKeys : Mounted<SliderCrankData> {
  FiringKeys firing;
  SliderCrankJointKeys joints;
  DeformationKeys deformation;
};

Fields<SliderCrankKeys> slider_crank_fields() {
  return Fields<SliderCrankKeys>()
      .add(slider_crank_linkage(), &SliderCrankKeys::linkage)
      .add(mounting_without_joints("force on the slider, or a list of them", slider_loads()),
           &SliderCrankKeys::mounting)
      .add(firing(), &SliderCrankKeys::firing)
      .add(joint_fields(), &SliderCrankKeys::joints)
      .add(deformation_fields(), &SliderCrankKeys::deformation);
}

// Angle of the shaft at which this cylinder fires; none, with a message, where order and intervals do not fit.
std::optional<double> fires_at(const Section& s, const FiringKeys& f, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) -> std::optional<double> {
    messages.add(s.where(key), fmt::format("{} \"{}\": {}", s.kind->name, s.name, text));
    return {};
  };
  const double cycle = f.strokes * std::numbers::pi, degree = std::numbers::pi / 180;
  const std::vector<int>& order = *f.order;
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); ++k)
    if (sorted[k] != static_cast<int>(k) + 1)
      return refuse(
          "firing_order",
          fmt::format("firing_order must name each cylinder from 1 to {} once, e.g. [1, 3, 4, 2]", sorted.size()));
  const auto own = std::find(order.begin(), order.end(), *f.cylinder);
  if (own == order.end())
    return refuse("cylinder",
                  fmt::format("cylinder = {} is not in firing_order, which has 1 to {}", *f.cylinder, order.size()));
  const std::vector<double> intervals =
      f.intervals.value_or(std::vector<double>(order.size(), cycle / static_cast<double>(order.size())));
  if (intervals.size() != order.size())
    return refuse(
        "firing_intervals",
        fmt::format(
            "{} firing_intervals for {} cylinders; give one from each firing to the next, the last back to the first",
            intervals.size(), order.size()));
  const double sum = std::accumulate(intervals.begin(), intervals.end(), 0.0);
  if (std::abs(sum - cycle) > 1e-9 * cycle)
    return refuse("firing_intervals",
                  fmt::format("firing_intervals add up to {:.6g} deg; must be the cycle of {:.6g} deg", sum / degree,
                              cycle / degree));
  return std::accumulate(intervals.begin(), intervals.begin() + (own - order.begin()), 0.0);
}

// The phase by the firing order; a phase that is given must be the same crank, of either turn.
bool put_phase(const Section& s, const FiringKeys& f, Mounting& mounting, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("{} \"{}\": {}", s.kind->name, s.name, text));
    return false;
  };
  if (!f.order && !f.cylinder) {
    if (f.intervals) return refuse("firing_intervals", "\"firing_intervals\" needs \"firing_order\" and \"cylinder\"");
    return true;
  }
  if (!f.order) return refuse("cylinder", "\"cylinder\" needs \"firing_order\", e.g. [1, 3, 4, 2]");
  if (!f.cylinder) return refuse("firing_order", "\"firing_order\" needs \"cylinder\", the number of this one, e.g. 1");
  const std::optional<double> at = fires_at(s, f, messages);
  if (!at) return false;
  const double turn = 2 * std::numbers::pi, degree = std::numbers::pi / 180;
  const double phase = place_within(-*at, f.strokes * std::numbers::pi);
  if (s.given("phase") && std::abs(std::remainder(mounting.phase - phase, turn)) > 1e-6)
    return refuse(
        "phase",
        fmt::format("phase = {:.6g} deg, but by the firing order it fires at {:.6g} deg of the shaft, where its crank "
                    "must be at the dead centre: phase = {:.6g} deg; leave the phase out, or mend the order",
                    mounting.phase / degree, *at / degree, place_within(-*at, turn) / degree));
  mounting.phase = phase;
  return true;
}

void build_slider_crank(const Section& s, const Reading<SliderCrankKeys>& mechanism, Network& net) {
  Messages& messages = mechanism.messages();
  Mounting mounting = mechanism.mounting;
  put_phase(s, mechanism.firing, mounting, messages);
  const bool valid = mechanism.valid();
  const SliderCrankData& d = mechanism.linkage;
  DataFaults faults = faults_of(d);
  const bool friction = mechanism.joints.rub();
  const bool deforms = !mechanism.deformation.clearances.empty() || mechanism.deformation.flexibility;
  if (valid && faults.empty() && d.changes() && (friction || deforms))
    faults.push_back({"rod", fmt::format("rod = radius + |offset| = {}, so that crank and rod pass change points, "
                                         "where {}; lengthen the rod, or omit {}",
                                         in_mm(d.rod_length),
                                         friction ? "reactions have no bound and friction by them jams the crank"
                                                  : "gaps and bending decide which way the rod goes on",
                                         friction ? "friction of the joints" : "clearance and rod_flexibility")});
  if (valid && faults.empty() && d.rocks() && deforms)
    faults.push_back(
        {"rod",
         fmt::format(
             "rod = {} is shorter than radius + |offset|, so that the crank rocks; gaps and bending then decide how "
             "far it goes, beyond any arc that is known: lengthen the rod, or omit clearance and rod_flexibility",
             in_mm(d.rod_length))});
  build_mechanism(s, d, mounting, faults, net, messages, joints_of(mechanism.joints),
                  deforming_parts(mechanism.deformation, d, s, messages));
}

}  // namespace

Kind slider_crank_kind() {
  return kind_of<slider_crank_fields, build_slider_crank>(
      on_a_shaft, "slider-crank",
      "crank, rod and slider; φ = 0 with the crank along the stroke (extended, without offset)");
}

}  // namespace kurbel
