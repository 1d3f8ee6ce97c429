// observed.cpp — an observer that samples every step, and the run that it watches.
#include "tests/oracle/observed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"
#include "engine/run/sources.h"

namespace kurbel::oracle {
namespace {

constexpr std::array parts = {0.0, 0.25, 0.5, 0.75, 1.0};                              // of a step
constexpr std::array weights = {7.0 / 90, 32.0 / 90, 12.0 / 90, 32.0 / 90, 7.0 / 90};  // Boole's rule
constexpr double turns = 1e-3;  // of the usual speed: from there on a shaft turns
constexpr double apart = 1e-9;  // of the usual speed: from there on both sides of a contact differ

// A contact as it stands in the model: a joint that slips, a belt's internal state, or a brake on a shaft.
struct Place {
  Contact contact;
  int joint = -1, elastic = -1;  // of the network, of the model
  int internal_state = -1;       // of an elastic belt: what it has slipped
  int element = -1;              // of a brake
  int command = -1;
};

class Sampler final : public Observer {
 public:
  Sampler(std::shared_ptr<const Model> model, double until)
      : model_(std::move(model)), m_(*model_), until_(until), sources_(m_) {
    seen_.model = model_;
    seen_.link = m_.network.nodes[at(m_.reduction_node)].component;
    find_contacts();
    for (const TorqueJoint& joint : m_.torque_joints) seen_.torques.push_back({joint.component});
    for (const std::string& component : m_.network.components) seen_.speeds.push_back({component});
    for (const MotorTorque& motor : m_.motors)
      seen_.motors.push_back({motor.component, motor.rated_torque, motor.rated_speed});
  }

  void step(StepView& view) override {
    const double begin = view.t_previous(), length = view.t() - begin;
    if (!(length > 0)) return;
    std::vector<Stretch> now(places_.size());
    for (std::size_t k = 0; k < parts.size(); ++k) look(view, begin + parts[k] * length, k, length, now);
    for (std::size_t c = 0; c < places_.size(); ++c) {
      now[c].begin = begin, now[c].end = view.t();
      go_on(places_[c].contact, now[c]);
    }
  }

  Observed take(Equations& equations, RunOutcome outcome) {
    if (!outcome.state.empty()) see_end(equations, outcome);
    for (Place& place : places_) seen_.contacts.push_back(std::move(place.contact));
    seen_.outcome = std::move(outcome);
    return std::move(seen_);
  }

 private:
  void find_contacts() {
    for (std::size_t e = 0; e < m_.elastic.size(); ++e) {
      const ElasticJoint& joint = m_.elastic[e];
      const std::string& component = m_.network.joints[at(joint.joint)].component;
      if (!joint.slips) continue;
      Place place{.contact = {component, m_.network.kind_of(component)}, .joint = joint.joint};
      place.elastic = static_cast<int>(e), place.command = m_.command_of(component);
      place.contact.usual_speed = std::abs(joint.gain_a) * m_.shafts[at(joint.shaft_a)].speed_scale;
      place.contact.capacity = m_.network.joints[at(joint.joint)].element->capacity;
      places_.push_back(std::move(place));
    }
    for (std::size_t k = 0; k < m_.internal_states.size(); ++k) {
      if (m_.internal_states[k].state.name != "slipped_angle") continue;
      for (const ElasticJoint& joint : m_.elastic)
        if (m_.network.joints[at(joint.joint)].component == m_.internal_states[k].component) {
          Place place{.contact = {m_.internal_states[k].component, "belt"}, .joint = joint.joint};
          place.internal_state = static_cast<int>(k);
          place.contact.usual_speed = std::abs(joint.gain_a) * m_.shafts[at(joint.shaft_a)].speed_scale;
          places_.push_back(std::move(place));
        }
    }
    for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
      const Network::ShaftElement& element = m_.network.elements[e];
      if (m_.network.kind_of(element.component) != "brake") continue;
      Place place{.contact = {element.component, "brake"}, .element = static_cast<int>(e)};
      place.command = m_.command_of(element.component);
      place.contact.usual_speed = m_.speed_scale * m_.scale_ratio[at(element.node)];
      places_.push_back(std::move(place));
    }
  }

