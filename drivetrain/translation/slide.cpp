// slide.cpp — from the keys of a slide to torques on its shaft, and channels in the units of translation.
#include "drivetrain/translation/slide.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "drivetrain/loads/loads.h"
#include "drivetrain/shared/torque_source.h"
#include "drivetrain/translation/slide_forces.h"
#include "engine/elements/no_element.h"
#include "engine/model/network.h"
#include "engine/scene/effects.h"

namespace kurbel {

ShaftForm under(const SlideWeight&, const Effects& effects) { return effects.gravity ? nullptr : no_element(); }
ShaftForm under(const SlideFriction&, const Effects& effects) { return effects.gravity ? nullptr : no_element(); }

namespace {

// Whose motion and forces are reported.
struct Slide {
  std::string name;
  double per_radian = 1;  // [m/rad]
  double start = 0;       // [m]
};

// Reports only: no torque, no event, no state.
class SlideChannels final : public ElementPool {
 public:
  void add(const Slide& slide, const ShaftPorts& ports, bool counts) {
    for (Entry& entry : entries_)
      if (entry.slide.name == slide.name) {
        entry.forces.push_back(ports.id);
        if (counts) entry.travelled = ports.own;
        return;
      }
    entries_.push_back({slide, ports.node, ports.shaft, ports.gain, {ports.id}, counts ? ports.own : -1});
  }
  void add(const Instant&, Sums&) const override {}
  void register_jacobian(JacobianPattern&) override {}
  void add_jacobian(const Instant&, const double*, double*) const override {}
  void add_channels(std::vector<Channel>& channels) const override {
    for (const Entry& entry : entries_) {
      const auto& [slide, node, shaft, gain, forces, travelled] = entry;
      const double k = slide.per_radian, rate = k * gain, start = slide.start;
      channels.push_back(
          {Name::make(quantities::position, slide.name), "m", [=, i = node, own = travelled](const Snapshot& s) {
             return start + (own < 0 ? k * s.node_angle[i] : s.now.own[own]);
           }});
      channels.push_back({Name::make(quantities::velocity, slide.name), "m/s",
                          [rate, i = shaft](const Snapshot& s) { return rate * s.now.speed[i]; }});
      channels.push_back({Name::make(quantities::acceleration, slide.name), "m/s2",
                          [rate, i = shaft](const Snapshot& s) { return rate * s.alpha[i]; }});
      channels.push_back({Name::make(quantities::force, slide.name), "N", [k, all = forces](const Snapshot& s) {
                            double sum = 0;
                            for (const int id : all) sum += s.sums.element_torque[id] + s.hold_torque[id];
                            return sum / k;
                          }});
    }
  }

 private:
  struct Entry {
    Slide slide;
    int node, shaft;
    double gain;
    std::vector<int> forces;  // shaft elements
    int travelled = -1;       // internal state that counts it; −1: the angle does
  };
  std::vector<Entry> entries_;
};

// A torque on the slide's shaft that its channels count as a force.
class ForceOnSlide final : public AnyShaftElement {
 public:
  ForceOnSlide(Slide slide, ShaftForm torque)
      : AnyShaftElement(*torque), slide_(std::move(slide)), torque_(std::move(torque)) {}
  std::string describe() const override { return torque_->describe(); }
  ShaftForm form_under(const Effects& effects) const override {
    ShaftForm other = torque_->form_under(effects);
    return other ? std::make_shared<ForceOnSlide>(slide_, std::move(other)) : nullptr;
  }
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override {
    torque_->place(pools, ports, label);
    pools.of<SlideChannels>().add(slide_, ports, !internal_states.empty());
  }