  double command_at(const Place& place, double t, const Equations& equations) const {
    if (place.element >= 0 && !equations.modes().active[at(place.element)]) return 0;
    return place.command < 0 ? 1 : equations.modes().command[at(place.command)].at(t, m_.scene.sequence);
  }
  double slip_of(const Place& place, const Snapshot& s) const {
    if (place.internal_state >= 0) return s.sums.internal_rate[place.internal_state];
    if (place.element >= 0) {
      const std::size_t node = at(m_.network.elements[at(place.element)].node);
      return m_.gain_of_node[node] * s.now.speed[m_.shaft_of_node[node]];
    }
    const ElasticJoint& joint = m_.elastic[at(place.elastic)];
    return joint.gain_a * s.now.speed[joint.shaft_a] - joint.gain_b * s.now.speed[joint.shaft_b];
  }
  double torque_of(const Place& place, const Snapshot& s) const {
    return place.element >= 0 ? s.sums.element_torque[place.element] : s.joint_torque[place.joint];
  }

  // Point k of a step, of all that is followed.
  void look(StepView& view, double t, std::size_t k, double length, std::vector<Stretch>& now) {
    const Snapshot& s = view.snapshot(t);
    if (k > 0 || view.begins_anew()) take_moment(s, t, view.equations());
    for (std::size_t c = 0; c < places_.size(); ++c) {
      const double slip = slip_of(places_[c], s), torque = torque_of(places_[c], s),
                   command = command_at(places_[c], t, view.equations());
      Stretch& stretch = now[c];
      if (k == 0) stretch.command_begin = command;
      stretch.command_end = command, stretch.sense = slip;
      stretch.slip = std::max(stretch.slip, std::abs(slip));
      stretch.torque = std::max(stretch.torque, std::abs(torque));
      stretch.slipped += weights[k] * length * std::abs(slip);
      stretch.heat += weights[k] * length * std::abs(slip * torque);
    }
    const auto extend = [](Extremes& e, double value) {
      e.least = std::min(e.least, value), e.greatest = std::max(e.greatest, value);
    };
    for (std::size_t j = 0; j < m_.torque_joints.size(); ++j)
      extend(seen_.torques[j], m_.torque_joints[j].torque(s.joint_torque));
    for (Extremes& e : seen_.speeds) {
      const std::size_t node = at(m_.network.ports.at(e.of).out);
      extend(e, m_.gain_of_node[node] * s.now.speed[m_.shaft_of_node[node]]);
    }
    for (std::size_t i = 0; i < m_.motors.size(); ++i) {
      const double torque = m_.motors[i].torque(s);
      seen_.motors[i].squares += weights[k] * length * torque * torque;
      if (t > 0.75 * until_) {
        const std::size_t node = at(m_.motors[i].node), last = t > 0.875 * until_ ? 1 : 0;
        seen_.motors[i].late_squares[last] += weights[k] * length * torque * torque;
        seen_.motors[i].late_turned[last] +=
            weights[k] * length * m_.gain_of_node[node] * s.now.speed[at(m_.shaft_of_node[node])];
      }
      seen_.motors[i].greatest = std::max(seen_.motors[i].greatest, std::abs(torque));
    }
  }

  // The step is added to what the contact did before it, or begins something else.
  void go_on(Contact& contact, Stretch now) {
    using State = Stretch::State;
    const bool open = now.command_begin == 0 && now.command_end == 0;
    now.state = open ? State::open : now.slip > apart * contact.usual_speed ? State::slips : State::holds;
    // A hold of a clutch that is closed is a stretch of its own.
    const auto closed = [](const Stretch& stretch) { return stretch.command_begin >= 1 && stretch.command_end >= 1; };
    if (contact.stretches.empty() || contact.stretches.back().state != now.state ||
        (now.state == State::holds && closed(now) != closed(contact.stretches.back())))
      return contact.stretches.push_back(now);
    Stretch& last = contact.stretches.back();
    last.end = now.end, last.command_end = now.command_end, last.sense = now.sense;
    last.slip = std::max(last.slip, now.slip), last.torque = std::max(last.torque, now.torque);
    last.slipped += now.slipped, last.heat += now.heat;
  }