 private:
  Slide slide_;
  ShaftForm torque_;
};

void check_slide(const Reading<SlideKeys>& s) {
  using Keys = SlideKeys;
  if (s.force < 0 && !s.always_backwards)
    s.refuse(&Keys::force, fmt::format("force = {:g} N; a force against the motion must be ≥ 0 (with acts = "
                                       "\"always\" it may be negative)",
                                       s.force));
  if (s.mass == 0)
    for (const auto member : {&Keys::inclination, &Keys::friction})
      if (s.given(member) && s.*member != 0)
        s.refuse(member,
                 fmt::format("\"{}\" is about the weight, and the slide has none; give \"mass\"", s.key(member)));
  if (s.table && s.table->period > 0 && s.table->over == "travel")
    s.refuse(&Keys::table, "a table over travel has no period; drop it");
}

}  // namespace

Fields<SlideKeys> slide_fields() {
  using Keys = SlideKeys;
  return Fields<Keys>()
      .add(defaulted("mass", "kg", "0 kg", not_negative, "of all that moves along: m k² on the shaft"), &Keys::mass)
      .add(defaulted("inclination", "rad", "0 deg", {.low = -1.5707963267948968, .high = 1.5707963267948968},
                     "of the direction of drive above the horizontal: 90 deg lifts, -90 deg presses downwards"),
           &Keys::inclination)
      .add(defaulted("gravity", "m/s2", "9.80665 m/s2", not_negative, "its weight is m g", "gravity"), &Keys::gravity)
      .add(defaulted("guide_friction", "", "0", {.low = 0, .high = 10},
                     "μ of the guide under the weight: μ m g cos β against the motion; holds at standstill"),
           &Keys::friction)
      .add(defaulted("force", "N", "0 N", any_number, "constant resistance F₀"), &Keys::force)
      .add(choice("acts", "against motion",
                  "the constant force opposes motion and holds at standstill, or acts always backwards"),
           &Keys::always_backwards, {{"against motion", false}, {"always", true}})
      .add(defaulted("damping", "N*s/m", "0 N*s/m", not_negative, "c in c v"), &Keys::viscous)
      .add(defaulted("quadratic", "N*s2/m2", "0 N*s2/m2", not_negative, "q in q v |v|"), &Keys::quadratic)
      .add(curve("table", {"time", "travel"}, "N",
                 "resisting force over time, or over the travel (return_points: on the way back)"),
           &Keys::table)
      .add(choice("work", "useful", "line of the energy balance of these forces"), &Keys::work,
           {{"useful", Account::useful}, {"harmful", Account::harmful}, {"driving", Account::driving}})
      .add(defaulted("start_travel", "m", "0 m", any_number,
                     "travel at the start; without a table over travel, where the shaft's angle is 0"),
           &Keys::start)
      .check(check_slide);
}

void put_slide(const SlideKeys& s, const std::string& name, int node, double k, Network& net) {
  const Slide slide{name, k, s.start};
  const auto put = [&](auto element) {
    net.put(node, name, std::make_shared<ForceOnSlide>(slide, shaft_form(std::move(element))), {}, 0);
  };
  net.nodes[static_cast<std::size_t>(node)].inertia += s.mass * k * k;
  const double weight = s.mass * s.gravity, along = k * weight * std::sin(s.inclination);
  const double across = k * s.friction * weight * std::cos(s.inclination);
  put(SlideWeight{along});  // also where it is nothing: one element must report the motion
  if (across > 0) put(SlideFriction{across});
  const double viscous = s.viscous * k * k, quadratic = s.quadratic * k * k * k;
  if (s.always_backwards || s.force == 0) {
    if (s.force != 0) put(HarmonicTorque{s.work, -k * s.force, 0, 0, 0});
    if (viscous > 0 || quadratic > 0) put(SpeedLoad{s.work, viscous, quadratic});
  } else if (s.force > 0) {
    put(OpposingLoad{s.work, k * s.force, viscous, quadratic, 0});
  }
  if (!s.table) return;
  const bool over_time = s.table->over == "time";
  using Over = Network::DataRange::Over;
  net.limit({.component = name,
             .of = "force",
             .over = over_time ? Over::time : Over::channel,
             .node = node,
             .channel = "travelled." + name,
             .offset = s.start,
             .unit = over_time ? "s" : "m"},
            s.table->curve());
  if (over_time)
    put(TorqueOverTime{s.work, s.table->curve(), -k});
  else
    put(ForceOverTravel{s.work, s.table->curve(), s.table->x_back.empty() ? Curve() : s.table->back(), k, s.start});
}

}  // namespace kurbel