  void take_moment(const Snapshot& s, double t, const Equations& equations) {
    const std::size_t shaft = at(m_.shaft_of_node[at(m_.reduction_node)]);
    Moment moment{.t = t, .angle = s.node_angle[m_.reduction_node]};
    moment.speed = m_.gain_of_node[at(m_.reduction_node)] * s.now.speed[shaft];
    for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
      const Network::ShaftElement& element = m_.network.elements[e];
      const double torque = s.sums.element_torque[e] * m_.node_ratio[at(element.node)];
      const std::size_t own = at(m_.shaft_of_node[at(element.node)]);
      if (element.element->account == Account::driving) {
        moment.drive += torque;
        if (std::abs(s.now.speed[own]) <= turns * m_.shafts[own].speed_scale)
          moment.pushed = std::max(moment.pushed, std::abs(torque));
      } else if (!element.element->is.directional) {
        moment.load += torque;
      }
    }
    for (std::size_t k = 0; k < m_.commands.size(); ++k)
      moment.reported.push_back(equations.modes().command[k].at(t, m_.scene.sequence));
    moment.on = equations.modes().active;
    moment.driven = sources_.drive(equations.modes().active);
    moment.held = equations.at_standstill(shaft);
    seen_.moments.push_back(moment);
  }

  void see_end(Equations& equations, const RunOutcome& outcome) {
    const Snapshot& s = equations.snapshot(outcome.t, outcome.state);
    for (std::size_t i = 0; i < m_.motors.size(); ++i) {
      const MotorTorque& motor = m_.motors[i];
      MotorSeen& seen = seen_.motors[i];
      seen.torque = motor.torque(s);
      seen.speed = m_.gain_of_node[at(motor.node)] * s.now.speed[m_.shaft_of_node[at(motor.node)]];
      if (const int command = m_.command_of(motor.component); command >= 0)
        seen.command = equations.modes().command[at(command)].at(outcome.t, m_.scene.sequence);
      if (!motor.elements.empty() && std::none_of(motor.elements.begin(), motor.elements.end(),
                                                  [&](std::size_t e) { return equations.modes().active[e] != 0; }))
        seen.command = 0;
    }
    for (const Shaft& shaft : m_.shafts) {
      const std::size_t k = static_cast<std::size_t>(&shaft - m_.shafts.data());
      seen_.fastest_shaft = std::max(seen_.fastest_shaft, std::abs(s.now.speed[k]) / shaft.speed_scale);
      if (std::abs(s.now.speed[k]) > turns * shaft.speed_scale) seen_.turning.push_back(m_.node_label(shaft.reference));
    }
  }

  std::shared_ptr<const Model> model_;
  const Model& m_;
  double until_;
  Sources sources_;
  std::vector<Place> places_;
  Observed seen_;
};

}  // namespace

Observed observe(std::shared_ptr<const Model> model, double until, double budget) {
  Equations equations(model, false);
  Sampler sampler(model, until);
  RunOptions options{.tolerance = 1e-9, .until = until, .budget = budget, .progress = {}};
  // The scene's method may be one that looks at the machine over its angle: the oracle steps in time.
  options.method = "auto";
  RunOutcome outcome = integrate(equations, options, {&sampler});
  const double cpu_seconds = outcome.statistics.cpu_seconds;
  Observed observed = sampler.take(equations, std::move(outcome));
  observed.cpu_seconds = cpu_seconds;
  return observed;
}

}  // namespace kurbel::oracle
